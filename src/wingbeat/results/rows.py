"""An orbit record as rows of label and value, in the units a reader wants: what terminal and page show."""

from __future__ import annotations

import math
from typing import Any

__all__ = ["Rows", "change_rows", "orbit_groups", "power_rows", "stability_rows", "state_rows", "wingbeat_rows"]

Rows = list[tuple[str, str]]

_RATIOS = ("span_retraction", "twist_ratio", "wrist", "downstroke_fraction", "span_harmonics")
# What says that a wingbeat goes without one of the laws beyond the paper's; none of them needs a line then.
_OFF: dict[str, Any] = {
    **dict.fromkeys(("pitch_phase", "sweep_mean", "sweep_amplitude", "sweep_phase", "stroke_plane_tilt"), 0.0),
    **{name: [] for name in ("flap_harmonics", "pitch_harmonics", "span_harmonics")},
    "downstroke_fraction": 0.5,
}


def orbit_groups(record: dict[str, Any]) -> dict[str, Rows]:
    """Return every group of numbers that an orbit record holds, by its title; empty ones have no rows."""
    aero = record.get("aero", {})
    place = f"{record.get('species')} at {_of(record, 'speed', 'm/s')}"
    if record.get("climb"):
        place += f", climbing {_of(record, 'climb', 'm/s')}"
    named = [str(aero[name]) for name in ("coefficients", "extension", "force_point") if name in aero]
    loads = ", ".join([*named, *(["full airspeed"] if aero.get("airspeed") == "full" else [])])
    return {
        "flight": [("species, mean speed", place), ("air loads", loads), *flight_rows(record)],
        "short of an orbit, at the closest beat": shortage_rows(record.get("failed_balance") or []),
        "nearest changes that fly, each by itself": change_rows(record.get("relaxations") or []),
        "wingbeat": wingbeat_rows(record.get("wingbeat", {})),
        "plausible, and the range": plausible_rows(record.get("plausibility") or []),
        "state at the top of the stroke": state_rows(record.get("initial_state", {})),
        "power, both wings": power_rows(record),
        "certificate": certificate_rows(record),
        "stability": stability_rows(record),
    }


def flight_rows(record: dict[str, Any]) -> Rows:
    """Return the numbers of the flight as a whole."""
    names = {"strouhal": "Strouhal number", "reduced_frequency": "reduced frequency", "reynolds": "Reynolds number"}
    rows = [(label, _of(record, name)) for name, label in names.items() if name in record]
    for name, label in (("alpha_quarter_span", "1/4"), ("alpha_three_quarter_span", "3/4")):
        if name in record:
            low, high = (_number(v, "deg", math.degrees(1.0)) for v in record[name])
            rows.append((f"effective alpha at {label} span", f"{low.removesuffix(' deg')} to {high}"))
    if "body_pitch_range" in record:
        rows.append(("range of body pitch", _of(record, "body_pitch_range", "deg")))
    return rows


def plausible_rows(judged: list[dict[str, Any]]) -> Rows:
    """Return each number that is judged, with its range and whether it lies within."""
    rows = []
    for one in judged:
        unit = {"rad": "deg", "1": ""}.get(one["unit"]) or str(one["unit"]).removeprefix("1")
        factor = math.degrees(1.0) if unit == "deg" else 1.0
        low, high = (None if end is None else _number(end, unit, factor) for end in (one["low"], one["high"]))
        known = "no range is known"
        if low and high:
            known = f"{low.removesuffix(f' {unit}')} to {high}"
        elif low or high:
            known = f"at least {low}" if low else f"at most {high}"
        outside = ", outside" if one["within"] is False else ""
        rows.append((one["name"].replace("_", " "), f"{_number(one['value'], unit, factor)} ({known}{outside})"))
    return rows


def shortage_rows(shortages: list[dict[str, Any]]) -> Rows:
    """Return which laws of balance fail, and by how much."""
    share = {"N m": "of weight times chord"}
    return [
        (
            s["law"],
            f"{_of(s, 'amount', s['unit'])}, {100 * s['share']:.2g} % {share.get(s['unit'], 'of the weight')}",
        )
        for s in shortages
    ]


def change_rows(changes: list[dict[str, Any]]) -> Rows:
    """Return the changes that fly."""
    return [("or" if i else "either", change["text"]) for i, change in enumerate(changes)]


def wingbeat_rows(beat: dict[str, Any]) -> Rows:
    """Return the numbers of a wingbeat, those of laws that are off left out."""
    units = {"frequency": "Hz", **dict.fromkeys(_RATIOS, "")}
    shown = [name for name in beat if name not in _OFF or beat[name] != _OFF[name]]
    rows = [(name.replace("_", " "), _of(beat, name, units.get(name, "deg"))) for name in shown]
    return [(f"wing {label}" if label.startswith("pitch") else label, value) for label, value in rows]


