"""The wing's points in the world as functions of the five coordinates and time, and the air loads on these.

Coordinates q = (x, z, body pitch, flap, root wing pitch); partial velocities are ``dr/dq``, drift is ``dr/dt`` at
fixed q (the velocity due to span, fold, sweep and twist), bias is ``r''`` at ``q'' = 0``; all are exact
derivatives. The air loads use the same formulas for a strip as `flight_model`, but their own sums over the strips,
so that the two modules check each other.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from wingbeat._jax.arrays import jax, jnp
from wingbeat._jax.exported import exported
from wingbeat.aero.closed_forms import added_inertia, added_mass
from wingbeat.aero.family import depends_on_reynolds
from wingbeat.aero.strip_forces import StripForces, strip_forces, with_turning
from wingbeat.animal.kinematics import Wingbeat, flap_angle, held_at, pitch_angle, span_ratio
from wingbeat.animal.vehicle import Vehicle
from wingbeat.mechanics.flight_model import FlightModel, State
from wingbeat.mechanics.strip_air import body_air, is_unsteady, pressure_offset, unsteady_density, wake_at
from wingbeat.mechanics.wing_shape import (
    Strips,
    air_chord,
    chord_at,
    dot,
    from_world,
    mass_points,
    strips_of,
    stroke_pitch,
    stroke_plane,
    tail_tilt,
    to_world,
    wing_shape,
)

if TYPE_CHECKING:
    from wingbeat._jax.arrays import (
        ChordFractions,
        Component,
        CoordinateMatrix,
        Coordinates,
        Corners,
        MassPoints,
        PerStrip,
        Phases,
        Scalar,
        Stations,
        StripPoints,
        StripsByCoordinates,
        StripVectors,
        SurfacePoints,
        Triple,
        Vector,
        Vectors,
    )


class WingPoints(NamedTuple):
    """Points of the left wing in the world."""

    mass: MassPoints  # mass points [m], shape (2, N, 3)
    quarter_chord: StripPoints  # [m], shape (N, 3)
    chordwise: StripPoints  # unit vector towards the leading edge
    normal: StripPoints  # unit vector normal to chord and span


def _in_world(attitude: Component, vector: Triple) -> Vectors:
    x, z = to_world(attitude, vector[0], vector[2])
    return jnp.stack([x, vector[1], z], axis=-1)


def wing_points(model: FlightModel, wingbeat: Wingbeat, q: Coordinates, time: Scalar) -> WingPoints:
    """Place the left wing in the world. Theory: equations ``world-place`` and ``coordinates``."""
    wing = model.vehicle.wing
    strips = strips_of(wing, model.strips)
    shape = wing_shape(model.vehicle, wingbeat, strips, wingbeat.frequency * time, q[3], q[4])
    place = jnp.stack([q[0], jnp.zeros_like(q[0]), q[1]])
    attitude = q[2] + stroke_pitch(stroke_plane(wing, wingbeat))
    return WingPoints(
        place + _in_world(attitude, mass_points(wing, shape, strips)),
        place + _in_world(attitude, shape.quarter_chord),
        _in_world(attitude, shape.chordwise),
        _in_world(attitude, shape.normal),
    )


# From the root's end of the leading edge, along it, and back along the trailing edge.
CORNERS = ("leading inner", "leading outer", "trailing outer", "trailing inner")


def corners_of(points: WingPoints, chord: PerStrip, width: Scalar) -> Corners:
    """Return the corners of the left wing's strips in the world [m], shape (N, 4, 3), in the order of `CORNERS`."""
    out = 0.5 * width * jnp.cross(points.normal, points.chordwise)
    leading, trailing = (
        points.quarter_chord + share * chord[:, None] * points.chordwise for share in (0.25, -0.75)
    )
    return jnp.stack([leading - out, leading + out, trailing + out, trailing - out], axis=1)


@exported
def strip_corners(
    model: FlightModel, wingbeat: Wingbeat, state: State, phase: Phases, hinge: Phases | None = None
) -> Corners:
    """Return the strips' corners along a flight [m], shape (K, N, 4, 3), as `corners_of` does for one instant.

    `hinge` is the angle of a hinge that gives way [rad].
    """
    wing = model.vehicle.wing
    chord = strips_of(wing, model.strips).chord

    def at(body: State, when: Scalar, *angle: Scalar) -> Corners:
        beat = _turned(wingbeat, when, *angle)
        q = jnp.stack([body.x, body.z, body.body_pitch, flap_angle(beat, when), pitch_angle(beat, when)])
        points = wing_points(model, beat, q, when / wingbeat.frequency)
        width = wing.semi_span * span_ratio(wingbeat, when) / model.strips
        return corners_of(points, air_chord(wingbeat, chord, when), width)

    return jax.vmap(at)(state, phase, *(() if hinge is None else (hinge,)))


