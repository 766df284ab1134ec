"""The certificate: an independent adaptive flight of one period.

It shares no step with the solver's flights: Dopri8, with error control at rtol 1e-10, evaluates the wing's motion
at its own instants. With the lag, the solver's flight says only where to look for the wake that repeats.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._jax.arrays import fusion_barrier, jax, jnp
from wingbeat._jax.exported import exported
from wingbeat.animal.kinematics import Wingbeat, parameter
from wingbeat.mechanics.flight_model import FlightModel, State
from wingbeat.mechanics.flights import RTOL, Steps, fly_through
from wingbeat.mechanics.state_rates import body_rates, hinge_states, rate_table
from wingbeat.orbits.flight.lagged import InnerStart, RepeatingStates
from wingbeat.orbits.flight.march import ALONG, PLACES, WEIGHTS
from wingbeat.orbits.flight.period import Flown, flier, inner_start
from wingbeat.orbits.search_options import WAKE, WakeOptions

if TYPE_CHECKING:
    from wingbeat._jax.arrays import Stretches, StretchMaps, StretchStates

SAMPLES = 256
# Number of samples of a flight that serves only the correction.
_ROUGH_SAMPLES = 32


@dataclass(frozen=True)
class Certificate:
    """One period flown by the certifier.

    Attributes
    ----------
    phase : phases of the samples, shape (K,).
    states : (x, z, body_pitch, u, w, pitch_rate) there, shape (K, 6) [m, m, rad, m/s, m/s, rad/s].
    steps : the integrator's steps.
    wake : with the lag of the wake, the states of each strip's wake there, shape (K, 2 strips) [m/s]; else None.
    hinge : angle and rate of a hinge that gives way there, shape (K, 2) [rad, rad/s]; None without one.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> flown = wb.certify(orbit.problem.model, orbit.wingbeat, orbit.initial_state[2:])
    >>> round(float(flown.end[0]) * orbit.wingbeat.frequency, 3), flown.pitch.shape  # mean speed, body pitch
    (12.0, (257,))
    """

    phase: np.ndarray
    states: np.ndarray
    steps: Steps
    wake: np.ndarray | None = None
    hinge: np.ndarray | None = None

    @property
    def end(self) -> np.ndarray:
        """The state at the end of the period."""
        return self.states[-1]

    @property
    def pitch(self) -> np.ndarray:
        """Body pitch along the path [rad]."""
        return self.states[:, 2]

    @property
    def path(self) -> np.ndarray:
        """All states but the position: shape (K, 4), more with those of hinge and wake."""
        inner = [one for one in (self.hinge, self.wake) if one is not None]
        return np.hstack([self.states[:, 2:], *inner])

    @property
    def wake_miss(self) -> float | None:
        """Largest change of a state of the wake over the period [m/s]; None without the lag."""
        return None if self.wake is None else float(np.abs(self.wake[-1] - self.wake[0]).max())

    @property
    def inner_miss(self) -> float:
        """Largest change of a state of wake or hinge over the period; 0 without any."""
        return max(self.wake_miss or 0.0, self.hinge_miss or 0.0)

    @property
    def hinge_miss(self) -> float | None:
        """Largest change of the hinge's angle or rate over the period [rad, rad/s]; None without a hinge."""
        return None if self.hinge is None else float(np.abs(self.hinge[-1] - self.hinge[0]).max())


def certify(
    model: FlightModel,
    wingbeat: Wingbeat,
    pitch_state: np.ndarray,
    rtol: float = RTOL,
    *,
    rough: bool = False,
    near: InnerStart | None = None,
    lag: WakeOptions = WAKE,
) -> Certificate:
    """Fly one period from x = z = 0 and the given (body_pitch, u, w, pitch_rate).

    With the lag of the wake or a hinge that gives way, the period is flown again until their states repeat, too, or
    the flights of `lag` are spent; `Certificate.wake_miss` and `hinge_miss` say how nearly they repeat.

    Theory: equation ``certificate``.

    Parameters
    ----------
    model, wingbeat : the flight model and its wingbeat.
    pitch_state : initial pitch state, shape (4,) [rad, m/s, m/s, rad/s].
    rtol : relative tolerance of the flight.
    rough : whether to sample the path at only a few phases, which takes half the time.
    near : where to look for these states; the search knows it, and it saves flights.
    lag : how exactly they must repeat.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> flown = wb.certify(orbit.problem.model, orbit.wingbeat, orbit.initial_state[2:])
    >>> bool(abs(flown.end[2:] - flown.states[0, 2:]).max() < 1e-6)
    True
    """
    # A rough flight has the same number of phases, the last ones all at the end. One compiled program thus serves
    # both kinds of flight.
    phase = np.minimum(np.linspace(0.0, SAMPLES / _ROUGH_SAMPLES if rough else 1.0, SAMPLES + 1), 1.0)
    start, first = State(0.0, 0.0, *pitch_state), inner_start(model, wingbeat)
    if not first.size:
        return Certificate(phase, *fly_through(model, wingbeat, start, phase, rtol))

    def from_inner(inner: np.ndarray) -> tuple[np.ndarray, Steps]:
        return fly_through(model, wingbeat, start, phase, rtol, wake=(inner,))

    states, steps = _repeating(from_inner, near, first, lag.rough_repeats if rough else lag.repeats, lag)
    hinge, wake = np.split(states[:, 6:], [hinge_states(wingbeat)], axis=1)
    parts = (None if part.size == 0 else part for part in (wake, hinge))
    return Certificate(phase, states[:, :6], steps, *parts)


