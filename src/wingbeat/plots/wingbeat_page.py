"""One page of a wingbeat or a flight: nine panels and a title above them."""

from __future__ import annotations

import json
import textwrap
from typing import TYPE_CHECKING, Any

from wingbeat._base import FaultList
from wingbeat._base.datasets import climb_text
from wingbeat._base.style import ALARM, GOOD, PAGE, drawing, heading, in_words, letter_panels, new_figure
from wingbeat.plots.panels import draw_loads, draw_motion, draw_portraits, flown, mean_power
from wingbeat.results.plausibility import statements
from wingbeat.results.rows import limits_in_words, mass_of

if TYPE_CHECKING:
    import xarray as xr
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
    weight. Two statements at the top say how well a certified orbit closes and whether it is plausible. Both are
    green if the orbit is plausible; otherwise the second is red. Without a certificate, one red line gives the
    reason.

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


# What the two statements on an orbit, and what its limits have set, are read from.
_READ = ("status", "closure", "plausibility", "active_bounds", "objective", "wingbeat")


def _orbit_title(dataset: xr.Dataset, frequency: str) -> list[tuple[str, dict[str, Any]]]:
    about = dataset.attrs
    aero = json.loads(about["aero"])
    first = f"{heading(about['species'])} at {about['speed']:.4g} m/s{climb_text(about['climb'])}, {frequency}"
    names = f"{in_words(aero['coefficients'])}, {in_words(aero['extension'])}"
    loads = f"Air loads: {names}, {aero['strips']} strips per wing"
    second = f"{loads}; minimised: {in_words(about['objective'])}"
    if about["status"] == "converged":
        record = {name: _read(about, name) for name in _READ}
        said = statements(record)
        parts = [(f"Certified: {said.closes}", _GOOD if said.good else _TEXT)]
        parts.append((_capital(said.plausible), _GOOD if said.good else _ALARM))
        if limits := limits_in_words(record):
            parts.append((f"Set by limits, not predicted: {limits}", _TEXT))
    else:
        parts = [(f"NOT CERTIFIED ({about['status']}): {about['message']}", _ALARM)]
    lines = [(line, look) for text, look in ((second, _TEXT), *parts) for line in textwrap.wrap(text, 120)]
    return [(first, _TITLE), *lines]


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


def _read(about: dict[str, Any], name: str) -> Any:
    """Return a part of the record, or None: files of early versions have no ``plausibility``."""
    return about[name] if name in ("status", "objective") else json.loads(about.get(name, "null"))


def _flight_title(dataset: xr.Dataset, frequency: str) -> list[tuple[str, dict[str, Any]]]:
    phase, reached = dataset["phase"].values, flown(dataset)
    first = f"Flight of {phase[-1]:g} beats, starting at {float(dataset['u'][0]):.4g} m/s, {frequency}"
    if reached.all():
        return [(first, _TITLE)]
    end = phase[reached][-1] if reached.any() else 0.0
    return [(first, _TITLE), (f"NOT FINISHED: the vehicle tumbled after {end:.3g} beats", _ALARM)]
