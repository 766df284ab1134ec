"""The inputs of the air loads as a dictionary: for a record, or to set up the same air loads again."""

from __future__ import annotations

import math
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
    FunctionCoefficients,
    TableCoefficients,
    load_coefficients,
)

# Words before the name of a user's function, and after a function that no file can restore.
OWN = "the user's own"
SET_ANEW = "is not in the file; set up the problem with this function again"
_FORMULA = ("name", "citation", "doi", "grade", "reynolds_range", "alpha_range_deg")
_CAMBERED = ("name", "low_join_deg", "high_join_deg", "citation", "doi", "grade", "reynolds_range")
_TABLE = ("name", "alpha_deg", "c_l", "c_d", "x_cp", "citation", "reynolds_range")


class NotInFileError(ValueError):
    """The inputs name a function of the user's, which a file cannot hold."""


def aero_record(aero: BladeElement) -> dict[str, Any]:
    """Return the inputs of the air loads; a function of the user's is represented by a digest of its program."""
    named = _named(aero.coefficients)
    digest = {"function": named.pop("function")} if "function" in named else {}
    return {
        **named,
        "strips": aero.strips,
        "force_point": aero.force_point,
        "airspeed": aero.airspeed,
        **further_terms(aero),
        **digest,
    }


def further_terms(aero: BladeElement) -> dict[str, Any]:
    """Return the terms of the air loads that Su et al. do not have, by name; terms that are off are left out."""
    terms: dict[str, Any] = {} if aero.unsteady == "none" else {"unsteady": aero.unsteady}
    if aero.inflow != "none":
        terms |= {"inflow": aero.inflow, "induced_factor": aero.induced_factor}
    if terms and aero.share != 1:
        terms["share"] = aero.share
    if aero.hand != "none":
        terms |= {"hand": _named(aero.hand), "hand_from": aero.hand_from}
    if aero.upstroke_factor != 1:
        terms["upstroke_factor"] = aero.upstroke_factor
    return terms


def aero_inputs(aero: BladeElement) -> dict[str, Any]:
    """Return the record of the air loads with the numbers of models that are not in the library."""
    record = aero_record(aero) | _numbers(aero.coefficients)
    return record if aero.hand == "none" else record | {"hand": record["hand"] | _numbers(aero.hand)}


def aero_from(aero: dict[str, Any]) -> BladeElement:
    """Set up the air loads from what `aero_inputs` returned.

    Raises
    ------
    KeyError, TypeError, ValueError : the dictionary was not made by `aero_inputs`.
    """
    numbers = ("unsteady", "inflow", "induced_factor", "share", "hand_from", "upstroke_factor")
    terms = {name: aero[name] for name in numbers if name in aero}
    hand = _coefficients(aero["hand"]) if "hand" in aero else "none"
    elements = aero["strips"], aero["force_point"], aero["airspeed"]
    return BladeElement(_coefficients(aero), *elements, hand=hand, **terms)


def _named(coefficients: CoefficientModel) -> dict[str, Any]:
    """Return name, extension and blend width of a coefficient model, and a digest if it is a function."""
    named = {name: getattr(coefficients, name) for name in ("extension", "blend_width_deg")}
    named = {"coefficients": coefficients.name, **named}
    if isinstance(coefficients, FunctionCoefficients):
        named["function"] = f"{OWN}, {coefficients.program.digest[:16]}"
    return named


def _numbers(coefficients: Any) -> dict[str, Any]:
    """Return the numbers from which a coefficient model can be set up; none if its name suffices."""
    if isinstance(coefficients, TableCoefficients):
        return {"table": {name: getattr(coefficients, name) for name in _TABLE} | _aspect_ratio(coefficients)}
    if isinstance(coefficients, FormulaCoefficients) and not _is_built_in(coefficients):
        formula = {name: getattr(coefficients, name) for name in _FORMULA} | _aspect_ratio(coefficients)
        for name in ("lift_terms", "drag_terms", "centre_terms"):
            terms = getattr(coefficients, name)
            formula[name] = None if terms is None else dict(vars(terms))
        return {"formula": formula}
    if isinstance(coefficients, CamberedCoefficients) and not _is_built_in(coefficients):
        cambered = {name: getattr(coefficients, name) for name in _CAMBERED} | _aspect_ratio(coefficients)
        return {"cambered": cambered | {"terms": dict(vars(coefficients.terms))}}
    return {}


def _aspect_ratio(coefficients: CoefficientModel) -> dict[str, float | str]:
    """Return the aspect ratio of a model that states one; JSON has no infinity."""
    if coefficients.aspect_ratio is None:
        return {}
    return {"aspect_ratio": "inf" if math.isinf(coefficients.aspect_ratio) else coefficients.aspect_ratio}


def _is_built_in(coefficients: FormulaCoefficients | CamberedCoefficients) -> bool:
    """Return whether the library has this model under its name; a fit may have the name of a published model."""
    if coefficients.name not in LIBRARY:
        return False
    return LIBRARY[coefficients.name](coefficients.extension, coefficients.blend_width_deg) == coefficients


def _coefficients(given: dict[str, Any]) -> Any:
    how = {"extension": given["extension"], "blend_width_deg": given["blend_width_deg"]}
    if "function" in given:
        raise NotInFileError(f"{OWN} function {given['coefficients']!r} {SET_ANEW}")
    if "table" in given:
        return TableCoefficients(**_tuples(given["table"]), **how)
    if "cambered" in given:
        cambered = _tuples(given["cambered"])
        terms = CamberedTerms(**cambered.pop("terms"))
        return CamberedCoefficients(**cambered, terms=terms, blend_width_deg=given["blend_width_deg"])
    if "formula" not in given:
        return load_coefficients(given["coefficients"], **how)
    formula = _tuples(given["formula"])
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
