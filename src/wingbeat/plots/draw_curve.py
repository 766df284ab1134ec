"""The page of a power curve: power and frequency against speed, other wingbeats, and published values."""

from __future__ import annotations

import itertools
import json
import textwrap
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import FaultList, axis_label, climb_text, heading, in_words, over_of, plain, readable_limit
from wingbeat._base.style import (
    ALARM,
    BLUE,
    GREEN,
    ORANGE,
    PAGE,
    VERMILION,
    drawing,
    legend_below,
    letter_panels,
    new_figure,
)
from wingbeat.experiment.flights_file import FlightPoints
from wingbeat.plots.published import Published
from wingbeat.records.characteristic import best_line, characteristic_speeds
from wingbeat.records.judgements import conditions_of, set_by_limits_along
from wingbeat.records.measured import COMPARED
from wingbeat.words.curve_words import speed_in_words, speed_label

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_PANEL, _LEGEND, _OWN = 62.0, 36.0, 8.0  # mm; the last for the legend of measured flights
_LETTERS = 62  # of a line of the legend
_MOST_LIMITS = 1  # for whose words the title has room
_LINE = 116  # letters of a line of the title
_MOST_EMPTY = 0.35  # share of the axis that may lie below the slowest speed
_OTHER, _SPEEDS = "0.6", VERMILION
_BREAK: dict[str, Any] = {"color": "0.3", "linewidth": 0.5, "linestyle": (0, (2, 2)), "zorder": 1}
# Of published laws and points: enough that no two on a page look alike.
_DASHES = ((0, (1, 1)), (0, (3, 1, 1, 1)), (0, (6, 1.5)), (0, (2, 2.5)), (0, (6, 1, 1, 1, 1, 1)))
_POINTS = ("D", "P", "X", "*")
_NEEDED = ("frequency", "mean_positive_power", "objective_value", "family", "continued", "status")
_MARKERS = {"maximum_range": "s", "fastest_sustained": ">", "slowest_sustained": "<"}  # of minima: "v"


def curve_page(
    dataset: xr.Dataset, published: Sequence[Published] = (), measured: FlightPoints | None = None
) -> Figure:
    """Draw power and wingbeat frequency of a curve's orbits against speed.

    The thick line is the best orbit of each speed, broken where another kind of wingbeat takes over. A point is
    empty where a limit has set the number. Thin grey lines are other optima that were followed along speed. If
    another quantity is minimised, such as the metabolic power, it has a panel of its own. The characteristic speeds
    stand in the panel of the minimised quantity with their error bars.

    Parameters
    ----------
    dataset : `Curve.dataset`, also one read from a file.
    published : values to draw for comparison.
    measured : flights to draw with their errors; metabolic power has a panel of its own.

    Raises
    ------
    InvalidInputError : the dataset is not a curve.
    """
    faults = FaultList()
    if dataset.attrs.get("wingbeat_kind") != "curve" or any(name not in dataset for name in _NEEDED):
        faults.add("dataset", dataset.attrs.get("wingbeat_kind"), "is no curve of wingbeat", "give curve.dataset")
    elif over_of(dataset.attrs) != "speed":
        faults.add("dataset", over_of(dataset.attrs), "is what the curve runs over", "use frequency_page")
    faults.raise_if_any()
    about, speed, line = dataset.attrs, dataset["speed"].values, best_line(dataset)
    power_limit = json.loads(about["inputs"])["power_limit"]
    minimised = about["objective"]
    powers = ["mean_power", "mean_positive_power"] if minimised == "mean_power" else ["mean_positive_power"]
    own = minimised if minimised in (*powers, "frequency") else "objective_value"
    panels = [*powers, *([own] if own == "objective_value" else []), "frequency"]
    # A metabolic rate never stands in the panel of mechanical power, also if the curve has none of its own.
    metabolic = own if minimised == "metabolic_rate" else "metabolic_rate"
    if measured is not None and "metabolic_rate" in measured.values and metabolic not in panels:
        panels.insert(-1, metabolic)
    places = COMPARED | {"metabolic_rate": metabolic}
    # From 0 on, where the tangent of greatest range starts, unless that leaves much of the panel empty.
    start = 0.0 if speed[0] < _MOST_EMPTY * speed[-1] else speed[0]
    least, most = start, speed[-1]
    if measured is not None:
        least, most = min(least, measured.speed.min()), max(most, measured.speed.max())
    margin = 0.02 * (most - least)
    with drawing():
        figure = new_figure(PAGE, _PANEL * len(panels) + _LEGEND + (0.0 if measured is None else _OWN))
        all_axes = np.atleast_1d(figure.subplots(len(panels), 1, sharex=True))
        for axes, name in zip(all_axes, panels, strict=True):
            if name == "objective_value":
                unit = plain(dataset[name].attrs["units"])
                axes.set_ylabel(f"{in_words(minimised)} [{'-' if unit == '1' else unit}]")
            else:
                axes.set_ylabel(axis_label(name) if name in dataset else "metabolic rate, measured [W]")
            limited = minimised if name == "objective_value" else name
            top = 0.0
            if name in dataset:
                at_limit = np.array([limited in limits for limits in set_by_limits_along(dataset)])
                top = max(draw_optima(axes, dataset, name, at_limit), _draw_published(axes, published, name))
            if measured is not None:
                drawn = [_draw_measured(axes, measured, one) for one, place in places.items() if place == name]
                top = max(top, *drawn, 0.0)
            if name == own:
                _draw_speeds(axes, characteristic_speeds(line, power_limit), power_limit)
            axes.set(xlim=(least - margin, most + margin), ylim=(0, top))
        all_axes[-1].set_xlabel(axis_label("speed", full=True))
        all_axes[-1].locator_params(axis="x", steps=[1, 2, 5, 10])
        letter_panels(all_axes)
        legend_below(figure, all_axes, columns=2)
        figure.suptitle(curve_title(about), fontsize=8, x=0.01, ha="left")
    return figure


