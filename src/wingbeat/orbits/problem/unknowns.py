"""The unknowns that the solver varies, and a check for tilts that have no effect."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from wingbeat._base import FaultList
from wingbeat.animal.vehicle import Vehicle


@dataclass(frozen=True)
class Unknowns:
    """Names, bounds and scales of the unknowns: the pitch state at phase 0, then the free parameters.

    Theory: equation ``unknowns``.

    Parameters
    ----------
    names : of the unknowns.
    lower, upper : bounds, SI and radians, shape (unknowns,).
    scale : differences that matter, shape (unknowns,); the optimiser's scale is in multiples of them.
    """

    names: tuple[str, ...]
    lower: np.ndarray
    upper: np.ndarray
    scale: np.ndarray


def check_tilts(vehicle: Vehicle, free: tuple[str, ...], faults: FaultList) -> None:
    """Add a fault for each free tilt that has no effect on this vehicle's flight.

    Parameters
    ----------
    vehicle : the vehicle.
    free : names of the free parameters.
    faults : receives the faults.
    """
    ahead, _, above = vehicle.wing.shoulder
    if "stroke_plane_tilt" in free and ahead == 0 and above == 0 and vehicle.tail is None:
        rule = "changes only the body's pitch, because the shoulder is at its centre of mass and there is no tail"
        faults.add("free", "stroke_plane_tilt", rule, "set wing.shoulder, or leave stroke_plane_tilt fixed")
    if "tail_tilt" in free and vehicle.tail is None:
        rule = "changes nothing, because there is no tail"
        fix = "set tail.area, tail.arm and tail.lift_slope, or leave tail_tilt fixed"
        faults.add("free", "tail_tilt", rule, fix)
