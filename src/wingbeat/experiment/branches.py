"""Two branches in measurements of one curve, such as sweeps up and down through a stall with hysteresis."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

# For windows of so many rows in the order of the angle: the largest ratio of the sums of squares about two lines
# and about one parabola that says there are two branches. In normal noise, one of 500 tables of 60 rows is below
# the first number, and one of 20 below the second (400 tables for each number). The second counts if the gap is
# also `_GAP` times the scatter between neighbours elsewhere.
_RATIOS = {8: (0.001, 0.014), 10: (0.010, 0.034), 12: (0.030, 0.057), 16: (0.060, 0.10), 20: (0.080, 0.13)}
_RATIOS |= {28: (0.115, 0.18)}
_GAP = 6.0
# Fewest rows of each branch, and least share of rows whose nearest angle is on the other branch: one half if
# branches alternate, and nearly none where the curve jumps or bends at a stall, as repeats of an angle are alike.
_BOTH, _MIXED = 3, 0.3
# Branches at angles of their own: fewest changes from one angle to the next, and their least share.
_TURNS, _ALTERNATING = 4, 0.6
# Part of the largest gap down to which two branches count as apart.
_APART = 0.4


class Branches(NamedTuple):
    """Where two branches are apart [deg], where most, and their residuals there."""

    from_deg: float
    to_deg: float
    at_deg: float
    upper: float
    lower: float

    @classmethod
    def between(cls, a: Array, residuals: Array, inside: NDArray[np.bool_]) -> Branches:
        """Return the branches of rows whose membership is known.

        Parameters
        ----------
        a, residuals : angles [deg] and residuals, shape (n,).
        inside : the rows of one branch, shape (n,).
        """
        low, high = (max(a[inside].min(), a[~inside].min()), min(a[inside].max(), a[~inside].max()))
        grid = np.unique(np.round(a[(a >= low) & (a <= high)], 2))
        one, other = (_curve(grid, a[rows], residuals[rows]) for rows in (inside, ~inside))
        gap = np.abs(one - other)
        worst = int(np.argmax(gap))
        apart = gap > _APART * gap[worst]
        first = last = worst
        while first > 0 and apart[first]:
            first -= 1
        while last < len(grid) - 1 and apart[last]:
            last += 1
        pair = float(one[worst]), float(other[worst])
        return cls(float(grid[first]), float(grid[last]), float(grid[worst]), max(pair), min(pair))


def _curve(grid: Array, a: Array, y: Array) -> Array:
    """Return the means at equal angles, joined by lines."""
    angles, place = np.unique(np.round(a, 2), return_inverse=True)
    return np.interp(grid, angles, np.bincount(place, y) / np.bincount(place))


def two_branches(alpha_deg: Array, residuals: Array, least: float) -> Branches | None:
    """Return two branches among rows in any order, or None if one curve with scatter explains them as well.

    In windows over the angle, two lines are put through the residuals, each row to the nearer line. Of scatter
    alone they leave a third of what one parabola leaves; of two branches, almost nothing.

    Parameters
    ----------
    alpha_deg, residuals : angles [deg] and residuals of one curve, shape (n,).
    least : least gap that counts.

    >>> a = np.repeat(np.arange(12.0), 2)
    >>> noise = 0.01 * np.sin(9.0 * np.arange(24) ** 2)
    >>> two_branches(a, noise, 0.1) is None
    True
    >>> two_branches(a, noise + np.tile([0.2, -0.2], 12), 0.1).upper > 0.1
    True
    """
    order = np.argsort(alpha_deg, kind="stable")
    a, y = alpha_deg[order], residuals[order]
    found: list[tuple[float, NDArray[np.intp], NDArray[np.bool_]]] = []
    for size, (strict, loose) in _RATIOS.items():
        for first in range(0, len(a) - size + 1, max(size // 4, 1)):
            rows = np.arange(first, first + size)
            if np.ptp(y[rows]) < least or y[rows].std() < least * np.sqrt(_BOTH / size * (1 - _BOTH / size)):
                continue  # too close together for such a gap
            lines = _two_lines(a[rows], y[rows])
            if lines is None:
                continue
            ratio, upper = lines
            gap = float(y[rows][upper].mean() - y[rows][~upper].mean())
            if ratio > loose or abs(gap) < least or not _mixed(a[rows], upper):
                continue
            if ratio < strict or abs(gap) > _GAP * _scatter(y, rows):
                found.append((ratio / strict, rows, upper))
    if not found:
        return None
    _, rows, upper = min(found, key=lambda one: one[0])
    # Carry the two lines outward from the best window: each row belongs to the nearer of its neighbours' branches.
    label = np.zeros(len(a), dtype=int)
    label[rows] = np.where(upper, 1, -1)
    for i in [*range(rows[-1] + 1, len(a)), *range(rows[0] - 1, -1, -1)]:
        near = np.argsort(np.abs(a - a[i]) + 1e9 * (label == 0))[:6]
        levels = [y[near][label[near] == side] for side in (1, -1)]
        if all(len(level) for level in levels):
            label[i] = 1 if abs(y[i] - levels[0].mean()) < abs(y[i] - levels[1].mean()) else -1
    known = label != 0
    return Branches.between(a[known], y[known], label[known] > 0)


def _two_lines(a: Array, y: Array) -> tuple[float, NDArray[np.bool_]] | None:
    """Return the ratio of the sums of squares about two lines and one parabola, and the rows of the upper line."""
    x = (a - a.mean()) / max(float(np.ptp(a)), 1e-9)
    one = np.column_stack([np.ones_like(x), x, x**2])
    whole = float(((y - one @ np.linalg.lstsq(one, y)[0]) ** 2).sum())
    flat = y - _line(x, y, np.ones(len(x), dtype=bool))
    ranked = np.sort(flat)
    widest = int(np.argmax(np.diff(ranked)))
    best: tuple[float, NDArray[np.bool_]] | None = None
    for cut in (float(np.median(flat)), 0.5 * float(ranked[widest] + ranked[widest + 1])):
        upper = flat > cut
        for _ in range(8):
            if min(upper.sum(), (~upper).sum()) < _BOTH:
                break
            high, low = _line(x, y, upper), _line(x, y, ~upper)
            nearer = np.abs(y - high) < np.abs(y - low)
            left = float(np.minimum((y - high) ** 2, (y - low) ** 2).sum())
            if best is None or left / max(whole, 1e-300) < best[0]:
                best = left / max(whole, 1e-300), nearer
            if (nearer == upper).all():
                break
            upper = nearer
    return best if best is not None and min(best[1].sum(), (~best[1]).sum()) >= _BOTH else None


def _line(x: Array, y: Array, rows: NDArray[np.bool_]) -> Array:
    """Return at all places the line of least squares through some rows."""
    at, mean = float(x[rows].mean()), float(y[rows].mean())
    away = x[rows] - at
    return mean + float(away @ (y[rows] - mean)) / max(float(away @ away), 1e-300) * (x - at)


def _mixed(a: Array, upper: NDArray[np.bool_]) -> bool:
    """Return whether both branches are at the same angles, or take turns from one angle to the next."""
    apart = np.abs(a[:, None] - a)
    np.fill_diagonal(apart, np.inf)
    nearest = apart <= apart.min(axis=1, keepdims=True) + 1e-6
    share = (nearest & (upper[:, None] != upper)).sum(axis=1) / nearest.sum(axis=1)
    place = np.unique(np.round(a, 3), return_inverse=True)[1]
    turns = int(np.abs(np.diff(np.bincount(place, upper) > 0.5 * np.bincount(place))).sum())
    return float(share.mean()) >= _MIXED or turns >= max(_TURNS, _ALTERNATING * place.max())


def _scatter(y: Array, rows: NDArray[np.intp]) -> float:
    """Return the scatter of rows outside a window, from differences of neighbours; infinite if there are few."""
    steps = np.abs(np.diff(y))
    outside = np.ones(len(steps), dtype=bool)
    outside[max(rows[0] - 1, 0) : rows[-1] + 1] = False
    return 1.4826 / np.sqrt(2) * float(np.median(steps[outside])) if outside.sum() >= 8 else np.inf
