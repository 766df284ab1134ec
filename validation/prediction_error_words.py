"""The page and the figure of `prediction_error.py`, from the errors over all sets of numbers."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from textwrap import fill
from typing import TYPE_CHECKING

import pandas as pd

from wingbeat.nomenclature import label_of
from wingbeat.plots import save_figure
from wingbeat.style import BLUE, FONT, GOOD, GREY, PAGE, drawing, dress, new_figure
from wingbeat.whole_flights.comparison import AGREES

if TYPE_CHECKING:
    from prediction_error import Error

# Of some 40 correlations that are all zero, the largest of n pairs is about this over the root of n.
BY_CHANCE = 2.4
# In a line of a label of the figure, so that labels leave the bars half of the width.
LETTERS = 46
# Slow flight, of which the findings speak [m/s].
SLOW = 7.0
COLUMNS = (
    "animal",
    "quantity",
    "basis",
    "at [m/s]",
    "flights",
    "ratio: median (10 to 90 %)",
    "agree",
    "numbers that move the prediction most, with their rank correlation",
)
TEXT = """# Which numbers would a better prediction need?

`python validation/prediction_error.py` writes this page. Predicted flights differ from measured ones
([whole flights](whole_flights.md)). Do they differ because numbers of the animal are uncertain? And which number
would be worth measuring better?

We drew {sets} sets of numbers: {drawn}.
A set holds all numbers of the animal, of its tail, of its muscle and of its wing's coefficients, and a speed. Each
number is drawn evenly from the range that its source gives. We flew each set with the model
[`animal`](../guide/models.md) from two starts: the stock wingbeat, and the best flight of the species' own numbers
at the nearest speed of the [whole flights](whole_flights.md). If both starts lead to a certified flight, we keep
the one in which the flight muscle needs less metabolic power. For {certified} sets we found a certified flight.
For {own} of these sets, the flight that we kept started from the flight of the species' own numbers.

![Predicted over measured values for each quantity and band of speeds]({figure})

*Bars: 10th to 90th percentile of the certified flights, with the median as a point. Shaded: the ratios at which a
prediction would agree if the measurement were a single value, the middle of the measured range.*

{table}

The *ratio* is the prediction divided by the middle of the measured range. *Agree* is the share of flights that
agree with the measurement by the rule of the [whole flights](whole_flights.md). The square of a number's rank
correlation is the share of the prediction's scatter that goes with this number. A positive correlation means that
the prediction rises with the number. In the band with the fewest flights, even numbers without influence have
correlations of up to {chance:.2f} by chance.

{findings}

Two starts do not find the best family of wingbeats for every set. Jumps between families add scatter that no number
explains. The ranges are those of the species files and of the wings' coefficients. They are ranges, not probability
distributions.
"""
FINDINGS = """## What this says

- **Uncertain numbers do not explain the frequencies.** Few sets come near a measured frequency, or near the law for
  birds in cruise. The median prediction is two to four times the measured frequency or the law's frequency. In
  {least:.0f} % of the certified flights, the flap amplitude is the smallest that the species files allow, 5
  degrees. So the cause is probably in the model; [what sets the frequency](frequency_trials.md) names the lag of
  the wake.
- **In slow flight the place of the shoulder matters most.** The distance of the shoulder from the plane of symmetry
  (`wing.shoulder.y`) goes with {slow:.0f} % of the scatter of the pigeon's frequency near 4.5 m/s. Below 7 m/s the
  pigeon's median is {near:.0f} Hz where this distance is less than 1 cm, and {far:.0f} Hz where it is more than
  2 cm. Wings whose shoulders are far apart can flap higher before they cross the plane. In {crossed:.0f} % of all
  sets the shoulder is on the wrong side of the plane. None of these sets has a certified flight, because such a
  wing cannot stay on its own side. These sets exist because a species file gives one range for all three
  coordinates of the shoulder. A measured position of the shoulder would remove these sets and this part of the
  scatter.
- **Powers mostly agree.** 78 to 91 % of the flights agree with the measured powers. The mass of the muscle, and how
  far the wing folds and retracts in the upstroke, move the cockatiel's power most. Measure these numbers first. The
  cockatiel's efficiency depends most on the curvature and the largest strain rate of the muscle. In no set is the
  predicted efficiency within a factor of 2 of the measured efficiency.
- **Two starts matter.** In {own:.0f} % of the certified sets, the flight that we kept started from the flight of
  the species' own numbers.
"""


def page(table: pd.DataFrame, errors: Sequence[Error], figure: Path) -> str:
    """Draw the figure, and return the page."""
    draw(errors, figure)
    counts = table["animal"].value_counts(sort=False)
    return TEXT.format(
        sets=len(table),
        drawn=" and ".join(f"{count} of a {animal}" for animal, count in counts.items()),
        certified=int((table["status"] == "converged").sum()),
        own=int((table["start"] == "own").sum()),
        figure=figure.name,
        table="\n".join(_rows(errors)),
        chance=BY_CHANCE / min(one.flights for one in errors) ** 0.5,
        findings=FINDINGS.format(**_numbers(table)).rstrip(),
    )


def _numbers(table: pd.DataFrame) -> dict[str, float]:
    """Return the numbers in the findings."""
    flown = table[table["status"] == "converged"]
    slow = flown[(flown["animal"] == "pigeon") & (flown["speed"] < SLOW)]
    aside, frequency = slow["wing.shoulder.y"], slow["frequency"]
    crossed = table[table["wing.shoulder.y"] < 0]
    if (crossed["status"] == "converged").any():
        raise ValueError("a certified flight has its shoulder beyond the plane of symmetry: mend the findings")
    at_measured = slow[slow["speed"].between(3.46, 5.46)]
    return {
        "least": 100 * float((flown["flap_amplitude_deg"] < 5.05).mean()),
        "slow": 100 * float(at_measured["frequency"].rank().corr(at_measured["wing.shoulder.y"].rank())) ** 2,
        "near": float(frequency[aside < 0.01].median()),
        "far": float(frequency[aside > 0.02].median()),
        "crossed": 100 * len(crossed) / len(table),
        "own": 100 * float((flown["start"] == "own").mean()),
    }


def _rows(errors: Sequence[Error]) -> Iterator[str]:
    yield f"| {' | '.join(COLUMNS)} |"
    yield "|---" * len(COLUMNS) + "|"
    for one in errors:
        low, middle, high = one.ratio
        numbers = ", ".join(f"{path} {share:+.2f}" for path, share in one.numbers.items())
        yield (
            f"| {one.animal} | {label_of(one.measurement.quantity)} | {one.measurement.basis} | {_band(one)} "
            f"| {one.flights} | {middle:.2f} ({low:.2f} to {high:.2f}) | {100 * one.agree:.0f} % | {numbers} |"
        )


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
