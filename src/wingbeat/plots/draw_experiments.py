"""Pages of measurements: a filmed wingbeat with its spline and band, and fitted coefficients with their data."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import heading
from wingbeat._base.style import (
    BLUE,
    COLUMN,
    FONT,
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
from wingbeat.experiment import FilmedBeat, WingFit

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_BAND: dict[str, Any] = {"color": VERMILION, "alpha": 0.3, "linewidth": 0}
# More panels side by side than these are too narrow to read.
_ACROSS = 4
FILM_LABELS = {
    "flap_deg": "flap angle, wing up [deg]",
    "pitch_deg": "wing pitch, leading edge up [deg]",
    "span_fraction": "span over semi-span [-]",
    "sweep_deg": "sweep, span ahead of the stroke plane [deg]",
    "tip_pitch_deg": "wing pitch at the tip [deg]",
    "stroke_plane_deg": "stroke plane from the body axis [deg]",
    "area_fraction": "area over full area [-]",
    "fold_deg": "fold, hand below the arm [deg]",
}


@drawing()
def film_page(beat: FilmedBeat) -> Figure:
    """Return a figure with a panel for each column that was filmed.

    Points are the frames, folded into one wingbeat. The curve is the spline with its 95 % band. The panel below
    shows the residuals of the frames, with two standard deviations of a frame, which hold 95 % of them.

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
        above.fill_between(phase, value - 2 * error, value + 2 * error, label="95 % band of the curve", **_BAND)
        above.plot(phase, value, color=VERMILION, label="periodic spline")
        look = {"color": BLUE, "marker": "o", "markersize": 3, "markerfacecolor": "none", "linestyle": ""}
        above.plot(seen % 1.0, frames, **look, label="frames")
        below.plot(seen % 1.0, residual, **look)
        spread: dict[str, Any] = {"color": "0.9", "zorder": 0, "label": "95 % of frames"}
        below.axhspan(-2 * law.residual_sd, 2 * law.residual_sd, **spread)
        below.fill_between(phase, -2 * error, 2 * error, **_BAND)
        below.axhline(0.0, color=VERMILION)
        above.set_ylabel(FILM_LABELS[name])
        unit = "deg" if name.endswith("_deg") else "-"
        below.set(xlabel="phase of the film [beats]", ylabel=f"residual [{unit}]")
        below.tick_params(labelbottom=True)
        for axes in (above, below):
            axes.grid()
            axes.set_xlim(0.0, 1.0)
    letter_panels(pairs[: len(columns), 0])
    legend_below(figure, grid[:2, 0], columns=4 if len(columns) > 1 else 2)
    label = ": synthetic, not filmed" if beat.film.synthetic else ""
    figure.suptitle(heading(beat.film.name) + label, fontsize=8, parse_math=False)
    return figure


_STREAMS = ((BLUE, "o"), (ORANGE, "s"), (GREEN, "^"), (PURPLE, "D"), (SKY, "v"))
_LABELS = {
    "C_L": "lift coefficient $C_L$ [-]",
    "C_D": "drag coefficient $C_D$ [-]",
    "x_cp": "centre of pressure $x_{cp}$ [chords]",
    "C_M": "moment coefficient $C_M$ about 0.5 c [-]",
}


@drawing()
def fit_page(fit: WingFit) -> Figure:
    """Return a figure with a panel for C_L, C_D and, where there are any, x_cp and C_M.

    Points are the measurements with two standard errors on either side. The curve is the fit with its 95 % band
    for a new measurement; the curve of C_M follows from the other three.

    Parameters
    ----------
    fit : from `fit_wing`.
    """
    shown = ["C_L", "C_D", *(name for name in ("x_cp", "C_M") if name in fit.table.mean)]
    rows = (len(shown) + 1) // 2
    figure = new_figure(PAGE, 20.0 + 63.0 * rows)
    panels = figure.subplots(rows, 2, sharex=True, squeeze=False).ravel()
    for axes, name in zip(panels, shown, strict=False):
        error = fit.table.se.get(name)
        for label, rows, (colour, mark) in _streams(fit):
            bars, more = (None, "") if error is None else (2 * error[rows], ", ±2 s.e.")
            look: dict[str, Any] = {"color": colour, "marker": mark, "markersize": 3, "linestyle": ""}
            look |= {"markerfacecolor": "none", "markeredgewidth": 0.7, "elinewidth": 0.7, "label": label + more}
            axes.errorbar(fit.table.alpha_deg[rows], fit.table.mean[name][rows], bars, zorder=2, **look)
        if name in fit.curves:
            curve = fit.curves[name]
            alpha = np.linspace(curve.alpha_deg.min(), curve.alpha_deg.max(), 801)
            value, reach = curve.predict(alpha), curve.band(alpha)
            band = {**_BAND, "alpha": 0.25, "label": "95 % of new points"}
            axes.fill_between(alpha, value - reach, value + reach, zorder=1, **band)
            axes.plot(alpha, value, color=VERMILION, label="fit", zorder=3)
            if np.isfinite(curve.r_squared):  # cut rather than rounded, so that 0.99996 is not shown as 1
                shown_fit = f"$R^2$ = {np.floor(curve.r_squared * 1e4) / 1e4:.4f}"
                axes.set_title(shown_fit, loc="right", fontsize=FONT)
        elif name == "C_M" and fit.centre is not None:
            alpha = np.linspace(fit.centre.alpha_deg.min(), fit.centre.alpha_deg.max(), 801)
            axes.plot(alpha, fit.moment(alpha), color=VERMILION, linestyle="--", zorder=3, label="from the fits")
        if name != "x_cp":  # x_cp is never near 0; with 0 on the axis, its curve would look flat
            axes.axhline(0.0, color="0.6", linewidth=0.6, zorder=0)
        axes.grid()
        axes.set(ylabel=_LABELS[name], xlabel=r"angle of attack $\alpha$ [deg]")
        axes.tick_params(labelbottom=True)
    for axes in panels[len(shown) :]:
        axes.set_axis_off()
    letter_panels(panels[: len(shown)])
    source = f"; {fit.citation}" if fit.citation else ""
    figure.suptitle(f"{fit.name}: curves of the form {fit.form}{source}", fontsize=8, parse_math=False)
    legend_below(figure, panels[: len(shown)])
    return figure


def _streams(fit: WingFit) -> list[tuple[str, Any, tuple[str, str]]]:
    """Return label, rows and style for each Reynolds number; if there are more than five, for all rows together."""
    reynolds = fit.table.reynolds
    if reynolds is None:
        return [("measured", slice(None), _STREAMS[0])]
    order = np.argsort(reynolds, kind="stable")
    leap = np.diff(reynolds[order]) > 0.05 * reynolds[order][:-1]
    group = np.empty(len(order), dtype=np.intp)
    group[order] = np.concatenate([[0], np.cumsum(leap)])
    count = int(group.max()) + 1
    if count > len(_STREAMS):
        return [(f"measured, Re {reynolds.min():.0f} to {reynolds.max():.0f}", slice(None), _STREAMS[0])]
    return [(f"measured, Re {reynolds[group == k].mean():.0f}", group == k, _STREAMS[k]) for k in range(count)]
