"""Figure 1: the plate in the water channel, and its axes, forces and centre of pressure, to scale."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base.style import FONT, GREY, PAGE, SHADE, drawing, letter_panels
from wingbeat.aero import SuFan
from wingbeat_evidence.paper.experiment_claims import CHANNEL, CHORD, SPAN, THICKNESS
from wingbeat_evidence.paper.figure_style import LOOKS, MEASURED, Drawn, sheet
from wingbeat_evidence.paper.printed import printed_centre, printed_drag, printed_lift, printed_moment

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# The angle at which the forces are drawn [deg], and the length of an arrow for a coefficient of 1, in chords.
ANGLE_DEG, _LENGTH = 30.0, 0.55
# If a name is further than this from its arrow, a line joins them [points].
_FAR = 15
_NOTE = (
    "a: the plate as the paper describes it, {span:g} by {chord:g} m and {thickness:g} mm thick. It is broadside "
    "in the water channel of {width:g} by {height:g} m, drawn to scale and seen along the flow; its height in "
    "the channel is a guess. b: the section of the plate at {angle:g} degrees. Lift L is normal to the stream U, "
    "and drag D is along it. F_N is normal to the chord, and F_T is along it. All forces are drawn to one scale, "
    "from the published Su-Fan formulas: L = F_N cos α - F_T sin α, D = F_N sin α + F_T cos α. They act at the "
    "centre of pressure x_cp, {centre:.3f} chords from the leading edge. M is their moment about mid-chord, "
    "where the load cell sits: C_M = C_N (0.5 - x_cp) = {moment:.3f}, nose up."
)


def plate_numbers(alpha_deg: float) -> dict[str, float]:
    """Return the coefficients of the plate at an angle of attack [deg], by the published formulas.

    >>> {name: round(value, 3) for name, value in plate_numbers(20.0).items()}["C_L"]
    0.972
    """
    model, at, alpha = SuFan(), np.array([alpha_deg]), np.radians(alpha_deg)
    lift, drag, moment, centre = (
        float(of(model, at)[0]) for of in (printed_lift, printed_drag, printed_moment, printed_centre)
    )
    return {
        "alpha_deg": alpha_deg,
        "C_L": lift,
        "C_D": drag,
        "C_N": float(lift * np.cos(alpha) + drag * np.sin(alpha)),
        "C_T": float(drag * np.cos(alpha) - lift * np.sin(alpha)),
        "C_M_mid_chord": moment,
        "x_cp_chords": centre,
    }


def plate_figure() -> Drawn:
    """Draw figure 1: a the plate in its channel, b axes, forces and centre of pressure at 30 degrees.

    Returns
    -------
    The figure, its caption, and its row: the coefficients that b draws.

    Su et al. 2023, doi 10.48550/arXiv.2302.09602.
    """
    numbers = plate_numbers(ANGLE_DEG)
    words = {"span": SPAN, "chord": CHORD, "thickness": 1e3 * THICKNESS, "width": CHANNEL[0], "height": CHANNEL[1]}
    words |= {"angle": ANGLE_DEG, "centre": numbers["x_cp_chords"], "moment": numbers["C_M_mid_chord"]}
    with drawing():
        figure = sheet(PAGE, 64.0)
        panels = figure.subplots(1, 2, width_ratios=(1.0, 1.5))
        _draw_channel(panels[0])
        _draw_section(panels[1], numbers)
        letter_panels(panels)
    return Drawn(figure, [numbers], _NOTE.format(**words))


def _draw_channel(axes: Axes) -> None:
    from matplotlib.patches import Rectangle

    width, height = CHANNEL
    axes.add_patch(Rectangle((0, 0), width, height, facecolor=SHADE, edgecolor="k", linewidth=0.8))
    left, top = 0.5 * (width - CHORD), 0.5 * (height + SPAN)
    axes.add_patch(
        Rectangle((left, top - SPAN), CHORD, SPAN, facecolor=LOOKS["su-fan"].color, alpha=0.7, gid="plate")
    )
    axes.plot([0.5 * width] * 2, [top, height + 0.05], color="k", linewidth=1.2)
    axes.plot(0.5 * width, height + 0.05, "s", color="k", markersize=5)
    axes.text(0.5 * width + 0.03, height + 0.05, "load cell, motor", va="center", fontsize=FONT)
    _measure(axes, (left, top - SPAN - 0.02), (left + CHORD, top - SPAN - 0.02), f"c {CHORD:g} m", (32, 0))
    _measure(axes, (left - 0.03, top - SPAN), (left - 0.03, top), f"h {SPAN:g} m", (-22, 0))
    _measure(axes, (0, -0.03), (width, -0.03), f"{width:g} m", (0, -8))
    _measure(axes, (width + 0.03, 0), (width + 0.03, height), f"{height:g} m", (16, 0))
    axes.set(xlim=(-0.12, width + 0.17), ylim=(-0.12, height + 0.1), aspect="equal")
    axes.axis("off")


def _draw_section(axes: Axes, numbers: dict[str, float]) -> None:
    from matplotlib.patches import Arc, Polygon

    alpha = np.radians(numbers["alpha_deg"])
    # The stream comes from the left; the leading edge is on the left and up.
    back, normal = np.array([np.cos(alpha), -np.sin(alpha)]), np.array([np.sin(alpha), np.cos(alpha)])
    thick = THICKNESS / CHORD
    corners = [s * back + side * 0.5 * thick * normal for s, side in ((0, 1), (1, 1), (1, -1), (0, -1))]
    axes.add_patch(Polygon(corners, facecolor=SHADE, edgecolor="k", linewidth=0.8, gid="section"))
    for y in (0.25, -0.75):
        _arrow(axes, np.array([-0.75, y]), np.array([0.4, 0.0]), GREY, "U", (-2, 5))
    # The stream's direction through the leading edge, and the angle to the chord.
    axes.plot([0, 0.75], [0, 0], color=GREY, linewidth=0.6, linestyle=":")
    axes.add_patch(Arc((0, 0), 1.1, 1.1, theta1=-numbers["alpha_deg"], theta2=0, color=GREY, linewidth=0.8))
    axes.text(0.58, -0.14, "α", fontsize=8)
    at = numbers["x_cp_chords"] * back
    axes.plot(*at, "o", color="k", markersize=4.5, gid="centre of pressure")
    stream = np.array([1.0, 0.0])
    across = np.array([0.0, 1.0])
    forces: dict[str, tuple[str, np.ndarray, str, tuple[int, int]]] = {
        "lift": ("L", numbers["C_L"] * across, LOOKS["su-fan"].color, (-10, -2)),
        "drag": ("D", numbers["C_D"] * stream, LOOKS["dickinson"].color, (4, -3)),
        "normal": ("$F_N$", numbers["C_N"] * normal, "k", (4, 0)),
        "tangential": ("$F_T$", numbers["C_T"] * back, "k", (14, -24)),
    }
    for gid, (name, force, color, away) in forces.items():
        _arrow(axes, at, _LENGTH * force, color, name, away, gid)
    middle = 0.5 * back
    axes.plot(*middle, "x", color=MEASURED, markersize=6, markeredgewidth=1.4, gid="mid-chord")
    turn: dict[str, Any] = {"arrowstyle": "-|>", "connectionstyle": "arc3,rad=0.6", "color": MEASURED}
    ends = [_pair(middle + side * back - 0.20 * normal) for side in (-0.16, 0.16)]
    axes.annotate("", ends[0], ends[1], arrowprops=turn)
    axes.text(*_pair(middle - 0.36 * normal), "M", color=MEASURED, fontsize=8, ha="center", va="center")
    _measure(axes, (-0.12 * normal).tolist(), (at - 0.12 * normal).tolist(), "$x_{cp}$", (-8, -6))
    axes.set(xlim=(-0.85, 1.35), ylim=(-1.0, 0.75), aspect="equal")
    axes.axis("off")


def _arrow(
    axes: Axes, start: np.ndarray, along: np.ndarray, color: str, name: str, away: tuple[int, int], gid: str = ""
) -> None:
    style: dict[str, Any] = {"arrowstyle": "-|>", "color": color, "lw": 1.2, "shrinkA": 0, "shrinkB": 0}
    drawn = axes.annotate("", _pair(start + along), _pair(start), arrowprops=style)
    drawn.set_gid(gid or name)
    leader: dict[str, Any] = {"arrowstyle": "-", "color": color, "lw": 0.5 if max(map(abs, away)) > _FAR else 0.0}
    place: dict[str, Any] = {"textcoords": "offset points", "arrowprops": leader}
    axes.annotate(name, _pair(start + along), xytext=away, color=color, fontsize=8, **place)


def _pair(place: np.ndarray) -> tuple[float, float]:
    return float(place[0]), float(place[1])


def _measure(axes: Axes, start: Any, end: Any, words: str, away: tuple[int, int]) -> None:
    style: dict[str, Any] = {"arrowstyle": "<->", "color": GREY, "lw": 0.6, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", end, start, arrowprops=style)
    middle = 0.5 * (start[0] + end[0]), 0.5 * (start[1] + end[1])
    place: dict[str, Any] = {"textcoords": "offset points", "ha": "center", "va": "center"}
    axes.annotate(words, middle, xytext=away, color=GREY, fontsize=FONT, **place)
