"""The flights of one animal with one model, at several speeds or along another number, for a page without a server.

With them go flights through gusts. Scenes are thinned: fewer samples of a beat, in whole numbers of 16 bits.
"""

from __future__ import annotations

import base64
from collections.abc import Sequence
from typing import Any

import numpy as np

from wingbeat._base import InvalidInputError, first_line
from wingbeat.animal.species.scaling import CRUISE_BY_MASS
from wingbeat.animal.species.species import Species
from wingbeat.orbits.options import Status
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.solve import Progress, check_search
from wingbeat.results.orbit import Orbit, solve_orbits
from wingbeat.stability.gust_flights import fly_pushes
from wingbeat.viewer import scene
from wingbeat.viewer.scene import EXACT, packed
from wingbeat_explorer.axis import SPEED, Axis, problems_along
from wingbeat_explorer.face_data import face_of, is_plausible, measured_points
from wingbeat_explorer.models import EXPLORER_MODELS, search_starts

SPEEDS = 9
# What speeds to show, as shares of the cruise of a bird of the same mass. Robots fly slower.
_SHARES = {"robot": (0.25, 0.85)}
_OTHERS = (0.35, 1.5)
_HOVERS = 0.02  # kg; lighter vehicles are also shown in hover
# The gusts of a page without a server.
DIRECTIONS = ("upward", "tail")
SIZES = (1.0,)  # m/s
BEATS = 12  # that are flown through them
SAMPLES = 64  # of a beat; the viewer draws straight lines between them
_WHOLE = 32767
# The viewer shows resultants first; without the two parts, a page has room for half as many flights again.
_LEFT_OUT = ("lift", "drag")


def default_speeds(species: Species, count: int = SPEEDS) -> list[float]:
    """Return speeds at which an animal or a robot of this mass may fly, in steps of at least 0.5 m/s.

    Parameters
    ----------
    species : the animal or robot.
    count : how many at most.

    >>> import wingbeat as wb
    >>> default_speeds(wb.load_species("pigeon"), 6)
    [5.0, 8.0, 11.0, 14.0, 17.5, 20.5]
    """
    mass = species.vehicle.mass
    slow, fast = _SHARES.get(species.kind, _OTHERS)
    cruise = float(CRUISE_BY_MASS.number(mass).value)  # pyright: ignore[reportArgumentType]
    low = 0.0 if mass < _HOVERS else slow * cruise
    return np.unique(np.round(2.0 * np.linspace(low, fast * cruise, count)) / 2.0).tolist()


def solve_lattice(
    species: Species,
    model: str,
    values: Sequence[float],
    starts: int | None = None,
    seed: int = 0,
    progress: Progress | None = None,
    push: bool = False,
    along: str = SPEED.name,
    speed: float | None = None,
) -> dict[str, Any]:
    """Find the wingbeats of an animal at several speeds, and return what the static explorer shows of them.

    In place of the speed, another number may change, such as the stiffness of a robot's pitch hinges. The result is
    fit for JSON. It has species, title, model, the axis (name, unit and label of what changes), the value on it to
    begin with (first), the curve (points and what was measured on animals), the sources of the plausible ranges and
    the answers, one for each value, from `face_of`. Answers and points hold the value under the axis' name. Flights
    are solved as a series, so that neighbours help each other. With `push` it has pushes too: flights through gusts
    at the value to begin with.

    Parameters
    ----------
    species : the animal or robot.
    model : one of `wingbeat_explorer.LATTICE_MODELS`.
    values : increasing: speeds [m/s], or values of the number that changes.
    starts, seed : as in `solve_orbits`; without a number of starts, the model ``"plausible"`` takes three.
    progress : called with (flights done, flights in all).
    push : whether to fly through gusts as well, which takes some seconds.
    along : ``"speed"``, or the path of the number that changes, as `Species.with_values` takes it.
    speed : of all flights [m/s], where another number changes.

    Raises
    ------
    InvalidInputError : no value, values that do not increase; a value, a model, a path, a speed or a number of
        starts out of range; a number that the model searches for.

    >>> import wingbeat as wb
    >>> lattice = solve_lattice(wb.load_species("pigeon"), "paper", [11.0, 12.0], starts=1)
    >>> lattice["first"], [point["certified"] for point in lattice["curve"]["points"]]
    (11.0, [True, True])
    """
    axis, problems, count = check_lattice(species, model, values, starts, seed, along, speed)
    orbits = solve_orbits(problems, count, seed, in_order=True, progress=progress)
    return lattice_of(species, model, orbits, push, axis)


