"""The page that shows a filmed wingbeat: frames, the periodic spline through them, and its band."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from wingbeat._base.style import BLUE, COLUMN, PAGE, VERMILION, drawing, legend_below, letter_panels, new_figure
from wingbeat.experiment import FilmedBeat

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_POINTS, _CURVE = BLUE, VERMILION
# More panels side by side than these are too narrow to read.
_ACROSS = 4
_LABELS = {
    "flap_deg": "flap angle, wing up [deg]",
    "pitch_deg": "wing pitch, leading edge up [deg]",
    "span_fraction": "span over semi-span [-]",
    "sweep_deg": "sweep, span ahead of the stroke plane [deg]",
    "tip_pitch_deg": "wing pitch at the tip [deg]",
    "stroke_plane_deg": "stroke plane from the body axis [deg]",
    "area_fraction": "area over full area [-]",
}


@drawing()
def film_page(beat: FilmedBeat) -> Figure:
    """Return a figure with a panel for each column that was filmed.

    Points are the frames, folded into one wingbeat. The curve is the spline with its 95 % band. The panel below
    shows the residuals of the frames, with two standard deviations of a frame.

    Parameters
    ----------
    beat : from `fit_film`.
    """
    columns = list(beat.laws)
    across, blocks = min(len(columns), _ACROSS), -(-len(columns) // _ACROSS)
    figure = new_figure(min(COLUMN * across, PAGE), 95.0 * blocks)
    grid = figure.subplots(2 * blocks, across, sharex=True, squeeze=False, height_ratios=(3, 1) * blocks)
    pairs = grid.reshape(blocks, 2, across).transpose(0, 2, 1).reshape(-1, 2)
    for unused in pairs[len(columns) :].ravel():
        unused.remove()
    phase = np.linspace(0.0, 1.0, 401)
    for (above, below), name in zip(pairs[: len(columns)], columns, strict=True):
        law = beat.laws[name]
        value, error = law.curve(phase)
        seen, frames = beat.film.seen(name)
        residual = frames - law.curve(seen)[0]
        above.fill_between(
            phase, value - 2 * error, value + 2 * error, color=_CURVE, alpha=0.3, linewidth=0, label="95 % band"
        )
        above.plot(phase, value, color=_CURVE, label="periodic spline")
        look = {"color": _POINTS, "marker": "o", "markersize": 3, "markerfacecolor": "none", "linestyle": ""}
        above.plot(seen % 1.0, frames, **look, label="frames")
        below.plot(seen % 1.0, residual, **look)
        below.axhspan(-2 * law.residual_sd, 2 * law.residual_sd, color="0.9", zorder=0, label="±2 sd of a frame")
        below.fill_between(phase, -2 * error, 2 * error, color=_CURVE, alpha=0.3, linewidth=0)
        below.axhline(0.0, color=_CURVE)
        above.set_ylabel(_LABELS[name])
        unit = "deg" if name.endswith("_deg") else "-"
        below.set(xlabel="phase of the film [beats]", ylabel=f"residual [{unit}]")
        below.tick_params(labelbottom=True)
        for axes in (above, below):
            axes.grid()
            axes.set_xlim(0.0, 1.0)
    letter_panels(pairs[: len(columns), 0])
    legend_below(figure, grid[:2, 0], columns=4 if len(columns) > 1 else 2)
    label = ": synthetic, not filmed" if beat.film.synthetic else ""
    figure.suptitle(beat.film.name + label, fontsize=8)
    return figure
