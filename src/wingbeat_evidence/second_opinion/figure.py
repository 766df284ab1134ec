"""Lift and thrust over the beat, from our loads and from a vortex lattice on the same motion."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import heading
from wingbeat._base.style import (
    FIRST,
    PAGE,
    SECOND,
    SKY,
    THIRD,
    drawing,
    legend_below,
    letter_panels,
    new_figure,
    shade_downstrokes,
)
from wingbeat_evidence.second_opinion.comparison import SecondOpinion

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_THEIRS: dict[str, Any] = {"color": "k", "linewidth": 1.6}
_OURS = {
    ("none", "none"): ("ours, coefficients alone", FIRST),
    ("thin-aerofoil", "none"): ("ours with rotation and added mass", SECOND),
    ("none", "momentum"): ("ours with momentum inflow", THIRD),
    ("thin-aerofoil", "momentum"): ("ours with both", {"color": SKY, "linestyle": (0, (6, 1, 1, 1))}),
}


@drawing()
def second_opinion_page(opinion: SecondOpinion) -> Figure:
    """Draw lift and thrust of both wings, divided by the weight, and the share of strips beyond 15 degrees.

    Parameters
    ----------
    opinion : from `compare_with_lattice`.
    """
    figure = new_figure(PAGE, 92.0)
    figure.suptitle(
        f"{heading(opinion.species)} at {opinion.speed:.4g} m/s: our loads and a vortex lattice, same motion",
        fontsize=8.5,
        parse_math=False,
    )
    panels = figure.subplots(2, 2, sharex=True, height_ratios=(4, 1))
    share = np.mean(opinion.beyond, axis=-1)
    for axes, below, force in zip(*panels, ("lift", "thrust"), strict=True):
        _draw_force(axes, opinion, force)
        shade_downstrokes(below, 0.0, 1.0, opinion.strokes)
        look = {"step": "mid", "facecolor": "none", "edgecolor": "0.3", "hatch": "/////", "linewidth": 0.6}
        below.fill_between(_closed(opinion.phase, 1.0), _closed(share), label="strips beyond 15 deg", **look)
        below.set(ylim=(0, 1), yticks=(0, 1), ylabel="share of\nstrips [-]")
        below.set_xlabel("phase t/T [-], downstroke shaded")
    legend_below(figure, panels, columns=3)
    letter_panels(panels[0])
    return figure


def _draw_force(axes: Axes, opinion: SecondOpinion, force: str) -> None:
    shade_downstrokes(axes, 0.0, 1.0, opinion.strokes)
    axes.axhline(0.0, color="0.6", linewidth=0.6)
    phase = _closed(opinion.phase, 1.0)
    axes.plot(phase, _closed(getattr(opinion.theirs, force)) / opinion.weight, label="vortex lattice", **_THEIRS)
    for terms, (label, style) in _OURS.items():
        if (loads := opinion.ours[terms]) is not None:
            axes.plot(phase, _closed(getattr(loads, force)) / opinion.weight, label=label, **style)
    axes.set_ylabel(f"{force} of both wings / weight [-]")


def _closed(values: np.ndarray, more: float = 0.0) -> np.ndarray:
    """Return the samples of a beat, with the first one repeated at the end."""
    return np.append(values, values[0] + more)
