"""Limits of quantities and of wingbeat parameters, as values and as texts."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from wingbeat._base import FaultList, InvalidInputError
from wingbeat.animal.kinematics import ANGLES, FREE_NAMES
from wingbeat.orbits.problem.quantities import NUMBER, QUANTITIES, Quantity, named_quantity


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
    InvalidInputError : an unknown quantity, a limit that is not finite, an angle above pi.

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
        if QUANTITIES.get(self.quantity.name) == self.quantity and self.quantity.unit == "rad":
            advice = f"write '{self} deg' or np.radians({self.limit:g})"
            faults.angle("constraint.limit", self.limit, advice=advice)
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


def read_limits(given: Sequence[Any], faults: FaultList) -> tuple[list[WingbeatLimit], list[Constraint]]:
    """Return the limits of wingbeat parameters and those of quantities; of two on the same side, the tighter one.

    Parameters
    ----------
    given : texts and constraints.
    faults : receives what is not a limit, angles in degrees, and limits that contradict each other.

    >>> [str(one) for one in read_limits(["peak_power<=30", "peak_power<=40", "peak_power<=30.0"], FaultList())[1]]
    ['peak_power<=30']
    """
    parameters: dict[tuple[str, str], WingbeatLimit] = {}
    quantities: dict[tuple[str, str], Constraint] = {}
    for i, one in enumerate(given):
        limit = parse_wingbeat_limit(one)
        if limit is not None:
            if limit.name not in ANGLES or faults.angle(limit.name, limit.value, advice=f"write '{one} deg'"):
                _add(parameters, (limit.name, limit.sign), limit, limit.value, faults)
            continue
        try:
            constraint = parse_constraint(one) if isinstance(one, str) else one
        except InvalidInputError as error:
            faults.faults.extend(error.faults)
            continue
        if isinstance(constraint, Constraint):
            sign = "<=" if constraint.at_most else ">="
            _add(quantities, (constraint.quantity.name, sign), constraint, constraint.limit, faults)
        else:
            faults.add(f"subject_to[{i}]", one, "is not a constraint", "for example 'peak_power<=30'")
    return list(parameters.values()), list(quantities.values())


def _add(
    kept: dict[tuple[str, str], Any], key: tuple[str, str], limit: Any, value: float, faults: FaultList
) -> None:
    """Keep a limit unless there is a tighter one on the same side; note one that contradicts another."""
    name, sign = key
    values = {side: _value(kept[name, side]) for side in ("=", "<=", ">=") if (name, side) in kept}
    if sign == "=" and values.get("=", value) != value:
        faults.add("subject_to", f"{name}={value:g}", f"is fixed at {values['=']:g} too", "keep one of the two")
    elif sign != "=" and (other := values.get(">=" if sign == "<=" else "<=")) is not None:
        lower, upper = (other, value) if sign == "<=" else (value, other)
        if lower > upper:
            rule = f"contradicts {name}{'>=' if sign == '<=' else '<='}{other:g}"
            faults.add("subject_to", f"{name}{sign}{value:g}", rule, "keep one of the two, or exchange the signs")
    if sign not in values or (value < values[sign] if sign == "<=" else value > values[sign]):
        kept[key] = limit


def _value(limit: WingbeatLimit | Constraint) -> float:
    return limit.value if isinstance(limit, WingbeatLimit) else limit.limit
