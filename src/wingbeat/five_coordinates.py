"""The five-coordinate equations of motion ``D q'' + C q' + h + g = tau + f_aero`` as arrays.

Coordinates q = (x, z, body pitch psi, flap phi, root wing pitch theta); both wings counted. Span and fold follow
time, so the equations are rheonomic; for rigid wings h vanishes and they are those of Su et al. 2023
(doi 10.48550/arXiv.2302.09602). Every term is a sum over mass points of partial velocities ``dr/dq``, which are
exact derivatives of where the wing is (`wing_motion.wing_shape`).
"""

from __future__ import annotations

from typing import Any, NamedTuple

from wingbeat.aero.blade_element import StripForces, strip_forces
from wingbeat.dynamics import body_drag, pressure_offset
from wingbeat.frames import Triple, body_to_world, world_to_body
from wingbeat.jax64 import jax, jnp
from wingbeat.kinematics import Wingbeat, span_ratio
from wingbeat.model import FlightModel
from wingbeat.wing_motion import mass_points, strips_of, wing_shape

COORDINATES = ("x", "z", "body_pitch", "flap", "pitch")


class EquationsOfMotion(NamedTuple):
    """The terms of the equations of motion; C is in Christoffel form, so ``D' - 2 C`` is skew for rigid wings."""

    mass_matrix: Any
    velocity_matrix: Any
    time_force: Any
    gravity_force: Any


class AirForces(NamedTuple):
    """Generalised air loads on the five coordinates, their power, and the strips of one wing in the world."""

    generalised: Any
    power: Any
    power_in_body: Any
    strips: StripForces
    strip_force: Any
    strip_velocity: Any


class WingPoints(NamedTuple):
    """Left wing in the world: mass points (2, N, 3), quarter chords, chordwise and normal unit vectors (N, 3)."""

    mass: Any
    quarter_chord: Any
    chordwise: Any
    normal: Any


def _to_world(body_pitch: Any, vector: Triple) -> Any:
    x, z = body_to_world(body_pitch, vector[0], vector[2])
    return jnp.stack([x, vector[1], z], axis=-1)


def wing_points(model: FlightModel, wingbeat: Wingbeat, q: Any, time: Any) -> WingPoints:
    """Place the left wing in the world for coordinates q at a time [s]."""
    strips = strips_of(model.vehicle.wing, model.strips)
    shape = wing_shape(model.vehicle, wingbeat, strips, wingbeat.frequency * time, q[3], q[4])
    place = jnp.stack([q[0], jnp.zeros_like(q[0]), q[1]])
    return WingPoints(
        place + _to_world(q[2], mass_points(shape, strips)),
        place + _to_world(q[2], shape.quarter_chord),
        _to_world(q[2], shape.chordwise),
        _to_world(q[2], shape.normal),
    )


def partial_velocities(model: FlightModel, wingbeat: Wingbeat, q: Any, time: Any) -> WingPoints:
    """Return ``dr/dq`` of all wing points, each with a last axis of five."""
    return jax.jacfwd(lambda at: wing_points(model, wingbeat, at, time))(q)


def drift_velocities(model: FlightModel, wingbeat: Wingbeat, q: Any, time: Any) -> WingPoints:
    """Return ``dr/dt`` at fixed q of all wing points: what span and fold move by themselves."""
    return jax.jvp(lambda t: wing_points(model, wingbeat, q, t), (time,), (jnp.ones_like(time),))[1]


def bias_accelerations(model: FlightModel, wingbeat: Wingbeat, q: Any, q_dot: Any, time: Any) -> tuple[Any, Any]:
    """Return the mass points' ``d(dr/dq)/dq q'`` (last axis of five) and ``d2r/dt2 + 2 d2r/dqdt q'``."""

    def by_q(at: Any) -> Any:
        return partial_velocities(model, wingbeat, at, time).mass

    def by_time(at: Any, when: Any) -> Any:
        return drift_velocities(model, wingbeat, at, when).mass

    still, one = jnp.zeros_like(time), jnp.ones_like(time)
    turning = jax.jvp(by_q, (q,), (q_dot,))[1]
    return turning, jax.jvp(by_time, (q, time), (2.0 * q_dot, still))[1] + jax.jvp(
        by_time, (q, time), (jnp.zeros_like(q), one)
    )[1]


def _point_masses(model: FlightModel) -> Any:
    """Return the mass of each point times two wings [kg], shape (N,): half a strip's mass, twice."""
    return strips_of(model.vehicle.wing, model.strips).mass


