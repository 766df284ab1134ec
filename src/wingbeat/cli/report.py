"""Orbits and flights on a terminal: what `orbit` and `show` print."""

from __future__ import annotations

import json
import os
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat.cli.power_report import power_groups
from wingbeat.datasets import KIND, STATE_NAMES
from wingbeat.errors import FileError
from wingbeat.results.plausibility import statements
from wingbeat.results.rows import Rows, orbit_groups, power_rows, state_rows, wingbeat_rows
from wingbeat.results.storage import load_dataset

if TYPE_CHECKING:
    import xarray as xr
    from rich.console import Console


def read_result(path: str | PathLike[str]) -> xr.Dataset:
    """Return the dataset of a file that `orbit -o`, `simulate -o` or `curve -o` wrote.

    Raises
    ------
    FileError : missing, unreadable, cut short, or of another program.
    """
    dataset = load_dataset(path)
    if dataset.attrs.get(KIND) not in ("orbit", "flight", "curve"):
        ways = "give a file that `wingbeat orbit -o`, `simulate -o` or `curve -o` wrote"
        raise FileError(f"cannot read {os.fspath(path)!r}: it holds no orbit, flight or curve of wingbeat; {ways}")
    return dataset


def print_orbit(record: dict[str, Any], console: Console) -> None:
    """Print an orbit record: closure, plausibility, every group of its numbers, and warnings."""
    if record.get("status") == "converged":
        said = statements(record)
        # The words are green only if both statements hold; each statement is printed on its own.
        _print_status("certified", "green" if said.good else "", said.closes, console)
        _print_status("plausible", "green" if said.good else "yellow", said.plausible, console)
    else:
        message = str(record.get("message", ""))
        _print_status(f"not certified, {record.get('status')}", "red", message, console)
    groups = orbit_groups(record)
    certificate = {title: groups.pop(title) for title in ("certificate", "stability")}
    _print_groups({**groups, **power_groups(record.get("power_account")), **certificate}, console)
    _print_warnings(record.get("warnings") or [], console)


def flight_summary(dataset: xr.Dataset, path: str | PathLike[str]) -> dict[str, Any]:
    """Return beats flown, vehicle, wingbeat, first and last state and mean powers; SI and radians.

    Raises
    ------
    FileError : the file at `path`, from which the dataset was read, lacks one of these.
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
        ends = [{name: float(reached[name][i]) for name in STATE_NAMES} if len(phase) else None for i in (0, -1)]
    except (KeyError, ValueError) as error:
        raise FileError(
            f"cannot read {os.fspath(path)!r} as a flight: it is damaged ({error}); run `wingbeat simulate` again"
        ) from None
    beats = float(phase[-1]) if len(phase) else 0.0
    return {"completed": not lost.any(), "beats": beats, **about, "start": ends[0], "end": ends[1], **power}


def print_flight(summary: dict[str, Any], console: Console) -> None:
    """Print the summary of a flight."""
    completed = summary["completed"]
    message = f"{summary['beats']:.4g} beats" + ("" if completed else ", then the vehicle tumbled")
    _print_status("flown" if completed else "not finished", "green" if completed else "red", message, console)
    groups = {
        "wingbeat": wingbeat_rows(summary["wingbeat"]),
        "state at the start": state_rows(summary["start"] or {}),
        "state at the end": state_rows(summary["end"] or {}),
        "power, both wings": power_rows(summary),
    }
    _print_groups(groups, console)


def _print_status(status: str, color: str, message: str, console: Console) -> None:
    from rich.text import Text

    message = message.removeprefix(f"{status}: ")
    console.print(Text.assemble((status, f"bold {color}".strip()), ": " if message else "", message))


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
