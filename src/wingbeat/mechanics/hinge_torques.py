"""Torques and powers of the hinges, and the parts of the power, from sums over the wing that depend on time alone.

By d'Alembert's principle, the generalised force that drives a motion of the wing is
``sum m (r'' - g) . v - F . v``. Here v is the velocity that the motion gives each point: dr/d(angle) for a hinge
torque, dr/dt in body axes for the power of all actuators. In stroke axes
``r'' = p'' + psi'' E b - psi'^2 b + 2 psi' E b' + b''``. Here p is the position of the body, b that of a point
relative to the body, and E turns a vector nose-up by a right angle. So all sums over mass points depend on time
alone, as in `body_dynamics`.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from wingbeat._jax.arrays import at_default, jax, jnp, unchecked
from wingbeat.aero.strip_forces import StripForces
from wingbeat.animal.kinematics import HeldHinge, Wingbeat, flap_angle, pitch_angle, span_ratio
from wingbeat.animal.vehicle import Wing
from wingbeat.mechanics.strip_air import (
    is_unsteady,
    loads_of_strips,
    strip_moments,
    unsteady_density,
    velocity_at_wings,
    wake_of,
)
from wingbeat.mechanics.wing_motion import (
    StripSpeeds,
    UnsteadyLoad,
    WingMotion,
    WingShape,
    inertia_of_air,
    mid_speed,
    strip_motion,
    stroke_attitude,
    turned_by_hinge,
    unsteady_load,
)
from wingbeat.mechanics.wing_shape import (
    Strips,
    UnturnedShapes,
    air_chord,
    dot,
    from_world,
    giving_share,
    mass_behind,
    mass_gyration,
    mass_moments,
    quarter_turn,
    shape_at,
    strips_of,
    sum_over_strips,
    time_rates,
    turned,
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
    pitch: PartialMotion | None  # None if nothing drives it
    whole: PartialMotion
    giving: PartialMotion | None = None  # that of a hinge that nothing drives; None without one
    giving_rate: Phases | None = None  # [rad/s]


class HingeLoads(NamedTuple):
    """Torques [N m] and powers [W] of the hinges, both wings together."""

    flap_torque: Phases
    pitch_torque: Phases  # 0 if nothing drives this hinge
    hinge_power: Phases  # torques times rates; the sum of the last three parts
    actuator_power: Phases  # of all actuators, including those of span, fold, sweep and twist
    aerodynamic_power: Phases  # part against the air loads
    inertial_power: Phases  # part that accelerates the wings relative to the body
    body_power: Phases  # the rest: the body accelerates and turns, and gravity


class _Chords(NamedTuple):
    """The strips' shape, their centres of mass, and the unit vectors from there to the leading edge."""

    shape: WingShape
    centre: Triple
    fore: Triple


def _chords(wing: Wing, strips: Strips, shape: WingShape) -> _Chords:
    behind, fore = mass_behind(wing, strips), shape.chordwise
    x, y, z = (place - behind * ahead for place, ahead in zip(shape.quarter_chord, fore, strict=True))
    return _Chords(shape, (x, y, z), fore)


