"""Torques and powers of the hinges, and the parts of the power, from sums over the wing that depend on time alone.

By d'Alembert's principle, the generalised force that drives a motion of the wing is
``sum m (r'' - g) . v - F . v``. Here v is the velocity that the motion gives each point: dr/d(angle) for a hinge
torque, dr/dt in body axes for the power of all actuators. In stroke axes
``r'' = p'' + psi'' E b - psi'^2 b + 2 psi' E b' + b''``. Here p is the position of the body, b that of a point
relative to the body, and E turns a vector nose-up by a right angle. So all sums over mass points depend on time
alone, as in `body_dynamics`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from wingbeat._jax.arrays import jax, jnp
from wingbeat.animal.kinematics import Wingbeat, flap_angle, pitch_angle, span_ratio
from wingbeat.mechanics.flight_model import (
    FlightModel,
    is_unsteady,
    strip_loads,
    strip_moments,
    unsteady_density,
    velocity_at_wings,
)
from wingbeat.mechanics.wing_motion import (
    StripSpeeds,
    UnsteadyLoad,
    WingMotion,
    WingShape,
    mid_speed,
    strip_motion,
    stroke_attitude,
    unsteady_load,
)
from wingbeat.mechanics.wing_shape import (
    Strips,
    air_chord,
    dot,
    from_world,
    mass_moments,
    quarter_turn,
    shape_at,
    strips_of,
    sum_over_strips,
    time_rates,
    wing_shape,
    with_time_axes,
)

if TYPE_CHECKING:
    from wingbeat._jax.arrays import BodyAcceleration, Pair, PerStrip, PerStripBroadcast, Phases, PitchState, Triple


class PartialMotion(NamedTuple):
    """A motion of the wing: sums over the velocities v that one unit of this motion gives to the wing's points.

    For the turn of a hinge, v is in m/rad; for the whole motion, it is in m/s. The sums are over the mass points of
    both wings and may have axes of times. In stroke axes, r is the position of a mass point, and E rotates by a
    right angle.

    Attributes
    ----------
    normal_lever : component of the quarter chord's v along the unpitched strip's normal, by strip.
    chord_rotation : turn of the chord, by strip.
    first_moment : ``sum m v``, forward and up.
    euler : ``sum m v . E r``, to be multiplied by the body's pitch acceleration.
    centrifugal : ``sum m v . r``, to be multiplied by the pitch rate squared.
    coriolis : ``sum m v . E r'``, to be multiplied by the pitch rate.
    own_acceleration : ``sum m v . r''``.
    chordwise_lever : component of the quarter chord's v along the unpitched chord, by strip; None unless the wing
        sweeps.
    unsteady : generalised load of the unsteady terms; None without them.
    """

    normal_lever: PerStrip
    chord_rotation: PerStrip
    first_moment: Pair
    euler: Phases
    centrifugal: Phases
    coriolis: Phases
    own_acceleration: Phases
    chordwise_lever: PerStrip | None = None
    unsteady: UnsteadyLoad | None = None


class HingeMotion(NamedTuple):
    """Rates of the two hinge angles, and the motions of flap, of wing pitch and of the whole wingbeat.

    Attributes
    ----------
    flap_rate, pitch_rate : rates of flap and of wing pitch at the root [rad/s].
    flap, pitch, whole : the motions.
    """

    flap_rate: Phases
    pitch_rate: Phases
    flap: PartialMotion
    pitch: PartialMotion
    whole: PartialMotion


class HingeLoads(NamedTuple):
    """Torques and powers of the hinges, both wings together.

    Attributes
    ----------
    flap_torque, pitch_torque : [N m].
    hinge_power : torques times rates [W]; the sum of the three parts below.
    actuator_power : power of all actuators, including those of span, fold, sweep and twist [W].
    aerodynamic_power : part against the air loads [W].
    inertial_power : part that accelerates the wings relative to the body [W].
    body_power : the rest [W]; it arises because the body accelerates and turns, and because of gravity.
    """

    flap_torque: Phases
    pitch_torque: Phases
    hinge_power: Phases
    actuator_power: Phases
    aerodynamic_power: Phases
    inertial_power: Phases
    body_power: Phases


class _GeneralisedForce(NamedTuple):
    """The generalised force that drives a motion of the wing.

    Attributes
    ----------
    air : part against the air loads.
    inertia : part that accelerates the wing relative to the body.
    body : part due to the body's acceleration and gravity.
    """

    air: Phases
    inertia: Phases
    body: Phases

    @property
    def whole(self) -> Phases:
        return self.body + self.inertia + self.air


class _Chords(NamedTuple):
    """The strips' shape, their mid-chords, and the vectors from there to the leading edge."""

    shape: WingShape
    mid_chord: Triple
    fore: Triple


def _chords(shape: WingShape, strips: Strips) -> _Chords:
    quarter, fore = 0.25 * strips.chord, shape.chordwise
    x, y, z = (place - quarter * ahead for place, ahead in zip(shape.quarter_chord, fore, strict=True))
    return _Chords(shape, (x, y, z), fore)


