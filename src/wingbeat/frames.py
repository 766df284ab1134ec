"""Frames: body axes in the world, and the bases of stroke plane and wing, as tuples of components.

World: x forward, y left, z up. Body axes: the world's, turned by the body pitch (nose-up positive).
Only the plane of symmetry turns, so in-plane vectors are pairs (forward, up) and others triples (forward, left,
up). Components stay apart because XLA on CPU works along the last axis, and three is a short axis.
"""

from __future__ import annotations

from typing import Any

from wingbeat.elementary import cos, sin

Pair = tuple[Any, Any]
Triple = tuple[Any, Any, Any]


def body_to_world(body_pitch: Any, forward: Any, up: Any) -> Pair:
    """Turn an in-plane vector from body axes into the world (x, z)."""
    c, s = cos(body_pitch), sin(body_pitch)
    return c * forward - s * up, s * forward + c * up


def world_to_body(body_pitch: Any, x: Any, z: Any) -> Pair:
    """Turn an in-plane vector from the world into body axes (forward, up)."""
    c, s = cos(body_pitch), sin(body_pitch)
    return c * x + s * z, c * z - s * x


def span_axis(flap: Any, stroke_plane_angle: Any) -> Triple:
    """Return the spanwise unit vector ``e_s = cos(phi) y + sin(phi) d_up`` in body axes."""
    cb, sb = cos(stroke_plane_angle), sin(stroke_plane_angle)
    c, s = cos(flap), sin(flap)
    return -s * cb, c, s * sb


def wing_axes(spanwise: Triple, pitch: Any, stroke_plane_angle: Any) -> tuple[Triple, Triple]:
    """Return the chordwise (to the leading edge) and normal unit vectors of a wing along `spanwise`, body axes.

    ``e_c = cos(theta) e_c0 + sin(theta) e_n0``, ``e_n = -sin(theta) e_c0 + cos(theta) e_n0`` with
    ``e_c0 = (sin beta, 0, cos beta)`` and ``e_n0 = e_c0 x e_s``.
    """
    cb, sb = cos(stroke_plane_angle), sin(stroke_plane_angle)
    x, y, z = -cb * spanwise[1], cb * spanwise[0] - sb * spanwise[2], sb * spanwise[1]
    c, s = cos(pitch), sin(pitch)
    return (c * sb + s * x, s * y, c * cb + s * z), (c * x - s * sb, c * y, c * z - s * cb)
