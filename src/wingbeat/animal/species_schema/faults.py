"""Faults in our own words: where, value, rule and fix in place of what pydantic says."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable
from typing import Any

from pydantic import ValidationError

from wingbeat._base import FaultList, suggest
from wingbeat.animal.species_schema.keys import FREE, KEYS, LOOKS, NO_COLOUR, PATH, PLAUSIBLE, SHAPE, Key
from wingbeat.animal.species_schema.models import (
    ADAPTERS,
    NUMBER_FIELDS,
    TABLE,
    TAGS,
    BoundTable,
    RangeTable,
    SpeciesFile,
)

MAX_FAULTS = 100


class Shown(str):
    """Words that a fault shows in place of a value."""

    def __repr__(self) -> str:
        return str(self)


NOTHING = Shown("nothing")


def shown(value: Any) -> Any:
    """Return a value in a form that prints on one line; Python cannot print some values of a file (10**5000)."""
    flat = isinstance(value, list | tuple) and all(isinstance(item, int | float) for item in value)
    try:
        text = repr(value) if flat or not isinstance(value, dict | list | tuple) else ""
    except ValueError:
        return Shown("an enormous number")
    if isinstance(value, dict):
        return Shown("a table")
    if isinstance(value, list | tuple):
        return Shown(text) if flat else Shown("a list")
    return value if isinstance(value, str | int | float) else Shown(str(value))


def dotted(path: Iterable[Any]) -> str:
    """Return a path of keys and list indices as TOML would write it, on one line."""
    text = ""
    for part in path:
        if isinstance(part, int):
            text += f"[{part}]"
        elif part not in TAGS:
            bare = re.fullmatch(r"[A-Za-z0-9_-]+", part)
            text += "." * bool(text) + (part if bare else json.dumps(part))[:80]
    return text


def spoken(path: Any) -> str:
    """Return a path that the user typed: unchanged if it can be printed, else in quotes with escapes."""
    text = str(shown(path))
    return text if text.isprintable() and text.strip() and len(text) <= 80 else json.dumps(text)[:80]


def check_shape(raw: dict[str, Any], faults: FaultList) -> None:
    """Note every wrong key, type and shape in the content of a TOML file."""
    try:
        SpeciesFile.model_validate(raw)
    except ValidationError as error:
        _translate(error, "", faults)


def check_value(key: Key, where: str, value: Any, faults: FaultList) -> bool:
    """Note a fault unless `value` has the shape of `key`; return whether it has."""
    try:
        ADAPTERS[key.shape].validate_python(value)
    except ValidationError as error:
        _translate(error, where, faults)
        return False
    return True


def has_shape(shape: str, value: Any) -> bool:
    """Return whether a value has one of the shapes of a `Key`."""
    try:
        ADAPTERS[shape].validate_python(value)
    except ValidationError:
        return False
    return True


def _translate(error: ValidationError, where: str, faults: FaultList) -> None:
    """Note pydantic's errors at or below `where` as our faults."""
    found = error.errors(include_url=False)
    for fault in found[:MAX_FAULTS]:
        value, loc = fault["input"], fault["loc"]
        rule, fix = rule_of(fault["type"], value, fault.get("ctx", {}))
        if fault["type"] == "missing":
            value = NOTHING
        elif fault["type"] == "extra_forbidden":
            fix = suggest(str(loc[-1]), _known_keys(loc[:-1]))
        faults.add(where + dotted(loc), shown(value), rule, fix)
    if len(found) > MAX_FAULTS:
        faults.add("file", Shown(f"{len(found)} faults"), "too many to list", "is it a species file?")


def rule_of(kind: str, value: Any, context: dict[str, Any]) -> tuple[str, str]:
    """Return the rule and the fix for one of pydantic's kinds of error."""
    match kind:
        case "missing":
            return "must be given", ""
        case "extra_forbidden":
            return "is not a known key", ""
        case "float_type" if isinstance(value, int) and not isinstance(value, bool):
            return "is too large a number", ""
        case "float_type" if isinstance(value, str):
            return "must be a number", "write the number without quotes; its unit goes into unit = ..."
        case "float_type":
            return "must be a number", ""
        case "finite_number":
            return "must be finite", ""
        case "string_type":
            return "must be a text", "put it in quotes"
        case "string_pattern_mismatch":
            return NO_COLOUR
        case "string_too_short":
            return "must not be empty", ""
        case "bool_type":
            return "must be true or false", ""
        case "literal_error":
            return f"must be one of {context['expected']}".replace("'", ""), ""
        case "list_type":
            return "must be a list of numbers", ""
        case "too_short" | "too_long":
            least, most = context.get("min_length"), context.get("max_length")
            size = f"at least {least}" if kind == "too_short" else f"at most {most}"
            return f"must hold {size} numbers", ""
        case "model_type" | "dict_type":
            return "must be a table", ""
    return f"does not match the schema ({kind})", ""


def _known_keys(loc: tuple[Any, ...]) -> list[str]:
    """Return the keys that the table at this place may have."""
    place = [part for part in loc if isinstance(part, str)]
    if place[:1] == ["alternatives"] and len(place) > 1:
        if len(place) == 2:
            return ["reason", "vehicle", "wingbeat", "air"]
        place = place[2:]
    if TABLE in place:
        return list(BoundTable.model_fields) if place[0] in ("free", "path") else NUMBER_FIELDS
    if len(place) == 2 and place[0] == "plausible":
        return list(RangeTable.model_fields)
    paths = [path for key in (*KEYS, *SHAPE, *LOOKS, *FREE, *PLAUSIBLE, *PATH) for path in key.spellings]
    if not place:
        return list(SpeciesFile.model_fields)
    depth = len(place)
    return list(dict.fromkeys(p.split(".")[depth] for p in paths if p.split(".")[:depth] == place))
