"""The class `Curve`, certified orbits along speed with characteristic speeds; how one is found, built and read."""

from __future__ import annotations

import functools
import itertools
import json
import math
import re
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import (
    KIND,
    NOMENCLATURE,
    FaultList,
    Report,
    Reported,
    __version__,
    attributes_of,
    cf,
    harmonic_place,
    label_of,
)
from wingbeat._workers.tuning import core_count
from wingbeat.animal.kinematics import NAMED_IF_ON, PARAMETER_NAMES, in_use
from wingbeat.experiment.flights_file import FlightPoints
from wingbeat.mechanics.flight_model import State
from wingbeat.orbits.branches import SPEED, Branches, certified, families, marks_of, trace
from wingbeat.orbits.options import DEFAULTS, SolverOptions
from wingbeat.orbits.problem.problem import SPEED_LIMITS, OrbitProblem
from wingbeat.orbits.solve import Progress, check_search
from wingbeat.plots.draw_curve import curve_page
from wingbeat.records.characteristic import (
    BestLine,
    best_line,
    characteristic_speeds,
    is_mean_power,
    line_of,
    next_speeds,
    with_characteristic_speeds,
)
from wingbeat.records.forms import inputs_hash
from wingbeat.records.inputs import aero_record, inputs_of, vehicle_record
from wingbeat.records.measured import measured_beside
from wingbeat.records.result_files import Saveable, load_dataset
from wingbeat.records.tables import finite_or_none, frame_of
from wingbeat.results.orbit import Orbit
from wingbeat.words.curve_words import curve_report, span_in_words

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr
    from matplotlib.figure import Figure

MOST_SPEEDS = 1000
# Three orbits enclose a minimum of a smooth curve in steps of 1 m/s; a power has two, that of least power and that
# of greatest range. Steps of 3 m/s need two orbits more.
REFINEMENTS = 8


class Curve(Saveable, Reported):
    """Certified orbits that minimise an objective along speed; made by `solve_curve`, or by `load_curve`.

    Attributes
    ----------
    dataset : every certified optimum over (speed, optimum), labelled.
    marks : changes between neighbouring speeds.
    gaps : speeds at which nothing is certified [m/s].
    warnings : notes for the reader.
    characteristic_speeds : speeds at which the minimised quantity is least [m/s].

    >>> import wingbeat as wb
    >>> curve = wb.solve_curve(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), [12.0, 12.5], starts=1)
    >>> curve.dataset.sizes["speed"], curve.gaps
    (2, [])
    """

    def __init__(self, dataset: xr.Dataset) -> None:
        self._dataset = dataset
        self._about: dict[str, Any] = {name: json.loads(dataset.attrs[name]) for name in _JSON}

    def __repr__(self) -> str:
        data = self._dataset
        what = f"minimum {data.attrs['objective']} at {data.sizes['speed']} speeds"
        return f"<Curve {data.attrs['species']}: {what}, {len(self.gaps)} without an orbit>"

    @property
    def dataset(self) -> xr.Dataset:
        """Every certified optimum over (speed, optimum), the best of each speed first; names as in records."""
        return self._dataset

    @property
    def marks(self) -> list[dict[str, Any]]:
        """Changes between neighbouring speeds: ``gap``, change of ``branch``, change of active ``bounds``."""
        return self._about["marks"]

    @property
    def gaps(self) -> list[float]:
        """The speeds at which nothing is certified [m/s]."""
        data = self._dataset
        return [float(u) for u, status in zip(data["speed"], data["status"], strict=True) if status != "converged"]

    @property
    def warnings(self) -> list[str]:
        """Notes for the reader, with the speeds to which they apply."""
        return self._about["warnings"]

    @functools.cached_property
    def characteristic_speeds(self) -> dict[str, Any]:
        """Speeds at which the minimised quantity is least, with error bars, and those that a power limit allows.

        A power has ``minimum_power`` and ``maximum_range``, and, with a limit, ``fastest_sustained`` and
        ``slowest_sustained``; the cost of transport has ``maximum_range``; another quantity has its own, such as
        ``minimum_frequency``. Each says whether it was found, or why no speed is given.
        """
        return characteristic_speeds(best_line(self._dataset), self._about["inputs"]["power_limit"])

    def _report(self) -> Report:
        return curve_report(self.record())

    def plot(self, published: Sequence[Any] = (), data: FlightPoints | None = None) -> Figure:
        """Return a figure of power and wingbeat frequency against speed.

        Parameters
        ----------
        published : values to draw for comparison, each a `wb.plots.Published`.
        data : your own measured flights, from `wb.experiment.read_flights`.
        """
        return curve_page(self._dataset, published, data)

    def compare(self, data: FlightPoints) -> dict[str, Any]:
        """Return measured flights beside this curve, with the residuals: measured less computed.

        The curve is interpolated linearly between its speeds. Mechanical power is compared with the mean positive
        hinge power, metabolic power with that of the flight muscle alone (only models with a muscle have one).

        Parameters
        ----------
        data : from `wb.experiment.read_flights`.

        Returns
        -------
        ``file``; ``points``, each with ``quantity``, ``speed`` [m/s], ``measured``, ``error``, ``computed`` and
        ``residual`` [Hz or W] and, where nothing is computed, why (``not_compared``); ``residuals``, for each
        quantity ``count``, ``mean``, ``rms`` and ``mean_share`` of the computed (None where one is 0);
        ``notes``.
        """
        return measured_beside(self._dataset, data)

    def to_dataframe(self) -> pd.DataFrame:
        """Return a row for each speed, with the names of records: SI units and radians.

        The best optimum of a speed has the plain names; those of the second end in ``_optimum_2``, and so on.
        """
        return frame_of(self._dataset)

    def record(self) -> dict[str, Any]:
        """Return the curve as a JSON-able dictionary: SI units, radians, None for missing values."""
        data, about = self._dataset, self._dataset.attrs
        columns = {n: v.values.tolist() for n, v in data.data_vars.items() if v.dims in (POINTS, ("speed",))}
        points = []
        for i, speed in enumerate(data["speed"].values.tolist()):
            one = {n: v[i] for n, v in columns.items() if data[n].dims == ("speed",)}
            optima = [
                {n: v[i][k] for n, v in columns.items() if data[n].dims == POINTS}
                for k in range(data.sizes["optimum"])
                if data["family"].values[i, k] >= 0
            ]
            points.append({"speed": speed, **one, "optima": optima})
        record = {
            **{n: about[n] for n in ("species", "climb", "objective", "solve_seconds", "version")},
            **{n: self._about[n] for n in ("vehicle", "aero", "air", "constraints")},
            "power_limit": self._about["inputs"]["power_limit"],
            "objective_unit": data["objective_value"].attrs["units"],
            "characteristic_speeds": self.characteristic_speeds,
            "gaps": self.gaps,
            "marks": self.marks,
            "points": points,
            "warnings": self.warnings,
        }
        return finite_or_none(record)


