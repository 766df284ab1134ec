"""What a worker does: it solves points and returns outcomes, each of which depends on its inputs alone.

Nothing here knows of stores, processes or clusters.
"""

from __future__ import annotations

import functools
import json
import time
from collections.abc import Hashable, Iterator, Mapping
from typing import Any, NamedTuple

from wingbeat._workers.process import Context
from wingbeat.orbits.batch import Answers, Known, best_of_guesses, find_with_known, kind, numbers_of
from wingbeat.orbits.options import Status
from wingbeat.orbits.solution import Solution, search_near
from wingbeat.orbits.solve import Settings
from wingbeat.records.orbit_record import orbit_record
from wingbeat.studies.recipe import Recipe, recipe_from, starts_of
from wingbeat.studies.units import Outcome, Unit, failed

# Number of recipes that a process keeps set up.
_KEPT = 64
# Number of results of a chain that predict the next result: a parabola along the chain needs no more.
_PREDICTING = 8


def solve_units(units: list[Unit], context: Context) -> None:
    """Solve a batch of units in a worker process, and report the outcome of each point, in order."""
    for unit in units:
        for outcome in solve_unit(unit):
            context.report(outcome)


def solve_unit(unit: Unit) -> Iterator[Outcome]:
    """Yield the outcome of each point, in order; any error at a point becomes its outcome."""
    before: list[_Before] = []
    for task in unit.tasks:
        if task.key in unit.skip:
            continue
        begun = time.perf_counter()
        try:
            found, known = _search(unit.recipe, task.changes, before)
            if found.status is Status.CONVERGED:
                before.append(known)
            record = orbit_record(found)
            record.pop("solve_seconds")  # of the run, not of the point
            misses = record["closure"].values()
            certificate = None if None in misses else max(map(abs, misses))
            told = json.dumps(record, separators=(",", ":"), allow_nan=False)
            text = "" if found.status is Status.CONVERGED else record["message"]
            outcome = Outcome(task.key, record["status"], told, certificate, text, time.perf_counter() - begun)
        except Exception as error:  # whatever a user's numbers or functions raise is told beside the point
            text = f"{type(error).__name__}: {error}"
            outcome = failed(task.key, "error", text, time.perf_counter() - begun)
        yield outcome


class _Before(NamedTuple):
    """A solved point of a chain: its kind and its result."""

    kind: Hashable
    known: Known


def _search(recipe: str, changes: Mapping[str, Any], before: list[_Before]) -> tuple[Solution, _Before]:
    """Solve one point; in a chain, with the help of the earlier results."""
    made = _recipe(recipe)
    search = made.search
    problem = made.problem(changes)
    most = None if search["most_starts"] is None else int(search["most_starts"])
    settings = Settings(starts_of(made, problem), int(search["seed"]), most, search["advise"], search["explain"])
    own, numbers = kind(problem), numbers_of(problem)
    like = [one.known for one in before[-_PREDICTING:] if one.kind == own]
    near = best_of_guesses(problem, Answers(like, [numbers]).predict(0))
    if before and near is None:
        near = search_near(problem, before[-1].known.unknowns)
    found = find_with_known(problem, near, settings)
    return found, _Before(own, Known(numbers, found.unknowns, found.active_bounds, found.reduced_hessian))


@functools.lru_cache(_KEPT)
def _recipe(inputs: str) -> Recipe:
    return recipe_from(json.loads(inputs))