def check_lattice(
    species: Species,
    model: str,
    values: Sequence[float],
    starts: int | None = None,
    seed: int = 0,
    along: str = SPEED.name,
    speed: float | None = None,
) -> tuple[Axis, list[OrbitProblem], int | None]:
    """Return axis and problems of `solve_lattice` and the number of starts, with its faults, without solving."""
    check_search(1 if starts is None else starts, seed)
    axis, problems = problems_along(species, model, values, along, speed)
    return axis, problems, search_starts(starts, EXPLORER_MODELS[model].within_plausible)


def lattice_of(
    species: Species, model: str, orbits: Sequence[Orbit], push: bool = False, axis: Axis = SPEED
) -> dict[str, Any]:
    """Return what `solve_lattice` returns, of orbits that are solved already, in the order of the axis' values."""
    answers: list[dict[str, Any]] = [
        face_of(orbit, model) | {axis.name: axis.value_of(orbit.problem)} for orbit in orbits
    ]
    points = [
        point_of(answer, axis.name) | {"stable": orbit.record().get("stable")}
        for answer, orbit in zip(answers, orbits, strict=True)
    ]
    first = _first(points)
    # The source of a range is long, and most often the same in all flights.
    sources = {gauge["name"]: gauge["source"] for gauge in answers[0]["gauges"]}
    measured = measured_points(species) if axis == SPEED else []
    lattice = {
        "species": species.name,
        "title": species.common_name or species.name,
        "model": model,
        "axis": axis._asdict(),
        "first": points[first][axis.name],
        "curve": {"points": points, "measured": measured},
        "sources": sources,
        "answers": [_small(answer, sources) for answer in answers],
    }
    return lattice | ({"pushes": pushes_of(orbits[first])} if push else {})


def _small(answer: dict[str, Any], sources: dict[str, str]) -> dict[str, Any]:
    """Return an answer with a thinned scene, and without the sources that all flights share."""
    gauges = [
        {name: part for name, part in gauge.items() if name != "source" or part != sources[gauge["name"]]}
        for gauge in answer["gauges"]
    ]
    scene = answer["scene"]
    return answer | {"gauges": gauges, "scene": None if scene is None else thinned(scene)}


def point_of(answer: dict[str, Any], along: str = SPEED.name) -> dict[str, Any]:
    """Return a point of the curve: speed [m/s], power [W], frequency [Hz], whether certified and plausible.

    Parameters
    ----------
    answer : from `face_of`.
    along : the name of what changes along the curve; its value stands in the speed's place.
    """
    numbers = {name: answer[name] for name in (along, "power", "frequency")}
    return numbers | {"certified": answer["lights"][0]["good"], "plausible": is_plausible(answer["lights"])}


def _first(points: Sequence[dict[str, Any]]) -> int:
    """Return the place of the point to begin with: of least power among plausible, or else certified ones."""
    for kind in ("plausible", "certified"):
        fit = [nth for nth, point in enumerate(points) if point[kind]]
        if fit:
            return min(fit, key=lambda nth: points[nth]["power"])
    return 0


