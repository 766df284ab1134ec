"""From a problem to a certified orbit: several starts, defect correction, the certificate, a status."""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Iterator

import numpy as np

from wingbeat._base import FaultList
from wingbeat._workers.tuning import core_count
from wingbeat.orbits.infeasible.lower_bound import is_at_lower_bound
from wingbeat.orbits.infeasible.without_orbit import Ending, unexplained, without_orbit
from wingbeat.orbits.multistart import (
    Progress,
    easier_searches,
    first_searches,
    load_programs,
    optima_of,
    optimal,
    search_from_optima,
    search_from_starts,
    stable_searches,
)
from wingbeat.orbits.nlp.defect_correction import Corrected, first_certified, follow_to_certificate, size
from wingbeat.orbits.nlp.local_search import Candidate, active_bounds, refine, violation
from wingbeat.orbits.nlp.newton_kkt import NewtonKKT, ReducedHessian
from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.orbits.options.solver import DEFAULTS, SolverOptions
from wingbeat.orbits.problem.map_quantities import MapQuantity
from wingbeat.orbits.problem.problem import CLOSURE, OrbitProblem
from wingbeat.orbits.problem.stable import asks_for_stability, minimises_map
from wingbeat.orbits.solution import Optimum, Solution, better_of, families
from wingbeat.orbits.starts import start_count, start_point, usual_most_starts
from wingbeat.orbits.status import Status


def check_search(starts: int, seed: int, most_starts: int = 1) -> None:
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
    options: SolverOptions = DEFAULTS,
) -> Solution:
    """Find the periodic orbit that minimises the objective, from several starts, and certify it.

    Parameters
    ----------
    problem : the orbit problem.
    starts : number of starts; default as in `SearchOptions` for such a problem. If peaks are minimised, half as
        many further starts follow near the best optimum.
    seed : of the random starts; the same seed gives the same orbit.
    progress : called with (starts done, starts in all). Without an orbit, each single change that is tried counts
        as one more start.
    threads : number of local searches at a time; default the number of cores.
    most_starts : if no start leads to a certified orbit, more follow, up to this many; default that of
        `SearchOptions`.
    advise : if no orbit is found, find the single changes that lead to one. This takes as long as the starts.
    explain : if no orbit is found, find the closest wingbeat and the balance that fails. This takes a third of the
        time of the starts. If `explain` is false, `advise` has no effect.
    options : of the solvers.

    Returns
    -------
    Solution : with a status; a failure is a result, not an exception.

    Raises
    ------
    InvalidInputError : starts, seed or most_starts not whole numbers in range.
    """
    starts = start_count(problem, starts, options.search)
    most = usual_most_starts(problem, options.search) if most_starts is None else most_starts
    check_search(starts, seed, most)
    begun = time.perf_counter()
    threads = threads or core_count()
    programme = Transcription(problem, options)
    best, found, free = _searched(programme, starts, most, seed, threads, progress)
    ending = None
    if best is None:
        best, ending = without_orbit(programme, found, threads, advise, progress) if explain else unexplained(found)
    solution = _found(programme, best, found, len(found), seed, begun, ending)
    return dataclasses.replace(solution, free_objective=_certified_objective(free))


def find_beside(known: Solution, starts: int, seed: int = 0) -> Solution:
    """Return the better of a certified orbit and the best orbit from a number of starts, run one after the other.

    Only optima that may be better, judged by the solver's coarse flights, are certified.
    """
    begun = time.perf_counter()
    programme, options = Transcription(known.problem, known.options), known.options.search
    here, scale = programme.scaled(known.unknowns), known.problem.minimise.scale
    objective = programme.objective(here) * scale
    error, apart = options.uncorrected_error * max(abs(objective), scale), options.same_optimum
    found = first_searches(programme, starts, seed, 1)
    others = [
        c for c in optimal(found) if c.objective <= objective - error or np.abs(c.scaled - here).max() > apart
    ]
    best = first_certified(programme, [c for c in others if c.objective <= objective + error])
    if best is not None:
        return better_of(_found(programme, best, found, len(found), seed, begun), known)
    optima = families([*known.as_optimum(), *optima_of(found)], known.problem.unknowns().scale, apart)
    return dataclasses.replace(
        known,
        starts=known.starts + len(found),
        seed=seed,
        distinct_optima=len(optima),
        optima=optima,
        seconds=known.seconds + time.perf_counter() - begun,
        certify_seconds=known.certify_seconds + programme.certify_seconds,
    )


