"""Branches of orbits along speed, frequency or the share of terms of the air loads, and their marks."""

from __future__ import annotations

import bisect
import dataclasses
import itertools
import math
import time
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any, NamedTuple, TypeVar

import numpy as np

from wingbeat._base import PLURALS
from wingbeat._workers.tuning import core_count
from wingbeat.orbits.nlp.newton_kkt import NewtonKKT, ReducedHessian
from wingbeat.orbits.nlp.transcription import Candidate, Transcription, as_candidate, refine
from wingbeat.orbits.options import DEFAULTS, ContinuationOptions, SolverOptions, Status
from wingbeat.orbits.problem.parameters import with_number
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.solution import Solution, certified_optimum, optimal, place_of
from wingbeat.orbits.solve import Progress, Settings, find_orbit, first_searches


class Along(NamedTuple):
    """A number of a problem along which orbits are continued, and its first and smallest `steps` from a value."""

    name: str
    unit: str
    of: Callable[[OrbitProblem], float]
    moved: Callable[[OrbitProblem, float], OrbitProblem]
    steps: Callable[[ContinuationOptions, float], tuple[float, float]]
    advise: bool = True  # whether a problem without an orbit asks for changes of its numbers that would give one


def at_frequency(problem: OrbitProblem, frequency: float) -> OrbitProblem:
    """Return the problem at a given frequency [Hz], which is free no more and no longer the animal's own."""
    held = with_number(problem.species, ("wingbeat", "frequency"), frequency)
    return dataclasses.replace(problem, species=held, own_frequency=False, **fixed_frequency(problem))


def fixed_frequency(problem: OrbitProblem) -> dict[str, Any]:
    """Return the free parameters and the bounds of a problem without those of the frequency."""
    free = tuple(name for name in problem.free if name != "frequency")
    return {"free": free, "bounds": {n: pair for n, pair in problem.bounds.items() if n != "frequency"}}


SPEED = Along(
    "speed",
    "m/s",
    lambda problem: problem.speed,
    lambda problem, speed: problem.at_speed(speed),
    lambda options, _: (options.first_speed_step, options.least_speed_step),
)
FREQUENCY = Along(
    "frequency",
    "Hz",
    lambda problem: problem.species.wingbeat.frequency,
    at_frequency,
    lambda options, value: (options.first_frequency_step * value, options.least_frequency_step * value),
    advise=False,  # the other frequencies show which one would do
)
# From 0 for none of the terms to 1 for all of each.
SHARE = Along(
    "share",
    "",
    lambda problem: problem.aero.share,
    lambda problem, share: dataclasses.replace(problem, aero=dataclasses.replace(problem.aero, share=share)),
    lambda options, _: (options.first_share_step, options.least_share_step),
)

T = TypeVar("T")
R = TypeVar("R")


class BranchLink(NamedTuple):
    """Optimum `lower` of a problem and optimum `upper` of the next one are of one branch, `steps` steps apart."""

    interval: int
    lower: int
    upper: int
    steps: int


class Landing(NamedTuple):
    """The optimum to which a continuation led, if any, and the number of steps, 0 after a jump."""

    optimum: Solution | None
    steps: int


class Branches(NamedTuple):
    """The optima of each problem, best first, and their links; a problem without an orbit has a failed solution."""

    optima: tuple[tuple[Solution, ...], ...]
    links: tuple[BranchLink, ...]
    along: Along = SPEED


# Returns the problems to solve between those solved so far; none to end.
Refine = Callable[[Branches], Sequence[OrbitProblem]]


def trace(
    along: Along,
    problems: list[OrbitProblem],
    starts: int,
    seed: int,
    progress: Progress | None = None,
    threads: int | None = None,
    options: SolverOptions = DEFAULTS,
    refine: Refine | None = None,
) -> Branches:
    """Solve problems in the order of one number, and continue each optimum to the neighbours until none is new.

    The first and the last problem get `starts` starts, those between fewer; one without a certified orbit then gets
    twice as many as the first. The results do not depend on the number of `threads`. Again and again, `refine`
    chooses problems to add from the branches so far; continuation from the neighbours solves these.
    """
    with ThreadPoolExecutor(threads or core_count()) as pool:
        try:
            return _BranchTracer(along, problems, pool, progress, options).branches(starts, seed, refine)
        finally:
            pool.shutdown(wait=False, cancel_futures=True)


