"""Many local searches of one problem: from its starts, in parallel, and from optima of an easier problem."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

import numpy as np

from wingbeat.orbits.flight.certify import certify
from wingbeat.orbits.flight.shooting import fly_part
from wingbeat.orbits.nlp.local_search import Candidate, as_candidate, search
from wingbeat.orbits.nlp.tightening import tightened
from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.orbits.problem.stable import asks_for_stability, easier, minimises_map
from wingbeat.orbits.solution import Optimum, families
from wingbeat.orbits.starts import start_beside, start_point

T = TypeVar("T")
Progress = Callable[[int, int], None]


def load_programs(programme: Transcription, start: np.ndarray) -> None:
    """Load or compile the programs of a local search and of the certificate in parallel, once per process."""
    if fly_part.loaded:
        return

    wingbeat = programme.problem.wingbeat(start)
    with ThreadPoolExecutor(2) as pool:
        # The program of the search compiles the longest, so it goes first.
        searching = pool.submit(programme.closure_jacobian, programme.scaled(start))
        pool.submit(certify, programme.model, wingbeat, start[:4]).result()
        searching.result()


def first_searches(
    programme: Transcription, starts: int, seed: int, threads: int, progress: Progress | None = None
) -> list[Candidate]:
    """Search from starts, from optima of the problem without limits, and near the lowest peak; return all ends.

    Parameters
    ----------
    programme : the problem's programme.
    starts, seed : number of starts, and seed of the random ones. The problem without limits gets the same number of
        starts.
    threads : number of local searches at a time.
    progress : called with (local searches done, local searches in all), including those without limits.
    """
    problem, options = programme.problem, programme.options
    if asks_for_stability(problem):
        return stable_searches(programme, easier_searches(programme, starts, seed, threads, progress), threads)
    limited = bool(problem.subject_to)
    found: list[Candidate] = []
    for candidate in search_from_starts(programme, range(starts), seed, threads):
        found.append(candidate)
        if progress is not None:
            progress(len(found), starts * (1 + limited))
    if limited:
        without = Transcription(dataclasses.replace(problem, subject_to=()), options)
        report = None if progress is None else lambda done, total: progress(starts + done, starts + total)
        found += search_from_optima(programme, first_searches(without, starts, seed, threads, report), threads)
    if programme.has_epigraph:
        found += beside_best(programme, found, starts // 2, seed)
    return found


def search_from_optima(
    programme: Transcription, easier: Iterable[Candidate], threads: int, pruned: bool = False
) -> list[Candidate]:
    """Search from the best optimum of each family of an easier problem; return where the local searches end.

    Parameters
    ----------
    programme : of the problem.
    easier : ends of the searches of the easier problem.
    threads : number of local searches at a time.
    pruned : whether to leave out families that are dearer without the limits than an optimum found with them.
        Limits only raise the objective within a family.
    """
    scale, apart = programme.problem.unknowns().scale, programme.options.search.same_optimum
    found: list[Candidate] = []
    starts = list(families(optima_of(easier), scale, apart))
    while starts:
        together, starts = starts[:threads] if pruned else starts, starts[threads:] if pruned else []
        begun = [optimum.unknowns for optimum in together]
        found += _side_by_side(lambda start: search(programme.uncorrected(), start), begun, threads)
        best = optimal(found)
        if best:
            starts = [optimum for optimum in starts if optimum.objective < best[0].objective]
    return found


def easier_searches(
    programme: Transcription, starts: int, seed: int, threads: int, progress: Progress | None = None
) -> list[Candidate]:
    """Search as `first_searches` does, for the easier problem that comes before a search for stability."""
    free = Transcription(easier(programme.problem), programme.options)
    return first_searches(free, starts, seed, threads, progress)


def stable_searches(programme: Transcription, free: list[Candidate], threads: int) -> list[Candidate]:
    """Search for stable orbits from the optima without limits of stability; return where the searches end.

    No search starts from elsewhere, for two reasons. Stable orbits are next to some of these optima. A flight with
    the derivatives of the stroke map takes five times as long as one without. If a stable orbit costs too much
    (`SearchOptions.dear_stability`) or none is found, one more search starts from the best of these optima. It
    tightens the limits step by step, because a direct search may end in another family.
    """
    best, map_is_minimised = optimal(free), minimises_map(programme.problem)
    if best and not map_is_minimised:
        already = as_candidate(programme.uncorrected(), programme.scaled(optima_of(best)[0].unknowns), optimal=True)
        if already.is_optimum:
            return [already]
    if map_is_minimised or not best:
        return search_from_optima(programme, free, threads)
    found = search_from_optima(programme, free, threads, pruned=True)
    stable = optimal(found)
    dear = best[0].objective + programme.options.search.dear_stability * abs(best[0].objective)
    if not stable or stable[0].objective > dear:
        found.append(search(programme.uncorrected(), tightened(programme, optima_of(best)[0].unknowns)))
    return found


def optima_of(candidates: Iterable[Candidate]) -> tuple[Optimum, ...]:
    """Return the optima among the candidates, in SI, the best first."""
    return tuple(Optimum(c.objective, c.programme.physical(c.scaled)) for c in optimal(candidates))


def optimal(candidates: Iterable[Candidate]) -> list[Candidate]:
    """Return the candidates that are optima, the best first."""
    return sorted((c for c in candidates if c.is_optimum), key=lambda c: c.objective)


def search_from_starts(
    programme: Transcription, indices: Iterable[int], seed: int, threads: int
) -> Iterator[Candidate]:
    """Search from these starts in parallel threads, and yield in order where each local search ends.

    The first start is the stock wingbeat. Every other start is brought close to closure before the objective is
    minimised, because a local search from far away diverges. If no orbit exists, such a search ends after 30
    flights rather than 100.
    """

    def one(index: int) -> Candidate:
        start = start_point(programme.problem, index, seed, programme.options.search)
        return search(programme.uncorrected(), start, restore=index > 0)

    yield from _side_by_side(one, indices, threads)


def _side_by_side(work: Callable[[T], Candidate], items: Iterable[T], threads: int) -> Iterator[Candidate]:
    if threads == 1:
        yield from map(work, items)
        return
    # Compiled flights release the interpreter lock, so threads run in parallel.
    with ThreadPoolExecutor(threads) as pool:
        try:
            yield from pool.map(work, items)
        finally:
            pool.shutdown(wait=False, cancel_futures=True)


def beside_best(programme: Transcription, found: list[Candidate], count: int, seed: int) -> list[Candidate]:
    """Search near the best optimum, because a lower peak is often near it; return where the searches end."""
    more: list[Candidate] = []
    for index in range(count):
        optima = optima_of((*found, *more))
        if not optima:
            break
        place = len(found) + index
        start = start_beside(programme.problem, optima[0].unknowns, place, seed, programme.options.search)
        more.append(search(programme.uncorrected(), start))
    return more
