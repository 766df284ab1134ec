"""Where the wingbeat puts the strips of a wing: frames, constant numbers, places, and their rates in time.

World: x forward, y left, z up. Body axes: the world's, turned by the body pitch (nose-up positive). Stroke axes:
body axes turned further, until the third axis lies in the stroke plane, in which the wings flap and retract. Stroke
axes turn with the body. All these turns are in the plane of symmetry. Vectors in this plane are pairs (forward,
up), others are triples (forward, left, up). Components are separate arrays because XLA, JAX's compiler, works along
the last axis on a CPU, and an axis of three is short. Strips are the first axis and times the last.
"""

from __future__ import annotations

import functools
import math
import operator
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from wingbeat._jax.arrays import at_default, cos, jax, jnp, sin, unchecked
from wingbeat._jax.exported import exported
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
from wingbeat.animal.pitch_hinge import HeldHinge
from wingbeat.animal.vehicle import Vehicle, Wing
from wingbeat.mechanics.mass_stations import Strips, from_stations

if TYPE_CHECKING:
    from wingbeat._jax.arrays import (
        Component,
        FlapAngles,
        Pair,
        PerStrip,
        PerStripBroadcast,
        Phases,
        Scalar,
        Sums,
        Triple,
    )


def to_world(attitude: Component, forward: Component, up: Component) -> Pair:
    """Turn a pair from axes pitched nose-up by `attitude` to the world's. Theory: equation ``body-axes``."""
    c, s = cos(attitude), sin(attitude)
    return c * forward - s * up, s * forward + c * up


def from_world(attitude: Component, x: Component, z: Component) -> Pair:
    """Turn a pair from the world's axes to those pitched nose-up by `attitude`. Theory: equation ``body-axes``."""
    c, s = cos(attitude), sin(attitude)
    return c * x + s * z, c * z - s * x


def stroke_pitch(stroke_plane_angle: Component) -> Component:
    """Return the nose-up pitch of stroke axes relative to body axes [rad]; 0 for a vertical stroke plane.

    The first stroke axis is ``e_c0 = (sin beta, 0, cos beta)``; the third is ``d_up = (-cos beta, 0, sin beta)``.

    Theory: equation ``stroke-axes``.
    """
    return 0.5 * math.pi - stroke_plane_angle


def quarter_turn(pair: Pair) -> Pair:
    """Turn an in-plane vector nose-up by a right angle. Theory: equation ``quarter-turn``."""
    return -pair[1], pair[0]


def dot(a: Pair | Triple, b: Pair | Triple) -> Component:
    """Return the scalar product of two in-plane vectors or of two vectors in space."""
    products = [one * other for one, other in zip(a, b, strict=True)]
    return sum(products[1:], products[0])


def sum_over_strips(a: PerStrip) -> Phases:
    """Return the sum over the strips; few are added one by one, because XLA can vectorise this on a CPU."""
    if a.shape[0] > 32:
        return jnp.sum(a, axis=0)
    return functools.reduce(operator.add, [a[i] for i in range(a.shape[0])])


def mass_moments(mass: PerStripBroadcast | float, rows: Sequence[PerStrip]) -> Sums:
    """Return the sums over the strips of each row times the strips' mass, shape (rows, ...)."""
    # A single sum for all rows compiles in a third of the time that one sum per row needs.
    return sum_over_strips(jnp.stack([mass * row for row in rows], axis=1))


