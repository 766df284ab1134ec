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
    PURPLE,
    SECOND,
    THIRD,
    VERMILION,
    drawing,
    legend_below,
    letter_panels,
    new_figure,
)
from wingbeat.records.judgements import conditions_of

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

_MARKS = {"least_sink": ("slowest sink", "o", VERMILION), "best_ratio": ("flattest glide", "s", GREEN)}
_TAIL: dict[str, Any] = {"color": PURPLE, "linestyle": (0, (6, 1, 1, 1))}


def glide_page(dataset: xr.Dataset) -> Figure:
    """Draw a glide polar against speed: a sink, b glide ratio, c angles, d torques and moment.

    Parameters
    ----------
    dataset : `GlidePolar.dataset`, also one read from a file.

    Raises
    ------
    InvalidInputError : the dataset is not a glide polar.
    """
    faults, about = FaultList(), dataset.attrs
    if about.get("wingbeat_kind") != "glide":
        faults.add("dataset", about.get("wingbeat_kind"), "is no glide polar", "give GlidePolar.dataset")
    faults.raise_if_any()
    speed = dataset["speed"].values
    with drawing():
        figure = new_figure(PAGE, 137.0)
        all_axes = sink, ratio, angles, torques = figure.subplots(2, 2, sharex=True).ravel()
        for axes, name, label in ((sink, "sink", "sinking speed [m/s]"), (ratio, "glide_ratio", "glide ratio [-]")):
            axes.plot(speed, dataset[name].values, color="k")
            axes.set(ylabel=label)
            for best, (words, marker, color) in _MARKS.items():
                glide = json.loads(about[best])
                if glide is not None:
                    told = f"{words}: {glide['sink']:.3g} m/s, ratio {glide['glide_ratio']:.3g}"
                    told += f", at {glide['speed']:.3g} m/s"
                    axes.plot(glide["speed"], glide[name], marker, color=color, markersize=5, label=told, zorder=3)
        sink.invert_yaxis()
        alpha, pitch = (np.degrees(dataset[name].values) for name in ("angle_of_attack", "body_pitch"))
        angles.plot(speed, alpha, label="angle of attack α", **FIRST)
        angles.plot(speed, pitch, label="body pitch ψ", **SECOND)
        angles.set(ylabel="angle [deg]", xlabel="speed [m/s]")
        torques.plot(speed, dataset["flap_torque"].values, label="flap torque that holds both wings", **THIRD)
        torques.plot(speed, dataset["tail_moment"].values, label="moment needed from a tail", **_TAIL)
        torques.set(ylabel="torque, moment [N m]", xlabel="speed [m/s]")
        for axes in all_axes:
            axes.grid()
        letter_panels(all_axes)
        legend_below(figure, all_axes, columns=2)
        count, asked = int(dataset["trimmed"].sum()), dataset.sizes["angle_of_attack"]
        where = "" if count == asked else f" at {count} of {asked} angles"
        coefficients = in_words(json.loads(about["aero"])["coefficients"])
        title = f"{heading(about['species'])} gliding{conditions_of(about)}, wings held still, "
        title += f"{coefficients} coefficients; pitching moment balanced{where}"
        figure.suptitle(title, fontsize=8.5, parse_math=False)
    return figure
