"""Coefficients from a table of measurements: a curve that keeps the rows' shape, extended to every angle.

Where the cubic spline is monotone between its rows, the curve is the cubic spline. Elsewhere, as at a stall, it is
a quintic whose slopes at the rows are those of Fritsch and Butland 1984 (doi 10.1137/0905021), SciPy's
`PchipInterpolator`. Their piecewise cubic alone would not do: its curvature jumps at each row, and an orbit crosses
hundreds of rows in a beat, because ten strips cross each row twice. Such jumps stop the certifying flight, which is
of order 8. With a row at every second degree of `su-fan`, no orbit of the bat at 5 m/s could be certified.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._base import FaultList
from wingbeat._jax.arrays import horner, jax, jnp
from wingbeat.aero.coefficient_model import (
    CoefficientModel,
    Kernel,
    check_aspect_ratio,
    check_possible,
    is_whole_turn,
)
from wingbeat.aero.extension import Jet, check_drag_of_joins, check_extension, extend

if TYPE_CHECKING:
    from scipy.interpolate import PPoly

    from wingbeat._jax.arrays import Angles, Cells, Knots, PieceColumns, Scalar


def monotone_curve(knots: Knots, values: Knots, *, periodic: bool = False) -> Any:
    """Return SciPy's `PPoly` of the quintics through `values` at rising `knots`, monotone between any two of them.

    Theory: equations ``table-slope``, ``table-curvature`` and ``table-monotone``.
    """
    # Imported here, because SciPy is slow to import and the formulas do not need it.
    from scipy.interpolate import BPoly, CubicSpline, PchipInterpolator, PPoly

    pieces = len(knots) - 1
    # The pieces before and after each row.
    before, after = np.arange(-1, pieces), np.arange(pieces + 1)
    before[0], after[-1] = (pieces - 1, 0) if periodic else (0, pieces - 1)
    steps = np.diff(knots)
    secants = np.diff(values) / steps
    if periodic:
        turn = knots[-1] - knots[0]
        around = np.concatenate([knots[-2:-1] - turn, knots, knots[1:2] + turn])
        slopes = PchipInterpolator(around, np.concatenate([values[-2:-1], values, values[1:2]]))(knots, 1)
    else:
        slopes = PchipInterpolator(knots, values)(knots, 1)
    left, right, secant = np.abs(slopes[:-1]), np.abs(slopes[1:]), np.abs(secants)
    needed = np.maximum(0.4 * (left + right), (2 * (left + right) + np.maximum(left, right)) / 7)
    share = np.divide(secant, needed, out=np.ones_like(secant), where=needed > secant)
    slopes = slopes * np.minimum(share[before], share[after])
    at_begin = (6 * secants - 4 * slopes[:-1] - 2 * slopes[1:]) / steps
    at_end = (-6 * secants + 2 * slopes[:-1] + 4 * slopes[1:]) / steps
    one, other = at_end[before], at_begin[after]
    if not periodic:
        one[0], other[-1] = other[0], one[-1]
    curvatures = np.where(one * other > 0, np.where(np.abs(one) < np.abs(other), one, other), 0.0)
    spline = CubicSpline(knots, values, bc_type="periodic" if periodic else "not-a-knot")
    # A row keeps the spline's slope and curvature unless a piece beside it is then not monotone.
    limited = np.zeros(pieces + 1, dtype=bool)
    while True:
        slope = np.where(limited, slopes, spline(knots, 1))
        curvature = np.where(limited, curvatures, spline(knots, 2))
        # A quintic is monotone if its control polygon is.
        first, last = steps * slope[:-1], steps * slope[1:]
        begin, end = steps**2 * curvature[:-1] / 20, steps**2 * curvature[1:] / 20
        middle = steps * secants - 0.4 * (first + last) + end - begin
        rises = np.stack([first, first / 5 + begin, middle, last / 5 - end, last])
        good = np.where(secants == 0, (rises == 0).all(axis=0), (rises * np.sign(secants) >= 0).all(axis=0))
        more = (~good[before] | ~good[after]) & ~limited
        if not more.any():
            jets = np.column_stack([values, slope, curvature])
            return PPoly.from_bernstein_basis(BPoly.from_derivatives(knots, jets))
        limited |= more


COLUMNS = ("alpha_deg", "c_l", "c_d")
MIN_ROWS = 4
# No instrument sets angles more finely, and a curve through closer rows would be a step.
CLOSEST_DEG = 1e-3
# Coefficients that differ by less are the same but for rounding, as the sines of -180 and 180 degrees are.
_SAME = 1e-6
Where = Callable[[int, str], str]


def numbers(faults: FaultList, cells: Sequence[Any], where: Callable[[int], str]) -> list[float]:
    """Return the cells as floats; a cell that is not a number becomes NaN and is noted as a fault."""
    values = []
    for i, cell in enumerate(cells):
        values.append(math.nan)
        try:
            number = float(cell)
        except (TypeError, ValueError):
            rule = "is empty" if isinstance(cell, str) and not cell.strip() else "is not a number"
            faults.add(where(i), cell, rule, "write one number with a decimal point")
            continue
        if math.isfinite(number):
            values[-1] = number
        else:
            faults.add(where(i), number, "must be finite", "drop the row or give a value")
    return values


def check_columns(faults: FaultList, columns: dict[str, list[float]], where: Where) -> None:
    """Note angles that do not rise, coefficients that no wing has, and too few rows."""
    angles = columns["alpha_deg"]
    falls = [i for i in range(1, len(angles)) if angles[i] <= angles[i - 1]]
    if falls:
        share = f" ({len(falls)} of {len(angles)} rows)" if len(falls) > 1 else ""
        rule = f"must be above the {angles[falls[0] - 1]:g} before it{share}"
        fix = "sort the rows by angle and drop duplicates; of sweeps up and down, keep one"
        fix = "the angles fall: reverse the order of the rows" if len(falls) == len(angles) - 1 else fix
        faults.add(where(falls[0], "alpha_deg"), angles[falls[0]], rule, fix)
    for i, angle in enumerate(angles):
        if i and 0 < angle - angles[i - 1] < CLOSEST_DEG:
            rule = f"must be at least {CLOSEST_DEG:g} degrees above the {angles[i - 1]:g} before it"
            faults.add(where(i, "alpha_deg"), angle, rule, "merge the two rows")
        if abs(angle) > 180:
            faults.add(where(i, "alpha_deg"), angle, "must lie between -180 and 180 degrees", "wrap the angle")
    for name, column in columns.items():
        check_possible(faults, name, column, lambda i, name=name: where(i, name))
    if len(angles) < MIN_ROWS:
        faults.add("rows", len(angles), f"must be at least {MIN_ROWS} for a curve", "measure at more angles")


def check_coverage(faults: FaultList, columns: dict[str, list[float]], extension: str, where: Where) -> None:
    """Note a table that covers fewer angles than its extension needs, or more negative angles than it uses.

    A whole turn whose last row differs from its first by rounding is closed: its last row becomes its first.
    """
    angles = columns["alpha_deg"]
    first, last = angles[0], angles[-1]
    at_first, at_last = where(0, "alpha_deg"), where(len(angles) - 1, "alpha_deg")
    if max(abs(first), abs(last)) <= 2 * math.pi:
        rule = f"is the largest angle of a column from {first:g} to {last:g}, which looks like radians"
        faults.add(at_last, last, rule, "write alpha_deg in degrees, from 0 to at least 90")
        return
    if last < 90:
        faults.add(at_last, last, "the table must reach at least 90 degrees", "measure at larger angles")
    if first > 0:
        faults.add(at_first, first, "the table must begin at 0 degrees or below", "add a row for 0")
    if is_whole_turn(angles):
        for name, column in columns.items():
            if name == "alpha_deg":
                continue
            if abs(column[-1] - column[0]) > _SAME:
                rule = f"must equal the value at -180 degrees, {column[0]:g}"
                faults.add(where(len(angles) - 1, name), column[-1], rule, "repeat the row of -180 at 180")
            else:
                column[-1] = column[0]
    elif first < 0 and extension != "signed":
        rule = f"is negative, and the extension {extension} would ignore it"
        more = "use signed" if first <= -90 else "add rows down to -90 and use signed"
        drop = "drop the negative rows" + (" and use mirrored" if extension == "signed-drag" else "")
        faults.add(at_first, first, rule, f"{drop}, or {more}")
    elif first > -90 and extension.startswith("signed"):
        rule = "the extension signed needs the table to begin at -90 degrees or below"
        rule = "the extension signed-drag has no effect on a table" if extension == "signed-drag" else rule
        fix = "use mirrored" if first >= 0 else "add rows down to -90, or drop the negative rows and use mirrored"
        faults.add(at_first, first, rule, fix)


# Cells in which a table is looked up; more if rows are so close that two would be in one cell. With this look-up a
# flight with quintics takes less time than one with cubics and a binary search did: 0.48 in place of 0.52 ms.
_LOOKUP_CELLS = 2048
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
    continuous (`wingbeat.aero.table`). A table from 0 to at least 90 degrees is extended like a formula; rows
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
        raw = {name: getattr(self, name) for name in (*COLUMNS, "x_cp") if getattr(self, name) is not None}
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
        knots, count = np.deg2rad(self.alpha_deg), _LOOKUP_CELLS
        span = knots[-1] - knots[0]
        while span / count > np.diff(knots).min():
            count *= 2
        starts = knots[0] + np.arange(count) * (span / count)
        cells = np.searchsorted(knots[:-1], starts, side="right") - 1.0
        centre = np.full((_ORDER, len(knots) - 1), np.nan) if self.x_cp is None else self._curve(self.x_cp).c[::-1]
        loads = np.vstack([knots[:-1], self._curve(self.c_l).c[::-1], self._curve(self.c_d).c[::-1]])
        pieces = TablePieces(loads, np.vstack([knots[:-1], centre]), cells, span / count)
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
