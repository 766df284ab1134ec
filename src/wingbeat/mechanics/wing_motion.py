"""The wing's motion in stroke axes, which depends on time alone: strips, mass points and their rates.

Everything here is for the left wing; sums over mass points count both wings. Strips are the first axis and times
the last, because XLA on CPU works along the last axis, and strips are few.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

from wingbeat._jax.arrays import at_default, cos, jax, jnp, sin
from wingbeat.animal.kinematics import (
    Wingbeat,
    chord_ratio,
    flap_angle,
    fold_angle,
    pitch_angle,
    span_ratio,
    sweep_angle,
    tip_twist,
)
from wingbeat.animal.vehicle import Vehicle, Wing
from wingbeat.mechanics.frames import dot, from_world, quarter_turn, stroke_pitch
from wingbeat.mechanics.strip_sums import mass_moments
from wingbeat.mechanics.unsteady_air import UnsteadyLoad, strip_motion, unsteady_loads_on_body
from wingbeat.mechanics.wing_shape import Strips, WingShape

if TYPE_CHECKING:
    from wingbeat._jax.arrays import Pair, PerStrip, PerStripBroadcast, Phases, Scalar, Triple


class WingMotion(NamedTuple):
    """The wing's motion in stroke axes, as air loads and body dynamics need it; any axes of times come last.

    Speeds are those of the quarter chord. Pitch turns a strip about its quarter chord and does not change these
    speeds. Sums over mass points count both wings.

    Attributes
    ----------
    ahead, above : position of the quarter chord [m]; `ahead` has no axis of strips unless the wing sweeps.
    flapping_speed : speed along the normal of the unpitched strip [m/s].
    flap_cosine : of the strip's flap angle.
    pitch : pitch of the strip [rad].
    area : of the strip [m2].
    width : of every strip, along the span [m], shape (...).
    first_moment : sum of mass times position, forward and up [kg m].
    first_moment_rate, first_moment_acceleration : its time derivatives [kg m/s, kg m/s2].
    inertia, inertia_rate : sum of mass times position squared [kg m2], and its time derivative [kg m2/s].
    acceleration_moment : sum of mass times (position turned by a right angle) . acceleration [N m].
    unpitched : unit vector along the unpitched chord, as its components in the plane of symmetry; None unless the
        wing sweeps.
    sweeping_speed : speed along the unpitched chord [m/s]; None unless the wing sweeps.
    tilt : of the stroke plane [rad]; None if it is 0.
    span : unit vector along the span, as its components in the plane of symmetry; None unless loads depend on the
        full airspeed.
    spanwise_speed : speed along the span [m/s]; None unless loads depend on the full airspeed.
    unsteady : unsteady loads on the body, forward, up and nose-up; None without unsteady terms.
    tail_tilt : added to the tail's incidence [rad]; None if it is 0, or without a tail.
    """

    ahead: Phases | PerStrip
    above: PerStrip
    flapping_speed: PerStrip
    flap_cosine: PerStrip
    pitch: PerStrip
    area: PerStrip
    width: Phases
    first_moment: Pair
    first_moment_rate: Pair
    first_moment_acceleration: Pair
    inertia: Phases
    inertia_rate: Phases
    acceleration_moment: Phases
    unpitched: Pair | None = None
    sweeping_speed: PerStrip | None = None
    tilt: Phases | None = None
    span: Pair | None = None
    spanwise_speed: PerStrip | None = None
    unsteady: tuple[UnsteadyLoad, UnsteadyLoad, UnsteadyLoad] | None = None
    tail_tilt: Phases | None = None


def strips_of(wing: Wing, count: int) -> Strips:
    """Cut a wing into equal strips.

    The mass of a strip is proportional to ``(1 - s/L)**p``, normalised to the mass of the wing.

    Theory: equation ``strip-mass``.

    Parameters
    ----------
    wing : gives chord, mass and mass exponent p.
    count : number of strips, N.
    """
    span_fraction = (jnp.arange(count) + 0.5) / count
    chord = chord_at(wing, span_fraction)
    share = (1.0 - span_fraction) ** wing.mass_exponent
    return Strips(span_fraction, chord, wing.mass * share / jnp.sum(share))


def chord_at(wing: Wing, span_fraction: PerStrip) -> PerStrip:
    """Return the chord [m] at span fractions, linear between the stations of the wing.

    Theory: equation ``strip-chord``.
    """
    stations = jnp.atleast_1d(jnp.asarray(wing.chord, dtype=float))
    if stations.size == 1:
        return jnp.broadcast_to(stations, span_fraction.shape)
    return jnp.interp(span_fraction, jnp.linspace(0.0, 1.0, stations.size), stations)


def air_chord(wingbeat: Wingbeat, chord: PerStripBroadcast, phase: Phases) -> PerStripBroadcast:
    """Return the chord that meets the air [m]: the full chord times the wingbeat's chord law.

    Theory: equation ``chord-law``.

    Parameters
    ----------
    wingbeat : gives the law.
    chord : the full chord of the strips [m], with an axis of length one for each axis of `phase`.
    phase : phases, shape (...).
    """
    ratio = chord_ratio(wingbeat, phase)
    return chord if ratio is None else chord * ratio


def stroke_plane(wing: Wing, wingbeat: Wingbeat) -> Scalar:
    """Return the angle of the stroke plane from the body axis [rad]. Theory: equation ``stroke-plane``."""
    if at_default(wingbeat, "stroke_plane_tilt"):
        return wing.stroke_plane_angle
    return wing.stroke_plane_angle + wingbeat.stroke_plane_tilt


def tail_tilt(vehicle: Vehicle, wingbeat: Wingbeat) -> Scalar | None:
    """Return the angle that is added to the tail's incidence [rad]; None if it is off, or without a tail."""
    if vehicle.tail is None or at_default(wingbeat, "tail_tilt"):
        return None
    return wingbeat.tail_tilt


