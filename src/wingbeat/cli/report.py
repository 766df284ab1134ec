"""Orbits and flights on a terminal: what `orbit` and `show` print."""

from __future__ import annotations

import json
import math
import os
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat.cli.power_report import power_groups
from wingbeat.errors import FileError
from wingbeat.results.storage import KIND, load_dataset

if TYPE_CHECKING:
    import xarray as xr
    from rich.console import Console

__all__ = ["flight_summary", "print_flight", "print_orbit", "read_result"]

Rows = list[tuple[str, str]]

_RATIOS = ("span_retraction", "twist_ratio", "wrist", "downstroke_fraction", "span_harmonics")
# What says that a wingbeat goes without one of the laws beyond the paper's; none of them needs a line then.
_OFF: dict[str, Any] = {
    **dict.fromkeys(("pitch_phase", "sweep_mean", "sweep_amplitude", "sweep_phase", "stroke_plane_tilt"), 0.0),
    **{name: [] for name in ("flap_harmonics", "pitch_harmonics", "span_harmonics")},
    "downstroke_fraction": 0.5,
}
_STATE = ("x", "z", "body_pitch", "u", "w", "pitch_rate")


def read_result(path: str | PathLike[str]) -> xr.Dataset:
    """Return the dataset of a file that `orbit -o`, `simulate -o` or `curve -o` wrote.

    Raises
    ------
    FileError : missing, unreadable, cut short, or of another program.
    """
    dataset = load_dataset(path)
    if dataset.attrs.get(KIND) not in ("orbit", "flight", "curve"):
        ways = "give a file of `wingbeat orbit -o`, `simulate -o` or `curve -o`"
        raise FileError(f"cannot read {os.fspath(path)!r}: it holds no orbit, flight or curve of wingbeat; {ways}")
    return dataset


def print_orbit(record: dict[str, Any], console: Console) -> None:
    """Print an orbit record: its status first, then every group of numbers the record holds, then warnings."""
    certified = record.get("status") == "converged"
    message = str(record.get("message", ""))
    # "certified" stands in front already, as the status.
    _print_status(
        "certified" if certified else f"not certified, {record.get('status')}", certified, message, console
    )
    aero = record.get("aero", {})
    place = f"{record.get('species')} at {_of(record, 'speed', 'm/s')}"
    if record.get("climb"):
        place += f", climbing {_of(record, 'climb', 'm/s')}"
    loads = ", ".join(str(aero[name]) for name in ("coefficients", "extension", "force_point") if name in aero)
    _print_groups(
        {
            "flight": [("species, mean speed", place), ("air loads", loads), *_flight_numbers(record)],
            "short of an orbit, at the closest beat": _shortages(record.get("failed_balance") or []),
            "nearest changes that fly, each by itself": _changes(record.get("relaxations") or []),
            "wingbeat": _wingbeat(record.get("wingbeat", {})),
            "state at the top of the stroke": _state(record.get("initial_state", {})),
            "power, both wings": _powers(record),
            **power_groups(record.get("power_account")),
            "certificate": _certificate(record),
            "stability": _stability(record),
        },
        console,
    )
    _print_warnings(record.get("warnings") or [], console)


def flight_summary(dataset: xr.Dataset, path: str | PathLike[str]) -> dict[str, Any]:
    """Return beats flown, vehicle, wingbeat, first and last state and mean powers; SI and radians.

    Raises
    ------
    FileError : the file at `path`, which the dataset came from, lacks one of these.
    """
    try:
        about = {name: json.loads(dataset.attrs[name]) for name in ("vehicle", "wingbeat")}
        lost = ~np.isfinite(dataset["hinge_power"].values + dataset["pitch_rate"].values)
        reached = dataset.isel(phase=slice(int(lost.argmax()) if lost.any() else None))
        phase = reached["phase"].values
        power = {
            name: float(np.trapezoid(reached[column].values, phase) / np.ptp(phase)) if len(phase) > 1 else None
            for name, column in (("mean_power", "hinge_power"), ("mean_actuator_power", "actuator_power"))
        }
        ends = [{name: float(reached[name][i]) for name in _STATE} if len(phase) else None for i in (0, -1)]
    except (KeyError, ValueError) as error:
        raise FileError(
            f"cannot read {os.fspath(path)!r} as a flight: it is damaged ({error}); fly it again"
        ) from None
    beats = float(phase[-1]) if len(phase) else 0.0
    return {"completed": not lost.any(), "beats": beats, **about, "start": ends[0], "end": ends[1], **power}


