"""A power curve as a labelled dataset: every optimum at every speed, with units, marks and inputs."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import KIND, NOMENCLATURE, __version__, attributes_of, cf, harmonic_place, label_of
from wingbeat.animal.kinematics import NAMED_IF_ON, PARAMETER_NAMES, in_use
from wingbeat.mechanics.flight_model import State
from wingbeat.orbits.many.branches import Branches
from wingbeat.orbits.many.transitions import Mark, certified, families, marks_of
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.records.characteristic import BestLine, _line, with_characteristic_speeds
from wingbeat.records.inputs import aero_record, inputs_hash, vehicle_record

if TYPE_CHECKING:
    import xarray as xr

POINTS = ("speed", "optimum")
# Numbers of the orbit record that the curve holds at each speed.
_NUMBERS = (
    "objective_value",
    *("mean_power", "mean_positive_power", "peak_power", "mean_actuator_power", "peak_actuator_power"),
    *("cost_of_transport", "body_pitch_range", "strouhal", "reduced_frequency", "reynolds", "optimality"),
)


def _harmonic(wingbeat: dict[str, Any], law: str, place: int) -> float:
    """Return one number of a harmonic, 0 if the law has no such harmonic."""
    pairs = wingbeat.get(law, [])
    return pairs[place] if place < len(pairs) else 0.0


def curve_dataset(
    branches: Branches,
    records: Sequence[Sequence[dict[str, Any]]],
    marks: Sequence[Mark],
    inputs: dict[str, Any],
    asked: Sequence[float],
    seconds: float,
) -> xr.Dataset:
    """Assemble the records of all optima, shape (speed, optimum), the best first, padded with not-a-number.

    Speeds that were not `asked` for are marked: they were added to find the characteristic speeds.
    """
    import xarray as xr

    labels = families(branches)
    problem = branches.optima[0][0].problem
    speeds = np.array([optima[0].problem.speed for optima in branches.optima])
    good = [[r if certified(s) else None for r, s in zip(*row, strict=True)] for row in _rows(records, branches)]
    widest = max(map(len, good))
    table = _Table(good, widest)
    for name in _NUMBERS:
        unit = cf(problem.minimise.unit) if name == "objective_value" else NOMENCLATURE[name].unit
        table.add(name, unit, label_of(name), lambda r, n=name: r[n])
    for name in PARAMETER_NAMES:
        harmonic, unit, label = harmonic_place(name), NOMENCLATURE[name].unit, label_of(name)
        used = in_use(problem.species.wingbeat, name) or name in problem.free
        if name in NAMED_IF_ON:
            if used:
                table.add(name, unit, label, lambda r, n=name: r["wingbeat"].get(n, 0.0))
        elif harmonic is None:
            table.add(name, unit, label, lambda r, n=name: r["wingbeat"][n])
        elif used:
            table.add(name, unit, label, lambda r, at=harmonic: _harmonic(r["wingbeat"], *at))
    for name in State._fields:
        for column, table_of in (("initial", "initial_state"), ("closure", "closure")):
            label, unit = label_of(f"{table_of}.{name}"), NOMENCLATURE[name].unit
            table.add(f"{column}_{name}", unit, label, lambda r, t=table_of, n=name: r[t][n])
    for i, constraint in enumerate(problem.subject_to):
        text = str(constraint)
        about = f"{constraint.quantity.name}, kept to {text}"
        table.add(f"constraint_{i}", cf(constraint.quantity.unit), about, lambda r, n=text: r["constraints"][n])
    table.add("largest_multiplier", "1", label_of("largest_multiplier"), _largest_multiplier)
    table.texts("active_bounds", label_of("active_bounds"), lambda r: ", ".join(r["active_bounds"]))
    table.texts("outside_ranges", label_of("outside_ranges"), _outside)
    family = np.full((len(speeds), widest), -1)
    for i, row in enumerate(labels):
        family[i, : len(row)] = [n if r is not None else -1 for n, r in zip(row, good[i], strict=True)]
    table.columns["family"] = (POINTS, family, _about("family"))
    steps = np.zeros((len(speeds) - 1, widest, widest), dtype=int)
    for join in branches.links:
        steps[join.interval, join.lower, join.upper] = join.steps
    table.columns["continued"] = (("interval", "optimum", "optimum_above"), steps, _about("continued"))
    first = [row[0] for row in records]
    for name in ("status", "message"):
        table.columns[name] = (("speed",), np.array([r[name] for r in first], dtype=object), _about(name))
    listed = np.array(["\n".join(r["warnings"]) for r in first], dtype=object)
    table.columns["warnings"] = (("speed",), listed, _about("warnings"))
    table.columns["refined"] = (("speed",), np.array([int(u not in asked) for u in speeds]), _about("refined"))
    for name in ("starts", "distinct_optima"):
        counts = [r[name] if g[0] is not None or name == "starts" else 0 for r, g in zip(first, good, strict=True)]
        table.columns[name] = (("speed",), np.array(counts), _about(name))
    meaning = {"units": NOMENCLATURE["speed"].unit, "long_name": label_of("speed")}
    meaning["standard_name"] = "platform_speed_wrt_air"
    axes = {"speed": ("speed", speeds, meaning), "optimum": ("optimum", np.arange(widest), _about("optimum"))}
    dataset = xr.Dataset(table.columns, axes, _attributes(problem, first, marks, inputs, seconds))
    return with_characteristic_speeds(dataset, inputs["power_limit"])


def _about(name: str) -> dict[str, str]:
    return attributes_of(NOMENCLATURE[name])


def _rows(records: Any, branches: Branches) -> Any:
    return zip(records, branches.optima, strict=True)


class _Table:
    """Columns over speed and optimum, from records; a record is None if there is no certified orbit."""

    def __init__(self, records: Sequence[Sequence[dict[str, Any] | None]], widest: int) -> None:
        self._records, self._shape = records, (len(records), widest)
        self.columns: dict[str, Any] = {}

    def add(self, name: str, unit: str, meaning: str, of: Any) -> None:
        """Add a number of each record; None, such as a cost of transport in hover, becomes not-a-number."""
        values = np.full(self._shape, np.nan)
        for place, record in self._each():
            found = of(record)
            values[place] = math.nan if found is None else found
        self.columns[name] = (POINTS, values, {"units": unit, "long_name": meaning})

    def texts(self, name: str, meaning: str, of: Any) -> None:
        """Add a text of each record."""
        values = np.full(self._shape, "", dtype=object)
        for place, record in self._each():
            values[place] = of(record)
        self.columns[name] = (POINTS, values, {"long_name": meaning})

    def _each(self) -> Any:
        for i, row in enumerate(self._records):
            yield from (((i, j), record) for j, record in enumerate(row) if record is not None)


def _outside(record: dict[str, Any]) -> str:
    return ", ".join(one["name"] for one in record["plausibility"] if one["within"] is False)


def _largest_multiplier(record: dict[str, Any]) -> float | None:
    pairs = record["floquet_multipliers"]
    return (
        None if any(part is None for pair in pairs for part in pair) else max(math.hypot(*pair) for pair in pairs)
    )


def best_of(branches: Branches) -> BestLine:
    """Return the best orbits along speed, while the curve is being solved."""
    best = [optima[0] for optima in branches.optima]
    problem, speed = best[0].problem, np.array([one.problem.speed for one in best])
    value = np.array([one.objective if certified(one) else math.nan for one in best])
    marks = [(mark.kind, mark.lower, mark.upper) for mark in marks_of(branches)]
    limits = [one.limited for one in best]
    return _line(problem.minimise.name, problem.minimise.unit, speed, value, marks, limits)


def _by_speed(mark: Mark) -> dict[str, Any]:
    return {"kind": mark.kind, "lower_speed": mark.lower, "upper_speed": mark.upper, "what": mark.what}


def _attributes(
    problem: OrbitProblem, records: Sequence[Any], marks: Sequence[Mark], inputs: dict[str, Any], seconds: float
) -> dict[str, Any]:
    return {
        "Conventions": "CF-1.11",
        KIND: "curve",
        "species": problem.species.name,
        "vehicle": json.dumps(vehicle_record(problem.vehicle)),
        "aero": json.dumps(aero_record(problem.aero)),
        "air": json.dumps(dict(vars(problem.air))),
        "climb": float(problem.climb),
        "objective": problem.minimise.name,
        "constraints": json.dumps([str(c) for c in problem.subject_to]),
        "marks": json.dumps([_by_speed(mark) for mark in marks]),
        "warnings": json.dumps(_common_warnings(records)),
        "solve_seconds": seconds,
        "version": __version__,
        "inputs": json.dumps(inputs),
        "inputs_hash": inputs_hash(inputs),
    }


def _common_warnings(records: Sequence[dict[str, Any]]) -> list[str]:
    """Return the best orbits' warnings with their speeds; warnings that differ only in numbers are merged."""
    speeds: dict[str, list[float]] = {}
    texts: dict[str, str] = {}
    for record in records:
        for text in record["warnings"]:
            key = re.sub(r"[\d.]+", "#", text)
            texts.setdefault(key, text)
            speeds.setdefault(key, []).append(record["speed"])
    return [f"at {_span(speeds[key])} m/s: {text}" for key, text in texts.items()]


def _span(speeds: list[float]) -> str:
    return f"{speeds[0]:g}" if len(speeds) == 1 else f"{speeds[0]:g} to {speeds[-1]:g}"
