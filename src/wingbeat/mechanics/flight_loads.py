"""All motions, loads and powers of a vehicle that flies a prescribed wingbeat, at given phases and states."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from wingbeat._jax.arrays import jax, jnp
from wingbeat._jax.exported import exported
from wingbeat.animal.kinematics import Wingbeat, flap_angle, fold_angle, pitch_angle, span_ratio, sweep_angle
from wingbeat.mechanics.flight_model import BodyLoads, FlightModel, State, air_loads, balance, motion_table
from wingbeat.mechanics.hinge_torques import hinge_loads, hinge_motion
from wingbeat.mechanics.state_rates import body_rates, held_wingbeat, refuse_without_motion
from wingbeat.mechanics.strip_air import is_unsteady, refuse_without_wake
from wingbeat.mechanics.wing_motion import WingMotion, stroke_attitude
from wingbeat.mechanics.wing_points import air_forces_on, point_motion
from wingbeat.mechanics.wing_shape import air_chord, dot, from_world, strips_of, time_rates, to_world

if TYPE_CHECKING:
    from wingbeat._jax.arrays import (
        Coordinates,
        MassPoints,
        PerStrip,
        Phases,
        PhasesAcceleration,
        PhasesPair,
        PhasesStrips,
        StripVectors,
    )


class Loads(NamedTuple):
    """Motions, forces, torques and powers along a flight, with the axes of phase first.

    Vectors are in world axes. Strips are those of the left wing. Torques and powers are those of both wings
    together; momenta and energies are those of the whole vehicle.

    Attributes
    ----------
    flap, flap_rate : of the arm, up positive [rad, rad/s].
    wing_pitch, wing_pitch_rate : at the root, leading edge up positive [rad, rad/s].
    span_ratio : span divided by the full span.
    fold, sweep : angle of the hand below the arm, and of the span ahead of the stroke plane [rad].
    acceleration : (x'', z'', psi'') of the body [m/s2, m/s2, rad/s2].
    strip_position, strip_velocity : of the quarter chords [m, m/s], shape (..., N, 3).
    strip_speed : the speed V of the loads [m/s], shape (..., N).
    strip_reynolds : Reynolds number of the strip's chord at that speed, shape (..., N).
    alpha : angle of attack [rad], shape (..., N).
    lift, drag : of each strip [N], shape (..., N).
    strip_force : on each strip [N], shape (..., N, 3).
    air_force : generalised air loads on the five coordinates [N, N m], shape (..., 5).
    flap_torque, pitch_torque : of the hinges [N m].
    hinge_power, actuator_power : of the hinges, and of all actuators [W].
    aerodynamic_power, inertial_power, body_power : parts of the hinge power [W], see `HingeLoads`.
    air_power : power of the air loads on wings, body and tail [W].
    profile_power, induced_power, parasite_power, unsteady_power : parts of `air_power` by cause, with the
        opposite sign [W]; see `AirPower`.
    centre_of_mass : x and z [m], shape (..., 2).
    momentum : x and z [kg m/s], shape (..., 2).
    angular_momentum : about the centre of mass, nose-up positive [kg m2/s].
    kinetic_energy, potential_energy : [J].
    wake_downwash : by which the shed wake moves the air at the strips [m/s], shape (..., N); None without the lag.
    """

    flap: Phases
    flap_rate: Phases
    wing_pitch: Phases
    wing_pitch_rate: Phases
    span_ratio: Phases
    fold: Phases
    sweep: Phases
    acceleration: PhasesAcceleration
    strip_position: StripVectors
    strip_velocity: StripVectors
    strip_speed: PhasesStrips
    strip_reynolds: PhasesStrips
    alpha: PhasesStrips
    lift: PhasesStrips
    drag: PhasesStrips
    strip_force: StripVectors
    air_force: Coordinates
    flap_torque: Phases
    pitch_torque: Phases
    hinge_power: Phases
    actuator_power: Phases
    aerodynamic_power: Phases
    inertial_power: Phases
    body_power: Phases
    air_power: Phases
    profile_power: Phases
    induced_power: Phases
    parasite_power: Phases
    unsteady_power: Phases
    centre_of_mass: PhasesPair
    momentum: PhasesPair
    angular_momentum: Phases
    kinetic_energy: Phases
    potential_energy: Phases
    wake_downwash: PhasesStrips | None = None


@exported
def flight_loads(
    model: FlightModel,
    wingbeat: Wingbeat,
    state: State,
    phase: Phases,
    wake: PhasesStrips | None = None,
    hinge: PhasesPair | None = None,
) -> Loads:
    """Evaluate a flight with prescribed wings: loads, body accelerations, hinge torques and powers.

    Theory: equations ``energies`` and ``energy-identity``.

    Parameters
    ----------
    model : the flight model.
    wingbeat : the prescribed wingbeat.
    state : body state, fields of shape (...) or one for all phases [m, rad, m/s, rad/s].
    phase : phases, shape (...).
    wake : with the lag of the wake, the states of each strip's wake [m/s], shape (..., 2 N), as a `Certificate` has
        them.
    hinge : with a hinge that gives way, angle and rate [rad, rad/s], shape (..., 2), as a `Certificate` has them.

    Returns
    -------
    Loads : every quantity with the axes of `phase` first; JAX arrays, so that they can be differentiated.

    Raises
    ------
    InvalidInputError : a model with the lag of the wake, without the states of the wake; a hinge that gives way,
        without its motion.

    >>> import numpy as np, wingbeat as wb
    >>> pigeon = wb.load_species("pigeon")
    >>> model = wb.FlightModel(pigeon.vehicle, wb.aero.BladeElement(wb.aero.SuFan()))
    >>> wb.flight_loads(model, pigeon.wingbeat, wb.State(u=10.0), np.linspace(0, 1, 5)).alpha.shape
    (5, 10)
    """
    phase = jnp.asarray(phase, dtype=float)
    refuse_without_wake(model, wake)
    refuse_without_motion(wingbeat, hinge)
    fields = State(*(jnp.broadcast_to(jnp.asarray(f, dtype=float), phase.shape).ravel() for f in state))
    if hinge is not None:
        angles = jnp.asarray(hinge, dtype=float).reshape(phase.size, -1)
        found = jax.vmap(lambda at: _loads(model, wingbeat, *at[:2], hinge=at[2]))((fields, phase.ravel(), angles))
    elif wake is None:
        found = jax.vmap(lambda at: _loads(model, wingbeat, *at))((fields, phase.ravel()))
    else:
        states = jnp.asarray(wake).reshape(phase.size, -1)
        found = jax.vmap(lambda at: _loads(model, wingbeat, *at[:2], wake=at[2]))((fields, phase.ravel(), states))
    return jax.tree_util.tree_map(lambda a: a.reshape(*phase.shape, *a.shape[1:]), found)


class MissingLoads(NamedTuple):
    """The loads, in world axes, that a prescribed body motion needs in addition to air loads and weight."""

    force_x: Phases  # [N]
    force_z: Phases  # [N]
    moment: Phases  # about the body's centre of mass, nose-up positive [N m]


@exported
def carried_loads(
    model: FlightModel, wingbeat: Wingbeat, state: State, phase: Phases, acceleration: PhasesAcceleration
) -> tuple[Loads, MissingLoads]:
    """Evaluate a flight with prescribed body motion: `flight_loads`, and the loads missing for that motion."""
    refuse_without_wake(model)
    refuse_without_motion(wingbeat)

    def at(here: tuple[State, Phases, PhasesAcceleration]) -> tuple[Loads, MissingLoads]:
        body, when, given = here
        motion = motion_table(model, wingbeat, when)
        attitude = stroke_attitude(model.vehicle.wing, motion, body.body_pitch)
        loads = air_loads(model, motion, attitude, body.u, body.w, body.pitch_rate, given)
        missing = missing_loads(model, motion, loads, attitude, body.pitch_rate, given)
        return _loads(model, wingbeat, body, when, given), missing

    return jax.lax.map(at, (state, phase, acceleration))


def _loads(
    model: FlightModel,
    wingbeat: Wingbeat,
    state: State,
    phase: Phases,
    given: PhasesAcceleration | None = None,
    wake: PerStrip | None = None,
    hinge: Coordinates | None = None,
) -> Loads:
    """Return the loads at one phase, of a body that flies freely or has a given acceleration."""
    if hinge is not None:
        whole = jnp.stack([state.body_pitch, state.u, state.w, state.pitch_rate, *hinge])
        wingbeat, rates = held_wingbeat(model, wingbeat, phase, whole)
        given = rates[1:4]
    flap, pitch = flap_angle(wingbeat, phase), pitch_angle(wingbeat, phase)
    sweep = sweep_angle(wingbeat, phase)
    pitch_state = jnp.stack([state.body_pitch, state.u, state.w, state.pitch_rate])
    if wake is not None:
        pitch_state = jnp.concatenate([pitch_state, wake])
    motion, moved = motion_table(model, wingbeat, phase), hinge_motion(model, wingbeat, phase)
    body = body_rates(model, motion, pitch_state)[1:4] if given is None else given
    hinges = hinge_loads(model, motion, moved, pitch_state, body)
    q = jnp.stack([state.x, state.z, state.body_pitch, flap, pitch])
    q_dot = jnp.stack([state.u, state.w, state.pitch_rate, moved.flap_rate, moved.pitch_rate])
    time = phase / wingbeat.frequency
    points = point_motion(model, wingbeat, q, q_dot, time)
    q_acceleration = None
    if is_unsteady(model):
        flap_acceleration, pitch_acceleration = (
            time_rates(lambda at, law=law: law(wingbeat, at), phase, wingbeat.frequency)[2]
            for law in (flap_angle, pitch_angle)
        )
        q_acceleration = jnp.concatenate([body, jnp.stack([flap_acceleration, pitch_acceleration])])
    air = air_forces_on(model, wingbeat, q, q_dot, time, points, q_acceleration, wake)
    strips = strips_of(model.vehicle.wing, model.strips)
    whole = _whole_body(model, q, q_dot, points.position.mass, points.velocity.mass, strips.mass)
    return Loads(
        flap=flap,
        flap_rate=moved.flap_rate,
        wing_pitch=pitch,
        wing_pitch_rate=moved.pitch_rate,
        span_ratio=span_ratio(wingbeat, phase),
        fold=fold_angle(wingbeat, phase),
        sweep=jnp.zeros_like(flap) if sweep is None else sweep,
        acceleration=body,
        strip_position=points.position.quarter_chord,
        strip_velocity=air.strip_velocity,
        strip_speed=air.strips.speed,
        strip_reynolds=model.air.reynolds(air.strips.speed, air_chord(wingbeat, strips.chord, phase)),
        alpha=air.strips.alpha,
        lift=air.strips.lift,
        drag=air.strips.drag,
        strip_force=air.strip_force,
        air_force=air.generalised,
        **hinges._asdict(),
        air_power=air.power,
        **{f"{name}_power": watts for name, watts in air.spent._asdict().items()},
        **whole,
        wake_downwash=air.wake_downwash,
    )


def _whole_body(
    model: FlightModel, q: Coordinates, q_dot: Coordinates, points: MassPoints, velocity: MassPoints, mass: PerStrip
) -> dict[str, Any]:
    """Return centre of mass, momenta and energies of body and both wings. Theory: equation ``centre-of-mass``."""
    body, total, plane = model.vehicle.body, model.vehicle.mass, jnp.asarray([0, 2])
    centre = (body.mass * q[:2] + jnp.einsum("n,kna->a", mass, points[..., plane])) / total
    momentum = body.mass * q_dot[:2] + jnp.einsum("n,kna->a", mass, velocity[..., plane])

    def spin(place: Any, speed: Any) -> Any:
        # Nose-up is a turn from x to z.
        away = place - centre
        return away[..., 0] * speed[..., 1] - away[..., 1] * speed[..., 0]

    angular = (
        body.pitch_inertia * q_dot[2]
        + body.mass * spin(q[:2], q_dot[:2])
        + jnp.einsum("n,kn->", mass, spin(points[..., plane], velocity[..., plane]))
    )
    kinetic = 0.5 * (
        body.mass * q_dot[:2] @ q_dot[:2]
        + body.pitch_inertia * q_dot[2] ** 2
        + jnp.einsum("n,kna,kna->", mass, velocity, velocity)
    )
    return {
        "centre_of_mass": centre,
        "momentum": momentum,
        "angular_momentum": angular,
        "kinetic_energy": kinetic,
        "potential_energy": total * model.air.gravity * centre[1],
    }


def missing_loads(
    model: FlightModel,
    motion: WingMotion,
    loads: BodyLoads,
    attitude: Phases,
    pitch_rate: Phases,
    acceleration: PhasesAcceleration,
) -> MissingLoads:
    """Return what must act, besides loads and gravity, to accelerate so. Theory: equation ``missing-loads``."""
    # Each is the left side minus the right side of an equation of `accelerations`.
    mass, force_forward, force_up, turn, arm, inertia = balance(
        model.vehicle, model.air.gravity, motion, loads, attitude, pitch_rate
    )
    along, turning = from_world(attitude, acceleration[0], acceleration[1]), acceleration[2]
    forward = mass * along[0] + turning * arm[0] - force_forward
    up = mass * along[1] + turning * arm[1] - force_up
    x, z = to_world(attitude, forward, up)
    return MissingLoads(x, z, dot(arm, along) + turning * inertia - turn)
