"""The page of a power curve: power and frequency against speed, branches, marks, and published values."""

from __future__ import annotations

import itertools
import json
import textwrap
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import FaultList, axis_label, climb_text, heading, in_words, plain, readable_limit
from wingbeat._base.style import ALARM, BLUE, GREEN, PAGE, VERMILION, drawing, letter_panels, new_figure
from wingbeat.plots.published import Published
from wingbeat.records.characteristic import best_line, characteristic_speeds
from wingbeat.words.curve_words import speed_in_words, speed_label

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_HEIGHT = 150.0  # mm
_LETTERS = 50  # of a line of the legend
_MOST_LIMITS = 1  # for whose words the title has room
_MOST_EMPTY = 0.35  # share of the axis that may lie below the slowest speed
_BEST, _OTHER, _PUBLISHED, _SPEEDS = BLUE, "0.6", GREEN, VERMILION
_DASHES = ((0, (1, 1)), (0, (3, 1, 1, 1)), (0, (6, 1.5)), (0, (2, 2.5)))
# Marks in a strip above the panel: kind, marker, its fill, height as a share of the panel's, and label.
_STRIP = (
    ("branch", "X", "k", 1.09, "change of branch between two speeds"),
    ("bounds", "^", "w", 1.03, "change of active bounds"),
)
_NEEDED = ("frequency", "mean_positive_power", "objective_value", "family", "continued", "status")
_MARKERS = {"maximum_range": "s", "fastest_sustained": ">", "slowest_sustained": "<"}  # of minima: "v"


def curve_page(dataset: xr.Dataset, published: Sequence[Published] = ()) -> Figure:
    """Draw power and wingbeat frequency of a curve's orbits against speed.

    The thick line is the best orbit of each speed, broken where it changes branch. Thin grey lines are the other
    certified optima found. The grey band spans all optima. If another quantity is minimised, such as the metabolic
    power, it has a panel of its own. Small points were added to find the characteristic speeds, which stand in the
    panel of the minimised quantity with their error bars; where a point is empty, a limit has set the number.

    Parameters
    ----------
    dataset : `Curve.dataset`, also one read from a file.
    published : values to draw for comparison.

    Raises
    ------
    InvalidInputError : the dataset is not a curve.
    """
    faults = FaultList()
    if dataset.attrs.get("wingbeat_kind") != "curve" or any(name not in dataset for name in _NEEDED):
        faults.add("dataset", dataset.attrs.get("wingbeat_kind"), "is no curve of wingbeat", "give curve.dataset")
    faults.raise_if_any()
    about, speed = dataset.attrs, dataset["speed"].values
    marks, line = json.loads(about["marks"]), best_line(dataset)
    gaps = [float(u) for u, status in zip(speed, dataset["status"].values, strict=True) if status != "converged"]
    power_limit = json.loads(about["inputs"])["power_limit"]
    powers = ["mean_positive_power"]
    if dataset.attrs["objective"] == "mean_power":
        powers = ["mean_power", *powers]
    minimised = dataset.attrs["objective"]
    has_panel = minimised in (*powers, "frequency")
    panels = [*powers, *([] if has_panel else ["objective_value"]), "frequency"]
    with drawing():
        figure = new_figure(PAGE, _HEIGHT + 45 * (len(panels) - 2))
        all_axes = np.atleast_1d(figure.subplots(len(panels), 1, sharex=True))
        for axes, name in zip(all_axes, panels, strict=True):
            axes.set_ylabel(_minimised_label(dataset) if name == "objective_value" else axis_label(name))
            own = minimised if name == "objective_value" else name
            _draw_optima(axes, dataset, marks, name, np.array([own in reached for reached in line.limits]))
            _draw_published(axes, published, name)
            _draw_marks(axes, marks, gaps)
        axes = all_axes[panels.index(minimised if has_panel else "objective_value")]
        _draw_speeds(axes, characteristic_speeds(line, power_limit), power_limit)
        all_axes[-1].set_xlabel(axis_label("speed", full=True))
        for axes in all_axes:
            axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), fontsize=6.5)
        letter_panels(all_axes)
        figure.suptitle(_title(dataset), fontsize=8, x=0.01, ha="left")
    return figure


def _minimised_label(dataset: xr.Dataset) -> str:
    unit = plain(dataset["objective_value"].attrs["units"])
    return f"{in_words(dataset.attrs['objective'])} [{'-' if unit == '1' else unit}]"


def _title(dataset: xr.Dataset) -> str:
    about = dataset.attrs
    aero, kept = (json.loads(about[name]) for name in ("aero", "constraints"))
    limits = "".join(f", {in_words(readable_limit(text))}" for text in kept)
    limits = limits.replace("<=", " ≤ ").replace(">=", " ≥ ")
    if len(kept) > _MOST_LIMITS:
        limits = f", within {len(kept)} limits"
    animal = heading(about["species"]) + climb_text(about["climb"])
    loads = f"{in_words(aero['coefficients'])} coefficients, {in_words(aero['extension'])}"
    return f"{animal}: minimum {in_words(about['objective'])}{limits}; {loads}"


