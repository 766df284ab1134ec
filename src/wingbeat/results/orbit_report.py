"""What an orbit record says to a reader, as the blocks of a report."""

from __future__ import annotations

from typing import Any

from wingbeat._base import Block, Line, Notes, Report, Tone, grouped
from wingbeat.results.plausibility import statements
from wingbeat.results.power_rows import power_groups
from wingbeat.results.rows import limits_in_words, orbit_groups


def orbit_report(record: dict[str, Any]) -> Report:
    """Return certificate, plausibility, what limits have set, every group of numbers, and warnings of an orbit.

    Parameters
    ----------
    record : of `Orbit.record`; with a ``power_account``, its parts are reported too.
    """
    lines: list[Block]
    if record.get("status") == "converged":
        said = statements(record)
        # The words are green only if both statements hold; each statement is a line of its own.
        lines = [
            status_line("certified", said.closes, "good" if said.good else "title"),
            status_line("plausible", said.plausible, "good" if said.good else "doubtful"),
        ]
        if limits := limits_in_words(record):
            lines.append(status_line("set by limits, not predicted", limits, "doubtful"))
    else:
        status = f"not certified, {record.get('status')}"
        lines = [status_line(status, str(record.get("message", "")), "bad")]
    groups = orbit_groups(record)
    certificate = {title: groups.pop(title) for title in ("certificate", "stability")}
    lines.append(grouped({**groups, **power_groups(record.get("power_account")), **certificate}))
    return [*lines, *warning_blocks(record.get("warnings") or [])]


def status_line(status: str, message: str, tone: Tone) -> Line:
    """Return a line of a status and what it means, which may begin with the status."""
    message = message.removeprefix(f"{status}: ")
    return Line(f": {message}" if message else "", status, tone)


def warning_blocks(warnings: list[str]) -> list[Block]:
    """Return warnings under their title; nothing if there are none."""
    return [Line(""), Line("warnings", tone="title"), Notes(tuple(warnings))] if warnings else []
