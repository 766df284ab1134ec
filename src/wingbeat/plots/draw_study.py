"""The figure of a study: lines along one varied parameter, maps over two, parallel coordinates for more."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import FaultList, in_words, label_of, plain_unit
from wingbeat._base.style import ALARM, FONT, MARKED, PAGE, drawing, legend_below, letter_panels, new_figure
from wingbeat.animal.vehicle import Air
from wingbeat.records.judgements import conditions_in_words

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_ROW = 70.0  # mm
_MAP = "cividis"
_DASHES = ("-", "--", ":", "-.")
# Largest numbers that can still be read: panels of maps; panels of parallel coordinates; lines in one of the
# latter.
_MOST, _STRANDS = (12, 4), 2000
# Columns whose values say by themselves what they are.
_NAMES = ("species", "aero.coefficients", "species_given", "aero_given")
# A column holds one number that was rounded if its range is at most this share of its largest value.
_SAME = 1e-9
_FAILED: dict[str, Any] = {
    "marker": "x",
    "color": ALARM,
    "markersize": 4,
    "linestyle": "none",
    "label": "not certified",
}


def study_page(
    frame: pd.DataFrame, varied: Sequence[str], quantity: str, label: str, units: Sequence[str]
) -> Figure:
    """Draw a quantity of a study's certified orbits against the varied parameters.

    Points without a result are left out and counted in the title. There is one line or panel for each combination
    of the study's top-level keys. One varied parameter gives lines, with failures as red crosses at the bottom. Two
    give maps, in squares for a grid and in dots otherwise. More give parallel coordinates, with one line per point.

    Parameters
    ----------
    frame : the table of the study, `Study.to_dataframe`.
    varied : the numeric columns that the study varies.
    quantity : column to draw.
    label : its label, with the unit.
    units : of the varied parameters.

    Raises
    ------
    InvalidInputError : a column that is absent or holds no numbers, or nothing certified to draw.
    """
    faults = FaultList()
    if not varied:
        fix = "vary a number in the study, or read the study's table"
        faults.add("varied", list(varied), "has no number to draw against", fix)
    for name in (*varied, quantity):
        if name not in frame or frame[name].dtype.kind not in "fiu":
            faults.add("quantity" if name == quantity else "varied", name, "is not a numeric column of the table")
    faults.raise_if_any()
    asked, waiting = len(frame), frame["status"].to_numpy() == "waiting"
    frame = frame.loc[~waiting]
    good = int(np.count_nonzero(frame["status"].to_numpy() == "converged"))
    if not good:
        faults.add("status", "none converged", "leaves nothing to draw", "see `wingbeat study status`")
    faults.raise_if_any()
    pairs = zip(varied, units, strict=True)
    axes_labels = [f"{label_of(name, short=True)} [{'-' if unit == '1' else unit}]" for name, unit in pairs]
    groups = _groups(frame, varied)
    with drawing():
        shown = groups if len(varied) == 1 else groups[: _MOST[len(varied) > 2]]
        rows = {1: 1, 2: math.ceil(len(shown) / 2)}.get(len(varied), len(shown))
        figure = new_figure(PAGE, max(_ROW * rows, 90.0))
        if len(varied) == 1:
            axes = [_draw_lines(figure, shown, varied[0], quantity, axes_labels[0], label)]
        else:
            axes = _draw_panels(figure, shown, [*varied, quantity], axes_labels, label)
        legend_below(figure, axes)
        left = f"; {len(groups) - len(shown)} more panels are left out" if len(groups) > len(shown) else ""
        later = f", {asked - len(frame)} not solved yet" if len(frame) < asked else ""
        what = re.sub(r" \[.*\]$", "", label)
        title = f"{what[:1].upper()}{what[1:]}{_conditions(frame)}: {good} of {asked} points certified{later}{left}"
        figure.suptitle(title, fontsize=8, x=0.01, ha="left", parse_math=False)
    return figure


def _conditions(frame: pd.DataFrame) -> str:
    """Return what the title says of load and air, as far as all points share them."""
    shared = {}
    for name in ("air.density", "carried_mass"):
        values = frame[name].fillna(0.0).to_numpy(dtype=float) if name in frame else np.zeros(1)
        shared[name] = float(values[0]) if np.ptp(values) <= _SAME * np.abs(values).max() else 0.0
    return conditions_in_words({"density": shared["air.density"] or Air().density}, shared["carried_mass"])


def _groups(frame: pd.DataFrame, varied: Sequence[str]) -> list[tuple[str, pd.DataFrame]]:
    """Return, for each combination of the study's other requested values, its name and its points."""
    columns = [str(name) for name in frame.columns]
    # The columns of the requested values lie between the status and the record, whose first column is `message`.
    end = columns.index("message" if "message" in columns else "certificate")
    asked = [name for name in columns[2:end] if name not in varied]
    others = [name for name in asked if len({str(value) for value in frame[name]}) > 1]
    if not others:
        return [(in_words(str(frame["species"].iloc[0])), frame)]
    found = []
    for values, part in frame.groupby(others, sort=False, dropna=False):
        key: Any = values
        found.append((", ".join(_said(name, value) for name, value in zip(others, key, strict=True)), part))
    return found


