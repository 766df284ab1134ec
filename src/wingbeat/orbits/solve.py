"""From a problem to a certified orbit: several searches, defect correction, the certificate, a status."""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Iterator

import numpy as np

from wingbeat.errors import FaultList
from wingbeat.orbits.infeasible.lower_bound import is_at_lower_bound
from wingbeat.orbits.infeasible.without_orbit import Ending, unexplained, without_orbit
from wingbeat.orbits.multistart import (
    Progress,
    first_searches,
    load_programs,
    optima_of,
    optimal,
    search_from_optima,
    search_from_starts,
)
from wingbeat.orbits.nlp.defect_correction import SETTLED, Corrected, first_certified, follow_to_certificate, size
from wingbeat.orbits.nlp.local_search import (
    Candidate,
    active_bounds,
    refine,
    violation,
)
from wingbeat.orbits.nlp.newton_kkt import Curvature, Polish
from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.orbits.problem.problem import CLOSURE, OrbitProblem
from wingbeat.orbits.solution import FAMILY, Optimum, Solution, better_of, families
from wingbeat.orbits.starts import start_point, usual_starts
from wingbeat.orbits.status import Status
from wingbeat.workers.affinity import core_count

# Violation, in the optimiser's scale, of unknowns that are next to an orbit.
_NEXT_TO = 5.0
MOST_STARTS = 50
# An uncorrected optimum whose objective is more than this share above a certified one's is no better: of 200
# frequencies nearly all changed by less than .0025 when they were corrected.
_UNSURE = 0.01


def check_search(starts: int, seed: int, most_starts: int = MOST_STARTS) -> None:
    """Raise `InvalidInputError` unless all are whole numbers in range."""
    faults = FaultList()
    for name, value, least in (("starts", starts, 1), ("seed", seed, 0), ("most_starts", most_starts, 1)):
        faults.whole(name, value, least, 100_000)
    faults.raise_if_any()


def find_orbit(
    problem: OrbitProblem,
    starts: int | None = None,
    seed: int = 0,
    progress: Progress | None = None,
    threads: int | None = None,
    most_starts: int | None = None,
    advise: bool = True,
    explain: bool = True,
) -> Solution:
    """Search for the periodic orbit of least objective from several starts and certify it.

    Parameters
    ----------
    problem : the orbit problem.
    starts : number of searches; if not given 6, 12 where objective or limits are read off the beat, 24 where
        bounds are other than the species' or peaks are made least; for peaks half as many follow beside the best.
    seed : makes the random starts; the same seed gives the same orbit.
    progress : called with (searches done, searches in all); without an orbit changes are looked at after that, each
        of which counts as one more.
    threads : searches at a time, as many as there are cores if not given.
    most_starts : if none of the searches can be certified, more are made, up to this many (50 if not
        given), before giving up.
    advise : where there is no orbit, find the single changes that make one; costs as much as the searches.
    explain : where there is no orbit, find the beat that comes closest to one and which law of balance fails; costs
        a third of the searches. Without it nothing is advised.

    Returns
    -------
    Solution : with a status; a failed search is data, not an exception.

    Raises
    ------
    InvalidInputError : starts, seed or most_starts not whole numbers in range.
    """
    starts = usual_starts(problem) if starts is None else starts
    most = MOST_STARTS if most_starts is None else most_starts
    check_search(starts, seed, most)
    begun = time.perf_counter()
    threads = threads or core_count()
    transcription = Transcription(problem)
    best, found = _searched(transcription, starts, most, seed, threads, progress)
    ending = None
    if best is None:
        best, ending = (
            without_orbit(transcription, found, threads, advise, progress) if explain else unexplained(found)
        )
    return _found(transcription, best, found, len(found), seed, begun, ending)


def find_beside(known: Solution, starts: int, seed: int = 0) -> Solution:
    """Return the better of a certified orbit and what so many searches of its problem, one by one, come to.

    Only what may be better, as far as the search's few steps tell, is certified.
    """
    begun = time.perf_counter()
    transcription, problem = Transcription(known.problem), known.problem
    here = transcription.scaled(known.unknowns)
    level = transcription.objective(here) * problem.minimise.scale
    unsure = _UNSURE * max(abs(level), problem.minimise.scale)
    found = first_searches(transcription, starts, seed, 1)
    others = [c for c in optimal(found) if c.objective <= level - unsure or np.abs(c.scaled - here).max() > FAMILY]
    best = first_certified(transcription, [c for c in others if c.objective <= level + unsure])
    if best is not None:
        return better_of(_found(transcription, best, found, len(found), seed, begun), known)
    optima = families([*known.as_optimum(), *optima_of(found)], problem.unknowns().scale)
    return dataclasses.replace(
        known,
        starts=known.starts + len(found),
        seed=seed,
        distinct_optima=len(optima),
        optima=optima,
        seconds=known.seconds + time.perf_counter() - begun,
        certify_seconds=known.certify_seconds + transcription.certify_seconds,
    )


def _searched(
    transcription: Transcription,
    starts: int,
    most: int,
    seed: int,
    threads: int,
    progress: Progress | None = None,
) -> tuple[Corrected | None, list[Candidate]]:
    """Return the best certified orbit that searches lead to, if any, and where they all ended."""
    problem = transcription.problem
    load_programs(transcription, start_point(problem, 0, seed))
    found = first_searches(transcription, starts, seed, threads, progress)
    best = first_certified(transcription, found)
    for led in _where_limits_hold(problem, starts, seed, threads) if best is None else ():
        found += led
        if (best := first_certified(transcription, led)) is not None:
            break
    more = range(starts, most if best is None else starts)
    for done, candidate in enumerate(search_from_starts(transcription, more, seed, threads), starts + 1):
        found.append(candidate)
        if progress is not None:  # what limits led to is none of the starts
            progress(done, max(starts, most))
        if (best := first_certified(transcription, [candidate])) is not None:
            break
    return best, found


