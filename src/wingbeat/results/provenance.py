"""Everything that went into an orbit, as a dictionary that alone can set up the same problem again."""

from __future__ import annotations

import json
import math
from collections.abc import Callable
from typing import Any

from wingbeat.aero import (
    LIBRARY,
    BladeElement,
    CamberedCoefficients,
    CamberedTerms,
    CentreTerms,
    CoefficientModel,
    FormulaCoefficients,
    FormulaTerms,
    TableCoefficients,
    load_coefficients,
)
from wingbeat.errors import InvalidInputError
from wingbeat.kinematics import Wingbeat
from wingbeat.orbits.options.solver import DEFAULTS, SolverOptions
from wingbeat.orbits.problem.limits import Constraint
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.problem.quantities import Quantity, named_objective, named_quantity
from wingbeat.results.record import aero_record, vehicle_from, vehicle_record, wingbeat_record
from wingbeat.species import Species
from wingbeat.species_schema import Number, Range
from wingbeat.vehicle import Air

# Before the name of a function of the user's.
_OWN = "the user's own"
_ANEW = "is not in the file; set up the problem with this function again"
_FORMULA = ("name", "citation", "doi", "grade", "reynolds_range", "alpha_range_deg")
_CAMBERED = ("name", "low_join_deg", "high_join_deg", "citation", "doi", "grade", "reynolds_range")
_TABLE = ("name", "alpha_deg", "c_l", "c_d", "x_cp", "citation", "reynolds_range")


class NotInFileError(ValueError):
    """The inputs name a function of the user's, which a file cannot hold."""


