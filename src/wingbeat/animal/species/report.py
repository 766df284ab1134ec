"""What a species says of itself: every number with its source, bounds, plausible ranges and alternatives."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from wingbeat._base import Block, Line, Report, Row, Table, cf, for_people
from wingbeat.animal.species.numbers import ALL_SPEEDS, Bound, Number, OwnFrequency, Range, bound_cells, display


def species_report(animal: Any) -> Report:
    """Return every number of a `Species` with its source, bounds of free parameters, and plausible ranges."""
    names = ", ".join(name for name in (animal.common_name, animal.scientific_name, animal.kind) if name)
    bounds = {f"wingbeat.{name}": limits for name, limits in animal.bounds.items()} | animal.path_bounds
    own = {path: path.removeprefix("wingbeat.") for path in bounds}
    told = {path: Bound(bounds[path], animal.reasons[n], n in animal.guessed_bounds) for path, n in own.items()}
    sources: dict[str, int] = {}
    blocks: list[Block] = [Line(f"{animal.name}{': ' if names else ''}{names}")]
    blocks += [*number_blocks("numbers", animal.numbers, sources), *bound_blocks(told)]
    blocks += [*range_blocks(animal.plausible, sources), *frequency_blocks(animal.frequencies, sources)]
    for name, other in animal.alternatives.items():
        blocks += number_blocks(f"alternative {name}: {other.reason}", other.numbers, sources)
    if animal.shape is not None:
        blocks += number_blocks("shape, which only drawings use", animal.shape.numbers, sources)
    return [*blocks, *last_blocks(sources, animal.warnings)]


def number_blocks(title: str, numbers: Mapping[str, Number], sources: dict[str, int]) -> list[Block]:
    """Return numbers, each with its source, which is added to the numbered `sources`."""
    rows = []
    for path, number in numbers.items():
        name, shown = display(path, number)
        limits = f"{shown.range[0]:g} to {shown.range[1]:g}" if shown.range else ""
        value = shown.value if isinstance(shown.value, tuple) else (shown.value,)
        unit = "" if shown.unit == "1" else shown.unit
        name = name if path == "vehicle.mass" else name.removeprefix("vehicle.")  # as --set takes them
        told = ", ".join(f"{each:g}" for each in value) if len(value) < 6 else f"{len(value)} stations"
        rows.append(Row((name, told, unit, limits, _mark(shown.source, sources))))
    columns = ("number", "value", "unit", "plausible", "source")
    return [*_titled(title), Table(tuple(rows), columns, "nrlrr")]


def bound_blocks(bounds: Mapping[str, Bound]) -> list[Block]:
    """Return the bounds of free parameters, and of the path, whose names have no ``wingbeat.`` before them."""
    rows = []
    for path, bound in bounds.items():
        guess = "guess: " if bound.guessed else ""
        rows.append(
            Row(
                (
                    *bound_cells(path, bound.bounds),
                    guess + bound.reason.removeprefix("guess: ").removeprefix("guess; "),
                )
            )
        )
    title = "free parameters, and limits that hold throughout the wingbeat"
    return [*_titled(title), Table(tuple(rows), ("quantity", "bounds", "unit", "reason"), "nrll")]


def range_blocks(plausible: Mapping[str, Range], sources: dict[str, int]) -> list[Block]:
    """Return plausible ranges of quantities of the beat; those of parameters stand with the numbers."""
    rows = []
    for name, known in plausible.items():
        factor, unit = for_people(cf(known.unit))
        low, high = ("" if end is None else f"{factor * end:g}" for end in known[:2])
        speeds = "{:g} to {:g}".format(*known.speeds) if known.speeds else ""
        rows.append(Row((name, low, high, unit, speeds, _mark(known.source, sources))))
    columns = ("quantity", "minimum", "maximum", "unit", "at [m/s]", "source")
    return [*_titled("plausible ranges"), Table(tuple(rows), columns, "nrrlrr")] if rows else []


def frequency_blocks(frequencies: Sequence[OwnFrequency], sources: dict[str, int]) -> list[Block]:
    """Return the frequencies at which the animal beats."""
    rows = []
    for own in frequencies:
        low, high = own.range
        speeds = "{:g} to {:g}".format(*own.speeds) if own.speeds != ALL_SPEEDS else ""
        cells = (own.basis, f"{own.value:g}", f"{low:g} to {high:g}", speeds, _mark(own.source, sources))
        rows.append(Row(cells))
    columns = ("basis", "frequency [Hz]", "band [Hz]", "at [m/s]", "source")
    return [*_titled("frequencies of its flights"), Table(tuple(rows), columns, "nrlrr")] if rows else []


def last_blocks(sources: dict[str, int], warnings: Sequence[str]) -> list[Block]:
    """Return the numbered sources, and the warnings."""
    listed = (Line(f"[{number}] {source}") for source, number in sources.items())
    return [*_titled("sources"), *listed, *(Line(f"warning: {warning}", tone="warning") for warning in warnings)]


def _titled(title: str) -> tuple[Line, Line]:
    return Line(""), Line(title, tone="title")


def _mark(source: str, sources: dict[str, int]) -> str:
    """Return the number of a source: sources are long and shared, so they are numbered and listed below."""
    return f"[{sources.setdefault(source, len(sources) + 1)}]" if source else ""
