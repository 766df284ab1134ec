"""Everything that can be read off a vehicle flying a prescribed wingbeat, at given phases and states."""

from __future__ import annotations

from typing import Any, NamedTuple

from wingbeat._jax.config import jax, jnp
from wingbeat._jax.exported import stored
from wingbeat.kinematics import Wingbeat, flap_angle, fold_angle, pitch_angle, span_ratio, sweep_angle
from wingbeat.mechanics.equations_of_motion import air_forces_on
from wingbeat.mechanics.flight_model import FlightModel, State, body_rates, motion_table
from wingbeat.mechanics.hinge_torques import hinge_loads, hinge_motion
from wingbeat.mechanics.wing_motion import strips_of
from wingbeat.mechanics.wing_points import point_motion


class Loads(NamedTuple):
    """Motions, forces, torques and powers along a flight; leading axis phase, strips of the left wing.

    Torques and powers are of both wings together, vectors are (x, y, z) in the world, momenta and energies
    of the whole vehicle; angular momentum is about the system's centre of mass, nose-up positive.
    """

    flap: Any
    flap_rate: Any
    wing_pitch: Any
    wing_pitch_rate: Any
    span_ratio: Any
    fold: Any
    sweep: Any
    acceleration: Any
    strip_position: Any
    strip_velocity: Any
    strip_speed: Any
    strip_reynolds: Any
    alpha: Any
    lift: Any
    drag: Any
    strip_force: Any
    air_force: Any
    flap_torque: Any
    pitch_torque: Any
    hinge_power: Any
    actuator_power: Any
    aerodynamic_power: Any
    inertial_power: Any
    body_power: Any
    air_power: Any
    centre_of_mass: Any
    momentum: Any
    angular_momentum: Any
    kinetic_energy: Any
    potential_energy: Any


@stored
def flight_loads(model: FlightModel, wingbeat: Wingbeat, state: State, phase: Any) -> Loads:
    """Evaluate a flight with prescribed wings: loads, body accelerations, hinge torques and powers.

    Parameters
    ----------
    model : the flight model.
    wingbeat : the prescribed wingbeat.
    state : body state, fields of shape (...) or one for all phases [m, rad, m/s, rad/s].
    phase : phases, shape (...).

    Returns
    -------
    Loads : every quantity with the axes of `phase` first; JAX arrays, so that they can be differentiated.

    >>> import numpy as np, wingbeat as wb
    >>> pigeon = wb.load_species("pigeon")
    >>> model = wb.FlightModel(pigeon.vehicle, wb.aero.BladeElement(wb.aero.SuFan()))
    >>> wb.flight_loads(model, pigeon.wingbeat, wb.State(u=10.0), np.linspace(0, 1, 5)).alpha.shape
    (5, 10)
    """
    phase = jnp.asarray(phase, dtype=float)
    fields = State(*(jnp.broadcast_to(jnp.asarray(f, dtype=float), phase.shape).ravel() for f in state))
    found = jax.lax.map(lambda at: _loads(model, wingbeat, *at), (fields, phase.ravel()))
    return jax.tree_util.tree_map(lambda a: a.reshape(*phase.shape, *a.shape[1:]), found)


def _loads(model: FlightModel, wingbeat: Wingbeat, state: State, phase: Any) -> Loads:
    flap, pitch, sweep = (law(wingbeat, phase) for law in (flap_angle, pitch_angle, sweep_angle))
    pitch_state = jnp.stack([state.body_pitch, state.u, state.w, state.pitch_rate])
    motion, moved = motion_table(model, wingbeat, phase), hinge_motion(model.vehicle, wingbeat, phase, model.strips)
    body = body_rates(model, motion, pitch_state)[1:]
    hinges = hinge_loads(model, motion, moved, pitch_state, body)
    q = jnp.stack([state.x, state.z, state.body_pitch, flap, pitch])
    q_dot = jnp.stack([state.u, state.w, state.pitch_rate, moved.flap_rate, moved.pitch_rate])
    time = phase / wingbeat.frequency

    points = point_motion(model, wingbeat, q, q_dot, time)
    air = air_forces_on(model, wingbeat, q, q_dot, time, points)
    strips = strips_of(model.vehicle.wing, model.strips)
    mass = strips.mass
    whole = _whole_body(model, q, q_dot, points.place.mass, points.velocity.mass, mass)
    return Loads(
        flap=flap,
        flap_rate=moved.flap_rate,
        wing_pitch=pitch,
        wing_pitch_rate=moved.pitch_rate,
        span_ratio=span_ratio(wingbeat, phase),
        fold=fold_angle(wingbeat, phase),
        sweep=jnp.zeros_like(flap) if sweep is None else sweep,
        acceleration=body,
        strip_position=points.place.quarter_chord,
        strip_velocity=air.strip_velocity,
        strip_speed=air.strips.speed,
        strip_reynolds=model.air.reynolds(air.strips.speed, strips.chord),
        alpha=air.strips.alpha,
        lift=air.strips.lift,
        drag=air.strips.drag,
        strip_force=air.strip_force,
        air_force=air.generalised,
        **hinges._asdict(),
        air_power=air.power,
        **whole,
    )


def _whole_body(model: FlightModel, q: Any, q_dot: Any, points: Any, velocity: Any, mass: Any) -> dict[str, Any]:
    """Return centre of mass, momenta and energies of body and both wings."""
    body = model.vehicle.body
    plane = jnp.asarray([0, 2])
    total = model.vehicle.mass
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
