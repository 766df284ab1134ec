"""Tables of measured coefficients as files: how columns may be named, and what no such table can hold."""

from __future__ import annotations

import math
import re
import shlex
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import FaultList, FileError, read_text, suggest
from wingbeat._base.sheets import (
    MAX_BYTES,
    Sheet,
    check_unit,
    cut_short,
    parse_numbers,
    read_sheet,
    same_name,
    split_unit,
)
from wingbeat.aero.coefficient_model import check_possible
from wingbeat.aero.polar_formats import polar_of

QUANTITIES = ("C_L", "C_D", "C_M", "x_cp")
REQUIRED = ("alpha_deg", "C_L", "C_D")
_ERRORS = tuple(f"{name}_{kind}" for name in QUANTITIES for kind in ("sd", "se"))
KNOWN = ("alpha_deg", "reynolds", *QUANTITIES, *_ERRORS, "runs")
# Cells that may be empty: no centre of pressure without a force, and what was not measured in every row.
MAY_BE_EMPTY = frozenset(KNOWN) - frozenset(REQUIRED)

_SPELLINGS = {same_name(name): name for name in KNOWN}
_SPELLINGS |= dict.fromkeys(("alpha", "aoa", "aoadeg", "angleofattack", "angleofattackdeg", "α"), "alpha_deg")
_SPELLINGS |= dict.fromkeys(("re", "reynoldsnumber"), "reynolds")
_SPELLINGS |= {"liftcoefficient": "C_L", "dragcoefficient": "C_D", "momentcoefficient": "C_M"}
# A column of these names starts like a coefficient and ends like an error; it is named if it is not used.
_ERROR_LIKE = re.compile(r"(cl|cd|cm|xcp)\W*(e|s|u|d|std|stat|ci)", re.ASCII)
# Lift rises with the angle of attack on every wing at small angles. These are the angles [deg], the least number of
# angles, and the least fall of lift that says that a sign is wrong.
_ATTACHED_DEG, _LEAST_ANGLES, _LEAST_FALL = 8.0, 4, 0.15
# At these angles [deg] every wing's lift has the sign of the angle, and at those its drag is above its lift.
_INCLINED_DEG, _ACROSS_DEG = (20.0, 70.0), (80.0, 100.0)
_IDEAL_DRAG = 1e-3
# No wing in a stream at Re above 100 has so much drag at small angles: a plate at Re 100 has 0.27 (Blasius).
# In per cent it is at most 20 there; more are drag counts.
_SMALL_DEG, _DRAG_AT_SMALL, _PER_CENT_AT_SMALL, _VISCOUS = 5.0, 1.0, 20.0, 100.0
# Friction of a flat plate, both sides, in laminar flow: 2.656/sqrt(Re) (Blasius 1908). Drag below a quarter of it
# says that Re is in other units: in thousands, it would be too small by a factor of 32.
_BLASIUS, _LEAST_SHARE = 2.656, 0.25
_LISTED = 8


class PolarSheet(NamedTuple):
    """A table of coefficients as numbers."""

    sheet: Sheet  # the parts of the file
    headings: dict[str, str]  # the file's own names of the columns that are read, by our names
    columns: dict[str, NDArray[np.float64]]  # numbers by our names; NaN where an optional cell is empty
    notes: tuple[str, ...]  # what a reader should know: columns that are not read
    of_program: bool = False  # whether another program wrote it, with a moment about the quarter chord

    def only(self, rows: NDArray[np.intp]) -> PolarSheet:
        """Return the table of these rows alone."""
        sheet = self.sheet._replace(rows=[self.sheet.rows[row] for row in rows])
        return self._replace(sheet=sheet, columns={name: column[rows] for name, column in self.columns.items()})

    def where(self, row: int, name: str) -> str:
        """Return the place of a cell in the file, in the file's own words."""
        at = self.sheet.rows[row][0] if row < len(self.sheet.rows) else self.sheet.header_row
        return f"{self.sheet.file} row {at}, column {self.headings.get(name, name)}"


