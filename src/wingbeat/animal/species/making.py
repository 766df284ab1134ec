"""A species by its name, from a file, or from mass, span and area, where laws or guesses give the other numbers."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping
from numbers import Real
from pathlib import Path
from typing import Any

from wingbeat._base import FaultList, read_text, suggest
from wingbeat.animal.species.building import (
    UNNAMED_PATHS,
    WHOLE,
    build_records,
    check_bounds,
    check_parts,
    complete_parts,
    default_of,
    derive_body,
    find_warnings,
    lacks_muscle,
    plain,
    weigh_wing,
)
from wingbeat.animal.species.deriving import BAT, BIRD, ROBOT, Kind, bat_beat, derive, single
from wingbeat.animal.species.file_schema import has_shape
from wingbeat.animal.species.numbers import (
    DEFAULT,
    KEYS,
    Bound,
    Number,
    Numbers,
    SpeciesText,
    in_order,
    shown,
    spoken,
    to_si,
)
from wingbeat.animal.species.reading import packaged_text, read_species_text, species_names
from wingbeat.animal.species.scaling import frequencies_by_law, tail_numbers
from wingbeat.animal.species.shape import shape_of
from wingbeat.animal.species.species import Species

# Nose straight up or down: the limit where a file sets none.
_UPRIGHT = (-math.pi / 2, math.pi / 2)
_PATH = {
    "body_pitch": Bound(_UPRIGHT, "no limit given: nose straight down to straight up", True),
    "flap": Bound(_UPRIGHT, "no limit given: wing straight down to straight up", True),
}
_SEPARATORS = [separator for separator in ("/", os.sep, os.altsep) if separator]
_LARGEST = 1 << 18  # bytes; the built-in files have 12 000


def load_species(name_or_path: str | os.PathLike[str]) -> Species:
    """Return a built-in species by its name, or your own from a TOML file.

    Parameters
    ----------
    name_or_path : ``"pigeon"``, ``"bat"``, or a path; a text that ends in .toml or contains a separator is a path.

    Raises
    ------
    InvalidInputError : an unknown name, or everything that is wrong with the file, all at once.
    FileError : the file is missing, unreadable, or not TOML.

    >>> load_species("bat").free
    ('frequency', 'flap_mean', 'flap_amplitude', 'pitch_mean', 'pitch_amplitude')
    """
    name, faults = name_or_path, FaultList()
    if isinstance(name, str) and name in species_names():
        content = read_species_text(packaged_text(name), f"{name}.toml", name, faults, packaged=True)
        return species_of(content, faults)
    if isinstance(name, str) and not (name.endswith(".toml") or any(s in name for s in _SEPARATORS)):
        known = suggest(name.lower(), species_names()).replace("?", "")
        if os.path.isfile(name):
            faults.add("species", name, "is not a species file", "its name must end in .toml, or name an animal")
        else:
            faults.add("species", name, "is not a built-in species", f"{known}; or give the path of a .toml file")
    elif not isinstance(name, str | os.PathLike):
        faults.add("species", name, "must be a name or a path", f"the names are {', '.join(species_names())}")
    faults.raise_if_any()
    text = read_text(name, limit=_LARGEST)
    return species_of(read_species_text(text, os.fspath(name), Path(name).stem, faults), faults)


def species_of(content: SpeciesText, faults: FaultList) -> Species:
    """Return the species that a text describes, or refuse it with the faults noted before and all others."""
    numbers: dict[str, Number] = dict(content.numbers)
    weigh_wing(numbers, content.numbers)
    for other in content.alternatives.values():
        weigh_wing(other.numbers, other.numbers)
    if WHOLE in numbers:
        derive_body(numbers, content.numbers, faults)
    path = _PATH | content.path
    bounds = content.free | path
    check_bounds(content, faults)
    check_parts(numbers, faults)
    records = build_records(numbers, content.numbers, faults)
    for other in content.alternatives.values():
        build_records(other.numbers, other.numbers, faults)
    shape = shape_of(content.shape, faults)
    faults.raise_if_any()
    complete_parts(numbers)
    for key in KEYS:
        if key.path not in numbers and key.path not in UNNAMED_PATHS:
            default = records["vehicle"].mass if key.path == WHOLE else default_of(key.path)
            source = "body.mass and both wings" if key.path == WHOLE else DEFAULT
            numbers[key.path] = Number(default, key.unit, source)
    numbers, drawn = in_order(numbers), shape.numbers if shape else {}
    free = {name: bound.bounds for name, bound in content.free.items()}
    species = Species(
        name=content.name,
        common_name=content.common_name,
        scientific_name=content.scientific_name,
        kind=content.kind,
        free=tuple(free),
        bounds=free,
        guessed_bounds=frozenset(key for key, bound in bounds.items() if bound.guessed),
        path_bounds={key: bound.bounds for key, bound in path.items()},
        reasons={key: bound.reason for key, bound in bounds.items()},
        numbers=numbers,
        alternatives=content.alternatives,
        plausible=content.plausible,
        frequencies=tuple(content.frequencies) or frequencies_by_law(content.kind, numbers),
        warnings=find_warnings(numbers, drawn, tuple(free), free, records["vehicle"], records["wingbeat"]),
        shape=shape,
        **records,
    )
    for name, other in content.alternatives.items():
        if species.kind or not lacks_muscle(numbers | other.numbers):  # without a kind there are no laws of muscle
            species.with_alternative(name)  # which refuses one that is impossible
    return species


# What may be given beside mass, span and area: every number of a species file by its own name, which includes the
# part's name only for a wing's mass and a tail's numbers.
_MEASURED = {
    path.split(".", 1)[1].replace(".", "_")
    if key.part == "tail" or key.path == "vehicle.wing.mass"
    else path.rpartition(".")[2]: (path, key)
    for key in KEYS
    if key.path not in ("vehicle.mass", "vehicle.body.mass")
    for path in key.spellings
}
# Limits within which the laws work: shares of the whole mass or the span; wide limits for the rest.
_SHARES = {"wing_mass": ("mass", 1e-6, 0.5), "semi_span": ("wing_span", 0.01, 1.0)}
_LIMITS = {"frequency": (1e-3, 1e4), "density": (1e-3, 1e3), "gravity": (1e-3, 1e3)}
# A span is longer than its chord; one of more than a hundred chords is a slip of units.
_MOST_CHORDS = 100.0


def bird(
    *,
    mass: float,
    wing_span: float,
    wing_area: float,
    name: str = "bird",
    common_name: str = "",
    scientific_name: str = "",
    tail: bool = False,
    **measured: Any,
) -> Species:
    """Return a bird from its mass, wing span and wing area.

    The rest follows from published scaling laws. Each such number's source says ``derived``, the law and where it
    was read; its plausible range is the spread of animals around the law.

    Parameters
    ----------
    mass : of the whole bird [kg].
    wing_span : tip to tip [m].
    wing_area : both wings and the body between them [m2].
    name, common_name, scientific_name : its names.
    tail : whether it gets a tail, spread by 60 degrees, from the laws of `wingbeat.animal.species.scaling`.
    measured : any number of a species file, by its name; it replaces the one from the laws: ``wing_mass``,
        ``pitch_inertia``, ``semi_span``, ``chord``, ``frequency``, ``flap_amplitude_deg``, ``density``,
        ``tail_area`` and so on.

    Raises
    ------
    InvalidInputError : a number that is not positive or not finite, an area larger than the square of the span, or
        an unknown name; all faults are listed at once.

    >>> import wingbeat as wb
    >>> crow = wb.bird(mass=0.3, wing_span=0.62, wing_area=0.06)
    >>> crow.numbers["vehicle.wing.mass"].source[:38]
    'derived: 0.0706 m^1.098 at m = 0.3 kg '
    """
    size = {"mass": mass, "wing_span": wing_span, "wing_area": wing_area}
    return _species(BIRD, size, (name, common_name, scientific_name), measured, tail=tail)


def bat(
    *,
    mass: float,
    wing_span: float,
    wing_area: float,
    name: str = "bat",
    common_name: str = "",
    scientific_name: str = "",
    **measured: Any,
) -> Species:
    """Return a bat from its mass, wing span and wing area, with twist and fold.

    The rest follows from published scaling laws, as in `bird`. No law of bats' wing mass was found: 7 % of the
    whole mass for each wing is a guess, and its source says so.

    Parameters
    ----------
    mass : of the whole bat [kg].
    wing_span : tip to tip [m].
    wing_area : both wings and the body between them [m2].
    name, common_name, scientific_name : its names.
    measured : as in `bird`.

    Raises
    ------
    InvalidInputError : as in `bird`.

    >>> import wingbeat as wb
    >>> wb.bat(mass=0.028, wing_span=0.362, wing_area=0.0163).wingbeat.twist_ratio
    1.6
    """
    size = {"mass": mass, "wing_span": wing_span, "wing_area": wing_area}
    return _species(BAT, size, (name, common_name, scientific_name), measured)


def robot(
    *,
    mass: float,
    wing_span: float,
    wing_area: float,
    frequency_range: tuple[float, float] | None = None,
    name: str = "robot",
    common_name: str = "",
    scientific_name: str = "",
    **measured: Any,
) -> Species:
    """Return a flapping robot from its mass [kg], wing span [m] and wing area [m2], like `bird`.

    The wings are rigid. No law of robots was found. Masses and inertias are scaled by isometry from single robots;
    the stock frequency is that of a bird of this size. Give the numbers that you know of your robot.

    Parameters
    ----------
    mass, wing_span, wing_area, name, common_name, scientific_name, measured : as in `bird`.
    frequency_range : lowest and highest wingbeat frequency of its motor [Hz]; by default a wide guess,
        and a warning says so if an orbit is at one of these bounds.

    Raises
    ------
    InvalidInputError : as in `bird`, and a frequency range that is not (lowest, highest).

    >>> import wingbeat as wb
    >>> wb.robot(mass=0.026, wing_span=0.62, wing_area=0.055, frequency_range=(1, 5)).bounds["frequency"]
    (1.0, 5.0)
    """
    size = {"mass": mass, "wing_span": wing_span, "wing_area": wing_area}
    return _species(ROBOT, size, (name, common_name, scientific_name), measured, frequency_range)


def _species(
    kind: Kind,
    size: dict[str, Any],
    names: tuple[Any, Any, Any],
    measured: Mapping[str, Any],
    frequency_range: Any = None,
    tail: Any = False,
) -> Species:
    faults = FaultList()
    if not isinstance(tail, bool):
        faults.add("tail", shown(tail), "must be True or False", "give its numbers as tail_area= and so on")
    for where, text in zip(("name", "common_name", "scientific_name"), names, strict=True):
        good = isinstance(text, str) and text.isprintable() and text.strip() == text
        if not good or (where == "name" and not text):
            faults.add(where, shown(text), "must be a text on one line", "for example 'jackdaw'")
    content = SpeciesText(*names, kind.name)
    _check_size(size, faults)
    for name, value in measured.items():
        _put(content.numbers, name, plain(value), size, faults)
    limits = None if frequency_range is None else _checked_range(frequency_range, faults)
    faults.raise_if_any()
    mass, span, area = (float(value) for value in size.values())
    # The law of bats' amplitude, a logarithm, gives no wingbeat for some areas.
    if kind is BAT and "wingbeat.flap_amplitude" not in content.numbers and single(bat_beat(mass, area)[1]) <= 0:
        rule = "is outside the range of the law for bats' flap_amplitude"
        faults.add("wing_area", area, rule, "give flap_amplitude=")
    faults.raise_if_any()
    derive(kind, content, mass, span, area, limits)
    for path, number in tail_numbers(mass).items() if tail else ():
        content.numbers.setdefault(path, number)
    content.numbers.written["vehicle.mass"] = "mass", size["mass"]
    return species_of(content, faults)


def _check_size(size: dict[str, Any], faults: FaultList) -> None:
    mass, span, area = size.values()
    faults.number("mass", mass, at_least=1e-6, at_most=1e3, unit="kg", fix="give the whole mass in kg")
    tips, both = "give the span tip to tip in m", "give the area of both wings in m2"
    known = faults.number("wing_span", span, at_least=1e-3, at_most=1e2, unit="m", fix=tips)
    if not faults.number("wing_area", area, above=0, unit="m2", fix=both) or not known:
        return
    if area > span * span:
        faults.add("wing_area", area, f"is larger than the square of the span, {span * span:g} m2", "use m and m2")
    elif area * _MOST_CHORDS < span * span:
        rule = f"is less than {1 / _MOST_CHORDS:g} of the square of the span"
        faults.add("wing_area", area, rule, "use m and m2")


def _put(numbers: Numbers, name: str, value: Any, size: dict[str, Any], faults: FaultList) -> None:
    """Add a measured number, or note why it cannot be one."""
    if name not in _MEASURED:
        faults.add(spoken(name), shown(value), "is not a number of a species", suggest(name, _MEASURED))
        return
    path, key = _MEASURED[name]
    if not has_shape(key.shape, value, name, faults):
        return
    if key.path in numbers:
        faults.add(name, shown(value), f"is given as {numbers.written[key.path][0]} too", "keep one of the two")
        return
    if name in _LIMITS:
        low, high = _LIMITS[name]
        if not faults.number(name, value, at_least=low, at_most=high):
            return
    elif name in _SHARES and isinstance(size[_SHARES[name][0]], Real):
        whole, low, high = _SHARES[name]
        if not low * size[whole] <= value <= high * size[whole]:
            rule = f"must be {low:g} to {high:g} times the {whole} of {size[whole]:g}"
            faults.add(name, value, rule, "give that of one wing, in kg or m")
            return
    numbers.put(key, Number(to_si(value, path), key.unit, "given"), name, value)


def _checked_range(limits: Any, faults: FaultList) -> tuple[float, float] | None:
    where = "frequency_range"
    if not isinstance(limits, tuple | list) or len(limits) != 2:
        faults.add(where, shown(limits), "must be (lowest, highest)", "give both in Hz")
    elif all([faults.number(where, value, above=0, unit="Hz") for value in limits]):
        if limits[0] < limits[1]:
            return float(limits[0]), float(limits[1])
        faults.add(where, limits, "must have its low end below its high end", "write (lowest, highest)")
    return None
