"""Many orbit problems, spread over processes; of problems alike, the later ones start from the answers before."""

from __future__ import annotations

import functools
import itertools
import multiprocessing
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from typing import Any, TypeVar

import numpy as np

from wingbeat.errors import FaultList
from wingbeat.orbits.neighbours import Answers, alike, numbers_of
from wingbeat.orbits.polish import Polish
from wingbeat.orbits.problem import OrbitProblem
from wingbeat.orbits.solution import Solution, Status
from wingbeat.orbits.solve import Progress, check_search, find_beside, find_orbit, settle
from wingbeat.orbits.starts import usual_starts

T = TypeVar("T")
R = TypeVar("R")

_MOST_PROCESSES = 1024


def find_orbits(
    problems: Sequence[OrbitProblem],
    starts: int | None = None,
    seed: int = 0,
    processes: int = 1,
    progress: Progress | None = None,
    most_starts: int | None = None,
    advise: bool = False,
) -> Iterator[Solution]:
    """Yield the solution of each problem, in their order; a failed search is data as in `find_orbit`.

    Of problems that differ in numbers only, the first are searched as in `find_orbit`. Of a later one the first
    search starts from what their answers foretell; if that leads to no certified orbit, it does not count.

    Parameters
    ----------
    problems : any mixture of vehicles, air loads, speeds, free parameters and objectives.
    starts, seed, most_starts, advise : as in `find_orbit`, for each problem.
    processes : how many Python processes share the work; with 1 it is done in this one. The answers are the same.
    progress : called with (problems done, problems in all).

    Raises
    ------
    InvalidInputError : a problem that is none, starts, seed, most_starts or processes out of range.
    """
    faults = FaultList()
    for i, problem in enumerate(problems):
        if not isinstance(problem, OrbitProblem):
            faults.add(f"problems[{i}]", problem, "is not an OrbitProblem")
    check_processes(faults, processes)
    faults.raise_if_any()
    check_search(1 if starts is None else starts, seed, 1 if most_starts is None else most_starts)
    solve = functools.partial(_solve_alike, starts=starts, seed=seed, most_starts=most_starts, advise=advise)
    return _in_order(solve, problems, processes, progress)


def check_processes(faults: FaultList, processes: Any) -> None:
    """Note a fault unless it is a whole number of processes."""
    if isinstance(processes, bool) or not isinstance(processes, int) or not 1 <= processes <= _MOST_PROCESSES:
        faults.add("processes", processes, f"must be a whole number from 1 to {_MOST_PROCESSES}")


def _in_order(
    solve: Callable[[Sequence[OrbitProblem]], Iterator[Solution]],
    problems: Sequence[OrbitProblem],
    processes: int,
    progress: Progress | None,
) -> Iterator[Solution]:
    """Solve group by group, and yield each solution when its turn comes."""
    groups = alike(problems)
    work = solve if processes == 1 else functools.partial(_all_of, solve)
    found = in_processes(work, [[problems[i] for i in group] for group in groups], processes)
    waiting: dict[int, Solution] = {}
    due = 0
    indices = itertools.chain.from_iterable(groups)
    for index, solution in zip(indices, itertools.chain.from_iterable(found), strict=True):
        waiting[index] = solution
        if progress is not None:
            progress(due + len(waiting), len(problems))
        while due in waiting:
            yield waiting.pop(due)
            due += 1


def _all_of(solve: Callable[[T], Iterator[R]], item: T) -> list[R]:
    return list(solve(item))


def _solve_alike(
    problems: Sequence[OrbitProblem], starts: int | None, seed: int, most_starts: int | None, advise: bool
) -> Iterator[Solution]:
    """Solve problems of one group in turn, each helped by the answers before."""
    answers = Answers([numbers_of(problem) for problem in problems])
    for i, problem in enumerate(problems):
        count = usual_starts(problem) if starts is None else starts
        settled, polish = settle_foretold(problem, answers.foretell(i))
        best = find_helped(problem, settled, count, seed, most_starts, advise)
        if best.status is Status.CONVERGED:
            answers.add(i, best.unknowns, best.active_bounds, polish)
        yield best


def settle_foretold(
    problem: OrbitProblem, guesses: Sequence[tuple[np.ndarray, Polish | None]]
) -> tuple[Solution | None, Polish | None]:
    """Return the best certified orbit next to what answers foretell, and what corrected it; or None and None."""
    settled = [found for guess in guesses if (found := settle(problem, *guess)) is not None]
    return min(settled, key=lambda found: found[0].objective, default=(None, None))


def find_helped(
    problem: OrbitProblem,
    known: Solution | None,
    starts: int,
    seed: int = 0,
    most_starts: int | None = None,
    advise: bool = False,
) -> Solution:
    """Return the best of a certified orbit that other answers led to, if any, and what the searches left find.

    Parameters
    ----------
    problem, starts, seed, most_starts, advise : as in `find_orbit`.
    known : takes the place of one search; with it there is an orbit, so nobody asks for most_starts or advice.
    """
    if known is None:
        return find_orbit(problem, starts, seed, threads=1, most_starts=most_starts, advise=advise)
    return known if starts == 1 else find_beside(known, starts - 1, seed)


def in_processes(
    work: Callable[[T], R],
    items: Sequence[T],
    processes: int,
    progress: Progress | None = None,
) -> Iterator[R]:
    """Yield what `work` makes of each item, in their order, as they come.

    Parameters
    ----------
    work : a function that can be pickled; its JAX programs run in the process it is called in.
    items : what to work on.
    processes : how many Python processes share the items; with 1 it is done in this one.
    progress : called with (items done, items in all).
    """

    def told(results: Iterator[R]) -> Iterator[R]:
        for done, result in enumerate(results, start=1):
            if progress is not None:
                progress(done, len(items))
            yield result

    if processes == 1:
        yield from told(map(work, items))
        return
    # A process that has run JAX must not be forked, so the workers start afresh and import wingbeat.
    context = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(min(processes, max(len(items), 1)), context) as pool:
        try:
            yield from told(pool.map(work, items))
        finally:
            pool.shutdown(wait=False, cancel_futures=True)
