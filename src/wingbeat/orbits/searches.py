"""Many searches of one problem: from its starts, side by side, and from beside the best of what they met."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from wingbeat.orbits.certify import certify
from wingbeat.orbits.search import Candidate, search
from wingbeat.orbits.shooting import fly_part
from wingbeat.orbits.starts import start_beside, start_point
from wingbeat.orbits.transcription import Transcription


def load_programs(problem: Transcription, start: np.ndarray) -> None:
    """Read or compile, side by side, the programs of a search and its certificate, once a process."""
    if fly_part.loaded:
        return

    wingbeat = problem.problem.wingbeat(start)
    with ThreadPoolExecutor(2) as pool:
        # That of the search first, which takes the longest to compile.
        searching = pool.submit(problem.closure_jacobian, problem.scaled(start))
        pool.submit(certify, problem.model, wingbeat, start[:4]).result()
        searching.result()


def search_from_starts(
    problem: Transcription, indices: Iterable[int], seed: int, elastic: bool, threads: int
) -> Iterator[Candidate]:
    """Yield where the searches from starts of these indices end, in order, so many threads at a time."""

    def one(index: int) -> Candidate:
        return search(problem.anew(), start_point(problem.problem, index, seed), elastic=elastic)

    if threads == 1:
        yield from map(one, indices)
        return
    # Compiled flights release the interpreter, so threads use the cores there are.
    with ThreadPoolExecutor(threads) as pool:
        try:
            yield from pool.map(one, indices)
        finally:
            pool.shutdown(wait=False, cancel_futures=True)


def beside_best(problem: Transcription, found: list[Candidate], count: int, seed: int) -> list[Candidate]:
    """Return where searches end that start beside the best optimum so far: least peaks often have better near."""
    more: list[Candidate] = []
    for index in range(count):
        optima = [c for c in (*found, *more) if c.closed and c.optimal]
        if not optima:
            break
        best = min(optima, key=lambda c: c.objective)
        start = start_beside(problem.problem, problem.physical(best.scaled), len(found) + index, seed)
        more.append(search(problem.anew(), start))
    return more
