"""Scenarios as texts: the query of a permalink and a JSON file, both read back strictly."""

from __future__ import annotations

import base64
import binascii
import dataclasses
import json
import re
import zlib
from collections.abc import Callable, Sequence
from typing import Any
from urllib.parse import parse_qsl, urlencode

from wingbeat._base import Fault, FaultList, FileError, InvalidInputError
from wingbeat_explorer.app.checked import (
    NO_YES,
    every,
    finite,
    number_in,
    switch,
    table,
    text_of,
    truth_in,
    value_in,
    word,
)
from wingbeat_explorer.app.scenario import LARGEST_FILE, Scenario

# Servers and browsers accept addresses of 16 kB and more; a species file takes some 6 kB.
_LONGEST_QUERY = 24_000
_VERSION = 1
_NUMBERS = ("speed", "climb", "blend_width_deg", "induced_factor", "hand_from", "upstroke_factor")
_WHOLE = ("strips", "starts", "seed")
_SWITCHES = ("within_plausible",)
_WORDS = (
    "species",
    "model",
    "aero",
    "extension",
    "force_point",
    "airspeed",
    "unsteady",
    "inflow",
    "hand",
    "minimise",
)


def to_query(scenario: Scenario) -> str:
    """Return the query of a permalink: values that differ from the defaults, and the compressed species file."""
    empty, words = Scenario(), []
    for name in (*_WORDS, *_NUMBERS, *_WHOLE):
        value = getattr(scenario, name)
        if value != getattr(empty, name) or name in ("species", "model", "speed"):
            words.append((name, value if isinstance(value, str) else repr(value)))
    words += [(name, NO_YES[True]) for name in _SWITCHES if getattr(scenario, name)]
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
    """Return the scenario of a permalink.

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
    elif name not in (*_WORDS, *_NUMBERS, *_WHOLE, *_SWITCHES, "sweep", "species_file"):
        parts = (*_WORDS, *_NUMBERS, *_WHOLE, *_SWITCHES, "sweep", "species_file", "limit", "bound", "set")
        faults.add(name[:60], text[:60], "is not part of a link", f"the parts of a link are {', '.join(parts)}")
    elif name in plain:
        faults.add(name, text[:60], "is given twice", "keep one of them")
    elif name in _WORDS:
        plain[name] = text
    elif name in _SWITCHES:
        plain[name] = truth_in(text)
        if plain[name] is None:
            faults.add(name, text[:60], "must be yes or no")
    elif name == "species_file":
        plain[name] = _unpacked(text, faults)
    else:
        parts = [number_in(part) for part in text.split(":")] if name == "sweep" else [number_in(text)]
        if None in parts:
            faults.add(name, text[:60], "must be numbers" if name == "sweep" else "must be a number")
        elif name in _WHOLE:
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
    known = {"values" if name == "set" else name for name in plain} if isinstance(plain, dict) else set()
    if not isinstance(plain, dict) or not known <= {f.name for f in dataclasses.fields(Scenario)}:
        odd = sorted(str(name)[:40] for name in known - {f.name for f in dataclasses.fields(Scenario)})
        what = ", ".join(odd[:5]) if isinstance(plain, dict) else type(plain).__name__
        faults.add("state", what, "is not a state of the explorer", "load a file that the explorer saved")
        faults.raise_if_any()
    given: dict[str, Any] = {}
    checks: dict[str, Callable[[Any], Any]] = {
        **dict.fromkeys(_WORDS, word),
        **dict.fromkeys(_NUMBERS, finite),
        **dict.fromkeys(_WHOLE, lambda value: value),  # the scenario's own check names the range
        **dict.fromkeys(_SWITCHES, switch),
        "species_file": text_of,
        "limits": lambda value: every(value, word),
        "sweep": lambda value: found if (found := every(value, finite)) and len(found) == 3 else None,
        "bounds": lambda value: table(
            value, lambda pair: p if (p := every(pair, finite)) and len(p) == 2 else None
        ),
        "set": lambda value: table(value, lambda v: every(v, finite) if isinstance(v, list) else finite(v)),
    }
    for name, value in plain.items():
        understood = checks[name](value)
        if understood is None and not (name == "starts" and value is None):
            faults.add(name, repr(value)[:60], "is not understood", "save the state again")
        else:
            given["values" if name == "set" else name] = understood
    faults.raise_if_any()
    scenario = Scenario(**given)
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
