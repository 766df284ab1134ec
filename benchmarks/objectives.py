"""Can 30 random restarts, or CasADi and IPOPT, better the optima of each objective and within each limit?

Run from the root of a clone. Each problem is a line of JSON as it is done, of which the other makes tables;
those that the file has already are not done again::

    uv run --group bench python benchmarks/objectives.py [--animals bat] [--only peak_power] -o found.jsonl
    uv run --group bench python benchmarks/objectives_table.py found.jsonl
"""

from __future__ import annotations

import argparse
import json
import math
import time
from collections.abc import Iterator
from pathlib import Path

from bettering import Ipopt, by_restarts

import wingbeat as wb
from wingbeat.orbits.problem.quantities import QUANTITIES, named_quantity
from wingbeat.orbits.solution import Solution
from wingbeat.orbits.solve import Settings, find_orbit

# More starts, tried where something else found less.
MORE_STARTS = (12, 24, 48)
BETTER = 1e-3
# A limit costs nothing where the quantity is this near its least anyway.
COSTS = 0.02


class Solver:
    """Solves a problem once with so many starts."""

    def __init__(self, starts: int | None) -> None:
        self.starts = starts
        self._known: dict[tuple, Solution] = {}

    def __call__(self, animal: str, speed: float, minimise: str, limit: str = "") -> Solution:
        asked = animal, speed, minimise, limit
        if asked not in self._known:
            limits = [limit] if limit else []
            problem = wb.OrbitProblem(wb.load_species(animal), speed=speed, minimise=minimise, subject_to=limits)
            self._known[asked] = find_orbit(problem, Settings(self.starts, advise=False), threads=1)
        return self._known[asked]


def limits_of(solver: Solver, animal: str, speed: float, only: list[str]) -> Iterator[tuple[str, str]]:
    """Yield pairs of an objective and a limit that costs it something.

    Each quantity may be half way at most from its least value to what it is where the frequency is least, or the
    positive power where the least frequency all but makes it least.
    """
    for name in (name for name in QUANTITIES if name in only):
        least = solver(animal, speed, name)
        for minimise in ("frequency", "mean_positive_power"):
            free = solver(animal, speed, minimise)
            if not wb.Status.CONVERGED is least.status is free.status:
                continue
            there = free.value_of(named_quantity(name))
            if there > least.objective + COSTS * abs(least.objective):
                half = 0.5 * (least.objective + there)
                yield minimise, f"{name}<={half:.6g}"
                if name == "frequency":
                    yield minimise, f"{name}={half:.6g}"
                break
    if "flap_amplitude" in only:
        yield "frequency", "flap_amplitude<=50 deg"
        yield "mean_positive_power", "flap_amplitude=45 deg"


def attempt(solver: Solver, asked: tuple[str, float, str, str], restarts: tuple[int, int], ipopt: Ipopt) -> dict:
    """Solve a problem, try to better it, by so many restarts of a seed too, and return what came of it."""
    begun = time.perf_counter()
    best = solver(*asked)
    spent = {"solved": best.seconds}
    row = dict(zip(("animal", "speed", "minimise", "limit"), asked, strict=True)) | {
        "unit": best.problem.minimise.unit,
        "starts": best.starts,
        "status": best.status.value,
        "objective": best.objective,
        "closure": max(map(abs, best.closure.values())),
        "optimality": best.optimality,
        "active": list(best.active_bounds),
    }
    if best.status is wb.Status.CONVERGED:
        row["by_restarts"], spent["restarts"] = _timed(by_restarts, best, *restarts)
        row["by_ipopt"], spent["ipopt"] = _timed(ipopt, best)
        others = [row["by_restarts"]["least"], *(found["certified"] for found in row["by_ipopt"])]
        least = min((value for value in others if value is not None), default=best.objective)
        row["lower_by"] = (best.objective - least) / abs(best.objective)
        if row["lower_by"] > BETTER:
            row["more_starts"] = _with_more_starts(asked, best.starts, least + BETTER * abs(least))
    return row | {"seconds": spent | {"all": time.perf_counter() - begun}}


def _with_more_starts(asked: tuple[str, float, str, str], starts: int, enough: float) -> dict[int, float]:
    """Return what more starts lead to, up to as many as are enough."""
    found: dict[int, float] = {}
    for more in MORE_STARTS:
        if more > starts and min(found.values(), default=math.inf) > enough:
            found[more] = Solver(more)(*asked).objective
    return found


def done(output: Path) -> set[tuple[str, float, str, str]]:
    """Return which problems a file has already."""
    rows = [json.loads(text) for text in output.read_text().splitlines()] if output.exists() else []
    return {(row["animal"], row["speed"], row["minimise"], row["limit"]) for row in rows}


def _timed(function, *given) -> tuple:
    begun = time.perf_counter()
    return function(*given), time.perf_counter() - begun


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--animals", nargs="+", default=["pigeon", "bat"])
    arguments.add_argument("--speeds", type=float, nargs="+", default=[6.0, 10.0, 14.0])
    arguments.add_argument("--only", nargs="+", default=[*QUANTITIES, "flap_amplitude"], help="quantities")
    arguments.add_argument("--of", nargs="+", default=["objectives", "limits"])
    arguments.add_argument("--starts", type=int, help="of wingbeat's own search; if not given, as many as it makes")
    arguments.add_argument("--restarts", type=int, default=30)
    arguments.add_argument(
        "--seed", type=int, default=1, help="of the restarts; that of wingbeat's own starts is 0"
    )
    arguments.add_argument(
        "--guesses", type=int, default=1, help="random ones of IPOPT, besides wingbeat's optimum"
    )
    arguments.add_argument("-o", "--output", type=Path, required=True)
    given = arguments.parse_args()
    solver, ipopt = Solver(given.starts), Ipopt(given.guesses)
    for animal in given.animals:
        asked = []
        if "objectives" in given.of:
            asked += [(animal, v, name, "") for name in QUANTITIES if name in given.only for v in given.speeds]
        if "limits" in given.of:
            limited = [
                (animal, v, *pair) for v in given.speeds for pair in limits_of(solver, animal, v, given.only)
            ]
            # Problems that differ in numbers only follow one another: IPOPT's statement of them is built once.
            asked += sorted(limited, key=lambda each: each[3].rstrip("0123456789.e-"))
        for each in (each for each in asked if each not in done(given.output)):
            row = attempt(solver, each, (given.restarts, given.seed), ipopt)
            with given.output.open("a") as file:
                print(json.dumps(row), file=file)


if __name__ == "__main__":
    main()
