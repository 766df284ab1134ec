"""The five-coordinate equations of motion ``D q'' + C q' + h + g = tau + f_aero`` as arrays.

Coordinates q = (x, z, body pitch psi, flap phi, root wing pitch theta); both wings counted. Span and fold follow
time, so the equations are rheonomic; for rigid wings h vanishes and they are those of Su et al. 2023
(doi 10.48550/arXiv.2302.09602). Every term is a sum over mass points of partial velocities ``dr/dq``, which are
exact derivatives of where the wing is (`wing_motion.wing_shape`).
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any, NamedTuple

from wingbeat._jax.config import jax, jnp
from wingbeat.aero.blade_element import StripForces, strip_forces
from wingbeat.kinematics import Wingbeat, span_ratio
from wingbeat.mechanics.body_dynamics import body_drag, pressure_offset
from wingbeat.mechanics.flight_model import FlightModel
from wingbeat.mechanics.frames import from_world, to_world
from wingbeat.mechanics.wing_motion import strips_of
from wingbeat.mechanics.wing_points import (
    PointMotion,
    bias_accelerations,
    partial_velocities,
    point_motion,
)


class EquationsOfMotion(NamedTuple):
    """The terms of the equations of motion; C in Christoffel form: ``D' - 2 C`` is skew for rigid wings."""

    mass_matrix: Any
    velocity_matrix: Any
    time_force: Any
    gravity_force: Any


class AirForces(NamedTuple):
    """Generalised air loads on the five coordinates, their power, and the strips of one wing in the world."""

    generalised: Any
    power: Any
    strips: StripForces
    strip_force: Any
    strip_velocity: Any


def _point_masses(model: FlightModel) -> Any:
    """Return the mass of each point times two wings [kg], shape (N,): half a strip's mass, twice."""
    return strips_of(model.vehicle.wing, model.strips).mass


def _terms(model: FlightModel, wingbeat: Wingbeat, q: Any, q_dot: Any, time: Any) -> EquationsOfMotion:
    body, mass = model.vehicle.body, _point_masses(model)
    partial = partial_velocities(model, wingbeat, q, time).mass
    turning, drifting = bias_accelerations(model, wingbeat, q, q_dot, time)
    own = jnp.diag(jnp.asarray([body.mass, body.mass, body.pitch_inertia, 0.0, 0.0]))
    down = model.air.gravity * jnp.asarray([0.0, 0.0, 1.0])
    return EquationsOfMotion(
        own + jnp.einsum("n,knai,knaj->ij", mass, partial, partial),
        jnp.einsum("n,knai,knaj->ij", mass, partial, turning),
        jnp.einsum("n,knai,kna->i", mass, partial, drifting),
        jnp.einsum("n,knai,a->i", mass, partial, down) + jnp.zeros(5).at[1].set(body.mass * model.air.gravity),
    )


def air_forces_on(
    model: FlightModel, wingbeat: Wingbeat, q: Any, q_dot: Any, time: Any, motion: PointMotion
) -> AirForces:
    """Return the air loads from the motion of the wing points."""
    strips = strips_of(model.vehicle.wing, model.strips)
    length = model.vehicle.wing.semi_span * span_ratio(wingbeat, wingbeat.frequency * time)
    points, velocity = motion.place, motion.velocity.quarter_chord
    span_speed = None
    if model.full_airspeed:
        span_speed = jnp.sum(velocity * jnp.cross(points.normal, points.chordwise), axis=-1)
    forces = strip_forces(
        model.kernel,
        model.air.density,
        length / model.strips * strips.chord,
        jnp.sum(velocity * points.chordwise, axis=-1),
        jnp.sum(velocity * points.normal, axis=-1),
        jnp.zeros_like(strips.chord),
        span_speed,
    )
    force = forces.chordwise[:, None] * points.chordwise + forces.normal[:, None] * points.normal
    lever, sliding = motion.partial.quarter_chord, motion.drift.quarter_chord
    if model.at_centre_of_pressure:
        ahead = pressure_offset(model.kernel, forces.alpha, strips.chord)[:, None]
        lever = lever + ahead[..., None] * motion.partial.chordwise
        sliding = sliding + ahead * motion.drift.chordwise
    wings = 2.0 * jnp.einsum("na,nai->i", force, lever)
    drag = body_drag(model.vehicle.body.drag_area, model.air.density, from_world(q[2], q_dot[0], q_dot[1]))
    generalised = wings.at[:2].add(jnp.stack(to_world(q[2], *drag)))
    sliding_power = 2.0 * jnp.sum(force * sliding)
    return AirForces(
        generalised,
        generalised @ q_dot + sliding_power,
        forces,
        force,
        velocity,
    )


