"""Models of a flight: the choices of Su et al. 2023, or those that suit a live animal or a robot.

A model chooses coefficients, terms of the air loads, parts of the vehicle, free parameters and the objective.
`paper` makes the choices of Su et al. 2023 (doi 10.48550/arXiv.2302.09602), `animal` those for a bird, a bat or a
robot. The choices depend on the kind of flyer. None is fitted to a measured flight.

>>> import wingbeat as wb
>>> pigeon = wb.load_species("pigeon")
>>> wb.models.animal(pigeon).problem(pigeon, speed=10.0).minimise.name
'metabolic_power'
"""

from __future__ import annotations

import dataclasses
import functools
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any, Literal

from wingbeat._base import FaultList, in_words
from wingbeat.aero import BladeElement, Feathered
from wingbeat.animal.kinematics import ANGLES
from wingbeat.animal.species.numbers import FREQUENCY
from wingbeat.animal.species.posture import free_of, with_free_stroke
from wingbeat.animal.species.scaling import BODY_DRAG_AREA, CROSSFLOW_AREA
from wingbeat.animal.species.species import Species
from wingbeat.orbits.problem.origin import Choice, Origin
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.problem.quantities import Constraint, named_objective, read_limits

MODELS = ("paper", "animal")
Frequency = float | Literal["own", "free"]

# Coefficients for each kind of wing, and what they are.
_WINGS = {
    "bird": (
        "feathered-flapping",
        "a feathered wing: attached flow as in a glide, stall as late as on revolving wings",
    ),
    "bat": ("membrane", "a membrane wing: a thin plate with the camber of a bat's wing; mostly guesses"),
    "robot": ("su-fan", "a rigid wing: the flat plate measured by Su et al. 2023"),
}


