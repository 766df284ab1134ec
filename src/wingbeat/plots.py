"""The page that shows one wingbeat, or a flight of several, and how figures are saved."""

from __future__ import annotations

import json
import math
import os
import textwrap
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat.errors import FaultList
from wingbeat.files import writing

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["FIGURE_SUFFIXES", "check_figure_name", "save_figure", "wingbeat_page"]

FIGURE_SUFFIXES = (".png", ".pdf", ".svg")

_WIDTH, _PANELS, _LINE = (
    183.0,
    148.0,
    4.0,
)  # mm: two columns of a journal, three rows of panels, a line of text
_INCH = 25.4
# Okabe and Ito's colours, told apart by colour-blind eyes, each with a dash of its own for grey prints.
_FIRST = {"color": "#0072B2", "linestyle": "-"}
_SECOND = {"color": "#D55E00", "linestyle": (0, (4, 1.5))}
_THIRD = {"color": "#009E73", "linestyle": (0, (1, 1))}
_MEAN = {"color": "0.35", "linestyle": "-.", "linewidth": 0.8}
_SHADE, _RED = "0.91", "#C00000"
_STYLE: dict[str, Any] = {"font.family": "sans-serif", "font.size": 7, "lines.linewidth": 1.1}
_STYLE |= {"axes.labelpad": 2, "axes.linewidth": 0.6, "axes.spines.top": False, "axes.spines.right": False}
# Without pieces, the line of a flight of thousands of beats is too long for the PNG writer.
_SAVING: dict[str, Any] = {"pdf.fonttype": 42, "svg.hashsalt": "wingbeat", "agg.path.chunksize": 20_000}
_NEEDED = ["flap", "wing_pitch", "fold", "span_ratio", "x", "z", "u", "w", "body_pitch", "pitch_rate"]
_NEEDED += ["alpha", "strip_force", "hinge_power", "actuator_power"]


def check_figure_name(faults: FaultList, where: str, path: str | PathLike[str]) -> None:
    """Note a fault unless the name ends like a figure that can be written."""
    if os.path.splitext(path)[1].lower() not in FIGURE_SUFFIXES:
        faults.add(where, os.fspath(path), "is no kind of figure", f"end it in {', '.join(FIGURE_SUFFIXES)}")


def save_figure(figure: Figure, path: str | PathLike[str]) -> None:
    """Write a figure as PNG (300 dots an inch), PDF or SVG, by its suffix, whole or not at all.

    The same figure gives the same bytes: no date is written. Text in a PDF stays text.

    Raises
    ------
    InvalidInputError : another suffix.
    FileError : the file cannot be written.
    """
    from matplotlib import rc_context

    faults = FaultList()
    check_figure_name(faults, "path", path)
    faults.raise_if_any()
    kind = os.path.splitext(path)[1][1:].lower()
    undated: dict[str, Any] = {"png": {}, "pdf": {"CreationDate": None}, "svg": {"Date": None}}[kind]
    with rc_context(_SAVING), writing(path) as beside:  # type: ignore[arg-type]
        figure.savefig(beside, format=kind, dpi=300, metadata=undated)


