"""The problem that a combination of a study's top-level keys defines: how it is made, and how a point changes it.

An objective may be a function of a Python file, ``mine.py:mean_lift``. The code that runs is always what
`as_inputs` has just read from the user's file. A store holds only its digest; nothing that a store holds is run.
"""

from __future__ import annotations

import dataclasses
import functools
import hashlib
import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from wingbeat._base import FaultList, first_line, plain_unit, read_text, suggest
from wingbeat.aero import BladeElement, load_coefficients
from wingbeat.aero.blade_element import OF_ELEMENTS, load_hand
from wingbeat.aero.polar_formats import POLAR_SUFFIXES
from wingbeat.animal.species.building import NO_SUCH_PATH, settable
from wingbeat.animal.species.making import load_species
from wingbeat.animal.species.numbers import FREQUENCY, KEYS, Key, shown, spoken
from wingbeat.animal.species.species import Species
from wingbeat.models import Model, model_of
from wingbeat.orbits.problem.parameters import Parameter, bound_of, limit_of, parameters_of
from wingbeat.orbits.problem.problem import CLIMB_LIMITS, SPEED_LIMITS, OrbitProblem
from wingbeat.orbits.problem.quantities import named_objective
from wingbeat.orbits.problem.quantity import Quantity
from wingbeat.orbits.starts import start_count
from wingbeat.records.inputs import aero_from, inputs_of, species_from
from wingbeat.studies.form import StudyForm

# --- objectives ---

_MARK = ".py:"  # of a text that names a function of a file


def as_inputs(text: str, folder: Path) -> dict[str, str]:
    """Return inputs from which a worker makes an objective; a function's file is included as text."""
    if _MARK not in text:
        return {"name": named_objective(text).name}
    file, _, name = text.rpartition(":")
    found = {"name": name, "file": Path(file).name, "code": read_text(folder / file)}
    from_inputs(found)
    return found


def described(inputs: Mapping[str, str]) -> dict[str, str]:
    """Return what a store may hold of the inputs of an objective: the digest of the code instead of the code.

    >>> described({"name": "lift", "file": "mine.py", "code": "def lift(beat): ..."})["digest"][:8]
    '8e1f8275'
    """
    kept = {key: value for key, value in inputs.items() if key != "code"}
    return kept | ({"digest": hashlib.sha256(inputs["code"].encode()).hexdigest()} if "code" in inputs else {})


def changed_code(ours: Iterable[Mapping[str, str]], kept: Iterable[Mapping[str, Any]]) -> str:
    """Return in words which functions of a study's files differ from those that a store's points were made with.

    `ours` is in the form of `as_inputs`, `kept` in that of `Recipe.described`.
    """
    theirs = [described(inputs["objective"]) for inputs in kept]
    changed = {
        f"{one['file']}:{one['name']}"
        for one in map(described, ours)
        if "digest" in one
        and one not in theirs
        and any((one["file"], one["name"]) == (other.get("file"), other.get("name")) for other in theirs)
    }
    rule = "differs from the one that they were made with"
    return "".join(f": the objective {what} {rule}" for what in sorted(changed))


def from_inputs(inputs: dict[str, str]) -> Quantity:
    """Return the objective that `as_inputs` described."""
    return _run(**inputs) if "code" in inputs else named_objective(inputs["name"])


@functools.cache
def _run(name: str, file: str, code: str) -> Quantity:
    """Return a quantity from a file's code, cached, because JAX compiles every new function object anew."""
    faults, space = FaultList(), {"__name__": Path(file).stem, "__file__": file}
    where = f"minimise {file}:{name}"
    try:
        exec(compile(code, file, "exec"), space)
    except (Exception, SystemExit) as error:  # whatever a user's file raises
        reason = first_line(error)
        faults.add(where, file, f"cannot be run: {reason}", "correct the file; it may import wingbeat and jax")
        faults.raise_if_any()
    found: Any = space.get(name)
    if isinstance(found, Quantity):
        return found
    if not callable(found):
        faults.add(where, name, "is not a function or a Quantity of that file", "see docs/guide/objectives.md")
        faults.raise_if_any()
    return Quantity(name, found)


