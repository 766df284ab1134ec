"""``wingbeat show``: print what a saved orbit, flight or curve holds."""

from __future__ import annotations

import json as json_format
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from wingbeat._base import KIND
from wingbeat.cli.curve_report import print_curve
from wingbeat.cli.report import flight_summary, print_flight, print_orbit
from wingbeat.cli.streams import plain_console
from wingbeat.records.forms import parse_attributes
from wingbeat.records.numbers import power_account
from wingbeat.records.result_files import load_dataset
from wingbeat.results.curve import Curve


def show(
    file: Annotated[Path, Parameter(help="A file written by `orbit -o`, `simulate -o` or `curve -o`.")],
    *,
    power: Annotated[bool, Parameter(negative="", help="Print the parts of an orbit's power.")] = False,
    json: Annotated[bool, Parameter(negative="", help="Print JSON alone: SI units and radians.")] = False,
) -> None:
    """Print a saved orbit's record, a flight's summary, or a curve.

    Angles are printed in degrees; with --json in radians, as everywhere in files.
    """
    dataset = load_dataset(file)
    account = power_account(dataset) if power else None
    if dataset.attrs[KIND] == "curve":
        curve = Curve(dataset)
        print(json_format.dumps(curve.record(), indent=2, allow_nan=False)) if json else print_curve(curve)
        return
    console = plain_console()
    is_orbit = dataset.attrs[KIND] == "orbit"
    record = parse_attributes(dataset.attrs)[0] if is_orbit else flight_summary(dataset)
    if account is not None:
        record["power_account"] = account
    if json:
        print(json_format.dumps(record, indent=2, allow_nan=False))
    elif is_orbit:
        print_orbit(record, console)
    else:
        print_flight(record, console)