class WingShape(NamedTuple):
    """Where the strips of the left wing are, in stroke axes, arrays of shape (N, ...).

    Flap turns a strip about the first axis. Sweep then turns the strip's span forward, in the plane of that
    axis and the span. Pitch turns the strip about its own span, which runs along the quarter chords.

    Theory: equation ``flap-vectors``.
    """

    # Position of the quarter chord relative to the body's centre of mass [m].
    ahead: PerStripBroadcast
    left: PerStripBroadcast
    above: PerStripBroadcast
    flap_sine: PerStripBroadcast
    flap_cosine: PerStripBroadcast
    pitch: PerStripBroadcast  # [rad]
    pitch_sine: PerStripBroadcast
    pitch_cosine: PerStripBroadcast
    sweep_sine: Phases | None = None  # None for a wing without sweep
    sweep_cosine: Phases | None = None

    @property
    def quarter_chord(self) -> Triple:
        """Position of the quarter chord, forward, left and up [m]."""
        return self.ahead, self.left, self.above

    @property
    def unpitched(self) -> Triple:
        """Unit vector along the chord of the unpitched strip. Theory: equation ``strip-axes``."""
        if self.sweep_sine is None:
            return 1.0, 0.0, 0.0
        inward = -self.sweep_sine
        return self.sweep_cosine, inward * self.flap_cosine, inward * self.flap_sine

    @property
    def spanwise(self) -> Triple:
        """Unit vector towards the tip. Theory: equation ``strip-axes``."""
        if self.sweep_sine is None:
            return jnp.zeros_like(self.flap_sine), self.flap_cosine, self.flap_sine
        return self.sweep_sine, self.sweep_cosine * self.flap_cosine, self.sweep_cosine * self.flap_sine

    @property
    def chordwise(self) -> Triple:
        """Unit vector to the leading edge. Theory: equation ``strip-axes``."""
        if self.sweep_sine is not None:
            return self._pitched(self.pitch_cosine, self.pitch_sine)
        return self.pitch_cosine, -self.pitch_sine * self.flap_sine, self.pitch_sine * self.flap_cosine

    @property
    def normal(self) -> Triple:
        """Unit vector normal to chord and span, up at rest.

        Theory: equation ``strip-axes``.
        """
        if self.sweep_sine is not None:
            return self._pitched(-self.pitch_sine, self.pitch_cosine)
        return -self.pitch_sine, -self.pitch_cosine * self.flap_sine, self.pitch_cosine * self.flap_cosine

    def _pitched(self, along: PerStripBroadcast, across: PerStripBroadcast) -> Triple:
        """Return the vector with these components along the unpitched strip's chord and normal."""
        forward, left, up = self.unpitched
        return along * forward, along * left - across * self.flap_sine, along * up + across * self.flap_cosine


def strips_of(wing: Wing, count: int) -> Strips:
    """Cut a wing into equal strips, with masses by its law or its table. Theory: equation ``strip-mass``."""
    span_fraction = (jnp.arange(count) + 0.5) / count
    chord = chord_at(wing, span_fraction)
    if wing.mass_stations is not None:
        there = chord_at(wing, jnp.asarray(wing.mass_stations, dtype=float))
        return from_stations(wing, span_fraction, chord, there)
    share = (1.0 - span_fraction) ** wing.mass_exponent
    return Strips(span_fraction, chord, wing.mass * share / jnp.sum(share))


@exported(static=("count",))
def strip_chords(wing: Wing, *, count: int) -> PerStrip:
    """Return the chords of the strips [m], in one program; each operation of its own takes a few ms at first."""
    return strips_of(wing, count).chord


def chord_at(wing: Wing, span_fraction: PerStrip) -> PerStrip:
    """Return the chord [m], linear between the stations of the wing. Theory: equation ``strip-chord``."""
    stations = jnp.atleast_1d(jnp.asarray(wing.chord, dtype=float))
    if stations.size == 1:
        return jnp.broadcast_to(stations, span_fraction.shape)
    return jnp.interp(span_fraction, jnp.linspace(0.0, 1.0, stations.size), stations)


def air_chord(wingbeat: Wingbeat, chord: PerStripBroadcast, phase: Phases) -> PerStripBroadcast:
    """Return the chord that meets the air [m]: full chord times chord law. Theory: equation ``chord-law``."""
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


def padded(strips: Strips, vector: int) -> Strips:
    """Return the strips, padded to a multiple of `vector` with strips without chord and mass."""
    # At a single time, XLA on CPU vectorises along the strips; left-over strips cost more than a full vector.
    more = (0, -strips.span_fraction.size % vector)
    empty = jax.tree_util.tree_map(lambda a: jnp.pad(a, more), strips)
    return empty._replace(span_fraction=jnp.pad(strips.span_fraction, more, "edge"))


def with_time_axes(strips: Strips, phase: Phases) -> Strips:
    """Return the strips with an axis of length one for each axis of `phase`."""
    return jax.tree_util.tree_map(lambda a: jnp.expand_dims(a, tuple(range(1, 1 + jnp.ndim(phase)))), strips)


def twist_factors(wingbeat: Wingbeat, span_fraction: PerStripBroadcast) -> PerStripBroadcast:
    """Return each strip's pitch over the root's, without the twist law. Theory: equation ``strip-angles``."""
    return 1.0 + (wingbeat.twist_ratio - 1.0) * span_fraction


