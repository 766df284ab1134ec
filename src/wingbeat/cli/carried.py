"""What ``simulate`` reports if the film shows the body too: the body then moves as filmed, not as computed."""

from __future__ import annotations

import dataclasses
import json as json_format
from collections.abc import Mapping
from typing import Any

import numpy as np

from wingbeat._base import NOMENCLATURE, FaultList, for_people
from wingbeat.aero import BladeElement
from wingbeat.animal.species.record import Species
from wingbeat.cli.filmed import DRAWS, film_lines, film_record, plus_minus
from wingbeat.experiment import BodyPath, FilmedBeat, fit_body_path
from wingbeat.mechanics.flight_model import FlightModel
from wingbeat.results.flight import CarriedFlight, carry

# Numbers of the summary: what they are called, and what in the table of names has their unit.
_NAMES = {
    "mean_u": ("mean forward velocity", "u"),
    "mean_w": ("mean upward velocity", "w"),
    "mean_body_pitch": ("mean body pitch", "body_pitch"),
    "mean_power": ("mean power of the hinges", "hinge_power"),
    "mean_positive_power": ("mean positive power of the hinges", "hinge_power"),
    "mean_actuator_power": ("mean power of all actuators", "actuator_power"),
}
_MISSING = {
    "missing_force_x": ("missing force forward", "of the weight"),
    "missing_force_z": ("missing force up", "of the weight"),
    "missing_moment": ("missing moment nose-up", "of weight times chord"),
}


def carried(
    beat: FilmedBeat,
    animal: Species,
    aero: BladeElement,
    given: Mapping[str, float | None],
    beats: int,
    samples: int,
) -> tuple[CarriedFlight, dict[str, float | None]]:
    """Return the flight of a filmed body with filmed wings, and the standard errors of its summary.

    The errors include the noise of the filmed wing motion, but not the noise of the filmed path of the body.

    Parameters
    ----------
    beat : the film's wingbeat.
    animal : with that wingbeat.
    aero : the air loads.
    given : u, w and body pitch where the film does not show them; a pitch rate is refused.
    beats, samples : as in `carry`.

    Raises
    ------
    InvalidInputError : a pitch rate, and inputs that `fit_body_path` refuses.
    """
    faults = FaultList()
    if given.get("pitch_rate") is not None:
        rule = "is not needed: the film gives the motion of the body"
        faults.add("--pitch-rate", given["pitch_rate"], rule, "leave it out")
    faults.raise_if_any()
    path = fit_body_path(beat, given.get("u"), given.get("w"), given.get("body_pitch"))
    model = FlightModel(animal.vehicle, aero, animal.air, velocity=path.velocity)
    flight = carry(model, animal.wingbeat, path, beats, samples, species=animal)
    return flight, _errors(flight, beat, path, samples)


def _errors(flight: CarriedFlight, beat: FilmedBeat, path: BodyPath, samples: int) -> dict[str, float | None]:
    told, rows = flight.summary, []
    for wingbeat in beat.draws(flight.wingbeat, DRAWS):
        # The body keeps the beat of the film.
        same = dataclasses.replace(wingbeat, frequency=path.frequency)
        rows.append([*carry(flight.model, same, path, 1, samples).summary.values()])
    if not rows:
        return dict.fromkeys(told)
    errors = np.sqrt(np.mean((np.array(rows) - [*told.values()]) ** 2, axis=0))
    return dict(zip(told, errors.tolist(), strict=True))


def report_carried(
    flight: CarriedFlight,
    errors: Mapping[str, float | None],
    beat: FilmedBeat,
    warnings: list[str],
    json: bool,
) -> None:
    """Print velocities, body pitch and powers of a flight whose body moves as filmed, and what the model lacks.

    The model lacks the force and moment that must be added to its air loads to give the filmed motion.

    Parameters
    ----------
    flight, errors : from `carried`.
    beat : the film's wingbeat.
    warnings : of the flight and the film; part of the JSON, and otherwise left to the caller.
    json : whether to print JSON and nothing else.
    """
    told = flight.summary
    if json:
        record: dict[str, Any] = {"body": "prescribed", "summary": told, "standard_errors": errors}
        record |= {"warnings": warnings, "kinematics": film_record(beat)}
        print(json_format.dumps(record, indent=2, allow_nan=False))
        return
    print("the body moves as filmed; its motion is not integrated")
    for name, (label, series) in _NAMES.items():
        (factor, unit), error = for_people(NOMENCLATURE[series].unit), errors[name]
        print(f"{label}: {plus_minus(factor * told[name], None if error is None else factor * error, unit)}")
    for name, (label, unit) in _MISSING.items():
        mean = plus_minus(told[f"{name}_mean"], errors[f"{name}_mean"], unit)
        print(f"{label}: mean {mean}, rms {told[f'{name}_rms']:.3g}")
    short = told["missing_force_z_mean"]
    held = f"{1.0 - short:.0%} of the weight" if abs(short) > 0.005 else "the weight"
    print(f"on average the model's wings and body hold up {held}")
    for line in film_lines(beat):
        print(line)