def _said(name: str, value: Any) -> str:
    """Return a requested value with its name and unit, as in ``speed 4 m/s``."""
    if name in _NAMES:
        return in_words(str(value))
    number = f"{value:g}" if isinstance(value, float) else str(value)
    unit = plain_unit(name)
    return f"{label_of(name, short=True)} {number}{'' if unit == '1' else f' {unit}'}"


def _draw_lines(
    figure: Figure, groups: list[tuple[str, pd.DataFrame]], path: str, quantity: str, x_label: str, label: str
) -> Axes:
    axes, missed = figure.subplots(), []
    for i, (name, part) in enumerate(groups):
        part = part.sort_values(path)
        good = (part["status"] == "converged").to_numpy()
        x = part[path].to_numpy(dtype=float)
        again, which = divmod(i, len(MARKED))
        color, marker = MARKED[which]
        style: dict[str, Any] = {"color": color, "label": name, "markersize": 3.0}
        style |= {"linestyle": _DASHES[again % len(_DASHES)], "marker": marker}
        # Where there is no orbit, not-a-number breaks the line.
        axes.plot(x, np.where(good, part[quantity].to_numpy(dtype=float), np.nan), **style)
        missed.extend(x[~good])
    if missed:
        foot: dict[str, Any] = {"transform": axes.get_xaxis_transform(), "clip_on": False}
        axes.plot(missed, np.full(len(missed), 0.02), **foot, **_FAILED)
    axes.set(xlabel=x_label, ylabel=label)
    return axes


def _draw_panels(
    figure: Figure, groups: list[tuple[str, pd.DataFrame]], names: list[str], labels: list[str], label: str
) -> list[Axes]:
    """Draw a panel for each combination of the top-level keys."""
    maps = len(names) == 3
    columns = min(2, len(groups)) if maps else 1
    panels = figure.subplots(math.ceil(len(groups) / columns), columns, squeeze=False).ravel()
    for axes, (name, part) in zip(panels, groups, strict=False):
        good = (part["status"] == "converged").to_numpy()
        table = part[names].to_numpy(dtype=float)
        axes.set_title(name, fontsize=FONT)
        if not good.any():
            axes.text(0.5, 0.5, "nothing certified", transform=axes.transAxes, ha="center", color=ALARM)
            continue
        drawn = _map(axes, table, good, labels) if maps else _strands(axes, table[good], [*labels, label])
        figure.colorbar(drawn, ax=axes, label=label)
    for axes in panels[len(groups) :]:
        axes.remove()
    if len(groups) > 1:
        letter_panels(panels[: len(groups)])
    return list(panels[: len(groups)])


def _map(axes: Axes, table: np.ndarray, good: np.ndarray, labels: list[str]) -> Any:
    """Draw the last column against the first two, as squares if the points form a full grid, else as dots."""
    x, y, values = table[:, 0], table[:, 1], np.where(good, table[:, 2], np.nan)
    if not good.all():
        axes.plot(x[~good], y[~good], **_FAILED)
    axes.set(xlabel=labels[0], ylabel=labels[1])
    across, up = np.unique(x), np.unique(y)
    if across.size > 1 and up.size > 1 and across.size * up.size == x.size:
        table = np.full((up.size, across.size), np.nan)
        table[np.searchsorted(up, y), np.searchsorted(across, x)] = values
        return axes.pcolormesh(across, up, table, cmap=_MAP, shading="nearest")
    some = np.isfinite(values)
    return axes.scatter(x[some], y[some], c=values[some], cmap=_MAP, s=14, edgecolors="0.3", linewidths=0.3)


def _strands(axes: Axes, table: np.ndarray, labels: list[str]) -> Any:
    """Draw a line for each point through the values of its parameters, coloured by the quantity, which is last."""
    from matplotlib.cm import ScalarMappable
    from matplotlib.collections import LineCollection
    from matplotlib.colors import Normalize

    table = table[:: math.ceil(len(table) / _STRANDS)]
    low, high = np.nanmin(table, axis=0), np.nanmax(table, axis=0)
    spread = high - low > _SAME * np.abs(high)
    places = np.where(spread, (table - low) / np.where(spread, high - low, 1.0), 0.5)
    strands = [np.column_stack([np.arange(len(labels)), row]) for row in places]
    norm = Normalize(low[-1], high[-1])
    faint = float(np.clip(60 / len(strands), 0.15, 0.9))
    lines = LineCollection(strands, cmap=_MAP, norm=norm, linewidths=0.6, alpha=faint)
    lines.set_array(table[:, -1])
    axes.add_collection(lines)
    axes.set_xlim(-0.15, len(labels) - 0.85)
    axes.set_ylim(-0.08, 1.08)
    axes.set_xticks(range(len(labels)), [text.replace(" [", "\n[") for text in labels])
    axes.set_yticks([])
    axes.spines["left"].set_visible(False)
    axes.vlines(range(len(labels)), 0.0, 1.0, color="0.3", linewidth=0.6)
    for i in range(len(labels)):
        for height, value, side in ((-0.01, low[i], "top"), (1.01, high[i], "bottom")):
            axes.text(i, height, f"{value:.4g}", ha="center", va=side, fontsize=6)
    return ScalarMappable(norm, _MAP)
