"""``wingbeat simulate``: fly from an initial state for some beats, with prescribed wing motion."""

from __future__ import annotations

import dataclasses
import functools
import math
import shlex
import sys
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from rich.table import Table

from wingbeat._base import FaultList
from wingbeat.aero.winds import Wind
from wingbeat.cli import filmed
from wingbeat.cli import problem_options as options
from wingbeat.cli.arguments import (
    Output,
    Whole,
    as_typed,
    check_outputs,
    check_result,
    figure,
    flag,
    given_beside,
    option,
)
from wingbeat.cli.process import EXIT_GOOD, EXIT_NOT_CERTIFIED
from wingbeat.cli.terminal import answer, plain_console
from wingbeat.experiment.film_fit import FilmedBeat
from wingbeat.mechanics.flight_model import FlightModel, State
from wingbeat.mechanics.flights import check_samples
from wingbeat.orbits.problem.filmed import doubts_of, filmed_species
from wingbeat.plots import film_page
from wingbeat.records.numbers import beat_mean
from wingbeat.records.orbit_record import crossing
from wingbeat.results.flight import Flight
from wingbeat.results.flight import simulate as fly
from wingbeat.results.orbit import load_orbit

_BESIDE_FROM = ("from_", "beats", "samples", "u", "w", "body_pitch_deg", "pitch_rate", "json", "output")
_BESIDE_FROM += ("gust", "turbulence", "wind_seed")


def simulate(
    species: Annotated[str | None, options.SPECIES] = None,
    *,
    beats: Annotated[Whole, option("Number of wingbeats.")] = 5,
    samples: Annotated[Whole, option("Samples per wingbeat.")] = 128,
    u: Annotated[
        float | None, option("Initial forward velocity [m/s]; default: 10, or the orbit's with --from.")
    ] = None,
    w: Annotated[float | None, option("Initial upward velocity [m/s].")] = None,
    body_pitch_deg: Annotated[float | None, option("Initial body pitch, nose up [deg].")] = None,
    pitch_rate: Annotated[float | None, option("Initial pitch rate [rad/s].")] = None,
    model: options.ModelOptions = options.DEFAULT_MODEL,
    set_: options.Settings = None,
    kinematics: filmed.Kinematics = None,
    side: filmed.Side = None,
    plot_kinematics: Annotated[Path | None, figure("Draw the film, the fitted spline and its 95 % band")] = None,
    from_: Annotated[
        Path | None, option("Take wingbeat, vehicle, air loads and initial state from this orbit.", "--from")
    ] = None,
    gust: options.Gust = None,
    turbulence: options.Turbulence = None,
    wind_seed: options.WindSeed = 0,
    json: Annotated[bool, flag("Print the beats as JSON and nothing else.")] = False,
    output: Output = None,
) -> int:
    """Fly from an initial state for some wingbeats, with prescribed wing motion.

    The wingbeat comes from the species (change it with --set wingbeat.frequency=7 ...), from an orbit (--from), or
    from a film (--kinematics; the species gives the motions that were not filmed). If the film shows the path of
    the body (body_x_m, body_z_m, body_pitch_deg), the body moves as filmed, and the command prints the force and
    moment that the model lacks. To disturb an orbit, give --u, --w, --body-pitch-deg or --pitch-rate; each
    replaces that number in the orbit's initial state. With a film, power is printed with the error due to the
    noise of the film. --gust and --turbulence move the air.
    Exit code 3: the vehicle tumbled and the flight could not be finished.
    """
    beside = given_beside(simulate, locals(), *_BESIDE_FROM)
    faults = FaultList()
    if from_ is None and species is None:
        fix = "give a name such as pigeon, a species file, or --from with an orbit's file"
        faults.add("SPECIES", None, "is missing", fix)
    if from_ is not None and beside:
        faults.add("--from", str(from_), "comes with its own inputs", f"leave out {', '.join(beside)}")
    check_result(faults, output, kinematics, from_, *model.files, plot_kinematics=plot_kinematics)
    filmed.check_side(faults, side, kinematics)
    if plot_kinematics is not None and kinematics is None:
        faults.add("--plot-kinematics", str(plot_kinematics), "has no film to draw", "give --kinematics")
    check_samples(faults, beats, samples)
    faults.raise_if_any()
    check_outputs(output, plot_kinematics)
    options.wind_of(gust, turbulence, wind_seed, airspeed=1.0)  # refuses what it cannot be, before a film is fitted
    given = {"u": u, "w": w, "pitch_rate": pitch_rate}
    given["body_pitch"] = None if body_pitch_deg is None else math.radians(body_pitch_deg)
    disturbed = {name: value for name, value in given.items() if value is not None}
    beat = prescribed = flown_by = given_way = None
    doubts: list[str] = []
    start, hinge = State(u=10.0), None
    if from_ is not None:
        orbit = load_orbit(from_)
        with options.unpacking(from_):
            flown_by, wingbeat, start = orbit.problem.model, orbit.wingbeat, orbit.initial_state
            animal, hinge = orbit.problem.species, orbit.record().get("hinge_start")
            reach = orbit.problem.bounds["flap"]
        start = start._replace(**disturbed)
    else:
        assert species is not None
        animal, whole = model.flown(species, set_)
        if kinematics is not None:
            beat = filmed.filmed_beat(kinematics, side)
            doubts += doubts_of(beat, animal)
            animal = filmed_species(beat, animal)
        wingbeat, reach = animal.wingbeat, animal.path_bounds["flap"]
        if beat is not None and beat.film.shows_body:
            if gust is not None or turbulence is not None:
                rule = "has no effect on a body that moves as filmed"
                faults.add("--gust", gust or turbulence, rule, "leave it out")
                faults.raise_if_any()
            prescribed = filmed.carried(beat, animal, whole.aero, given, beats, samples)
        else:
            start = start._replace(**disturbed)
            velocity, loads = (float(start.u), float(start.w)), whole.aero
            if wingbeat.pitch_hinge is not None and model.force_point is None:  # as in a problem of such a wing
                loads = dataclasses.replace(loads, force_point="centre-of-pressure")
            flown_by = FlightModel(animal.vehicle, loads, animal.air, velocity=velocity)
    if prescribed is not None:
        flight, errors, more = prescribed
        doubts += more
        record: dict[str, Any] = {"body": "prescribed", "trimmed": not filmed.missing(flight.summary, errors)}
        record |= {"summary": flight.summary, "standard_errors": errors}
        report, completed = functools.partial(filmed.print_carried, flight.summary, errors), True
    else:
        assert flown_by is not None
        wind = options.wind_of(gust, turbulence, wind_seed, math.hypot(start.u, start.w))
        flight = fly(flown_by, wingbeat, start, beats, samples, wind=wind, species=animal, hinge=hinge)
        rows, completed = beat_rows(flight, samples), flight.completed
        given_way = None if flight.hinge is None else (flight.phase, flight.hinge[:, 0])
        if beat is not None:
            for row, error in zip(rows, _errors(flight, beat, beats, samples, wind), strict=True):
                row["mean_power_se"] = error
        record = {"completed": completed, "beats": rows}
        report = functools.partial(_print, rows, completed)
    notes = [*crossing(flight.model.vehicle, flight.model.strips, wingbeat, reach, given_way)]
    notes += doubts
    record |= {"warnings": notes} | ({} if beat is None else {"kinematics": filmed.film_record(beat)})
    with answer() as told:
        told.tell(record, report, json)
        for line in filmed.film_lines(beat) if beat and not json else []:
            told.show(lambda line=line: print(line))
        for note in notes:
            print(f"warning: {note}", file=sys.stderr)
        if prescribed is not None and not json:
            speed, climb = (round(prescribed[0].summary[name], 2) for name in ("mean_u", "mean_w"))
            flying = {"speed": f"{speed:g}", "climb": f"{climb:g}" if abs(climb) > 0.05 * speed else None}
            words = as_typed(**flying, kinematics=kinematics, side=side, set=set_) + model.typed()
            words = shlex.join(["wingbeat", "orbit", str(species), *words])
            told.show(lambda: print(f"next, the trim that holds this wingbeat in the air: {words}"))
        told.save(output, flight.save)
        told.draw(plot_kinematics, None if beat is None else lambda: film_page(beat))
    return EXIT_GOOD if completed else EXIT_NOT_CERTIFIED


