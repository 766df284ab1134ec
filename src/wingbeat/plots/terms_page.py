"""What terms of the air loads do to the best wingbeat, drawn against their share."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from wingbeat._base.style import (
    FIRST,
    PAGE,
    SECOND,
    THIRD,
    drawing,
    heading,
    legend_above,
    letter_panels,
    new_figure,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_TERMS = {"unsteady": ("rotation", "added mass"), "inflow": ("induced flow",)}
_SPENT = {"profile": FIRST, "induced": SECOND, "unsteady": THIRD}


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
        title = f"{name} at {record['speed']:.4g} m/s: the share of {terms} rises from 0 to 1"
        figure.suptitle(title, fontsize=8.5, parse_math=False)
        frequency, amplitude, power = figure.subplots(1, 3)
        runs = _runs(record)
        _draw(frequency, runs, lambda point: point["wingbeat"]["frequency"], "frequency [Hz]")
        amplitude_of = "flap amplitude [deg]"
        _draw(amplitude, runs, lambda point: math.degrees(point["wingbeat"]["flap_amplitude"]), amplitude_of)
        for part, look in _SPENT.items():
            _draw(power, runs, lambda point, part=part: point["spent"][part], "mean power [W]", label=part, **look)
        _draw(power, runs, lambda point: point["mean_actuator_power"], "mean power [W]", label="all actuators")
        legend_above(power, columns=2)
        letter_panels(figure.axes)
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


def _draw(axes: Axes, runs: Any, of: Any, label_of_axis: str, label: str = "", **look: Any) -> None:
    look = {"color": "k", "marker": "o", "ms": 3, **look}
    for number, run in enumerate(runs):
        (line,) = axes.plot([point["share"] for point in run], [of(point) for point in run], **look)
        if label and number == 0:
            line.set_label(label)
    highest = max([0.0, *(of(point) for run in runs for point in run)])
    axes.set(xlabel="share of the terms [-]", ylabel=label_of_axis, xlim=(-0.03, 1.03))
    axes.set_ylim(min(0.0, axes.get_ylim()[0]), max(1.08 * highest, axes.get_ylim()[1]))