def stroke_attitude(wing: Wing, motion: WingMotion, body_pitch: Phases) -> Phases:
    """Return the nose-up pitch of stroke axes relative to world axes [rad].

    Theory: equation ``stroke-attitude``.
    """
    attitude = body_pitch + stroke_pitch(wing.stroke_plane_angle)
    return attitude if motion.tilt is None else attitude - motion.tilt


def padded(strips: Strips, vector: int) -> Strips:
    """Return the strips, padded to a multiple of `vector` with strips without chord and mass.

    At a single time, XLA on CPU vectorises along the strips; a few left-over strips cost more than a full vector.
    """
    more = (0, -strips.span_fraction.size % vector)
    return Strips(
        jnp.pad(strips.span_fraction, more, "edge"), jnp.pad(strips.chord, more), jnp.pad(strips.mass, more)
    )


def with_time_axes(strips: Strips, phase: Phases) -> Strips:
    """Return the strips with an axis of length one for each axis of `phase`."""
    return Strips(*(jnp.expand_dims(a, tuple(range(1, 1 + jnp.ndim(phase)))) for a in strips))


def twist_factors(wingbeat: Wingbeat, span_fraction: PerStripBroadcast) -> PerStripBroadcast:
    """Return each strip's pitch divided by the root's, without the twist law: ``1 + (twist_ratio - 1) s/L``.

    Theory: equation ``strip-angles``.
    """
    return 1.0 + (wingbeat.twist_ratio - 1.0) * span_fraction


