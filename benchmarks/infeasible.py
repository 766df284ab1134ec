"""Problems without an answer: is the right balance named, and does the change proposed fly? Prints Markdown.

Run from the root of a clone::

    uv run python benchmarks/infeasible.py [--kinds "too heavy" ...]

Each of thirty problems is solved; the smallest change proposed is applied and the problem solved again from
nothing, with another seed; and once more with nine tenths of the change: would a smaller one have done?
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable
from typing import Any

from infeasible_cases import Case, cases, drawn

import wingbeat as wb
from wingbeat.orbits.changes import Relaxation, with_change
from wingbeat.orbits.solution import Solution
from wingbeat.orbits.solve import Settings, find_orbit

# Searches for an orbit that is not expected.
_FEW = 12
SEED = 20
_SHARE = 0.9


def named_right(case: Case, found: Solution) -> bool:
    """Say whether the law that fails most is one of those that must, and a limit is named where there is one."""
    limits = all(str(limit) in found.message for limit in case.problem.subject_to)
    return bool(found.shortages) and found.shortages[0].law in case.laws and limits


def flies(case: Case, change: Relaxation) -> bool:
    """Solve the problem with the change made, from nothing and with another seed."""
    return find_orbit(change.apply(case.problem), Settings(seed=1, advise=False)).status is wb.Status.CONVERGED


def less_flies(case: Case, change: Relaxation) -> bool:
    """Solve the problem with a part of the change made."""
    value = change.old + _SHARE * (change.new - change.old)
    problem = with_change(case.problem, change.name, change.sign, value)
    return find_orbit(problem, Settings(seed=1, most_starts=_FEW, advise=False)).status is wb.Status.CONVERGED


def row_of(case: Case) -> tuple[tuple[Any, ...], Solution]:
    """Return the cells of a case, and its solution."""
    begun = time.process_time()
    found = find_orbit(case.problem)
    seconds = time.process_time() - begun
    first = found.relaxations[0] if found.relaxations else None

    def answer(ask: Callable[[Case, Relaxation], bool]) -> str:
        return "-" if first is None else ("yes" if ask(case, first) else "no")

    right = "yes" if named_right(case, found) else "no"
    short = "; ".join(str(s) for s in found.shortages if abs(s.share) >= 0.2 * abs(found.shortages[0].share))
    changes = "; ".join(r.text for r in found.relaxations)
    cells = (case.kind, case.what, short, right, changes, answer(flies), answer(less_flies), f"{seconds:.0f}")
    return cells, found


def name_drawn(count: int) -> None:
    """Print what is named for problems drawn at random, and how often it is what their kind is made to fail by."""
    right = infeasible = 0
    for case in drawn(count, SEED):
        found = find_orbit(case.problem, Settings(2, most_starts=_FEW, advise=False))
        if found.status is wb.Status.INFEASIBLE:
            infeasible += 1
            right += named_right(case, found)
            short = "; ".join(str(s) for s in found.shortages[:2])
            print("|", " | ".join((case.kind, case.what, short, str(named_right(case, found)))), "|", flush=True)
    print(f"\n{infeasible} of {6 * count} are infeasible; the law of their kind is named in {right}.")


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--kinds", nargs="+")
    arguments.add_argument("--drawn", type=int, help="name the law only, of so many drawn at random of each kind")
    given = arguments.parse_args()
    if given.drawn:
        name_drawn(given.drawn)
        return
    chosen = [case for case in cases() if given.kinds is None or case.kind in given.kinds]
    heads = (
        "kind",
        "problem",
        "missing",
        "right balance",
        "changes that fly",
        "first flies",
        "0.9 of it",
        "CPU s",
    )
    print("|", " | ".join(heads), "|")
    print("| --- " * len(heads) + "|")
    right = flying = infeasible = 0
    for case in chosen:
        cells, found = row_of(case)
        print("|", " | ".join(cells), "|", flush=True)
        infeasible += found.status is wb.Status.INFEASIBLE
        right += cells[3] == "yes"
        flying += cells[5] == "yes"
    print(f"\n{infeasible} of {len(chosen)} are infeasible; the right balance is named in {right}; ", end="")
    print(f"the smallest proposed change flies in {flying}.")


if __name__ == "__main__":
    main()
