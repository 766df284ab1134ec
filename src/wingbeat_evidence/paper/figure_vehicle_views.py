"""The views of figure 2: oblique, from the side, from the front, from above, and the cross-section of one strip."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base.style import GREY, TINT, dress
from wingbeat.animal.vehicle import Wing
from wingbeat_evidence.paper.figure_style import FONT_SMALL, LOOKS, MEASURED
from wingbeat_evidence.paper.vehicle_posture import Posture, Section

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_BLUE, _RED = LOOKS["su-fan"].color, LOOKS["dickinson"].color
_BODY, _WING, _EDGE = "0.80", TINT, "0.35"
_MIRROR = np.array([1.0, -1.0, 1.0])
_GROUND = {"facecolor": "w", "linewidth": 0, "pad": 0.6, "alpha": 0.8}
_WORDS: dict[str, Any] = {"fontsize": FONT_SMALL, "ha": "center", "va": "center"}
# Half of the width and of the height of every view to scale [m]; either animal's wing has room.
_REACH = 0.31
_HALF_HEIGHT = 0.28


def _plane(at: Posture, sides: Sequence[int]) -> np.ndarray:
    """Return the coordinates `sides` of the outlines of both wings' strips, shape (2 N, 4, 2)."""
    return np.concatenate([at.outlines, at.outlines * _MIRROR])[..., list(sides)]


def _strips(axes: Axes, outlines: np.ndarray, zorder: float = 2) -> None:
    from matplotlib.collections import PolyCollection

    look: dict[str, Any] = {"facecolor": _WING, "edgecolor": _EDGE, "linewidth": 0.4, "zorder": zorder}
    axes.add_collection(PolyCollection(list(outlines), gid="strips", **look))


def _ring(at: Posture, across: np.ndarray, up: np.ndarray) -> np.ndarray:
    """Return the body's outline, shape (K, 2), projected on two unit vectors of the world."""
    half_length, half_depth = at.body_axes
    c, s = math.cos(at.body_pitch), math.sin(at.body_pitch)
    # Semi-axes as columns; an ellipsoid's shadow is the ellipse of the projected shape matrix.
    semi = np.array([[c, 0, -s], [0, 1, 0], [s, 0, c]]) * [half_length, half_depth, half_depth]
    shadow = np.stack([across, up]) @ semi
    root = np.linalg.cholesky(shadow @ shadow.T)
    turn = np.linspace(0, 2 * np.pi, 73)
    return (root @ np.stack([np.cos(turn), np.sin(turn)])).T


def _body(axes: Axes, at: Posture, across: Any, up: Any, zorder: float = 3) -> None:
    ring = _ring(at, np.asarray(across, dtype=float), np.asarray(up, dtype=float))
    axes.fill(*ring.T, facecolor=_BODY, edgecolor=_EDGE, linewidth=0.5, zorder=zorder)


def _write(axes: Axes, place: np.ndarray, words: str, **look: Any) -> None:
    axes.text(float(place[0]), float(place[1]), words, zorder=6, **_WORDS | look)


def _arc(axes: Axes, centre: Any, radius: float, start: float, end: float, words: str, color: str = "k") -> None:
    """Draw an angle from `start` to `end` [rad] with an arrow head and its name beside its middle."""
    turn = np.linspace(start, end, 33)
    x, y = centre[0] + radius * np.cos(turn), centre[1] + radius * np.sin(turn)
    axes.plot(x, y, color=color, linewidth=0.7, zorder=5)
    head: dict[str, Any] = {"arrowstyle": "-|>", "color": color, "lw": 0.7, "mutation_scale": 5}
    axes.annotate("", (x[-1], y[-1]), (x[-3], y[-3]), arrowprops={**head, "shrinkA": 0, "shrinkB": 0}, zorder=5)
    middle, beyond = 0.5 * (start + end), radius * 1.1
    place = (centre[0] + beyond * math.cos(middle), centre[1] + beyond * math.sin(middle))
    side = "left" if math.cos(middle) >= 0 else "right"
    axes.text(*place, words, color=color, fontsize=FONT_SMALL, ha=side, va="center", zorder=6)


def _arrow(axes: Axes, start: Any, vector: Any, color: str, words: str, apart: float = 1.15) -> None:
    start, vector = np.asarray(start), np.asarray(vector)
    look: dict[str, Any] = {"arrowstyle": "-|>", "color": color, "lw": 1.0, "mutation_scale": 7}
    axes.annotate("", start + vector, start, arrowprops={**look, "shrinkA": 0, "shrinkB": 0}, zorder=6)
    _write(axes, start + apart * vector, words, color=color, bbox=_GROUND)
    # Arrows do not widen the view by themselves.
    axes.update_datalim([start, start + 1.05 * apart * vector])
    axes.autoscale_view()