def _repeating(
    fly: Callable[[np.ndarray], tuple[np.ndarray, Steps]],
    near: InnerStart | None,
    inner: np.ndarray,
    tolerance: float,
    lag: WakeOptions,
) -> tuple[np.ndarray, Steps]:
    """Fly until the inner states repeat, by Broyden's method for the inverse; return the last flight."""
    unit = np.eye(inner.size)
    inverse = unit
    if near is not None:
        inner, inverse = near.states, np.linalg.inv(unit - near.slopes)
    states, steps = fly(inner)
    for _ in range(lag.certifying_flights - 1):
        miss = states[-1, 6:] - inner
        if not np.abs(miss).max() > tolerance:  # or not a number
            break
        step = inverse @ miss
        inner = inner + step
        states, steps = fly(inner)
        change = miss - (states[-1, 6:] - inner)
        back = inverse @ change
        if np.isfinite(back).all() and step @ back:
            inverse = inverse + np.outer(step - back, step @ inverse) / (step @ back)
    return states, steps


# Number of steps in each step of the certifier, whose steps are short at the kinks of the loads. With two, the
# multipliers of unstable bats are within 1e-5 of those of an adaptive flight.
_STEPS = 2
# Distances from the path at which flights start: (body_pitch, u, w, pitch_rate) [rad, m/s, m/s, rad/s], and that
# of u for the wake. The first derivatives of a flight are exact to 1e-13, so one-sided differences of them can
# have steps as short as this.
_BESIDE = np.array([1e-7, 1e-6, 1e-6, 1e-6])
# Number of stretches of the path that are flown at once, as lanes: few enough for the processor's first cache.
_LANES = 64


@exported
def _state_maps(
    model: FlightModel, wingbeat: Wingbeat, begin: Stretches, end: Stretches, path: StretchStates
) -> StretchMaps:
    """Return the derivative of each stretch's last state (pitch, wake) by its first, by flights beside the path."""
    length = (end - begin) / _STEPS
    seconds = length / wingbeat.frequency

    def stage(carry: Any, given: Any) -> tuple[Any, None]:
        state, rate, total = carry
        motion, along, weight = given
        here = fusion_barrier(state + along * seconds * rate)
        rate = fusion_barrier(jax.vmap(lambda at: body_rates(model, motion, at))(here))
        return (state, rate, total + weight * rate), None

    def step(state: Any, index: Any) -> tuple[Any, None]:
        phases = begin + length * (index + jnp.array([0.0, 0.5, 1.0])[:, None])
        motion = rate_table(model, wingbeat, phases.ravel())
        rows = jax.tree_util.tree_map(
            lambda leaf: jnp.moveaxis(leaf.reshape(*leaf.shape[:-1], 3, -1), -2, 0)[PLACES], motion
        )
        nothing = jnp.zeros_like(state)
        stages = rows, jnp.asarray(ALONG), jnp.asarray(WEIGHTS)
        (_, _, change), _ = jax.lax.scan(stage, (state, nothing, nothing), stages)
        return state + seconds * change, None

    apart = _apart(path.shape[1])
    beside = jnp.concatenate([jnp.zeros((1, len(apart))), jnp.diag(apart)])
    there, _ = jax.lax.scan(step, path.T + beside[..., None], jnp.arange(_STEPS))
    return ((there[1:] - there[0]) / apart[:, None, None]).transpose(2, 1, 0)


def floquet_multipliers(model: FlightModel, wingbeat: Wingbeat, steps: Steps) -> np.ndarray:
    """Return the four multipliers of largest modulus over a period, the largest first, shape (4,).

    They are eigenvalues of the `monodromy` matrix, without the lag of the wake all of them; not-a-number if the
    flight diverges.

    Parameters
    ----------
    steps : the certifier's steps.
    model, wingbeat : the flight model and its wingbeat.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> steps = wb.certify(orbit.problem.model, orbit.wingbeat, orbit.initial_state[2:]).steps
    >>> multipliers = wb.floquet_multipliers(orbit.problem.model, orbit.wingbeat, steps)
    >>> round(float(abs(multipliers[0])), 2)
    1.35
    """
    return multipliers_of(monodromy(model, wingbeat, steps))