def state_rows(state: dict[str, Any]) -> Rows:
    """Return the numbers of a state."""
    labels = {
        "x": ("forward position x", "m"),
        "z": ("height z", "m"),
        "body_pitch": ("body pitch, nose up", "deg"),
        "u": ("forward velocity u", "m/s"),
        "w": ("upward velocity w", "m/s"),
        "pitch_rate": ("pitch rate", "deg/s"),
    }
    return [(labels[name][0], _of(state, name, labels[name][1])) for name in state if name in labels]


def power_rows(record: dict[str, Any]) -> Rows:
    """Return means and peaks of power, and per mass where the record tells it."""
    labels = {
        "mean_power": "hinges, mean",
        "mean_positive_power": "hinges, mean of the positive part",
        "peak_power": "hinges, peak",
        "mean_actuator_power": "actuators, mean",
        "peak_actuator_power": "actuators, peak",
    }
    vehicle = record.get("vehicle")
    mass = vehicle["body"]["mass"] + 2 * vehicle["wing"]["mass"] if vehicle else None
    rows = []
    for name, label in labels.items():
        if name in record:
            # The animal's mass is that of body and wings together.
            each = f" ({_number(record[name], 'W/kg', 1 / mass)})" if mass and record[name] is not None else ""
            rows.append((label, _of(record, name, "W") + each))
    if "cost_of_transport" in record:
        rows.append(("cost of transport", _of(record, "cost_of_transport")))
    return rows


def certificate_rows(record: dict[str, Any]) -> Rows:
    """Return how far the orbit can be trusted."""
    closure = record.get("closure") or {}
    rows = []
    if record.get("objective_value") is not None:
        rows.append(("made least", f"{record['objective'].replace('_', ' ')}, {record['objective_value']:.5g}"))
    for constraint, value in (record.get("constraints") or {}).items():
        rows.append((f"kept to {constraint}", _number(value, "", 1.0)))
    if closure:
        units = {"x": "m", "z": "m", "body_pitch": "rad", "u": "m/s", "w": "m/s", "pitch_rate": "rad/s"}
        worst = max(closure, key=lambda name: math.inf if closure[name] is None else abs(closure[name]))
        miss = "lost" if closure[worst] is None else f"{abs(closure[worst]):.1e} {units.get(worst, '')}"
        rows.append(("largest miss when re-flown", f"{miss.strip()}, in {worst}"))
    if record.get("optimality") is not None:
        rows.append(("optimality (largest KKT residual)", f"{record['optimality']:.1e}"))
    if "starts" in record:
        rows.append(("searches, those that ended here", f"{record['starts']}, {record.get('starts_at_best')}"))
        rows.append(("distinct optima met", str(record.get("distinct_optima"))))
    rows.append(("on the bound of", ", ".join(record.get("active_bounds") or []) or "nothing"))
    return rows


def stability_rows(record: dict[str, Any]) -> Rows:
    """Return what the Floquet multipliers say."""
    pairs = record.get("floquet_multipliers") or []
    if not pairs or any(part is None for pair in pairs for part in pair):
        return []
    sizes = [math.hypot(*pair) for pair in pairs]
    rows = [("multipliers, modulus", ", ".join(f"{size:.3g}" for size in sizes))]
    if record.get("stable") is None:
        return [*rows, ("stable", "unknown: the orbit is not certified")]
    rows.append(("stable", "yes" if record["stable"] else "no"))
    growth = math.log(max(sizes)) if max(sizes) > 0 else -math.inf
    if growth:
        time = math.log(2.0) / abs(growth)
        what = "double" if growth > 0 else "halve"
        rows.append((f"a disturbance takes to {what}", f"{time:.3g} beats"))
    return rows


def _of(numbers: dict[str, Any], name: str, unit: str = "") -> str:
    """Return one number of a record in the unit shown."""
    return _number(numbers.get(name), unit, math.degrees(1.0) if unit.startswith("deg") else 1.0)


def _number(value: Any, unit: str, factor: float) -> str:
    if isinstance(value, list | tuple):
        # Of harmonics, a ten-thousandth of a degree is nothing.
        shown = [f"{each * factor:.3g}" if abs(each * factor) >= 1e-4 else "0" for each in value]
        return f"{', '.join(shown)} {unit}".rstrip()
    if value is None:
        return "-"  # undefined, as a cost of transport in hover
    shown = value * factor
    return f"{shown:{'.0f' if 1e4 <= abs(shown) < 1e7 else '.4g'}} {unit}".rstrip()
