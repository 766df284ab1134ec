"""Random animals within plausible ranges: does the shorter search find what the longer one finds, for what cost?

Run from the root of a clone; an animal takes some 40 s of the processor::

    uv run python benchmarks/plausible_search.py --count 50 --minutes 30

The longer search begins within the ranges at every start, and at every optimum that was found without them. Animals
are those of `random_animals.py` with another seed; those without an orbit within the ranges are left out.
"""

from __future__ import annotations

import argparse
import dataclasses
import math
import time

from random_animals import animals

import wingbeat as wb
from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.orbits.options import DEFAULTS
from wingbeat.orbits.solve import first_searches
from wingbeat.orbits.starts import start_count

SEED = 11
MISS = 0.005
LONGER = dataclasses.replace(DEFAULTS.search, starts_within_ranges=1000, same_value=1e-12)


def searched(problem: wb.OrbitProblem, options: wb.SolverOptions) -> tuple[float, float]:
    """Return the least objective that the searches find, infinite without an optimum, and their core-seconds."""
    begun = time.process_time()
    found = first_searches(Transcription(problem, options), start_count(problem, None, options.search), 0, 1)
    best = min((end.objective for end in found if end.is_optimum), default=math.inf)
    return best, time.process_time() - begun


def main() -> None:
    """Search for each animal both ways; print the ratios and the misses."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=50)
    parser.add_argument("--minutes", type=float, default=math.inf, help="draw no more animals after this time")
    asked = parser.parse_args()
    end = time.monotonic() + 60 * asked.minutes
    flying, misses, short, long = 0, 0, 0.0, 0.0
    for animal in animals(asked.count, SEED):
        if time.monotonic() > end:
            break
        problem = wb.models.animal(animal.species).problem(animal.species, animal.speed, bounds="plausible")
        best, taken = searched(problem, wb.SolverOptions(search=LONGER))
        if math.isinf(best):
            continue
        found, seconds = searched(problem, DEFAULTS)
        flying, misses = flying + 1, misses + (found > (1 + MISS) * best)
        short, long = short + seconds, long + taken
        name = f"{animal.species.name}, {animal.speed:.1f} m/s"
        print(f"{name}: {found / best:.5f} of the objective, {seconds:.1f} for {taken:.1f} s", flush=True)
    print(f"{misses} of {flying} miss by more than {MISS:.1%}; {short / max(long, 1e-9):.2f} of the time")


if __name__ == "__main__":
    main()
