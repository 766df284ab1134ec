"""A scenario: every choice of the page, their checks, and the orbit problem that they define."""

from __future__ import annotations

import dataclasses
import functools
import math
import os
import tempfile
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, get_type_hints

from pydantic import AfterValidator, Field, SkipValidation, Strict

from wingbeat._base import FaultList, FileError, InvalidInputError
from wingbeat.aero import (
    EXTENSIONS,
    LIBRARY,
    BladeElement,
    FamilyCoefficients,
    TableCoefficients,
    load_coefficients,
)
from wingbeat.aero.blade_element import ELEMENT_LIMITS, ELEMENT_WORDS, OF_ELEMENTS, load_hand
from wingbeat.aero.completion import VITERNA
from wingbeat.aero.polar_formats import POLAR_SUFFIXES
from wingbeat.aero.polar_models import load_table
from wingbeat.animal.species.making import load_species, species_of
from wingbeat.animal.species.reading import read_species_text, species_names
from wingbeat.animal.species.species import Species
from wingbeat.models import MODELS, model_of
from wingbeat.orbits.problem.problem import CLIMB_LIMITS, SPEED_LIMITS, OrbitProblem
from wingbeat.orbits.problem.quantities import FASTEST, QUANTITIES
from wingbeat_explorer.app.formatting import clean_label
from wingbeat_explorer.models import name_of, search_starts

# Limits for one visitor, because others use the machine, too.
MOST_STARTS, MOST_STRIPS, MOST_SPEEDS, MOST_LIMITS, MOST_NUMBERS = 100, 60, 60, 8, 60
TAIL_TILT = "tail_tilt"  # the parameter that a species holds fixed and the page can free
LARGEST_FILE = 1 << 18  # characters of a species file, as `load_species` has it
LARGEST_TABLE = 1 << 20  # characters of a file of coefficients; twenty polars of a whole turn take 0.3 million
_LONGEST_WORD = 200


def _shown(text: str) -> str:
    """Return a text of one line that is not too long to be shown."""
    if len(text) > _LONGEST_WORD or not text.isprintable():
        raise ValueError
    return text


def _encodable(text: str) -> str:
    """Return a text that UTF-8 can encode; JSON may contain lone surrogates, which have no code in UTF-8."""
    text.encode()
    return text


# What links and files from elsewhere may hold in place of a choice.
Word = Annotated[str, Strict(), AfterValidator(_shown)]
Finite = Annotated[float, Strict(), Field(allow_inf_nan=False)]
Row = Annotated[tuple[Finite, ...], Field(max_length=1000)]
Whole = Annotated[int, SkipValidation]  # the scenario's own check names the range
Switch = Annotated[bool, Strict()]


