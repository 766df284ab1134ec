"""The class `Curve`, certified orbits along speed or frequency; how one is found, built and read."""

from __future__ import annotations

import dataclasses
import functools
import itertools
import json
import math
import re
import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import OVER, PLURALS, FaultList, Report, Reported, over_of
from wingbeat._workers.tuning import core_count
from wingbeat.experiment.flights_file import FlightPoints
from wingbeat.orbits.branches import FREQUENCY, SPEED, Along, Branches, certified, fixed_frequency, marks_of, trace
from wingbeat.orbits.options import DEFAULTS, SolverOptions
from wingbeat.orbits.problem.problem import SPEED_LIMITS, OrbitProblem
from wingbeat.orbits.solve import Progress, check_search
from wingbeat.plots.draw_curve import curve_page
from wingbeat.plots.draw_frequencies import frequency_page
from wingbeat.records.characteristic import (
    BestLine,
    is_mean_power,
    line_of,
    next_speeds,
    speeds_of,
)
from wingbeat.records.curve_dataset import curve_dataset
from wingbeat.records.inputs import inputs_of
from wingbeat.records.judgements import OTHER_FREQUENCY
from wingbeat.records.measured import measured_beside
from wingbeat.records.result_files import Saveable, load_dataset
from wingbeat.records.tables import finite_or_none, frame_of
from wingbeat.results.orbit import Orbit
from wingbeat.words.curve_words import curve_report, span_in_words

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr
    from matplotlib.figure import Figure

MOST_POINTS = 1000
# Three orbits enclose a minimum of a smooth curve in steps of 1 m/s; a power has two, that of least power and that
# of greatest range. Steps of 3 m/s need two orbits more.
REFINEMENTS = 8


