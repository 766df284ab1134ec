"""Many orbit problems: batches spread over processes, and series whose solutions pass to the neighbours and back.

In a batch, problems that differ in numbers only are similar, and a later one starts from the solutions of earlier
ones.
"""

from __future__ import annotations

import dataclasses
import functools
import time
from collections.abc import Callable, Hashable, Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np

from wingbeat._base import FaultList
from wingbeat._jax.arrays import jax
from wingbeat._workers.pool import in_processes, process_map
from wingbeat.orbits.nlp.newton_kkt import ReducedHessian, first_certified
from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.orbits.options import DEFAULTS, ContinuationOptions, SolverOptions, Status
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.solution import (
    Solution,
    at_orbit,
    better_of,
    correct_guess,
    families,
    optima_of,
    optimal,
    search_near,
    solution_of,
)
from wingbeat.orbits.solve import BRIEF, Progress, Settings, find_orbit, first_searches
from wingbeat.orbits.starts import start_count


class Group(NamedTuple):
    """Indices of problems that differ in numbers only: those to solve first, and the others, split into parts."""

    first: list[int]
    parts: list[list[int]]


def group_similar(
    problems: Sequence[OrbitProblem], options: ContinuationOptions = DEFAULTS.continuation
) -> list[Group]:
    """Return groups of problems that differ in numbers only, in an order that favours predictions.

    Of a large group, a sample is to be solved first, then parts of similar problems. Sample and parts begin nearest
    to the mean and go on with what is farthest from all before. The number of processes has no effect.
    """
    kinds: dict[object, list[int]] = {}
    for i, problem in enumerate(problems):
        kinds.setdefault(kind(problem), []).append(i)
    groups = []
    for members in kinds.values():
        places = differences([numbers_of(problems[i]) for i in members], options.rounding)
        whole = np.arange(len(members))
        first = _spread(places, whole, len(members) if len(members) <= options.batch_size else options.batch_first)
        rest = np.setdiff1d(whole, first)
        split = _parts(places, rest, options.batch_size) if rest.size else []
        parts = [_spread(places, part, part.size) for part in split]
        groups.append(Group([members[j] for j in first], [[members[j] for j in part] for part in parts]))
    return groups


def kind(problem: OrbitProblem) -> Hashable:
    """Return a value that is equal for problems that differ in numbers only."""
    leaves, tree = jax.tree_util.tree_flatten((problem.model, problem.species.wingbeat))
    shapes = tuple(np.shape(leaf) for leaf in leaves)
    asked = *problem.free, repr(problem.minimise), repr(problem.subject_to)
    return (problem.species.name, problem.aero.coefficients.name, *asked), tree, shapes


def differences(described: Sequence[np.ndarray], rounding: float) -> np.ndarray:
    """Return coordinates of problems about their mean, in the directions in which their scaled numbers differ."""
    numbers = np.array(described)
    numbers = numbers / np.maximum(np.abs(numbers).max(axis=0), np.finfo(float).tiny)
    places, sizes, _ = np.linalg.svd(numbers - numbers.mean(axis=0), full_matrices=False)
    counts = sizes > rounding * np.sqrt(numbers.size)
    return places[:, counts] * sizes[counts]


def numbers_of(problem: OrbitProblem) -> np.ndarray:
    """Return the numbers that distinguish a problem from others of its kind."""
    leaves = jax.tree_util.tree_leaves((problem.model, problem.species.wingbeat))
    bounds = list(problem.bounds.values())
    # Numbers that a coefficient model lacks are not-a-number.
    return np.nan_to_num(np.concatenate([np.ravel(a) for a in (*leaves, problem.speed, problem.climb, bounds)]))


def _parts(places: np.ndarray, members: np.ndarray, most: int) -> list[np.ndarray]:
    """Halve along the direction with the largest range, and halve the parts again until all are small enough."""
    if members.size <= most:
        return [members]
    here = places[members]
    order = members[np.argsort(here[:, np.ptp(here, axis=0).argmax()], kind="stable")] if here.size else members
    half = members.size // 2
    return _parts(places, order[:half], most) + _parts(places, order[half:], most)


def _spread(places: np.ndarray, members: np.ndarray, count: int) -> np.ndarray:
    """Return `count` members: first the one nearest to the mean, then always the farthest from those chosen."""
    here = places[members] - places[members].mean(axis=0)
    order, away = [], np.full(members.size, np.inf)
    nearest = np.linalg.norm(here, axis=1).argmin()
    for _ in range(count):
        order.append(nearest)
        away = np.minimum(away, np.linalg.norm(here - here[nearest], axis=1))
        away[order] = -1.0
        nearest = away.argmax()
    return members[order]


class Known(NamedTuple):
    """A solved problem: the numbers that distinguish it from its kind, its optimum, and what holds there."""

    numbers: np.ndarray
    unknowns: np.ndarray
    active: tuple[str, ...]
    reduced_hessian: ReducedHessian | None


