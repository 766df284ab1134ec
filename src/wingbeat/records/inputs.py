"""Everything that an orbit was computed from as a dictionary fit for JSON, and back: the writer beside its reader.

`vehicle_record`, `wingbeat_record` and `aero_record` say what flew; `inputs_of` adds the numbers and names from
which `problem_from` sets up the same problem again.
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping
from typing import Any

from wingbeat._base import SHAPE, InvalidInputError
from wingbeat._jax.arrays import at_default
from wingbeat.aero import (
    LIBRARY,
    BladeElement,
    CamberedCoefficients,
    CamberedTerms,
    CentreTerms,
    CoefficientModel,
    FamilyCoefficients,
    FormulaCoefficients,
    FormulaTerms,
    FunctionCoefficients,
    TableCoefficients,
    load_coefficients,
)
from wingbeat.aero.blade_element import OF_ELEMENTS
from wingbeat.aero.family import AtOneReynolds
from wingbeat.animal.drive import Battery, Motor, Muscle, Springs
from wingbeat.animal.kinematics import NAMED_IF_ON, PITCH_LAW, Wingbeat
from wingbeat.animal.pitch_hinge import PitchHinge
from wingbeat.animal.species.numbers import OwnFrequency, Range, number_from
from wingbeat.animal.species.shape import Shape
from wingbeat.animal.species.species import Species
from wingbeat.animal.vehicle import Air, Body, Tail, Vehicle, Wing
from wingbeat.orbits.options import DEFAULTS, SolverOptions
from wingbeat.orbits.problem.origin import origin_from
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.problem.quantities import Constraint, named_objective, named_quantity
from wingbeat.orbits.problem.quantity import Quantity

# Words before the name of a user's function, and after a function that no file can restore.
OWN = "the user's own"
_OWN = "own_frequency", "own_posture"  # flags of a problem, which inputs have only if they are true
SET_ANEW = "is not in the file; set up the problem with this function again"
_SOURCE, _TERMS = ("citation", "doi", "grade", "reynolds_range"), ("lift_terms", "drag_terms", "centre_terms")
# Of coefficient models that the library may lack: the class, and from what besides its name to set one up.
_MODELS: dict[str, tuple[type[CoefficientModel], tuple[str, ...]]] = {
    "table": (TableCoefficients, ("alpha_deg", "c_l", "c_d", "x_cp", "citation", "reynolds_range", "aspect_ratio")),
    "formula": (FormulaCoefficients, (*_SOURCE, "alpha_range_deg", "aspect_ratio", *_TERMS)),
    "cambered": (CamberedCoefficients, ("low_join_deg", "high_join_deg", *_SOURCE, "aspect_ratio", "terms")),
}


class NotInFileError(ValueError):
    """The inputs name a function of the user's, which a file cannot hold."""


def aero_record(aero: BladeElement) -> dict[str, Any]:
    """Return the inputs of the air loads; a function of the user's is represented by a digest of its program."""
    named = _named(aero.coefficients)
    digest = {"function": named.pop("function")} if "function" in named else {}
    named |= {name: getattr(aero, name) for name in ("strips", "force_point", "airspeed")}
    # Terms that Su et al. do not have are left out if they are off.
    terms: dict[str, Any] = {} if aero.unsteady == "none" else {"unsteady": aero.unsteady}
    if aero.wake != "none":
        terms["wake"] = aero.wake
    if aero.inflow != "none":
        terms |= {"inflow": aero.inflow, "induced_factor": aero.induced_factor}
    if terms and aero.share != 1:
        terms["share"] = aero.share
    if aero.hand != "none":
        terms |= {"hand": _named(aero.hand), "hand_from": aero.hand_from}
    if aero.upstroke_factor != 1:
        terms["upstroke_factor"] = aero.upstroke_factor
    return {**named, **terms, **digest}


def aero_inputs(aero: BladeElement) -> dict[str, Any]:
    """Return the record of the air loads with the numbers of models that are not in the library."""
    record = aero_record(aero) | _numbers(aero.coefficients)
    return record if aero.hand == "none" else record | {"hand": record["hand"] | _numbers(aero.hand)}


def aero_from(aero: dict[str, Any]) -> BladeElement:
    """Set up the air loads from what `aero_inputs` returned."""
    always = ("strips", "force_point", "airspeed")
    elements = {name: aero[name] for name in (*OF_ELEMENTS, "share") if name in aero or name in always}
    if "hand" in aero:
        elements["hand"] = _coefficients(aero["hand"])
    return BladeElement(_coefficients(aero), **elements)


