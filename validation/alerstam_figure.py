"""The one figure of the study: speeds and frequencies of birds, flown by each model and measured."""

from __future__ import annotations

import numpy as np
from alerstam_flights import Bird
from alerstam_summary import AIR, FITTED, Row, column, of_model
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from wingbeat._base.style import (
    BLUE,
    GREEN,
    ORANGE,
    PAGE,
    PURPLE,
    SHADE,
    VERMILION,
    drawing,
    legend_below,
    letter_panels,
    new_figure,
)
from wingbeat.animal.species import scaling
from wingbeat.models import MODELS

SLOW = {"color": BLUE, "marker": "o", "markersize": 3.5, "linestyle": "", "alpha": 0.75}
FAST = {"color": VERMILION, "marker": "^", "markersize": 4.0, "linestyle": "", "alpha": 0.75}
# Of the frequencies in panel c, so that one legend names all.
LEAST_POWER = SLOW | {"color": PURPLE, "marker": "D", "markersize": 3.0}
LEAST_FREQUENCY = FAST | {"color": ORANGE, "marker": "v"}
# Labels and limits of the panels, from top to bottom; the limits hold for all models.
PANELS = (
    ("measured airspeed [m/s]", "predicted speed [m/s]", (3, 30)),
    ("Reynolds number of chord and measured airspeed [-]", "predicted over measured speed [-]", (0.2, 1.9)),
    ("Reynolds number of chord and airspeed [-]", "frequency over Pennycuick's law [-]", (0.13, 4.6)),
    (
        "Reynolds number of chord and measured airspeed [-]",
        "speed over that at lift coefficient 1 [-]",
        (0.7, 3.2),
    ),
)


@drawing()
def draw(found: list[Row], timed: list[Bird]) -> Figure:
    """Return a column of panels for each model: speeds, residuals, frequencies over the law, speeds over C_L 1."""
    flown = [model for model in MODELS if of_model(found, model)]
    figure = new_figure(PAGE, 260.0)
    panels = figure.subplots(4, len(flown), squeeze=False)
    for model, column_of_panels in zip(flown, panels.T, strict=True):
        _draw_model(column_of_panels, of_model(found, model), timed)
        _finish(column_of_panels, model)
        column_of_panels[0].set_title(f"model {model}", pad=4)
    letter_panels(panels[:, 0])
    legend_below(figure, panels)
    return figure


def _draw_model(panels: np.ndarray, found: list[Row], timed: list[Bird]) -> None:
    measured, reynolds = column(found, "airspeed"), column(found, "reynolds")
    at_one = np.sqrt(2 * column(found, "mass") * AIR.gravity / (AIR.density * column(found, "wing_area")))
    ends = np.array([5.0, 40.0])
    panels[0].fill_between(ends, ends / 1.2, ends * 1.2, color=SHADE, zorder=0)
    panels[0].plot(ends, ends, "--", color="0.4", linewidth=1)
    for name, look, label in (
        ("min_power_speed", SLOW, "minimum power"),
        ("max_range_speed", FAST, "maximum range"),
    ):
        values = column(found, name)
        panels[0].loglog(measured, values, label=label, **look)
        panels[1].loglog(reynolds, values / measured, label=label, **look)
        panels[3].semilogx(reynolds, values / at_one, label=label, **look)
    panels[3].semilogx(reynolds, measured / at_one, "x", color="0.3", markersize=4, label="measured speed")
    _frequencies(panels[2], found, timed)


def _frequencies(axes: Axes, found: list[Row], timed: list[Bird]) -> None:
    law, reynolds = column(found, "pennycuick_frequency"), column(found, "reynolds")
    looks = (
        ("least_power_frequency", LEAST_POWER, "flown, least power"),
        ("least_frequency", LEAST_FREQUENCY, "flown, least frequency"),
    )
    for name, look, label in looks:
        axes.loglog(reynolds, column(found, name) / law, label=label, **look)
    wing = column(found, "wing_law_frequency") / law
    axes.loglog(reynolds, wing, "+", color=GREEN, markersize=4, label="law of wing length")
    for i, bird in enumerate(timed):
        own = scaling.BIRD_FREQUENCY(bird.mass, bird.span, bird.area, AIR.density, AIR.gravity)
        at = bird.airspeed * bird.area / bird.span / AIR.viscosity
        bars = {"yerr": bird.frequency_sd / own, "capsize": 2, "label": "measured frequency" if i == 0 else None}
        axes.errorbar(at, bird.frequency / own, fmt="s", color="black", markersize=4, **bars)


def _finish(panels: np.ndarray, model: str) -> None:
    for row, (axes, (x, y, limits)) in enumerate(zip(panels, PANELS, strict=True)):
        axes.set(xlabel=x, ylabel=y, ylim=limits)
        axes.grid()
        if row:
            axes.axvspan(*FITTED[model], color=SHADE, zorder=0)
            axes.axhline(1.0, color="0.4", linewidth=1, linestyle="--")
            axes.set_xticks([2e4, 5e4, 1e5, 2e5, 4e5], ["20 000", "50 000", "100 000", "200 000", "400 000"])
        axes.minorticks_off()
        if row in (1, 2):
            axes.set_yticks([0.2, 0.3, 0.4, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 4.0])
            axes.yaxis.set_major_formatter("{x:g}")
            axes.set_ylim(limits)
    panels[0].set(xlim=(6.5, 27), xticks=[7, 10, 15, 20, 25], yticks=[3, 5, 7, 10, 15, 20, 30])
    for axis in (panels[0].xaxis, panels[0].yaxis):
        axis.set_major_formatter("{x:g}")
