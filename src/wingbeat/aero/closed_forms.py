"""Air loads in closed form: induced flow, unsteady loads of a thin aerofoil, tail, drag and cross flow of the body.

Induced flow: Rankine and Froude's actuator disc in Glauert's form for any direction of flight,
``2 rho A v |V + v n| = k T``. Here T is the mean force of the wings, n its direction, V the velocity of the animal,
A the area of the disc that the wings span, v the induced speed and k the induced factor (1 for an ideal disc, 1.2
in Pennycuick 2008, Modelling the Flying Bird). The air at the wings has the velocity ``-v n``.

Unsteady loads: rotation, added mass and couple. With ``C_L = 2 pi sin(alpha)`` they are the loads of Theodorsen
1935 (NACA Report 496) without the lag of the wake, ``C(k) = 1``. Rotation is that of Sane and Dickinson 2002
(doi 10.1242/jeb.205.8.1087) about the quarter chord. All turning rates are of the chord in the plane normal to the
span, leading edge up positive.

Tail: a flat surface of low aspect ratio at any angle of attack, ``C_L = a sin(alpha) cos(alpha)``,
``C_D = C_D0 + a sin^2(alpha) cos^2(alpha) + C_B sin^4(alpha)``. At small angles the lift grows with the slope a,
which for a slender tail is ``pi/2`` times the aspect ratio. There is no suction at the leading edge, so that the
lift tilts back with the surface: Thomas 1993 (Phil Trans R Soc B 340:361, doi 10.1098/rstb.1993.0079). Measured
tails have less lift than this if they are widely spread or above 20 degrees (Maybury et al. 2001,
doi 10.1098/rspb.2001.1666; Evans 2003, doi 10.1098/rspb.2003.2373). The sines and cosines are ours: with them the
lift is largest at 45 degrees, and at 90 degrees the surface is a plate across the flow.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import FaultList

if TYPE_CHECKING:
    from wingbeat._jax.arrays import Pair, PerStrip, PerStripBroadcast, Phases, Scalar

INFLOWS = ("none", "momentum")
# Number of Newton's steps. Outside the vortex ring, 12 steps come within 1e-12 m/s of the solution.
_STEPS = 16
# Avoids a division by 0 in the direction of a zero force, and in the slope at rest without induced flow.
_TINY = 1e-30


def disc_area(semi_span: Scalar) -> Scalar:
    """Return the area of the disc that the wings span, ``pi R^2`` [m2]."""
    return math.pi * semi_span * semi_span


def induced_flow(
    density: Scalar, area: Scalar, factor: Scalar, force: Pair, velocity: Pair, xp: Any = np
) -> tuple[Any, Any]:
    """Return the induced velocity of the air at the wings, forward and up [m/s]. Theory: equation ``induced-flow``.

    `factor` is k, 0 for no induced flow; `force` is the mean force of both wings and `velocity` that of the animal,
    both forward and up; `xp` is the array module that computes, numpy or jax.numpy.

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
    """Note a fault if the animal descends into its own wake. Theory: equation ``vortex-ring``.

    In vertical descent, the vortex ring exists at speeds from 0 to twice the induced speed of hover (Leishman 2006,
    Principles of Helicopter Aerodynamics, section 2.13). With forward speed this range narrows; it ends at a
    forward speed of about the induced speed of hover (Johnson 2005, NASA TP-2005-213477). Here the range is the
    inside of the circle through these points.
    """
    hover = math.sqrt(factor * weight / (2.0 * density * area))
    speed, climb = velocity
    if speed * speed + (climb + hover) ** 2 < hover * hover:
        rule = (
            "is a descent into the wings' own wake (vortex ring), where momentum theory gives no induced flow. "
            f"This happens only below {hover:.2g} m/s forward and between 0 and {2 * hover:.2g} m/s down"
        )
        faults.add("climb", climb, rule, "fly faster, or leave the inflow out")


UNSTEADY = ("none", "thin-aerofoil")


def rotation_lift(density: Scalar, chord: PerStripBroadcast, width: Phases, turning: PerStrip) -> PerStrip:
    """Return the force normal to a turning strip's velocity, per speed [N s/m]: ``rho pi/2 c^2 omega dr``."""
    return 0.5 * math.pi * density * chord * chord * width * turning


