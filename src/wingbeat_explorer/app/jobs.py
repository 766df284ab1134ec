"""What a worker does for the explorer: orbits, sensitivities, files. Its inputs and outputs are fit for JSON."""

from __future__ import annotations

import base64
import io
import json
import time
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from wingbeat._base import FileError, InvalidInputError, first_line
from wingbeat._workers.process import Context
from wingbeat.models import MODELS
from wingbeat.orbits.options import Status
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.solution import Solution, search_near
from wingbeat.records.inputs import problem_from
from wingbeat.records.netcdf import netcdf_bytes
from wingbeat.results.orbit import Orbit, solve_orbit
from wingbeat.results.sensitivities import sensitivities
from wingbeat.words.orbit_words import orbit_groups
from wingbeat_explorer.app.formatting import refusals
from wingbeat_explorer.app.links import from_plain
from wingbeat_explorer.app.scenario import problem_of
from wingbeat_explorer.app.uploads import read_upload, scenario_of
from wingbeat_explorer.face import face_of, is_plausible, lights_of
from wingbeat_explorer.measured import measured_points
from wingbeat_explorer.pushed import flown_through_gusts

if TYPE_CHECKING:
    import xarray as xr

_MOST_RANKED = 12


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
    near_since = time.perf_counter()
    continued = _continued(problem, what.get("near"))
    in_vain = time.perf_counter() - near_since
    if continued is not None:
        return answer_of(Orbit.of(continued, 1), scenario.face_model, begun) | {"continued": True}
    orbit = solve_orbit(problem, scenario.search_starts, scenario.seed, context.progress)
    context.check()
    answer = answer_of(orbit, scenario.face_model, begun)
    # The page waited for both searches.
    return answer | {"solver_seconds": in_vain + answer["solver_seconds"]}


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
    content = netcdf_bytes(dataset) if what["as"] == "nc" else _figure(dataset, what["as"])
    return {"content": base64.b64encode(content).decode()}


def _figure(dataset: xr.Dataset, kind: str) -> bytes:
    from wingbeat.plots import wingbeat_page

    with io.BytesIO() as file:
        wingbeat_page(dataset).savefig(file, format=kind, dpi=200)
        return file.getvalue()


def _read(what: dict[str, Any], context: Context) -> dict[str, Any]:
    """Return the content of an uploaded file: a scenario, or an orbit with its scenario."""
    found = read_upload(what["path"], what["label"])
    if isinstance(found, Orbit):
        return _answer_of_file(found, what["label"])
    return found


def _answer_of_file(orbit: Orbit, label: str) -> dict[str, Any]:
    """Return the answer in a file, and its scenario if the page's controls can represent it."""
    begun = time.perf_counter()
    origin = orbit.problem.origin.name if orbit.problem.origin else MODELS[0]
    try:
        scenario, why_not = scenario_of(orbit)
        answer = answer_of(orbit, origin if scenario is None else from_plain(scenario).face_model, begun)
    except Exception as error:  # whatever can be wrong with what somebody wrote into a file
        reason = first_line(error)[:200]
        raise FileError(f"cannot show the orbit in {label!r}: it is damaged ({reason}); solve it again") from None
    return {"answer": answer, "scenario": scenario, "why_not": why_not}
