"""The lag of the wake: how the vorticity that a strip has shed reduces the downwash at its chord.

When the circulation of a strip changes, the opposite circulation leaves at the trailing edge, drifts away with
the air and slows the change. On a thin aerofoil, let the downwash w at three quarters of the chord rise in a step.
After s semi-chords of travel, the lift is that of the downwash ``w phi(s)``. Here phi is Wagner's function in the
form of Jones 1940 (NACA Report 681): ``phi = 1 - 0.165 exp(-0.0455 s) - 0.335 exp(-0.3 s)``. The effects of many
steps add up (Duhamel; Leishman 2006, Principles of Helicopter Aerodynamics, chapter 8): the lift is that of
``w - X``. The downwash of the wake itself is ``X = sum A_j (w - z_j)``, where z_j follows w with
``dz_j/ds = b_j (w - z_j)``. For a sine this gives ``C(k) = 1 - sum A_j i k / (b_j + i k)``, within 0.02 of
Theodorsen's C(k), which contains Bessel functions (1935, NACA Report 496).

The wake moves the air across the chord, and the strip meets this air as any other wind: its polar, attached or
stalled, is read at the angle of attack in the moved air, and its forces turn with that air. With ``C_L = 2
pi sin(alpha)`` in plunge this is Theodorsen's lift and Garrick's thrust (1936, NACA Report 567). The model of
dynamic stall of Leishman and Beddoes 1989 (doi 10.4050/JAHS.34.3.3) starts with the same step.

A whole wing of finite span lags less than a section: its lift starts nearer to its final value. Jones's report has
elliptic wings of aspect ratio 3 and 6, ``phi = 1 - 0.283 exp(-0.540 s)`` and ``1 - 0.361 exp(-0.381 s)``. We quote
these four constants from memory; of the report we read the summary. By them the lift starts at 0.43 and 0.47 of
``2 pi`` per radian, and at 0.5 on a section: only slightly less, as the summary says.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._base import FaultList
from wingbeat.aero.coefficient_model import Kernel, kernel_lift

if TYPE_CHECKING:
    from wingbeat._jax.arrays import Angles, PairOfNumbers, PerStrip, StallNumbers, WakeStates

WAKES = ("none", "jones-section", "jones-finite")
# A_j and b_j of a section, and those of elliptic wings by aspect ratio. The first state of a wing of finite span
# has no share up to an aspect ratio of 6.
_SECTION = (0.165, 0.0455), (0.335, 0.3)
_ELLIPTIC = {3.0: ((0.0, 0.0455), (0.283, 0.540)), 6.0: ((0.0, 0.0455), (0.361, 0.381)), math.inf: _SECTION}
# Angles at which the largest lift is looked for, from 0 to 90 degrees.
_ANGLES = 901
# Below this share of the beat with attached flow, terms of attached flow do not describe it.
ATTACHED_SHARE = 0.9


class WakeLag(NamedTuple):
    """Numbers of the lag; a JAX pytree. Those of stall are per strip where arm and hand have polars of their own.

    Attributes
    ----------
    shares, rates : A_j, and b_j per semi-chord, shape (2,).
    stall : angles of attack of least and of largest lift [rad], shape (2,) or (2, strips).
    per_lift : sine of these angles over the lift there, of the same shape; 0 on a side without lift.
    """

    shares: PairOfNumbers
    rates: PairOfNumbers
    stall: StallNumbers
    per_lift: StallNumbers


def jones_numbers(wake: str, aspect_ratio: float = math.inf) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the shares A_j and the rates b_j per semi-chord. Theory: equation ``jones-numbers``.

    Parameters
    ----------
    wake : "jones-section", or "jones-finite" for a wing of the aspect ratio.
    aspect_ratio : span of both wings over their mean chord, at least 3.

    >>> jones_numbers("jones-finite", 6.0)
    ((0.0, 0.361), (0.0455, 0.381))
    """
    if wake == "jones-section":
        aspect_ratio = math.inf
    # Between Jones's wings linear in 1/A, which is ours.
    known = sorted(_ELLIPTIC, reverse=True)
    places, values = [1.0 / one for one in known], np.array([_ELLIPTIC[one] for one in known])
    (first, second), (slow, fast) = (
        [float(np.interp(1.0 / aspect_ratio, places, values[:, j, part])) for j in range(2)] for part in range(2)
    )
    return (first, second), (slow, fast)


