"""``wingbeat view``: a saved orbit or flight in motion, as a page or as an animated picture."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

from wingbeat._base import FaultList, InvalidInputError
from wingbeat.cli.arguments import Whole, check_outputs, flag, option, written_to
from wingbeat.cli.problem_options import saved_orbit
from wingbeat.cli.terminal import progress_bar
from wingbeat.records.result_files import load_dataset
from wingbeat.stability.options import MOST_DELAY
from wingbeat.viewer import Push, animate, write_page

_SUFFIXES = (".html", ".gif")


def view(
    file: Annotated[Path, option("A file written by `orbit -o` or `simulate -o`.")],
    other: Annotated[Path | None, option("A second file to compare with.")] = None,
    *,
    output: Annotated[Path, written_to("The file to write: .html for a page, .gif for an animated picture.")],
    push: Annotated[
        bool, flag("Let the reader push the animal: add flights through gusts, without and with feedback.")
    ] = False,
    delay: Annotated[Whole | None, option("With --push: beats by which feedback acts later; default 0.")] = None,
) -> None:
    """Show a saved flight in motion: wings, air loads and time series at every phase of the beat.

    The page holds all it needs: it opens from disk and makes no network request.

    Examples: wingbeat view pigeon.nc -o pigeon.html; wingbeat view sufan.nc dickinson.nc -o both.html;
    wingbeat view bat.nc -o bat.gif; wingbeat view pigeon.nc --push -o pigeon.html
    """
    faults = FaultList()
    suffix = output.suffix.lower()
    if suffix not in _SUFFIXES:
        rule = "is neither a page nor an animated picture"
        faults.add("--output", str(output), rule, f"end it in {' or '.join(_SUFFIXES)}")
    if push and (other is not None or suffix != ".html"):
        rule = "flies one orbit, in a page"
        faults.add("--push", True, rule, "give one orbit, and an output that ends in .html")
    if delay is not None and not push:
        faults.add("--delay", delay, "is that of the feedback of --push", "add --push")
    faults.whole("--delay", delay or 0, 0, MOST_DELAY, "beats")
    faults.raise_if_any()
    check_outputs(output)
    flights = [(path.stem, load_dataset(path, "orbit", "flight")) for path in (file, other) if path is not None]
    if suffix == ".html":
        pushes: tuple[Push, ...] = ()
        if push:
            from wingbeat.stability.gust_flights import fly_pushes

            orbit = saved_orbit(file)
            try:
                pushes = fly_pushes(orbit, delay or 0)
            except InvalidInputError as error:  # no feedback holds the orbit
                pushes = fly_pushes(orbit, None)  # refuses an orbit that is not certified
                print(f"flights with feedback are left out: {error}", file=sys.stderr)
        write_page(flights, output, pushes)
    else:
        with progress_bar("frames") as progress:
            animate(flights, output, progress)
    print(f"wrote {output}", file=sys.stderr)
