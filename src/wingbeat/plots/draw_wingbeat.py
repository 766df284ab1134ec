"""One page of a wingbeat or a flight: nine panels and a title above them."""

from __future__ import annotations

import json
import math
import textwrap
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import FaultList, climb_text, heading, in_words
from wingbeat._base.datasets import downstrokes, flown
from wingbeat._base.style import (
    ALARM,
    FIRST,
    FONT,
    GOOD,
    PAGE,
    SECOND,
    THIRD,
    drawing,
    dress,
    legend_above,
    letter_panels,
    new_figure,
    shade_downstrokes,
)
from wingbeat.records.judgements import conditions_of, statements
from wingbeat.words.orbit_words import frequency_in_words, limits_in_words, mass_of, other_frequency

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_PANELS, _LINE = 148.0, 4.0  # mm: three rows of panels, a line of text
_TITLE, _TEXT = {"fontsize": 9, "fontweight": "bold"}, {"fontsize": 7.5}
_GOOD, _ALARM = {**_TEXT, "color": GOOD}, {**_TEXT, "color": ALARM}
_NEEDED = ["flap", "wing_pitch", "fold", "span_ratio", "time", "x", "z", "u", "w", "body_pitch", "pitch_rate"]
_NEEDED += ["alpha", "strip_force", "hinge_power", "actuator_power"]


def wingbeat_page(dataset: xr.Dataset) -> Figure:
    """Draw one page, 183 mm wide, of an orbit's or a flight's time series; downstrokes are shaded.

    a: wing kinematics; b: body pitch; c: power; d to f: phase portraits; g: effective angle of attack; h and i:
    horizontal and vertical force on the strips at 1/4 and 3/4 of the span, both wings together, divided by the
    weight. A legend above the middle panel of a row holds for the row. Two statements at the top say how well a
    certified orbit closes and whether it is plausible. Both are green if the orbit is plausible; otherwise the
    second is red. Without a certificate, one red line gives the reason.

    Parameters
    ----------
    dataset : `Orbit.dataset`, `Flight.dataset` or one read from a file.

    Raises
    ------
    InvalidInputError : the dataset is neither an orbit nor a flight, or lacks a quantity.

    >>> import wingbeat as wb
    >>> pigeon = wb.load_species("pigeon")
    >>> model = wb.FlightModel(pigeon.vehicle, wb.aero.BladeElement(wb.aero.SuFan()))
    >>> flight = wb.simulate(model, pigeon.wingbeat, wb.State(u=10.0))
    >>> page = wb.plots.wingbeat_page(flight.dataset)
    >>> f"{25.4 * page.get_figwidth():.0f} mm wide"
    '183 mm wide'
    """
    lines, weight = _described(dataset)
    height = 2.5 + _LINE * len(lines) + _PANELS
    with drawing():
        figure = new_figure(PAGE, height)
        layout: Any = figure.get_layout_engine()
        layout.set(rect=(0, 0, 1, _PANELS / height), w_pad=0.04, h_pad=0.04, wspace=0, hspace=0.02)
        for i, (text, style) in enumerate(lines):
            # A name that the user chose may hold a dollar sign, which must not start a formula.
            where = (2 / PAGE, 1 - (1.5 + _LINE * i) / height)
            figure.text(*where, text, va="top", parse_math=False, **style)
        panels = figure.subplots(3, 3)
        draw_motion(dataset, panels[0])
        draw_portraits(dataset, panels[1])
        draw_loads(dataset, panels[2], weight)
        figure.align_ylabels(panels)
        letter_panels(panels)
    return figure


def _described(dataset: xr.Dataset) -> tuple[list[tuple[str, dict[str, Any]]], float]:
    """Return the lines above the panels with their styles, and the weight [N]; refuse a dataset not of wingbeat."""
    faults = FaultList()
    kind = dataset.attrs.get("wingbeat_kind")
    if kind not in ("orbit", "flight"):
        faults.add("dataset", kind, "is neither an orbit nor a flight of wingbeat", "give orbit.dataset")
    elif missing := [name for name in _NEEDED if name not in dataset]:
        faults.add("dataset", missing, "is missing from the dataset", "solve the orbit or fly the flight again")
    faults.raise_if_any()
    try:
        vehicle, air, beat = (json.loads(dataset.attrs[name]) for name in ("vehicle", "air", "wingbeat"))
        weight = mass_of(vehicle) * air["gravity"]
        title = _orbit_title if kind == "orbit" else _flight_title
        mean = mean_power(dataset)
        power = "" if mean is None else f", mean hinge power {mean:.3g} W"
        return title(dataset, f"{beat['frequency']:.4g} Hz{power}"), weight
    except (KeyError, TypeError, ValueError) as error:
        faults.add("attributes", str(error), "cannot be understood", "solve the orbit or fly the flight again")
    faults.raise_if_any()
    raise AssertionError


