"""The derivative of a period flown with inner states, and those inner states that repeat.

Inner states are the angle and rate of a hinge that gives way, and with the lag of the wake two of each strip. The
step loop integrates them with the body. They must return after a beat as the body does, but they are no unknowns of
the search: at given unknowns their start z follows from ``z(T; z) = z``, which Newton's method solves. Its matrix,
the derivative of z(T) by z, comes with each flight, because tangents of body and inner states are propagated
together. Eliminating the start condenses the derivatives: the search sees a flight of the body alone (the lifted
Newton method, Albersmeyer and Diehl 2010, doi 10.1137/080724885). The search moves in small steps, so the start
predicted from the flight before is nearly right, and most points take one flight.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._jax.arrays import jax, jnp
from wingbeat.orbits.flight.march import ALONG, STEPS, WEIGHTS, March, along_stages, from_rows, in_lanes
from wingbeat.orbits.search_options import WakeOptions

if TYPE_CHECKING:
    from wingbeat._jax.arrays import ByStripWake, Free, PerStrip, Scalar, TableRows, TableTangents


def chained(
    rates: tuple[Callable[..., Any], Callable[..., Any], Callable[..., Any]],
    model: Any,
    table: TableRows,
    tangents: TableTangents,
    like: Any,
    flight: March,
    step: Scalar,
    step_tangent: Free,
) -> tuple[Any, Any, Any]:
    """Return places, states and their tangents: the end (2 + S,), its Jacobian, and that of the path.

    There are S states; `rates` are `body_rates`, `rates_by_wake`, `slopes_with_hinge`. Directions, the states and
    then the free parameters, are the last axis. Theory: equation ``step-chain``.
    """
    (body_rates, rates_by_wake, slopes_with_hinge), size, free = rates, flight.last.size, step_tangent.size
    lanes, state, by_state, by_free = along_stages(body_rates, model, table, like, flight.states)
    if model.wake is None:
        changes = jax.vmap(lambda rows: from_rows(rows, like))(in_lanes(tangents))
        columns = [slopes_with_hinge(model, lanes, state, changes)]
    else:
        own = jax.vmap(by_free)(in_lanes(tangents))  # (free, S, lanes)
        by_wake, pace = rates_by_wake(model, lanes, state)
        body = jax.vmap(by_state)(jnp.eye(size)[:4])  # (4, S, lanes)
        columns = [body.transpose(1, 0, 2), _wake_columns(model, by_wake, pace), own.transpose(1, 0, 2)]
    # (steps, 4 stages, S, directions)
    slopes = jnp.concatenate(columns, axis=1).reshape(size, size + free, 4, STEPS).transpose(3, 2, 0, 1)
    # The step grows with the free parameters, whose tangents are rows of the unit matrix below those of the states.
    lengthen, unit = jnp.pad(step_tangent, (size, 0)), jnp.eye(free, size + free, size)
    first = jnp.eye(size, size + free)

    def advance(carry: Any, given: Any) -> tuple[Any, Any]:
        before, place = carry
        slope, states, rates = given
        rate: Any = 0.0
        mean: Any = 0.0
        mean_rate: Any = 0.0
        speed: Any = 0.0
        mean_speed: Any = 0.0
        for i in range(4):
            here = before if i == 0 else before + ALONG[i] * (step * rate + rates[i - 1][:, None] * lengthen)
            rate = slope[i] @ jnp.concatenate([here, unit])
            mean, mean_rate = mean + WEIGHTS[i] * rate, mean_rate + WEIGHTS[i] * rates[i]
            speed, mean_speed = speed + WEIGHTS[i] * here[1:3], mean_speed + WEIGHTS[i] * states[i, 1:3]
        after = before + step * mean + mean_rate[:, None] * lengthen
        place = place + step * speed + mean_speed[:, None] * lengthen
        return (after, place), before

    given = slopes, flight.states.transpose(2, 1, 0), flight.rates.transpose(2, 1, 0)
    (last, place), path = jax.lax.scan(advance, (first, jnp.zeros((2, size + free))), given)
    mean_speed = jnp.einsum("i,cis->c", jnp.asarray(WEIGHTS), flight.states[1:3])
    end = jnp.concatenate([step * mean_speed, flight.last])
    return end, jnp.concatenate([place, last]), jnp.concatenate([path, last[None]])


def _wake_columns(model: Any, by_wake: ByStripWake, pace: PerStrip) -> Any:
    """Return the derivatives of all rates by the states of the wake, (S, S - 4, lanes)."""
    strips = by_wake.shape[1]
    shares, rates = (np.repeat(np.eye(2), strips, axis=0) @ jnp.asarray(a) for a in model.wake[:2])
    of_body = -shares[:, None] * jnp.concatenate([by_wake, by_wake], axis=1)
    of_wake = -jnp.eye(2 * strips)[..., None] * (rates[:, None] * jnp.concatenate([pace, pace]))
    return jnp.concatenate([jnp.zeros((1, *of_body.shape[1:])), of_body, of_wake])


class InnerStart(NamedTuple):
    """The inner states at phase 0 of a flight, whether they repeat, and the flight's stroke map.

    The map is the derivative of (body_pitch, u, w, pitch_rate) and inner states after a beat by those before it.
    `along` is the derivative of the states that repeat by the unknowns.
    """

    states: np.ndarray
    repeats: bool
    stroke_map: np.ndarray
    along: np.ndarray

    @property
    def slopes(self) -> np.ndarray:
        """Derivative of the inner states after a beat by those before it."""
        return self.stroke_map[4:, 4:]


class RepeatingStates:
    """A flier of the body alone: it finds the inner states that repeat, and condenses the derivatives.

    `fly` flies all states of one period, in blocks, and is kept as `disturbed`; `first` are inner states to begin
    with; `whole` says whether the path has all states, or body pitch. A flier predicts the states from its last
    flight, so a search has a copy of its own.
    """

    def __init__(self, fly: Callable[..., Any], first: np.ndarray, whole: bool, options: WakeOptions) -> None:
        self.disturbed, self._first, self._whole, self._options = fly, first, whole, options
        self.size = first.size
        self._last: tuple[np.ndarray, np.ndarray, np.ndarray] | None = None

    def __call__(self, values: np.ndarray, start: np.ndarray, blocks: int = 1) -> Any:
        """Fly one period from a pitch state; the result is that of `flier`."""
        place = np.concatenate([start, values])
        states, options = self._predicted(place), self._options
        flown: Any = None
        repeats = False
        step, along, jacobian = np.zeros((self.size, 1)), np.zeros((self.size, place.size)), np.zeros((0, 0))
        for _ in range(options.most_flights):
            flown = self.disturbed(values, np.concatenate([start, states]), blocks)
            jacobian, miss = np.asarray(flown.end_jacobian), np.asarray(flown.end)[6:] - states
            largest = np.maximum(np.abs(jacobian).max(initial=0.0), np.abs(miss).max())
            if not largest < options.diverged:  # or not a number
                return self._condensed(flown, np.zeros(self.size), np.zeros((self.size, place.size)))
            slopes, others = self._split(jacobian[6:])
            step, along = np.split(
                np.linalg.solve(np.eye(self.size) - slopes, np.column_stack([miss, others])), [1], axis=1
            )
            repeats = bool(np.abs(step).max() <= options.near)
            if repeats:
                break
            # Far from the states that repeat, to fly on is safer than Newton's step: disturbances die out.
            far = np.abs(step).max() > options.far * (1.0 + np.abs(states).max())
            states = states + (miss if far else step[:, 0])
        self._last = place, states + step[:, 0], along
        start_of = InnerStart(self._last[1], repeats, jacobian[2:, : 4 + self.size], along)
        return self._condensed(flown, step[:, 0], along)._replace(inner=start_of)

    def _predicted(self, place: np.ndarray) -> np.ndarray:
        if self._last is None:
            return self._first
        before, states, along = self._last
        predicted = states + along @ (place - before)
        return predicted if np.abs(predicted - states).max() < np.abs(states).max() + 1.0 else states

    def _split(self, jacobian: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the columns of the wake's states, and the others."""
        end = 4 + self.size
        return jacobian[..., 4:end], np.concatenate([jacobian[..., :4], jacobian[..., end:]], axis=-1)

    def _condensed(self, flown: Any, step: np.ndarray, along: np.ndarray) -> Any:
        def moved(values: Any, jacobian: Any) -> tuple[np.ndarray, np.ndarray]:
            by_wake, others = self._split(np.asarray(jacobian))
            return np.asarray(values) + by_wake @ step, others + by_wake @ along

        end, end_jacobian = moved(flown.end[:6], flown.end_jacobian[:6])
        kept = slice(None) if self._whole else slice(1)
        path, path_jacobian = moved(flown.path[:, kept], flown.path_jacobian[:, kept])
        return flown._replace(end=end, end_jacobian=end_jacobian, path=path, path_jacobian=path_jacobian)
