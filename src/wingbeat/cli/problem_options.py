"""Options from which a problem is made: species, speed, model, limits and moving air; and saved orbits."""

from __future__ import annotations

import dataclasses
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Annotated, Any

import numpy as np
from cyclopts import Parameter

from wingbeat._base import FaultList, FileError, InvalidInputError, first_line
from wingbeat.aero import EXTENSIONS, FORCE_POINTS, BladeElement, load_coefficients
from wingbeat.aero.blade_element import load_hand
from wingbeat.aero.model_file import Fitted, read_model
from wingbeat.aero.winds import LEVELS, CosineGust, DrydenTurbulence, Wind
from wingbeat.animal.species.building import DENSITY_ALONE
from wingbeat.animal.species.making import load_species
from wingbeat.animal.species.reading import parse_setting
from wingbeat.animal.species.species import Species
from wingbeat.cli.arguments import Whole, as_typed, flag, named_numbers, option, several
from wingbeat.models import Frequency, Model, model_of
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.problem.quantities import Constraint
from wingbeat.orbits.problem.quantity import STABLE_RADIUS
from wingbeat.records.inputs import NotInFileError
from wingbeat.results.orbit import Orbit, load_orbit
from wingbeat.words.orbit_words import air_in_words

# --- the problem ---

SPECIES = option("Name of a species, or path of a species file.")
SPEED = option("Mean forward speed [m/s]; 0 is hover.")
Climb = Annotated[float, option("Mean climb rate [m/s].")]
Limits = Annotated[list[str] | None, several("Limits: 'peak_power<=30' 'frequency=6' ...")]
Minimise = Annotated[str | None, option("Quantity to minimise, as in `wingbeat orbit`.")]
Starts = Annotated[Whole | None, option("Number of starts, as in `wingbeat orbit`.")]
Stable = Annotated[bool, flag("Find an orbit on which disturbances decay: short for 'spectral_radius<=0.995'.")]
Settings = Annotated[
    list[str] | None,
    several("Numbers to change, PATH=VALUE: wing.mass=0.02 ... `wingbeat species NAME` lists the paths.", "--set"),
]
Payload = Annotated[float, option("Load carried at the body's centre of mass [kg].")]
WithinPlausible = Annotated[bool, flag("Keep parameters, powers and forces within the species' plausible ranges.")]
WingsMayCross = Annotated[bool, flag("Let the wings pass through the plane of symmetry and through each other.")]

_OF_COEFFICIENTS = ("aero", "extension", "blend_width_deg", "hand")


