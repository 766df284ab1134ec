"""Coefficients from a table of measurements: a curve that keeps the rows' shape, extended to every angle."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from wingbeat._base import FaultList
from wingbeat._base.sheets import Sheet, same_name
from wingbeat._jax.arrays import horner, jax, jnp
from wingbeat.aero.blends import Jet
from wingbeat.aero.coefficient_model import CoefficientModel, Kernel, check_aspect_ratio
from wingbeat.aero.extension import check_drag_of_joins, check_extension, extend
from wingbeat.aero.monotone import monotone_curve
from wingbeat.aero.polar_sheet import REQUIRED as REQUIRED_IN_FILE
from wingbeat.aero.polar_sheet import PolarSheet, doubtful_drag, fitting, read_polar, refuse_several
from wingbeat.aero.table_checks import (
    OPTIONAL,
    REQUIRED,
    check_columns,
    check_coverage,
    is_whole_turn,
    numbers,
)

if TYPE_CHECKING:
    from numpy.typing import NDArray
    from scipy.interpolate import PPoly

    from wingbeat._jax.shapes import Angles, Cells, PieceColumns, Scalar


# Cells in which a table is looked up; more if rows are so close that two would be in one cell. With this look-up a
# flight with quintics takes less time than one with cubics and a binary search did: 0.48 in place of 0.52 ms.
_CELLS = 2048
# Coefficients of a quintic.
_ORDER = 6


class TablePieces(NamedTuple):
    """Piecewise quintics over the angle [rad]: one column for each piece, shape (13, n-1) and (7, n-1).

    A column holds the angle where the piece begins and the coefficients, constant first, of C_L and C_D, or of
    x_cp. Equal cells of width `cell` divide the table; `cells` holds the number of the piece in which each begins.
    """

    loads: PieceColumns
    centres: PieceColumns
    cells: Cells
    cell: Scalar

    @classmethod
    def of(cls, knots: NDArray[np.float64], lift: PPoly, drag: PPoly, centre: PPoly | None) -> TablePieces:
        """Return the pieces of the curves through the columns of a table."""
        count, span = _CELLS, knots[-1] - knots[0]
        while span / count > np.diff(knots).min():
            count *= 2
        starts = knots[0] + np.arange(count) * (span / count)
        cells = np.searchsorted(knots[:-1], starts, side="right") - 1.0
        none = np.full((_ORDER, len(knots) - 1), np.nan)
        loads = np.vstack([knots[:-1], lift.c[::-1], drag.c[::-1]])
        centres = np.vstack([knots[:-1], none if centre is None else centre.c[::-1]])
        return cls(loads, centres, cells, span / count)

    def _value(self, pieces: PieceColumns, first: int, alpha: Angles) -> Angles:
        pieces, cells = jnp.asarray(pieces), jnp.asarray(self.cells)
        begin = pieces[0]
        cell = jnp.clip((alpha - begin[0]) / self.cell, 0, cells.size - 1).astype(jnp.int32)
        piece = jnp.round(cells[cell]).astype(jnp.int32)
        after = jnp.minimum(piece + 1, begin.size - 1)
        piece = jnp.where(alpha >= begin[after], after, piece)
        return horner(tuple(pieces[first : first + _ORDER][:, piece]), alpha - begin[piece])

    def lift(self, alpha: Angles) -> Angles:
        """Return C_L at `alpha` [rad]."""
        return self._value(self.loads, 1, alpha)

    def drag(self, alpha: Angles) -> Angles:
        """Return C_D at `alpha` [rad]."""
        return self._value(self.loads, 1 + _ORDER, alpha)

    def centre(self, alpha: Angles) -> Angles:
        """Return x_cp at `alpha` [rad]; NaN where the table has none."""
        return self._value(self.centres, 1, alpha)


class WholeTurnKernel(NamedTuple):
    """Coefficients tabulated from -pi to pi, used without extension; a JAX pytree."""

    pieces: TablePieces

    def lift_drag(self, alpha: Angles) -> tuple[Angles, Angles]:
        """Return C_L and C_D at `alpha` [rad], any shape."""
        return self.pieces.lift(alpha), self.pieces.drag(alpha)

    def centre_of_pressure(self, alpha: Angles) -> Angles:
        """Return x_cp at `alpha` [rad], any shape; NaN where the table has none."""
        return self.pieces.centre(alpha)


@dataclass(frozen=True)
class TableCoefficients(CoefficientModel):
    """Quasi-steady coefficients of a wing strip, from a table.

    Between two rows each coefficient is monotone, so it never leaves their values; slope and curvature are
    continuous (`wingbeat.aero.monotone`). A table from 0 to at least 90 degrees is extended like a formula; rows
    beyond 90 degrees only shape the slope there. A table with rows down to -90 degrees or below needs the extension
    `signed`. A table from -180 to 180 is periodic and used without extension; its `extension` is `signed`.

    Parameters
    ----------
    name : name of the model.
    alpha_deg : angles of attack [deg], rising, shape (n,).
    c_l, c_d : coefficients of lift, within -5 to 5, and of drag, above 0 and at most 5, shape (n,).
    x_cp : centre of pressure in chords from the leading edge, within -1 to 2, shape (n,), or None.
    citation : source of the table.
    reynolds_range : chord Reynolds numbers of the measurements, or None.
    extension : how the table is extended to all angles (`wingbeat.aero.extension`).
    blend_width_deg : half width of the blends where pieces meet [deg], in (0, 3].
    aspect_ratio : of the wing that was measured [-], infinite for a section, None if not stated.
    notes : what a reader of the table's file should know, such as columns that are not used.

    Raises
    ------
    InvalidInputError : not numbers, columns of different length, angles that do not rise or look like radians,
        coefficients that no wing has, fewer than 4 rows, too short a range of angles, an extension that does not
        fit the range, a blend in which drag is not positive.

    >>> alpha = np.arange(0.0, 91.0, 5.0)
    >>> lift, drag = np.sin(2 * np.deg2rad(alpha)), 1.02 - np.cos(2 * np.deg2rad(alpha))
    >>> plate = TableCoefficients("plate", alpha, lift, drag)
    >>> round(float(plate.lift(np.deg2rad(-45.0))), 6)
    -1.0
    """

    name: str
    alpha_deg: tuple[float, ...]
    c_l: tuple[float, ...]
    c_d: tuple[float, ...]
    x_cp: tuple[float, ...] | None = None
    citation: str = ""
    reynolds_range: tuple[float, float] | None = None
    extension: str = "mirrored"
    blend_width_deg: float = 1.0
    aspect_ratio: float | None = None
    notes: tuple[str, ...] = field(default=(), compare=False)

    def __post_init__(self) -> None:
        faults = FaultList()
        check_aspect_ratio(faults, "aspect_ratio", self.aspect_ratio)
        check_extension(faults, self.extension, self.blend_width_deg)
        raw = {name: getattr(self, name) for name in (*REQUIRED, *OPTIONAL) if getattr(self, name) is not None}
        columns = {name: numbers(faults, list(raw[name]), lambda i, name=name: f"{name}[{i}]") for name in raw}
        for name, column in columns.items():
            if len(column) != len(columns["alpha_deg"]):
                rule = f"must have as many numbers as alpha_deg, which has {len(columns['alpha_deg'])}"
                faults.add(name, f"{len(column)} numbers", rule)
        faults.raise_if_any()
        check_columns(faults, columns, lambda i, name: f"{name}[{i}]")
        faults.raise_if_any()
        check_coverage(faults, columns, self.extension, lambda i, name: f"{name}[{i}]")
        faults.raise_if_any()
        for name, column in columns.items():
            object.__setattr__(self, name, tuple(column))
        if is_whole_turn(self.alpha_deg):
            object.__setattr__(self, "extension", "signed")
            return
        drag = self._curve(self.c_d)

        def jet(at: float) -> Jet:
            return Jet(*(float(drag(at, order)) for order in range(3)))

        check_drag_of_joins(faults, f"{self.name}, c_d", jet, self.blend_width_deg, *self._how)
        faults.raise_if_any()

    def __str__(self) -> str:
        return f"{self.name} ({self.citation or 'no source given'})"

    @property
    def alpha_range_deg(self) -> tuple[float, float]:  # type: ignore[override]
        """Lowest and highest angle of the table [deg]."""
        return self.alpha_deg[0], self.alpha_deg[-1]

    @property
    def has_centre_of_pressure(self) -> bool:
        """Whether the table has a centre of pressure."""
        return self.x_cp is not None

    def kernel(self) -> Kernel:
        """Return the JAX pytree that evaluates this table.

        Theory: equation ``table-spline``.
        """
        centre = None if self.x_cp is None else self._curve(self.x_cp)
        knots = np.deg2rad(self.alpha_deg)
        pieces = TablePieces.of(knots, self._curve(self.c_l), self._curve(self.c_d), centre)
        if is_whole_turn(self.alpha_deg):
            return WholeTurnKernel(jax.tree.map(jnp.asarray, pieces))
        return extend(pieces, self.blend_width_deg, *self._how)

    @property
    def _how(self) -> tuple[str, tuple[str, ...]]:
        """The extension, and which coefficients the table also states at negative angles."""
        return self.extension, ("lift", "drag", "centre") if self.extension == "signed" else ()

    def _curve(self, column: tuple[float, ...]) -> PPoly:
        """Return the curve through a column; that of a whole turn is periodic."""
        knots, periodic = np.deg2rad(self.alpha_deg), is_whole_turn(self.alpha_deg)
        return monotone_curve(knots, np.array(column), periodic=periodic)


def _stated_aspect_ratio(faults: FaultList, sheet: Sheet) -> float | None:
    """Return the aspect ratio that a comment of the file states, such as ``# aspect_ratio = 6``."""
    for key, (row, text) in sheet.constants.items():
        if same_name(key) == "aspectratio":
            where = f"{sheet.file} row {row}, aspect_ratio"
            stated = math.inf if text == "inf" else numbers(faults, [text], lambda _, where=where: where)[0]
            if not math.isnan(stated):
                check_aspect_ratio(faults, where, stated)
            return stated
    return None


