"""What a species says of itself: every number with its source, bounds, plausible ranges and alternatives."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from wingbeat._base import Block, Line, Report, Row, Table, cf, for_people
from wingbeat.animal.species.numbers import (
    ALL_SPEEDS,
    Alternative,
    Bound,
    Number,
    OwnFrequency,
    Range,
    bound_cells,
    display,
)


def report_of(
    head: str,
    numbers: Mapping[str, Number],
    bounds: Mapping[str, Bound],
    plausible: Mapping[str, Range],
    frequencies: Sequence[OwnFrequency],
    alternatives: Mapping[str, Alternative],
    drawn: Mapping[str, Number],
    warnings: Sequence[str],
) -> Report:
    """Return every number with its source, the bounds of free parameters and of the path, and the plausible ranges.

    The names of bounds of the path have no ``wingbeat.`` before them; `drawn` are numbers that only drawings use.
    """
    sources: dict[str, int] = {}
    blocks: list[Block] = [Line(head), *_titled("numbers"), _numbers(numbers, sources)]
    rows = []
    for path, bound in bounds.items():
        guess = "guess: " if bound.guessed else ""
        rows.append(Row((*bound_cells(path, bound.bounds), guess + bound.reason.removeprefix("guess: "))))
    blocks += _titled("free parameters, and limits that hold throughout the wingbeat")
    blocks.append(Table(tuple(rows), ("quantity", "bounds", "unit", "reason"), "nrll"))
    rows = []
    for name, known in plausible.items():  # those of parameters are in the table above
        factor, unit = for_people(cf(known.unit))
        low, high = ("" if end is None else f"{factor * end:g}" for end in known[:2])
        speeds = "{:g} to {:g}".format(*known.speeds) if known.speeds else ""
        rows.append(Row((name, low, high, unit, speeds, _mark(known.source, sources))))
    if rows:
        columns = ("quantity", "minimum", "maximum", "unit", "at [m/s]", "source")
        blocks += [*_titled("plausible ranges"), Table(tuple(rows), columns, "nrrlrr")]
    if frequencies:
        rows = []
        for own in frequencies:
            low, high = own.range
            speeds = "{:g} to {:g}".format(*own.speeds) if own.speeds != ALL_SPEEDS else ""
            rows.append(
                Row((own.basis, f"{own.value:g}", f"{low:g} to {high:g}", speeds, _mark(own.source, sources)))
            )
        columns = ("basis", "frequency [Hz]", "band [Hz]", "at [m/s]", "source")
        blocks += [*_titled("frequencies of its flights"), Table(tuple(rows), columns, "nrlrr")]
    for name, other in alternatives.items():
        blocks += [*_titled(f"alternative {name}: {other.reason}"), _numbers(other.numbers, sources)]
    if drawn:
        blocks += [*_titled("shape, which only drawings use"), _numbers(drawn, sources)]
    blocks += [*_titled("sources"), *(Line(f"[{number}] {source}") for source, number in sources.items())]
    return [*blocks, *(Line(f"warning: {warning}", tone="warning") for warning in warnings)]


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
    return Table(tuple(rows), ("number", "value", "unit", "plausible", "source"), "nrlrr")