_JSON = ("vehicle", "aero", "air", "constraints", "marks", "warnings", "inputs")


def solve_curve(
    problem: OrbitProblem,
    speeds: Sequence[float],
    starts: int = 6,
    seed: int = 0,
    power_limit: float | None = None,
    progress: Progress | None = None,
    options: SolverOptions = DEFAULTS,
    refinements: int = REFINEMENTS,
) -> Curve:
    """Find certified orbits that minimise an objective at each speed of a range, and keep all other optima found.

    Every optimum that is found is continued to the neighbouring speeds, up and down, until nothing new appears.
    Each step changes every unknown only a little. If the best optimum of one speed does not lead to the best of the
    next, the curve has a mark between these speeds. Where the minimised quantity is least, speeds are added until
    its neighbours are within `ContinuationOptions.refined_to`; the dataset marks them as ``refined``.

    Parameters
    ----------
    problem : the problem at each speed; its own speed is ignored.
    speeds : at least two, increasing [m/s]; 0 is hover.
    starts : number of starts at each end of the range; each speed in between gets a third as many.
    seed : of the random starts.
    power_limit : the mean power that can be sustained [W], of the kind that the problem minimises; if given, the
        speeds within this limit are found too.
    progress : called with (tasks done, tasks known so far).
    options : of the solvers.
    refinements : largest number of speeds that are added; 0 adds none.

    Raises
    ------
    InvalidInputError : speeds that are not numbers in increasing order; starts, seed, power_limit or refinements
        out of range; a power_limit where no mean power is minimised.

    >>> import wingbeat as wb
    >>> problem = wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0)
    >>> curve = wb.solve_curve(problem, [10.0, 11.0, 12.0], starts=1)
    >>> curve.gaps, [mark["kind"] for mark in curve.marks]
    ([], [])
    """
    check_search(starts, seed)
    faults = FaultList()
    values = list(speeds)
    good = all([faults.number(f"speeds[{i}]", u, **SPEED_LIMITS) for i, u in enumerate(values)])
    if not 2 <= len(values) <= MOST_SPEEDS:
        faults.add("speeds", len(values), f"must be 2 to {MOST_SPEEDS} speeds", "for example 3:20:1")
    elif good and not all(low < high for low, high in itertools.pairwise(values)):
        faults.add("speeds", values, "must increase", "give each speed once, the slowest first")
    if power_limit is not None:
        faults.number("power_limit", power_limit, above=0, unit="W", fix="the sustainable power")
        if not is_mean_power(problem.minimise.name, problem.minimise.unit):
            rule = f"is a limit on the power that is minimised, but {problem.minimise.name} is minimised"
            fix = "minimise a mean power, such as mean_positive_power (--minimise positive-power)"
            faults.add("power_limit", power_limit, rule, fix)
    faults.whole("refinements", refinements, 0, MOST_SPEEDS)
    faults.raise_if_any()
    begun = time.perf_counter()
    speeds = [float(u) for u in values]
    left = refinements

    def refine(branches: Branches) -> list[OrbitProblem]:
        nonlocal left
        added = next_speeds(best_of(branches), options.continuation.refined_to, power_limit)[:left]
        left -= len(added)
        return [problem.at_speed(speed) for speed in added]

    problems = [problem.at_speed(speed) for speed in speeds]
    branches = trace(SPEED, problems, starts, seed, progress, options=options, refine=refine)
    with ThreadPoolExecutor(core_count()) as pool:
        tasks = [[pool.submit(Orbit.of(o, starts, seed).record) for o in optima] for optima in branches.optima]
        records = [[task.result() for task in row] for row in tasks]
    solved = [optima[0].problem.speed for optima in branches.optima]
    inputs = inputs_of(problem, starts, seed, options) | {"speed": solved, "power_limit": power_limit}
    seconds = time.perf_counter() - begun
    return Curve(curve_dataset(branches, records, inputs, speeds, seconds))


