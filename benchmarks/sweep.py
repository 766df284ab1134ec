"""Is the fine sweep of speeds continuous, and do series, batches and studies miss the best optimum?

Run from the root of a clone, after `misses.py --group animals`, whose references the second part reads::

    python benchmarks/sweep.py sweep
    python benchmarks/sweep.py many --reference reference.json

The first part solves both animals by both coefficient models at 57 speeds, each by itself. Then it hands each
answer to the neighbouring speeds, first up, then down. An answer that becomes better by more than 0.5 % is a miss:
the sweep jumps there although an optimum goes on. The second part solves the 48 cases of the animals together, by a
series, a batch and a study, each at its default settings.
"""

from __future__ import annotations

import argparse
import csv
import json
import os
import tempfile
from pathlib import Path

import numpy as np
from misses import MISS, MODELS, SPEEDS, animals

import wingbeat as wb
from wingbeat.orbits.solution import Solution, search_near
from wingbeat.orbits.solve import Settings, find_orbit

FINE = np.arange(3.0, 17.01, 0.25)
STUDY = """species = ["bat", "pigeon"]
aero = ["su-fan", "dickinson"]
minimise = "{objective}"
vary.speed = {{ grid = {speeds} }}
"""


def sweep() -> None:
    """Print every answer that a neighbour's optimum betters."""
    for animal in ("bat", "pigeon"):
        for name, model in MODELS.items():
            problems = [wb.OrbitProblem(wb.load_species(animal), float(speed), aero=model()) for speed in FINE]
            answers = [find_orbit(problem, Settings(advise=False), threads=1) for problem in problems]
            best = [answer if answer.status is wb.Status.CONVERGED else None for answer in answers]
            handed_on(problems, best, range(1, len(FINE)), -1)
            handed_on(problems, best, range(len(FINE) - 2, -1, -1), 1)
            misses = 0
            for speed, answer, better in zip(FINE, answers, best, strict=True):
                flies = answer.status is wb.Status.CONVERGED
                if better is not None and (not flies or answer.objective > (1 + MISS) * better.objective):
                    misses += 1
                    told = f"{answer.objective:.3f}" if flies else str(answer.status)
                    print(
                        f"{animal} {name} {speed:g} m/s: {told}, but {better.objective:.3f} next to it", flush=True
                    )
            flown = sum(b is not None for b in best)
            print(f"{animal} {name}: {misses} of {len(FINE)} answers miss; {flown} fly", flush=True)


def handed_on(problems: list[wb.OrbitProblem], best: list[Solution | None], order: range, giver: int) -> None:
    """Start a search at each speed from the best of its neighbour, and keep what is better."""
    for i in order:
        given, own = best[i + giver], best[i]
        if given is None:
            continue
        found = search_near(problems[i], given.unknowns, np.inf if own is None else own.objective)
        best[i] = own if found is None else found


def many(reference: Path) -> None:
    """Print the misses of series, batches and studies at the 48 cases."""
    known = json.loads(reference.read_text())
    names, problems = zip(*((name, made()) for name, made in animals()), strict=True)
    begun = spent()
    series = [
        orbit
        for first in range(0, len(problems), len(SPEEDS))
        for orbit in wb.solve_orbits(problems[first : first + len(SPEEDS)], in_order=True)
    ]
    report("series", known, dict(zip(names, map(value_of, series), strict=True)), begun)
    begun = spent()
    batch = wb.solve_orbits(problems)
    report("batch", known, dict(zip(names, map(value_of, batch), strict=True)), begun)
    begun = spent()
    report("studies", known, studied(), begun)


def value_of(orbit: wb.Orbit) -> float | None:
    """Return the objective of a certified orbit."""
    return orbit.record()["objective_value"] if orbit.status is wb.Status.CONVERGED else None


def studied() -> dict[str, float | None]:
    """Return the objective of each case by a study for each of the two objectives, with one process."""
    found: dict[str, float | None] = {}
    for objective in ("frequency", "mean_positive_power"):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "cases.toml"
            file.write_text(STUDY.format(objective=objective, speeds=list(SPEEDS)))
            study = wb.plan_study(file)
            study.run(processes=1)
            table = Path(folder) / "cases.csv"
            study.export(table)
            for row in csv.DictReader(table.open()):
                name = f"{row['species']} {row['aero.coefficients']} {float(row['speed']):g} {objective}"
                found[name] = float(row["objective_value"]) if row["status"] == "converged" else None
    return found


def spent() -> float:
    """Return the core-seconds so far, of this process and of those that have ended."""
    return sum(os.times()[:4])


def report(way: str, known: dict[str, float], found: dict[str, float | None], begun: float) -> None:
    """Print which cases a way of solving misses, and what it cost."""
    misses = 0
    for name, value in found.items():
        best = known[name]
        if best is not None and (value is None or value > (1 + MISS) * best):
            misses += 1
            print(f"{way}, {name}: {value}, best {best:.4f}", flush=True)
    seconds = spent() - begun
    print(f"{way}: {misses} of {len(found)} answers miss; {seconds / len(found):.3f} core-seconds each", flush=True)


def main() -> None:
    """Run one part."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("part", choices=("sweep", "many"))
    parser.add_argument("--reference", type=Path, default=Path("reference.json"))
    asked = parser.parse_args()
    if asked.part == "sweep":
        sweep()
    else:
        many(asked.reference)


if __name__ == "__main__":
    main()
