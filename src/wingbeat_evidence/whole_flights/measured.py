"""Measurements of whole flights: a TOML file for each animal, with a source for every number."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from wingbeat._base import FaultList, is_number, plain_unit, read_text, suggest, toml_tables

# What can be compared; the nomenclature has units and words.
COMPARED = (
    "frequency",
    "flap_amplitude_deg",
    "positive_power_per_mass",
    "muscle_power_per_mass",
    "muscle_work_per_mass",
    "metabolic_rate",
    "net_muscle_efficiency",
    "flight_efficiency",
    "peak_activation",
    "minimum_power_speed",
)
# How a number was found: measured on the animal, with a model of air or body, or by a law of other animals.
BASES = ("measured", "estimated", "law")
_OF_CURVE = "minimum_power_speed"
_KEYS = ("quantity", "basis", "values", "what", "source")
_FASTEST = 60.0


@dataclass(frozen=True)
class Measurement:
    """One number of a flight: measured, estimated, or from a law.

    Attributes
    ----------
    quantity : one of `COMPARED`.
    basis : ``"measured"`` on the animal, ``"estimated"`` with a model, or ``"law"``, from a law fitted to other
        animals.
    speeds : lowest and highest flight speed to which it applies [m/s]; None for the speed of minimum power.
    values : lowest and highest value, in the unit of the nomenclature; if a mean was published, the mean minus and
        plus one standard deviation.
    what : which and how many animals, and what the two values are.
    source : where it is published; in the package's files, with a grade before it: A read in the source, B in an
        abstract, C second-hand, D computed from these.
    """

    quantity: str
    basis: str
    speeds: tuple[float, float] | None
    values: tuple[float, float]
    what: str
    source: str

    @property
    def unit(self) -> str:
        """Unit of the values."""
        return plain_unit(self.quantity)


@dataclass(frozen=True)
class MeasuredFlights:
    """The measurements of an animal's flights.

    Attributes
    ----------
    species : name of a built-in species, or of a species file beside this one.
    speeds : speeds at which to fly the species [m/s], increasing; they include each speed of a measurement at a
        single speed.
    measurements : the numbers to compare with.

    >>> import wingbeat_evidence as evidence
    >>> flights = evidence.read_measured_flights("pigeon")
    >>> flights.species, len(flights.measurements)
    ('pigeon', 9)
    """

    species: str
    speeds: tuple[float, ...]
    measurements: tuple[Measurement, ...]


def measured_animals() -> list[str]:
    """Return the names of the animals whose measured flights the package holds.

    >>> "pigeon" in measured_animals()
    True
    """
    return sorted(path.stem for path in _folder().glob("*.toml"))


def read_measured_flights(name: str | Path) -> MeasuredFlights:
    """Read the measured flights of an animal.

    A file has ``species``, ``speeds`` [m/s] and tables ``[[measured]]``. Each table has the keys ``quantity``,
    ``basis``, ``values``, ``what``, ``source`` and, except for the speed of minimum power, ``speeds``. Values and
    speeds are a lowest and a highest number.

    Parameters
    ----------
    name : an animal of `measured_animals`, or the path of a file.

    Raises
    ------
    FileError : the file is missing or cannot be read.
    InvalidInputError : unknown keys or quantities, numbers out of range; all faults of the file at once.

    >>> flights = read_measured_flights("pigeon")
    >>> flights.measurements[0].quantity, flights.measurements[0].unit
    ('frequency', 'Hz')
    """
    own = str(name) in measured_animals()
    path = _folder() / f"{name}.toml" if own else Path(name)
    given = toml_tables(read_text(path), str(path))
    faults = FaultList()
    for key in set(given) - {"species", "speeds", "measured"}:
        faults.add(f"{path.name}, {key!r}"[:100], "", "is not a known key", "give species, speeds, measured")
    species, rows = given.get("species"), given.get("measured")
    if not isinstance(species, str) or not species:
        faults.add(f"{path.name}, species", species, "must name a species", "such as pigeon")
        species = ""
    if not isinstance(rows, list) or not rows or not all(isinstance(row, dict) for row in rows):
        faults.add(f"{path.name}, measured", "", "holds no measurement", "add a table [[measured]]")
        rows = []
    speeds = _speeds(faults, f"{path.name}, speeds", given.get("speeds"))
    found = [_measurement(faults, f"{path.name}, measured {i}", row) for i, row in enumerate(rows, start=1)]
    faults.raise_if_any()
    if not own and species.endswith(".toml"):
        species = str(path.parent / species)
    single = {one.speeds[0] for one in found if one.speeds is not None and one.speeds[0] == one.speeds[1]}
    return MeasuredFlights(species, tuple(sorted({*speeds, *single})), tuple(found))


def _folder() -> Path:
    return Path(__file__).parent.parent / "data" / "whole_flights"


def _speeds(faults: FaultList, where: str, given: Any) -> list[float]:
    if not isinstance(given, list) or not given or not all(is_number(one) for one in given):
        faults.add(where, given, "must be a list of speeds in m/s", "such as [6, 8, 10]")
        return []
    for one in given:
        faults.number(where, one, at_least=0, at_most=_FASTEST)
    return [float(one) for one in given]


def _measurement(faults: FaultList, where: str, row: dict[str, Any]) -> Measurement:
    of_curve = row.get("quantity") == _OF_CURVE
    needed = _KEYS if of_curve else (*_KEYS, "speeds")
    for key in [key for key in row if key not in needed]:
        faults.add(f"{where}, {key!r}"[:100], "", "is not a key of this measurement", suggest(key, needed))
    for key in [key for key in needed if key not in row]:
        faults.add(f"{where}, {key}", "", "is missing", f"give {', '.join(needed)}")
    faults.choice(f"{where}, quantity", row.get("quantity", "frequency"), COMPARED)
    faults.choice(f"{where}, basis", row.get("basis", "measured"), BASES)
    for key in ("what", "source"):
        if key in row and (not isinstance(row[key], str) or not row[key].strip()):
            faults.add(f"{where}, {key}", row[key], "must be words")
    values = _pair(faults, f"{where}, values", row.get("values", [1, 1]), math.inf)
    speeds = None if of_curve else _pair(faults, f"{where}, speeds", row.get("speeds", [1, 1]), _FASTEST)
    words = [str(row.get(key, "")) for key in ("quantity", "basis", "what", "source")]
    return Measurement(words[0], words[1], speeds, values, words[2], words[3])


def _pair(faults: FaultList, where: str, given: Any, most: float) -> tuple[float, float]:
    if not isinstance(given, list) or len(given) != 2 or not all(is_number(one) for one in given):
        faults.add(where, given, "must be a lowest and a highest number", "such as [7.3, 8.7]")
        return 1.0, 1.0
    for one in given:
        faults.number(where, one, at_least=0, at_most=most)
    if given[0] > given[1]:
        faults.add(where, given, "falls", "give the lower number first")
    return float(given[0]), float(given[1])
