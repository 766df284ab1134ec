"""All inputs of an orbit, in a dictionary that suffices to set up the same problem again."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

from wingbeat._base import InvalidInputError
from wingbeat.animal.kinematics import Wingbeat
from wingbeat.animal.species.numbers import Range, number_from
from wingbeat.animal.species.record import Species
from wingbeat.animal.species.shape import shape_from, shape_record
from wingbeat.animal.vehicle import Air
from wingbeat.orbits.options.solver import DEFAULTS, SolverOptions
from wingbeat.orbits.problem.limits import Constraint
from wingbeat.orbits.problem.origin import origin_from
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.problem.quantities import Quantity, named_objective, named_quantity
from wingbeat.results.aero_record import OWN, SET_ANEW, NotInFileError, aero_from, aero_inputs
from wingbeat.results.record import vehicle_from, vehicle_record, wingbeat_record


def inputs_of(problem: OrbitProblem, starts: int, seed: int, options: SolverOptions = DEFAULTS) -> dict[str, Any]:
    """Return a problem's inputs, number of starts and seed, and the solver options that differ from defaults."""
    species = problem.species
    inputs = {
        "species": {
            "name": species.name,
            "common_name": species.common_name,
            "scientific_name": species.scientific_name,
            "kind": species.kind,
            "free": species.free,
            "bounds": species.bounds,
            "guessed_bounds": sorted(species.guessed_bounds),
            "path_bounds": species.path_bounds,
            "warnings": species.warnings,
            "numbers": species.numbers,
            "plausible": species.plausible,
            **({} if species.shape is None else {"shape": shape_record(species.shape)}),
        },
        "vehicle": vehicle_record(problem.vehicle),
        "stock_wingbeat": wingbeat_record(species.wingbeat),
        "aero": aero_inputs(problem.aero),
        "air": dict(vars(problem.air)),
        "speed": problem.speed,
        "climb": problem.climb,
        "free": problem.free,
        "bounds": problem.bounds,
        "wings_may_cross": problem.wings_may_cross,
        "objective": _asked_for(problem.minimise),
        "constraints": [
            {"quantity": _asked_for(c.quantity), "limit": c.limit, "at_most": c.at_most} for c in problem.subject_to
        ],
        "starts": starts,
        "seed": seed,
    }
    if problem.origin is not None:
        inputs["model"] = problem.origin.record()
    if options != DEFAULTS:
        inputs["options"] = options.changed()
    return json.loads(json.dumps(inputs))


def problem_from(inputs: dict[str, Any]) -> OrbitProblem:
    """Set up the problem that `inputs_of` described.

    Raises
    ------
    KeyError, TypeError, ValueError : the dictionary was not made by `inputs_of`.
    """
    species = species_from(inputs)
    return OrbitProblem(
        species,
        speed=inputs["speed"],
        climb=inputs["climb"],
        aero=aero_from(inputs["aero"]),
        free=tuple(inputs["free"]),
        bounds=_pairs(inputs["bounds"]),
        wings_may_cross=inputs["wings_may_cross"],
        minimise=_brought_back(named_objective, inputs["objective"]),
        subject_to=[
            Constraint(_brought_back(named_quantity, c["quantity"]), c["limit"], c["at_most"])
            for c in inputs["constraints"]
        ],
        air=species.air,
        origin=origin_from(inputs["model"]) if "model" in inputs else None,
    )


def own_functions(inputs: dict[str, Any]) -> list[str]:
    """Return the names of the user's own objective, quantities and coefficients, which a file cannot restore."""
    names = [inputs["objective"], *(c["quantity"] for c in inputs["constraints"])]
    own = [name for name in names if name.startswith(OWN)]
    aero = inputs["aero"]
    return own + [part["coefficients"] for part in (aero, aero.get("hand", {})) if "function" in part]


def species_from(inputs: dict[str, Any]) -> Species:
    """Set up the species that `inputs_of` described, without its reasons and alternatives, which are not stored.

    Raises
    ------
    KeyError, TypeError, ValueError : the dictionary was not made by `inputs_of`.
    """
    known = inputs["species"]
    return Species(
        name=known["name"],
        common_name=known["common_name"],
        scientific_name=known["scientific_name"],
        kind=known.get("kind", ""),  # a file of a version without kinds has none
        vehicle=vehicle_from(inputs["vehicle"]),
        wingbeat=Wingbeat(**inputs["stock_wingbeat"]),
        air=Air(**inputs["air"]),
        free=tuple(known["free"]),
        bounds=_pairs(known["bounds"]),
        guessed_bounds=frozenset(known["guessed_bounds"]),
        path_bounds=_pairs(known["path_bounds"]),
        reasons={},
        numbers={path: number_from(*number) for path, number in known["numbers"].items()},
        alternatives={},
        # A file of a version that judged nothing has no ranges.
        plausible={name: _plausible_range(*one) for name, one in known.get("plausible", {}).items()},
        warnings=tuple(known["warnings"]),
        shape=shape_from(known["shape"]) if "shape" in known else None,
    )


def _plausible_range(
    low: float | None, high: float | None, unit: str, source: str, speeds: list[float] | None
) -> Range:
    return Range(low, high, unit, source, None if speeds is None else (speeds[0], speeds[1]))


def _pairs(bounds: dict[str, list[float]]) -> dict[str, tuple[float, float]]:
    return {name: (low, high) for name, (low, high) in bounds.items()}


def _asked_for(quantity: Quantity) -> str:
    """Return the name that restores a quantity; for a user's function, a name that the reader refuses."""
    try:
        known = named_objective(quantity.name) == quantity or named_quantity(quantity.name) == quantity
    except InvalidInputError:
        known = False
    return quantity.name if known else f"{OWN} {quantity.name}"


def _brought_back(find: Callable[[str], Any], name: str) -> Any:
    if name.startswith(OWN):
        raise NotInFileError(f"{name!r} {SET_ANEW}")
    try:
        return find(name)
    except InvalidInputError as error:
        raise ValueError(f"unknown objective or quantity {name!r}") from error
