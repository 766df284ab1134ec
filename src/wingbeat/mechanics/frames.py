"""Frames: the world, body axes and stroke axes. Vectors are tuples of components.

World: x forward, y left, z up. Body axes: the world's, turned by the body pitch (nose-up positive). Stroke axes:
body axes turned further, until the third axis lies in the stroke plane, in which the wings flap and retract. Stroke
axes turn with the body. All these turns are in the plane of symmetry. Vectors in this plane are pairs (forward,
up), others are triples (forward, left, up). Components are separate arrays because XLA, JAX's compiler, works along
the last axis on a CPU, and an axis of three is short.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from wingbeat._jax.arrays import cos, sin

if TYPE_CHECKING:
    from wingbeat._jax.arrays import Component, Pair, Triple


def to_world(attitude: Component, forward: Component, up: Component) -> Pair:
    """Return the world components (x, z) of an in-plane vector given in axes pitched nose-up by `attitude`.

    Theory: equation ``body-axes``.
    """
    c, s = cos(attitude), sin(attitude)
    return c * forward - s * up, s * forward + c * up


def from_world(attitude: Component, x: Component, z: Component) -> Pair:
    """Return the components of an in-plane world vector in axes pitched nose-up by `attitude`.

    Theory: equation ``body-axes``.
    """
    c, s = cos(attitude), sin(attitude)
    return c * x + s * z, c * z - s * x


def stroke_pitch(stroke_plane_angle: Component) -> Component:
    """Return the nose-up pitch of stroke axes relative to body axes [rad]; 0 for a vertical stroke plane.

    The first stroke axis is ``e_c0 = (sin beta, 0, cos beta)``; the third is ``d_up = (-cos beta, 0, sin beta)``.

    Theory: equation ``stroke-axes``.

    Parameters
    ----------
    stroke_plane_angle : beta, from the body axis [rad].
    """
    return 0.5 * math.pi - stroke_plane_angle


def quarter_turn(pair: Pair) -> Pair:
    """Turn an in-plane vector nose-up by a right angle.

    Theory: equation ``quarter-turn``.
    """
    return -pair[1], pair[0]


def dot(a: Pair | Triple, b: Pair | Triple) -> Component:
    """Return the scalar product of two in-plane vectors or of two vectors in space."""
    products = [one * other for one, other in zip(a, b, strict=True)]
    return sum(products[1:], products[0])
