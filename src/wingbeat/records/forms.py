"""The form of each kind of result that is read again: its attributes, variables and record, with their types."""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

from wingbeat._base import (
    KIND,
    NOMENCLATURE,
    OVER,
    SERIES,
    SERIES_WHERE_ON,
    SHAPE,
    STATE_NAMES,
    control_in,
    is_number,
    over_of,
)
from wingbeat.animal.species.file_schema import KINDS
from wingbeat.records.judgements import is_judgement, statements

if TYPE_CHECKING:
    import xarray as xr

Dims = tuple[str, ...]
_STRIP, _VECTOR = ("phase", "station"), ("phase", "station", "axis")
# Dimensions of the series of a flight; a series that is not listed has one number per phase.
SERIES_DIMS: dict[str, Dims] = {
    **{name: (name,) for name in ("station", "axis", "corner")},
    **dict.fromkeys(("strip_position", "strip_velocity", "strip_force"), _VECTOR),
    **dict.fromkeys(("strip_speed", "strip_reynolds", "alpha", "lift", "drag", "wake_downwash"), _STRIP),
    "strip_corner": ("phase", "station", "corner", "axis"),
}
_TEXTS, _WHOLE, _REAL = "OUT", "iu", "f"


class _Variable(NamedTuple):
    """Dimensions of a variable, and the kinds of its data type."""

    dims: Dims
    kinds: str = _REAL


class _Form(NamedTuple):
    """What a kind of result holds."""

    attributes: dict[str, type]  # type of each attribute that it needs; dictionaries and lists are JSON
    needed: dict[str, _Variable]
    others: dict[str, _Variable]  # that it may have beside them
    any_over: Dims | None  # dimensions that any other variable of real numbers may have
    lengths: dict[str, int]  # of dimensions that are always the same


def _series(name: str) -> _Variable:
    return _Variable(SERIES_DIMS.get(name, ("phase",)), _TEXTS if name in ("axis", "corner") else _REAL)


_FLOWN: Any = (
    {term.name: _series(term.name) for term in SERIES},
    {term.name: _series(term.name) for term in SERIES_WHERE_ON},
    None,
    {"axis": 3, "corner": 4},
)


def _curve(over: str, others: tuple[str, ...], attributes: dict[str, type]) -> _Form:
    """Return the form of a curve over speed or frequency, with its other numbers and attributes."""
    points: Dims = over, "optimum"
    needed = {
        over: _Variable((over,)),
        "optimum": _Variable(("optimum",), _WHOLE),
        "family": _Variable(points, _WHOLE),
        "continued": _Variable(("interval", "optimum", "optimum_above"), _WHOLE),
        **dict.fromkeys(("active_bounds", "outside_ranges"), _Variable(points, _TEXTS)),
        **dict.fromkeys(("status", "message", "warnings"), _Variable((over,), _TEXTS)),
        **dict.fromkeys(("starts", "distinct_optima", "refined"), _Variable((over,), _WHOLE)),
        **dict.fromkeys(
            ("objective_value", "mean_power", "mean_positive_power", "peak_power", "flap_amplitude", *others),
            _Variable(points),
        ),
    }
    attributes = {
        **dict.fromkeys(("vehicle", "aero", "air", "inputs"), dict),
        **dict.fromkeys(("constraints", "marks", "warnings"), list),
        **dict.fromkeys(("species", "objective", "version", "inputs_hash"), str),
        **dict.fromkeys(("climb", "solve_seconds"), float),
        **attributes,
    }
    return _Form(attributes, needed, {}, points, {})


_RECORDED = ("status", "message", "species", "objective", "version")
# An orbit's other attributes are those of its record; `storage.parse_attributes` knows their types.
FORMS = {
    "orbit": _Form({"inputs": dict, **dict.fromkeys((*_RECORDED, "inputs_hash"), str)}, *_FLOWN),
    "flight": _Form({"vehicle": dict, "air": dict, "wingbeat": dict, "version": str}, *_FLOWN),
    "curve": _curve("speed", ("frequency",), {}),
}
_OVER_FREQUENCY = _curve("frequency", (), {OVER: str, "speed": float})


