"""``wingbeat stability``: what grows and what decays after a disturbance, at one speed or along speed."""

from __future__ import annotations

import json as json_format
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any

from cyclopts import Parameter

from wingbeat._base import FaultList, Line
from wingbeat.cli.answer import answer
from wingbeat.cli.app import EXIT_GOOD, EXIT_NOT_CERTIFIED
from wingbeat.cli.model_options import DEFAULT_MODEL, ModelOptions
from wingbeat.cli.options import (
    Climb,
    Limits,
    Output,
    Seed,
    Settings,
    Whole,
    WithinPlausible,
    check_files,
    check_outputs,
    check_result,
    given_beside,
    unpacking,
)
from wingbeat.cli.printing import print_report
from wingbeat.cli.progress import progress_bar
from wingbeat.cli.ranges import parse_range
from wingbeat.cli.streams import plain_console
from wingbeat.orbits.status import Status
from wingbeat.plots import save_figure, stability_page
from wingbeat.results.orbit import Orbit, load_orbit, solve_orbit, solve_orbits
from wingbeat.stability.causes import StabilitySensitivities, stability_sensitivities
from wingbeat.stability.causes_report import causes_report
from wingbeat.stability.inputs import check_inputs, compensation
from wingbeat.stability.linear_flight import linearise
from wingbeat.stability.linear_report import linear_report

# Of the state (body pitch, u, w, pitch rate); a pair of complex modes counts once.
_LAST_MODE = 3
_OF_A_FILE = ("source", "inputs", "height", "jumps", "sensitivities", "mode", "output", "json", "plot")


def stability(
    source: Annotated[
        str, Parameter(help="Name of a species, path of a species file, or a saved orbit (.nc).", name="SPECIES")
    ],
    *,
    speed: Annotated[
        str | None,
        Parameter(help="Mean forward speed [m/s], or speeds as start:stop:step; 0 is hover."),
    ] = None,
    climb: Climb = 0.0,
    model: ModelOptions = DEFAULT_MODEL,
    within_plausible: WithinPlausible = False,
    minimise: Annotated[str | None, Parameter(help="Quantity to minimise, as in `wingbeat orbit`.")] = None,
    subject_to: Limits = None,
    starts: Annotated[Whole | None, Parameter(help="Number of starts, as in `wingbeat orbit`.")] = None,
    seed: Seed = 0,
    set_: Settings = None,
    inputs: Annotated[
        list[str] | None,
        Parameter(
            consume_multiple=True,
            negative=(),
            help="Parameters of the wingbeat that may change from beat to beat: frequency flap_mean ... Default: "
            "the free parameters whose jumps harmonics can undo.",
        ),
    ] = None,
    height: Annotated[bool, Parameter(negative="", help="Make the height z part of the state.")] = False,
    jumps: Annotated[
        bool,
        Parameter(
            negative="",
            help="Change the inputs alone, without the harmonics that keep the wing from jumping between beats.",
        ),
    ] = False,
    sensitivities: Annotated[
        bool,
        Parameter(negative="", help="Print which numbers of the animal move the spectral radius most."),
    ] = False,
    mode: Annotated[
        Whole | None,
        Parameter(help="Fly the orbit with this mode, 0 for the fastest growing; write the flight to --output."),
    ] = None,
    output: Output = None,
    json: Annotated[bool, Parameter(negative="", help="Print the numbers as JSON and nothing else.")] = False,
    plot: Annotated[Path | None, Parameter(help="Draw the multipliers and modes: .png, .pdf or .svg.")] = None,
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
    check_result(faults, output)
    check_files(faults, output, plot=plot)
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
        orbit = load_orbit(source)
        with unpacking(Path(source)):
            _ = orbit.problem  # set up here, where a file that lacks something is a fault of the file
        orbits = [orbit]
    else:
        assert speed is not None
        asked: dict[str, Any] = {
            "climb": climb,
            "bounds": "plausible" if within_plausible else {},
            "minimise": minimise,
            "subject_to": subject_to or (),
        }
        speeds = parse_range(speed, "--speed").tolist()
        first = model.problem(source, speeds[0], set_, **asked)
        if inputs is not None:
            check_inputs(faults, inputs, first.vehicle)
            faults.raise_if_any()
            if not jumps:  # refused here, as `linearise` would do after the solve
                compensation(first.species.wingbeat, inputs)
        orbits = _solve([first, *(first.at_speed(one) for one in speeds[1:])], starts, seed)
    answers = [_answer(orbit, inputs, height, jumps) for orbit in orbits]
    found = [one for one in answers if "modes" in one]
    certified = [orbit for orbit in orbits if orbit.status is Status.CONVERGED]
    causes = [stability_sensitivities(orbit) if sensitivities else None for orbit in certified]
    for record, cause in zip(found, causes, strict=True):
        if cause is not None:
            record["sensitivities"] = cause.record()
    for one in answers:
        if "modes" not in one:
            print(f"{one['speed']:g} m/s: {one['status']}: {one['message']}", file=sys.stderr)
    with answer() as given:
        if json:
            told = answers if len(answers) > 1 else answers[0]
            given.show(lambda: print(json_format.dumps(told, indent=2, allow_nan=False)))
        else:
            given.show(lambda: _print(found, causes))
        if mode is not None and certified:
            flown = linearise(certified[0], inputs, smooth=not jumps)
            given.save(output, lambda path: flown.mode_flight(mode).save(path))
        if found:
            given.save(plot, lambda path: save_figure(stability_page(found), path))
    return EXIT_GOOD if found else EXIT_NOT_CERTIFIED


def _answer(orbit: Orbit, inputs: list[str] | None, height: bool, jumps: bool) -> dict[str, Any]:
    """Return the record of a linear flight; of an orbit that is not certified, speed, status and message."""
    if orbit.status is not Status.CONVERGED:
        return {"speed": orbit.inputs["speed"], "status": orbit.status.value, "message": orbit.message}
    return linearise(orbit, inputs, height=height, smooth=not jumps).record()


def _solve(problems: Sequence[Any], starts: int | None, seed: int) -> list[Orbit]:
    with progress_bar(problems[0].species.name) as progress:
        if len(problems) == 1:
            return [solve_orbit(problems[0], starts, seed, progress)]
        return solve_orbits(problems, starts, seed, progress=progress, in_order=True)


def _print(found: Sequence[dict[str, Any]], causes: Sequence[StabilitySensitivities | None]) -> None:
    console = plain_console()
    for record, cause in zip(found, causes, strict=True):
        print_report([*linear_report(record), Line("")], console)
        if cause is not None:
            print_report([*causes_report(cause.record()), Line("")], console)
