"""From a problem to a certified orbit: many local searches, defect correction, the certificate, a status.

The searches of one problem start from its own starts, in parallel, and from optima of an easier problem.
"""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from wingbeat._base import FaultList, cf, for_people
from wingbeat._workers.tuning import core_count
from wingbeat.orbits.changes import holds_frequency, possible_changes
from wingbeat.orbits.deficit import is_clear, nearest_beat
from wingbeat.orbits.diagnosis import Ending, certified_changes, least_change, unexplained, without_orbit
from wingbeat.orbits.flight.period import fly_part
from wingbeat.orbits.nlp.newton_kkt import Corrected, certified, first_certified
from wingbeat.orbits.nlp.transcription import Candidate, Transcription, as_candidate, load_programs, search
from wingbeat.orbits.options import DEFAULTS, SolverOptions, Status
from wingbeat.orbits.problem.quantity import MapQuantity
from wingbeat.orbits.solution import Optimum, Solution, families, optima_of, optimal, solution_of
from wingbeat.orbits.starts import (
    OwnStart,
    asks_for_stability,
    easier,
    minimises_map,
    optima_lead_within,
    plainly,
    start_beside,
    start_count,
    start_point,
    starts_in_words,
    starts_within,
    usual_most_starts,
    wingbeat_with_all_laws,
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
    """How a problem is searched; numbers of starts are by default those of `SearchOptions` for such a problem."""

    starts: int | None = None  # if peaks are minimised, half as many follow near the best optimum
    seed: int = 0  # of the random starts
    most_starts: int | None = None  # further starts follow, up to this many, until one leads to a certified orbit
    advise: bool = True  # without an orbit, find single changes that lead to one; takes as long as the starts
    explain: bool = True  # without an orbit, find the balance that fails and advise; takes a third of their time
    options: SolverOptions = DEFAULTS
    start: OwnStart | None = None  # the user's own, searched first; `starts` counts it too
    trace: bool = False  # keep objective, violation and step of each iteration

    def check(self) -> None:
        """Raise `InvalidInputError` unless all numbers are whole numbers in range."""
        starts, most = (1 if count is None else count for count in (self.starts, self.most_starts))
        check_search(starts, self.seed, most)


USUAL = Settings()
# Of many problems, few readers want the changes that would lead to an orbit.
BRIEF = Settings(advise=False)


def find_orbit(
    problem: OrbitProblem, settings: Settings = USUAL, progress: Progress | None = None, threads: int | None = None
) -> Solution:
    """Find the periodic orbit that minimises the objective, and certify it; a failure is a result, no exception.

    `progress` is called with (starts done, starts in all); without an orbit, each single change tried counts as one
    more start. Starts, seed or most_starts out of range raise `InvalidInputError`.
    """
    options, seed = settings.options, settings.seed
    starts = start_count(problem, settings.starts, options.search)
    most = usual_most_starts(problem, options.search) if settings.most_starts is None else settings.most_starts
    check_search(starts, seed, most)
    begun = time.perf_counter()
    threads = threads or core_count()
    programme = Transcription(problem, options)
    programme.steps = [] if settings.trace else None
    own = None if settings.start is None else np.array([*settings.start.values.values()])
    if not fly_part.loaded:
        like_optimum = wingbeat_with_all_laws(problem, options.search)
        load_programs(programme.uncorrected(), start_point(problem, 0, seed, options.search), like_optimum)
    free: list[Candidate] = []  # where the searches without limits of stability end, if there are such limits
    unlimited: list[Candidate] = []  # and those without any limits
    if asks_for_stability(problem):
        easy = Transcription(easier(problem), options)
        free = first_searches(easy, starts, seed, threads, progress, own, unlimited)
        found = stable_searches(programme, free, threads)
    else:
        found = first_searches(programme, starts, seed, threads, progress, own, unlimited)
    first = (free or found)[0]
    best, ending = first_certified(programme, found), None
    tried = starts_within(problem, starts, options.search)
    if best is None and tried < starts:
        rest, tried = range(tried, starts), starts
        found += search_from_starts(programme, rest, seed, threads, own)
        best = first_certified(programme, found)
    if best is None and settings.explain and problem.within_plausible and problem.subject_to:
        best, ending = beyond_limits(programme, unlimited, len(found), threads, settings.advise)
    nearest = None
    if best is None and settings.explain and settings.most_starts is None and ends_early(problem, found):
        close = nearest_beat(programme, found)
        if is_clear(close, options.diagnosis):
            nearest, most = close, starts
    for led in _where_limits_hold(programme, starts, seed, threads) if best is None else ():
        found += led
        if (best := first_certified(programme, led)) is not None:
            break
    more = range(tried, most if best is None else tried)
    for done, candidate in enumerate(search_from_starts(programme, more, seed, threads, own), tried + 1):
        found.append(candidate)
        if progress is not None:  # searches from limited quantities are not counted
            progress(done, max(starts, most))
        if (best := first_certified(programme, [candidate])) is not None:
            break
    searches = len(found)
    if best is None and settings.explain:
        best, ending = without_orbit(programme, found, threads, settings.advise, progress, nearest)
    elif best is None:
        best, ending = unexplained(found)
    solution = solution_of(best, programme, begun, found, searches, seed, ending)
    if settings.start is not None:
        away = np.abs((first.programme.physical(first.scaled) - solution.unknowns) / problem.unknowns().scale).max()
        near = bool(first.is_optimum and away <= options.search.same_optimum)
        # Without limits of stability, the search may end elsewhere and still lead here. If a quantity of the stroke
        # map is minimised, `first` is where another search ended.
        led = None if minimises_map(problem) or (free and not near) else near and ending is None
        solution = dataclasses.replace(solution, start=settings.start._replace(led_here=led))
    if settings.trace:
        origin = best.origin
        made = found if origin is None or any(c is origin for c in found) else [*found, origin]
        steps = [(i, step) for i, candidate in enumerate(made) for step in candidate.programme.steps or ()]
        number = next((i for i, candidate in enumerate(made) if candidate is origin), None)
        if number is not None:
            steps += [(number, step) for step in best.programme.steps or ()]
        solution = dataclasses.replace(solution, steps=tuple(steps))
    freed = first_certified(free[0].programme, free) if free and not minimises_map(problem) else None
    if freed is None:
        return solution
    objective = freed.programme.objective(freed.scaled) * freed.programme.problem.minimise.scale
    return dataclasses.replace(solution, free_objective=objective)


def ends_early(problem: OrbitProblem, found: list[Candidate]) -> bool:
    """Return whether the closest wingbeat may tell that more starts at a given frequency find no orbit."""
    return holds_frequency(problem) and not problem.subject_to and not any(end.closed for end in found)


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
            yield search_from_optima(programme, found, threads)


def beyond_limits(
    programme: Transcription, unlimited: list[Candidate], searches: int, threads: int, advise: bool
) -> tuple[Corrected | None, Ending | None]:
    """Return the best orbit without limits, with the limits that it leaves and by how much; None if it leaves none.

    With `advise`, each of these limits is moved alone, as little as possible, until an orbit keeps to it and to all
    others. If hardly any move is needed, the searches missed an orbit, which is returned without an ending.
    """
    problem, options = programme.problem, programme.options
    without = Transcription(dataclasses.replace(problem, subject_to=()), options)
    orbit = first_certified(without, unlimited)
    if orbit is None:  # then it is not the ranges that leave none
        orbit, ending = without_orbit(without, unlimited, threads, advise)
        if ending is not None and ending.status is not Status.INFEASIBLE:
            return None, None
        if ending is not None:
            message = f"no orbit within the limits; without them, {ending.message}"
            # Its changes help where the limits are left out, so none is an answer to this problem.
            return orbit, dataclasses.replace(ending, message=message, relaxations=())
    plain = Transcription(plainly(problem), options) if programme.has_epigraph else programme
    assert plain.outputs is not None
    near = without.physical(orbit.scaled)
    margins = plain.certified_inequalities(plain.scaled(near), orbit.certificate)[len(plain.path_limits) :]
    left, told = set(), []
    for index, (quantity, limit, at_most) in enumerate(
        (one.quantity, float(one.limit), one.at_most) for one in problem.subject_to
    ):
        margin = margins[list(plain.outputs.values_of(index))].min() * quantity.scale
        if margin < -options.diagnosis.negligible_change * max(abs(limit), quantity.scale):
            factor, unit = for_people(cf(quantity.unit))
            value = f"{(limit - margin if at_most else limit + margin) * factor:.3g}"
            end = f"at {'most' if at_most else 'least'} {limit * factor:.3g} {unit}".rstrip()
            told.append(f"{quantity.name.replace('_', ' ')} {value} ({end})")
            left.add((quantity.name, "<=" if at_most else ">="))
    if not told:
        return None, None
    changes = [c for c in possible_changes(problem, (), {}, options.changes) if (c.name, c.sign) in left]
    with ThreadPoolExecutor(threads) as pool:
        tried = pool.map(lambda change: least_change(problem, change, near, options), changes if advise else ())
        least = sorted((one for one in tried if one is not None), key=lambda one: one.share)
    leads = [one.unknowns for one in least if one.share <= options.diagnosis.negligible_change]
    if led := first_certified(programme, [search(programme.uncorrected(), lead) for lead in leads]):
        return led, None
    cheapest = orbit.programme.problem.minimise
    which = (
        "the best one" if cheapest is problem.minimise else f"the one of least {cheapest.name.replace('_', ' ')}"
    )
    message = (
        f"no orbit within the limits from {starts_in_words(searches)}: at {problem.speed:g} m/s, {which} "
        f"without them has {', '.join(told)}"
    )
    flying = certified_changes(plain, least)
    if flying:
        message += f"; the smallest single changes that give an orbit: {', or '.join(one.text for one in flying)}"
    elif advise:
        message += "; moving one of these limits alone gave no orbit"
    return certified(programme.uncorrected(), programme.scaled(near)), Ending(
        Status.INFEASIBLE, message, (), flying
    )


def first_searches(
    programme: Transcription,
    starts: int,
    seed: int,
    threads: int,
    progress: Progress | None = None,
    own: np.ndarray | None = None,
    unlimited: list[Candidate] | None = None,
) -> list[Candidate]:
    """Search from starts, from optima of the problem without limits, and near the lowest peak; return all ends.

    The ends of the searches without any limits are appended to `unlimited`.
    """
    problem, options = programme.problem, programme.options
    if asks_for_stability(problem):
        easy = Transcription(easier(problem), options)
        free = first_searches(easy, starts, seed, threads, progress, own, unlimited)
        return stable_searches(programme, free, threads)
    limited, first = bool(problem.subject_to), starts_within(problem, starts, options.search)
    found: list[Candidate] = []
    for candidate in search_from_starts(programme, range(first), seed, threads, own):
        found.append(candidate)
        if progress is not None:
            progress(len(found), first + starts * limited)
    if limited:
        without = Transcription(dataclasses.replace(problem, subject_to=()), options)
        report = None if progress is None else lambda done, total: progress(first + done, first + total)
        found += search_from_optima(
            programme, first_searches(without, starts, seed, threads, report, own, unlimited), threads
        )
    if programme.has_epigraph:
        for _ in range(starts // 2):  # a lower peak is often near the best optimum
            optima = optima_of(found)
            if not optima:
                break
            start = start_beside(problem, optima[0].unknowns, len(found), seed, options.search)
            found.append(search(programme.uncorrected(), start))
    if unlimited is not None and not limited:
        unlimited += found
    return found


def search_from_optima(
    programme: Transcription, easier: Iterable[Candidate], threads: int, pruned: bool = False
) -> list[Candidate]:
    """Search from the best optimum of each family of an easier problem; return where the local searches end.

    With `pruned`, a family that is dearer without the limits than an optimum found with them is left out, because
    limits only raise the objective within a family. Within plausible ranges, so is one whose objective without
    limits is that of a family which has led to an optimum.
    """
    problem, options = programme.problem, programme.options.search
    ranges, led = optima_lead_within(problem), list[Optimum]()
    found: list[Candidate] = []
    starts = list(families(optima_of(easier), problem.unknowns().scale, options.same_optimum))
    while starts:
        together = starts[:threads] if pruned else starts
        if ranges:
            together = [one for i, one in enumerate(starts) if not _is_alike(one, starts[:i], options.same_value)]
        starts = [one for one in starts if all(one is not other for other in together)]
        begun = [optimum.unknowns for optimum in together]
        ends = list(_side_by_side(lambda start: search(programme.uncorrected(), start), begun, threads))
        found += ends
        if ranges:
            led += [one for one, end in zip(together, ends, strict=True) if end.is_optimum]
            starts = [one for one in starts if not _is_alike(one, led, options.same_value)]
        elif best := optimal(found):
            starts = [one for one in starts if one.objective < best[0].objective]
    return found


def _is_alike(optimum: Optimum, others: Iterable[Optimum], share: float) -> bool:
    """Return whether the objective is that of another optimum, within a share of it."""
    return any(abs(optimum.objective - other.objective) <= share * abs(other.objective) for other in others)


def stable_searches(programme: Transcription, free: list[Candidate], threads: int) -> list[Candidate]:
    """Search for stable orbits from the optima without limits of stability; return where the searches end.

    Without such an optimum, the ends of `free` are returned.
    """
    # No search starts from elsewhere: stable orbits are next to some of these optima, and a flight with the
    # derivatives of the stroke map takes five times as long as one without.
    best, map_is_minimised = optimal(free), minimises_map(programme.problem)
    if best and not map_is_minimised:
        already = as_candidate(programme.uncorrected(), programme.scaled(optima_of(best)[0].unknowns), optimal=True)
        if already.is_optimum:
            return [already]
    if map_is_minimised or not best:
        ends = (free_end.programme.physical(free_end.scaled) for free_end in free)
        return search_from_optima(programme, free, threads) or [
            as_candidate(programme.uncorrected(), programme.scaled(end)) for end in ends
        ]
    found = search_from_optima(programme, free, threads, pruned=True)
    stable = optimal(found)
    dear = best[0].objective + programme.options.search.dear_stability * abs(best[0].objective)
    if not stable or stable[0].objective > dear:
        # The limits are tightened step by step, because a direct search may end in another family.
        found.append(search(programme.uncorrected(), tightened(programme, optima_of(best)[0].unknowns)))
    return found


def search_from_starts(
    programme: Transcription, indices: Sequence[int], seed: int, threads: int, own: np.ndarray | None = None
) -> Iterator[Candidate]:
    """Search from these starts in parallel threads, and yield in order where each local search ends.

    A start of the user's `own` is number 0, before the others.
    """

    def one(index: int) -> Candidate:
        if own is not None:
            if index == 0:
                return search(programme.uncorrected(), own, restore=True)
            index -= 1
        start = start_point(programme.problem, index, seed, programme.options.search)
        # All but the stock wingbeat are first brought close to closure: from far away, a search diverges. If no
        # orbit exists, it then ends after 30 flights rather than 100.
        return search(programme.uncorrected(), start, restore=index > 0)

    yield from _side_by_side(one, indices, threads)


def _side_by_side(work: Callable[[T], Candidate], items: Sequence[T], threads: int) -> Iterator[Candidate]:
    if threads == 1 or len(items) == 1:
        yield from map(work, items)
        return
    # Compiled flights release the interpreter lock, so threads run in parallel.
    with ThreadPoolExecutor(threads) as pool:
        try:
            yield from pool.map(work, items)
        finally:
            pool.shutdown(wait=False, cancel_futures=True)


def tightened(programme: Transcription, start: np.ndarray) -> np.ndarray:
    """Return unknowns near an optimum within limits of the stroke map, from an orbit that exceeds them.

    Each limit moves from the quantity's value at the start in steps of equal ratio; a short search follows each.
    """
    problem, options = programme.problem, programme.options
    stroke_map = programme.fly(start[4:], start[:4]).stroke_map
    for share in np.linspace(0.0, 1.0, options.search.tightening_steps + 1)[1:].tolist():
        limits = []
        for constraint in problem.subject_to:
            quantity, limit = constraint.quantity, constraint.limit
            if isinstance(quantity, MapQuantity) and constraint.at_most:
                there = float(np.max(quantity.of(stroke_map)))
                if there > limit > 0:
                    constraint = dataclasses.replace(constraint, limit=there * (limit / there) ** share)
            limits.append(constraint)
        nearer = Transcription(dataclasses.replace(problem, subject_to=tuple(limits)), options)
        scaled = nearer.scaled(start)
        start = nearer.physical(
            nearer.optimise(scaled, options.search.tightening_iterations, options.search.tolerance)[0]
        )
    return start
