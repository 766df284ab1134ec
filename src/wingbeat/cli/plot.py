"""``wingbeat plot``: draw one page of a saved orbit, flight or curve."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from wingbeat._base import KIND, FaultList
from wingbeat.cli.curve_report import drawn
from wingbeat.cli.options import check_outputs
from wingbeat.plots import check_figure_name, power_page, save_figure, wingbeat_page
from wingbeat.records.result_files import load_dataset
from wingbeat.results.curve import Curve


def plot(
    file: Annotated[Path, Parameter(help="A file written by `orbit -o`, `simulate -o` or `curve -o`.")],
    *,
    output: Annotated[Path, Parameter(name=["--output", "-o"], help="The page: .png, .pdf or .svg.")],
    power: Annotated[bool, Parameter(negative="", help="Draw the parts of an orbit's power.")] = False,
) -> None:
    """Draw one page: wing motion, body pitch, power, phase portraits, angles of attack and forces.

    For a curve, draw power and frequency against speed.

    Examples: wingbeat plot pigeon.nc -o pigeon.pdf; wingbeat plot pigeon.nc --power -o power.png
    """
    faults = FaultList()
    check_figure_name(faults, "--output", output)
    faults.raise_if_any()
    check_outputs(output)
    dataset = load_dataset(file)
    if power:
        page = power_page(dataset)
    else:
        page = drawn(Curve(dataset)) if dataset.attrs[KIND] == "curve" else wingbeat_page(dataset)
    save_figure(page, output)
    print(f"wrote {output}", file=sys.stderr)
