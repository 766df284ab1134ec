"""From a problem to a certified orbit: many local searches, defect correction, the certificate, a status.

The searches of one problem start from its own starts, in parallel, and from optima of an easier problem.
"""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from wingbeat._base import FaultList
from wingbeat._workers.tuning import core_count
from wingbeat.orbits.diagnosis import unexplained, without_orbit
from wingbeat.orbits.flight.certificate import certify
from wingbeat.orbits.flight.period import fly_part
from wingbeat.orbits.nlp.newton_kkt import Corrected, first_certified
from wingbeat.orbits.nlp.transcription import Candidate, Transcription, as_candidate, search
from wingbeat.orbits.options import DEFAULTS, SolverOptions
from wingbeat.orbits.problem.quantities import Constraint
from wingbeat.orbits.problem.quantity import MapQuantity
from wingbeat.orbits.solution import Solution, families, optima_of, optimal, solution_of
from wingbeat.orbits.starts import (
    asks_for_stability,
    easier,
    minimises_map,
    start_beside,
    start_count,
    start_point,
    usual_most_starts,
)

if TYPE_CHECKING:
    from wingbeat.orbits.problem.problem import OrbitProblem

T = TypeVar("T")
Progress = Callable[[int, int], None]


def check_search(starts: int, seed: int, most_starts: int = 1) -> None:
    """Raise `InvalidInputError` unless all are whole numbers in range."""
    faults = FaultList()
    for name, value, least in (("starts", starts, 1), ("seed", seed, 0), ("most_starts", most_starts, 1)):
        faults.whole(name, value, least, 100_000)
    faults.raise_if_any()


@dataclass(frozen=True)
class Settings:
    """How a problem is searched.

    Parameters
    ----------
    starts : number of starts; default as in `SearchOptions` for such a problem. If peaks are minimised, half as
        many further starts follow near the best optimum.
    seed : of the random starts; the same seed gives the same orbit.
    most_starts : if no start leads to a certified orbit, more follow, up to this many; default that of
        `SearchOptions`.
    advise : if no orbit is found, find the single changes that lead to one. This takes as long as the starts.
    explain : if no orbit is found, find the closest wingbeat and the balance that fails. This takes a third of the
        time of the starts. If `explain` is false, `advise` has no effect.
    options : of the solvers.
    """

    starts: int | None = None
    seed: int = 0
    most_starts: int | None = None
    advise: bool = True
    explain: bool = True
    options: SolverOptions = DEFAULTS

    def check(self) -> None:
        """Raise `InvalidInputError` unless all numbers are whole numbers in range."""
        check_search(
            1 if self.starts is None else self.starts,
            self.seed,
            1 if self.most_starts is None else self.most_starts,
        )


USUAL = Settings()
# Of many problems, few readers want the changes that would lead to an orbit.
BRIEF = Settings(advise=False)


def find_orbit(
    problem: OrbitProblem, settings: Settings = USUAL, progress: Progress | None = None, threads: int | None = None
) -> Solution:
    """Find the periodic orbit that minimises the objective, from several starts, and certify it.

    Parameters
    ----------
    problem, settings : the orbit problem, and how it is searched.
    progress : called with (starts done, starts in all). Without an orbit, each single change that is tried counts
        as one more start.
    threads : number of local searches at a time; default the number of cores.

    Returns
    -------
    Solution : with a status; a failure is a result, not an exception.

    Raises
    ------
    InvalidInputError : starts, seed or most_starts not whole numbers in range.
    """
    options, seed = settings.options, settings.seed
    starts = start_count(problem, settings.starts, options.search)
    most = usual_most_starts(problem, options.search) if settings.most_starts is None else settings.most_starts
    check_search(starts, seed, most)
    begun = time.perf_counter()
    threads = threads or core_count()
    programme = Transcription(problem, options)
    best, found, free = _searched(programme, starts, most, seed, threads, progress)
    searches, ending = len(found), None
    if best is None and settings.explain:
        best, ending = without_orbit(programme, found, threads, settings.advise, progress)
    elif best is None:
        best, ending = unexplained(found)
    solution = solution_of(best, programme, begun, found, searches, seed, ending)
    return dataclasses.replace(solution, free_objective=_certified_objective(free))


