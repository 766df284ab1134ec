"""Pages of stability and control: multipliers and modes, gusts with and without feedback, manoeuvres."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from wingbeat._base import heading, in_words
from wingbeat._base.style import (
    BLUE,
    FIRST,
    GREEN,
    GREY,
    MARKED,
    ORANGE,
    PAGE,
    PURPLE,
    SECOND,
    SHADE,
    THIRD,
    drawing,
    dress,
    legend_below,
    letter_panels,
    new_figure,
)
from wingbeat.animal.kinematics import ANGLES

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_KINDS = ("divergence", "oscillation", "subsidence", "flip")
_LOOK = dict(zip(_KINDS, MARKED, strict=False))
_LEGEND = {"body_pitch": "body pitch", "u": "forward velocity", "w": "upward velocity", "pitch_rate": "pitch rate"}
_PART_COLOURS = {"body_pitch": BLUE, "u": ORANGE, "w": GREEN, "pitch_rate": PURPLE}


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


@drawing()
def stability_page(records: Sequence[dict[str, Any]]) -> Figure:
    """Draw multipliers and modes of one linear flight, or of several along speed.

    Inside the shaded circle disturbances decay. Marks are small at the lowest and large at the highest speed. The
    bars show what moves in the modes of the flight nearest to the middle of the speeds.

    Parameters
    ----------
    records : of `LinearFlight.record`, at least one, of one animal.
    """
    figure = new_figure(PAGE, 68.0)
    first, several = records[0], len(records) > 1
    name = heading(first["species"])
    speeds = f"{first['speed']:g} to {records[-1]['speed']:g} m/s" if several else f"{first['speed']:g} m/s"
    figure.suptitle(f"{name} at {speeds}: multipliers of a disturbance in one beat", fontsize=8.5)
    plane, sizes, bars = figure.subplots(1, 3, width_ratios=(1, 1.1, 1))
    _draw_plane(plane, records)
    if several:
        _draw_sizes(sizes, records)
    else:
        _draw_growth(sizes, first)
    middle = 0.5 * (records[0]["speed"] + records[-1]["speed"])
    _draw_bars(bars, min(records, key=lambda record: abs(record["speed"] - middle)))
    letter_panels(figure.axes)
    legend_below(figure, [plane, sizes], columns=5)
    return figure


def _draw_plane(axes: Axes, records: Sequence[dict[str, Any]]) -> None:
    sizes = np.linspace(6.0, 30.0, len(records)) if len(records) > 1 else [20.0]
    turn = np.linspace(0.0, 2 * np.pi, 181)
    axes.fill(np.cos(turn), np.sin(turn), color=SHADE, linewidth=0, zorder=0, label="decays")
    axes.plot(np.cos(turn), np.sin(turn), color=GREY, linewidth=0.6)
    for kind, (colour, mark) in _LOOK.items():
        points = [
            (*mode["multiplier"], size)
            for record, size in zip(records, sizes, strict=True)
            for mode in record["modes"]
            if mode["kind"] == kind
        ]
        if points:
            real, imaginary, size = np.array(points).T
            both = np.r_[real, real], np.r_[imaginary, -imaginary]
            axes.scatter(*both, s=np.r_[size, size], color=colour, marker=mark, alpha=0.7, linewidths=0, label=kind)
    axes.set_aspect("equal", adjustable="datalim")
    dress(axes, "real part [-]", "imaginary part [-]")


def _draw_sizes(axes: Axes, records: Sequence[dict[str, Any]]) -> None:
    axes.axhspan(0.0, 1.0, color=SHADE, linewidth=0, zorder=0)
    for kind, (colour, mark) in _LOOK.items():
        points = [(r["speed"], mode["modulus"]) for r in records for mode in r["modes"] if mode["kind"] == kind]
        if points:
            axes.plot(*np.array(points).T, mark, color=colour, ms=3.5, mew=0)
    axes.plot(
        [r["speed"] for r in records],
        [r["averaged"]["spectral_radius"] for r in records],
        color="k",
        linewidth=0.8,
        linestyle=(0, (2, 1.5)),
        label="spectral radius of the averaged model",
    )
    axes.set_ylim(bottom=0.0)
    dress(axes, "speed [m/s]", "modulus of the multiplier [-]")


def _draw_growth(axes: Axes, record: dict[str, Any]) -> None:
    """Draw the size of each mode over the first beats."""
    beats = np.arange(9)
    for mode in record["modes"]:
        colour, mark = _LOOK[mode["kind"]]
        axes.plot(beats * record["dt"], mode["modulus"] ** beats, color=colour, marker=mark, ms=3, linewidth=0.9)
    axes.axhline(1.0, color=GREY, linewidth=0.6)
    axes.set_yscale("log")
    axes.set(xlabel="time [s]", ylabel="disturbance over its initial size [-]")


def _draw_bars(axes: Axes, record: dict[str, Any]) -> None:
    modes = record["modes"]
    left = np.zeros(len(modes))
    for part, label in _LEGEND.items():
        widths = np.array([mode["shares"][part] for mode in modes])
        axes.barh(range(len(modes)), widths, left=left, height=0.6, color=_PART_COLOURS[part], label=label)
        left += widths
    axes.set_yticks(range(len(modes)), [f"{mode['kind']}\n{mode['modulus']:.3f}" for mode in modes])
    axes.set(xlim=(0, 1), ylim=(len(modes) - 0.4, -0.9), xlabel=f"share at {record['speed']:g} m/s [-]")
    axes.legend(loc="upper center", ncols=2, fontsize=6, bbox_to_anchor=(0.45, 1.2), handlelength=0.9)


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
    plan: _Plan,
    flights: Mapping[str, _Flown],
    column: int,
    label: str,
    factor: float = 1.0,
    climb: float = 0.0,
) -> None:
    start = float(plan.beat_map.orbit.initial_state.z)

    def planned(time: np.ndarray) -> np.ndarray:
        return np.interp(time, plan.times, plan.states[:, 1])

    for (name, flight), line in zip(flights.items(), _MANOEUVRE_LINES, strict=False):
        tops = slice(None, None, (len(flight.time) - 1) // len(flight.wingbeats))
        time, values = flight.time[tops], flight.states[tops, column + 1]
        if column == 0:
            values = values - start - climb * time
        shown = np.cumprod(np.abs(flight.states[tops, 2] - planned(time)) < _LOST).astype(bool)
        axes.plot(time[shown], factor * values[shown], label=name, **line)
    axes.plot(plan.times, factor * plan.states[:, column], ".", color="k", ms=2.0, label="plan", zorder=3)
    dress(axes, "time [s]", label)


def _draw_changes(axes: Axes, plan: _Plan) -> None:
    middle = 0.5 * (plan.times[1:] + plan.times[:-1])
    for name, values, (colour, mark) in zip(plan.inputs, plan.changes.T, MARKED, strict=False):
        factor = 10.0 if name == "frequency" else (np.degrees(1.0) if name in ANGLES else 1.0)
        label = f"{in_words(name)}{' [0.1 Hz]' if name == 'frequency' else ''}"
        axes.plot(middle, factor * values, color=colour, marker=mark, ms=2.0, linewidth=0.8, label=label)
    axes.axhline(0.0, color=GREY, linewidth=0.6)
    dress(axes, "time [s]", "change [deg, 0.1 Hz]")