def print_flight(summary: dict[str, Any], console: Console) -> None:
    """Print the summary of a flight."""
    completed = summary["completed"]
    message = f"{summary['beats']:.4g} beats" + ("" if completed else ", then the vehicle tumbled")
    _print_status("flown" if completed else "not finished", completed, message, console)
    groups = {
        "wingbeat": _wingbeat(summary["wingbeat"]),
        "state at the start": _state(summary["start"] or {}),
        "state at the end": _state(summary["end"] or {}),
        "power, both wings": _powers(summary),
    }
    _print_groups(groups, console)


def _flight_numbers(record: dict[str, Any]) -> Rows:
    names = {"strouhal": "Strouhal number", "reduced_frequency": "reduced frequency", "reynolds": "Reynolds number"}
    rows = [(label, _of(record, name)) for name, label in names.items() if name in record]
    for name, label in (("alpha_quarter_span", "1/4"), ("alpha_three_quarter_span", "3/4")):
        if name in record:
            low, high = (_number(v, "deg", math.degrees(1.0)) for v in record[name])
            rows.append((f"effective alpha at {label} span", f"{low.removesuffix(' deg')} to {high}"))
    if "body_pitch_range" in record:
        rows.append(("range of body pitch", _of(record, "body_pitch_range", "deg")))
    return rows


def _shortages(shortages: list[dict[str, Any]]) -> Rows:
    share = {"N m": "of weight times chord"}
    return [
        (
            s["law"],
            f"{_of(s, 'amount', s['unit'])}, {100 * s['share']:.2g} % {share.get(s['unit'], 'of the weight')}",
        )
        for s in shortages
    ]


def _changes(changes: list[dict[str, Any]]) -> Rows:
    return [("or" if i else "either", change["text"]) for i, change in enumerate(changes)]


def _wingbeat(beat: dict[str, Any]) -> Rows:
    units = {"frequency": "Hz", **dict.fromkeys(_RATIOS, "")}
    shown = [name for name in beat if name not in _OFF or beat[name] != _OFF[name]]
    rows = [(name.replace("_", " "), _of(beat, name, units.get(name, "deg"))) for name in shown]
    return [(f"wing {label}" if label.startswith("pitch") else label, value) for label, value in rows]


def _state(state: dict[str, Any]) -> Rows:
    labels = {
        "x": ("forward position x", "m"),
        "z": ("height z", "m"),
        "body_pitch": ("body pitch, nose up", "deg"),
        "u": ("forward velocity u", "m/s"),
        "w": ("upward velocity w", "m/s"),
        "pitch_rate": ("pitch rate", "deg/s"),
    }
    return [(labels[name][0], _of(state, name, labels[name][1])) for name in state if name in labels]


def _powers(record: dict[str, Any]) -> Rows:
    labels = {
        "mean_power": "hinges, mean",
        "mean_positive_power": "hinges, mean of the positive part",
        "peak_power": "hinges, peak",
        "mean_actuator_power": "actuators, mean",
        "peak_actuator_power": "actuators, peak",
    }
    vehicle = record.get("vehicle")
    mass = vehicle["body"]["mass"] + 2 * vehicle["wing"]["mass"] if vehicle else None
    rows = []
    for name, label in labels.items():
        if name in record:
            # The animal's mass is that of body and wings together.
            each = f" ({_number(record[name], 'W/kg', 1 / mass)})" if mass and record[name] is not None else ""
            rows.append((label, _of(record, name, "W") + each))
    if "cost_of_transport" in record:
        rows.append(("cost of transport", _of(record, "cost_of_transport")))
    return rows


