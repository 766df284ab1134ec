"""The hinge power of an orbit: its parts, the part that a spring takes over, and the cost of negative work."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import heading
from wingbeat._base.datasets import downstrokes
from wingbeat._base.style import (
    FIRST,
    PAGE,
    SECOND,
    THIRD,
    VERMILION,
    drawing,
    legend_above,
    letter_panels,
    new_figure,
    shade_downstrokes,
)
from wingbeat.records.numbers import SHARES, power_account

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_WHOLE: dict[str, Any] = {"color": "k", "linewidth": 1.5}
_LOOKS = {"aerodynamic": FIRST, "inertial": SECOND, "body": THIRD}


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
    with drawing():
        figure = new_figure(PAGE, 80.0)
        name, speed = heading(str(dataset.attrs["species"])), dataset.attrs["speed"]
        certified = "" if dataset.attrs["status"] == "converged" else ", NOT CERTIFIED"
        title = f"{name} at {speed:.4g} m/s: hinge power of both wings{certified}"
        figure.suptitle(title, fontsize=8.5, parse_math=False)
        shares, loop, costs = figure.subplots(1, 3)
        _draw_shares(shares, dataset)
        _draw_torque(loop, dataset, account["best_spring"])
        _draw_costs(costs, account)
        letter_panels(figure.axes)
    return figure


def _draw_shares(axes: Axes, dataset: xr.Dataset) -> None:
    phase = dataset["phase"].values
    shade_downstrokes(axes, 0.0, 1.0, downstrokes(phase, dataset["flap_rate"].values))
    axes.axhline(0.0, color="0.6", linewidth=0.6)
    axes.plot(phase, dataset["hinge_power"].values, label="hinge power", **_WHOLE)
    for name, variable in SHARES.items():
        axes.plot(phase, dataset[variable].values, label=f"{name} share", **_LOOKS[name])
    axes.set(xlabel="phase t/T [-], downstroke shaded", ylabel="power [W]")
    legend_above(axes, columns=1)


def _draw_torque(axes: Axes, dataset: xr.Dataset, spring: dict[str, Any]) -> None:
    flap, torque = dataset["flap"].values, dataset["flap_torque"].values
    axes.axhline(0.0, color="0.6", linewidth=0.6)
    axes.plot(np.degrees(flap), torque, label="flap torque", **_WHOLE)
    if spring["rest_angle"] is not None:
        given = -spring["stiffness"] * (flap - spring["rest_angle"])
        axes.plot(np.degrees(flap), given, label="best spring", **_LOOKS["inertial"])
        axes.plot(np.degrees(flap), torque - given, label="remaining for actuators", **_LOOKS["aerodynamic"])
    axes.set(xlabel="flap angle φ [deg]", ylabel="torque [N m]")
    legend_above(axes, columns=1)


def _draw_costs(axes: Axes, account: dict[str, Any]) -> None:
    by_returned = dict(account["cost_by_returned"])
    bars = {
        "costs as driving": by_returned[-1.0],
        "is lost": by_returned[0.0],
        "half returned": by_returned[0.5],
        "best spring": account["best_spring"]["mean_positive_power"],
        "all returned": by_returned[1.0],
    }
    colors = ["0.65" if name != "best spring" else VERMILION for name in bars]
    found = axes.barh(list(bars), [np.nan if v is None else v for v in bars.values()], color=colors, height=0.7)
    axes.bar_label(found, fmt="%#.3g", fontsize=7, padding=2)
    axes.invert_yaxis()
    axes.margins(x=0.15)
    axes.tick_params(axis="y", length=0)
    axes.set(xlabel="mean power [W]", ylabel="negative work ...")