def load_curve(path: str | PathLike[str]) -> Curve:
    """Read a curve that `Curve.save` wrote.

    Parameters
    ----------
    path : of a NetCDF file (.nc).

    Raises
    ------
    FileError : the file is missing, unreadable, truncated, not a curve of wingbeat, or changed after it was saved.

    >>> import tempfile, pathlib, wingbeat as wb
    >>> curve = wb.solve_curve(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), [12.0, 12.5], starts=1)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "curve.nc"
    ...     curve.save(path)
    ...     wb.load_curve(path).record() == curve.record()
    True
    """
    return Curve(load_dataset(path, "curve"))


POINTS = ("speed", "optimum")
# Numbers of the orbit record that the curve holds at each speed.
_NUMBERS = (
    "objective_value",
    *("mean_power", "mean_positive_power", "peak_power", "mean_actuator_power", "peak_actuator_power"),
    *("cost_of_transport", "body_pitch_range", "strouhal", "reduced_frequency", "reynolds", "optimality"),
)

_TEXTS: dict[str, Callable[[dict[str, Any]], str]] = {
    "active_bounds": lambda record: ", ".join(record["active_bounds"]),
    "outside_ranges": lambda record: ", ".join(j["name"] for j in record["plausibility"] if j["within"] is False),
}


def curve_dataset(
    branches: Branches,
    records: Sequence[Sequence[dict[str, Any]]],
    inputs: dict[str, Any],
    asked: Sequence[float],
    seconds: float,
) -> xr.Dataset:
    """Assemble the records of all optima, shape (speed, optimum), the best first, padded with not-a-number."""
    import xarray as xr

    problem = branches.optima[0][0].problem
    speeds = np.array([optima[0].problem.speed for optima in branches.optima])
    first = [row[0] for row in records]
    # The record of each certified optimum, None in place of another.
    good = [
        [record if certified(one) else None for record, one in zip(*row, strict=True)]
        for row in zip(records, branches.optima, strict=True)
    ]
    widest = max(map(len, good))
    places = [((i, k), record) for i, row in enumerate(good) for k, record in enumerate(row) if record is not None]
    columns: dict[str, Any] = {}

    def add(name: str, dims: tuple[str, ...], values: np.ndarray) -> None:
        columns[name] = (dims, values, attributes_of(NOMENCLATURE[name]))

    for name, unit, label, of in _numbers(problem):
        values = np.full((len(good), widest), np.nan)
        for place, record in places:
            values[place] = of(record)  # None, such as a cost of transport in hover, becomes not-a-number
        columns[name] = (POINTS, values, {"units": unit, "long_name": label})
    for name, text_of in _TEXTS.items():
        texts = np.full((len(good), widest), "", dtype=object)
        for place, record in places:
            texts[place] = text_of(record)
        columns[name] = (POINTS, texts, {"long_name": label_of(name)})
    family = np.full((len(good), widest), -1)
    for i, row in enumerate(families(branches)):
        family[i, : len(row)] = [n if r is not None else -1 for n, r in zip(row, good[i], strict=True)]
    add("family", POINTS, family)
    steps = np.zeros((len(speeds) - 1, widest, widest), dtype=int)
    for join in branches.links:
        steps[join.interval, join.lower, join.upper] = join.steps
    add("continued", ("interval", "optimum", "optimum_above"), steps)
    for name in ("status", "message"):
        add(name, ("speed",), np.array([record[name] for record in first], dtype=object))
    add("warnings", ("speed",), np.array(["\n".join(record["warnings"]) for record in first], dtype=object))
    add("refined", ("speed",), np.array([int(u not in asked) for u in speeds]))
    add("starts", ("speed",), np.array([record["starts"] for record in first]))
    counts = [r["distinct_optima"] if row[0] is not None else 0 for r, row in zip(first, good, strict=True)]
    add("distinct_optima", ("speed",), np.array(counts))
    speed = {"units": NOMENCLATURE["speed"].unit, "long_name": label_of("speed")}
    speed["standard_name"] = "platform_speed_wrt_air"
    optimum = attributes_of(NOMENCLATURE["optimum"])
    axes = {"speed": ("speed", speeds, speed), "optimum": ("optimum", np.arange(widest), optimum)}
    marks = [
        {"kind": m.kind, "lower_speed": m.lower, "upper_speed": m.upper, "what": m.what} for m in marks_of(branches)
    ]
    attributes = {
        "Conventions": "CF-1.11",
        KIND: "curve",
        "species": problem.species.name,
        "vehicle": json.dumps(vehicle_record(problem.vehicle)),
        "aero": json.dumps(aero_record(problem.aero)),
        "air": json.dumps(dict(vars(problem.air))),
        "climb": float(problem.climb),
        "objective": problem.minimise.name,
        "constraints": json.dumps([str(c) for c in problem.subject_to]),
        "marks": json.dumps(marks),
        "warnings": json.dumps(_common_warnings(first)),
        "solve_seconds": seconds,
        "version": __version__,
        "inputs": json.dumps(inputs),
        "inputs_hash": inputs_hash(inputs),
    }
    return with_characteristic_speeds(xr.Dataset(columns, axes, attributes), inputs["power_limit"])


