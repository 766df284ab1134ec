"""How often a quantity of random draws sits at a limit, and what is printed of it instead of an error bar."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from wingbeat._base import PRECISION, written, written_range

# From this share of the draws on, mean and deviation describe the limit rather than the orbits.
_MOST = 0.5


class LimitShare(NamedTuple):
    """Among draws of a quantity, those that a limit has set; made by `limit_share`.

    Attributes
    ----------
    limits : values that a limit gave the quantity, increasing.
    at_limit, draws : number of draws at a limit, and of all draws.
    others : smallest and largest value of the other draws; None if there are none.
    """

    limits: tuple[float, ...]
    at_limit: int
    draws: int
    others: tuple[float, float] | None

    @property
    def share(self) -> float:
        """Share of the draws that are at a limit."""
        return self.at_limit / self.draws if self.draws else 0.0

    @property
    def most(self) -> bool:
        """Whether a limit has set the quantity in so many draws that it has no error bar."""
        return self.share >= _MOST

    def in_words(self, unit: str = "", factor: float = 1.0) -> str:
        """Return in words how many draws a limit has set.

        Parameters
        ----------
        unit, factor : to print, and from the quantity's own unit to it.

        >>> LimitShare((5.045,), 300, 300, None).in_words("Hz")
        'set by the limit 5.045 Hz in 100 % of the samples'
        """
        limits = " and ".join(written(factor * limit) for limit in self.limits)
        plural = "s" if len(self.limits) > 1 else ""
        after = f" {unit}" if unit and unit != "1" else ""
        percent = 100 * self.share
        # Never 0 % or 100 % if that is not all.
        shown = f"{percent:.0f}" if percent in (0.0, 100.0) else f"{min(max(percent, 1.0), 99.0):.0f}"
        return f"set by the limit{plural} {limits}{after} in {shown} % of the samples"

    def shown(self, value: float, error: float, unit: str = "", factor: float = 1.0) -> str:
        """Return the quantity as it is printed: with its error, or with the limit that set it.

        Parameters
        ----------
        value, error : of the quantity, in its own unit; an error of not-a-number is not known.
        unit, factor : as in `in_words`.

        >>> LimitShare((5.045,), 30, 40, (5.1, 5.6)).shown(5.2, 0.2, "Hz")
        'set by the limit 5.045 Hz in 75 % of the samples, 5.10 to 5.60 Hz in the others'
        >>> LimitShare((), 0, 40, (5.1, 5.6)).shown(5.2, 0.1234, "Hz")
        '5.20 +- 0.12 Hz'
        """
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
    """Count the draws of a quantity that are at a limit.

    Parameters
    ----------
    values : of the certified draws, shape (n,).
    at_limit : whether each is at its limit, shape (n,).

    >>> limit_share(np.array([5.0, 5.0, 5.3]), np.array([True, True, False]))
    LimitShare(limits=(5.0,), at_limit=2, draws=3, others=(5.3, 5.3))
    """
    held, others = np.sort(values[at_limit]), values[~at_limit]
    # Values that agree as closely as certified orbits do are one limit.
    first = np.diff(held, prepend=-np.inf) > PRECISION * np.abs(held)
    ends = (float(others.min()), float(others.max())) if others.size else None
    return LimitShare(tuple(held[first].tolist()), int(at_limit.sum()), len(values), ends)