@dataclass(frozen=True)
class Model:
    """All choices for a flight except species and speed; `paper` and `animal` return models.

    Attributes
    ----------
    name : ``"paper"`` or ``"animal"``.
    kind : kind of flyer that the model is for; empty if it is for any.
    aero : the air loads.
    frequency : a frequency to fly at [Hz]; ``"own"`` for that of the animal (`Species.own_frequency`), ``"free"``
        to search for it.

    >>> import wingbeat as wb
    >>> pigeon = wb.load_species("pigeon")
    >>> wb.models.animal(pigeon).problem(pigeon, speed=12.0).minimise.name
    'metabolic_power'
    """

    name: str
    kind: str
    aero: BladeElement
    frequency: Frequency = "free"

    def problem(self, species: Species, speed: float, climb: float = 0.0, **changes: Any) -> OrbitProblem:
        """Return the problem of a flight with this model.

        Parameters
        ----------
        species : the animal or robot, of the model's kind.
        speed, climb : mean horizontal and vertical velocity [m/s].
        changes : other parameters of `OrbitProblem`, such as ``minimise`` or ``subject_to``. They replace the
            model's own choices; another coefficient model as ``aero`` keeps the model's terms.

        Raises
        ------
        InvalidInputError : a species of another kind; a frequency of this model that `changes` search for or fix
            elsewhere; inputs that `OrbitProblem` refuses.
        """
        flown = self.species(species)
        # A wing whose pitch gives way turns by the moment of its loads, so where they act matters.
        giving = flown.wingbeat.pitch_hinge is not None
        aero = dataclasses.replace(self.aero, force_point="centre-of-pressure") if giving else self.aero
        asked: dict[str, Any] = {"aero": aero, "minimise": self.objective(flown)} | changes
        if not isinstance(asked["aero"], BladeElement):
            asked["aero"] = dataclasses.replace(aero, coefficients=asked["aero"])
        own: dict[str, Any] = self.own_choices(asked["minimise"], changes.get("free"), changes.get("bounds"))
        origin = Origin(self.name, tuple(self._choices(flown, own)), tuple(self._changed(flown, changes)))
        if self.frequency not in ("own", "free"):
            _check_given(self.frequency, changes)
            flown = flown.with_values({FREQUENCY: self.frequency})
            asked = {"free": tuple(name for name in flown.free if name != "frequency")} | asked
        return OrbitProblem(flown, speed, climb, origin=origin, **(own | asked))

    def own_choices(self, minimise: Any, free: Any, bounds: Any) -> dict[str, bool]:
        """Return ``own_frequency`` and ``own_posture`` of the `OrbitProblem` that this model makes.

        Who names the free parameters, or minimises the frequency, searches for it. Who bounds the body's pitch
        keeps these bounds at every speed.

        Parameters
        ----------
        minimise, free, bounds : as in `OrbitProblem`; None for none.

        Raises
        ------
        InvalidInputError : an objective without a quantity of this name.

        >>> import wingbeat as wb
        >>> animal(wb.load_species("pigeon")).own_choices("frequency", None, None)
        {'own_frequency': False, 'own_posture': True}
        """
        least = named_objective(minimise) if isinstance(minimise, str) else minimise
        searched = bool(free) or getattr(least, "parameter", None) == "frequency"
        bounded = bounds is not None and bounds != "plausible" and "body_pitch" in bounds
        poised = self.name == "animal" and self.kind != "robot"
        return {"own_frequency": self.frequency == "own" and not searched, "own_posture": poised and not bounded}

    @property
    def gliding(self) -> BladeElement:
        """The air loads of a glide: a feathered wing that does not flap stalls as early as gliding wings do."""
        if self.aero.coefficients.name != "feathered-flapping":
            return self.aero
        width = self.aero.coefficients.blend_width_deg
        return dataclasses.replace(self.aero, coefficients=Feathered(blend_width_deg=width))

    def objective(self, species: Species) -> str:
        """Return the name of the quantity that the model minimises.

        Parameters
        ----------
        species : the species with the model's additions, from `Model.species`.
        """
        if self.name == "paper":
            return "frequency"
        drive = species.vehicle.drive
        if drive.muscle is not None:
            return "metabolic_power"
        return "electrical_power" if drive.motor is not None else "mean_positive_power"

    def species(self, species: Species) -> Species:
        """Return the species with what the model adds to it: drag of the body, tail, muscle, free parameters.

        Values that the species file gives are kept, but a body drag of 0 counts as not given unless it was set by
        hand. The scaling laws use the whole mass, so add a payload afterwards:
        ``model.species(pigeon).with_payload(0.03)``.

        Parameters
        ----------
        species : the animal or robot.

        Raises
        ------
        InvalidInputError : a species of another kind.
        """
        if self.name == "paper":
            return species
        _check_kind(species, self.kind)
        flown, vehicle = species, species.vehicle
        if not vehicle.body.drag_area and not species.is_set_by_hand("vehicle.body.drag_area"):
            if "body-drag" in species.alternatives:
                flown = species.with_alternative("body-drag")
            else:  # the law for birds
                flown = species.with_derived({"vehicle.body.drag_area": BODY_DRAG_AREA.number(vehicle.mass)})
        crossflow = "vehicle.body.crossflow_area"
        if self.kind != "robot" and not vehicle.body.crossflow_area and not species.is_set_by_hand(crossflow):
            flown = flown.with_derived({crossflow: CROSSFLOW_AREA.number(vehicle.mass)})
        if self.kind == "bird" and vehicle.tail is None:
            flown = flown.with_tail()
        if self.kind != "robot" and vehicle.muscle is None:
            flown = flown.with_muscle()
        return with_free_stroke(flown)

    def _changed(self, flown: Species, changes: Mapping[str, Any]) -> Iterator[str]:
        """Yield the names of the choices in which the user departs from the model."""
        own = _air_loads(self.name, self.kind)
        for place in dataclasses.fields(BladeElement):
            if getattr(self.aero, place.name) != getattr(own, place.name):
                yield "aero" if place.name == "coefficients" else place.name
        usual = {"minimise": named_objective(self.objective(flown)), "free": flown.free}
        for name, value in changes.items():
            given = named_objective(value) if name == "minimise" and isinstance(value, str) else value
            if given and given != usual.get(name):
                yield name
        if self.frequency != _usual_frequency(self.name, self.kind) and not changes.get("free"):
            yield "frequency"

    def _choices(self, flown: Species, own: Mapping[str, bool]) -> list[Choice]:
        aero, objective = _air_loads(self.name, self.kind), in_words(self.objective(flown))
        if self.name == "paper":
            paper = "as in Su et al. 2023"
            return [
                Choice("coefficients", aero.coefficients.name, f"{paper}: measured on a flat plate"),
                Choice("terms of the air loads", "none", f"{paper}: quasi-steady, no induced flow"),
                Choice("vehicle and free parameters", "as in the species file", paper),
                Choice("objective", objective, paper),
            ]
        body, tail, muscle, numbers = flown.vehicle.body, flown.vehicle.tail, flown.vehicle.muscle, flown.numbers
        found = [
            Choice("coefficients", aero.coefficients.name, _WINGS[self.kind][1]),
            Choice("unsteady terms", aero.unsteady, "rotation and added mass: wings turn within a beat"),
            Choice(
                "inflow",
                f"{aero.inflow}, {aero.induced_factor:g} times the induced power of an ideal disc",
                "the factor 1.2 fits a cockatiel's power (Morris and Askew 2010, J Exp Biol 213:2781, abstract)",
            ),
            Choice("body drag area", f"{1e4 * body.drag_area:.2g} cm2", numbers["vehicle.body.drag_area"].source),
        ]
        if body.crossflow_area:
            source = numbers["vehicle.body.crossflow_area"].source
            found.append(Choice("cross-flow area of the body", f"{1e4 * body.crossflow_area:.2g} cm2", source))
        if tail is not None:
            found.append(Choice("tail area", f"{1e4 * tail.area:.2g} cm2", numbers["vehicle.tail.area"].source))
        if muscle is not None:
            mass, source = f"{1e3 * muscle.mass:.2g} g", numbers["vehicle.muscle.mass"].source
            found.append(Choice("mass of the depressors", mass, source))
        for name, bound in free_of(self.kind).items():
            if name in flown.free and flown.reasons.get(name) == bound.reason:
                low, high = flown.bounds[name]
                limits = f"{low:g} to {high:g}" + (" of a beat" if name == "downstroke_fraction" else "")
                if name in ANGLES:
                    limits = f"{math.degrees(low):.0f} to {math.degrees(high):.0f} degrees"
                found.append(Choice(f"free: {name}", limits, bound.reason))
        if own["own_posture"] and "body_pitch" in flown.guessed_bounds:
            why = "guess: nearly level in fast flight and steeper in slow flight, as of pigeons and swallows"
            found.append(Choice("pitch of the body", "within bounds that fall with speed", why))
        if own["own_frequency"] and not flown.is_set_by_hand(FREQUENCY):
            why = "measured, by a law, or a guess, see frequency_basis: no physics that was tried predicts it"
            found.append(Choice("frequency", f"the {'robot' if self.kind == 'robot' else 'animal'}'s own", why))
        return [*found, Choice("objective", objective, "what the beat costs")]


