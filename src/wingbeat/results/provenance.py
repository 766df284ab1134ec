"""Everything that went into an orbit, as a dictionary that alone can set up the same problem again."""

from __future__ import annotations

import json
from typing import Any

from wingbeat.aero import BladeElement, TableCoefficients, load_coefficients
from wingbeat.kinematics import Wingbeat
from wingbeat.orbits.objectives import Frequency
from wingbeat.orbits.problem import OrbitProblem
from wingbeat.results.record import aero_record, vehicle_record
from wingbeat.species import Species
from wingbeat.vehicle import Air, Body, Vehicle, Wing

_TABLE = ("name", "alpha_deg", "c_l", "c_d", "x_cp", "citation", "reynolds_range")


def inputs_of(problem: OrbitProblem, starts: int, seed: int) -> dict[str, Any]:
    """Return all inputs of a problem and its search."""
    species, coefficients = problem.species, problem.aero.coefficients
    aero = aero_record(problem.aero)
    if isinstance(coefficients, TableCoefficients):
        aero["table"] = {name: getattr(coefficients, name) for name in _TABLE}
    inputs = {
        "species": {
            "name": species.name,
            "common_name": species.common_name,
            "scientific_name": species.scientific_name,
            "free": species.free,
            "bounds": species.bounds,
            "guessed_bounds": sorted(species.guessed_bounds),
            "body_pitch_bounds": species.body_pitch_bounds,
            "warnings": species.warnings,
        },
        "vehicle": vehicle_record(problem),
        "stock_wingbeat": dict(vars(species.wingbeat)),
        "aero": aero,
        "air": dict(vars(problem.air)),
        "speed": problem.speed,
        "climb": problem.climb,
        "free": problem.free,
        "bounds": problem.bounds,
        "objective": problem.minimise.name,
        "starts": starts,
        "seed": seed,
    }
    return json.loads(json.dumps(inputs))


def problem_from(inputs: dict[str, Any]) -> OrbitProblem:
    """Set up the problem that `inputs_of` described.

    Raises
    ------
    KeyError, TypeError, ValueError : the dictionary is not one of `inputs_of`.
    """
    known, vehicle, aero = inputs["species"], inputs["vehicle"], inputs["aero"]
    wing = dict(vehicle["wing"])
    air = Air(**inputs["air"])
    species = Species(
        name=known["name"],
        common_name=known["common_name"],
        scientific_name=known["scientific_name"],
        vehicle=Vehicle(Body(**vehicle["body"]), Wing(**wing)),
        wingbeat=Wingbeat(**inputs["stock_wingbeat"]),
        air=air,
        free=tuple(known["free"]),
        bounds=_pairs(known["bounds"]),
        guessed_bounds=frozenset(known["guessed_bounds"]),
        body_pitch_bounds=(known["body_pitch_bounds"][0], known["body_pitch_bounds"][1]),
        reasons={},
        numbers={},
        alternatives={},
        warnings=tuple(known["warnings"]),
    )
    return OrbitProblem(
        species,
        speed=inputs["speed"],
        climb=inputs["climb"],
        aero=BladeElement(_coefficients(aero), aero["strips"], aero["force_point"]),
        free=tuple(inputs["free"]),
        bounds=_pairs(inputs["bounds"]),
        minimise=_objective(inputs["objective"]),
        air=air,
    )


def _pairs(bounds: dict[str, list[float]]) -> dict[str, tuple[float, float]]:
    return {name: (low, high) for name, (low, high) in bounds.items()}


def _coefficients(aero: dict[str, Any]) -> Any:
    extension, width = aero["extension"], aero["blend_width_deg"]
    if "table" not in aero:
        return load_coefficients(aero["coefficients"], extension, width)
    table: dict[str, Any] = {key: tuple(v) if isinstance(v, list) else v for key, v in aero["table"].items()}
    return TableCoefficients(**table, extension=extension, blend_width_deg=width)


def _objective(name: str) -> Frequency:
    if name != Frequency().name:
        raise ValueError(f"unknown objective {name!r}")
    return Frequency()