def _errors(flight: Flight, beat: FilmedBeat, beats: int, samples: int, wind: Wind | None) -> list[float | None]:
    """Return the standard error of each beat's mean power, from flights with random draws of the film."""

    def powers(one: Flight) -> np.ndarray:
        return np.array([row["mean_power"] for row in beat_rows(one, samples)], dtype=float)

    power, start, squares = powers(flight), State(*flight.states[0]), []
    for wingbeat in beat.draws(flight.wingbeat, filmed.DRAWS):
        squares.append((powers(fly(flight.model, wingbeat, start, beats, samples, wind=wind)) - power) ** 2)
    errors = np.sqrt(np.mean(squares, axis=0)) if squares else np.full(beats, np.nan)
    return [float(error) if np.isfinite(error) else None for error in errors]


def beat_rows(flight: Flight, samples: int) -> list[dict[str, Any]]:
    """Return one row per beat: state at its end, mean velocities and mean power; None after the vehicle tumbled."""
    period = 1.0 / flight.wingbeat.frequency
    power = flight.dataset["hinge_power"].to_numpy()
    rows = []
    for beat in range((len(flight.phase) - 1) // samples):
        first, last = flight.states[beat * samples], flight.states[(beat + 1) * samples]
        means = {"mean_u": (last[0] - first[0]) / period, "mean_w": (last[1] - first[1]) / period}
        mean = beat_mean(power[beat * samples : (beat + 1) * samples + 1])
        row = means | dict(zip(State._fields, last, strict=True)) | {"mean_power": mean}
        rows.append({"beat": beat + 1} | {name: float(v) if np.isfinite(v) else None for name, v in row.items()})
    return rows


def _print(rows: list[dict[str, Any]], completed: bool) -> None:
    table = Table("beat", "mean u [m/s]", "mean w [m/s]", "body pitch [deg]", "pitch rate [rad/s]", "power [W]")
    for row in rows:
        pitch = None if row["body_pitch"] is None else math.degrees(row["body_pitch"])
        values = (row["mean_u"], row["mean_w"], pitch, row["pitch_rate"], row["mean_power"])
        shown = ["lost" if v is None else f"{v:.3f}" for v in values]
        if "mean_power_se" in row and row["mean_power"] is not None:
            shown[-1] = filmed.plus_minus(row["mean_power"], row["mean_power_se"])
        table.add_row(str(row["beat"]), *shown)
    console = plain_console()  # as markup, [m/s] would vanish
    console.print(table)
    if not completed:
        console.print("the vehicle tumbled: the flight could not be finished", style="red")
