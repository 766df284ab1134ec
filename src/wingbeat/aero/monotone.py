"""A curve through rows that keeps within the values of the two rows around it, with continuous curvature.

Where the cubic spline is monotone between its rows, the curve is the cubic spline. Elsewhere, as at a stall, it is
a quintic whose slopes at the rows are those of Fritsch and Butland 1984 (doi 10.1137/0905021), SciPy's
`PchipInterpolator`. Their piecewise cubic alone would not do: its curvature jumps at each row, and an orbit crosses
hundreds of rows in a beat, because ten strips cross each row twice. Such jumps stop the certifying flight, which is
of order 8. With a row at every second degree of `su-fan`, no orbit of the bat at 5 m/s could be certified.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from wingbeat._jax.shapes import Knots


def monotone_curve(knots: Knots, values: Knots, *, periodic: bool = False) -> Any:
    """Return SciPy's `PPoly` of the quintics through `values` at rising `knots`, monotone between any two of them.

    Theory: equations ``table-slope``, ``table-curvature`` and ``table-monotone``.

    Parameters
    ----------
    knots, values : the rows, four or more, shape (n,).
    periodic : whether the curve repeats itself; the last value is then the first.
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
