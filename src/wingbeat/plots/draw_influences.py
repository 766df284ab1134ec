"""Pages of what an optimum depends on: its numbers (tornado), a limit (Pareto front), terms of the air loads."""

from __future__ import annotations

import math
import textwrap
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from wingbeat._base import cf, climb_text, for_people, heading, in_words, label_of, written
from wingbeat._base.style import (
    BLUE,
    FIRST,
    GREEN,
    GREY,
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
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.records.judgements import conditions_in_words, conditions_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_ROW, _HEAD = 6.5, 24.0  # mm
_LETTERS = 27  # of a line of a label
_MOST_RANKED = 12


class _Ranked(Protocol):
    """What the tornado plot asks of `Sensitivities`."""

    problem: OrbitProblem
    values: dict[str, float]
    units: dict[str, str]
    slopes: list[Any]

    @property
    def limited(self) -> frozenset[str]: ...
    def ranked(self, quantity: str) -> list[Any]: ...
    def swing(self, slope: Any, quantity: str) -> tuple[float, float]: ...


def tornado_page(found: _Ranked) -> Figure:
    """Rank parameters by the first-order effect of their plausible ranges on each quantity, the largest on top.

    Parameters without a range are left out. Each quantity has a panel; the line in the middle is the solved orbit.
    Bars are shares of the largest, because a linear approximation over whole ranges gives no valid error bar. A
    quantity that a limit has set has no bars.

    Parameters
    ----------
    found : from `wingbeat.sensitivities`.

    >>> import wingbeat as wb
    >>> pigeon = wb.load_species("pigeon")
    >>> found = wb.sensitivities(wb.solve_orbit(wb.OrbitProblem(pigeon, speed=10.0), starts=1))
    >>> len(wb.plots.tornado_page(found).axes)
    2
    """
    count = min(_MOST_RANKED, sum(s.parameter.plausible is not None for s in found.slopes))
    with drawing():
        figure = new_figure(PAGE, _HEAD + _ROW * count)
        problem = found.problem
        there = conditions_in_words(vars(problem.air), problem.species.carried_mass)
        title = f"{heading(problem.species.name)} at {problem.speed:g} m/s{there}, minimum "
        title += in_words(problem.minimise.name)
        figure.suptitle(f"{title}: which uncertain numbers matter most", fontsize=8, parse_math=False)
        panels = figure.subplots(1, len(found.values), squeeze=False)[0]
        for panel, name in zip(panels, found.values, strict=True):
            ranked = [s for s in found.ranked(name) if s.parameter.plausible is not None][:_MOST_RANKED]
            largest = max((abs(end) for slope in ranked for end in found.swing(slope, name)), default=0.0) or 1.0
            label = f"change of {in_words(name)} / largest [-]"
            if name in found.limited:
                # Its changes are rounding; as shares of the largest they would look like an answer.
                largest = math.inf
                label = f"{in_words(name)}: {written(found.values[name], unit=found.units[name])}, set by the limit"
                panel.set_xticks([])
            for row, slope in enumerate(ranked):
                low, high = found.swing(slope, name)
                for change, color, end in ((low, BLUE, "low end of its range"), (high, VERMILION, "high end")):
                    panel.barh(row, change / largest, height=0.7, color=color, label=end if row == 0 else None)
            panel.spines["left"].set_visible(False)
            panel.axvline(0.0, color="0.2", linewidth=0.8)
            names = [textwrap.fill(label_of(s.parameter.path), _LETTERS, break_on_hyphens=False) for s in ranked]
            panel.set_yticks(range(len(ranked)), names)
            panel.tick_params(axis="y", length=0)
            panel.invert_yaxis()
            panel.margins(y=0.01)
            panel.set_xlabel(label)
        letter_panels(panels)
        legend_below(figure, panels[0], columns=2)
    return figure


_KINDS = ("objective", "quantity")
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
    minimised, limited = (in_words(record[kind]) for kind in _KINDS)
    where = f"{heading(record['species'])} at {record['speed']:g} m/s{climb_text(record['climb'])}"
    figure.suptitle(
        f"{where}{conditions_of(record)}: least {minimised} for each limit of the {limited}", fontsize=8.5
    )
    front, changes = figure.subplots(1, 2)
    good = [point for point in record["points"] if point["quantity_value"] is not None]
    groups: dict[str, tuple[list[Any], dict[str, Any]]] = {
        "best orbits": (
            [p for p in good if not p["dominated"]],
            {"color": BLUE, "linestyle": "-", "linewidth": 1.0},
        ),
        "dominated by another": ([p for p in good if p["dominated"]], {"mfc": "none", "mec": GREY}),
        "without limit": ([p for p in good if p["limit"] is None], {"marker": "D", "color": "k"}),
    }
    for label, (points, look) in groups.items():
        if points:
            objective, at = (_values(points, f"{kind}_value", record[f"{kind}_unit"]) for kind in _KINDS)
            front.plot(at, objective, label=label, **{"marker": "o", "linestyle": "none", "ms": 3.5} | look)
    missed = [p for p in record["points"] if p["quantity_value"] is None and p["limit"] is not None]
    if missed:
        limits = _values(missed, "limit", record["quantity_unit"])
        bottom = np.full(len(missed), front.get_ylim()[0])
        front.plot(limits, bottom, "x", color=VERMILION, ms=4, clip_on=False, label="limit that no orbit keeps")
    dress(front, _label(record, "quantity"), _label(record, "objective"))
    best = [p for p in record["points"] if p["quantity_value"] is not None and not p["dominated"]]
    free = record["points"][0]
    for name, (colour, mark) in _CHANGING.items():
        if free["quantity_value"] is not None and best:
            rise = [100.0 * (point[name] / free[name] - 1.0) for point in best]
            at = _values(best, "quantity_value", record["quantity_unit"])
            changes.plot(at, rise, color=colour, marker=mark, ms=3.5, linewidth=1.0, label=in_words(name))
    changes.axhline(0.0, color=GREY, linewidth=0.6)
    dress(changes, _label(record, "quantity"), "change from the orbit without limit [%]")
    for axes in (front, changes):
        if record["quantity"] == "spectral_radius":
            left, right = axes.get_xlim()
            axes.axvspan(left, 1.0, color=SHADE, linewidth=0, zorder=0, label="disturbances decay")
            axes.set_xlim(left, right)
    letter_panels(figure.axes)
    legend_below(figure, [front, changes], columns=5)
    return figure


def _values(points: list[dict[str, Any]], name: str, unit: str) -> np.ndarray:
    return for_people(cf(unit))[0] * np.array([point[name] for point in points])


def _label(record: dict[str, Any], kind: str) -> str:
    unit = for_people(cf(record[f"{kind}_unit"]))[1]
    return f"{in_words(record[kind])} [{unit or '-'}]"


_TERMS = {"unsteady": ("rotation", "added mass"), "inflow": ("induced flow",)}
_PARTS = {
    "profile": ("spent on profile drag", FIRST),
    "induced": ("spent on induced drag", SECOND),
    "unsteady": ("spent on unsteady terms", THIRD),
}


def terms_page(record: dict[str, Any]) -> Figure:
    """Draw frequency, flap amplitude and power of the best orbits against the share of the terms.

    Lines end where the best orbit changes branch. The last panel shows what the mean power is spent on.

    Parameters
    ----------
    record : of a `TermTrace`.
    """
    with drawing():
        figure = new_figure(PAGE, 66.0)
        *first, last = (word for name, words in _TERMS.items() if name in record["aero"] for word in words)
        terms = f"{', '.join(first)} and {last}" if first else last
        name = heading(record["species"])
        title = (
            f"{name} at {record['speed']:.4g} m/s{conditions_of(record)}: the share of {terms} rises from 0 to 1"
        )
        figure.suptitle(title, fontsize=8.5, parse_math=False)
        frequency, amplitude, power = figure.subplots(1, 3)
        runs = _runs(record)
        _draw_line(frequency, runs, lambda point: point["wingbeat"]["frequency"])
        _draw_line(amplitude, runs, lambda point: math.degrees(point["wingbeat"]["flap_amplitude"]))
        for part, (label, look) in _PARTS.items():
            _draw_line(power, runs, lambda point, part=part: point["spent"][part], label=label, **look)
        _draw_line(power, runs, lambda point: point["mean_actuator_power"], label="all actuators")
        labels = ("frequency [Hz]", "flap amplitude [deg]", "mean power [W]")
        for axes, label in zip(figure.axes, labels, strict=True):
            axes.set(xlabel="share of the terms [-]", ylabel=label, xlim=(-0.03, 1.03))
        letter_panels(figure.axes)
        legend_below(figure, power)
    return figure


def _runs(record: dict[str, Any]) -> list[list[dict[str, Any]]]:
    """Return the points in runs without a change of branch and without a gap."""
    torn = {mark["lower"] for mark in record["marks"] if mark["kind"] != "bounds"}
    runs: list[list[dict[str, Any]]] = [[]]
    for point in record["points"]:
        if point["wingbeat"] is not None:
            runs[-1].append(point)
        if point["share"] in torn:
            runs.append([])
    return [run for run in runs if run]


def _draw_line(axes: Axes, runs: Any, of: Any, label: str = "_", **look: Any) -> None:
    look = {"color": "k", "marker": "o", "ms": 3, **look}
    for number, run in enumerate(runs):
        named = label if number == 0 else "_"
        axes.plot([point["share"] for point in run], [of(point) for point in run], label=named, **look)
    highest = max([0.0, *(of(point) for run in runs for point in run)])
    axes.set_ylim(min(0.0, axes.get_ylim()[0]), max(1.08 * highest, axes.get_ylim()[1]))