def _to_scale(axes: Axes, xlabel: str, ylabel: str, title: str) -> None:
    dress(axes, xlabel, ylabel)
    axes.set(aspect="equal", xlim=(-_REACH, _REACH), ylim=(-_HALF_HEIGHT, _HALF_HEIGHT))
    ticks = [-0.2, 0.0, 0.2]
    axes.set(xticks=ticks, yticks=ticks, autoscale_on=False)
    axes.set_title(title, fontsize=FONT_SMALL, pad=3)


def draw_oblique(axes: Axes, at: Posture, wing: Wing) -> None:
    """Draw the vehicle from its left, ahead and above, with body axes, strips, span and chord named."""
    azimuth, height = math.radians(40.0), math.radians(28.0)
    across = np.array([-math.sin(azimuth), math.cos(azimuth), 0.0])
    up = np.array([-math.sin(height) * math.cos(azimuth), -math.sin(height) * math.sin(azimuth), math.cos(height)])
    seen = np.stack([across, up], axis=1)
    _strips(axes, (at.outlines * _MIRROR) @ seen, zorder=2)
    _strips(axes, at.outlines @ seen, zorder=2)
    _body(axes, at, across, up, zorder=3)
    for mirror in (1.0, _MIRROR):
        line = np.concatenate([at.shoulder[None], at.quarter_chord]) * mirror @ seen
        axes.plot(*line.T, color="k", linestyle=(0, (4, 2)), linewidth=0.8, zorder=5)
    _dot(axes, at.shoulder @ seen)
    c, s, length = math.cos(at.body_pitch), math.sin(at.body_pitch), 0.13
    for vector, words in (((c, 0, s), "$x_b$"), ((0, 1, 0), "$y_b$"), ((-s, 0, c), "$z_b$")):
        _arrow(axes, (0, 0), length * np.array(vector) @ seen, _RED, words)
    for i, corners in enumerate(at.outlines @ seen):
        # Well behind the quarter chord and its dashes.
        place = 0.2 * corners[:2].mean(axis=0) + 0.8 * corners[2:].mean(axis=0)
        _write(axes, place, str(i + 1), fontsize=6)
    inner, tip = at.outlines[0], at.outlines[-1]
    _measure(axes, (np.stack([inner[3], tip[2]]) - 0.03 * at.chordwise[0]) @ seen, f"L {wing.semi_span:g} m")
    _measure(axes, (tip[1:3] + 0.03 * at.spanwise[-1]) @ seen, f"c {wing.mean_chord:g} m", "top")
    axes.set_aspect("equal")
    axes.margins(0.02)
    axes.axis("off")


def _dot(axes: Axes, place: Any) -> None:
    axes.plot([place[0]], [place[1]], color="k", marker="o", markersize=3, zorder=6)


def _measure(axes: Axes, ends: np.ndarray, words: str, side: str = "bottom") -> None:
    look: dict[str, Any] = {"arrowstyle": "<->", "color": GREY, "lw": 0.7, "mutation_scale": 5}
    axes.annotate("", ends[1], ends[0], arrowprops={**look, "shrinkA": 0, "shrinkB": 0})
    slope = math.degrees(math.atan2(*(ends[1] - ends[0])[::-1]))
    turned: dict[str, Any] = {"rotation": slope, "rotation_mode": "anchor", "ha": "center", "va": side}
    offset = (0, 1.5 if side == "bottom" else -3)
    place: dict[str, Any] = {"xytext": offset, "textcoords": "offset points", "fontsize": FONT_SMALL}
    axes.annotate(words, ends.mean(axis=0), color=GREY, **place, **turned)
    axes.update_datalim(ends)


