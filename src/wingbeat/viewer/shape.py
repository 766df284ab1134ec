"""Shapes that only the drawings have, not the model: the body is an ellipsoid, the tail a triangle."""

from __future__ import annotations

import math

import numpy as np

from wingbeat.animal.vehicle import Body, Tail

_WATER = 1000.0  # kg/m3, the density that makes an ellipsoid of the body's mass and inertia


def body_axes(body: Body) -> tuple[float, float]:
    """Return half length and half depth [m] of a spheroid of water with the body's mass and pitch inertia.

    The model contains no shape of the body; this is a guess for drawings. If the body is too compact for such a
    spheroid, it is drawn as a sphere.

    >>> half_length, half_depth = body_axes(Body(mass=0.276, pitch_inertia=3.6e-4))
    >>> round(half_length, 3), round(half_depth, 3)
    (0.075, 0.03)
    """
    volume = 3 * body.mass / (4 * math.pi * _WATER)
    squares = 5 * body.pitch_inertia / body.mass
    # The half length a solves a^2 + volume/a = squares; the largest root is that of a long body.
    roots = np.roots([1.0, 0.0, -squares, volume])
    long = max((r.real for r in roots if abs(r.imag) < 1e-12 and r.real > 0), default=volume ** (1 / 3))
    return float(long), math.sqrt(volume / float(long))


def tail_corners(tail: Tail, tilt: float = 0.0) -> np.ndarray:
    """Return root, left and right corner of a tail in body axes (forward, left, up), shape (3, 3) [m].

    The triangle has the tail's area and incidence, and its centre of area is the tail's aerodynamic centre. Its
    aspect ratio is that of a slender tail with the same lift slope: ``2/pi`` times the slope.

    Parameters
    ----------
    tail : the numbers of the tail.
    tilt : added to the incidence [rad].

    >>> corners = tail_corners(Tail(area=0.0064, arm=0.16, lift_slope=math.pi))
    >>> [round(float(x), 3) for x in corners[:, 0]], round(float(corners[1, 1]), 3)
    ([-0.085, -0.198, -0.198], 0.057)
    """
    half_width = 0.5 * math.sqrt(2.0 / math.pi * tail.lift_slope * tail.area)
    length, lifted = tail.area / half_width, tail.incidence + tilt
    chord = np.array([math.cos(lifted), 0.0, math.sin(lifted)])
    centre, left = np.array([-tail.arm, 0.0, tail.height]), np.array([0.0, half_width, 0.0])
    back = centre - length / 3.0 * chord
    return np.stack([centre + 2.0 * length / 3.0 * chord, back + left, back - left])
