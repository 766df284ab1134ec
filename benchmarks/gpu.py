"""Flights and orbits a second on this machine's accelerator, beside its CPU, within six minutes.

Run from the root of a clone; without an accelerator it measures the CPU alone::

    uv run python benchmarks/gpu.py

Each platform has a process of its own. Flights are those of `wb.survey_gusts`, one compiled program for all, with
feedback; orbits are those of `wb.solve_orbits`, mixed problems with one start. The time includes neither compiling
nor loading. A part that would go on beyond `--seconds` is left out, and the output says so.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterator

import jax

import wingbeat as wb
from wingbeat.bench import mixed_problems, right_hand_side

FLIGHTS = (256, 2048, 16_384, 65_536)
BEATS = 10
ORBITS = (8, 64, 512)


def growing(counts: tuple[int, ...], run: Callable[[int], object], until: float) -> Iterator[dict[str, float]]:
    """Yield how many a second, for growing numbers, while the next is expected to end in time."""
    for count in counts:
        run(count)  # compiles for this number
        begun = time.perf_counter()
        run(count)
        taken = time.perf_counter() - begun
        yield {"count": count, "seconds": taken, "a_second": count / taken}
        if time.perf_counter() + 10 * taken > until:
            return


def measure(seconds: float) -> None:
    """Print what this process's platform does, one JSON line for each measurement."""
    device = jax.devices()[0].device_kind
    pigeon = wb.load_species("pigeon")
    orbit = wb.solve_orbit(wb.OrbitProblem(pigeon, speed=12.0), starts=1)
    held = {"held": wb.feedback(orbit)}

    half = time.perf_counter() + 0.5 * seconds

    def fly(count: int) -> None:
        wb.survey_gusts(orbit, held, flights=count, beats=BEATS)

    told = {"platform": jax.default_backend(), "device": device}
    print(json.dumps(told | {"what": "right-hand side, 16384 lanes", "nanoseconds": 1e9 * right_hand_side(16_384)}))
    for one in growing(FLIGHTS, fly, half):
        print(json.dumps(told | {"what": f"flights of {BEATS} beats"} | one), flush=True)
    problems = list(mixed_problems(ORBITS[-1]))
    for one in growing(ORBITS, lambda count: wb.solve_orbits(problems[:count], starts=1), half + 0.5 * seconds):
        print(json.dumps(told | {"what": "orbits of a batch"} | one), flush=True)


def main() -> None:
    """Measure each platform in a process of its own."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=150.0, help="for each platform")
    parser.add_argument("--here", action="store_true", help="measure the platform of this process alone")
    given = parser.parse_args()
    if given.here:
        measure(given.seconds)
        return
    words = [sys.executable, __file__, "--here", "--seconds", str(given.seconds)]
    first = subprocess.run(words, check=True, stdout=subprocess.PIPE, text=True).stdout
    print(first, end="", flush=True)
    if json.loads(first.splitlines()[0])["platform"] == "cpu":
        print("JAX has no accelerator here: these are the numbers of the CPU alone")
    else:
        subprocess.run(words, env={**os.environ, "JAX_PLATFORMS": "cpu"}, check=True)


if __name__ == "__main__":
    main()
