"""A table of measured coefficients with their errors, and its CSV file."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from wingbeat._version import __version__
from wingbeat.errors import FaultList
from wingbeat.experiment.record import refuse_radians
from wingbeat.files import write_atomically
from wingbeat.sheets import Sheet, check_unit, parse_numbers, read_sheet, split_unit

QUANTITIES = ("C_L", "C_D", "C_M", "x_cp")
REQUIRED = ("alpha_deg", "C_L", "C_D")
_KNOWN = (
    *("alpha_deg", "reynolds"),
    *(f"{name}{kind}" for name in QUANTITIES for kind in ("", "_sd", "_se")),
    "runs",
)
# An empty cell says that the quantity is undefined there: no centre of pressure without a force.
_MAY_BE_EMPTY = frozenset(("C_M", "C_M_sd", "C_M_se", "x_cp", "x_cp_sd", "x_cp_se"))

Columns = dict[str, NDArray[np.float64]]


@dataclass(frozen=True)
class CoefficientTable:
    """Measured coefficients, one row for each point.

    Parameters
    ----------
    alpha_deg : angles of attack [deg], shape (n,).
    mean : C_L, C_D and, if measured, C_M and x_cp, each of shape (n,); NaN where x_cp is undefined.
    sd, se : standard deviation of the samples and standard error of the mean, under the names in `mean`, where
        known.
    reynolds : chord Reynolds numbers, shape (n,), or None.
    runs : number of runs averaged in each row, shape (n,), or None.
    notes : notes for the reader.

    Raises
    ------
    InvalidInputError : columns of different length, angles or coefficients that are not finite, an error below 0.
    """

    alpha_deg: NDArray[np.float64]
    mean: Columns
    sd: Columns = field(default_factory=dict)
    se: Columns = field(default_factory=dict)
    reynolds: NDArray[np.float64] | None = None
    runs: NDArray[np.intp] | None = None
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        faults = FaultList()
        for name in ("C_L", "C_D"):
            if name not in self.mean:
                faults.add("mean", ", ".join(self.mean), f"must hold {name}", "measure it")
        for name, column in self.columns().items():
            kind = name[-3:]
            if np.shape(column) != np.shape(self.alpha_deg):
                faults.add(name, f"shape {np.shape(column)}", f"must be {np.shape(self.alpha_deg)}, as alpha_deg")
            elif name not in _MAY_BE_EMPTY and not np.isfinite(column).all():
                row = int(np.argmin(np.isfinite(column)))
                faults.add(f"{name}[{row}]", float(column[row]), "must be finite", "drop the row")
            elif kind in ("_sd", "_se") and (column < 0).any():
                row = int(np.argmax(column < 0))
                faults.add(f"{name}[{row}]", float(column[row]), "must be >= 0", "an error has no sign")
        faults.raise_if_any()

    def columns(self) -> Columns:
        """Return all columns by their name in the file."""
        columns: Columns = {"alpha_deg": self.alpha_deg}
        if self.reynolds is not None:
            columns["reynolds"] = self.reynolds
        for name in QUANTITIES:
            for kind, group in (("", self.mean), ("_sd", self.sd), ("_se", self.se)):
                if name in group:
                    columns[name + kind] = group[name]
        if self.runs is not None:
            columns["runs"] = self.runs.astype(np.float64)
        return columns

    def between(self, lowest_deg: float, highest_deg: float) -> CoefficientTable:
        """Return the rows between two angles.

        Parameters
        ----------
        lowest_deg, highest_deg : angles of attack [deg], both included.

        Raises
        ------
        InvalidInputError : no row is between the angles.
        """
        keep = (self.alpha_deg >= lowest_deg) & (self.alpha_deg <= highest_deg)
        if not keep.any():
            faults = FaultList()
            rule = f"holds no row: the angles run from {self.alpha_deg.min():g} to {self.alpha_deg.max():g}"
            faults.add("alpha range", f"{lowest_deg:g} to {highest_deg:g}", rule, "widen it")
            faults.raise_if_any()

        def kept(group: Columns) -> Columns:
            return {name: column[keep] for name, column in group.items()}

        reynolds = None if self.reynolds is None else self.reynolds[keep]
        runs = None if self.runs is None else self.runs[keep]
        mean, sd, se = kept(self.mean), kept(self.sd), kept(self.se)
        return CoefficientTable(self.alpha_deg[keep], mean, sd, se, reynolds, runs, self.notes)

    def save(self, path: str | Path) -> None:
        """Write the table as CSV, with notes as # lines above it; cells of undefined quantities are empty.

        Parameters
        ----------
        path : of the file to write.

        Raises
        ------
        FileError : the file cannot be written.
        """
        columns = self.columns()
        lines = [f"# reduced by wingbeat {__version__}; angles in degrees, x_cp in chords from the leading edge"]
        lines += [f"# note: {note}" for note in self.notes]
        lines.append(",".join(columns))
        for row in zip(*columns.values(), strict=True):
            lines.append(",".join("" if np.isnan(value) else f"{value:.8g}" for value in row))
        write_atomically(path, "\n".join(lines) + "\n")


def load_measurements(path: str | Path) -> CoefficientTable:
    """Read a table of measured coefficients from CSV.

    The columns alpha_deg, C_L and C_D are required. reynolds, C_M, x_cp, runs and errors (C_L_sd, C_L_se, ...) are
    read if present. Other columns are refused, because a misspelt error column would otherwise be ignored.

    Parameters
    ----------
    path : of the CSV file.

    Raises
    ------
    FileError : the file is missing or cannot be read.
    InvalidInputError : missing or unknown columns, cells that are not numbers, angles in radians, and what
        `CoefficientTable` refuses, each fault with its row and column.
    """
    sheet, faults = read_sheet(path), FaultList()
    names = _names(faults, sheet)
    faults.raise_if_any()
    numbers = parse_numbers(faults, sheet, names, blank=_MAY_BE_EMPTY)
    _check_rows(faults, sheet, dict(zip(names, numbers.T, strict=True)))
    faults.raise_if_any()
    columns = {name: numbers[:, k].copy() for k, name in enumerate(names)}
    where = f"{sheet.file}, column alpha_deg"
    refuse_radians(where, columns["alpha_deg"])

    def group(kind: str) -> Columns:
        return {name: columns[name + kind] for name in QUANTITIES if name + kind in columns}

    runs = columns["runs"].astype(np.intp) if "runs" in columns else None
    return CoefficientTable(
        columns["alpha_deg"], group(""), group("_sd"), group("_se"), columns.get("reynolds"), runs
    )


def _names(faults: FaultList, sheet: Sheet) -> list[str]:
    names: list[str] = []
    for k, cell in enumerate(sheet.header):
        name, unit = split_unit(cell)
        where = f"{sheet.file} row {sheet.header_row}, column {k + 1}"
        if name not in _KNOWN:
            fix = "radians times 57.29578 are alpha_deg" if "alpha" in name else f"known are {', '.join(_KNOWN)}"
            faults.add(where, cell, "is not a known column", fix)
        elif name in names:
            faults.add(where, cell, "appears twice", "keep one")
        check_unit(faults, where, unit, "deg" if name == "alpha_deg" else "")
        names.append(name)
    for name in REQUIRED:
        if name not in names:
            where = f"{sheet.file} row {sheet.header_row}, column {name}"
            faults.add(where, ",".join(sheet.header), "the column is missing", f"needed are {', '.join(REQUIRED)}")
    if not sheet.rows:
        faults.add(f"{sheet.file} row {sheet.header_row}", "", "has no row of numbers", "add the measurements")
    return names


def _check_rows(faults: FaultList, sheet: Sheet, columns: Columns) -> None:
    """Note errors below 0, impossible Reynolds numbers, and angles beyond half a turn."""
    for name, column in columns.items():
        bad = np.zeros(len(column), dtype=bool)
        rule = fix = ""
        if name.endswith(("_sd", "_se")):
            bad, rule, fix = column < 0, "must be >= 0", "an error has no sign"
        elif name in ("reynolds", "runs"):
            bad, rule, fix = column <= 0, "must be > 0", "was the stream at rest?"
        elif name == "alpha_deg":
            bad, rule, fix = np.abs(column) > 180, "must lie between -180 and 180 degrees", "wrap the angle"
        for i in np.flatnonzero(bad):
            faults.add(f"{sheet.file} row {sheet.rows[i][0]}, column {name}", float(column[i]), rule, fix)
