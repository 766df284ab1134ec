"""What a vehicle looks like where the model knows no shape: the body as an ellipsoid."""

from __future__ import annotations

import math

import numpy as np

from wingbeat.vehicle import Body

_WATER = 1000.0  # kg/m3, the density that makes an ellipsoid of the body's mass and inertia


def body_axes(body: Body) -> tuple[float, float]:
    """Return half length and half depth [m] of the round ellipsoid of water with the body's mass and pitch inertia.

    The model knows no shape of the body; this is the roundest guess with the body's numbers. A body too compact for
    such an ellipsoid is drawn as a ball.

    >>> half_length, half_depth = body_axes(Body(mass=0.276, pitch_inertia=3.6e-4))
    >>> round(half_length, 3), round(half_depth, 3)
    (0.075, 0.03)
    """
    volume = 3 * body.mass / (4 * math.pi * _WATER)
    squares = 5 * body.pitch_inertia / body.mass
    # a^2 + volume/a = squares, of which the largest root is the long body.
    roots = np.roots([1.0, 0.0, -squares, volume])
    long = max((r.real for r in roots if abs(r.imag) < 1e-12 and r.real > 0), default=volume ** (1 / 3))
    return float(long), math.sqrt(volume / float(long))
