"""Names of quantities with their units and labels, from one table; and numbers as readers see them.

Records, data sets, studies, figures, pages and the explorer use the table, `nomenclature.csv`. Units are SI in CF
form: ``m s-1``. For readers, `plain` writes ``m/s``, `for_people` converts to degrees, and `written` gives a number
the digits that it deserves. If the last part of a dotted name has several meanings, the name in the table includes
the part before it: ``wing.mass``.
"""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

# --- harmonics of a wingbeat: ``flap_sin_2`` is the second number of the list ``flap_harmonics`` ---

# The lowest order of each law's harmonics: what is below it has a name of its own.
FIRST_ORDER = {"flap": 2, "pitch": 2, "span": 1, "sweep": 2, "chord": 1, "twist": 1}
# Laws that are a share of a length; the others are angles.
SHARES = ("span", "chord")
HIGHEST_ORDER = 8
HARMONIC_NAMES = tuple(
    f"{law}_{part}_{order}"
    for law, first in FIRST_ORDER.items()
    for order in range(first, HIGHEST_ORDER + 1)
    for part in ("cos", "sin")
)


def harmonic_place(name: str) -> tuple[str, int] | None:
    """Return the list that holds a harmonic, and its index in it; None if the name is not that of a harmonic.

    >>> harmonic_place("flap_sin_2"), harmonic_place("flap_mean")
    (('flap_harmonics', 1), None)
    """
    if name not in HARMONIC_NAMES:
        return None
    law, part, order = name.split("_")
    return f"{law}_harmonics", 2 * (int(order) - FIRST_ORDER[law]) + (part == "sin")


# --- the table ---


class Term(NamedTuple):
    """One quantity."""

    name: str  # as in records, data sets and species files
    unit: str  # SI, as the CF conventions write it; 1 for a plain number, empty for a text
    label: str  # what to call it; the ``long_name`` in data sets
    symbol: str = ""  # as in the theory, empty if it has none
    meaning: str = ""  # definition, as species files say it; if none is given, the label
    short: str = ""  # label where there is little room, in rows and on axes; if none is given, the label

    @property
    def definition(self) -> str:
        """The meaning, or the label if no meaning is given."""
        return self.meaning or self.label

    @property
    def short_label(self) -> str:
        """The short label, or the label if no short one is given."""
        return self.short or self.label


_GROUPS: dict[str, list[Term]] = {}
with Path(__file__).with_suffix(".csv").open(encoding="utf-8", newline="") as _file:
    for _row in list(csv.reader(_file))[1:]:
        _GROUPS.setdefault(_row[0], []).append(Term(*_row[1:]))
for _name in HARMONIC_NAMES:
    _unit, _label = "1" if _name.startswith(SHARES) else "rad", f"harmonic {_name} of the wingbeat"
    _GROUPS["wingbeat"].append(Term(_name, _unit, _label, meaning="one number of the harmonics"))
NOMENCLATURE: dict[str, Term] = {term.name: term for terms in _GROUPS.values() for term in terms}
# Series of an orbit or a flight. Most flights do not have the second: moving air, laws that are mostly off, and the
# missing loads of a body that moves as filmed.
SERIES, SERIES_WHERE_ON = tuple(_GROUPS["series"]), tuple(_GROUPS["series_where_on"])
# Columns of a glide polar, and what is measured of a plate in a tunnel.
GLIDE, RUN = tuple(_GROUPS["glide"]), tuple(_GROUPS["run"])
# The attribute of a data set that says what it is: an orbit, a flight, a curve, a study.
KIND = "wingbeat_kind"
# The attribute that names what a curve runs over; one over speed has none.
OVER = "over"
# The attribute of an orbit or a flight that says how the animal looks: its kind, and its shape if that is known.
SHAPE = "shape"
# The body's state in the world, as data sets and records name it.
STATE_NAMES = ("x", "z", "body_pitch", "u", "w", "pitch_rate")
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
    if path.startswith("constraints."):
        path = re.split("[<>=]", path.partition(".")[2])[0]
    # Without list indices, and without words for bounds and axes. The numbers in power_cost(0.5) may hold dots.
    parts = [part for part in re.sub(r"\(.*\)|\[.*\]", "", path).split(".") if not part.isdigit()]
    if parts[0] in ("bounds", "limit") and parts[-1] in ("lower", "upper"):
        parts = parts[1:-1]
    elif parts[-1] in _AXES and "shoulder" in parts:
        parts = parts[:-1]
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


# --- what readers call things ---

# What readers call the coefficient models that carry the names of people, and quantities with too short a name.
_WORDS = {"su-fan": "Su-Fan", "dickinson": "Dickinson", "wang": "Wang", "whitney-wood": "Whitney and Wood"}
_WORDS |= {"parslew-crowther": "Parslew and Crowther", "byl": "Byl", "strouhal": "Strouhal number"}
_WORDS |= {"metabolic_power": "metabolic power of the flight muscle", "reynolds": "Reynolds number"}
_WORDS |= {"metabolic_rate": "metabolic rate of the whole animal"}