# What the two statements on an orbit, and what its limits have set, are read from, beside status and objective.
_READ = ("closure", "plausibility", "active_bounds", "wingbeat", "warnings")


def _orbit_title(dataset: xr.Dataset, frequency: str) -> list[tuple[str, dict[str, Any]]]:
    about = dataset.attrs
    aero = json.loads(about["aero"])
    first = f"{heading(about['species'])} at {about['speed']:.4g} m/s{climb_text(about['climb'])}, {frequency}"
    names = f"{in_words(aero['coefficients'])}, {in_words(aero['extension'])}"
    loads = f"Air loads: {names}, {aero['strips']} strips per wing"
    second = f"{loads}; minimised: {in_words(about['objective'])}"
    if about["status"] == "converged":
        # Files of early versions have no `plausibility`.
        record = {name: json.loads(about.get(name, "null")) for name in _READ}
        record |= {name: about[name] for name in ("status", "objective", "frequency_basis") if name in about}
        said = statements(record)
        parts = [(f"Certified: {said.closes}", _GOOD if said.good else _TEXT)]
        parts.append((said.plausible[:1].upper() + said.plausible[1:], _GOOD if said.good else _ALARM))
        if frequency := frequency_in_words(record):
            parts.append((f"Given, not predicted: {frequency}", _TEXT))
        parts += [(note[:1].upper() + note[1:], _ALARM) for note in other_frequency(record)]
        if limits := limits_in_words(record):
            parts.append((f"Set by limits, not predicted: {limits}", _TEXT))
    else:
        parts = [(f"NOT CERTIFIED ({about['status']}): {about['message']}", _ALARM)]
    lines = [(line, look) for text, look in ((second, _TEXT), *parts) for line in textwrap.wrap(text, 120)]
    there = conditions_of(about).removeprefix(", ")
    return [(first, _TITLE), *([(there[:1].upper() + there[1:], _TEXT)] if there else []), *lines]


def _flight_title(dataset: xr.Dataset, frequency: str) -> list[tuple[str, dict[str, Any]]]:
    phase, reached = dataset["phase"].values, flown(dataset)
    first = f"Flight of {phase[-1]:g} beats, starting at {float(dataset['u'][0]):.4g} m/s, {frequency}"
    if reached.all():
        return [(first, _TITLE)]
    end = phase[reached][-1] if reached.any() else 0.0
    return [(first, _TITLE), (f"NOT FINISHED: the vehicle tumbled after {end:.3g} beats", _ALARM)]


_MEAN: dict[str, Any] = {"color": "0.35", "linestyle": "-.", "linewidth": 0.8}


def mean_power(dataset: xr.Dataset) -> float | None:
    """Return the mean hinge power over the flown samples [W]; None if there are none."""
    reached = flown(dataset)
    phase, power = dataset["phase"].values[reached], dataset["hinge_power"].values[reached]
    return float(np.trapezoid(power, phase) / np.ptp(phase)) if len(phase) > 1 else None


