"""What a worker does for the explorer: orbits, sensitivities, files. Its inputs and outputs are fit for JSON.

Uploaded files are checked here, in a process of their own, before anything in them is used.
"""

from __future__ import annotations

import base64
import dataclasses
import io
import itertools
import json
import time
from collections.abc import Callable
from typing import Any

from wingbeat._base import FileError, InvalidInputError, first_line, read_text
from wingbeat._workers.process import Context
from wingbeat.aero.blade_element import OF_ELEMENTS
from wingbeat.aero.completion import VITERNA
from wingbeat.aero.polar_formats import POLAR_SUFFIXES
from wingbeat.animal.species.numbers import FREQUENCY
from wingbeat.animal.species.writing import species_text
from wingbeat.models import MODELS, model_of
from wingbeat.orbits.options import Status
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.solution import Solution, search_near
from wingbeat.records.inputs import inputs_of, problem_from
from wingbeat.records.result_files import load_dataset, netcdf_bytes
from wingbeat.results.orbit import Orbit, orbit_from, solve_orbit
from wingbeat.results.sensitivities import sensitivities
from wingbeat.words.orbit_words import orbit_groups
from wingbeat_explorer.app.formatting import clean_label, refusals
from wingbeat_explorer.app.links import from_json, from_plain, to_plain
from wingbeat_explorer.app.scenario import (
    LARGEST_TABLE,
    MOST_STARTS,
    Scenario,
    problem_of,
    species_from_text,
    species_in,
    table_of,
)
from wingbeat_explorer.face_data import face_of, is_plausible, lights_of, measured_points
from wingbeat_explorer.lattice import flown_through_gusts

_MOST_RANKED = 12
MOST_BYTES = 5_000_000
# Most bytes of all arrays of a file once they are unpacked; an orbit takes less than one million bytes.
MOST_DECLARED = 50_000_000
# What the parts of a problem are called on the page, where their keys would not be understood.
_SPOKEN = {"aero": "model of the air loads", "free": "choice of free parameters"}
_HDF5 = b"\x89HDF\r\n\x1a\n"


def do(what: dict[str, Any], context: Context) -> dict[str, Any]:
    """Do a job; if input is refused, return ``{"refused": [[where, message], ...]}``."""
    kinds: dict[str, Callable[[dict[str, Any], Context], dict[str, Any]]] = {
        "orbit": _orbit,
        "point": _point,
        "pushes": _pushes,
        "influence": _influence,
        "file": _file,
        "read": _read,
    }
    try:
        return kinds[what["do"]](what, context)
    except InvalidInputError as error:
        return {"refused": refusals(error.faults)}
    except FileError as error:
        return {"refused": [["", str(error)]]}


def _orbit(what: dict[str, Any], context: Context) -> dict[str, Any]:
    """Solve by continuation from the previous answer if it is near; else as the command line does."""
    begun = time.perf_counter()
    scenario = from_plain(what["scenario"])
    problem = problem_of(scenario)
    notes = {"notes": list(getattr(problem.aero.coefficients, "notes", ()))}  # an orbit's own problem has none
    near_since = time.perf_counter()
    continued = _continued(problem, what.get("near"))
    in_vain = time.perf_counter() - near_since
    if continued is not None:
        return answer_of(Orbit.of(continued, 1), scenario.face_model, begun) | notes | {"continued": True}
    orbit = solve_orbit(problem, scenario.search_starts, scenario.seed, context.progress)
    context.check()
    answer = answer_of(orbit, scenario.face_model, begun)
    # The page waited for both searches.
    return answer | notes | {"solver_seconds": in_vain + answer["solver_seconds"]}


def _continued(problem: OrbitProblem, near: dict[str, Any] | None) -> Solution | None:
    """Return the orbit that one local search from another orbit's unknowns finds, if it is certified."""
    if near is None or tuple(near["free"]) != problem.free:
        return None
    import numpy as np

    return search_near(problem, np.array(near["unknowns"], dtype=float))


