"""Flights through a gust with and without feedback, and the share of gusts that are survived."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base.style import (
    FIRST,
    GREY,
    PAGE,
    SECOND,
    SHADE,
    THIRD,
    drawing,
    dress,
    legend_below,
    letter_panels,
)
from wingbeat._base.style import new_figure as new_page
from wingbeat.stability.gust_flight import GustFlight
from wingbeat.stability.gust_survey import GustSurvey

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_LINES = (SECOND, FIRST, THIRD)
# Largest deviation of body pitch that the panel shows [deg]; a flight with a larger deviation is lost.
_SHOWN = 60.0


@drawing()
def gust_page(flights: Mapping[str, GustFlight], survey: GustSurvey | None = None, title: str = "") -> Figure:
    """Draw body pitch and height of flights through one gust, and the share of gusts that are survived.

    The shade is the time of the gust. Lines end where a flight is lost.

    Parameters
    ----------
    flights : through the same wind, by names, at most three.
    survey : with feedbacks of the same names; with None, its panels are left out.
    title : above the panels, such as the animal and its speed.
    """
    figure = new_page(PAGE, 62.0)
    if title:
        figure.suptitle(title, fontsize=8, x=0.01, ha="left")
    panels = figure.subplots(1, 4 if survey is not None else 2)
    _draw_flights(panels[0], panels[1], flights)
    if survey is not None:
        _draw_shares(panels[2], panels[3], survey)
    letter_panels(figure.axes)
    legend_below(figure, [panels[0]], columns=3)
    return figure


@drawing()
def survey_page(survey: GustSurvey) -> Figure:
    """Draw the share of gusts that are survived, by their size and by their direction.

    Parameters
    ----------
    survey : from `survey_gusts`, with at most three feedbacks.
    """
    figure = new_page(PAGE, 62.0)
    panels = figure.subplots(1, 2)
    _draw_shares(panels[0], panels[1], survey)
    letter_panels(figure.axes)
    legend_below(figure, [panels[0]], columns=3)
    return figure


def _draw_flights(pitch: Axes, height: Axes, flights: Mapping[str, GustFlight]) -> None:
    for nth, ((name, one), line) in enumerate(zip(flights.items(), _LINES, strict=False)):
        # The first line is dashed, and above the others: where flights are equal, both are seen.
        look: dict[str, Any] = line | {"zorder": 3.0 - 0.1 * nth}
        time = one.flight.time
        samples = (len(time) - 1) // len(one.flight.wingbeats)
        degrees = np.degrees(one.pitch)
        lost = np.flatnonzero(~(np.abs(degrees) <= _SHOWN))
        end = int(lost[0]) if len(lost) else len(time)
        pitch.plot(time[:end], degrees[:end], label=name, **look)
        tops = np.arange(len(one.height))
        kept = tops[tops * samples < end]
        height.plot(time[kept * samples], one.height[kept], label=name, **look)
    first = next(iter(flights.values())).flight
    if first.air is not None:
        blows = np.hypot(*first.air.T) > 0
        if blows.any() and not blows.all():
            span = first.time[blows][0], first.time[blows][-1]
            for panel in (pitch, height):
                panel.axvspan(*span, color=SHADE, linewidth=0, zorder=0, label="time of the gust")
    for panel in (pitch, height):
        panel.axhline(0.0, color=GREY, linewidth=0.6)
    dress(pitch, "time [s]", "deviation of body pitch [deg]")
    dress(height, "time [s]", "height above the path [m]")


def _draw_shares(sizes: Axes, directions: Axes, survey: GustSurvey) -> None:
    for name, line in zip(survey.survived, _LINES, strict=False):
        edges, shares = survey.by_size(name)
        sizes.plot(0.5 * (edges[1:] + edges[:-1]), 100.0 * shares, label=name, **line)
        edges, shares = survey.by_direction(name)
        directions.plot(np.degrees(0.5 * (edges[1:] + edges[:-1])), 100.0 * shares, label=name, **line)
    for panel in (sizes, directions):
        panel.set_ylim(-3.0, 103.0)
    dress(sizes, "largest velocity of the gust [m/s]", f"survived of {len(survey.size)} gusts [%]")
    dress(directions, "direction of the gust [deg]\n0 forward, 90 up, 180 backward", "survived [%]")
    sizes.set_xlim(0.0, math.ceil(float(survey.size.max())))
    directions.set_xlim(0.0, 360.0)
    directions.set_xticks([0, 90, 180, 270, 360])
