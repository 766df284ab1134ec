"""The wing's motion in stroke axes, which depends on time alone: a table for air loads and body dynamics.

Everything here is for the left wing; sums over mass points count both wings.

The unsteady loads (rotation, added mass and couples of a thin aerofoil, `wingbeat.aero.closed_forms`) are at most
products of two speeds, each linear in the body's motion through the air in stroke axes, ``xi = (V_x, V_z, psi')``,
with factors that the wing's own motion sets. So the load on a motion is ``-rho (A . a + B . xi + C + psi' (D . xi +
E))``, where a is the acceleration of the body. A to E are tabulated like the moments of the wing's mass; only the
couple against the turning of the chord needs the airspeed of each strip.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

from wingbeat._jax.arrays import at_default, computed_once, jax, jnp
from wingbeat.aero.closed_forms import added_inertia, added_mass, damping_couple, rotation_lift
from wingbeat.animal.kinematics import Wingbeat, span_ratio
from wingbeat.animal.pitch_hinge import HeldHinge
from wingbeat.animal.vehicle import Vehicle, Wing
from wingbeat.mechanics.wing_shape import (
    Strips,
    UnturnedShapes,
    WingShape,
    air_chord,
    dot,
    giving_share,
    mass_behind,
    mass_gyration,
    mass_moments,
    padded,
    quarter_turn,
    shape_at,
    strips_of,
    stroke_pitch,
    sum_over_strips,
    tail_tilt,
    time_rates,
    turned_in_time,
    with_time_axes,
)

if TYPE_CHECKING:
    from wingbeat._jax.arrays import (
        ByBodyMotion,
        Pair,
        PerStrip,
        PerStripBroadcast,
        PerStripOrNone,
        Phases,
        Scalar,
        Triple,
        TripleOrNone,
    )


class WingMotion(NamedTuple):
    """The wing's motion in stroke axes, as air loads and body dynamics need it; any axes of times come last.

    Speeds are those of the quarter chord. Pitch turns a strip about its quarter chord and does not change these
    speeds. Sums over mass points count both wings.
    """

    ahead: Phases | PerStrip  # of the quarter chord [m]; it has no axis of strips unless the wing sweeps
    above: PerStrip  # [m]
    flapping_speed: PerStrip  # along the normal of the unpitched strip [m/s]
    flap_cosine: PerStrip
    pitch: PerStrip  # [rad]
    area: PerStrip  # [m2]
    width: Phases  # of a strip along the span [m]
    first_moment: Pair  # sum of mass times position, forward and up [kg m]
    first_moment_rate: Pair
    first_moment_acceleration: Pair
    inertia: Phases  # sum of mass times position squared [kg m2]
    inertia_rate: Phases
    acceleration_moment: Phases  # sum of mass times (position turned by a right angle) . acceleration [N m]
    # Unit vector along the unpitched chord in the plane of symmetry, and speed along it; None if it never sweeps.
    unpitched: Pair | None = None
    sweeping_speed: PerStrip | None = None
    tilt: Phases | None = None  # of the stroke plane [rad]; None if 0
    span: Pair | None = None  # as `unpitched`, along the span; None unless loads depend on the full airspeed
    spanwise_speed: PerStrip | None = None
    unsteady: tuple[UnsteadyLoad, UnsteadyLoad, UnsteadyLoad] | None = None  # on the body, forward, up and nose-up
    tail_tilt: Phases | None = None  # added to the tail's incidence [rad]; None if 0
    chords: ChordMotion | None = None  # None unless loads depend on the wake


class ChordMotion(NamedTuple):
    """Directions and turning rates of the strips' chords."""

    cosine: PerStrip  # of the pitch
    sine: PerStrip
    turning: PerStrip | None  # by the wing's own motion [rad/s]; None unless strips shed what their turning sets
    turning_by_spin: PerStrip | None  # by that of the body, per pitch rate


def stroke_attitude(wing: Wing, motion: WingMotion, body_pitch: Phases) -> Phases:
    """Return the nose-up pitch of stroke axes in the world [rad]. Theory: equation ``stroke-attitude``."""
    attitude = body_pitch + stroke_pitch(wing.stroke_plane_angle)
    return attitude if motion.tilt is None else attitude - motion.tilt