def flown_through_gusts(orbit: Orbit, **asked: Any) -> tuple[list[dict[str, Any]], str]:
    """Return flights through gusts as the viewer's scene holds them, and why those with feedback are left out.

    The reason is empty if they are not left out. `asked` are further parameters of `fly_pushes`, which refuses an
    orbit that is not certified.
    """
    why_not = ""
    try:
        flown = fly_pushes(orbit, **asked)
    except InvalidInputError as error:
        flown = fly_pushes(orbit, delay=None, **asked)  # refuses what does not concern the feedback
        why_not = first_line(error)
    return scene([("", orbit.dataset)], flown)["pushes"], why_not


def pushes_of(orbit: Orbit) -> list[dict[str, Any]]:
    """Return flights through gusts of 1 m/s from below and from behind, small enough for a page with many animals.

    They last twelve beats, or until the animal is lost, without and with feedback. If no feedback holds the orbit,
    there are only those without. An orbit that is not certified has none.
    """
    if orbit.status is not Status.CONVERGED:
        return []
    pushes, _ = flown_through_gusts(orbit, beats=BEATS, directions=DIRECTIONS, sizes=SIZES)
    return [
        push | {"scene": push["scene"] | {"flights": [_smaller(push["scene"]["flights"][0])]}} for push in pushes
    ]


def thinned(scene: dict[str, Any]) -> dict[str, Any]:
    """Return a scene with about 64 samples of each flight, its arrays in 16 bits, and without lift and drag.

    An array keeps its values to a thirty-thousandth of its largest one; phase, time and the body's path are in
    single precision. Of a strip's four corners three are kept: it is a parallelogram.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> small = thinned(wb.viewer.scene([("pigeon", orbit.dataset)]))
    >>> len(unpacked(small["flights"][0]["arrays"]["phase"]))
    65
    """
    flights = []
    for flight in scene["flights"]:
        count = len(unpacked(flight["arrays"]["phase"]))
        kept = np.unique(np.round(np.linspace(0, count - 1, min(count, SAMPLES + 1))).astype(int))
        flights.append(_smaller(flight, kept))
    return scene | {"flights": flights}


def _smaller(flight: dict[str, Any], kept: Any = slice(None)) -> dict[str, Any]:
    """Return a flight with these of its samples, in 16 bits."""
    count = len(unpacked(flight["arrays"]["phase"]))
    arrays = {}
    for name, array in flight["arrays"].items():
        if name not in _LEFT_OUT:
            values = unpacked(array).reshape(count, -1)[kept]
            if name == "corners":
                values = values.reshape(len(values), -1, 4, 3)[:, :, :3].reshape(len(values), -1)
            arrays[name] = packed(values, "f4") if name in EXACT else in_16_bits(values)
    return flight | {"arrays": arrays}


def unpacked(array: dict[str, Any]) -> np.ndarray:
    """Return the flat values of an array of a scene, which may be one in 16 bits."""
    data = base64.b64decode(array["data"])
    if array["kind"] != "d2":
        return np.frombuffer(data, f"<{array['kind']}")
    steps = np.frombuffer(data, np.uint8).reshape(2, -1).T.copy().view("<i2").reshape(-1, array["samples"])
    return np.cumsum(steps, axis=1, dtype=np.int16).T.ravel() * array["scale"]


def in_16_bits(values: np.ndarray) -> dict[str, Any]:
    """Return an array of a scene in 16 bits that compress well: steps from sample to sample, low bytes first.

    The values are finite, of shape (samples, numbers in each).

    >>> unpacked(in_16_bits(np.array([[0.0], [2.0], [1.0]]))).round(4).tolist()
    [0.0, 2.0, 1.0]
    """
    scale = float(np.abs(values).max()) / _WHOLE or 1.0
    whole = np.round(values / scale).astype(np.int16).T
    steps = np.diff(whole, axis=1, prepend=np.int16(0)).astype("<i2")  # modulo 2^16, as the sums that undo it
    data = base64.b64encode(steps.ravel().view(np.uint8).reshape(-1, 2).T.tobytes())
    return {"kind": "d2", "data": data.decode(), "scale": scale, "samples": len(values)}
