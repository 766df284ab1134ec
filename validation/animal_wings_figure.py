"""The figure of the wings of animals: measured points, the fitted curves with their band, and the whole turn."""

from __future__ import annotations

from typing import Any

import numpy as np
from animal_wings_data import Glides, HalfWing, reduced
from animal_wings_fit import ASPECT_RATIO, HalfWingFit, Terms, curves
from measured_data import Array

from wingbeat._base import in_words
from wingbeat._base.style import (
    BLUE,
    GREEN,
    ORANGE,
    PAGE,
    VERMILION,
    drawing,
    legend_below,
    letter_panels,
    new_figure,
)
from wingbeat.aero import CoefficientModel

LOOKS: dict[str, dict[str, Any]] = {
    "feathered": {"color": BLUE, "linewidth": 1.6},
    "feathered-revolving": {"color": ORANGE, "linestyle": (0, (4, 1.5))},
    "membrane": {"color": GREEN, "linestyle": (0, (1, 1))},
    "su-fan": {"color": VERMILION, "linestyle": (0, (6, 1.5, 1, 1.5))},
}

GREY_POINT = "0.6"


@drawing()
def draw_wings(
    models: dict[str, CoefficientModel], fits: list[HalfWingFit], glides: Glides, drawn: list[Terms]
) -> Any:
    """Return the figure: lift, drag and polar near the data, and both coefficients over the whole turn."""
    figure = new_figure(PAGE, 150.0)
    axes = figure.subplots(2, 2)
    alpha = np.linspace(-20.0, 30.0, 401)
    _points(axes, [fit.wing for fit in fits], glides)
    _bands(axes, alpha, drawn)
    for name, model in models.items():
        a = np.radians(alpha)
        lift, drag = model.lift(a), model.drag(a)
        axes[0, 0].plot(alpha, lift, **LOOKS[name], label=in_words(name))
        axes[0, 1].plot(alpha, drag, **LOOKS[name])
        axes[1, 0].plot(lift, drag, **LOOKS[name])
    turn = np.linspace(-180.0, 180.0, 2001)
    for name in ("feathered", "su-fan"):
        for curve, style in ((models[name].lift, "-"), (models[name].drag, "--")):
            axes[1, 1].plot(turn, curve(np.radians(turn)), style, color=LOOKS[name]["color"])
    _label(axes)
    legend_below(figure, figure.axes, columns=6)
    return figure


def _points(axes: Any, wings: list[HalfWing], glides: Glides) -> None:
    """Draw the gulls and the jackdaw, brought to the aspect ratio of the models."""
    small = {"markersize": 1.8, "linestyle": "none"}
    for i, wing in enumerate(wings):
        lift = wing.lift[wing.fast]
        alpha, drag = reduced(
            wing.alpha_deg[wing.fast], lift, wing.drag[wing.fast], wing.aspect_ratio, ASPECT_RATIO
        )
        name = "nine gull wings, printed" if i == 0 else None
        axes[0, 0].plot(alpha, lift, ".", color=GREY_POINT, label=name, **small)
        axes[0, 1].plot(alpha, drag, ".", color=GREY_POINT, **small)
        axes[1, 0].plot(lift, drag, ".", color=GREY_POINT, **small)
    both = glides.induced + glides.profile
    _, drag = reduced(glides.lift, glides.lift, both, glides.aspect_ratio, ASPECT_RATIO)
    axes[1, 0].plot(glides.lift, drag, "^", color="black", label="jackdaw, live", **(small | {"markersize": 2.2}))


def _bands(axes: Any, alpha: Array, drawn: list[Terms]) -> None:
    """Draw the 95 % band of the resampled fits of feathered wings."""
    pairs = [
        (np.asarray(c.lift(np.radians(alpha))), np.asarray(c.drag(np.radians(alpha)))) for c in map(curves, drawn)
    ]
    within = alpha <= 25.0
    for panel, values in zip(axes[0], zip(*pairs, strict=True), strict=True):
        low, high = np.percentile(values, [2.5, 97.5], axis=0)
        panel.fill_between(alpha[within], low[within], high[within], color=BLUE, alpha=0.2, linewidth=0)


def _label(axes: Any) -> None:
    angle = r"angle of attack $\alpha$ [deg]"
    axes[0, 0].set(xlabel=angle, ylabel="lift coefficient $C_L$ [-]", ylim=(-0.8, 1.8))
    axes[0, 1].set(xlabel=angle, ylabel="drag coefficient $C_D$ [-]", ylim=(0.0, 0.7))
    axes[1, 0].set(
        xlabel="lift coefficient $C_L$ [-]", ylabel="drag coefficient $C_D$ [-]", xlim=(-0.4, 1.7), ylim=(0.0, 0.4)
    )
    axes[1, 1].set(xlabel=angle, ylabel="$C_L$ (solid), $C_D$ (dashed) [-]")
    axes[1, 1].set_xticks(range(-180, 181, 60))
    letter_panels(axes.flat)
    for panel in axes.flat:
        panel.grid()
        panel.axhline(0.0, color=GREY_POINT, linewidth=0.6)
