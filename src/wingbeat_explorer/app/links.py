"""Scenarios as texts: the query of a permalink and a JSON file, both read back strictly."""

from __future__ import annotations

import base64
import binascii
import dataclasses
import json
import math
import re
import zlib
from collections.abc import Sequence
from typing import Any
from urllib.parse import parse_qsl, urlencode

from pydantic import TypeAdapter, ValidationError

from wingbeat._base import Fault, FaultList, FileError, InvalidInputError
from wingbeat.aero.polar_formats import POLAR_SUFFIXES
from wingbeat_explorer.app.formatting import clean_label
from wingbeat_explorer.app.scenario import LARGEST_FILE, NUMBERS, SWITCHES, WHOLE, WORDS, Scenario

# Servers and browsers accept addresses of 16 kB and more; a species file takes some 6 kB.
_LONGEST_QUERY = 24_000
_VERSION = 1
_LONGEST_NUMBER = 40  # characters
NO_YES = ("no", "yes")  # a truth value as a text
_PARTS = (*WORDS, *NUMBERS, *WHOLE, *SWITCHES, "sweep", "species_file")  # of a link, beside those that come often
_CHECKED = TypeAdapter(Scenario)


def to_query(scenario: Scenario) -> str:
    """Return the query of a permalink: values that differ from the defaults, and the compressed species file.

    It has the name of a file of coefficients, not its text.
    """
    empty, words = Scenario(), []
    for name in (*WORDS, *NUMBERS, *WHOLE):
        value = getattr(scenario, name)
        if value != getattr(empty, name) or name in ("species", "model", "speed"):
            words.append((name, value if isinstance(value, str) else repr(value)))
    words += [(name, NO_YES[True]) for name in SWITCHES if getattr(scenario, name)]
    if scenario.species_file:
        packed = zlib.compress(scenario.species_file.encode(), 9)
        words.append(("species_file", base64.urlsafe_b64encode(packed).decode().rstrip("=")))
    words += [("limit", text) for text in scenario.limits]
    words += [("bound", f"{name}:{low!r}:{high!r}") for name, (low, high) in scenario.bounds.items()]
    words += [("set", f"{path}={_written(value)}") for path, value in scenario.values.items()]
    if scenario.sweep != empty.sweep:
        words.append(("sweep", ":".join(repr(part) for part in scenario.sweep)))
    return urlencode(words, safe=":=[],")


def from_query(query: str) -> Scenario:
    """Return the scenario of a permalink; it may name a file of coefficients, which its `faults` then ask for.

    Raises
    ------
    InvalidInputError : everything in it that is not understood, and every invalid choice.
    """
    faults = FaultList()
    if len(query) > _LONGEST_QUERY:
        faults.add("link", f"{len(query)} characters", f"must be at most {_LONGEST_QUERY}", "load the JSON file")
        faults.raise_if_any()
    plain: dict[str, Any] = {"limits": [], "bounds": {}, "set": {}}
    try:
        pairs = parse_qsl(
            query, keep_blank_values=True, strict_parsing=bool(query), errors="strict", max_num_fields=200
        )
    except ValueError:
        raise InvalidInputError([Fault("link", query[:60], "is not a query", "copy the whole link")]) from None
    for name, text in pairs:
        _read_pair(plain, name, text, faults)
    faults.raise_if_any()
    if plain.get("aero", "").lower().endswith(POLAR_SUFFIXES):
        scenario = from_plain({name: value for name, value in plain.items() if name != "aero"})
        return dataclasses.replace(scenario, aero=clean_label(plain["aero"]))
    return from_plain(plain)


def _read_pair(plain: dict[str, Any], name: str, text: str, faults: FaultList) -> None:
    """Store one ``name=text`` of a query, or note its fault."""
    if name == "limit":
        plain["limits"].append(text)
    elif name in ("bound", "set"):
        path, *ends = re.split(":" if name == "bound" else "=", text, maxsplit=2 if name == "bound" else 1)
        values = [number_in(end) for end in ends] if name == "bound" else [value_in(end) for end in ends]
        given = plain["bounds" if name == "bound" else "set"]
        if len(values) != (2 if name == "bound" else 1) or None in values:
            form = "name:lowest:highest" if name == "bound" else "path=number"
            faults.add(name, text, f"must be {form}", "SI units and radians")
        elif path in given:
            faults.add(name, text, "is given twice", "keep one of them")
        else:
            given[path] = values if name == "bound" else values[0]
    elif name not in _PARTS:
        parts = ", ".join((*_PARTS, "limit", "bound", "set"))
        faults.add(name[:60], text[:60], "is not part of a link", f"the parts of a link are {parts}")
    elif name in plain:
        faults.add(name, text[:60], "is given twice", "keep one of them")
    elif name in WORDS:
        plain[name] = text
    elif name in SWITCHES:
        plain[name] = truth_in(text)
        if plain[name] is None:
            faults.add(name, text[:60], "must be yes or no")
    elif name == "species_file":
        plain[name] = _unpacked(text, faults)
    else:
        parts = [number_in(part) for part in text.split(":")] if name == "sweep" else [number_in(text)]
        if None in parts:
            faults.add(name, text[:60], "must be numbers" if name == "sweep" else "must be a number")
        elif name in WHOLE:
            plain[name] = int(parts[0]) if parts[0] == round(parts[0] or 0.0) else parts[0]  # type: ignore[arg-type]
        else:
            plain[name] = parts if name == "sweep" else parts[0]


