"""The channels of a load cell's file, whatever wrote it: names, units, numbers, clock."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import FaultList
from wingbeat._base.sheets import LARGEST, NO_VALUE, number_in

Array = NDArray[np.float64]
# More than these do not help the reader.
SHOWN_FAULTS, _SHOWN_NAMES = 5, 24


class Recording(NamedTuple):
    """The channels of a file: names, units where the file states them, and how to get their numbers.

    `numbers` returns those of some channels, shape (samples, channels), and `clock` their times [s], or None if the
    file does not say when they were measured. Both note faults. `constants` are values by key, with their row.
    """

    file: str
    kind: str
    names: list[str]
    units: list[str | None]
    numbers: Callable[[FaultList, list[int]], Array]
    clock: Callable[[FaultList, list[int]], Array | None]
    notes: list[str]
    constants: dict[str, tuple[int, str]]

    def shown(self) -> str:
        """Return the names of the channels for a message."""
        more = len(self.names) - _SHOWN_NAMES
        return ", ".join(self.names[:_SHOWN_NAMES]) + (f" and {more} more" if more > 0 else "")


def cell_numbers(faults: FaultList, file: str, rows: list[tuple[int, list[str]]], names: dict[int, str]) -> Array:
    """Return the numbers of some columns of a table of cells, shape (rows, columns); note cells that are none."""
    values = np.full((len(rows), len(names)), np.nan)
    wrong = 0
    for k, (column, name) in enumerate(names.items()):
        cells = [row[1][column] if column < len(row[1]) else "" for row in rows]
        try:
            values[:, k] = cells
        except ValueError:
            values[:, k] = np.nan
        good = np.isfinite(values[:, k]) & (np.abs(values[:, k]) <= LARGEST)
        if good.all() and not any("_" in cell or not cell.isascii() for cell in cells):
            continue
        for (row, _), cell, i in zip(rows, cells, range(len(rows)), strict=True):
            values[i, k] = np.nan if (number := number_in(cell)) is None else number
            if not np.isfinite(values[i, k]) or abs(values[i, k]) > LARGEST:
                wrong += 1
                if wrong <= SHOWN_FAULTS:
                    rule = "has no value" if cell.strip().lower() in NO_VALUE else "is not a number"
                    where = f"{file} row {row}, channel {name}"
                    faults.add(where, cell, rule, "drop the row, or choose another channel")
    if wrong > SHOWN_FAULTS:
        faults.add(file, f"{wrong} cells", "are not numbers; the first are above", "is it the right channel?")
    return values
