"""The wing's points in the world as functions of the five coordinates and time, and their exact derivatives.

Coordinates q = (x, z, body pitch, flap, root wing pitch); partial velocities are ``dr/dq``, drift is ``dr/dt`` at
fixed q (the velocity due to span, fold, sweep and twist), bias is ``r''`` at ``q'' = 0``.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from wingbeat._jax.arrays import jax, jnp
from wingbeat._jax.exported import exported
from wingbeat.animal.kinematics import Wingbeat, flap_angle, pitch_angle, span_ratio
from wingbeat.animal.vehicle import Vehicle
from wingbeat.mechanics.flight_model import FlightModel, State
from wingbeat.mechanics.frames import stroke_pitch, to_world
from wingbeat.mechanics.wing_motion import air_chord, chord_at, mass_points, strips_of, stroke_plane, wing_shape
from wingbeat.mechanics.wing_shape import Strips

if TYPE_CHECKING:
    from wingbeat._jax.arrays import (
        ChordFractions,
        Component,
        Coordinates,
        Corners,
        MassPoints,
        PerStrip,
        Phases,
        Scalar,
        Stations,
        StripPoints,
        SurfacePoints,
        Triple,
        Vectors,
    )


class WingPoints(NamedTuple):
    """Points of the left wing in the world.

    Attributes
    ----------
    mass : mass points [m], shape (2, N, 3).
    quarter_chord : [m], shape (N, 3).
    chordwise, normal : unit vectors towards the leading edge and normal to chord and span, shape (N, 3).
    """

    mass: MassPoints
    quarter_chord: StripPoints
    chordwise: StripPoints
    normal: StripPoints


def _in_world(attitude: Component, vector: Triple) -> Vectors:
    x, z = to_world(attitude, vector[0], vector[2])
    return jnp.stack([x, vector[1], z], axis=-1)


def wing_points(model: FlightModel, wingbeat: Wingbeat, q: Coordinates, time: Scalar) -> WingPoints:
    """Place the left wing in the world.

    Theory: equations ``world-place`` and ``coordinates``.

    Parameters
    ----------
    model, wingbeat : the wing, and its laws of span, fold, sweep and twist.
    q : (x, z, body pitch, flap, root wing pitch), shape (5,) [m, rad].
    time : [s].
    """
    wing = model.vehicle.wing
    strips = strips_of(wing, model.strips)
    shape = wing_shape(model.vehicle, wingbeat, strips, wingbeat.frequency * time, q[3], q[4])
    place = jnp.stack([q[0], jnp.zeros_like(q[0]), q[1]])
    attitude = q[2] + stroke_pitch(stroke_plane(wing, wingbeat))
    return WingPoints(
        place + _in_world(attitude, mass_points(shape, strips)),
        place + _in_world(attitude, shape.quarter_chord),
        _in_world(attitude, shape.chordwise),
        _in_world(attitude, shape.normal),
    )


# From the root's end of the leading edge, along it, and back along the trailing edge.
CORNERS = ("leading inner", "leading outer", "trailing outer", "trailing inner")


def corners_of(points: WingPoints, chord: PerStrip, width: Scalar) -> Corners:
    """Return the corners of the left wing's strips in the world [m], shape (N, 4, 3), in the order of `CORNERS`.

    Parameters
    ----------
    points : of the wing.
    chord : of the strips [m].
    width : of a strip along the span [m].
    """
    out = 0.5 * width * jnp.cross(points.normal, points.chordwise)
    leading, trailing = (
        points.quarter_chord + share * chord[:, None] * points.chordwise for share in (0.25, -0.75)
    )
    return jnp.stack([leading - out, leading + out, trailing + out, trailing - out], axis=1)


@exported
def strip_corners(model: FlightModel, wingbeat: Wingbeat, state: State, phase: Phases) -> Corners:
    """Return the strips' corners along a flight [m], shape (K, N, 4, 3), as `corners_of` does for one instant.

    Parameters
    ----------
    model : the flight model.
    wingbeat : the prescribed wingbeat.
    state : body state, fields of shape (K,) [m, rad].
    phase : phases, shape (K,).
    """
    wing = model.vehicle.wing
    chord = strips_of(wing, model.strips).chord

    def at(body: State, when: Scalar) -> Corners:
        q = jnp.stack([body.x, body.z, body.body_pitch, flap_angle(wingbeat, when), pitch_angle(wingbeat, when)])
        points = wing_points(model, wingbeat, q, when / wingbeat.frequency)
        width = wing.semi_span * span_ratio(wingbeat, when) / model.strips
        return corners_of(points, air_chord(wingbeat, chord, when), width)

    return jax.vmap(at)(state, phase)


@exported
def surface_points(
    vehicle: Vehicle,
    wingbeat: Wingbeat,
    state: State,
    phase: Phases,
    span_fraction: Stations,
    chord_fraction: ChordFractions,
) -> SurfacePoints:
    """Return points of the left wing's surface in the world along a flight [m], shape (K, C, S, 3).

    Parameters
    ----------
    vehicle, wingbeat : the wing and how it beats.
    state : body state, fields of shape (K,) [m, rad].
    phase : phases, shape (K,).
    span_fraction : distances from the shoulder over the length of the wing, shape (S,).
    chord_fraction : distances from the leading edge over the chord, shape (C,).
    """
    wing = vehicle.wing
    chord = chord_at(wing, span_fraction)
    stations = Strips(span_fraction, chord, jnp.zeros_like(chord))
    behind = 0.25 - chord_fraction[:, None]

    def at(body: State, when: Scalar) -> Any:
        flap, pitch = flap_angle(wingbeat, when), pitch_angle(wingbeat, when)
        shape = wing_shape(vehicle, wingbeat, stations, when, flap, pitch)
        attitude = body.body_pitch + stroke_pitch(stroke_plane(wing, wingbeat))
        quarter, fore = _in_world(attitude, shape.quarter_chord), _in_world(attitude, shape.chordwise)
        place = jnp.stack([body.x, jnp.zeros_like(body.x), body.z])
        return place + quarter + (behind * air_chord(wingbeat, chord, when))[..., None] * fore

    return jax.vmap(at)(state, phase)


def partial_velocities(model: FlightModel, wingbeat: Wingbeat, q: Coordinates, time: Scalar) -> WingPoints:
    """Return the partial velocities ``dr/dq`` of all wing points, with a last axis of five.

    Theory: equation ``partial-velocities``.
    """
    return jax.jacfwd(lambda at: wing_points(model, wingbeat, at, time))(q)


def drift_velocities(model: FlightModel, wingbeat: Wingbeat, q: Coordinates, time: Scalar) -> WingPoints:
    """Return ``dr/dt`` of all wing points at fixed q [m/s]: their velocity due to span, fold, sweep and twist.

    Theory: equation ``drift``.
    """
    return jax.jvp(lambda t: wing_points(model, wingbeat, q, t), (time,), (jnp.ones_like(time),))[1]


def bias_accelerations(
    model: FlightModel, wingbeat: Wingbeat, q: Coordinates, q_dot: Coordinates, time: Scalar
) -> tuple[MassPoints, MassPoints]:
    """Return the mass points' ``d(dr/dq)/dq q'`` (last axis of five) and ``d2r/dt2 + 2 d2r/dqdt q'``.

    Theory: equations ``time-force`` and ``frozen-motion``.

    Parameters
    ----------
    model, wingbeat, q, time : as in `wing_points`.
    q_dot : rates of q, shape (5,) [per s].
    """

    def by_q(at: Coordinates) -> Any:
        return partial_velocities(model, wingbeat, at, time).mass

    def by_time(at: Coordinates, when: Scalar) -> Any:
        return drift_velocities(model, wingbeat, at, when).mass

    still, one = jnp.zeros_like(time), jnp.ones_like(time)
    partial_rate = jax.jvp(by_q, (q,), (q_dot,))[1]
    return partial_rate, jax.jvp(by_time, (q, time), (2.0 * q_dot, still))[1] + jax.jvp(
        by_time, (q, time), (jnp.zeros_like(q), one)
    )[1]


class PointMotion(NamedTuple):
    """Wing points and their derivatives.

    Attributes
    ----------
    position : the points.
    velocity : their velocities.
    partial : partial velocities ``dr/dq``, with a last axis of five.
    drift : ``dr/dt`` at fixed q.
    bias : accelerations ``r''`` at ``q'' = 0``.
    """

    position: WingPoints
    velocity: WingPoints
    partial: WingPoints
    drift: WingPoints
    bias: WingPoints


def point_motion(
    model: FlightModel, wingbeat: Wingbeat, q: Coordinates, q_dot: Coordinates, time: Scalar
) -> PointMotion:
    """Return the wing points and all their derivatives for a given motion.

    Theory: equation ``point-rates``.

    Parameters
    ----------
    model, wingbeat, q, q_dot, time : as in `bias_accelerations`.
    """

    def place(along: Scalar) -> WingPoints:
        return wing_points(model, wingbeat, q + along * q_dot, time + along)

    def velocity(along: Scalar) -> tuple[WingPoints, WingPoints]:
        return jax.jvp(place, (along,), (jnp.ones_like(along),))

    still = jnp.zeros_like(time)
    (points, velocities), (_, bias) = jax.jvp(velocity, (still,), (jnp.ones_like(time),))
    partial = partial_velocities(model, wingbeat, q, time)
    drift = jax.tree_util.tree_map(lambda v, p: v - p @ q_dot, velocities, partial)
    return PointMotion(points, velocities, partial, drift, bias)
