"""Tables that do not cover the whole circle, completed to it."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise


def is_whole_turn(angles: Sequence[float]) -> bool:
    """Return whether a table runs from -180 to 180 degrees."""
    return angles[0] == -180 and angles[-1] == 180


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
