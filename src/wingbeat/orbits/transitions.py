"""Marks along best orbits: where they change branch, where the active bounds change, and gaps."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING, Any, NamedTuple

from wingbeat.orbits.options import Status

if TYPE_CHECKING:
    from wingbeat.orbits.branches import Branches, BranchLink
    from wingbeat.orbits.solution import Solution

GAP, BRANCH, BOUNDS = "gap", "branch", "bounds"
# Words for bounds that cease to be active, and for those that become active: for one name, and for several.
_LEFT = "leaves its bound", "leave their bounds"
_REACHED = "reaches its bound", "reach their bounds"


class Mark(NamedTuple):
    """A change of the best orbit between two neighbouring problems; `what` describes it."""

    kind: str
    lower: float
    upper: float
    what: str


def marks_of(branches: Branches) -> list[Mark]:
    """Return the changes of the best orbit from problem to problem.

    ``gap``: one of the two problems has no certified orbit. ``branch``: no continuation leads from the best orbit
    of one problem to that of the next, so the unknowns jump. ``bounds``: different bounds are active.
    """
    marks = []
    for interval, (below, above) in enumerate(_neighbours(branches)):
        ends = branches.along.of(below.problem), branches.along.of(above.problem)
        if not certified(below) or not certified(above):
            marks.append(Mark(GAP, *ends, f"no certified orbit at one of these {branches.along.name}s"))
            continue
        if _link_of_best(branches, interval) is None:
            marks.append(Mark(BRANCH, *ends, _how_it_changes(branches, interval)))
        gone = [name for name in below.active_bounds if name not in above.active_bounds]
        come = [name for name in above.active_bounds if name not in below.active_bounds]
        parts = [
            f"{', '.join(names)} {words[len(names) > 1]}"
            for names, words in ((gone, _LEFT), (come, _REACHED))
            if names
        ]
        if parts:
            marks.append(Mark(BOUNDS, *ends, "; ".join(parts)))
    return marks


def families(branches: Branches) -> list[list[int]]:
    """Return the family number of each optimum of each problem.

    Families are sorted by the best rank of their optima. A family contains at most one optimum of each problem. If
    two families lead to the same optimum, the family with fewer steps continues.
    """
    labels = [[-1] * len(optima) for optima in branches.optima]
    count = 0
    for place, optima in enumerate(branches.optima):
        ways = [join for join in branches.links if join.interval == place - 1]
        taken: set[int] = set()
        for join in sorted(ways, key=lambda j: j.steps):
            if labels[place][join.upper] < 0 and join.lower not in taken:
                labels[place][join.upper] = labels[place - 1][join.lower]
                taken.add(join.lower)
        for index in range(len(optima)):
            if labels[place][index] < 0:
                labels[place][index] = count
                count += 1
    first = dict.fromkeys(label for rank in range(count) for row in labels for label in row[rank : rank + 1])
    order = {label: number for number, label in enumerate(first)}
    return [[order[label] for label in row] for row in labels]


def certified(solution: Solution) -> bool:
    """Whether a solution is a certified orbit."""
    return solution.status is Status.CONVERGED


def _neighbours(branches: Branches) -> list[Any]:
    best = [optima[0] for optima in branches.optima]
    return list(itertools.pairwise(best))


def _link_of_best(branches: Branches, interval: int) -> BranchLink | None:
    return next((j for j in branches.links if (j.interval, j.lower, j.upper) == (interval, 0, 0)), None)


def _how_it_changes(branches: Branches, interval: int) -> str:
    """Return in words whether two families cross, and where, or whether one of them ends."""
    ways = {j.lower: j.upper for j in branches.links if j.interval == interval}
    back = {upper: lower for lower, upper in ways.items()}
    below, above = branches.optima[interval : interval + 2]
    if 0 in ways and 0 in back:
        before = below[back[0]].objective - below[0].objective
        after = above[ways[0]].objective - above[0].objective
        low, high = (branches.along.of(one[0].problem) for one in (below, above))
        share = before / (before + after) if before + after > 0 else 0.5
        return f"another family becomes better near {low + share * (high - low):.2f} {branches.along.unit}".rstrip()
    if 0 in ways:
        return "a better family begins"
    if 0 in back:
        return "the family ends and another continues"
    return "the family ends and another begins"
