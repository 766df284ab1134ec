"""The air that strips and body meet, loads in it, and the air that shed wakes move (`wingbeat.aero.wake`)."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from wingbeat._base import Fault, InvalidInputError
from wingbeat._jax.arrays import at_default, atan2, computed_once, cos, elementwise_jvp, fusion_barrier, jnp, sin
from wingbeat.aero.closed_forms import body_drag, crossflow_force, rotation_lift, tail_force
from wingbeat.aero.family import at_reynolds, depends_on_reynolds
from wingbeat.aero.strip_forces import StripForces, strip_forces
from wingbeat.aero.wake import WakeLag, shed_downwash, wake_downwash
from wingbeat.animal.vehicle import Vehicle
from wingbeat.mechanics.wing_motion import WingMotion, stroke_attitude
from wingbeat.mechanics.wing_shape import dot, from_world

if TYPE_CHECKING:
    from wingbeat._jax.arrays import FlightState, Pair, PerStrip, Phases, PhasesStrips, Scalar, WakeStates
    from wingbeat.aero.coefficient_model import Kernel


def strip_speeds(
    motion: WingMotion, velocity: Pair, pitch_rate: Phases
) -> tuple[PerStrip, PerStrip, PerStrip | None]:
    """Return the speeds of the quarter chords along chord and normal of the unpitched strip, and along the span."""
    forward_speed, up_speed = velocity[0] - pitch_rate * motion.above, velocity[1] + pitch_rate * motion.ahead
    normal_speed = up_speed * motion.flap_cosine + motion.flapping_speed
    chord_speed = forward_speed
    if motion.unpitched is not None:
        chord_speed = dot(motion.unpitched, (forward_speed, up_speed)) + motion.sweeping_speed
    span_speed = None
    if motion.span is not None:
        span_speed = dot(motion.span, (forward_speed, up_speed)) + motion.spanwise_speed
    return chord_speed, normal_speed, span_speed


class StripWake(NamedTuple):
    """The air that strips meet where the shed wake moves it, along the pitched chord and its normal."""

    chord_speed: PerStrip  # of the quarter chord through that air [m/s]
    normal_speed: PerStrip
    span_speed: PerStrip | None
    downwash: PerStrip  # X, by which the wake moves the air [m/s]
    shed: PerStrip  # w, the downwash that sets the circulation [m/s]
    pace: PerStrip  # semi-chords in a second
    turning: PerStrip | None  # of the chord [rad/s]; None without unsteady terms


def wake_states(model: Any, state: FlightState) -> WakeStates:
    """Return z_1 and z_2 of the strips, from the state of a flight with the lag of the wake."""
    return state[4:].reshape(2, model.strips, *state.shape[1:])


def strips_in_wake(
    model: Any, motion: WingMotion, velocity: Pair, pitch_rate: Phases, states: WakeStates
) -> StripWake:
    """Return the air that strips meet; the velocity is that of the body relative to the air at the wings."""
    along, across, span_speed = strip_speeds(motion, velocity, pitch_rate)
    chords = motion.chords
    assert chords is not None
    chord_speed = chords.cosine * along + chords.sine * across
    normal_speed = chords.cosine * across - chords.sine * along
    turning = None
    if chords.turning is not None and chords.turning_by_spin is not None:
        turning = chords.turning + pitch_rate * chords.turning_by_spin
    return wake_at(model, motion.area / motion.width, (chord_speed, normal_speed, span_speed), turning, states)


def wake_at(
    model: Any,
    chord: PerStrip,
    speeds: tuple[PerStrip, PerStrip, PerStrip | None],
    turning: PerStrip | None,
    states: WakeStates,
) -> StripWake:
    """Return the air that strips meet, from speeds along the pitched chord, its normal and the span."""
    speeds, turning = computed_once((speeds, turning))
    shed, speed = _shed((model.kernel, model.wake), *speeds[:2])
    if turning is not None:
        shed = shed + model.unsteady * 0.5 * chord * turning
    downwash = wake_downwash(model.wake.shares, shed, states)
    # In air that moves down, the strip moves up relative to the air.
    met = StripWake(speeds[0], speeds[1] + downwash, speeds[2], downwash, shed, 2.0 * speed / chord, turning)
    return computed_once(met)


@elementwise_jvp
def _shed(
    numbers: tuple[Kernel, WakeLag], chord_speed: PerStrip, normal_speed: PerStrip
) -> tuple[PerStrip, PerStrip]:
    """Return what strips shed that do not turn, and their speed in the plane of chord and normal [m/s]."""
    kernel, wake = numbers
    squared = chord_speed * chord_speed + normal_speed * normal_speed
    moving = squared > 0.0
    speed = jnp.where(moving, jnp.sqrt(jnp.where(moving, squared, 1.0)), 0.0)
    alpha = atan2(-normal_speed, chord_speed)
    lift, _ = kernel.lift_drag(alpha)
    axes = (1,) * (alpha.ndim - 1)  # of times
    stall, per_lift = (
        [jnp.reshape(one, (-1, *axes)) if jnp.ndim(one) else one for one in jnp.asarray(pair)]
        for pair in (wake.stall, wake.per_lift)
    )
    return shed_downwash(stall, per_lift, alpha, lift, speed, normal_speed, jnp), speed


def strip_loads_in_wake(model: Any, motion: WingMotion, wake: StripWake) -> StripForces:
    """Return the quasi-steady loads on strips in moved air, along chord and normal of the unpitched strip."""
    chords, speeds = motion.chords, (wake.chord_speed, wake.normal_speed)
    assert chords is not None
    still = jnp.zeros_like(wake.chord_speed)
    found = strip_forces(model.kernel, model.air.density, motion.area, *speeds, still, wake.span_speed)
    along, across = found.chordwise, found.normal
    if wake.turning is not None:
        # The tables of the unsteady terms have rotation in the air that the wake does not move.
        chord, width = motion.area / motion.width, motion.width
        along = (
            along - rotation_lift(model.unsteady * model.air.density, chord, width, wake.turning) * wake.downwash
        )
    chordwise = chords.cosine * along - chords.sine * across
    return computed_once(found._replace(chordwise=chordwise, normal=chords.sine * along + chords.cosine * across))


def strip_loads(model: Any, motion: WingMotion, velocity: Pair, pitch_rate: Phases) -> StripForces:
    """Return the quasi-steady loads on the strips of one wing, along chord and normal of the unpitched strip.

    `velocity` is that of the body relative to the air at the wings, in stroke axes. The velocity of the quarter
    chord determines the angle of attack, wherever the force acts.

    Theory: equations ``strip-velocity`` and ``strip-velocity-stroke``.
    """
    chord_speed, normal_speed, span_speed = strip_speeds(motion, velocity, pitch_rate)
    speeds, kernel = (chord_speed, normal_speed, motion.pitch, span_speed), model.kernel
    if depends_on_reynolds(kernel):
        scale = motion.area / motion.width / model.air.viscosity
        return strip_forces(kernel, model.air.density, motion.area, *speeds, scale)
    return strip_forces(kernel, model.air.density, motion.area, *speeds)


def loads_of_strips(
    model: Any, motion: WingMotion, velocity: Pair, pitch_rate: Phases, wake: StripWake | None
) -> StripForces:
    """Return the quasi-steady loads on the strips, in the air that their wake moves if it is given."""
    if wake is None:
        return strip_loads(model, motion, velocity, pitch_rate)
    return strip_loads_in_wake(model, motion, wake)


def strip_moments(model: Any, motion: WingMotion, strips: StripForces) -> PerStrip:
    """Return the moments of loads at the centre of pressure about the quarter chords, leading edge up [N m]."""
    across = strips.normal * cos(motion.pitch) - strips.chordwise * sin(motion.pitch)
    return pressure_offset(model, strips, motion.area / motion.width) * across


def pressure_offset(model: Any, strips: StripForces, chord: PerStrip) -> PerStrip:
    """Return how far the centre of pressure is ahead of the quarter chord [m]. Theory: equation ``force-point``."""
    kernel = model.kernel
    if depends_on_reynolds(kernel):
        kernel = at_reynolds(kernel, model.air.reynolds(strips.speed, chord))
    return chord * (0.25 - kernel.centre_of_pressure(strips.alpha))


def is_unsteady(model: Any) -> bool:
    """Return whether a model has unsteady terms."""
    return not at_default(model, "unsteady")


def unsteady_density(model: Any) -> Scalar:
    """Return the density of the air times the share of unsteady loads [kg/m3]."""
    return model.unsteady * model.air.density


def velocity_at_wings(model: Any, attitude: Phases, u: Phases, w: Phases) -> Pair:
    """Return the velocity of the body relative to the air at the wings, in stroke axes [m/s]."""
    if model.induced_flow is None:
        return from_world(attitude, u, w)
    forward, up = model.induced_flow
    return from_world(attitude, u - forward, w - up)


def wake_of(model: Any, motion: WingMotion, state: FlightState) -> StripWake | None:
    """Return the air that the wake of the strips moves, from the state of a flight; None without the lag."""
    if model.wake is None:
        return None
    body_pitch, u, w, pitch_rate = state[:4]
    attitude = stroke_attitude(model.vehicle.wing, motion, body_pitch)
    velocity = velocity_at_wings(model, attitude, u, w)
    return strips_in_wake(model, motion, velocity, pitch_rate, wake_states(model, state))


def refuse_without_wake(model: Any, states: PhasesStrips | None = None) -> None:
    """Refuse a model with the lag of the wake where the states of the wake are not known."""
    if model.wake is not None and states is None:
        rule = "has two states of each strip, which only a closed wingbeat knows"
        fix = "leave the wake out here, or solve an orbit with it"
        raise InvalidInputError([Fault("aero.wake", "the lag of the wake", rule, fix)])


def body_air(
    vehicle: Vehicle,
    density: Scalar,
    velocity: Pair,
    pitch_rate: Phases,
    axes: Phases | Scalar = 0.0,
    tilt: Phases | Scalar | None = None,
) -> tuple[Pair, Phases | None]:
    """Return force and moment of the air on the body and its tail; without a tail the moment is None.

    `axes` is the nose-up pitch of the velocity's axes relative to body axes; `tilt` is added to the tail's
    incidence. The flow that the wings induce does not reach the tail.

    Theory: equation ``tail-velocity``.
    """
    drag, tail = body_drag(vehicle.body.drag_area, density, velocity, jnp), vehicle.tail
    if not at_default(vehicle.body, "crossflow_area"):
        normal = fusion_barrier((sin(axes), cos(axes)))
        more = crossflow_force(vehicle.body.crossflow_area, density, normal, velocity, jnp)
        drag = drag[0] + more[0], drag[1] + more[1]
    if tail is None:
        return drag, None
    # Behind the barriers, geometry and force are computed once for all directions of a derivative. A flight with a
    # tail then takes 1.15 times as long as one with no tail. Without the barriers it takes 1.5 times as long.
    incidence = (tail.incidence if tilt is None else tail.incidence + tilt) - axes
    (ahead, above), normal = from_world(axes, -tail.arm, tail.height), (-sin(incidence), cos(incidence))
    (ahead, above), normal = fusion_barrier(((ahead, above), normal))
    there = velocity[0] - pitch_rate * above, velocity[1] + pitch_rate * ahead
    force = tail_force(density, tail.area, tail.lift_slope, tail.drag_coefficient, normal, there, jnp)
    forward, up = computed_once(force)
    return (drag[0] + forward, drag[1] + up), ahead * up - above * forward
