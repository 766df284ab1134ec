"""How an animal looks: outline of the wing, body and colours. Drawings use it, no model does."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from wingbeat._base import FaultList, InvalidInputError, is_number
from wingbeat.animal.species.numbers import (
    COLOUR,
    COLOURS,
    COVERS,
    DEFAULT,
    EXTREMITIES,
    NO_COLOUR,
    SHAPE,
    TRUNK,
    Number,
    ShapeText,
)

# The drawn wing has the area of the model's: the mean of its chord is one mean chord, to this fraction.
_AREA = 0.02
# Edges and a colour that stand in for missing ones, so that their faults do not hide others.
_STAND_IN = {"leading_edge": (0.25, 0.25), "trailing_edge": (0.75, 0.75)}
_BLACK = f"#{0:06x}"
_LONGEST = 100.0  # m


@dataclass(frozen=True)
class Shape:
    """How an animal or a robot looks.

    Edges of the wing are at equally spaced stations from root to tip, in mean chords from the pitch axis, which is
    the quarter chord of the model's strips; an edge on the other side of the axis is negative.

    Parameters
    ----------
    cover : ``"feathers"``, ``"membrane"`` or ``"film"``.
    leading_edge : ahead of the pitch axis, positive forward.
    trailing_edge : behind the pitch axis, positive backward; the chord, the sum of both, has the mean 1.
    body_length : of trunk, neck and head, without bill and tail [m].
    body_width, body_depth : largest width and depth of the body [m].
    colours : of back, breast, head, wing, wing_tip and bill, each ``"#rrggbb"``.
    camber, thickness : of the wing, over the local chord.
    head_length : part of the body's length [m].
    bill_length, ear_length, tail_length, tail_width : [m], 0 without one.
    numbers : the same numbers by their paths in a species file, with unit, source and plausible range; those not
        given have no source.

    Raises
    ------
    InvalidInputError : an unknown cover or colour, edges of unequal length or that cross, a mean chord other than
        1, a length that is not positive, a number that is not finite; all faults at once.

    >>> import wingbeat as wb
    >>> swift = wb.load_species("common-swift").shape
    >>> swift.cover, swift.schematic
    ('feathers', True)
    """

    cover: str
    leading_edge: tuple[float, ...]
    trailing_edge: tuple[float, ...]
    body_length: float
    body_width: float
    body_depth: float
    colours: dict[str, str]
    camber: float = 0.0
    thickness: float = 0.0
    head_length: float = 0.0
    bill_length: float = 0.0
    ear_length: float = 0.0
    tail_length: float = 0.0
    tail_width: float = 0.0
    numbers: dict[str, Number] = field(default_factory=dict)

    def __post_init__(self) -> None:
        faults = FaultList()
        faults.choice("shape.cover", self.cover, COVERS)
        self._check_edges(faults)
        for name in ("camber", "thickness"):
            faults.number(f"shape.{name}", getattr(self, name), at_least=0, at_most=0.5)
        for name in TRUNK:
            faults.number(f"shape.{name}", getattr(self, name), above=0, at_most=_LONGEST, unit="m")
        for name in EXTREMITIES:
            faults.number(f"shape.{name}", getattr(self, name), at_least=0, at_most=_LONGEST, unit="m")
        lengths = self.body_length, self.head_length
        if all(map(is_number, lengths)) and self.head_length > self.body_length > 0:
            faults.add("shape.head_length", self.head_length, "is longer than the body", "the head is a part of it")
        given = self.colours if isinstance(self.colours, Mapping) else {}
        for name in COLOURS:
            colour = given.get(name)
            if not isinstance(colour, str) or not re.fullmatch(COLOUR, colour):
                faults.add(f"shape.colours.{name}", colour, *NO_COLOUR)
        faults.raise_if_any()
        numbers = {}
        for key in SHAPE:
            # As it was given with its source; its value alone if it has none or was replaced.
            value, known = getattr(self, key.name), self.numbers.get(key.path)
            source = DEFAULT if not key.required and value == 0 else ""
            kept = known is not None and known.value == value
            numbers[key.path] = known if kept else Number(value, key.unit, source)
        object.__setattr__(self, "numbers", numbers)

    def _check_edges(self, faults: FaultList) -> None:
        sound, leading, trailing = True, self.leading_edge, self.trailing_edge
        for name, edge in zip(_STAND_IN, (leading, trailing), strict=True):
            where = f"shape.{name}"
            if not isinstance(edge, list | tuple) or len(edge) < 2:
                fix = "give it at equally spaced stations from root to tip"
                faults.add(where, edge, "must hold at least 2 numbers", fix)
                sound = False
            elif all([faults.number(f"{where}[{i}]", p, at_least=-100, at_most=100) for i, p in enumerate(edge)]):
                object.__setattr__(self, name, tuple(float(place) for place in edge))
            else:
                sound = False
        if not sound:
            return
        if len(leading) != len(trailing):
            rule = f"has {len(trailing)} stations, the leading edge {len(leading)}"
            faults.add("shape.trailing_edge", trailing, rule, "give both edges at the same stations")
            return
        chord = [ahead + behind for ahead, behind in zip(leading, trailing, strict=True)]
        for i, local in enumerate(chord):
            if local < 0:
                fix = f"give at least {-leading[i]:g}, where the chord is zero"
                faults.add(f"shape.trailing_edge[{i}]", trailing[i], "is ahead of the leading edge", fix)
        mean = (sum(chord) - 0.5 * (chord[0] + chord[-1])) / (len(chord) - 1)
        if min(chord) >= 0 and not abs(mean - 1.0) <= _AREA:
            rule = f"gives, with the leading edge, a mean chord of {mean:.4g} mean chords; it must be 1"
            faults.add("shape.trailing_edge", trailing, rule, f"divide both edges by {mean:.4g}" if mean else "")

    @property
    def schematic(self) -> bool:
        """Whether some of it is a guess: drawn by eye, not measured."""
        return any(number.source.startswith("guess") for number in self.numbers.values())

    def drawn(self) -> dict[str, Any]:
        """Return what a drawing needs, fit for JSON: everything but units, sources and ranges."""
        plain = {one.name: getattr(self, one.name) for one in dataclasses.fields(self) if one.name != "numbers"}
        edges = {name: list(plain[name]) for name in _STAND_IN}
        return {**plain, **edges, "colours": dict(self.colours), "schematic": self.schematic}


def shape_of(text: ShapeText | None, faults: FaultList) -> Shape | None:
    """Return the shape that a file's table [shape] describes, if any; what is missing in it is noted already."""
    if text is None:
        return None
    given = {path.removeprefix("shape."): number.value for path, number in text.numbers.items()}
    if not _STAND_IN.keys() <= given.keys():
        given |= _STAND_IN
    colours = {name: text.texts.get(f"shape.colours.{name}", _BLACK) for name in COLOURS}
    missing = {name: _LONGEST for name in TRUNK if name not in given}
    values: dict[str, Any] = given | missing
    try:
        return Shape(
            text.texts.get("shape.cover", COVERS[0]), **values, colours=colours, numbers=dict(text.numbers)
        )
    except InvalidInputError as error:
        faults.faults += [text.numbers.quote(fault) for fault in error.faults]
        return None
