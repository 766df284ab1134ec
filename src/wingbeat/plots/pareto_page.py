"""The page of a Pareto front: what a limit costs, and how the wingbeat changes along it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import cf, for_people
from wingbeat._base.datasets import climb_text
from wingbeat._base.style import (
    BLUE,
    GREEN,
    GREY,
    PAGE,
    SHADE,
    VERMILION,
    drawing,
    dress,
    heading,
    in_words,
    legend_below,
    letter_panels,
    new_figure,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# Bound of the shaded values of a quantity, for which a disturbance decays.
_DECAYS = {"spectral_radius": 1.0}
_AXES = ("quantity", "objective")
_CHANGING = {"frequency": (GREEN, "^"), "mean_positive_power": (VERMILION, "s")}


@drawing()
def pareto_page(record: dict[str, Any]) -> Figure:
    """Draw the objective against the limited quantity, and how much frequency and power rise along the front.

    Hollow grey points are dominated: another orbit is better in one quantity and no worse in the other. Crosses on
    the axis mark limits that no certified orbit keeps. Where disturbances decay, the panels are shaded.

    Parameters
    ----------
    record : of `ParetoFront.record`.
    """
    figure = new_figure(PAGE, 76.0)
    minimised, limited = (in_words(record[kind]) for kind in ("objective", "quantity"))
    where = f"{heading(record['species'])} at {record['speed']:g} m/s{climb_text(record['climb'])}"
    figure.suptitle(f"{where}: least {minimised} for each limit of the {limited}", fontsize=8.5)
    front, changes = figure.subplots(1, 2)
    _draw_front(front, record)
    _draw_changes(changes, record)
    for axes in (front, changes):
        if record["quantity"] in _DECAYS:
            left, right = axes.get_xlim()
            axes.axvspan(left, _DECAYS[record["quantity"]], color=SHADE, linewidth=0, zorder=0, label="decays")
            axes.set_xlim(left, right)
    letter_panels(figure.axes)
    legend_below(figure, [front, changes], columns=4)
    return figure


def _draw_front(axes: Axes, record: dict[str, Any]) -> None:
    good = [point for point in record["points"] if point["quantity_value"] is not None]
    looks: dict[str, dict[str, Any]] = {
        "best orbits": {"color": BLUE, "marker": "o", "linewidth": 1.0},
        "dominated": {"linestyle": "none", "marker": "o", "mfc": "none", "mec": GREY},
        "without limit": {"linestyle": "none", "marker": "D", "color": "k"},
    }
    groups = {
        "best orbits": [point for point in good if not point["dominated"]],
        "dominated": [point for point in good if point["dominated"]],
        "without limit": [point for point in good if point["limit"] is None],
    }
    for label, points in groups.items():
        if points:
            at, objective = (_values(points, f"{kind}_value", record[f"{kind}_unit"]) for kind in _AXES)
            axes.plot(at, objective, ms=3.5, label=label, **looks[label])
    missed = [p for p in record["points"] if p["quantity_value"] is None and p["limit"] is not None]
    if missed:
        limits = _values(missed, "limit", record["quantity_unit"])
        bottom = np.full(len(missed), axes.get_ylim()[0])
        axes.plot(limits, bottom, "x", color=VERMILION, ms=4, clip_on=False, label="limit without an orbit")
    dress(axes, *(_label(record, kind) for kind in _AXES))


def _draw_changes(axes: Axes, record: dict[str, Any]) -> None:
    best = [p for p in record["points"] if p["quantity_value"] is not None and not p["dominated"]]
    free = record["points"][0]
    for name, (colour, mark) in _CHANGING.items():
        if free["quantity_value"] is not None and best:
            rise = [100.0 * (point[name] / free[name] - 1.0) for point in best]
            at = _values(best, "quantity_value", record["quantity_unit"])
            axes.plot(at, rise, color=colour, marker=mark, ms=3.5, linewidth=1.0, label=in_words(name))
    axes.axhline(0.0, color=GREY, linewidth=0.6)
    dress(axes, _label(record, "quantity"), "change from the orbit without limit [%]")


def _values(points: list[dict[str, Any]], name: str, unit: str) -> np.ndarray:
    return for_people(cf(unit))[0] * np.array([point[name] for point in points])


def _label(record: dict[str, Any], kind: str) -> str:
    unit = for_people(cf(record[f"{kind}_unit"]))[1]
    return f"{in_words(record[kind])} [{unit or '-'}]"