def read_polar(path: str | Path, faults: FaultList) -> PolarSheet:
    """Read a table of coefficients: CSV with columns in any order and usual spelling, or a polar of a program.

    Angles from 0 to 360 degrees become -180 to 180. Faults of cells and values are noted in `faults`; those of the
    file and its head are raised.
    """
    try:
        text = read_text(path, limit=MAX_BYTES)
    except FileError:  # read_sheet says what it is
        text = ""
    foreign = polar_of(faults, Path(path).name, text)
    sheet = read_sheet(path) if foreign is None else foreign.sheet
    names, notes = _names(faults, sheet)
    headings = {name: split_unit(cell).name for name, cell in zip(names, sheet.header, strict=True) if name}
    blank = frozenset(headings[name] for name in headings if name in MAY_BE_EMPTY)
    numbers = parse_numbers(faults, sheet, [headings.get(name, "") for name in names], blank=blank)
    columns = {name: numbers[:, k].copy() for k, name in enumerate(names) if name}
    notes = [*sheet.notes, *(cut_short(text) if foreign is not None else ()), *notes]
    alpha = columns["alpha_deg"]
    behind = alpha > 180
    if behind.sum() > 2 and np.nanmin(alpha) >= 0 and np.nanmax(alpha) <= 360:
        notes.append(f"angles from {np.nanmin(alpha):g} to {np.nanmax(alpha):g} degrees are read as -180 to 180")
        alpha = np.where(behind, alpha - 360, alpha)
        order = np.argsort(alpha, kind="stable")
        columns = {name: column[order] for name, column in (columns | {"alpha_deg": alpha}).items()}
        sheet = sheet._replace(rows=[sheet.rows[k] for k in order])
    if foreign is not None and foreign.quarter and not faults.faults:
        turn = np.radians(columns["alpha_deg"])
        columns["C_M"] += 0.25 * (columns["C_L"] * np.cos(turn) + columns["C_D"] * np.sin(turn))
    found = PolarSheet(sheet, headings, columns, tuple(notes), foreign is not None)
    if not sheet.rows:
        faults.add(f"{sheet.file} row {sheet.header_row}", "", "has no row of numbers", "add the measurements")
        faults.raise_if_any()
    _check_values(faults, found)
    return found


def _names(faults: FaultList, sheet: Sheet) -> tuple[list[str], list[str]]:
    """Return our name of each column, "" for one that is not read, and notes; refuse a head that cannot be read."""
    names: list[str] = []
    unread: list[str] = []
    earlier = len(faults.faults)
    for k, cell in enumerate(sheet.header):
        name = _SPELLINGS.get(same_name(cell), "")
        where = f"{sheet.file} row {sheet.header_row}, column {k + 1}"
        if same_name(cell) in ("alpharad", "aoarad"):
            faults.add(where, cell, "is in radians", "multiply by 57.29578 and name it alpha_deg")
            name = "alpha_deg"
        if not name:
            unread.append(split_unit(cell).name)
        elif name in names:
            faults.add(where, cell, f"appears twice (above as {sheet.header[names.index(name)]})", "keep one")
        else:
            check_unit(faults, where, split_unit(cell).unit, "deg" if name == "alpha_deg" else "")
        names.append(name)
    for name in [name for name in REQUIRED if name not in names]:
        near = suggest(name, unread, most=1, otherwise="")
        fix = f"needed are {', '.join(REQUIRED)}" + (f"; {near}" if near else "")
        where = f"{sheet.file} row {sheet.header_row}, column {name}"
        faults.add(where, ",".join(sheet.header), "the column is missing", fix)
    if len(faults.faults) > earlier:
        faults.raise_if_any()
    shown = [name or "(without a name)" for name in unread]
    notes = []
    if shown:
        notes.append(f"columns that are not used: {', '.join(shown[:_LISTED])}{', ...' * (len(shown) > _LISTED)}")
    if errors := [name for name in unread if _ERROR_LIKE.match(same_name(name))]:
        rule = "named C_L_se (standard error of the mean) or C_L_sd (standard deviation), and so on"
        told = "if these are errors, they are not used; errors are read from columns"
        notes.append(f"{', '.join(errors)}: {told} {rule}")
    return names, notes


