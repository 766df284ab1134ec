"""How far a wing is to the side of the plane of symmetry, and how far it flaps: functions of time alone.

The body pitches about the lateral axis, so a wing's distance to the side depends on the prescribed wingbeat and
never on the flight.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from wingbeat._jax.arrays import jnp
from wingbeat._jax.exported import exported
from wingbeat.animal.kinematics import Wingbeat, flap_angle, fold_angle, span_ratio
from wingbeat.animal.vehicle import Vehicle
from wingbeat.mechanics.wing_motion import air_chord, shape_at, strips_of, with_time_axes
from wingbeat.mechanics.wing_shape import Strips, WingShape

if TYPE_CHECKING:
    from wingbeat._jax.arrays import Component, FlapAngles, PerStrip, PerStripBroadcast, Phases


# Chordwise place of the leading and the trailing edge from the quarter chord, in chords.
LEADING, TRAILING = 0.25, -0.75


@exported(static=("count",))
def lateral_corners(
    vehicle: Vehicle, wingbeat: Wingbeat, phase: Phases, *, count: int
) -> tuple[PerStrip, PerStrip]:
    """Return the distance of the left wing's strip corners to the left of the plane of symmetry [m].

    Theory: equation ``strip-corners``.

    Parameters
    ----------
    vehicle : gives the wing.
    wingbeat : the prescribed wingbeat.
    phase : phases, shape (K,).
    count : number of strips, N.

    Returns
    -------
    Leading and trailing corners, inner ones first, shape (2 N, K) each.
    """
    strips = with_time_axes(strips_of(vehicle.wing, count), phase)
    shape = shape_at(vehicle, wingbeat, strips, phase)
    half, chord = _half_width(vehicle, wingbeat, shape, phase, count), air_chord(wingbeat, strips.chord, phase)

    def edge(share: float) -> PerStrip:
        along = _edge(shape, chord, share)
        return jnp.concatenate([along - half, along + half])

    return edge(LEADING), edge(TRAILING)


def lateral_corner(
    vehicle: Vehicle, wingbeat: Wingbeat, strips: Strips, share: Phases, side: Phases, phase: Phases, count: int
) -> Phases:
    """Return the distance of given corners to the left [m], each at its own phase; all arrays have shape (K,).

    Parameters
    ----------
    vehicle, wingbeat, count : as in `lateral_corners`.
    strips : the strips to which the corners belong.
    share : `LEADING` or `TRAILING`.
    side : -1 for an inner corner, 1 for an outer one.
    phase : phases.
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
    """Return whether the shoulder is off the plane of symmetry, so that a pitching root can stay on its own side.

    If the shoulder is in the plane itself, some corner of the root crosses it in any stroke. The wing then counts
    as on its side if neither arm nor hand flaps by more than a right angle.
    """
    return bool(vehicle.wing.shoulder[1] != 0.0)


@exported
def flap_angles(wingbeat: Wingbeat, phase: Phases) -> FlapAngles:
    """Return the flap angles of arm and hand, up positive [rad], shape (2, K)."""
    flap = flap_angle(wingbeat, phase)
    return jnp.stack([flap, flap - fold_angle(wingbeat, phase)])
