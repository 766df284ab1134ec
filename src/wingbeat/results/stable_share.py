"""How certain the verdict `stable` is: the share of random draws whose orbit is stable."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

# Standard deviations on each side of a share for an interval of 95 %.
_DEVIATIONS = 1.96


class StableShare(NamedTuple):
    """Number of stable orbits among the certified orbits of random draws; made by `uncertainty_by_samples`.

    Attributes
    ----------
    stable : number of certified orbits whose spectral radius is below 1.
    certified : number of draws with a certified orbit.
    drawn : number of all draws.

    >>> import wingbeat as wb
    >>> print(wb.StableShare(stable=124, certified=200, drawn=200))
    stable in 62 % of 200 orbits, 55 to 68 %
    """

    stable: int
    certified: int
    drawn: int

    @property
    def share(self) -> float | None:
        """Share of the certified orbits that are stable; None if none is certified."""
        return self.stable / self.certified if self.certified else None

    @property
    def interval(self) -> tuple[float, float]:
        """Interval of the share, 95 %: what so few draws leave open, not the error of the ranges.

        It is the score interval of a binomial share (Wilson 1927, doi 10.1080/01621459.1927.10502953), which is
        meaningful for shares of 0 and 1, too.

        >>> [round(end, 2) for end in StableShare(124, 200, 200).interval]
        [0.55, 0.68]
        """
        n, square = self.certified, _DEVIATIONS**2
        if n == 0:
            return 0.0, 1.0
        share = self.stable / n
        middle = (share + square / (2 * n)) / (1 + square / n)
        half = _DEVIATIONS * math.sqrt(share * (1 - share) / n + square / (4 * n**2)) / (1 + square / n)
        return max(middle - half, 0.0), min(middle + half, 1.0)

    def record(self) -> dict[str, Any]:
        """Return all numbers as a JSON-able dictionary."""
        return {**self._asdict(), "share": self.share, "interval": list(self.interval)}

    def __str__(self) -> str:
        """Return the share as a sentence: ``stable in 62 % of 200 orbits, 55 to 68 %``."""
        if self.share is None:
            return f"none of {self.drawn} draws has a certified orbit"
        low, high = (f"{100 * end:.0f}" for end in self.interval)
        lost = self.drawn - self.certified
        without = f"; {lost} of {self.drawn} draws have no orbit" if lost else ""
        return f"stable in {100 * self.share:.0f} % of {self.certified} orbits, {low} to {high} %{without}"


def stable_share(radii: np.ndarray, drawn: int) -> StableShare:
    """Count the stable orbits.

    Parameters
    ----------
    radii : spectral radii of the certified orbits, shape (n,).
    drawn : number of draws, certified or not.
    """
    return StableShare(int(np.sum(np.asarray(radii) < 1.0)), len(radii), drawn)