def _numbers(problem: OrbitProblem) -> Iterator[tuple[str, str, str, Callable[[dict[str, Any]], float | None]]]:
    """Yield name, unit and meaning of each number of an optimum, and the function that reads it from a record."""
    for name in (*_NUMBERS, *(["metabolic_power", "metabolic_rate"] if problem.vehicle.muscle else [])):
        unit = cf(problem.minimise.unit) if name == "objective_value" else NOMENCLATURE[name].unit
        yield name, unit, label_of(name), lambda record, name=name: record[name]
    for name in PARAMETER_NAMES:
        always = name not in NAMED_IF_ON and harmonic_place(name) is None
        if always or in_use(problem.species.wingbeat, name) or name in problem.free:
            yield name, NOMENCLATURE[name].unit, label_of(name), functools.partial(_parameter, name)
    for name in State._fields:
        for column, part in (("initial", "initial_state"), ("closure", "closure")):
            label = label_of(f"{part}.{name}")
            of = lambda record, part=part, name=name: record[part][name]  # noqa: E731
            yield f"{column}_{name}", NOMENCLATURE[name].unit, label, of
    for i, constraint in enumerate(problem.subject_to):
        label = f"{constraint.quantity.name}, kept to {constraint}"
        of = lambda record, text=str(constraint): record["constraints"][text]  # noqa: E731
        yield f"constraint_{i}", cf(constraint.quantity.unit), label, of
    yield "largest_multiplier", "1", label_of("largest_multiplier"), _largest_multiplier


def _parameter(name: str, record: dict[str, Any]) -> float:
    """Return a parameter of the wingbeat, 0 for a law or a harmonic that is off."""
    if (place := harmonic_place(name)) is None:
        return record["wingbeat"].get(name, 0.0)
    law, at = place
    pairs = record["wingbeat"].get(law, [])
    return pairs[at] if at < len(pairs) else 0.0


def _largest_multiplier(record: dict[str, Any]) -> float | None:
    pairs = record["floquet_multipliers"]
    lost = any(part is None for pair in pairs for part in pair)
    return None if lost else max(math.hypot(*pair) for pair in pairs)


def best_of(branches: Branches) -> BestLine:
    """Return the best orbits along speed, while the curve is being solved."""
    best = [optima[0] for optima in branches.optima]
    problem, speed = best[0].problem, np.array([one.problem.speed for one in best])
    value = np.array([one.objective if certified(one) else math.nan for one in best])
    marks = [(mark.kind, mark.lower, mark.upper) for mark in marks_of(branches)]
    limits = [one.limited for one in best]
    return line_of(problem.minimise.name, problem.minimise.unit, speed, value, marks, limits)


def _common_warnings(records: Sequence[dict[str, Any]]) -> list[str]:
    """Return the best orbits' warnings with their speeds; warnings that differ only in numbers are merged."""
    alike: dict[str, tuple[str, list[float]]] = {}
    for record in records:
        for text in record["warnings"]:
            alike.setdefault(re.sub(r"[\d.]+", "#", text), (text, []))[1].append(record["speed"])
    return [f"at {span_in_words(speeds)} m/s: {text}" for text, speeds in alike.values()]