def _whole_centre(polar: PolarSheet) -> tuple[list[float] | None, tuple[str, ...]]:
    """Return x_cp in every row, and notes; empty cells, where there is no force, are filled from neighbours."""
    given = polar.columns.get("x_cp")
    if given is None:
        return None, ()
    known = np.isfinite(given)
    if known.sum() < 2:
        return None, ("x_cp: no two rows have a value, so the model has no centre of pressure",)
    if known.all():
        return given.tolist(), ()
    alpha = polar.columns["alpha_deg"]
    filled = np.interp(alpha, alpha[known], given[known])
    angles = ", ".join(f"{angle:g}" for angle in alpha[~known][:8]) + ", ..." * bool((~known).sum() > 8)
    return filled.tolist(), (f"x_cp is empty at {angles} degrees and is filled from the neighbouring rows",)


def load_table(path: str | Path, extension: str = "mirrored", blend_width_deg: float = 1.0) -> TableCoefficients:
    """Read a coefficient table from a CSV file with the columns alpha_deg, C_L, C_D and, if known, x_cp, reynolds.

    Columns may have any order and spelling (alpha, c_l, CL, Cd, Re), with or without a unit in brackets. Others are
    ignored; the model's `notes` name them. Blank rows and rows that begin with # are skipped. One such row may
    state the wing's aspect ratio, for example ``# aspect_ratio = 6``, or ``inf`` for a section; the model of
    induced flow needs it.

    Parameters
    ----------
    path : the CSV file; angles in degrees.
    extension, blend_width_deg : as in `TableCoefficients`.

    Raises
    ------
    FileError : the file is missing or cannot be read.
    InvalidInputError : inputs that `TableCoefficients` refuses, each fault with its row and column; a table that is
        not one curve from 0 to at least 90 degrees, with the command that makes a curve of it.
    """
    faults = FaultList()
    check_extension(faults, extension, blend_width_deg)
    polar = read_polar(path, faults)
    aspect_ratio = _stated_aspect_ratio(faults, polar.sheet)
    columns = {name.lower(): polar.columns[name].tolist() for name in REQUIRED_IN_FILE}
    if not faults.faults:
        refuse_several(faults, path, polar)
        faults.raise_if_any()
    centre, notes = _whole_centre(polar)
    if centre is not None:
        columns["x_cp"] = centre

    def where(row: int, name: str) -> str:
        return polar.where(row, {"c_l": "C_L", "c_d": "C_D"}.get(name, name))

    shape = FaultList()
    check_columns(shape, columns, where)
    if not (faults.faults or shape.faults):
        if columns["alpha_deg"][-1] < 90:
            rule = "the table must reach at least 90 degrees"
            last = len(polar.sheet.rows) - 1
            fix = f"a fit completes it: {fitting(path, polar)}"
            faults.add(where(last, "alpha_deg"), columns["alpha_deg"][last], rule, fix)
        else:
            check_coverage(shape, columns, extension, where)
    noted = {fault.where for fault in faults.faults}
    turned = any(fault.where.endswith(f"column {polar.headings['alpha_deg']}") for fault in faults.faults)
    faults.faults += [
        fault for fault in shape.faults if fault.where not in noted and not (turned and "alpha" in fault.where)
    ]
    faults.raise_if_any()
    stream = polar.columns.get("reynolds", np.empty(0))
    stream = stream[np.isfinite(stream)]
    return TableCoefficients(
        Path(path).stem,
        *(tuple(columns[name]) for name in REQUIRED),
        x_cp=None if centre is None else tuple(centre),
        citation=polar.sheet.file,
        reynolds_range=(float(stream.min()), float(stream.max())) if len(stream) else None,
        extension=extension,
        blend_width_deg=blend_width_deg,
        aspect_ratio=aspect_ratio,
        notes=(*polar.notes, *notes, *doubtful_drag(polar.columns["C_D"], polar.columns.get("reynolds"))),
    )