def curve_title(about: Mapping[str, Any]) -> str:
    """Return the title of a page from the attributes of a curve: what is minimised, within what, by what loads."""
    aero, kept = (json.loads(about[name]) for name in ("aero", "constraints"))
    limits = "".join(f", {in_words(readable_limit(text))}" for text in kept)
    limits = limits.replace("<=", " ≤ ").replace(">=", " ≥ ")
    if len(kept) > _MOST_LIMITS:
        limits = f", within {len(kept)} limits"
    at = f" at {about['speed']:g} m/s" if over_of(about) == "frequency" else ""
    who = f"{heading(about['species'])}{at}{climb_text(about['climb'])}{conditions_of(about)}"
    loads = f"{in_words(aero['coefficients'])} coefficients, {in_words(aero['extension'])}"
    return textwrap.fill(f"{who}: wingbeats of minimum {in_words(about['objective'])}{limits}; {loads}", _LINE)


def draw_optima(
    axes: Axes,
    dataset: xr.Dataset,
    name: str,
    at_limit: np.ndarray,
    label: str = "best wingbeat",
    look: Mapping[str, Any] = MappingProxyType({"color": BLUE}),
) -> float:
    """Draw the best orbits with their breaks and gaps, and other optima; return the height that the best need."""
    over = over_of(dataset.attrs)
    speed, values = dataset[over].values, dataset[name].values
    top = 1.15 * np.nanmax(values[:, 0]) if np.isfinite(values[:, 0]).any() else 1.0
    marks = [mark for mark in json.loads(dataset.attrs["marks"]) if mark["kind"] == "branch"]
    torn = np.flatnonzero(np.isin(speed, [mark[f"lower_{over}"] for mark in marks])) + 1
    for part in np.split(np.arange(len(speed)), torn):
        axes.plot(speed[part], values[part, 0], **{"marker": "o", "markersize": 2.5, **look}, label=label, zorder=3)
        label = "_"
    if at_limit.any():
        hollow = {"markersize": 3, "markerfacecolor": "w", "label": "set by a limit, not predicted", "zorder": 3}
        axes.plot(speed[at_limit], values[at_limit, 0], "o", color=look["color"], **hollow)
    label = "other wingbeats that the search found"
    for i, below, above in np.argwhere(dataset["continued"].values > 0):
        ends = values[i, below], values[i + 1, above]
        if (below or above) and min(ends) < top:
            axes.plot(speed[i : i + 2], ends, color=_OTHER, linewidth=0.6, label=label)
            label = "_"
    label = "another kind of wingbeat takes over"
    for mark in marks:
        axes.axvline(0.5 * (mark[f"lower_{over}"] + mark[f"upper_{over}"]), label=label, **_BREAK)
        label = "_"
    gaps = speed[dataset["status"].values != "converged"]
    if gaps.size:  # at the foot
        place: dict[str, Any] = {"transform": axes.get_xaxis_transform(), "clip_on": False, "color": ALARM}
        axes.plot(gaps, np.full(gaps.size, 0.02), "x", markersize=5, label="no certified wingbeat", **place)
    return top