def multipliers_of(matrix: np.ndarray) -> np.ndarray:
    """Return the four largest eigenvalues of a matrix, largest modulus first. Theory: equation ``multipliers``."""
    if not np.isfinite(matrix).all():
        return np.full(4, np.nan + 0j)
    found = np.linalg.eigvals(matrix)
    return found[np.lexsort((-found.imag, -found.real, -np.round(np.abs(found), 9)))][:4]


def monodromy(model: FlightModel, wingbeat: Wingbeat, steps: Steps) -> np.ndarray:
    """Return the derivative of the pitch state at the end of a period by that at its start, shape (4, 4).

    The states of a hinge that gives way, or of the wake, follow. It is not-a-number if the flight diverges.

    Theory: equation ``monodromy``.
    """
    phase, path = steps.phase, steps.states[:, 2:]
    if phase[-1] < 1.0:
        return np.full((path.shape[1], path.shape[1]), np.nan)
    maps_of, count, blocks = _state_maps.bind(model, wingbeat), len(phase) - 1, []
    for first in range(0, count, _LANES):
        # Spare lanes repeat the last stretch.
        lanes = np.minimum(np.arange(first, first + _LANES), count - 1)
        blocks.append(maps_of(phase[lanes], phase[lanes + 1], path[lanes]))
    maps = np.concatenate(blocks)[:count]
    while len(maps) > 1:  # multiply in pairs; the first map acts first
        last = maps[len(maps) // 2 * 2 :]
        maps = np.concatenate([maps[1::2] @ maps[: len(maps) // 2 * 2 : 2], last])
    return maps[0]


class StrokeMap(NamedTuple):
    """Derivatives of (z, body_pitch, u, w, pitch_rate) after one beat, and the pitch state at K equal phases.

    A hinge that gives way adds its angle and rate to both.
    """

    by_state: np.ndarray  # by the same numbers before the beat, shape (5, 5), or (7, 7) with a hinge
    by_parameters: np.ndarray  # by parameters of the wingbeat, shape (5, parameters), or (7, parameters)
    transition: np.ndarray  # of the pitch state at each phase by that at phase 0, shape (K, 4, 4), or (K, 6, 6)
    path: np.ndarray  # the pitch state there, shape (K, 4) [rad, m/s, m/s, rad/s], or (K, 6)


def stroke_map(
    model: FlightModel, wingbeat: Wingbeat, pitch_state: np.ndarray, parameters: tuple[str, ...], blocks: int
) -> StrokeMap:
    """Differentiate one beat of `blocks` times 32 steps, by parameters. Theory: equation ``stroke-map``.

    A hinge's angle and rate follow the pitch state.
    """
    fly = flier(model, wingbeat, parameters, whole_path=True, repeating=False)
    values = np.array([parameter(wingbeat, name) for name in parameters], dtype=float)
    start = np.asarray(pitch_state, dtype=float)
    flown, size = fly(values, start, blocks), start.size
    end = np.asarray(flown.end_jacobian)[1:]
    height = np.eye(1 + size, 1)  # the flight does not depend on the height
    transition = np.asarray(flown.path_jacobian)[..., :size]
    return StrokeMap(np.hstack([height, end[:, :size]]), end[:, size:], transition, np.asarray(flown.path))


def map_and_changes(
    fly: Callable[..., Flown], values: np.ndarray, start: np.ndarray, blocks: int, flown: Flown
) -> tuple[np.ndarray, np.ndarray]:
    """Return the stroke map of the pitch state and of a hinge, (S, S), and its derivatives, (unknowns, S, S)."""
    # Second derivatives of the flight do not depend on the order of differentiation. So we shift each of the S
    # states in turn, and take the change of the exact first derivatives by all unknowns. This takes S flights
    # beside the one `flown`, however many parameters are free.
    along = None
    if isinstance(fly, RepeatingStates):
        if flown.inner is None:  # the flight diverges
            size = start.size + fly.size
            return np.full((size, size), np.nan), np.full((start.size + values.size, size, size), np.nan)
        start, along, fly = np.concatenate([start, flown.inner.states]), flown.inner.along, fly.disturbed
        flown = fly(values, start, blocks)
    size, here = start.size, np.asarray(flown.end_jacobian)[2:]
    apart = _apart(size)
    beside = [np.asarray(fly(values, start + step, blocks).end_jacobian)[2:] for step in np.diag(apart)]
    changes = [(there - here) / step for there, step in zip(beside, apart, strict=True)]
    by_unknowns = np.stack(changes, axis=-1).transpose(1, 0, 2)
    if along is not None:  # the states of a hinge that repeat move with the unknowns
        by_body, by_inner, by_free = np.split(by_unknowns, [4, size])
        by_unknowns = np.concatenate([by_body, by_free]) + np.tensordot(along, by_inner, (0, 0))
    return here[:, :size], by_unknowns


def _apart(states: int) -> np.ndarray:
    """Return by how much flights beside a path are off it, for each state."""
    return np.append(_BESIDE, np.full(states - _BESIDE.size, _BESIDE[1]))