def wing_shape(
    vehicle: Vehicle, wingbeat: Wingbeat, strips: Strips, phase: Phases, flap: Phases, pitch: Phases
) -> WingShape:
    """Place the left wing's strips at given flap and pitch angles; the phase gives span, fold, sweep and twist.

    Theory: equations ``strip-angles``, ``shoulder-place`` and ``strip-place``.
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
    shape = WingShape(
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
    return _about_axis(wing, strips, shape)


def _about_axis(wing: Wing, strips: Strips, shape: WingShape) -> WingShape:
    """Return a shape with its quarter chords, given one with the pitch axis in their place."""
    if at_default(wing, "pitch_axis"):
        return shape
    away = (wing.pitch_axis - 0.25) * strips.chord
    x, y, z = (place + away * fore for place, fore in zip(shape.quarter_chord, shape.chordwise, strict=True))
    return shape._replace(ahead=x, left=y, above=z)


def mass_behind(wing: Wing, strips: Strips) -> PerStripBroadcast:
    """Return how far the strips' centres of mass are behind the quarter chords [m]. Theory: ``mass-points``."""
    if strips.behind is not None:
        return strips.behind
    return 0.25 * strips.chord if at_default(wing, "mass_axis") else (wing.mass_axis - 0.25) * strips.chord


def mass_gyration(wing: Wing, strips: Strips) -> PerStripBroadcast:
    """Return the strips' radius of gyration squared [m2]. Theory: equation ``mass-points``."""
    if strips.gyration is not None:
        return strips.gyration
    chord = strips.chord
    if at_default(wing, "mass_gyration"):
        return chord * chord / 12.0
    return wing.mass_gyration * wing.mass_gyration * (chord * chord)


def shape_at(vehicle: Vehicle, wingbeat: Wingbeat, strips: Strips, phase: Phases) -> WingShape:
    """Place the strips at a phase of the prescribed wingbeat. Theory: equation ``strip-place``."""
    flap, pitch = flap_angle(wingbeat, phase), pitch_angle(wingbeat, phase)
    return wing_shape(vehicle, wingbeat, strips, phase, flap, pitch)


def mass_points(wing: Wing, shape: WingShape, strips: Strips) -> Triple:
    """Return the mass points in stroke axes [m], shape (2, N, ...). Theory: equation ``mass-points``."""
    # Two points of half a strip's mass, a radius of gyration from its centre, have its second moment; for a uniform
    # strip, the radius is c/(2 sqrt 3).
    if strips.gyration is not None:
        turns = strips.gyration > 0  # a square root has no derivative at 0
        radius = jnp.where(turns, jnp.sqrt(jnp.where(turns, strips.gyration, 1.0)), 0.0)
        offsets = jnp.stack([side * radius - mass_behind(wing, strips) for side in (1.0, -1.0)])
    elif at_default(wing, "mass_axis") and at_default(wing, "mass_gyration"):
        offsets = jnp.stack([strips.chord * (-0.25 + half / math.sqrt(3)) for half in (0.5, -0.5)])
    else:
        offsets = jnp.stack(
            [strips.chord * (0.25 - wing.mass_axis + side * wing.mass_gyration) for side in (1.0, -1.0)]
        )
    x, y, z = (place + offsets * fore for place, fore in zip(shape.quarter_chord, shape.chordwise, strict=True))
    return x, y, z


def time_rates(function: Callable[[Any], Any], phase: Phases, frequency: Scalar) -> tuple[Any, Any, Any]:
    """Return a function of phase, of any pytree, with its first and second time derivatives.

    Theory: equations ``phase`` and ``flap-vector-rates``.
    """
    one = jnp.ones_like(phase)

    def rate(at: Any) -> tuple[Any, Any]:
        return jax.jvp(function, (at,), (one,))

    # Derivatives are by phase first. The frequency only scales them, so a derivative by the frequency does not
    # differentiate the function.
    (value, first), (_, second) = jax.jvp(rate, (phase,), (one,))
    first = jax.tree_util.tree_map(lambda a: a * frequency, first)
    squared = frequency * frequency
    return value, first, jax.tree_util.tree_map(lambda a: a * squared, second)


# --- a wing whose pitch is a state: what depends on time alone is tabulated once, and turned in every step ---


class UnturnedShapes(NamedTuple):
    """Shapes with the hinge at 0 and the pitch axis in place of the quarter chords, and their rates in time."""

    shape: WingShape
    rate: WingShape
    second: WingShape


def unturned_shapes(vehicle: Vehicle, wingbeat: Wingbeat, strips: Strips, phase: Phases) -> UnturnedShapes:
    """Tabulate them at phases; the wingbeat's hinge is held at 0."""
    # A wing about the default axis has the axis in place of the quarter chord.
    about = unchecked(Wing, {n: v for n, v in vars(vehicle.wing).items() if n != "pitch_axis"} | _AXIS)
    plain = unchecked(Vehicle, vars(vehicle) | {"wing": about})

    def at(when: Phases) -> WingShape:
        return shape_at(plain, wingbeat, strips, when)._replace(pitch_sine=None, pitch_cosine=None)

    return UnturnedShapes(*time_rates(at, phase, wingbeat.frequency))


_AXIS = {"pitch_axis": Wing.pitch_axis}


