"""Air load of a tail: a flat surface of low aspect ratio, at any angle of attack.

``C_L = a sin(alpha) cos(alpha)``, ``C_D = C_D0 + a sin^2(alpha) cos^2(alpha) + C_B sin^4(alpha)``. At small angles
the lift grows with the slope a, which for a slender tail is ``pi/2`` times the aspect ratio. There is no suction at
the leading edge, so that the lift tilts back with the surface: Thomas 1993 (Phil Trans R Soc B 340:361,
doi 10.1098/rstb.1993.0079). Measured tails lift less than that where they are widely spread or above 20 degrees
(Maybury et al. 2001, doi 10.1098/rspb.2001.1666; Evans 2003, doi 10.1098/rspb.2003.2373). The sines bound the lift
at 45 degrees and turn the surface into a plate across the flow; that part of the formula is ours.
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
    velocity: tuple[Phases, Phases],
    xp: Any = np,
) -> Pair:
    """Return the force on a tail, along its chord and along its normal [N].

    Parameters
    ----------
    density : of the air [kg/m3].
    area : [m2].
    lift_slope : a [1/rad].
    drag_coefficient : C_D0, at no lift.
    velocity : of the tail's aerodynamic centre through the air, along chord and normal [m/s].
    xp : array module of the numbers.

    >>> chord, normal = tail_force(1.225, 0.004, 3.0, 0.02, (10.0, 0.0))
    >>> round(float(chord), 6), abs(float(normal))
    (-0.0049, 0.0)
    """
    along, across = velocity
    squared = along * along + across * across
    moving = squared > 0.0
    safe = xp.where(moving, squared, 1.0)
    speed = xp.where(moving, xp.sqrt(safe), 0.0)
    sine_squared = across * across / safe
    lift = -lift_slope * along * across / safe
    lift_drag = lift_slope * (1.0 - sine_squared) + BROADSIDE * sine_squared
    drag = drag_coefficient + sine_squared * lift_drag
    half = 0.5 * density * area * speed
    return half * (-lift * across - drag * along), half * (lift * along - drag * across)
