"""Many orbit problems, spread over processes; a later problem starts from the solutions of similar ones."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any, NamedTuple, TypeVar

import numpy as np

from wingbeat._base import FaultList
from wingbeat._workers.pool import process_map
from wingbeat.orbits.many.warm_start import Answers, Group, Known, group_similar, numbers_of
from wingbeat.orbits.nlp.newton_kkt import ReducedHessian
from wingbeat.orbits.options.solver import DEFAULTS, SolverOptions
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.solution import Solution
from wingbeat.orbits.solve import Progress, check_search, correct_guess, find_beside, find_orbit
from wingbeat.orbits.starts import start_count
from wingbeat.orbits.status import Status

T = TypeVar("T")
R = TypeVar("R")

_MOST_PROCESSES = 1024


class Part(NamedTuple):
    """Problems of one kind that are solved in sequence, and known solutions that predict the first of them."""

    problems: list[OrbitProblem]
    known: list[Known]


# A solution and, if it is certified, what it contributes to predictions.
Answer = tuple[Solution, Known | None]


def find_orbits(
    problems: Sequence[OrbitProblem],
    starts: int | None = None,
    seed: int = 0,
    processes: int = 1,
    progress: Progress | None = None,
    most_starts: int | None = None,
    advise: bool = False,
    options: SolverOptions = DEFAULTS,
) -> Iterator[Solution]:
    """Yield the solution of each problem, in the order of `problems`; a failure is a result, as in `find_orbit`.

    Problems that differ in numbers only form a group. The first few problems of a group are solved as in
    `find_orbit`. For each later problem, the solutions before it predict a first start, which counts only if it
    leads to a certified orbit. A large group is split: some of its problems are solved first, and the processes
    then share the others.

    Parameters
    ----------
    problems : any mixture of vehicles, air loads, speeds, free parameters and objectives.
    starts, seed, most_starts, advise, options : as in `find_orbit`, for each problem.
    processes : how many Python processes share the work; 1 means this process. The results do not depend on it.
    progress : called with (problems done, problems in all).

    Raises
    ------
    InvalidInputError : an item that is not an `OrbitProblem`; starts, seed, most_starts or processes out of range.
    """
    faults = FaultList()
    for i, problem in enumerate(problems):
        if not isinstance(problem, OrbitProblem):
            faults.add(f"problems[{i}]", problem, "is not an OrbitProblem")
    check_processes(faults, processes)
    faults.raise_if_any()
    check_search(1 if starts is None else starts, seed, 1 if most_starts is None else most_starts)
    asked = {"starts": starts, "seed": seed, "most_starts": most_starts, "advise": advise, "options": options}
    solve = functools.partial(_solve_part, **asked)
    groups = group_similar(problems, options.continuation)
    return _in_order(solve, problems, groups, processes, progress)


def check_processes(faults: FaultList, processes: Any) -> None:
    """Add a fault unless `processes` is a whole number in range."""
    faults.whole("processes", processes, 1, _MOST_PROCESSES)


def _in_order(
    solve: Callable[[Part], Iterator[Answer]],
    problems: Sequence[OrbitProblem],
    groups: Sequence[Group],
    processes: int,
    progress: Progress | None,
) -> Iterator[Solution]:
    """Solve group by group, and yield each solution when its turn comes."""
    work = solve if processes == 1 else functools.partial(_all_of, solve)
    waiting: dict[int, Solution] = {}
    due = 0
    with process_map(processes, max(len(groups), sum(len(group.parts) for group in groups))) as over:
        for index, solution in _by_groups(functools.partial(over, work), problems, groups):
            waiting[index] = solution
            if progress is not None:
                progress(due + len(waiting), len(problems))
            while due in waiting:
                yield waiting.pop(due)
                due += 1


def _by_groups(
    solve: Callable[[list[Part]], Iterator[Iterable[Answer]]],
    problems: Sequence[OrbitProblem],
    groups: Sequence[Group],
) -> Iterator[tuple[int, Solution]]:
    """Yield index and solution of each problem: first the problems that each group solves first, then the parts."""
    known: list[list[Known]] = [[] for _ in groups]
    first = [Part([problems[i] for i in group.first], []) for group in groups]
    for group, learned, answers in zip(groups, known, solve(first), strict=True):
        for index, (solution, answer) in zip(group.first, answers, strict=True):
            if answer is not None:
                learned.append(answer)
            yield index, solution
    rest = [(part, learned) for group, learned in zip(groups, known, strict=True) for part in group.parts]
    found = solve([Part([problems[i] for i in part], learned) for part, learned in rest])
    for (part, _), answers in zip(rest, found, strict=True):
        for index, (solution, _) in zip(part, answers, strict=True):
            yield index, solution


def _all_of(solve: Callable[[T], Iterator[R]], item: T) -> list[R]:
    return list(solve(item))


def _solve_part(
    part: Part, starts: int | None, seed: int, most_starts: int | None, advise: bool, options: SolverOptions
) -> Iterator[Answer]:
    """Solve the problems of a part in sequence; earlier solutions help to solve the later problems."""
    numbers = [numbers_of(problem) for problem in part.problems]
    answers = Answers(part.known, numbers, options.continuation)
    for i, problem in enumerate(part.problems):
        count = start_count(problem, starts, options.search)
        known = best_of_guesses(problem, answers.predict(i), options)
        best = find_with_known(problem, known, count, seed, most_starts, advise, options=options)
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


def find_with_known(
    problem: OrbitProblem,
    known: Solution | None,
    starts: int,
    seed: int = 0,
    most_starts: int | None = None,
    advise: bool = False,
    explain: bool = True,
    options: SolverOptions = DEFAULTS,
) -> Solution:
    """Return the known certified orbit, if there is one, or a better solution that the other starts find.

    Parameters
    ----------
    problem, starts, seed, most_starts, advise, explain, options : as in `find_orbit`.
    known : a certified orbit, which counts as one start. If it is given, `most_starts` and `advise` have no effect.
    """
    if known is None:
        return find_orbit(problem, starts, seed, None, 1, most_starts, advise, explain, options)
    return known if starts == 1 else find_beside(known, starts - 1, seed)
