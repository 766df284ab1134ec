"""What a power curve says to a reader, as the blocks of a report."""

from __future__ import annotations

import itertools
import math
from typing import Any

from wingbeat.datasets import climb_text
from wingbeat.nomenclature import find, for_people
from wingbeat.reports import Block, Line, Notes, Report, Row, Table
from wingbeat.style import in_words

_LABELS = {
    "minimum_power": "minimum power",
    "maximum_range": "greatest range",
    "fastest_sustained": "fastest within the power limit",
    "slowest_sustained": "slowest within the power limit",
}
_HEADINGS = ("U\n[m/s]", "f\n[Hz]", "P+\n[W]", "CoT\n[-]", "flap\n[deg]", "optima", "at the bound of")
_MINIMISED_AT = 3  # column of the minimised quantity, after the power


def curve_report(record: dict[str, Any]) -> Report:
    """Return a row for each speed, changes of the best orbit between them, characteristic speeds and warnings.

    Parameters
    ----------
    record : of `Curve.record`.
    """
    points = record["points"]
    animal, minimised = record["species"] + climb_text(record["climb"]), in_words(record["objective"])
    certified = len(points) - len(record["gaps"])
    headings: list[str] = list(_HEADINGS)
    factor, unit = _unit(record["objective"])
    other = record["objective"] not in ("frequency", "mean_positive_power")  # which have columns of their own
    if other:
        headings.insert(_MINIMISED_AT, f"minimised\n[{unit or '-'}]")
    rows = tuple(Row(_row(point, factor if other else None)) for point in points)
    blocks: list[Block] = [
        Line(f"{animal}, minimum {minimised}: {certified} of {len(points)} speeds certified"),
        Table(rows, tuple(headings), "r" * (len(headings) - 1) + "l"),
        *_implausible(points),
        Line(""),
        Line("changes from one speed to the next", tone="title"),
    ]
    for mark in record["marks"]:
        where = f"{mark['lower_speed']:g} to {mark['upper_speed']:g} m/s"
        text = f"  {mark['kind']}, {where}: {mark['what']}"
        blocks.append(Line(text, tone="" if mark["kind"] == "bounds" else "warning"))
    if not record["marks"]:
        blocks.append(Line("  one branch, always at the same bounds"))
    blocks.append(Line(f"characteristic speeds, from the curve of {_power(record)}", tone="title"))
    blocks += [
        Line(f"  {_LABELS[name]}: {_told(name, found)}") for name, found in record["characteristic_speeds"].items()
    ]
    if record["warnings"]:
        blocks += [Line("warnings", tone="title"), Notes(tuple(record["warnings"]))]
    return blocks


def _implausible(points: list[dict[str, Any]]) -> list[Block]:
    """Say at which speeds the best orbit is outside which plausible ranges; nothing for a file of before."""
    judged = [(point["speed"], point["optima"][0].get("outside_ranges")) for point in points if point["optima"]]
    if not judged or any(names is None for _, names in judged):
        return []
    lines: list[Block] = [Line(""), Line("outside plausible ranges", tone="title")]
    for names, group in itertools.groupby(judged, key=lambda one: one[1]):
        speeds = [speed for speed, _ in group]
        where = f"{speeds[0]:g}" if len(speeds) == 1 else f"{speeds[0]:g} to {speeds[-1]:g}"
        if names:
            lines.append(Line(f"  at {where} m/s: {str(names).replace('_', ' ')}", tone="warning"))
    return lines if len(lines) > 2 else [*lines, Line("  at no speed")]


def _power(record: dict[str, Any]) -> str:
    if record["power"] == "minimised quantity":
        return in_words(record["objective"])
    return record["power"]


def _unit(objective: str) -> tuple[float, str]:
    """Return the factor to the reader's unit of the minimised quantity, and that unit; a user's own has none."""
    term = find(objective)
    return for_people(term.unit) if term is not None else (1.0, "")


def _row(point: dict[str, Any], factor: float | None) -> tuple[str, ...]:
    """Return the cells of a speed; with a factor to its unit, also the minimised quantity."""
    if not point["optima"]:
        none = ("",) * (4 if factor is None else 5)
        return (f"{point['speed']:g}", *none, "0", f"{point['status']}: {point['message']}")
    best = point["optima"][0]
    cost = best["cost_of_transport"]
    minimised = () if factor is None else (f"{best['objective_value'] * factor:.4g}",)
    return (
        f"{point['speed']:g}",
        f"{best['frequency']:.4g}",
        f"{best['mean_positive_power']:.4g}",
        *minimised,
        "-" if cost is None else f"{cost:.3g}",
        f"{math.degrees(best['flap_amplitude']):.3g}",
        f"{point['distinct_optima']}",
        best["active_bounds"] or "nothing",
    )


def _told(name: str, found: dict[str, Any] | None) -> str:
    if found is None:
        return "none"
    text = f"{found['speed']:.3g} m/s, {found['power']:.4g} W"
    if "within_2_percent" in found:
        low, high = found["within_2_percent"]
        least = "power over speed" if name == "maximum_range" else "the power"
        text += f"; {least} is within 2 % of its minimum from {low:.3g} to {high:.3g} m/s"
    if found["at_edge"]:
        text += "; at the end of the range or beside a gap: the true speed may lie beyond"
    if found["jump_beside"]:
        text += "; the curve changes branch there"
    return text
