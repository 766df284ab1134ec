"""What an orbit problem says to a reader, as the blocks of a report."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, cast

from wingbeat._base import NOMENCLATURE, Report, Reported, for_people, grouped
from wingbeat.animal.species.numbers import bound_cells

if TYPE_CHECKING:
    from wingbeat.orbits.problem.limits import Constraint
    from wingbeat.orbits.problem.problem import OrbitProblem

_TERMS = ("unsteady", "inflow")


class ReportedProblem(Reported):
    """The notebook manners of an orbit problem."""

    def _report(self) -> Report:
        return problem_report(cast("OrbitProblem", self))


def problem_report(problem: OrbitProblem) -> Report:
    """Return what is to fly, what is minimised within which limits, and the bounds of the free parameters.

    Parameters
    ----------
    problem : the problem.
    """
    aero = problem.aero
    named = {"coefficients": aero.coefficients.name, "extension": aero.coefficients.extension}
    named |= {"force_point": aero.force_point, "airspeed": aero.airspeed}
    named |= {name: getattr(aero, name) for name in _TERMS if getattr(aero, name) != "none"}
    origin = [] if problem.origin is None else model_rows(problem.origin.record())
    rows = [
        ("species, mean speed", place_in_words(problem.species.name, problem.speed, problem.climb)),
        *origin,
        ("air loads", loads_in_words(named)),
        ("minimised", problem.minimise.name.replace("_", " ")),
        *(("limit", limit_in_words(limit)) for limit in problem.subject_to),
    ]
    bounds = {name if name not in problem.free else f"wingbeat.{name}": b for name, b in problem.bounds.items()}
    cells = [bound_cells(path, limits) for path, limits in bounds.items()]
    bounded = [(name.removeprefix("wingbeat."), f"{ends} {unit}".rstrip()) for name, ends, unit in cells]
    return [grouped({"orbit problem": rows, "free parameters, and limits along the path": bounded})]


def limit_in_words(limit: Constraint) -> str:
    """Return a limit in the unit that readers prefer."""
    factor, unit = for_people(limit.quantity.unit)
    sign = "<=" if limit.at_most else ">="
    return f"{limit.quantity.name} {sign} {limit.limit * factor:.6g} {unit}".rstrip()


def place_in_words(species: str | None, speed: float | None, climb: float | None) -> str:
    """Return which species flies, and how fast."""
    if speed is None:
        return str(species)
    (factor, unit), (factor_up, unit_up) = (for_people(NOMENCLATURE[name].unit) for name in ("speed", "climb"))
    climbing = f", climbing {climb * factor_up:.4g} {unit_up}" if climb else ""
    return f"{species} at {speed * factor:.4g} {unit}{climbing}"


def loads_in_words(aero: Mapping[str, Any]) -> str:
    """Return the coefficients and the terms of the air loads, from their names in a record."""
    named = [str(aero[name]) for name in ("coefficients", "extension", "force_point") if name in aero]
    terms = [f"{aero[name]} {name}" for name in _TERMS if name in aero]
    return ", ".join([*named, *(["full airspeed"] if aero.get("airspeed") == "full" else []), *terms])


def model_rows(origin: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Return the name of the model that made the problem, and the choices that the user changed."""
    changed = [name.replace("_", "-") for name in origin["changed"]]
    return [("model", origin["name"] + (f"; changed: {', '.join(changed)}" if changed else ""))]