def wing_motion(
    vehicle: Vehicle,
    wingbeat: Wingbeat,
    phase: Phases,
    count: int,
    vector: int = 1,
    along_span: bool = False,
    unsteady: bool = False,
    wake: bool = False,
    shapes: UnturnedShapes | None = None,
) -> WingMotion:
    """Tabulate the wing's motion at given phases in one pass; the strips are padded to a multiple of `vector`.

    With a hinge that is held at the phases, `shapes` saves computing what does not depend on its motion.

    Theory: equations ``wing-moments`` and ``rod-moment``.
    """
    phase = jnp.asarray(phase, dtype=float)
    strips = with_time_axes(padded(strips_of(vehicle.wing, count), vector), phase)

    def places_of(shape: WingShape) -> tuple[WingShape, Pair, Pair]:
        # The shape, and in-plane components of the centres of mass and of vectors from there to the leading edge.
        fore = shape.chordwise[0], shape.chordwise[2]
        behind = mass_behind(vehicle.wing, strips)
        return shape, (shape.ahead - behind * fore[0], shape.above - behind * fore[1]), fore

    def strip_places(at: Phases) -> tuple[WingShape, Pair, Pair]:
        return places_of(shape_at(vehicle, wingbeat, strips, at))

    if shapes is None:
        in_time = time_rates(strip_places, phase, wingbeat.frequency)
    else:
        in_time = turned_by_hinge(places_of, vehicle.wing, wingbeat, strips, shapes)
    (shape, place, fore), rates, accelerations = in_time
    (shape_rate, speed, fore_rate), (shape_second, acceleration, fore_acceleration) = rates, accelerations

    # The mass of a strip is spread along its chord about its centre.
    mass, gyration = 2.0 * strips.mass, mass_gyration(vehicle.wing, strips)
    second = dot(place, place) + gyration * dot(fore, fore)
    half_rate = dot(place, speed) + gyration * dot(fore, fore_rate)
    turning = dot(quarter_turn(place), acceleration) + gyration * dot(quarter_turn(fore), fore_acceleration)
    sums = mass_moments(mass, (*place, *speed, *acceleration, second, half_rate, turning))
    width = vehicle.wing.semi_span / count * span_ratio(wingbeat, phase)
    chord = air_chord(wingbeat, strips.chord, phase)
    # Whether the quarter chords move along the unpitched chord.
    swept = shape.sweep_sine is not None or not at_default(vehicle.wing, "pitch_axis")
    steady, tilt = at_default(wingbeat, "stroke_plane_tilt"), tail_tilt(vehicle, wingbeat)
    span = loads = chords = moved = None
    if along_span:
        x, y, z = (jnp.broadcast_to(part, shape.pitch.shape) for part in shape.spanwise)
        span = x, y, z
    if unsteady:
        moved = strip_motion(shape, shape_rate, shape_second, chord)
        loads = unsteady_loads_on_body(moved, chord, width)
    if wake:
        turns = (None, None) if moved is None else (moved.speeds[3].turn, moved.speeds[2].turn)
        chords = ChordMotion(shape.pitch_cosine, shape.pitch_sine, *turns)
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
        unpitched=_in_plane(shape) if swept else None,
        sweeping_speed=dot(shape_rate.quarter_chord, shape.unpitched) if swept else None,
        tilt=None if steady else jnp.broadcast_to(wingbeat.stroke_plane_tilt, phase.shape),
        span=None if span is None else (span[0], span[2]),
        spanwise_speed=None if span is None else dot(shape_rate.quarter_chord, span),
        unsteady=loads,
        tail_tilt=None if tilt is None else jnp.broadcast_to(tilt, phase.shape),
        chords=chords,
    )


def turned_by_hinge(
    made: Callable[[WingShape], Any], wing: Wing, wingbeat: Wingbeat, strips: Strips, shapes: UnturnedShapes
) -> tuple[Any, Any, Any]:
    """Return what is made of the shape of a wing with a held hinge, with its first two time derivatives."""
    held = wingbeat.pitch_hinge
    assert isinstance(held, HeldHinge)
    share = giving_share(wingbeat, strips.span_fraction)
    return turned_in_time(made, wing, strips, shapes, share * held.angle, share * held.rate)


