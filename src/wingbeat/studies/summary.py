"""How far a study is: the number of points with each status, and the report of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from wingbeat._base import Block, Line, Report, Row, Table
from wingbeat.studies.units import STATUSES


@dataclass(frozen=True)
class Summary:
    """The progress of a study.

    Parameters
    ----------
    total : points of the study.
    counts : number of points by status; ``waiting`` are those without a result.
    kept : number of results of points that are no longer in the study.
    changed : whether the study was changed and not yet run again, so that the store holds the previous points.
    seconds : computing time of the results, on one core [s].
    """

    total: int
    counts: dict[str, int]
    kept: int = 0
    changed: bool = False
    seconds: float = 0.0

    def count(self, *statuses: str) -> int:
        """Return the number of points with one of these statuses."""
        return sum(self.counts.get(status, 0) for status in statuses)

    @property
    def waiting(self) -> int:
        """Number of points without a result."""
        return self.count("waiting")


# Points without a certified orbit that are listed.
_LISTED = 10


def study_report(summary: Summary, store: Path, uncertified: Callable[[int], list[dict[str, Any]]]) -> Report:
    """Return the number of points with each status, and why the first uncertified points have no orbit.

    `uncertified` reads the first of these points from the store, at most as many as it is given.
    """
    rows = [(name, summary.count(name)) for name in (*STATUSES, "waiting")]
    counts = tuple(Row((f"  {name:<14}", f"{count:>7}")) for name, count in rows if count)
    blocks: list[Block] = [Line(f"{summary.total} points in {store}"), Table(counts, align="lr")]
    if summary.kept:
        blocks.append(Line(f"  {summary.kept} results of points that are no longer in the study are kept"))
    if summary.changed:
        changed = "the study has changed since its last run: this summary is of the previous points"
        blocks.append(Line(f"  {changed}", tone="warning"))
    troubled = summary.count(*STATUSES[1:])
    blocks += [Line(_in_words(row)) for row in (uncertified(_LISTED) if troubled else [])]
    if troubled > _LISTED:
        blocks.append(Line(f"... and {troubled - _LISTED} more; `wingbeat study export` lists all"))
    return blocks


def points_wait(summary: Summary) -> str:
    """Return the words for how many points of a study wait for a result.

    >>> points_wait(Summary(3, {"converged": 1, "waiting": 2})), points_wait(Summary(1, {"waiting": 1}))
    ('2 of 3 points wait', 'the only point waits')
    """
    if summary.total == 1:
        return "the only point waits" if summary.waiting else "no point waits"
    return f"{summary.waiting} of {summary.total} points wait{'s' if summary.waiting == 1 else ''}"


def _in_words(row: dict[str, Any]) -> str:
    """Return status, varied values and reason of a point."""
    where = ", ".join(
        f"{name} = {value:.5g}" if isinstance(value, float) else f"{name} = {value}"
        for name, value in row.items()
        if name not in ("status", "reason")
    )
    text = ": ".join(part for part in (row["status"], where, row["reason"]) if part)
    return "".join(sign if sign.isprintable() else repr(sign)[1:-1] for sign in text)