@dataclass(frozen=True)
class Scenario:
    """Every choice of the page; SI units and radians. Links, files and their checks follow from these fields.

    Parameters
    ----------
    species : name of a built-in species, or of the one in `species_file`.
    species_file : TOML text of the visitor's own species, empty for a built-in one.
    speed, climb : mean velocity [m/s].
    model : ``"paper"`` or ``"animal"``, see `wingbeat.models`; it determines what is added to the species. If a
        model is chosen on the page, the page also sets its air loads and objective, which can be changed later.
    frequency : a frequency to fly at [Hz]; None for the model's own choice, see `wingbeat.models`.
    free_frequency : whether it is searched for in place of the model's own choice; bounds of it say the same.
    aero_file : text of the visitor's own coefficients, empty for those of the library; `aero` is the file's name.
        It stays in the session and in saved states: links have the name alone.
    aero, extension, blend_width_deg, strips, force_point, airspeed, unsteady, wake, inflow, induced_factor,
        hand, hand_from, upstroke_factor : the air loads, as on the command line.
    minimise : name of the quantity to minimise.
    limits : limits on quantities, texts as for ``--subject-to``.
    bounds : bounds of free parameters in place of the species' own. Species keep ``tail_tilt`` fixed; bounds make
        it free.
    within_plausible : whether the flight keeps to the species' plausible ranges; then `bounds` are empty.
    values : numbers of the species that were changed, by their paths.
    starts : number of starts, None for the default, see `search_starts`.
    seed : of the random starts.
    sweep : first and last speed and step of the curve [m/s].
    """

    species: Word = "pigeon"
    species_file: Annotated[str, Strict(), AfterValidator(_encodable)] = ""
    speed: Finite = 10.0
    climb: Finite = 0.0
    model: Word = "paper"
    frequency: Finite | None = None
    free_frequency: Switch = False
    aero: Word = "su-fan"
    aero_file: Annotated[str, Strict(), AfterValidator(_encodable)] = ""
    extension: Word = "mirrored"
    blend_width_deg: Finite = 1.0
    strips: Whole = BladeElement.strips
    force_point: Word = BladeElement.force_point
    airspeed: Word = BladeElement.airspeed
    unsteady: Word = BladeElement.unsteady
    wake: Word = BladeElement.wake
    inflow: Word = BladeElement.inflow
    induced_factor: Finite = BladeElement.induced_factor
    hand: Word = BladeElement.hand
    hand_from: Finite = BladeElement.hand_from
    upstroke_factor: Finite = BladeElement.upstroke_factor
    minimise: Word = "frequency"
    limits: tuple[Word, ...] = ()
    bounds: Mapping[Word, tuple[Finite, Finite]] = field(default_factory=dict)
    within_plausible: Switch = False
    values: Mapping[Word, Finite | Row] = field(default_factory=dict)
    starts: Whole | None = None
    seed: Whole = 0
    sweep: tuple[Finite, Finite, Finite] = (4.0, 16.0, 1.0)

    @property
    def face_model(self) -> str:
        """The model by its name in the face, see `wingbeat_explorer.models`."""
        return name_of(self.model, self.aero, self.within_plausible)

    @property
    def search_starts(self) -> int | None:
        """The number of starts of a search, None for the solver's default."""
        return search_starts(self.starts, self.within_plausible)

    def faults(self) -> FaultList:
        """Return the faults of each choice by itself; `problem_of` checks the choices together."""
        faults = FaultList()
        if not self.species_file:
            faults.choice("species", self.species, species_names())
        elif len(self.species_file) > LARGEST_FILE:
            faults.add("species_file", f"{len(self.species_file)} characters", f"must be <= {LARGEST_FILE}")
        faults.number("speed", self.speed, **SPEED_LIMITS, fix="0 is hover")
        faults.number("climb", self.climb, **CLIMB_LIMITS, fix="0 is level flight")
        faults.choice("model", self.model, MODELS)
        is_file = self.aero.lower().endswith(POLAR_SUFFIXES) and clean_label(self.aero) == self.aero
        if not is_file and not self.aero_file:
            faults.choice("aero", self.aero, tuple(LIBRARY))
        elif not is_file:
            fix = f"the name ends in {', '.join(POLAR_SUFFIXES)}"
            faults.add("aero", self.aero, "is no name of a file of coefficients", fix)
        elif not self.aero_file:
            fix = "drop it here, or choose other coefficients"
            faults.add("aero", self.aero, f"needs the file {self.aero}, which no link holds", fix)
        elif len(self.aero_file) > LARGEST_TABLE:
            faults.add(
                "aero", self.aero, f"has {len(self.aero_file)} characters", f"at most {LARGEST_TABLE} are read"
            )
        faults.choice("extension", self.extension, (*EXTENSIONS, VITERNA))
        if self.frequency is not None:
            faults.number("frequency", self.frequency, above=0, unit="Hz", fix="leave it empty for the model's own")
            if self.free_frequency:
                faults.add("frequency", self.frequency, "is given, and also searched for", "keep one")
        faults.number("blend_width_deg", self.blend_width_deg, above=0, at_most=3, unit="deg")
        for name, words in ELEMENT_WORDS.items():
            faults.choice(name, getattr(self, name), words)
        faults.number("induced_factor", self.induced_factor, **ELEMENT_LIMITS["induced_factor"])
        faults.choice("hand", self.hand, ("none", *LIBRARY))
        for name in ("hand_from", "upstroke_factor"):
            faults.number(name, getattr(self, name), **ELEMENT_LIMITS[name])
        faults.choice("minimise", self.minimise, tuple(QUANTITIES))
        if self.within_plausible and self.bounds:
            fix = "take back the changed bounds, or switch the plausible ranges off"
            faults.add("within_plausible", "yes", "cannot be combined with bounds of your own", fix)
        faults.whole("strips", self.strips, 1, MOST_STRIPS)
        faults.whole("seed", self.seed, 0, 100_000)
        if self.starts is not None:
            faults.whole("starts", self.starts, 1, MOST_STARTS)
        for name, count, most in (
            ("limits", len(self.limits), MOST_LIMITS),
            ("bounds", len(self.bounds), MOST_NUMBERS),
            ("set", len(self.values), MOST_NUMBERS),
        ):
            if count > most:
                faults.add(name, count, f"must be at most {most}", "leave some out")
        self._check_sweep(faults)
        return faults

    def _check_sweep(self, faults: FaultList) -> None:
        first, last, step = self.sweep
        good = faults.number("sweep.from", first, **SPEED_LIMITS)
        good &= faults.number("sweep.to", last, **SPEED_LIMITS)
        if faults.number("sweep.step", step, above=0, at_most=FASTEST, unit="m/s") and good:
            if not first < last:
                faults.add("sweep.to", last, f"must be > {first:g} m/s", "the curve runs from slow to fast")
            elif (last - first) / step > MOST_SPEEDS - 1 + 1e-9:
                faults.add("sweep.step", step, f"gives more than {MOST_SPEEDS} speeds", "take longer steps")

    def speeds(self) -> list[float]:
        """Return the speeds of the curve [m/s]."""
        first, last, step = self.sweep
        return [round(first + i * step, 9) for i in range(math.floor((last - first) / step + 1e-9) + 1)]

    def at(self, speed: float) -> Scenario:
        """Return the scenario at another speed [m/s]."""
        return dataclasses.replace(self, speed=speed)

    def asks_as(self, other: Scenario) -> bool:
        """Return whether two scenarios ask for the same orbit; the range of the curve does not matter."""
        return self == dataclasses.replace(other, sweep=self.sweep)


