"""Pages of stability and control: multipliers and modes, gusts with and without feedback, manoeuvres."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from wingbeat._base import heading, in_words
from wingbeat._base.style import (
    FIRST,
    GREY,
    MARKED,
    ORANGE,
    PAGE,
    SECOND,
    SHADE,
    SKY,
    THIRD,
    drawing,
    dress,
    legend_below,
    letter_panels,
    new_figure,
)
from wingbeat.animal.kinematics import ANGLES
from wingbeat.records.judgements import conditions_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


class _Flown(Protocol):
    """What the pages ask of a `Flight`."""

    @property
    def time(self) -> Any: ...  # kept once computed, which no array's property is
    @property
    def states(self) -> np.ndarray: ...
    @property
    def wingbeats(self) -> Sequence[Any]: ...
    @property
    def air(self) -> np.ndarray | None: ...


class _GustFlown(Protocol):
    """What the pages ask of a `GustFlight`."""

    @property
    def flight(self) -> _Flown: ...
    @property
    def pitch(self) -> np.ndarray: ...
    @property
    def height(self) -> np.ndarray: ...


class _Survey(Protocol):
    """What the pages ask of a `GustSurvey`."""

    @property
    def size(self) -> np.ndarray: ...
    @property
    def survived(self) -> dict[str, np.ndarray]: ...
    def by_size(self, name: str) -> tuple[np.ndarray, np.ndarray]: ...
    def by_direction(self, name: str) -> tuple[np.ndarray, np.ndarray]: ...


class _Plan(Protocol):
    """What the pages ask of a `Manoeuvre`."""

    @property
    def beat_map(self) -> Any: ...
    @property
    def ends(self) -> Sequence[Any]: ...
    @property
    def inputs(self) -> tuple[str, ...]: ...
    @property
    def times(self) -> np.ndarray: ...
    @property
    def states(self) -> np.ndarray: ...
    @property
    def changes(self) -> np.ndarray: ...


_LOOK = dict(zip(("divergence", "oscillation", "subsidence", "flip"), MARKED, strict=False))
# Names and colours of what moves in a mode; the colours are no mode's.
_PARTS = {"body_pitch": ("body pitch", "0.3"), "u": ("forward velocity", SKY)}
_PARTS |= {"w": ("upward velocity", ORANGE), "pitch_rate": ("pitch rate", "0.75")}


@drawing()
def stability_page(records: Sequence[dict[str, Any]]) -> Figure:
    """Draw multipliers and modes of one linear flight, or of several along speed.

    Inside the shaded circle disturbances decay. Marks are small at the lowest and large at the highest speed. The
    bars show what moves in the modes of the flight nearest to the middle of the speeds.

    Parameters
    ----------
    records : of `LinearFlight.record`, at least one, of one animal.
    """
    figure = new_figure(PAGE, 74.0)
    first, last, several = records[0], records[-1], len(records) > 1
    speeds = f"{first['speed']:g} to {last['speed']:g} m/s" if several else f"{first['speed']:g} m/s"
    title = f"{heading(first['species'])} at {speeds}{conditions_of(first)}: "
    title += "what a disturbance is multiplied by in one beat"
    figure.suptitle(title + ("; marks grow with speed" if several else ""), fontsize=8.5)
    plane, sizes, bars = figure.subplots(1, 3, width_ratios=(1, 1.1, 1))
    turn = np.linspace(0.0, 2 * np.pi, 181)
    plane.fill(np.cos(turn), np.sin(turn), color=SHADE, linewidth=0, zorder=0, label="disturbance decays")
    plane.plot(np.cos(turn), np.sin(turn), color=GREY, linewidth=0.6)
    areas = np.linspace(6.0, 30.0, len(records)) if several else [20.0]
    for kind, (colour, mark) in _LOOK.items():
        found = [
            (*mode["multiplier"], area, record["speed"], mode["modulus"])
            for record, area in zip(records, areas, strict=True)
            for mode in record["modes"]
            if mode["kind"] == kind
        ]
        if found:
            real, imaginary, area, speed, modulus = np.array(found).T
            both = np.r_[real, real], np.r_[imaginary, -imaginary]
            look: dict[str, Any] = {"color": colour, "marker": mark}
            plane.scatter(*both, s=np.r_[area, area], alpha=0.7, linewidths=0, label=kind, **look)
            if several:
                sizes.plot(speed, modulus, linestyle="", ms=3.5, mew=0, **look)
    plane.set_aspect("equal", adjustable="datalim")
    dress(plane, "multiplier, real part [-]", "multiplier, imaginary part [-]")
    if several:
        sizes.axhspan(0.0, 1.0, color=SHADE, linewidth=0, zorder=0)
        sizes.set_ylim(bottom=0.0)
        dress(sizes, "speed [m/s]", "modulus of the multiplier [-]")
    else:  # the size of each mode over the first beats
        beats = np.arange(9)
        for mode in first["modes"]:
            colour, mark = _LOOK[mode["kind"]]
            sizes.plot(
                beats * first["dt"], mode["modulus"] ** beats, color=colour, marker=mark, ms=3, linewidth=0.9
            )
        sizes.axhline(1.0, color=GREY, linewidth=0.6)
        sizes.set(yscale="log", xlabel="time [s]", ylabel="size over initial size [-]")
    middle = min(records, key=lambda record: abs(record["speed"] - 0.5 * (first["speed"] + last["speed"])))
    modes = middle["modes"]
    left = np.zeros(len(modes))
    for part, (label, colour) in _PARTS.items():
        widths = np.array([mode["shares"][part] for mode in modes])
        bars.barh(range(len(modes)), widths, left=left, height=0.6, color=colour, label=label)
        left += widths
    bars.set_yticks(range(len(modes)), [f"{mode['kind']}\n{mode['modulus']:.3f}" for mode in modes])
    bars.invert_yaxis()
    bars.set(xlim=(0, 1), xlabel=f"share of the motion at {middle['speed']:g} m/s [-]")
    letter_panels(figure.axes)
    legend_below(figure, [plane, bars], columns=4)
    return figure


_GUST_LINES = (SECOND, FIRST, THIRD)
# Largest deviation of body pitch that the panel shows [deg]; a flight with a larger deviation is lost.
_SHOWN = 60.0


@drawing()
def gust_page(flights: Mapping[str, _GustFlown], survey: _Survey | None = None, title: str = "") -> Figure:
    """Draw body pitch and height of flights through one gust, and the share of gusts that are survived.

    The shade is the time of the gust. Lines end where a flight is lost.

    Parameters
    ----------
    flights : through the same wind, by names, at most three.
    survey : with feedbacks of the same names; with None, its panels are left out.
    title : above the panels, such as the animal and its speed.
    """
    figure = new_figure(PAGE, 62.0)
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
def survey_page(survey: _Survey) -> Figure:
    """Draw the share of gusts that are survived, by their size and by their direction.

    Parameters
    ----------
    survey : from `survey_gusts`, with at most three feedbacks.
    """
    figure = new_figure(PAGE, 62.0)
    panels = figure.subplots(1, 2)
    _draw_shares(panels[0], panels[1], survey)
    letter_panels(figure.axes)
    legend_below(figure, [panels[0]], columns=3)
    return figure


def _draw_flights(pitch: Axes, height: Axes, flights: Mapping[str, _GustFlown]) -> None:
    for nth, ((name, one), line) in enumerate(zip(flights.items(), _GUST_LINES, strict=False)):
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


def _draw_shares(sizes: Axes, directions: Axes, survey: _Survey) -> None:
    for name, line in zip(survey.survived, _GUST_LINES, strict=False):
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


# A flight whose body pitch differs by this much from the plan is lost, and its lines end [rad].
_LOST = np.pi / 3
_MANOEUVRE_LINES = (FIRST, SECOND, THIRD)


@drawing()
def manoeuvre_page(plan: _Plan, flights: Mapping[str, _Flown]) -> Figure:
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
    speeds = " to ".join(f"{speed:g}" for speed in (orbit.inputs["speed"], *(end.speed for end in plan.ends)))
    title = f"{heading(str(orbit.inputs['species']['name']))}{conditions_of(orbit.record())}: from {speeds} m/s"
    figure.suptitle(title, fontsize=8.5, parse_math=False)
    panels = figure.subplots(2, 2).ravel()
    states = (
        (2, "forward velocity u [m/s]", 1.0),
        (1, "body pitch [deg]", np.degrees(1.0)),
        (0, "height above the path [m]", 1.0),
    )
    for axes, (column, label, factor) in zip(panels, states, strict=False):
        for (name, flight), line in zip(flights.items(), _MANOEUVRE_LINES, strict=False):
            tops = slice(None, None, (len(flight.time) - 1) // len(flight.wingbeats))
            time, values = flight.time[tops], flight.states[tops, column + 1]
            if column == 0:
                values = values - float(orbit.initial_state.z) - plan.beat_map.climb * time
            off = np.abs(flight.states[tops, 2] - np.interp(time, plan.times, plan.states[:, 1]))
            shown = np.cumprod(off < _LOST).astype(bool)
            axes.plot(time[shown], factor * values[shown], label=name, **line)
        axes.plot(plan.times, factor * plan.states[:, column], ".", color="k", ms=3.0, label="plan", zorder=1)
        dress(axes, "time [s]", label)
    middle = 0.5 * (plan.times[1:] + plan.times[:-1])
    for name, values, (colour, mark) in zip(plan.inputs, plan.changes.T, MARKED, strict=False):
        factor = 10.0 if name == "frequency" else (np.degrees(1.0) if name in ANGLES else 1.0)
        label = f"{in_words(name)}{' [0.1 Hz]' if name == 'frequency' else ''}"
        look: dict[str, Any] = {"color": colour, "marker": mark, "ms": 3.0, "linewidth": 0.8, "label": label}
        panels[3].plot(middle, factor * values, markevery=max(1, len(middle) // 12), **look)
    panels[3].axhline(0.0, color=GREY, linewidth=0.6)
    dress(panels[3], "time [s]", "change [deg, or 0.1 Hz]")
    letter_panels(figure.axes)
    legend_below(figure, [panels[0], panels[3]], columns=4)
    return figure
