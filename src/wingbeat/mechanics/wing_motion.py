"""The wing's motion in stroke axes, which depends on time alone: strips, mass points and their rates.

Everything here is for the left wing; sums over mass points count both wings. Strips are the first axis and times
the last, because XLA on CPU works along the last axis, and strips are few.
"""

from __future__ import annotations

import functools
import math
import operator
from collections.abc import Sequence
from typing import Any, NamedTuple

from wingbeat._jax.config import at_default, jax, jnp
from wingbeat._jax.elementary import cos, sin
from wingbeat.kinematics import Wingbeat, flap_angle, fold_angle, pitch_angle, span_ratio, sweep_angle
from wingbeat.mechanics.frames import Pair, Triple, from_world, stroke_pitch
from wingbeat.vehicle import Vehicle, Wing

_FEW = 32


class Strips(NamedTuple):
    """What of the strips does not change with time, shape (N,) each, or (N, 1, ..) beside as many axes of time."""

    span_fraction: Any
    chord: Any
    mass: Any


class WingShape(NamedTuple):
    """Where the strips of the left wing are, stroke axes, arrays of shape (N, ...).

    ``ahead``, ``left`` and ``above`` place the quarter chord from the body's centre of mass. Flap turns a strip
    about the first axis, sweep then turns its span forward in the plane of that axis and the span, and pitch turns
    it about its own span, which runs along the quarter chords. Without sweep its sine and cosine are None.
    """

    ahead: Any
    left: Any
    above: Any
    flap_sine: Any
    flap_cosine: Any
    pitch: Any
    pitch_sine: Any
    pitch_cosine: Any
    sweep_sine: Any = None
    sweep_cosine: Any = None

    @property
    def place(self) -> Triple:
        """Where the quarter chord is."""
        return self.ahead, self.left, self.above

    @property
    def level(self) -> Triple:
        """Unit vector that is chordwise where the wing is not pitched."""
        if self.sweep_sine is None:
            return 1.0, 0.0, 0.0
        inward = -self.sweep_sine
        return self.sweep_cosine, inward * self.flap_cosine, inward * self.flap_sine

    @property
    def spanwise(self) -> Triple:
        """Unit vector towards the tip."""
        if self.sweep_sine is None:
            return jnp.zeros_like(self.flap_sine), self.flap_cosine, self.flap_sine
        return self.sweep_sine, self.sweep_cosine * self.flap_cosine, self.sweep_cosine * self.flap_sine

    @property
    def chordwise(self) -> Triple:
        """Unit vector to the leading edge."""
        if self.sweep_sine is not None:
            return self._pitched(self.pitch_cosine, self.pitch_sine)
        return self.pitch_cosine, -self.pitch_sine * self.flap_sine, self.pitch_sine * self.flap_cosine

    @property
    def normal(self) -> Triple:
        """Unit vector normal to chord and span, up at rest."""
        if self.sweep_sine is not None:
            return self._pitched(-self.pitch_sine, self.pitch_cosine)
        return -self.pitch_sine, -self.pitch_cosine * self.flap_sine, self.pitch_cosine * self.flap_cosine

    def _pitched(self, along: Any, across: Any) -> Triple:
        """Return the vector of these parts along the unpitched chord and along the normal without pitch."""
        forward, left, up = self.level
        return along * forward, along * left - across * self.flap_sine, along * up + across * self.flap_cosine


class WingMotion(NamedTuple):
    """What body and air feel of the wing, stroke axes, with any trailing axes of times.

    For air loads, by strip: the quarter chord's place (``ahead`` of all strips alike, ``above``), its speed
    ``flapping_speed`` along the normal that the strip has without pitch, the cosine of the strip's flap angle,
    its pitch and its area; ``width`` is that of all strips alike. Pitch turns a strip about its quarter chord and
    so changes no speed.
    Where the wing sweeps, ``ahead`` is by strip, and the unpitched chord is no longer the first axis: ``level`` is
    what it is in the plane of symmetry, ``sweeping_speed`` the quarter chord's speed along it. ``tilt`` is that of
    the stroke plane. Where loads go with the whole airspeed, ``span`` is the unit vector along the span in the
    plane of symmetry, ``spanning_speed`` the quarter chord's speed along it. All five are None where there is none.
    For the balance, sums over the mass of both wings: ``first_moment`` and ``inertia`` of mass times place and
    mass times place squared, ``swirl`` of mass times (place turned by a right angle) . acceleration.
    """

    ahead: Any
    above: Any
    flapping_speed: Any
    flap_cosine: Any
    pitch: Any
    area: Any
    width: Any
    first_moment: Pair
    first_moment_rate: Pair
    first_moment_acceleration: Pair
    inertia: Any
    inertia_rate: Any
    swirl: Any
    level: Pair | None = None
    sweeping_speed: Any = None
    tilt: Any = None
    span: Pair | None = None
    spanning_speed: Any = None


