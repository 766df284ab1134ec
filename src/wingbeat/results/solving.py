"""Functions that find orbits: of one problem, of many problems, or of a series of problems."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from wingbeat.mechanics.flights import Steps
from wingbeat.orbits.flight.beat import flown_beat
from wingbeat.orbits.flight.certify import SAMPLES
from wingbeat.orbits.flight.floquet import floquet_multipliers
from wingbeat.orbits.many.batch import find_orbits
from wingbeat.orbits.many.series import find_series
from wingbeat.orbits.options.solver import DEFAULTS, SolverOptions
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.solve import Progress, check_search, find_orbit
from wingbeat.orbits.starts import start_count
from wingbeat.results.orbit import Orbit


def solve_orbit(
    problem: OrbitProblem,
    starts: int | None = None,
    seed: int = 0,
    progress: Progress | None = None,
    options: SolverOptions = DEFAULTS,
) -> Orbit:
    """Find and certify the periodic orbit that minimises an objective at a prescribed mean velocity.

    A failure raises no exception: `Orbit.status` says how the solver ended, and `Orbit.message` says what fails and
    what to do. The orbit then holds the closest wingbeat, and `Orbit.relaxations` lists single changes that lead to
    an orbit.

    Parameters
    ----------
    problem : the orbit problem.
    starts : number of starts; more may find better optima. The default is 24 if the wingbeat's bounds differ from
        the species', or if the largest value of a series is minimised. In other cases, the default is 12 if the
        objective or a limit is a quantity of the flown wingbeat. In all remaining cases it is 6.
    seed : of the random starts; the same seed gives the same orbit.
    progress : called with (starts done, starts in all).
    options : every tuning number of the solvers, with the measurement behind it.

    Raises
    ------
    InvalidInputError : starts or seed out of range.

    The condition is ``q(T) = q(0) + (U_x, U_z, 0, ...) T`` of Su et al. 2023
    (doi 10.48550/arXiv.2302.09602), certified by an independent adaptive flight at rtol 1e-10.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0), starts=1)
    >>> orbit.status.value, max(abs(miss) for miss in orbit.record()["closure"].values()) < 1e-6
    ('converged', True)
    """
    starts = start_count(problem, starts, options.search)
    check_search(starts, seed)
    with ThreadPoolExecutor(1) as pool:
        if not flown_beat.loaded:  # read or compiled while the search goes on
            pool.submit(_load_record_programs, problem)
        solution = find_orbit(problem, starts, seed, progress, options=options)
    return Orbit.of(solution, starts, seed)


def _load_record_programs(problem: OrbitProblem) -> None:
    model, wingbeat = problem.model, problem.species.wingbeat
    path = np.zeros((SAMPLES + 1, 4))
    flown_beat(model, wingbeat, np.zeros(SAMPLES + 1), path, (0.0, 0.0))
    floquet_multipliers(model, wingbeat, Steps(np.linspace(0.0, 1.0, 3), np.zeros((3, 6))))


def solve_orbits(
    problems: Sequence[OrbitProblem],
    starts: int | None = None,
    seed: int = 0,
    processes: int = 1,
    progress: Progress | None = None,
    most_starts: int | None = None,
    advise: bool = False,
    in_order: bool = False,
    options: SolverOptions = DEFAULTS,
) -> list[Orbit]:
    """Find and certify an orbit for each problem, in their order; results of similar problems serve as starts.

    Among problems that differ in numbers only, the first few are solved as by `solve_orbit`. For each later
    problem, the first start is predicted from the solutions of these first problems. This start counts only if it
    leads to a certified orbit. If a problem has several optima, this orbit may differ from the one that
    `solve_orbit` finds. The results do not depend on `processes`.

    Records and time series are computed on demand, so you can hold thousands of orbits and look at a few.

    Parameters
    ----------
    problems : any mixture of vehicles, air loads, speeds, free parameters and objectives.
    starts, seed : as in `solve_orbit`, for each problem.
    processes : how many Python processes share the work. A script whose own functions or classes are in the
        problems must then keep its calls under ``if __name__ == "__main__":``.
    progress : called with (problems done, problems in all).
    most_starts : number of starts without an orbit after which the solver gives up; default as in `SearchOptions`.
        Fewer save time.
    advise : for each problem without an orbit, find the single changes that lead to one, as `solve_orbit` does;
        this takes seconds for each.
    in_order : whether the problems are a series, such as speeds in order, with the same free parameters. Each
        problem then also starts from its neighbours' results, up and down the series, until nothing improves. The
        best family of orbits thus spreads over the series as far as it exists.
    options : of the solvers.

    Raises
    ------
    WorkerError : two processes die on the same problem, or processes cannot be started.
    InvalidInputError : something that is not a problem, starts, seed, most_starts or processes out of range, or
        problems in order with different free parameters.

    >>> import wingbeat as wb
    >>> pigeon = wb.load_species("pigeon")
    >>> orbits = wb.solve_orbits([wb.OrbitProblem(pigeon, speed=u) for u in (9.0, 10.0, 11.0)], starts=1)
    >>> [orbit.status.value for orbit in orbits]
    ['converged', 'converged', 'converged']
    """
    solve = find_series if in_order else find_orbits
    found = solve(problems, starts, seed, processes, progress, most_starts, advise, options)
    asked = (start_count(problem, starts, options.search) for problem in problems)
    return [Orbit.of(solution, count, seed) for solution, count in zip(found, asked, strict=True)]