def _named(*types: object) -> tuple[str, ...]:
    """Return the names of the choices of these types; the text of a file is no word."""
    hints = get_type_hints(Scenario)
    return tuple(name for name, kind in hints.items() if kind in types and not name.endswith("_file"))


WORDS, NUMBERS, WHOLE, SWITCHES = (
    _named(str),
    _named(float, float | None),
    _named(int, int | None),
    _named(bool),
)


@functools.lru_cache(maxsize=32)
def species_from_text(text: str, label: str) -> Species:
    """Return the species that the text of a species file describes.

    Raises
    ------
    FileError : not TOML. InvalidInputError : everything that is wrong with it.
    """
    faults = FaultList()
    return species_of(read_species_text(text, label, label.removesuffix(".toml"), faults), faults)


@functools.lru_cache(maxsize=16)
def table_of(
    content: bytes, label: str, extension: str, blend_width_deg: float
) -> TableCoefficients | FamilyCoefficients:
    """Return the coefficients in a visitor's file, whose name is `label`; all is as `load_table` has it.

    Raises
    ------
    FileError, InvalidInputError : in the words of the command line.
    """
    with tempfile.TemporaryDirectory(prefix="wingbeat-") as folder:
        path = Path(folder) / label
        path.write_bytes(content)
        try:
            return load_table(path, extension, blend_width_deg)
        except FileError as error:
            raise FileError(str(error).replace(folder + os.sep, "")) from None
        except InvalidInputError as error:  # some name the command that helps, with the path
            told = [dataclasses.replace(one, fix=one.fix.replace(folder + os.sep, "")) for one in error.faults]
            raise InvalidInputError(told) from None


@functools.lru_cache(maxsize=64)
def _built_in(name: str) -> Species:
    return load_species(name)


@functools.cache
def animals() -> tuple[tuple[str, str], ...]:
    """Return name and title of every built-in species, by title; the first call reads all their files."""
    named = ((name, load_species(name).common_name or name) for name in species_names())
    return tuple(sorted(named, key=lambda pair: pair[1].lower()))


def species_in(scenario: Scenario) -> Species:
    """Return the species with the numbers of its file and of its model, before the user's changes.

    A species of unknown kind gets no numbers from the model; `problem_of` then refuses a model that needs the kind.
    """
    own = own_species(scenario)
    return model_of(scenario.model, own).species(own) if own.kind else own


def own_species(scenario: Scenario) -> Species:
    """Return the species with the numbers of its file alone."""
    if scenario.species_file:
        return species_from_text(scenario.species_file, f"{scenario.species}.toml")
    return _built_in(scenario.species)


def problem_of(scenario: Scenario) -> OrbitProblem:
    """Return the orbit problem of a scenario; the command line makes the same problem from the same choices.

    Raises
    ------
    InvalidInputError : everything that is wrong with it; `where` names the choice.
    """
    faults = scenario.faults()
    faults.raise_if_any()
    species, loads, model = None, None, None
    try:
        species = species_in(scenario)
        free = scenario.free_frequency or (scenario.frequency is None and "frequency" in scenario.bounds)
        model = model_of(scenario.model, species, "free" if free else scenario.frequency)
        if scenario.values:
            species = species.with_values(dict(scenario.values))
    except InvalidInputError as error:
        faults.faults += error.faults
    except FileError as error:
        faults.add("species_file", scenario.species, str(error))
    try:
        reach = scenario.extension, scenario.blend_width_deg
        elements = {name: getattr(scenario, name) for name in OF_ELEMENTS}
        elements["hand"] = load_hand(scenario.hand, *reach)
        if scenario.aero_file:
            coefficients = table_of(scenario.aero_file.encode(), scenario.aero, *reach)
        else:
            coefficients = load_coefficients(scenario.aero, *reach)
        loads = BladeElement(coefficients, **elements)
    except InvalidInputError as error:
        faults.faults += error.faults
    except FileError as error:
        faults.add("aero", scenario.aero, str(error))
    faults.raise_if_any()
    assert species is not None
    assert model is not None
    if TAIL_TILT in scenario.bounds and TAIL_TILT not in species.free:
        species = dataclasses.replace(species, free=(*species.free, TAIL_TILT))
    return dataclasses.replace(model, aero=loads).problem(
        species,
        scenario.speed,
        climb=scenario.climb,
        bounds="plausible" if scenario.within_plausible else dict(scenario.bounds),
        minimise=scenario.minimise,
        subject_to=scenario.limits,
    )
