"""From numbers to records; faults of the constructors are reported in the words of the file."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from typing import Any

from wingbeat._base.errors import FaultList, InvalidInputError
from wingbeat._base.nomenclature import plain_unit
from wingbeat.animal.kinematics import NAMED_IF_ON, Wingbeat
from wingbeat.animal.species_schema import KEYS, PARTS, TAIL_PATHS, Number, Numbers, SpeciesText, display
from wingbeat.animal.species_schema.faults import NOTHING
from wingbeat.animal.vehicle import Air, Body, Motor, Muscle, Springs, Tail, Vehicle, Wing

DEFAULT = "not given: the default"
WHOLE, BODY, WING = "vehicle.mass", "vehicle.body.mass", "vehicle.wing.mass"
_RECORDS = {
    "vehicle.body": Body,
    "vehicle.wing": Wing,
    "vehicle.tail": Tail,
    "vehicle.muscle": Muscle,
    "vehicle.motor": Motor,
    "vehicle.springs": Springs,
    "wingbeat": Wingbeat,
    "air": Air,
}
_ARTICLES = {"tail": "a tail", "muscle": "a muscle", "motor": "a motor", "springs": "springs"}
_OF_PARTS = {key.path: key for keys in PARTS.values() for key in keys}
# If a species is not given these numbers, it has none of them, not even as a default.
UNNAMED_PATHS = (*_OF_PARTS, *(f"wingbeat.{name}" for name in NAMED_IF_ON))
_DEFAULTS: dict[str, Any] = {
    f"{section}.{field.name}": field.default
    for section, record in _RECORDS.items()
    for field in dataclasses.fields(record)
    if field.default is not dataclasses.MISSING
}


def default_of(path: str) -> Any:
    """Return the default of a number; if it has none, 1.0, which every constructor accepts."""
    return _DEFAULTS.get(path, 1.0)


def build_records(numbers: Mapping[str, Number], given: Numbers, faults: FaultList) -> dict[str, Any]:
    """Return vehicle, wingbeat and air; faults quote the values in `given` as they were written.

    What is missing is filled in by `default_of`, so that one fault does not hide the others.
    """
    made: dict[str, Any] = {}
    before = len(faults.faults)
    for section, record in _RECORDS.items():
        part = section.rpartition(".")[2]
        if part in PARTS and not has_part(numbers, part):
            continue
        paths = {field.name: f"{section}.{field.name}" for field in dataclasses.fields(record)}
        values = {n: numbers[p].value if p in numbers else default_of(p) for n, p in paths.items()}
        try:
            made[section] = record(**values)
        except InvalidInputError as error:
            faults.faults += [given.quote(fault) for fault in error.faults]
    if len(faults.faults) > before:
        return {}
    parts = {part: made.get(f"vehicle.{part}") for part in PARTS}
    vehicle = Vehicle(made["vehicle.body"], made["vehicle.wing"], **parts)
    if not math.isfinite(vehicle.mass):
        faults.add("vehicle.mass", vehicle.mass, "must be finite", "make the body or the wings lighter")
    return {"vehicle": vehicle, "wingbeat": made["wingbeat"], "air": made["air"]}


def has_part(numbers: Mapping[str, Number], part: str) -> bool:
    """Return whether the numbers include one of an optional part, such as a tail."""
    return any(key.path in numbers for key in PARTS[part])


def complete_parts(numbers: dict[str, Number]) -> None:
    """Add defaults for the missing numbers of each optional part, if some number of the part is given."""
    for part, keys in PARTS.items():
        if not has_part(numbers, part):
            continue
        paths = TAIL_PATHS if part == "tail" else tuple(key.path for key in keys)
        for path in paths:
            if path not in _OF_PARTS or not _OF_PARTS[path].required:
                numbers.setdefault(path, Number(default_of(path), plain_unit(path), DEFAULT))


def check_parts(numbers: Mapping[str, Number], faults: FaultList) -> None:
    """Note the required numbers of a part that are missing and were not already refused."""
    for part, keys in PARTS.items():
        for key in keys if has_part(numbers, part) else ():
            refused = any(fault.where.endswith(f"{part}.{key.name}") for fault in faults.faults)
            if key.required and key.path not in numbers and not refused:
                rule = f"must be given for {_ARTICLES[part]}"
                faults.add(key.path, NOTHING, rule, f"{key.meaning} [{key.unit}]")


def derive_body(numbers: dict[str, Number], given: Numbers, faults: FaultList) -> None:
    """Set the mass of the body to the whole mass minus that of both wings."""
    whole, wing = (numbers[path].value if path in numbers else None for path in (WHOLE, WING))
    where, value = given.written.get(WHOLE) or given.written.get(WING, (WHOLE, whole))
    if not isinstance(whole, float):
        return
    if whole <= 0:
        faults.add(where, value, "must be > 0 kg", "give the mass of the whole animal")
    elif not isinstance(wing, float) or wing <= 0:
        return  # the wing's own fault is reported elsewhere
    elif whole <= 2 * wing:
        faults.add(where, value, f"leaves no mass for the body: the whole has {whole:g} kg, each wing {wing:g} kg")
    else:
        numbers[BODY] = Number(whole - 2 * wing, "kg", "vehicle.mass less both wings")


def in_order(numbers: Mapping[str, Number]) -> dict[str, Number]:
    """Return the numbers in the order of a species file."""
    return {key.path: numbers[key.path] for key in KEYS if key.path in numbers}


def check_bounds(content: SpeciesText, faults: FaultList) -> None:
    """Note bounds that allow an impossible wingbeat: a frequency of 0, a negative amplitude."""
    for name, bound in content.free.items():
        for end in bound.bounds:
            number = Numbers()
            number[f"wingbeat.{name}"] = Number(end, "")
            number.written[f"wingbeat.{name}"] = content.written[name]
            before = len(faults.faults)
            build_records(number, number, faults)
            if len(faults.faults) > before:
                break


def words(path: str, number: Number) -> str:
    """Return value and unit as text for a reader, angles in degrees."""
    _, shown = display(path, number)
    unit = "" if shown.unit == "1" else f" {shown.unit}"
    if isinstance(shown.value, tuple):
        return f"[{', '.join(f'{value:g}' for value in shown.value)}]{unit}"
    return f"{shown.value:g}{unit}"