def _point(what: dict[str, Any], context: Context) -> dict[str, Any]:
    """Return one point of a curve: the better of the orbits from its own starts and from the neighbouring speed.

    Without ``whole``, it is the one from the neighbouring speed, if that is certified.
    """
    scenario = from_plain(what["scenario"])
    problem = problem_of(scenario)
    continued = _continued(problem, what.get("near"))
    other = None if continued is None else Orbit.of(continued, 1)
    if other is not None and not what["whole"]:
        return _point_of(other, scenario.speed)
    orbit = solve_orbit(problem, scenario.search_starts, scenario.seed, context.progress)
    context.check()
    if other is not None and (
        orbit.status is not Status.CONVERGED
        or other.record()["objective_value"] < orbit.record()["objective_value"]
    ):
        orbit = other
    return _point_of(orbit, scenario.speed)


def _point_of(orbit: Orbit, speed: float) -> dict[str, Any]:
    record = orbit.record()
    near = _near(orbit) if orbit.status is Status.CONVERGED else None
    return {
        "speed": speed,
        "status": record["status"],
        "frequency": record["wingbeat"]["frequency"],
        "mean_positive_power": record["mean_positive_power"],
        "plausible": is_plausible(lights_of(record)),
        "near": near,
    }


def _near(orbit: Orbit) -> dict[str, Any]:
    return {"free": list(orbit.problem.free), "unknowns": orbit.unknowns.tolist()}


def answer_of(orbit: Orbit, model: str, begun: float) -> dict[str, Any]:
    """Return everything that the page shows of an orbit; the face, which only the browser reads, is a text."""
    record = orbit.record()
    return {
        "record": record,
        "inputs": orbit.inputs,
        "groups": orbit_groups(record),
        "near": _near(orbit) if orbit.status is Status.CONVERGED else None,
        "plausible": is_plausible(lights_of(record)),
        "measured": measured_points(orbit.problem.species),
        "face": json.dumps(face_of(orbit, model), allow_nan=False),
        "seconds": time.perf_counter() - begun,
        "solver_seconds": record["solve_seconds"],
    }


def orbit_again(known: dict[str, Any]) -> Orbit:
    """Return the orbit of a record, with the inputs of its problem."""
    inputs = known["inputs"]
    return Orbit.of_record(known["record"], problem_from(inputs), inputs["starts"], inputs["seed"])


def _pushes(what: dict[str, Any], context: Context) -> dict[str, Any]:
    """Return flights of an orbit through gusts for the viewer; without feedback if none holds the orbit."""
    pushes, why_not = flown_through_gusts(orbit_again(what["of"]), progress=context.progress)
    return {"pushes": json.dumps(pushes, allow_nan=False), "why_not": why_not}


def _influence(what: dict[str, Any], context: Context) -> dict[str, Any]:
    """Return what each quantity depends on most, and the prices of the active bounds."""
    orbit = orbit_again(what["of"])
    found = sensitivities(orbit)
    rankings = [found.error_bar(name).ranked() for name in found.values]
    first = next(iter(found.values))
    ranked = [
        {
            "path": slope.parameter.path,
            "plausible": slope.parameter.plausible,
            "unit": slope.parameter.unit,
            "swings": {name: list(found.swing(slope, name)) for name in found.values},
        }
        for slope in found.ranked(first)[:_MOST_RANKED]
    ]
    prices = [
        {"path": p.parameter.path, "unit": p.parameter.unit, "size": p.parameter.size, "by": p.quantities}
        for p in found.prices
    ]
    return {"values": found.values, "units": found.units, "rankings": rankings, "ranked": ranked, "prices": prices}


def _file(what: dict[str, Any], context: Context) -> dict[str, Any]:
    """Return an orbit as the bytes of a file, in base 64."""
    dataset = orbit_again(what["of"]).dataset
    if what["as"] == "nc":
        content = netcdf_bytes(dataset)
    else:
        from wingbeat.plots import wingbeat_page

        with io.BytesIO() as file:
            wingbeat_page(dataset).savefig(file, format=what["as"], dpi=200)
            content = file.getvalue()
    return {"content": base64.b64encode(content).decode()}


