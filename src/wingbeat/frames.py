"""Frames: body axes in the world, and the bases of stroke plane and wing, as plain tuples of components.

World: x forward, y left, z up. Body axes: the world's, turned by the body pitch (nose-up positive).
Only the plane of symmetry turns, so in-plane vectors are pairs (forward, up).
"""

from __future__ import annotations

from typing import Any

from wingbeat.elementary import cos, sin
from wingbeat.jax64 import jnp


def body_to_world(body_pitch: Any, forward: Any, up: Any) -> tuple[Any, Any]:
    """Turn an in-plane vector from body axes into the world (x, z)."""
    c, s = cos(body_pitch), sin(body_pitch)
    return c * forward - s * up, s * forward + c * up


def world_to_body(body_pitch: Any, x: Any, z: Any) -> tuple[Any, Any]:
    """Turn an in-plane vector from the world into body axes (forward, up)."""
    c, s = cos(body_pitch), sin(body_pitch)
    return c * x + s * z, c * z - s * x


def span_axis(flap: Any, stroke_plane_angle: Any) -> Any:
    """Return the spanwise unit vector ``e_s = cos(phi) y + sin(phi) d_up`` in body axes, shape (..., 3)."""
    cb, sb = cos(stroke_plane_angle), sin(stroke_plane_angle)
    c, s = cos(flap), sin(flap)
    return jnp.stack([-s * cb, c, s * sb], axis=-1)


def wing_axes(flap: Any, pitch: Any, stroke_plane_angle: Any) -> tuple[Any, Any]:
    """Return the chordwise (to the leading edge) and normal unit vectors in body axes, shape (..., 3) each.

    ``e_c = cos(theta) e_c0 + sin(theta) e_n0``, ``e_n = -sin(theta) e_c0 + cos(theta) e_n0`` with
    ``e_c0 = (sin beta, 0, cos beta)`` and ``e_n0 = e_c0 x e_s = cos(phi) d_up - sin(phi) y``.
    """
    cb, sb = cos(stroke_plane_angle), sin(stroke_plane_angle)
    cf, sf = cos(flap), sin(flap)
    cp, sp = cos(pitch), sin(pitch)
    chordwise = jnp.stack([cp * sb - sp * cf * cb, -sp * sf, cp * cb + sp * cf * sb], axis=-1)
    normal = jnp.stack([-sp * sb - cp * cf * cb, -cp * sf, -sp * cb + cp * cf * sb], axis=-1)
    return chordwise, normal
