"""Limits of quantities and of wingbeat parameters, as values and as texts."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from typing import Any, NamedTuple

from wingbeat.errors import FaultList
from wingbeat.kinematics import ANGLES, FREE_NAMES
from wingbeat.orbits.problem.quantities import NUMBER, Quantity, named_quantity


@dataclass(frozen=True)
class Constraint:
    """A limit on a quantity.

    Parameters
    ----------
    quantity : a `Quantity`, or the name of one.
    limit : in the unit of the quantity.
    at_most : True for an upper limit, False for a lower one. A limit on a series applies to its maximum:
        an upper limit therefore holds at every instant, a lower limit at one instant or more.

    Raises
    ------
    InvalidInputError : an unknown quantity, a limit that is not finite.

    >>> import wingbeat as wb
    >>> limit = wb.Constraint("peak_power", 30.0)
    >>> str(limit)
    'peak_power<=30'
    >>> wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0, subject_to=[limit]).subject_to == (limit,)
    True
    """

    quantity: Quantity
    limit: float
    at_most: bool = True

    def __post_init__(self) -> None:
        faults = FaultList()
        if isinstance(self.quantity, str):
            object.__setattr__(self, "quantity", named_quantity(self.quantity))
        if not isinstance(self.quantity, Quantity):
            faults.add("constraint.quantity", self.quantity, "is not a Quantity", "give a Quantity or its name")
        faults.number("constraint.limit", self.limit)
        faults.raise_if_any()

    def __str__(self) -> str:
        return f"{self.quantity.name}{'<=' if self.at_most else '>='}{self.limit:g}"


_EXPRESSION = re.compile(rf"\s*([\w.+-]+(?:\([^()]*\))?)\s*(<=|>=)\s*({NUMBER})\s*(deg)?\s*")


def parse_constraint(text: str) -> Constraint:
    """Return the constraint in a text such as ``peak_power<=30`` or ``body_pitch_range <= 10 deg``.

    Raises
    ------
    InvalidInputError : a text not of that form, an unknown quantity, degrees for a quantity that is not an angle.

    >>> str(parse_constraint("peak_power <= 30"))
    'peak_power<=30'
    """
    faults = FaultList()
    found = _EXPRESSION.fullmatch(str(text))
    if found is None:
        fix = "for example peak_power<=30 or 'body_pitch_range <= 10 deg'"
        faults.add("constraint", text, "must be a quantity, <= or >=, and a number", fix)
        faults.raise_if_any()
    assert found is not None
    name, sign, number, degrees = found.groups()
    quantity = named_quantity(name)
    if degrees and quantity.unit != "rad":
        faults.add("constraint", text, f"gives {name} in degrees, but its unit is {quantity.unit}", "leave out deg")
    faults.raise_if_any()
    limit = math.radians(float(number)) if degrees else float(number)
    return Constraint(quantity, limit, sign == "<=")


class WingbeatLimit(NamedTuple):
    """A wingbeat parameter fixed at a value (``=``), or limited to it from above or below, SI and radians."""

    name: str
    sign: str
    value: float


_LIMIT = re.compile(rf"\s*(\w+)\s*(<=|>=|=)\s*({NUMBER})\s*(deg)?\s*")


def parse_wingbeat_limit(text: Any) -> WingbeatLimit | None:
    """Return the limit of a wingbeat parameter in a text, or None if the text has another meaning.

    The result is also None for an upper or lower limit of the frequency, which is a constraint like any other.

    >>> parse_wingbeat_limit("frequency = 6").value
    6.0
    """
    found = _LIMIT.fullmatch(text) if isinstance(text, str) else None
    if found is None or found[1] not in FREE_NAMES or (found[4] and found[1] not in ANGLES):
        return None
    if found[1] == "frequency" and found[2] != "=":
        return None
    value = float(found[3])
    return WingbeatLimit(found[1], found[2], math.radians(value) if found[4] else value)