def _certificate(record: dict[str, Any]) -> Rows:
    closure = record.get("closure") or {}
    rows = []
    if record.get("objective_value") is not None:
        rows.append(("made least", f"{record['objective'].replace('_', ' ')}, {record['objective_value']:.5g}"))
    for constraint, value in (record.get("constraints") or {}).items():
        rows.append((f"kept to {constraint}", _number(value, "", 1.0)))
    if closure:
        units = {"x": "m", "z": "m", "body_pitch": "rad", "u": "m/s", "w": "m/s", "pitch_rate": "rad/s"}
        worst = max(closure, key=lambda name: math.inf if closure[name] is None else abs(closure[name]))
        miss = "lost" if closure[worst] is None else f"{abs(closure[worst]):.1e} {units.get(worst, '')}"
        rows.append(("largest miss when re-flown", f"{miss.strip()}, in {worst}"))
    if record.get("optimality") is not None:
        rows.append(("optimality (largest KKT residual)", f"{record['optimality']:.1e}"))
    if "starts" in record:
        rows.append(("searches, distinct optima", f"{record['starts']}, {record.get('distinct_optima')}"))
    rows.append(("on the bound of", ", ".join(record.get("active_bounds") or []) or "nothing"))
    return rows


def _stability(record: dict[str, Any]) -> Rows:
    pairs = record.get("floquet_multipliers") or []
    if not pairs or any(part is None for pair in pairs for part in pair):
        return []
    sizes = [math.hypot(*pair) for pair in pairs]
    rows = [("multipliers, modulus", ", ".join(f"{size:.3g}" for size in sizes))]
    if record.get("stable") is None:
        return [*rows, ("stable", "unknown: the orbit is not certified")]
    rows.append(("stable", "yes" if record["stable"] else "no"))
    growth = math.log(max(sizes)) if max(sizes) > 0 else -math.inf
    if growth:
        time = math.log(2.0) / abs(growth)
        what = "double" if growth > 0 else "halve"
        rows.append((f"a disturbance takes to {what}", f"{time:.3g} beats"))
    return rows


def _of(numbers: dict[str, Any], name: str, unit: str = "") -> str:
    """Return one number of a record in the unit shown."""
    return _number(numbers.get(name), unit, math.degrees(1.0) if unit.startswith("deg") else 1.0)


def _number(value: Any, unit: str, factor: float) -> str:
    if isinstance(value, list | tuple):
        # Of harmonics, a ten-thousandth of a degree is nothing.
        shown = [f"{each * factor:.3g}" if abs(each * factor) >= 1e-4 else "0" for each in value]
        return f"{', '.join(shown)} {unit}".rstrip()
    if value is None:
        return "-"  # undefined, as a cost of transport in hover
    shown = value * factor
    return f"{shown:{'.0f' if 1e4 <= abs(shown) < 1e7 else '.4g'}} {unit}".rstrip()


def _print_status(status: str, good: bool, message: str, console: Console) -> None:
    from rich.text import Text

    message = message.removeprefix(f"{status}: ")
    console.print(Text.assemble((status, f"bold {'green' if good else 'red'}"), ": " if message else "", message))


def _print_groups(groups: dict[str, Rows], console: Console) -> None:
    from rich.table import Table
    from rich.text import Text

    # One table, so that all numbers stand in one column; as Text, for names come from files.
    table = Table(box=None, show_header=False, pad_edge=False, padding=(0, 2, 0, 0))
    table.add_column(no_wrap=False, min_width=min(33, console.width // 2))
    table.add_column(overflow="fold")
    for title, rows in groups.items():
        if rows:
            table.add_row()
            table.add_row(Text(title, style="bold"))
        for label, value in rows:
            table.add_row(Text(f"  {label}"), Text(value))
    console.print(table)


def _print_warnings(warnings: list[str], console: Console) -> None:
    from rich.table import Table
    from rich.text import Text

    if not warnings:
        return
    table = Table.grid(padding=(0, 1, 0, 0))
    for warning in warnings:
        table.add_row(Text("-"), Text(warning, style="yellow"))
    console.print()
    console.print(Text("warnings", style="bold"))
    console.print(table)
