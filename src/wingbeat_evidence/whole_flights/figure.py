"""The page of whole flights: power, frequency and amplitude against speed, with measured values."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import heading, in_words, plain_unit
from wingbeat._base.style import (
    BLUE,
    GREEN,
    GREY,
    ORANGE,
    PAGE,
    VERMILION,
    drawing,
    dress,
    legend_below,
    letter_panels,
    new_figure,
)
from wingbeat_evidence.whole_flights.comparison import name_of
from wingbeat_evidence.whole_flights.measured import COMPARED, Measurement
from wingbeat_evidence.whole_flights.prediction import Prediction

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# How each basis is drawn; the label stands in the legend.
_LOOKS: dict[str, dict[str, Any]] = {
    "measured": {"color": VERMILION, "hatch": "", "alpha": 0.35, "label": "measured"},
    "estimated": {"color": ORANGE, "hatch": "////", "alpha": 0.25, "label": "estimated with a model"},
    "law": {"color": GREEN, "hatch": "....", "alpha": 0.15, "label": "law fitted to other animals"},
}
_LETTERS = 30  # of a line of an axis label
_LINE = 0.05  # m/s: half of the width of a stripe at a single speed
_ALWAYS = ("positive_power_per_mass", "frequency", "flap_amplitude_deg")


@drawing()
def flights_page(prediction: Prediction) -> Figure:
    """Return a figure of an animal's predicted flights and its measured ones.

    The line with points is the prediction. The band around it contains 80 % of the certified draws, in which the
    animal's numbers vary, or spans the range of its frequency. Boxes and bars are measured values: their height is
    a standard deviation either side of the mean, or the range that the source gives. A vertical stripe marks the
    measured speed of minimum power.

    Parameters
    ----------
    prediction : from `predict_flights`.
    """
    measured = {one.quantity for one in prediction.flights.measurements}
    flown = {name for one in prediction.flown for name in one.values}
    more = [name for name in COMPARED if name in measured & flown and name not in _ALWAYS]
    shown = [*_ALWAYS, *more]
    columns = 3
    rows = -(-len(shown) // columns)
    figure = new_figure(PAGE, 10.0 + 55.0 * rows)
    grid = figure.subplots(rows, columns, squeeze=False, sharex=True)
    for axes, name in zip(grid.ravel(), shown, strict=False):
        _draw(axes, prediction, name)
    for axes in grid.ravel()[len(shown) :]:
        axes.remove()
    letter_panels(grid.ravel()[: len(shown)])
    legend_below(figure, figure.axes, columns=3)
    animal, objective = heading(prediction.flights.species), in_words(prediction.objective)
    title = f"{animal}: model {prediction.model}, least {objective}"
    figure.suptitle(title, fontsize=8, x=0.01, ha="left")
    return figure


def _draw(axes: Axes, prediction: Prediction, name: str) -> None:
    speeds, values, low, high = prediction.series(name)
    unit = " [-]" if plain_unit(name) == "1" else ""
    dress(axes, "speed [m/s]", textwrap.fill(name_of(name) + unit, _LETTERS))
    axes.tick_params(labelbottom=True)
    if np.isfinite(low).any():
        drawn = any(one.drawn for one in prediction.flown)
        label = "middle 80 % of the random draws" if drawn else "over the range of its frequency"
        axes.fill_between(speeds, low, high, color=BLUE, alpha=0.15, linewidth=0, label=label)
    axes.plot(speeds, values, "-o", color=BLUE, markersize=3, label="predicted", zorder=3)
    failed = ~np.isfinite(values)
    if failed.any():
        at_foot = {"transform": axes.get_xaxis_transform(), "clip_on": False}
        axes.plot(speeds[failed], [0.02] * failed.sum(), "x", color=GREY, label="no certified flight", **at_foot)
    for one in prediction.flights.measurements:
        if one.quantity == name:
            _draw_measured(axes, one)
        elif one.quantity == "minimum_power_speed" and name in ("positive_power_per_mass", "muscle_power_per_mass"):
            first, last = one.values
            stripe: dict[str, Any] = {"color": GREY, "alpha": 0.25, "linewidth": 0}
            axes.axvspan(first - _LINE, last + _LINE, label="its speed of minimum power", **stripe)
    axes.set_ylim(0, None)
    margin = max(0.06 * (speeds[-1] - speeds[0]), 10 * _LINE)
    axes.set_xlim(speeds[0] - margin, speeds[-1] + margin)


def _draw_measured(axes: Axes, one: Measurement) -> None:
    assert one.speeds is not None
    look, (low, high), (first, last) = _LOOKS[one.basis], one.values, one.speeds
    if first == last:
        bar: dict[str, Any] = {"color": look["color"], "markersize": 4, "capsize": 2.5, "zorder": 4}
        bar |= {"fmt": "D", "label": f"{look['label']}, at one speed"}
        axes.errorbar(first, 0.5 * (low + high), 0.5 * (high - low), **bar)
        return
    face = {"facecolor": look["color"], "edgecolor": look["color"], "hatch": look["hatch"], "alpha": look["alpha"]}
    axes.fill_between([first, last], low, high, linewidth=0.5, label=look["label"], zorder=1, **face)
