"""Polars of a section from NeuralFoil, which imitates XFOIL (extra ``neuralfoil``), with its own confidence.

Measured against XFOIL 6.99 (NACA 0012 and 4412, Re 2e4 to 4e5, -10 to 15 degrees, 629 rows that converged), root
mean squares by NeuralFoil's confidence: from 0.95 on (515 rows) C_L differs by 0.025 and C_D by 6 %; from 0.9 to
0.95 (49 rows) by 0.05 and 16 %; from 0.5 to 0.9 (49 rows) by 0.08 and 20 %; from 0.3 to 0.5 (15 rows) by 0.09 and
12 %; below, XFOIL converged once. So rows below 0.5 are left out and those below 0.9 named. From 30 degrees the
confidence is 0 for every section: the rest of the circle comes from an extension, such as Viterna's.

| NeuralFoil 0.3.3 | what differs from what one would guess |
| --- | --- |
| a plate with blunt ends | confidence 0 at all angles, and lift at 0 degrees: its shapes have round noses |
| coordinates in Lednicer's order | are taken as one line; drag is 1e104, without an error |
| 90 degrees | drag of 0.1 and less, where a plate has 2 |
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import FaultList, FileError, install_extra, read_text
from wingbeat.aero.coefficient_model import centre_from_moment

LEAST_CONFIDENCE, GOOD_CONFIDENCE = 0.5, 0.9
# NeuralFoil was trained from Re 1e3 on; below 5e3 its confidence falls under a half.
_REYNOLDS = (1e3, 1e9)
_ANGLES = np.arange(-30.0, 30.5, 1.0)
_POINTS = 121
# A polar ends where so many rows in a row have too little confidence.
_MISSED = 3
_PLATE = re.compile(r"(?i)plate[:= _-]?([\d.]+)$")


class SectionPolar(NamedTuple):
    """The polar of a section at one Reynolds number; the moment is about mid-chord, nose-up positive."""

    reynolds: float
    alpha_deg: NDArray[np.float64]
    lift: NDArray[np.float64]
    drag: NDArray[np.float64]
    moment: NDArray[np.float64]
    confidence: NDArray[np.float64]

    @property
    def kept(self) -> NDArray[np.bool_]:
        """The rows in use: those of sufficient confidence, outwards from 0 until three in a row are below it."""
        good = self.confidence >= LEAST_CONFIDENCE
        ends = [len(good) - 1, 0]
        for side, step in enumerate((1, -1)):
            missed, at = 0, int(np.argmin(np.abs(self.alpha_deg)))
            while 0 <= at < len(good):
                missed = 0 if good[at] else missed + 1
                if missed == _MISSED:
                    ends[side] = at
                    break
                at += step
        place = np.arange(len(good))
        return good & (place <= ends[0]) & (place >= ends[1])


def section_coordinates(name: str) -> tuple[str, NDArray[np.float64]]:
    """Return what a section is called and its outline, from the trailing edge over the top, shape (n, 2).

    Parameters
    ----------
    name : NACA digits ("naca0012"), the path of a file of coordinates (.dat), or a plate of a stated thickness in
        chords ("plate0.04") with an elliptic nose as long as it is thick and a tail that tapers over a tenth.

    Raises
    ------
    FileError : the file is missing or cannot be read.
    InvalidInputError : an unknown section, or coordinates that are no outline.

    >>> name, outline = section_coordinates("naca0012")
    >>> name, round(float(np.ptp(outline[:, 1])), 3)
    ('NACA 0012', 0.12)
    """
    faults = FaultList()
    station = 0.5 * (1 - np.cos(np.linspace(0, math.pi, _POINTS)))
    digits, plate = re.fullmatch(r"(?i)(?:naca[ _-]?)?(\d{4})", name.strip()), _PLATE.fullmatch(name.strip())
    if digits:
        camber, place, thick = int(digits[1][0]) / 100, int(digits[1][1]) / 10, int(digits[1][2:]) / 100
        if not thick or (camber and not place):
            faults.add("--section", name, "is no section", "the last two digits are the thickness in per cent")
            faults.raise_if_any()
        half = 5 * thick * (0.2969 * np.sqrt(station) - 0.126 * station - 0.3516 * station**2)
        half += 5 * thick * (0.2843 * station**3 - 0.1015 * station**4)
        line, slope = np.zeros_like(station), np.zeros_like(station)
        if camber:
            front = station < place
            line = np.where(
                front, 2 * place * station - station**2, 1 - 2 * place + 2 * place * station - station**2
            )
            scale = camber / np.where(front, place**2, (1 - place) ** 2)
            line, slope = scale * line, scale * 2 * (place - station)
        turn = np.arctan(slope)
        upper = np.column_stack([station - half * np.sin(turn), line + half * np.cos(turn)])
        lower = np.column_stack([station + half * np.sin(turn), line - half * np.cos(turn)])
        return f"NACA {digits[1]}", np.vstack([upper[::-1], lower[1:]])
    if plate:
        thick = float(plate[1])
        if not 0.005 <= thick <= 0.2:
            rule = "has a thickness that must lie between 0.005 and 0.2 chords"
            faults.add("--section", name, rule, "for example plate0.04 for 4 per cent")
            faults.raise_if_any()
        half = np.full(_POINTS, thick / 2)
        half = np.where(station < thick, thick / 2 * np.sqrt(1 - (1 - np.minimum(station / thick, 1)) ** 2), half)
        half = np.where(station > 0.9, thick / 2 * (1 - station) / 0.1, half)
        return f"plate of {thick:g} chords", np.vstack(
            [np.column_stack([station, half])[::-1], np.column_stack([station, -half])[1:]]
        )
    if not name.lower().endswith((".dat", ".txt")):
        fix = "give NACA digits (naca0012), a file of coordinates (.dat), or plate0.04 for a plate 4 per cent thick"
        faults.add("--section", name, "is no section", fix)
        faults.raise_if_any()
    return _outline(faults, Path(name))


def _outline(faults: FaultList, path: Path) -> tuple[str, NDArray[np.float64]]:
    """Return name and outline of a file of coordinates, in Selig's or Lednicer's order."""
    lines = [line.strip() for line in read_text(path).splitlines() if line.strip()]
    pairs: list[tuple[float, float]] = []
    title = path.stem
    for i, line in enumerate(lines):
        cells = line.replace(",", " ").split()
        try:
            one = float(cells[0]), float(cells[1])
        except (ValueError, IndexError):
            if i:
                faults.add(f"{path.name} line {i + 1}", line, "is no pair of coordinates", "drop the line")
            title = title if i else line
            continue
        pairs.append(one)
    faults.raise_if_any()
    if len(pairs) > 3 and pairs[0] == (round(pairs[0][0]), round(pairs[0][1])) and sum(pairs[0]) == len(pairs) - 1:
        count = int(pairs[0][0])  # Lednicer: both sides from the nose
        upper, lower = pairs[1 : 1 + count], pairs[1 + count :]
        pairs = upper[::-1] + lower[lower[0] == upper[0] :]
    outline = np.array(pairs).reshape(-1, 2)
    if len(outline) < 20 or not np.isfinite(outline).all():
        faults.add(path.name, len(outline), "coordinates are too few for an outline", "give 20 points or more")
    elif np.ptp(outline[:, 0]) > 10:
        faults.add(path.name, float(np.ptp(outline[:, 0])), "is the chord", "are these per cent? Divide by 100")
    elif not (
        np.argmin(outline[:, 0]) in range(2, len(outline) - 2) and np.ptp(outline[:, 1]) < np.ptp(outline[:, 0])
    ):
        rule = "does not run from the trailing edge around the nose and back"
        faults.add(path.name, "", rule, "give coordinates in the order of Selig or of Lednicer")
    faults.raise_if_any()
    chord = float(np.ptp(outline[:, 0]))
    outline = (outline - [outline[:, 0].min(), 0.0]) / chord
    half = int(np.argmin(outline[:, 0]))
    if outline[:half, 1].mean() < outline[half:, 1].mean():
        outline = outline[::-1]
    return title, outline


def section_polars(name: str, reynolds: Sequence[float]) -> tuple[str, list[SectionPolar]]:
    """Return what a section is called, and its polar at each Reynolds number by NeuralFoil's largest model.

    Parameters
    ----------
    name : as in `section_coordinates`.
    reynolds : chord Reynolds numbers, from 1000 to 1e9.

    Raises
    ------
    FileError : NeuralFoil is not installed; a file that cannot be read.
    InvalidInputError : an unknown section, Reynolds numbers outside its range.
    """
    faults = FaultList()
    for value in reynolds:
        fix = "NeuralFoil was trained from Re 1000; give chord times speed over viscosity"
        faults.number("--re", value, at_least=_REYNOLDS[0], at_most=_REYNOLDS[1], fix=fix)
    if not reynolds:
        faults.add("--re", "", "is missing", "give the wing's Reynolds numbers, such as --re 2e4 5e4 1e5")
    faults.raise_if_any()
    title, outline = section_coordinates(name)
    try:
        import neuralfoil
    except ImportError:
        raise FileError(f"NeuralFoil is not installed here: {install_extra('neuralfoil')}") from None
    found = []
    for value in sorted(set(reynolds)):
        got = neuralfoil.get_aero_from_coordinates(outline, alpha=_ANGLES, Re=float(value), model_size="xlarge")
        lift, drag, moment, confidence = (
            np.asarray(got[key], dtype=float) for key in ("CL", "CD", "CM", "analysis_confidence")
        )
        turn = np.radians(_ANGLES)
        middle = moment + 0.25 * (lift * np.cos(turn) + drag * np.sin(turn))
        found.append(SectionPolar(float(value), _ANGLES.copy(), lift, drag, middle, confidence))
    return title, found


def sections_csv(title: str, polars: Sequence[SectionPolar]) -> str:
    """Return polars as the text of a table that `load_table` reads, without the rows of little confidence."""
    lines = [f"# {title} by NeuralFoil, section", "# aspect_ratio = inf"]
    lines.append("alpha_deg,reynolds,C_L,C_D,C_M,x_cp,analysis_confidence")
    for one in polars:
        centres = centre_from_moment(one.alpha_deg, one.lift, one.drag, one.moment)
        for k in np.flatnonzero(one.kept):
            centre = "" if math.isnan(centres[k]) else f"{centres[k]:.4f}"
            cells = (one.alpha_deg[k], one.reynolds, one.lift[k], one.drag[k], one.moment[k])
            lines.append(",".join([*(f"{cell:.6g}" for cell in cells), centre, f"{one.confidence[k]:.3f}"]))
    return "\n".join(lines) + "\n"
