"""The page and the figure of `prediction_error.py`, from the errors over all sets of numbers."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from textwrap import fill
from typing import TYPE_CHECKING

import pandas as pd
from page_script import filled

from wingbeat._base import label_of
from wingbeat._base.style import BLUE, FONT, GOOD, GREY, PAGE, drawing, dress, new_figure
from wingbeat.plots import save_figure
from wingbeat_evidence.markdown import markdown_table
from wingbeat_evidence.whole_flights.comparison import AGREES
from wingbeat_evidence.whole_flights.page import IN_SHORT

if TYPE_CHECKING:
    from prediction_error import Error

# Of some 40 correlations that are all zero, the largest of n pairs is about this over the root of n.
BY_CHANCE = 2.4
# In a line of a label of the figure, so that labels leave the bars half of the width.
LETTERS = 46
# Slow flight, of which the findings speak [m/s].
SLOW = 7.0
COLUMNS = ("animal", "quantity", "basis", "at [m/s]", "flights", "ratio (10 to 90 %)", "agree", "depends on")


def page(table: pd.DataFrame, errors: Sequence[Error], figure: Path) -> str:
    """Draw the figure, and return the page."""
    draw(errors, figure)
    counts = table["animal"].value_counts(sort=False)
    flown = table[table["status"] == "converged"]
    slow = flown[(flown["animal"] == "pigeon") & (flown["speed"] < SLOW)]
    aside, frequency = slow["wing.shoulder.y"], slow["frequency"]
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
        least=100 * float((flown["flap_amplitude_deg"] < 5.05).mean()),
        slow=100 * float(ranked["frequency"].corr(ranked["wing.shoulder.y"])) ** 2,
        near=float(frequency[aside < 0.01].median()),
        far=float(frequency[aside > 0.02].median()),
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
