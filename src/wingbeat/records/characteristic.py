"""Characteristic speeds or frequencies of a curve: where the minimised quantity is least, what muscle allows."""

from __future__ import annotations

import itertools
import json
import math
import re
import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._base import PRECISION, over_of
from wingbeat.records.inputs import species_from

if TYPE_CHECKING:
    import xarray as xr

# Speeds are `within_2_percent` if their value exceeds the minimum by at most this share.
_FLAT = 0.02
# Over frequency, power is flatter than over speed, and what varies an animal's frequency is not power.
_FLAT_IN_FREQUENCY = 0.05
# Another minimum within this share of the least is practically as good: warnings of orbits use the same share.
_RIVAL = 0.01
# Points on each side of the lowest that show how much optima scatter about a smooth curve.
_WINDOW = 3


class BestLine(NamedTuple):
    """The best orbits along speed, or frequency, shape (K,)."""

    quantity: str  # name of the minimised quantity
    is_power: bool  # whether it is a mean power, which divided by speed is least at the speed of maximum range
    speed: np.ndarray  # increasing [m/s], or the frequency [Hz]
    value: np.ndarray  # the minimised quantity, not-a-number in gaps
    joined: np.ndarray  # whether each point and the next belong to one branch, shape (K - 1,)
    limits: Sequence[frozenset[str]]  # names of the bounds and limits that each orbit has reached
    others: np.ndarray  # of other families of optima, shape (F, K), not-a-number where a family has no optimum

    def sought(self) -> dict[str, bool]:
        """Return the names of the minima that the curve has, and whether each is that of the value over speed."""
        if self.is_power:
            return {"minimum_power": False, "maximum_range": True}
        return {"maximum_range" if self.quantity == "cost_of_transport" else f"minimum_{self.quantity}": False}

    def over(self, speed: bool) -> BestLine:
        """Return this line, or that of the value divided by speed, which hover has not."""
        if not speed:
            return self
        moving = np.where(self.speed > 0, self.speed, np.nan)
        return self._replace(value=self.value / moving, others=self.others / moving)

    def mirrored(self) -> BestLine:
        """Return the line along minus the speed."""
        back = {name: getattr(self, name)[::-1] for name in ("value", "joined", "limits")}
        return self._replace(speed=-self.speed[::-1], others=self.others[:, ::-1], **back)

    def reaches(self, k: int, way: int) -> bool:
        """Whether point k and its neighbour in one direction belong to one branch."""
        there = k + way
        return 0 <= there < len(self.value) and bool(np.isfinite(self.value[there]) and self.joined[min(k, there)])

    def smooth_piece(self, k: int) -> slice:
        """Return the points about point k that belong to its branch and have the same active limits."""
        ends = []
        for way in (-1, 1):
            end = k
            while abs(end - k) < _WINDOW and self.reaches(end, way) and self.limits[end + way] == self.limits[k]:
                end += way
            ends.append(end)
        return slice(ends[0], ends[1] + 1)


def characteristic_speeds(line: BestLine, power_limit: float | None = None) -> dict[str, Any]:
    """Return the speeds at which the minimised quantity is least, and those that a power limit allows.

    Power over speed is least at ``maximum_range``, on the tangent from the origin. Each speed has ``speed`` [m/s],
    its error bar ``interval`` [m/s], ``value`` (the minimised quantity) and ``status``: ``found``; ``at_or_below``
    or ``at_or_above`` the end of the curve; ``beside_jump`` or ``beside_gap``, where no speed is given;
    ``set_by_limit``, where a limit has set the minimised quantity itself. A minimum also has ``lowest`` (the
    computed speed with the least value), ``limits`` (that are active there), ``changed_limits`` (active on one side
    of it only), ``rivals`` (other minima within 1 %) and ``within_2_percent``: the speeds between which the value
    is within 2 % of its minimum.

    The error bar covers the neighbours of the lowest point, between which a smooth branch has its minimum; all
    speeds at which a smooth curve is above its minimum by less than twice the scatter of the optima about it; and
    the rivals.
    """
    found: dict[str, Any] = {name: _least(line, line.over(speed)) for name, speed in line.sought().items()}
    if power_limit is not None and line.is_power:
        found["fastest_sustained"] = _crossing(line, power_limit)
        slowest = _crossing(line.mirrored(), power_limit)
        found["slowest_sustained"] = slowest and slowest | {
            "status": slowest["status"].replace("above", "below"),
            "speed": None if slowest["speed"] is None else -slowest["speed"] + 0.0,
            "interval": slowest["interval"]
            and [None if u is None else -u + 0.0 for u in slowest["interval"][::-1]],
        }
    return found