def _turned(wingbeat: Wingbeat, phase: Scalar, *angle: Scalar) -> Wingbeat:
    """Return the wingbeat with its hinge at an angle, which is at rest; without an angle, as it is."""
    if not angle:
        return wingbeat
    still = jnp.zeros_like(phase)
    return held_at(wingbeat, phase, angle[0], still, still)


@exported
def surface_points(
    vehicle: Vehicle,
    wingbeat: Wingbeat,
    state: State,
    phase: Phases,
    span_fraction: Stations,
    chord_fraction: ChordFractions,
    hinge: Phases | None = None,
) -> SurfacePoints:
    """Return points of the left wing's surface in the world along a flight [m], shape (K, C, S, 3).

    `hinge` is the angle of a hinge that gives way [rad].
    """
    wing = vehicle.wing
    chord = chord_at(wing, span_fraction)
    stations = Strips(span_fraction, chord, jnp.zeros_like(chord))
    behind = 0.25 - chord_fraction[:, None]

    def at(body: State, when: Scalar, *angle: Scalar) -> Any:
        beat = _turned(wingbeat, when, *angle)
        flap, pitch = flap_angle(beat, when), pitch_angle(beat, when)
        shape = wing_shape(vehicle, beat, stations, when, flap, pitch)
        attitude = body.body_pitch + stroke_pitch(stroke_plane(wing, wingbeat))
        quarter, fore = _in_world(attitude, shape.quarter_chord), _in_world(attitude, shape.chordwise)
        place = jnp.stack([body.x, jnp.zeros_like(body.x), body.z])
        return place + quarter + (behind * air_chord(wingbeat, chord, when))[..., None] * fore

    return jax.vmap(at)(state, phase, *(() if hinge is None else (hinge,)))


def partial_velocities(model: FlightModel, wingbeat: Wingbeat, q: Coordinates, time: Scalar) -> WingPoints:
    """Return ``dr/dq`` of all wing points, with a last axis of five. Theory: equation ``partial-velocities``."""
    return jax.jacfwd(lambda at: wing_points(model, wingbeat, at, time))(q)


class PointMotion(NamedTuple):
    """Wing points and their derivatives."""

    position: WingPoints
    velocity: WingPoints
    partial: WingPoints  # partial velocities ``dr/dq``, with a last axis of five
    drift: WingPoints  # ``dr/dt`` at fixed q
    bias: WingPoints  # accelerations ``r''`` at ``q'' = 0``


def point_motion(
    model: FlightModel, wingbeat: Wingbeat, q: Coordinates, q_dot: Coordinates, time: Scalar
) -> PointMotion:
    """Return the wing points and all their derivatives for a given motion. Theory: equation ``point-rates``."""

    def place(along: Scalar) -> WingPoints:
        return wing_points(model, wingbeat, q + along * q_dot, time + along)

    def velocity(along: Scalar) -> tuple[WingPoints, WingPoints]:
        return jax.jvp(place, (along,), (jnp.ones_like(along),))

    still = jnp.zeros_like(time)
    (points, velocities), (_, bias) = jax.jvp(velocity, (still,), (jnp.ones_like(time),))
    partial = partial_velocities(model, wingbeat, q, time)
    drift = jax.tree_util.tree_map(lambda v, p: v - p @ q_dot, velocities, partial)
    return PointMotion(points, velocities, partial, drift, bias)


class AirPower(NamedTuple):
    """The power that a flight spends on the air [W], by cause, shape (...). Theory: equation ``power-by-cause``."""

    # Against lift and drag of the strips, at their velocity relative to the air at the wings. If the polar was
    # measured on a finite wing, this power includes the induced drag of that wing.
    profile: Phases
    induced: Phases  # spent on the induced flow v, ``-F . v`` with the force F of the wings; 0 without inflow
    parasite: Phases  # against the loads of body and tail
    # Against rotation, added mass, couples and the lag of the wake; the air returns the part due to added mass.
    unsteady: Phases


