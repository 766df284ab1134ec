"""A table of measured coefficients with their errors, and its CSV file."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import FaultList, __version__
from wingbeat._base.sheets import write_columns
from wingbeat.aero.polar_sheet import QUANTITIES, read_polar, reynolds_groups

# NaN says that the quantity is undefined or not known there: no centre of pressure without a force.
_MAY_BE_EMPTY = frozenset(("C_M", "C_M_sd", "C_M_se", "x_cp", "x_cp_sd", "x_cp_se", "reynolds"))

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
            if np.shape(column) != np.shape(self.alpha_deg):
                faults.add(name, f"shape {np.shape(column)}", f"must be {np.shape(self.alpha_deg)}, as alpha_deg")
            elif name not in _MAY_BE_EMPTY and not np.isfinite(column).all():
                faults.first(name, column, ~np.isfinite(column), "must be finite", "drop the row")
            elif name.endswith(("_sd", "_se")):
                faults.first(name, column, column < 0, "must be >= 0", "an error has no sign")
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

    def between(
        self, lowest_deg: float = -180.0, highest_deg: float = 180.0, *, reynolds: tuple[float, float] | None = None
    ) -> CoefficientTable:
        """Return the rows between two angles and, if given, between two Reynolds numbers.

        Parameters
        ----------
        lowest_deg, highest_deg : angles of attack [deg], both included.
        reynolds : lowest and highest chord Reynolds number, both included, or None for all rows.

        Raises
        ------
        InvalidInputError : no row is there, or the table has no Reynolds numbers to choose by.
        """
        faults = FaultList()
        keep = (self.alpha_deg >= lowest_deg) & (self.alpha_deg <= highest_deg)
        if not keep.any():
            rule = f"holds no row: the angles run from {self.alpha_deg.min():g} to {self.alpha_deg.max():g}"
            faults.add("alpha range", f"{lowest_deg:g} to {highest_deg:g}", rule, "widen it")
        if reynolds is not None:
            asked = f"{reynolds[0]:g} to {reynolds[1]:g}"
            if self.reynolds is None:
                rule = "the table has no column reynolds"
                faults.add("reynolds range", asked, rule, "add it, or leave the range out")
            else:
                keep = keep & (self.reynolds >= reynolds[0]) & (self.reynolds <= reynolds[1])
                if not (faults.faults or keep.any()):
                    held = " and ".join(f"{low:.0f} to {high:.0f}" for low, high in reynolds_groups(self.reynolds))
                    faults.add("reynolds range", asked, f"holds no row: the table has Re {held}", "widen it")
        faults.raise_if_any()
        return self._changed(lambda _, column: column[keep])

    def with_mirror_image(self) -> CoefficientTable:
        """Return the table with each row above 0 degrees again at the opposite angle, as on a symmetric wing.

        Lift and moment change their sign there; drag, centre of pressure and errors do not.
        """
        above, odd = self.alpha_deg > 0, ("alpha_deg", "C_L", "C_M")
        return self._changed(lambda name, c: np.concatenate([c, -c[above] if name in odd else c[above]]))

    def _changed(self, change: Callable[[str, NDArray[Any]], NDArray[Any]]) -> CoefficientTable:
        """Return the table with each column replaced by what `change` makes of its name and itself."""
        mean, sd, se = (
            {name: change(name + kind, column) for name, column in group.items()}
            for kind, group in (("", self.mean), ("_sd", self.sd), ("_se", self.se))
        )
        reynolds, runs = (None if column is None else change("", column) for column in (self.reynolds, self.runs))
        return CoefficientTable(change("alpha_deg", self.alpha_deg), mean, sd, se, reynolds, runs, self.notes)

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
        write_columns(path, lines, columns)


def load_measurements(path: str | Path) -> CoefficientTable:
    """Read a table of measured coefficients from CSV.

    The columns alpha_deg, C_L and C_D are required. reynolds, C_M, x_cp, runs and errors (C_L_sd, C_L_se, ...) are
    read if present. Columns may have any order and spelling (alpha, c_l, CL, Cd, Re). Others are ignored; the
    table's notes name them.

    Parameters
    ----------
    path : of the CSV file.

    Raises
    ------
    FileError : the file is missing or cannot be read.
    InvalidInputError : missing columns, cells that are not numbers, angles in radians, coefficients and Reynolds
        numbers that no wing has, each fault with its row and column.
    """
    faults = FaultList()
    polar = read_polar(path, faults)
    faults.raise_if_any()
    columns, notes = dict(polar.columns), list(polar.notes)
    for name, column in polar.columns.items():
        # An error may be empty where its quantity is, such as x_cp where there is no force.
        of = columns.get(name.removesuffix("_sd").removesuffix("_se"), column) if name not in QUANTITIES else column
        lacks = np.isnan(column) & (np.isfinite(of) | (of is column))
        empty = int(lacks.sum())
        if not empty or name in QUANTITIES or name == "reynolds":
            continue
        if name == "runs" or empty == len(column):
            del columns[name]
            notes.append(f"{name} is empty in {empty} of {len(column)} rows, so this column is not used")
        else:
            columns[name] = np.where(lacks, np.nanmedian(column), column)
            notes.append(f"{name} is empty in {empty} of {len(column)} rows, which get the median of the others")
    if "reynolds" in columns and np.isnan(columns["reynolds"]).all():
        del columns["reynolds"]

    def group(kind: str) -> Columns:
        return {name: columns[name + kind] for name in QUANTITIES if name + kind in columns}

    runs = columns["runs"].astype(np.intp) if "runs" in columns else None
    measured = columns["alpha_deg"], group(""), group("_sd"), group("_se")
    return CoefficientTable(*measured, columns.get("reynolds"), runs, tuple(notes))