@Parameter(name="*")
@dataclass(frozen=True)
class ModelOptions:
    """The options of model and air loads, shared by all commands that fly an animal.

    If an option is not given, the model's own choice applies.
    """

    model: Annotated[
        str,
        option(
            "Model of the flight: paper (as in Su et al. 2023), or animal (coefficients, tail, body drag, "
            "air-load terms and muscle of the animal's kind). Other options replace parts of the model; their "
            "stated defaults are those of paper."
        ),
    ] = "paper"
    frequency: Annotated[
        float | None,
        option(
            "Frequency to fly at [Hz]. Default: paper searches for it; animal takes that of the bird or bat, "
            "measured or by a law of its kind."
        ),
    ] = None
    free: Annotated[
        list[str] | None,
        several("Parameters that are free in addition: frequency, twist_ratio, stroke_plane_tilt ..."),
    ] = None
    aero: Annotated[
        list[str] | None,
        option(
            "Coefficients: su-fan (default), feathered, ... (see `polar`), a table (.csv), a polar (.pol, .dat, "
            "...) or a fit (.toml). Several polars, such as naca0012_re*.txt, are one model that depends on the "
            "Reynolds number."
        ),
    ] = None
    extension: Annotated[
        str | None,
        option(
            f"Extension to angles outside the fit: {', '.join(EXTENSIONS)}; default mirrored. viterna completes a "
            "table that ends at the stall."
        ),
    ] = None
    blend_width_deg: Annotated[
        float | None, option("Half width [deg] of the blends at 0, 90 and 180 degrees; default 1.")
    ] = None
    force_point: Annotated[
        str | None,
        option(
            f"Where the force acts: {' or '.join(FORCE_POINTS)}; default {BladeElement.force_point}; of a wing "
            "whose pitch gives way, centre-of-pressure."
        ),
    ] = None
    airspeed: Annotated[
        str | None,
        option(
            "Airspeed that determines a strip's loads: planar (default: without the component along the span) "
            "or full (with this component)."
        ),
    ] = None
    strips: Annotated[Whole | None, option(f"Number of strips of one wing; default {BladeElement.strips}.")] = None
    unsteady: Annotated[
        str | None, option("Unsteady terms: none (default), or thin-aerofoil (rotation, added mass and couples).")
    ] = None
    wake: Annotated[
        str | None,
        option("Lag of the wake: none (default), jones-section, or jones-finite (of a wing of finite span)."),
    ] = None
    inflow: Annotated[
        str | None,
        option("Induced flow: none (default), or momentum (for coefficients whose aspect ratio is known)."),
    ] = None
    induced_factor: Annotated[
        float | None,
        option(f"Ratio of induced power to that of an ideal disc; default {BladeElement.induced_factor}."),
    ] = None
    hand: Annotated[
        str | None,
        option(
            "Coefficients of the hand; takes the same names as --aero. --aero then applies to the arm alone. "
            "Default none: --aero applies to the whole wing."
        ),
    ] = None
    hand_from: Annotated[
        float | None, option(f"Fraction of the span at which --hand begins; default {BladeElement.hand_from}.")
    ] = None
    upstroke_factor: Annotated[
        float | None, option("Factor from 0 to 1 on lift and drag where air meets the wing from above; default 1.")
    ] = None
    altitude: Annotated[
        float | None,
        option(
            "Height above sea level, -500 to 9000 [m]: sets air.density and air.viscosity to those of the standard "
            "atmosphere. Default: the air of the species, or sea level if --temperature is given."
        ),
    ] = None
    temperature: Annotated[
        float | None,
        option(
            "Temperature of the air, -60 to 60 [deg C], with the pressure of the altitude; default that of the "
            "standard atmosphere, 15 at sea level."
        ),
    ] = None

    @property
    def files(self) -> list[str]:
        """The names of coefficients, some of which may be paths of files."""
        return [*(self.aero or ()), *([] if self.hand is None else [self.hand])]

    def typed(self) -> list[str]:
        """Return the given options as words of a command line."""
        given = {one.name: getattr(self, one.name) for one in fields(self)}
        return as_typed(**{one.name: given[one.name] for one in fields(self) if given[one.name] != one.default})

    def flown(self, name: str, settings: list[str] | None, payload: float = 0.0) -> tuple[Species, Model]:
        """Return (species, model), with the given air loads, the numbers of ``--set`` and a payload."""
        species = load_species(name)
        model = model_of(self.model, species, self._frequency())
        own = ("model", "altitude", "temperature", "frequency", "free")
        given = {name: value for name, value in vars(self).items() if name not in own and value is not None}
        if given:
            others = {name: value for name, value in given.items() if name not in _OF_COEFFICIENTS}
            loads = dataclasses.replace(model.aero, **self._coefficients(model.aero), **others)
            model = dataclasses.replace(model, aero=loads)
        above = (self.altitude, self.temperature)
        flown = with_settings(model.species(species), settings, payload, *above)
        return flown.with_free([name for name in self.free or () if name != "frequency"]), model

    def _frequency(self) -> Frequency | None:
        """Return the frequency that ``--frequency`` and ``--free`` ask for, in the form of `model_of`."""
        searched = "frequency" in (self.free or ())
        if searched and self.frequency is not None:
            faults = FaultList()
            faults.add("--frequency", self.frequency, "is given, but --free frequency searches for it", "keep one")
            faults.raise_if_any()
        return "free" if searched else self.frequency

    def problem(
        self,
        name: str,
        speed: float,
        settings: list[str] | None,
        payload: float = 0.0,
        *,
        within_plausible: bool = False,
        **asked: Any,
    ) -> OrbitProblem:
        """Return the problem for a species given by name or file; None in `asked` means the model's own choice."""
        species, model = self.flown(name, settings, payload)
        given = {key: value for key, value in asked.items() if value is not None}
        if self.force_point is not None:
            given["aero"] = model.aero  # a hinge does not change the choice
        return model.problem(species, speed, bounds="plausible" if within_plausible else {}, **given)

    def fit(self) -> Fitted | None:
        """Return the fit with its covariance if ``--aero`` names a fitted model's file; else None."""
        given = self.aero or [""]
        return read_model(given[0]) if len(given) == 1 and given[0].lower().endswith(".toml") else None

    def _coefficients(self, own: BladeElement) -> dict[str, Any]:
        """Return the given coefficients of arm and hand; a given extension also applies to the model's own ones."""
        reach = self.extension or "mirrored", 1.0 if self.blend_width_deg is None else self.blend_width_deg
        found: dict[str, Any] = {}
        if self.aero is not None or self.extension is not None or self.blend_width_deg is not None:
            found["coefficients"] = load_coefficients(self.aero or own.coefficients.name, *reach)
            say_notes(self.aero, found["coefficients"])
        if self.hand is not None:
            found["hand"] = load_hand(self.hand, *reach)
            say_notes(self.hand, found["hand"])
        return found