def _draw_published(axes: Axes, published: Sequence[Published], name: str) -> float:
    """Draw the published values of a quantity and return the largest."""
    dashes, points = itertools.cycle(_DASHES), itertools.cycle(_POINTS)
    tallest = 0.0
    for one in published:
        style: dict[str, Any] = {"color": GREEN, "label": one.label, "zorder": 2}
        if one.quantity == "speed":
            if name not in ("frequency", "objective_value"):
                axes.axvspan(one.speeds[0], one.speeds[-1], **style | {"alpha": 0.12, "linewidth": 0})
            continue
        # Also of those that stand in another panel: one legend names them all.
        single = len(one.speeds) == 1
        style |= {"marker": next(points)} if single else {"linestyle": next(dashes)}
        if one.quantity != name:
            continue
        if single:
            axes.errorbar(one.speeds, one.values, one.spread, markersize=4, capsize=2, linestyle="", **style)
        else:
            axes.plot(one.speeds, one.values, **style)
            band = one.values - one.spread, one.values + one.spread
            axes.fill_between(one.speeds, *band, color=GREEN, alpha=0.15, linewidth=0)
        tallest = max(tallest, 1.05 * float(np.max(one.values + one.spread)))
    return tallest


def _draw_measured(axes: Axes, measured: FlightPoints, quantity: str) -> float:
    """Draw a quantity of measured flights with its errors and return the largest."""
    if quantity not in measured.values:
        return 0.0
    values, errors = measured.values[quantity], np.nan_to_num(measured.errors[quantity])
    look: dict[str, Any] = {
        "marker": "s",
        "markersize": 4,
        "color": "k",
        "markerfacecolor": ORANGE,
        "linestyle": "",
    }
    look |= {"capsize": 2, "elinewidth": 0.8, "markeredgewidth": 0.6, "zorder": 6, "clip_on": False}
    label = textwrap.fill(f"measured {quantity.replace('_', ' ')}, {measured.name}", _LETTERS)
    axes.errorbar(measured.speed, values, errors, label=label, **look)
    return 1.08 * float(np.nanmax(values + errors))


def _draw_speeds(axes: Axes, speeds: dict[str, Any], limit: float | None) -> None:
    """Mark the characteristic speeds with their error bars, and the tangent from the origin to that of range."""
    for key, found in speeds.items():
        if found is None:
            continue
        label = textwrap.fill(f"{speed_label(key)}: {speed_in_words(found)}", _LETTERS)
        look: dict[str, Any] = {"color": _SPEEDS, "markeredgecolor": "k", "markersize": 6, "linestyle": ""}
        look |= {"marker": _MARKERS.get(key, "v"), "label": label, "zorder": 5}
        if key == "maximum_range":  # larger and open: both speeds may be the same
            look |= {"markersize": 9, "markerfacecolor": "none", "markeredgecolor": _SPEEDS}
        if found["speed"] is None:  # only the words, in the legend
            axes.plot([], [], **look | {"marker": "", "zorder": 0})
            continue
        low, high = found["interval"]
        reach = [[found["speed"] - low], [high - found["speed"]]]
        axes.errorbar([found["speed"]], [found["value"]], xerr=reach, capsize=2, elinewidth=0.8, **look)
        if key == "maximum_range" and "minimum_power" in speeds:
            along = np.array([0.0, 1.15 * found["speed"]])
            dashed = {"linewidth": 0.6, "linestyle": (0, (4, 2))}
            axes.plot(along, found["value"] / found["lowest"] * along, color=_SPEEDS, **dashed)
    if limit is not None:
        axes.axhline(limit, color=_SPEEDS, linewidth=0.7, linestyle=":", label=f"power limit {limit:g} W")
