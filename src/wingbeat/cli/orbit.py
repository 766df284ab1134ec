"""``wingbeat orbit``: find and certify the wingbeat that flies at a speed."""

from __future__ import annotations

import json as json_format
import math
import os
from pathlib import Path
from typing import Annotated

from cyclopts import Parameter
from rich.console import Console

from wingbeat.cli.app import EXIT_GOOD, EXIT_NOT_CERTIFIED
from wingbeat.cli.influence import print_influence
from wingbeat.cli.options import (
    AeroName,
    BlendWidth,
    Extension,
    ForcePoint,
    Payload,
    Settings,
    Strips,
    Whole,
    aero_with,
    check_outputs,
    fit_of,
    given_beside,
    species_with,
    unpacking,
)
from wingbeat.cli.progress import progress_bar
from wingbeat.cli.report import print_orbit
from wingbeat.errors import FaultList
from wingbeat.orbits.problem import OrbitProblem
from wingbeat.results.orbit import Orbit, load_orbit, solve_orbit
from wingbeat.results.power import power_account
from wingbeat.results.sensitivities import sensitivities as differentiate

FIGURES = (".png", ".pdf", ".svg")
_BESIDE_FROM = ("from_", "power", "json", "output", "plot", "sensitivities", "tornado")


def orbit(
    species: Annotated[str | None, Parameter(help="Name of a species, or path of a species file.")] = None,
    *,
    speed: Annotated[float | None, Parameter(help="Mean forward speed [m/s]; 0 is hover.")] = None,
    climb: Annotated[float, Parameter(help="Mean climb rate [m/s].")] = 0.0,
    aero: AeroName = "su-fan",
    extension: Extension = "mirrored",
    blend_width_deg: BlendWidth = 1.0,
    force_point: ForcePoint = "quarter-chord",
    flap_amplitude_max: Annotated[
        float | None, Parameter(help="Upper bound of the flap amplitude, half of peak to peak [deg].")
    ] = None,
    strips: Strips = 10,
    minimise: Annotated[
        str,
        Parameter(
            help="What to make least: frequency, power, positive-power, peak-power, cost-of-transport, "
            "peak-flap-torque, peak-pitch-torque, body-pitch-range, roughness, ..."
        ),
    ] = "frequency",
    subject_to: Annotated[
        list[str] | None,
        Parameter(
            consume_multiple=True,
            negative=(),
            help="Limits to keep: 'peak_power<=30' 'body_pitch_range<=10 deg' ...",
        ),
    ] = None,
    starts: Annotated[Whole, Parameter(help="Number of searches; more find better optima.")] = 6,
    seed: Annotated[Whole, Parameter(help="Seed of the random starts.")] = 0,
    set_: Settings = None,
    payload: Payload = 0.0,
    from_: Annotated[
        Path | None, Parameter(name="--from", help="Solve again what this file holds, from its inputs alone.")
    ] = None,
    power: Annotated[
        bool, Parameter(negative="", help="Say what the power is made of, what braking costs, what a spring saves.")
    ] = False,
    json: Annotated[bool, Parameter(negative="", help="Print the record as JSON and nothing else.")] = False,
    output: Annotated[
        Path | None, Parameter(name=["--output", "-o"], help="Write the time series to this NetCDF file.")
    ] = None,
    plot: Annotated[Path | None, Parameter(help="Draw one page: .png, .pdf or .svg.")] = None,
    sensitivities: Annotated[
        bool, Parameter(negative="", help="Say what the answer hangs on, what bounds cost, and how sure it is.")
    ] = False,
    tornado: Annotated[
        Path | None, Parameter(help="Draw what every plausible range can change: .png, .pdf or .svg.")
    ] = None,
) -> int:
    """Find the wingbeat of least frequency, or power, that flies at a speed, and certify it.

    Exit code 0: certified. 3: nothing certified, the message says what to change.

    Examples: wingbeat orbit pigeon --speed 12 --plot pigeon.png;
    wingbeat orbit bat --speed 8 --aero dickinson --set wing.mass=0.006 -o bat.nc;
    wingbeat orbit bat --speed 8 --minimise positive-power --subject-to 'peak_power<=60'
    """
    beside = given_beside(orbit, locals(), *_BESIDE_FROM)
    faults = FaultList()
    for option, figure in (("--plot", plot), ("--tornado", tornado)):
        if figure is not None and figure.suffix.lower() not in FIGURES:
            faults.add(option, str(figure), "is not a figure's name", f"end it in {', '.join(FIGURES)}")
        if figure and output and os.path.realpath(figure) == os.path.realpath(output):
            faults.add(option, str(figure), "is the file of --output too", "give each its own")
    if plot and tornado and os.path.realpath(plot) == os.path.realpath(tornado):
        faults.add("--tornado", str(tornado), "is the file of --plot too", "give each its own")
    if from_ is not None and beside:
        faults.add("--from", str(from_), "comes with its own inputs", f"leave out {', '.join(beside)}")
    if from_ is None and species is None:
        faults.add("SPECIES", None, "is missing", "give a name such as pigeon, or a species file")
    if from_ is None and speed is None:
        faults.add("--speed", None, "is missing", "give the mean forward speed in m/s, 0 for hover")
    faults.raise_if_any()
    if from_ is not None:
        saved = load_orbit(from_)
        with unpacking(from_):
            problem, starts, seed = saved.problem, saved.inputs["starts"], saved.inputs["seed"]
    else:
        assert species is not None
        assert speed is not None
        animal = species_with(species, set_, payload)
        bounds = {}
        if flap_amplitude_max is not None:
            least = animal.bounds.get("flap_amplitude", (0.0, 0.0))[0]
            lowest = math.degrees(least)
            faults.number(
                "--flap-amplitude-max",
                flap_amplitude_max,
                above=lowest,
                below=180,
                unit="degrees",
                fix=f"the flap amplitude of {animal.name} is searched from {lowest:g} degrees up",
            )
            faults.raise_if_any()
            bounds = {"flap_amplitude": (least, math.radians(flap_amplitude_max))}
        loads = aero_with(aero, extension, blend_width_deg, strips, force_point)
        problem = OrbitProblem(
            animal,
            speed=speed,
            climb=climb,
            aero=loads,
            bounds=bounds,
            minimise=minimise,
            subject_to=subject_to or (),
        )
    check_outputs(output, plot, tornado)
    found = _solve(problem, starts, seed)
    if output:
        found.save(output)
    if plot:
        from wingbeat.plots import save_figure, wingbeat_page

        save_figure(wingbeat_page(found.dataset), plot)
    record = found.record()
    certified = record["status"] == "converged"
    influence, bars = None, []
    if certified and (sensitivities or tornado):
        influence = differentiate(found)
        bars = [influence.error_bar(name, fit_of(aero)) for name in influence.values]
    if influence and tornado:
        from wingbeat.plots import save_figure, tornado_page

        save_figure(tornado_page(influence), tornado)
    if influence and sensitivities:
        record |= {"sensitivities": influence.table(), "error_bars": [bar._asdict() for bar in bars]}
    if power:
        record["power_account"] = power_account(found.dataset)
    if json:
        print(json_format.dumps(record, indent=2, allow_nan=False))
    else:
        print_orbit(record, Console())
        if influence and sensitivities:
            print_influence(influence, bars, Console())
    return EXIT_GOOD if certified else EXIT_NOT_CERTIFIED


def _solve(problem: OrbitProblem, starts: int, seed: int) -> Orbit:
    with progress_bar(f"{problem.species.name} at {problem.speed:g} m/s") as progress:
        return solve_orbit(problem, starts, seed, progress)