def paper() -> Model:
    """Return the model of Su et al. 2023: a flat-plate wing, quasi-steady air loads, least frequency.

    >>> paper().aero.coefficients.name
    'su-fan'
    """
    return _made("paper", "", None)


def animal(species: Species, frequency: Frequency | None = None) -> Model:
    """Return the model that suits a live animal, or a robot, of the species' kind.

    The kind determines the coefficients of the wing. Air loads include rotation, added mass and induced flow. Body
    drag, tail and muscle come from the species file or, if it gives none, from published laws. The tail's tilt and
    the downstroke fraction are free; of birds and bats twist, span retraction, mean sweep and tilt of the stroke
    plane are too, and the body's pitch keeps to bounds that fall with speed. The objective is the metabolic power;
    for a robot, the electrical power of its motor, or the mean positive power if no motor is known.

    Parameters
    ----------
    species : the animal or robot; only its kind matters.
    frequency : a frequency to fly at [Hz]; ``"own"`` for that of the animal, which is the default of birds and
        bats; ``"free"`` to search for it, the default of robots.

    Raises
    ------
    InvalidInputError : a species whose kind is not known; a frequency that is not positive.

    >>> import wingbeat as wb
    >>> animal(wb.load_species("pigeon"), frequency="free").frequency
    'free'
    >>> animal(wb.load_species("bat")).aero.coefficients.name
    'membrane'
    """
    _check_kind(species, species.kind)
    return _made("animal", species.kind, frequency)


