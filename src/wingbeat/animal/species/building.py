"""From numbers to records, with the constructors' faults in the words of the file, and what looks odd in them."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from typing import Any, get_args, get_type_hints

from wingbeat._base import FaultList, InvalidInputError, plain_unit, suggest
from wingbeat.animal.kinematics import NAMED_IF_ON, PitchHinge, Wingbeat, parameter
from wingbeat.animal.species.numbers import (
    DEFAULT,
    KEYS,
    NOTHING,
    OUTSIDE,
    PARTS,
    STATION_MASSES,
    TAIL_PATHS,
    WING,
    Key,
    Number,
    Numbers,
    SpeciesText,
    display,
    path_of,
    shown,
    spoken,
    words,
)
from wingbeat.animal.vehicle import CHORDWISE, STATIONS, Air, Vehicle

WHOLE, BODY = "vehicle.mass", "vehicle.body.mass"
HINGE = "vehicle.pitch_hinge"  # a part in files; the record of the wingbeat holds it, in place of the pitch law
# The class of each record, by the path of its numbers; the parts of a vehicle in the order of its fields.
_RECORDS: dict[str, Any] = {
    **{f"vehicle.{n}": (get_args(hint) or (hint,))[0] for n, hint in get_type_hints(Vehicle).items()},
    **{HINGE: PitchHinge, "wingbeat": Wingbeat, "air": Air},
}
_OF_PARTS = {key.path: key for keys in PARTS.values() for key in keys}
# If a species is not given these numbers, it has none of them, not even as a default.
UNNAMED_PATHS = (
    *_OF_PARTS,
    *(f"wingbeat.{name}" for name in NAMED_IF_ON),
    *(f"vehicle.wing.{name}" for name in (*CHORDWISE, *STATIONS)),
)
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
        if record is Wingbeat:
            values["pitch_hinge"] = made.get(HINGE)
        try:
            made[section] = record(**values)
        except InvalidInputError as error:
            faults.faults += [given.quote(fault) for fault in error.faults]
    if len(faults.faults) > before:
        return {}
    parts = [p for p in _RECORDS if p.startswith("vehicle.") and p != HINGE]
    vehicle = Vehicle(**{p.removeprefix("vehicle."): made.get(p) for p in parts})
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
                rule = f"must be given for {part}" if part.endswith("s") else f"must be given for a {part}"
                faults.add(key.path, NOTHING, rule, f"{key.meaning} [{key.unit}]")
    if has_part(numbers, "battery") and not has_part(numbers, "motor"):
        faults.add("vehicle.motor", NOTHING, "must be given for a battery", "the battery feeds the motor")


def lacks_muscle(numbers: Mapping[str, Number]) -> bool:
    """Return whether the numbers include some of a flight muscle, but not all that it needs."""
    return has_part(numbers, "muscle") and any(k.required and k.path not in numbers for k in PARTS["muscle"])


def weigh_wing(numbers: dict[str, Number], given: Mapping[str, Number]) -> None:
    """Set the wing's mass to the sum of its stations', or scale those by a mass of the wing that alone is given."""
    column, old = numbers.get(STATION_MASSES), numbers.get(WING)
    if column is None or (WING in given and STATION_MASSES in given):
        return
    masses = column.value if isinstance(column.value, tuple) else (column.value,)
    total = math.fsum(masses)
    if WING not in given or old is None:
        source = "sum of wing.station_masses"
        numbers[WING] = old._replace(value=total, source=source) if old else Number(total, "kg", source)
    elif isinstance(old.value, float) and old.value > 0 and total > 0:
        scaled, told = tuple(mass * old.value / total for mass in masses), "scaled to wing.mass: "
        numbers[STATION_MASSES] = column._replace(value=scaled, source=told + column.source.removeprefix(told))


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


def check_bounds(content: SpeciesText, faults: FaultList) -> None:
    """Note bounds that allow an impossible wingbeat: a frequency of 0, a negative amplitude."""
    for name, bound in content.free.items():
        for end in bound.bounds:
            number = Numbers()
            number[path_of(name)] = Number(end, "")
            number.written[path_of(name)] = content.written[name]
            before = len(faults.faults)
            build_records(number, number, faults)
            if len(faults.faults) > before:
                break


# The rule in the fault of a path that names no number. A study recognises such a fault by this rule, and so does
# not take it for that of a refused value.
NO_SUCH_PATH = "no number has this path"
# The whole mass is not among them: it follows from body and wings, so a change of it would change another number
# unasked.
_SETTABLE = {
    path: key
    for key in KEYS
    if key.path != "vehicle.mass"
    for spelling in key.spellings
    for path in (spelling, spelling.removeprefix("vehicle."))
}


def settable(path: Any, value: Any, faults: FaultList) -> Key | None:
    """Return the number that a path names, with or without ``vehicle.`` in front, or note a fault."""
    if isinstance(path, str) and path in _SETTABLE:
        return _SETTABLE[path]
    if path in ("mass", "vehicle.mass"):
        fix = "set body.mass or wing.mass; the whole mass follows from both"
    else:
        fix = suggest(str(path), [path for path in _SETTABLE if not path.startswith("vehicle.")])
    faults.add(spoken(path), shown(value), NO_SUCH_PATH, fix)
    return None


def plain(value: Any) -> Any:
    """Return a value as a file would hold it: plain numbers and lists in place of NumPy arrays and tuples."""
    if hasattr(value, "tolist"):
        value = value.tolist()
    return [plain(item) for item in value] if isinstance(value, list | tuple) else value


BY_HAND = "set by hand"  # begins the source of a number that was set after the species was made
_IN_PLACE = f"{BY_HAND} in place of"
DENSITY_ALONE = "air.density is set and air.viscosity is not"  # begins the warning of such air
DERIVED = "derived: "  # begins the source of a number that a scaling law gave
_EXAMPLE = "example"  # source of a number of the template
NOT_MEASURED = "derived by scaling laws, not measured: "  # begins the warning that lists such numbers


def set_by_hand(path: str, old: Number | None) -> str:
    """Return the source of a number that is set in place of an old one."""
    if old is None:
        return BY_HAND
    if old.source.startswith(_IN_PLACE):
        return old.source
    return f"{_IN_PLACE} {words(path, old)}" + (f": {old.source}" if old.source else "")


def find_warnings(
    numbers: Mapping[str, Number],
    drawn: Mapping[str, Number],
    free: tuple[str, ...],
    bounds: Mapping[str, tuple[float, float]],
    vehicle: Vehicle,
    wingbeat: Wingbeat,
) -> tuple[str, ...]:
    """Return one line for each thing that is possible but odd; `drawn` are the numbers of the species' shape."""
    found = []
    for path, number in {**numbers, **drawn}.items():
        values = number.value if isinstance(number.value, tuple) else (number.value,)
        if number.range and not all(number.range[0] <= value <= number.range[1] for value in values):
            name, shown = display(path, number)
            unit = "" if shown.unit == "1" else f" {shown.unit}"
            source = f" ({number.source})" if number.source else ""
            low, high = shown.range or number.range
            outside = f"is outside its plausible range {low:g} to {high:g}{unit}{source}"
            found.append(f"{name} = {words(path, number)} {outside}")
    for name, (low, high) in bounds.items():
        value = parameter(wingbeat, name)
        if not low <= value <= high:
            path = path_of(name)
            guess = words(path, Number(value, plain_unit(name)))
            found.append(f"{path} = {guess} is outside its bounds; the solver starts from the nearer bound")
    laws = {path.removeprefix("vehicle."): n.source for path, n in numbers.items() if n.source.startswith(DERIVED)}
    derived = [path.removeprefix("vehicle.") for path in numbers if path.startswith("vehicle.")]
    if told := [path for path in derived if path in laws]:
        found.append(NOT_MEASURED + ", ".join(told))
    if parts := dict.fromkeys(path.split(".")[1] for path, n in numbers.items() if n.source == _EXAMPLE):
        found.append(f"examples of the template, until their source says otherwise: numbers of {', '.join(parts)}")
    beyond = [f"{path} ({s.partition(OUTSIDE)[2].partition(' (')[0]})" for path, s in laws.items() if OUTSIDE in s]
    if beyond:
        rule = "scaling laws used outside the data they were fitted to, so unreliable"
        found.append(f"{rule}: {'; '.join(beyond)}")
    if vehicle.tail is None and (wingbeat.tail_tilt or "tail_tilt" in free):
        found.append("wingbeat.tail_tilt has no effect: there is no tail; add the table [vehicle.tail]")
    sources = [numbers[path].source if path in numbers else "" for path in ("air.density", "air.viscosity")]
    if [source.startswith(BY_HAND) for source in sources] == [True, False]:
        why = "so Reynolds numbers are those of other air; an altitude and a temperature set both"
        found.append(f"{DENSITY_ALONE}, {why} (--altitude, --temperature, Species.at_altitude)")
    if not free:
        found.append("free: no wingbeat parameter is free, so no orbit can be found; add the table [free]")
    return tuple(found)
