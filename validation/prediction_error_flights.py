"""The flights of `prediction_error.py`: sets of an animal's numbers, each flown from two starts."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

import wingbeat as wb
from wingbeat._base import write_atomically
from wingbeat._workers.pool import in_processes
from wingbeat.cli.terminal import progress_bar
from wingbeat.orbits.problem.parameters import parameters_of
from wingbeat.orbits.solution import search_near
from wingbeat_evidence.whole_flights import read_measured_flights

ANIMALS = ("pigeon", "cockatiel")
# Columns of the table: those of the nomenclature that are measured.
QUANTITIES = (
    "frequency",
    "flap_amplitude_deg",
    "positive_power_per_mass",
    "muscle_power_per_mass",
    "muscle_efficiency",
)
# Numbers of metabolism that change neither the flight nor a compared quantity.
_WITHOUT_EFFECT = {
    f"muscle.{name}" for name in ("activation_energy", "recovery_factor", "resting_rate", "support_factor")
}


def ranges(animal: str) -> dict[str, tuple[float, float]]:
    """Return the range of the speed and of every number that an animal's flight depends on, by its path."""
    problem = problem_at(animal, 10.0)
    terms = wb.aero.WING_ESTIMATES[problem.aero.coefficients.name]
    speeds = read_measured_flights(animal).speeds
    found = {"speed": (speeds[0], speeds[-1])}
    for one in parameters_of(problem):
        if one.path.startswith("air.") or one.path in _WITHOUT_EFFECT:  # air is known where a flight is measured
            continue
        estimate = terms.get(one.path.removeprefix("aero.wing."))
        limits = (estimate.low, estimate.high) if estimate is not None else one.plausible
        if limits is not None and limits[0] < limits[1]:
            found[one.path] = limits
    return found


def problem_at(animal: str, speed: float) -> wb.OrbitProblem:
    """Return the problem of an animal's flight by the model `animal`."""
    species = wb.load_species(animal)
    return wb.models.animal(species).problem(species, speed=speed)


def study(animal: str, sets: int, store: Path) -> wb.Study:
    """Return the study that flies each set from the stock wingbeat."""
    return wb.plan_study(
        species=animal,
        model="animal",
        starts=1,
        most_starts=1,
        explain=False,
        vary={path: {"range": list(limits)} for path, limits in ranges(animal).items()},
        sample={"method": "sobol", "n": sets, "seed": 0},
        store=store,
    )


def flown_sets(animal: str, sets: int, processes: int, folder: Path) -> pd.DataFrame:
    """Return the sets of an animal, with what the better of both flights predicts.

    Parameters
    ----------
    animal : name of a built-in species.
    sets : number of sets.
    processes : Python processes that share them.
    folder : keeps what was flown.
    """
    plan = study(animal, sets, folder / f"{animal}_error.study.sqlite")
    plan.run(processes=processes)
    flown = plan.to_dataframe()
    drawn = flown[list(ranges(animal))]
    mass = flown["vehicle.body.mass"] + 2.0 * flown["vehicle.wing.mass"]
    first = pd.DataFrame(
        {
            "frequency": flown["wingbeat.frequency"],
            "flap_amplitude_deg": np.degrees(flown["wingbeat.flap_amplitude"]),
            "positive_power_per_mass": flown["mean_positive_power"] / mass,
            "muscle_power_per_mass": flown["muscle_power_per_mass"],
            "muscle_efficiency": flown["muscle_efficiency"],
        }
    )
    table = pd.DataFrame({"animal": animal, "status": flown["status"], "start": "stock", **drawn, **first})
    below = flown["objective_value"].where(flown["status"] == "converged", math.inf).fillna(math.inf)
    for i, found in enumerate(flown_near(animal, drawn, below.tolist(), processes, folder)):
        if found is not None:
            table.loc[i, ["status", "start"]] = "converged", "own"
            table.loc[i, list(QUANTITIES)] = [found[name] for name in QUANTITIES]
    return table


class Near(NamedTuple):
    """A set to fly from the animal's own best flight: its numbers, the start, and the least objective so far."""

    animal: str
    numbers: dict[str, float]
    start: list[float]
    below: float


def flown_near(
    animal: str, drawn: pd.DataFrame, below: list[float], processes: int, folder: Path
) -> list[dict[str, Any] | None]:
    """Return for each set the flight that starts from the animal's own best flight, None where it is no better."""
    file = folder / f"{animal}_near.jsonl"
    done = file.read_text().splitlines() if file.exists() else []
    best = own_flights(animal, folder)
    items = [
        Near(animal, row, _start(best, row["speed"]), least)
        for row, least in zip(drawn.to_dict("records"), below, strict=True)
    ]
    with progress_bar(f"{animal}: sets from its own flight") as progress, file.open("a") as kept:
        for found in in_processes(fly_near, items[len(done) :], processes, progress):
            done.append(json.dumps(found))
            kept.write(done[-1] + "\n")
            kept.flush()
    return [json.loads(line) for line in done]


def own_flights(animal: str, folder: Path) -> dict[float, list[float]]:
    """Return the unknowns of the animal's own best flights, with no number changed, by their speeds."""
    file = folder / f"{animal}_own.json"
    if not file.exists():
        speeds = read_measured_flights(animal).speeds
        orbits = wb.solve_orbits([problem_at(animal, speed) for speed in speeds], in_order=True)
        found = {
            speed: orbit.unknowns.tolist()
            for speed, orbit in zip(speeds, orbits, strict=True)
            if orbit.status is wb.Status.CONVERGED
        }
        write_atomically(file, json.dumps(found))
    return {float(speed): unknowns for speed, unknowns in json.loads(file.read_text()).items()}


def _start(best: dict[float, list[float]], speed: float) -> list[float]:
    """Return the unknowns of the flight at the nearest speed, moved to this speed."""
    nearest = min(best, key=lambda at: abs(at - speed))
    start = list(best[nearest])
    start[1] += speed - nearest  # u, after body pitch
    return start


def fly_near(item: Near) -> dict[str, Any] | None:
    """Fly a set from the animal's own flight; return what is compared, None if that is no better."""
    problem = problem_at(item.animal, item.numbers["speed"])
    parameters = {one.path: one for one in parameters_of(problem)}
    for path, value in item.numbers.items():
        problem = parameters[path].changed(problem, value)
    found = search_near(problem, np.array(item.start), item.below)
    if found is None:
        return None
    record = wb.Orbit.of(found, 1).record()
    return {
        "frequency": record["wingbeat"]["frequency"],
        "flap_amplitude_deg": math.degrees(record["wingbeat"]["flap_amplitude"]),
        "positive_power_per_mass": record["mean_positive_power"] / problem.vehicle.mass,
        "muscle_power_per_mass": record["muscle_power_per_mass"],
        "muscle_efficiency": record["muscle_efficiency"],
    }