def wingbeat_page(dataset: xr.Dataset) -> Figure:
    """Draw one page, 183 mm wide, of an orbit's or a flight's time series; downstrokes are shaded.

    a wing kinematics, b body pitch, c power, d to f phase portraits, g effective angle of attack, h and i
    horizontal and vertical force on one strip of both wings at 1/4 and 3/4 of the span, over the weight.
    An orbit that is not certified says so in red.

    Parameters
    ----------
    dataset : `Orbit.dataset`, `Flight.dataset` or what was saved of them.

    Raises
    ------
    InvalidInputError : the dataset is neither an orbit nor a flight, or lacks a quantity.

    >>> import wingbeat as wb
    >>> pigeon = wb.load_species("pigeon")
    >>> model = wb.flight_model(pigeon.vehicle, wb.aero.BladeElement(wb.aero.SuFan()))
    >>> flight = wb.simulate(model, pigeon.wingbeat, wb.State(u=10.0))
    >>> page = wb.plots.wingbeat_page(flight.dataset)
    >>> f"{25.4 * page.get_figwidth():.0f} mm wide"
    '183 mm wide'
    """
    from matplotlib import rc_context
    from matplotlib.figure import Figure

    lines, weight = _described(dataset)
    head, foot = 2.5 + _LINE * len(lines), 1.0 + _LINE
    height = head + _PANELS + foot
    with rc_context(_STYLE):  # type: ignore[arg-type]
        figure = Figure(figsize=(_WIDTH / _INCH, height / _INCH), layout="constrained")
        layout: Any = figure.get_layout_engine()
        layout.set(rect=(0, foot / height, 1, _PANELS / height), w_pad=0.04, h_pad=0.04, wspace=0, hspace=0.02)
        for i, (text, style) in enumerate(lines):
            # A name of the user's own may hold a dollar sign, which is no formula.
            where = (2 / _WIDTH, 1 - (1.5 + _LINE * i) / height)
            figure.text(*where, text, va="top", parse_math=False, **style)
        note = "Downstroke shaded. g: effective angle. "
        note += f"h, i: one of the {dataset.sizes['station']} equal strips, both wings together."
        figure.text(2 / _WIDTH, 1.5 / height, note, fontsize=7)
        panels = figure.subplots(3, 3)
        _draw_motion(dataset, panels[0])
        _draw_portraits(dataset, panels[1])
        _draw_loads(dataset, panels[2], weight)
        figure.align_ylabels(panels)
        for letter, axes in zip("abcdefghi", panels.flat, strict=True):
            corner = {"xycoords": "axes fraction", "textcoords": "offset points", "in_layout": False}
            axes.annotate(letter, (0, 1), (-28, 4), fontsize=8, fontweight="bold", **corner)
    return figure


def _described(dataset: xr.Dataset) -> tuple[list[tuple[str, dict[str, Any]]], float]:
    """Return the lines above the panels with their styles, and the weight [N]; refuse what is not ours."""
    faults = FaultList()
    kind = dataset.attrs.get("wingbeat_kind")
    if kind not in ("orbit", "flight"):
        faults.add("dataset", kind, "is neither an orbit nor a flight of wingbeat", "give orbit.dataset")
    elif missing := [name for name in _NEEDED if name not in dataset]:
        faults.add("dataset", missing, "is missing from it", "solve or fly it again")
    faults.raise_if_any()
    try:
        vehicle, air, beat = (json.loads(dataset.attrs[name]) for name in ("vehicle", "air", "wingbeat"))
        weight = (vehicle["body"]["mass"] + 2 * vehicle["wing"]["mass"]) * air["gravity"]
        title = _orbit_title if kind == "orbit" else _flight_title
        return title(dataset, f"{beat['frequency']:.4g} Hz"), weight
    except (KeyError, TypeError, ValueError) as error:
        faults.add("attributes", str(error), "cannot be understood", "solve or fly it again")
    faults.raise_if_any()
    raise AssertionError


_TITLE, _TEXT = {"fontsize": 9, "fontweight": "bold"}, {"fontsize": 7.5}
_ALARM = {"fontsize": 7.5, "color": _RED}


def _orbit_title(dataset: xr.Dataset, frequency: str) -> list[tuple[str, dict[str, Any]]]:
    about = dataset.attrs
    aero, bounds = json.loads(about["aero"]), json.loads(about["active_bounds"])
    climb = f", climbing {about['climb']:.3g} m/s" if about["climb"] else ""
    first = f"{about['species']} at {about['speed']:.4g} m/s{climb}, {frequency}"
    loads = f"Air loads {aero['coefficients']}, {aero['extension']}, {aero['strips']} strips a wing"
    second = f"{loads}; least {about['objective']}, on the bound of {', '.join(bounds) or 'nothing'}"
    status, style = f"{about['message'][:1].upper()}{about['message'][1:]}", _TEXT
    if about["status"] != "converged":
        status, style = f"NOT CERTIFIED ({about['status']}): {about['message']}", _ALARM
    lines = [(line, look) for text, look in ((second, _TEXT), (status, style)) for line in textwrap.wrap(text, 120)]
    return [(first[:1].upper() + first[1:], _TITLE), *lines]


