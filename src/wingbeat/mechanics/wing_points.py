"""The wing's points in the world as functions of the five coordinates and time, and their exact derivatives.

Coordinates q = (x, z, body pitch, flap, root wing pitch); partial velocities are ``dr/dq``, drift is ``dr/dt`` at
fixed q (what span and fold move by themselves), bias what ``r''`` is at ``q'' = 0``.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from wingbeat._jax.config import jax, jnp
from wingbeat._jax.exported import stored
from wingbeat.kinematics import Wingbeat, flap_angle, pitch_angle, span_ratio
from wingbeat.mechanics.flight_model import FlightModel, State
from wingbeat.mechanics.frames import Triple, stroke_pitch, to_world
from wingbeat.mechanics.wing_motion import mass_points, strips_of, stroke_plane, wing_shape


class WingPoints(NamedTuple):
    """Left wing in the world: mass points (2, N, 3), quarter chords, chordwise and normal unit vectors (N, 3)."""

    mass: Any
    quarter_chord: Any
    chordwise: Any
    normal: Any


def _in_world(attitude: Any, vector: Triple) -> Any:
    x, z = to_world(attitude, vector[0], vector[2])
    return jnp.stack([x, vector[1], z], axis=-1)


def wing_points(model: FlightModel, wingbeat: Wingbeat, q: Any, time: Any) -> WingPoints:
    """Place the left wing in the world for coordinates q at a time [s]."""
    wing = model.vehicle.wing
    strips = strips_of(wing, model.strips)
    shape = wing_shape(model.vehicle, wingbeat, strips, wingbeat.frequency * time, q[3], q[4])
    place = jnp.stack([q[0], jnp.zeros_like(q[0]), q[1]])
    attitude = q[2] + stroke_pitch(stroke_plane(wing, wingbeat))
    return WingPoints(
        place + _in_world(attitude, mass_points(shape, strips)),
        place + _in_world(attitude, shape.place),
        _in_world(attitude, shape.chordwise),
        _in_world(attitude, shape.normal),
    )


# From the root's end of the leading edge, along it, and back along the trailing edge.
CORNERS = ("leading inner", "leading outer", "trailing outer", "trailing inner")


def corners_of(points: WingPoints, chord: Any, width: Any) -> Any:
    """Return the corners of the left wing's strips in the world, shape (N, 4, 3), in the order of `CORNERS`."""
    out = 0.5 * width * jnp.cross(points.normal, points.chordwise)
    leading, trailing = (
        points.quarter_chord + share * chord[:, None] * points.chordwise for share in (0.25, -0.75)
    )
    return jnp.stack([leading - out, leading + out, trailing + out, trailing - out], axis=1)


@stored
def strip_corners(model: FlightModel, wingbeat: Wingbeat, state: State, phase: Any) -> Any:
    """Return `corners_of` the strips along a flight, shape (K, N, 4, 3).

    Parameters
    ----------
    model : the flight model.
    wingbeat : the prescribed wingbeat.
    state : body state, fields of shape (K,) [m, rad].
    phase : phases, shape (K,).
    """
    wing = model.vehicle.wing
    chord = strips_of(wing, model.strips).chord

    def at(body: State, when: Any) -> Any:
        q = jnp.stack([body.x, body.z, body.body_pitch, flap_angle(wingbeat, when), pitch_angle(wingbeat, when)])
        points = wing_points(model, wingbeat, q, when / wingbeat.frequency)
        return corners_of(points, chord, wing.semi_span * span_ratio(wingbeat, when) / model.strips)

    return jax.vmap(at)(state, phase)


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