def draw_motion(dataset: xr.Dataset, panels: Any) -> None:
    """Draw wing kinematics, body pitch and power."""
    wing, pitch, power = panels
    phase = dataset["phase"].values
    _over_phase(wing, dataset, "wing angles [deg]")
    curves = [("flap", "flap φ", FIRST), ("wing_pitch", "pitch θ", SECOND), ("fold", "fold", THIRD)]
    for name, label, style in curves if np.ptp(dataset["fold"].values) > 1e-9 else curves[:2]:
        wing.plot(phase, np.degrees(dataset[name].values), label=label, **style)
    if "hinge_angle" in dataset:
        _draw_hinge(wing, dataset)
    lines = [line for line in wing.get_lines() if not str(line.get_label()).startswith("_")]
    if np.ptp(dataset["span_ratio"].values) > 1e-9:
        span = wing.twinx()
        span.spines["right"].set_visible(True)
        span.set(ylabel="span L/L₀ [-]", ylim=(-0.1, 1.1), yticks=(0, 0.5, 1))
        span.tick_params(labelsize=FONT, length=2, pad=2)
        dots = {**THIRD, "linestyle": (0, (3, 1, 1, 1))}
        lines = [*lines, *span.plot(phase, dataset["span_ratio"].values, label="span", **dots)]
    legend_above(wing, lines)
    _over_phase(pitch, dataset, "body pitch ψ [deg]")
    pitch.plot(phase, np.degrees(dataset["body_pitch"].values), **FIRST)
    pitch.collections[0].set_label("time of the downstroke")
    legend_above(pitch, pitch.collections[:1])
    _over_phase(power, dataset, "power of both wings [W]")
    lines = power.plot(phase, dataset["hinge_power"].values, label="hinge", **FIRST)
    lines += power.plot(phase, dataset["actuator_power"].values, label="actuator", **SECOND)
    mean = mean_power(dataset)
    legend_above(power, lines + ([] if mean is None else [power.axhline(mean, label="mean", **_MEAN)]))
    for axes in panels:
        _clear_corner(axes)


def _draw_hinge(axes: Axes, dataset: xr.Dataset) -> None:
    """Draw the angle of a hinge that gives way and at rest; in place of the pitch, unless the wing twists."""
    phase, beat = dataset["phase"].values, json.loads(dataset.attrs["wingbeat"])
    angle, style, twists = np.degrees(dataset["hinge_angle"].values), SECOND, beat["hinge_twist_share"]
    if twists:
        style = THIRD
    else:
        axes.get_lines()[1].remove()
    axes.plot(phase, angle, label="tip twist" if twists == 1 else "hinge θ", **style)
    rest = math.degrees(beat["hinge_rest_angle"])
    axes.axhline(rest, label="at rest", **_MEAN)
    if beat["hinge_stop_stiffness"]:
        stop = math.degrees(beat["hinge_stop_angle"])
        low, high = axes.get_ylim()
        for i, at in enumerate(at for at in (-stop, stop) if low < at < high):
            axes.axhline(at, color=ALARM, linewidth=0.5, label="_" if i else "stops")


def draw_portraits(dataset: xr.Dataset, panels: Any) -> None:
    """Draw velocity against position for the three degrees of freedom, marked where the strokes begin."""
    from matplotlib.legend_handler import HandlerTuple

    x, z = dataset["x"].values, dataset["z"].values
    # In millimetres if all are short.
    (x, x_unit), (z, z_unit) = ((1e3 * v, "mm") if np.fmax.reduce(np.abs(v)) < 0.5 else (v, "m") for v in (x, z))
    u, w = dataset["u"].values, dataset["w"].values
    pitch, rate = np.degrees(dataset["body_pitch"].values), np.degrees(dataset["pitch_rate"].values)
    phase, time, reached = dataset["phase"].values, dataset["time"].values, flown(dataset)
    strokes = downstrokes(phase, dataset["flap_rate"].values)
    dress(panels[0], f"displacement x [{x_unit}]", "forward velocity u [m/s]")
    dress(panels[1], f"height z [{z_unit}]", "upward velocity w [m/s]")
    dress(panels[2], "body pitch ψ [deg]", "pitch rate q [deg/s]")
    _portrait(panels[0], phase, x, u, strokes)
    lines, _ = _portrait(panels[1], phase, z, w, strokes)
    _, marks = _portrait(panels[2], phase, pitch, rate, strokes)
    if reached.sum() > 1:
        # The mean advance: what a closed orbit gains in a beat.
        first, last = np.flatnonzero(reached)[[0, -1]]
        mean = (dataset["x"].values[last] - dataset["x"].values[first]) / (time[last] - time[first])
        advance = (x[last] - x[first]) / (phase[last] - phase[first])
        label = f"mean {mean:.4g} m/s, {advance:.3g} {x_unit} a beat"
        legend_above(panels[0], panels[0].plot([x[first], x[last]], [mean, mean], label=label, **_MEAN))
    legend_above(panels[1], lines)
    starts = {"labels": ["start of down- and upstroke"], "handler_map": {tuple: HandlerTuple(None)}}
    legend_above(panels[2], [tuple(marks)], **starts)


