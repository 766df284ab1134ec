"""The unsteady loads on a motion of the wing, from sums over the strips that depend on time alone.

Rotation, added mass and couples of a thin aerofoil (`wingbeat.aero.closed_forms`) are at most products of two
speeds.
The motion of the body through the air in stroke axes is ``xi = (V_x, V_z, psi')``. Each speed of a strip is linear
in xi, with factors that the wing's own motion sets. So the load on a motion is ``-rho (A . a + B . xi + C +
psi' (D . xi + E))``, where a is the acceleration of the body. A to E are tabulated like the moments of the wing's
mass. Only the couple against the turning of the chord needs the airspeed of each strip.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from wingbeat._jax.arrays import computed_once, jax, jnp
from wingbeat.aero.closed_forms import added_inertia, added_mass, damping_couple, rotation_lift
from wingbeat.mechanics.frames import dot
from wingbeat.mechanics.strip_sums import mass_moments, sum_over_strips
from wingbeat.mechanics.wing_shape import WingShape

if TYPE_CHECKING:
    from wingbeat._jax.arrays import (
        ByBodyMotion,
        PerStrip,
        PerStripBroadcast,
        PerStripOrNone,
        Phases,
        Scalar,
        Triple,
        TripleOrNone,
    )


class StripSpeeds(NamedTuple):
    """Speeds of the strips per unit of a motion; None stands for zero.

    Attributes
    ----------
    chord, normal : of the quarter chord, along the chord and the normal of the unpitched strip.
    mid : of the mid-chord, along the normal of the chord.
    turn : of the chord about the span, leading edge up.
    """

    chord: PerStrip | None
    normal: PerStrip | None
    mid: PerStrip
    turn: PerStrip | None


class StripRates(NamedTuple):
    """Time derivatives of the speeds in `StripSpeeds`, by the same names."""

    mid: PerStrip
    turn: PerStrip | None


class StripMotion(NamedTuple):
    """How the motions V_x, V_z and psi' of the body, and the wing's own motion, move the strips.

    Attributes
    ----------
    speeds, rates : the strips' speeds for each of these four motions, and their time derivatives.
    """

    speeds: tuple[StripSpeeds, ...]
    rates: tuple[StripRates, ...]


def strip_motion(shape: WingShape, rate: WingShape, second: WingShape, chord: PerStripBroadcast) -> StripMotion:
    """Return how the strips move.

    Theory: equation ``chord-turning``.

    Parameters
    ----------
    shape, rate, second : of the wing, and its first and second time derivatives.
    chord : of the strips [m].
    """
    # Without this, the tangents of every sum over the strips would compute the shape anew, and a flight would take
    # 1.3 times as long.
    shape, rate, second = computed_once((shape, rate, second))
    along, along_rate, along_second = _unpitched(shape, rate, second)
    normal, normal_rate = (None, -shape.flap_sine, shape.flap_cosine), (None, -rate.flap_sine, rate.flap_cosine)
    places = shape.quarter_chord, rate.quarter_chord, second.quarter_chord
    turns = (
        (None, None, _products((normal[2], along[0])), _products((1.0, rate.pitch), *_pairs(normal, along_rate))),
        (
            None,
            None,
            _products((normal_rate[2], along[0]), (normal[2], along_rate[0])),
            _products((1.0, second.pitch), *_pairs(normal_rate, along_rate), *_pairs(normal, along_second)),
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
        rates.append(StripRates(mid_speed(shape, *across, turn_rate, chord), turn_rate))
    return computed_once(StripMotion(tuple(speeds), tuple(rates)))


def mid_speed(
    shape: WingShape,
    of_chord: PerStrip | None,
    of_normal: PerStrip | None,
    turn: PerStrip | None,
    chord: PerStripBroadcast,
) -> PerStrip:
    """Return the speed of the mid-chord along the normal of the chord.

    Parameters
    ----------
    shape : gives the pitch.
    of_chord, of_normal, turn : as in `StripSpeeds`.
    chord : of the strips [m].
    """
    found = _products((shape.pitch_cosine, of_normal), (-shape.pitch_sine, of_chord), (-0.25 * chord, turn))
    assert found is not None
    return found


def _products(*pairs: tuple[PerStripOrNone | float, PerStripOrNone]) -> Any:
    """Return the sum of the products of pairs; None counts as 0, and a sum without terms is None."""
    products = [a * b for a, b in pairs if a is not None and b is not None]
    return sum(products[1:], products[0]) if products else None


def _pairs(one: TripleOrNone, other: TripleOrNone) -> Any:
    """Return the pairs of components whose products sum to the scalar product of two vectors."""
    return zip(one, other, strict=True)


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
    """Return the speeds along an axis due to V_x, V_z, psi' and the wing's own motion, and their time derivatives.

    `places` holds the quarter chords and their first two time derivatives.
    """
    (x, _, z), (x_speed, _, z_speed) = places[:2]
    (x_axis, _, z_axis), (x_rate, _, z_rate) = axis, axis_rate
    return (
        (x_axis, z_axis, _products((z_axis, x), (x_axis, -z)), _products(*_pairs(axis, places[1]))),
        (
            x_rate,
            z_rate,
            _products((z_rate, x), (x_rate, -z), (z_axis, x_speed), (x_axis, -z_speed)),
            _products(*_pairs(axis_rate, places[1]), *_pairs(axis, places[2])),
        ),
    )


class UnsteadyLoad(NamedTuple):
    """The generalised load of the unsteady terms on one motion of both wings, divided by the density of the air.

    Without damping, the load is ``-(A . a + B . xi + C + psi' (D . xi + E))``. Here ``xi = (V_x, V_z, psi')`` is
    the body's motion through the air in stroke axes, and a its acceleration with the pitch acceleration.

    Attributes
    ----------
    by_acceleration : A, shape (3, ...).
    by_velocity : B, shape (3, ...).
    own : C, the part due to the wing's own motion, shape (...).
    by_spin : D, shape (3, ...).
    own_spin : E, shape (...).
    damping, damping_by_spin : factors of each strip's airspeed, and of the airspeed times the pitch rate.
    """

    by_acceleration: ByBodyMotion
    by_velocity: ByBodyMotion
    own: Phases
    by_spin: ByBodyMotion
    own_spin: Phases
    damping: PerStrip | None
    damping_by_spin: PerStrip | None

    def load(self, density: Scalar, velocity: Triple, acceleration: Triple | None, airspeed: PerStrip) -> Phases:
        """Return the generalised force of the air on the motion.

        Theory: equation ``unsteady-load``.

        Parameters
        ----------
        density : rho [kg/m3].
        velocity : xi [m/s, m/s, rad/s].
        acceleration : of the body in stroke axes, and its pitch acceleration [m/s2, m/s2, rad/s2]; None means 0.
        airspeed : of the strips [m/s].
        """
        spin = velocity[2]
        steady = dot(_rows(self.by_velocity), velocity) + self.own
        turning = dot(_rows(self.by_spin), velocity) + self.own_spin
        resisted = steady + spin * turning
        if acceleration is not None:
            resisted = resisted + dot(_rows(self.by_acceleration), acceleration)
        if self.damping is not None:
            resisted = resisted + sum_over_strips(airspeed * (self.damping + spin * self.damping_by_spin))
        return -density * resisted


def _rows(matrix: ByBodyMotion) -> Triple:
    return matrix[0], matrix[1], matrix[2]


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


def _inertial(row: _Row, rates: StripRates) -> tuple[Any, ...]:
    return (row.mass, rates.mid), (row.inertia, rates.turn)


def _sums(motion: StripMotion, rows: list[Any]) -> Any:
    zero = jnp.zeros_like(motion.speeds[3].mid)
    return mass_moments(2.0, [zero if row is None else row for row in rows])


def _load(
    row: _Row,
    motion: StripMotion,
    tables: tuple[ByBodyMotion, ByBodyMotion, Phases, ByBodyMotion, Phases],
    chord: PerStripBroadcast,
    width: Phases,
) -> UnsteadyLoad:
    """Return the load of a motion from its tables A, B, C, D (without the turning of the axes) and E."""
    by_acceleration, by_velocity, own, by_spin, own_spin = tables
    # The axes turn with the body: xi' is its acceleration plus psi' (V_z, -V_x, 0).
    turned = jnp.stack([-by_acceleration[1], by_acceleration[0], jnp.zeros_like(by_acceleration[0])])
    damping = damping_by_spin = None
    turn = row.speeds.turn
    if turn is not None:
        damping, damping_by_spin = (
            -2.0 * damping_couple(1.0, chord, width, moved.turn, jnp.ones_like(turn)) * turn
            for moved in (motion.speeds[3], motion.speeds[2])
        )
    return UnsteadyLoad(by_acceleration, by_velocity, own, by_spin + turned, own_spin, damping, damping_by_spin)


def unsteady_load(
    motion: StripMotion, speeds: StripSpeeds, chord: PerStripBroadcast, width: Phases
) -> UnsteadyLoad:
    """Return the unsteady load on a motion.

    Parameters
    ----------
    motion : of the strips.
    speeds : of the strips, per unit of the motion on which the air acts.
    chord, width : of the strips [m].
    """
    row = _row(speeds, chord, width)
    spin, turning = (rotation_lift(1.0, chord, width, moved.turn) for moved in motion.speeds[2:])
    moves = list(zip(motion.speeds, motion.rates, strict=True))
    sums = _sums(
        motion,
        [
            *(_products((row.mass, moved.mid), (row.inertia, moved.turn)) for moved in motion.speeds[:3]),
            *(_products(*_inertial(row, rates), _rotation(turning, moved, speeds)) for moved, rates in moves),
            *(_products(_rotation(spin, moved, speeds)) for moved in motion.speeds),
        ],
    )
    return _load(row, motion, (sums[:3], sums[3:6], sums[6], sums[7:10], sums[10]), chord, width)


def unsteady_loads_on_body(
    motion: StripMotion, chord: PerStripBroadcast, width: Phases
) -> tuple[UnsteadyLoad, UnsteadyLoad, UnsteadyLoad]:
    """Return the loads of the unsteady terms on the motions V_x, V_z and psi' of the body.

    A is symmetric, and the part of D without the turning of the axes is antisymmetric, so 24 sums give 33 tables.

    Parameters
    ----------
    motion : of the strips.
    chord, width : of the strips [m].
    """
    rows = [_row(speeds, chord, width) for speeds in motion.speeds[:3]]
    spin, turning = (rotation_lift(1.0, chord, width, moved.turn) for moved in motion.speeds[2:])
    own, own_rates = motion.speeds[3], motion.rates[3]
    pairs = ((0, 1), (0, 2), (1, 2))
    moves = list(zip(motion.speeds[:3], motion.rates[:3], strict=True))

    def inertia(i: int, j: int) -> Any:
        return _products((rows[i].mass, rows[j].speeds.mid), (rows[i].inertia, rows[j].speeds.turn))

    sums = _sums(
        motion,
        [
            *(inertia(i, i) for i in range(3)),
            *(inertia(i, j) for i, j in pairs),
            *(_products(_rotation(spin, rows[j].speeds, rows[i].speeds)) for i, j in pairs),
            *(
                _products(*_inertial(row, rates), _rotation(turning, moved, row.speeds))
                for row in rows
                for moved, rates in moves
            ),
            *(_products(*_inertial(row, own_rates), _rotation(turning, own, row.speeds)) for row in rows),
            *(_products(_rotation(spin, own, row.speeds)) for row in rows),
        ],
    )
    zero = jnp.zeros_like(sums[0])
    a, (xz, xp, zp), (d_xz, d_xp, d_zp) = sums[:3], sums[3:6], sums[6:9]
    by_acceleration = jnp.stack([a[0], xz, xp]), jnp.stack([xz, a[1], zp]), jnp.stack([xp, zp, a[2]])
    by_spin = jnp.stack([zero, d_xz, d_xp]), jnp.stack([-d_xz, zero, d_zp]), jnp.stack([-d_xp, -d_zp, zero])
    forward, up, nose_up = (
        _load(
            rows[i],
            motion,
            (by_acceleration[i], sums[9 + 3 * i : 12 + 3 * i], sums[18 + i], by_spin[i], sums[21 + i]),
            chord,
            width,
        )
        for i in range(3)
    )
    return forward, up, nose_up