def next_speeds(line: BestLine, tolerance: float, power_limit: float | None = None) -> list[float]:
    """Return the speeds to solve at next, none twice, so that characteristic speeds get near neighbours.

    A minimum is sought by successive parabolas, and then enclosed from both sides; a crossing by the chord. What is
    enclosed, or cannot be (at an end, beside a jump, at a limit), needs no speed.
    """
    asked: list[float] = []
    for over_speed in line.sought().values():
        asked += _toward_least(line.over(over_speed), tolerance)
    if power_limit is not None and line.is_power:
        asked += _toward_crossing(line, power_limit, tolerance)
        asked += [-u for u in _toward_crossing(line.mirrored(), power_limit, tolerance)]
    decimals = max(0, 1 - math.floor(math.log10(tolerance)))
    known = list(line.speed)
    chosen = []
    for speed in asked:
        rounded = round(speed, decimals)
        if min(abs(rounded - u) for u in known) > 0.2 * tolerance:
            known.append(rounded)
            chosen.append(rounded)
    return chosen


def _lowest(line: BestLine) -> int | None:
    return int(np.nanargmin(line.value)) if np.isfinite(line.value).any() else None


def _toward_least(line: BestLine, tolerance: float) -> list[float]:
    k = _lowest(line)
    if k is None or _status(line, k) != "found":
        return []
    low, mid, high = (float(u) for u in line.speed[k - 1 : k + 2])
    wide = 1.001 * tolerance
    if max(mid - low, high - mid) <= wide:
        return []
    vertex = _vertex(line.speed[k - 1 : k + 2], line.value[k - 1 : k + 2])
    if abs(vertex - mid) > 0.5 * tolerance:
        return [min(max(vertex, low + 0.5 * tolerance), high - 0.5 * tolerance)]
    return [u for u, room in ((mid - tolerance, mid - low > wide), (mid + tolerance, high - mid > wide)) if room]


def _toward_crossing(line: BestLine, limit: float, tolerance: float) -> list[float]:
    k = _last_within(line, limit)
    if k is None or not line.reaches(k, 1) or line.speed[k + 1] - line.speed[k] <= 1.001 * tolerance:
        return []
    at = _chord(line, k, limit)
    return [u for u in (at - 0.5 * tolerance, at + 0.5 * tolerance) if line.speed[k] < u < line.speed[k + 1]]


def _vertex(speed: np.ndarray, value: np.ndarray) -> float:
    """Return where the parabola through three points is least; the middle speed if it is not."""
    square, slope, _ = np.polyfit(speed - speed[1], value, 2)
    return float(speed[1] - 0.5 * slope / square) if square > 0 else float(speed[1])


def _status(line: BestLine, k: int) -> str:
    """Return what can be said of a minimum at point k."""
    last = len(line.value) - 1
    if line.quantity in line.limits[k]:
        return "set_by_limit"
    sides = [(way, k + way) for way in (-1, 1) if 0 <= k + way <= last]
    if any(np.isfinite(line.value[there]) and not line.reaches(k, way) for way, there in sides):
        return "beside_jump"
    # Hover has no power over speed, but it is no gap.
    if any(np.isnan(line.value[there]) and line.speed[there] > 0 for _, there in sides):
        return "beside_gap"
    if len(sides) == 2 and all(np.isfinite(line.value[there]) for _, there in sides):
        return "found"
    return "at_or_above" if k == last else "at_or_below"