def _portrait(
    axes: Axes, phase: np.ndarray, place: np.ndarray, speed: np.ndarray, strokes: Sequence[tuple[float, float]]
) -> tuple[list, list]:
    """Draw one portrait; return the lines of both strokes and the marks of their starts."""
    axes.locator_params(axis="x", nbins=5)
    axes.margins(0.08)
    down = np.zeros(len(phase), dtype=bool)
    for first, last in strokes:
        down |= (first <= phase) & (phase < last)
    lines = []
    for mask, label, style in ((down, "downstroke", FIRST), (~down, "upstroke", SECOND)):
        # Each piece between two samples belongs to the stroke of the first of them.
        on = mask | np.concatenate([[False], mask[:-1]])
        lines += axes.plot(place, np.where(on, speed, np.nan), label=label, **style)
    size = 1.0 if phase[-1] - phase[0] <= 6 else 0.6
    beats = phase[-1] - np.array([first for first, _ in strokes])
    at_the_top = np.any(np.abs(beats - np.round(beats)) < 1e-9)  # whole beats after the start of a downstroke
    tops = sorted({first for first, _ in strokes} | ({phase[-1]} if at_the_top else set()))
    marks = []
    for starts, marker, points in ((tops, (8, 2, 0), 7), ([last for _, last in strokes], "o", 4)):
        look = {"linestyle": "", "marker": marker, "markersize": size * points, "mew": 0.9 * size}
        at = [np.interp(starts, phase, values) for values in (place, speed)]
        marks += axes.plot(*at, color="k", zorder=3, **look)
    return lines, marks


def draw_loads(dataset: xr.Dataset, panels: Any, weight: float) -> None:
    """Draw effective angle of attack and force at 1/4 and 3/4 of the span."""
    phase, place = dataset["phase"].values, dataset["station"].values
    force = 2 * dataset["strip_force"].sel(axis=["x", "z"]).values / (weight or math.nan)
    alpha = np.unwrap(dataset["alpha"].values, axis=1)
    for axes, strips, label in (
        (panels[0], alpha, "angle of attack α [deg]"),
        (panels[1], force[..., 0], "horizontal force / weight [-]"),
        (panels[2], force[..., 1], "vertical force / weight [-]"),
    ):
        _over_phase(axes, dataset, label)
        if flown(dataset).any():  # without data, this line would set limits of some 1e-17
            axes.axhline(0, color=_MEAN["color"], linewidth=0.5)
        for station, name, style in ((0.25, "1/4 span", FIRST), (0.75, "3/4 span", SECOND)):
            # Strip centres need not lie at these span fractions: we interpolate linearly between centres.
            # Beyond the last centre, we take its value.
            line = strips @ np.array([np.interp(station, place, one) for one in np.eye(len(place))])
            if strips is alpha:  # within half a turn of 0, with a gap where a tumbling wing passes +-180 degrees
                line = np.mod(np.degrees(line) + 180.0, 360.0) - 180.0
                line = np.where(np.abs(np.diff(line, prepend=line[:1])) > 180.0, np.nan, line)
            axes.plot(phase, line, label=name, **style)
        _clear_corner(axes)
    legend_above(panels[1], panels[1].get_lines()[-2:])


def _clear_corner(axes: Axes) -> None:
    """Leave room below the lowest tick, so that its label does not meet the label of the first phase."""
    low, high = axes.get_ylim()
    room = 0.06 * (high - low)
    lowest = min((tick for tick in axes.get_yticks() if low <= tick <= high), default=high)
    axes.set_ylim(min(low, lowest - room), high)


def _over_phase(axes: Axes, dataset: xr.Dataset, ylabel: str) -> None:
    """Prepare a panel over phase with every downstroke shaded."""
    dress(axes, "phase t/T [-]", ylabel)
    phase = dataset["phase"].values
    # The wing's motion is prescribed, so its strokes go on where a flight ended.
    shade_downstrokes(axes, phase[0], phase[-1], downstrokes(phase, dataset["flap_rate"].values))