def model_of(name: str, species: Species, frequency: Frequency | None = None) -> Model:
    """Return the model with a given name for a species.

    Parameters
    ----------
    name : one of `MODELS`.
    species : the animal or robot.
    frequency : as in `animal`; ``paper`` searches for it by default.

    Raises
    ------
    InvalidInputError : an unknown name; inputs that `animal` refuses.

    >>> import wingbeat as wb
    >>> model_of("animal", wb.load_species("bat")).kind
    'bat'
    """
    faults = FaultList()
    faults.choice("model", name, MODELS)
    faults.raise_if_any()
    if name == "animal":
        return animal(species, frequency)
    return _made("paper", "", frequency)


def _made(name: str, kind: str, frequency: Frequency | None) -> Model:
    """Return a model; without a frequency, birds and bats of the model `animal` fly at their own."""
    usual = _usual_frequency(name, kind)
    if frequency is not None and frequency not in ("own", "free"):
        faults = FaultList()
        faults.number("frequency", frequency, above=0, unit="Hz", fix="or 'own', or 'free' to search for it")
        faults.raise_if_any()
    return Model(name, kind, _air_loads(name, kind), usual if frequency is None else frequency)


def _usual_frequency(name: str, kind: str) -> Frequency:
    # No law of robots was found: their motors differ too much.
    return "own" if name == "animal" and kind != "robot" else "free"


@functools.cache  # the tables of its coefficients take 0.1 s
def _air_loads(name: str, kind: str) -> BladeElement:
    if name == "paper":
        return BladeElement("su-fan")
    return BladeElement(_WINGS[kind][0], unsteady="thin-aerofoil", inflow="momentum")


def _check_given(frequency: Frequency, changes: Mapping[str, Any]) -> None:
    """Refuse what a frequency of the model contradicts."""
    faults, limits = FaultList(), changes.get("subject_to") or ()
    limits, _ = read_limits([limits] if isinstance(limits, str | Constraint) else list(limits), faults)
    if "frequency" in (changes.get("free") or ()):
        faults.add("frequency", frequency, "is given, but `free` searches for it", "keep one of the two")
    for value in (one.value for one in limits if one.name == "frequency" and one.sign == "="):
        if value != frequency:
            faults.add(
                "frequency", frequency, f"is given, but subject_to fixes {value:g} Hz", "keep one of the two"
            )
    faults.raise_if_any()


def _check_kind(species: Species, kind: str) -> None:
    faults = FaultList()
    if species.kind not in _WINGS:
        fix = f'write kind = "bird", "bat" or "robot" into the file of {species.name}'
        faults.add("kind", species.kind, 'the model "animal" is only for a bird, a bat or a robot', fix)
    elif species.kind != kind:
        fix = "call wb.models.animal with this species"
        faults.add("species", species.name, f"is a {species.kind}, not a {kind}", fix)
    faults.raise_if_any()
