"""One period flown with fixed steps, and the exact derivative of its end.

First, the states are computed, step after step. Then the tangents of all steps are computed at once, as lanes; the
tangents of each step start from the state at its start. Last, the step maps are multiplied. The position (x, z)
does not affect the flight: it is a sum over the steps.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._jax.arrays import fusion_barrier, jax, jnp
from wingbeat._jax.exported import exported
from wingbeat.animal.kinematics import Wingbeat, unpack
from wingbeat.mechanics.flight_model import FlightModel, body_rates, motion_table
from wingbeat.mechanics.wing_motion import WingMotion
from wingbeat.orbits.flight.runge_kutta import ALONG, PLACES, WEIGHTS
from wingbeat.orbits.flight.stroke_distances import ROWS, least_distances

if TYPE_CHECKING:
    from wingbeat._jax.arrays import (
        EndJacobian,
        FlownPath,
        Free,
        FreeTangents,
        LinearMap,
        MappedTangents,
        PathJacobian,
        PitchState,
        Scalar,
        Stages,
        StateTangents,
        StateVector,
        StrokeJacobian,
        StrokeRows,
        TableRows,
        TableTangents,
        Tangents,
    )


# One compiled march has this many steps; finer flights chain several marches.
STEPS = 32


class Flown(NamedTuple):
    """A period flown from x = z = 0, and its derivatives by (body_pitch, u, w, pitch_rate, free parameters).

    `end` is the last state, shape (6,). `path` is body pitch, or the whole pitch state, at the start and after each
    step, shape (K, components). The last axis of each Jacobian is the unknowns. `stroke` holds the distances of the
    stroke from its limits; it and its derivative by the free parameters are None unless requested.
    """

    end: StateVector
    path: FlownPath
    end_jacobian: EndJacobian
    path_jacobian: PathJacobian
    stroke: StrokeRows = None
    stroke_jacobian: StrokeJacobian = None


def _tabulate(
    model: FlightModel, wingbeat: Wingbeat, first: Scalar, last: Scalar
) -> tuple[tuple[TableRows, Scalar], WingMotion]:
    """Tabulate the wing at the ends of the steps, then at their middles.

    Returns the table as one array of rows, the length of a step [s], and the table itself.
    """
    whole = jnp.arange(STEPS + 1) / STEPS
    phase = first + (last - first) * jnp.concatenate([whole, whole[:-1] + 0.5 / STEPS])
    table = motion_table(model, wingbeat, phase)
    return (_in_rows(table), (last - first) / (wingbeat.frequency * STEPS)), table


def _in_rows(table: WingMotion) -> TableRows:
    """Return a table as one array, (rows, times), because one array is faster to slice than many."""
    return jnp.concatenate([leaf.reshape(-1, leaf.shape[-1]) for leaf in jax.tree_util.tree_leaves(table)])


def _from_rows(rows: TableRows, like: Any) -> WingMotion:
    """Return a table from its rows; `like` is a table with the same structure."""
    leaves, tree = jax.tree_util.tree_flatten(like)
    sizes = np.cumsum([int(np.prod(leaf.shape[:-1])) for leaf in leaves])
    parts = jnp.split(rows, sizes[:-1])
    shaped = [part.reshape(*leaf.shape[:-1], *rows.shape[1:]) for part, leaf in zip(parts, leaves, strict=True)]
    return jax.tree_util.tree_unflatten(tree, shaped)


# Indices of the four stages of all steps along the last axis of a table of `_tabulate`.
_STAGES = [(slice(STEPS), slice(STEPS + 1, None), slice(1, STEPS + 1))[place] for place in PLACES]


class March(NamedTuple):
    """States and rates of all stages, shape (4 components, 4 stages, steps), and the last state (4,)."""

    states: Stages
    rates: Stages
    last: PitchState


def _combine(stages: Any) -> Any:
    """Return the weighted mean of the four stages along the first axis."""
    return sum(weight * stages[i] for i, weight in enumerate(WEIGHTS.tolist()))


def _march(model: FlightModel, table: TableRows, like: Any, step: Scalar, start: PitchState) -> March:
    """Fly the steps in sequence by the classical Runge-Kutta method."""
    stages = jnp.asarray(ALONG), jnp.asarray(WEIGHTS)

    def advance(state: Any, rows: Any) -> tuple[Any, tuple[Any, Any]]:
        def stage(carry: tuple[Any, Any], given: Any) -> tuple[tuple[Any, Any], tuple[Any, Any]]:
            (rate, mean), (row, along, weight) = carry, given
            here = state + along * step * rate
            rate = body_rates(model, _from_rows(row, like), here)
            return (rate, mean + weight * rate), (here, rate)

        nothing = jnp.zeros_like(state)
        (_, mean), flown = jax.lax.scan(stage, (nothing, nothing), (rows, *stages))
        return state + step * mean, flown

    rows = jnp.stack([table.T[part] for part in _STAGES], axis=1)
    last, (states, rates) = jax.lax.scan(advance, start, rows)
    return March(states.transpose(2, 1, 0), rates.transpose(2, 1, 0), last)


def _stage_tangents(
    model: FlightModel, table: TableRows, tangents: TableTangents, like: Any, states: Stages
) -> tuple[StateTangents, FreeTangents]:
    """Differentiate the rates of every stage of every step; one vectorised right-hand side handles all stages.

    Returns the derivatives by state and by free parameter, shapes (4, 4 rates, stages, steps) and (free, 4 rates,
    stages, steps).
    """

    def in_lanes(rows: Any) -> Any:
        return jnp.concatenate([rows[..., part] for part in _STAGES], axis=-1)

    lanes, state = _from_rows(in_lanes(table), like), states.reshape(4, -1)

    def by_state(seed: Any) -> Any:
        tangent = jnp.broadcast_to(seed[:, None], state.shape)
        return jax.jvp(lambda s: body_rates(model, lanes, s), (state,), (tangent,))[1]

    def by_free(rows: Any) -> Any:
        tangent = _from_rows(rows, like)
        return jax.jvp(lambda motion: body_rates(model, motion, state), (lanes,), (tangent,))[1]

    def to_stages(rows: Any) -> Any:
        return rows.reshape(-1, 4, 4, STEPS)

    return to_stages(jax.vmap(by_state)(jnp.eye(4))), to_stages(jax.vmap(by_free)(in_lanes(tangents)))


def _through(by_state: LinearMap, tangents: Tangents) -> MappedTangents:
    """Apply a linear map (4, components, ..), state first, to tangents (directions, 4, ..).

    The sums are written out, because XLA on CPU vectorises sums of products along the last axis, but not products
    of small matrices. With `einsum` a flight takes 1.8 ms in place of 1.6 ms.
    """
    return sum(tangents[:, j, None] * by_state[j] for j in range(4))


def _chain(
    flight: March,
    by_state: StateTangents,
    by_free: FreeTangents,
    step: Scalar,
    step_tangent: Free,
    components: int,
) -> Flown:
    """Compose the tangents of all stages into those of the steps, and these into those of the period.

    Directions are the first axis, components the next, steps the last.

    Theory: equation ``step-chain``.
    """
    states, rates = flight.states, flight.rates
    by_free = jnp.concatenate([jnp.zeros((4, *by_free.shape[1:])), by_free])
    lengthen = jnp.pad(step_tangent, (4, 0))[:, None, None]
    first = jnp.broadcast_to(jnp.eye(lengthen.size, 4)[..., None], (lengthen.size, 4, STEPS))
    state_tangents, rate_tangents = [first], []
    for i, advance in enumerate((0.5, 0.5, 1.0, None)):
        rate_tangents.append(fusion_barrier(_through(by_state[:, :, i], state_tangents[i]) + by_free[:, :, i]))
        if advance is not None:
            state_tangents.append(first + advance * (step * rate_tangents[i] + lengthen * rates[:, i]))
    step_map = fusion_barrier(
        first + step * _combine(rate_tangents) + lengthen * _combine(rates.transpose(1, 0, 2))
    )
    mean_speed = _combine(states.transpose(1, 0, 2))[1:3]
    place_map = fusion_barrier(step * _combine(state_tangents)[:, 1:3] + lengthen * mean_speed)

    def follow(jacobian: Any, after: Any) -> tuple[Any, Any]:
        return _through(after[:4], jacobian).at[4:].add(after[4:]), jacobian

    last, path = jax.lax.scan(follow, jnp.eye(lengthen.size, 4), step_map.transpose(2, 0, 1))
    place = jnp.sum(_through(place_map[:4], path.transpose(1, 2, 0)), axis=-1)
    place = place.at[4:].add(jnp.sum(place_map[4:], axis=-1))
    return Flown(
        jnp.concatenate([step * jnp.sum(mean_speed, axis=-1), flight.last]),
        jnp.concatenate([states[:components, 0].T, flight.last[None, :components]]),
        jnp.concatenate([place, last], axis=1).T,
        jnp.concatenate([path[:, :, :components], last[None, :, :components]]).transpose(0, 2, 1),
    )


@exported(static=("free", "components", "stroke"), hot=True)
def fly_part(
    model: FlightModel,
    wingbeat: Wingbeat,
    values: Free,
    start: PitchState,
    first: Scalar,
    last: Scalar,
    *,
    free: tuple[str, ...],
    components: int,
    stroke: bool,
) -> Flown:
    """Fly `STEPS` steps between two phases with the free parameters at `values`, and differentiate.

    The part that starts at phase 0 also returns the least distances of the stroke from its limits over the whole
    beat, because a separate program for them would double the cost.

    Theory: equation ``runge-kutta``.
    """

    def by_values(at: Any) -> Any:
        return _tabulate(model, unpack(free, wingbeat, at), first, last)

    (table, step), along, like = jax.linearize(by_values, values, has_aux=True)
    tangents, step_tangent = jax.vmap(along)(jnp.eye(len(free)))
    table, tangents = fusion_barrier((table, tangents))
    flight = _march(model, table, like, step, start)
    by_state, by_free = _stage_tangents(model, table, tangents, like, flight.states)
    flown = _chain(flight, by_state, by_free, step, step_tangent, components)
    if not stroke:
        return flown

    def near(at: Any) -> tuple[Any, Any]:
        def rows(values: Any) -> Any:
            return least_distances(model.vehicle, unpack(free, wingbeat, values), model.strips)

        found, along = jax.linearize(rows, at)
        return found, jax.vmap(along, out_axes=1)(jnp.eye(len(free)))

    def nothing(at: Any) -> tuple[Any, Any]:
        return jnp.zeros(len(ROWS)), jnp.zeros((len(ROWS), len(free)))

    rows, jacobian = jax.lax.cond(first == 0.0, near, nothing, values)
    return flown._replace(stroke=rows, stroke_jacobian=jacobian)


def flier(
    model: FlightModel, wingbeat: Wingbeat, free: tuple[str, ...], *, whole_path: bool = False, stroke: bool = False
) -> Callable[..., Flown]:
    """Return a function that flies one period, given free parameters, pitch state at x = z = 0, and `blocks`.

    The function flies `blocks` times `STEPS` steps and differentiates them. `Flown.path` holds the body pitch
    alone, or with `whole_path` the whole pitch state; the derivatives of the whole pitch state take a tenth of a
    batch's time. With `stroke`, the function also returns the distances of the stroke from its limits.
    """
    part = fly_part.bind(model, wingbeat, free=free, components=4 if whole_path else 1, stroke=stroke)

    def fly(values: np.ndarray, start: np.ndarray, blocks: int = 1) -> Flown:
        flown = part(values, start, 0.0, 1.0 / blocks)
        for i in range(1, blocks):
            flown = _then(flown, part(values, flown.end[2:], i / blocks, (i + 1) / blocks))
        return flown

    return fly


def _then(before: Flown, part: Flown) -> Flown:
    """Join two parts that were flown one after the other."""
    chained = before.end_jacobian[2:]

    def from_start(jacobian: Any) -> np.ndarray:
        whole = np.asarray(jacobian)[..., :4] @ chained
        whole[..., 4:] += np.asarray(jacobian)[..., 4:]
        return whole

    end, end_jacobian = np.array(part.end), from_start(part.end_jacobian)
    end[:2] += before.end[:2]
    end_jacobian[:2] += before.end_jacobian[:2]
    return before._replace(
        end=end,
        path=np.concatenate([before.path, np.asarray(part.path)[1:]]),
        end_jacobian=end_jacobian,
        path_jacobian=np.concatenate([before.path_jacobian, from_start(part.path_jacobian)[1:]]),
    )
