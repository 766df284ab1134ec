"""Multipliers of disturbed flights: in the complex plane, their size along speed, and what moves in each mode."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base.style import (
    BLUE,
    GREEN,
    GREY,
    MARKED,
    ORANGE,
    PAGE,
    PURPLE,
    SHADE,
    drawing,
    dress,
    heading,
    legend_below,
    letter_panels,
    new_figure,
)
from wingbeat.stability.linear_report import MOVING

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_KINDS = ("divergence", "oscillation", "subsidence", "flip")
_LOOK = dict(zip(_KINDS, MARKED, strict=False))
_LEGEND = MOVING | {"u": "forward velocity", "w": "upward velocity"}
_PART_COLOURS = {"body_pitch": BLUE, "u": ORANGE, "w": GREEN, "pitch_rate": PURPLE}


@drawing()
def stability_page(records: Sequence[dict[str, Any]]) -> Figure:
    """Draw multipliers and modes of one linear flight, or of several along speed.

    Inside the shaded circle disturbances decay. Marks are small at the lowest and large at the highest speed. The
    bars show what moves in the modes of the flight nearest to the middle of the speeds.

    Parameters
    ----------
    records : of `LinearFlight.record`, at least one, of one animal.
    """
    figure = new_figure(PAGE, 68.0)
    first, several = records[0], len(records) > 1
    name = heading(first["species"])
    speeds = f"{first['speed']:g} to {records[-1]['speed']:g} m/s" if several else f"{first['speed']:g} m/s"
    figure.suptitle(f"{name} at {speeds}: multipliers of a disturbance in one beat", fontsize=8.5)
    plane, sizes, bars = figure.subplots(1, 3, width_ratios=(1, 1.1, 1))
    _draw_plane(plane, records)
    if several:
        _draw_sizes(sizes, records)
    else:
        _draw_growth(sizes, first)
    middle = 0.5 * (records[0]["speed"] + records[-1]["speed"])
    _draw_bars(bars, min(records, key=lambda record: abs(record["speed"] - middle)))
    letter_panels(figure.axes)
    legend_below(figure, [plane, sizes], columns=5)
    return figure


def _draw_plane(axes: Axes, records: Sequence[dict[str, Any]]) -> None:
    sizes = np.linspace(6.0, 30.0, len(records)) if len(records) > 1 else [20.0]
    turn = np.linspace(0.0, 2 * np.pi, 181)
    axes.fill(np.cos(turn), np.sin(turn), color=SHADE, linewidth=0, zorder=0, label="decays")
    axes.plot(np.cos(turn), np.sin(turn), color=GREY, linewidth=0.6)
    for kind, (colour, mark) in _LOOK.items():
        points = [
            (*mode["multiplier"], size)
            for record, size in zip(records, sizes, strict=True)
            for mode in record["modes"]
            if mode["kind"] == kind
        ]
        if points:
            real, imaginary, size = np.array(points).T
            both = np.r_[real, real], np.r_[imaginary, -imaginary]
            axes.scatter(*both, s=np.r_[size, size], color=colour, marker=mark, alpha=0.7, linewidths=0, label=kind)
    axes.set_aspect("equal", adjustable="datalim")
    dress(axes, "real part [-]", "imaginary part [-]")


def _draw_sizes(axes: Axes, records: Sequence[dict[str, Any]]) -> None:
    axes.axhspan(0.0, 1.0, color=SHADE, linewidth=0, zorder=0)
    for kind, (colour, mark) in _LOOK.items():
        points = [(r["speed"], mode["modulus"]) for r in records for mode in r["modes"] if mode["kind"] == kind]
        if points:
            axes.plot(*np.array(points).T, mark, color=colour, ms=3.5, mew=0)
    axes.plot(
        [r["speed"] for r in records],
        [r["averaged"]["spectral_radius"] for r in records],
        color="k",
        linewidth=0.8,
        linestyle=(0, (2, 1.5)),
        label="spectral radius of the averaged model",
    )
    axes.set_ylim(bottom=0.0)
    dress(axes, "speed [m/s]", "modulus of the multiplier [-]")


def _draw_growth(axes: Axes, record: dict[str, Any]) -> None:
    """Draw the size of each mode over the first beats."""
    beats = np.arange(9)
    for mode in record["modes"]:
        colour, mark = _LOOK[mode["kind"]]
        axes.plot(beats * record["dt"], mode["modulus"] ** beats, color=colour, marker=mark, ms=3, linewidth=0.9)
    axes.axhline(1.0, color=GREY, linewidth=0.6)
    axes.set_yscale("log")
    axes.set(xlabel="time [s]", ylabel="disturbance over its initial size [-]")


def _draw_bars(axes: Axes, record: dict[str, Any]) -> None:
    modes = record["modes"]
    left = np.zeros(len(modes))
    for part, label in _LEGEND.items():
        widths = np.array([mode["shares"][part] for mode in modes])
        axes.barh(range(len(modes)), widths, left=left, height=0.6, color=_PART_COLOURS[part], label=label)
        left += widths
    axes.set_yticks(range(len(modes)), [f"{mode['kind']}\n{mode['modulus']:.3f}" for mode in modes])
    axes.set(xlim=(0, 1), ylim=(len(modes) - 0.4, -0.9), xlabel=f"share at {record['speed']:g} m/s [-]")
    axes.legend(loc="upper center", ncols=2, fontsize=6, bbox_to_anchor=(0.45, 1.2), handlelength=0.9)
