"""What the residuals of a fit say: a dependence on Reynolds number, two branches, a wrong row, a useless curve.

Every judgement needs both significance and size: noise alone causes it in less than one of a hundred tables, and a
difference below `LEAST_SHARE` of the quantity's range is not mentioned.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import InvalidInputError
from wingbeat.aero.coefficient_model import MAX_DRAG, MAX_LIFT
from wingbeat.aero.polar_sheet import doubtful_drag, reynolds_groups
from wingbeat.experiment.regression import Array, CurveFit, fit_curve

if TYPE_CHECKING:
    from wingbeat.aero import CoefficientModel

# Least difference worth a warning, as a share of the range of the measured values. Repeated tests of one wing in
# one tunnel differ by some per cent.
LEAST_SHARE = 0.06
# Chance at which the F test says that residuals depend on a group.
_CHANCE = 1e-4
# Hat functions over the angle: for what all groups share, and for how one group differs.
_COMMON, _OWN = 12, 5
# Fewest rows of a group, and of the others beside it, that can show a difference.
_FEW = 4
# A row is wrong if it lies this many standard deviations from the curve through the others, and if its neighbours
# lie closer by this factor. In normal noise 6 happens once in 10^9 rows.
_OUTLYING, _ALONE = 6.0, 0.4
# A curve that leaves half of the variance is no fit, unless the scatter is small beside the values themselves:
# drag near its minimum hardly varies.
LEAST_R_SQUARED, SMALL_SCATTER = 0.5, 0.1
# Ratio of the highest to the lowest Reynolds number from which a range without gaps is compared in parts.
_WIDE = 1.3
# Most sweeps to compare one by one; more of them are compared as all that rise with all that fall.
_SWEEPS = 6


class Difference(NamedTuple):
    """How one group of rows differs from the others: where most [deg], by how much, and the chance of noise."""

    at_deg: float
    size: float
    chance: float


def judge(curve: CurveFit, reynolds: Array | None) -> tuple[str, ...]:
    """Return warnings on the residuals of a fit, in words with numbers."""
    least = LEAST_SHARE * float(np.ptp(curve.values))
    if least <= 0:
        return ()
    groups = reynolds_groups(reynolds)
    if reynolds is not None and len(groups) == 1 and groups[0][1] >= _WIDE * groups[0][0]:
        # A wide range without gaps is cut in thirds.
        thirds = np.array_split(np.unique(reynolds[np.isfinite(reynolds)]), 3)
        groups = [(float(part[0]), float(part[-1])) for part in thirds if len(part)]
    notes: list[str] = []
    parts = [np.arange(len(curve.values))]
    if reynolds is not None and len(groups) > 1:
        members = [np.flatnonzero((reynolds >= low) & (reynolds <= high)) for low, high in groups]
        notes += _of_reynolds(curve, groups, members, least)
        parts = members if notes else [*members, *parts]
    for rows in parts:
        found = _branches(curve, rows, least)
        if found is not None:
            middle = float(curve.form.value(np.array([found.at_deg]), curve.parameters)[0])
            upper, lower = middle + found.upper, middle + found.lower
            notes.append(
                f"{curve.label}: the rows form two branches from {found.from_deg:.3g} to {found.to_deg:.3g} deg: "
                f"{upper:.2g} and {lower:.2g} at {found.at_deg:.3g} deg, and the curve lies between them; are they "
                "sweeps up and down, two wings or two Reynolds numbers? Keep the rows of one branch and fit them "
                "alone"
            )
            break
    doubts = doubtful_drag(curve.values, reynolds) if curve.label == "C_D" else ()
    return (*notes, *_wrong_rows(curve, least), *doubts)


def _of_reynolds(
    curve: CurveFit, groups: list[tuple[float, float]], members: list[NDArray[np.intp]], least: float
) -> list[str]:
    words = []
    for (low, high), rows in zip(groups, members, strict=True):
        inside = np.isin(np.arange(len(curve.values)), rows)
        found = group_difference(curve.alpha_deg, curve.residuals, inside)
        if found is not None and found.chance < _CHANCE / len(groups) and abs(found.size) > least:
            name = f"{low:.0f}" if low == high else f"{low:.0f} to {high:.0f}"
            way = "below" if found.size < 0 else "above"
            lies = f"it lies {abs(found.size):.2g} {way} the other rows"
            words.append(f"at Re {name} {lies} near {found.at_deg:.3g} deg")
    if not words:
        return []
    low, high = groups[int(np.argmax([len(rows) for rows in members]))]
    advice = f"fit one range of Re, for example --reynolds-range {math.floor(low)} {math.ceil(high)}"
    return [f"{curve.label}: the residuals depend on Re: {'; '.join(words)}; {advice}"]


def group_difference(alpha_deg: Array, residuals: Array, inside: NDArray[np.bool_]) -> Difference | None:
    """Return how the residuals of a group of rows differ from those of the others, None if both share too few rows.

    Over the angles that both have, the residuals are fitted by hat functions of the angle, once the same for all
    rows, once with further hats for the group. ``F = ((S1 - S2)/(n1 - n2))/(S2/n2)`` with the sums of squares S and
    their degrees of freedom n has Snedecor's distribution if the group does not differ.
    """
    from scipy.stats import f

    if min(inside.sum(), (~inside).sum()) < _FEW:
        return None
    low = max(alpha_deg[inside].min(), alpha_deg[~inside].min()) - 1e-9
    high = min(alpha_deg[inside].max(), alpha_deg[~inside].max()) + 1e-9
    shared = (alpha_deg >= low) & (alpha_deg <= high)
    a, y, own = alpha_deg[shared], residuals[shared], inside[shared]
    few = int(min(own.sum(), (~own).sum()))
    if few < _FEW:
        return None
    angles = len(np.unique(np.round(a, 2)))
    common = _hats(a, min(_COMMON, max(angles // 2, 2)))
    extra = _hats(a, max(min(_OWN, few // 3, angles // 2), 1))
    full = np.column_stack([common, extra * own[:, None]])
    factors, _, rank, _ = np.linalg.lstsq(full, y)
    alike, _, rank_common, _ = np.linalg.lstsq(common, y)
    left, alone = float(((y - full @ factors) ** 2).sum()), float(((y - common @ alike) ** 2).sum())
    free, more = len(y) - int(rank), int(rank) - int(rank_common)
    if free < 3 or more < 1:
        return None
    effect = factors[common.shape[1] :]
    # At a knot without rows of both, the difference is an extrapolation.
    support = np.minimum(extra[own].sum(axis=0), extra[~own].sum(axis=0)) >= 1.0
    knots = extra.T @ a / np.maximum(extra.sum(axis=0), 1e-12)
    if not support.any():
        return None
    worst = int(np.argmax(np.where(support, np.abs(effect), -1.0)))
    noise = max(left, 1e-24 * max(alone, 1e-24)) / free
    chance = float(f.sf((alone - left) / more / noise, more, free)) if alone > left else 1.0
    return Difference(float(knots[worst]), float(effect[worst]), chance)


def _hats(a: Array, count: int) -> Array:
    """Return hat functions (linear B-splines) with `count` knots over the angles, shape (n, count)."""
    if count < 2:
        return np.ones((len(a), 1))
    knots = np.linspace(a.min(), a.max(), count)
    return np.column_stack([np.interp(a, knots, row) for row in np.eye(count)])


def _branches(curve: CurveFit, rows: NDArray[np.intp], least: float) -> Branches | None:
    """Return two branches among rows: sweeps in the order of the file that differ, or else two clusters."""
    a, left = curve.alpha_deg[rows], curve.residuals[rows]
    sweeps = _sweeps(a)
    if len(sweeps) > _SWEEPS:
        way = [np.sign(a[part[-1]] - a[part[0]]) for part in sweeps]
        sweeps = [np.concatenate([s for s, w in zip(sweeps, way, strict=True) if w == sign]) for sign in set(way)]
    found: list[tuple[float, NDArray[np.bool_]]] = []
    for part in sweeps if len(sweeps) > 1 else ():
        inside = np.isin(np.arange(len(a)), part)
        one = group_difference(a, left, inside)
        if one is not None and one.chance < _CHANCE / len(sweeps) and abs(one.size) > least:
            found.append((abs(one.size), inside))
    if found:
        inside = max(found, key=lambda pair: pair[0])[1]
        return Branches.between(a, left, inside)
    return two_branches(a, left, least)


def _sweeps(a: Array) -> list[NDArray[np.intp]]:
    """Return the rows of each sweep: angles that rise, or fall, over a third of the range in five rows or more."""
    steps = np.sign(np.diff(a))
    sweeps, first = [], 0
    for i in range(1, len(a) + 1):
        if i == len(a) or (i - 1 > first and steps[i - 1] * steps[i - 2] < 0) or steps[i - 1] == 0:
            part = np.arange(first, i)
            if len(part) >= 5 and np.ptp(a[part]) > np.ptp(a) / 3:
                sweeps.append(part)
            first = i
    return sweeps


def _wrong_rows(curve: CurveFit, least: float) -> list[str]:
    """Return a warning for a row that lies far from the curve through all others, while its neighbours do not."""
    left = curve.residuals
    scatter = float(np.sqrt((left**2).sum() / curve.freedom))
    row = int(np.argmax(np.abs(left) / curve.sigma))
    others = np.arange(len(left)) != row
    if abs(left[row]) < max(2.5 * scatter, least):
        return []
    a, y, sigma = (column[others] for column in (curve.alpha_deg, curve.values, curve.sigma))
    try:
        without = fit_curve(a, y, curve.form, sigma if curve.weighted else None, curve.label)
    except InvalidInputError:  # too few rows without it
        return []
    misses = curve.values - without.form.value(curve.alpha_deg, without.parameters)
    near = np.argsort(np.abs(curve.alpha_deg - curve.alpha_deg[row]))[1:5]
    spread = float(np.sqrt((misses[others] ** 2).sum() / without.freedom))
    size = abs(misses[row])
    # Scatter is often a share of the value, as that of drag; where drag is large, so is its scatter.
    curve_there = np.maximum(np.abs(curve.values - misses), 1e-12)
    share = 1.4826 * float(np.median(np.abs(misses[others]) / curve_there[others]))
    spread = max(spread, share * float(curve_there[row]))
    if size < max(_OUTLYING * spread, least) or np.abs(misses[near]).max() > _ALONE * size:
        return []
    value, wanted = float(curve.values[row]), float(curve.values[row] - misses[row])
    ratio = wanted / value if value else math.inf
    guess = "a wrong sign?" if -1.3 < ratio < -0.7 else "is it a mistake?"
    if any(0.7 < ratio / factor < 1.4 for factor in (10.0, 0.1)):
        guess = "a slipped decimal point?"
    return [
        f"{curve.label}: row {row + 1} of the table ({curve.alpha_deg[row]:g} deg) is {value:.4g}, but the curve "
        f"through the other rows gives {wanted:.3g} with a scatter of {spread:.2g}: {guess}"
    ]


def failures(curve: CurveFit) -> tuple[str, ...]:
    """Return why a fitted curve is useless: it misses the data, or it gives what no wing has where they were taken.

    A curve fails if R^2 is below 0, or below 0.5 with a scatter of more than a tenth of the largest value; and if
    the size of C_L exceeds 5, or C_D is not above 0 and at most 5, within the measured angles.
    """
    found = []
    share = float(np.sqrt((curve.residuals**2).mean()) / max(np.abs(curve.values).max(), 1e-12))
    if curve.r_squared < LEAST_R_SQUARED and (share > SMALL_SCATTER or curve.r_squared < 0):
        found.append(
            f"{curve.label}: the curve does not fit: R-squared is {curve.r_squared:.2f}, and the residuals scatter "
            f"by {100 * share:.0f} % of the largest value; try another --form, or look at the rows with --plot"
        )
    angles = np.linspace(curve.alpha_deg.min(), curve.alpha_deg.max(), 361)
    return (*found, *_impossible(curve.label, angles, curve.form.value(angles, curve.parameters)))


def model_failures(model: CoefficientModel, measured_deg: tuple[float, float]) -> tuple[str, ...]:
    """Return why the model that follows from a fit is useless: what no wing has, at any angle of attack."""
    angles = np.arange(-180.0, 180.5)
    alpha = np.deg2rad(angles)
    columns = {"C_L": np.asarray(model.lift(alpha)), "C_D": np.asarray(model.drag(alpha))}
    low, high = measured_deg
    beyond = f"beyond the measured {low:g} to {high:g} deg; measure farther, or choose the form cambered"
    return tuple(f"{text} {beyond}" for name, c in columns.items() for text in _impossible(name, angles, c))


def _impossible(label: str, angles: Array, values: Array) -> list[str]:
    limits = {"C_L": (-MAX_LIFT, MAX_LIFT), "C_D": (0.0, MAX_DRAG)}
    if label not in limits:
        return []
    low, high = limits[label]
    over = np.maximum(values - high, low - values)
    row = int(np.argmax(np.where(np.isfinite(over), over, np.inf)))
    if over[row] < 0 or (over[row] == 0 and label == "C_L"):
        return []
    return [f"{label}: the curve gives {values[row]:.3g} at {angles[row]:g} deg, which no wing has,"]


# For windows of so many rows in the order of the angle: the largest ratio of the sums of squares about two lines
# and about one parabola that says there are two branches. In normal noise, one of 500 tables of 60 rows is below
# the first number, and one of 20 below the second (400 tables for each number). The second counts if the gap is
# also `_GAP` times the scatter between neighbours elsewhere.
_RATIOS = {8: (0.001, 0.014), 10: (0.010, 0.034), 12: (0.030, 0.057), 16: (0.060, 0.10), 20: (0.080, 0.13)}
_RATIOS[28] = (0.115, 0.18)
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
        """Return the branches of rows whose membership is known."""
        low, high = (max(a[inside].min(), a[~inside].min()), min(a[inside].max(), a[~inside].max()))
        grid = np.unique(np.round(a[(a >= low) & (a <= high)], 2))
        means = []
        for rows in (inside, ~inside):  # the means at equal angles, joined by lines
            angles, place = np.unique(np.round(a[rows], 2), return_inverse=True)
            means.append(np.interp(grid, angles, np.bincount(place, residuals[rows]) / np.bincount(place)))
        one, other = means
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


def two_branches(alpha_deg: Array, residuals: Array, least: float) -> Branches | None:
    """Return two branches among rows in any order, or None if one curve with scatter explains them as well.

    In windows over the angle, two lines are put through the residuals, each row to the nearer line. Of scatter
    alone they leave a third of what one parabola leaves; of two branches, almost nothing. A gap below `least` does
    not count.
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