# --- recipes ---

# Every point has values of these, whatever is varied; the limit of the payload is that of `Species.with_payload`.
MOTION = {"speed": SPEED_LIMITS, "climb": CLIMB_LIMITS, "payload": {"at_least": 0.0, "unit": plain_unit("payload")}}
# Top-level keys that set the air; without a value the air is that of the species.
AIR = ("altitude", "temperature")
# The numbers and words of the coefficients.
OF_COEFFICIENTS = ("extension", "blend_width_deg")
_OF_COEFFICIENTS = tuple(f"aero.{name}" for name in OF_COEFFICIENTS)
_OF_ELEMENTS = tuple(f"aero.{name}" for name in OF_ELEMENTS)
_CHOICES = (*_OF_COEFFICIENTS, *_OF_ELEMENTS)
_AT_REST = {"speed": 10.0, "climb": 0.0, "payload": 0.0}


@dataclass(frozen=True)
class Recipe:
    """An orbit problem without the values of a point: speed, climb, payload, and everything that a study varies.

    `objective` is in the form of `as_inputs`. `search` holds ``starts``, ``seed``, ``most_starts``, ``advise`` and
    ``explain``; a number that is None has its default.
    """

    species: Species
    aero: BladeElement
    objective: dict[str, str]
    free: tuple[str, ...]
    bounds: dict[str, tuple[float, float]] | str
    subject_to: tuple[str, ...]
    search: dict[str, Any]
    own_frequency: bool = False  # as in `OrbitProblem`
    own_posture: bool = False

    def problem(self, changes: Mapping[str, Any]) -> OrbitProblem:
        """Return the problem of a point, whose changes by path must have a speed among them."""
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
            own_frequency=self.own_frequency,
            own_posture=self.own_posture,
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

    def follows_speed(self, path: str) -> bool:
        """Return whether the value at a path changes with speed, so that it is not known before a point is."""
        if self.own_frequency and self.name_of(path) == FREQUENCY:
            return not self.species.is_set_by_hand(FREQUENCY)
        return self.own_posture and path.startswith("bounds.body_pitch.")

    def value(self, path: str) -> Any:
        """Return the value at a path before anything is varied; None if there is none."""
        if self.follows_speed(path):
            return None
        if (key := _key(path)) is not None:
            number = self.species.numbers.get(key.path)
            value: Any = None if number is None else number.value
            if path.endswith("_deg") and not key.path.endswith("_deg"):
                return [math.degrees(v) for v in value] if isinstance(value, tuple) else math.degrees(value)
            return list(value) if isinstance(value, tuple) else value
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
            "bounds": bounds if isinstance(bounds := self.bounds, str) else {n: list(b) for n, b in bounds.items()},
            "subject_to": list(self.subject_to),
            "search": self.search,
            **{name: True for name in ("own_frequency", "own_posture") if getattr(self, name)},
        }

    def described(self) -> dict[str, Any]:
        """Return what a store holds of the inputs: everything but the code of a user's objective."""
        return self.inputs() | {"objective": described(self.objective)}


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
        inputs.get("own_frequency", False),
        inputs.get("own_posture", False),
    )


def starts_of(recipe: Recipe, problem: OrbitProblem) -> int:
    """Return the number of starts for a problem of a recipe."""
    starts = recipe.search["starts"]
    return start_count(problem) if starts is None else int(starts)


@functools.cache
def _key(path: str) -> Key | None:
    """Return the species' key that a path names."""
    return settable(path, None, FaultList())


def _parameter(problem: OrbitProblem, path: str) -> Parameter | None:
    """Return a parameter that species files do not hold: of a coefficient model, a bound, or a limit."""
    kind, _, rest = path.partition(".")
    if kind == "bounds":
        name, _, side = rest.rpartition(".")
        return bound_of(problem, name, side) if name in problem.bounds and side in ("lower", "upper") else None
    if kind == "limit":
        limits = [limit_of(problem, i) for i in range(len(problem.subject_to))]
        return next((limit for limit in limits if limit.path == path), None)
    return next((p for p in parameters_of(problem) if p.path == path), None)


