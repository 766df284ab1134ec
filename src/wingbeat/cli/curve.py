"""``wingbeat curve``: power and frequency against speed, with every branch, jump and characteristic speed."""

from __future__ import annotations

import json as json_format
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from wingbeat._base import FaultList
from wingbeat.cli.answer import answer
from wingbeat.cli.app import EXIT_GOOD, EXIT_NOT_CERTIFIED
from wingbeat.cli.curve_report import drawn, print_curve
from wingbeat.cli.model_options import DEFAULT_MODEL, ModelOptions
from wingbeat.cli.options import (
    SPECIES,
    Climb,
    Limits,
    Output,
    Seed,
    Settings,
    Stable,
    Whole,
    WithinPlausible,
    check_files,
    check_outputs,
    check_result,
    with_stability,
)
from wingbeat.cli.progress import progress_bar
from wingbeat.cli.ranges import parse_range
from wingbeat.plots.figure_files import save_figure
from wingbeat.results.curve import REFINEMENTS, solve_curve


def curve(
    species: Annotated[str, SPECIES],
    *,
    speeds: Annotated[
        list[str],
        Parameter(
            consume_multiple=True,
            negative=(),
            help="Speeds [m/s]: numbers, or start:stop:step. 0 3:20:1 is hover, and 3 to 20 m/s in steps of 1.",
        ),
    ],
    climb: Climb = 0.0,
    model: ModelOptions = DEFAULT_MODEL,
    within_plausible: WithinPlausible = False,
    minimise: Annotated[
        str | None,
        Parameter(
            help="Quantity to minimise at each speed: frequency, positive-power, ...; default that of the model."
        ),
    ] = None,
    subject_to: Limits = None,
    stable: Stable = False,
    power_limit: Annotated[
        float | None,
        Parameter(
            help="Sustainable power [W] of the kind that is minimised; the slowest and the fastest speed within it "
            "are printed."
        ),
    ] = None,
    starts: Annotated[
        Whole,
        Parameter(help="Number of starts at the first and last speed; other speeds get a third as many."),
    ] = 6,
    refinements: Annotated[
        Whole,
        Parameter(help="Most speeds to add until each characteristic speed is known to 0.1 m/s; 0 adds none."),
    ] = REFINEMENTS,
    seed: Seed = 0,
    set_: Settings = None,
    json: Annotated[bool, Parameter(negative="", help="Print the curve as JSON and nothing else.")] = False,
    output: Output = None,
    plot: Annotated[Path | None, Parameter(help="Draw power and frequency: .png, .pdf or .svg.")] = None,
) -> int:
    """Find the curves of power and frequency against speed, their branches and their characteristic speeds.

    Every optimum found is continued to the next lower and higher speeds. A mark on the curve shows where the best
    orbit changes branch or reaches other bounds. The characteristic speeds are those of the quantity that is
    minimised: to get the speeds of minimum power and of greatest range, minimise a power.
    Exit code 0: some speeds are certified, and gaps are reported. 3: no speed is certified.

    Examples: wingbeat curve pigeon --speeds 3:20:1 --minimise positive-power --plot pigeon.png;
    wingbeat curve bat --speeds 0 3:20:1 --minimise positive-power --power-limit 4 -o bat.nc
    """
    faults = FaultList()
    check_result(faults, output)
    check_files(faults, output, plot=plot)
    faults.raise_if_any()
    row = sorted(float(speed) for text in speeds for speed in parse_range(text, "--speeds"))
    problem = model.problem(
        species,
        row[-1] if row else 0.0,
        set_,
        climb=climb,
        bounds="plausible" if within_plausible else {},
        minimise=minimise,
        subject_to=with_stability(subject_to, stable),
    )
    check_outputs(output, plot)
    with progress_bar(f"{problem.species.name} along speed") as progress:
        found = solve_curve(problem, row, starts, seed, power_limit, progress, refinements=refinements)
    with answer() as given:
        if json:
            given.show(lambda: print(json_format.dumps(found.record(), indent=2, allow_nan=False)))
        else:
            given.show(lambda: print_curve(found))
        given.save(output, found.save)
        given.save(plot, lambda path: save_figure(drawn(found), path))
    return EXIT_NOT_CERTIFIED if len(found.gaps) == len(row) else EXIT_GOOD