def hinge_alone(
    model: Any, wingbeat: Wingbeat, phase: Phases, shapes: UnturnedShapes | None = None
) -> tuple[PartialMotion, Phases]:
    """Return the motion that a unit rate of a held hinge causes, and its inertia, both wings in air [kg m2].

    With `shapes`, the hinge turns at a steady rate.

    Theory: equation ``hinge-balance``.
    """
    vehicle, hinge = model.vehicle, wingbeat.pitch_hinge
    assert isinstance(hinge, HeldHinge)
    strips = with_time_axes(strips_of(vehicle.wing, model.strips), phase)

    def chords(shape: WingShape) -> _Chords:
        return _chords(vehicle.wing, strips, shape)

    def by_angle(angle: Phases) -> _Chords:
        if shapes is not None:
            turn = giving_share(wingbeat, strips.span_fraction) * angle
            return chords(turned(vehicle.wing, strips, shapes.shape, turn))
        other = unchecked(Wingbeat, vars(wingbeat) | {"pitch_hinge": hinge._replace(angle=angle)})
        return chords(shape_at(vehicle, other, strips, phase))

    if shapes is None:
        in_time = time_rates(lambda at: chords(shape_at(vehicle, wingbeat, strips, at)), phase, wingbeat.frequency)
    else:
        in_time = turned_by_hinge(chords, vehicle.wing, wingbeat, strips, shapes)
    here, rates, accelerations = in_time
    velocity = jax.jvp(by_angle, (hinge.angle,), (jnp.ones_like(hinge.angle),))[1]
    along = _along(vehicle.wing, here, rates, accelerations, velocity, strips)
    of_mass = dot(velocity.centre, velocity.centre)
    of_mass = of_mass + mass_gyration(vehicle.wing, strips) * dot(velocity.fore, velocity.fore)
    inertia = sum_over_strips(2.0 * strips.mass * of_mass)
    if not is_unsteady(model):
        return along, inertia
    chord = air_chord(wingbeat, strips.chord, phase)
    width = vehicle.wing.semi_span / model.strips * span_ratio(wingbeat, phase)
    moved = strip_motion(here.shape, rates.shape, accelerations.shape, chord)
    speeds = _speeds_of(here, velocity, along, chord)
    inertia = inertia + unsteady_density(model) * inertia_of_air(speeds, chord, width)
    return along._replace(unsteady=unsteady_load(moved, speeds, chord, width)), inertia


def _speeds_of(here: _Chords, velocity: _Chords, along: PartialMotion, chord: PerStripBroadcast) -> StripSpeeds:
    """Return the speeds of the strips per unit of a motion."""
    levers, turn = (along.chordwise_lever, along.normal_lever), dot(velocity.fore, here.shape.normal)
    return StripSpeeds(*levers, mid_speed(here.shape, *levers, turn, chord), turn)


def hinge_motion(model: Any, wingbeat: Wingbeat, phase: Phases) -> HingeMotion:
    """Tabulate the motions that the hinges cause, at given phases."""
    vehicle, phase = model.vehicle, jnp.asarray(phase, dtype=float)
    strips = with_time_axes(strips_of(vehicle.wing, model.strips), phase)

    def by_time(at: Phases) -> _Chords:
        return _chords(vehicle.wing, strips, shape_at(vehicle, wingbeat, strips, at))

    def by_angles(flap: Phases, pitch: Phases) -> _Chords:
        return _chords(vehicle.wing, strips, wing_shape(vehicle, wingbeat, strips, phase, flap, pitch))

    here, rates, accelerations = time_rates(by_time, phase, wingbeat.frequency)
    angles = flap_angle(wingbeat, phase), pitch_angle(wingbeat, phase)
    one, none = jnp.ones_like(phase), jnp.zeros_like(phase)
    flap, pitch = (jax.jvp(by_angles, angles, along)[1] for along in ((one, none), (none, one)))
    _, flap_rate, _ = time_rates(lambda at: flap_angle(wingbeat, at), phase, wingbeat.frequency)
    _, pitch_rate, _ = time_rates(lambda at: pitch_angle(wingbeat, at), phase, wingbeat.frequency)
    motions = [_along(vehicle.wing, here, rates, accelerations, v, strips) for v in (flap, pitch, rates)]
    if is_unsteady(model):
        width = vehicle.wing.semi_span / model.strips * span_ratio(wingbeat, phase)
        chord = air_chord(wingbeat, strips.chord, phase)
        moved = strip_motion(here.shape, rates.shape, accelerations.shape, chord)
        for i, v in enumerate((flap, pitch, rates)):
            speeds = _speeds_of(here, v, motions[i], chord)
            motions[i] = motions[i]._replace(unsteady=unsteady_load(moved, speeds, chord, width))
    if isinstance(hinge := wingbeat.pitch_hinge, HeldHinge):
        giving, rate = hinge_alone(model, wingbeat, phase)[0], hinge.rate + jnp.zeros_like(phase)
        driven = None if hinge.moves_root else motions[1]
        return HingeMotion(flap_rate, pitch_rate, motions[0], driven, motions[2], giving, rate)
    return HingeMotion(flap_rate, pitch_rate, *motions)