# --- from the keys of a form to the parts of a recipe ---


def makers_of(form: StudyForm, folder: Path) -> dict[str, tuple[tuple[str, ...], Callable[..., Any]]]:
    """Return functions that make the parts of a base from top-level keys; equal values are evaluated only once."""

    @functools.cache
    def flown(species: str, model: str) -> tuple[Species, Model]:
        own = load_species(_beside(species, folder, (".toml",)))
        return own, model_of(model, own)

    def animal(
        species: str, model: str, altitude: float | None = None, temperature: float | None = None
    ) -> Species:
        own, whole = flown(species, model)
        complete = whole.species(own)
        if altitude is not None or temperature is not None:
            complete = complete.at_altitude(altitude or 0.0, temperature)
        return whole.species(complete.with_values(form.settings)) if form.settings else complete

    def loads(
        species: str, model: str, name: str, extension: str, width_deg: float, *elements: Any
    ) -> BladeElement:
        own, chosen = flown(species, model)[1].aero, form.model_fields_set
        reach = extension, width_deg
        given = dict(zip(OF_ELEMENTS, elements, strict=True))
        if model != "paper":  # what the study does not give is as the model says
            given = {key: value for key, value in given.items() if key in chosen}
            name = name if "aero" in chosen else own.coefficients.name
        if "hand" in given:
            given["hand"] = load_hand(_beside(given["hand"], folder, (*POLAR_SUFFIXES, ".toml")), *reach)
        arm = load_coefficients(_beside(name, folder, (*POLAR_SUFFIXES, ".toml")), *reach)
        if "force_point" not in chosen and animal(species, model).wingbeat.pitch_hinge is not None:
            given["force_point"] = "centre-of-pressure"  # as in any problem of a wing that it turns
        return dataclasses.replace(own, coefficients=arm, **given)

    def objective(species: str, model: str, name: str) -> dict[str, str]:
        if model != "paper" and "minimise" not in form.model_fields_set:
            name = flown(species, model)[1].objective(animal(species, model))
        return as_inputs(name, folder)

    def bounds() -> dict[str, tuple[float, float]] | str:
        return given if isinstance(given := form.bounds, str) else _bounds(given)

    def own(species: str, model: str, name: str) -> dict[str, bool]:
        least = from_inputs(objective(species, model, name))
        return flown(species, model)[1].own_choices(least, form.free, bounds())

    of_model = "species", "model"
    makers = {
        "species": ((*of_model, *AIR), animal),
        "aero": ((*of_model, "aero", *OF_COEFFICIENTS, *OF_ELEMENTS), loads),
        "minimise": ((*of_model, "minimise"), objective),
        "own": ((*of_model, "minimise"), own),
        "bounds": ((), bounds),
    }
    return {name: (keys, functools.cache(make)) for name, (keys, make) in makers.items()}


def _beside(name: str, folder: Path, suffixes: tuple[str, ...]) -> str:
    """Return the path of a file in the study's folder; a name without one of the suffixes stays as it is."""
    return str(folder / name) if name.lower().endswith(suffixes) else name


def _bounds(given: dict[str, list[float]]) -> dict[str, tuple[float, float]]:
    """Return bounds in radians; bounds whose name ends in _deg are given in degrees."""
    found, faults = {}, FaultList()
    for name, (low, high) in given.items():
        own = name.removesuffix("_deg")
        degrees = name != own
        if degrees and plain_unit(own) != "rad":
            faults.add(
                f"bounds.{name}", [low, high], "is not the name of an angle", f"give bounds.{own} in its unit"
            )
        elif degrees and own in given:
            faults.add(f"bounds.{name}", [low, high], f"is given as {own} too", "keep one of the two")
        found[own] = (math.radians(low), math.radians(high)) if degrees else (low, high)
    faults.raise_if_any()
    return found
