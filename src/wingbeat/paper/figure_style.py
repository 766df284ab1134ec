"""How the figures of the paper look: sheets of a journal's width, one look per coefficient model, tables."""

from __future__ import annotations

import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLUMN, PAGE = 89.0, 183.0  # mm: one and two columns of a journal
INCH = 25.4
FONT, FONT_SMALL = 7.0, 6.5
_LINE = 3.2
# Mean width of a letter of the notes over its height.
_LETTER = 0.545
STYLE: dict[str, Any] = {"font.family": "sans-serif", "font.size": FONT, "lines.linewidth": 1.1}
STYLE |= {"axes.labelpad": 2, "axes.linewidth": 0.6, "axes.spines.top": False, "axes.spines.right": False}
GREY, SHADE, ALARM = "0.45", "0.91", "#C00000"
MEASURED = "#009E73"

Row = Mapping[str, Any]
Table = Sequence[Row]


@dataclass(frozen=True)
class Look:
    """A coefficient model's name for readers, and its colour, dash and marker: any one of them tells it."""

    name: str
    color: str
    dashes: Any
    marker: str

    @property
    def line(self) -> dict[str, Any]:
        """Colour and dash, as matplotlib wants them."""
        return {"color": self.color, "linestyle": self.dashes}


# Okabe and Ito's blue and vermilion; solid and dashed as in the paper.
LOOKS = {
    "su-fan": Look("Su-Fan", "#0072B2", "-", "o"),
    "dickinson": Look("Dickinson", "#D55E00", (0, (4, 1.5)), "s"),
}


def sheet(width: float, height: float, note: str, alarm: str = "") -> Figure:
    """Return an empty figure with a note below its panels.

    Parameters
    ----------
    width, height : of the figure, and of its panels alone [mm].
    note : what a reader must know; wrapped.
    alarm : what is missing, in red above the note.
    """
    from matplotlib.figure import Figure

    letters = int(width / (FONT * _LETTER * INCH / 72))
    lines = [(line, color) for text, color in ((alarm, ALARM), (note, "k")) for line in _wrapped(text, letters)]
    foot = 2.0 + _LINE * len(lines)
    total = height + foot
    figure = Figure(figsize=(width / INCH, total / INCH), layout="constrained")
    layout: Any = figure.get_layout_engine()
    layout.set(rect=(0, foot / total, 1, height / total), w_pad=0.04, h_pad=0.04, wspace=0.02, hspace=0.03)
    for i, (line, color) in enumerate(lines):
        y = (foot - 0.8 - _LINE * i) / total
        figure.text(2 / width, y, line, va="top", fontsize=FONT, color=color, parse_math=False)
    return figure


def _wrapped(text: str, letters: int) -> list[str]:
    return textwrap.wrap(text, letters, break_on_hyphens=False) if text else []


def dress(axes: Axes, xlabel: str, ylabel: str) -> None:
    """Name the axes; ticks are styled here because matplotlib makes them only when it draws."""
    axes.set(xlabel=xlabel, ylabel=ylabel)
    axes.tick_params(labelsize=FONT, length=2, pad=2)
    axes.ticklabel_format(style="plain", useOffset=False)
    axes.locator_params(nbins=6)


def dress_cycle(axes: Axes, ylabel: str) -> None:
    """Prepare a panel over one period, its downstroke shaded."""
    dress(axes, "time t/T [-]", ylabel)
    axes.axvspan(0.0, 0.5, facecolor=SHADE, linewidth=0, zorder=0, gid="downstroke")
    axes.set_xlim(0.0, 1.0)
    axes.axhline(0.0, color=GREY, linewidth=0.5, zorder=1)


def letter_panels(panels: Any) -> None:
    """Write A, B, C, ... above the panels' upper left corners."""
    for letter, axes in zip("ABCDEFGHIJ", np.ravel(panels), strict=False):
        place = {"xycoords": "axes fraction", "textcoords": "offset points"}
        axes.annotate(letter, (0, 1), (-24, 5), fontsize=8, fontweight="bold", annotation_clip=False, **place)


def legend_above(axes: Axes, handles: Any = None, columns: int = 3) -> None:
    """Put a legend in lines above the panel, where no curve can cross it."""
    spacing = {"borderaxespad": 0, "handlelength": 2.2, "handletextpad": 0.4, "columnspacing": 0.9}
    place: dict[str, Any] = {"loc": "lower left", "bbox_to_anchor": (0.0, 1.02), "ncols": columns}
    named = {} if handles is None else {"handles": handles}
    axes.legend(frameon=False, fontsize=FONT, **place, **spacing, **named)


def say(axes: Axes, words: str) -> None:
    """Write in an empty panel why it is empty."""
    middle: dict[str, Any] = {"ha": "center", "va": "center", "transform": axes.transAxes, "backgroundcolor": "w"}
    axes.set(xticks=[], yticks=[])
    axes.text(0.5, 0.5, textwrap.fill(words, 28), color=ALARM, fontsize=FONT, parse_math=False, **middle)