def check_form(dataset: xr.Dataset) -> None:
    """Check types and dimensions of all attributes and variables of an orbit, a flight or a curve."""
    form = FORMS[dataset.attrs[KIND]] if over_of(dataset.attrs) == "speed" else _OVER_FREQUENCY
    faults = [f"{name} is missing" for name in form.needed if name not in dataset.variables]
    known = form.needed | form.others
    for name, variable in dataset.variables.items():
        rule = known.get(str(name))
        if rule is None and not (variable.dims == form.any_over and variable.dtype.kind in _REAL):
            faults.append(f"{name!r:.60} does not belong to a result of this kind")
        elif rule is not None and (variable.dims != rule.dims or variable.dtype.kind not in rule.kinds):
            faults.append(f"{name} is of another type or shape")
        if 0 in variable.shape and rule is not None and "interval" not in rule.dims:
            faults.append(f"{name} is empty")
    faults += [f"{name} has not {n} items" for name, n in form.lengths.items() if dataset.sizes.get(name, n) != n]
    for name, kind in form.attributes.items():
        try:
            good = _is_of(dataset.attrs[name], kind)
        except (LookupError, ValueError, RecursionError):
            good = False
        if not good:
            faults.append(f"the attribute {name} is missing or of another type")
    if SHAPE in dataset.attrs and not _is_shape(dataset.attrs[SHAPE]):
        faults.append("the attribute shape is of another type")
    texts = [v.values.ravel().tolist() for v in dataset.variables.values() if v.dtype.kind in _TEXTS]
    held = [*texts, *(_content(value) for value in dataset.attrs.values())]
    held += [variable.attrs for variable in dataset.variables.values()]
    if (control := control_in(held)) is not None:
        faults.append(f"a text holds the control character {control!r}")
    if faults:
        raise ValueError("; ".join(faults[:3]) + (f"; and {len(faults) - 3} more" if len(faults) > 3 else ""))


def _content(value: Any) -> Any:
    """Return what an attribute holds: the content of a JSON text, in which control characters are escapes."""
    try:
        return [value, json.loads(value)] if isinstance(value, str) else None
    except (ValueError, RecursionError):
        return value


def _is_shape(text: Any) -> bool:
    """Return whether a text says how an animal looks, as `results.record.shape_attribute` writes it."""
    if not _is_of(text, dict):
        return False
    known = from_json(text)
    edges = [known.pop(name) for name in ("leading_edge", "trailing_edge") if name in known]
    colours = known.pop("colours", {})
    kinds = {**dict.fromkeys(("kind", "cover"), str), "schematic": bool}
    return (
        all(isinstance(edge, list) and len(edge) > 1 and all(map(is_number, edge)) for edge in edges)
        and isinstance(colours, dict)
        and all(isinstance(colour, str) for colour in colours.values())
        and all(isinstance(v, kinds[n]) if n in kinds else is_number(v) for n, v in known.items())
        and known.get("kind", "") in ("", *KINDS)
    )


def _is_of(value: Any, kind: type) -> bool:
    if kind is str:
        return isinstance(value, str)
    if kind is float:
        number = value.item() if hasattr(value, "item") else value
        return is_number(number) and math.isfinite(number)
    return isinstance(value, str) and isinstance(from_json(value), kind)


def from_json(text: str) -> Any:
    """Return the content of a JSON text whose numbers are finite."""
    return json.loads(text, parse_float=_finite, parse_constant=_finite)


def _finite(text: str) -> float:
    if not math.isfinite(number := float(text)):
        raise ValueError(f"{text} is not a finite number")
    return number


# What a record holds that is not a number.
_KINDS: dict[str, tuple[type, ...]] = {
    **dict.fromkeys(("status", "message", "species", "objective", "frequency_basis", "version"), (str,)),
    **dict.fromkeys(
        ("model", "vehicle", "aero", "air", "wingbeat", "initial_state", "closure", "constraints", "start"), (dict,)
    ),
    "hinge_start": (dict,),
    **dict.fromkeys(
        ("active_bounds", "failed_balance", "relaxations", "plausibility", "warnings", "trace"), (list,)
    ),
    **dict.fromkeys(("floquet_multipliers", "alpha_quarter_span", "alpha_three_quarter_span"), (list,)),
    "inputs": (dict,),
}


