"""The form: animal, flight, air loads and search; bounds and numbers of the animal are in `number_fields`."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

from wingbeat._base import NOMENCLATURE, InvalidInputError, for_people
from wingbeat.aero import AIRSPEEDS, EXTENSIONS, FORCE_POINTS, INFLOWS, LIBRARY, UNSTEADY, WAKES
from wingbeat.aero.blade_element import OF_ELEMENTS
from wingbeat.aero.completion import VITERNA
from wingbeat.animal.species.reading import species_names
from wingbeat.animal.species.species import Species
from wingbeat.models import model_of
from wingbeat.orbits.problem.quantities import QUANTITIES
from wingbeat_explorer import default_speeds
from wingbeat_explorer.app.formatting import from_shown, sentence
from wingbeat_explorer.app.links import NO_YES, truth_in
from wingbeat_explorer.app.number_fields import Numbers
from wingbeat_explorer.app.scenario import NUMBERS, WHOLE, WORDS, Scenario, animals, own_species, species_in
from wingbeat_explorer.app.widgets import (
    Field,
    box,
    button,
    choice_field,
    number_field,
    set_class,
    slider,
    tag,
    text_field,
)
from wingbeat_explorer.models import EXPLORER_MODELS, name_of

_OWN = "(loaded file)"
# The choices of the air loads: name, label, and the words to choose from or None for a number.
_AIR_LOADS = (
    ("extension", "Extension", (*EXTENSIONS, VITERNA)),
    ("force_point", "Force acts at", FORCE_POINTS),
    ("airspeed", "Airspeed", AIRSPEEDS),
    ("unsteady", "Unsteady terms", UNSTEADY),
    ("wake", "Lag of the wake", WAKES),
    ("inflow", "Induced flow", INFLOWS),
    ("induced_factor", "Induced factor", None),
    ("hand", "Model of the hand", ("none", *LIBRARY)),
    ("hand_from", "Hand begins at span fraction", None),
    ("upstroke_factor", "Upstroke factor", None),
)
_FASTEST = 25.0  # m/s, the right end of the slider; faster is typed


class Controls:
    """The controls of one page: they show a scenario, and call `change` with the choices that were changed."""

    def __init__(self, scenario: Scenario, change: Callable[..., Any]) -> None:
        self._scenario, self._change = scenario, change
        self._fields: dict[str, Field] = {}
        self._species = "", ""
        self._table = ("", "", "")  # name, text and extension of the visitor's own coefficients

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
            self._frequency_place = tag("div")
            self._build_frequency()
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
            self._aero_place = tag("div")
            self._build_aero()
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

    def _build_frequency(self) -> None:
        """Offer the animal's own frequency, where the model flies at it, a given one, and the search for it."""
        self._frequency_place.clear()
        options = [("given", "as given"), ("free", "searched")]
        if self._flies_at_own():
            options.insert(0, ("own", "the animal's own, by measurement or law"))
        now = self._scenario.frequency
        with self._frequency_place:
            self._asked = choice_field("Frequency", options, "", self._choose_frequency)
            act = self._number("frequency")
            self._fields["frequency"] = number_field("Given frequency", _typed(now), act, unit="Hz")
        self._show_frequency()

    def _flies_at_own(self) -> bool:
        species = own_species(self._scenario)
        return bool(species.kind) and model_of(self._scenario.model, species).frequency == "own"

    def _show_frequency(self) -> None:
        now = self._scenario
        searched = now.free_frequency or "frequency" in now.bounds or not self._flies_at_own()
        self._asked.show("given" if now.frequency is not None else "free" if searched else "own")
        set_class(self._fields["frequency"].row, "hidden", now.frequency is None)

    def _choose_frequency(self, word: str) -> None:
        bounds = {name: pair for name, pair in self._scenario.bounds.items() if name != "frequency"}
        if word == "free":
            self._change(frequency=None, free_frequency=self._flies_at_own())
        elif word == "own":
            self._change(frequency=None, free_frequency=False, bounds=bounds)
        else:
            own = own_species(self._scenario).own_frequency(self._scenario.speed).value
            self._change(frequency=float(f"{own:.3g}"), free_frequency=False, bounds=bounds)

    def _build_aero(self) -> None:
        self._aero_place.clear()
        name, text, _ = self._table
        own = [(name, f"{name} ({'loaded file' if text else 'file not loaded'})")] if name else []
        library = [(each, each) for each in LIBRARY]
        with self._aero_place:
            self._fields["aero"] = choice_field("Model", [*own, *library], self._scenario.aero, self._choose_aero)

    def _choose_aero(self, name: str) -> None:
        if name == self._table[0]:
            self._change(aero=name, aero_file=self._table[1], extension=self._table[2])
        else:
            self._change(**self._from_library(name))

    def _from_library(self, name: str) -> dict[str, Any]:
        """Return the choice of coefficients of the library, which no rule of Viterna completes."""
        extended = {"extension": "mirrored"} if self._scenario.extension == VITERNA else {}
        return {"aero": name, "aero_file": "", **extended}

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
        if scenario.aero not in LIBRARY:
            known, self._table = self._table, (scenario.aero, scenario.aero_file, scenario.extension)
            if known[:2] != self._table[:2]:
                self._build_aero()
        if (before.model, before.species, before.species_file) != (
            scenario.model,
            scenario.species,
            scenario.species_file,
        ):
            self._build_frequency()
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
        self._show_frequency()
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
        loads = {} if model is None else self._modelled(model, species)
        speed, sweep = speeds_for(species, self._scenario.speed)
        own = {"species_file": "", "values": {}, "bounds": {}, "frequency": None, "free_frequency": False}
        self._change(species=name, speed=speed, sweep=sweep, **own | loads)

    def _choose_model(self, name: str) -> None:
        """Take the air loads and objective of a model; drop changed numbers, which the new model may not have."""
        try:
            chosen = self._modelled(name, own_species(self._scenario))
        except InvalidInputError as error:
            self._fields["model"].refuse("; ".join(fault.fix for fault in error.faults))
            return
        if chosen["model"] != self._scenario.model:
            chosen |= {"frequency": None, "free_frequency": False}
        self._change(values={}, bounds={}, **chosen)

    def _modelled(self, name: str, species: Species) -> dict[str, Any]:
        """Return the choices of the page for a model by its name in the face."""
        meant = EXPLORER_MODELS[name]
        chosen = {"model": meant.model, "within_plausible": meant.within_plausible}
        chosen |= choices_of(meant.model, species)
        return chosen | self._from_library(meant.coefficients or chosen["aero"])

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
