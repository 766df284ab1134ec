"""``wingbeat curve``: power and frequency against speed, or power, amplitude and activation against frequency."""

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
from wingbeat.cli.plot import check_over_speed, page_of
from wingbeat.cli.terminal import deliver, progress_bar
from wingbeat.experiment import read_flights
from wingbeat.results.curve import REFINEMENTS, solve_curve
from wingbeat.words.curve_words import curve_report


def curve(
    species: Annotated[str, options.SPECIES],
    *,
    speeds: Annotated[
        list[str] | None,
        several("Speeds [m/s]: numbers, or start:stop:step. 0 3:20:1 is hover, and 3 to 20 m/s in steps of 1."),
    ] = None,
    over: Annotated[str, option("What the curve runs over: speed, or frequency at one --speed.")] = "speed",
    frequencies: Annotated[
        list[str] | None, several("Frequencies [Hz] of a curve over frequency, as --speeds: 3:12:0.5.")
    ] = None,
    speed: Annotated[float | None, option("Speed [m/s] of a curve over frequency.")] = None,
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
    plot: Annotated[Path | None, figure("Draw the curve")] = None,
    data: Annotated[
        Path | None,
        option(
            "Your own measured flights (.csv), for table and figure: speed [m/s], and frequency [Hz], mechanical "
            "power [W] or metabolic power [W], each with or without an error."
        ),
    ] = None,
) -> int:
    """Find the curves of power and frequency against speed, with branches and characteristic speeds.

    Every optimum found is continued to the next lower and higher speeds. A mark on the curve shows where the best
    orbit changes branch or reaches other bounds. The characteristic speeds are those of the quantity that is
    minimised: to get the speeds of minimum power and of greatest range, minimise a power.
    With --over frequency, the frequency is given at each point: the curve shows what each costs, and which ones
    muscle allows, beside the animal's own.
    Exit code 0: some points are certified, and gaps are reported. 3: no point is certified.

    Examples: wingbeat curve pigeon --speeds 3:20:1 --minimise positive-power --plot pigeon.png;
    wingbeat curve bat --speeds 0 3:20:1 --minimise positive-power --power-limit 4 -o bat.nc;
    wingbeat curve pigeon --speeds 3:14:1 --model animal --data flights.csv --plot flights.png;
    wingbeat curve pigeon --over frequency --frequencies 3:12:0.5 --speed 14 --model animal --plot frequency.png
    """
    faults = FaultList()
    faults.choice("--over", over, ("speed", "frequency"))
    check_result(faults, output, data, *model.files, plot=plot)
    faults.raise_if_any()
    given = {"--speeds": speeds, "--frequencies": frequencies, "--speed": speed}
    needed = ("--speeds",) if over == "speed" else ("--frequencies", "--speed")
    for name, value in given.items():
        if name in needed and value is None:
            faults.add(name, "", f"is missing: a curve over {over} needs it", f"give {name}")
        elif name not in needed and value is not None:
            faults.add(name, value, f"does not belong to a curve over {over}", "leave it out, or change --over")
    if over == "frequency":
        searched = "frequency" if "frequency" in (model.free or ()) else None
        given = {"--frequency": model.frequency, "--free": searched, "--data": data and str(data)}
        for name, value in given.items():
            if value is not None:
                check_over_speed(faults, name, value, over)
    faults.raise_if_any()
    words, option_name = (speeds, "--speeds") if over == "speed" else (frequencies, "--frequencies")
    row = sorted(float(value) for text in words or () for value in parse_range(text, option_name))
    at = speed if speed is not None else row[-1] if row else 0.0
    asked = {"climb": climb, "minimise": minimise, "subject_to": options.limits_of(subject_to, stable)}
    problem = model.problem(species, at, set_, within_plausible=within_plausible, **asked)
    check_outputs(output, plot)
    flights = None if data is None else read_flights(data)  # before the search, which takes longer
    with progress_bar(f"{problem.species.name} along {over}") as progress:
        more = {"refinements": refinements, "over": over}
        found = solve_curve(problem, row, starts, seed, power_limit, progress, **more)
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
