"""The fields for every bound and number of the animal."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from wingbeat._base import NOMENCLATURE, for_people
from wingbeat.animal.kinematics import ANGLES
from wingbeat.animal.species.numbers import PARTS, TAIL_PATHS, Number
from wingbeat.animal.species.scaling import muscle_numbers, tail_numbers
from wingbeat.animal.species.species import Species
from wingbeat_explorer.app.formatting import from_shown, not_a_number, range_text, shown_text, spoken_path
from wingbeat_explorer.app.scenario import TAIL_TILT, Scenario
from wingbeat_explorer.app.widgets import Field, button, folded, number_field, tag

_GROUPS = {
    "vehicle.body": "Body",
    "vehicle.wing": "Wing",
    "vehicle.tail": "Tail",
    "vehicle.muscle": "Flight muscle",
    "vehicle.motor": "Motor",
    "vehicle.springs": "Springs at the flap hinges",
    "vehicle.battery": "Battery",
    "wingbeat": "Fixed parameters",
    "air": "Air",
}
_OF_PARTS = tuple(key for keys in PARTS.values() for key in keys)
# Parts whose numbers follow from laws for birds.
_BY_LAWS = {"vehicle.tail": ("tail", tail_numbers), "vehicle.muscle": ("muscle", muscle_numbers)}
# Bounds of the tail's tilt until the user gives both: the range in the template of species files [rad].
_TILTS = (-math.radians(30.0), math.radians(30.0))


class Numbers:
    """The fields for the bounds and numbers of one animal.

    `species` has the numbers of its file, `scenario` those that the user changed. `change` is called with the new
    ``values`` or ``bounds``, which replace the previous ones.
    """

    def __init__(self, species: Species, scenario: Scenario, change: Callable[..., Any]) -> None:
        self._species, self._change = species, change
        self._scenario = scenario
        # If a species lacks a part, such as a tail, the part's fields are empty.
        self._numbers = {key.path: Number((), key.unit) for key in _OF_PARTS} | species.numbers
        # Parameters that the species holds fixed, and that bounds make free.
        self._freed = [name for name in (TAIL_TILT,) if name not in species.bounds]
        self._values: dict[str, Field] = {}
        self._bounds: dict[tuple[str, int], Field] = {}
        self._resets: list[Any] = []
        with folded("Bounds of free parameters"):
            for name in (*species.bounds, *species.path_bounds):
                self._build_bound(name)
            self._resets.append(button("As in the species file", lambda: change(bounds={}), "quiet"))
        for group, title in _GROUPS.items():
            held = [path for path in self._numbers if self._is_shown(path) and path.startswith(f"{group}.")]
            with folded(title):
                for path in held:
                    self._build_number(path)
                if group == "vehicle.tail" and self._freed:
                    self._build_bound(TAIL_TILT, "A bound makes the tilt free; without bounds it is fixed.")
                if group in _BY_LAWS and getattr(species.vehicle, _BY_LAWS[group][0]) is None:
                    self._build_law(*_BY_LAWS[group])
        self.show(scenario)

    @property
    def fields(self) -> list[Field]:
        """Every field."""
        return [*self._values.values(), *self._bounds.values()]

    def _is_shown(self, path: str) -> bool:
        number, free = self._numbers[path], self._species.free
        empty = number.value == () and not any(path == key.path for key in _OF_PARTS)
        return path != "vehicle.mass" and path.partition("wingbeat.")[2] not in free and not empty

    def _build_law(self, part: str, law: Callable[[float], dict[str, Number]]) -> None:
        """Offer to add a part whose numbers follow from scaling laws, and to remove it."""
        paths = TAIL_PATHS if part == "tail" else tuple(key.path for key in PARTS[part])

        def add() -> None:
            found = {path: number.value for path, number in law(self._species.vehicle.mass).items()}
            self._change(values={**self._scenario.values, **found})

        def remove() -> None:
            values = {path: value for path, value in self._scenario.values.items() if path not in paths}
            self._change(values=values, **({"bounds": self._without(TAIL_TILT)} if part == "tail" else {}))

        button(f"Add the {part} of a bird of this mass", add, "quiet")
        button(f"Remove the {part}", remove, "quiet")

    def _build_number(self, path: str) -> None:
        number = self._numbers[path]
        tip = f"Source: {' '.join(number.source.split())}" if number.source else "No source is given."
        self._values[path] = number_field(
            spoken_path(path), shown_text(path, number), self._set(path), unit=for_people(number.unit)[1], tip=tip
        )

    def _build_bound(self, name: str, tip: str = "") -> None:
        _, unit = for_people(NOMENCLATURE[name].unit)
        tip = tip or self._species.reasons.get(name, "")
        guess = "a guess" if name in self._species.guessed_bounds else ""
        with tag("div", classes="pair", role="group", aria_label=f"Bounds of {name.replace('_', ' ')}"):
            tag("span", name.replace("_", " "), "pair-name")
            for end, word in enumerate(("from", "to")):
                act = self._bound(name, end)
                tip_here = " ".join(part for part in (tip, f"({guess})" if guess else "") if part)
                self._bounds[name, end] = number_field(word, "", act, unit=unit, tip=tip_here)

    def show(self, scenario: Scenario) -> None:
        """Show the values of a scenario, and mark those outside their plausible range."""
        self._scenario = scenario
        for path, field in self._values.items():
            number = self._numbers[path]
            changed = path in scenario.values
            now = number._replace(value=scenario.values[path]) if changed else number
            field.show(shown_text(path, now))
            parts = now.value if isinstance(now.value, tuple) else (now.value,)
            outside = now.range is not None and not all(now.range[0] <= part <= now.range[1] for part in parts)
            hint = range_text(path, now)
            if changed and number.value != ():
                hint = f"{hint}; changed from {shown_text(path, number)}".removeprefix("; ")
            field.mark(f"Outside: {hint}" if outside else hint, outside)
        for (name, end), field in self._bounds.items():
            field.show("" if self._is_fixed(name) else self._bound_text(self._now(name)[end], name))

    def _is_angle(self, name: str) -> bool:
        return name in ANGLES or name in self._species.path_bounds

    def _is_fixed(self, name: str) -> bool:
        return name in self._freed and name not in self._scenario.bounds

    def _now(self, name: str) -> tuple[float, float]:
        own = ({TAIL_TILT: _TILTS} | self._species.path_bounds | self._species.bounds)[name]
        low, high = self._scenario.bounds.get(name, own)
        return low, high

    def _bound_text(self, value: float, name: str) -> str:
        return f"{math.degrees(value) if self._is_angle(name) else value:.6g}"

    def field_of(self, where: str) -> Field | None:
        """Return the field that a fault belongs to."""
        name = where.removeprefix("bounds.")
        if (name, 0) in self._bounds and where.startswith("bounds."):
            return self._bounds[name, 0]
        bare = where.removesuffix("_deg").partition("[")[0]
        return next((self._values[p] for p in (bare, f"vehicle.{bare}") if p in self._values), None)

    def _set(self, path: str) -> Callable[[str], None]:
        number = self._numbers[path]

        def act(text: str) -> None:
            several = (isinstance(number.value, tuple) and number.value != ()) or path.endswith(".chord")
            value = from_shown(text, number.unit, several)
            values = dict(self._scenario.values)
            if not text.strip() or text == shown_text(path, number):
                values.pop(path, None)
            elif value is None:
                self._values[path].refuse(not_a_number(text))
                return
            else:
                values[path] = value
            self._change(values=values)

        return act

    def _without(self, name: str) -> dict[str, tuple[float, float]]:
        return {other: pair for other, pair in self._scenario.bounds.items() if other != name}

    def _bound(self, name: str, end: int) -> Callable[[str], None]:
        def act(text: str) -> None:
            if not text.strip() and name in self._freed:
                self._change(bounds=self._without(name))
                return
            value = self._bounds[name, end].number(text, "rad" if self._is_angle(name) else "")
            if value is None:
                return
            low, high = self._now(name)
            pair = (value, high) if end == 0 else (low, value)
            self._change(bounds={**self._scenario.bounds, name: pair})

        return act