def inputs_of(problem: OrbitProblem, starts: int, seed: int, options: SolverOptions = DEFAULTS) -> dict[str, Any]:
    """Return all inputs of a problem and its search, and the solver options that differ from their defaults."""
    species, coefficients = problem.species, problem.aero.coefficients
    aero = aero_record(problem.aero)
    if isinstance(coefficients, TableCoefficients):
        aero["table"] = {name: getattr(coefficients, name) for name in _TABLE} | _aspect_ratio(coefficients)
    elif isinstance(coefficients, FormulaCoefficients) and not _in_the_box(coefficients):
        aero["formula"] = {name: getattr(coefficients, name) for name in _FORMULA} | _aspect_ratio(coefficients)
        for name in ("lift_terms", "drag_terms", "centre_terms"):
            terms = getattr(coefficients, name)
            aero["formula"][name] = None if terms is None else dict(vars(terms))
    elif isinstance(coefficients, CamberedCoefficients) and not _in_the_box(coefficients):
        aero["cambered"] = {name: getattr(coefficients, name) for name in _CAMBERED} | _aspect_ratio(coefficients)
        aero["cambered"]["terms"] = dict(vars(coefficients.terms))
    inputs = {
        "species": {
            "name": species.name,
            "common_name": species.common_name,
            "scientific_name": species.scientific_name,
            "free": species.free,
            "bounds": species.bounds,
            "guessed_bounds": sorted(species.guessed_bounds),
            "path_bounds": species.path_bounds,
            "warnings": species.warnings,
            "numbers": species.numbers,
            "plausible": species.plausible,
        },
        "vehicle": vehicle_record(problem.vehicle),
        "stock_wingbeat": wingbeat_record(species.wingbeat),
        "aero": aero,
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
    if options != DEFAULTS:
        inputs["options"] = options.changed()
    return json.loads(json.dumps(inputs))


def _aspect_ratio(coefficients: CoefficientModel) -> dict[str, float | str]:
    """Return the aspect ratio of a model that states one; JSON has no infinity."""
    if coefficients.aspect_ratio is None:
        return {}
    return {"aspect_ratio": "inf" if math.isinf(coefficients.aspect_ratio) else coefficients.aspect_ratio}


def problem_from(inputs: dict[str, Any]) -> OrbitProblem:
    """Set up the problem that `inputs_of` described.

    Raises
    ------
    KeyError, TypeError, ValueError : the dictionary is not one of `inputs_of`.
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
    )


def own_functions(inputs: dict[str, Any]) -> list[str]:
    """Return the names of objective, quantities and coefficients of the user's own, which a file cannot restore."""
    names = [inputs["objective"], *(c["quantity"] for c in inputs["constraints"])]
    own = [name for name in names if name.startswith(_OWN)]
    return [*own, inputs["aero"]["coefficients"]] if "function" in inputs["aero"] else own


def species_from(inputs: dict[str, Any]) -> Species:
    """Set up the species that `inputs_of` described, without its reasons and alternatives, which are not stored.

    Raises
    ------
    KeyError, TypeError, ValueError : the dictionary is not one of `inputs_of`.
    """
    known = inputs["species"]
    return Species(
        name=known["name"],
        common_name=known["common_name"],
        scientific_name=known["scientific_name"],
        vehicle=vehicle_from(inputs["vehicle"]),
        wingbeat=Wingbeat(**inputs["stock_wingbeat"]),
        air=Air(**inputs["air"]),
        free=tuple(known["free"]),
        bounds=_pairs(known["bounds"]),
        guessed_bounds=frozenset(known["guessed_bounds"]),
        path_bounds=_pairs(known["path_bounds"]),
        reasons={},
        numbers={path: _number(*number) for path, number in known["numbers"].items()},
        alternatives={},
        # A file of a version that judged nothing has no ranges.
        plausible={name: _plausible_range(*one) for name, one in known.get("plausible", {}).items()},
        warnings=tuple(known["warnings"]),
    )


def aero_from(aero: dict[str, Any]) -> BladeElement:
    """Set up the air loads from the table ``aero`` of `inputs_of`.

    Raises
    ------
    KeyError, TypeError, ValueError : the dictionary is not one of `inputs_of`.
    """
    terms = {name: aero[name] for name in ("unsteady", "inflow", "induced_factor", "share") if name in aero}
    return BladeElement(_coefficients(aero), aero["strips"], aero["force_point"], aero["airspeed"], **terms)


def _number(value: Any, unit: str, source: str, plausible: list[float] | None) -> Number:
    whole = tuple(value) if isinstance(value, list) else value
    return Number(whole, unit, source, None if plausible is None else (plausible[0], plausible[1]))


def _plausible_range(
    low: float | None, high: float | None, unit: str, source: str, speeds: list[float] | None
) -> Range:
    return Range(low, high, unit, source, None if speeds is None else (speeds[0], speeds[1]))


def _pairs(bounds: dict[str, list[float]]) -> dict[str, tuple[float, float]]:
    return {name: (low, high) for name, (low, high) in bounds.items()}


def _in_the_box(coefficients: FormulaCoefficients | CamberedCoefficients) -> bool:
    """Return whether the name alone restores the formulas; a fit may have the name of a published model."""
    if coefficients.name not in LIBRARY:
        return False
    return LIBRARY[coefficients.name](coefficients.extension, coefficients.blend_width_deg) == coefficients


def _coefficients(aero: dict[str, Any]) -> Any:
    how = {"extension": aero["extension"], "blend_width_deg": aero["blend_width_deg"]}
    if "function" in aero:
        raise NotInFileError(f"{_OWN} function {aero['coefficients']!r} {_ANEW}")
    if "table" in aero:
        return TableCoefficients(**_tuples(aero["table"]), **how)
    if "cambered" in aero:
        cambered = _tuples(aero["cambered"])
        terms = CamberedTerms(**cambered.pop("terms"))
        return CamberedCoefficients(**cambered, terms=terms, blend_width_deg=aero["blend_width_deg"])
    if "formula" not in aero:
        return load_coefficients(aero["coefficients"], **how)
    formula = _tuples(aero["formula"])
    centre = formula.pop("centre_terms")
    lift, drag = (FormulaTerms(**formula.pop(name)) for name in ("lift_terms", "drag_terms"))
    return FormulaCoefficients(
        **formula,
        lift_terms=lift,
        drag_terms=drag,
        centre_terms=None if centre is None else CentreTerms(**centre),
        **how,
    )


def _tuples(numbers: dict[str, Any]) -> dict[str, Any]:
    known = {key: tuple(value) if isinstance(value, list) else value for key, value in numbers.items()}
    return known | {"aspect_ratio": math.inf} if known.get("aspect_ratio") == "inf" else known


def _asked_for(quantity: Quantity) -> str:
    """Return the name that restores a quantity; a user's function cannot be restored and gets a name that fails."""
    try:
        known = named_objective(quantity.name) == quantity or named_quantity(quantity.name) == quantity
    except InvalidInputError:
        known = False
    return quantity.name if known else f"{_OWN} {quantity.name}"


def _brought_back(find: Callable[[str], Any], name: str) -> Any:
    if name.startswith(_OWN):
        raise NotInFileError(f"{name!r} {_ANEW}")
    try:
        return find(name)
    except InvalidInputError as error:
        raise ValueError(f"unknown objective or quantity {name!r}") from error