def _found(
    transcription: Transcription,
    best: Corrected,
    found: list[Candidate],
    searches: int,
    seed: int,
    begun: float,
    ending: Ending | None = None,
) -> Solution:
    seconds, certifying = time.perf_counter() - begun, transcription.certify_seconds
    optima = families(optima_of(found), transcription.problem.unknowns().scale)
    return _solution(best, searches, optima, seed, seconds, certifying, ending)


def _where_limits_hold(problem: OrbitProblem, starts: int, seed: int, threads: int) -> Iterator[list[Candidate]]:
    """Yield where searches end that start from beats that make least what a problem limits, a limit at a time.

    Limits on a peak have edges in which searches from random starts catch; all fifty of the bat did at 10 m/s with
    least positive power within a pitch torque that a quarter less would have done for.
    """
    for limit in problem.subject_to:
        if limit.at_most:
            easier = Transcription(dataclasses.replace(problem, subject_to=(), minimise=limit.quantity))
            yield search_from_optima(Transcription(problem), first_searches(easier, starts, seed, threads), threads)


def settle(problem: OrbitProblem, guess: np.ndarray, like: Curvature | None = None) -> Solution | None:
    """Correct unknowns taken to be next to an orbit, without a search.

    Parameters
    ----------
    problem : the orbit problem.
    guess : unknowns.
    like : what was learned of a problem much the same.

    Returns
    -------
    The certified orbit, or None.
    """
    begun = time.perf_counter()
    transcription = Transcription(problem)
    scaled = transcription.scaled(guess)
    if violation(transcription, scaled) > _NEXT_TO:
        return None
    polish = Polish(transcription, scaled, like)
    nearer = polish.approach(scaled, SETTLED)
    if nearer is None:
        return None
    corrected = follow_to_certificate(transcription, polish, nearer)
    if not corrected.is_orbit():
        return None
    seconds = time.perf_counter() - begun
    return _solution(corrected, 1, (), 0, seconds, transcription.certify_seconds)


def follow(problem: OrbitProblem, start: np.ndarray, below: float = np.inf) -> Solution | None:
    """Search once from unknowns near an orbit; return the certified orbit, or None.

    Parameters
    ----------
    problem : the orbit problem.
    start : unknowns to start from, clipped to their bounds.
    below : the objective must come out less than this, or the orbit is not even certified.
    """
    begun = time.perf_counter()
    candidate = refine(Transcription(problem), start)
    if not (candidate.closed and candidate.optimal and candidate.objective < below):
        return None
    return certified_optimum(candidate, time.perf_counter() - begun)


def find_optima(problem: OrbitProblem, starts: int, seed: int = 0) -> list[Solution]:
    """Return every distinct optimum that searches meet and the certifier closes, best first; none if none is.

    Parameters
    ----------
    problem, starts, seed : as in `find_orbit`; the searches are made one after the other.
    """
    begun = time.perf_counter()
    found = first_searches(Transcription(problem), starts, seed, 1)
    each = (time.perf_counter() - begun) / starts
    optima: list[Solution] = []
    known: list[np.ndarray] = []
    for candidate in optimal(found):
        if any(np.abs(candidate.scaled - other).max() <= FAMILY for other in known):
            continue
        optimum = certified_optimum(candidate, each)
        if optimum is not None:
            known.append(candidate.scaled)
            if not any(optimum.same_as(other) for other in optima):
                optima.append(optimum)
    return optima


def certified_optimum(candidate: Candidate, seconds: float) -> Solution | None:
    """Return what a search ended in as the certifier closes it, or None; `seconds` is what the search took."""
    begun = time.perf_counter()
    transcription = candidate.programme.anew()
    best = first_certified(transcription, [candidate])
    if best is None:
        return None
    seconds += time.perf_counter() - begun
    return _solution(best, 1, (), 0, seconds, transcription.certify_seconds)


def _solution(
    best: Corrected,
    searches: int,
    optima: tuple[Optimum, ...],
    seed: int,
    seconds: float,
    certify_seconds: float,
    ending: Ending | None = None,
) -> Solution:
    told = ending or Ending(Status.CONVERGED, _certified_words(best))
    return Solution(
        best.programme.problem,
        told.status,
        told.message,
        best.wingbeat,
        best.certificate,
        dict(zip(CLOSURE, (float(v) for v in best.miss), strict=True)),
        active_bounds(best.programme, best.scaled),
        best.optimality,
        searches,
        max(len(optima), 1) if told.status is Status.CONVERGED else len(optima),
        seed,
        seconds,
        certify_seconds,
        optima,
        told.shortages,
        told.relaxations,
        best.learned,
    )


def _certified_words(best: Corrected) -> str:
    words = f"certified: re-flown, it closes to {size(best.miss):.0e}"
    problem = best.programme.problem
    if is_at_lower_bound(problem, best.programme.physical(best.scaled)):
        low = problem.bounds["frequency"][0]
        words += f"; the frequency is at its lower bound, {low:g} Hz: no search can better it"
    return words
