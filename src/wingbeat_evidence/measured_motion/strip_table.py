"""The table of strips of a measured motion: one row for each time and strip."""

from __future__ import annotations

from collections.abc import Iterable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import WHOLE, FaultList, suggest
from wingbeat._base.sheets import Sheet, parse_numbers

Array = NDArray[np.float64]

# The columns of the arrays of a case.
_COLUMNS = {
    "position": ("x_m", "y_m", "z_m"),
    "chord": ("chord_x_m", "chord_y_m", "chord_z_m"),
    "area": ("area_m2",),
    "velocity": ("vx_m_s", "vy_m_s", "vz_m_s"),
    "rear_velocity": ("v3x_m_s", "v3y_m_s", "v3z_m_s"),
}
_OPTIONAL = ("velocity", "rear_velocity")
# Faults of one kind that are listed one by one.
LISTED = 5
# Most cells in the table of times and strips for each row of the file; a table without gaps has one cell a row.
_MOST_CELLS = 100


class StripTable(NamedTuple):
    """The table of strips as arrays, and the row of the file that contains each time and strip."""

    arrays: dict[str, Array | None]
    rows: NDArray[np.int64]
    file: str

    def where(self, name: str, index: tuple[int, ...]) -> str:
        """Return the file, row and column of an element of an array."""
        if len(index) == 0:
            return self.file
        column = "time_s" if name == "times" else _COLUMNS[name][index[2] if len(index) > 2 else 0]
        if name == "chord" and len(index) == 2:
            column = "chord"
        return f"{self.file} row {self.rows[index[0], index[1] if len(index) > 1 else 0]}, column {column}"


def check_columns(faults: FaultList, sheet: Sheet, needed: Iterable[str], known: Iterable[str]) -> bool:
    """Note columns that are missing, unknown or named twice; return True if there are none."""
    before = len(faults.faults)
    where = f"{sheet.file} row {sheet.header_row}"
    known = list(known)
    for name in needed:
        if name not in sheet.header:
            faults.add(
                f"{where}, column {name}", "", "the column is missing", f"the columns are {', '.join(known)}"
            )
    for k, name in enumerate(sheet.header):
        if name not in known:
            faults.add(f"{where}, column {k + 1}", name, "is not a known column", suggest(name, known))
        elif name in sheet.header[:k]:
            faults.add(f"{where}, column {k + 1}", name, "appears twice", "keep one")
    return len(faults.faults) == before


def read_strips(faults: FaultList, sheet: Sheet) -> StripTable | None:
    """Return the strips of a table, or None if a fault was noted."""
    known = ["time_s", "strip", *(column for columns in _COLUMNS.values() for column in columns)]
    wanted = {name: columns for name, columns in _COLUMNS.items() if name not in _OPTIONAL}
    wanted |= {name: _COLUMNS[name] for name in _OPTIONAL if set(_COLUMNS[name]) & set(sheet.header)}
    needed = ["time_s", "strip", *(column for columns in wanted.values() for column in columns)]
    if not check_columns(faults, sheet, needed, known):
        return None
    before = len(faults.faults)
    numbers = parse_numbers(faults, sheet, sheet.header)
    if len(faults.faults) > before:
        return None
    by_name = {name: numbers[:, k] for k, name in enumerate(sheet.header)}
    order = _grid(faults, sheet, by_name["time_s"], by_name["strip"])
    if order is None:
        return None
    arrays: dict[str, Array | None] = {"times": by_name["time_s"][order[:, 0]], **dict.fromkeys(_OPTIONAL)}
    for name, columns in wanted.items():
        stacked = np.stack([by_name[column][order] for column in columns], axis=-1)
        arrays[name] = stacked[..., 0] if name == "area" else stacked
    rows = np.array([row for row, _ in sheet.rows])[order]
    return StripTable(arrays, rows, sheet.file)


def _grid(faults: FaultList, sheet: Sheet, time: Array, strip: Array) -> NDArray[np.int64] | None:
    """Return the row of each time and strip, shape (times, strips); None if some are missing."""
    if not len(time):
        faults.add(sheet.file, "0 rows", "holds no strips", "write one row for each time and strip")
        return None
    before = len(faults.faults)
    odd = np.flatnonzero((strip != np.round(strip)) | (np.abs(strip) > 1e6))
    for i in odd[:LISTED]:
        where = f"{sheet.file} row {sheet.rows[i][0]}, column strip"
        faults.add(where, float(strip[i]), WHOLE, "number the strips along the wing")
    if len(odd):
        return None
    order = np.argsort(strip, kind="stable")
    falls = (np.diff(strip[order]) == 0) & (np.diff(time[order]) <= 0)
    for i in order[1:][falls][:LISTED]:
        where = f"{sheet.file} row {sheet.rows[i][0]}, column time_s"
        rule = f"is not later than the previous time of strip {strip[i]:g}"
        faults.add(where, float(time[i]), rule, "sort the rows by time, and keep one row for each time and strip")
    if falls.any():
        return None
    times, at = np.unique(time, return_inverse=True)
    names, which = np.unique(strip, return_inverse=True)
    if len(times) * len(names) > _MOST_CELLS * len(time):  # it could ask for more memory than there is
        rule = f"are too few for {len(names)} strips at each of {len(times)} times"
        faults.add(sheet.file, f"{len(time)} rows", rule, "write all strips at the same times")
        return None
    grid = np.full((len(times), len(names)), -1, dtype=np.int64)
    grid[at, which] = np.arange(len(time))
    missing = np.argwhere(grid < 0)
    for i, k in missing[:LISTED]:
        rule = f"has no row at {times[i]:g} s; a strip needs a row at every time"
        fix = "add the missing rows, or leave out the whole strip"
        faults.add(f"{sheet.file}, strip {names[k]:g}", f"{(grid[:, k] >= 0).sum()} rows", rule, fix)
    if len(missing) > LISTED:
        rule = "are missing in total: the table must have a row for every strip at every time"
        faults.add(sheet.file, f"{len(missing)} rows", rule, "write all strips at the same times")
    return grid if len(faults.faults) == before else None