def _in_plane(shape: WingShape) -> Pair:
    x, _, z = shape.unpitched
    return jnp.broadcast_to(x, shape.pitch.shape), jnp.broadcast_to(z, shape.pitch.shape)


class StripSpeeds(NamedTuple):
    """Speeds of the strips per unit of a motion; None stands for zero."""

    chord: PerStrip | None  # of the quarter chord, along the chord of the unpitched strip
    normal: PerStrip | None  # of the quarter chord, along the normal of the unpitched strip
    mid: PerStrip  # of the mid-chord, along the normal of the chord
    turn: PerStrip | None  # of the chord about the span, leading edge up


class StripMotion(NamedTuple):
    """How the motions V_x, V_z and psi' of the body and the wing's own move the strips."""

    speeds: tuple[StripSpeeds, ...]
    rates: tuple[tuple[PerStrip, PerStrip | None], ...]  # time derivatives of `mid` and `turn`


def strip_motion(shape: WingShape, rate: WingShape, second: WingShape, chord: PerStripBroadcast) -> StripMotion:
    """Return how the strips move, from the shape and its time derivatives. Theory: equation ``chord-turning``."""
    # Without this, the tangents of every sum over the strips would compute the shape anew, and a flight would take
    # 1.3 times as long.
    shape, rate, second = computed_once((shape, rate, second))
    along, along_rate, along_second = _unpitched(shape, rate, second)
    normal, normal_rate = (None, -shape.flap_sine, shape.flap_cosine), (None, -rate.flap_sine, rate.flap_cosine)
    places = shape.quarter_chord, rate.quarter_chord, second.quarter_chord
    turns = (
        (
            None,
            None,
            _products((normal[2], along[0])),
            _products((1.0, rate.pitch), *zip(normal, along_rate, strict=True)),
        ),
        (
            None,
            None,
            _products((normal_rate[2], along[0]), (normal[2], along_rate[0])),
            _products(
                (1.0, second.pitch),
                *zip(normal_rate, along_rate, strict=True),
                *zip(normal, along_second, strict=True),
            ),
        ),
    )
    speeds, rates = [], []
    for of_chord, of_chord_rate, of_normal, of_normal_rate, turn, turn_rate in zip(
        *_speeds(along, along_rate, places), *_speeds(normal, normal_rate, places), *turns, strict=True
    ):
        mid = mid_speed(shape, of_chord, of_normal, turn, chord)
        across = (
            _products((1.0, of_chord_rate), (rate.pitch, of_normal)),
            _products((1.0, of_normal_rate), (-rate.pitch, of_chord)),
        )
        speeds.append(StripSpeeds(of_chord, of_normal, mid, turn))
        rates.append((mid_speed(shape, *across, turn_rate, chord), turn_rate))
    return computed_once(StripMotion(tuple(speeds), tuple(rates)))


def mid_speed(
    shape: WingShape,
    of_chord: PerStrip | None,
    of_normal: PerStrip | None,
    turn: PerStrip | None,
    chord: PerStripBroadcast,
) -> PerStrip:
    """Return the speed of the mid-chord along the normal of the chord."""
    return _products((shape.pitch_cosine, of_normal), (-shape.pitch_sine, of_chord), (-0.25 * chord, turn))


def _products(*pairs: tuple[PerStripOrNone | float, PerStripOrNone]) -> Any:
    """Return the sum of the products of pairs; None counts as 0, and a sum without terms is None."""
    products = [a * b for a, b in pairs if a is not None and b is not None]
    return sum(products[1:], products[0]) if products else None


def _unpitched(shape: WingShape, rate: WingShape, second: WingShape) -> tuple[TripleOrNone, ...]:
    """Return the unit vector along the unpitched chord, and its first two time derivatives; None means 0."""
    if shape.sweep_sine is None:
        return (jnp.ones_like(shape.pitch), None, None), (None, None, None), (None, None, None)

    def turned(at: WingShape, along: WingShape) -> tuple[Triple, Triple]:
        return jax.jvp(lambda one: one.unpitched, (at,), (along,))

    (chord, chord_rate), (_, chord_second) = jax.jvp(turned, (shape, rate), (rate, second))
    found = chord, chord_rate, chord_second
    return jax.tree_util.tree_map(lambda part: jnp.broadcast_to(part, shape.pitch.shape), found)


