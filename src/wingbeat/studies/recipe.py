"""The problem that a combination of a study's top-level keys defines, and how a point changes its values."""

from __future__ import annotations

import dataclasses
import functools
import json
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from wingbeat._base import FaultList, plain_unit, suggest
from wingbeat.aero import BladeElement
from wingbeat.aero.choosing import load_hand
from wingbeat.animal.species.building import NO_SUCH_PATH, settable
from wingbeat.animal.species.numbers import KEYS, Key, shown, spoken
from wingbeat.animal.species.record import Species
from wingbeat.orbits.problem.parameters import Parameter, bound_of, limit_of, parameters_of
from wingbeat.orbits.problem.problem import CLIMB_LIMITS, SPEED_LIMITS, OrbitProblem
from wingbeat.orbits.starts import usual_starts
from wingbeat.results.aero_record import aero_from
from wingbeat.results.orbit import Orbit
from wingbeat.results.provenance import inputs_of, species_from
from wingbeat.studies.objective import described, from_inputs

# Every point has values of these, whatever is varied; the limit of the payload is that of `Species.with_payload`.
MOTION = {"speed": SPEED_LIMITS, "climb": CLIMB_LIMITS, "payload": {"at_least": 0.0, "unit": plain_unit("payload")}}
# The numbers and words of the coefficients, and those of the air loads, in the order of their constructors.
OF_COEFFICIENTS = ("extension", "blend_width_deg")
OF_ELEMENTS = (
    *("strips", "force_point", "airspeed", "unsteady", "inflow", "induced_factor"),
    *("hand", "hand_from", "upstroke_factor"),
)
_OF_COEFFICIENTS = tuple(f"aero.{name}" for name in OF_COEFFICIENTS)
_OF_ELEMENTS = tuple(f"aero.{name}" for name in OF_ELEMENTS)
_CHOICES = (*_OF_COEFFICIENTS, *_OF_ELEMENTS)
_AT_REST = {"speed": 10.0, "climb": 0.0, "payload": 0.0}