def giving_share(wingbeat: Wingbeat, span_fraction: PerStripBroadcast) -> PerStripBroadcast:
    """Return each strip's pitch per angle of a hinge that gives way. Theory: equation ``hinge-torque``."""
    held = wingbeat.pitch_hinge
    assert isinstance(held, HeldHinge)
    twisted = held.hinge.twist_share
    return (1.0 - twisted) * twist_factors(wingbeat, span_fraction) + twisted * span_fraction


def turned(wing: Wing, strips: Strips, shape: WingShape, turn: PerStrip) -> WingShape:
    """Return an unturned shape with its strips pitched further. Theory: equation ``strip-place``."""
    pitch = shape.pitch + turn
    pitched = shape._replace(pitch=pitch, pitch_sine=sin(pitch), pitch_cosine=cos(pitch))
    return _about_axis(wing, strips, pitched)


def turned_in_time(
    made: Callable[[WingShape], Any],
    wing: Wing,
    strips: Strips,
    shapes: UnturnedShapes,
    turn: PerStrip,
    turn_rate: PerStrip,
) -> tuple[Any, Any, Any]:
    """Return what is made of the turned shape, with its first and second time derivatives at a steady turn rate."""

    def now(shape: WingShape, angle: PerStrip) -> Any:
        return made(turned(wing, strips, shape, angle))

    def both(shape: WingShape, angle: PerStrip, rate: WingShape, angle_rate: PerStrip) -> tuple[Any, Any]:
        return jax.jvp(now, (shape, angle), (rate, angle_rate))

    at, along = (shapes.shape, turn, shapes.rate, turn_rate), (shapes.rate, turn_rate, shapes.second)
    (value, first), (_, second) = jax.jvp(both, at, (*along, jnp.zeros_like(turn_rate)))
    return value, first, second


# --- how far the wing is to the side of the plane of symmetry: the body pitches about the lateral axis, so this
# depends on the prescribed wingbeat and never on the flight ---

# Chordwise place of the leading and the trailing edge from the quarter chord, in chords.
LEADING, TRAILING = 0.25, -0.75


@exported(static=("count",))
def lateral_corners(
    vehicle: Vehicle, wingbeat: Wingbeat, phase: Phases, *, count: int
) -> tuple[PerStrip, PerStrip]:
    """Return how far leading and trailing corners are to the left [m], inner ones first, shape (2 N, K) each.

    Theory: equation ``strip-corners``.
    """
    strips = with_time_axes(strips_of(vehicle.wing, count), phase)
    shape = shape_at(vehicle, wingbeat, strips, phase)
    half, chord = _half_width(vehicle, wingbeat, shape, phase, count), air_chord(wingbeat, strips.chord, phase)
    edges = (_edge(shape, chord, share) for share in (LEADING, TRAILING))
    leading, trailing = (jnp.concatenate([edge - half, edge + half]) for edge in edges)
    return leading, trailing


def lateral_corner(
    vehicle: Vehicle, wingbeat: Wingbeat, strips: Strips, share: Phases, side: Phases, phase: Phases, count: int
) -> Phases:
    """Return the distance of given corners to the left [m], each at its own phase; all arrays have shape (K,).

    `share` is `LEADING` or `TRAILING`; `side` is -1 for an inner corner, 1 for an outer one.
    """
    shape = shape_at(vehicle, wingbeat, strips, phase)
    edge = _edge(shape, air_chord(wingbeat, strips.chord, phase), share)
    return edge + side * _half_width(vehicle, wingbeat, shape, phase, count)


def _edge(shape: WingShape, chord: PerStripBroadcast, share: Component) -> PerStripBroadcast:
    return shape.left + share * chord * shape.chordwise[1]


def _half_width(
    vehicle: Vehicle, wingbeat: Wingbeat, shape: WingShape, phase: Phases, count: int
) -> PerStripBroadcast:
    chordwise, normal = shape.chordwise, shape.normal
    width = vehicle.wing.semi_span / count * span_ratio(wingbeat, phase)
    return 0.5 * width * (normal[2] * chordwise[0] - normal[0] * chordwise[2])


def has_room(vehicle: Vehicle) -> bool:
    """Return whether the shoulder is off the plane of symmetry, so that a pitching root can stay on its side."""
    # If not, some corner of the root crosses the plane in any stroke. The wing then counts as on its side if
    # neither arm nor hand flaps by more than a right angle.
    return bool(vehicle.wing.shoulder[1] != 0.0)


@exported
def flap_angles(wingbeat: Wingbeat, phase: Phases) -> FlapAngles:
    """Return the flap angles of arm and hand, up positive [rad], shape (2, K)."""
    flap = flap_angle(wingbeat, phase)
    return jnp.stack([flap, flap - fold_angle(wingbeat, phase)])
