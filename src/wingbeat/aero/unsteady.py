"""Unsteady loads of a thin aerofoil on a strip: rotation, added mass and couple.

With ``C_L = 2 pi sin(alpha)`` they are the loads of Theodorsen 1935 (NACA Report 496) without the lag of the wake,
``C(k) = 1``. Rotation is that of Sane and Dickinson 2002 (doi 10.1242/jeb.205.8.1087) about the quarter chord.
All turning rates are of the chord in the plane normal to the span, leading edge up positive.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from wingbeat._jax.shapes import Pair, PerStrip, PerStripBroadcast, Phases, Scalar

UNSTEADY = ("none", "thin-aerofoil")


def rotation_lift(density: Scalar, chord: PerStripBroadcast, width: Phases, turning: PerStrip) -> PerStrip:
    """Return the force normal to a turning strip's velocity, per speed [N s/m]: ``rho pi/2 c^2 omega dr``.

    Parameters
    ----------
    density : rho [kg/m3].
    chord, width : c and dr [m].
    turning : omega [rad/s].
    """
    return 0.5 * math.pi * density * chord * chord * width * turning


def rotation_force(
    density: Scalar,
    chord: PerStripBroadcast,
    width: Phases,
    turning: PerStrip,
    chord_speed: PerStrip,
    normal_speed: PerStrip,
) -> Pair:
    """Return the force of a turning strip at its quarter chord [N], along chord and normal.

    ``(F_c, F_n) = rho G dr (-v_n, v_c)`` with the circulation ``G = pi/2 c^2 omega``. It does no work at the
    quarter chord. The formula holds in any axes in the plane of chord and normal, such as the unpitched strip's.

    Theory: equation ``rotation-force``.

    Parameters
    ----------
    density : rho [kg/m3].
    chord, width : c and dr [m].
    turning : omega [rad/s].
    chord_speed, normal_speed : of the quarter chord through the air, v_c and v_n [m/s].
    """
    lift = rotation_lift(density, chord, width, turning)
    return -lift * normal_speed, lift * chord_speed


def added_mass(density: Scalar, chord: PerStripBroadcast, width: Phases) -> PerStrip:
    """Return the added mass of strips, ``pi/4 rho c^2 dr`` [kg].

    It resists the acceleration of the mid-chord: ``F_n = -m d(v_n)/dt`` with v_n the speed of the mid-chord through
    the air along the normal of the chord.

    Theory: equation ``added-mass``.

    Parameters
    ----------
    density : rho [kg/m3].
    chord, width : c and dr [m].

    >>> round(added_mass(1.225, 0.112, 1.0), 6)
    0.012069
    """
    return 0.25 * math.pi * density * chord * chord * width


def added_inertia(density: Scalar, chord: PerStripBroadcast, width: Phases) -> PerStrip:
    """Return the added moment of inertia of strips about mid-chord, ``pi/128 rho c^4 dr`` [kg m2].

    It resists the turning of the chord: couple ``-I d(omega)/dt``.

    Theory: equation ``unsteady-couple``.

    Parameters
    ----------
    density : rho [kg/m3].
    chord, width : c and dr [m].
    """
    squared = chord * chord
    return math.pi / 128 * density * squared * squared * width


def damping_couple(
    density: Scalar, chord: PerStripBroadcast, width: Phases, turning: PerStrip, speed: PerStrip
) -> PerStrip:
    """Return the couple that opposes the turning of strips, ``-pi/16 rho c^3 |V| omega dr`` [N m].

    Theory: equation ``unsteady-couple``.

    Parameters
    ----------
    density : rho [kg/m3].
    chord, width : c and dr [m].
    turning : omega [rad/s].
    speed : ``|V|``, the airspeed of the quarter chord that determines the loads, planar or full [m/s].
    """
    return -math.pi / 16 * density * chord * chord * chord * width * speed * turning
