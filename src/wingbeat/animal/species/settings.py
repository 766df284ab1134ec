"""Numbers set by hand: ``PATH=VALUE`` on a command line, ``{path: value}`` in Python."""

from __future__ import annotations

from typing import Any

from wingbeat._base import FaultList, FileError, suggest
from wingbeat.animal.species_schema import KEYS, Key, parse_toml, shown, spoken

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