def draw_side(axes: Axes, at: Posture) -> None:
    """Draw the vehicle from its right, nose to the right: body pitch, stroke plane, speed; strips edge on."""
    _to_scale(axes, "x [m]", "z [m]", "pigeon, from its right")
    _body(axes, at, (1, 0, 0), (0, 0, 1), zorder=1)
    _strips(axes, at.outlines[..., [0, 2]])
    nose = 0.27 * np.array([math.cos(at.body_pitch), math.sin(at.body_pitch)])
    axes.plot([-nose[0], nose[0]], [-nose[1], nose[1]], color=_RED, linewidth=0.8, linestyle="-.", zorder=4)
    axes.plot([0, 0.30], [0, 0], color=GREY, linewidth=0.6, zorder=4)
    _arc(axes, (0, 0), 0.22, 0.0, at.body_pitch, f"ψ {math.degrees(at.body_pitch):.0f}°", _RED)
    upward = np.array([-math.sin(at.stroke), math.cos(at.stroke)])
    line = at.shoulder[[0, 2]] + np.outer([-0.24, 0.26], upward)
    axes.plot(*line.T, color=_BLUE, linewidth=0.8, linestyle=(0, (4, 2)), zorder=4)
    tilt = math.pi / 2 + at.stroke - at.body_pitch
    _arc(
        axes, at.shoulder[[0, 2]], 0.13, at.body_pitch, at.body_pitch + tilt, f"β {math.degrees(tilt):.0f}°", _BLUE
    )
    _write(axes, line[0] + [0.015, 0], "stroke plane", color=_BLUE, ha="left")
    _arrow(axes, (-0.28, -0.2), (0.16, 0), "k", "U", apart=1.2)
    _dot(axes, at.shoulder[[0, 2]])


def draw_front(axes: Axes, postures: Sequence[Posture], animal: str) -> None:
    """Draw the vehicle from ahead at the first posture, only its quarter chord at the others, and flap angles."""
    first, *others = postures
    _to_scale(axes, "y [m]", "z [m]", f"{animal}, from ahead")
    _strips(axes, _plane(first, (1, 2)))
    _body(axes, first, (0, 1, 0), (0, 0, 1))
    for at in postures:
        for side in (1, -1):
            line = np.concatenate([at.shoulder[None], at.quarter_chord])[:, [1, 2]] * [side, 1]
            dashes = (0, (4, 2)) if at is first else "-" if at.phase == 0.75 else (0, (1, 1))
            axes.plot(*line.T, color="k" if at is first else GREY, linewidth=0.8, linestyle=dashes, zorder=4)
    for at in others[:2]:
        words = f"φ {math.degrees(at.flap):+.0f}°"
        _arc(axes, at.shoulder[1:], 0.13, 0.0, at.flap, words)
    _dot(axes, first.shoulder[1:])


def draw_top(axes: Axes, at: Posture, animal: str) -> None:
    """Draw the vehicle from above, nose up: strips, quarter chord, shoulder."""
    _to_scale(axes, "y [m]", "x [m]", f"{animal}, from above")
    _strips(axes, _plane(at, (1, 0)))
    _body(axes, at, (0, 1, 0), (1, 0, 0))
    for side in (1, -1):
        line = np.concatenate([at.shoulder[None], at.quarter_chord])[:, [1, 0]] * [side, 1]
        axes.plot(*line.T, color="k", linewidth=0.8, linestyle=(0, (4, 2)), zorder=4)
    _dot(axes, at.shoulder[[1, 0]])
    axes.invert_xaxis()


def draw_section(axes: Axes, strip: Section) -> None:
    """Draw the cross-section of one strip, leading edge to the right: pitch, motion, angle of attack, forces."""
    chord = np.array([math.cos(strip.pitch), math.sin(strip.pitch)])
    motion = np.array([math.cos(strip.motion), math.sin(strip.motion)])
    axes.plot(*np.outer(chord, [-0.75, 0.25]), color="k", linewidth=3, solid_capstyle="round", zorder=4)
    axes.plot(*np.outer(chord, [0.25, 1.15]), color="k", linewidth=0.6, linestyle="--")
    axes.plot([0, 1.25], [0, 0], color=GREY, linewidth=0.6)
    _arrow(axes, (0, 0), 1.0 * motion, _BLUE, f"V {strip.speed:.3g} m/s", apart=1.12)
    scale = 0.9 / math.hypot(strip.lift, strip.drag)
    _arrow(axes, (0, 0), scale * strip.lift * np.array([-motion[1], motion[0]]), MEASURED, "dL")
    _arrow(axes, (0, 0), -scale * strip.drag * motion, _RED, "dD", apart=1.3)
    _arc(axes, (0, 0), 0.85, strip.motion, strip.pitch, f"α {math.degrees(strip.alpha):.0f}°", _BLUE)
    _arc(axes, (0, 0), 0.6, 0.0, strip.pitch, f"θ {math.degrees(strip.pitch):.0f}°")
    _dot(axes, (0, 0))
    axes.set_aspect("equal")
    axes.margins(0.08)
    axes.set_title("cross-section of a strip", fontsize=FONT_SMALL, pad=3)
    axes.axis("off")
