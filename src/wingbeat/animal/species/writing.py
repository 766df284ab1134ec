"""A species as the text of a species file: every number with its unit, plausible range and source."""

from __future__ import annotations

import json
import math
import re
import textwrap
from collections.abc import Iterator, Mapping

from wingbeat.animal.species.building import BODY, WHOLE
from wingbeat.animal.species.numbers import ALL_SPEEDS, COLOURS, Number, Range, display
from wingbeat.animal.species.scaling import frequencies_by_law
from wingbeat.animal.species.species import Species

_HEAD = "# SI units; _deg means degrees. A source that begins with derived or guess was not measured."


def species_text(species: Species) -> str:
    """Return the TOML text of a species; `load_species` makes the same species from it, to six digits.

    >>> from wingbeat import load_species
    >>> species_text(load_species("pigeon")).splitlines()[1]
    'name = "pigeon"'
    """
    lines = [_HEAD]
    for name in ("name", "common_name", "scientific_name"):
        lines.append(f"{name} = {_quoted(getattr(species, name))}")
    if species.kind:
        lines.append(f"kind = {_quoted(species.kind)}")
    lines += _tables(species.numbers, "", BODY)
    free = "# Free parameters of an orbit. A warning names a bound that is a guess if an orbit is at it."
    lines += ["", free, "[free]"]
    lines += [_bound(species, name) for name in species.free]
    lines += ["", "# Limits along the whole path, not only at its start.", "[path]"]
    lines += [_bound(species, name) for name in species.path_bounds]
    if species.plausible:
        lines += ["", "# Plausible ranges, with which every orbit is compared."]
    for name, known in species.plausible.items():
        lines += _plausible(name, known)
    by_law = species.frequencies == frequencies_by_law(species.kind, species.numbers)  # then the reader finds them
    for own in () if by_law else species.frequencies:
        lines += ["", "[[frequencies]]", f"value = {_digits(own.value)}", 'unit = "Hz"']
        lines += [f"range = [{_digits(own.range[0])}, {_digits(own.range[1])}]", f"basis = {_quoted(own.basis)}"]
        if own.speeds != ALL_SPEEDS:
            lines.append(f"speeds = [{_digits(own.speeds[0])}, {_digits(own.speeds[1])}]")
        lines += [f"source = {_text(own.source)}"] if own.source else []
    if species.shape is not None:
        cover, colours = species.shape.cover, species.shape.colours
        lines += ["", "# How it looks. Only drawings use it.", "[shape]", f"cover = {_quoted(cover)}"]
        lines += _tables(species.shape.numbers, "", "")
        lines += ["", "[shape.colours]", *(f"{name} = {_quoted(colours[name])}" for name in COLOURS)]
    for name, other in species.alternatives.items():
        table = f"alternatives.{name if re.fullmatch('[A-Za-z0-9_-]+', name) else _quoted(name)}"
        lines += ["", f"[{table}]", f"reason = {_quoted(other.reason)}"]
        lines += _tables(other.numbers, f"{table}.", BODY if WHOLE in other.numbers else "")
    return "\n".join(lines) + "\n"


def _tables(numbers: Mapping[str, Number], prefix: str, left_out: str) -> Iterator[str]:
    for path, number in numbers.items():
        if path == left_out:
            continue
        name, shown = display(path, number)
        values = [_digits(value) for value in (shown.value if isinstance(shown.value, tuple) else (shown.value,))]
        yield from ("", f"[{prefix}{name}]")
        yield f"value = [{', '.join(values)}]" if isinstance(shown.value, tuple) else f"value = {values[0]}"
        yield f"unit = {_quoted(shown.unit)}"
        if shown.range:
            yield f"range = [{_digits(shown.range[0])}, {_digits(shown.range[1])}]"
        if shown.source:
            yield f"source = {_text(shown.source)}"


def _plausible(name: str, known: Range) -> Iterator[str]:
    angle = known.unit == "rad"
    yield from ("", f"[plausible.{name}{'_deg' if angle else ''}]")
    for end in ("low", "high"):
        value = getattr(known, end)
        if value is not None:
            yield f"{end} = {_digits(math.degrees(value) if angle else value)}"
    yield f"unit = {_quoted('deg' if angle else known.unit)}"
    if known.speeds:
        yield f"speeds = [{_digits(known.speeds[0])}, {_digits(known.speeds[1])}]"
    if known.source:
        yield f"source = {_text(known.source)}"


def _bound(species: Species, name: str) -> str:
    limits = (species.path_bounds | species.bounds)[name]
    unit = species.numbers[f"wingbeat.{name}"].unit if name in species.bounds else "rad"
    if unit == "rad":
        unit, limits = "deg", (math.degrees(limits[0]), math.degrees(limits[1]))
        key = f"{name}_deg"
    else:
        key = name
    guessed = "true" if name in species.guessed_bounds else "false"
    pair = f"[{_digits(limits[0])}, {_digits(limits[1])}]"
    reason = _quoted(species.reasons[name])
    return f"{key} = {{ bounds = {pair}, unit = {_quoted(unit)}, guessed = {guessed}, reason = {reason} }}"


def _digits(value: float) -> str:
    text = f"{value:.6g}"
    return text if re.search(r"[.e]", text) else f"{text}.0"


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False)


def _text(text: str) -> str:
    """Return a text in quotes, over several lines if one would be too long; TOML joins the lines again."""
    quoted = _quoted(text)
    if len(quoted) < 100:
        return quoted
    lines = textwrap.wrap(quoted[1:-1], 112, break_long_words=False, break_on_hyphens=False)
    return '"""\n' + "\n".join(lines) + '"""'
