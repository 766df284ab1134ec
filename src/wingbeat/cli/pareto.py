"""``wingbeat pareto``: what a limit of one quantity costs in another, such as power for stability."""

from __future__ import annotations

import json as json_format
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from wingbeat._base import FaultList
from wingbeat.cli.answer import answer
from wingbeat.cli.app import EXIT_GOOD, EXIT_NOT_CERTIFIED
from wingbeat.cli.model_options import DEFAULT_MODEL, ModelOptions
from wingbeat.cli.options import (
    SPECIES,
    Climb,
    Limits,
    Seed,
    Settings,
    Whole,
    WithinPlausible,
    check_files,
    check_outputs,
)
from wingbeat.cli.printing import print_report
from wingbeat.cli.progress import progress_bar
from wingbeat.cli.ranges import parse_range
from wingbeat.cli.streams import plain_console
from wingbeat.plots import pareto_page, save_figure
from wingbeat.results.pareto import pareto_front
from wingbeat.words.curve_words import pareto_report


def pareto(
    species: Annotated[str, SPECIES],
    *,
    speed: Annotated[float, Parameter(help="Mean forward speed [m/s]; 0 is hover.")],
    limits: Annotated[
        list[str],
        Parameter(
            consume_multiple=True,
            negative=(),
            help="Limits, in SI units and radians: numbers, or start:stop:step, such as 0.9:1.3:0.05.",
        ),
    ],
    against: Annotated[
        str, Parameter(help="Quantity that the limits apply to: spectral_radius, peak_power, ...")
    ] = "spectral_radius",
    at_least: Annotated[bool, Parameter(negative="", help="The limits are lower limits, not upper ones.")] = False,
    climb: Climb = 0.0,
    model: ModelOptions = DEFAULT_MODEL,
    within_plausible: WithinPlausible = False,
    minimise: Annotated[
        str | None,
        Parameter(help="Quantity to minimise, as in `wingbeat orbit`."),
    ] = None,
    subject_to: Limits = None,
    starts: Annotated[Whole | None, Parameter(help="Number of starts for each limit.")] = None,
    seed: Seed = 0,
    set_: Settings = None,
    json: Annotated[bool, Parameter(negative="", help="Print all points as JSON and nothing else.")] = False,
    plot: Annotated[Path | None, Parameter(help="Draw the front: .png, .pdf or .svg.")] = None,
) -> int:
    """Find what a limit costs: the best orbit within each of several limits, and without the limit.

    The answer is a Pareto front: on it, neither quantity can improve unless the other gets worse.
    Exit code 0: some orbits are certified. 3: no orbit is certified.

    Examples: wingbeat pareto pigeon --speed 8 --minimise positive-power --limits 0.9:1.3:0.05 --plot front.png;
    wingbeat pareto bat --speed 6 --against peak_power --limits 4 5 6
    """
    faults = FaultList()
    check_files(faults, None, plot=plot)
    faults.raise_if_any()
    values = [float(limit) for text in limits for limit in parse_range(text, "--limits")]
    problem = model.problem(
        species,
        speed,
        set_,
        climb=climb,
        bounds="plausible" if within_plausible else {},
        minimise=minimise,
        subject_to=subject_to or (),
    )
    check_outputs(plot)
    with progress_bar(f"{problem.species.name}, limits") as progress:
        front = pareto_front(
            problem, against, values, at_most=not at_least, starts=starts, seed=seed, progress=progress
        )
    record = front.record()
    certified = [point for point in record["points"] if point["objective_value"] is not None]
    with answer() as given:
        if json:
            given.show(lambda: print(json_format.dumps(record, indent=2, allow_nan=False)))
        else:
            given.show(lambda: print_report(pareto_report(record), plain_console()))
        if certified:
            given.save(plot, lambda path: save_figure(pareto_page(record), path))
    return EXIT_GOOD if certified else EXIT_NOT_CERTIFIED