def _named(coefficients: CoefficientModel) -> dict[str, Any]:
    """Return name, extension and blend width of a coefficient model, and a digest if it is a function."""
    how = {name: getattr(coefficients, name) for name in ("extension", "blend_width_deg")}
    named = {"coefficients": coefficients.name, **how}
    if isinstance(coefficients, AtOneReynolds):
        at, coefficients = coefficients.reynolds, coefficients.family
        named |= {"coefficients": coefficients.name, "at_reynolds": at}
    if isinstance(coefficients, FamilyCoefficients):
        named["reynolds_of_polars"] = list(coefficients.reynolds)
    if isinstance(coefficients, FunctionCoefficients):
        named["function"] = f"{OWN}, {coefficients.program.digest[:16]}"
    return named


def _numbers(coefficients: CoefficientModel) -> dict[str, Any]:
    """Return the numbers from which a coefficient model can be set up; none if its name suffices."""
    if isinstance(coefficients, AtOneReynolds):
        coefficients = coefficients.family
    if isinstance(coefficients, FamilyCoefficients):
        return {"family": [_numbers(member)["table"] for member in coefficients.members]}
    kind = next((kind for kind, (made, _) in _MODELS.items() if isinstance(coefficients, made)), "")
    of_library: Any = LIBRARY.get(coefficients.name)
    if not kind or (
        kind != "table"  # a fit may have the name of a published model
        and of_library is not None
        and of_library(coefficients.extension, coefficients.blend_width_deg) == coefficients
    ):
        return {}
    numbers = {name: getattr(coefficients, name) for name in ("name", *_MODELS[kind][1])}
    if numbers["aspect_ratio"] is None:
        del numbers["aspect_ratio"]
    elif math.isinf(numbers["aspect_ratio"]):
        numbers["aspect_ratio"] = "inf"  # JSON has no infinity
    terms = {name: part for name, part in numbers.items() if name.endswith("terms") and part is not None}
    return {kind: numbers | {name: dict(vars(part)) for name, part in terms.items()}}


def _coefficients(given: dict[str, Any]) -> Any:
    how = {"extension": given["extension"], "blend_width_deg": given["blend_width_deg"]}
    if "function" in given:
        raise NotInFileError(f"{OWN} function {given['coefficients']!r} {SET_ANEW}")
    if "family" in given:
        members = tuple(TableCoefficients(**_tuples(member), **how) for member in given["family"])
        family = FamilyCoefficients(given["coefficients"], tuple(given["reynolds_of_polars"]), members)
        return family.at(given["at_reynolds"]) if "at_reynolds" in given else family
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


# Parts that a vehicle may lack.
_PARTS = {"tail": Tail, "muscle": Muscle, "motor": Motor, "springs": Springs, "battery": Battery}


def vehicle_record(vehicle: Vehicle) -> dict[str, Any]:
    """Return the vehicle's numbers."""
    parts = {name: getattr(vehicle, name) for name in ("body", "wing", *_PARTS)}
    return {name: _listed(part) for name, part in parts.items() if part is not None}


def _listed(part: Any) -> dict[str, Any]:
    numbers = part.told() if isinstance(part, Wing) else vars(part)
    return {name: list(value) if isinstance(value, tuple) else value for name, value in numbers.items()}


def vehicle_from(record: dict[str, Any]) -> Vehicle:
    """Return the vehicle that `vehicle_record` described, without a tail or other part that the record lacks."""
    parts = {name: made(**record[name]) for name, made in _PARTS.items() if name in record}
    return Vehicle(Body(**record["body"]), Wing(**record["wing"]), **parts)


_HINGE = "hinge_"  # before the names of a hinge's numbers


def wingbeat_record(wingbeat: Wingbeat) -> dict[str, Any]:
    """Return the wingbeat's numbers; the laws in `NAMED_IF_ON` are left out if they are off."""
    left_out = [name for name in NAMED_IF_ON if at_default(wingbeat, name) or getattr(wingbeat, name) == ()]
    hinge = wingbeat.pitch_hinge
    if hinge is None:
        return {name: value for name, value in _listed(wingbeat).items() if name not in (*left_out, "pitch_hinge")}
    left_out += (*PITCH_LAW, "pitch_harmonics") if hinge.moves_root else ()
    listed = {name: value for name, value in _listed(wingbeat).items() if name not in left_out}
    del listed["pitch_hinge"]
    return listed | {f"{_HINGE}{name}": value for name, value in vars(hinge).items()}