def _along(
    wing: Wing, here: _Chords, rates: _Chords, accelerations: _Chords, velocity: _Chords, strips: Strips
) -> PartialMotion:
    # The mass of a strip is spread along its chord about its centre.
    mass, gyration = 2.0 * strips.mass, mass_gyration(wing, strips)

    def in_plane(chords: _Chords) -> tuple[Pair, Pair]:
        return (chords.centre[0], chords.centre[2]), (chords.fore[0], chords.fore[2])

    def work(centre: Pair, fore: Pair) -> PerStrip:
        return dot(centre, of_centre) + gyration * dot(fore, of_fore)

    swept = here.shape.sweep_sine is not None or not at_default(wing, "pitch_axis")
    of_centre, of_fore = in_plane(velocity)
    (place, fore), (speed, fore_rate) = in_plane(here), in_plane(rates)
    rows = (
        *of_centre,
        work(quarter_turn(place), quarter_turn(fore)),
        work(place, fore),
        work(quarter_turn(speed), quarter_turn(fore_rate)),
        dot(accelerations.centre, velocity.centre) + gyration * dot(accelerations.fore, velocity.fore),
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


def required_force(
    model: Any,
    along: PartialMotion,
    strips: StripForces,
    moments: PerStrip | float,
    velocity: Pair,
    pitch_rate: Phases,
    apparent: Pair,
    pitch_acceleration: Phases,
    accelerates: Triple | None,
) -> Triple:
    """Return the generalised force that drives a motion: against the air, of the wing's inertia, of the body.

    `moments` are those of the strips' loads about the quarter chords. In stroke axes, `apparent` is the body's
    acceleration less that of gravity; `accelerates` is that of the body, None without unsteady terms.

    Theory: equation ``generalised-force``.
    """
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


def hinge_loads(
    model: Any,
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
    ax, az, turning = body_acceleration
    attitude = stroke_attitude(model.vehicle.wing, motion, body_pitch)
    velocity = velocity_at_wings(model, attitude, u, w)
    strips = loads_of_strips(model, motion, velocity, pitch_rate, wake)
    moments = strip_moments(model, motion, strips) if model.at_centre_of_pressure else 0.0
    apparent = from_world(attitude, ax, az + model.air.gravity)
    accelerates = (*from_world(attitude, ax, az), turning) if is_unsteady(model) else None
    given = velocity, pitch_rate, apparent, turning, accelerates

    def required(along: PartialMotion) -> Triple:
        return required_force(model, along, strips, moments, *given)

    flap_parts = required(hinges.flap)
    if hinges.pitch is None:
        still = jnp.zeros_like(flap_parts[0])
        pitch_parts = still, still, still
    else:
        pitch_parts = required(hinges.pitch)
    flap, pitch = (of_body + inertia + air for air, inertia, of_body in (flap_parts, pitch_parts))
    air, inertia, of_body = required(hinges.whole)
    actuators = of_body + inertia + air
    if hinges.giving is not None and hinges.giving_rate is not None:
        # Spring and damper hold this hinge: no actuator gives its power.
        actuators = actuators - sum(required(hinges.giving)) * hinges.giving_rate
    power = flap * hinges.flap_rate + pitch * hinges.pitch_rate
    shares = (a * hinges.flap_rate + b * hinges.pitch_rate for a, b in zip(flap_parts, pitch_parts, strict=True))
    return HingeLoads(flap, pitch, power, actuators, *shares)
