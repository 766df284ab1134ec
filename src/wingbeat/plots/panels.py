"""The panels of a page: what is drawn in each, in the units of its axes."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base.datasets import downstrokes, flown
from wingbeat._base.style import FIRST, FONT, SECOND, THIRD, dress, legend_above, shade_downstrokes

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes

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
    lines = wing.get_lines()
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
    _over_phase(power, dataset, "power of both wings [W]")
    lines = power.plot(phase, dataset["hinge_power"].values, label="hinge", **FIRST)
    lines += power.plot(phase, dataset["actuator_power"].values, label="actuator", **SECOND)
    mean = mean_power(dataset)
    legend_above(power, lines + ([] if mean is None else [power.axhline(mean, label="mean", **_MEAN)]))
    for axes in panels:
        _clear_corner(axes)


def draw_portraits(dataset: xr.Dataset, panels: Any) -> None:
    """Draw velocity against position for the three degrees of freedom, marked where the strokes begin."""
    from matplotlib.legend_handler import HandlerTuple

    (x, x_unit), (z, z_unit) = _length(dataset["x"].values), _length(dataset["z"].values)
    u, w = dataset["u"].values, dataset["w"].values
    pitch, rate = np.degrees(dataset["body_pitch"].values), np.degrees(dataset["pitch_rate"].values)
    phase, time, reached = dataset["phase"].values, dataset["time"].values, flown(dataset)
    strokes = _strokes(dataset)
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
    axes: Axes,
    phase: np.ndarray,
    place: np.ndarray,
    speed: np.ndarray,
    strokes: Sequence[tuple[float, float]],
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
    tops = sorted({first for first, _ in strokes} | ({phase[-1]} if _ends_at_the_top(phase, strokes) else set()))
    marks = []
    for starts, marker, points in ((tops, (8, 2, 0), 7), ([last for _, last in strokes], "o", 4)):
        look = {"linestyle": "", "marker": marker, "markersize": size * points, "mew": 0.9 * size}
        at = [np.interp(starts, phase, values) for values in (place, speed)]
        marks += axes.plot(*at, color="k", zorder=3, **look)
    return lines, marks


def _ends_at_the_top(phase: np.ndarray, strokes: Sequence[tuple[float, float]]) -> bool:
    """Say whether the last sample is a whole number of beats after the start of a downstroke."""
    beats = phase[-1] - np.array([first for first, _ in strokes])
    return bool(np.any(np.abs(beats - np.round(beats)) < 1e-9))


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
            axes.plot(phase, _turned(line) if strips is alpha else line, label=name, **style)
        legend_above(axes, axes.get_lines()[-2:])
        _clear_corner(axes)


def _clear_corner(axes: Axes) -> None:
    """Leave room below the lowest tick, so that its label does not meet the label of the first phase."""
    low, high = axes.get_ylim()
    room = 0.06 * (high - low)
    lowest = min((tick for tick in axes.get_yticks() if low <= tick <= high), default=high)
    axes.set_ylim(min(low, lowest - room), high)


def _length(values: np.ndarray) -> tuple[np.ndarray, str]:
    """Return lengths in metres, or in millimetres if all are short; return the unit too."""
    return (1e3 * values, "mm") if np.fmax.reduce(np.abs(values)) < 0.5 else (values, "m")


def _turned(angle: np.ndarray) -> np.ndarray:
    """Return angles within half a turn of 0 [deg], with a gap where a tumbling wing passes +-180 degrees."""
    degrees = np.mod(np.degrees(angle) + 180.0, 360.0) - 180.0
    return np.where(np.abs(np.diff(degrees, prepend=degrees[:1])) > 180.0, np.nan, degrees)


def _strokes(dataset: xr.Dataset) -> list[tuple[float, float]]:
    """Return the phases of the downstrokes; the wing's motion is prescribed, so it goes on where a flight ended."""
    return downstrokes(dataset["phase"].values, dataset["flap_rate"].values)


def _over_phase(axes: Axes, dataset: xr.Dataset, ylabel: str) -> None:
    """Prepare a panel over phase with every downstroke shaded."""
    dress(axes, "phase t/T [-]", ylabel)
    phase = dataset["phase"].values
    shade_downstrokes(axes, phase[0], phase[-1], _strokes(dataset))
