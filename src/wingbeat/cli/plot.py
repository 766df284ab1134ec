"""``wingbeat plot``: draw one page of a saved orbit or flight."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from wingbeat.cli.report import read_result
from wingbeat.errors import FaultList
from wingbeat.plots import check_figure_name, power_page, save_figure, wingbeat_page


def plot(
    file: Annotated[Path, Parameter(help="A file of `orbit -o` or `simulate -o`.")],
    *,
    output: Annotated[Path, Parameter(name=["--output", "-o"], help="The page: .png, .pdf or .svg.")],
    power: Annotated[bool, Parameter(negative="", help="Draw what the power of an orbit is made of.")] = False,
) -> None:
    """Draw one page: wing motion, body pitch, power, phase portraits, angles of attack and forces.

    Examples: wingbeat plot pigeon.nc -o pigeon.pdf; wingbeat plot pigeon.nc --power -o power.png
    """
    faults = FaultList()
    check_figure_name(faults, "--output", output)
    faults.raise_if_any()
    save_figure((power_page if power else wingbeat_page)(read_result(file)), output)
    print(f"wrote {output}", file=sys.stderr)