class Curve(Saveable, Reported):
    """Certified orbits that minimise an objective along speed or frequency, from `solve_curve` or `load_curve`.

    Attributes
    ----------
    over : what the curve runs over, ``"speed"`` or ``"frequency"``.
    dataset : every certified optimum over (speed, optimum) or (frequency, optimum), labelled.
    marks : changes between neighbouring points.
    gaps : speeds [m/s] or frequencies [Hz] at which nothing is certified.
    warnings : notes for the reader.
    characteristic_speeds : speeds at which the minimised quantity is least [m/s]; empty over frequency.
    characteristic_frequencies : what the curve says of the wingbeat frequency [Hz]; empty over speed.

    >>> import wingbeat as wb
    >>> curve = wb.solve_curve(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), [12.0, 12.5], starts=1)
    >>> curve.dataset.sizes["speed"], curve.gaps
    (2, [])
    """

    def __init__(self, dataset: xr.Dataset) -> None:
        self._dataset = dataset
        self.over = over_of(dataset.attrs)
        self._about: dict[str, Any] = {name: json.loads(dataset.attrs[name]) for name in _JSON}

    def __repr__(self) -> str:
        data = self._dataset
        what = f"minimum {data.attrs['objective']} at {data.sizes[self.over]} {PLURALS[self.over]}"
        return f"<Curve {data.attrs['species']}: {what}, {len(self.gaps)} without an orbit>"

    @property
    def dataset(self) -> xr.Dataset:
        """Every certified optimum over (speed or frequency, optimum), the best first; names as in records."""
        return self._dataset

    @property
    def marks(self) -> list[dict[str, Any]]:
        """Changes between neighbouring points: ``gap``, change of ``branch``, change of active ``bounds``."""
        return self._about["marks"]

    @property
    def gaps(self) -> list[float]:
        """The speeds [m/s] or frequencies [Hz] at which nothing is certified."""
        data = self._dataset
        return [
            float(x) for x, status in zip(data[self.over], data["status"], strict=True) if status != "converged"
        ]

    @property
    def warnings(self) -> list[str]:
        """Notes for the reader, with the speeds or frequencies to which they apply."""
        return self._about["warnings"]

    @functools.cached_property
    def characteristic_speeds(self) -> dict[str, Any]:
        """Speeds at which the minimised quantity is least, with error bars, and those that a power limit allows.

        A power has ``minimum_power`` and ``maximum_range``, and, with a limit, ``fastest_sustained`` and
        ``slowest_sustained``; the cost of transport has ``maximum_range``; another quantity has its own, such as
        ``minimum_frequency``. A robot with a battery has ``best_endurance`` and ``best_range`` of its discharge,
        one with a motor alone those of its electrical power. Each says whether it was found, or why no speed is
        given.
        """
        if self.over != "speed":
            return {}
        return speeds_of(self._dataset, self._about["inputs"]["power_limit"])

    @functools.cached_property
    def characteristic_frequencies(self) -> dict[str, Any]:
        """What a curve over frequency says of the frequency [Hz].

        ``own`` is that of the animal, with its band, basis and source; ``least`` where the minimised quantity is
        least, with the ranges in which it is within 5 % of that (``within_5_percent``). Where there is muscle,
        ``activation`` has the ranges with an activation of at most 1, and ``work_per_beat`` for each measurement
        the ranges whose work per beat it allows.
        """
        return {} if self.over == "speed" else json.loads(self._dataset.attrs["characteristic_frequencies"])

    def _report(self) -> Report:
        return curve_report(self.record())

    def plot(self, published: Sequence[Any] = (), data: FlightPoints | None = None) -> Figure:
        """Return a figure of power and wingbeat frequency against speed, or of what depends on frequency.

        Parameters
        ----------
        published : values to draw for comparison, each a `wb.plots.Published`; only over speed.
        data : your own measured flights, from `wb.experiment.read_flights`; only over speed.
        """
        if self.over == "frequency":
            return frequency_page(self._dataset)
        return curve_page(self._dataset, published, data)

    def compare(self, data: FlightPoints) -> dict[str, Any]:
        """Return measured flights beside this curve, with the residuals: measured less computed.

        The curve is interpolated linearly between its speeds. Mechanical power is compared with the mean positive
        hinge power, a metabolic rate with that of the whole animal (only models with a muscle have one).

        Parameters
        ----------
        data : from `wb.experiment.read_flights`.

        Returns
        -------
        ``file``; ``points``, each with ``quantity``, ``speed`` [m/s], ``measured``, ``error``, ``computed`` and
        ``residual`` [Hz or W] and, where nothing is computed, why (``not_compared``); ``residuals``, for each
        quantity ``count``, ``mean``, ``rms`` and ``mean_share`` of the computed (None where one is 0);
        ``notes``.

        Raises
        ------
        InvalidInputError : a curve over frequency.
        """
        if self.over != "speed":
            faults = FaultList()
            faults.add("curve", self.over, "has one speed only", "compare flights with a curve over speed")
            faults.raise_if_any()
        return measured_beside(self._dataset, data)

    def to_dataframe(self) -> pd.DataFrame:
        """Return a row for each speed or frequency, with the names of records: SI units and radians.

        The best optimum of a row has the plain names; those of the second end in ``_optimum_2``, and so on.
        """
        return frame_of(self._dataset)

    def record(self) -> dict[str, Any]:
        """Return the curve as a JSON-able dictionary: SI units, radians, None for missing values."""
        data, about, over = self._dataset, self._dataset.attrs, self.over
        each, both = (over,), (over, "optimum")
        columns = {n: v.values.tolist() for n, v in data.data_vars.items() if v.dims in (both, each)}
        points = []
        for i, value in enumerate(data[over].values.tolist()):
            one = {n: v[i] for n, v in columns.items() if data[n].dims == each}
            optima = [
                {n: v[i][k] for n, v in columns.items() if data[n].dims == both}
                for k in range(data.sizes["optimum"])
                if data["family"].values[i, k] >= 0
            ]
            points.append({over: value, **one, "optima": optima})
        record = {
            **{n: about[n] for n in ("species", "climb", "objective", "solve_seconds", "version")},
            **{n: self._about[n] for n in ("vehicle", "aero", "air", "constraints")},
            "power_limit": self._about["inputs"]["power_limit"],
            "own_frequency": self._about["inputs"].get("own_frequency", False),
            "objective_unit": data["objective_value"].attrs["units"],
            **(
                {"characteristic_speeds": self.characteristic_speeds}
                if over == "speed"
                else {
                    **{OVER: over, "speed": about["speed"]},
                    "characteristic_frequencies": self.characteristic_frequencies,
                }
            ),
            "gaps": self.gaps,
            "marks": self.marks,
            "points": points,
            "warnings": self.warnings,
        }
        return finite_or_none(record)


_JSON = ("vehicle", "aero", "air", "constraints", "marks", "warnings", "inputs")
_ALONG = {along.name: along for along in (SPEED, FREQUENCY)}


