"""The progress of a study."""

from __future__ import annotations

from dataclasses import dataclass


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