def _searched(
    programme: Transcription, starts: int, most: int, seed: int, threads: int, progress: Progress | None = None
) -> tuple[Corrected | None, list[Candidate], list[Candidate]]:
    """Return the best certified orbit that the starts lead to, if any, and where all local searches ended.

    The last list holds the ends of the searches without limits of stability, if the problem has such limits.
    """
    load_programs(programme, start_point(programme.problem, 0, seed, programme.options.search))
    free: list[Candidate] = []
    if asks_for_stability(programme.problem):
        free = easier_searches(programme, starts, seed, threads, progress)
        found = stable_searches(programme, free, threads)
    else:
        found = first_searches(programme, starts, seed, threads, progress)
    best = first_certified(programme, found)
    for led in _where_limits_hold(programme, starts, seed, threads) if best is None else ():
        found += led
        if (best := first_certified(programme, led)) is not None:
            break
    more = range(starts, most if best is None else starts)
    for done, candidate in enumerate(search_from_starts(programme, more, seed, threads), starts + 1):
        found.append(candidate)
        if progress is not None:  # searches from limited quantities are not counted
            progress(done, max(starts, most))
        if (best := first_certified(programme, [candidate])) is not None:
            break
    return best, found, [] if minimises_map(programme.problem) else free


def _certified_objective(found: list[Candidate]) -> float | None:
    """Return the objective of the best candidate that can be certified, if any."""
    best = first_certified(found[0].programme, found) if found else None
    return None if best is None else best.programme.objective(best.scaled) * best.programme.problem.minimise.scale


def _where_limits_hold(programme: Transcription, starts: int, seed: int, threads: int) -> Iterator[list[Candidate]]:
    """For each limit, search from the beat that minimises the limited quantity; yield the ends of the searches.

    Limits on a peak have edges at which local searches stop. In one case, we minimised the bat's positive power at
    10 m/s with a limit on pitch torque. All fifty random starts stopped at such an edge, although a quarter less
    torque was feasible.
    """
    problem, options = programme.problem, programme.options
    for limit in problem.subject_to:
        if limit.at_most and not isinstance(limit.quantity, MapQuantity):
            # The frequency is minimised as an output of the beat, because a fixed frequency is no unknown.
            least = dataclasses.replace(limit.quantity, parameter=None)
            easier = Transcription(dataclasses.replace(problem, subject_to=(), minimise=least), options)
            found = first_searches(easier, starts, seed, threads)
            yield search_from_optima(Transcription(problem, options), found, threads)


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

    The problem without limits gets as many starts as the problem. `progress` counts its searches too.
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

    With `pruned`, families are left out that are dearer without the limits than an optimum found with them: limits
    only raise the objective within a family.
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


def tightened(programme: Transcription, start: np.ndarray) -> np.ndarray:
    """Return unknowns near a local optimum; start from an orbit that exceeds limits of the stroke map.

    Each limit moves in steps of equal ratio. Its first value is that of the limited quantity at the start, its last
    is the limit asked for. A short search follows each step.
    """
    problem, options = programme.problem, programme.options
    stroke_map = np.asarray(programme.fly(start[4:], start[:4]).end_jacobian)[2:, :4]
    for share in np.linspace(0.0, 1.0, options.search.tightening_steps + 1)[1:]:
        limits = tuple(_between(c, stroke_map, float(share)) for c in problem.subject_to)
        nearer = Transcription(dataclasses.replace(problem, subject_to=limits), options)
        scaled = nearer.scaled(start)
        start = nearer.physical(
            nearer.optimise(scaled, options.search.tightening_iterations, options.search.tolerance)[0]
        )
    return start


def _between(constraint: Constraint, stroke_map: np.ndarray, share: float) -> Constraint:
    """Return a limit between the quantity's value at the start and the limit asked for; leave other constraints."""
    quantity, limit = constraint.quantity, constraint.limit
    if not (isinstance(quantity, MapQuantity) and constraint.at_most):
        return constraint
    there = float(np.max(quantity.of(stroke_map)))
    if not there > limit > 0:
        return constraint
    return dataclasses.replace(constraint, limit=there * (limit / there) ** share)