def solve_curve(
    problem: OrbitProblem,
    values: Sequence[float],
    starts: int = 6,
    seed: int = 0,
    power_limit: float | None = None,
    progress: Progress | None = None,
    options: SolverOptions = DEFAULTS,
    refinements: int = REFINEMENTS,
    over: str = "speed",
) -> Curve:
    """Find certified orbits that minimise an objective at each speed, or frequency, and keep all optima found.

    Every optimum that is found is continued to the neighbouring speeds, up and down, until nothing new appears.
    Each step changes every unknown only a little. If the best optimum of one speed does not lead to the best of the
    next, the curve has a mark between these speeds. Where the minimised quantity is least, speeds are added until
    its neighbours are within `ContinuationOptions.refined_to`; the dataset marks them as ``refined``.

    Parameters
    ----------
    problem : the problem at each speed; its own speed is ignored. Over frequency, its own frequency is.
    values : at least two, increasing: speeds [m/s], of which 0 is hover, or frequencies [Hz].
    starts : number of starts at each end of the range; each value in between gets a third as many.
    seed : of the random starts.
    power_limit : the mean power that can be sustained [W], of the kind that the problem minimises; if given, the
        speeds within this limit are found too.
    progress : called with (tasks done, tasks known so far).
    options : of the solvers.
    refinements : largest number of speeds that are added; 0 adds none. No frequency is added.
    over : ``"speed"``, or ``"frequency"``: orbits at the problem's speed, each with its frequency given.

    Raises
    ------
    InvalidInputError : values that are not numbers in increasing order; starts, seed, power_limit or refinements
        out of range; a power_limit where no mean power is minimised, or over frequency; a frequency that is
        minimised over frequency.

    >>> import wingbeat as wb
    >>> problem = wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0)
    >>> curve = wb.solve_curve(problem, [10.0, 11.0, 12.0], starts=1)
    >>> curve.gaps, [mark["kind"] for mark in curve.marks]
    ([], [])
    """
    check_search(starts, seed)
    faults = FaultList()
    faults.choice("over", over, tuple(_ALONG))
    faults.raise_if_any()
    along, values = _ALONG[over], list(values)
    _check_values(faults, along, values)
    least = problem.minimise
    if along is FREQUENCY:
        if least.parameter == "frequency":
            fix = "minimise a power, such as metabolic_power (--model animal)"
            faults.add("minimise", least.name, "is given at each point of a curve over frequency", fix)
        if power_limit is not None:
            faults.add("power_limit", power_limit, "belongs to a curve over speed", "leave it out")
    elif power_limit is not None:
        faults.number("power_limit", power_limit, above=0, unit="W", fix="the sustainable power")
        if not is_mean_power(least.name, least.unit):
            rule = f"is a limit on the power that is minimised, but {least.name} is minimised"
            fix = "minimise a mean power, such as mean_positive_power (--minimise positive-power)"
            faults.add("power_limit", power_limit, rule, fix)
    faults.whole("refinements", refinements, 0, MOST_POINTS)
    faults.raise_if_any()
    begun = time.perf_counter()
    asked = [float(value) for value in values]
    left = refinements

    def refine(branches: Branches) -> list[OrbitProblem]:
        nonlocal left
        added = next_speeds(best_of(branches), options.continuation.refined_to, power_limit)[:left]
        left -= len(added)
        return [along.moved(problem, value) for value in added]

    problems = [along.moved(problem, value) for value in asked]
    more = refine if along is SPEED else None  # about a least power that is flat in frequency, more is not known
    branches = trace(along, problems, starts, seed, progress, options=options, refine=more)
    with ThreadPoolExecutor(core_count()) as pool:
        tasks = [[pool.submit(Orbit.of(o, starts, seed).record) for o in optima] for optima in branches.optima]
        records = [[task.result() for task in row] for row in tasks]
    solved = [along.of(optima[0].problem) for optima in branches.optima]
    # Over frequency, the inputs keep the animal's own frequency; it is free at no point.
    base = problem if along is SPEED else dataclasses.replace(problem, **fixed_frequency(problem))
    inputs = inputs_of(base, starts, seed, options) | {over: solved, "power_limit": power_limit}
    warnings = _common_warnings([row[0] for row in records], solved, along.unit)
    return Curve(curve_dataset(branches, records, inputs, asked, warnings, time.perf_counter() - begun))


def _check_values(faults: FaultList, along: Along, values: list[float]) -> None:
    name = PLURALS[along.name]
    limits: dict[str, Any] = SPEED_LIMITS if along is SPEED else {"above": 0.0, "unit": along.unit}
    good = all([faults.number(f"{name}[{i}]", value, **limits) for i, value in enumerate(values)])
    if not 2 <= len(values) <= MOST_POINTS:
        example = "3:20:1" if along is SPEED else "3:12:0.5"
        faults.add(name, len(values), f"must be 2 to {MOST_POINTS} {name}", f"for example {example}")
    elif good and not all(low < high for low, high in itertools.pairwise(values)):
        fix = f"give each {along.name} once, the smallest first"
        faults.add(name, values, "must increase", fix)


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


def best_of(branches: Branches) -> BestLine:
    """Return the best orbits along speed, while the curve is being solved."""
    best = [optima[0] for optima in branches.optima]
    problem, speed = best[0].problem, np.array([one.problem.speed for one in best])
    value = np.array([one.objective if certified(one) else math.nan for one in best])
    marks = [(mark.kind, mark.lower, mark.upper) for mark in marks_of(branches)]
    limits = [one.limited for one in best]
    return line_of(problem.minimise.name, problem.minimise.unit, speed, value, marks, limits)


def _common_warnings(records: Sequence[dict[str, Any]], values: Sequence[float], unit: str) -> list[str]:
    """Return the best orbits' warnings with where they apply; warnings that differ only in numbers are merged."""
    alike: dict[str, tuple[str, list[float]]] = {}
    for record, value in zip(records, values, strict=True):
        for text in record["warnings"]:
            key = text if text.startswith(OTHER_FREQUENCY) else re.sub(r"[\d.]+", "#", text)
            alike.setdefault(key, (text, []))[1].append(value)
    return [f"at {span_in_words(where)} {unit}: {text}" for text, where in alike.values()]