def _least(whole: BestLine, line: BestLine) -> dict[str, Any] | None:
    """Return where the value of a line is least; `whole` is that before it was divided by speed."""
    k = _lowest(line)
    if k is None:
        return None
    status, here = _status(line, k), float(line.speed[k])
    bounds = {"at_or_below": [None, here], "at_or_above": [here, None]}
    at, interval, rivals = None, bounds.get(status), []
    if status == "found":
        at, interval, rivals = _enclosed(line, k)
    sides = [line.limits[n] for n in (k - 1, k + 1) if 0 <= n < len(line.value)]
    level = float(line.value[k]) * (1 + _FLAT) if line.value[k] > 0 else float(line.value[k])
    return {
        "status": status,
        "speed": at,
        "interval": interval,
        "value": float(whole.value[k]),
        "lowest": here,
        "limits": sorted(line.limits[k]),
        "changed_limits": sorted(sides[0] ^ sides[-1]) if status == "found" else [],
        "rivals": rivals,
        "within_2_percent": [_reach(line, k, -1, level), _reach(line, k, 1, level)],
    }


def _enclosed(line: BestLine, k: int) -> tuple[float, list[float], list[float]]:
    """Return the speed of a minimum between two neighbours of its branch, its error bar, and rivals."""
    low, here, high = (float(u) for u in line.speed[k - 1 : k + 2])
    piece = line.smooth_piece(k)
    speed, value = line.speed[piece], line.value[piece]
    at, ends = here, [low, high]
    if piece.start < k < piece.stop - 1:  # otherwise the minimum is where a limit begins to act
        at = _vertex(line.speed[k - 1 : k + 2], line.value[k - 1 : k + 2])
        degree = 3 if len(speed) > 5 else 2
        spare = len(speed) - degree - 1
        if spare > 0:
            shifted = speed - here
            smooth = np.polynomial.Polynomial.fit(shifted, value, degree)
            scatter = math.sqrt(float(np.sum((smooth(shifted) - value) ** 2)) / spare)
            fine = np.linspace(shifted[0], shifted[-1], 2001)
            along = smooth(fine)
            if degree > 2:  # another parabola would be worse than that through the neighbours
                at = here + float(fine[along.argmin()])
            near = fine[along <= along.min() + max(2.0 * scatter, PRECISION * abs(line.value[k]))]
            ends += [here + float(near[0]), here + float(near[-1])]
    rivals = _rivals(line, k)
    ends += rivals
    return min(max(at, low), high), [min(ends), max(ends)], rivals


def _rivals(line: BestLine, k: int) -> list[float]:
    """Return the speeds of other minima, of the best orbits or of other families, within 1 % of the least."""
    level = line.value[k] + _RIVAL * abs(line.value[k])
    found = set()
    for values in (line.value, *line.others):
        for n in range(1, len(values) - 1):
            around = values[n - 1 : n + 2]
            enclosed = abs(line.speed[n] - line.speed[k]) <= line.speed[k + 1] - line.speed[k - 1]
            if np.isfinite(around).all() and around[1] == around.min() and around[1] <= level and not enclosed:
                found.add(float(line.speed[n]))
    return sorted(found)


def _reach(line: BestLine, start: int, way: int, level: float) -> float:
    """Return the first speed in one direction at which the value rises above a level, or else the last speed."""
    here = start
    while 0 <= here + way < len(line.value) and np.isfinite(line.value[here + way]):
        there = here + way
        if line.value[there] > level:
            share = (level - line.value[here]) / (line.value[there] - line.value[here])
            return float(line.speed[here] + share * (line.speed[there] - line.speed[here]))
        here = there
    return float(line.speed[here])