def accelerations_from_torques(
    model: FlightModel, wingbeat: Wingbeat, q: Any, q_dot: Any, time: Any, torques: Any
) -> Any:
    """Return q'' (5) when the hinges are driven by torques (flap, pitch) of both wings together [N m]."""
    terms = _terms(model, wingbeat, q, q_dot, time)
    air = _air_forces(model, wingbeat, q, q_dot, time).generalised
    tau = jnp.concatenate([jnp.zeros(3), jnp.asarray(torques)])
    return jnp.linalg.solve(terms.mass_matrix, tau + air - resistance(terms, q_dot))


def resistance(terms: EquationsOfMotion, q_dot: Any) -> Any:
    """Return ``C q' + h + g``."""
    return terms.velocity_matrix @ q_dot + terms.time_force + terms.gravity_force


def _air_forces(model: FlightModel, wingbeat: Wingbeat, q: Any, q_dot: Any, time: Any) -> AirForces:
    return air_forces_on(model, wingbeat, q, q_dot, time, point_motion(model, wingbeat, q, q_dot, time))


def _torque(model: FlightModel, wingbeat: Wingbeat, q: Any, q_dot: Any, time: Any, q_acceleration: Any) -> Any:
    terms = _terms(model, wingbeat, q, q_dot, time)
    air = _air_forces(model, wingbeat, q, q_dot, time).generalised
    return terms.mass_matrix @ q_acceleration + resistance(terms, q_dot) - air


@functools.partial(jax.jit, static_argnums=0)
def _over_axes(
    function: Callable[..., Any], model: FlightModel, wingbeat: Wingbeat, time: Any, *vectors: Any
) -> Any:
    """Apply a function of q, q', time and perhaps q'' to arrays with any leading axes."""
    moment, *rows = (jnp.asarray(a, dtype=float) for a in (time, *vectors))
    axes = jnp.broadcast_shapes(moment.shape, *(row.shape[:-1] for row in rows))
    flat = [jnp.broadcast_to(row, (*axes, 5)).reshape(-1, 5) for row in rows]
    times = jnp.broadcast_to(moment, axes).ravel()
    found = jax.vmap(lambda t, q, q_dot, *more: function(model, wingbeat, q, q_dot, t, *more))(times, *flat)
    return jax.tree_util.tree_map(lambda a: a.reshape(*axes, *a.shape[1:]), found)


def equations_of_motion(model: FlightModel, wingbeat: Wingbeat, q: Any, q_dot: Any, time: Any) -> EquationsOfMotion:
    """Return the terms D, C, h and g of the five-coordinate equations of motion.

    Parameters
    ----------
    model : the flight model, a `FlightModel`.
    wingbeat : gives span and fold as functions of time, and the twist; its flap and pitch laws do not enter.
    q, q_dot : (x, z, body pitch, flap, root wing pitch) and rates, shape (..., 5) [m, rad; per s].
    time : [s], shape (...).

    Returns
    -------
    EquationsOfMotion : ``mass_matrix`` D and ``velocity_matrix`` C of shape (..., 5, 5), ``time_force`` h and
        ``gravity_force`` g of shape (..., 5); JAX arrays, so that they can be differentiated.

    Su et al. 2023 (doi 10.48550/arXiv.2302.09602), with h for prescribed span and fold.

    >>> import numpy as np, wingbeat as wb
    >>> pigeon = wb.load_species("pigeon")
    >>> model = wb.FlightModel(pigeon.vehicle, wb.aero.BladeElement(wb.aero.SuFan()))
    >>> terms = wb.equations_of_motion(model, pigeon.wingbeat, np.zeros(5), np.zeros(5), 0.0)
    >>> round(float(terms.mass_matrix[0, 0]), 3)
    0.316
    """
    return _over_axes(_terms, model, wingbeat, time, q, q_dot)


def air_forces(model: FlightModel, wingbeat: Wingbeat, q: Any, q_dot: Any, time: Any) -> AirForces:
    """Return the generalised air loads f_aero of both wings and the body, and the loads of the strips.

    Parameters
    ----------
    model, wingbeat, q, q_dot, time : as in `equations_of_motion`.

    Returns
    -------
    AirForces : ``generalised`` f_aero of shape (..., 5) [N, N m]; ``power``, that of the loads on everything that
        moves through the air [W]; the strips of the left wing.
    """
    return _over_axes(_air_forces, model, wingbeat, time, q, q_dot)


def generalised_torques(
    model: FlightModel, wingbeat: Wingbeat, q: Any, q_dot: Any, q_acceleration: Any, time: Any
) -> Any:
    """Return what must act on the coordinates, ``tau = D q'' + C q' + h + g - f_aero``.

    Parameters
    ----------
    model, wingbeat, q, q_dot, time : as in `equations_of_motion`.
    q_acceleration : q'' of shape (..., 5) [m/s2, rad/s2].

    Returns
    -------
    tau of shape (..., 5): zero in its first three rows for a free flight, then the hinge torques of both wings
    together [N m].
    """
    return _over_axes(_torque, model, wingbeat, time, q, q_dot, q_acceleration)
