"""``wingbeat view``: a saved orbit or flight in motion, as a page or as an animated picture."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from wingbeat.cli.options import check_outputs
from wingbeat.cli.progress import progress_bar
from wingbeat.cli.report import read_result
from wingbeat.errors import FaultList
from wingbeat.viewer import animate, write_page

_SUFFIXES = (".html", ".gif")


def view(
    file: Annotated[Path, Parameter(help="A file written by `orbit -o` or `simulate -o`.")],
    other: Annotated[Path | None, Parameter(help="A second file to compare with.")] = None,
    *,
    output: Annotated[
        Path,
        Parameter(
            name=["--output", "-o"], help="The file to write: .html for a page, .gif for an animated picture."
        ),
    ],
) -> None:
    """Show a saved flight in motion: wings, air loads and time series at every phase of the beat.

    The page holds all it needs: it opens from disk and makes no network request.

    Examples: wingbeat view pigeon.nc -o pigeon.html; wingbeat view sufan.nc dickinson.nc -o both.html;
    wingbeat view bat.nc -o bat.gif
    """
    faults = FaultList()
    suffix = output.suffix.lower()
    if suffix not in _SUFFIXES:
        faults.add(
            "--output",
            str(output),
            "is neither a page nor an animated picture",
            f"end it in {' or '.join(_SUFFIXES)}",
        )
    faults.raise_if_any()
    check_outputs(output)
    flights = [(path.stem, read_result(path)) for path in (file, other) if path is not None]
    if suffix == ".html":
        write_page(flights, output)
    else:
        with progress_bar("frames") as progress:
            animate(flights, output, progress)
    print(f"wrote {output}", file=sys.stderr)
