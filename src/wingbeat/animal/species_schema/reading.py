"""Read the text of a species file into numbers in SI units, and note every fault of the file."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from wingbeat._base import IN_RADIANS, Fault, FaultList, FileError, toml_tables
from wingbeat.animal.species_schema.faults import NOTHING, check_shape, dotted, has_shape, shown
from wingbeat.animal.species_schema.keys import FREE, KEYS, LOOKS, PARTS, PATH, PLAUSIBLE, SHAPE, Key
from wingbeat.animal.species_schema.models import KINDS

Value = float | tuple[float, ...]
# The rule for an angle in radians, for one that the file gives in degrees.
_IN_DEGREES = {
    rule: f"must be an angle from {-most:.0f} to {most:.0f} degrees"
    for most, rule in ((math.degrees(most), rule) for most, rule in IN_RADIANS.items())
}


class Number(NamedTuple):
    """A number in SI units and radians, its unit, its source and its plausible range."""

    value: Value
    unit: str
    source: str = ""
    range: tuple[float, float] | None = None


def number_from(value: Any, unit: str, source: str, limits: list[float] | None) -> Number:
    """Return the number that JSON keeps as a list of these four."""
    whole = tuple(value) if isinstance(value, list) else value
    return Number(whole, unit, source, None if limits is None else (limits[0], limits[1]))


class Bound(NamedTuple):
    """The bounds of a free quantity in SI units and radians, the reason, and whether they are a guess."""

    bounds: tuple[float, float]
    reason: str = ""
    guessed: bool = False


class Range(NamedTuple):
    """The plausible range of a quantity, SI and radians; an unknown end is None.

    `speeds` are the lowest and highest flight speed at which it applies [m/s]; None means all speeds.
    """

    low: float | None = None
    high: float | None = None
    unit: str = "1"
    source: str = ""
    speeds: tuple[float, float] | None = None


class Numbers(dict[str, Number]):
    """Numbers by path, with the original text of each, so that a fault can quote it."""

    def __init__(self) -> None:
        super().__init__()
        self.written: dict[str, tuple[str, Any]] = {}

    def put(self, key: Key, number: Number, path: str, value: Any) -> None:
        """Add a number that was written as `value` under `path`."""
        self[key.path] = number
        self.written[key.path] = (path, value)

    def quote(self, fault: Fault) -> Fault:
        """Return a fault that a constructor found, with the path, value and unit that the file uses."""
        where = fault.where if fault.where.startswith(("wingbeat.", "air.", "shape.")) else f"vehicle.{fault.where}"
        for canonical, (path, value) in self.written.items():
            rest = where[len(canonical) :]
            if where.startswith(canonical) and rest[:1] in ("", "[", "."):
                told = fault.value if rest else shown(value)
                if not path.endswith("_deg"):
                    return Fault(path + rest, told, fault.rule, fault.fix)
                if fault.rule in _IN_DEGREES:
                    return Fault(path + rest, told, _IN_DEGREES[fault.rule])
                return Fault(path + rest, told, fault.rule.replace(" rad", " deg"), fault.fix)
        return Fault(where, fault.value, fault.rule, fault.fix)


class Alternative(NamedTuple):
    """Measured or assumed numbers that may replace the defaults, and why they are worth a trial."""

    reason: str
    numbers: Numbers


class ShapeText(NamedTuple):
    """How the animal looks: numbers by path, and texts by path (what covers the wing, and the colours)."""

    numbers: Numbers
    texts: dict[str, str]


@dataclass
class SpeciesText:
    """The content of a species file, before any check of its physics."""

    name: str
    common_name: str = ""
    scientific_name: str = ""
    kind: str = ""
    numbers: Numbers = field(default_factory=Numbers)
    free: dict[str, Bound] = field(default_factory=dict)
    path: dict[str, Bound] = field(default_factory=dict)
    plausible: dict[str, Range] = field(default_factory=dict)
    shape: ShapeText | None = None
    alternatives: dict[str, Alternative] = field(default_factory=dict)
    written: dict[str, tuple[str, Any]] = field(default_factory=dict)  # each bound's path and pair


def parse_toml(text: str, label: str) -> dict[str, Any]:
    """Return the tables of a TOML text.

    Raises
    ------
    FileError : empty, not TOML, or nested too deeply.
    """
    raw = toml_tables(text, label)
    if not raw:
        raise FileError(f"{label!r} holds nothing; `wingbeat species new FILE` writes a template to start from")
    return raw


def read_species_text(text: str, label: str, name: str, faults: FaultList) -> SpeciesText:
    """Return the content of a species file; note its faults and leave out the entries that have them.

    Parameters
    ----------
    text, label : the TOML text, and the name of the file for messages.
    name : the name of the species if the file gives none.
    faults : receives every fault of keys, types, shapes and units, and every missing key.

    Raises
    ------
    FileError : not TOML at all.
    """
    raw = parse_toml(text, label)
    check_shape(raw, faults)
    result = SpeciesText(name)
    result.name = _line(raw.get("name")) or name
    result.common_name = _line(raw.get("common_name"))
    result.scientific_name = _line(raw.get("scientific_name"))
    result.kind = kind if (kind := raw.get("kind")) in KINDS else ""
    result.numbers = _numbers(raw, (), faults)
    _note_missing(raw, faults)
    result.free = _bounds(raw, FREE, result.written, faults)
    result.path = _bounds(raw, PATH, result.written, faults)
    result.plausible = _plausible(raw, faults)
    result.shape = _shape(raw, faults)
    alternatives = raw.get("alternatives")
    for other, content in (alternatives if isinstance(alternatives, dict) else {}).items():
        if isinstance(content, dict):
            reason = content.get("reason")
            numbers = _numbers(content, ("alternatives", other), faults)
            result.alternatives[other] = Alternative(_line(reason), numbers)
    return result


def to_si(value: Any, path: str) -> Value:
    """Return a number or list of the right shape in SI units; `path` shows whether it is in degrees."""
    if isinstance(value, list):
        return tuple(float(to_si(item, path)) for item in value)  # type: ignore[arg-type]
    return math.radians(value) if path.endswith("_deg") else float(value)


def display(path: str, number: Number) -> tuple[str, Number]:
    """Return path and number for readers: angles are in degrees, with ``_deg`` in the path."""
    if number.unit != "rad":
        return path, number

    def degrees(angle: float) -> float:
        return float(f"{math.degrees(angle):.12g}")  # 60 comes back as 60, not 59.99999999999999

    limits = number.range and (degrees(number.range[0]), degrees(number.range[1]))
    angles = number.value
    shown = tuple(degrees(angle) for angle in angles) if isinstance(angles, tuple) else degrees(angles)
    return f"{path}_deg", Number(shown, "deg", number.source, limits)


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
            faults.add(
                key.path, NOTHING, "must be given", f"{key.meaning} [{key.unit}]" if key.unit else key.meaning
            )
    texts = {key.path: _leaf(raw, key.path) for key in LOOKS if has_shape(key.shape, _leaf(raw, key.path))}
    return ShapeText(_values(raw, SHAPE, (), faults), texts)


def _note_missing(raw: dict[str, Any], faults: FaultList) -> None:
    for key in KEYS:
        if key.required and all(_leaf(raw, path) is None for path in key.spellings):
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
    if isinstance(unit, str) and unit and _tidy(unit) != _tidy(expected):
        faults.add(f"{where}.unit", unit, f"must be {expected!r}", "give the value in this unit")


def _tidy(unit: str) -> str:
    """Return a unit in its plain form: m^2, m² and m**2 become m2."""
    for old, new in (("**", ""), ("^", ""), ("²", "2"), ("³", "3"), (" ", ""), ("·", ""), ("*", "")):
        unit = unit.replace(old, new)
    return unit
