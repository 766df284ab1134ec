"""``wingbeat show``: print what a saved orbit, flight or curve holds."""

from __future__ import annotations

import json as json_format
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np

from wingbeat._base import KIND, STATE_NAMES, Report, grouped
from wingbeat.cli.arguments import flag, option
from wingbeat.cli.terminal import print_json, print_report
from wingbeat.records.forms import parse_attributes
from wingbeat.records.numbers import power_account
from wingbeat.records.result_files import load_dataset
from wingbeat.results.curve import Curve
from wingbeat.words.curve_words import curve_report
from wingbeat.words.orbit_words import orbit_report, power_rows, state_rows, status_line, wingbeat_rows

if TYPE_CHECKING:
    import xarray as xr


def show(
    file: Annotated[Path, option("A file written by `orbit -o`, `simulate -o` or `curve -o`.")],
    *,
    power: Annotated[bool, flag("Print the parts of an orbit's power.")] = False,
    json: Annotated[bool, flag("Print JSON alone: SI units and radians.")] = False,
) -> None:
    """Print a saved orbit's record, a flight's summary, or a curve.

    Angles are printed in degrees; with --json in radians, as everywhere in files.
    """
    dataset = load_dataset(file)
    account = power_account(dataset) if power else None
    if dataset.attrs[KIND] == "curve":
        record, report_of = Curve(dataset).record(), curve_report
    elif dataset.attrs[KIND] == "orbit":
        record, report_of = parse_attributes(dataset.attrs)[0], orbit_report
    else:
        record, report_of = flight_summary(dataset), flight_report
    if account is not None:
        record["power_account"] = account
    print_json(record) if json else print_report(report_of(record))


def flight_summary(dataset: xr.Dataset) -> dict[str, Any]:
    """Return beats flown, vehicle, wingbeat, first and last state and mean powers of a flight; SI and radians."""
    about = {name: json_format.loads(dataset.attrs[name]) for name in ("vehicle", "wingbeat")}
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


def flight_report(summary: dict[str, Any]) -> Report:
    """Return the summary of a flight as the blocks of a report."""
    completed = summary["completed"]
    message = f"{summary['beats']:.4g} beats" + ("" if completed else ", then the vehicle tumbled")
    groups = {
        "wingbeat": wingbeat_rows(summary["wingbeat"]),
        "state at the start": state_rows(summary["start"] or {}),
        "state at the end": state_rows(summary["end"] or {}),
        "power, both wings": power_rows(summary),
    }
    status = status_line(*(("flown", message, "good") if completed else ("not finished", message, "bad")))
    return [status, grouped(groups)]
