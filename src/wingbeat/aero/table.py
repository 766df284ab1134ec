"""Coefficients from a table of measurements: a curve that keeps the rows' shape, extended to every angle."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._jax.config import jax, jnp
from wingbeat._jax.elementary import horner
from wingbeat.aero.blends import Jet
from wingbeat.aero.coefficient_model import CoefficientModel, Kernel, check_aspect_ratio
from wingbeat.aero.extension import check_drag_of_joins, check_extension, extend
from wingbeat.aero.polar_sheet import REQUIRED as REQUIRED_IN_FILE
from wingbeat.aero.polar_sheet import PolarSheet, fitting, read_polar, refuse_several
from wingbeat.aero.table_checks import (
    OPTIONAL,
    REQUIRED,
    check_columns,
    check_coverage,
    is_whole_turn,
    numbers,
)
from wingbeat.errors import FaultList
from wingbeat.sheets import Sheet, same_name

if TYPE_CHECKING:
    from wingbeat._jax.shapes import Angles, Knots, Spline


class TablePieces(NamedTuple):
    """Piecewise cubics over the angle [rad]; the coefficients (4, n-1) go from the constant to the cubic term."""

    knots: Knots
    lift_spline: Spline
    drag_spline: Spline
    centre_spline: Spline

    def _value(self, spline: Spline, alpha: Angles) -> Angles:
        knots, spline = jnp.asarray(self.knots), jnp.asarray(spline)
        segment = jnp.searchsorted(knots[1:-1], alpha, side="right")
        return horner(tuple(spline[:, segment]), alpha - knots[segment])

    def lift(self, alpha: Angles) -> Angles:
        """Return C_L at `alpha` [rad]."""
        return self._value(self.lift_spline, alpha)

    def drag(self, alpha: Angles) -> Angles:
        """Return C_D at `alpha` [rad]."""
        return self._value(self.drag_spline, alpha)

    def centre(self, alpha: Angles) -> Angles:
        """Return x_cp at `alpha` [rad]; NaN where the table has none."""
        return self._value(self.centre_spline, alpha)


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

    Between two rows each coefficient is monotone, so it never leaves their values: the curve is the piecewise cubic
    of Fritsch and Butland 1984 (doi 10.1137/0905021), whose slope is continuous. A table from 0 to at least 90
    degrees is extended like a formula; rows beyond 90 degrees only shape the slope there. A table with rows down to
    -90 degrees or below needs the extension `signed`. A table from -180 to 180 is periodic and used without
    extension; its `extension` is `signed`.

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
        none = np.full((4, len(self.alpha_deg) - 1), np.nan)
        splines = [none if row is None else self._curve(row).c[::-1] for row in (self.c_l, self.c_d, self.x_cp)]
        pieces = TablePieces(np.deg2rad(self.alpha_deg), *splines)
        if is_whole_turn(self.alpha_deg):
            return WholeTurnKernel(jax.tree.map(jnp.asarray, pieces))
        return extend(pieces, self.blend_width_deg, *self._how)

    @property
    def _how(self) -> tuple[str, tuple[str, ...]]:
        """The extension, and which coefficients the table also states at negative angles."""
        return self.extension, ("lift", "drag", "centre") if self.extension == "signed" else ()

    def _curve(self, values: tuple[float, ...]) -> Any:
        """Return SciPy's piecewise cubic through a column; that of a whole turn has one slope at both ends.

        Theory: equation ``table-slope``.
        """
        # Imported here, because SciPy is slow to import and the formulas do not need it.
        from scipy.interpolate import PchipInterpolator, PPoly

        knots = np.deg2rad(self.alpha_deg)
        if not is_whole_turn(self.alpha_deg):
            return PchipInterpolator(knots, values)
        # The slope at a row depends on the row before and the row after it.
        around = np.concatenate([knots[-2:-1] - 2 * np.pi, knots, knots[1:2] + 2 * np.pi])
        wrapped = PchipInterpolator(around, (values[-2], *values, values[1]))
        return PPoly(wrapped.c[:, 1:-1], knots)


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
        notes=(*polar.notes, *notes),
    )
