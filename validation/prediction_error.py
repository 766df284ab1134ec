"""Ask which numbers of an animal the error of its predicted flight depends on: fly many sets of its numbers.

    python validation/prediction_error.py [--sets 1000] [--processes 2] [--folder FOLDER]

Every set draws all numbers of a pigeon or a cockatiel, of its wing's coefficients and the speed within their
ranges. The model ``animal`` flies it once. FOLDER keeps every flight: a run that was stopped resumes. The results
go to ``data/prediction_error.csv``, and the page is written from them; with ``--page`` nothing is flown.
"""

from __future__ import annotations

import argparse
import itertools
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd
from prediction_error_words import page

import wingbeat as wb
from wingbeat.files import write_atomically
from wingbeat.orbits.problem.parameters import parameters_of
from wingbeat.whole_flights import Measurement, read_measured_flights
from wingbeat.whole_flights.comparison import AGREES

ROOT = Path(__file__).parents[1]
TABLE, PAGE = ROOT / "data" / "prediction_error.csv", ROOT / "docs" / "prediction_error.md"
ANIMALS = ("pigeon", "cockatiel")
# Flights at most this far from the speed of a measurement at one speed [m/s].
NEAR = 1.0
# A frequency that does not depend on speed in the animal hides that predictions do: bands of speed part them.
SLOW, FAST = 7.0, 12.0
FEWEST = 30  # flights; fewer say nothing of some 40 numbers
NAMED = 4  # numbers in a row of the page


def ranges(animal: str) -> dict[str, tuple[float, float]]:
    """Return the range of the speed and of every number that an animal's flight depends on, by its path."""
    species = wb.load_species(animal)
    problem = wb.models.animal(species).problem(species, speed=10.0)
    terms = wb.aero.WING_ESTIMATES[problem.aero.coefficients.name]
    speeds = read_measured_flights(animal).speeds
    found = {"speed": (speeds[0], speeds[-1])}
    for one in parameters_of(problem):
        if one.path.startswith("air."):  # known where a flight is measured
            continue
        estimate = terms.get(one.path.removeprefix("aero.wing."))
        limits = (estimate.low, estimate.high) if estimate is not None else one.plausible
        if limits is not None and limits[0] < limits[1]:
            found[one.path] = limits
    return found


def study(animal: str, sets: int, store: Path) -> wb.Study:
    """Return the study: one flight for each set of numbers, more starts where the first finds none."""
    return wb.plan_study(
        species=animal,
        model="animal",
        starts=1,
        most_starts=4,
        explain=False,
        vary={path: {"range": list(limits)} for path, limits in ranges(animal).items()},
        sample={"method": "sobol", "n": sets, "seed": 0},
        store=store,
    )


def results(animal: str, flown: pd.DataFrame) -> pd.DataFrame:
    """Return the sets of an animal with the quantities that are measured, in the units of the nomenclature."""
    mass = flown["vehicle.body.mass"] + 2.0 * flown["vehicle.wing.mass"]
    quantities = {
        "frequency": flown["wingbeat.frequency"],
        "flap_amplitude_deg": np.degrees(flown["wingbeat.flap_amplitude"]),
        "positive_power_per_mass": flown["mean_positive_power"] / mass,
        "muscle_power_per_mass": flown["muscle_power_per_mass"],
        "muscle_efficiency": flown["muscle_efficiency"],
    }
    return pd.DataFrame({"animal": animal, "status": flown["status"], **flown[list(ranges(animal))], **quantities})


class Error(NamedTuple):
    """The error of a quantity in a band of speeds, over the sets of numbers.

    Attributes
    ----------
    animal : whose flights these are.
    measurement : what was measured.
    band : lowest and highest speed of the flights [m/s].
    flights : number of certified flights in the band.
    ratio : 10th, 50th and 90th percentile of prediction over the middle of the measured values.
    agree : share of the flights that agree with the measurement, by the rule of the whole flights.
    numbers : for the numbers that matter most, the rank correlation with the prediction.
    """

    animal: str
    measurement: Measurement
    band: tuple[float, float]
    flights: int
    ratio: tuple[float, float, float]
    agree: float
    numbers: dict[str, float]


def errors(table: pd.DataFrame) -> Iterator[Error]:
    """Yield the error of each measured quantity, by bands of speed."""
    for animal in ANIMALS:
        flown = table[(table["animal"] == animal) & (table["status"] == "converged")]
        for one in read_measured_flights(animal).measurements:
            if one.speeds is None or one.values[0] == 0:  # an upper limit has no middle
                continue
            for band in bands(one.speeds):
                rows = flown[flown["speed"].between(*band)]
                if len(rows) >= FEWEST:
                    yield error(animal, one, band, rows)


def bands(speeds: tuple[float, float]) -> Iterator[tuple[float, float]]:
    """Yield slow, medium and fast flight, as far as a measurement applies to them."""
    low, high = speeds
    if high - low < NEAR:
        yield (low + high) / 2 - NEAR, (low + high) / 2 + NEAR
        return
    ends = [low, *(one for one in (SLOW, FAST) if low + NEAR < one < high - NEAR), high]
    yield from itertools.pairwise(ends)


def error(animal: str, one: Measurement, band: tuple[float, float], rows: pd.DataFrame) -> Error:
    """Return the error over the flights of a band."""
    values = rows[one.quantity]
    low, high = one.values
    factor = AGREES[one.quantity]
    ranked = values.rank()
    found = {path: float(ranked.corr(rows[path].rank())) for path in ranges(animal)}
    best = sorted((path for path in found if not np.isnan(found[path])), key=lambda path: -abs(found[path]))
    ends = np.percentile(values / np.mean(one.values), [10, 50, 90])
    return Error(
        animal,
        one,
        band,
        len(rows),
        (float(ends[0]), float(ends[1]), float(ends[2])),
        float(values.between(low / factor, high * factor).mean()),
        {path: found[path] for path in best[:NAMED]},
    )


def main() -> None:
    """Fly what the stores lack, and write table and page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sets", type=int, default=1000)
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--folder", type=Path, default=Path())
    parser.add_argument("--page", action="store_true", help="write the page from the table, without flying")
    asked = parser.parse_args()
    if not asked.page:
        found = []
        for animal in ANIMALS:
            plan = study(animal, asked.sets, asked.folder / f"{animal}_error.study.sqlite")
            plan.run(processes=asked.processes)
            found.append(results(animal, plan.to_dataframe()))
        write_atomically(TABLE, pd.concat(found).to_csv(index=False, float_format="%.6g"))
    table = pd.read_csv(TABLE)
    write_atomically(PAGE, page(table, list(errors(table)), PAGE.with_suffix(".png")))


if __name__ == "__main__":
    main()
