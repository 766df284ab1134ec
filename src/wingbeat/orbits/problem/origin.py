"""What a problem says of itself: the model that made it with its choices, and its parts in words."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

from wingbeat._base import NOMENCLATURE, for_people
from wingbeat.animal.species.species import Species


class Choice(NamedTuple):
    """One choice of a model: what is chosen, the choice in words or as a number with its unit, and why."""

    what: str
    value: str
    reason: str


class Origin(NamedTuple):
    """The model with which a problem was made; it has no effect on the solution."""

    name: str  # ``"paper"`` or ``"animal"``
    choices: tuple[Choice, ...]
    # Air loads and parameters of `OrbitProblem` that the user chose differently. Changed numbers of the species are
    # no part of it: their sources name the change.
    changed: tuple[str, ...] = ()

    def record(self) -> dict[str, Any]:
        """Return the origin as lists and texts, for JSON."""
        choices = [choice._asdict() for choice in self.choices]
        return {"name": self.name, "choices": choices, "changed": list(self.changed)}


def origin_from(record: dict[str, Any]) -> Origin:
    """Return the origin from `Origin.record`; any other dictionary raises `KeyError` or `TypeError`."""
    choices = tuple(Choice(**choice) for choice in record["choices"])
    return Origin(record["name"], choices, tuple(record["changed"]))


TERMS = ("unsteady", "wake", "inflow")


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
    terms = [f"{aero[name]} {name}" for name in TERMS if name in aero]
    if family := aero.get("reynolds_of_polars"):
        at = f", at Re {aero['at_reynolds']:.0f}" if "at_reynolds" in aero else ""
        named[0] += f" ({len(family)} polars, Re {family[0]:.0f} to {family[-1]:.0f}{at})"
    return ", ".join([*named, *(["full airspeed"] if aero.get("airspeed") == "full" else []), *terms])


def model_rows(origin: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Return the name of the model that made the problem, and the choices that the user changed."""
    changed = [name.replace("_", "-") for name in origin["changed"]]
    return [("model", origin["name"] + (f"; changed: {', '.join(changed)}" if changed else ""))]


def frequency_basis(free: Iterable[str], own_frequency: bool, species: Species, speed: float) -> str:
    """Return where the frequency of a problem comes from: ``free``, ``given``, or the basis of the animal's own."""
    if "frequency" in free:
        return "free"
    return species.own_frequency(speed).basis if own_frequency else "given"