def _speeds(axis: TripleOrNone, axis_rate: TripleOrNone, places: tuple[Triple, Triple, Triple]) -> Any:
    """Return speeds along an axis due to V_x, V_z, psi' and the wing's own motion, and their time derivatives."""
    (x, _, z), (x_speed, _, z_speed) = places[:2]
    (x_axis, _, z_axis), (x_rate, _, z_rate) = axis, axis_rate
    return (
        (x_axis, z_axis, _products((z_axis, x), (x_axis, -z)), _products(*zip(axis, places[1], strict=True))),
        (
            x_rate,
            z_rate,
            _products((z_rate, x), (x_rate, -z), (z_axis, x_speed), (x_axis, -z_speed)),
            _products(*zip(axis_rate, places[1], strict=True), *zip(axis, places[2], strict=True)),
        ),
    )


class UnsteadyLoad(NamedTuple):
    """The generalised load of the unsteady terms on one motion of both wings, divided by the density of the air.

    The letters are those of the theory's equation ``unsteady-load``.
    """

    by_acceleration: ByBodyMotion  # A
    by_velocity: ByBodyMotion  # B
    own: Phases  # C, the part due to the wing's own motion
    by_spin: ByBodyMotion  # D
    own_spin: Phases  # E
    damping: PerStrip | None  # factor of each strip's airspeed
    damping_by_spin: PerStrip | None  # factor of each strip's airspeed times the pitch rate

    def load(self, density: Scalar, velocity: Triple, acceleration: Triple | None, airspeed: PerStrip) -> Phases:
        """Return the force of the air, from xi, a and the airspeed. Theory: equation ``unsteady-load``."""

        def of_body(matrix: ByBodyMotion, motion: Triple) -> Phases:
            return dot((matrix[0], matrix[1], matrix[2]), motion)

        spin = velocity[2]
        steady = of_body(self.by_velocity, velocity) + self.own
        turning = of_body(self.by_spin, velocity) + self.own_spin
        resisted = steady + spin * turning
        if acceleration is not None:
            resisted = resisted + of_body(self.by_acceleration, acceleration)
        if self.damping is not None:
            resisted = resisted + sum_over_strips(airspeed * (self.damping + spin * self.damping_by_spin))
        return -density * resisted


class _Row(NamedTuple):
    """The added mass and inertia times the speeds of one motion of the strips, and these speeds."""

    mass: PerStrip
    inertia: PerStrip | None
    speeds: StripSpeeds


def _row(speeds: StripSpeeds, chord: PerStripBroadcast, width: Phases) -> _Row:
    inertia = None if speeds.turn is None else added_inertia(1.0, chord, width) * speeds.turn
    return _Row(added_mass(1.0, chord, width) * speeds.mid, inertia, speeds)


def _rotation(lift: PerStrip, moved: StripSpeeds, speeds: StripSpeeds) -> tuple[PerStrip, Any]:
    """Return the two factors of the work that one motion's rotational lift does on another motion."""
    minus_chord = None if moved.chord is None else -moved.chord
    return lift, _products((moved.normal, speeds.chord), (minus_chord, speeds.normal))


def _work(row: _Row, rates: tuple[PerStrip, PerStripOrNone], lift: PerStrip, moved: StripSpeeds) -> Any:
    """Return the work on a motion of the air's inertia and of the rotational lift that another motion causes."""
    return _products((row.mass, rates[0]), (row.inertia, rates[1]), _rotation(lift, moved, row.speeds))


def _sums(motion: StripMotion, *rows: PerStripOrNone) -> Any:
    zero = jnp.zeros_like(motion.speeds[3].mid)
    return mass_moments(2.0, [zero if row is None else row for row in rows])