class Answers:
    """Solutions of problems of one kind, and predictions from the nearest of them for problems to come."""

    def __init__(
        self,
        known: Sequence[Known],
        coming: Sequence[np.ndarray],
        options: ContinuationOptions = DEFAULTS.continuation,
    ) -> None:
        self._before, self._near_share = len(known), options.near_share
        self._places = differences([*(one.numbers for one in known), *coming], options.rounding)
        self._known = list(known)
        self._at = list(range(len(known)))

    def add(self, place: int, known: Known) -> None:
        """Add the solution of a problem that was to come."""
        self._at.append(self._before + place)
        self._known.append(known)

    def predict(self, place: int) -> list[tuple[np.ndarray, ReducedHessian | None]]:
        """Return predicted unknowns, each with the curvature of the nearest solution that has one.

        Each family of solutions with the same active bounds near the problem makes one; none does if one is small.
        """
        away = self._places[self._at] - self._places[self._before + place]
        order = np.linalg.norm(away, axis=1).argsort(kind="stable")
        enough = away.shape[1] + 2
        families = dict.fromkeys(self._known[i].active for i in order[:enough])
        members = [np.array([i for i in order if self._known[i].active == family]) for family in families]
        if any(alike.size < enough for alike in members):
            return []
        predicted = []
        for alike in members:
            known = [self._known[i] for i in alike]
            unknowns = _regression(away[alike], np.array([one.unknowns for one in known]), self._near_share)
            curvatures = (one.reduced_hessian for one in known if one.reduced_hessian is not None)
            predicted.append((unknowns, next(curvatures, None)))
        return predicted


def _regression(away: np.ndarray, values: np.ndarray, near_share: float) -> np.ndarray:
    """Fit a parabola to values, the nearest first, or a line if they are too few; return the fit at distance 0."""
    directions = away.shape[1]
    columns = np.hstack([np.ones((len(away), 1)), away])
    one, other = np.triu_indices(directions)
    if len(away) >= 1.5 * (columns.shape[1] + one.size):
        columns = np.hstack([columns, away[:, one] * away[:, other]])
    count = 2 * max(columns.shape[1], directions + 2)
    distance = np.linalg.norm(away[:count], axis=1)
    weights = 1.0 / (distance + near_share * distance[-1])[:, None]
    return np.linalg.lstsq(columns[:count] * weights, values[:count] * weights)[0][0]


class Part(NamedTuple):
    """Problems of one kind that are solved in sequence, and known solutions that predict the first of them."""

    problems: list[OrbitProblem]
    known: list[Known]


# A solution and, if it is certified, what it contributes to predictions.
Answer = tuple[Solution, Known | None]


def find_orbits(
    problems: Sequence[OrbitProblem],
    settings: Settings = BRIEF,
    processes: int = 1,
    progress: Progress | None = None,
) -> Iterator[Solution]:
    """Yield the solution of each problem, in the order of `problems`; a failure is a result, as in `find_orbit`.

    In a group that differs in numbers only, solutions predict a first start of each later problem, which counts if
    it leads to a certified orbit. The number of `processes` has no effect on the results. What is not an
    `OrbitProblem`, and numbers out of range, raise `InvalidInputError`.
    """
    faults = FaultList()
    for i, problem in enumerate(problems):
        if not isinstance(problem, OrbitProblem):
            faults.add(f"problems[{i}]", problem, "is not an OrbitProblem")
    check_processes(faults, processes)
    faults.raise_if_any()
    settings.check()
    solve = functools.partial(_solve_part, settings=settings)
    groups = group_similar(problems, settings.options.continuation)
    return _in_order(solve, problems, groups, processes, progress)


def check_processes(faults: FaultList, processes: Any) -> None:
    """Add a fault unless `processes` is a whole number in range."""
    faults.whole("processes", processes, 1, 1024)


def _in_order(
    solve: Callable[[Part], Iterator[Answer]],
    problems: Sequence[OrbitProblem],
    groups: Sequence[Group],
    processes: int,
    progress: Progress | None,
) -> Iterator[Solution]:
    """Solve first what each group solves first, then all parts; yield each solution when its turn comes."""
    work = solve if processes == 1 else functools.partial(_all_of, solve)
    learned: list[list[Known]] = [[] for _ in groups]
    first = [(group.first, known) for group, known in zip(groups, learned, strict=True)]
    rest = [(part, known) for group, known in zip(groups, learned, strict=True) for part in group.parts]
    waiting: dict[int, Solution] = {}
    due = 0
    with process_map(processes, max(len(first), len(rest))) as over:
        for tasks in (first, rest):
            parts = [Part([problems[i] for i in indices], list(known)) for indices, known in tasks]
            for (indices, known), answers in zip(tasks, over(work, parts), strict=True):
                for index, (solution, answer) in zip(indices, answers, strict=True):
                    if answer is not None:
                        known.append(answer)
                    waiting[index] = solution
                    if progress is not None:
                        progress(due + len(waiting), len(problems))
                    while due in waiting:
                        yield waiting.pop(due)
                        due += 1


