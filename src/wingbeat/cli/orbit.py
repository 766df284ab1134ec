"""``wingbeat orbit``: find and certify the wingbeat that flies at a speed."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Annotated, Any

from wingbeat._base import FaultList, Line
from wingbeat.animal.species.species import Species
from wingbeat.cli import filmed
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
    several,
)
from wingbeat.cli.process import EXIT_GOOD, EXIT_NOT_CERTIFIED
from wingbeat.cli.terminal import answer, print_json, print_report, progress_bar
from wingbeat.orbits.options import Status
from wingbeat.orbits.problem.filmed import filmed_problem, trimmed
from wingbeat.orbits.problem.quantities import WingbeatLimit
from wingbeat.records.numbers import power_account
from wingbeat.results.optimum import trace_report
from wingbeat.results.orbit import load_orbit, solve_orbit
from wingbeat.results.sensitivities import influence_report
from wingbeat.results.sensitivities import sensitivities as differentiate
from wingbeat.results.spread import orbit_spread
from wingbeat.words.orbit_words import orbit_report

_BESIDE_FROM = ("from_", "power", "json", "output", "plot", "trace", "sensitivities", "tornado")


def orbit(
    species: Annotated[str | None, options.SPECIES] = None,
    *,
    speed: Annotated[float | None, options.SPEED] = None,
    climb: options.Climb = 0.0,
    model: options.ModelOptions = options.DEFAULT_MODEL,
    flap_amplitude_max: Annotated[
        float | None, option("Upper bound of the flap amplitude, half of peak to peak [deg].")
    ] = None,
    within_plausible: options.WithinPlausible = False,
    minimise: Annotated[
        str | None,
        option(
            "Quantity to minimise: frequency, power, positive-power, peak-power, cost-of-transport, "
            "peak-flap-torque, body-pitch-range, metabolic-power, ...; default that of the model, or with "
            "--model paper positive-power if a film gives the frequency."
        ),
    ] = None,
    subject_to: Annotated[
        list[str] | None, several("Limits: 'peak_power<=30' 'body_pitch_range<=10 deg' ...")
    ] = None,
    stable: options.Stable = False,
    starts: Annotated[
        Whole | None,
        option(
            "Number of starts. Default: 6; 12 with limits or if a power is minimised; 24 with your own bounds "
            "or if a peak is minimised."
        ),
    ] = None,
    seed: Seed = 0,
    wings_may_cross: options.WingsMayCross = False,
    set_: options.Settings = None,
    payload: options.Payload = 0.0,
    kinematics: filmed.Kinematics = None,
    side: filmed.Side = None,
    from_: Annotated[
        Path | None, option("Solve the problem in this file again, from its inputs alone.", "--from")
    ] = None,
    power: Annotated[
        bool, flag("Print the parts of the power, the cost of negative work, and what a spring saves.")
    ] = False,
    json: Annotated[bool, flag("Print the record as JSON and nothing else.")] = False,
    output: Output = None,
    plot: Annotated[Path | None, figure("Draw one page")] = None,
    start: Annotated[
        Path | None,
        option(
            "Start the first search from this orbit (.nc) or film (.csv). --starts then counts it too; default 1."
        ),
    ] = None,
    trace: Annotated[bool, flag("Print objective, residual and step of each iteration of the solver.")] = False,
    sensitivities: Annotated[
        bool, flag("Print what the result depends on most, and the prices of bounds.")
    ] = False,
    tornado: Annotated[Path | None, figure("Draw how far each plausible range moves the result")] = None,
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
    check_result(faults, output, kinematics, start, from_, *model.files, plot=plot, tornado=tornado)
    if from_ is not None and beside:
        faults.add("--from", str(from_), "comes with its own inputs", f"leave out {', '.join(beside)}")
    filmed.check_side(faults, side, kinematics)
    if within_plausible and kinematics is not None:
        rule = "gives the wingbeat, so it cannot be combined with --within-plausible"
        faults.add("--kinematics", str(kinematics), rule, "leave out one of the two options")
    if from_ is None and species is None:
        faults.add("SPECIES", None, "is missing", "give a name such as pigeon, or a species file")
    if from_ is None and speed is None:
        faults.add("--speed", None, "is missing", "give the mean forward speed in m/s, 0 for hover")
    faults.raise_if_any()
    check_outputs(output, plot, tornado)
    beat = None
    begun: Any = None  # where the first search starts
    if start is not None:
        begun = filmed.filmed_beat(start, None) if start.suffix.lower() == ".csv" else load_orbit(start)
    if from_ is not None:
        saved = load_orbit(from_)
        with options.unpacking(from_):
            problem, starts, seed = saved.problem, saved.inputs["starts"], saved.inputs["seed"]
            begun = saved.inputs.get("start")
    else:
        assert species is not None
        assert speed is not None
        animal, whole = model.flown(species, set_, payload)
        bounds, limits = _amplitude_bounds(animal, flap_amplitude_max), options.limits_of(subject_to, stable)
        if within_plausible:  # which takes the place of other bounds
            limits += [WingbeatLimit(name, "<=", most) for name, (_, most) in bounds.items()]
        asked: dict[str, Any] = {"climb": climb, "subject_to": limits}
        asked["bounds"] = "plausible" if within_plausible else bounds
        asked |= {"wings_may_cross": True} if wings_may_cross else {}
        asked |= {} if minimise is None else {"minimise": minimise}
        if kinematics is None:
            # Of a wing that gives way, too, the force acts where it was asked to.
            own = {"aero": whole.aero} if model.force_point and animal.wingbeat.pitch_hinge else {}
            problem = whole.problem(animal, speed, **own, **asked)
        else:
            beat = filmed.filmed_beat(kinematics, side)
            if model.model == "animal":
                animal, free, asked = trimmed(beat, animal, asked)
                problem = whole.problem(animal, speed, free=free, **asked)
            else:
                problem = filmed_problem(beat, animal, speed, aero=whole.aero, **asked)
    fit = model.fit()
    with progress_bar(f"{problem.species.name} at {problem.speed:g} m/s") as progress:
        found = solve_orbit(problem, starts, seed, progress, start=begun, trace=trace)
    record, certified = found.record(), found.status is Status.CONVERGED
    if power:
        record["power_account"] = power_account(found.dataset)
    with answer() as given:
        if not json:  # before sensitivities and error bars, which may take minutes
            given.show(lambda: print_report(orbit_report(record)))
            if trace:
                given.show(lambda: print_report([Line(""), *trace_report(record["trace"], record["objective"])]))
        if certified and (sensitivities or tornado):
            influence = differentiate(found)
            bars = [influence.error_bar(name, fit) for name in influence.values]
            if sensitivities:
                record |= {"sensitivities": influence.table(), "rankings": [bar.ranked() for bar in bars]}
                if not json:
                    given.show(lambda: print_report([Line(""), *influence_report(influence, bars)]))
        else:
            influence = None
        if beat is not None:
            record["kinematics"], lines = filmed.film_record(beat), filmed.film_lines(beat)
            if certified:
                with progress_bar("error bars") as progress:
                    spread = orbit_spread(found, beat.draws(found.problem.species.wingbeat, filmed.DRAWS), progress)
                record["kinematics"] |= filmed.spread_record(spread)
                lines += filmed.spread_lines(spread, found)
            for line in [] if json else lines:
                given.show(lambda line=line: print(line))
        if json:
            given.show(lambda: print_json(record))
        given.save(output, found.save)
        given.draw(plot, found.plot)
        given.draw(tornado, None if influence is None else influence.plot)
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
