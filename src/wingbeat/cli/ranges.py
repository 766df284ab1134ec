"""Ranges of numbers as they are written on a command line: ``start:stop:step``, the stop included."""

from __future__ import annotations

from decimal import Decimal, InvalidOperation
from fractions import Fraction
from math import floor, lcm

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import FaultList

MAX_VALUES = 10_000_000
_MAX_DIGITS = 12
_SYNTAX = "write start:stop:step, for example 0:110:2, or one number"


def _exact(faults: FaultList, where: str, text: str) -> Fraction | None:
    """Return the decimal number exactly, or None with a fault noted."""
    try:
        number = Decimal(text.strip())
    except InvalidOperation:
        faults.add(where, text, "is not a number", _SYNTAX)
        return None
    if not number.is_finite():
        faults.add(where, text, "must be finite", _SYNTAX)
        return None
    exponent = number.as_tuple().exponent
    # Read exactly, 1e999999 would fill the memory.
    if number and (number.adjusted() > _MAX_DIGITS or int(exponent) < -_MAX_DIGITS):
        faults.add(where, text, f"has more than {_MAX_DIGITS} digits before or after the point", "round it")
        return None
    return Fraction(number)


def _check_steps(faults: FaultList, where: str, text: str, parts: list[Fraction]) -> None:
    """Note a step that is zero, too small, leads away from the stop, or misses the stop."""
    start, stop, step = parts
    if step == 0:
        faults.add(where, text, "the step must not be 0", _SYNTAX)
        return
    steps = (stop - start) / step
    if steps < 0:
        faults.add(where, text, "the step leads away from the stop", "reverse the sign of the step")
    elif steps >= MAX_VALUES:
        faults.add(where, text, f"gives more than {MAX_VALUES} values", "take a larger step")
    elif steps.denominator != 1:
        nearest = float(start + floor(steps) * step), float(start + (floor(steps) + 1) * step)
        fix = f"stop at {nearest[0]:g} or {nearest[1]:g}, or change the step"
        faults.add(where, text, "the stop is not a whole number of steps from the start", fix)


def parse_range(text: str, where: str) -> NDArray[np.float64]:
    """Return the numbers of ``start:stop:step``, both ends included exactly, or a single number, shape (n,).

    Parameters
    ----------
    text : the user's text.
    where : the option's name, for messages.

    Raises
    ------
    InvalidInputError : not numbers, a step that is 0, leads away from the stop or misses it, too many values.

    >>> parse_range("0:0.3:0.1", "--alpha").tolist()
    [0.0, 0.1, 0.2, 0.3]
    >>> parse_range("5", "--alpha").tolist()
    [5.0]
    """
    faults = FaultList()
    pieces = str(text).split(":")
    if len(pieces) not in (1, 3):
        faults.add(where, text, f"has {len(pieces)} numbers instead of 1 or 3", _SYNTAX)
        faults.raise_if_any()
    parts = [part for piece in pieces if (part := _exact(faults, where, piece)) is not None]
    faults.raise_if_any()
    if len(parts) == 1:
        return np.array([float(parts[0])])
    _check_steps(faults, where, text, parts)
    faults.raise_if_any()
    start, stop, step = parts
    # In whole units of the common denominator every value is exact, and its quotient rounded only once.
    unit = lcm(start.denominator, step.denominator)
    count = int((stop - start) / step) + 1
    return np.array([(int(start * unit) + i * int(step * unit)) / unit for i in range(count)])
