"""The table of forces that were measured with a motion: one row for each time of the strips."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import FaultList
from wingbeat._base.sheets import Sheet, parse_numbers
from wingbeat_evidence.measured_motion.strip_table import LISTED, check_columns

Array = NDArray[np.float64]

_FORCES = {"fx_n": "fx", "fz_n": "fz"}
# Every name that a column of standard errors may have.
_ERRORS = {f"{axis}{ending}": axis for axis in ("fx", "fz") for ending in ("_n_se", "_se_n", "_se")}
# Share of a step by which the times of forces and strips may differ.
_SAME_TIME = 0.1


def read_forces(
    faults: FaultList, sheet: Sheet, times: Array | None, window: tuple[Any, Any]
) -> tuple[dict[str, Array], dict[str, Array]] | None:
    """Return forces and their standard errors at the times of the strips, or None if a fault was noted."""
    known = ["time_s", *_FORCES, *(name for name in _ERRORS if name.endswith("_n_se"))]
    if not check_columns(faults, sheet, ["time_s"], [*known, *(set(_ERRORS) - set(known))]):
        return None
    if not set(_FORCES) & set(sheet.header):
        rule = "has neither fx_n nor fz_n"
        faults.add(f"{sheet.file} row {sheet.header_row}", ",".join(sheet.header), rule, "one is enough")
        return None
    before = len(faults.faults)
    numbers = parse_numbers(faults, sheet, sheet.header)
    if len(faults.faults) > before or times is None:
        return None
    by_name = {name: numbers[:, k] for k, name in enumerate(sheet.header)}
    place = _matched(faults, sheet, by_name["time_s"], times, window)
    for name, column in by_name.items():
        rows = np.flatnonzero((name in _ERRORS and _ERRORS[name] + "_n" in by_name) & (column < 0))
        for i in rows[:LISTED]:
            where = f"{sheet.file} row {sheet.rows[i][0]}, column {name}"
            faults.add(where, float(column[i]), "must be >= 0: it is a standard error", "give its absolute value")
    if place is None or len(faults.faults) > before:
        return None

    def at_times(name: str) -> Array:
        column = np.full(len(times), np.nan)
        column[place >= 0] = by_name[name][place[place >= 0]]
        return column

    forces = {axis: at_times(name) for name, axis in _FORCES.items() if name in by_name}
    errors = {axis: at_times(name) for name, axis in _ERRORS.items() if name in by_name and axis in forces}
    return forces, errors


def _matched(
    faults: FaultList, sheet: Sheet, given: Array, times: Array, window: tuple[Any, Any]
) -> NDArray[np.int64] | None:
    """Return the row of forces for each time of the strips; -1 for a time outside the window that has no row."""
    before = len(faults.faults)
    falls = np.flatnonzero(np.diff(given) <= 0) + 1
    for i in falls[:LISTED]:
        where = f"{sheet.file} row {sheet.rows[i][0]}, column time_s"
        faults.add(where, float(given[i]), "is not later than the previous time", "sort the rows by time")
    if len(falls) or not len(given):
        if not len(given):
            faults.add(sheet.file, "0 rows", "holds no forces", "write one row for each time of the strips")
        return None
    low, high = (end if bound is None else bound for bound, end in zip(window, times[[0, -1]], strict=True))
    slack = _SAME_TIME * float(np.diff(times).min()) if len(times) > 1 else 0.0
    after = np.clip(np.searchsorted(given, times), 0, len(given) - 1)
    before_it = np.maximum(after - 1, 0)
    nearest = np.where(np.abs(given[before_it] - times) < np.abs(given[after] - times), before_it, after)
    found = np.abs(given[nearest] - times) <= slack
    judged = (times >= low - slack) & (times <= high + slack)
    # Without a window every row counts, also those before and after the strips.
    rows = len(given) if window == (None, None) else int(((given >= low - slack) & (given <= high + slack)).sum())
    if rows != judged.sum() or not found[judged].all():
        lacking = times[judged & ~found]
        rule = f"must be the same as the {judged.sum()} times of the strips"
        rule += f", but no row is at {lacking[0]:g} s" if len(lacking) else ""
        faults.add(f"{sheet.file}, column time_s", f"{rows} times", rule, "interpolate the forces to these times")
    return np.where(found, nearest, -1) if len(faults.faults) == before else None
