"""The drawing of a curve against speed: plain SVG in the colours of the page."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from typing import Any

from wingbeat.nomenclature import axis_label

_WIDTH, _PANEL, _GAP, _LEFT, _TOP, _RIGHT, _FOOT = 560, 150, 34, 52, 22, 14, 40
_PANELS = ("frequency", "mean_positive_power")


def chart(points: Sequence[dict[str, Any]], speeds: Sequence[float], now: float | None) -> str:
    """Return the drawing of frequency and power against speed as SVG.

    Parameters
    ----------
    points : the solved points, each with ``speed``, ``status``, ``frequency``, ``mean_positive_power``.
    speeds : all requested speeds; they determine the axis.
    now : the speed to mark, that of the answer that the page shows.
    """
    height = _TOP + len(_PANELS) * (_PANEL + _GAP) - _GAP + _FOOT
    low, high = min(speeds), max(speeds)
    parts = []
    for i, name in enumerate(_PANELS):
        parts += _panel(points, (low, high), name, _TOP + i * (_PANEL + _GAP), now)
    bottom = height - _FOOT
    for value in _ticks(low, high):
        x = _across(value, low, high)
        parts.append(_text(x, bottom + 16, f"{value:g}", "middle"))
    parts.append(_text(_LEFT + _plot_width() / 2, bottom + 33, axis_label("speed"), "middle"))
    certified = sum(point["status"] == "converged" for point in points)
    label = f"Frequency and power against speed, {certified} certified points; the table below holds the numbers"
    head = f'<svg viewBox="0 0 {_WIDTH} {height}" role="img" aria-label="{label}" class="chart">'
    return head + "".join(parts) + "</svg>"


def _plot_width() -> float:
    return _WIDTH - _LEFT - _RIGHT


def _across(speed: float, low: float, high: float) -> float:
    return _LEFT + _plot_width() * (speed - low) / max(high - low, 1e-9)


def _panel(
    points: Sequence[dict[str, Any]],
    ends: tuple[float, float],
    name: str,
    top: float,
    now: float | None,
) -> list[str]:
    known = [p for p in points if p["status"] == "converged" and p[name] is not None]
    tallest = max((float(p[name]) for p in known), default=1.0) * 1.08 or 1.0
    bottom = top + _PANEL
    parts = [_text(_LEFT, top - 7, axis_label(name), "start", "title")]
    for value in _ticks(0.0, tallest):
        y = bottom - _PANEL * value / tallest
        parts.append(f'<line class="grid" x1="{_LEFT}" x2="{_WIDTH - _RIGHT}" y1="{y:.1f}" y2="{y:.1f}"/>')
        parts.append(_text(_LEFT - 6, y + 4, f"{value:g}", "end"))
    if now is not None and ends[0] <= now <= ends[1]:
        x = _across(now, *ends)
        parts.append(f'<line class="now" x1="{x:.1f}" x2="{x:.1f}" y1="{top}" y2="{bottom}"/>')
    places = {p["speed"]: (_across(p["speed"], *ends), bottom - _PANEL * float(p[name]) / tallest) for p in known}
    parts += _lines(points, places)
    parts += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.5"/>' for x, y in places.values()]
    for point in points:
        if point["status"] != "converged":
            x = _across(point["speed"], *ends)
            parts.append(f'<path class="gap" d="M{x - 4:.1f} {bottom - 10}l8 8m0-8l-8 8"/>')
    return parts


def _lines(points: Sequence[dict[str, Any]], places: dict[float, tuple[float, float]]) -> list[str]:
    """Return lines between neighbours that are both certified; no line crosses a gap."""
    found = []
    for one, other in itertools.pairwise(points):
        if one["speed"] in places and other["speed"] in places:
            (x, y), (right, to) = places[one["speed"]], places[other["speed"]]
            found.append(f'<line class="curve" x1="{x:.1f}" y1="{y:.1f}" x2="{right:.1f}" y2="{to:.1f}"/>')
    return found


def _text(x: float, y: float, text: str, anchor: str, kind: str = "tick") -> str:
    return f'<text class="{kind}" x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}">{text}</text>'


def _ticks(low: float, high: float) -> list[float]:
    """Return about five round numbers between two ends."""
    span = max(high - low, 1e-12)
    power = 10.0 ** math.floor(math.log10(span / 4))
    step = next(power * f for f in (1, 2, 5, 10) if span / (power * f) <= 6)
    first = math.ceil(low / step - 1e-9)
    return [round(step * k, 12) for k in range(first, math.floor(high / step + 1e-9) + 1)]