@dataclass(frozen=True)
class Recipe:
    """An orbit problem without the values of a point: speed, climb, payload, and everything that a study varies.

    Parameters
    ----------
    species, aero : the animal and its air loads.
    objective : in the form of `objective.as_inputs`.
    free, bounds : as in `OrbitProblem`.
    subject_to : limits as texts.
    search : ``starts``, ``seed``, ``most_starts``, ``advise``, ``explain``; a number that is None has its default.
    """

    species: Species
    aero: BladeElement
    objective: dict[str, str]
    free: tuple[str, ...]
    bounds: dict[str, tuple[float, float]] | str
    subject_to: tuple[str, ...]
    search: dict[str, Any]

    def problem(self, changes: Mapping[str, Any]) -> OrbitProblem:
        """Return the problem of a point.

        Parameters
        ----------
        changes : values by path; speed must be among them.

        Raises
        ------
        InvalidInputError : values that species, air loads or problem refuse.
        """
        numbers = {path: value for path, value in changes.items() if _key(path) is not None}
        species = self.species.with_values(numbers) if numbers else self.species
        problem = OrbitProblem(
            species.with_payload(changes.get("payload", 0.0)),
            speed=changes["speed"],
            climb=changes.get("climb", 0.0),
            aero=self._aero({path: changes[path] for path in _CHOICES if path in changes}),
            free=self.free,
            bounds=self.bounds,
            minimise=from_inputs(self.objective),
            subject_to=self.subject_to,
        )
        for path, value in changes.items():
            if path not in numbers and path not in MOTION and path not in _CHOICES:
                found = _parameter(problem, path)
                if found is None:  # a law that another change switched off
                    faults = FaultList()
                    faults.add(path, shown(value), "names no number of this problem", "leave it out of the study")
                    faults.raise_if_any()
                assert found is not None
                problem = found.changed(problem, float(value))
        return problem

    def _aero(self, choices: Mapping[str, Any]) -> BladeElement:
        inner = {p.removeprefix("aero."): v for p, v in choices.items() if p in _OF_COEFFICIENTS}
        outer = {p.removeprefix("aero."): v for p, v in choices.items() if p in _OF_ELEMENTS}
        arm, hand = self.aero.coefficients, outer.pop("hand", self.aero.hand)
        if inner:
            arm, hand = (one if isinstance(one, str) else dataclasses.replace(one, **inner) for one in (arm, hand))
        if isinstance(hand, str):
            hand = load_hand(hand, *(getattr(arm, name) for name in OF_COEFFICIENTS))
        return dataclasses.replace(self.aero, coefficients=arm, hand=hand, **outer) if choices else self.aero

    @functools.cached_property
    def example(self) -> OrbitProblem:
        """The problem at an arbitrary speed, otherwise unchanged."""
        return self.problem(_AT_REST)

    def name_of(self, path: str) -> str:
        """Return the standard name of a path, which may be written with or without ``vehicle.`` or ``_deg``."""
        key = _key(path)
        return path.removeprefix("vehicle.") if key is None else key.path

    def value(self, path: str) -> Any:
        """Return the value at a path before anything is varied; None if there is none."""
        if (key := _key(path)) is not None:
            number = self.species.numbers.get(key.path)
            value = None if number is None else number.value
            listed = list(value) if isinstance(value, tuple) else value
            return _degrees(listed) if path.endswith("_deg") and not key.path.endswith("_deg") else listed
        if path in MOTION:
            return None
        if path in _OF_COEFFICIENTS:
            return getattr(self.aero.coefficients, path.removeprefix("aero."))
        if path == "aero.hand":
            return getattr(self.aero.hand, "name", "none")
        if path in _OF_ELEMENTS:
            return getattr(self.aero, path.removeprefix("aero."))
        found = _parameter(self.example, path)
        return None if found is None else found.value

    def check(self, path: str, value: Any, faults: FaultList) -> None:
        """Raise `InvalidInputError`, or note a fault, if a value is impossible at its path."""
        if path in MOTION:
            faults.number(path, value, **MOTION[path])
        elif _key(path) is not None:
            self.species.with_values({path: value})
        elif path in _CHOICES:
            self._aero({path: value})
        elif path in ("mass", "vehicle.mass"):
            settable(path, value, faults)
        elif (found := _parameter(self.example, path)) is None:
            faults.add(spoken(path), shown(value), NO_SUCH_PATH, suggest(str(path), self.paths()))
        elif faults.number(path, value):
            found.changed(self.example, float(value))

    def paths(self) -> list[str]:
        """Return the paths that can be varied."""
        own = [key.path.removeprefix("vehicle.") for key in KEYS if key.path != "vehicle.mass"]
        found = [p.path for p in parameters_of(self.example) if p.path.startswith("aero.")]
        ends = [f"bounds.{name}.{side}" for name in self.example.bounds for side in ("lower", "upper")]
        return [*MOTION, *own, *_CHOICES, *(p for p in found if p not in _CHOICES), *ends]

    def inputs(self) -> dict[str, Any]:
        """Return everything as a dictionary fit for JSON, from which a worker makes the same recipe.

        It holds the code of a user's objective: `recipe_from` must never get what was read from a store.
        """
        told = inputs_of(OrbitProblem(self.species, 10.0, aero=self.aero, minimise="mean_power"), 1, 0)
        kept = {name: told[name] for name in ("species", "vehicle", "stock_wingbeat", "aero", "air")}
        return kept | {
            "objective": self.objective,
            "free": list(self.free),
            "bounds": _listed(self.bounds),
            "subject_to": list(self.subject_to),
            "search": self.search,
        }

    def described(self) -> dict[str, Any]:
        """Return what a store holds of the inputs: everything but the code of a user's objective."""
        return self.inputs() | {"objective": described(self.objective)}

    def orbit(self, changes: str, record: str) -> Orbit:
        """Return the orbit of a point that a store holds.

        Parameters
        ----------
        changes, record : JSON texts of the store.
        """
        problem = self.problem(json.loads(changes))
        return Orbit.of_record(json.loads(record), problem, starts_of(self, problem), int(self.search["seed"]))


def _listed(bounds: dict[str, tuple[float, float]] | str) -> dict[str, list[float]] | str:
    return bounds if isinstance(bounds, str) else {name: list(pair) for name, pair in bounds.items()}


def recipe_from(inputs: Mapping[str, Any]) -> Recipe:
    """Return the recipe that `Recipe.inputs` described."""
    return Recipe(
        species_from(dict(inputs)),
        aero_from(inputs["aero"]),
        inputs["objective"],
        tuple(inputs["free"]),
        bounds
        if isinstance(bounds := inputs["bounds"], str)
        else {name: tuple(pair) for name, pair in bounds.items()},
        tuple(inputs["subject_to"]),
        inputs["search"],
    )


def starts_of(recipe: Recipe, problem: OrbitProblem) -> int:
    """Return the number of starts for a problem of a recipe."""
    starts = recipe.search["starts"]
    return usual_starts(problem) if starts is None else int(starts)


@functools.cache
def _key(path: str) -> Key | None:
    """Return the species' key that a path names."""
    return settable(path, None, FaultList())


def _degrees(value: Any) -> Any:
    return [math.degrees(v) for v in value] if isinstance(value, list) else math.degrees(value)


def _parameter(problem: OrbitProblem, path: str) -> Parameter | None:
    """Return a parameter that species files do not hold: of a coefficient model, a bound, or a limit."""
    kind, _, rest = path.partition(".")
    if kind == "bounds":
        name, _, side = rest.rpartition(".")
        return bound_of(problem, name, side) if name in problem.bounds and side in ("lower", "upper") else None
    if kind == "limit":
        places = [i for i, limit in enumerate(problem.subject_to) if limit.quantity.name == rest]
        return limit_of(problem, places[0]) if places else None
    return next((p for p in parameters_of(problem) if p.path == path), None)