def _read(what: dict[str, Any], context: Context) -> dict[str, Any]:
    """Return the content of an uploaded file: a scenario, a species, coefficients, or an answer.

    An answer comes with its scenario, if the page's controls can represent it.
    """
    reach = what.get("extension", "mirrored"), what.get("blend_width_deg", 1.0)
    orbit, label = read_upload(what["path"], what["label"], reach), what["label"]
    if not isinstance(orbit, Orbit):
        return orbit
    begun = time.perf_counter()
    origin = orbit.problem.origin.name if orbit.problem.origin else MODELS[0]
    try:
        scenario, why_not = scenario_of(orbit)
        answer = answer_of(orbit, origin if scenario is None else from_plain(scenario).face_model, begun)
    except Exception as error:  # whatever can be wrong with what somebody wrote into a file
        reason = first_line(error)[:200]
        raise FileError(f"cannot show the orbit in {label!r}: it is damaged ({reason}); solve it again") from None
    return {"answer": answer, "scenario": scenario, "why_not": why_not}


# Uploaded files --------------------------------------------------------------------------------------------------


def read_upload(path: str, label: str, reach: tuple[str, float] = ("mirrored", 1.0)) -> Orbit | dict[str, Any]:
    """Return the orbit in a file, ``{"scenario": ...}`` of a saved state, or ``{"species": ..., "text": ...}``.

    Of a table of coefficients, return ``{"aero": ..., "aero_file": ..., "extension": ...}``. `reach` is the
    extension that the page asks for and half the width [deg] of its blends.

    The server stored the file under a path that it chose; `label` is the visitor's name for it.
    """
    with open(path, "rb") as file:
        start = file.read(8)
    try:
        if start == _HDF5:
            return _checked(path, label)
        if label.lower().endswith(POLAR_SUFFIXES):
            return _table_in(path, label, *reach)
        text = read_text(path)
        if text.lstrip()[:1] == "{":
            return {"scenario": to_plain(from_json(text, label))}
        species = species_from_text(text, label)
    except FileError as error:
        raise FileError(str(error).replace(path, label)) from None
    return {"species": clean_label(species.name), "text": text}


def _table_in(path: str, label: str, extension: str, blend_width_deg: float) -> dict[str, Any]:
    """Return the coefficients in a file; Viterna's rule completes a table that is refused otherwise.

    What is refused in both ways is refused in the words of the command line.
    """
    with open(path, "rb") as file:
        content = file.read()
    refused: InvalidInputError | None = None
    for asked in ("mirrored" if extension == VITERNA else extension, VITERNA):
        try:
            table_of(content, label, asked, blend_width_deg)
        except InvalidInputError as error:
            refused = refused or error
        else:
            return {"aero": label, "aero_file": read_text(path, limit=LARGEST_TABLE), "extension": asked}
    assert refused is not None
    return {"refused": [["", str(fault)] for fault in refused.faults]}


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
    """Return a scenario for the problem and inputs of an orbit.

    Its species is the text of a file if `written_out`, or the built-in one of its name. It keeps to the plausible
    ranges if `within`, or has bounds and limits of its own.
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
    usual = model_of(model, known).frequency
    basis, left = problem.frequency_basis, ["vehicle.mass"]
    frequency = species.wingbeat.frequency if basis == "given" and "frequency" in known.free else None
    if frequency is not None or basis in ("measured", "law", "guess"):
        left.append(FREQUENCY)
    bounds = known.bounds | known.path_bounds
    if problem.own_posture:  # the model's own bounds at this speed
        bounds |= {"body_pitch": tuple(problem.bounds["body_pitch"])}
    own = {n: (float(p[0]), float(p[1])) for n, p in problem.bounds.items() if tuple(p) != bounds.get(n)}
    limits = tuple(f"{c.quantity.name}{'<=' if c.at_most else '>='}{c.limit!r}" for c in problem.subject_to)
    return Scenario(
        species=name,
        species_file=text,
        model=model,
        frequency=frequency,
        free_frequency=basis == "free" and usual == "own" and problem.minimise.parameter != "frequency",
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
            if path not in left and (path not in known.numbers or known.numbers[path].value != number.value)
        },
        starts=min(inputs["starts"], MOST_STARTS),
        seed=inputs["seed"],
    )
