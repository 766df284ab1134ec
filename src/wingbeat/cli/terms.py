"""``wingbeat terms``: what terms of the air loads do to the best wingbeat."""

from __future__ import annotations

import functools
import math
from pathlib import Path
from typing import Annotated, Any

from wingbeat._base import FaultList
from wingbeat.cli import problem_options as options
from wingbeat.cli.arguments import Seed, Whole, check_files, check_outputs, figure, flag, option, parse_range
from wingbeat.cli.terminal import deliver, plain_console, progress_bar
from wingbeat.plots import terms_page
from wingbeat.results.terms import found_any, trace_terms


def terms(
    species: Annotated[str, options.SPECIES],
    *,
    speed: Annotated[float, options.SPEED],
    climb: options.Climb = 0.0,
    model: options.ModelOptions = options.DEFAULT_MODEL,
    shares: Annotated[str, option("Shares of the terms, start:stop:step: 0 is none, 1 is all of them.")] = (
        "0:1:0.25"
    ),
    within_plausible: options.WithinPlausible = False,
    minimise: Annotated[
        str | None, option("Quantity to minimise: frequency, ...; default that of the model.")
    ] = None,
    subject_to: options.Limits = None,
    starts: Annotated[
        Whole, option("Number of starts at the first and last share; other shares get a third as many.")
    ] = 6,
    seed: Seed = 0,
    set_: options.Settings = None,
    json: Annotated[bool, flag("Print the trace as JSON and nothing else.")] = False,
    plot: Annotated[Path | None, figure("Draw the trace")] = None,
) -> int:
    """Find the best wingbeats, and changes of family, while the share of a term of the air loads rises from 0 to 1.

    Name the terms with --unsteady and --inflow; if both are named, their shares rise together. --model animal names
    both. Exit code 3: no share has a certified orbit.

    Examples: wingbeat terms pigeon --speed 8 --unsteady thin-aerofoil;
    wingbeat terms bat --speed 6 --inflow momentum --plot inflow.png
    """
    faults = FaultList()
    check_files(faults, None, plot=plot)
    faults.raise_if_any()
    row = [float(share) for share in parse_range(shares, "--shares")]
    asked = {"climb": climb, "minimise": minimise, "subject_to": subject_to}
    problem = model.problem(species, speed, set_, within_plausible=within_plausible, **asked)
    check_outputs(plot)
    with progress_bar(f"{problem.species.name} at each share of the terms") as progress:
        found = trace_terms(problem, row, starts, seed, progress)
    record = found.record()
    page = functools.partial(terms_page, record)
    return deliver(record, lambda: _print(record), found_any(found), json=json, plot=plot, page=page)


_HEADS = ("share", "family", "frequency\n[Hz]", "amplitude\n[deg]", "power\n[W]")
_SPENT = ("profile", "induced", "parasite", "unsteady")


def _print(record: dict[str, Any]) -> None:
    from rich.table import Table

    console = plain_console()
    table = Table(box=None, pad_edge=False)
    for head in (*_HEADS, *(f"{name}\n[W]" for name in _SPENT)):
        table.add_column(head, justify="right", no_wrap=True)
    for point in record["points"]:
        beat, shown = point["wingbeat"], [point["status"], *("-" for _ in (*_HEADS[2:], *_SPENT))]
        if beat is not None:
            numbers = beat["frequency"], math.degrees(beat["flap_amplitude"]), point["mean_actuator_power"]
            numbers += tuple(point["spent"][name] for name in _SPENT)
            shown = [str(point["family"] + 1), *(f"{value:.3g}" for value in numbers)]
        table.add_row(f"{point['share']:g}", *shown)
    console.print(table)
    console.print("power: mean total of all actuators; the columns to its right show what it is spent on")
    for mark in record["marks"]:
        console.print(f"share {mark['lower']:g} to {mark['upper']:g}: {mark['what']}")
    told = "one family of wingbeats is best" if record["same_family"] else "no single family of wingbeats is best"
    console.print(f"{told} from share {record['points'][0]['share']:g} to {record['points'][-1]['share']:g}")