def strips_of(wing: Wing, count: int) -> Strips:
    """Cut a wing into `count` equal strips: span fractions, chords at strip centres [m], strip masses [kg].

    A strip's mass is proportional to ``(1 - s/L)**p``, normalised to the mass of the wing.
    """
    span_fraction = (jnp.arange(count) + 0.5) / count
    stations = jnp.atleast_1d(jnp.asarray(wing.chord, dtype=float))
    if stations.size == 1:
        chord = jnp.broadcast_to(stations, (count,))
    else:
        chord = jnp.interp(span_fraction, jnp.linspace(0.0, 1.0, stations.size), stations)
    share = (1.0 - span_fraction) ** wing.mass_exponent
    return Strips(span_fraction, chord, wing.mass * share / jnp.sum(share))


def stroke_plane(wing: Wing, wingbeat: Wingbeat) -> Any:
    """Return the angle of the stroke plane from the body axis [rad]."""
    if at_default(wingbeat, "stroke_plane_tilt"):
        return wing.stroke_plane_angle
    return wing.stroke_plane_angle + wingbeat.stroke_plane_tilt


def stroke_attitude(wing: Wing, motion: WingMotion, body_pitch: Any) -> Any:
    """Return how far stroke axes are pitched nose-up from the world's [rad]."""
    attitude = body_pitch + stroke_pitch(wing.stroke_plane_angle)
    return attitude if motion.tilt is None else attitude - motion.tilt


def filled_up(strips: Strips, vector: int) -> Strips:
    """Return the strips and, at the last one's place, some without chord and mass, in all a multiple of `vector`.

    At a single time XLA on CPU works along the strips, and a few left over cost it more than a whole vector.
    """
    more = (0, -strips.span_fraction.size % vector)
    return Strips(
        jnp.pad(strips.span_fraction, more, "edge"), jnp.pad(strips.chord, more), jnp.pad(strips.mass, more)
    )


def beside(strips: Strips, times: Any) -> Strips:
    """Return the strips with an axis of length one for each axis of `times`."""
    return Strips(*(jnp.expand_dims(a, tuple(range(1, 1 + jnp.ndim(times)))) for a in strips))


def twist_factors(wingbeat: Wingbeat, span_fraction: Any) -> Any:
    """Return each strip's wing pitch over that of the root, ``1 + (twist_ratio - 1) s/L``."""
    return 1.0 + (wingbeat.twist_ratio - 1.0) * span_fraction