def _unpacked(text: str, faults: FaultList) -> str:
    """Return the species file in a link; unpacking stops at the size limit."""
    try:
        packed = base64.b64decode(text + "=" * (-len(text) % 4), altchars=b"-_", validate=True)
        opener = zlib.decompressobj()
        content = opener.decompress(packed, LARGEST_FILE)
        if opener.eof and not opener.unused_data:
            return content.decode()
    except (ValueError, binascii.Error, zlib.error):
        pass
    faults.add("species_file", text[:40], "is not a packed species file", "copy the whole link")
    return ""


def to_plain(scenario: Scenario) -> dict[str, Any]:
    """Return a scenario as a dictionary fit for JSON."""
    plain = dataclasses.asdict(scenario)
    plain["set"] = plain.pop("values")
    return json.loads(json.dumps(plain))


def from_plain(plain: Any) -> Scenario:
    """Return the scenario of a dictionary from `to_plain`; absent keys take the default of an empty page.

    Raises
    ------
    InvalidInputError : another form, unknown names, invalid choices; all at once.
    """
    faults = FaultList()
    known = {"set" if f.name == "values" else f.name for f in dataclasses.fields(Scenario)}
    if not isinstance(plain, dict) or not plain.keys() <= known:
        odd = sorted(str(name)[:40] for name in plain.keys() - known) if isinstance(plain, dict) else []
        what = ", ".join(odd[:5]) if odd else type(plain).__name__
        faults.add("state", what, "is not a state of the explorer", "load a file that the explorer saved")
        faults.raise_if_any()
    try:
        scenario = _CHECKED.validate_python({"values" if name == "set" else name: v for name, v in plain.items()})
    except ValidationError as error:
        wrong = {each["loc"][0] for each in error.errors(include_url=False)}
        for name, value in plain.items():
            if ("values" if name == "set" else name) in wrong:
                faults.add(name, repr(value)[:60], "is not understood", "save the state again")
        raise InvalidInputError(faults.faults) from None
    scenario.faults().raise_if_any()
    return scenario


def to_json(scenario: Scenario) -> str:
    """Return a scenario as the text of a JSON file."""
    head = {"wingbeat_explorer": _VERSION, "units": "SI units and radians"}
    return json.dumps({**head, "state": to_plain(scenario)}, indent=2, allow_nan=False)


def from_json(text: str, label: str) -> Scenario:
    """Return the scenario of a JSON file.

    Raises
    ------
    FileError : not JSON, or not a scenario. InvalidInputError : as in `from_plain`.
    """
    try:
        whole = json.loads(text)
    except (ValueError, RecursionError):
        raise FileError(f"cannot read {label!r} as JSON; load a file that the explorer saved") from None
    if not isinstance(whole, dict) or whole.get("wingbeat_explorer") != _VERSION:
        raise FileError(f"cannot read {label!r}: it is not a saved state; load a file that the explorer saved")
    return from_plain(whole.get("state"))


def _written(value: float | Sequence[float]) -> str:
    return repr(float(value)) if isinstance(value, int | float) else json.dumps(list(value)).replace(" ", "")


def number_in(text: str) -> float | None:
    """Return the finite number that a text is."""
    try:
        value = float(text) if len(text) < _LONGEST_NUMBER else math.nan
    except ValueError:
        return None
    return value if math.isfinite(value) else None


def value_in(text: str) -> float | list[Any] | None:
    """Return the number or the list of numbers, in brackets, that a text is."""
    if not text.startswith("["):
        return number_in(text)
    parts = [number_in(part) for part in text[1:-1].split(",")] if text.endswith("]") and text != "[]" else []
    return parts if parts and None not in parts else None


def truth_in(text: str) -> bool | None:
    """Return the truth value that a text is."""
    return text == NO_YES[True] if text in NO_YES else None
