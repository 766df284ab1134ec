"""Uploaded files: a worker process checks them before anything in them is used."""

from __future__ import annotations

import dataclasses
import itertools
from typing import Any

from wingbeat._base import FileError, read_text
from wingbeat.aero.blade_element import OF_ELEMENTS
from wingbeat.animal.species.writing import species_text
from wingbeat.models import MODELS
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.records.inputs import inputs_of
from wingbeat.records.result_files import load_dataset
from wingbeat.results.orbit import Orbit, orbit_from
from wingbeat_explorer.app.links import from_json, to_plain
from wingbeat_explorer.app.scenario import MOST_STARTS, Scenario, problem_of, species_from_text, species_in

MOST_BYTES = 5_000_000
# Most bytes of all arrays of a file once they are unpacked; an orbit takes less than one million bytes.
MOST_DECLARED = 50_000_000
# What the parts of a problem are called on the page, where their keys would not be understood.
_SPOKEN = {"aero": "model of the air loads", "free": "choice of free parameters"}
_HDF5 = b"\x89HDF\r\n\x1a\n"


def clean_label(name: str) -> str:
    r"""Return the name of a file for messages: the last part of its path, shortened and printable.

    >>> clean_label("../../etc/my\nbat.toml")
    'mybat.toml'
    """
    last = name.replace("\\", "/").rpartition("/")[2]
    return "".join(c for c in last if c.isprintable()).strip()[:60] or "the file"


def read_upload(path: str, label: str) -> Orbit | dict[str, Any]:
    """Return the orbit in a file, or ``{"scenario": ...}`` of a saved state, or ``{"species": ..., "text": ...}``.

    Parameters
    ----------
    path : where the server stored the file, under a name that the server chose.
    label : the visitor's name for the file.

    Raises
    ------
    FileError, InvalidInputError : every fault of the file.
    """
    with open(path, "rb") as file:
        start = file.read(8)
    try:
        if start == _HDF5:
            return _checked(path, label)
        text = read_text(path)
        if text.lstrip()[:1] == "{":
            return {"scenario": to_plain(from_json(text, label))}
        species = species_from_text(text, label)
    except FileError as error:
        raise FileError(str(error).replace(path, label)) from None
    return {"species": clean_label(species.name), "text": text}


def _checked(path: str, label: str) -> Orbit:
    """Return the orbit in a file; refuse it if a series holds a value that is not finite."""
    import numpy as np

    orbit = orbit_from(load_dataset(path, "orbit", most=MOST_DECLARED))
    for name, values in orbit.dataset.variables.items():
        if values.dtype.kind == "f" and not np.isfinite(values.values).all():
            raise FileError(
                f"cannot show {label!r}: {name} holds values that are not numbers; solve the orbit again"
            )
    return orbit


def scenario_of(orbit: Orbit) -> tuple[dict[str, Any] | None, str]:
    """Return the scenario that gives the problem of an orbit, or None and the reason why there is none."""
    inputs, why_not = orbit.inputs, ""
    for written_out, within in itertools.product((False, True), (True, False)):
        try:
            scenario = _asking_for(orbit.problem, inputs, written_out, within)
            again = inputs_of(problem_of(scenario), inputs["starts"], inputs["seed"])
        except (LookupError, TypeError, ValueError, AttributeError, FileError) as error:
            why_not = str(error).splitlines()[0][:160]
            continue
        parts = ("vehicle", "stock_wingbeat", "aero", "air", "free", "bounds", "objective", "constraints")
        odd = [part for part in parts if again[part] != inputs[part]]
        if not odd:
            return to_plain(scenario), ""
        why_not = f"the {_SPOKEN.get(odd[0], odd[0].replace('_', ' '))} would not be the same"
    return None, why_not


def _asking_for(problem: OrbitProblem, inputs: dict[str, Any], written_out: bool, within: bool) -> Scenario:
    """Return a scenario for the problem.

    Parameters
    ----------
    problem, inputs : of an orbit.
    written_out : whether its species is the text of a file, or the built-in one of its name.
    within : whether it keeps to the plausible ranges, or has bounds and limits of its own.
    """
    species, aero = problem.species, problem.aero
    name, text = species.name, ""
    if written_out:
        # A file keeps no reasons for its bounds, and its numbers to six digits; the rest is set below.
        text = species_text(
            dataclasses.replace(species, reasons=dict.fromkeys((*species.bounds, *species.path_bounds), ""))
        )
        name = clean_label(name)
    elements: dict[str, Any] = {name: getattr(aero, name) for name in OF_ELEMENTS}
    elements["hand"] = getattr(aero.hand, "name", "none")
    model = problem.origin.name if problem.origin else MODELS[0]
    known = species_in(Scenario(species=name, species_file=text, model=model))
    bounds = known.bounds | known.path_bounds
    own = {n: (float(p[0]), float(p[1])) for n, p in problem.bounds.items() if tuple(p) != bounds.get(n)}
    limits = tuple(f"{c.quantity.name}{'<=' if c.at_most else '>='}{c.limit!r}" for c in problem.subject_to)
    return Scenario(
        species=name,
        species_file=text,
        model=model,
        speed=problem.speed,
        climb=problem.climb,
        aero=aero.coefficients.name,
        extension=aero.coefficients.extension,
        blend_width_deg=aero.coefficients.blend_width_deg,
        **elements,
        minimise=problem.minimise.name,
        limits=() if within else limits,
        bounds={} if within else own,
        within_plausible=within,
        values={
            path: number.value
            for path, number in species.numbers.items()
            if path != "vehicle.mass" and (path not in known.numbers or known.numbers[path].value != number.value)
        },
        starts=min(inputs["starts"], MOST_STARTS),
        seed=inputs["seed"],
    )