def wing_shape(
    vehicle: Vehicle, wingbeat: Wingbeat, strips: Strips, phase: Phases, flap: Phases, pitch: Phases
) -> WingShape:
    """Place the left wing's strips at given flap and pitch angles; the phase gives span, fold, sweep and twist.

    Inboard of the wrist, a strip has the flap angle of the arm; outboard, that of the hand.

    Theory: equations ``strip-angles``, ``shoulder-place`` and ``strip-place``.

    Parameters
    ----------
    vehicle : gives the wing.
    wingbeat : gives span, fold, sweep and twist.
    strips : of the wing.
    phase : phases, shape (...).
    flap, pitch : flap angle and wing pitch at the root [rad], shape (...).
    """
    wing = vehicle.wing
    length = wing.semi_span * span_ratio(wingbeat, phase)
    hand_flap = flap - fold_angle(wingbeat, phase)
    arm = jnp.minimum(strips.span_fraction, wingbeat.wrist)
    hand = jnp.maximum(strips.span_fraction - wingbeat.wrist, 0.0)
    (arm_sine, arm_cosine), (hand_sine, hand_cosine) = ((sin(a), cos(a)) for a in (flap, hand_flap))
    x, left, z = wing.shoulder
    ahead, above = from_world(stroke_pitch(stroke_plane(wing, wingbeat)), x, z)
    of_arm = strips.span_fraction <= wingbeat.wrist
    strip_pitch = pitch * twist_factors(wingbeat, strips.span_fraction)
    twist = tip_twist(wingbeat, phase)
    if twist is not None:
        strip_pitch = strip_pitch + twist * strips.span_fraction
    ahead = jnp.full_like(strip_pitch, ahead)
    sweep = sweep_angle(wingbeat, phase)
    sweep_sine, sweep_cosine = (None, None) if sweep is None else (sin(sweep), cos(sweep))
    if sweep is not None:
        ahead = ahead + strips.span_fraction * (length * sweep_sine)
        length = length * sweep_cosine
    return WingShape(
        ahead,
        left + arm * (length * arm_cosine) + hand * (length * hand_cosine),
        above + arm * (length * arm_sine) + hand * (length * hand_sine),
        jnp.where(of_arm, arm_sine, hand_sine),
        jnp.where(of_arm, arm_cosine, hand_cosine),
        strip_pitch,
        sin(strip_pitch),
        cos(strip_pitch),
        sweep_sine,
        sweep_cosine,
    )


def shape_at(vehicle: Vehicle, wingbeat: Wingbeat, strips: Strips, phase: Phases) -> WingShape:
    """Place the strips at a phase of the prescribed wingbeat. Theory: equation ``strip-place``."""
    flap, pitch = flap_angle(wingbeat, phase), pitch_angle(wingbeat, phase)
    return wing_shape(vehicle, wingbeat, strips, phase, flap, pitch)


def mass_points(shape: WingShape, strips: Strips) -> Triple:
    """Return the mass points in stroke axes [m], three components of shape (2, N, ...).

    Each has half the mass of its strip. Two points at mid-chord +- c/(2 sqrt 3) have the second moment of a uniform
    strip.

    Theory: equation ``mass-points``.
    """
    offsets = jnp.stack([strips.chord * (-0.25 + half / math.sqrt(3)) for half in (0.5, -0.5)])
    x, y, z = (place + offsets * fore for place, fore in zip(shape.quarter_chord, shape.chordwise, strict=True))
    return x, y, z


def time_rates(function: Callable[[Any], Any], phase: Phases, frequency: Scalar) -> tuple[Any, Any, Any]:
    """Return a function of phase with its first and second time derivatives, by automatic differentiation.

    Theory: equations ``phase`` and ``flap-vector-rates``.

    Parameters
    ----------
    function : of phases; returns any pytree.
    phase : phases, shape (...).
    frequency : [Hz].
    """
    one = jnp.ones_like(phase)

    def rate(at: Any) -> tuple[Any, Any]:
        return jax.jvp(function, (at,), (one,))

    # Derivatives are by phase first. The frequency only scales them, so a derivative by the frequency does not
    # differentiate the function.
    (value, first), (_, second) = jax.jvp(rate, (phase,), (one,))

    def scaled(tree: Any, factor: Any) -> Any:
        return jax.tree_util.tree_map(lambda a: a * factor, tree)

    return value, scaled(first, frequency), scaled(second, frequency * frequency)