def _draw_optima(
    axes: Axes, dataset: xr.Dataset, marks: list[dict[str, Any]], name: str, at_limit: np.ndarray
) -> None:
    speed, values = dataset["speed"].values, dataset[name].values
    good = np.isfinite(values)
    low = np.where(good, values, np.inf).min(axis=1)
    high = np.where(good, values, -np.inf).max(axis=1)
    some = good.any(axis=1)
    band = {"color": "0.5", "alpha": 0.13, "linewidth": 0, "label": "range of all optima found"}
    axes.fill_between(speed, np.where(some, low, np.nan), np.where(some, high, np.nan), **band)
    label = "another optimum, followed along speed"
    for i, below, above in np.argwhere(dataset["continued"].values > 0):
        if below or above:
            ends = values[i, below], values[i + 1, above]
            axes.plot(speed[i : i + 2], ends, color=_OTHER, linewidth=0.6, label=label)
            label = "_"
    for rank in range(1, values.shape[1]):
        axes.plot(speed, values[:, rank], ".", color=_OTHER, markersize=2)
    torn = {m["lower_speed"] for m in marks if m["kind"] == "branch"}
    line, label = [values[:, 0], speed], f"best, minimum {in_words(dataset.attrs['objective'])}"
    for part in np.split(np.arange(len(speed)), [i + 1 for i, u in enumerate(speed) if u in torn]):
        axes.plot(line[1][part], line[0][part], "-", color=_BEST, label=label, zorder=3)
        label = "_"
    refined = dataset["refined"].values > 0 if "refined" in dataset else np.zeros(len(speed), dtype=bool)
    for which, size, fill, label in (
        (~refined & ~at_limit, 3, _BEST, "_"),
        (refined & ~at_limit, 1.5, _BEST, "_"),
        (at_limit, 3, "w", f"{in_words(name)} set by a limit"),
    ):
        if which.any():
            look = {"markersize": size, "markerfacecolor": fill, "label": label, "zorder": 3}
            axes.plot(speed[which], values[which, 0], "o", color=_BEST, **look)
    top = 1.15 * np.nanmax(values[:, 0]) if some.any() else 1.0
    # From 0 on, where the tangent of greatest range starts, unless that leaves much of the panel empty.
    start = 0.0 if speed[0] < _MOST_EMPTY * speed[-1] else speed[0]
    margin = 0.02 * (speed[-1] - start)
    axes.set_xlim(start - margin, speed[-1] + margin)
    axes.set_ylim(0, max(top, min(1.05 * high[some].max(initial=0.0), 1.5 * top)))


def _draw_marks(axes: Axes, marks: list[dict[str, Any]], gaps: list[float]) -> None:
    # Above the panel: inside it, the marks of the lowest speeds look like measured points.
    strip: dict[str, Any] = {
        "transform": axes.get_xaxis_transform(),
        "linestyle": "",
        "clip_on": False,
        "zorder": 4,
    }
    strip |= {"markersize": 5, "markeredgecolor": "k", "markeredgewidth": 0.6}
    for kind, marker, fill, height, label in _STRIP:
        at = [0.5 * (m["lower_speed"] + m["upper_speed"]) for m in marks if m["kind"] == kind]
        if at:
            look = {"marker": marker, "markerfacecolor": fill, "label": label}
            axes.plot(at, [height] * len(at), **look, **strip)
        if kind == "branch":
            for u in at:
                axes.axvline(u, color="0.3", linewidth=0.5, linestyle=(0, (2, 2)), zorder=1)
    if gaps:
        strip |= {"color": ALARM, "markeredgecolor": ALARM}
        axes.plot(gaps, [_STRIP[-1][3]] * len(gaps), "x", label="nothing certified", **strip)


def _draw_published(axes: Axes, published: Sequence[Published], name: str) -> None:
    left, right = axes.get_xlim()
    tallest = axes.get_ylim()[1]
    dashes = itertools.cycle(_DASHES)  # in the order of the lines, so that a law looks the same in every figure
    for one in (p for p in published if p.quantity in (name, "speed")):
        style = {"color": _PUBLISHED, "zorder": 2}
        if one.quantity == "speed":
            if name not in ("frequency", "objective_value"):
                axes.axvspan(
                    one.speeds[0], one.speeds[-1], color=_PUBLISHED, alpha=0.12, linewidth=0, label=one.label
                )
            continue
        if len(one.speeds) == 1:
            axes.errorbar(
                one.speeds, one.values, one.spread, fmt="D", markersize=4, capsize=2, label=one.label, **style
            )
            continue
        axes.plot(one.speeds, one.values, linestyle=next(dashes), label=one.label, **style)
        if one.spread:
            axes.fill_between(
                one.speeds,
                one.values - one.spread,
                one.values + one.spread,
                color=_PUBLISHED,
                alpha=0.15,
                linewidth=0,
            )
        tallest = max(tallest, 1.05 * float(np.max(one.values)))
    axes.set(xlim=(left, right), ylim=(0, tallest))


def _draw_speeds(axes: Axes, speeds: dict[str, Any], limit: float | None) -> None:
    """Mark the characteristic speeds with their error bars, and the tangent from the origin to that of range."""
    for key, found in speeds.items():
        if found is None:
            continue
        label = f"{speed_label(key)}: {speed_in_words(found)}"
        look: dict[str, Any] = {
            "marker": _MARKERS.get(key, "v"),
            "color": _SPEEDS,
            "markeredgecolor": "k",
            "linestyle": "",
        }
        look |= {"markersize": 6, "label": textwrap.fill(label, _LETTERS), "zorder": 5}
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
            left, right = axes.get_xlim()
            dashed = {"linewidth": 0.6, "linestyle": (0, (4, 2))}
            axes.plot(along, found["value"] / found["lowest"] * along, color=_SPEEDS, **dashed)
            axes.set_xlim(left, right)
    if limit is not None:
        axes.axhline(limit, color=_SPEEDS, linewidth=0.7, linestyle=":", label=f"power limit {limit:g} W")
