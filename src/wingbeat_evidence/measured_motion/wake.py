"""The lag of the wake: how the vorticity that a strip has shed reduces the downwash at its chord.

When the circulation of a strip changes, the opposite circulation leaves at the trailing edge, drifts away with
the air and slows the change. On a thin aerofoil, let the downwash w at three quarters of the chord rise in a step.
After s semi-chords of travel, the lift is that of the downwash ``w phi(s)``. Here phi is Wagner's function in the
form of Jones 1940 (NACA Report 681): ``phi = 1 - 0.165 exp(-0.0455 s) - 0.335 exp(-0.3 s)``. The effects of many
steps add up (Duhamel; Leishman 2006, Principles of Helicopter Aerodynamics, chapter 8): the lift is that of
``w - X``. The downwash of the wake itself is ``X = sum A_i (w - z_i)``, where z_i follows w with
``dz_i/ds = b_i (w - z_i)``. For a sine this gives ``C(k) = 1 - sum A_i i k / (b_i + i k)``, within 0.02 of
Theodorsen's C(k), which contains Bessel functions (1935, NACA Report 496).

The wake moves the air across the chord, and the strip meets this air as any other wind: its polar, attached or
stalled, is read at the angle of attack in the moved air, and its forces turn with that air. With ``C_L = 2
pi sin(alpha)`` in plunge this is Theodorsen's lift and Garrick's thrust (1936, NACA Report 567). The model of
dynamic stall of Leishman and Beddoes 1989 (doi 10.4050/JAHS.34.3.3) starts with the same step.

The lag is that of a section, as rotation and added mass (`wingbeat.aero.closed_forms`) are. A whole wing of a small
aspect ratio lags less (Jones 1940).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from wingbeat.aero.coefficient_model import Kernel, kernel_lift

Array = NDArray[np.float64]

# A_i and b_i of Jones's form of Wagner's function.
SHARES, RATES = (0.165, 0.335), (0.0455, 0.3)
# Angles at which the largest lift is looked for, from 0 to 90 degrees.
_ANGLES = 901
# Below this product of semi-chords and rate b_i, the weights of a step come from their series.
_SHORT = 1e-3


def largest_lift_angles(kernel: Kernel) -> tuple[float, float]:
    """Return the angles of attack of least and of largest lift between -90 and 90 degrees [rad].

    Beyond them the flow has stalled: lift no longer rises with the angle.

    Parameters
    ----------
    kernel : the kernel of the polar.
    """
    angles = np.linspace(0.0, 0.5 * math.pi, _ANGLES)
    below, above = kernel_lift(kernel, -angles), kernel_lift(kernel, angles)
    return -float(angles[below.argmin()]), float(angles[above.argmax()])


def shed_downwash(kernel: Kernel, chord: Array, chord_speed: Array, normal_speed: Array, turning: Array) -> Array:
    """Return the downwash that determines a strip's circulation [m/s], of the arrays' shape.

    When this downwash changes, the strip sheds circulation. Below the angle a_s of largest lift, it is the downwash
    at three quarters of the chord, ``-v_n + c omega/2``. Past a_s, circulation follows lift and not the angle:
    there ``V sin(a_s) C_L(alpha)/C_L(a_s)`` replaces ``-v_n``. The replacement vanishes, like the lift, for a plate
    broadside to the air.

    Theory: equation ``shed-downwash``.

    Parameters
    ----------
    kernel : the kernel of the polar.
    chord : c [m].
    chord_speed, normal_speed : of the quarter chord through the air, v_c and v_n [m/s].
    turning : omega, leading edge up [rad/s].
    """
    speed, alpha = np.hypot(chord_speed, normal_speed), np.arctan2(-normal_speed, chord_speed)
    lift, downwash = kernel_lift(kernel, alpha), -normal_speed
    for stall, stalled in zip(largest_lift_angles(kernel), _beyond(kernel, alpha), strict=True):
        largest = float(kernel_lift(kernel, np.array(stall)))
        # A polar without lift on a side sheds nothing there.
        per_lift = math.sin(stall) / largest if largest * stall > 0 else 0.0
        downwash = np.where(stalled, speed * per_lift * lift, downwash)
    return downwash + 0.5 * chord * turning


def is_stalled(kernel: Kernel, alpha: Array) -> NDArray[np.bool_]:
    """Return whether angles of attack [rad] lie beyond those of largest lift, on either side.

    Parameters
    ----------
    kernel : the kernel of the polar.
    alpha : from -pi to pi [rad], any shape.
    """
    below, above = _beyond(kernel, alpha)
    return below | above


def _beyond(kernel: Kernel, alpha: Array) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    below, above = largest_lift_angles(kernel)
    return alpha < below, alpha > above


def wake_downwash(downwash: Array, travelled: Array, repeats: bool) -> Array:
    """Return the downwash X of the shed wake [m/s], shape (n, strips); the polar sees ``w - X``.

    Between two samples w is taken as linear in s, and the states are integrated exactly. In a motion that repeats,
    the states repeat too; any other motion starts with the wake of steady flight, X = 0.

    Theory: equation ``wake-downwash``.

    Parameters
    ----------
    downwash : w of `shed_downwash` at each time [m/s], shape (n, strips).
    travelled : semi-chords from each time to the next, shape (n - 1, strips). In a motion that repeats, shape (n,
        strips): the last row leads from the last time to the first time of the next beat.
    repeats : whether the motion repeats.

    >>> step = np.array([[0.0], [1.0], [1.0]])  # a step of w at once, then 5 semi-chords
    >>> effective = step - wake_downwash(step, np.array([[0.0], [5.0]]), False)
    >>> effective.ravel().round(3).tolist()  # Wagner's function, 0.5 at 0
    [0.0, 0.5, 0.794]
    """
    following = np.roll(downwash, -1, axis=0)[: len(travelled)]
    wake = np.zeros_like(downwash)
    for share, rate in zip(SHARES, RATES, strict=True):
        fading, ahead, here = _step_weights(rate * travelled)
        pushes = here * downwash[: len(travelled)] + ahead * following
        states = np.empty_like(downwash)
        states[0] = _repeating(fading, pushes, downwash[0]) if repeats else downwash[0]
        for i in range(1, len(downwash)):
            states[i] = fading[i - 1] * states[i - 1] + pushes[i - 1]
        wake += share * (downwash - states)
    return wake


def _step_weights(way: Array) -> tuple[Array, Array, Array]:
    """Return the weights in the state after a step: of the old state, of w at the end, and of w at the start."""
    fading, few = np.exp(-way), np.minimum(way, _SHORT)
    short = way < _SHORT
    mean = np.where(short, 1 - few / 2 + few * few / 6, -np.expm1(-way) / np.maximum(way, _SHORT))
    ahead = np.where(short, few / 2 - few * few / 6, 1 - mean)
    return fading, ahead, np.where(short, few / 2 - few * few / 3, mean - fading)


def _repeating(fading: Array, pushes: Array, at_rest: Array) -> Array:
    """Return the states at the first time that recur after a beat; for strips that do not travel, `at_rest`."""
    held, gained = np.ones_like(at_rest), np.zeros_like(at_rest)
    for fade, push in zip(fading, pushes, strict=True):
        held, gained = fade * held, fade * gained + push
    lost = 1 - held
    # A strip that does not travel has no wake. If `lost` is below the rounding error of 1, it is meaningless.
    moves = lost > 1e-9
    return np.where(moves, gained / np.where(moves, lost, 1.0), at_rest)