def _is_known(value: Any) -> bool:
    return value is None or is_number(value)


def _are_known(value: dict[str, Any]) -> bool:
    return all(map(_is_known, value.values()))


def _is_range(value: list[Any]) -> bool:
    return len(value) == 2 and all(map(_is_known, value))


def _are_deficits(value: list[Any]) -> bool:
    return all({*one} == {"law", "share", "amount", "unit"} for one in value) and all(
        isinstance(one["law"], str) and is_number(one["share"]) and is_number(one["amount"]) for one in value
    )


def _is_start(value: dict[str, Any]) -> bool:
    return (
        {*value} == {"kind", "values", "notes", "led_here"}
        and isinstance(value["kind"], str)
        and value["led_here"] in (True, False, None)
        and isinstance(value["values"], dict)
        and all(map(is_number, value["values"].values()))
        and isinstance(value["notes"], list)
        and all(isinstance(note, str) for note in value["notes"])
    )


_STEP = ("search", "stage", "iteration", "objective", "residual", "step")


def _are_steps(value: list[Any]) -> bool:
    return all(
        isinstance(one, dict)
        and (*one,) == _STEP
        and isinstance(one["stage"], str)
        and isinstance(one["search"], int)
        and all(_is_known(one[name]) for name in _STEP if name != "stage")
        for one in value
    )


# What the items of dictionaries and lists must be.
_ITEMS: dict[str, Callable[[Any], bool]] = {
    **dict.fromkeys(("initial_state", "closure"), lambda value: {*value} == {*STATE_NAMES} and _are_known(value)),
    **dict.fromkeys(("active_bounds", "warnings"), lambda value: all(isinstance(item, str) for item in value)),
    **dict.fromkeys(("alpha_quarter_span", "alpha_three_quarter_span"), _is_range),
    "constraints": _are_known,
    "hinge_start": lambda value: {*value} == {"hinge_angle", "hinge_rate"} and _are_known(value),
    "floquet_multipliers": lambda value: all(isinstance(pair, list) and _is_range(pair) for pair in value),
    "failed_balance": _are_deficits,
    "plausibility": is_judgement,
    "start": _is_start,
    "trace": _are_steps,
}


def orbit_attributes(record: dict[str, Any], inputs: dict[str, Any]) -> dict[str, Any]:
    """Return a record, statements on it and its inputs: numbers and texts unchanged, everything else as JSON."""
    plain = {name for name, value in record.items() if _KINDS.get(name) == (str,) or is_number(value)}
    return {
        KIND: "orbit",
        **{name: value if name in plain else json.dumps(value) for name, value in record.items()},
        **said_of(record),
        "inputs": json.dumps(inputs),
        "inputs_hash": inputs_hash(inputs),
    }


def said_of(record: dict[str, Any]) -> dict[str, str]:
    """Return the statements on closure and plausibility, as attributes."""
    said = statements(record)
    return {"statement_of_closure": said.closes, "statement_of_plausibility": said.plausible}


def parse_attributes(attributes: dict[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return record and inputs from the attributes of an orbit."""
    record = {}
    for name, value in attributes.items():
        if name not in _KINDS and name not in NOMENCLATURE:
            continue
        kind = _KINDS.get(name, (int, float, type(None)))
        if kind != (str,):
            value = from_json(value) if isinstance(value, str) else value.item()
        if not isinstance(value, kind) or (isinstance(value, float) and not math.isfinite(value)):
            raise ValueError(f"{name} is {value!r:.60}")
        if not _ITEMS.get(name, lambda _: True)(value):
            raise ValueError(f"{name} holds something else than it should")
        record[name] = value
    inputs = record.pop("inputs")
    if attributes["inputs_hash"] != inputs_hash(inputs):
        raise ValueError("the inputs do not match their hash")
    return record, inputs


def inputs_hash(inputs: dict[str, Any]) -> str:
    """Return the SHA-256 of the inputs; the order of the inputs does not matter."""
    return hashlib.sha256(json.dumps(inputs, sort_keys=True).encode()).hexdigest()
