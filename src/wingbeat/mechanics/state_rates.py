"""The right-hand side of a flight: rates of the body, of the shed wake, and of a wing whose pitch gives way.

A hinge that nothing drives adds a fourth equation to the body's three, ``J theta'' + sum m v . (p'' + psi'' E b) =
tau - Q``: v is the velocity that a unit rate of the hinge gives the wing, J its inertia, tau the torque of spring,
damper and stops, and Q what it would take to hold theta'' at 0 (`hinge_torques`). The four are linear in the
accelerations. So the body is accelerated first as if theta'' were 0, then by a unit of theta''; the fourth equation
gives how much of it there is.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from wingbeat._base import Fault, InvalidInputError
from wingbeat._jax.arrays import computed_once, fusion_barrier, jax, jnp
from wingbeat.aero.wake import wake_rates
from wingbeat.animal.kinematics import PitchHinge, Wingbeat, held_at
from wingbeat.mechanics.flight_model import (
    BodyLoads,
    FlightModel,
    accelerations,
    air_loads,
    balance,
    loads_at,
    motion_table,
    of_body_balance,
    strip_parts,
)
from wingbeat.mechanics.hinge_torques import PartialMotion, hinge_alone, required_force
from wingbeat.mechanics.strip_air import (
    loads_of_strips,
    strip_loads_in_wake,
    strip_moments,
    unsteady_density,
    velocity_at_wings,
    wake_of,
    wake_states,
)
from wingbeat.mechanics.wing_motion import WingMotion, stroke_attitude
from wingbeat.mechanics.wing_shape import (
    UnturnedShapes,
    dot,
    from_world,
    strips_of,
    to_world,
    unturned_shapes,
    with_time_axes,
)

if TYPE_CHECKING:
    from wingbeat._jax.arrays import FlightState, PerStrip, Phases, PhasesPair, Scalar

HINGE_STATE = ("hinge_angle", "hinge_rate")


class GivingStroke(NamedTuple):
    """What depends on time alone of a wing whose pitch is a state."""

    phase: Phases
    wingbeat: Wingbeat  # its numbers have the shape of the phases
    shapes: UnturnedShapes


def hinge_states(wingbeat: Wingbeat) -> int:
    """Return the number of states of a wingbeat's hinge: two, or none without one."""
    return 0 if wingbeat.pitch_hinge is None else len(HINGE_STATE)


def rate_table(model: FlightModel, wingbeat: Wingbeat, phase: Phases, vector: int = 1) -> WingMotion | GivingStroke:
    """Tabulate what `body_rates` needs at phases; `vector` is as in `motion_table`."""
    if wingbeat.pitch_hinge is None:
        return motion_table(model, wingbeat, phase, vector)
    if model.wake is not None:
        fix = "leave the lag of the wake out, or prescribe the pitch"
        raise InvalidInputError([Fault("aero.wake", "the lag", "is not built for a wing that gives way", fix)])
    phase = jnp.asarray(phase, dtype=float)
    spread = jax.tree_util.tree_map(lambda a: jnp.broadcast_to(jnp.asarray(a, dtype=float), phase.shape), wingbeat)
    still, strips = jnp.zeros_like(phase), with_time_axes(strips_of(model.vehicle.wing, model.strips), phase)
    at_zero = held_at(wingbeat, phase, still, still, still)
    return GivingStroke(phase, spread, unturned_shapes(model.vehicle, at_zero, strips, phase))


def body_rates(model: FlightModel, motion: WingMotion | GivingStroke, state: FlightState) -> FlightState:
    """Return d/dt of (body_pitch, u, w, pitch_rate), of the hinge and of the wake.

    Theory: equations ``state-rates`` and ``hinge-balance``.
    """
    if isinstance(motion, GivingStroke):
        tables = computed_once(_tables(model, motion, state[4], state[5]))
        return _rates_with_hinge(model, tables, state)
    body_pitch, u, w, pitch_rate = state if model.wake is None else state[:4]
    attitude = stroke_attitude(model.vehicle.wing, motion, body_pitch)
    wake = wake_of(model, motion, state)
    # Without inflow, the air loads depend on the pitch state through three numbers only: the velocity in stroke
    # axes and the pitch rate. So three derivatives of the loads give those by all four parts of the state.
    loads = air_loads(model, motion, attitude, u, w, pitch_rate, wake=wake)
    ax, az, pitch_acceleration = accelerations(
        model.vehicle, model.air.gravity, motion, loads, attitude, pitch_rate, unsteady_density(model)
    )
    rates = jnp.stack([pitch_rate, ax, az, pitch_acceleration])
    if wake is None or model.wake is None:
        return rates
    lag = wake_rates(model.wake.rates, wake.pace, wake.shed, wake_states(model, state))
    return jnp.concatenate([rates, *lag])


