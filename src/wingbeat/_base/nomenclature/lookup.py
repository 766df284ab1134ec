"""The table of names, and how to look up a dotted name in it, as in records, studies and ``--set``.

If the last part of a name has several meanings, the table's name includes the part before it: ``wing.mass``.
"""

from __future__ import annotations

import re

from wingbeat._base.nomenclature.answers import ANSWER, BEAT, STUDY
from wingbeat._base.nomenclature.given import AERO, GIVEN, RUN, WINGBEAT
from wingbeat._base.nomenclature.series import GLIDE, SERIES, SERIES_WHERE_ON
from wingbeat._base.nomenclature.shape import SHAPE
from wingbeat._base.nomenclature.term import Term
from wingbeat._base.nomenclature.units import for_people, plain

NOMENCLATURE: dict[str, Term] = {
    term.name: term
    for term in (*SERIES, *SERIES_WHERE_ON, *GLIDE, *GIVEN, *WINGBEAT, *SHAPE, *BEAT, *AERO, *RUN, *ANSWER, *STUDY)
}
_AXES = ("x", "y", "z")
# A part before or after a name that says which of its numbers is meant.
_ABOUT = {
    "initial_state": "{}, at the top of the stroke",
    "closure": "residual of the {} when re-flown",
    "limit": "limit of the {}",
    "lower": "lower bound of the {}",
    "upper": "upper bound of the {}",
}


def find(path: str) -> Term | None:
    """Return the entry of a dotted name, None if the table has none.

    The longest ending of the name that is in the table is used, so ``wing.mass`` and ``body.mass`` differ. If an
    angle's name ends in ``_deg``, its entry is in degrees.

    >>> find("vehicle.wing.mass").label, find("wingbeat.flap_mean_deg").unit, find("nonsense")
    ('mass of one wing', 'deg', None)
    """
    parts = _named_parts(path)
    for start in range(len(parts)):
        end = ".".join(parts[start:])
        if end in NOMENCLATURE:
            return NOMENCLATURE[end]
        angle = NOMENCLATURE.get(end.removesuffix("_deg"))
        if angle is not None and angle.unit == "rad":
            return angle._replace(name=end, unit="deg")
    return None


def plain_unit(path: str) -> str:
    """Return the unit of a dotted name in plain text, ``1`` if it has none or is not in the table.

    >>> plain_unit("wing.mass"), plain_unit("mean_power"), plain_unit("air.gravity"), plain_unit("wing.shoulder.x")
    ('kg', 'W', 'm/s2', 'm')
    """
    term = find(path)
    return plain(term.unit) if term is not None and term.unit else "1"


def readable_limit(limit: str) -> str:
    """Return a limit of a record, which is in SI units and radians, with its unit and angles in degrees.

    The limit of a quantity that is not in the table does not change.

    >>> readable_limit("body_pitch_range<=0.349066"), readable_limit("peak_power<=30"), readable_limit("mine>=0.5")
    ('body_pitch_range<=20 deg', 'peak_power<=30 W', 'mine>=0.5')
    """
    name, sign, number = re.split(r"(<=|>=)", limit, maxsplit=1)
    term = find(name)
    factor, unit = for_people(term.unit) if term is not None else (1.0, "")
    return f"{name}{sign}{float(number) * factor:.4g} {unit}".rstrip()


def label_of(path: str, short: bool = False) -> str:
    """Return the label, or the short label, of the number at a dotted name; the name itself if the table lacks it.

    >>> label_of("closure.u"), label_of("floquet_multipliers.0.1")
    ('residual of the forward velocity of the body when re-flown', 'Floquet multipliers of the orbit, item 0.1')
    >>> label_of("speed", short=True), label_of("wing.shoulder.x", short=True)
    ('speed', 'position of the shoulder, x')
    """
    term, parts = find(path), path.split(".")
    if term is None:
        return path
    if parts[0] == "constraints":
        return f"{term.label}, limited to {path.partition('.')[2]}"
    label = term.short_label if short else term.label
    for part in (parts[0], parts[-1]) if len(parts) > 1 else ():
        label = _ABOUT.get(part, "{}").format(label)
    items = ".".join(part for part in parts[1:] if part.isdigit())
    if items:
        label += f", item {items}"
    return f"{label}, {parts[-1]}" if parts[-1] in _AXES and "shoulder" in parts else label


def attributes_of(term: Term) -> dict[str, str]:
    """Return the attributes of a data set's variable; texts have no unit, and some names have no symbol."""
    known = {"units": term.unit, "long_name": term.label, "symbol": term.symbol}
    return {key: value for key, value in known.items() if value}


def axis_label(name: str, full: bool = False) -> str:
    """Return a figure's axis label for a quantity: short, or in full with its symbol.

    >>> axis_label("mean_power"), axis_label("frequency")
    ('hinge power, mean [W]', 'wingbeat frequency [Hz]')
    >>> axis_label("speed"), axis_label("speed", full=True)
    ('speed [m/s]', 'mean horizontal speed U [m/s]')
    """
    term = NOMENCLATURE[name]
    words = (term.label, term.symbol) if full else (term.short_label,)
    return " ".join(word for word in (*words, f"[{plain(term.unit)}]") if word)


def _named_parts(path: str) -> list[str]:
    """Return a dotted name's parts without list indices and without the words for bounds and limits."""
    if path.startswith("constraints."):
        path = re.split("[<>=]", path.partition(".")[2])[0]
    # The numbers in the brackets of power_cost(0.5) may hold dots.
    parts = re.sub(r"\(.*\)|\[.*\]", "", path).split(".")
    parts = [part for part in parts if not part.isdigit()]
    if parts[0] == "bounds" and parts[-1] in ("lower", "upper"):
        return parts[1:-1]
    return parts[:-1] if parts[-1] in _AXES and "shoulder" in parts else parts