def check_finite_wing(faults: FaultList, wake: str, aspect_ratio: float) -> None:
    """Note a fault if a wing is too short for Jones's wings of finite span."""
    if wake == "jones-finite" and aspect_ratio < min(_ELLIPTIC):
        rule = f"has Jones's wings of aspect ratio 3 and more, and this vehicle's is {aspect_ratio:.2g}"
        faults.add("aero.wake", wake, rule, "use jones-section, which overstates the lag of so short a wing")


def stall_numbers(kernel: Kernel) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return the angles of least and of largest lift [rad], and their sines over the lift there.

    A polar without lift on a side sheds nothing there: its number is 0.
    """
    found = _largest_lift(kernel)
    below, above = (math.sin(angle) / lift if lift * angle > 0 else 0.0 for angle, lift in found)
    return (found[0][0], found[1][0]), (below, above)


def largest_lift_angles(kernel: Kernel) -> tuple[float, float]:
    """Return the angles of attack of least and of largest lift between -90 and 90 degrees [rad].

    Beyond them the flow has stalled: lift no longer rises with the angle.

    Parameters
    ----------
    kernel : the kernel of the polar.
    """
    (below, _), (above, _) = _largest_lift(kernel)
    return below, above


def _largest_lift(kernel: Kernel) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return angle and lift where the lift is least at negative and largest at positive angles."""
    angles = np.linspace(0.0, 0.5 * math.pi, _ANGLES)
    below, above = np.split(kernel_lift(kernel, np.concatenate([-angles, angles])), 2)  # in one program
    low, high = below.argmin(), above.argmax()
    return (-float(angles[low]), float(below[low])), (float(angles[high]), float(above[high]))


def is_stalled(stall: StallNumbers | Sequence[Any], alpha: Angles) -> Any:
    """Return whether angles of attack [rad] lie beyond those of least and of largest lift.

    Parameters
    ----------
    stall : angles of least and of largest lift [rad], each a number or of the shape of alpha.
    alpha : from -pi to pi [rad], any shape.
    """
    return (alpha < stall[0]) | (alpha > stall[1])


def shed_downwash(
    stall: Sequence[Any],
    per_lift: Sequence[Any],
    alpha: PerStrip,
    lift: PerStrip,
    speed: PerStrip,
    normal_speed: PerStrip,
    xp: Any = np,
) -> Any:
    """Return the downwash that determines the circulation of strips that do not turn [m/s].

    When this downwash changes, a strip sheds circulation. Below the angle a_s of largest lift, it is ``-v_n``. Past
    a_s, circulation follows lift and not the angle: there it is ``V sin(a_s) C_L(alpha)/C_L(a_s)``, which
    vanishes, like the lift, for a plate broadside to the air. A turning strip has the downwash at three quarters of
    the chord, ``c omega/2`` more.

    Theory: equation ``shed-downwash``.

    Parameters
    ----------
    stall, per_lift : of `stall_numbers`.
    alpha, lift, speed, normal_speed : angle of attack [rad] and C_L there, V and v_n [m/s], of one shape.
    xp : the array module that computes, numpy or jax.numpy.
    """
    stalled = xp.where(alpha > 0, per_lift[1], per_lift[0]) * speed * lift
    return xp.where(is_stalled(stall, alpha), stalled, -normal_speed)


def wake_downwash(shares: PairOfNumbers | Sequence[float], downwash: PerStrip, states: WakeStates) -> PerStrip:
    """Return the downwash X of the shed wake [m/s]; the polar sees ``w - X``. Theory: equation ``wake-downwash``.

    Parameters
    ----------
    shares : A_j, shape (2,).
    downwash : w [m/s].
    states : z_1 and z_2 [m/s], each of the shape of w.
    """
    return shares[0] * (downwash - states[0]) + shares[1] * (downwash - states[1])


def wake_rates(
    rates: PairOfNumbers, pace: PerStrip, downwash: PerStrip, states: WakeStates
) -> tuple[PerStrip, PerStrip]:
    """Return the time derivatives of z_1 and z_2 [m/s2]. Theory: equation ``wake-downwash``.

    Parameters
    ----------
    rates : b_j per semi-chord, shape (2,).
    pace : semi-chords in a second, ``2 V / c``.
    downwash, states : as in `wake_downwash`.
    """
    return rates[0] * pace * (downwash - states[0]), rates[1] * pace * (downwash - states[1])
