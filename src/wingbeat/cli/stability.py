"""``wingbeat stability``: what grows and what decays after a disturbance, at one speed or along speed."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

from wingbeat._base import FaultList, Line
from wingbeat.cli import problem_options as options
from wingbeat.cli.arguments import (
    Output,
    Seed,
    Whole,
    check_outputs,
    check_result,
    figure,
    flag,
    given_beside,
    option,
    parse_range,
    several,
)
from wingbeat.cli.terminal import deliver, print_report, progress_bar
from wingbeat.orbits.options import Status
from wingbeat.plots import stability_page
from wingbeat.results.orbit import solve_orbit, solve_orbits
from wingbeat.stability.causes import stability_sensitivities
from wingbeat.stability.inputs import compensation
from wingbeat.stability.linear_flight import linearise
from wingbeat.stability.options import check_inputs
from wingbeat.stability.reports import causes_report, linear_report

# Of the state (body pitch, u, w, pitch rate); a pair of complex modes counts once.
_LAST_MODE = 3
_OF_A_FILE = ("source", "inputs", "height", "jumps", "sensitivities", "mode", "output", "json", "plot")


def stability(
    source: Annotated[str, option("Name of a species, path of a species file, or a saved orbit (.nc).", "SPECIES")],
    *,
    speed: Annotated[
        str | None, option("Mean forward speed [m/s], or speeds as start:stop:step; 0 is hover.")
    ] = None,
    climb: options.Climb = 0.0,
    model: options.ModelOptions = options.DEFAULT_MODEL,
    within_plausible: options.WithinPlausible = False,
    minimise: options.Minimise = None,
    subject_to: options.Limits = None,
    starts: options.Starts = None,
    seed: Seed = 0,
    set_: options.Settings = None,
    inputs: Annotated[
        list[str] | None,
        several(
            "Parameters of the wingbeat that may change from beat to beat: frequency flap_mean ... Default: "
            "the free parameters whose jumps harmonics can undo."
        ),
    ] = None,
    height: Annotated[bool, flag("Make the height z part of the state.")] = False,
    jumps: Annotated[
        bool, flag("Change the inputs alone, without the harmonics that keep the wing from jumping between beats.")
    ] = False,
    sensitivities: Annotated[
        bool, flag("Print which numbers of the animal move the spectral radius most.")
    ] = False,
    mode: Annotated[
        Whole | None,
        option("Fly the orbit with this mode, 0 for the fastest growing; write the flight to --output."),
    ] = None,
    output: Output = None,
    json: Annotated[bool, flag("Print the numbers as JSON and nothing else.")] = False,
    plot: Annotated[Path | None, figure("Draw the multipliers and modes")] = None,
) -> int:
    """Find what grows and what decays when an orbit is disturbed, from beat to beat.

    The command prints the modes of body pitch, velocity and pitch rate. --json prints the linear maps from one top
    of the stroke to the next: A of the state, B of the inputs, G of a gust that is constant for one beat. With
    several speeds --json prints a list. The entry of a speed without a certified orbit has status and message.
    Exit code 0: some speeds are certified. 3: no speed is certified.

    Examples: wingbeat stability pigeon --speed 12; wingbeat stability bat.nc --json;
    wingbeat stability pigeon --speed 4:20:2 --plot locus.png; wingbeat stability pigeon --speed 12 --sensitivities;
    wingbeat stability pigeon --speed 12 --mode 0 -o mode.nc
    """
    beside = given_beside(stability, locals(), *_OF_A_FILE)
    faults = FaultList()
    check_result(faults, output, source, *model.files, plot=plot)
    if (mode is None) != (output is None):
        faults.add("--mode", mode, "needs --output, and --output needs --mode", "give both: --mode 0 -o mode.nc")
    saved = source.endswith(".nc")
    if saved and beside:
        faults.add("SPECIES", source, "is an orbit and comes with its own inputs", f"leave out {', '.join(beside)}")
    if not saved and speed is None:
        faults.add("--speed", None, "is missing", "give the mean forward speed in m/s, 0 for hover")
    if inputs is not None:
        check_inputs(faults, inputs)
    if mode is not None:
        faults.whole("--mode", mode, 0, _LAST_MODE, "0 is the fastest growing mode")
    faults.raise_if_any()
    check_outputs(plot, output)
    if saved:
        orbits = [options.saved_orbit(Path(source))]
    else:
        assert speed is not None
        asked = {"climb": climb, "minimise": minimise, "subject_to": subject_to}
        speeds = parse_range(speed, "--speed").tolist()
        first = model.problem(source, speeds[0], set_, within_plausible=within_plausible, **asked)
        if inputs is not None:
            check_inputs(faults, inputs, first.vehicle)
            faults.raise_if_any()
            if not jumps:  # refused here, as `linearise` would do after the solve
                compensation(first.species.wingbeat, inputs)
        problems = [first, *(first.at_speed(one) for one in speeds[1:])]
        with progress_bar(first.species.name) as progress:
            if len(problems) == 1:
                orbits = [solve_orbit(first, starts, seed, progress)]
            else:
                orbits = solve_orbits(problems, starts, seed, progress=progress, in_order=True)
    answers, found, reports = [], [], []
    for orbit in orbits:
        if orbit.status is not Status.CONVERGED:
            failed = {"speed": orbit.inputs["speed"], "status": orbit.status.value, "message": orbit.message}
            answers.append(failed)
            continue
        record = linearise(orbit, inputs, height=height, smooth=not jumps).record()
        reports.append([*linear_report(record), Line("")])
        if sensitivities:
            record["sensitivities"] = stability_sensitivities(orbit).record()
            reports.append([*causes_report(record["sensitivities"]), Line("")])
        found.append(record)
        answers.append(record)
    for one in answers:
        if "modes" not in one:
            print(f"{one['speed']:g} m/s: {one['status']}: {one['message']}", file=sys.stderr)
    certified = [orbit for orbit in orbits if orbit.status is Status.CONVERGED]
    flown = linearise(certified[0], inputs, smooth=not jumps) if mode is not None and certified else None
    return deliver(
        answers if len(answers) > 1 else answers[0],
        lambda: [print_report(report) for report in reports],
        bool(found),
        json=json,
        output=output,
        save=None if flown is None else lambda path: flown.mode_flight(mode or 0).save(path),
        plot=plot,
        page=(lambda: stability_page(found)) if found else None,
    )
