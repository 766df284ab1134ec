"""What a species says to a reader, as the blocks of a report: every number with its source."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from wingbeat._base import Block, Line, Report, Row, Table, cf, for_people, plain_unit
from wingbeat.animal.species_schema import Number, display

if TYPE_CHECKING:
    from wingbeat.animal.species.record import Species

_NUMBERS = ("number", "value", "unit", "plausible", "source")
_FREE = ("quantity", "bounds", "unit", "reason")
_PLAUSIBLE = ("quantity", "minimum", "maximum", "unit", "at [m/s]", "source")


def species_report(animal: Species) -> Report:
    """Return every number of a species with its source, the bounds of free parameters, and the plausible ranges.

    Parameters
    ----------
    animal : the species.
    """
    names = ", ".join(name for name in (animal.common_name, animal.scientific_name, animal.kind) if name)
    sources: dict[str, int] = {}
    blocks: list[Block] = [Line(f"{animal.name}{': ' if names else ''}{names}")]
    blocks += [*_titled("numbers"), _numbers(animal.numbers, sources)]
    blocks += [*_titled("free parameters, and limits that hold throughout the wingbeat"), _free(animal)]
    if animal.plausible:
        blocks += [*_titled("plausible ranges"), _plausible(animal, sources)]
    for name, other in animal.alternatives.items():
        blocks += [*_titled(f"alternative {name}: {other.reason}"), _numbers(other.numbers, sources)]
    if animal.shape:
        blocks += [*_titled("shape, which only drawings use"), _numbers(animal.shape.numbers, sources)]
    blocks += [*_titled("sources"), *(Line(f"[{number}] {source}") for source, number in sources.items())]
    return [*blocks, *(Line(f"warning: {warning}", tone="warning") for warning in animal.warnings)]


def bound_cells(path: str, limits: tuple[float, float]) -> tuple[str, str, str]:
    """Return name, bounds and unit of a parameter or of a limit along the path, with angles in degrees.

    Parameters
    ----------
    path : of the parameter, as in species files.
    limits : its bounds, SI and radians.

    >>> bound_cells("wingbeat.frequency", (1.0, 30.0))
    ('wingbeat.frequency', '1 to 30', 'Hz')
    """
    name, shown = display(path, Number(0.0, plain_unit(path), range=limits))
    low, high = shown.range or limits
    return name, f"{low:g} to {high:g}", "" if shown.unit == "1" else shown.unit


def _titled(title: str) -> tuple[Line, Line]:
    return Line(""), Line(title, tone="title")


def _mark(source: str, sources: dict[str, int]) -> str:
    """Return the number of a source: sources are long and shared, so they are numbered and listed below."""
    return f"[{sources.setdefault(source, len(sources) + 1)}]" if source else ""


def _numbers(numbers: Mapping[str, Number], sources: dict[str, int]) -> Table:
    rows = []
    for path, number in numbers.items():
        name, shown = display(path, number)
        limits = f"{shown.range[0]:g} to {shown.range[1]:g}" if shown.range else ""
        value = shown.value if isinstance(shown.value, tuple) else (shown.value,)
        unit = "" if shown.unit == "1" else shown.unit
        name = name if path == "vehicle.mass" else name.removeprefix("vehicle.")  # as --set takes them
        told = ", ".join(f"{each:g}" for each in value) if len(value) < 6 else f"{len(value)} stations"
        rows.append(Row((name, told, unit, limits, _mark(shown.source, sources))))
    return Table(tuple(rows), _NUMBERS, "nrlrr")


def _free(animal: Species) -> Table:
    rows = []
    bounds = {f"wingbeat.{name}": limits for name, limits in animal.bounds.items()}
    for path, limits in (bounds | animal.path_bounds).items():
        short = path.removeprefix("wingbeat.")
        guess = "guess: " if short in animal.guessed_bounds else ""
        rows.append(Row((*bound_cells(path, limits), guess + animal.reasons[short].removeprefix("guess: "))))
    return Table(tuple(rows), _FREE, "nrll")


def _plausible(animal: Species, sources: dict[str, int]) -> Table:
    """Return the plausible ranges of a beat's quantities; those of parameters are in the other table."""
    rows = []
    for name, known in animal.plausible.items():
        factor, unit = for_people(cf(known.unit))
        low, high = ("" if end is None else f"{factor * end:g}" for end in known[:2])
        speeds = "{:g} to {:g}".format(*known.speeds) if known.speeds else ""
        rows.append(Row((name, low, high, unit, speeds, _mark(known.source, sources))))
    return Table(tuple(rows), _PLAUSIBLE, "nrrlrr")