def _searched(
    programme: Transcription,
    starts: int,
    most: int,
    seed: int,
    threads: int,
    progress: Progress | None = None,
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


def _found(
    programme: Transcription,
    best: Corrected,
    found: list[Candidate],
    searches: int,
    seed: int,
    begun: float,
    ending: Ending | None = None,
) -> Solution:
    seconds, certifying = time.perf_counter() - begun, programme.certify_seconds
    apart = programme.options.search.same_optimum
    optima = families(optima_of(found), programme.problem.unknowns().scale, apart)
    return _solution(best, searches, optima, seed, seconds, certifying, ending)


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


def correct_guess(
    problem: OrbitProblem,
    guess: np.ndarray,
    like: ReducedHessian | None = None,
    options: SolverOptions = DEFAULTS,
) -> Solution | None:
    """Find the certified orbit next to a guess of the unknowns, by correction without a local search.

    Parameters
    ----------
    problem : the orbit problem.
    guess : the guessed unknowns.
    like : curvature at the optimum of a similar problem.
    options : of the solvers.

    Returns
    -------
    The certified orbit; None if the guess is too far from an orbit, or if its correction fails.
    """
    begun = time.perf_counter()
    programme = Transcription(problem, options)
    scaled = programme.scaled(guess)
    if violation(programme, scaled) > options.continuation.near_closure:
        return None
    newton = NewtonKKT(programme, scaled, like)
    nearer = newton.approach(programme, scaled, options.certificate.linear_range)
    if nearer is None:
        return None
    corrected = follow_to_certificate(programme, newton, nearer)
    if not corrected.is_orbit():
        return None
    seconds = time.perf_counter() - begun
    return _solution(corrected, 1, (), 0, seconds, programme.certify_seconds)


def search_near(
    problem: OrbitProblem, start: np.ndarray, below: float = np.inf, options: SolverOptions = DEFAULTS
) -> Solution | None:
    """Run one local search from unknowns near an orbit; return the certified orbit, or None.

    Parameters
    ----------
    problem : the orbit problem.
    start : unknowns to start from, clipped to their bounds.
    below : only an orbit with an objective less than this is returned.
    options : of the solvers.
    """
    begun = time.perf_counter()
    candidate = refine(Transcription(problem, options), start)
    if not (candidate.is_optimum and candidate.objective < below):
        return None
    found = certified_optimum(candidate, time.perf_counter() - begun)
    # The certifier moves the orbit and may raise its objective: whoever repeats this until nothing improves would
    # never end.
    return found if found is not None and found.objective < below else None


def find_optima(
    problem: OrbitProblem, starts: int, seed: int = 0, options: SolverOptions = DEFAULTS
) -> list[Solution]:
    """Return every distinct optimum that the starts find and the certifier confirms, the best first.

    Parameters
    ----------
    problem, starts, seed, options : as in `find_orbit`; the starts run one after the other.
    """
    begun = time.perf_counter()
    found = first_searches(Transcription(problem, options), starts, seed, 1)
    each = (time.perf_counter() - begun) / starts
    optima: list[Solution] = []
    known: list[np.ndarray] = []
    for candidate in optimal(found):
        if any(np.abs(candidate.scaled - other).max() <= options.search.same_optimum for other in known):
            continue
        optimum = certified_optimum(candidate, each)
        if optimum is not None:
            known.append(candidate.scaled)
            if not any(optimum.same_as(other) for other in optima):
                optima.append(optimum)
    return optima


def certified_optimum(candidate: Candidate, seconds: float) -> Solution | None:
    """Certify where a local search ended, or return None; `seconds` is the time that the search took."""
    begun = time.perf_counter()
    programme = candidate.programme.uncorrected()
    best = first_certified(programme, [candidate])
    if best is None:
        return None
    seconds += time.perf_counter() - begun
    return _solution(best, 1, (), 0, seconds, programme.certify_seconds)


def _solution(
    best: Corrected,
    searches: int,
    optima: tuple[Optimum, ...],
    seed: int,
    seconds: float,
    certify_seconds: float,
    ending: Ending | None = None,
) -> Solution:
    end = ending or Ending(Status.CONVERGED, _certified_words(best))
    return Solution(
        best.programme.problem,
        end.status,
        end.message,
        best.wingbeat,
        best.certificate,
        dict(zip(CLOSURE, (float(v) for v in best.residual), strict=True)),
        active_bounds(best.programme, best.scaled),
        best.optimality,
        searches,
        max(len(optima), 1) if end.status is Status.CONVERGED else len(optima),
        seed,
        seconds,
        certify_seconds,
        optima,
        end.deficits,
        end.relaxations,
        best.reduced_hessian,
        best.programme.options,
    )


def _certified_words(best: Corrected) -> str:
    words = f"certified: re-flown, it closes to {size(best.residual):.0e}"
    problem, tolerance = best.programme.problem, best.programme.options.search.bound_tolerance
    if is_at_lower_bound(problem, best.programme.physical(best.scaled), tolerance):
        low = problem.bounds["frequency"][0]
        words += f"; the frequency is at its lower bound of {low:g} Hz, so more starts cannot improve it"
    return words