def _last_within(line: BestLine, limit: float) -> int | None:
    within = np.flatnonzero(line.value <= limit)
    return int(within[-1]) if within.size else None


def _chord(line: BestLine, k: int, limit: float) -> float:
    low, high = line.value[k : k + 2]
    return float(line.speed[k] + (limit - low) / (high - low) * (line.speed[k + 1] - line.speed[k]))


def _crossing(line: BestLine, limit: float) -> dict[str, Any] | None:
    """Return the largest speed at which the value is within a limit."""
    k = _last_within(line, limit)
    if k is None:
        return None
    here, at = float(line.speed[k]), None
    if k + 1 == len(line.value):
        status, interval = "at_or_above", [here, None]
    elif line.reaches(k, 1):
        at, status, interval = _chord(line, k, limit), "found", [here, float(line.speed[k + 1])]
    else:
        status, interval = ("beside_jump" if np.isfinite(line.value[k + 1]) else "beside_gap"), None
    return {"status": status, "speed": at, "interval": interval, "value": limit}


def with_characteristic(dataset: xr.Dataset, inputs: dict[str, Any]) -> xr.Dataset:
    """Return the data set of a curve with the speeds or frequencies that follow from it as an attribute."""
    if over_of(dataset.attrs) == "frequency":
        return dataset.assign_attrs(
            characteristic_frequencies=json.dumps(_characteristic_frequencies(dataset, inputs))
        )
    found = speeds_of(dataset, inputs["power_limit"])
    return dataset.assign_attrs(characteristic_speeds=json.dumps(found))


def speeds_of(dataset: xr.Dataset, power_limit: float | None) -> dict[str, Any]:
    """Return the characteristic speeds of a curve, and of a robot those of best endurance and range.

    These two are of the electrical power of the curve's orbits or, if there is a battery, of its discharge at each
    speed. Without a battery they are left out where the electrical power is minimised: they are
    ``minimum_power`` and ``maximum_range``.
    """
    line = best_line(dataset)
    found = characteristic_speeds(line, power_limit)
    plain = line._replace(is_power=False, others=line.others[:0])
    if "endurance" in dataset:
        for name, column in (("best_endurance", "endurance"), ("best_range", "flight_range")):
            lasts = dataset[column].values[:, 0]
            lasts = plain._replace(quantity=column, value=np.where(lasts > 0.0, lasts, np.nan))
            found[name] = _named(lasts, lasts._replace(value=1.0 / lasts.value))
    elif "electrical_power" in dataset and line.quantity != "electrical_power":
        power = plain._replace(quantity="electrical_power", value=dataset["electrical_power"].values[:, 0])
        for name, over_speed in (("best_endurance", False), ("best_range", True)):
            found[name] = _named(power, power.over(over_speed))
    return found


def _named(whole: BestLine, line: BestLine) -> dict[str, Any] | None:
    """Return where a line is least, with the name of its quantity, which is not the minimised one."""
    least = _least(whole, line)
    return None if least is None else least | {"quantity": whole.quantity}


# Work per beat and mass of the pectoralis that was measured, with sources; see the file.
_WORK = Path(__file__).with_name("work_per_beat.toml")


