"""How an animal looks: numbers and texts that only drawings use."""

from __future__ import annotations

from wingbeat._base.nomenclature.term import Term

_EDGE = "at equally spaced stations from root to tip, in mean chords; the pitch axis is the strips' quarter chord"
SHAPE = (
    Term("cover", "", "what covers the wing", "", "what covers the wing: feathers, membrane or film"),
    Term("leading_edge", "1", "leading edge of the wing", "", f"distance ahead of the pitch axis {_EDGE}"),
    Term("trailing_edge", "1", "trailing edge of the wing", "", f"distance behind the pitch axis {_EDGE}"),
    Term("camber", "1", "camber of the wing", "", "largest height of the camber line over the local chord"),
    Term("shape.thickness", "1", "thickness of the wing", "", "largest thickness of the wing over the local chord"),
    Term("body_length", "m", "length of the body", "", "length of trunk, neck and head, without bill and tail"),
    Term("body_width", "m", "largest width of the body"),
    Term("body_depth", "m", "largest depth of the body"),
    Term("head_length", "m", "length of the head", "", "length of the head, a part of the body's length"),
    Term("bill_length", "m", "length of the bill", "", "length of the bill ahead of the head"),
    Term("ear_length", "m", "length of the ears", "", "length of the ears above the head"),
    Term("tail_length", "m", "length of the tail", "", "length of the tail behind the body"),
    Term("tail_width", "m", "largest width of the tail"),
    Term("colours.back", "", "colour of the back"),
    Term("colours.breast", "", "colour of the breast and belly"),
    Term("colours.head", "", "colour of the head"),
    Term("colours.wing", "", "colour of the wing"),
    Term("colours.wing_tip", "", "colour of the wing's tip"),
    Term("colours.bill", "", "colour of the bill or snout"),
)