def equations_of_motion(model: FlightModel, wingbeat: Wingbeat, q: Any, q_dot: Any, time: Any) -> EquationsOfMotion:
    """Return D (5, 5), C (5, 5), h (5) and g (5) at coordinates q, rates q_dot and time [s].

    The wingbeat gives span and fold as functions of time (and the twist); its flap and pitch laws do not enter.
    """
    body, mass = model.vehicle.body, _point_masses(model)
    partial = partial_velocities(model, wingbeat, q, time).mass
    turning, drifting = bias_accelerations(model, wingbeat, q, q_dot, time)
    own = jnp.diag(jnp.stack([body.mass, body.mass, body.pitch_inertia, 0.0, 0.0]))
    down = model.air.gravity * jnp.asarray([0.0, 0.0, 1.0])
    return EquationsOfMotion(
        own + jnp.einsum("n,knai,knaj->ij", mass, partial, partial),
        jnp.einsum("n,knai,knaj->ij", mass, partial, turning),
        jnp.einsum("n,knai,kna->i", mass, partial, drifting),
        jnp.einsum("n,knai,a->i", mass, partial, down) + jnp.zeros(5).at[1].set(body.mass * model.air.gravity),
    )


class PointMotion(NamedTuple):
    """Wing points with their velocities, partial velocities, drifts and bias accelerations (``r''`` at q'' = 0)."""

    place: WingPoints
    velocity: WingPoints
    partial: WingPoints
    drift: WingPoints
    bias: WingPoints


def point_motion(model: FlightModel, wingbeat: Wingbeat, q: Any, q_dot: Any, time: Any) -> PointMotion:
    """Differentiate the wing's place once for all that a given motion needs."""

    def place(along: Any) -> WingPoints:
        return wing_points(model, wingbeat, q + along * q_dot, time + along)

    def velocity(along: Any) -> tuple[WingPoints, WingPoints]:
        return jax.jvp(place, (along,), (jnp.ones_like(along),))

    still = jnp.zeros_like(time)
    (points, velocities), (_, bias) = jax.jvp(velocity, (still,), (jnp.ones_like(time),))
    partial = partial_velocities(model, wingbeat, q, time)
    drift = jax.tree_util.tree_map(lambda v, p: v - p @ q_dot, velocities, partial)
    return PointMotion(points, velocities, partial, drift, bias)


def air_forces(model: FlightModel, wingbeat: Wingbeat, q: Any, q_dot: Any, time: Any) -> AirForces:
    """Return the generalised air loads f_aero (5) of both wings and the body, and their powers [W].

    `power` is the power on everything that moves through the air, `power_in_body` that of the wings' loads along
    the wings' velocities in body axes, which the actuators must supply.
    """
    return air_forces_on(model, wingbeat, q, q_dot, time, point_motion(model, wingbeat, q, q_dot, time))


def air_forces_on(
    model: FlightModel, wingbeat: Wingbeat, q: Any, q_dot: Any, time: Any, motion: PointMotion
) -> AirForces:
    """Return what `air_forces` returns, from the motion of the wing points."""
    strips = strips_of(model.vehicle.wing, model.strips)
    length = model.vehicle.wing.semi_span * span_ratio(wingbeat, wingbeat.frequency * time)
    points, velocity = motion.place, motion.velocity.quarter_chord
    forces = strip_forces(
        model.kernel,
        model.air.density,
        length / model.strips * strips.chord,
        jnp.sum(velocity * points.chordwise, axis=-1),
        jnp.sum(velocity * points.normal, axis=-1),
    )
    force = forces.chordwise[:, None] * points.chordwise + forces.normal[:, None] * points.normal
    lever, sliding = motion.partial.quarter_chord, motion.drift.quarter_chord
    if model.at_centre_of_pressure:
        ahead = pressure_offset(model.kernel, forces.alpha, strips.chord)[:, None]
        lever = lever + ahead[..., None] * motion.partial.chordwise
        sliding = sliding + ahead * motion.drift.chordwise
    wings = 2.0 * jnp.einsum("na,nai->i", force, lever)
    drag = body_drag(model.vehicle.body.drag_area, model.air.density, world_to_body(q[2], q_dot[0], q_dot[1]))
    generalised = wings.at[:2].add(jnp.stack(body_to_world(q[2], *drag)))
    sliding_power = 2.0 * jnp.sum(force * sliding)
    return AirForces(
        generalised,
        generalised @ q_dot + sliding_power,
        wings[3:] @ q_dot[3:] + sliding_power,
        forces,
        force,
        velocity,
    )


def accelerations_from_torques(
    model: FlightModel, wingbeat: Wingbeat, q: Any, q_dot: Any, time: Any, torques: Any
) -> Any:
    """Return q'' (5) when the hinges are driven by torques (flap, pitch) of both wings together [N m]."""
    terms = equations_of_motion(model, wingbeat, q, q_dot, time)
    air = air_forces(model, wingbeat, q, q_dot, time).generalised
    tau = jnp.concatenate([jnp.zeros(3), jnp.asarray(torques)])
    return jnp.linalg.solve(terms.mass_matrix, tau + air - resistance(terms, q_dot))


def resistance(terms: EquationsOfMotion, q_dot: Any) -> Any:
    """Return ``C q' + h + g``."""
    return terms.velocity_matrix @ q_dot + terms.time_force + terms.gravity_force
