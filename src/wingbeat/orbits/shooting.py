"""One period flown with fixed steps, and the exact derivative of where it ends.

The march goes first, in sequence; then the tangents of all steps at once as lanes, each from the state where
its step began; last the chain of the small step maps. Place (x, z) feeds nothing back and is a sum of steps.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from wingbeat.jax64 import jax, jnp
from wingbeat.kinematics import Wingbeat, unpack
from wingbeat.model import FlightModel, body_rates, motion_table
from wingbeat.stored import stored
from wingbeat.wing_motion import WingMotion


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
    """The wing at the ends and middles of all steps, leading axis 2 steps + 1, and the length of a step [s]."""

    motion: WingMotion
    step: Any


@stored(static=("steps",))
def tabulate(model: FlightModel, wingbeat: Wingbeat, *, steps: int) -> StageTables:
    """Tabulate the wing for a march of `steps` equal steps over one period."""
    motion = motion_table(model, wingbeat, jnp.linspace(0.0, 1.0, 2 * steps + 1))
    return StageTables(motion, 1.0 / (wingbeat.frequency * steps))


@stored(static=("free", "steps"))
def tabulate_tangents(
    model: FlightModel, wingbeat: Wingbeat, values: Any, *, free: tuple[str, ...], steps: int
) -> tuple[StageTables, StageTables]:
    """Tabulate the wing and its derivatives (leading axis) with respect to the free parameters."""
    tables, along = jax.linearize(lambda v: tabulate(model, unpack(free, wingbeat, v), steps=steps), values)
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

    stages = jax.tree_util.tree_map(lambda a: jnp.stack([a[:-1:2], a[1::2], a[2::2]], axis=1), tables.motion)
    last, (states, rates) = jax.lax.scan(advance, start, stages)
    place = tables.step * jnp.sum(_combine(jnp.moveaxis(states, 1, 0))[:, 1:3], axis=0)
    path = jnp.concatenate([states[:, 0], last[None]])
    return March(Period(jnp.concatenate([place, last]), path), states, rates)


def fly(model: FlightModel, wingbeat: Wingbeat, start: Any, steps: int) -> Period:
    """Fly one period of a wingbeat from a pitch state at x = z = 0."""
    return march(model, tabulate(model, wingbeat, steps=steps), start).period


def fly_with_tangents(
    model: FlightModel, wingbeat: Wingbeat, free: tuple[str, ...], values: Any, start: Any, steps: int
) -> PeriodTangents:
    """Fly one period and differentiate its end and path by start and free parameters, now at `values`.

    Three compiled pieces, not one: XLA fuses across them to no good (twice the compile time, thrice the run).
    """
    tables, tangents = tabulate_tangents(model, wingbeat, values, free=free, steps=steps)
    flight = march(model, tables, start)
    return differentiate(model, tables, tangents, flight)


@stored
def differentiate(
    model: FlightModel, tables: StageTables, table_tangents: StageTables, flight: March
) -> PeriodTangents:
    """Differentiate a flown period: every stage of every step is a lane of one right-hand side."""
    stage = 2 * jnp.arange(flight.states.shape[0])[:, None] + jnp.asarray([0, 1, 1, 2])
    lanes = jax.tree_util.tree_map(lambda a: a[stage], tables.motion)
    lane_tangents = jax.tree_util.tree_map(lambda a: a[:, stage], table_tangents.motion)

    def by_state(seed: Any) -> Any:
        tangent = jnp.broadcast_to(seed, flight.states.shape)
        return jax.jvp(lambda s: body_rates(model, lanes, s), (flight.states,), (tangent,))[1]

    def by_free(tangent: WingMotion) -> Any:
        return jax.jvp(lambda motion: body_rates(model, motion, flight.states), (lanes,), (tangent,))[1]

    by_states = jax.vmap(by_state, out_axes=-1)(jnp.eye(4))
    by_frees = jax.vmap(by_free, out_axes=-1)(lane_tangents)
    return _chain(flight, (by_states, by_frees), tables.step, table_tangents.step)


def _chain(flight: March, tangents: tuple[Any, Any], step: Any, step_tangent: Any) -> PeriodTangents:
    """Compose the tangents of all stages into those of the steps, and these into those of the period."""
    states, rates = (jnp.moveaxis(a, 1, 0) for a in (flight.states, flight.rates))
    by_state, by_free = (jnp.moveaxis(a, 1, 0) for a in tangents)
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