def say_notes(given: str | list[str] | None, coefficients: object) -> None:
    """Print what a table's file, several files or a fit say about themselves on standard error."""
    name = given[0] if isinstance(given, list) and len(given) == 1 else given
    fit = read_model(name) if isinstance(name, str) and name.lower().endswith(".toml") else coefficients
    shown = name if isinstance(name, str) or name is None else f"{name[0]} and {len(name) - 1} more"
    for note in getattr(fit, "notes", ()):
        print(f"note: {shown}: {note}", file=sys.stderr)


DEFAULT_MODEL = ModelOptions()


def limits_of(subject_to: list[str] | None, stable: bool) -> list[Any]:
    """Return the limits of ``--subject-to``, with the limit of ``--stable``."""
    return [*(subject_to or ()), *([Constraint("spectral_radius", STABLE_RADIUS)] if stable else [])]  # type: ignore[arg-type]


def with_settings(
    species: Species,
    settings: list[str] | None,
    payload: float = 0.0,
    altitude: float | None = None,
    temperature: float | None = None,
) -> Species:
    """Return a species with the numbers of ``--set``, a payload and the air of an altitude.

    Standard error says which air an altitude gives, and if only a density is set.
    """
    species = changed(species, settings, altitude, temperature)
    if altitude is not None or temperature is not None:
        print(f"note: {species.numbers['air.density'].source}: {air_in_words(vars(species.air))}", file=sys.stderr)
    for warning in species.warnings:
        if warning.startswith(DENSITY_ALONE):
            print(f"warning: {warning}", file=sys.stderr)
    return species.with_payload(payload)


def changed(
    species: Species, settings: list[str] | None, altitude: float | None = None, temperature: float | None = None
) -> Species:
    """Return a species with the numbers of ``--set`` and the air of an altitude; report all faults at once."""
    values, faults = {}, FaultList()
    above = {"--altitude": altitude, "--temperature": temperature}
    above = {name: value for name, value in above.items() if value is not None}
    if settings is not None and not settings:
        faults.add("--set", "", "must be PATH=VALUE", "for example wing.mass=0.02")
    for text in settings or []:
        try:
            path, value = parse_setting(text)
        except InvalidInputError as error:
            faults.faults.extend(error.faults)
            continue
        if path in values:
            faults.add("--set", text, "is set twice", "keep one of them")
        if above and path in ("air.density", "air.viscosity"):
            faults.add(
                "--set",
                text,
                f"is what {' and '.join(above)} {'sets' if len(above) == 1 else 'set'}",
                "keep one of them",
            )
        values[path] = value
    if above:
        try:
            species = species.at_altitude(altitude or 0.0, temperature)
        except InvalidInputError as error:
            faults.faults += [dataclasses.replace(fault, where=f"--{fault.where}") for fault in error.faults]
    faults.raise_if_any()
    return species.with_values(values) if values else species


# --- saved orbits ---


def saved_orbit(path: Path) -> Orbit:
    """Return a saved orbit whose problem is set up, so that what its file lacks is a fault of the file."""
    orbit = load_orbit(path)
    with unpacking(path):
        _ = orbit.problem
    return orbit


@contextmanager
def unpacking(path: Path) -> Iterator[None]:
    """Raise a `FileError` in place of any error that occurs while the orbit of the file at `path` is set up."""
    try:
        yield
    except NotInFileError as error:
        raise FileError(f"cannot set up the orbit in {str(path)!r} again: {error} in Python") from None
    except (LookupError, TypeError, ValueError, AttributeError) as error:
        rule = f"its inputs are damaged ({first_line(error)}); solve the orbit again"
        raise FileError(f"cannot read {str(path)!r} as an orbit: {rule}") from None


# --- moving air ---

Gust = Annotated[
    list[str] | None,
    several("Gust that rises and falls once: u=1 w=3 start=0.2 duration=0.5 (forward and up [m/s], times [s])."),
]
Turbulence = Annotated[
    str | None, option(f"Dryden turbulence 30 m above the ground: {', '.join(LEVELS)}. See --wind-seed.")
]
WindSeed = Annotated[Whole, option("Seed of the turbulence.")]


def wind_of(gust: list[str] | None, turbulence: str | None, seed: int, airspeed: float) -> Wind | None:
    """Return the wind that the options ask for, the sum if they ask for several; None for still air."""
    parts: list[Wind] = []
    if gust is not None:
        faults = FaultList()
        found = named_numbers(faults, "--gust", gust, [field.name for field in fields(CosineGust)], "w=3")
        faults.raise_if_any()
        parts.append(CosineGust(**found))
    if turbulence is not None:
        parts.append(DrydenTurbulence(airspeed, turbulence, seed=seed))

    def air(times: np.ndarray) -> tuple[Any, Any]:
        found = [part(times) for part in parts]
        return sum(u for u, _ in found), sum(w for _, w in found)

    return air if parts else None
