"""Numbers as people write them: a species file, and ``PATH=VALUE``, with every fault noted; the built-in files."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from importlib import resources
from typing import Any

from wingbeat._base import FaultList, FileError, toml_tables
from wingbeat.animal.species.file_schema import KINDS, check_shape, dotted, has_shape
from wingbeat.animal.species.numbers import (
    ALL_SPEEDS,
    FREE,
    KEYS,
    LOOKS,
    NOTHING,
    PARTS,
    PATH,
    PLAUSIBLE,
    SHAPE,
    STATION_MASSES,
    WING,
    Alternative,
    Bound,
    Key,
    Number,
    Numbers,
    OwnFrequency,
    Range,
    ShapeText,
    SpeciesText,
    shown,
    spoken,
    to_si,
)

_TEMPLATE = "template"


def packaged_text(name: str) -> str:
    """Return the text of a TOML file that the package contains."""
    return resources.files("wingbeat").joinpath("data", f"{name}.toml").read_text(encoding="utf-8")


def template() -> str:
    """Return a complete, commented species file to start from; it can be loaded without changes.

    >>> "semi_span" in template()
    True
    """
    return packaged_text(_TEMPLATE)


def robot_tables() -> str:
    """Return the template's commented tables of parts and wings that a robot may have: all but those of an animal.

    >>> "# [vehicle.motor]" in robot_tables(), "# [vehicle.muscle]" in robot_tables()
    (True, False)
    """
    wings = template().replace("\n\n# Behind", "\n\n# [vehicle.wing]\n# Behind")
    optional = [part for part in wings.split("\n\n") if "# [vehicle." in part]
    return "\n\n".join(part.rstrip() for part in optional if "# [vehicle.muscle]" not in part) + "\n"


def species_names() -> tuple[str, ...]:
    """Return the names of the built-in species.

    >>> species_names()[:3]
    ('annas-hummingbird', 'barn-swallow', 'bat')
    """
    files = (entry.name for entry in resources.files("wingbeat").joinpath("data").iterdir())
    names = {name.removesuffix(".toml") for name in files if name.endswith(".toml")}
    return tuple(sorted(names - {_TEMPLATE}))


def parse_toml(text: str, label: str) -> dict[str, Any]:
    """Return the tables of a TOML text, or raise a `FileError`: empty, not TOML, or nested too deeply."""
    raw = toml_tables(text, label)
    if not raw:
        raise FileError(f"{label!r} holds nothing; `wingbeat species new FILE` writes a template to start from")
    return raw


def read_species_text(
    text: str, label: str, name: str, faults: FaultList, *, packaged: bool = False
) -> SpeciesText:
    """Return the content of a species file; note its faults and leave out the entries that have them.

    The label is the file's name for messages, the name that of the species if the file gives none. A text that is
    not TOML at all raises a `FileError`. Tests check the shape of `packaged` files: to do it here takes 0.1 s.
    """
    raw = parse_toml(text, label)
    if not packaged:
        check_shape(raw, faults)
    own, common, scientific = (_line(raw.get(part)) for part in ("name", "common_name", "scientific_name"))
    result = SpeciesText(own or name, common, scientific, raw["kind"] if raw.get("kind") in KINDS else "")
    result.numbers = _numbers(raw, (), faults)
    _note_missing(raw, faults)
    result.free = _bounds(raw, FREE, result.written, faults)
    result.path = _bounds(raw, PATH, result.written, faults)
    result.plausible = _plausible(raw, faults)
    result.frequencies = _frequencies(raw, faults)
    result.shape = _shape(raw, faults)
    alternatives = raw.get("alternatives")
    for other, content in (alternatives if isinstance(alternatives, dict) else {}).items():
        if isinstance(content, dict):
            numbers = _numbers(content, ("alternatives", other), faults)
            result.alternatives[other] = Alternative(_line(content.get("reason")), numbers)
    return result


def _line(text: Any) -> str:
    """Return a text on one line, as messages and tables need it; an empty text if it is not a text."""
    return " ".join(text.split()) if isinstance(text, str) else ""


def _leaf(raw: dict[str, Any], path: str) -> Any:
    """Return the value at a path, or None."""
    place: Any = raw
    for part in path.split("."):
        place = place.get(part) if isinstance(place, dict) else None
    return place


def _spelt(raw: dict[str, Any], key: Key, prefix: tuple[str, ...], faults: FaultList) -> Iterator[tuple[str, Any]]:
    """Yield the path and the value of a key for each of its names that the file uses."""
    found = [(path, leaf) for path in key.spellings if (leaf := _leaf(raw, path)) is not None]
    if len(found) > 1:
        where = dotted((*prefix, *found[1][0].split(".")))
        faults.add(where, shown(_value(found[1][1])), f"is given as {key.path} too", "keep one of the two")
    yield from found[:1]


def _value(leaf: Any, name: str = "value") -> Any:
    return leaf.get(name) if isinstance(leaf, dict) else leaf


def _numbers(raw: dict[str, Any], prefix: tuple[str, ...], faults: FaultList) -> Numbers:
    numbers = _values(raw, KEYS, prefix, faults)
    if "vehicle.mass" in numbers and "vehicle.body.mass" in numbers:
        where, value = numbers.written["vehicle.body.mass"]
        faults.add(where, value, "cannot be combined with vehicle.mass", "keep one: the other follows from it")
    return numbers


def _values(raw: dict[str, Any], keys: Iterable[Key], prefix: tuple[str, ...], faults: FaultList) -> Numbers:
    numbers = Numbers()
    for key in keys:
        for path, leaf in _spelt(raw, key, prefix, faults):
            where, value = dotted((*prefix, *path.split("."))), _value(leaf)
            table = leaf if isinstance(leaf, dict) else {}
            _check_unit(where, table.get("unit"), key, path, faults)
            limits = _range(f"{where}.range", table.get("range"), path, faults)
            _check_angles(f"{where}.range", limits or (), key, path, faults)
            if has_shape(key.shape, value):
                number = Number(to_si(value, path), key.unit, _line(table.get("source")), limits)
                numbers.put(key, number, where, value)
    return numbers


def _shape(raw: dict[str, Any], faults: FaultList) -> ShapeText | None:
    if not isinstance(raw.get("shape"), dict):
        return None
    for key in (*LOOKS, *SHAPE):
        if key.required and _leaf(raw, key.path) is None:
            fix = f"{key.meaning} [{key.unit}]" if key.unit else key.meaning
            faults.add(key.path, NOTHING, "must be given", fix)
    texts = {key.path: _leaf(raw, key.path) for key in LOOKS if has_shape(key.shape, _leaf(raw, key.path))}
    return ShapeText(_values(raw, SHAPE, (), faults), texts)


def _note_missing(raw: dict[str, Any], faults: FaultList) -> None:
    weighed = _leaf(raw, STATION_MASSES) is not None
    for key in KEYS:
        needed = key.required or (key.path == WING and not weighed)
        if needed and all(_leaf(raw, path) is None for path in key.spellings):
            section = _leaf(raw, key.path.rpartition(".")[0])
            if isinstance(section, dict) or (section is None and key.part not in PARTS):
                names = " or ".join(key.spellings)
                faults.add(names, NOTHING, "must be given", f"{key.meaning} [{key.unit}]")
    if all(_leaf(raw, path) is None for path in ("vehicle.mass", "vehicle.body.mass")):
        fix = "or give vehicle.body.mass, the mass without the wings [kg]"
        faults.add("vehicle.mass", NOTHING, "must be given", fix)


def _bounds(
    raw: dict[str, Any], keys: Iterable[Key], written: dict[str, tuple[str, Any]], faults: FaultList
) -> dict[str, Bound]:
    bounds = {}
    for key in keys:
        for path, leaf in _spelt(raw, key, (), faults):
            table, pair = leaf if isinstance(leaf, dict) else {}, _value(leaf, "bounds")
            _check_unit(path, table.get("unit"), key, path, faults)
            if (limits := _range(path, pair, path, faults)) is None:
                continue
            if key in PATH:  # those of the wingbeat are checked with the wingbeats that they allow
                _check_angles(path, limits, key, path, faults)
            if limits[0] == limits[1]:
                faults.add(path, pair, "has equal lower and upper bounds", "widen them, or leave the parameter out")
            bounds[key.name] = Bound(limits, _line(table.get("reason")), table.get("guessed") is True)
            written[key.name] = (path, pair)
    return bounds


def _plausible(raw: dict[str, Any], faults: FaultList) -> dict[str, Range]:
    found = {}
    for key in PLAUSIBLE:
        for path, table in _spelt(raw, key, (), faults):
            if not isinstance(table, dict):
                continue
            _check_unit(path, table.get("unit"), key, path, faults)
            ends = [table.get(end) for end in ("low", "high")]
            low, high = (to_si(end, path) if has_shape("number", end) else None for end in ends)
            if low is not None and high is not None and low > high:  # type: ignore[operator]
                faults.add(path, ends, "has a low end above its high end", "swap the two")
            _check_angles(path, [end for end in (low, high) if end is not None], key, path, faults)
            speeds = _range(f"{path}.speeds", table.get("speeds"), f"{path}.speeds", faults)
            found[key.name] = Range(low, high, key.unit, _line(table.get("source")), speeds)  # type: ignore[arg-type]
    return found


def _frequencies(raw: dict[str, Any], faults: FaultList) -> list[OwnFrequency]:
    """Return the entries of ``[[frequencies]]``; their speeds may not overlap."""
    given = raw.get("frequencies")
    found: list[OwnFrequency] = []
    for i, table in enumerate(given if isinstance(given, list) else []):
        where, known = f"frequencies[{i}]", table if isinstance(table, dict) else {}
        limits = _range(f"{where}.range", known.get("range"), "frequencies.range", faults)
        speeds = _range(f"{where}.speeds", known.get("speeds"), "frequencies.speeds", faults) or ALL_SPEEDS
        value, basis = known.get("value"), known.get("basis")
        if known.get("unit") not in (None, "", "Hz"):
            faults.add(f"{where}.unit", shown(known["unit"]), "must be 'Hz'", "give the value in this unit")
        if limits is None or not has_shape("number", value) or basis not in ("measured", "law"):
            continue  # the shape's own faults are noted
        if not 0 < limits[0] <= value <= limits[1]:  # type: ignore[operator]
            rule = f"must be above 0 and within its range, {limits[0]:g} to {limits[1]:g} Hz"
            faults.add(f"{where}.value", value, rule)
        if basis == "measured" and not _line(known.get("source")):
            faults.add(f"{where}.source", NOTHING, "must be given of what was measured", "say who measured it")
        for j, other in enumerate(found):
            first, last = max(speeds[0], other.speeds[0]), min(speeds[1], other.speeds[1])
            single = speeds[0] == speeds[1] or other.speeds[0] == other.speeds[1]
            if first < last or (first == last and single):
                fix = "give each frequency speeds of its own"
                faults.add(f"{where}.speeds", list(speeds), f"overlap with those of frequencies[{j}]", fix)
        found.append(OwnFrequency(float(value), limits, basis, _line(known.get("source")), speeds))  # type: ignore[arg-type]
    return found


def _range(where: str, pair: Any, path: str, faults: FaultList) -> tuple[float, float] | None:
    """Return a pair of numbers in SI units, or None if the value is not a pair."""
    if not has_shape("stations", pair) or not isinstance(pair, list) or len(pair) != 2:
        return None
    lowest, highest = (to_si(value, path) for value in pair)
    if lowest > highest:  # type: ignore[operator]
        faults.add(where, pair, "has the highest value first", "write [lowest, highest]")
    return lowest, highest  # type: ignore[return-value]


def _check_angles(where: str, ends: Iterable[Any], key: Key, path: str, faults: FaultList) -> None:
    """Note ends of a range that are angles too large to be in radians."""
    if key.unit == "rad" and not path.endswith("_deg"):
        for end in ends:
            faults.angle(where, end)


def _check_unit(where: str, unit: Any, key: Key, path: str, faults: FaultList) -> None:
    expected = "deg" if path.endswith("_deg") else key.unit
    # m^2, m² and m**2 are m2.
    plain = str.maketrans("²³", "23", "*^ ·")
    if isinstance(unit, str) and unit and unit.translate(plain) != expected.translate(plain):
        faults.add(f"{where}.unit", unit, f"must be {expected!r}", "give the value in this unit")


def parse_setting(text: str) -> tuple[str, Any]:
    """Return path and value of a setting such as ``wing.mass=0.02`` or ``wing.chord=[0.1, 0.08]``.

    Raises
    ------
    InvalidInputError : not of the form PATH=VALUE, or the value is neither a number nor a list of numbers.

    >>> parse_setting("wing.mass=0.02")
    ('wing.mass', 0.02)
    """
    path, equals, value = (part.strip() for part in text.partition("="))
    faults = FaultList()
    if not equals or not path:
        faults.add("--set", text, "must be PATH=VALUE", "for example wing.mass=0.02")
        faults.raise_if_any()
    try:
        return path, float(value)  # more lenient than TOML: .02 and 1. are numbers too
    except ValueError:
        pass
    try:
        table = parse_toml(f"value = {value}", value)
    except FileError:
        table = {}
    if list(table) != ["value"] or not isinstance(table["value"], list):
        faults.add(spoken(path), value, "is not a number or a list of numbers", "for example 0.02 or [0.1, 0.08]")
        faults.raise_if_any()
    return path, table["value"]
