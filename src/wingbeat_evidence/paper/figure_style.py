"""The look of the paper's figures: as wide as a journal page or column, one style for each coefficient model."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from wingbeat._base.style import ALARM, FIRST, FONT, GREEN, GREY, INCH, SECOND, dress, new_figure, shade_downstrokes

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

FONT_SMALL = 6.5
_LINE = 3.2
# Mean width of a letter, divided by its height.
_LETTER = 0.545
MEASURED = GREEN

Row = Mapping[str, Any]
Table = Sequence[Row]


class Drawn(NamedTuple):
    """A figure, the numbers that it draws, and the caption to print below it."""

    figure: Figure
    table: Table
    caption: str


@dataclass(frozen=True)
class Look:
    """A coefficient model's displayed name, colour, dash and marker; each of these alone identifies the model."""

    name: str
    color: str
    dashes: Any
    marker: str

    @property
    def line(self) -> dict[str, Any]:
        """Colour and dash, as matplotlib wants them."""
        return {"color": self.color, "linestyle": self.dashes}


# Solid and dashed as in the paper.
LOOKS = {
    "su-fan": Look("Su-Fan", FIRST["color"], FIRST["linestyle"], "o"),
    "dickinson": Look("Dickinson", SECOND["color"], SECOND["linestyle"], "s"),
}


def sheet(width: float, height: float, alarm: str = "") -> Figure:
    """Return an empty figure, with a warning below its panels if results are missing.

    Parameters
    ----------
    width, height : of the figure, and of its panels alone [mm].
    alarm : text about missing results; it is wrapped and red.
    """
    letters = int(width / (FONT * _LETTER * INCH / 72))
    lines = textwrap.wrap(alarm, letters, break_on_hyphens=False)
    foot = 2.0 + _LINE * len(lines) if lines else 0.0
    total = height + foot
    figure = new_figure(width, total)
    layout: Any = figure.get_layout_engine()
    layout.set(rect=(0, foot / total, 1, height / total), w_pad=0.04, h_pad=0.04, wspace=0.02, hspace=0.03)
    for i, line in enumerate(lines):
        y = (foot - 0.8 - _LINE * i) / total
        figure.text(2 / width, y, line, va="top", fontsize=FONT, color=ALARM, parse_math=False)
    return figure


def dress_cycle(axes: Axes, ylabel: str) -> None:
    """Prepare a panel with an axis of one period and the downstroke shaded."""
    dress(axes, "time t/T [-]", ylabel)
    shade_downstrokes(axes, 0.0, 1.0)
    axes.axhline(0.0, color=GREY, linewidth=0.5, zorder=1)


def say(axes: Axes, words: str) -> None:
    """Write into an empty panel why it is empty."""
    middle: dict[str, Any] = {"ha": "center", "va": "center", "transform": axes.transAxes, "backgroundcolor": "w"}
    axes.set(xticks=[], yticks=[])
    axes.text(0.5, 0.5, textwrap.fill(words, 28), color=ALARM, fontsize=FONT, parse_math=False, **middle)
