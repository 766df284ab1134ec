"""Ask which numbers of an animal the error of its predicted flight depends on: fly many sets of its numbers.

    python validation/prediction_error.py [--sets 1000] [--processes 2] [--folder FOLDER]

Every set draws all numbers of a pigeon or a cockatiel, of its wing's coefficients and the speed within their
ranges. FOLDER keeps every flight: a run that was stopped resumes. The results go to ``data/prediction_error.csv``,
and the page is written from them; with ``--page`` nothing is flown.
"""

from __future__ import annotations

import argparse
import itertools
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd
from prediction_error_flights import ANIMALS, flown_sets, ranges
from prediction_error_words import SLOW, page

from wingbeat._base import write_atomically
from wingbeat_evidence.whole_flights import Measurement, read_measured_flights
from wingbeat_evidence.whole_flights.comparison import AGREES

ROOT = Path(__file__).parents[1]
TABLE, PAGE = ROOT / "data" / "prediction_error.csv", ROOT / "docs" / "evidence" / "prediction_error.md"
# Flights at most this far from the speed of a measurement at one speed [m/s].
NEAR = 1.0
# Predictions depend on the speed, measured frequencies hardly do. So bands of speed are judged apart [m/s].
FAST = 12.0
FEWEST = 30  # flights; fewer say nothing of some 40 numbers
NAMED = 3  # numbers in a row of the page


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
    """Fly what the folder lacks, and write table and page."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--sets", type=int, default=1000)
    parser.add_argument("--processes", type=int, default=1)
    parser.add_argument("--folder", type=Path, default=Path())
    parser.add_argument("--page", action="store_true", help="write the page from the table, without flying")
    asked = parser.parse_args()
    if not asked.page:
        found = [flown_sets(animal, asked.sets, asked.processes, asked.folder) for animal in ANIMALS]
        write_atomically(TABLE, pd.concat(found).to_csv(index=False, float_format="%.6g"))
    table = pd.read_csv(TABLE)
    write_atomically(PAGE, page(table, list(errors(table)), PAGE.with_suffix(".png")))


if __name__ == "__main__":
    main()
