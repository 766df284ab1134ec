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
from wingbeat.mechanics.flight_model import FlightModel, is_unsteady, unsteady_density, velocity_at_wings, wake_of
from wingbeat.mechanics.strip_air import loads_of_strips, strip_moments
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
    from wingbeat._jax.arrays import BodyAcceleration, Pair, PerStrip, Phases, PitchState, Triple


class PartialMotion(NamedTuple):
    """A motion of the wing: sums over the velocities v that one unit of this motion gives to the wing's points.

    For the turn of a hinge, v is in m/rad; for the whole motion, it is in m/s. The sums are over the mass points of
    both wings and may have axes of times. In stroke axes, r is the position of a mass point, and E rotates by a
    right angle.
    """

    normal_lever: PerStrip  # component of the quarter chord's v along the unpitched strip's normal
    chord_rotation: PerStrip  # turn of the chord
    first_moment: Pair  # ``sum m v``, forward and up
    euler: Phases  # ``sum m v . E r``, to be multiplied by the body's pitch acceleration
    centrifugal: Phases  # ``sum m v . r``, to be multiplied by the pitch rate squared
    coriolis: Phases  # ``sum m v . E r'``, to be multiplied by the pitch rate
    own_acceleration: Phases  # ``sum m v . r''``
    chordwise_lever: PerStrip | None = None  # component along the unpitched chord; None unless the wing sweeps
    unsteady: UnsteadyLoad | None = None


class HingeMotion(NamedTuple):
    """Rates of the two hinge angles, and the motions of flap, of wing pitch and of the whole wingbeat."""

    flap_rate: Phases  # [rad/s]
    pitch_rate: Phases  # of wing pitch at the root [rad/s]
    flap: PartialMotion
    pitch: PartialMotion
    whole: PartialMotion


class HingeLoads(NamedTuple):
    """Torques [N m] and powers [W] of the hinges, both wings together."""

    flap_torque: Phases
    pitch_torque: Phases
    hinge_power: Phases  # torques times rates; the sum of the last three parts
    actuator_power: Phases  # of all actuators, including those of span, fold, sweep and twist
    aerodynamic_power: Phases  # part against the air loads
    inertial_power: Phases  # part that accelerates the wings relative to the body
    body_power: Phases  # the rest: the body accelerates and turns, and gravity


class _Chords(NamedTuple):
    """The strips' shape, their mid-chords, and the vectors from there to the leading edge."""

    shape: WingShape
    mid_chord: Triple
    fore: Triple


def hinge_motion(model: FlightModel, wingbeat: Wingbeat, phase: Phases) -> HingeMotion:
    """Tabulate the motions that the hinges cause, at given phases."""
    vehicle, phase = model.vehicle, jnp.asarray(phase, dtype=float)
    strips = with_time_axes(strips_of(vehicle.wing, model.strips), phase)

    def chords(shape: WingShape) -> _Chords:
        quarter, fore = 0.25 * strips.chord, shape.chordwise
        x, y, z = (place - quarter * ahead for place, ahead in zip(shape.quarter_chord, fore, strict=True))
        return _Chords(shape, (x, y, z), fore)

    def by_time(at: Phases) -> _Chords:
        return chords(shape_at(vehicle, wingbeat, strips, at))

    def by_angles(flap: Phases, pitch: Phases) -> _Chords:
        return chords(wing_shape(vehicle, wingbeat, strips, phase, flap, pitch))

    here, rates, accelerations = time_rates(by_time, phase, wingbeat.frequency)
    angles = flap_angle(wingbeat, phase), pitch_angle(wingbeat, phase)
    one, none = jnp.ones_like(phase), jnp.zeros_like(phase)
    flap, pitch = (jax.jvp(by_angles, angles, along)[1] for along in ((one, none), (none, one)))
    _, flap_rate, _ = time_rates(lambda at: flap_angle(wingbeat, at), phase, wingbeat.frequency)
    _, pitch_rate, _ = time_rates(lambda at: pitch_angle(wingbeat, at), phase, wingbeat.frequency)
    motions = [_along(here, rates, accelerations, v, strips) for v in (flap, pitch, rates)]
    if is_unsteady(model):
        width = vehicle.wing.semi_span / model.strips * span_ratio(wingbeat, phase)
        chord = air_chord(wingbeat, strips.chord, phase)
        moved = strip_motion(here.shape, rates.shape, accelerations.shape, chord)
        for i, v in enumerate((flap, pitch, rates)):
            levers, turn = (motions[i].chordwise_lever, motions[i].normal_lever), dot(v.fore, here.shape.normal)
            speeds = StripSpeeds(*levers, mid_speed(here.shape, *levers, turn, chord), turn)
            motions[i] = motions[i]._replace(unsteady=unsteady_load(moved, speeds, chord, width))
    return HingeMotion(flap_rate, pitch_rate, *motions)


def _along(
    here: _Chords, rates: _Chords, accelerations: _Chords, velocity: _Chords, strips: Strips
) -> PartialMotion:
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
    wake = wake_of(model, motion, pitch_state)
    body_pitch, u, w, pitch_rate = pitch_state if wake is None else pitch_state[:4]
    ax, az, pitch_acceleration = body_acceleration
    attitude = stroke_attitude(model.vehicle.wing, motion, body_pitch)
    velocity = velocity_at_wings(model, attitude, u, w)
    strips = loads_of_strips(model, motion, velocity, pitch_rate, wake)
    moments = strip_moments(model, motion, strips) if model.at_centre_of_pressure else 0.0
    apparent = from_world(attitude, ax, az + model.air.gravity)
    accelerates = (*from_world(attitude, ax, az), pitch_acceleration) if is_unsteady(model) else None

    def required(along: PartialMotion) -> Triple:
        # The generalised force that drives a motion, in parts: against the air, of the wing's inertia, of the body.
        air = strips.normal * along.normal_lever + moments * along.chord_rotation
        if along.chordwise_lever is not None:
            air = air + strips.chordwise * along.chordwise_lever
        against_air = -2.0 * sum_over_strips(air)
        if along.unsteady is not None:
            through_air, density = (*velocity, pitch_rate), unsteady_density(model)
            against_air = against_air - along.unsteady.load(density, through_air, accelerates, strips.speed)
        of_body = dot(apparent, along.first_moment) + pitch_acceleration * along.euler
        of_body = of_body - pitch_rate * pitch_rate * along.centrifugal + 2.0 * pitch_rate * along.coriolis
        return against_air, along.own_acceleration, of_body

    flap_parts, pitch_parts = required(hinges.flap), required(hinges.pitch)
    flap, pitch = (of_body + inertia + air for air, inertia, of_body in (flap_parts, pitch_parts))
    power = flap * hinges.flap_rate + pitch * hinges.pitch_rate
    air, inertia, of_body = required(hinges.whole)
    shares = (a * hinges.flap_rate + b * hinges.pitch_rate for a, b in zip(flap_parts, pitch_parts, strict=True))
    return HingeLoads(flap, pitch, power, of_body + inertia + air, *shares)