def in_words(name: str) -> str:
    """Return a program's name of an animal, a model or a quantity as a reader would write it.

    >>> in_words("common-murre"), in_words("su-fan"), in_words("power_cost(-1)")
    ('common murre', 'Su-Fan', 'power cost(-1)')
    """
    return _WORDS.get(name) or re.sub("(?<=[a-z])-(?=[a-z])|_", " ", name)  # a minus sign stays


def heading(name: str) -> str:
    """Return the name of an animal as the first words of a title."""
    words = in_words(name)
    return words[:1].upper() + words[1:]


def climb_text(climb: float) -> str:
    """Return the words for a climb rate [m/s] in a title, after the speed; an empty text for level flight."""
    return f", climbing {climb:.4g} m/s" if climb else ""


# --- units in three spellings: for data sets, for plain text, and for readers ---


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
        return math.degrees(1.0), plain(unit.replace("rad", "deg", 1))
    return 1.0, "" if unit == "1" else plain(unit)


# --- numbers with errors: digits follow the error ---

# Relative tolerance of adaptive flights. Certified orbits agree to `PRECISION`, so a smaller spread is rounding.
RTOL, PRECISION = 1e-10, 1e-6
# Numbers outside this range of powers of ten are written with an exponent.
_LOWEST, _HIGHEST = -4, 6


def written(value: float, error: float | None = None, unit: str = "", digits: int = 4) -> str:
    """Return a number with its error, both to the same decimal, which the error decides.

    The error has two significant digits if they are 10 to 35, and otherwise one: section 5.3, Rounding, of the
    introduction to the Review of Particle Physics (Particle Data Group 2024, doi 10.1103/PhysRevD.110.030001). An
    error below `PRECISION` of the value is rounding, so it is not written. Without an error the value has `digits`
    significant digits; an error of not-a-number is not known; an infinite error means that the value is not
    determined.
    """
    after = f" {unit}" if unit and unit != "1" else ""
    if math.isnan(value):
        return "not known"
    if error is None or math.isinf(value):
        return f"{_significant(value, digits)}{after}"
    if error < 0:
        raise ValueError(f"an error is not negative: {error}")
    if math.isnan(error):
        return f"{_significant(value, digits)} +- ?{after}"
    if math.isinf(error):
        return "not determined"
    if error <= PRECISION * abs(value):
        return f"{_significant(value, digits)}{after} (no spread seen)"
    shown, power = _together([value, error], _last_place(error))
    both = " +- ".join(shown)
    return f"({both})e{power:+03d}{after}" if power else f"{both}{after}"


def written_range(low: float, high: float, unit: str = "", value: float | None = None) -> str:
    """Return an interval, with the value in it if there is one, all to the decimal that half its width decides.

    An infinite end is left out, and not-a-number is not known.
    """
    after = f" {unit}" if unit and unit != "1" else ""
    half = 0.5 * (high - low)
    if math.isnan(half) or (math.isinf(low) and math.isinf(high)):
        return "not determined" if value is None else f"{_significant(value, 4)}{after} (not determined)"
    if math.isinf(high):
        ends = f"at least {_significant(low, 4)}"
    elif math.isinf(low):
        ends = f"at most {_significant(high, 4)}"
    elif half <= PRECISION * max(abs(low), abs(high)):
        return f"{_significant(0.5 * (low + high) if value is None else value, 4)}{after}"
    else:
        numbers = [low, high] if value is None else [value, low, high]
        shown, power = _together(numbers, _last_place(half))
        shown = [f"{text}e{power:+03d}" for text in shown] if power else shown
        ends = " to ".join(shown[-2:])
        if value is not None:
            return f"{shown[0]}{after} ({ends})"
    return f"{ends}{after}" if value is None else f"{_significant(value, 4)}{after} ({ends})"


def _last_place(error: float) -> int:
    """Return the power of ten of the last digit that an error has."""
    first = math.floor(math.log10(error))
    leading = round(error / 10.0 ** (first - 2)) if first > -300 else 100
    # One digit fewer from 355 on; from 950 on that digit rounds to 10, which has two digits again.
    return first - 1 if leading < 355 else first


def _together(numbers: list[float], place: int) -> tuple[list[str], int]:
    """Return numbers rounded at a power of ten, and the exponent that they share, 0 for none."""
    rounded = [float(round(number, -place)) for number in numbers]
    largest = max(map(abs, rounded))
    top = math.floor(math.log10(largest)) if largest else place
    power = 0 if top < _HIGHEST and place >= 2 * _LOWEST and top >= _LOWEST else top
    decimals = max(power - place, 0)
    return [f"{number / 10.0**power + 0.0:.{decimals}f}" for number in rounded], power


def _significant(number: float, digits: int) -> str:
    """Return a number with so many significant digits, without trailing zeros, and without exponent if short."""
    if not math.isfinite(number):
        return f"{number}"
    top = math.floor(math.log10(abs(number))) if number else 0
    if not _LOWEST <= top < _HIGHEST:
        return f"{number:.{digits}g}"
    return f"{float(round(number, digits - 1 - top)) + 0.0:.10g}"


# What a curve, or a continuation, may run over, and its plural.
PLURALS = {"speed": "speeds", "frequency": "frequencies", "share": "shares"}


def over_of(attributes: Mapping[Any, Any]) -> str:
    """Return what the curve with these attributes runs over: ``speed`` or ``frequency``."""
    return str(attributes.get(OVER, "speed"))