def wingbeat_from(record: dict[str, Any]) -> Wingbeat:
    """Return the wingbeat that `wingbeat_record` described; a pitch law that a hinge replaces is 0."""
    given = {name: value for name, value in record.items() if not name.startswith(_HINGE)}
    own = {name.removeprefix(_HINGE): value for name, value in record.items() if name not in given}
    if not own:
        return Wingbeat(**given)
    return Wingbeat(**({"pitch_mean": 0.0, "pitch_amplitude": 0.0} | given), pitch_hinge=PitchHinge(**own))


def shape_attribute(species: Species | None) -> dict[str, str]:
    """Return the attribute of a data set that says how the animal looks; nothing without a species."""
    if species is None:
        return {}
    return {SHAPE: json.dumps({"kind": species.kind} | (species.shape.drawn() if species.shape else {}))}


def inputs_of(
    problem: OrbitProblem,
    starts: int,
    seed: int,
    options: SolverOptions = DEFAULTS,
    start: Mapping[str, float] | None = None,
) -> dict[str, Any]:
    """Return the inputs: problem, number of starts, seed, options that differ from defaults, a user's start."""
    species, shape = problem.species, {}
    if (own := species.shape) is not None:
        shape["shape"] = {"cover": own.cover, "colours": dict(own.colours), "numbers": dict(own.numbers)}
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
            **({"frequencies": species.frequencies} if species.frequencies else {}),
            **({} if species.own_mass is None else {"own_mass": species.own_mass}),
            **shape,
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
    inputs |= {name: True for name in _OWN if getattr(problem, name)}
    if options != DEFAULTS:
        inputs["options"] = options.changed()
    if start is not None:
        inputs["start"] = dict(start)
    return json.loads(json.dumps(inputs))


def problem_from(inputs: dict[str, Any]) -> OrbitProblem:
    """Set up the problem that `inputs_of` described."""
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
        **{name: inputs.get(name, False) for name in _OWN},
    )


def own_functions(inputs: dict[str, Any]) -> list[str]:
    """Return the names of the user's own objective, quantities and coefficients, which a file cannot restore."""
    names = [inputs["objective"], *(c["quantity"] for c in inputs["constraints"])]
    own = [name for name in names if name.startswith(OWN)]
    aero = inputs["aero"]
    return own + [part["coefficients"] for part in (aero, aero.get("hand", {})) if "function" in part]


def species_from(inputs: dict[str, Any]) -> Species:
    """Set up the species that `inputs_of` described, without its reasons and alternatives, which are not stored."""
    known = inputs["species"]
    # A file of a version that judged nothing has no ranges.
    plausible = {
        name: Range(low, high, unit, source, None if speeds is None else (speeds[0], speeds[1]))
        for name, (low, high, unit, source, speeds) in known.get("plausible", {}).items()
    }
    shape = None
    if "shape" in known:
        own = {path: number_from(*number) for path, number in known["shape"]["numbers"].items()}
        values: dict[str, Any] = {path.removeprefix("shape."): number.value for path, number in own.items()}
        shape = Shape(cover=known["shape"]["cover"], colours=dict(known["shape"]["colours"]), numbers=own, **values)
    return Species(
        name=known["name"],
        common_name=known["common_name"],
        scientific_name=known["scientific_name"],
        kind=known.get("kind", ""),  # a file of a version without kinds has none
        vehicle=vehicle_from(inputs["vehicle"]),
        wingbeat=wingbeat_from(inputs["stock_wingbeat"]),
        air=Air(**inputs["air"]),
        free=tuple(known["free"]),
        bounds=_pairs(known["bounds"]),
        guessed_bounds=frozenset(known["guessed_bounds"]),
        path_bounds=_pairs(known["path_bounds"]),
        reasons={},
        numbers={path: number_from(*number) for path, number in known["numbers"].items()},
        alternatives={},
        plausible=plausible,
        warnings=tuple(known["warnings"]),
        shape=shape,
        frequencies=tuple(_own_frequency(*one) for one in known.get("frequencies", [])),
        own_mass=known.get("own_mass"),
    )


def _own_frequency(value: float, band: list[float], basis: str, source: str, speeds: list[float]) -> OwnFrequency:
    return OwnFrequency(value, (band[0], band[1]), basis, source, (speeds[0], speeds[1]))


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
