"""``wingbeat pareto``: what a limit of one quantity costs in another, such as power for stability."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from wingbeat._base import FaultList
from wingbeat.cli import problem_options as options
from wingbeat.cli.arguments import (
    Seed,
    Whole,
    check_files,
    check_outputs,
    figure,
    flag,
    option,
    parse_range,
    several,
)
from wingbeat.cli.terminal import deliver, progress_bar
from wingbeat.results.pareto import pareto_front
from wingbeat.words.curve_words import pareto_report


def pareto(
    species: Annotated[str, options.SPECIES],
    *,
    speed: Annotated[float, options.SPEED],
    limits: Annotated[
        list[str], several("Limits, in SI units and radians: numbers, or start:stop:step, such as 0.9:1.3:0.05.")
    ],
    against: Annotated[
        str, option("Quantity that the limits apply to: spectral_radius, peak_power, ...")
    ] = "spectral_radius",
    at_least: Annotated[bool, flag("The limits are lower limits, not upper ones.")] = False,
    climb: options.Climb = 0.0,
    model: options.ModelOptions = options.DEFAULT_MODEL,
    within_plausible: options.WithinPlausible = False,
    minimise: options.Minimise = None,
    subject_to: options.Limits = None,
    starts: Annotated[Whole | None, option("Number of starts for each limit.")] = None,
    seed: Seed = 0,
    set_: options.Settings = None,
    json: Annotated[bool, flag("Print all points as JSON and nothing else.")] = False,
    plot: Annotated[Path | None, figure("Draw the front")] = None,
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
    asked = {"climb": climb, "minimise": minimise, "subject_to": subject_to}
    problem = model.problem(species, speed, set_, within_plausible=within_plausible, **asked)
    check_outputs(plot)
    with progress_bar(f"{problem.species.name}, limits") as progress:
        front = pareto_front(
            problem, against, values, at_most=not at_least, starts=starts, seed=seed, progress=progress
        )
    record = front.record()
    certified = any(point["objective_value"] is not None for point in record["points"])
    return deliver(
        record, pareto_report(record), certified, json=json, plot=plot, page=front.plot if certified else None
    )