def _load(
    row: _Row,
    motion: StripMotion,
    chord: PerStripBroadcast,
    width: Phases,
    by_acceleration: ByBodyMotion,
    by_velocity: ByBodyMotion,
    own: Phases,
    by_spin: ByBodyMotion,
    own_spin: Phases,
) -> UnsteadyLoad:
    """Return the load of a motion from its tables A, B, C, D (without the turning of the axes) and E."""
    # The axes turn with the body: xi' is its acceleration plus psi' (V_z, -V_x, 0).
    turned = jnp.stack([-by_acceleration[1], by_acceleration[0], jnp.zeros_like(by_acceleration[0])])
    turn = row.speeds.turn
    dampings = (
        (None, None)
        if turn is None
        else [
            -2.0 * damping_couple(1.0, chord, width, moved.turn, jnp.ones_like(turn)) * turn
            for moved in (motion.speeds[3], motion.speeds[2])
        ]
    )
    return UnsteadyLoad(by_acceleration, by_velocity, own, by_spin + turned, own_spin, *dampings)


def unsteady_load(
    motion: StripMotion, speeds: StripSpeeds, chord: PerStripBroadcast, width: Phases
) -> UnsteadyLoad:
    """Return the unsteady load on a motion of the strips that has the given `speeds` per unit."""
    row = _row(speeds, chord, width)
    spin, turning = (rotation_lift(1.0, chord, width, moved.turn) for moved in motion.speeds[2:])
    sums = _sums(
        motion,
        *(_products((row.mass, moved.mid), (row.inertia, moved.turn)) for moved in motion.speeds[:3]),
        *(_work(row, rates, turning, moved) for moved, rates in zip(motion.speeds, motion.rates, strict=True)),
        *(_products(_rotation(spin, moved, speeds)) for moved in motion.speeds),
    )
    return _load(row, motion, chord, width, sums[:3], sums[3:6], sums[6], sums[7:10], sums[10])


def inertia_of_air(speeds: StripSpeeds, chord: PerStripBroadcast, width: Phases) -> Phases:
    """Return the air's inertia that a motion of both wings meets, over the density. Theory: ``air-inertia``."""
    row = _row(speeds, chord, width)
    return 2.0 * sum_over_strips(_products((row.mass, speeds.mid), (row.inertia, speeds.turn)))


def unsteady_loads_on_body(
    motion: StripMotion, chord: PerStripBroadcast, width: Phases
) -> tuple[UnsteadyLoad, UnsteadyLoad, UnsteadyLoad]:
    """Return the loads of the unsteady terms on the motions V_x, V_z and psi' of the body.

    A is symmetric, and the part of D without the turning of the axes is antisymmetric, so 24 sums give 33 tables.
    """
    rows = [_row(speeds, chord, width) for speeds in motion.speeds[:3]]
    spin, turning = (rotation_lift(1.0, chord, width, moved.turn) for moved in motion.speeds[2:])
    own, pairs = motion.speeds[3], ((0, 1), (0, 2), (1, 2))
    moves = list(zip(motion.speeds[:3], motion.rates[:3], strict=True))

    def inertia(i: int, j: int) -> Any:
        return _products((rows[i].mass, rows[j].speeds.mid), (rows[i].inertia, rows[j].speeds.turn))

    sums = _sums(
        motion,
        *(inertia(i, i) for i in range(3)),
        *(inertia(i, j) for i, j in pairs),
        *(_products(_rotation(spin, rows[j].speeds, rows[i].speeds)) for i, j in pairs),
        *(_work(row, rates, turning, moved) for row in rows for moved, rates in moves),
        *(_work(row, motion.rates[3], turning, own) for row in rows),
        *(_products(_rotation(spin, own, row.speeds)) for row in rows),
    )
    zero = jnp.zeros_like(sums[0])
    a, (xz, xp, zp), (d_xz, d_xp, d_zp) = sums[:3], sums[3:6], sums[6:9]
    by_acceleration = jnp.stack([a[0], xz, xp]), jnp.stack([xz, a[1], zp]), jnp.stack([xp, zp, a[2]])
    by_spin = jnp.stack([zero, d_xz, d_xp]), jnp.stack([-d_xz, zero, d_zp]), jnp.stack([-d_xp, -d_zp, zero])

    def load(i: int) -> UnsteadyLoad:
        tables = by_acceleration[i], sums[9 + 3 * i : 12 + 3 * i], sums[18 + i], by_spin[i], sums[21 + i]
        return _load(rows[i], motion, chord, width, *tables)

    return load(0), load(1), load(2)
