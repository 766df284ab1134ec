"""``wingbeat curve``: power and frequency against speed, with every branch, jump and characteristic speed."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from wingbeat._base import FaultList
from wingbeat.cli import problem_options as options
from wingbeat.cli.arguments import (
    Output,
    Seed,
    Whole,
    check_outputs,
    check_result,
    figure,
    flag,
    option,
    parse_range,
    several,
)
from wingbeat.cli.plot import page_of
from wingbeat.cli.terminal import deliver, progress_bar
from wingbeat.experiment import read_flights
from wingbeat.results.curve import REFINEMENTS, solve_curve
from wingbeat.words.curve_words import curve_report


def curve(
    species: Annotated[str, options.SPECIES],
    *,
    speeds: Annotated[
        list[str],
        several("Speeds [m/s]: numbers, or start:stop:step. 0 3:20:1 is hover, and 3 to 20 m/s in steps of 1."),
    ],
    climb: options.Climb = 0.0,
    model: options.ModelOptions = options.DEFAULT_MODEL,
    within_plausible: options.WithinPlausible = False,
    minimise: Annotated[
        str | None,
        option("Quantity to minimise at each speed: frequency, positive-power, ...; default that of the model."),
    ] = None,
    subject_to: options.Limits = None,
    stable: options.Stable = False,
    power_limit: Annotated[
        float | None,
        option(
            "Sustainable power [W] of the kind that is minimised; the slowest and the fastest speed within it "
            "are printed."
        ),
    ] = None,
    starts: Annotated[
        Whole, option("Number of starts at the first and last speed; other speeds get a third as many.")
    ] = 6,
    refinements: Annotated[
        Whole, option("Most speeds to add until each characteristic speed is known to 0.1 m/s; 0 adds none.")
    ] = REFINEMENTS,
    seed: Seed = 0,
    set_: options.Settings = None,
    json: Annotated[bool, flag("Print the curve as JSON and nothing else.")] = False,
    output: Output = None,
    plot: Annotated[Path | None, figure("Draw power and frequency")] = None,
    data: Annotated[
        Path | None,
        option(
            "Your own measured flights (.csv), for table and figure: speed [m/s], and frequency [Hz], mechanical "
            "power [W] or metabolic power [W], each with or without an error."
        ),
    ] = None,
) -> int:
    """Find the curves of power and frequency against speed, their branches and their characteristic speeds.

    Every optimum found is continued to the next lower and higher speeds. A mark on the curve shows where the best
    orbit changes branch or reaches other bounds. The characteristic speeds are those of the quantity that is
    minimised: to get the speeds of minimum power and of greatest range, minimise a power.
    Exit code 0: some speeds are certified, and gaps are reported. 3: no speed is certified.

    Examples: wingbeat curve pigeon --speeds 3:20:1 --minimise positive-power --plot pigeon.png;
    wingbeat curve bat --speeds 0 3:20:1 --minimise positive-power --power-limit 4 -o bat.nc;
    wingbeat curve pigeon --speeds 3:14:1 --model animal --data flights.csv --plot flights.png
    """
    faults = FaultList()
    check_result(faults, output, plot=plot)
    faults.raise_if_any()
    row = sorted(float(speed) for text in speeds for speed in parse_range(text, "--speeds"))
    asked = {"climb": climb, "minimise": minimise, "subject_to": options.limits_of(subject_to, stable)}
    problem = model.problem(species, row[-1] if row else 0.0, set_, within_plausible=within_plausible, **asked)
    check_outputs(output, plot)
    flights = None if data is None else read_flights(data)  # before the search, which takes longer
    with progress_bar(f"{problem.species.name} along speed") as progress:
        found = solve_curve(problem, row, starts, seed, power_limit, progress, refinements=refinements)
    record = found.record() | ({} if flights is None else {"measured": found.compare(flights)})
    return deliver(
        record,
        curve_report(record),
        len(found.gaps) != len(row),
        json=json,
        output=output,
        save=found.save,
        plot=plot,
        page=lambda: page_of(found, flights),
    )
