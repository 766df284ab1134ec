"""How often the default search misses the best optimum, against the best of 80 random starts.

Cases: the two animals by two coefficient models at six speeds for two objectives; 30 vehicles drawn at random
around them; 20 odd ones. The structured starts were chosen on none but the animals.

    python benchmarks/misses.py --group animals --seeds 10 --reference reference.json

keeps the best of the random starts in a file, so that a second run only solves anew. It prints the worst answer to
each case, and at the end the misses of each group and the core-seconds of a default answer.
"""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np

import wingbeat as wb
from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.orbits.options import Status
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.solution import certified_optimum
from wingbeat.orbits.solve import Settings, find_orbit, search_from_starts
from wingbeat.orbits.starts import structured_starts

RANDOM_STARTS, REFERENCE_SEED = 80, 12345
# An answer this share above the best is a miss.
MISS = 0.005
SPEEDS = (4.0, 6.0, 8.0, 10.0, 12.0, 16.0)
MODELS: dict[str, Callable] = {"su-fan": wb.aero.SuFan, "dickinson": wb.aero.Dickinson}

Cases = Iterator[tuple[str, Callable[[], OrbitProblem]]]


def animals() -> Cases:
    """Yield the 48 cases of the two animals."""
    for objective in ("frequency", "mean_positive_power"):
        for animal in ("bat", "pigeon"):
            for model in MODELS:
                for speed in SPEEDS:
                    yield f"{animal} {model} {speed:g} {objective}", _problem(animal, model, speed, objective)


def _problem(animal: str, model: str, speed: float, objective: str) -> Callable[[], OrbitProblem]:
    asked = {} if objective == "frequency" else {"minimise": objective}
    return lambda: OrbitProblem(wb.load_species(animal), speed, aero=MODELS[model](), **asked)


def drawn() -> Cases:
    """Yield 30 vehicles with numbers up to 30 % off those of an animal, at a speed of their own."""
    random = np.random.default_rng(2026)
    paths = ("body.mass", "body.pitch_inertia", "wing.semi_span", "wing.chord", "wing.mass", "wing.mass_exponent")
    for i in range(30):
        animal, model = ("pigeon", "bat")[i % 2], list(MODELS)[i // 2 % 2]
        factors, speed = random.uniform(0.7, 1.3, len(paths)), random.uniform(4.0, 16.0)
        name = f"vehicle {i}, {animal} {model} {speed:.1f}"
        yield name, _drawn(animal, model, speed, dict(zip(paths, factors, strict=True)))


def _drawn(animal: str, model: str, speed: float, factors: dict[str, float]) -> Callable[[], OrbitProblem]:
    def made() -> OrbitProblem:
        species = wb.load_species(animal)
        values = {}
        for path, factor in factors.items():
            part, name = path.split(".")
            values[path] = factor * getattr(getattr(species.vehicle, part), name)
        return OrbitProblem(species.with_values(values), speed, aero=MODELS[model]())

    return made


def odd() -> Cases:
    """Yield 20 vehicles that look like neither animal."""
    pigeon, bat = wb.load_species("pigeon"), wb.load_species("bat")
    rigid = {"wingbeat.fold_amplitude": 0.0, "wingbeat.twist_ratio": 1.0}
    vehicles = {
        "thin long wings": pigeon.with_values({"wing.semi_span": 0.45, "wing.chord": 0.06}),
        "short broad wings": pigeon.with_values({"wing.semi_span": 0.22, "wing.chord": 0.16}),
        "5 g bat": wb.bat(mass=0.005, wing_span=0.2, wing_area=0.008),
        "5 kg bird": wb.bird(mass=5.0, wing_span=2.1, wing_area=0.55),
        "10 g bird": wb.bird(mass=0.01, wing_span=0.2, wing_area=0.009),
        "1 kg bat": wb.bat(mass=1.0, wing_span=1.3, wing_area=0.2),
        "bat without fold and twist": bat.with_values(rigid),
        "shoulder ahead": pigeon.with_values({"wing.shoulder": [0.036, 0.018, 0.0096]}),
        "tilted stroke plane": pigeon.with_values(
            {"wing.shoulder": [0.02, 0.035, 0.01], "wing.stroke_plane_angle_deg": 60.0}
        ),
        "swift": wb.load_species("common-swift"),
    }
    speeds = {"5 g bat": (4.0, 6.0), "5 kg bird": (14.0, 18.0), "10 g bird": (5.0, 9.0)}
    for name, species in vehicles.items():
        for i, speed in enumerate(speeds.get(name, (7.0, 12.0))):
            problem = OrbitProblem(species, speed, aero=list(MODELS.values())[i]())
            yield f"{name} {problem.aero.coefficients.name} {speed:g}", lambda problem=problem: problem


def reference(problem: OrbitProblem) -> float | None:
    """Return the least certified objective of so many random starts, none of them structured."""
    given = len(structured_starts(problem))
    transcription, best = Transcription(problem), None
    places = range(given, given + RANDOM_STARTS)
    ended = search_from_starts(transcription, places, REFERENCE_SEED, 1)
    found = [c for c in ended if c.closed and c.optimal]
    for candidate in sorted(found, key=lambda c: c.objective)[:4]:
        certain = certified_optimum(candidate, 0.0)
        if certain is not None and (best is None or certain.objective < best):
            best = certain.objective
    return best


def main() -> None:
    """Compare the default answers with the references."""
    parser = argparse.ArgumentParser(description=__doc__)
    groups = {"animals": animals, "drawn": drawn, "odd": odd}
    parser.add_argument("--group", choices=groups, action="append")
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--reference", type=Path, default=Path("reference.json"))
    asked = parser.parse_args()
    known = json.loads(asked.reference.read_text()) if asked.reference.exists() else {}
    for group in asked.group or groups:
        misses = answers = 0
        seconds = 0.0
        for name, made in groups[group]():
            problem = made()
            if name not in known:
                known[name] = reference(problem)
                asked.reference.write_text(json.dumps(known, indent=1))
            best, ratios = known[name], []
            for seed in range(asked.seeds):
                begun = time.process_time()
                found = find_orbit(problem, Settings(seed=seed, advise=False), threads=1)
                seconds += time.process_time() - begun
                answers += 1
                flies = found.status is Status.CONVERGED
                if best is None or not flies:
                    misses += not flies and best is not None
                    ratios.append(np.nan)
                    continue
                ratios.append(found.objective / best)
                misses += ratios[-1] > 1 + MISS
            worst = np.nanmax(ratios) if not np.isnan(ratios).all() else np.nan
            told = "nothing flies" if best is None else f"best {best:.4f}, worst answer {worst:.4f} of it"
            print(f"{name}: {told}", flush=True)
        each = seconds / max(answers, 1)
        print(f"{group}: {misses} of {answers} answers miss; {each:.3f} core-seconds each", flush=True)


if __name__ == "__main__":
    main()
