"""Numbers of an orbit against their plausible ranges, in the units that readers prefer."""

from __future__ import annotations

from typing import Any

from wingbeat.nomenclature import cf, for_people

# What the explorer shows, in its order, and how it is called there.
GAUGES = {
    "positive_power_per_mass": "Power per mass",
    "frequency": "Wingbeat frequency",
    "flap_amplitude": "Flap amplitude",
    "strouhal": "Strouhal number",
    "reynolds": "Reynolds number",
}


def gauges_of(record: dict[str, Any]) -> list[dict[str, Any]]:
    """Return the gauges of an orbit record: name, label, value, unit, low, high, inside and source of each.

    Angles are in degrees. An end of a range that is open or unknown is None. `inside` is None if the number has no
    value, such as the Strouhal number in hover, or if nothing is known of its range.

    Parameters
    ----------
    record : from `Orbit.record`.

    >>> judged = {"name": "frequency", "value": 12.0, "unit": "Hz", "low": 4.0, "high": 10.0, "within": False}
    >>> gauge = gauges_of({"plausibility": [judged | {"source": "a law"}]})[0]
    >>> gauge["label"], gauge["value"], gauge["inside"]
    ('Wingbeat frequency', 12.0, False)
    """
    judged = {one["name"]: one for one in record.get("plausibility") or []}
    return [_gauge(judged[name], label) for name, label in GAUGES.items() if name in judged]


def _gauge(judged: dict[str, Any], label: str) -> dict[str, Any]:
    factor, unit = for_people(cf(judged["unit"]))
    value, low, high = (None if part is None else factor * part for part in (judged[n] for n in _NUMBERS))
    known = low is not None or high is not None
    return {
        "name": judged["name"],
        "label": label,
        "value": value,
        "unit": unit,
        "low": low,
        "high": high,
        "inside": judged["within"] if known else None,
        "source": " ".join(judged["source"].split()),
    }


_NUMBERS = ("value", "low", "high")
