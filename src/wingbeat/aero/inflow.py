"""Induced flow by momentum theory: a uniform stream of air through the wings' disc, which carries the weight.

Rankine and Froude's actuator disc in Glauert's form for any direction of flight:
``2 rho A v |V + v n| = k T``. Here T is the mean force of the wings, n its direction, V the velocity of the
animal, A the area of the disc that the wings span, v the induced speed and k the induced factor (1 for an ideal
disc, 1.2 in Pennycuick 2008, Modelling the Flying Bird). The air at the wings has the velocity ``-v n``.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import FaultList

if TYPE_CHECKING:
    from wingbeat._jax.shapes import Pair, Scalar

INFLOWS = ("none", "momentum")
# Number of Newton's steps. Outside the vortex ring, 12 steps come within 1e-12 m/s of the solution.
_STEPS = 16
# Avoids a division by 0 in the direction of a zero force, and in the slope at rest without induced flow.
_TINY = 1e-30


def disc_area(semi_span: Scalar) -> Scalar:
    """Return the area of the disc that the wings span, ``pi R^2`` [m2].

    Parameters
    ----------
    semi_span : R [m].
    """
    return math.pi * semi_span * semi_span


def induced_flow(
    density: Scalar, area: Scalar, factor: Scalar, force: Pair, velocity: Pair, xp: Any = np
) -> tuple[Any, Any]:
    """Return the induced velocity of the air at the wings, forward and up [m/s].

    Theory: equation ``induced-flow``.

    Parameters
    ----------
    density : of the air [kg/m3].
    area : of the disc [m2].
    factor : k, which multiplies the induced momentum of an ideal disc; 0 means no induced flow.
    force : mean force of both wings, forward and up [N].
    velocity : mean velocity of the animal, forward and up [m/s].
    xp : the array module that computes, numpy or jax.numpy.

    >>> forward, up = induced_flow(1.225, disc_area(0.279), 1.0, (0.0, 0.316 * 9.81), (0.0, 0.0))
    >>> round(float(-up), 3)
    2.275
    """
    size = xp.sqrt(force[0] * force[0] + force[1] * force[1] + _TINY)
    forward, up = force[0] / size, force[1] / size
    along = velocity[0] * forward + velocity[1] * up
    squared = velocity[0] * velocity[0] + velocity[1] * velocity[1]
    hover = factor * size / (2.0 * density * area) + _TINY  # induced speed squared at rest
    speed = hover / xp.sqrt(squared + hover)
    for _ in range(_STEPS):
        through = xp.sqrt(squared + 2.0 * speed * along + speed * speed)
        slope = through + speed * (along + speed) / through
        speed = speed - (speed * through - hover) / slope
    return -speed * forward, -speed * up


def check_descent(
    faults: FaultList, density: float, area: float, factor: float, weight: float, velocity: tuple[float, float]
) -> None:
    """Note a fault if the animal descends into its own wake (vortex ring), where momentum theory does not hold.

    In vertical descent, the vortex ring exists at speeds from 0 to twice the induced speed of hover (Leishman 2006,
    Principles of Helicopter Aerodynamics, section 2.13). With forward speed this range narrows; it ends at a
    forward speed of about the induced speed of hover (Johnson 2005, NASA TP-2005-213477). Here the range is the
    inside of the circle through these points.

    Theory: equation ``vortex-ring``.

    Parameters
    ----------
    faults : the list to which the fault is added.
    density : of the air [kg/m3].
    area : of the disc [m2].
    factor : k, as in `induced_flow`.
    weight : [N].
    velocity : of the animal, forward and up [m/s].
    """
    hover = math.sqrt(factor * weight / (2.0 * density * area))
    speed, climb = velocity
    if speed * speed + (climb + hover) ** 2 < hover * hover:
        rule = (
            "is a descent into the wings' own wake (vortex ring), where momentum theory gives no induced flow. "
            f"This happens only below {hover:.2g} m/s forward and between 0 and {2 * hover:.2g} m/s down"
        )
        faults.add("climb", climb, rule, "fly faster, or leave the inflow out")
