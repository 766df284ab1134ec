"""Numbers of an orbit against their plausible ranges, in the units that readers prefer."""

from __future__ import annotations

from typing import Any

from wingbeat._base import cf, for_people
from wingbeat.records.judgements import JUDGED_NAMES, set_by_limit


def gauges_of(record: dict[str, Any]) -> list[dict[str, Any]]:
    """Return the gauges of an orbit record: one for each number of its ``plausibility``.

    Each has name, label, value, unit, low, high, inside, limited and source. Angles are in degrees. An end of a
    range that is open or unknown is None. `inside` is None if the number has no value, such as the Strouhal number
    in hover, or if nothing is known of its range. `limited` says whether a limit has set the number, or it follows
    from a limit.

    Parameters
    ----------
    record : from `Orbit.record`.

    >>> judged = {"name": "frequency", "value": 12.0, "unit": "Hz", "low": 4.0, "high": 10.0, "within": False}
    >>> gauge = gauges_of({"plausibility": [judged | {"source": "a law"}]})[0]
    >>> gauge["label"], gauge["value"], gauge["inside"]
    ('Wingbeat frequency', 12.0, False)
    """
    limited = set_by_limit(record)
    return [_gauge(one, one["name"] in limited) for one in record.get("plausibility") or []]


def _gauge(judged: dict[str, Any], limited: bool) -> dict[str, Any]:
    factor, unit = for_people(cf(judged["unit"]))
    value, low, high = (None if part is None else factor * part for part in (judged[n] for n in _NUMBERS))
    known = low is not None or high is not None
    label = JUDGED_NAMES[judged["name"]]
    return {
        "name": judged["name"],
        "label": "Wingbeat frequency" if label == "frequency" else label[:1].upper() + label[1:],
        "value": value,
        "unit": unit,
        "low": low,
        "high": high,
        "inside": judged["within"] if known else None,
        "limited": limited,
        "source": " ".join(judged["source"].split()),
    }


_NUMBERS = ("value", "low", "high")
