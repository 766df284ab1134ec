"""From the name of a species, or the path of a file, to its record."""

from __future__ import annotations

import dataclasses
import math
import os
from pathlib import Path

from wingbeat._base import FaultList, read_text, suggest
from wingbeat.animal.species.building import (
    DEFAULT,
    UNNAMED_PATHS,
    WHOLE,
    build_records,
    check_bounds,
    check_parts,
    complete_parts,
    default_of,
    derive_body,
    in_order,
)
from wingbeat.animal.species.record import Species
from wingbeat.animal.species.shape import shape_of
from wingbeat.animal.species.warnings import find_warnings
from wingbeat.animal.species_schema import (
    KEYS,
    Bound,
    Number,
    SpeciesText,
    packaged_text,
    read_species_text,
    species_names,
)

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
        return _build(packaged_text(name), f"{name}.toml", name)
    if isinstance(name, str) and not (name.endswith(".toml") or any(s in name for s in _SEPARATORS)):
        known = suggest(name.lower(), species_names()).replace("?", "")
        if os.path.isfile(name):
            faults.add("species", name, "is not a species file", "its name must end in .toml, or name an animal")
        else:
            faults.add("species", name, "is not a built-in species", f"{known}; or give the path of a .toml file")
    elif not isinstance(name, str | os.PathLike):
        faults.add("species", name, "must be a name or a path", f"the names are {', '.join(species_names())}")
    faults.raise_if_any()
    return _build(read_text(name, limit=_LARGEST), os.fspath(name), Path(name).stem)


def _build(text: str, label: str, name: str) -> Species:
    faults = FaultList()
    return species_of(read_species_text(text, label, name, faults), faults)


def species_of(content: SpeciesText, faults: FaultList) -> Species:
    """Return the species that a text describes.

    Raises
    ------
    InvalidInputError : the faults noted before, and everything else that is wrong with it.
    """
    numbers: dict[str, Number] = dict(content.numbers)
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
    species = Species(
        name=content.name,
        common_name=content.common_name,
        scientific_name=content.scientific_name,
        kind=content.kind,
        free=tuple(content.free),
        bounds={key: bound.bounds for key, bound in content.free.items()},
        guessed_bounds=frozenset(key for key, bound in bounds.items() if bound.guessed),
        path_bounds={key: bound.bounds for key, bound in path.items()},
        reasons={key: bound.reason for key, bound in bounds.items()},
        numbers=in_order(numbers),
        alternatives=content.alternatives,
        plausible=content.plausible,
        warnings=(),
        shape=shape,
        **records,
    )
    for other in content.alternatives.values():
        species._patched(other.numbers, faults)
    return dataclasses.replace(species, warnings=find_warnings(species))
