"""``wingbeat orbit``: find and certify the wingbeat that flies at a speed."""

from __future__ import annotations

import json as json_format
import math
from pathlib import Path
from typing import Annotated, Any

from cyclopts import Parameter
from rich.console import Console

from wingbeat._base import FaultList, Line
from wingbeat.animal.species.record import Species
from wingbeat.cli.answer import answer
from wingbeat.cli.app import EXIT_GOOD, EXIT_NOT_CERTIFIED
from wingbeat.cli.filmed import (
    DRAWS,
    Kinematics,
    Side,
    check_side,
    film_lines,
    film_record,
    filmed_beat,
    spread_lines,
    spread_record,
)
from wingbeat.cli.model_options import DEFAULT_MODEL, ModelOptions
from wingbeat.cli.options import (
    SPECIES,
    Climb,
    Output,
    Payload,
    Seed,
    Settings,
    Stable,
    Whole,
    WingsMayCross,
    WithinPlausible,
    check_files,
    check_outputs,
    check_result,
    given_beside,
    unpacking,
    with_stability,
)
from wingbeat.cli.printing import print_report
from wingbeat.cli.progress import progress_bar
from wingbeat.cli.report import print_orbit
from wingbeat.experiment import FilmedBeat
from wingbeat.orbits.problem.filmed import filmed_problem
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.status import Status
from wingbeat.records.numbers import power_account
from wingbeat.results.orbit import Orbit, load_orbit, solve_orbit
from wingbeat.results.sensitivities import Sensitivities, influence_report
from wingbeat.results.sensitivities import sensitivities as differentiate
from wingbeat.results.spread import Spread, orbit_spread

_BESIDE_FROM = ("from_", "power", "json", "output", "plot", "sensitivities", "tornado")


