"""How far a wing is to the side of the plane of symmetry, and how far it flaps: functions of time alone.

The body pitches about the lateral axis, so where a wing is to the side depends on the prescribed wingbeat and
never on the flight.
"""

from __future__ import annotations

from typing import Any

from wingbeat.jax64 import jnp
from wingbeat.kinematics import Wingbeat, flap_angle, fold_angle, span_ratio
from wingbeat.vehicle import Vehicle
from wingbeat.wing_motion import beside, shape_at, strips_of


def lateral_corners(vehicle: Vehicle, wingbeat: Wingbeat, phase: Any, count: int) -> tuple[Any, Any]:
    """Return where the corners of the left wing's strips are to the left [m].

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
    strips = beside(strips_of(vehicle.wing, count), phase)
    shape = shape_at(vehicle, wingbeat, strips, phase)
    chordwise, normal = shape.chordwise, shape.normal
    width = vehicle.wing.semi_span / count * span_ratio(wingbeat, phase)
    half = 0.5 * width * (normal[2] * chordwise[0] - normal[0] * chordwise[2])

    def edge(share: float) -> Any:
        along = shape.left + share * strips.chord * chordwise[1]
        return jnp.concatenate([along - half, along + half])

    return edge(0.25), edge(-0.75)


def has_room(vehicle: Vehicle) -> bool:
    """Say whether the shoulder lies beside the plane of symmetry, so that a root that pitches can keep off it.

    Where the shoulder lies in the plane itself, some corner of the root is across in any stroke. The wing then
    keeps to its side if neither arm nor hand turns by more than a right angle.
    """
    return bool(vehicle.wing.shoulder[1] != 0.0)


def flap_angles(wingbeat: Wingbeat, phase: Any) -> Any:
    """Return the flap angles of arm and hand, up positive [rad], shape (2, K)."""
    flap = flap_angle(wingbeat, phase)
    return jnp.stack([flap, flap - fold_angle(wingbeat, phase)])