def _characteristic_frequencies(dataset: xr.Dataset, inputs: dict[str, Any]) -> dict[str, Any]:
    """Return what a curve over frequency says of the frequency, as in `Curve.characteristic_frequencies`."""
    line = best_line(dataset)
    least, k = None, _lowest(line)
    if k is not None:
        value = float(line.value[k])
        near = _ranges(line, line.value, -math.inf, value + _FLAT_IN_FREQUENCY * abs(value))
        least = {"frequency": float(line.speed[k]), "value": value, "within_5_percent": near}
    own = species_from(inputs).own_frequency(float(inputs["speed"]))
    found: dict[str, Any] = {
        "own": {"value": own.value, "range": list(own.range), "basis": own.basis, "source": own.source},
        "least": least,
    }
    if "peak_activation" not in dataset:
        return found
    activation, work = (dataset[name].values[:, 0] for name in ("peak_activation", "muscle_work_per_mass"))
    bands = tomllib.loads(_WORK.read_text(encoding="utf-8"))["bands"]
    ends = min(band["low"] for band in bands), max(band["high"] for band in bands)
    whole = {"name": "all sources", "low": ends[0], "high": ends[1], "unit": "J kg-1"}
    bands = [whole | {"source": "from the least to the greatest of the others", "grade": "D"}, *bands]
    return found | {
        "activation": {"limit": 1.0, "ranges": _ranges(line, activation, -math.inf, 1.0)},
        "work_per_beat": [band | {"ranges": _ranges(line, work, band["low"], band["high"])} for band in bands],
    }


def _ranges(line: BestLine, value: np.ndarray, low: float, high: float) -> list[list[float]]:
    """Return where along a line a value is within limits; it is straight between the points of a branch."""
    found: list[list[float]] = []

    def add(first: float, last: float) -> None:
        if found and found[-1][1] >= first:
            found[-1][1] = last
        else:
            found.append([first, last])

    for k, here in enumerate(line.speed.tolist()):
        if low <= value[k] <= high:
            add(here, here)
        if not (line.reaches(k, 1) and np.isfinite(value[k : k + 2]).all()):
            continue
        step, rise = float(line.speed[k + 1]) - here, value[k + 1] - value[k]
        if rise == 0.0:  # a flat piece
            if low <= value[k] <= high:
                add(here, here + step)
            continue
        first, last = sorted((limit - value[k]) / rise for limit in (low, high))
        if first <= 1.0 and last >= 0.0:
            add(here + max(first, 0.0) * step, here + min(last, 1.0) * step)
    return found


def best_line(dataset: xr.Dataset) -> BestLine:
    """Return the best orbits of a curve, and the other families of optima."""
    over = over_of(dataset.attrs)
    values, family = dataset["objective_value"].values, dataset["family"].values
    others = []
    for one in range(int(family.max(initial=-1)) + 1):  # each has at most one optimum at each speed
        rows = np.where(family == one, values, np.nan)
        others.append(np.where(np.isfinite(rows).any(axis=1), np.nansum(rows, axis=1), np.nan))
    names = [str(text).split(", ") for text in dataset["active_bounds"].values[:, 0]]
    ends = [f"{side}_{over}" for side in ("lower", "upper")]
    marks = [(m["kind"], m[ends[0]], m[ends[1]]) for m in json.loads(dataset.attrs["marks"])]
    objective, unit = dataset.attrs["objective"], dataset["objective_value"].attrs["units"]
    limits = [frozenset(re.split("[<>]=", name)[0] for name in row if name) for row in names]
    line = objective, unit, dataset[over].values, values[:, 0], marks, limits
    return line_of(*line, others=np.array(others).reshape(-1, len(values)))


def is_mean_power(objective: str, unit: str) -> bool:
    """Whether a quantity is a mean power, of which a least value and a limit along speed mean something."""
    return unit == "W" and not objective.startswith("peak_")


def line_of(
    objective: str,
    unit: str,
    speed: np.ndarray,
    value: np.ndarray,
    marks: list[tuple[str, float, float]],
    limits: list[frozenset[str]],
    others: np.ndarray | None = None,
) -> BestLine:
    """Return a line that is torn at marks (kind, lower and upper speed) of other kinds than a change of bounds."""
    torn = {(low, high) for kind, low, high in marks if kind != "bounds"}
    joined = np.array([ends not in torn for ends in itertools.pairwise(speed.tolist())], dtype=bool)
    others = np.empty((0, len(speed))) if others is None else others
    return BestLine(objective, is_mean_power(objective, unit), speed, value, joined, limits, others)
