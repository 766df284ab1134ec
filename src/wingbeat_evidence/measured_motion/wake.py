"""The lag of the wake (`wingbeat.aero.wake`) of strips whose motion was measured at given times."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from wingbeat.aero.coefficient_model import Kernel, kernel_lift
from wingbeat.aero.wake import jones_numbers, shed_downwash, stall_numbers, wake_downwash

Array = NDArray[np.float64]

# Below this product of semi-chords and rate b_j, the weights of a step come from their series.
_SHORT = 1e-3


def strip_downwash(kernel: Kernel, chord: Array, chord_speed: Array, normal_speed: Array, turning: Array) -> Array:
    """Return the downwash w that determines a strip's circulation [m/s], of the arrays' shape.

    Parameters
    ----------
    kernel : the kernel of the polar.
    chord : c [m].
    chord_speed, normal_speed : of the quarter chord through the air, v_c and v_n [m/s].
    turning : omega, leading edge up [rad/s].
    """
    speed, alpha = np.hypot(chord_speed, normal_speed), np.arctan2(-normal_speed, chord_speed)
    flow = alpha, kernel_lift(kernel, alpha), speed, normal_speed
    return shed_downwash(*stall_numbers(kernel), *flow) + 0.5 * chord * turning


def sampled_wake(downwash: Array, travelled: Array, repeats: bool) -> Array:
    """Return the downwash X of the shed wake [m/s], shape (n, strips); the polar sees ``w - X``.

    Between two samples w is taken as linear in s, and the states are integrated exactly. In a motion that repeats,
    the states repeat too; any other motion starts with the wake of steady flight, X = 0.

    Parameters
    ----------
    downwash : w of `strip_downwash` at each time [m/s], shape (n, strips).
    travelled : semi-chords from each time to the next, shape (n - 1, strips). In a motion that repeats, shape (n,
        strips): the last row leads from the last time to the first time of the next beat.
    repeats : whether the motion repeats.

    >>> step = np.array([[0.0], [1.0], [1.0]])  # a step of w at once, then 5 semi-chords
    >>> effective = step - sampled_wake(step, np.array([[0.0], [5.0]]), False)
    >>> effective.ravel().round(3).tolist()  # Wagner's function, 0.5 at 0
    [0.0, 0.5, 0.794]
    """
    following = np.roll(downwash, -1, axis=0)[: len(travelled)]
    shares, rates = jones_numbers("jones-section")
    states = np.empty((2, *downwash.shape))
    for j, rate in enumerate(rates):
        own = states[j]
        fading, ahead, here = _step_weights(rate * travelled)
        pushes = here * downwash[: len(travelled)] + ahead * following
        own[0] = _repeating(fading, pushes, downwash[0]) if repeats else downwash[0]
        for i in range(1, len(downwash)):
            own[i] = fading[i - 1] * own[i - 1] + pushes[i - 1]
    return wake_downwash(shares, downwash, states)


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
