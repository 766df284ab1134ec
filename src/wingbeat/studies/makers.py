"""The parts of a study's problems, made from the keys of its form: species, air loads, objective, bounds."""

from __future__ import annotations

import dataclasses
import functools
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

from wingbeat._base import FaultList, plain_unit
from wingbeat.aero import BladeElement, load_coefficients
from wingbeat.aero.choosing import load_hand
from wingbeat.animal.species.making import load_species
from wingbeat.animal.species.record import Species
from wingbeat.models import Model, model_of
from wingbeat.studies.form import StudyForm
from wingbeat.studies.objective import as_inputs
from wingbeat.studies.recipe import OF_COEFFICIENTS, OF_ELEMENTS


def makers_of(form: StudyForm, folder: Path) -> dict[str, tuple[tuple[str, ...], Callable[..., Any]]]:
    """Return functions that make the parts of a base from top-level keys; equal values are evaluated only once."""

    @functools.cache
    def flown(species: str, model: str) -> tuple[Species, Model]:
        own = load_species(_beside(species, folder, (".toml",)))
        return own, model_of(model, own)

    def animal(species: str, model: str) -> Species:
        own, whole = flown(species, model)
        complete = whole.species(own)
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
            given["hand"] = load_hand(_beside(given["hand"], folder, (".csv", ".toml")), *reach)
        arm = load_coefficients(_beside(name, folder, (".csv", ".toml")), *reach)
        return dataclasses.replace(own, coefficients=arm, **given)

    def objective(species: str, model: str, name: str) -> dict[str, str]:
        if model != "paper" and "minimise" not in form.model_fields_set:
            name = flown(species, model)[1].objective(animal(species, model))
        return as_inputs(name, folder)

    of_model = "species", "model"
    makers = {
        "species": (of_model, animal),
        "aero": ((*of_model, "aero", *OF_COEFFICIENTS, *OF_ELEMENTS), loads),
        "minimise": ((*of_model, "minimise"), objective),
        "bounds": ((), lambda: given if isinstance(given := form.bounds, str) else _bounds(given)),
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
