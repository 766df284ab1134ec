"""Shares of random draws: at a limit, printed instead of an error bar; stable, with an interval; and unsolved."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from wingbeat._base import PRECISION, written, written_range

# From this share of the draws on, mean and deviation describe the limit rather than the orbits.
_MOST = 0.5


class LimitShare(NamedTuple):
    """Among draws of a quantity, those that a limit has set; made by `limit_share`."""

    limits: tuple[float, ...]  # values that a limit gave the quantity, increasing
    at_limit: int  # number of draws at a limit
    draws: int  # number of all draws
    others: tuple[float, float] | None  # smallest and largest value of the other draws

    @property
    def share(self) -> float:
        """Share of the draws that are at a limit."""
        return self.at_limit / self.draws if self.draws else 0.0

    @property
    def most(self) -> bool:
        """Whether a limit has set the quantity in so many draws that it has no error bar."""
        return self.share >= _MOST

    def in_words(self, unit: str = "", factor: float = 1.0) -> str:
        """Return how many draws a limit has set: ``set by the limit 5.045 Hz in 100 % of the samples``."""
        limits = " and ".join(written(factor * limit) for limit in self.limits)
        what = f"limit{'s' if len(self.limits) > 1 else ''} {limits}{f' {unit}' if unit and unit != '1' else ''}"
        percent = 100 * self.share
        # Never 0 % or 100 % if that is not all.
        shown = f"{percent:.0f}" if percent in (0.0, 100.0) else f"{min(max(percent, 1.0), 99.0):.0f}"
        return f"set by the {what} in {shown} % of the samples"

    def shown(self, value: float, error: float, unit: str = "", factor: float = 1.0) -> str:
        """Return the quantity as it is printed: with its error, or with the limit that set it."""
        usual = written(factor * value, factor * error, unit)
        if not self.at_limit:
            return usual
        words = self.in_words(unit, factor)
        if not self.most:
            return f"{usual}, {words}"
        if self.others is None:
            return words
        low, high = sorted(factor * end for end in self.others)
        return f"{words}, {written_range(low, high, unit)} in the others"


def limit_share(values: np.ndarray, at_limit: np.ndarray) -> LimitShare:
    """Count the draws of a quantity that are at a limit."""
    held, others = np.sort(values[at_limit]), values[~at_limit]
    # Values that agree as closely as certified orbits do are one limit.
    first = np.diff(held, prepend=-np.inf) > PRECISION * np.abs(held)
    ends = (float(others.min()), float(others.max())) if others.size else None
    return LimitShare(tuple(held[first].tolist()), int(at_limit.sum()), len(values), ends)


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
    """Count the stable orbits."""
    return StableShare(int(np.sum(np.asarray(radii) < 1.0)), len(radii), drawn)


class Unsolved(NamedTuple):
    """Random draws without a certified orbit, and why; made by `uncertainty_by_samples`.

    Attributes
    ----------
    draws : number of draws without a certified orbit.
    drawn : number of all draws.
    short : in how many of them each balance fails most: lift, thrust or pitching moment.
    differ : numbers whose means differ by more than chance, the surest first: with an orbit, without.

    >>> print(Unsolved(9, 16, {"thrust": 9}, {}))
    9 of 16 draws have no orbit: the balance that fails most is thrust in 9
    >>> print(Unsolved(9, 16, {}, {"wing.mass": (0.031, 0.0634)}))
    9 of 16 draws have no orbit: mean of wing.mass there 0.0634, with an orbit 0.031
    """

    draws: int
    drawn: int
    short: dict[str, int]
    differ: dict[str, tuple[float, float]]

    def __str__(self) -> str:
        """Return the count and the reasons as a sentence."""
        fails = ", ".join(f"{law} in {count}" for law, count in self.short.items())
        means = self.differ.items()
        apart = [f"mean of {path} there {there:.3g}, with an orbit {flown:.3g}" for path, (flown, there) in means]
        told = "; ".join([f"the balance that fails most is {fails}"][: len(self.short)] + apart)
        return f"{self.draws} of {self.drawn} draws have no orbit{f': {told}' if told else ''}"


# Standard errors by which two means differ beyond chance: among a few dozen numbers, chance names one in ten runs.
_BEYOND_CHANCE = 3.0


def unsolved(certified: np.ndarray, short: Sequence[str], drawn: np.ndarray, paths: tuple[str, ...]) -> Unsolved:
    """Count the draws without an orbit, and find the numbers that set them apart; `drawn` has shape (n, P)."""
    lost = ~certified
    differ: dict[str, tuple[float, float]] = {}
    if certified.any() and lost.any():
        with_one, without = drawn[certified].mean(axis=0), drawn[lost].mean(axis=0)
        error = drawn.std(axis=0) * math.sqrt(1 / certified.sum() + 1 / lost.sum())
        sure = np.abs(without - with_one) / np.where(error > 0, error, np.inf)
        for i in (i for i in np.argsort(-sure) if sure[i] > _BEYOND_CHANCE):
            differ[paths[i]] = float(with_one[i]), float(without[i])
    counts = Counter(law for law in short if law)
    return Unsolved(int(lost.sum()), len(lost), dict(counts.most_common()), differ)