class _BranchTracer:
    """The optima and links found so far. Tasks of a round are independent, so their order has no effect."""

    def __init__(
        self,
        along: Along,
        problems: list[OrbitProblem],
        pool: ThreadPoolExecutor,
        progress: Progress | None,
        options: SolverOptions,
    ) -> None:
        self._along, self._problems = along, list(problems)
        self._pool, self._progress, self._options = pool, progress, options
        self._met: list[list[Solution]] = [[] for _ in problems]
        self._links: dict[tuple[int, int, int], int] = {}
        self._tried: set[tuple[int, int, int]] = set()
        self._searches = [0] * len(problems)
        self._done = 0

    def branches(self, starts: int, seed: int, refine: Refine | None) -> Branches:
        last, options = len(self._problems) - 1, self._options
        between = math.ceil(starts / options.continuation.fewer_starts)
        counts = [starts if place in (0, last) else between for place in range(last + 1)]
        met = self._each(lambda i: find_optima(self._problems[i], counts[i], seed + i, options), range(last + 1))
        for place, optima in enumerate(met):
            self._searches[place] += counts[place]
            for optimum in optima:
                self._add(place, optimum)
        failed: dict[float, Solution] = {}
        self._complete(starts, seed, failed)
        found = self._sorted(failed)
        while refine is not None and (added := refine(found)):
            for problem in added:
                self._insert(problem)
            self._complete(starts, seed, failed)
            found = self._sorted(failed)
        return found

    def _complete(self, starts: int, seed: int, failed: dict[float, Solution]) -> None:
        """Continue all optima; where that finds nothing, search once more, and keep what failed, by its number."""
        self._grow()
        lost = [i for i, met in enumerate(self._met) if not met and self._along.of(self._problems[i]) not in failed]
        advise = self._along.advise
        settings = Settings(2 * starts, seed, 2 * starts, advise=advise, options=self._options)
        again = self._each(lambda i: find_orbit(self._problems[i], settings, threads=1), lost)
        for place, solution in zip(lost, again, strict=True):
            self._searches[place] += solution.starts
            if solution.status is Status.CONVERGED:
                self._add(place, solution)
            else:
                failed[self._along.of(self._problems[place])] = solution
        self._grow()

    def _insert(self, problem: OrbitProblem) -> None:
        """Put a problem between two others, whose optima are then continued to it."""
        at = bisect.bisect([self._along.of(other) for other in self._problems], self._along.of(problem))
        self._problems.insert(at, problem)
        self._met.insert(at, [])
        self._searches.insert(at, 0)

        def moved(place: int) -> int:
            return place + (place >= at)

        split = ((at - 1, 1), (at, -1))  # what was continued across the place is now continued to it
        self._links = {(moved(i), low, high): n for (i, low, high), n in self._links.items() if i != at - 1}
        self._tried = {(moved(i), index, way) for i, index, way in self._tried if (i, way) not in split}

    def _each(self, work: Callable[[T], R], items: Sequence[T]) -> list[R]:
        """Return the result of `work` for each item."""
        found = []
        known = self._done + len(items)
        for result in self._pool.map(work, items):
            found.append(result)
            self._done += 1
            if self._progress is not None:
                self._progress(self._done, known)
        return found

    def _add(self, place: int, optimum: Solution) -> int:
        """Add an optimum to those of its speed unless it is known; return its index."""
        for index, other in enumerate(self._met[place]):
            if optimum.same_as(other):
                if optimum.objective < other.objective:
                    self._met[place][index] = optimum
                return index
        self._met[place].append(optimum)
        return len(self._met[place]) - 1

    def _grow(self) -> None:
        """Continue optima up and down, in rounds, until all are continued."""
        while any([self._round(self._due(1)), self._round(self._due(-1)), self._round(self._between_best())]):
            pass

    def _round(self, tasks: list[tuple[int, int, int]]) -> bool:
        self._tried |= set(tasks)

        def continued(task: tuple[int, int, int]) -> Landing:
            place, index, way = task
            return carry(self._met[place][index], self._problems[place + way], self._along)

        landings = self._each(continued, tasks)
        for (place, index, way), (optimum, steps) in zip(tasks, landings, strict=True):
            there = place + way
            self._searches[there] += 1
            if optimum is None:
                continue
            landed = self._add(there, optimum)
            if steps:
                ends = (index, landed) if way > 0 else (landed, index)
                self._links.setdefault((min(place, there), *ends), steps)
        return bool(tasks)

    def _ranked(self, place: int) -> list[int]:
        """Return the indices of the optima of one problem, the best first."""
        return sorted(range(len(self._met[place])), key=lambda index: self._met[place][index].objective)

    def _due(self, way: int) -> list[tuple[int, int, int]]:
        """Return the tasks of the optima that have no link to the next speed in one direction yet."""
        linked = {(i, low) if way > 0 else (i + 1, high) for i, low, high in self._links}
        return [
            (place, index, way)
            for place in range(len(self._met))
            for index in self._ranked(place)[: self._options.continuation.followed]
            if 0 <= place + way < len(self._met)
            and (place, index) not in linked
            and (place, index, way) not in self._tried
        ]

    def _between_best(self) -> list[tuple[int, int, int]]:
        """Return the tasks, not yet tried, that could link the best optima of neighbouring speeds."""
        tasks = []
        for place in range(len(self._met) - 1):
            if not self._met[place] or not self._met[place + 1]:
                continue
            low, high = self._ranked(place)[0], self._ranked(place + 1)[0]
            if (place, low, high) not in self._links:
                tasks += [(place, low, 1), (place + 1, high, -1)]
        return [task for task in tasks if task not in self._tried]

    def _sorted(self, failed: dict[float, Solution]) -> Branches:
        """Return the branches, with the optima of each speed in order and the number of starts at that speed."""
        optima, ranks = [], []
        for place, met in enumerate(self._met):
            order = self._ranked(place)
            ranks.append({index: rank for rank, index in enumerate(order)})
            count = {"starts": self._searches[place], "distinct_optima": len(met)}
            here = [met[k] for k in order] or [failed[self._along.of(self._problems[place])]]
            optima.append(tuple(dataclasses.replace(optimum, **count) for optimum in here))
        links = [
            BranchLink(place, ranks[place][low], ranks[place + 1][high], steps)
            for (place, low, high), steps in self._links.items()
        ]
        return Branches(tuple(optima), tuple(sorted(links)), self._along)