def rotation_force(
    density: Scalar,
    chord: PerStripBroadcast,
    width: Phases,
    turning: PerStrip,
    chord_speed: PerStrip,
    normal_speed: PerStrip,
) -> Pair:
    """Return the force of a turning strip at its quarter chord [N], along chord and normal, where it does no work.

    ``(F_c, F_n) = rho G dr (-v_n, v_c)`` with the circulation ``G = pi/2 c^2 omega`` and the velocity v of the
    quarter chord, in any axes in the plane of chord and normal, such as the unpitched strip's.

    Theory: equation ``rotation-force``.
    """
    lift = rotation_lift(density, chord, width, turning)
    return -lift * normal_speed, lift * chord_speed


def added_mass(density: Scalar, chord: PerStripBroadcast, width: Phases) -> PerStrip:
    """Return the added mass of strips, ``pi/4 rho c^2 dr`` [kg].

    It resists the acceleration of the mid-chord: ``F_n = -m d(v_n)/dt`` with v_n the speed of the mid-chord through
    the air along the normal of the chord.

    Theory: equation ``added-mass``.

    >>> round(added_mass(1.225, 0.112, 1.0), 6)
    0.012069
    """
    return 0.25 * math.pi * density * chord * chord * width


def added_inertia(density: Scalar, chord: PerStripBroadcast, width: Phases) -> PerStrip:
    """Return the added inertia of strips about mid-chord [kg m2]. Theory: equation ``unsteady-couple``."""
    squared = chord * chord
    return math.pi / 128 * density * squared * squared * width


def damping_couple(
    density: Scalar, chord: PerStripBroadcast, width: Phases, turning: PerStrip, speed: PerStrip
) -> PerStrip:
    """Return the couple that opposes the turning of strips [N m]. Theory: equation ``unsteady-couple``."""
    return -math.pi / 16 * density * chord * chord * chord * width * speed * turning


# C_B, the drag coefficient of a disc across the flow: Hoerner 1965, Fluid-Dynamic Drag, chapter 3.
BROADSIDE = 1.17


def slender_slope(aspect_ratio: float) -> float:
    """Return the lift slope of a slender tail [1/rad], ``pi/2`` times its aspect ratio (Thomas 1993).

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
    """Return the force on a tail [N], in the axes in which the velocity of its aerodynamic centre is given.

    Lift and drag add up to ``-1/2 rho S |v| (k v + a (v.n) n)`` with ``k = C_D0 + (C_B - a) sin^4(alpha)``, where n
    is the unit vector normal to the upper side.

    Theory: equations ``tail-coefficients`` and ``tail-force``.

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


def body_drag(drag_area: Scalar, density: Scalar, velocity: Pair, xp: Any = np) -> Pair:
    """Return the drag of the body [N], in the axes of `velocity`. Theory: equation ``body-drag``."""
    squared = velocity[0] * velocity[0] + velocity[1] * velocity[1]
    moving = squared > 0.0
    speed = xp.where(moving, xp.sqrt(xp.where(moving, squared, 1.0)), 0.0)
    pressure_area = -0.5 * density * drag_area * speed
    return pressure_area * velocity[0], pressure_area * velocity[1]


def crossflow_force(area: Scalar, density: Scalar, normal: Pair, velocity: Pair, xp: Any = np) -> Pair:
    """Return the force of the cross flow on the body [N], in the axes of `velocity`.

    ``-1/2 rho S |v.n| (v.n) n``, with n the unit vector up in body axes: at the angle of attack a, the force across
    the axis of a slender body is ``eta C q A_p sin(a)^2`` (Allen and Perkins 1951, NACA Report 1048), A_p its
    planform area, C the drag coefficient of a cylinder across the flow and eta its reduction by finite length.

    Theory: equation ``crossflow-force``.

    >>> forward, up = crossflow_force(0.01, 1.225, (0.0, 1.0), (10.0, -1.0))
    >>> abs(float(forward)), round(float(up), 6)
    (0.0, 0.006125)
    """
    across = velocity[0] * normal[0] + velocity[1] * normal[1]
    push = -0.5 * density * area * xp.abs(across) * across
    return push * normal[0], push * normal[1]
