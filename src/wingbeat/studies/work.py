"""What a worker does: points in, outcomes out, each of its inputs alone.

Nothing here knows of stores, processes or clusters; an engine calls `solve_unit` wherever it likes.
"""

from __future__ import annotations

import functools
import json
import time
from collections.abc import Iterator, Mapping
from typing import Any

from wingbeat.orbits.continuation import hand_on
from wingbeat.orbits.solution import Solution, Status
from wingbeat.orbits.solve import find_orbit
from wingbeat.results.orbit import Orbit
from wingbeat.studies.recipe import Recipe, recipe_from
from wingbeat.studies.units import Outcome, Unit, failed

__all__ = ["solve_unit"]

# Recipes that a process keeps set up.
_KEPT = 64


def solve_unit(unit: Unit) -> Iterator[Outcome]:
    """Yield the outcome of each point, in order; whatever goes wrong with a point is an outcome, too."""
    before: Solution | None = None
    for task in unit.tasks:
        if task.key in unit.skip:
            before = None
            continue
        begun = time.perf_counter()
        try:
            found, asked = _search(unit.recipe, task.changes, before)
            before = found if found.status is Status.CONVERGED else None
            record = Orbit.of(found, *asked).record()
        except Exception as error:  # whatever a user's numbers or functions raise is told beside the point
            before = None
            text = f"{type(error).__name__}: {error}"
            yield failed(task.key, "error", text, time.perf_counter() - begun)
            continue
        yield _outcome(task.key, record, time.perf_counter() - begun)


def _search(recipe: str, changes: Mapping[str, Any], before: Solution | None) -> tuple[Solution, tuple[int, int]]:
    """Solve one point by itself; of a chain, from the answer before, too."""
    made = _recipe(recipe)
    search = made.search
    starts, seed = int(search["starts"]), int(search["seed"])
    most = None if search["most_starts"] is None else int(search["most_starts"])
    problem = made.problem(changes)
    found = find_orbit(problem, starts, seed, threads=1, most_starts=most, advise=search["advise"])
    return (found if before is None else hand_on(before, found)[0]), (starts, seed)


@functools.lru_cache(_KEPT)
def _recipe(inputs: str) -> Recipe:
    return recipe_from(json.loads(inputs))


def _outcome(key: str, record: dict[str, Any], seconds: float) -> Outcome:
    record.pop("solve_seconds")  # of the run, not of the point
    certificate = max(abs(miss) for miss in record["closure"].values() if miss is not None)
    text = "" if record["status"] == Status.CONVERGED.value else record["message"]
    told = json.dumps(record, separators=(",", ":"), allow_nan=False)
    return Outcome(key, record["status"], told, certificate, text, seconds)