def wing_shape(
    vehicle: Vehicle, wingbeat: Wingbeat, strips: Strips, phase: Any, flap: Any, pitch: Any
) -> WingShape:
    """Place the strips for given flap and root pitch [rad]; span and fold follow the phase.

    Inboard of the wrist a strip follows the flap angle of the arm, outboard that of the hand.
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


def shape_at(vehicle: Vehicle, wingbeat: Wingbeat, strips: Strips, phase: Any) -> WingShape:
    """Place the strips at a phase of the prescribed wingbeat."""
    flap, pitch = flap_angle(wingbeat, phase), pitch_angle(wingbeat, phase)
    return wing_shape(vehicle, wingbeat, strips, phase, flap, pitch)


def mass_points(shape: WingShape, strips: Strips) -> Triple:
    """Return the mass points, stroke axes, a triple of shape (2, N, ...); each carries half its strip's mass.

    Two points at mid-chord +- c/(2 sqrt 3) have the second moment of a uniform strip.
    """
    offsets = jnp.stack([strips.chord * (-0.25 + half / math.sqrt(3)) for half in (0.5, -0.5)])
    x, y, z = (place + offsets * fore for place, fore in zip(shape.place, shape.chordwise, strict=True))
    return x, y, z


def time_rates(function: Any, phase: Any, frequency: Any) -> tuple[Any, Any, Any]:
    """Return a function of phase with its first and second time derivatives, exactly."""
    one = jnp.ones_like(phase)

    def rate(at: Any) -> tuple[Any, Any]:
        return jax.jvp(function, (at,), (one,))

    # By phase first: how the frequency scales the rates is then known without differentiating the function.
    (value, first), (_, second) = jax.jvp(rate, (phase,), (one,))

    def scaled(tree: Any, factor: Any) -> Any:
        return jax.tree_util.tree_map(lambda a: a * factor, tree)

    return value, scaled(first, frequency), scaled(second, frequency * frequency)


def turned(pair: Pair) -> Pair:
    """Turn an in-plane pair nose-up by a right angle."""
    return -pair[1], pair[0]


def over_strips(a: Any) -> Any:
    """Return the sum over the first axis, of few strips as additions, of which XLA on CPU makes vector code."""
    if a.shape[0] > _FEW:
        return jnp.sum(a, axis=0)
    return functools.reduce(operator.add, [a[i] for i in range(a.shape[0])])


def sums_over_strips(mass: Any, rows: Sequence[Any]) -> Any:
    """Return the sums over the strips of each row times the strips' mass; rows come first.

    As one sum they compile in a third of the time of a sum for each.
    """
    return over_strips(jnp.stack([mass * row for row in rows], axis=1))


def dot(a: tuple[Any, ...], b: tuple[Any, ...]) -> Any:
    """Return the scalar product of two pairs or of two triples."""
    products = [one * other for one, other in zip(a, b, strict=True)]
    return sum(products[1:], products[0])


def wing_motion(
    vehicle: Vehicle, wingbeat: Wingbeat, phase: Any, count: int, vector: int = 1, along_span: bool = False
) -> WingMotion:
    """Tabulate what body and air feel of the wing at the given phases, in one pass, strips `filled_up`.

    The motion along the span is in the table only if it is asked for.
    """
    phase = jnp.asarray(phase, dtype=float)
    strips = beside(filled_up(strips_of(vehicle.wing, count), vector), phase)

    def strip_places(at: Any) -> tuple[WingShape, Pair, Pair]:
        """Return the shape and, in the plane of symmetry, mid-chords and vectors to the leading edge."""
        shape = shape_at(vehicle, wingbeat, strips, at)
        fore = shape.chordwise[0], shape.chordwise[2]
        quarter = 0.25 * strips.chord
        return shape, (shape.ahead - quarter * fore[0], shape.above - quarter * fore[1]), fore

    here, rates, pushes = time_rates(strip_places, phase, wingbeat.frequency)
    (shape, place, fore), (shape_rate, speed, fore_speed), (_, push, fore_push) = here, rates, pushes

    # The mass of a strip is spread along its chord: its second moment about mid-chord is that of a uniform rod.
    mass, spread = 2.0 * strips.mass, strips.chord * strips.chord / 12.0

    second = dot(place, place) + spread * dot(fore, fore)
    half_rate = dot(place, speed) + spread * dot(fore, fore_speed)
    swirl = dot(turned(place), push) + spread * dot(turned(fore), fore_push)
    sums = sums_over_strips(mass, (*place, *speed, *push, second, half_rate, swirl))

    width = vehicle.wing.semi_span / count * span_ratio(wingbeat, phase)
    swept = shape.sweep_sine is not None
    steady = at_default(wingbeat, "stroke_plane_tilt")
    span = tuple(jnp.broadcast_to(part, shape.pitch.shape) for part in shape.spanwise) if along_span else None
    return WingMotion(
        ahead=shape.ahead if swept else shape.ahead[0],
        above=shape.above,
        flapping_speed=shape_rate.above * shape.flap_cosine - shape_rate.left * shape.flap_sine,
        flap_cosine=shape.flap_cosine,
        pitch=shape.pitch,
        area=width * strips.chord,
        width=width,
        first_moment=(sums[0], sums[1]),
        first_moment_rate=(sums[2], sums[3]),
        first_moment_acceleration=(sums[4], sums[5]),
        inertia=sums[6],
        inertia_rate=2.0 * sums[7],
        swirl=sums[8],
        level=(jnp.broadcast_to(shape.level[0], shape.pitch.shape), shape.level[2]) if swept else None,
        sweeping_speed=dot(shape_rate.place, shape.level) if swept else None,
        tilt=None if steady else jnp.broadcast_to(wingbeat.stroke_plane_tilt, phase.shape),
        span=None if span is None else (span[0], span[2]),
        spanning_speed=None if span is None else dot(shape_rate.place, span),
    )
