"""A series of problems, each a little different from the last; solutions pass to the neighbours and back."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Sequence

from wingbeat._base import FaultList
from wingbeat._workers.pool import in_processes
from wingbeat.orbits.many.batch import check_processes
from wingbeat.orbits.options.solver import DEFAULTS, SolverOptions
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.solution import Solution, better_of
from wingbeat.orbits.solve import Progress, find_orbit, search_near
from wingbeat.orbits.status import Status


def find_series(
    problems: Sequence[OrbitProblem],
    starts: int | None = None,
    seed: int = 0,
    processes: int = 1,
    progress: Progress | None = None,
    most_starts: int | None = None,
    advise: bool = False,
    options: SolverOptions = DEFAULTS,
) -> list[Solution]:
    """Solve a series of problems, such as increasing speeds, from starts and from the neighbours' solutions.

    A start from the stock wingbeat finds the family of orbits that is near it. Solutions are passed up and down the
    series, so that the best family found for any problem reaches every problem where it exists. All problems must
    have the same free parameters.

    Parameters
    ----------
    problems : in an order in which neighbours are similar.
    starts, seed, most_starts, advise, options : as in `find_orbit`, for each problem before solutions are passed
        on.
    processes : how many Python processes share these starts. The results do not depend on it.
    progress : called with (problems solved, problems in all).

    Returns
    -------
    The solutions. Their numbers of `starts` include the starts from neighbours.

    Raises
    ------
    InvalidInputError : problems that differ in what is free; starts, seed, most_starts or processes out of range.
    """
    faults = FaultList()
    for i, problem in enumerate(problems):
        if problem.free != problems[0].free:
            fix = f"give all problems the same free parameters: {', '.join(problems[0].free)}"
            faults.add(
                f"problems[{i}].free", problem.free, "differs from the free parameters of the first problem", fix
            )
    check_processes(faults, processes)
    faults.raise_if_any()
    asked = {"starts": starts, "seed": seed, "most_starts": most_starts, "advise": advise, "options": options}
    search = functools.partial(find_orbit, threads=1, **asked)
    best = list(in_processes(search, problems, processes, progress))
    tried: set[tuple[bytes, int]] = set()
    upward = [(i, i + 1) for i in range(len(best) - 1)]
    downward = [(i + 1, i) for i in reversed(range(len(best) - 1))]
    for sweep in range(options.continuation.sweeps):
        better = False
        for giver, taker in upward if sweep % 2 == 0 else downward:
            key = (best[giver].unknowns.tobytes(), taker)
            if best[giver].status is Status.CONVERGED and key not in tried:
                tried.add(key)
                best[taker], found = _hand_on(best[giver], best[taker])
                better |= found
        if sweep and not better:
            break
    return best


def _hand_on(giver: Solution, own: Solution) -> tuple[Solution, bool]:
    """Return the better of two solutions, and whether it is the second.

    The first is the problem's own solution; the second is found from the solution of a neighbour.
    """
    below = float("inf")
    if own.status is Status.CONVERGED:
        below = own.objective - own.options.continuation.improvement * abs(own.objective)
    found = search_near(own.problem, giver.unknowns, below, own.options)
    if found is None:
        return dataclasses.replace(own, starts=own.starts + 1), False
    return better_of(own, found), True
