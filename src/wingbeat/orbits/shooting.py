"""One period flown with fixed steps, and the exact derivative of where it ends.

The march goes first, in sequence; then the tangents of all steps at once as lanes, each from the state where
its step began; last the chain of the small step maps. Place (x, z) feeds nothing back and is a sum of steps.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from wingbeat.jax64 import jax, jnp
from wingbeat.kinematics import Wingbeat, unpack
from wingbeat.model import FlightModel, body_rates, motion_table
from wingbeat.stored import stored
from wingbeat.wing_motion import WingMotion

# One compiled march has this many steps; finer flights chain several.
STEPS = 64


class Period(NamedTuple):
    """One period flown: where it ends from x = z = 0, and the pitch state at each step, shape (steps+1, 4)."""

    end: Any
    path: Any


class PeriodTangents(NamedTuple):
    """A period and its derivatives with respect to (body_pitch, u, w, pitch_rate, free parameters)."""

    period: Period
    end_jacobian: Any
    path_jacobian: Any


class StageTables(NamedTuple):
    """The wing at the ends and middles of all steps, last axis 2 steps + 1, and the length of a step [s]."""

    motion: WingMotion
    step: Any


@stored
def tabulate(model: FlightModel, wingbeat: Wingbeat, first: Any, last: Any) -> StageTables:
    """Tabulate the wing for a march of `STEPS` equal steps from one phase to another."""
    phase = first + (last - first) * jnp.linspace(0.0, 1.0, 2 * STEPS + 1)
    return StageTables(motion_table(model, wingbeat, phase), (last - first) / (wingbeat.frequency * STEPS))


@stored(static=("free",))
def tabulate_tangents(
    model: FlightModel, wingbeat: Wingbeat, values: Any, first: Any, last: Any, *, free: tuple[str, ...]
) -> tuple[StageTables, StageTables]:
    """Tabulate the wing and its derivatives (leading axis) with respect to the free parameters."""

    def by_values(at: Any) -> StageTables:
        return tabulate(model, unpack(free, wingbeat, at), first, last)

    tables, along = jax.linearize(by_values, values)
    return tables, jax.vmap(along)(jnp.eye(len(free)))


def _rk4(model: FlightModel, motion: WingMotion, step: Any, state: Any) -> tuple[Any, Any]:
    """Return the states and rates of the four stages of a classical Runge-Kutta step, shape (4, 4) each."""
    states, rates = [state], []
    for stage, advance in zip((0, 1, 1, 2), (0.5, 0.5, 1.0, None), strict=True):
        here = jax.tree_util.tree_map(lambda a, i=stage: a[i], motion)
        rates.append(body_rates(model, here, states[-1]))
        if advance is not None:
            states.append(state + advance * step * rates[-1])
    return jnp.stack(states), jnp.stack(rates)


def _combine(stages: Any) -> Any:
    """Return the weighted mean of the four stages along the first axis, weights 1, 2, 2, 1."""
    return (stages[0] + 2.0 * (stages[1] + stages[2]) + stages[3]) / 6.0


class March(NamedTuple):
    """A period with the states and rates of all Runge-Kutta stages, shape (steps, 4, 4)."""

    period: Period
    states: Any
    rates: Any


@stored
def march(model: FlightModel, tables: StageTables, start: Any) -> March:
    """Fly one period from a pitch state at x = z = 0 with fixed steps."""

    def advance(state: Any, motion: WingMotion) -> tuple[Any, tuple[Any, Any]]:
        states, rates = _rk4(model, motion, tables.step, state)
        return state + tables.step * _combine(rates), (states, rates)

    def by_step(table: Any) -> Any:
        times = jnp.moveaxis(table, -1, 0)
        return jnp.stack([times[:-1:2], times[1::2], times[2::2]], axis=1)

    stages = jax.tree_util.tree_map(by_step, tables.motion)
    last, (states, rates) = jax.lax.scan(advance, start, stages)
    place = tables.step * jnp.sum(_combine(jnp.moveaxis(states, 1, 0))[:, 1:3], axis=0)
    path = jnp.concatenate([states[:, 0], last[None]])
    return March(Period(jnp.concatenate([place, last]), path), states, rates)


@stored
def differentiate(
    model: FlightModel, tables: StageTables, table_tangents: StageTables, flight: March
) -> PeriodTangents:
    """Differentiate a flown period: every stage of every step is a lane of one right-hand side."""
    stage = (jnp.asarray([0, 1, 1, 2])[:, None] + 2 * jnp.arange(STEPS)).ravel()
    lanes, lane_tangents = (
        jax.tree_util.tree_map(lambda a: a[..., stage], tables.motion) for tables in (tables, table_tangents)
    )
    states = flight.states.transpose(2, 1, 0).reshape(4, -1)

    def by_state(seed: Any) -> Any:
        tangent = jnp.broadcast_to(seed[:, None], states.shape)
        return jax.jvp(lambda s: body_rates(model, lanes, s), (states,), (tangent,))[1]

    def by_free(tangent: WingMotion) -> Any:
        return jax.jvp(lambda motion: body_rates(model, motion, states), (lanes,), (tangent,))[1]

    def to_stages(rows: Any) -> Any:
        return rows.reshape(rows.shape[0], 4, 4, STEPS).transpose(2, 3, 1, 0)  # stages, steps, rates, seeds

    by_states = to_stages(jax.vmap(by_state)(jnp.eye(4)))
    by_frees = to_stages(jax.vmap(by_free)(lane_tangents))
    return _chain(flight, (by_states, by_frees), tables.step, table_tangents.step)


def _chain(flight: March, tangents: tuple[Any, Any], step: Any, step_tangent: Any) -> PeriodTangents:
    """Compose the tangents of all stages into those of the steps, and these into those of the period."""
    states, rates = (jnp.moveaxis(a, 1, 0) for a in (flight.states, flight.rates))
    by_state, by_free = tangents
    by_free = jnp.pad(by_free, ((0, 0), (0, 0), (0, 0), (4, 0)))
    lengthen = jnp.pad(step_tangent, (4, 0))
    first = jnp.broadcast_to(jnp.eye(4, lengthen.size), by_free.shape[1:])
    state_tangents, rate_tangents = [first], []
    for i, advance in enumerate((0.5, 0.5, 1.0, None)):
        rate_tangents.append(by_state[i] @ state_tangents[i] + by_free[i])
        if advance is not None:
            longer = rates[i][..., None] * lengthen
            state_tangents.append(first + advance * (step * rate_tangents[i] + longer))
    step_map = first + step * _combine(rate_tangents) + _combine(rates)[..., None] * lengthen
    place_map = step * _combine(state_tangents) + _combine(states)[..., None] * lengthen

    def follow(jacobian: Any, after: Any) -> tuple[Any, Any]:
        return (after[:, :4] @ jacobian).at[:, 4:].add(after[:, 4:]), jacobian

    last, path = jax.lax.scan(follow, jnp.eye(4, lengthen.size), step_map)
    place = jnp.einsum("kij,kjl->il", place_map[:, 1:3, :4], path)
    place = place.at[:, 4:].add(jnp.sum(place_map[:, 1:3, 4:], axis=0))
    return PeriodTangents(flight.period, jnp.concatenate([place, last]), jnp.concatenate([path, last[None]]))


def fly(model: FlightModel, wingbeat: Wingbeat, start: Any, blocks: int = 1) -> Period:
    """Fly one period of a wingbeat from a pitch state at x = z = 0, in `blocks` times `STEPS` steps."""
    place, state, paths = np.zeros(2), start, [np.asarray(start)[None]]
    for first, last in _parts(blocks):
        part = march(model, tabulate(model, wingbeat, first, last), state).period
        end = np.asarray(part.end)
        place, state = place + end[:2], end[2:]
        paths.append(np.asarray(part.path)[1:])
    return Period(np.concatenate([place, state]), np.concatenate(paths))


def fly_with_tangents(
    model: FlightModel, wingbeat: Wingbeat, free: tuple[str, ...], values: Any, start: Any, blocks: int = 1
) -> PeriodTangents:
    """Fly one period and differentiate its end and path by start and free parameters, now at `values`.

    Three compiled pieces, not one: XLA fuses across them to no good (twice the compile time, thrice the run).
    """
    chained, place = np.eye(4, 4 + len(free)), np.zeros((2, 4 + len(free)))
    state, ends, paths, path_jacobians = start, np.zeros(2), [np.asarray(start)[None]], [chained[None]]
    for first, last in _parts(blocks):
        tables, tangents = tabulate_tangents(model, wingbeat, values, first, last, free=free)
        part = differentiate(model, tables, tangents, march(model, tables, state))
        end, jacobian = np.asarray(part.period.end), _after(chained, part.end_jacobian)
        paths.append(np.asarray(part.period.path)[1:])
        path_jacobians.append(_after(chained, part.path_jacobian)[1:])
        chained, place = jacobian[2:], place + jacobian[:2]
        state, ends = end[2:], ends + end[:2]
    period = Period(np.concatenate([ends, state]), np.concatenate(paths))
    return PeriodTangents(period, np.concatenate([place, chained]), np.concatenate(path_jacobians))


def _after(before: np.ndarray, part: Any) -> np.ndarray:
    """Return a part's derivative with respect to what the period starts from, `before` being that of its start."""
    here = np.asarray(part)
    whole = here[..., :4] @ before
    whole[..., 4:] += here[..., 4:]
    return whole


def _parts(blocks: int) -> list[tuple[float, float]]:
    return [(i / blocks, (i + 1) / blocks) for i in range(blocks)]
