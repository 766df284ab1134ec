"""Draw docs/theory/frames.png: frames, angles and signs of the model.

Run from the root of a clone::

    uv run python validation/frames_figure.py
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Arc, Ellipse

import wingbeat as wb
from wingbeat._base.style import (
    BLUE,
    FIRST,
    GREEN,
    GREY,
    PAGE,
    SECOND,
    TINT,
    VERMILION,
    drawing,
    dress,
    letter_panels,
    new_figure,
    shade_downstrokes,
)
from wingbeat.animal.kinematics import flap_angle, pitch_angle, recovery, stroke_phase
from wingbeat.plots import save_figure

FIGURE = Path(__file__).resolve().parents[1] / "docs" / "theory" / "frames.png"
PITCH, PLANE, FLAP, FOLD, THETA, ALPHA = (math.radians(angle) for angle in (18, 75, 35, 30, 20, 32))
FLOWN = math.radians(-12)  # direction of a strip's velocity


def along(angle: float, length: float = 1.0) -> np.ndarray:
    """Return the vector of a length at an angle from the horizontal axis."""
    return length * np.array([math.cos(angle), math.sin(angle)])


def arrow(
    axes: Axes, start: Any, vector: Any, name: str, color: str, shift: Any = (0.0, 0.0), dash: Any = "-"
) -> None:
    """Draw a vector with its name beyond its tip."""
    start, vector = np.asarray(start, float), np.asarray(vector, float)
    style = {"arrowstyle": "-|>", "color": color, "linewidth": 1.2, "shrinkA": 0, "shrinkB": 0, "linestyle": dash}
    axes.annotate("", start + vector, start, arrowprops=style)
    beyond = start + vector * (1 + 0.11 / max(np.hypot(*vector), 1e-9)) + np.asarray(shift)
    axes.text(*beyond, name, color=color, ha="center", va="center")


def angle(axes: Axes, centre: Any, radius: float, first: float, last: float, name: str, away: float = 0.13) -> None:
    """Draw the arc of an angle, from `first` to `last` [rad], with its name."""
    ends = sorted(math.degrees(end) for end in (first, last))
    axes.add_patch(Arc(tuple(centre), 2 * radius, 2 * radius, theta1=ends[0], theta2=ends[1], color="k", lw=0.8))
    axes.text(*(np.asarray(centre) + along(0.5 * (first + last), radius + away)), name, ha="center", va="center")


def plain(axes: Axes, xlim: tuple[float, float], ylim: tuple[float, float]) -> None:
    """Leave only the drawing, with equal scales."""
    axes.set(xlim=xlim, ylim=ylim, aspect="equal")
    axes.set_axis_off()


def side(axes: Axes) -> None:
    """Draw world, body and stroke axes from the right side, nose to the right."""
    body = Ellipse((0, 0), 1.9, 0.42, angle=math.degrees(PITCH), facecolor=TINT, edgecolor=GREY, linewidth=0.8)
    axes.add_patch(body)
    axes.plot(0, 0, "ko", markersize=3)
    arrow(axes, (-1.6, -0.95), (0.5, 0), "x", GREY)
    arrow(axes, (-1.6, -0.95), (0, 0.5), "z", GREY)
    axes.plot([0, 1.55], [0, 0], color=GREY, linewidth=0.8, linestyle=":")
    arrow(axes, (0, 0), along(PITCH, 1.45), r"$\mathbf{x}_b$", BLUE)
    arrow(axes, (0, 0), along(PITCH + math.pi / 2, 0.75), r"$\mathbf{z}_b$", BLUE, (-0.04, 0.02))
    up = PITCH + math.pi - PLANE
    axes.plot(
        *np.transpose([along(up, -0.95), along(up, 1.25)]), color=VERMILION, linewidth=0.8, linestyle=(0, (4, 2))
    )
    axes.text(*along(up, -1.05), "stroke plane", color=VERMILION, ha="center", va="top")
    arrow(axes, (0, 0), along(up, 1.1), r"$\mathbf{d}$", VERMILION, (-0.08, -0.04))
    arrow(axes, (0, 0), along(up - math.pi / 2, 1.1), r"$\mathbf{e}_{c0}$", VERMILION, (0.06, 0.06))
    angle(axes, (0, 0), 1.25, 0.0, PITCH, r"$\psi$")
    backwards = PITCH + math.pi
    angle(axes, (0, 0), 0.62, up, backwards, r"$\beta$")
    plain(axes, (-1.85, 1.85), (-1.25, 1.35))


def front(axes: Axes) -> None:
    """Draw the left wing from behind: flap, fold, span and shoulder."""
    axes.add_patch(Ellipse((0, 0), 0.5, 0.44, facecolor=TINT, edgecolor=GREY, linewidth=0.8))
    axes.plot(0, 0, "ko", markersize=3)
    shoulder = np.array([-0.25, 0.0])
    axes.plot([0, 0], [-0.75, 1.2], color=GREY, linewidth=0.8, linestyle="-.")
    axes.text(0.06, -0.7, "plane of\nsymmetry", color=GREY, ha="left", va="center")
    arm = np.pi - FLAP
    hand = np.pi - (FLAP - FOLD)
    wrist = shoulder + along(arm, 0.85)
    tip = wrist + along(hand, 0.85)
    axes.plot([shoulder[0], shoulder[0] - 1.0], [0, 0], color=GREY, linewidth=0.8, linestyle=":")
    axes.plot(*np.transpose([wrist, wrist + along(arm, 0.6)]), color=GREY, linewidth=0.8, linestyle=":")
    axes.plot(*np.transpose([shoulder, wrist, tip]), color=BLUE, linewidth=2.5, solid_capstyle="round")
    axes.plot(*shoulder, "o", color=BLUE, markersize=4)
    axes.plot(*wrist, "o", color="w", markeredgecolor=BLUE, markersize=4)
    axes.text(shoulder[0] - 0.12, -0.1, "shoulder", ha="right", va="top")
    axes.text(wrist[0] + 0.05, wrist[1] + 0.08, "wrist", ha="left", va="bottom")
    axes.text(*(shoulder + along(arm, 0.42) + [0.1, 0.16]), "arm", color=BLUE, ha="left", va="center")
    axes.text(*(wrist + along(hand, 0.5) + [0.0, -0.13]), "hand", color=BLUE, ha="center", va="center")
    angle(axes, shoulder, 0.5, math.pi, arm, r"$\varphi$")
    angle(axes, wrist, 0.4, hand, arm, r"$\kappa$")
    arrow(axes, tip, along(hand, 0.35), r"$\mathbf{e}_s$", GREEN)
    arrow(axes, tip, along(hand - math.pi / 2, 0.35), r"$\mathbf{n}$", GREEN)
    arrow(axes, (0.75, 0.35), (-0.5, 0), r"$\mathbf{y}$", VERMILION)
    arrow(axes, (0.75, 0.35), (0, 0.5), r"$\mathbf{d}$", VERMILION)
    plain(axes, (-2.35, 1.0), (-0.95, 1.4))


def section(axes: Axes) -> None:
    """Draw the section of a strip: chord, points on it, velocity, angle of attack, lift and drag."""
    chord, normal = along(THETA), along(THETA + math.pi / 2)
    lead, trail = 0.5 * chord, -1.5 * chord
    axes.plot(*np.transpose([trail, lead]), color=BLUE, linewidth=3, solid_capstyle="round")
    axes.plot([0, 1.45], [0, 0], color=GREY, linewidth=0.8, linestyle=":")
    for share, mark in ((0.0, "o"), (-0.5, "|")):
        axes.plot(*(share * chord), mark, color="k", markersize=4 if mark == "o" else 9, zorder=5)
    for half in (1.0, -1.0):
        axes.plot(
            *((-0.5 + half / math.sqrt(3)) * chord), "D", color="w", markeredgecolor="k", markersize=3.5, zorder=5
        )
    axes.plot([0, 0.12], [-0.05, -0.42], color="k", linewidth=0.6)
    axes.text(0.1, -0.44, "quarter chord", ha="left", va="top")
    axes.text(*(-0.5 * chord + [-0.02, 0.12]), "mid-chord", ha="right", va="bottom")
    axes.text(*(-1.077 * chord + [0.12, -0.16]), "mass points", ha="left", va="top")
    arrow(axes, lead, 0.75 * chord, r"$\mathbf{e}_c$", GREEN)
    arrow(axes, (0, 0), 0.95 * normal, r"$\mathbf{e}_n$", GREEN, (-0.04, 0.02))
    flown = along(FLOWN)
    arrow(axes, (0, 0), 1.35 * flown, r"$\mathbf{v}$", "k")
    across = np.array([-flown[1], flown[0]])
    arrow(axes, (0, 0), 0.8 * across, "lift", VERMILION, (0.1, 0.03))
    arrow(axes, (0, 0), -0.45 * flown, "drag", VERMILION, (-0.12, 0.03))
    angle(axes, (0, 0), 1.12, 0.0, THETA, r"$\theta_i$")
    angle(axes, (0, 0), 0.62, FLOWN, THETA, r"$\alpha$")
    axes.text(1.5, 0.0, r"$\mathbf{e}_c^0$", color=GREY, ha="left", va="center")
    plain(axes, (-1.75, 1.85), (-0.85, 1.2))


def laws(axes: Axes) -> None:
    """Draw flap, wing pitch and the recovery law of the pigeon's stock wingbeat."""
    beat = wb.load_species("pigeon").wingbeat
    phase = np.linspace(0.0, 1.0, 201)
    shade_downstrokes(axes, 0.0, 1.0)
    axes.axhline(0.0, color="0.8", linewidth=0.6)
    axes.plot(phase, np.degrees(flap_angle(beat, phase)), **FIRST)
    axes.plot(phase, np.degrees(pitch_angle(beat, phase)), **SECOND)
    axes.plot(phase, 45.0 * np.asarray(recovery(stroke_phase(beat, phase))), color=GREEN, linestyle=(0, (1, 1)))
    for place, name, color in (
        ((0.03, 49), r"flap $\varphi$", BLUE),
        ((0.75, 16), r"pitch $\theta$", VERMILION),
        ((0.6, 51), r"recovery $r$, times 45", GREEN),
    ):
        axes.text(*place, name, color=color, ha="center" if name.startswith("pitch") else "left", va="center")
    axes.text(0.25, -54, "downstroke", color=GREY, ha="center", va="center")
    axes.text(0.75, -54, "upstroke", color=GREY, ha="center", va="center")
    dress(axes, r"phase $\hat t$", "angle [deg]")
    axes.set_ylim(-60, 60)


def main() -> None:
    """Draw the figure."""
    with drawing():
        figure = new_figure(PAGE, 128.0)
        panels = figure.subplots(2, 2)
        for draw, axes in zip((side, front, section, laws), panels.flat, strict=True):
            draw(axes)
        letter_panels(panels)
        save_figure(figure, FIGURE)


if __name__ == "__main__":
    main()