def _all_of(solve: Callable[[Part], Iterator[Answer]], part: Part) -> list[Answer]:
    return list(solve(part))


def _solve_part(part: Part, settings: Settings) -> Iterator[Answer]:
    """Solve the problems of a part in sequence; earlier solutions help to solve the later problems."""
    options = settings.options
    numbers = [numbers_of(problem) for problem in part.problems]
    answers = Answers(part.known, numbers, options.continuation)
    for i, problem in enumerate(part.problems):
        counted = dataclasses.replace(settings, starts=start_count(problem, settings.starts, options.search))
        known = best_of_guesses(problem, answers.predict(i), options)
        best = find_with_known(problem, known, counted)
        answer = None
        if best.status is Status.CONVERGED:
            answer = Known(numbers[i], best.unknowns, best.active_bounds, best.reduced_hessian)
            answers.add(i, answer)
        yield best, answer


def best_of_guesses(
    problem: OrbitProblem,
    guesses: Sequence[tuple[np.ndarray, ReducedHessian | None]],
    options: SolverOptions = DEFAULTS,
) -> Solution | None:
    """Return the best certified orbit that corrections of the predicted unknowns lead to, or None."""
    near = (correct_guess(problem, guess, like, options) for guess, like in guesses)
    return min((found for found in near if found is not None), key=lambda found: found.objective, default=None)


def find_with_known(problem: OrbitProblem, known: Solution | None, settings: Settings) -> Solution:
    """Return the known certified orbit, if any, or a better one that the other `starts` of the settings find."""
    if known is None:
        return find_orbit(problem, settings, threads=1)
    assert settings.starts is not None
    return known if settings.starts == 1 else find_beside(known, settings.starts - 1, settings.seed)


def find_beside(known: Solution, starts: int, seed: int = 0) -> Solution:
    """Return the better of a certified orbit and the best orbit from a number of further starts."""
    begun = time.perf_counter()
    programme, options = Transcription(known.problem, known.options), known.options.search
    here, scale = programme.scaled(known.unknowns), known.problem.minimise.scale
    objective = programme.objective(here) * scale
    error, apart = options.uncorrected_error * max(abs(objective), scale), options.same_optimum
    found = first_searches(programme, starts, seed, 1)
    others = [
        c for c in optimal(found) if c.objective <= objective - error or np.abs(c.scaled - here).max() > apart
    ]
    # Only optima that may be better, judged by the solver's coarse flights, are certified.
    best = first_certified(programme, [c for c in others if c.objective <= objective + error])
    if best is not None:
        return better_of(solution_of(best, programme, begun, found, len(found), seed), known)
    place = known.problem.unknowns().scale, apart
    optima = families([*known.as_optimum(), *optima_of(found)], *place)
    return dataclasses.replace(
        known,
        starts=known.starts + len(found),
        seed=seed,
        distinct_optima=len(optima) + 1 - len(at_orbit(optima, known.unknowns, *place)),
        optima=optima,
        seconds=known.seconds + time.perf_counter() - begun,
        certify_seconds=known.certify_seconds + sum(programme.certifying),
    )


def find_series(
    problems: Sequence[OrbitProblem],
    settings: Settings = BRIEF,
    processes: int = 1,
    progress: Progress | None = None,
) -> list[Solution]:
    """Solve a series of problems, such as increasing speeds, from starts and from the neighbours' solutions.

    Solutions are passed up and down the series, so that the best family found for any problem reaches every problem
    where it exists. Problems that differ in what is free raise `InvalidInputError`.
    """
    faults = FaultList()
    for i, problem in enumerate(problems):
        if problem.free != problems[0].free:
            fix = f"give all problems the same free parameters: {', '.join(problems[0].free)}"
            rule = "differs from the free parameters of the first problem"
            faults.add(f"problems[{i}].free", problem.free, rule, fix)
    check_processes(faults, processes)
    faults.raise_if_any()
    search = functools.partial(find_orbit, settings=settings, threads=1)
    best = list(in_processes(search, problems, processes, progress))
    tried: set[tuple[bytes, int]] = set()
    upward = [(i, i + 1) for i in range(len(best) - 1)]
    downward = [(i + 1, i) for i in reversed(range(len(best) - 1))]
    for sweep in range(settings.options.continuation.sweeps):
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
    """Return the better of a problem's own solution and one from its neighbour, and whether it is the second."""
    below = float("inf")
    if own.status is Status.CONVERGED:
        below = own.objective - own.options.continuation.improvement * abs(own.objective)
    found = search_near(own.problem, giver.unknowns, below, own.options)
    if found is None:
        return dataclasses.replace(own, starts=own.starts + 1), False
    return better_of(own, found), True
