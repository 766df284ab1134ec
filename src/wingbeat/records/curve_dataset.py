"""The data set of a curve over speed or frequency: every certified optimum, with what follows from them."""

from __future__ import annotations

import functools
import itertools
import json
import math
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import KIND, NOMENCLATURE, OVER, __version__, attributes_of, cf, harmonic_place, label_of
from wingbeat.animal.kinematics import HINGE_NAMES, NAMED_IF_ON, PARAMETER_NAMES, PITCH_LAW, in_use
from wingbeat.mechanics.flight_model import State
from wingbeat.orbits.branches import Branches, certified, families, marks_of
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.problem.quantity import OF_BATTERY
from wingbeat.records.characteristic import with_characteristic
from wingbeat.records.forms import inputs_hash
from wingbeat.records.hinges import hinge_names
from wingbeat.records.inputs import aero_record, vehicle_record

if TYPE_CHECKING:
    import xarray as xr

# Numbers of the orbit record that the curve holds at each point.
_NUMBERS = (
    "objective_value",
    *("mean_power", "mean_positive_power", "peak_power", "mean_actuator_power", "peak_actuator_power"),
    *("cost_of_transport", "body_pitch_range", "strouhal", "reduced_frequency", "reynolds", "optimality"),
    "detached_share",
)

_OF_MUSCLE = (
    *("metabolic_power", "metabolic_rate", "peak_activation"),
    *("muscle_power_per_mass", "muscle_work_per_mass"),
)
_OF_MOTOR = ("electrical_power", "peak_motor_torque", "peak_motor_voltage", "peak_motor_current")

_TEXTS: dict[str, Callable[[dict[str, Any]], str]] = {
    "active_bounds": lambda record: ", ".join(record["active_bounds"]),
    "outside_ranges": lambda record: ", ".join(j["name"] for j in record["plausibility"] if j["within"] is False),
}


def curve_dataset(
    branches: Branches,
    records: Sequence[Sequence[dict[str, Any]]],
    inputs: dict[str, Any],
    asked: Sequence[float],
    warnings: Sequence[str],
    seconds: float,
) -> xr.Dataset:
    """Assemble the records of all optima, shape (speed, optimum), the best first, padded with not-a-number.

    Over frequency, the shape is (frequency, optimum).
    """
    import xarray as xr

    problem, along = branches.optima[0][0].problem, branches.along
    over = along.name
    dims = over, "optimum"
    values_along = np.array([along.of(optima[0].problem) for optima in branches.optima])
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

    for name, unit, label, of in _numbers(problem, over):
        values = np.full((len(good), widest), np.nan)
        for place, record in places:
            values[place] = of(record)  # None, such as a cost of transport in hover, becomes not-a-number
        columns[name] = (dims, values, {"units": unit, "long_name": label})
    for name, text_of in _TEXTS.items():
        texts = np.full((len(good), widest), "", dtype=object)
        for place, record in places:
            texts[place] = text_of(record)
        columns[name] = (dims, texts, {"long_name": label_of(name)})
    family = np.full((len(good), widest), -1)
    for i, row in enumerate(families(branches)):
        family[i, : len(row)] = [n if r is not None else -1 for n, r in zip(row, good[i], strict=True)]
    add("family", dims, family)
    steps = np.zeros((len(values_along) - 1, widest, widest), dtype=int)
    for join in branches.links:
        steps[join.interval, join.lower, join.upper] = join.steps
    add("continued", ("interval", "optimum", "optimum_above"), steps)
    for name in ("status", "message"):
        add(name, (over,), np.array([record[name] for record in first], dtype=object))
    add("warnings", (over,), np.array(["\n".join(record["warnings"]) for record in first], dtype=object))
    add("refined", (over,), np.array([int(value not in asked) for value in values_along]))
    add("starts", (over,), np.array([record["starts"] for record in first]))
    counts = [r["distinct_optima"] if row[0] is not None else 0 for r, row in zip(first, good, strict=True)]
    add("distinct_optima", (over,), np.array(counts))
    axis = {"units": NOMENCLATURE[over].unit, "long_name": label_of(over)}
    if over == "speed":
        axis["standard_name"] = "platform_speed_wrt_air"
    optimum = attributes_of(NOMENCLATURE["optimum"])
    axes = {over: (over, values_along, axis), "optimum": ("optimum", np.arange(widest), optimum)}
    marks = [
        {"kind": m.kind, f"lower_{over}": m.lower, f"upper_{over}": m.upper, "what": m.what}
        for m in marks_of(branches)
    ]
    attributes = {
        "Conventions": "CF-1.11",
        KIND: "curve",
        "species": problem.species.name,
        "vehicle": json.dumps(vehicle_record(problem.vehicle)),
        "aero": json.dumps(aero_record(problem.aero)),
        "air": json.dumps(dict(vars(problem.air))),
        "climb": float(problem.climb),
        **({"carried_mass": problem.species.carried_mass} if problem.species.carried_mass else {}),
        "objective": problem.minimise.name,
        "constraints": json.dumps([str(c) for c in problem.subject_to]),
        "marks": json.dumps(marks),
        "warnings": json.dumps(warnings),
        "solve_seconds": seconds,
        "version": __version__,
        "inputs": json.dumps(inputs),
        "inputs_hash": inputs_hash(inputs),
    }
    if over != "speed":
        attributes |= {OVER: over, "speed": float(problem.speed)}
    return with_characteristic(xr.Dataset(columns, axes, attributes), inputs)


def _numbers(
    problem: OrbitProblem, over: str
) -> Iterator[tuple[str, str, str, Callable[[dict[str, Any]], float | None]]]:
    """Yield name, unit and meaning of each number of an optimum, and the function that reads it from a record."""
    parts = {"muscle": _OF_MUSCLE, "motor": _OF_MOTOR, "battery": tuple(OF_BATTERY)}
    if problem.vehicle.motor is None:  # without it, a battery drives nothing
        del parts["battery"]
    there = (names for part, names in parts.items() if getattr(problem.vehicle, part) is not None)
    hinges = hinge_names(problem.species.kind, problem.vehicle, problem.species.wingbeat)
    for name in (*_NUMBERS, *itertools.chain(*there), *hinges):
        unit = cf(problem.minimise.unit) if name == "objective_value" else NOMENCLATURE[name].unit
        yield name, unit, label_of(name), lambda record, name=name: record[name]
    for name in PARAMETER_NAMES:
        if name == over:  # the axis
            continue
        always = name not in (*NAMED_IF_ON, *HINGE_NAMES) and harmonic_place(name) is None
        if name in PITCH_LAW and problem.species.wingbeat.pitch_hinge is not None:
            always = False
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