class _GivingTables(NamedTuple):
    """The wing's motion at the states of its hinge, and what the hinge moves."""

    motion: WingMotion
    along: PartialMotion
    inertia: Phases  # that the hinge moves [kg m2]
    hinge: PitchHinge


def _tables(model: FlightModel, stroke: GivingStroke, angle: Phases, rate: Phases) -> _GivingTables:
    hinge, phase = stroke.wingbeat.pitch_hinge, stroke.phase
    assert isinstance(hinge, PitchHinge)
    held = held_at(stroke.wingbeat, phase, angle, rate, jnp.zeros_like(phase))
    motion = motion_table(model, held, phase, shapes=stroke.shapes)
    return _GivingTables(motion, *hinge_alone(model, held, phase, stroke.shapes), hinge)


def _rates_with_hinge(model: FlightModel, tables: _GivingTables, state: FlightState) -> FlightState:
    """Return d/dt of (body_pitch, u, w, pitch_rate, angle, rate). Theory: equation ``hinge-balance``."""
    body_pitch, u, w, pitch_rate, angle, rate = state
    motion, along = tables.motion, tables.along
    attitude = stroke_attitude(model.vehicle.wing, motion, body_pitch)
    velocity = velocity_at_wings(model, attitude, u, w)
    body = () if model.induced_flow is None else from_world(attitude, u, w)
    strips = computed_once(loads_of_strips(model, motion, velocity, pitch_rate, None))
    loads = loads_at(model, motion, velocity, pitch_rate, body, strips)
    density = unsteady_density(model)
    mass, *right, arm, inertia = balance(model.vehicle, model.air.gravity, motion, loads, attitude, pitch_rate)
    moments = strip_moments(model, motion, strips) if model.at_centre_of_pressure else 0.0
    still, weight = jnp.zeros_like(u), from_world(attitude, 0.0, model.air.gravity)
    needed = sum(
        required_force(model, along, strips, moments, velocity, pitch_rate, weight, still, (still, still, still))
    )
    coupling = (*along.first_moment, along.euler)
    if along.unsteady is not None:
        coupling = tuple(a + density * b for a, b in zip(coupling, along.unsteady.by_acceleration, strict=True))
    free = of_body_balance(mass, arm, inertia, motion, density, tuple(right))
    pushed = of_body_balance(mass, arm, inertia, motion, density, tuple(-one for one in coupling))
    left = tables.hinge.torque(angle, rate) - needed - dot(coupling, free)
    acceleration = left / (tables.inertia + dot(coupling, pushed))
    forward, up, turning = (a + acceleration * b for a, b in zip(free, pushed, strict=True))
    ax, az = to_world(attitude, forward, up)
    return jnp.stack([pitch_rate, ax, az, turning, rate, acceleration])


def acceleration_on_stand(
    model: FlightModel, stroke: GivingStroke, angle: Phases, rate: Phases, speed: Scalar = 0.0
) -> Phases:
    """Return the hinge's acceleration where a stand holds the body, at zero pitch, in wind of `speed` from ahead.

    Theory: equation ``hinge-balance``, with the body's accelerations 0.
    """
    motion, along, inertia, hinge = _tables(model, stroke, angle, rate)
    still = jnp.zeros_like(angle)
    attitude = stroke_attitude(model.vehicle.wing, motion, still)
    velocity = velocity_at_wings(model, attitude, still + speed, still)
    strips = loads_of_strips(model, motion, velocity, still, None)
    moments = strip_moments(model, motion, strips) if model.at_centre_of_pressure else 0.0
    weight = from_world(attitude, 0.0, model.air.gravity)
    held = (still, still, still)
    needed = required_force(model, along, strips, moments, velocity, still, weight, still, held)
    return (hinge.torque(angle, rate) - sum(needed)) / inertia


