"""The style of all figures: colours, lines, sizes, and functions that all panels share."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PAGE, COLUMN, INCH = 183.0, 89.0, 25.4  # mm: two columns of a journal, and one
FONT = 7.0  # points

# Okabe and Ito's colours, which colour-blind eyes tell apart.
BLUE, VERMILION, GREEN = "#0072B2", "#D55E00", "#009E73"
PURPLE, ORANGE, SKY = "#CC79A7", "#E69F00", "#56B4E9"
ALARM, GOOD = "#C00000", "#1B7F3B"
GREY, SHADE, TINT = "0.45", "0.91", "#D6E6F2"
# A schematic animal or robot: back, breast, head, wing, tip of the wing, bill.
SCHEMATIC = {
    "bird": ("#8a8f98", "#b9bdc4", "#7b808a", "#9a9fa8", "#5d626c", "#4a4d55"),
    "bat": ("#7d6a5b", "#9c8a79", "#75624f", "#5b4a40", "#4a3b33", "#4a3b33"),
    "robot": ("#4c535e", "#5d6570", "#4c535e", "#b9c4d0", "#a3afbd", "#4c535e"),
}

# Each line has a dash of its own, and each series of points a mark, for grey prints.
FIRST: dict[str, Any] = {"color": BLUE, "linestyle": "-"}
SECOND: dict[str, Any] = {"color": VERMILION, "linestyle": (0, (4, 1.5))}
THIRD: dict[str, Any] = {"color": GREEN, "linestyle": (0, (1, 1))}
MARKED = ((BLUE, "o"), (VERMILION, "s"), (GREEN, "^"), (PURPLE, "D"), (ORANGE, "v"), (SKY, "P"), ("k", "X"))

_STYLE: dict[str, Any] = {
    "font.family": "sans-serif",
    "lines.linewidth": 1.1,
    "axes.labelpad": 2,
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "grid.color": "0.92",
    "grid.linewidth": 0.6,
    "legend.frameon": False,
}


@contextmanager
def drawing(font: float = FONT) -> Iterator[None]:
    """Apply this style, with a font size [points], in a block or a decorated function, and no longer."""
    from matplotlib import rc_context

    with rc_context({**_STYLE, "font.size": font}):  # type: ignore[arg-type]
        yield


def new_figure(width: float, height: float) -> Figure:
    """Return an empty figure of a width and a height [mm]; a notebook shows it as the last value of a cell."""
    from wingbeat._base.notebook_figure import NotebookFigure

    return NotebookFigure(figsize=(width / INCH, height / INCH), layout="constrained")


def dress(axes: Axes, xlabel: str, ylabel: str) -> None:
    """Name the axes and style their ticks."""
    axes.set(xlabel=xlabel, ylabel=ylabel)
    axes.tick_params(labelsize=FONT, length=2, pad=2)  # set here, because ticks are made only when drawn
    axes.ticklabel_format(style="plain", useOffset=False)  # a common factor would stand in the legend
    axes.locator_params(nbins=6)


def shade_downstrokes(
    axes: Axes, first: float, last: float, strokes: Sequence[tuple[float, float]] | None = None
) -> None:
    """Shade the downstrokes between two phases, the axis' limits; by default, the first half of every beat."""
    from matplotlib.collections import PolyCollection

    axes.set_xlim(first, last)
    halves = [(start, start + 0.5) for start in range(math.floor(first), math.ceil(last))]
    shaded = halves if strokes is None else strokes
    boxes = [[(start, 0), (end, 0), (end, 1), (start, 1)] for start, end in shaded]
    # One collection and not a patch each: a flight may have thousands of beats.
    shade = PolyCollection(boxes, facecolor=SHADE, linewidth=0, zorder=0, gid="downstroke")
    shade.set_transform(axes.get_xaxis_transform())
    axes.add_collection(shade, autolim=False)


def letter_panels(panels: Any) -> None:
    """Write a small bold letter above the upper left corner of each panel, from a on."""
    corner: dict[str, Any] = {"xycoords": "axes fraction", "textcoords": "offset points"}
    for i, axes in enumerate(np.ravel(panels)):
        axes.annotate(chr(ord("a") + i), (0, 1), (-26, 4), fontsize=FONT + 1, fontweight="bold", **corner)


def legend_above(axes: Axes, handles: Any = None, columns: int = 3, **options: Any) -> None:
    """Put a legend of one or more lines above the panel, where it cannot overlap a curve."""
    spacing = {"borderaxespad": 0, "handlelength": 1.5, "handletextpad": 0.4, "columnspacing": 0.8}
    place: dict[str, Any] = {"loc": "lower left", "bbox_to_anchor": (-0.03, 1.01), "ncols": columns}
    named = {} if handles is None else {"handles": handles}
    axes.legend(fontsize=FONT, **place, **spacing, **named, **options)


def legend_below(figure: Figure, panels: Any, columns: int = 4) -> None:
    """Put one legend for all panels below them."""
    handles: dict[str, Any] = {}
    for axes in np.ravel(panels):
        handles |= dict(zip(*reversed(axes.get_legend_handles_labels()), strict=True))
    figure.legend(handles.values(), handles.keys(), loc="outside lower center", ncols=columns)