def wing_motion(
    vehicle: Vehicle,
    wingbeat: Wingbeat,
    phase: Phases,
    count: int,
    vector: int = 1,
    along_span: bool = False,
    unsteady: bool = False,
) -> WingMotion:
    """Tabulate the wing's motion at given phases in one pass, as air loads and body dynamics need it.

    Theory: equations ``wing-moments`` and ``rod-moment``.

    Parameters
    ----------
    vehicle, wingbeat : the wing and how it beats.
    phase : phases, shape (...).
    count : number of strips, N.
    vector : pads the strips to a multiple of this number.
    along_span : whether to add the motion along the span.
    unsteady : whether to add the unsteady loads.
    """
    phase = jnp.asarray(phase, dtype=float)
    strips = with_time_axes(padded(strips_of(vehicle.wing, count), vector), phase)

    def strip_places(at: Phases) -> tuple[WingShape, Pair, Pair]:
        """Return the shape, and in-plane components of mid-chords and of vectors from there to the leading edge."""
        shape = shape_at(vehicle, wingbeat, strips, at)
        fore = shape.chordwise[0], shape.chordwise[2]
        quarter = 0.25 * strips.chord
        return shape, (shape.ahead - quarter * fore[0], shape.above - quarter * fore[1]), fore

    (shape, place, fore), rates, accelerations = time_rates(strip_places, phase, wingbeat.frequency)
    (shape_rate, speed, fore_rate), (shape_second, acceleration, fore_acceleration) = rates, accelerations

    # The mass of a strip is spread along its chord: its second moment about mid-chord is that of a uniform rod.
    mass, gyration = 2.0 * strips.mass, strips.chord * strips.chord / 12.0

    second = dot(place, place) + gyration * dot(fore, fore)
    half_rate = dot(place, speed) + gyration * dot(fore, fore_rate)
    turning = dot(quarter_turn(place), acceleration) + gyration * dot(quarter_turn(fore), fore_acceleration)
    sums = mass_moments(mass, (*place, *speed, *acceleration, second, half_rate, turning))

    width = vehicle.wing.semi_span / count * span_ratio(wingbeat, phase)
    chord = air_chord(wingbeat, strips.chord, phase)
    swept = shape.sweep_sine is not None
    steady = at_default(wingbeat, "stroke_plane_tilt")
    tilt = tail_tilt(vehicle, wingbeat)
    span = None
    if along_span:
        x, y, z = (jnp.broadcast_to(part, shape.pitch.shape) for part in shape.spanwise)
        span = x, y, z
    loads = None
    if unsteady:
        moved = strip_motion(shape, shape_rate, shape_second, chord)
        loads = unsteady_loads_on_body(moved, chord, width)
    return WingMotion(
        ahead=shape.ahead if swept else shape.ahead[0],
        above=shape.above,
        flapping_speed=shape_rate.above * shape.flap_cosine - shape_rate.left * shape.flap_sine,
        flap_cosine=shape.flap_cosine,
        pitch=shape.pitch,
        area=width * chord,
        width=width,
        first_moment=(sums[0], sums[1]),
        first_moment_rate=(sums[2], sums[3]),
        first_moment_acceleration=(sums[4], sums[5]),
        inertia=sums[6],
        inertia_rate=2.0 * sums[7],
        acceleration_moment=sums[8],
        unpitched=(jnp.broadcast_to(shape.unpitched[0], shape.pitch.shape), shape.unpitched[2]) if swept else None,
        sweeping_speed=dot(shape_rate.quarter_chord, shape.unpitched) if swept else None,
        tilt=None if steady else jnp.broadcast_to(wingbeat.stroke_plane_tilt, phase.shape),
        span=None if span is None else (span[0], span[2]),
        spanwise_speed=None if span is None else dot(shape_rate.quarter_chord, span),
        unsteady=loads,
        tail_tilt=None if tilt is None else jnp.broadcast_to(tilt, phase.shape),
    )
