"""Tables that do not cover the whole circle, completed to it."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise

import numpy as np

from wingbeat._base import FaultList
from wingbeat.aero.coefficient_model import is_whole_turn
from wingbeat.aero.polar_sheet import zero_lift

VITERNA = "viterna"
# Rows of the rule are this far apart [deg].
_STEP_DEG = 2.5
# Lift that rises by more than this per degree at the end of a table has not stalled.
_STILL_RISING = 0.03


def closed_turn(columns: dict[str, list[float]]) -> tuple[str, ...]:
    """Close a table that covers the whole circle but for one step, in place; return a note on it.

    The row that is missing at -180 or 180 degrees repeats the other; without both, they are interpolated.
    """
    angles = columns["alpha_deg"]
    gap = angles[0] + 360 - angles[-1]
    widest = max(b - a for a, b in pairwise(angles)) if len(angles) > 2 else 0.0
    if is_whole_turn(angles) or not 0 < gap <= 1.5 * widest or gap > 30:
        return ()
    part = (180 - angles[-1]) / gap
    for name, column in columns.items():
        if name != "alpha_deg":
            end = column[-1] + part * (column[0] - column[-1])
            column[:] = [*([end] * (angles[0] > -180)), *column, *([end] * (angles[-1] < 180))]
    angles[:] = [*([-180.0] * (angles[0] > -180)), *angles, *([180.0] * (angles[-1] < 180))]
    one = "repeats the row of the other end" if part in (0, 1) else "is interpolated over the gap"
    return (f"the table covers the whole circle; its end at -180 and 180 degrees {one}",)


def viterna(
    faults: FaultList,
    where: Callable[[int, str], str],
    columns: dict[str, list[float]],
    aspect_ratio: float | None,
) -> tuple[str, ...]:
    """Complete a table to the whole circle by Viterna's rule, in place; return notes on it.

    Beyond the last row (angle s, C_L and C_D there) up to 90 degrees, with C_Dmax = 1.11 + 0.018 A for an aspect
    ratio A up to 50, else 2.01, that of a flat plate:

        C_L = C_Dmax/2 sin(2a) + a_2 cos(a)^2/sin(a),  a_2 = (C_L(s) - C_Dmax sin(s) cos(s)) sin(s)/cos(s)^2
        C_D = C_Dmax sin(a)^2 + b_2 cos(a),            b_2 = (C_D(s) - C_Dmax sin(s)^2)/cos(s)

    Below the first row likewise, with the sign of lift reversed; a table from 0 degrees, without lift there, gets
    its mirror image. From behind, the wing is the mirrored plate: C_L(180-a) = -C_L(a), C_D(180-a) = C_D(a),
    x_cp(180-a) = 1 - x_cp(a). The centre of pressure moves linearly to mid-chord at 90 degrees. Source: Viterna and
    Janetzke 1982 (NASA TM-82944). Theory: equation ``viterna``.
    """
    angles = columns["alpha_deg"]
    last = len(angles) - 1
    if angles[-1] >= 90 or angles[0] <= -90:
        end = 0 if angles[0] <= -90 else last
        rule = "reaches 90 degrees, and viterna completes tables that stall before"
        faults.add(where(end, "alpha_deg"), angles[end], rule, "leave --extension out, or use signed")
        return ()
    if angles[-1] <= 0 or columns["c_l"][-1] <= 0:
        rule = "is the last angle, and viterna needs the stall with positive lift"
        faults.add(where(last, "alpha_deg"), angles[-1], rule, "measure at larger angles")
    if angles[0] >= 0 and zero_lift(np.array(angles), np.array(columns["c_l"])) is None:
        rule = "is the first angle, and the wing has lift at 0 degrees"
        faults.add(where(0, "alpha_deg"), angles[0], rule, "viterna needs the stall at negative angles, too")
    elif angles[0] < 0 and columns["c_l"][0] >= 0:
        rule = "is the first angle, and lift is positive there"
        faults.add(
            where(0, "alpha_deg"), angles[0], rule, "viterna needs the stall with negative lift: measure there"
        )
    faults.raise_if_any()
    notes = []
    for end, beside, sign in ((-1, -2, 1), (0, 1, -1)):
        rise = sign * (columns["c_l"][end] - columns["c_l"][beside]) / abs(angles[end] - angles[beside])
        if sign * angles[end] > 0 and rise > _STILL_RISING:
            notes.append(
                f"the table ends before the stall, at {angles[end]:g} degrees; viterna takes that row as the stall"
            )
    if angles[0] >= 0:
        kept = [k for k, angle in enumerate(angles) if angle > 0]
        odd = {"alpha_deg": -1, "c_l": -1}
        at_zero = {"alpha_deg": 0.0, "c_l": 0.0}
        for name, column in columns.items():
            image = [odd.get(name, 1) * column[k] for k in reversed(kept)]
            middle = at_zero.get(name, float(np.interp(0.0, angles, column)))
            columns[name] = [*image, middle, *(column[k] for k in kept)]
        angles = columns["alpha_deg"]
        notes.append("negative angles are the mirror image of the positive ones")
    ratio = math.inf if aspect_ratio is None else aspect_ratio
    largest = 1.11 + 0.018 * ratio if ratio <= 50 else 2.01
    for sign in (1, -1):
        end = -1 if sign > 0 else 0
        stall = math.radians(abs(columns["alpha_deg"][end]))
        lift, drag = sign * columns["c_l"][end], columns["c_d"][end]
        first = math.degrees(stall)
        count = max(math.ceil((90 - first) / _STEP_DEG), 1)
        turn = np.radians(np.linspace(first, 90, count + 1)[1:])
        sine, cosine = np.sin(turn), np.cos(turn)
        cosine[-1] = 0.0
        at, across = math.sin(stall), math.cos(stall)
        rows = {"alpha_deg": sign * np.degrees(turn)}
        rows["alpha_deg"][-1] = sign * 90.0
        lifting = (lift - largest * at * across) * at / across**2
        rows["c_l"] = sign * (largest * sine * cosine + lifting * cosine**2 / sine)
        rows["c_d"] = largest * sine**2 + (drag - largest * at**2) / across * cosine
        if "x_cp" in columns:
            part = (np.degrees(turn) - first) / (90 - first)
            rows["x_cp"] = columns["x_cp"][end] + part * (0.5 - columns["x_cp"][end])
        for name, column in rows.items():
            added = column.tolist()
            columns[name] = [*columns[name], *added] if sign > 0 else [*reversed(added), *columns[name]]
    angles = np.array(columns["alpha_deg"])
    front, rear = (angles > 0) & (angles < 90), (angles < 0) & (angles > -90)
    for name, column in columns.items():
        values, zero = np.array(column), float(np.interp(0.0, angles, column))
        if name == "alpha_deg":
            over, under = [*(180 - values[front][::-1]), 180.0], [-180.0, *(-180 - values[rear][::-1])]
        else:
            scale, shift = {"c_l": (-1, 0), "x_cp": (-1, 1)}.get(name, (1, 0))
            end = shift + scale * zero
            over, under = (
                [*(shift + scale * values[front][::-1]), end],
                [end, *(shift + scale * values[rear][::-1])],
            )
        columns[name] = [float(value) for value in (*under, *column, *over)]
    shape = "a section" if math.isinf(ratio) else f"aspect ratio {ratio:g}"
    if aspect_ratio is None:
        shape = "a section (state another as '# aspect_ratio = 6' in the file)"
    return (
        *notes,
        f"completed by Viterna's rule beyond the table, with C_D {largest:.3g} at 90 degrees, of {shape}",
    )
