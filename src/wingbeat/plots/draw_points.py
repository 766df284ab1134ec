"""A page of tracked points: the wing in the body's axes, and its angles with the fitted laws and their bands."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING

import numpy as np

from wingbeat._base import heading
from wingbeat._base.style import (
    BLUE,
    GREEN,
    ORANGE,
    PAGE,
    PURPLE,
    SKY,
    VERMILION,
    drawing,
    legend_below,
    letter_panels,
    new_figure,
)
from wingbeat.experiment.point_tables import METRES
from wingbeat.experiment.wing_points import span_of
from wingbeat.plots.draw_experiments import FILM_LABELS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from wingbeat.experiment import PointAngles

_COLOURS = {"wrist": GREEN, "tip": BLUE, "trailing": ORANGE, "leading": PURPLE, "tip_trailing": SKY}
# Letters in a line of a label that is no longer than a panel.
_LABEL = 28


@drawing()
def points_page(found: PointAngles) -> Figure:
    """Return a figure of tracked points and of the angles that follow from them.

    Above, the points of each wing relative to its shoulder, from behind and from the side, and the line from
    shoulder to tip, by the wrist where the hand folds, of the fitted laws at eight phases. Below, each angle over
    the beat: frames with the standard error that follows from the points' noise, and the law with its 95 % band.

    Parameters
    ----------
    found : from `angles_from_points`.
    """
    laws = {name: law for name, law in found.beat.laws.items() if name != "stroke_plane_deg"}
    rows = -(-len(laws) // 3)
    figure = new_figure(PAGE, 70.0 + 58.0 * rows)
    above, below = np.ravel(figure.subfigures(2, 1, squeeze=False, height_ratios=(70.0, 58.0 * rows)))
    behind, beside = above.subplots(1, 2)
    length = found.semi_span if found.unit is not None else np.nan
    scale, first = METRES.get(found.unit or "", 1.0) / found.semi_span, next(iter(found.wings))
    for one, wing in found.wings.items():
        mirror = -1.0 if found.axes.sides[one] == "left" else 1.0
        for role, at in wing.items():
            if role != "shoulder":
                x, y, z = scale * (at - wing["shoulder"]).T
                look = {"color": _COLOURS[role], "marker": ".", "markersize": 3, "linestyle": "", "alpha": 0.6}
                behind.plot(mirror * y, z, **look, label=role.replace("_", " ") if one == first else "")
                beside.plot(x, z, **look)
        phase = np.arange(8) / 8
        flap, sweep, drop = (
            np.radians(laws[name].curve(phase)[0]) if name in laws else np.zeros(8)
            for name in ("flap_deg", "sweep_deg", "fold_deg")
        )
        span = laws["span_fraction"].curve(phase)[0] if "span_fraction" in laws else np.ones(8)
        tilt = np.full(8, np.radians(found.stroke_plane_deg - found.body_pitch_deg))
        arm = 1.0 if found.film.wrist is None else found.film.wrist
        places = [np.zeros((3, 8))]
        for share, angle in ((arm, flap), (1.0 - arm, flap - drop)):
            places.append(places[-1] + share * span * span_of(angle, sweep, tilt)[0].T)
        for k, (x, y, z) in enumerate(np.transpose(places, (2, 1, 0))):
            line = {"color": VERMILION, "linewidth": 0.7, "label": "" if k or one != first else "fitted span"}
            behind.plot(mirror * y, z, **line)
            beside.plot(x, z, **line)
    unit = f"full spans of {length:.3g} m" if np.isfinite(length) else "full spans"
    behind.set(title="from behind", xlabel=f"to the right [{unit}]", ylabel="up [full spans]")
    beside.set(title="from the right", xlabel="forward [full spans]", ylabel="up [full spans]")
    for axes in (behind, beside):
        axes.set_aspect("equal", adjustable="datalim")
        axes.grid()
    legend_below(above, [behind])
    panels = np.ravel(below.subplots(rows, 3, squeeze=False, sharex=True))
    curve = np.linspace(0.0, 1.0, 241)
    for axes, (name, law) in zip(panels, laws.items(), strict=False):
        value, error = law.curve(curve)
        phase, frames = found.film.seen(name)
        axes.fill_between(
            curve,
            value - 2 * error,
            value + 2 * error,
            color=VERMILION,
            alpha=0.3,
            linewidth=0,
            label="95 % band of the curve",
        )
        axes.plot(curve, value, color=VERMILION, label="periodic spline")
        bars = found.errors[name][np.isfinite(found.film.columns[name])] if name in found.errors else None
        look = {"fmt": "o", "color": BLUE, "markersize": 2.5, "markerfacecolor": "none", "elinewidth": 0.5}
        axes.errorbar(phase % 1.0, frames, bars, **look, label="frames, ±1 s.e.")
        axes.set(ylabel=textwrap.fill(FILM_LABELS[name], _LABEL), xlim=(0.0, 1.0))
        axes.grid()
    for axes in panels[len(laws) :]:
        axes.remove()
    for axes in panels[max(len(laws) - 3, 0) : len(laws)]:
        axes.set_xlabel("phase of the film [beats]")
        axes.tick_params(labelbottom=True)
    legend_below(below, panels[: len(laws)])
    letter_panels([behind, beside, *panels[: len(laws)]])
    figure.suptitle(heading(found.film.name), fontsize=8, parse_math=False)
    return figure
