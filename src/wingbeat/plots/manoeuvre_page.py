"""The page of a manoeuvre: speed, height, body pitch and commands against time."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from wingbeat._base.style import (
    FIRST,
    GREY,
    MARKED,
    PAGE,
    SECOND,
    THIRD,
    drawing,
    dress,
    heading,
    in_words,
    legend_below,
    letter_panels,
    new_figure,
)
from wingbeat.animal.kinematics import ANGLES
from wingbeat.results.flight import Flight
from wingbeat.stability.manoeuvre import Manoeuvre

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# A flight whose body pitch differs by this much from the plan is lost, and its lines end [rad].
_LOST = np.pi / 3
_LINES = (FIRST, SECOND, THIRD)


@drawing()
def manoeuvre_page(plan: Manoeuvre, flights: Mapping[str, Flight]) -> Figure:
    """Draw the plan of a manoeuvre at the tops of the stroke, and flights of it.

    All values are those at the tops of the stroke. Lines are flights, which end where a flight is lost; black dots
    are the plan. The last panel shows how the inputs change. Angles are in degrees, the frequency is in tenths of a
    hertz.

    Parameters
    ----------
    plan : the manoeuvre.
    flights : of the manoeuvre, by names, at most three.
    """
    figure = new_figure(PAGE, 110.0)
    orbit = plan.beat_map.orbit
    name = str(orbit.inputs["species"]["name"])
    speeds = " to ".join(f"{speed:g}" for speed in (orbit.inputs["speed"], *(end.speed for end in plan.ends)))
    figure.suptitle(f"{heading(name)}: {speeds} m/s", fontsize=8.5)
    panels = figure.subplots(2, 2).ravel()
    path = plan.beat_map.climb
    _draw_state(panels[0], plan, flights, 2, "forward velocity u [m/s]")
    _draw_state(panels[1], plan, flights, 1, "body pitch [deg]", np.degrees(1.0))
    _draw_state(panels[2], plan, flights, 0, "height above the path [m]", climb=path)
    _draw_changes(panels[3], plan)
    letter_panels(figure.axes)
    legend_below(figure, [panels[0], panels[3]], columns=4)
    return figure


def _draw_state(
    axes: Axes,
    plan: Manoeuvre,
    flights: Mapping[str, Flight],
    column: int,
    label: str,
    factor: float = 1.0,
    climb: float = 0.0,
) -> None:
    start = float(plan.beat_map.orbit.initial_state.z)

    def planned(time: np.ndarray) -> np.ndarray:
        return np.interp(time, plan.times, plan.states[:, 1])

    for (name, flight), line in zip(flights.items(), _LINES, strict=False):
        tops = slice(None, None, (len(flight.time) - 1) // len(flight.wingbeats))
        time, values = flight.time[tops], flight.states[tops, column + 1]
        if column == 0:
            values = values - start - climb * time
        shown = np.cumprod(np.abs(flight.states[tops, 2] - planned(time)) < _LOST).astype(bool)
        axes.plot(time[shown], factor * values[shown], label=name, **line)
    axes.plot(plan.times, factor * plan.states[:, column], ".", color="k", ms=2.0, label="plan", zorder=3)
    dress(axes, "time [s]", label)


def _draw_changes(axes: Axes, plan: Manoeuvre) -> None:
    middle = 0.5 * (plan.times[1:] + plan.times[:-1])
    for name, values, (colour, mark) in zip(plan.inputs, plan.changes.T, MARKED, strict=False):
        factor = 10.0 if name == "frequency" else (np.degrees(1.0) if name in ANGLES else 1.0)
        label = f"{in_words(name)}{' [0.1 Hz]' if name == 'frequency' else ''}"
        axes.plot(middle, factor * values, color=colour, marker=mark, ms=2.0, linewidth=0.8, label=label)
    axes.axhline(0.0, color=GREY, linewidth=0.6)
    dress(axes, "time [s]", "change [deg, 0.1 Hz]")