def _check_values(faults: FaultList, polar: PolarSheet) -> None:
    """Note what no table of a wing can hold: one fault for each column, at its worst row."""
    per_cent = _check_per_cent(faults, polar)
    for name, column in polar.columns.items():
        if name == "C_D" and per_cent:
            continue
        if name in QUANTITIES:
            check_possible(faults, name, column.tolist(), lambda i, name=name: polar.where(i, name))
        elif name in _ERRORS:
            fault_at(faults, polar, name, column < 0, "must be >= 0", "an error has no sign")
        elif name == "runs":
            fault_at(faults, polar, name, column < 1, "must be >= 1", "it is the number of runs in the row")
        elif name == "reynolds":
            small = np.nanmax(column, initial=0.0) < 100 and np.nanmin(column, initial=1.0) > 0
            units = "it looks like millions or thousands: multiply by 1 000 000 or 1000"
            fault_at(faults, polar, name, column < 1, "must be >= 1", units if small else "was the stream at rest?")
    _check_angles(faults, polar)
    _check_directions(faults, polar)


def _check_directions(faults: FaultList, polar: PolarSheet) -> None:
    """Note lift that falls with the angle or has the wrong sign, and lift above drag across the flow."""
    alpha, lift, drag = (polar.columns[name] for name in REQUIRED)
    where = f"{polar.sheet.file}, column {polar.headings['C_L']}"
    reverse = f"reverse the sign of {polar.headings['C_L']} or of {polar.headings['alpha_deg']}"
    near = (np.abs(alpha) <= _ATTACHED_DEG) & np.isfinite(lift)
    if len(np.unique(alpha[near])) >= _LEAST_ANGLES:
        slope = float(np.polyfit(alpha[near], lift[near], 1)[0])
        fall = -slope * float(np.ptp(alpha[near]))
        if fall > _LEAST_FALL and np.corrcoef(alpha[near], lift[near])[0, 1] < -0.8:
            low, high = alpha[near].min(), alpha[near].max()
            rule = f"falls by {fall:.2g} from {low:g} to {high:g} degrees; lift must rise"
            faults.add(where, f"{slope:.3g} per degree", rule, reverse)
            return
    low, high = _INCLINED_DEG
    for side, sign in (("positive", 1), ("negative", -1)):
        there = (low <= sign * alpha) & (sign * alpha <= high)
        if len(np.unique(alpha[there])) > 1 and (sign * lift[there]).max() < -_LEAST_FALL:
            rule = f"is the lift at {side} angles from {low:g} to {high:g} degrees, and it must be {side} there"
            faults.add(where, f"{lift[there].min():g} to {lift[there].max():g}", rule, "reverse its sign there")
            return
    low, high = _ACROSS_DEG
    across = (low <= np.abs(alpha)) & (np.abs(alpha) <= high)
    # An ideal fluid has lift alone, at all angles.
    if across.any() and drag.max() > _IDEAL_DRAG and (np.abs(lift[across]) > drag[across]).all():
        rule = f"is larger than the drag at all angles from {low:g} to {high:g} degrees, across the flow"
        fix = (
            "are lift and drag exchanged? If these are normal and tangential force, lift is C_N cos(alpha) - C_T "
            "sin(alpha) and drag C_N sin(alpha) + C_T cos(alpha)"
        )
        faults.add(where, float(np.abs(lift[across]).max()), rule, fix)