class AirForces(NamedTuple):
    """Air loads of both wings and the body on the five coordinates.

    Attributes
    ----------
    generalised : generalised forces f_aero, shape (..., 5) [N, N m].
    power : power of the air loads on wings, body and tail [W], shape (...).
    spent : `power` by cause, with the opposite sign.
    strips : loads on the strips of the left wing, shape (..., N).
    strip_force : force on each strip in the world [N], shape (..., N, 3).
    strip_velocity : velocity of each quarter chord in the world [m/s], shape (..., N, 3).
    added_mass : inertia of the air, which is the negative derivative of f_aero with respect to q'', shape
        (..., 5, 5) [kg, kg m, kg m2]; zero without unsteady terms.
    wake_downwash : by which the shed wake moves the air at the strips [m/s], shape (..., N); None without the lag.
    """

    generalised: Coordinates
    power: Phases
    spent: AirPower
    strips: StripForces
    strip_force: StripVectors
    strip_velocity: StripVectors
    added_mass: CoordinateMatrix
    wake_downwash: PerStrip | None = None


class _AirResistance(NamedTuple):
    """The motions of each strip of the left wing that the air resists (thin aerofoil), and the air's inertia."""

    mass: PerStrip  # added mass of the air
    inertia: PerStrip  # added inertia of the air
    lever: StripsByCoordinates  # derivative of the mid-chord's normal speed with respect to q', shape (N, 5)
    turn: StripsByCoordinates  # the same of the chord's turning rate
    normal_bias: PerStrip  # time derivative of the normal speed at ``q'' = 0``
    turning_bias: PerStrip  # the same of the turning rate
    turning: PerStrip  # turning rate of the chord [rad/s]

    @property
    def added_mass(self) -> CoordinateMatrix:
        """The generalised added mass of the air at both wings, shape (5, 5). Theory: equation ``air-inertia``."""
        return 2.0 * (
            jnp.einsum("n,ni,nj->ij", self.mass, self.lever, self.lever)
            + jnp.einsum("n,ni,nj->ij", self.inertia, self.turn, self.turn)
        )

    def forces(self, q_acceleration: Coordinates) -> tuple[PerStrip, PerStrip]:
        """Return the force of each strip along its normal at mid-chord [N], and its couple [N m]."""
        return (
            -self.mass * (self.normal_bias + self.lever @ q_acceleration),
            -self.inertia * (self.turning_bias + self.turn @ q_acceleration),
        )


def _air_resistance(
    model: FlightModel, chord: PerStrip, width: Scalar, motion: PointMotion, wind: Vector | float
) -> _AirResistance:
    density = unsteady_density(model)
    points, velocity, partial, bias = motion.position, motion.velocity, motion.partial, motion.bias

    def mid(of: Any) -> Any:
        quarter = 0.25 * chord.reshape(-1, *[1] * (of.chordwise.ndim - 1))
        return of.quarter_chord - quarter * of.chordwise

    def across(normal: Any, vector: Any) -> PerStrip:
        return jnp.sum(normal * vector, axis=-1)

    through_air = mid(velocity) - wind
    return _AirResistance(
        added_mass(density, chord, width),
        added_inertia(density, chord, width),
        jnp.einsum("na,nai->ni", points.normal, mid(partial)),
        jnp.einsum("na,nai->ni", points.normal, partial.chordwise),
        across(velocity.normal, through_air) + across(points.normal, mid(bias)),
        across(velocity.normal, velocity.chordwise) + across(points.normal, bias.chordwise),
        across(points.normal, velocity.chordwise),
    )