def orbit(
    species: Annotated[str | None, SPECIES] = None,
    *,
    speed: Annotated[float | None, Parameter(help="Mean forward speed [m/s]; 0 is hover.")] = None,
    climb: Climb = 0.0,
    model: ModelOptions = DEFAULT_MODEL,
    flap_amplitude_max: Annotated[
        float | None, Parameter(help="Upper bound of the flap amplitude, half of peak to peak [deg].")
    ] = None,
    within_plausible: WithinPlausible = False,
    minimise: Annotated[
        str | None,
        Parameter(
            help="Quantity to minimise: frequency, power, positive-power, peak-power, cost-of-transport, "
            "peak-flap-torque, body-pitch-range, metabolic-power, ...; default that of the model, "
            "or positive-power if a film gives the frequency."
        ),
    ] = None,
    subject_to: Annotated[
        list[str] | None,
        Parameter(
            consume_multiple=True,
            negative=(),
            help="Limits: 'peak_power<=30' 'body_pitch_range<=10 deg' ...",
        ),
    ] = None,
    stable: Stable = False,
    starts: Annotated[
        Whole | None,
        Parameter(
            help="Number of starts. Default: 6; 12 with limits or if a power is minimised; 24 with your own bounds "
            "or if a peak is minimised."
        ),
    ] = None,
    seed: Seed = 0,
    wings_may_cross: WingsMayCross = False,
    set_: Settings = None,
    payload: Payload = 0.0,
    kinematics: Kinematics = None,
    side: Side = None,
    from_: Annotated[
        Path | None, Parameter(name="--from", help="Solve the problem in this file again, from its inputs alone.")
    ] = None,
    power: Annotated[
        bool,
        Parameter(
            negative="", help="Print the parts of the power, the cost of negative work, and what a spring saves."
        ),
    ] = False,
    json: Annotated[bool, Parameter(negative="", help="Print the record as JSON and nothing else.")] = False,
    output: Output = None,
    plot: Annotated[Path | None, Parameter(help="Draw one page: .png, .pdf or .svg.")] = None,
    sensitivities: Annotated[
        bool, Parameter(negative="", help="Print what the result depends on most, and the prices of bounds.")
    ] = False,
    tornado: Annotated[
        Path | None, Parameter(help="Draw how far each plausible range moves the result: .png, .pdf or .svg.")
    ] = None,
) -> int:
    """Find and certify the wingbeat of minimum frequency, or power, that flies at a speed.

    With --kinematics, the command keeps the filmed motions and solves for the other motions. The errors that it
    prints are due to the noise of the film.
    Exit code 0: certified. 3: nothing certified; the message says what to change.

    Examples: wingbeat orbit pigeon --speed 12 --plot pigeon.png;
    wingbeat orbit bat --speed 8 --aero dickinson --set wing.mass=0.006 -o bat.nc;
    wingbeat orbit bat --speed 8 --minimise positive-power --subject-to 'peak_power<=60';
    wingbeat orbit pigeon --speed 10 --kinematics beat.csv
    """
    beside = given_beside(orbit, locals(), *_BESIDE_FROM)
    faults = FaultList()
    check_result(faults, output)
    check_files(faults, output, plot=plot, tornado=tornado)
    if from_ is not None and beside:
        faults.add("--from", str(from_), "comes with its own inputs", f"leave out {', '.join(beside)}")
    check_side(faults, side, kinematics)
    if within_plausible and kinematics is not None:
        rule = "gives the wingbeat, so it cannot be combined with --within-plausible"
        faults.add("--kinematics", str(kinematics), rule, "leave out one of the two options")
    if model.model == "animal" and kinematics is not None:
        fix = "give the parts of the model instead, such as --aero feathered --inflow momentum"
        faults.add("--model", model.model, "cannot be combined with a film, which gives the wingbeat", fix)
    if from_ is None and species is None:
        faults.add("SPECIES", None, "is missing", "give a name such as pigeon, or a species file")
    if from_ is None and speed is None:
        faults.add("--speed", None, "is missing", "give the mean forward speed in m/s, 0 for hover")
    faults.raise_if_any()
    check_outputs(output, plot, tornado)
    beat = None
    if from_ is not None:
        saved = load_orbit(from_)
        with unpacking(from_):
            problem, starts, seed = saved.problem, saved.inputs["starts"], saved.inputs["seed"]
    else:
        assert species is not None
        assert speed is not None
        animal, whole = model.flown(species, set_, payload)
        bounds, limits = _amplitude_bounds(animal, flap_amplitude_max), with_stability(subject_to, stable)
        if within_plausible and bounds:
            limits.append(f"flap_amplitude<={flap_amplitude_max!r} deg")
        asked: dict[str, Any] = {"climb": climb, "subject_to": limits}
        asked["bounds"] = "plausible" if within_plausible else bounds
        if wings_may_cross:
            asked["wings_may_cross"] = True
        if minimise is not None:
            asked["minimise"] = minimise
        if kinematics is None:
            problem = whole.problem(animal, speed, **asked)
        else:
            beat = filmed_beat(kinematics, side)
            problem = filmed_problem(beat, animal, speed, aero=whole.aero, **asked)
    fit = model.fit()
    found = _solve(problem, starts, seed)
    record, certified = found.record(), found.status is Status.CONVERGED
    if power:
        record["power_account"] = power_account(found.dataset)
    with answer() as given:
        if not json:  # before sensitivities and error bars, which may take minutes
            given.show(lambda: print_orbit(record, Console()))
        influence = differentiate(found) if certified and (sensitivities or tornado) else None
        bars = [] if influence is None else [influence.error_bar(name, fit) for name in influence.values]
        spread = _spread(found, beat) if beat is not None and certified else None
        if not json:
            if influence and sensitivities:
                given.show(lambda: print_report([Line(""), *influence_report(influence, bars)], Console()))
            for line in [*(film_lines(beat) if beat else []), *(spread_lines(spread, found) if spread else [])]:
                given.show(lambda line=line: print(line))
        else:
            if influence and sensitivities:
                record |= {"sensitivities": influence.table(), "rankings": [bar.ranked() for bar in bars]}
            if beat is not None:
                record["kinematics"] = film_record(beat) | (spread_record(spread) if spread else {})
            given.show(lambda: print(json_format.dumps(record, indent=2, allow_nan=False)))
        given.save(output, found.save)
        given.save(plot, lambda path: _draw(found, path))
        if influence:
            given.save(tornado, lambda path: _draw_influence(influence, path))
    return EXIT_GOOD if certified else EXIT_NOT_CERTIFIED


def _amplitude_bounds(animal: Species, most_deg: float | None) -> dict[str, tuple[float, float]]:
    """Return the bounds set by ``--flap-amplitude-max``."""
    if most_deg is None:
        return {}
    least = animal.bounds.get("flap_amplitude", (0.0, 0.0))[0]
    lowest = math.degrees(least)
    faults = FaultList()
    fix = f"the lower bound of the flap amplitude of {animal.name} is {lowest:g} degrees"
    faults.number("--flap-amplitude-max", most_deg, above=lowest, below=180, unit="degrees", fix=fix)
    faults.raise_if_any()
    return {"flap_amplitude": (least, math.radians(most_deg))}


def _draw(found: Orbit, path: Path) -> None:
    """Draw the page of an orbit."""
    from wingbeat.plots import save_figure, wingbeat_page

    save_figure(wingbeat_page(found.dataset), path)


def _draw_influence(influence: Sensitivities, path: Path) -> None:
    """Draw the effects of an orbit's uncertain parameters."""
    from wingbeat.plots import save_figure, tornado_page

    save_figure(tornado_page(influence), path)


def _spread(found: Orbit, beat: FilmedBeat) -> Spread:
    """Return the spread of orbits whose wingbeats are random draws of the film, for error bars."""
    with progress_bar("error bars") as progress:
        return orbit_spread(found, beat.draws(found.problem.species.wingbeat, DRAWS), progress)


def _solve(problem: OrbitProblem, starts: int | None, seed: int) -> Orbit:
    with progress_bar(f"{problem.species.name} at {problem.speed:g} m/s") as progress:
        return solve_orbit(problem, starts, seed, progress)
