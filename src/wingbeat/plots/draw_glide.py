"""The glide polar as a figure: sink, glide ratio, angles, and the torques that hold the wings, against speed."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import FaultList, heading, in_words
from wingbeat._base.style import (
    FIRST,
    GREEN,
    PAGE,
    SECOND,
    VERMILION,
    drawing,
    legend_above,
    letter_panels,
    new_figure,
)

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_LINE: dict[str, Any] = {**FIRST, "marker": ".", "markersize": 3}
_MARKS = {"least_sink": ("slowest sink", "o", VERMILION), "best_ratio": ("flattest glide", "s", GREEN)}


def glide_page(dataset: xr.Dataset) -> Figure:
    """Draw a glide polar against speed: a sink, b glide ratio, c angles, d torques and moment.

    Parameters
    ----------
    dataset : `GlidePolar.dataset`, also one read from a file.

    Raises
    ------
    InvalidInputError : the dataset is not a glide polar.
    """
    faults = FaultList()
    if dataset.attrs.get("wingbeat_kind") != "glide":
        faults.add("dataset", dataset.attrs.get("wingbeat_kind"), "is no glide polar", "give GlidePolar.dataset")
    faults.raise_if_any()
    speed = dataset["speed"].values
    with drawing():
        figure = new_figure(PAGE, 137.0)
        figure.suptitle(_title(dataset), fontsize=9, parse_math=False)
        sink, ratio, angles, torques = figure.subplots(2, 2, sharex=True).flat
        sink.plot(speed, dataset["sink"].values, **_LINE)
        sink.invert_yaxis()
        sink.set(ylabel="sinking speed [m/s]")
        ratio.plot(speed, dataset["glide_ratio"].values, **_LINE)
        ratio.set(ylabel="glide ratio [-]")
        for axes, name in ((sink, "sink"), (ratio, "glide_ratio")):
            _mark(axes, dataset, name)
        alpha, pitch = (np.degrees(dataset[name].values) for name in ("angle_of_attack", "body_pitch"))
        angles.plot(speed, alpha, label="angle of attack α", **_LINE)
        angles.plot(speed, pitch, label="body pitch ψ", **SECOND)
        angles.set(ylabel="angle [deg]", xlabel="speed [m/s]")
        torques.plot(speed, dataset["flap_torque"].values, label="flap torque that holds both wings", **_LINE)
        torques.plot(speed, dataset["tail_moment"].values, label="moment needed from a tail", **SECOND)
        torques.set(ylabel="torque, moment [N m]", xlabel="speed [m/s]")
        for axes, columns in ((sink, 1), (angles, 2), (torques, 1)):
            legend_above(axes, columns=columns)
        for axes in figure.axes:
            axes.grid()
        letter_panels(figure.axes)
    return figure


def _mark(axes: Axes, dataset: xr.Dataset, name: str) -> None:
    for best, (label, marker, color) in _MARKS.items():
        glide = json.loads(dataset.attrs[best])
        if glide is not None:
            told = (
                f"{label}: {glide['sink']:.3g} m/s, ratio {glide['glide_ratio']:.3g}, at {glide['speed']:.3g} m/s"
            )
            axes.plot(glide["speed"], glide[name], marker, color=color, markersize=5, label=told, zorder=3)


def _title(dataset: xr.Dataset) -> str:
    about = dataset.attrs
    aero = json.loads(about["aero"])
    count, all_ = int(dataset["trimmed"].sum()), dataset.sizes["angle_of_attack"]
    trimmed = "trimmed" if count == all_ else f"trimmed at {count} of {all_} angles"
    coefficients = in_words(aero["coefficients"])
    return f"{heading(about['species'])} gliding, wings held still, {coefficients} coefficients; {trimmed}"
