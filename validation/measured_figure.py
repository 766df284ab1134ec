"""The one figure of the study: measured wings against the two plates that flights are computed with."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.figure import Figure
from measured_data import Polar
from measured_summary import Row

from wingbeat._base.style import (
    FIRST,
    GREEN,
    PAGE,
    PURPLE,
    SECOND,
    SKY,
    drawing,
    legend_below,
    letter_panels,
    new_figure,
)

LOOKS: dict[str, dict[str, Any]] = {
    "gull": {"color": SKY, "marker": ".", "markersize": 2.5, "linestyle": "", "label": "gull half wings (9)"},
    "jackdaw": {"color": GREEN, "marker": "+", "markersize": 3.5, "linestyle": "", "label": "jackdaw, gliding"},
    "plate": {
        "color": PURPLE,
        "marker": "^",
        "markersize": 3.5,
        "linestyle": "",
        "label": "thin plates, AR 1, 2",
    },
}
MODELS = [{**FIRST, "linewidth": 1.6}, {**SECOND, "linewidth": 1.6}]


@drawing()
def draw_polars(models: list[Polar], polars: list[Polar], rows: list[Row]) -> Figure:
    """Return four panels: lift over angle, drag and lift-to-drag over lift, moment over normal force."""
    figure = new_figure(PAGE, 152.0)
    panels = figure.subplots(2, 2).ravel()
    zero = {row.polar.label: row.zero_lift_deg for row in rows}
    for polar in polars:
        _draw(panels, polar, zero[polar.label] or 0.0, LOOKS[polar.kind])
    for polar, look in zip(models, MODELS, strict=True):
        _draw(panels, polar, 0.0, {**look, "label": polar.label})
    labels = (
        ("angle of attack from zero lift [deg]", "lift coefficient $C_L$ [-]", (-10, 45), (-0.6, 1.9)),
        ("lift coefficient $C_L$ [-]", "drag coefficient $C_D$ [-]", (-0.4, 1.6), (0, 0.8)),
        ("lift coefficient $C_L$ [-]", "lift over drag [-]", (0, 1.6), (0, 26)),
        ("normal force coefficient $C_N$ [-]", "moment $C_M$ about shoulder or edge [-]", (-0.6, 1.7), (-0.8, 0.2)),
    )
    for axes, (x, y, x_limits, y_limits) in zip(panels, labels, strict=True):
        axes.set(xlabel=x, ylabel=y, xlim=x_limits, ylim=y_limits)
        axes.grid()
    letter_panels(panels)
    legend_below(figure, panels, columns=5)
    return figure


def _draw(panels: Any, polar: Polar, zero_lift_deg: float, look: dict[str, Any]) -> None:
    over_angle, over_lift, ratio, moment = panels
    if polar.alpha_deg is not None:
        over_angle.plot(polar.alpha_deg - zero_lift_deg, polar.lift, **look)
    over_lift.plot(polar.lift, polar.drag, **look)
    positive = polar.lift > 0
    ratio.plot(polar.lift[positive], (polar.lift / polar.drag)[positive], **look)
    if polar.moment is not None and polar.alpha_deg is not None:
        alpha = np.radians(polar.alpha_deg)
        moment.plot(polar.lift * np.cos(alpha) + polar.drag * np.sin(alpha), polar.moment, **look)
