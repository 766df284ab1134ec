"""What a table of coefficients must satisfy before a curve is put through it."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

from wingbeat._base import FaultList

REQUIRED = ("alpha_deg", "c_l", "c_d")
OPTIONAL = ("x_cp",)
MIN_ROWS = 4
# No instrument sets angles more finely, and a curve through closer rows would be a step.
CLOSEST_DEG = 1e-3
# Coefficients that differ by less are the same but for rounding, as the sines of -180 and 180 degrees are.
_SAME = 1e-6
# What a wing can have. Sections with slotted flaps reach a lift coefficient of about 4.5, and a plate across the
# flow has a drag coefficient of about 2. The centre of pressure is in chords from the leading edge.
MAX_LIFT, MAX_DRAG, CENTRE_RANGE = 5.0, 5.0, (-1.0, 2.0)

Where = Callable[[int, str], str]


def numbers(faults: FaultList, cells: Sequence[Any], where: Callable[[int], str]) -> list[float]:
    """Return the cells as floats; a cell that is not a number becomes NaN and is noted as a fault."""
    values = []
    for i, cell in enumerate(cells):
        try:
            number = float(cell)
        except (TypeError, ValueError):
            rule = "is empty" if isinstance(cell, str) and not cell.strip() else "is not a number"
            faults.add(where(i), cell, rule, "write one number with a decimal point")
            number = math.nan
        else:
            if not math.isfinite(number):
                faults.add(where(i), number, "must be finite", "drop the row or give a value")
                number = math.nan
        values.append(number)
    return values


def check_possible(faults: FaultList, quantity: str, values: Sequence[float], where: Callable[[int], str]) -> None:
    """Note one fault, at the worst row, if a column holds coefficients that no wing has.

    Parameters
    ----------
    faults : collects the fault.
    quantity : "c_l", "c_d" or "x_cp", in either case; other quantities have no limits.
    values : the column; values that are not finite are left to other checks.
    where : names a row of it.
    """
    name = quantity.lower()
    limits = {"c_l": (-MAX_LIFT, MAX_LIFT), "c_d": (0.0, MAX_DRAG), "x_cp": CENTRE_RANGE}
    if name not in limits:
        return
    low, high = limits[name]
    given = [(value, i) for i, value in enumerate(values) if math.isfinite(value)]
    bad = [(v, i) for v, i in given if not low <= v <= high or (name == "c_d" and v == 0)]
    if not bad:
        return
    worst, row = max(bad, key=lambda pair: max(low - pair[0], pair[0] - high))
    usual = sorted(abs(value) for value, _ in given)[len(given) // 2]
    if name == "x_cp":
        rule = f"must lie between {low:g} and {high:g} chords from the leading edge"
        fix = "where the force is nearly zero it has no centre: give a value from a neighbouring row"
        fix = "the column looks like per cent of the chord: divide it by 100" if usual > high else fix
    elif name == "c_d" and worst <= 0:
        rule = "must be > 0: every wing has drag, and drag is measured against the motion"
        reversed_ = all(value <= 0 for value, _ in given)
        fix = "reverse its sign" if reversed_ and worst < 0 else "check the zero of the balance, or drop the row"
    else:
        rule = f"must lie between {low:g} and {high:g}: no wing has more"
        counts = name == "c_d" and usual > 2 * high
        fix = "give it without a unit; per cent divided by 100 are coefficients"
        fix = "the column looks like drag counts: divide it by 10000" if counts else fix
    faults.add(where(row), worst, rule + (f" ({len(bad)} of {len(values)} rows)" if len(bad) > 1 else ""), fix)


def check_columns(faults: FaultList, columns: dict[str, list[float]], where: Where) -> None:
    """Note angles that do not rise, coefficients that no wing has, and too few rows."""
    angles = columns["alpha_deg"]
    falls = [i for i in range(1, len(angles)) if angles[i] <= angles[i - 1]]
    if falls:
        share = f" ({len(falls)} of {len(angles)} rows)" if len(falls) > 1 else ""
        rule = f"must be above the {angles[falls[0] - 1]:g} before it{share}"
        fix = "sort the rows by angle and drop duplicates; of sweeps up and down, keep one"
        fix = "the angles fall: reverse the order of the rows" if len(falls) == len(angles) - 1 else fix
        faults.add(where(falls[0], "alpha_deg"), angles[falls[0]], rule, fix)
    for i, angle in enumerate(angles):
        if i and 0 < angle - angles[i - 1] < CLOSEST_DEG:
            rule = f"must be at least {CLOSEST_DEG:g} degrees above the {angles[i - 1]:g} before it"
            faults.add(where(i, "alpha_deg"), angle, rule, "merge the two rows")
        if abs(angle) > 180:
            faults.add(where(i, "alpha_deg"), angle, "must lie between -180 and 180 degrees", "wrap the angle")
    for name, column in columns.items():
        check_possible(faults, name, column, lambda i, name=name: where(i, name))
    if len(angles) < MIN_ROWS:
        rule = f"must be at least {MIN_ROWS} for a curve"
        faults.add("rows", len(angles), rule, "measure at more angles")


def check_coverage(faults: FaultList, columns: dict[str, list[float]], extension: str, where: Where) -> None:
    """Note a table that covers fewer angles than its extension needs, or more negative angles than it uses.

    A whole turn whose last row differs from its first by rounding is closed: its last row becomes its first.
    """
    angles = columns["alpha_deg"]
    first, last = angles[0], angles[-1]
    at_first, at_last = where(0, "alpha_deg"), where(len(angles) - 1, "alpha_deg")
    if max(abs(first), abs(last)) <= 2 * math.pi:
        rule = f"is the largest angle of a column from {first:g} to {last:g}, which looks like radians"
        faults.add(at_last, last, rule, "write alpha_deg in degrees, from 0 to at least 90")
        return
    if last < 90:
        faults.add(at_last, last, "the table must reach at least 90 degrees", "measure at larger angles")
    if first > 0:
        faults.add(at_first, first, "the table must begin at 0 degrees or below", "add a row for 0")
    if is_whole_turn(angles):
        for name, column in columns.items():
            if name == "alpha_deg":
                continue
            if abs(column[-1] - column[0]) > _SAME:
                rule = f"must equal the value at -180 degrees, {column[0]:g}"
                faults.add(where(len(angles) - 1, name), column[-1], rule, "repeat the row of -180 at 180")
            else:
                column[-1] = column[0]
    elif first < 0 and extension != "signed":
        rule = f"is negative, and the extension {extension} would ignore it"
        more = "use signed" if first <= -90 else "add rows down to -90 and use signed"
        drop = "drop the negative rows" + (" and use mirrored" if extension == "signed-drag" else "")
        faults.add(at_first, first, rule, f"{drop}, or {more}")
    elif first > -90 and extension.startswith("signed"):
        rule = "the extension signed needs the table to begin at -90 degrees or below"
        if extension == "signed-drag":
            rule = "the extension signed-drag has no effect on a table"
        fix = "use mirrored" if first >= 0 else "add rows down to -90, or drop the negative rows and use mirrored"
        faults.add(at_first, first, rule, fix)


def is_whole_turn(angles: Sequence[float]) -> bool:
    """Return whether a table runs from -180 to 180 degrees."""
    return angles[0] == -180 and angles[-1] == 180
