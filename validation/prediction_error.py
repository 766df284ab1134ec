"""Ask which numbers of a pigeon the error of its predicted flight depends on: fly many sets of its numbers.

    python validation/prediction_error.py [--sets 2000] [--processes 2] [--store error.study.sqlite]

Every set draws all numbers of the pigeon, of its wing's coefficients and the speed within their ranges. The model
``animal`` flies it once. The store keeps every flight: a run that was stopped resumes. The table of results goes
to ``data/prediction_error.csv``, and the page is written from it; with ``--page`` nothing is flown.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd

import wingbeat as wb
from wingbeat.files import write_atomically
from wingbeat.nomenclature import NOMENCLATURE, for_people
from wingbeat.orbits.problem.parameters import parameters_of

ROOT = Path(__file__).parents[1]
TABLE, PAGE = ROOT / "data" / "prediction_error.csv", ROOT / "docs" / "prediction_error.md"
SPEEDS = 4.0, 18.0  # m/s
BANDS = (4.0, 8.0), (8.0, 13.0), (13.0, 18.0)
NAMED = 5  # numbers in a row of the table
# Column of the study's table, and its name for readers.
QUANTITIES = {
    "wingbeat.frequency": "wingbeat frequency",
    "wingbeat.flap_amplitude": "flap amplitude",
    "positive_power_per_mass": "mean positive power over the mass",
    "metabolic_power": "metabolic power",
    "peak_activation": "activation",
}


def ranges() -> dict[str, tuple[float, float]]:
    """Return the range of every number that the flight of the pigeon depends on, by its path."""
    pigeon = wb.load_species("pigeon")
    model = wb.models.animal(pigeon)
    problem = model.problem(pigeon, speed=SPEEDS[0])
    terms = wb.aero.WING_ESTIMATES[problem.aero.coefficients.name]
    found = {"speed": SPEEDS}
    for one in parameters_of(problem):
        if one.path.startswith("air."):  # known where a flight is measured
            continue
        estimate = terms.get(one.path.removeprefix("aero.wing."))
        limits = (estimate.low, estimate.high) if estimate is not None else one.plausible
        if limits is not None and limits[0] < limits[1]:
            found[one.path] = limits
    return found


def study(sets: int, store: Path) -> wb.Study:
    """Return the study: one flight for each set of numbers, more starts where the first finds none."""
    return wb.plan_study(
        species="pigeon",
        model="animal",
        starts=1,
        most_starts=4,
        explain=False,
        vary={path: {"range": list(limits)} for path, limits in ranges().items()},
        sample={"method": "sobol", "n": sets, "seed": 0},
        store=store,
    )


class Share(NamedTuple):
    """How much of a quantity's scatter in a band of speeds goes with each number: squared rank correlations."""

    quantity: str
    band: tuple[float, float]
    flights: int
    spread: tuple[float, float]
    numbers: dict[str, float]


def shares(table: pd.DataFrame) -> Iterator[Share]:
    """Yield a row for every quantity and band of speeds."""
    certified = table[table["status"] == "converged"]
    varied = [path for path in ranges() if path in table and path != "speed"]
    for quantity in QUANTITIES:
        for low, high in BANDS:
            rows = certified[certified["speed"].between(low, high)]
            values = rows[quantity].rank()
            numbers = {path: float(values.corr(rows[path].rank()) ** 2) for path in ("speed", *varied)}
            best = dict(sorted(numbers.items(), key=lambda item: -item[1])[: NAMED + 1])
            ends = np.percentile(rows[quantity], [10, 90])
            yield Share(quantity, (low, high), len(rows), (float(ends[0]), float(ends[1])), best)


TEXT = """# Which numbers move a predicted flight most?

`python validation/prediction_error.py` writes this page. It flew {flown} sets of numbers of a pigeon by the model
`animal` ([models](models.md)), each once at a random speed between 4 and 18 m/s; {certified} have a certified
orbit. Each set draws every number of the pigeon, of its tail and muscle, and of its wing's coefficients, all at
once, evenly within the range that its source gives. Measured values do not depend on these numbers, so what moves a
prediction also moves its error by as much ([whole flights](whole_flights.md)).

A share is the square of the rank correlation of a number with a quantity, over the flights of a band of speeds. A
number of the animal with a large share is worth measuring better. *Speed* is listed because it differs within a
band.

{table}

Flights are local optima from one start, or from up to four where the first found none. Jumps between families of
wingbeats therefore add scatter that no number explains.
"""


def page(table: pd.DataFrame) -> str:
    """Return the page."""
    lines = [
        "| quantity | at [m/s] | flights | 10 to 90 % of them | share of each number |",
        "|---|---|---|---|---|",
    ]
    for row in shares(table):
        factor, unit = for_people(NOMENCLATURE[row.quantity.rpartition(".")[2]].unit)
        ends = " to ".join(f"{factor * end:.3g}" for end in row.spread)
        numbers = ", ".join(f"{path} {share:.2f}" for path, share in row.numbers.items())
        band = " to ".join(f"{end:g}" for end in row.band)
        lines.append(f"| {QUANTITIES[row.quantity]} [{unit}] | {band} | {row.flights} | {ends} | {numbers} |")
    certified = int((table["status"] == "converged").sum())
    return TEXT.format(flown=len(table), certified=certified, table="\n".join(lines))


def main() -> None:
    """Fly what the store lacks, and write table and page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sets", type=int, default=2000)
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--store", type=Path, default=Path("error.study.sqlite"))
    parser.add_argument("--page", action="store_true", help="write the page from the table, without flying")
    asked = parser.parse_args()
    if not asked.page:
        plan = study(asked.sets, asked.store)
        plan.run(processes=asked.processes)
        table = plan.to_dataframe()
        mass = table["body.mass"] + 2.0 * table["wing.mass"]
        table["positive_power_per_mass"] = table["mean_positive_power"] / mass
        kept = [column for column in ("status", *ranges(), *QUANTITIES) if column in table]
        write_atomically(TABLE, table[kept].to_csv(index=False, float_format="%.6g"))
    write_atomically(PAGE, page(pd.read_csv(TABLE)))


if __name__ == "__main__":
    main()
