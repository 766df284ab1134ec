"""A scaling law: a formula with its source, how far animals scatter around it, and the data it was fitted to."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from wingbeat.animal.species_schema import Number

# In the source of a number that a law gave outside its data, this text precedes the value of the input and the
# range of the data.
OUTSIDE = "outside its data: "


@dataclass(frozen=True)
class Data:
    """The data a law was fitted to: lowest and highest value of each input in SI units, and where they were read.

    Parameters
    ----------
    ranges : by the symbol of the input; empty for a law without data, or with data that we did not find.
    where : where the ranges were read, or why there are none.
    """

    ranges: dict[str, tuple[float, float]]
    where: str


@dataclass(frozen=True)
class Law:
    """A number of an animal as a function of others, in SI units, with its source and how far animals scatter.

    Parameters
    ----------
    unit : of the number.
    formula : as text, for the source of the number.
    inputs : symbol and unit of each value that it takes.
    function : the formula.
    source : where it was read.
    spread : lowest and highest ratio of measured values to the value that the law gives.
    scatter : where the spread comes from.
    data : what it was fitted to.
    beyond : how the law continues outside its data, if not by its formula.

    >>> from wingbeat.animal.species.scaling import BIRD_WING_MASS
    >>> number = BIRD_WING_MASS.number(0.316)
    >>> f"{number.value:.4f} {number.unit}"
    '0.0199 kg'
    """

    unit: str
    formula: str
    inputs: tuple[str, ...]
    function: Callable[..., float]
    source: str
    spread: tuple[float, float]
    scatter: str
    data: Data
    beyond: str = ""

    def __call__(self, *values: float) -> float:
        """Return what the law gives."""
        return self.function(*values)

    def number(self, *values: float) -> Number:
        """Return what the law gives, marked as derived, with its spread as the plausible range."""
        value, (low, high) = self(*values), self.spread
        where = ", ".join(_told(*pair) for pair in zip(self.inputs, values, strict=True))
        formula = f"{self.formula} at {where}" if where else self.formula
        source = f"derived: {formula} ({self.source}); spread {low:g} to {high:g} times: {self.scatter}"
        return Number(value, self.unit, source + self.outside(*values), (low * value, high * value))

    def outside(self, *values: float) -> str:
        """Return which of these values are outside the law's data, as text to append to a source; empty if none."""
        found = []
        for pair, value in zip(self.inputs, values, strict=True):
            symbol, unit = pair.split()
            low, high = self.data.ranges.get(symbol, (-math.inf, math.inf))
            if not low <= value <= high:
                found.append(f"{_told(pair, value)}, data {low:.4g} to {high:.4g} {unit}")
        if not found:
            return ""
        beyond = f"; there {self.beyond}" if self.beyond else ""
        return f"; {OUTSIDE}{' and '.join(found)} ({self.data.where}){beyond}"


def _told(symbol_and_unit: str, value: float) -> str:
    symbol, unit = symbol_and_unit.split()
    return f"{symbol} = {value:.4g} {unit}"
