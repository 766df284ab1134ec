"""Many orbit problems, spread over processes: the same searches and answers as one by one."""

from __future__ import annotations

import functools
import multiprocessing
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from typing import TypeVar

from wingbeat.errors import FaultList
from wingbeat.orbits.problem import OrbitProblem
from wingbeat.orbits.solution import Solution
from wingbeat.orbits.solve import Progress, check_search, find_orbit

T = TypeVar("T")
R = TypeVar("R")

# Problems handed to a process at a time: enough to hide the handing over, few enough to share out evenly.
_CHUNK = 8
_MOST_PROCESSES = 1024


def find_orbits(
    problems: Sequence[OrbitProblem],
    starts: int = 6,
    seed: int = 0,
    processes: int = 1,
    progress: Progress | None = None,
    most_starts: int | None = None,
) -> Iterator[Solution]:
    """Yield the solution of each problem, in their order, as they come; a failed search is data as in `find_orbit`.

    Parameters
    ----------
    problems : any mixture of vehicles, air loads, speeds, free parameters and objectives.
    starts, seed, most_starts : as in `find_orbit`, for each problem.
    processes : how many Python processes share the work; with 1 it is done in this one.
    progress : called with (problems done, problems in all).

    Raises
    ------
    InvalidInputError : a problem that is none, starts, seed, most_starts or processes out of range.
    """
    faults = FaultList()
    for i, problem in enumerate(problems):
        if not isinstance(problem, OrbitProblem):
            faults.add(f"problems[{i}]", problem, "is not an OrbitProblem")
    if isinstance(processes, bool) or not isinstance(processes, int) or not 1 <= processes <= _MOST_PROCESSES:
        faults.add("processes", processes, f"must be a whole number from 1 to {_MOST_PROCESSES}")
    faults.raise_if_any()
    check_search(starts, seed, 1 if most_starts is None else most_starts)
    find = functools.partial(find_orbit, starts=starts, seed=seed, threads=1, most_starts=most_starts)
    return in_processes(find, problems, processes, progress, _CHUNK)


def in_processes(
    work: Callable[[T], R],
    items: Sequence[T],
    processes: int,
    progress: Progress | None = None,
    chunk: int = 1,
) -> Iterator[R]:
    """Yield what `work` makes of each item, in their order, as they come.

    Parameters
    ----------
    work : a function that can be pickled; its JAX programs run in the process it is called in.
    items : what to work on.
    processes : how many Python processes share the items; with 1 it is done in this one.
    progress : called with (items done, items in all).
    chunk : items handed to a process at a time.
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
            yield from told(pool.map(work, items, chunksize=chunk))
        finally:
            pool.shutdown(wait=False, cancel_futures=True)
