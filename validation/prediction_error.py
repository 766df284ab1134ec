"""Ask which numbers of an animal the error of its predicted flight depends on: fly many sets of its numbers.

    python validation/prediction_error.py [--sets 1000] [--processes 2] [--folder FOLDER]

Every set draws all numbers of a pigeon or a cockatiel, of its wing's coefficients and the speed within their
ranges. FOLDER keeps every flight: a run that was stopped resumes. The results go to ``data/prediction_error.csv``,
and the page is written from them; with ``--page`` nothing is flown.
"""

from __future__ import annotations

import argparse
import itertools
from collections.abc import Iterator, Sequence
from pathlib import Path
from textwrap import fill
from typing import NamedTuple

import numpy as np
import pandas as pd
from page_script import filled
from prediction_error_flights import ANIMALS, flown_sets

from wingbeat._base import label_of, write_atomically
from wingbeat._base.style import BLUE, FONT, GOOD, GREY, PAGE, drawing, dress, new_figure
from wingbeat.plots import save_figure
from wingbeat_evidence.markdown import markdown_table
from wingbeat_evidence.whole_flights import Measurement, read_measured_flights
from wingbeat_evidence.whole_flights.comparison import AGREES
from wingbeat_evidence.whole_flights.page import IN_SHORT

# Of some 40 correlations that are all zero, the largest of n pairs is about this over the root of n.
BY_CHANCE = 2.4
# In a line of a label of the figure, so that labels leave the bars half of the width.
LETTERS = 46
# Slow flight, of which the findings speak [m/s].
SLOW = 7.0
COLUMNS = ("animal", "quantity", "basis", "at [m/s]", "flights", "ratio (10 to 90 %)", "agree", "depends on")
ROOT = Path(__file__).parents[1]
TABLE, OUT = ROOT / "data" / "prediction_error.csv", ROOT / "docs" / "evidence" / "prediction_error.md"
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
            # An upper limit has no middle; the table may be older than the list of measurements.
            if one.speeds is None or one.values[0] == 0 or one.quantity not in flown:
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
    found = {path: float(ranked.corr(rows[path].rank())) for path in rows if "." in path or path == "speed"}
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


def page(table: pd.DataFrame, errors: Sequence[Error], figure: Path) -> str:
    """Draw the figure, and return the page."""
    draw(errors, figure)
    counts = table["animal"].value_counts(sort=False)
    flown = table[table["status"] == "converged"]
    slow = flown[(flown["animal"] == "pigeon") & (flown["speed"] < SLOW)]
    crossed = table[table["wing.shoulder.y"] < 0]
    if (crossed["status"] == "converged").any():
        raise ValueError("a certified flight has its shoulder beyond the plane of symmetry: mend the page")
    ranked = slow.loc[slow["speed"].between(3.46, 5.46), ["frequency", "wing.shoulder.y"]].rank()
    return filled(
        "prediction_error",
        sets=len(table),
        drawn=" and ".join(f"{count} of a {animal}" for animal, count in counts.items()),
        certified=len(flown),
        own=int((flown["start"] == "own").sum()),
        own_share=100 * float((flown["start"] == "own").mean()),
        figure=figure.name,
        table=markdown_table(COLUMNS, map(_row, errors)),
        chance=BY_CHANCE / min(one.flights for one in errors) ** 0.5,
        slow=100 * float(ranked["frequency"].corr(ranked["wing.shoulder.y"])) ** 2,
        crossed=100 * len(crossed) / len(table),
    )


def _row(one: Error) -> list[str]:
    low, middle, high = one.ratio
    numbers = ", ".join(f"{path} {share:+.2f}" for path, share in one.numbers.items())
    ratio, agree = f"{middle:.2f} ({low:.2f} to {high:.2f})", f"{100 * one.agree:.0f} %"
    quantity, basis = IN_SHORT[one.measurement.quantity].split(" [")[0], one.measurement.basis
    return [one.animal, quantity, basis, _band(one), str(one.flights), ratio, agree, numbers]


def _band(one: Error) -> str:
    low, high = one.band
    return f"{low:.3g} to {high:.3g}"


@drawing()
def draw(errors: Sequence[Error], path: Path) -> None:
    """Draw the ratio of prediction to measurement, a line for each quantity and band of speeds."""
    figure = new_figure(PAGE, 12 + 9.5 * len(errors))
    axes = figure.subplots()
    for i, one in enumerate(errors):
        factor = AGREES[one.measurement.quantity]
        axes.fill_betweenx([i - 0.4, i + 0.4], 1 / factor, factor, color=GOOD, alpha=0.2, linewidth=0)
        low, middle, high = one.ratio
        axes.plot([low, high], [i, i], color=BLUE, linewidth=2.5, solid_capstyle="butt")
        axes.plot(middle, i, "o", color=BLUE, markersize=5, markeredgecolor="white")
    axes.axvline(1.0, color=GREY, linewidth=0.8)
    dress(axes, "predicted / measured [-]", "")
    axes.set_xscale("log")
    ticks = (0.25, 0.5, 1, 2, 4, 8)
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks], minor=False)
    axes.set_xticks([], minor=True)
    names = [
        fill(f"{one.animal}: {label_of(one.measurement.quantity)}", LETTERS)
        + f"\n{_band(one)} m/s, {one.measurement.basis}"
        for one in errors
    ]
    axes.set_yticks(range(len(errors)), names, fontsize=FONT)
    axes.set_ylim(len(errors) - 0.5, -0.5)
    save_figure(figure, path)


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
    write_atomically(OUT, page(table, list(errors(table)), OUT.with_suffix(".png")))


if __name__ == "__main__":
    main()
