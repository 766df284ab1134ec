"""The parts of an orbit's power as rows of a table."""

from __future__ import annotations

import math
from typing import Any


def power_groups(account: dict[str, Any] | None) -> dict[str, list[tuple[str, str]]]:
    """Return a power account as groups of rows; no groups if there is no account."""
    if account is None:
        return {}
    costs = [(_fate(share), _watts(cost)) for share, cost in account["cost_by_returned"]]
    spring = account["best_spring"]
    if spring["rest_angle"] is None:
        springs = [("best stiffness", "none: no spring helps")]
    else:
        saved = 1.0 - spring["mean_positive_power"] / account["mean_positive_power"]
        springs = [
            ("best stiffness, both hinges together", f"{spring['stiffness']:.4g} N m/rad"),
            ("flap angle at rest", f"{math.degrees(spring['rest_angle']):.4g} deg"),
            ("remaining mean positive power", f"{_watts(spring['mean_positive_power'])} ({saved:.1%} less)"),
        ]
    return {
        "mean power, by what happens to negative work": [("negative work", _watts(account["braking"])), *costs],
        "parts of the hinge power: mean, minimum, maximum": _spreads(account["shares"]),
        "what the power of all actuators is spent on: mean, minimum, maximum": _spreads(account["spent"]),
        "springs at the flap hinges": springs,
    }


def _spreads(parts: dict[str, dict[str, float]]) -> list[tuple[str, str]]:
    return [
        (name, ", ".join(_watts(part[key]) for key in ("mean", "least", "most"))) for name, part in parts.items()
    ]


def _fate(returned: float) -> str:
    named = {-1.0: "if it costs as much as positive work", 0.0: "if it is lost"}
    return named.get(returned, f"if {returned:.0%} of it is returned")


def _watts(value: float | None) -> str:
    return "-" if value is None else f"{value:.4g} W"
