"""Polars that others measured, read from the shared data; none of them is part of this project."""

from __future__ import annotations

import csv
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import FileError, read_text

Array = NDArray[np.float64]
NEEDED = ("gull_wing_polar.csv", "jackdaw_glide_wake.csv", "flat_plate_pelletier_mueller.csv")
# Air at 15 degrees Celsius; the jackdaw's Reynolds number needs it and the file gives none [m2/s].
VISCOSITY = 1.5e-5
# The glider's reference span and area, as the header of its file states them [m, m2].
JACKDAW_SPAN, JACKDAW_AREA = 0.67, 0.0652


@dataclass(frozen=True)
class Polar:
    """One wing's polar: `alpha_deg` is None where nobody measured it, `moment` where it was not.

    Coefficients refer to the area of the wing (of the half wing for half wings); the moment is about the shoulder,
    over the mean aerodynamic chord, nose-up positive.
    """

    label: str
    kind: str
    lift: Array
    drag: Array
    reynolds: tuple[float, float]
    alpha_deg: Array | None = None
    moment: Array | None = None


def rows(path: Path) -> list[dict[str, str]]:
    """Return the rows of a CSV file whose comments begin with #."""
    lines = [line for line in read_text(path).splitlines() if line and not line.startswith("#")]
    return list(csv.DictReader(lines))


def columns(table: list[dict[str, str]], *names: str) -> list[Array]:
    """Return columns of numbers."""
    return [np.array([float(row[name]) for row in table]) for name in names]


def gulls(folder: Path) -> list[Polar]:
    """Return the nine printed half wings of a gull, both tunnel speeds of each together.

    Coefficients are those derived in the file with half the area of both wings: the columns called CL and CD in
    its source are areas. The angle is that of the mount; the wings are twisted, so that zero lift falls elsewhere.
    """
    table = rows(folder / NEEDED[0])
    found = []
    for wing in sorted({row["wing_id"] for row in table}):
        own = [row for row in table if row["wing_id"] == wing]
        names = "alpha_deg", "CL_half_area", "CD_half_area", "Cm_shoulder_half_area_MAC", "Re_MAC"
        alpha, lift, drag, moment, reynolds = columns(own, *names)
        between = float(reynolds.min()), float(reynolds.max())
        found.append(Polar(f"gull {wing}", "gull", lift, drag, between, alpha, moment))
    return found


def jackdaw(folder: Path) -> Polar:
    """Return the gliding jackdaw: wings alone, the drag that its wake shows as induced and profile drag."""
    table = rows(folder / NEEDED[1])
    speed, lift, induced, profile = columns(table, "airspeed_m_s", "CL", "CD_induced", "CD_profile")
    reynolds = speed * JACKDAW_AREA / JACKDAW_SPAN / VISCOSITY
    between = float(reynolds.min()), float(reynolds.max())
    return Polar("jackdaw, gliding, wings alone", "jackdaw", lift, induced + profile, between)


def plates(folder: Path) -> list[Polar]:
    """Return the thin flat plates of small aspect ratio, read off a printed figure by eye."""
    table = rows(folder / NEEDED[2])
    found = []
    for ratio in sorted({float(row["aspect_ratio_if_mirrored"]) for row in table}):
        own = [row for row in table if float(row["aspect_ratio_if_mirrored"]) == ratio]
        alpha, lift, drag, reynolds = columns(own, "alpha_deg", "CL", "CD", "Re")
        between = float(reynolds.min()), float(reynolds.max())
        found.append(Polar(f"thin plate, aspect ratio {ratio:g}", "plate", lift, drag, between, alpha))
    return found


def all_polars(folder: Path) -> list[Polar]:
    """Return every polar.

    Raises
    ------
    FileError : a file is missing.
    """
    absent = [name for name in NEEDED if not (folder / name).is_file()]
    if absent:
        raise FileError(f"cannot find {', '.join(absent)} in '{folder}'; give their folder with --data")
    return [*gulls(folder), jackdaw(folder), *plates(folder)]
