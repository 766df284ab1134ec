"""What ``orbit`` and ``simulate`` report about a filmed wingbeat."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import numpy as np

from wingbeat._base import NOMENCLATURE, FaultList, for_people, plain_unit, written
from wingbeat.aero import BladeElement
from wingbeat.animal.species.species import Species
from wingbeat.cli.arguments import option
from wingbeat.experiment.body_path import fit_body_path
from wingbeat.experiment.film import WHOLE
from wingbeat.experiment.film_file import read_film
from wingbeat.experiment.film_fit import FilmedBeat, fit_film
from wingbeat.mechanics.flight_model import FlightModel
from wingbeat.results.flight import CarriedFlight, carry
from wingbeat.words.orbit_words import power_label

if TYPE_CHECKING:
    from wingbeat.results.orbit import Orbit
    from wingbeat.results.spread import Spread

# Number of random draws of the film that are solved for an error bar, which is then accurate to an eighth.
DRAWS = 32
Kinematics = Annotated[
    Path | None, option("A filmed wingbeat (.csv): time [s], or phase in beats, with flap_deg, pitch_deg, ...")
]
Side = Annotated[
    Literal["both", "left", "right"] | None,
    option("With --kinematics: the wing to read where left and right were filmed; default: their mean."),
]
_POWERS = ("mean_power", "mean_positive_power", "peak_power")


def filmed_beat(kinematics: Path, side: str | None) -> FilmedBeat:
    """Read a film and fit its wingbeat."""
    return fit_film(read_film(kinematics, side or "both"))


def check_side(faults: FaultList, side: str | None, kinematics: Path | None) -> None:
    """Note a side that is chosen without a film."""
    if side is not None and kinematics is None:
        faults.add(
            "--side", side, "chooses a wing of a film, but there is none", "give --kinematics, or leave it out"
        )


def film_record(beat: FilmedBeat) -> dict[str, Any]:
    """Return the spline fits of a film, fit for JSON."""
    laws = {
        name: {"frames": law.frames, "residual_sd": law.residual_sd, "degrees_of_freedom": law.degrees}
        for name, law in beat.laws.items()
    }
    film = beat.film
    clock = {"frequency": film.frequency, "frequency_se": film.frequency_se, "frequency_fitted": film.fitted}
    named = {"film": film.name, "synthetic": film.synthetic} | clock
    return named | {"laws": laws, "notes": list(beat.notes), "warnings": list(beat.warnings)}


def film_lines(beat: FilmedBeat) -> list[str]:
    """Describe the spline fits of a film, with a line for each column, and its notes, but not its warnings."""
    lines, film = [], beat.film
    if film.fitted and film.frequency is not None and film.clip is not None:
        shown = written(film.frequency, film.frequency_se, "Hz")
        stated = f"; its file says {film.stated:.5g} Hz" if film.stated else ""
        lines.append(
            f"{film.name}: frequency {shown}, fitted to the {film.clip.beats:.2g} beats of the clip{stated}"
        )
    for name, law in beat.laws.items():
        unit = f"of the {WHOLE[name]}" if name in WHOLE else "deg"
        lines.append(
            f"{beat.film.name}, {name}: {law.frames} frames, residual {law.residual_sd:.2g} {unit}, spline "
            f"with {law.degrees:.3g} degrees of freedom"
        )
    return [*lines, *(f"note: {note}" for note in beat.notes if note not in beat.warnings)]


def spread_record(spread: Spread) -> dict[str, Any]:
    """Return the standard errors of an orbit, fit for JSON."""
    errors = {name: spread.standard_error(name) for name in spread.values}
    held = {name: spread.limited(name).share for name in spread.values}
    told = {"draws": spread.asked, "draws_certified": spread.certified, "standard_errors": errors}
    return told | {"set_by_limit": {name: share for name, share in held.items() if share}}


def spread_lines(spread: Spread, orbit: Orbit) -> list[str]:
    """Return lines with the powers and trims of an orbit and their standard errors."""
    record, lines = orbit.record(), []
    for name in _POWERS:
        lines.append(f"{power_label(name)}: {_shown(spread, name, record[name], plain_unit(name))}")
    for name in orbit.problem.free:
        value = record["wingbeat"].get(name)
        if value is None:
            continue  # a harmonic, which stands in a list
        factor, unit = for_people(NOMENCLATURE[name].unit)
        lines.append(f"trimmed {name.replace('_', ' ')}: {_shown(spread, f'wingbeat.{name}', value, unit, factor)}")
    edge = "; the other draws have none: the wingbeat is close to the limit of flight, and errors may be larger"
    ending = "" if spread.certified == spread.asked else edge
    flown = f"{spread.certified} of {spread.asked} random draws of the film have an orbit"
    return [*lines, f"one standard error; {flown}{ending}"]


def _shown(spread: Spread, name: str, value: float, unit: str, factor: float = 1.0) -> str:
    """Return a number of the orbit with its standard error, or with the limit that set it in the draws."""
    error = spread.standard_error(name) if name in spread.values else None
    if error is None:
        return plus_minus(factor * value, None, unit)
    return spread.limited(name).shown(value, error, unit, factor)


def plus_minus(value: float, error: float | None, unit: str = "") -> str:
    """Return a value and its error, which may not be known, to the digits that the error decides.

    >>> plus_minus(25.1234, 0.812), plus_minus(25.1234, None, "W")
    ('25.1 +- 0.8', '25.12 +- ? W')
    """
    return written(value, math.nan if error is None else error, unit)


# --- a film that shows the body too: the body then moves as filmed, not as computed ---

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
_WORDS = {"missing_force_x": "thrust", "missing_force_z": "upward force", "missing_moment": "nose-up moment"}
# A missing force below this share of the weight, or moment of weight times chord, is less than models differ by.
_TRIMMED = 0.05


def carried(
    beat: FilmedBeat,
    animal: Species,
    aero: BladeElement,
    given: Mapping[str, float | None],
    beats: int,
    samples: int,
) -> tuple[CarriedFlight, dict[str, float | None], list[str]]:
    """Return the flight of a filmed body with filmed wings, the standard errors of its summary, and warnings.

    The errors are those of the noise of the filmed wing motion and of the filmed path of the body.
    `given` holds u, w and body pitch where the film does not show them; a pitch rate is refused.
    """
    faults = FaultList()
    if given.get("pitch_rate") is not None:
        rule = "is not needed: the film gives the motion of the body"
        faults.add("--pitch-rate", given["pitch_rate"], rule, "leave it out")
    faults.raise_if_any()
    path = fit_body_path(beat, given.get("u"), given.get("w"), given.get("body_pitch"))
    model = FlightModel(animal.vehicle, aero, animal.air, velocity=path.velocity)
    flight = carry(model, animal.wingbeat, path, beats, samples, species=animal)
    told, rows = flight.summary, []
    wings = beat.draws(flight.wingbeat, DRAWS)
    for wingbeat, moved in zip(wings, path.draws(len(wings)), strict=True):
        # The body keeps the beat of the film.
        same = dataclasses.replace(wingbeat, frequency=path.frequency)
        rows.append([*carry(flight.model, same, moved, 1, samples).summary.values()])
    warnings = [*path.warnings]
    if animal.vehicle.tail is not None:
        warnings.append(_of_the_tail(flight))
    if not rows:
        return flight, dict.fromkeys(told), warnings
    errors = np.sqrt(np.mean((np.array(rows) - [*told.values()]) ** 2, axis=0))
    return flight, dict(zip(told, errors.tolist(), strict=True)), warnings


def _of_the_tail(flight: CarriedFlight) -> str:
    """Say at which tilt the tail, which no film shows, would balance the pitching moment."""
    here = flight.wingbeat.tail_tilt
    said = f"{math.degrees(here):.3g} deg, is not filmed (--set wingbeat.tail_tilt_deg=..)"
    if (found := flight.balanced()) is None:
        return f"the tail's tilt, {said}; no tilt within 30 deg balances the pitching moment"
    tilt, told = math.degrees(found.wingbeat.tail_tilt), found.summary
    x, z = (told[f"missing_force_{axis}_mean"] for axis in "xz")
    return (
        f"the tail's tilt, {said}; at {tilt:.3g} deg it would balance the pitching moment, and the "
        f"missing force would be {x:.2g} of the weight forward and {z:.2g} up"
    )


def missing(told: Mapping[str, float], errors: Mapping[str, float | None]) -> list[str]:
    """Return the forces and the moment that are missing on average, by more than two errors and `_TRIMMED`."""
    means = {name: (abs(told[f"{name}_mean"]), errors[f"{name}_mean"] or 0.0) for name in _MISSING}
    return [name for name, (mean, error) in means.items() if not mean <= max(_TRIMMED, 2.0 * error)]


def print_carried(told: Mapping[str, float], errors: Mapping[str, float | None]) -> None:
    """Print velocities, body pitch and powers of a flight whose body moves as filmed, and what the model lacks.

    The model lacks the force and moment that must be added to its air loads to give the filmed motion.
    """
    verdict = f"yes, no missing force or moment above {_TRIMMED:g} on average"
    found = []
    for name in missing(told, errors):
        mean, error = told[f"{name}_mean"], errors[f"{name}_mean"]
        short = "too little" if mean > 0 else "too much"
        found.append(f"{plus_minus(abs(mean), error, _MISSING[name][1])} {short} {_WORDS[name]}")
    if found:
        verdict = f"no, on average the model gives {'; '.join(found)}"
    print(f"trimmed: {verdict}")
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