def _flight_title(dataset: xr.Dataset, frequency: str) -> list[tuple[str, dict[str, Any]]]:
    phase, flown = dataset["phase"].values, _flown(dataset)
    first = f"Flight of {phase[-1]:g} beats from {float(dataset['u'][0]):.4g} m/s, {frequency}"
    if flown.all():
        return [(first, _TITLE)]
    end = phase[flown][-1] if flown.any() else 0.0
    return [(first, _TITLE), (f"NOT FINISHED: the vehicle tumbled after {end:.3g} beats", _ALARM)]


def _draw_motion(dataset: xr.Dataset, panels: Any) -> None:
    """Draw wing kinematics, body pitch and power."""
    wing, pitch, power = panels
    phase = dataset["phase"].values
    _over_phase(wing, phase, "wing angles [deg]")
    curves = [("flap", "flap φ", _FIRST), ("wing_pitch", "pitch θ", _SECOND), ("fold", "fold", _THIRD)]
    for name, label, style in curves if np.ptp(dataset["fold"].values) > 1e-9 else curves[:2]:
        wing.plot(phase, np.degrees(dataset[name].values), label=label, **style)
    lines = wing.get_lines()
    if np.ptp(dataset["span_ratio"].values) > 1e-9:
        span = wing.twinx()
        span.spines["right"].set_visible(True)
        span.set(ylabel="span L/L₀ [-]", ylim=(0, 1.05), yticks=(0, 0.5, 1))
        span.tick_params(labelsize=7, length=2, pad=2)
        dots = {**_THIRD, "linestyle": (0, (3, 1, 1, 1))}
        lines = [*lines, *span.plot(phase, dataset["span_ratio"].values, label="span", **dots)]
    _legend(wing, lines)
    _over_phase(pitch, phase, "body pitch ψ [deg]")
    pitch.plot(phase, np.degrees(dataset["body_pitch"].values), **_FIRST)
    _over_phase(power, phase, "power of both wings [W]")
    hinge, flown, label = dataset["hinge_power"].values, _flown(dataset), "hinge"
    if flown.sum() > 1:
        beats = phase[flown]
        mean = np.trapezoid(hinge[flown], beats) / (beats[-1] - beats[0])
        power.axhline(mean, **_MEAN)
        label += f", mean {mean:.3g} W"
    lines = power.plot(phase, hinge, label=label, **_FIRST)
    _legend(power, lines + power.plot(phase, dataset["actuator_power"].values, label="actuator", **_SECOND))


def _draw_portraits(dataset: xr.Dataset, panels: Any) -> None:
    """Draw velocity against place for the three degrees of freedom, marked where the strokes begin."""
    from matplotlib.legend_handler import HandlerTuple

    phase, time, z = (dataset[name].values for name in ("phase", "time", "z"))
    pitch, rate = np.degrees(dataset["body_pitch"].values), np.degrees(dataset["pitch_rate"].values)
    scale, unit = (1e3, "mm") if np.fmax.reduce(np.abs(z)) < 0.5 else (1.0, "m")
    down = np.mod(phase, 1.0) < 0.5 - 1e-9
    halves = np.arange(math.ceil(2 * phase[0] - 1e-9), math.floor(2 * phase[-1] + 1e-9) + 1)
    size = 1.0 if phase[-1] - phase[0] <= 6 else 0.6
    marks: list[Any] = []
    for axes, place, speed, labels in (
        (
            panels[0],
            dataset["x"].values,
            dataset["u"].values,
            ("displacement x [m]", "forward velocity u [m/s]"),
        ),
        (panels[1], scale * z, dataset["w"].values, (f"height z [{unit}]", "upward velocity w [m/s]")),
        (panels[2], pitch, rate, ("body pitch ψ [deg]", "pitch rate q [deg/s]")),
    ):
        _dress(axes, *labels)
        axes.locator_params(axis="x", nbins=5)
        axes.margins(0.08)
        for mask, label, style in ((down, "downstroke", _FIRST), (~down, "upstroke", _SECOND)):
            # Each piece between two samples belongs to the stroke of its first.
            on = mask | np.concatenate([[False], mask[:-1]])
            axes.plot(place, np.where(on, speed, np.nan), label=label, **style)
        marks = []
        for starts, marker, points in (
            (halves[halves % 2 == 0], (8, 2, 0), 7),
            (halves[halves % 2 == 1], "o", 4),
        ):
            at = [np.interp(starts / 2, phase, values) for values in (place, speed)]
            marks += axes.plot(
                *at, "k", linestyle="", marker=marker, markersize=size * points, mew=0.9 * size, zorder=3
            )
    flown = _flown(dataset)
    if flown.sum() > 1:
        beats, span, x = (np.ptp(phase[flown]), np.ptp(time[flown]), dataset["x"].values[flown][[0, -1]])
        mean, advance = (x[1] - x[0]) / span, (x[1] - x[0]) / beats
        label = f"mean {mean:.4g} m/s, {advance:.3g} m a beat"
        _legend(panels[0], panels[0].plot(x, [mean, mean], label=label, **_MEAN))
    _legend(panels[1], panels[1].get_lines()[:2])
    starts = {"labels": ["start of down- and upstroke"], "handler_map": {tuple: HandlerTuple(None)}}
    _legend(panels[2], [tuple(marks)], **starts)