def find_optima(
    problem: OrbitProblem, starts: int, seed: int = 0, options: SolverOptions = DEFAULTS
) -> list[Solution]:
    """Return every distinct optimum that the starts find and the certifier confirms, the best first."""
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


def carry(optimum: Solution, problem: OrbitProblem, along: Along = SPEED) -> Landing:
    """Continue an optimum along one number to another problem, in steps that move the orbit by at most `max_step`.

    If the branch ends on the way, a local search from its end leads to the landing, which then has 0 steps.
    """
    options = optimum.options.continuation
    value, last = along.of(optimum.problem), along.of(problem)
    first_step, least_step = along.steps(options, value)
    here, rate = optimum.place, np.zeros(optimum.place.size)
    step = math.copysign(min(first_step, abs(last - value)), last - value)
    hessian: ReducedHessian | None = None
    steps = 0
    while abs(step) >= least_step:
        # A remainder too short to be a step of its own is added to this one.
        ends = abs(last - value - step) < least_step
        step = last - value if ends else step
        there = problem if ends else along.moved(problem, value + step)
        programme = Transcription(there, optimum.options)
        candidate, hessian = _next_to(programme, _unknowns_at(here + rate * step, there), hessian)
        found = here if candidate is None else place_of(there, programme.physical(candidate.scaled))
        if candidate is None or np.abs(found - here).max() > options.max_step:
            step, rate = 0.5 * step, 0.0 * rate
            continue
        steps += 1
        if ends:
            return Landing(certified_optimum(candidate, 0.0), steps)
        rate, here, value = (found - here) / step, found, value + step
        fitting = options.aimed_step * options.max_step / max(np.abs(rate).max(), 1e-9)
        step = math.copysign(min(fitting, options.step_growth * abs(step), abs(last - value)), step)
    candidate = refine(Transcription(problem, optimum.options), _unknowns_at(here, problem))
    return Landing(certified_optimum(candidate, 0.0) if candidate.is_optimum else None, 0)


