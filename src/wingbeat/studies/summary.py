"""How far a study is."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Summary:
    """How far a study is.

    Parameters
    ----------
    total : points of the study.
    counts : points by status; ``waiting`` are those without an answer.
    kept : answers in the store of points that the study no longer asks for.
    changed : whether the study was changed and not yet run, so that the store holds the points from before.
    seconds : what the answers took, on one core [s].
    """

    total: int
    counts: dict[str, int]
    kept: int = 0
    changed: bool = False
    seconds: float = 0.0

    def count(self, *statuses: str) -> int:
        """Points that have one of these statuses."""
        return sum(self.counts.get(status, 0) for status in statuses)

    @property
    def waiting(self) -> int:
        """Points without an answer."""
        return self.count("waiting")