def hinge_motion(model: FlightModel, wingbeat: Wingbeat, phase: Phases) -> HingeMotion:
    """Tabulate the motions that the hinges cause, at given phases."""
    vehicle, phase = model.vehicle, jnp.asarray(phase, dtype=float)
    strips = with_time_axes(strips_of(vehicle.wing, model.strips), phase)

    def by_time(at: Phases) -> _Chords:
        return _chords(shape_at(vehicle, wingbeat, strips, at), strips)

    def by_angles(flap: Phases, pitch: Phases) -> _Chords:
        return _chords(wing_shape(vehicle, wingbeat, strips, phase, flap, pitch), strips)

    here, rates, accelerations = time_rates(by_time, phase, wingbeat.frequency)
    angles = flap_angle(wingbeat, phase), pitch_angle(wingbeat, phase)
    one, none = jnp.ones_like(phase), jnp.zeros_like(phase)
    flap, pitch = (jax.jvp(by_angles, angles, along)[1] for along in ((one, none), (none, one)))
    _, flap_rate, _ = time_rates(lambda at: flap_angle(wingbeat, at), phase, wingbeat.frequency)
    _, pitch_rate, _ = time_rates(lambda at: pitch_angle(wingbeat, at), phase, wingbeat.frequency)
    moving = here, rates, accelerations
    motions = [_along(moving, v, strips) for v in (flap, pitch, rates)]
    if is_unsteady(model):
        width = vehicle.wing.semi_span / model.strips * span_ratio(wingbeat, phase)
        chord = air_chord(wingbeat, strips.chord, phase)
        moved = strip_motion(here.shape, rates.shape, accelerations.shape, chord)
        motions = [
            motion._replace(unsteady=unsteady_load(moved, _speeds(motion, v, here, chord), chord, width))
            for motion, v in zip(motions, (flap, pitch, rates), strict=True)
        ]
    return HingeMotion(flap_rate, pitch_rate, *motions)


def _speeds(along: PartialMotion, velocity: _Chords, here: _Chords, chord: PerStripBroadcast) -> StripSpeeds:
    speeds = along.chordwise_lever, along.normal_lever, dot(velocity.fore, here.shape.normal)
    return StripSpeeds(*speeds[:2], mid_speed(here.shape, *speeds, chord), speeds[2])


def _along(moving: tuple[_Chords, _Chords, _Chords], velocity: _Chords, strips: Strips) -> PartialMotion:
    here, rates, accelerations = moving
    # The mass of a strip is spread along its chord: its second moment about mid-chord is that of a uniform rod.
    mass, gyration = 2.0 * strips.mass, strips.chord * strips.chord / 12.0

    def in_plane(chords: _Chords) -> tuple[Pair, Pair]:
        return (chords.mid_chord[0], chords.mid_chord[2]), (chords.fore[0], chords.fore[2])

    def work(mid_chord: Pair, fore: Pair) -> PerStrip:
        return dot(mid_chord, of_mid_chord) + gyration * dot(fore, of_fore)

    swept = here.shape.sweep_sine is not None
    of_mid_chord, of_fore = in_plane(velocity)
    (place, fore), (speed, fore_rate) = in_plane(here), in_plane(rates)
    rows = (
        *of_mid_chord,
        work(quarter_turn(place), quarter_turn(fore)),
        work(place, fore),
        work(quarter_turn(speed), quarter_turn(fore_rate)),
        dot(accelerations.mid_chord, velocity.mid_chord) + gyration * dot(accelerations.fore, velocity.fore),
    )
    sums = mass_moments(mass, rows)
    return PartialMotion(
        normal_lever=velocity.shape.above * here.shape.flap_cosine - velocity.shape.left * here.shape.flap_sine,
        chord_rotation=dot(velocity.fore, here.shape.normal) if swept else velocity.shape.pitch,
        first_moment=(sums[0], sums[1]),
        euler=sums[2],
        centrifugal=sums[3],
        coriolis=sums[4],
        own_acceleration=sums[5],
        chordwise_lever=dot(velocity.shape.quarter_chord, here.shape.unpitched) if swept else None,
    )


def hinge_loads(
    model: FlightModel,
    motion: WingMotion,
    hinges: HingeMotion,
    pitch_state: PitchState,
    body_acceleration: BodyAcceleration,
) -> HingeLoads:
    """Return hinge torques and powers of a flight.

    Theory: equations ``generalised-force``, ``hinge-torques``, ``hinge-power``, ``actuator-power`` and
    ``power-parts``.
    """
    body_pitch, u, w, pitch_rate = pitch_state
    ax, az, pitch_acceleration = body_acceleration
    attitude = stroke_attitude(model.vehicle.wing, motion, body_pitch)
    velocity = velocity_at_wings(model, attitude, u, w)
    strips = strip_loads(model.kernel, model.air.density, motion, velocity, pitch_rate)
    moments = strip_moments(model.kernel, motion, strips) if model.at_centre_of_pressure else 0.0
    apparent = from_world(attitude, ax, az + model.air.gravity)
    accelerates = (*from_world(attitude, ax, az), pitch_acceleration) if is_unsteady(model) else None

    def required(along: PartialMotion) -> _GeneralisedForce:
        air = strips.normal * along.normal_lever + moments * along.chord_rotation
        if along.chordwise_lever is not None:
            air = air + strips.chordwise * along.chordwise_lever
        against_air = -2.0 * sum_over_strips(air)
        if along.unsteady is not None:
            through_air, density = (*velocity, pitch_rate), unsteady_density(model)
            against_air = against_air - along.unsteady.load(density, through_air, accelerates, strips.speed)
        return _GeneralisedForce(
            air=against_air,
            inertia=along.own_acceleration,
            body=dot(apparent, along.first_moment)
            + pitch_acceleration * along.euler
            - pitch_rate * pitch_rate * along.centrifugal
            + 2.0 * pitch_rate * along.coriolis,
        )

    flap, pitch = required(hinges.flap), required(hinges.pitch)
    shares = (a * hinges.flap_rate + b * hinges.pitch_rate for a, b in zip(flap, pitch, strict=True))
    return HingeLoads(
        flap.whole,
        pitch.whole,
        flap.whole * hinges.flap_rate + pitch.whole * hinges.pitch_rate,
        required(hinges.whole).whole,
        *shares,
    )