def _next_to(
    programme: Transcription, guess: np.ndarray, like: ReducedHessian | None
) -> tuple[Candidate | None, ReducedHessian | None]:
    """Return the optimum near a guess, from Newton's method or else a local search, and its curvature if known."""
    scaled = programme.scaled(guess)
    newton = NewtonKKT(programme, scaled, like)
    near = newton.converge(programme, scaled)
    if near is not None:
        candidate = as_candidate(programme, near)
        if candidate.is_optimum:
            return candidate, newton.reduced_hessian
    candidate = refine(programme, guess, programme.options.continuation.step_iterations)
    return (candidate, None) if candidate.is_optimum else (None, None)


def _unknowns_at(place: np.ndarray, problem: OrbitProblem) -> np.ndarray:
    """Return the unknowns of a problem from a `Solution.place`."""
    unknowns = place * problem.unknowns().scale
    unknowns[1:3] += problem.speed, problem.climb
    return unknowns


# --- Marks along the best orbits. ---

# Words for bounds that cease to be active, and for those that become active: for one name, and for several.
_LEFT = "leaves its bound", "leave their bounds"
_REACHED = "reaches its bound", "reach their bounds"


class Mark(NamedTuple):
    """A change of the best orbit between two neighbouring problems; `what` describes it."""

    kind: str
    lower: float
    upper: float
    what: str


def marks_of(branches: Branches) -> list[Mark]:
    """Return the changes of the best orbit from problem to problem.

    ``gap``: one of the two problems has no certified orbit. ``branch``: no continuation leads from the best orbit
    of one problem to that of the next, so the unknowns jump. ``bounds``: different bounds are active.
    """
    marks, along = [], branches.along
    joined = {link.interval for link in branches.links if link.lower == link.upper == 0}
    for interval, (below, above) in enumerate(itertools.pairwise(optima[0] for optima in branches.optima)):
        ends = along.of(below.problem), along.of(above.problem)
        if not certified(below) or not certified(above):
            marks.append(Mark("gap", *ends, f"no certified orbit at one of these {PLURALS[along.name]}"))
            continue
        if interval not in joined:
            marks.append(Mark("branch", *ends, _how_it_changes(branches, interval)))
        gone = [name for name in below.active_bounds if name not in above.active_bounds]
        come = [name for name in above.active_bounds if name not in below.active_bounds]
        parts = [
            f"{', '.join(names)} {words[len(names) > 1]}"
            for names, words in ((gone, _LEFT), (come, _REACHED))
            if names
        ]
        if parts:
            marks.append(Mark("bounds", *ends, "; ".join(parts)))
    return marks


def families(branches: Branches) -> list[list[int]]:
    """Return the family number of each optimum of each problem; families are in order of their best ranks.

    If two families lead to the same optimum, the one with fewer steps continues.
    """
    labels = [[-1] * len(optima) for optima in branches.optima]
    count = 0
    for place, optima in enumerate(branches.optima):
        ways = [join for join in branches.links if join.interval == place - 1]
        taken: set[int] = set()
        for join in sorted(ways, key=lambda j: j.steps):
            if labels[place][join.upper] < 0 and join.lower not in taken:
                labels[place][join.upper] = labels[place - 1][join.lower]
                taken.add(join.lower)
        for index in range(len(optima)):
            if labels[place][index] < 0:
                labels[place][index] = count
                count += 1
    first = dict.fromkeys(label for rank in range(count) for row in labels for label in row[rank : rank + 1])
    order = {label: number for number, label in enumerate(first)}
    return [[order[label] for label in row] for row in labels]


def certified(solution: Solution) -> bool:
    """Whether a solution is a certified orbit."""
    return solution.status is Status.CONVERGED


def _how_it_changes(branches: Branches, interval: int) -> str:
    """Return in words whether two families cross, and where, or whether one of them ends."""
    ways = {j.lower: j.upper for j in branches.links if j.interval == interval}
    back = {upper: lower for lower, upper in ways.items()}
    below, above = branches.optima[interval : interval + 2]
    if 0 in ways and 0 in back:
        before = below[back[0]].objective - below[0].objective
        after = above[ways[0]].objective - above[0].objective
        low, high = (branches.along.of(one[0].problem) for one in (below, above))
        share = before / (before + after) if before + after > 0 else 0.5
        return f"another family becomes better near {low + share * (high - low):.2f} {branches.along.unit}".rstrip()
    if 0 in ways:
        return "a better family begins"
    if 0 in back:
        return "the family ends and another continues"
    return "the family ends and another begins"
