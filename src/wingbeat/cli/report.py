"""Orbits and flights on a terminal: what `orbit` and `show` print."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import STATE_NAMES, grouped
from wingbeat.cli.printing import print_report
from wingbeat.words.orbit_words import orbit_report, power_rows, state_rows, status_line, wingbeat_rows

if TYPE_CHECKING:
    import xarray as xr
    from rich.console import Console


def print_orbit(record: dict[str, Any], console: Console) -> None:
    """Print an orbit record: closure, plausibility, every group of its numbers, and warnings."""
    print_report(orbit_report(record), console)


def flight_summary(dataset: xr.Dataset) -> dict[str, Any]:
    """Return beats flown, vehicle, wingbeat, first and last state and mean powers; SI and radians.

    Parameters
    ----------
    dataset : of a flight.
    """
    about = {name: json.loads(dataset.attrs[name]) for name in ("vehicle", "wingbeat")}
    lost = ~np.isfinite(dataset["hinge_power"].values + dataset["pitch_rate"].values)
    reached = dataset.isel(phase=slice(int(lost.argmax()) if lost.any() else None))
    phase = reached["phase"].values
    power = {
        name: float(np.trapezoid(reached[column].values, phase) / np.ptp(phase)) if len(phase) > 1 else None
        for name, column in (("mean_power", "hinge_power"), ("mean_actuator_power", "actuator_power"))
    }
    ends = [{name: float(reached[name][i]) for name in STATE_NAMES} if len(phase) else None for i in (0, -1)]
    beats = float(phase[-1]) if len(phase) else 0.0
    return {"completed": not lost.any(), "beats": beats, **about, "start": ends[0], "end": ends[1], **power}


def print_flight(summary: dict[str, Any], console: Console) -> None:
    """Print the summary of a flight."""
    completed = summary["completed"]
    message = f"{summary['beats']:.4g} beats" + ("" if completed else ", then the vehicle tumbled")
    groups = {
        "wingbeat": wingbeat_rows(summary["wingbeat"]),
        "state at the start": state_rows(summary["start"] or {}),
        "state at the end": state_rows(summary["end"] or {}),
        "power, both wings": power_rows(summary),
    }
    status = status_line(*(("flown", message, "good") if completed else ("not finished", message, "bad")))
    print_report([status, grouped(groups)], console)
