"""Air load of a tail: a flat surface of low aspect ratio, at any angle of attack.

``C_L = a sin(alpha) cos(alpha)``, ``C_D = C_D0 + a sin^2(alpha) cos^2(alpha) + C_B sin^4(alpha)``. At small angles
the lift grows with the slope a, which for a slender tail is ``pi/2`` times the aspect ratio. There is no suction at
the leading edge, so that the lift tilts back with the surface: Thomas 1993 (Phil Trans R Soc B 340:361,
doi 10.1098/rstb.1993.0079). Measured tails have less lift than this if they are widely spread or above 20 degrees
(Maybury et al. 2001, doi 10.1098/rspb.2001.1666; Evans 2003, doi 10.1098/rspb.2003.2373). The sines and cosines are
ours: with them the lift is largest at 45 degrees, and at 90 degrees the surface is a plate across the flow.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from wingbeat._jax.shapes import Pair, Phases, Scalar

# C_B, the drag coefficient of a disc across the flow: Hoerner 1965, Fluid-Dynamic Drag, chapter 3.
BROADSIDE = 1.17


def slender_slope(aspect_ratio: float) -> float:
    """Return the lift slope of a slender tail [1/rad], ``pi/2`` times its aspect ratio (Thomas 1993).

    Parameters
    ----------
    aspect_ratio : largest width squared over area.

    >>> round(slender_slope(2.0), 3)
    3.142
    """
    return 0.5 * math.pi * aspect_ratio


def tail_force(
    density: Scalar,
    area: Scalar,
    lift_slope: Scalar,
    drag_coefficient: Scalar,
    normal: Pair,
    velocity: tuple[Phases, Phases],
    xp: Any = np,
) -> Pair:
    """Return the force on a tail [N], in the axes in which its velocity is given.

    Lift and drag add up to ``-1/2 rho S |v| (k v + a (v.n) n)`` with ``k = C_D0 + (C_B - a) sin^4(alpha)``, where n
    is the unit normal of the surface.

    Theory: equations ``tail-coefficients`` and ``tail-force``.

    Parameters
    ----------
    density : rho [kg/m3].
    area : S [m2].
    lift_slope : a [1/rad].
    drag_coefficient : C_D0, at zero lift.
    normal : n, unit vector to the upper side.
    velocity : v, of the tail's aerodynamic centre through the air [m/s].
    xp : the array module that computes, numpy or jax.numpy.

    >>> forward, up = tail_force(1.225, 0.004, 3.0, 0.02, (0.0, 1.0), (10.0, 0.0))
    >>> round(float(forward), 6), abs(float(up))
    (-0.0049, 0.0)
    """
    across = velocity[0] * normal[0] + velocity[1] * normal[1]
    squared = velocity[0] * velocity[0] + velocity[1] * velocity[1]
    moving = squared > 0.0
    safe = xp.where(moving, squared, 1.0)
    sine_squared = across * across / safe
    push = -0.5 * density * area * xp.where(moving, xp.sqrt(safe), 0.0)
    along = drag_coefficient + (BROADSIDE - lift_slope) * sine_squared * sine_squared
    lift = lift_slope * across
    return push * (along * velocity[0] + lift * normal[0]), push * (along * velocity[1] + lift * normal[1])
