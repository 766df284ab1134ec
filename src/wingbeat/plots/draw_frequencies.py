"""The page of a curve over frequency: what a beat costs, how far it goes and how hard, and what muscle allows."""

from __future__ import annotations

import json
import textwrap
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import FaultList, axis_label, in_words, over_of
from wingbeat._base.style import (
    BLUE,
    GREEN,
    ORANGE,
    PAGE,
    SECOND,
    SHADE,
    THIRD,
    VERMILION,
    drawing,
    dress,
    legend_below,
    letter_panels,
    new_figure,
)
from wingbeat.plots.draw_curve import curve_title, draw_optima
from wingbeat.records.inputs import vehicle_from
from wingbeat.records.judgements import set_by_limits_along
from wingbeat.words.curve_words import own_in_words, ranges_in_words, work_in_words

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_PANEL, _LEGEND = 50.0, 30.0  # mm
_LETTERS = 62  # of a line of the legend
_ALLOWED: dict[str, Any] = {"facecolor": GREEN, "alpha": 0.13, "linewidth": 0, "zorder": 0}
_POWER = {
    "mean_positive_power": "mechanical, positive",
    "metabolic_power": "metabolic, of the flight muscle",
    "metabolic_rate": "metabolic rate of the whole animal, an estimate",
}
_LOOKS: dict[str, dict[str, Any]] = {
    "mean_positive_power": {"color": BLUE},
    "metabolic_power": SECOND,
    "metabolic_rate": {**THIRD, "marker": "^"},
}


def frequency_page(dataset: xr.Dataset) -> Figure:
    """Draw power, flap amplitude, activation and work per beat of a curve's orbits against wingbeat frequency.

    Lines are the best orbits at each frequency, with the marks of `curve_page`. Green shows what muscle allows: an
    activation of at most 1, and the work per beat that was measured, of which each source has a bar at the right.
    Grey shows the frequency at which the animal beats, with its band.

    Parameters
    ----------
    dataset : `Curve.dataset` of a curve over frequency, also one read from a file.

    Raises
    ------
    InvalidInputError : the dataset is no curve over frequency.
    """
    faults = FaultList()
    if dataset.attrs.get("wingbeat_kind") != "curve" or over_of(dataset.attrs) != "frequency":
        faults.add(
            "dataset", dataset.attrs.get("wingbeat_kind"), "is no curve over frequency", "give curve.dataset"
        )
    faults.raise_if_any()
    about, frequency = dataset.attrs, dataset["frequency"].values
    known = json.loads(about["characteristic_frequencies"])
    limits = set_by_limits_along(dataset)
    mass = vehicle_from(json.loads(about["vehicle"])).mass
    muscle = "activation" in known
    per_mass = {name: dataset[name] / mass for name in _POWER if name in dataset}
    drawn = dataset.assign(per_mass | {"flap_amplitude": np.degrees(dataset["flap_amplitude"])})

    def curve(axes: Axes, name: str, **style: Any) -> float:
        at_limit = np.array([name in found for found in limits])
        return draw_optima(axes, drawn, name, at_limit, **style)

    with drawing():
        rows = 2 if muscle else 1
        figure = new_figure(PAGE, _PANEL * rows + _LEGEND)
        panels = np.ravel(figure.subplots(rows, 2, sharex=True))
        power, flap = panels[0], panels[1]
        top = max(curve(power, name, label=_POWER[name], look=_LOOKS[name]) for name in per_mass)
        dress(power, "", "power per whole mass [W/kg]")
        power.set_ylim(0.0, top)
        if about["objective"] in per_mass and known["least"] is not None:
            _draw_least(power, known["least"], about["objective"], mass)
        flap.set_ylim(0.0, curve(flap, "flap_amplitude", label="_"))
        dress(flap, "", axis_label("flap_amplitude").replace("[rad]", "[deg]"))
        if muscle:
            _draw_muscle(panels[2], panels[3], known, curve)
        margin = 0.03 * (frequency[-1] - frequency[0])
        own = known["own"]
        for axes in panels:
            low, high = own["range"]
            axes.axvspan(low, high, color=SHADE, linewidth=0, zorder=-1)
            label = textwrap.fill(f"the animal's own: {own_in_words(own)}", _LETTERS)
            axes.axvline(own["value"], color="0.35", linewidth=0.9, zorder=1, label=label)
            axes.set_xlim(frequency[0] - margin, frequency[-1] + margin)
        for axes in panels[-2:]:
            axes.set_xlabel(axis_label("frequency", full=True))
        letter_panels(panels)
        legend_below(figure, panels, columns=2)
        figure.suptitle(curve_title(about), fontsize=8, x=0.01, ha="left")
    return figure


def _draw_least(axes: Axes, least: dict[str, Any], objective: str, mass: float) -> None:
    """Draw between which frequencies the minimised power is within 5 % of its least."""
    ranges = least["within_5_percent"]
    label = textwrap.fill(f"within 5 % of the least {in_words(objective)}: {ranges_in_words(ranges)}", _LETTERS)
    look: dict[str, Any] = {"color": _LOOKS[objective]["color"], "linewidth": 5, "alpha": 0.3, "zorder": 2}
    value = least["value"] / mass
    for low, high in ranges:
        axes.plot([low, high], [value, value], solid_capstyle="butt", label=label, **look)
        label = "_"


def _draw_muscle(activation: Axes, work: Axes, known: dict[str, Any], curve: Any) -> None:
    """Draw activation and work per beat, with what muscle allows."""
    top = curve(activation, "peak_activation", label="_")
    dress(activation, "", "largest activation [-]")
    activation.axhspan(0.0, 1.0, **_ALLOWED)
    activation.set_ylim(0.0, max(top, 1.2))
    top = curve(work, "muscle_work_per_mass", label="_")
    dress(work, "", "work per beat and mass\nof the depressors [J/kg]")
    whole, *each = known["work_per_beat"]
    allowed = f"activation at most 1; {work_in_words(whole)} of measured work"
    work.axhspan(whole["low"], whole["high"], label=allowed, **_ALLOWED)
    work.set_ylim(0.0, max(top, 1.15 * whole["high"]))
    beside: dict[str, Any] = {"transform": work.get_yaxis_transform(), "clip_on": False}
    for i, band in enumerate(each):
        at = 1.02 + 0.035 * i
        work.plot([at, at], [band["low"], band["high"]], color=ORANGE, linewidth=2, zorder=4, **beside)
        if band["low"] == band["high"]:
            work.plot([at], [band["low"]], "D", color=ORANGE, markersize=3, zorder=4, **beside)

        work.text(at, band["high"], f"{i + 1}", color=VERMILION, ha="center", va="bottom", **beside)
    names = "; ".join(f"{i}\u00a0{band['name']}" for i, band in enumerate(each, 1))
    work.plot([], [], color=ORANGE, linewidth=2, label=textwrap.fill(f"measured work: {names}", _LETTERS))
