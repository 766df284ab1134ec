"""What a worker does: points in, outcomes out, each of its inputs alone.

Nothing here knows of stores, processes or clusters; an engine calls `solve_unit` wherever it likes.
"""

from __future__ import annotations

import functools
import json
import time
from collections.abc import Hashable, Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np

from wingbeat.orbits.batch import find_helped, settle_foretold
from wingbeat.orbits.neighbours import Answers, kind, numbers_of
from wingbeat.orbits.polish import Polish
from wingbeat.orbits.solution import Solution, Status
from wingbeat.orbits.solve import follow
from wingbeat.results.dataset import evaluate
from wingbeat.results.record import orbit_record
from wingbeat.studies.recipe import Recipe, recipe_from, starts_of
from wingbeat.studies.units import Outcome, Unit, failed

__all__ = ["solve_unit"]

# Recipes that a process keeps set up.
_KEPT = 64
# Answers of a chain that foretell the next: a parabola along it needs no more.
_FORETELLING = 8


def solve_unit(unit: Unit) -> Iterator[Outcome]:
    """Yield the outcome of each point, in order; whatever goes wrong with a point is an outcome, too."""
    before: list[_Known] = []
    for task in unit.tasks:
        if task.key in unit.skip:
            continue
        begun = time.perf_counter()
        try:
            known = _search(unit.recipe, task.changes, before)
            if known.solution.status is Status.CONVERGED:
                before.append(known)
            record = _record(known.solution)
        except Exception as error:  # whatever a user's numbers or functions raise is told beside the point
            text = f"{type(error).__name__}: {error}"
            yield failed(task.key, "error", text, time.perf_counter() - begun)
            continue
        yield _outcome(task.key, record, time.perf_counter() - begun)


class _Known(NamedTuple):
    """A solved point: its kind, its numbers, its answer, and what corrected it if it was foretold."""

    kind: Hashable
    numbers: np.ndarray
    solution: Solution
    polish: Polish | None


def _search(recipe: str, changes: Mapping[str, Any], before: list[_Known]) -> _Known:
    """Solve one point; of a chain, with the help of the answers before it."""
    made = _recipe(recipe)
    search = made.search
    problem = made.problem(changes)
    starts = starts_of(made, problem)
    most = None if search["most_starts"] is None else int(search["most_starts"])
    seed = int(search["seed"])
    own, numbers = kind(problem), numbers_of(problem)
    near, polish = settle_foretold(problem, _foretold(own, numbers, before))
    if before and near is None:
        near = follow(problem, before[-1].solution.unknowns)
    found = find_helped(problem, near, starts, seed, most, search["advise"])
    return _Known(own, numbers, found, polish)


def _foretold(own: Hashable, numbers: np.ndarray, before: list[_Known]) -> list[tuple[np.ndarray, Polish | None]]:
    """Return what the answers before a point of a chain foretell of it; those after it have no say."""
    like = [known for known in before[-_FORETELLING:] if known.kind == own]
    answers = Answers([*(known.numbers for known in like), numbers])
    for i, known in enumerate(like):
        answers.add(i, known.solution.unknowns, known.solution.active_bounds, known.polish)
    return answers.foretell(len(like))


@functools.lru_cache(_KEPT)
def _recipe(inputs: str) -> Recipe:
    return recipe_from(json.loads(inputs))


def _record(solution: Solution) -> dict[str, Any]:
    flown = solution.certificate
    loads = evaluate(solution.problem.model, solution.wingbeat, flown.phase, flown.states)
    return orbit_record(solution, loads)


def _outcome(key: str, record: dict[str, Any], seconds: float) -> Outcome:
    record.pop("solve_seconds")  # of the run, not of the point
    certificate = max(abs(miss) for miss in record["closure"].values() if miss is not None)
    text = "" if record["status"] == Status.CONVERGED.value else record["message"]
    told = json.dumps(record, separators=(",", ":"), allow_nan=False)
    return Outcome(key, record["status"], told, certificate, text, seconds)