def _check_per_cent(faults: FaultList, polar: PolarSheet) -> bool:
    """Note a fault if drag at small angles is larger than any wing's, as in per cent; return whether it is."""
    alpha, drag = polar.columns["alpha_deg"], polar.columns["C_D"]
    known = polar.columns.get("reynolds", np.full(len(alpha), math.inf))
    drag = drag[(np.abs(alpha) <= _SMALL_DEG) & (known >= _VISCOUS) & np.isfinite(drag)]
    if not len(drag) or not _DRAG_AT_SMALL <= drag.min() <= _PER_CENT_AT_SMALL:
        return False
    rule = f"is at least {drag.min():g} at angles up to {_SMALL_DEG:g} degrees, and no wing has so much drag"
    fix = "the column looks like per cent: divide it by 100"
    fix += "" if "reynolds" in polar.columns else f"; if Re is below {_VISCOUS:g}, state it in a column reynolds"
    faults.add(f"{polar.sheet.file}, column {polar.headings['C_D']}", float(drag.max()), rule, fix)
    return True


def fault_at(faults: FaultList, polar: PolarSheet, name: str, bad: NDArray[np.bool_], rule: str, fix: str) -> None:
    """Note one fault at the first bad row of a column, with the number of bad rows."""
    if bad.any():
        row = int(np.argmax(bad))
        others = f" ({bad.sum()} of {len(bad)} rows)" if bad.sum() > 1 else ""
        faults.add(polar.where(row, name), float(polar.columns[name][row]), rule + others, fix)


def _check_angles(faults: FaultList, polar: PolarSheet) -> None:
    """Note angles in radians, from 0 to 360 degrees, or beyond half a turn."""
    angles = polar.columns["alpha_deg"]
    finite = angles[np.isfinite(angles)]
    if not len(finite):
        return
    row = int(np.nanargmax(np.abs(angles)))
    if check_radians(faults, polar.where(row, "alpha_deg"), finite):
        return
    beyond = "must lie between -180 and 180 degrees"
    fault_at(faults, polar, "alpha_deg", np.abs(angles) > 180, beyond, "wrap the angle")


def check_radians(faults: FaultList, where: str, angles: NDArray[np.float64]) -> bool:
    """Note a fault if four angles or more do not go beyond pi, as in radians; return whether it is so."""
    distinct = np.unique(np.round(angles, 3))
    largest = float(np.abs(distinct).max())
    if len(distinct) < 4 or not 0 < largest <= math.pi:
        return False
    rule = f"is the largest of {len(distinct)} angles, which looks like a sweep in radians"
    faults.add(where, largest, rule, "write degrees (radians times 57.29578); a sweep in degrees must go beyond 4")
    return True


