"""The hinge power of an orbit: its parts, the part that a spring takes over, and the cost of negative work."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import heading
from wingbeat._base.datasets import downstrokes
from wingbeat._base.style import (
    FIRST,
    ORANGE,
    PAGE,
    PURPLE,
    SECOND,
    THIRD,
    drawing,
    legend_below,
    letter_panels,
    new_figure,
    shade_downstrokes,
)
from wingbeat.records.judgements import conditions_of
from wingbeat.records.numbers import SHARES, power_account

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

_WHOLE: dict[str, Any] = {"color": "k", "linewidth": 1.5}
_LOOKS = {"aerodynamic": FIRST, "inertial": SECOND, "body": THIRD}
_SPRING: dict[str, Any] = {"color": PURPLE, "linestyle": (0, (6, 1, 1, 1))}


def power_page(dataset: xr.Dataset) -> Figure:
    """Draw the parts of an orbit's hinge power.

    a: hinge power over the wingbeat with its aerodynamic, inertial and body parts. b: flap torque against flap
    angle, with the best spring's part and the remaining part of the actuators. c: mean power against the returned
    share of negative work.

    Parameters
    ----------
    dataset : `Orbit.dataset`, also one read from a file.

    Raises
    ------
    InvalidInputError : the dataset is not an orbit.
    """
    account = power_account(dataset)
    phase, flap, torque = (dataset[name].values for name in ("phase", "flap", "flap_torque"))
    with drawing():
        figure = new_figure(PAGE, 76.0)
        name, speed = heading(str(dataset.attrs["species"])), dataset.attrs["speed"]
        certified = "" if dataset.attrs["status"] == "converged" else ", NOT CERTIFIED"
        title = f"{name} at {speed:.4g} m/s{conditions_of(dataset.attrs)}: hinge power of both wings{certified}"
        figure.suptitle(title, fontsize=8.5, parse_math=False)
        shares, loop, costs = figure.subplots(1, 3)
        shade_downstrokes(shares, 0.0, 1.0, downstrokes(phase, dataset["flap_rate"].values))
        shares.plot(phase, dataset["hinge_power"].values, label="hinge power", **_WHOLE)
        for name, variable in SHARES.items():
            shares.plot(phase, dataset[variable].values, label=f"{name} share", **_LOOKS[name])
        shares.set(xlabel="phase t/T [-], downstroke shaded", ylabel="power [W]")
        loop.plot(np.degrees(flap), torque, label="flap torque", **_WHOLE)
        spring = account["best_spring"]
        if spring["rest_angle"] is not None:
            given = -spring["stiffness"] * (flap - spring["rest_angle"])
            loop.plot(np.degrees(flap), given, label="best spring", **_SPRING)
            loop.plot(np.degrees(flap), torque - given, label="remaining for actuators", color=ORANGE)
        loop.set(xlabel="flap angle φ [deg]", ylabel="torque [N m]")
        for axes in (shares, loop):
            axes.axhline(0.0, color="0.6", linewidth=0.6)
        by_returned = dict(account["cost_by_returned"])
        bars = {
            "costs as driving": by_returned[-1.0],
            "is lost": by_returned[0.0],
            "is half returned": by_returned[0.5],
            "goes into the\nbest spring": spring["mean_positive_power"],
            "is all returned": by_returned[1.0],
        }
        colors = [PURPLE if name.endswith("spring") else "0.65" for name in bars]
        lengths = [np.nan if value is None else value for value in bars.values()]
        costs.bar_label(costs.barh(list(bars), lengths, color=colors, height=0.7), fmt="%#.3g", padding=2)
        costs.invert_yaxis()
        costs.margins(x=0.15)
        costs.tick_params(axis="y", length=0)
        costs.set(xlabel="mean power [W] if negative work ...")
        letter_panels(figure.axes)
        legend_below(figure, [shares, loop], columns=4)
    return figure
