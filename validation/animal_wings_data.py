"""Measured wings of birds with the numbers that their fit needs: aspect ratio, tunnel speed, single flights."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from measured_data import JACKDAW_AREA, VISCOSITY, Array, columns, rows
from numpy.typing import NDArray

from wingbeat._base import FileError

JACKDAW_FILE = "jackdaw_glide_wake.csv"
NEEDED = ("gull_wing_polar.csv", "gull_wing_geometry.csv", JACKDAW_FILE)


@dataclass(frozen=True)
class HalfWing:
    """Forces on one printed half wing of a gull; `fast` marks the rows of the faster of two tunnel speeds.

    Coefficients refer to the area of the half wing. The aspect ratio is that of the wing and its mirror image,
    ``(2 R)^2 / S`` with R from root to tip and S the area of both. Angles are those of the mount.
    """

    name: str
    aspect_ratio: float
    alpha_deg: Array
    lift: Array
    drag: Array
    reynolds: Array
    fast: NDArray[np.bool_]


@dataclass(frozen=True)
class Glides:
    """Frames of the gliding jackdaw whose span and area were measured in the frame; shape (n,) each.

    Coefficients refer to the wing area of the frame: drag of the wings alone, induced and profile.
    """

    flight: NDArray[np.str_]
    lift: Array
    induced: Array
    profile: Array
    aspect_ratio: Array
    reynolds: Array


def half_wings(folder: Path) -> list[HalfWing]:
    """Return the nine printed half wings."""
    shapes = {row["wing_id"]: row for row in rows(folder / NEEDED[1])}
    polar = rows(folder / NEEDED[0])
    found = []
    for name, shape in sorted(shapes.items()):
        own = [row for row in polar if row["wing_id"] == name]
        measured = columns(own, "alpha_deg", "CL_half_area", "CD_half_area", "Re_MAC")
        fast = np.array([row["tunnel_speed_set"] == "high" for row in own])
        ratio = (2 * float(shape["root_to_tip_m"])) ** 2 / float(shape["S_m2"])
        found.append(HalfWing(name, ratio, *measured, fast))
    return found


def jackdaw_glides(folder: Path) -> Glides:
    """Return the frames of the jackdaw that show its span and wing area."""
    known = [row for row in rows(folder / NEEDED[2]) if row["wingspan_m"] and row["wing_area_m2"]]
    names = "airspeed_m_s", "CL", "CD_induced", "CD_profile", "wingspan_m", "wing_area_m2"
    speed, lift, induced, profile, span, area = columns(known, *names)
    share = JACKDAW_AREA / area
    # Day and hour.
    flight = np.array([row["obs_id"][:8] for row in known])
    reynolds = speed * area / span / VISCOSITY
    return Glides(flight, lift * share, induced * share, profile * share, span**2 / area, reynolds)


def check(folder: Path) -> None:
    """Raise `FileError` if a file is missing."""
    absent = [name for name in NEEDED if not (folder / name).is_file()]
    if absent:
        raise FileError(f"cannot find {', '.join(absent)} in '{folder}'; give their folder with --data")


def reduced(alpha_deg: Array, lift: Array, drag: Array, ratio: Array | float, to: float) -> tuple[Array, Array]:
    """Return angle of attack [deg] and C_D of a wing brought to another aspect ratio at the same C_L.

    Prandtl's lifting line: the downwash angle is C_L / (pi A), and the induced drag C_L times that.
    """
    change = lift / math.pi * (1.0 / to - 1.0 / np.asarray(ratio))
    return alpha_deg + np.degrees(change), drag + lift * change