def doubtful_drag(given: NDArray[np.float64], reynolds: NDArray[np.float64] | None) -> tuple[str, ...]:
    """Return a warning if drag is far below the friction of a flat plate at these Reynolds numbers.

    >>> doubtful_drag(np.array([0.03, 0.04]), np.array([60e3, 60e3]))
    ()
    >>> len(doubtful_drag(np.array([0.03, 0.04]), np.array([60.0, 60.0])))
    1
    """
    stream = np.empty(0) if reynolds is None else reynolds[np.isfinite(reynolds) & (reynolds >= 1)]
    drag = np.sort(given[np.isfinite(given)])
    if not len(stream) or not len(drag):
        return ()
    low, least = float(np.median(stream)), float(np.median(drag[: max(len(drag) // 4, 1)]))
    friction = _BLASIUS / math.sqrt(low)
    if not 0 < least < _LEAST_SHARE * friction:
        return ()
    return (
        f"C_D is {least:.2g} at its lowest, but the friction of a flat plate at Re {low:.3g} is {friction:.2g} "
        "(Blasius): are the Reynolds numbers in thousands or millions, or is the zero of the drag wrong?",
    )


def refuse_several(faults: FaultList, path: str | Path, polar: PolarSheet) -> None:
    """Note a fault if angles repeat: the table holds several curves, or repeats of one, and a model needs one."""
    angles, first, count = np.unique(np.round(polar.columns["alpha_deg"], 6), return_index=True, return_counts=True)
    twice = int((count > 1).sum())
    if not twice:
        return
    row = int(first[np.argmax(count > 1)])
    again = int(np.flatnonzero(np.round(polar.columns["alpha_deg"], 6) == angles[np.argmax(count > 1)])[1])
    groups = reynolds_groups(polar.columns.get("reynolds"))
    share = f"{twice} of {len(angles)} angles repeat{'s' * (twice == 1)}"
    rule = f"also stands in row {polar.sheet.rows[again][0]}, and a model needs one curve ({share})"
    fix = f"keep one branch if these are two (sweeps up and down); if not, fit a curve: {fitting(path, polar)}"
    if len(groups) > 1:
        known = polar.columns["reynolds"]
        rows = [(known >= low) & (known <= high) for low, high in groups]
        most = int(np.argmax([part.sum() for part in rows]))
        values = ", ".join(f"{low:.0f}" + f" to {high:.0f}" * (high > low) for low, high in groups)
        rule = f"repeats, and the table holds several Reynolds numbers ({values}); a model needs one curve"
        chosen = f" --reynolds-range {math.floor(groups[most][0])} {math.ceil(groups[most][1])}"
        fix = f"keep the rows of one, or fit one range: {fitting(path, polar, rows[most], chosen)}"
    faults.add(polar.where(row, "alpha_deg"), float(angles[np.argmax(count > 1)]), rule, fix)


# Reynolds numbers closer than this ratio are one stream: a pump or a fan keeps its speed within some per cent.
SAME_STREAM = 1.15


def reynolds_groups(reynolds: NDArray[np.float64] | None) -> list[tuple[float, float]]:
    """Return the lowest and highest Reynolds number of each group, rising; groups lie 15 per cent apart or more.

    >>> reynolds_groups(np.array([20e3, 60e3, 20.5e3]))
    [(20000.0, 20500.0), (60000.0, 60000.0)]
    """
    if reynolds is None:
        return []
    known = np.unique(reynolds[np.isfinite(reynolds)])
    ends = np.flatnonzero(known[1:] > SAME_STREAM * known[:-1]) + 1
    return [(float(part[0]), float(part[-1])) for part in np.split(known, ends) if len(part)]


def fitting(
    path: str | Path, polar: PolarSheet, rows: NDArray[np.bool_] | slice = slice(None), more: str = ""
) -> str:
    """Return the command that fits a model to `rows` with the options `more`, or what to measure for it."""
    alpha, lift = polar.columns["alpha_deg"][rows], polar.columns["C_L"][rows]
    low, high = float(alpha.min()), float(alpha.max())
    sides = [len(np.unique(alpha[sign * lift > 0])) >= 3 for sign in (-1, 1)]
    form = "su-fan" if low >= 0 and high > 60 else "cambered"
    if form == "cambered" and max(-low, high) > 60:
        more += " --alpha-min=-60 --alpha-max=60"
    if form == "cambered" and not all(sides) and not (low >= 0 and zero_lift(alpha, lift) is not None):
        return "no form fits one side of a cambered wing; measure three angles or more on each side of zero lift"
    model = shlex.quote(str(Path(path).with_suffix(".toml").name))
    return f"wingbeat fit {shlex.quote(str(path))} --form {form}{more} -o {model} (then give {model})"


# Lift at 0 degrees up to which a wing is taken as symmetric, from a line through the rows up to this angle [deg].
_SYMMETRIC, _LINE_DEG = 0.06, 6.0


def zero_lift(alpha_deg: NDArray[np.float64], lift: NDArray[np.float64]) -> float | None:
    """Return the lift at 0 degrees of a table of one side if it is nearly zero, as on a symmetric wing; else None.

    >>> zero_lift(np.array([0.0, 2, 4, 6]), np.array([0.01, 0.21, 0.40, 0.61])) is not None
    True
    >>> zero_lift(np.array([0.0, 2, 4, 6]), np.array([0.31, 0.51, 0.70, 0.91])) is None
    True
    """
    near = (alpha_deg >= 0) & (alpha_deg <= _LINE_DEG)
    if len(np.unique(alpha_deg[near])) < 2:
        return None
    at_zero = float(np.polyval(np.polyfit(alpha_deg[near], lift[near], 1), 0.0))
    return at_zero if abs(at_zero) <= _SYMMETRIC else None