def air_forces_on(
    model: FlightModel,
    wingbeat: Wingbeat,
    q: Coordinates,
    q_dot: Coordinates,
    time: Phases,
    motion: PointMotion,
    q_acceleration: Coordinates | None = None,
    wake: PerStrip | None = None,
) -> AirForces:
    """Return the air loads from the motion of the wing points at one instant; without q'', without added mass.

    `wake` are the states of the wake, shape (2 N,).

    Theory: equations ``strip-velocity``, ``generalised-air-loads`` and ``air-power``.
    """
    phase = wingbeat.frequency * time
    chord = air_chord(wingbeat, strips_of(model.vehicle.wing, model.strips).chord, phase)
    width = model.vehicle.wing.semi_span * span_ratio(wingbeat, phase) / model.strips
    points, velocity, wind = motion.position, motion.velocity.quarter_chord, None
    if model.induced_flow is not None:  # velocity of the air at the wings in the world [m/s]
        forward, up = (jnp.asarray(part, dtype=float) for part in model.induced_flow)
        wind = jnp.stack([forward, jnp.zeros(()), up])
    through_air = velocity if wind is None else velocity - wind
    chord_speed = jnp.sum(through_air * points.chordwise, axis=-1)
    normal_speed = jnp.sum(through_air * points.normal, axis=-1)
    span_speed = None
    if model.full_airspeed:
        span_speed = jnp.sum(through_air * jnp.cross(points.normal, points.chordwise), axis=-1)
    met = None
    if wake is not None:
        turning = jnp.sum(points.normal * motion.velocity.chordwise, axis=-1) if is_unsteady(model) else None
        met = wake_at(model, chord, (chord_speed, normal_speed, span_speed), turning, wake.reshape(2, -1))
        normal_speed = met.normal_speed
    speeds, kernel = (chord_speed, normal_speed, jnp.zeros_like(chord), span_speed), model.kernel
    scale = (chord / model.air.viscosity,) if depends_on_reynolds(kernel) else ()
    forces = strip_forces(kernel, model.air.density, width * chord, *speeds, *scale)
    force = forces.chordwise[:, None] * points.chordwise + forces.normal[:, None] * points.normal
    lever, drift = motion.partial.quarter_chord, motion.drift.quarter_chord
    if model.at_centre_of_pressure:
        ahead = pressure_offset(model, forces, chord)[:, None]
        lever = lever + ahead[..., None] * motion.partial.chordwise
        drift = drift + ahead * motion.drift.chordwise
    wings = 2.0 * jnp.einsum("na,nai->i", force, lever)
    steady_power = wings @ q_dot + 2.0 * jnp.sum(force * drift)
    travel = from_world(q[2], q_dot[0], q_dot[1])
    tilt = tail_tilt(model.vehicle, wingbeat)
    own, moment = body_air(model.vehicle, model.air.density, travel, q_dot[2], tilt=tilt)
    own_power = dot(own, travel)
    generalised = wings.at[:2].add(jnp.stack(to_world(q[2], *own)))
    if moment is not None:
        generalised = generalised.at[2].add(moment)
        own_power = own_power + moment * q_dot[2]
    zero = jnp.zeros_like(steady_power)
    unsteady = _Unsteady(jnp.zeros(5), zero, jnp.zeros_like(force), jnp.zeros((5, 5)))
    if is_unsteady(model):
        resistance = _air_resistance(model, chord, width, motion, 0.0 if wind is None else wind)
        along = chord_speed, normal_speed
        turned = with_turning(forces, unsteady_density(model), chord, width, resistance.turning, *along)
        rotation = turned.chordwise - forces.chordwise, turned.normal - forces.normal, turned.couple
        unsteady = _unsteady(motion, chord, q_dot, resistance, rotation, q_acceleration)
    against_steady, against_unsteady = (
        zero if wind is None else -2.0 * jnp.sum(one * wind) for one in (force, unsteady.force)
    )
    whole, power = generalised + unsteady.generalised, steady_power + own_power + unsteady.power
    spent = AirPower(
        profile=-steady_power - against_steady,
        induced=against_steady + against_unsteady,
        parasite=-own_power,
        unsteady=-unsteady.power - against_unsteady,
    )
    if met is not None:
        against_wake = 2.0 * jnp.sum(forces.normal * met.downwash)
        spent = spent._replace(profile=spent.profile - against_wake, unsteady=spent.unsteady + against_wake)
    return AirForces(
        whole,
        power,
        spent,
        forces,
        force + unsteady.force,
        velocity,
        unsteady.added_mass,
        None if met is None else met.downwash,
    )


class _Unsteady(NamedTuple):
    """The unsteady parts of `AirForces`: generalised forces, power, strip forces, and the added mass."""

    generalised: Coordinates
    power: Phases
    force: StripVectors
    added_mass: CoordinateMatrix


def _unsteady(
    motion: PointMotion,
    chord: PerStrip,
    q_dot: Coordinates,
    resistance: _AirResistance,
    rotation: tuple[PerStrip, PerStrip, PerStrip],
    q_acceleration: Coordinates | None,
) -> _Unsteady:
    """Return the unsteady loads; `rotation` are forces along chord and normal, and couples, of turning strips."""
    points = motion.position
    turning = rotation[0][:, None] * points.chordwise + rotation[1][:, None] * points.normal
    normal, couple = resistance.forces(jnp.zeros(5) if q_acceleration is None else q_acceleration)
    couple = couple + rotation[2]
    generalised = 2.0 * (
        jnp.einsum("na,nai->i", turning, motion.partial.quarter_chord)
        + normal @ resistance.lever
        + couple @ resistance.turn
    )
    drifting = motion.drift.quarter_chord - 0.25 * chord[:, None] * motion.drift.chordwise
    drift_power = 2.0 * (
        jnp.sum(turning * motion.drift.quarter_chord)
        + normal @ jnp.sum(points.normal * drifting, axis=-1)
        + couple @ jnp.sum(points.normal * motion.drift.chordwise, axis=-1)
    )
    force = turning + normal[:, None] * points.normal
    return _Unsteady(generalised, generalised @ q_dot + drift_power, force, resistance.added_mass)
