"""The tornado plot: which uncertain number moves an answer most."""

from __future__ import annotations

import math
import textwrap
from typing import TYPE_CHECKING, Any

from wingbeat._base import label_of, written
from wingbeat._base.style import (
    BLUE,
    PAGE,
    VERMILION,
    drawing,
    heading,
    in_words,
    legend_below,
    letter_panels,
    new_figure,
)
from wingbeat.results.sensitivities import Sensitivities

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_ROW, _HEAD = 6.5, 24.0  # mm
_LETTERS = 27  # of a line of a label
_MOST = 12


def tornado_page(found: Sensitivities) -> Figure:
    """Rank parameters by the first-order effect of their plausible ranges on each quantity, the largest on top.

    Parameters without a range are left out. Each quantity has a panel; the line in the middle is the solved orbit.
    Bars are shares of the largest, because a linear approximation over whole ranges gives no valid error bar. A
    quantity that a limit has set has no bars.

    Parameters
    ----------
    found : from `wingbeat.sensitivities`.

    >>> import wingbeat as wb
    >>> pigeon = wb.load_species("pigeon")
    >>> found = wb.sensitivities(wb.solve_orbit(wb.OrbitProblem(pigeon, speed=10.0), starts=1))
    >>> len(wb.plots.tornado_page(found).axes)
    2
    """
    count = min(_MOST, sum(s.parameter.plausible is not None for s in found.slopes))
    with drawing():
        figure = new_figure(PAGE, _HEAD + _ROW * count)
        problem = found.problem
        title = (
            f"{heading(problem.species.name)} at {problem.speed:g} m/s, minimum {in_words(problem.minimise.name)}"
        )
        figure.suptitle(title, fontsize=8, parse_math=False)
        panels = figure.subplots(1, len(found.values), squeeze=False)[0]
        for panel, name in zip(panels, found.values, strict=True):
            _draw(panel, found, name)
        letter_panels(panels)
        legend_below(figure, panels[0], columns=2)
    return figure


def _draw(panel: Any, found: Sensitivities, name: str) -> None:
    ranked = [s for s in found.ranked(name) if s.parameter.plausible is not None][:_MOST]
    largest = max((abs(end) for slope in ranked for end in found.swing(slope, name)), default=0.0) or 1.0
    label = f"change of {in_words(name)} / largest [-]"
    if name in found.limited:
        # Its changes are rounding; as shares of the largest they would look like an answer.
        largest = math.inf
        label = f"{in_words(name)}: {written(found.values[name], unit=found.units[name])}, set by the limit"
    for row, slope in enumerate(ranked):
        low, high = found.swing(slope, name)
        for change, color, end in ((low, BLUE, "low end of the range"), (high, VERMILION, "high end")):
            panel.barh(row, change / largest, height=0.7, color=color, label=end if row == 0 else None)
    panel.spines["left"].set_visible(False)
    panel.axvline(0.0, color="0.2", linewidth=0.8)
    panel.set_yticks(
        range(len(ranked)),
        [textwrap.fill(label_of(s.parameter.path), _LETTERS, break_on_hyphens=False) for s in ranked],
    )
    panel.tick_params(axis="y", length=0)
    panel.invert_yaxis()
    panel.margins(y=0.01)
    panel.set_xlabel(label)
