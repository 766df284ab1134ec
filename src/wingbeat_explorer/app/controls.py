"""The form: animal, flight, air loads, search, and every bound and number of the animal."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

from wingbeat._base import NOMENCLATURE, InvalidInputError, for_people
from wingbeat.aero import AIRSPEEDS, EXTENSIONS, FORCE_POINTS, INFLOWS, LIBRARY, UNSTEADY
from wingbeat.aero.blade_element import OF_ELEMENTS
from wingbeat.animal.kinematics import ANGLES
from wingbeat.animal.species.numbers import PARTS, TAIL_PATHS, Number
from wingbeat.animal.species.reading import species_names
from wingbeat.animal.species.scaling import muscle_numbers, tail_numbers
from wingbeat.animal.species.species import Species
from wingbeat.models import model_of
from wingbeat.orbits.problem.quantities import QUANTITIES
from wingbeat_explorer import default_speeds
from wingbeat_explorer.app.formatting import from_shown, not_a_number, range_text, sentence, shown_text, spoken_path
from wingbeat_explorer.app.links import NO_YES, truth_in
from wingbeat_explorer.app.scenario import (
    NUMBERS,
    TAIL_TILT,
    WHOLE,
    WORDS,
    Scenario,
    animals,
    own_species,
    species_in,
)
from wingbeat_explorer.app.widgets import (
    Field,
    box,
    button,
    choice_field,
    folded,
    number_field,
    slider,
    tag,
    text_field,
)
from wingbeat_explorer.models import EXPLORER_MODELS, name_of

_GROUPS = {
    "vehicle.body": "Body",
    "vehicle.wing": "Wing",
    "vehicle.tail": "Tail",
    "vehicle.muscle": "Flight muscle",
    "vehicle.motor": "Motor",
    "vehicle.springs": "Springs at the flap hinges",
    "wingbeat": "Fixed parameters",
    "air": "Air",
}
_OF_PARTS = tuple(key for keys in PARTS.values() for key in keys)
# Parts whose numbers follow from laws for birds.
_BY_LAWS = {"vehicle.tail": ("tail", tail_numbers), "vehicle.muscle": ("muscle", muscle_numbers)}
# Bounds of the tail's tilt until the user gives both: the range in the template of species files [rad].
_TILTS = (-math.radians(30.0), math.radians(30.0))
_OWN = "(loaded file)"
# The choices of the air loads: name, label, and the words to choose from or None for a number.
_AIR_LOADS = (
    ("aero", "Model", LIBRARY),
    ("extension", "Extension", EXTENSIONS),
    ("force_point", "Force acts at", FORCE_POINTS),
    ("airspeed", "Airspeed", AIRSPEEDS),
    ("unsteady", "Unsteady terms", UNSTEADY),
    ("inflow", "Induced flow", INFLOWS),
    ("induced_factor", "Induced factor", None),
    ("hand", "Model of the hand", ("none", *LIBRARY)),
    ("hand_from", "Hand begins at span fraction", None),
    ("upstroke_factor", "Upstroke factor", None),
)
_FASTEST = 25.0  # m/s, the right end of the slider; faster is typed


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


class Controls:
    """The controls of one page: they show a scenario, and call `change` with the choices that were changed."""

    def __init__(self, scenario: Scenario, change: Callable[..., Any]) -> None:
        self._scenario, self._change = scenario, change
        self._fields: dict[str, Field] = {}
        self._species = "", ""

    def build_flight(self, solve: Callable[[], Any]) -> None:
        """Make the main controls: animal and flight; `solve` is called when the visitor asks for it."""
        now = self._scenario
        with box("Animal and flight", "first"):
            self._own = (_OWN, f"{now.species} (loaded file)") if now.species_file else None
            self._animal_place = tag("div")
            with self._animal_place:
                self._build_animal()
            self._make("speed", "Speed", unit="m/s")
            self._slider = slider("Speed [m/s]", now.speed, 0.0, _FASTEST, 0.1, self._number("speed"))
            self._make("climb", "Climb", unit="m/s")
            whole = [(name, one.title) for name, one in EXPLORER_MODELS.items() if one.coefficients is None]
            self._fields["model"] = choice_field("Flight model", whole, _flight_model(now), self._choose_model)
            self._make("minimise", "Minimise", [(name, _quantity(name)) for name in QUANTITIES])
            button("Solve", solve, "primary", title="Search again from every start")

    def _build_animal(self) -> None:
        own = [self._own] if self._own else []
        value = _OWN if self._scenario.species_file else self._scenario.species
        self._fields["species"] = choice_field("Animal", [*own, *animals()], value, self._choose_animal)

    def build_loads(self) -> None:
        """Make the controls of air loads, search, bounds and numbers."""
        now = self._scenario
        with box("Air loads"):
            for name, label, options in _AIR_LOADS:
                self._make(name, label, None if options is None else [(each, each) for each in options])
            self._make("blend_width_deg", "Half width of the blends", unit="deg")
            self._make("strips", "Strips of a wing")
        with box("Solver"):
            self._make("starts", "Starts", hint="empty: the default number")
            self._make("seed", "Seed")
            self._fields["within_plausible"] = choice_field(
                "Keep to plausible ranges",
                [(word, word) for word in NO_YES],
                NO_YES[now.within_plausible],
                lambda text: self._change(within_plausible=truth_in(text)),
            )
            hint = "such as peak_power<=30, body_pitch_range<=10 deg; separate limits by commas"
            limits = ", ".join(now.limits)
            self._fields["limits"] = text_field("Within limits", limits, self._limits, hint=hint)
        self._numbers_place = tag("div", classes="numbers")
        self._build_numbers()

    def _make(
        self,
        name: str,
        label: str,
        options: Sequence[tuple[str, str]] | None = None,
        unit: str = "",
        hint: str = "",
    ) -> None:
        """Make the control of a choice: one of several (value, label) pairs, or a number."""
        value = getattr(self._scenario, name)
        if options is not None:
            made = choice_field(label, options, value, lambda text: self._change(**{name: text}))
        else:
            act = self._whole(name) if name in WHOLE else self._number(name)
            made = number_field(label, _typed(value), act, unit=unit, hint=hint)
        self._fields[name] = made

    def _build_numbers(self) -> None:
        self._species = _animal_of(self._scenario)
        self._numbers_place.clear()
        with self._numbers_place:
            self._numbers = Numbers(species_in(self._scenario), self._scenario, self._change)

    def show(self, scenario: Scenario) -> None:
        """Show another scenario."""
        before, self._scenario = self._scenario, scenario
        if _animal_of(scenario) != self._species:
            self._own = (_OWN, f"{scenario.species} (loaded file)") if scenario.species_file else None
            self._animal_place.clear()
            with self._animal_place:
                self._build_animal()
            self._build_numbers()
        elif scenario.values != before.values or scenario.bounds != before.bounds:
            self._numbers.show(scenario)
        for name in (*NUMBERS, *WHOLE):
            self._fields[name].show(_typed(getattr(scenario, name)))
        for name in WORDS:
            if name not in ("species", "model"):  # each has more to it
                self._fields[name].show(getattr(scenario, name))
        self._fields["model"].show(_flight_model(scenario))
        self._fields["within_plausible"].show(NO_YES[scenario.within_plausible])
        self._fields["limits"].show(", ".join(scenario.limits))
        if self._slider.props.get("value") != f"{scenario.speed:g}":
            self._slider.props["value"] = f"{scenario.speed:g}"

    def refuse(self, refusals: list[list[str]]) -> list[str]:
        """Show each fault beside its control; return the faults that belong to no control."""
        told: dict[Field, list[str]] = {}
        homeless = []
        for where, message in refusals:
            field = self._field_of(where)
            if field is None:
                homeless.append(sentence(where, message))
            else:
                told.setdefault(field, []).append(message)
        for field in [*self._fields.values(), *self._numbers.fields]:
            field.refuse("; ".join(told.get(field, [])))
        return homeless

    def _field_of(self, where: str) -> Field | None:
        aliases = {"coefficients": "aero", "quantity": "minimise", "constraint": "limits", "subject_to": "limits"}
        name = aliases.get(where.partition("[")[0], where)
        return self._fields.get(name) or self._numbers.field_of(where)

    def choose(self, **asked: Any) -> None:
        """Change species, model (its name in the face) or speed [m/s], as the controls do."""
        if "species" in asked:
            self._choose_animal(asked["species"], asked.get("model"))
        elif "model" in asked:
            self._choose_model(asked["model"])
        else:
            self._change(**asked)

    def _choose_animal(self, name: str, model: str | None = None) -> None:
        if name not in species_names():  # the loaded file, which is chosen already
            return
        # The changed numbers belonged to another animal, and a model depends on the kind of flyer.
        species = own_species(Scenario(species=name))
        if model is None and self._scenario.model != "paper":
            model = self._scenario.face_model
        loads = {} if model is None else _modelled(model, species)
        speed, sweep = speeds_for(species, self._scenario.speed)
        self._change(species=name, species_file="", values={}, bounds={}, speed=speed, sweep=sweep, **loads)

    def _choose_model(self, name: str) -> None:
        """Take the air loads and objective of a model; drop changed numbers, which the new model may not have."""
        try:
            chosen = _modelled(name, own_species(self._scenario))
        except InvalidInputError as error:
            self._fields["model"].refuse("; ".join(fault.fix for fault in error.faults))
            return
        self._change(values={}, bounds={}, **chosen)

    def _number(self, name: str) -> Callable[[str], None]:
        def act(text: str) -> None:
            if (value := self._fields[name].number(text)) is not None:
                self._change(**{name: value})

        return act

    def _whole(self, name: str) -> Callable[[str], None]:
        def act(text: str) -> None:
            value = from_shown(text, "", several=False)
            if name == "starts" and not text.strip():
                self._change(starts=None)
            elif isinstance(value, float) and value == math.floor(value):
                self._change(**{name: int(value)})
            else:
                self._fields[name].refuse(f"{text[:30]!r} is not a whole number")

        return act

    def _limits(self, text: str) -> None:
        self._change(limits=tuple(part.strip() for part in text.split(",") if part.strip()))


def choices_of(name: str, species: Species) -> dict[str, Any]:
    """Return the choices of the page that a model makes for a species."""
    model = model_of(name, species)
    loads = {place: getattr(model.aero, place) for place in OF_ELEMENTS if place != "strips"}
    return {"aero": model.aero.coefficients.name, "minimise": model.objective(model.species(species)), **loads}


def _modelled(name: str, species: Species) -> dict[str, Any]:
    """Return the choices of the page for a model by its name in the face."""
    meant = EXPLORER_MODELS[name]
    chosen = {"model": meant.model, "within_plausible": meant.within_plausible, **choices_of(meant.model, species)}
    return chosen | ({} if meant.coefficients is None else {"aero": meant.coefficients})


def speeds_for(species: Species, speed: float) -> tuple[float, tuple[float, float, float]]:
    """Return a speed for an animal, the present one if it may fly so, and the range of its curve [m/s]."""
    speeds = default_speeds(species)
    first, last = speeds[0], speeds[-1]
    step = max(math.ceil((last - first) / 6) / 2, 0.5)
    return speed if first <= speed <= last else speeds[len(speeds) // 2], (first, last, step)


def _animal_of(scenario: Scenario) -> tuple[str, str]:
    """Return the species and its model, which together determine the numbers on the page."""
    return scenario.species_file or scenario.species, scenario.model


def _flight_model(scenario: Scenario) -> str:
    """Return the model's name in the drawer, which has the coefficients in a field of their own."""
    return name_of(scenario.model, "", scenario.within_plausible)


def _typed(value: float | None) -> str:
    """Return a number as the visitor would type it; the default number of starts is left empty."""
    return "" if value is None else str(value) if isinstance(value, int) else f"{value:g}"


def _quantity(name: str) -> str:
    _, unit = for_people(NOMENCLATURE[name].unit)
    return name.replace("_", " ") + (f" [{unit.replace('s2', 's²')}]" if unit else "")
