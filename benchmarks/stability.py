"""Orbits on which disturbances decay: how many searches find one, what stability costs, and the time of a search.

Run from the root of a clone; it prints the numbers of docs/guide/stability.md::

    uv run python benchmarks/stability.py along pigeon --speeds 4:20
    uv run python benchmarks/stability.py along pigeon --speeds 6:18 --tail
    uv run python benchmarks/stability.py along pigeon --speeds 6:18 --model animal
    uv run python benchmarks/stability.py random

`along` flies an animal at each whole speed, without and with the limit ``spectral_radius<=0.995``. `random` does so
for the random vehicles of `certify_grid`. Times are those of the processor, of one thread. Both searches have their
default number of starts. A first problem is solved twice before, untimed: that compiles the programs.
"""

from __future__ import annotations

import argparse
import dataclasses
import time
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np
from certify_grid import vehicles

import wingbeat as wb
from wingbeat.orbits.solution import Solution
from wingbeat.orbits.solve import Settings, find_orbit

LIMIT, COUNT = "spectral_radius<=0.995", 200


class Pair(NamedTuple):
    """The free orbit and the stable one, each with the seconds of its search."""

    free: Solution
    stable: Solution
    free_seconds: float
    stable_seconds: float

    @property
    def price(self) -> float:
        """How much more the stable orbit costs, in percent."""
        return 100.0 * (self.stable.objective / self.free.objective - 1.0)

    @property
    def is_stable(self) -> bool:
        """Whether the stable orbit is certified and keeps to the limit on the certified path."""
        certified = self.stable.status is wb.Status.CONVERGED
        return certified and bool(np.abs(self.stable.multipliers).max() <= 0.995)


def solved(problem: wb.OrbitProblem) -> tuple[Solution, float]:
    """Return the orbit of a problem and the processor's seconds of its search."""
    begun = time.process_time()
    found = find_orbit(problem, Settings(explain=False), threads=1)
    return found, time.process_time() - begun


def pair(problem: wb.OrbitProblem) -> Pair:
    """Solve a problem without and with the limit."""
    free, free_seconds = solved(problem)
    limited = dataclasses.replace(problem, subject_to=(*problem.subject_to, LIMIT))
    stable, stable_seconds = solved(limited)
    return Pair(free, stable, free_seconds, stable_seconds)


def pairs(problems: Iterable[wb.OrbitProblem]) -> Iterator[Pair]:
    """Yield the orbits of those problems that have a free orbit, each printed as a line."""
    for i, problem in enumerate(problems):
        if i == 0:
            pair(problem)
        both = pair(problem)
        if both.free.status is not wb.Status.CONVERGED:
            print(f"{problem.species.name}, {problem.speed:.1f} m/s: no free orbit", flush=True)
            continue
        ends = (
            f"{both.free.objective:.3f} with {np.abs(both.free.multipliers).max():.3f}, "
            f"{both.stable.objective:.3f} with {np.abs(both.stable.multipliers).max():.4f}, {both.price:+.2f} %"
        )
        seconds = f"{both.free_seconds:.2f} s and {both.stable_seconds:.2f} s"
        print(
            f"{problem.species.name}, {problem.speed:.1f} m/s: {ends}, stable {both.is_stable}, {seconds}",
            flush=True,
        )
        yield both


def summary(found: list[Pair]) -> str:
    """Return shares, prices and ratios of time in words."""
    stable = [both for both in found if both.is_stable]
    prices = np.array([both.price for both in stable])
    ratios = np.array([both.stable_seconds / both.free_seconds for both in found])
    whole = sum(both.stable_seconds for both in found) / sum(both.free_seconds for both in found)
    return (
        f"{len(stable)} of {len(found)} stable; price: median {np.median(prices):.2f} %, nine in ten within "
        f"{np.quantile(prices, 0.9):.2f} %, most {prices.max():.2f} %; time over that of the free search: median "
        f"{np.median(ratios):.1f}, of all together {whole:.1f}"
    )


def main() -> None:
    """Read the arguments, solve, and print."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kind", choices=("along", "random"))
    parser.add_argument("species", nargs="?", default="pigeon")
    parser.add_argument("--speeds", default="4:20", help="first and last speed, and perhaps a step [m/s]")
    parser.add_argument("--tail", action="store_true", help="add a tail by the laws of birds")
    parser.add_argument("--minimise", help="quantity to minimise; default that of the model")
    parser.add_argument("--model", default="paper", choices=("paper", "animal"))
    parser.add_argument("--count", type=int, default=COUNT, help="number of random vehicles")
    asked = parser.parse_args()
    if asked.kind == "random":
        problems: Iterable[wb.OrbitProblem] = vehicles(asked.count)
    else:
        species = wb.load_species(asked.species)
        if asked.tail:
            species = species.with_tail()
        low, high, *step = (int(part) for part in asked.speeds.split(":"))
        model = wb.models.model_of(asked.model, species)
        changes = {} if asked.minimise is None else {"minimise": asked.minimise}
        problems = (model.problem(species, float(u), **changes) for u in range(low, high + 1, *step))
    print(summary(list(pairs(problems))))


if __name__ == "__main__":
    main()
