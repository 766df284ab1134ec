"""Characteristic speeds of a power curve: minimum power, maximum range, and the fastest within a power limit."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

# Speeds are `within_2_percent` if their value exceeds the minimum by at most this share.
_FLAT = 0.02


def characteristic_speeds(
    speed: np.ndarray, power: np.ndarray, joined: np.ndarray, power_limit: float | None = None
) -> dict[str, Any]:
    """Return the speeds of minimum power and of maximum range, and the slowest and fastest within a power limit.

    Parameters
    ----------
    speed, power : the curve [m/s, W], shape (K,), increasing in speed; power is not-a-number where there is a gap.
    joined : whether each point and the next belong to one branch, shape (K - 1,).
    power_limit : [W].

    Returns
    -------
    ``minimum_power``; ``maximum_range``, where power divided by speed is smallest (the tangent from the origin);
    and, with a limit, ``fastest_sustained`` and ``slowest_sustained``. An entry is None if the curve has no such
    speed. Each entry holds ``speed`` [m/s], ``power`` [W], ``at_edge`` (the range of speeds ends there or a gap
    begins, so the true speed may lie beyond) and ``jump_beside`` (the curve changes branch there). The first two
    also hold ``within_2_percent``: the speeds between which the minimised value is within 2 % of its minimum.

    >>> u = np.arange(4.0, 13.0)
    >>> found = characteristic_speeds(u, 60 / u + 0.01 * u**3, np.ones(8, bool))
    >>> f"{found['minimum_power']['speed']:.1f}"
    '6.7'
    """
    moving = speed > 0
    found: dict[str, Any] = {
        "minimum_power": _least(speed, power, joined, power, lambda square, slope, _: -0.5 * slope / square),
        "maximum_range": _least(
            speed,
            np.where(moving, power / np.where(moving, speed, 1.0), np.nan),
            joined,
            power,
            lambda square, _, level: math.sqrt(max(level / square, 0.0)),
        ),
    }
    if power_limit is not None:
        found["fastest_sustained"] = _crossing(speed, power, joined, power_limit)
        mirrored = _crossing(-speed[::-1], power[::-1], joined[::-1], power_limit)
        found["slowest_sustained"] = mirrored and mirrored | {"speed": -mirrored["speed"] + 0.0}
    return found


def _least(
    speed: np.ndarray,
    value: np.ndarray,
    joined: np.ndarray,
    power: np.ndarray,
    lowest: Callable[[float, float, float], float],
) -> dict[str, Any] | None:
    """Return where a value is smallest.

    If the lowest point and its two neighbours belong to one branch, the power between the neighbours is
    approximated by the parabola ``square U^2 + slope U + level`` through the three points. `lowest` takes the
    parabola's coefficients and returns the speed at which the value is smallest.
    """
    good = np.isfinite(value)
    if not good.any():
        return None
    k = int(np.nanargmin(value))
    low, high = k > 0 and good[k - 1], k + 1 < len(value) and good[k + 1]
    jump = bool((low and not joined[k - 1]) or (high and not joined[k]))
    at, watts = float(speed[k]), float(power[k])
    if low and high and not jump:
        around = slice(k - 1, k + 2)
        square, slope, level_at_rest = (float(c) for c in np.polyfit(speed[around], power[around], 2))
        if square > 0:
            at = min(max(lowest(square, slope, level_at_rest), float(speed[k - 1])), float(speed[k + 1]))
            watts = (square * at + slope) * at + level_at_rest
    level = float(value[k]) * (1 + _FLAT) if value[k] > 0 else float(value[k])
    return {
        "speed": at,
        "power": watts,
        "at_edge": not (low and high),
        "jump_beside": jump,
        "within_2_percent": [_reach(speed, value, k, -1, level), _reach(speed, value, k, 1, level)],
    }


def _reach(speed: np.ndarray, value: np.ndarray, start: int, way: int, level: float) -> float:
    """Return the first speed in one direction at which the value rises above a level, or else the last speed."""
    here = start
    while 0 <= here + way < len(value) and np.isfinite(value[here + way]):
        there = here + way
        if value[there] > level:
            share = (level - value[here]) / (value[there] - value[here])
            return float(speed[here] + share * (speed[there] - speed[here]))
        here = there
    return float(speed[here])


def _crossing(speed: np.ndarray, power: np.ndarray, joined: np.ndarray, limit: float) -> dict[str, Any] | None:
    """Return the largest speed at which the power is within the limit."""
    within = np.flatnonzero(power <= limit)
    if not within.size:
        return None
    k = int(within[-1])
    beyond = k + 1 < len(speed) and bool(np.isfinite(power[k + 1]))
    jump = beyond and not joined[k]
    at, watts = float(speed[k]), float(power[k])
    if beyond and not jump:
        at, watts = _reach(speed, power, k, 1, limit), limit
    return {"speed": at, "power": watts, "at_edge": not beyond, "jump_beside": bool(jump)}