def _draw_loads(dataset: xr.Dataset, panels: Any, weight: float) -> None:
    """Draw effective angle of attack and force at 1/4 and 3/4 of the span."""
    phase, place = dataset["phase"].values, dataset["station"].values
    force = 2 * dataset["strip_force"].sel(axis=["x", "z"]).values / (weight or math.nan)
    alpha = np.unwrap(dataset["alpha"].values, axis=1)
    for axes, strips, label in (
        (panels[0], alpha, "angle of attack α [deg]"),
        (panels[1], force[..., 0], "horizontal force / weight [-]"),
        (panels[2], force[..., 1], "vertical force / weight [-]"),
    ):
        _over_phase(axes, phase, label)
        axes.axhline(0, color=_MEAN["color"], linewidth=0.5)
        for station, name, style in ((0.25, "1/4 span", _FIRST), (0.75, "3/4 span", _SECOND)):
            # Strip centres need not lie there: linear in between, and the last one beyond.
            line = strips @ np.array([np.interp(station, place, one) for one in np.eye(len(place))])
            axes.plot(phase, _turned(line) if strips is alpha else line, label=name, **style)
        _legend(axes, axes.get_lines()[1:])


def _flown(dataset: xr.Dataset) -> np.ndarray:
    """Return which samples were reached before the vehicle tumbled, if it did."""
    return np.isfinite(dataset["hinge_power"].values) & np.isfinite(dataset["u"].values)


def _turned(angle: np.ndarray) -> np.ndarray:
    """Return angles within half a turn of 0 in degrees, with a gap where a tumbling wing passes the half."""
    degrees = np.mod(np.degrees(angle) + 180.0, 360.0) - 180.0
    return np.where(np.abs(np.diff(degrees, prepend=degrees[:1])) > 180.0, np.nan, degrees)


def _legend(axes: Axes, handles: Any, **options: Any) -> None:
    """Put a legend in one line above the panel, where no curve can cross it."""
    spacing = {"borderaxespad": 0, "handlelength": 1.7, "handletextpad": 0.5, "columnspacing": 1.0}
    place = {
        "loc": "lower left",
        "bbox_to_anchor": (-0.04, 1.01),
        "ncols": 3,
        "frameon": False,
        "fontsize": 7,
    }
    axes.legend(handles=handles, **place, **spacing, **options)


def _dress(axes: Axes, xlabel: str, ylabel: str) -> None:
    axes.set(xlabel=xlabel, ylabel=ylabel)
    axes.tick_params(labelsize=7, length=2, pad=2)  # said here, for ticks are made only when drawn
    axes.ticklabel_format(style="plain", useOffset=False)  # a common factor would stand in the legend
    axes.locator_params(nbins=6)


def _over_phase(axes: Axes, phase: np.ndarray, ylabel: str) -> None:
    """Prepare a panel over phase with every downstroke shaded."""
    from matplotlib.collections import PolyCollection

    _dress(axes, "phase t/T [-]", ylabel)
    axes.set_xlim(phase[0], phase[-1])
    starts = np.arange(math.floor(phase[0]), math.ceil(phase[-1]))
    boxes = [[(s, 0), (s + 0.5, 0), (s + 0.5, 1), (s, 1)] for s in starts]
    # One collection and not a patch each: a flight may have thousands of beats.
    shade = PolyCollection(boxes, facecolor=_SHADE, linewidth=0, zorder=0, gid="downstroke")
    shade.set_transform(axes.get_xaxis_transform())
    axes.add_collection(shade, autolim=False)
