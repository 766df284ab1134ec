"""A unit in three spellings: for data sets, for plain text, and for readers."""

from __future__ import annotations

import math
import re

_IN_DEGREES = math.degrees(1.0)


def cf(unit: str) -> str:
    """Return a unit as data sets write it, without a slash; a unit that is already written so does not change.

    >>> cf("m/s2"), cf("kg/m3"), cf("N m"), cf("1/deg"), cf("m s-2")
    ('m s-2', 'kg m-3', 'N m', 'deg-1', 'm s-2')
    """
    above, *below = unit.split("/")
    factors = [above] if above != "1" or not below else []
    for part in " ".join(below).split():
        found = re.fullmatch(r"(\D+)(\d*)", part)
        if found is None:  # a user's own unit, which we leave as it is
            return unit
        factors.append(f"{found[1]}-{found[2] or 1}")
    return " ".join(factors)


def plain(unit: str) -> str:
    """Return a unit of a data set as species files and messages write it, with a slash.

    >>> plain("m s-2"), plain("kg m2 s-1"), plain("deg-1"), plain("N m"), plain("foot-pounds")
    ('m/s2', 'kg m2/s', '1/deg', 'N m', 'foot-pounds')
    """
    above, below = [], []
    for part in unit.split():
        found = re.fullmatch(r"(\D+)-(\d+)", part)
        if found is None:
            above.append(part)
        else:
            below.append(found[1] + ("" if found[2] == "1" else found[2]))
    return "/".join([" ".join(above) or "1", *below]) if below else unit


def for_people(unit: str) -> tuple[float, str]:
    """Return the unit that readers prefer (degrees for angles) and the factor to it; the factor comes first.

    >>> for_people("m s-1"), for_people("1"), for_people("rad s-1")[1]
    ((1.0, 'm/s'), (1.0, ''), 'deg/s')
    """
    if unit.split()[:1] == ["rad"]:
        return _IN_DEGREES, plain(unit.replace("rad", "deg", 1))
    return 1.0, "" if unit == "1" else plain(unit)
