"""Can random restarts better the optima of each objective? Prints a table in Markdown.

Run from the root of a clone::

    uv run python benchmarks/objectives.py [--speeds 10] [--objectives peak_power] [--starts 12] [--restarts 30]
"""

from __future__ import annotations

import argparse
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np

import wingbeat as wb
from wingbeat.orbits.quantities import QUANTITIES
from wingbeat.orbits.search import search
from wingbeat.orbits.solve import find_orbit, follow
from wingbeat.orbits.starts import start_point
from wingbeat.orbits.transcription import Transcription

# The searches' own seed is 0.
SEED = 1


def least_of_restarts(problem: wb.OrbitProblem, restarts: int) -> tuple[float, int]:
    """Return the least certified objective of random restarts, and how many ended in an optimum."""
    programme = Transcription(problem)
    with ThreadPoolExecutor(2) as pool:
        starts = [start_point(problem, 1 + i, SEED) for i in range(restarts)]
        found = list(pool.map(lambda start: search(programme.anew(), start), starts))
    good = sorted((c for c in found if c.closed and c.optimal), key=lambda c: c.objective)
    for candidate in good:
        certified = follow(problem, programme.physical(candidate.scaled))
        if certified is not None:
            return certified.objective, len(good)
    return np.nan, len(good)


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__)
    arguments.add_argument("--speeds", type=float, nargs="+", default=[6.0, 10.0, 14.0])
    arguments.add_argument("--objectives", nargs="+", default=list(QUANTITIES))
    arguments.add_argument("--starts", type=int, default=12)
    arguments.add_argument("--restarts", type=int, default=30)
    given = arguments.parse_args()
    print("| animal | m/s | objective | least | of restarts | lower by, % | restarts ending in an optimum | s |")
    print("| --- " * 8 + "|")
    for animal in ("pigeon", "bat"):
        for speed in given.speeds:
            for name in given.objectives:
                begun = time.perf_counter()
                problem = wb.OrbitProblem(wb.load_species(animal), speed=speed, minimise=name)
                best = find_orbit(problem, given.starts)
                other, ended = least_of_restarts(problem, given.restarts)
                lower = 100 * (1 - other / best.objective)
                shown = (
                    f"{best.objective:.4g} {QUANTITIES[name].unit}"
                    if best.status is wb.Status.CONVERGED
                    else best.status.value
                )
                cells = (animal, f"{speed:g}", name, shown, f"{other:.4g}", f"{lower:.2f}", ended)
                spent = time.perf_counter() - begun
                print("|", " | ".join(str(cell) for cell in (*cells, f"{spent:.0f}")), "|", flush=True)


if __name__ == "__main__":
    main()
