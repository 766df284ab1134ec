"""How far a study is, as the blocks of a report."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

from wingbeat._base import Block, Line, Report, Reported, Row, Table, drawn
from wingbeat.studies.summary import Summary
from wingbeat.studies.units import STATUSES

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from wingbeat.studies.study import Study

# Points without a certified orbit that are listed.
_LISTED = 10


class ReportedStudy(Reported):
    """The notebook manners of a study."""

    def _report(self) -> Report:
        return study_report(cast("Study", self))

    def plot(self, quantity: str | None = None) -> Figure:
        """Return a figure of a result against the varied parameters.

        Parameters
        ----------
        quantity : a column of numbers, such as ``mean_power``; default the minimised quantity.
        """
        return drawn("study_page", *cast("Study", self).drawing(quantity))


def study_report(study: Study) -> Report:
    """Return the number of points with each status, and why the first uncertified points have no orbit.

    Parameters
    ----------
    study : the study; its store is read.
    """
    summary = study.status()
    rows = [(name, summary.count(name)) for name in (*STATUSES, "waiting")]
    counts = tuple(Row((f"  {name:<14}", f"{count:>7}")) for name, count in rows if count)
    blocks: list[Block] = [Line(f"{summary.total} points in {study.store}"), Table(counts, align="lr")]
    if summary.kept:
        blocks.append(Line(f"  {summary.kept} results of points that are no longer in the study are kept"))
    if summary.changed:
        changed = "the study has changed since its last run: this summary is of the previous points"
        blocks.append(Line(f"  {changed}", tone="warning"))
    troubled = summary.count(*STATUSES[1:])
    blocks += [Line(_in_words(row)) for row in (study.uncertified(_LISTED) if troubled else [])]
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