def slopes_with_hinge(model: FlightModel, stroke: GivingStroke, state: FlightState, changes: GivingStroke) -> Any:
    """Return the derivatives of all rates by the states, then along changes of the stroke, (S, directions, ...).

    The body's state does not change the wing's tables, so its directions do without their derivatives.
    """
    zeros = jax.tree_util.tree_map(lambda a: jnp.zeros((2, *a.shape[1:])), changes)
    strokes = jax.tree_util.tree_map(lambda a, b: jnp.concatenate([a, b]), zeros, changes)
    count = strokes.phase.shape[0]
    unit = jnp.zeros((count, *state.shape)).at[0, 4].set(1.0).at[1, 5].set(1.0)
    tables, along = jax.linearize(lambda *at: _tables(model, *at), stroke, state[4], state[5])
    # Behind the barrier, tables and their derivatives are computed once.
    tables, turned = fusion_barrier((tables, jax.vmap(along)(strokes, unit[:, 4], unit[:, 5])))

    def by_body(body: Any) -> Any:
        return _rates_with_hinge(model, tables, jnp.concatenate([body, state[4:]]))

    of_body = jax.vmap(jax.linearize(by_body, state[:4])[1])
    seeds = jnp.broadcast_to(jnp.eye(4).reshape(4, 4, *[1] * (state.ndim - 1)), (4, 4, *state.shape[1:]))
    rest = jax.vmap(jax.linearize(lambda *at: _rates_with_hinge(model, *at), tables, state)[1])
    return jnp.moveaxis(jnp.concatenate([of_body(seeds), rest(turned, unit)]), 1, 0)


def refuse_without_motion(wingbeat: Wingbeat, hinge: PhasesPair | None = None) -> None:
    """Refuse a hinge that gives way where its motion is not known."""
    if wingbeat.pitch_hinge is not None and hinge is None:
        rule, fix = "gives way, and its motion is not known here", "solve an orbit, whose certificate knows it"
        raise InvalidInputError([Fault("pitch_hinge", "the wing's pitch", rule, fix)])


def held_wingbeat(
    model: FlightModel, wingbeat: Wingbeat, phase: Phases, state: FlightState
) -> tuple[Wingbeat, Any]:
    """Return the wingbeat as one that is prescribed near the phases, with the hinge's motion there, and all rates.

    A wingbeat without a hinge is returned as it is.
    """
    rates = body_rates(model, rate_table(model, wingbeat, phase), state)
    if wingbeat.pitch_hinge is None:
        return wingbeat, rates
    return held_at(wingbeat, phase, state[4], state[5], rates[5]), rates


def rates_by_wake(model: FlightModel, motion: WingMotion, state: FlightState) -> tuple[Any, PerStrip]:
    """Return the derivatives of (u', w', pitch_rate') by the downwash of each strip's wake, and all paces."""
    wake = wake_of(model, motion, state)
    assert wake is not None
    attitude = stroke_attitude(model.vehicle.wing, motion, state[0])

    # The strips do not act on one another, so one derivative in all their directions has those by each.
    def parts(more: Any) -> tuple[Any, Any]:
        met = wake._replace(normal_speed=wake.normal_speed + more, downwash=wake.downwash + more)
        strips = strip_loads_in_wake(model, motion, met)
        return jnp.stack(strip_parts(model, motion, strips)), strips.speed

    nothing = jnp.zeros_like(wake.shed)
    loads, speed = jax.jvp(parts, (nothing,), (jnp.ones_like(nothing),))[1]
    loads = 2.0 * loads
    if motion.unsteady is not None:
        dampings = [(one.damping, one.damping_by_spin) for one in motion.unsteady]
        damped = [0.0 * speed if own is None else speed * (own + state[3] * spin) for own, spin in dampings]
        loads = loads - unsteady_density(model) * jnp.stack(damped)

    def accelerated(forward: Any, up: Any, moment: Any) -> Any:
        pushed = BodyLoads((forward, up), moment)
        found = accelerations(
            model.vehicle, model.air.gravity, motion, pushed, attitude, state[3], unsteady_density(model)
        )
        return jnp.stack(found)

    zero, one = jnp.zeros_like(attitude), jnp.ones_like(attitude)
    seeds = [tuple(one if i == j else zero for j in range(3)) for i in range(3)]
    by_load = fusion_barrier([jax.jvp(accelerated, (zero, zero, zero), seed)[1] for seed in seeds])
    return sum(by[:, None] * load for by, load in zip(by_load, loads, strict=True)), wake.pace
