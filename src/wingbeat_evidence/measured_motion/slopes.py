"""Rates of change of measured series: a cubic smoothing spline whose stiffness cross-validation chooses.

Measured frames contain noise, and a difference of two frames divides this noise by the short time between them.
The natural cubic spline f minimises ``sum (y - f)^2 + stiffness * integral f''^2``; its slopes are the rates.
Generalised cross-validation (Craven and Wahba 1979, doi 10.1007/BF01404567) picks the stiffness that predicts a
left-out frame best. All series of a call have one stiffness, so that all strips are treated alike. Series without
noise keep their values; noisy series lose their noise. The first four harmonics of the beat are never smoothed
away. If a motion repeats, the series is continued on both sides. Otherwise the slopes at the first and last frames
are less certain than at other frames, because no frames beyond them are known.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

# Harmonics of the beat that no smoothing may take off.
_KEPT = 4.0
# Angle per frame beyond which the stiffest and the softest spline smooth; the softest passes through all frames.
_SOFTEST = 30.0
_STIFFNESSES = 30
# Frames of the continuation on either side: over 40 frames, the effect of its ends fades to 0.27^40.
_MARGIN = 40


def smoothed_slopes(times: Array, values: Array, frequency: float, period: float | None) -> tuple[Array, Array]:
    """Return series without their noise, and their rates of change.

    Parameters
    ----------
    times : of the frames, rising [s], shape (n,).
    values : the series, along the first axis, shape (n, ...).
    frequency : of the beat [Hz].
    period : time after which the series repeat [s], or None.

    >>> t = np.linspace(0.0, 1.0, 100, endpoint=False)
    >>> value, slope = smoothed_slopes(t, np.sin(2 * np.pi * t), 1.0, 1.0)
    >>> bool(np.abs(slope - 2 * np.pi * np.cos(2 * np.pi * t)).max() < 1e-4)
    True
    """
    flat = values.reshape(len(times), -1)
    first = 0
    if period is not None:
        times, flat, first = _continued(times, flat, period)
    step = float(np.diff(times).mean())
    smooth, slope = _spline(times / step, flat, 2 * math.pi * _KEPT * frequency * step)
    held = slice(first, first + len(values))
    return smooth[held].reshape(values.shape), slope[held].reshape(values.shape) / step


def _continued(times: Array, flat: Array, period: float) -> tuple[Array, Array, int]:
    """Return the series with frames of the beats before and after, and the number of frames before."""
    close = 1e-3 * float(np.diff(times).min())
    # If the last frame repeats the first one a period later, it is not taken twice.
    once = times < times[0] + period - close
    beat, held = times[once], flat[once]
    count = min(_MARGIN, len(beat))
    later = beat + period > times[-1] + close
    after = np.flatnonzero(later)[:count]
    joined = np.concatenate([beat[-count:] - period, times, beat[after] + period])
    return joined, np.concatenate([held[-count:], flat, held[after]]), count


def _spline(times: Array, values: Array, kept: float) -> tuple[Array, Array]:
    """Return values and slopes of the spline at its knots, the times, whose mean step is one (Reinsch 1967)."""
    step = np.diff(times)
    rises = np.diff(values, axis=0) / step[:, None]
    bends = np.diff(rises, axis=0)
    # The bands of R, of second derivatives, and of Q'Q, the upper ones first, as `solveh_banded` reads them.
    roughness = np.zeros((3, len(times) - 2))
    roughness[2] = (step[:-1] + step[1:]) / 3
    roughness[1, 1:] = step[1:-1] / 6
    inverse = 1 / step
    middle = inverse[:-1] + inverse[1:]
    product = np.zeros_like(roughness)
    product[2] = inverse[:-1] ** 2 + middle**2 + inverse[1:] ** 2
    product[1, 1:] = -inverse[1:-1] * (middle[:-1] + middle[1:])
    product[0, 2:] = inverse[1:-2] * inverse[2:-1]
    stiffness = _stiffness(roughness, product, step, bends, kept)
    second, off = _bent(roughness, product, step, bends, stiffness)
    smooth = values - off
    second = np.pad(second, ((1, 1), (0, 0)))
    slope = np.diff(smooth, axis=0) / step[:, None]
    before = slope - step[:, None] / 6 * (2 * second[:-1] + second[1:])
    last = slope[-1:] + step[-1] / 6 * (second[-2:-1] + 2 * second[-1:])
    return smooth, np.concatenate([before, last])


def _bent(roughness: Array, product: Array, step: Array, bends: Array, stiffness: float) -> tuple[Array, Array]:
    """Return the second derivatives at the inner knots and the distances of the spline from the values."""
    from scipy.linalg import solveh_banded

    second = solveh_banded(roughness + stiffness * product, bends, check_finite=False)
    pull = np.diff(np.pad(second, ((1, 1), (0, 0))), axis=0) / step[:, None]
    return second, stiffness * np.diff(np.pad(pull, ((1, 1), (0, 0))), axis=0)


def _stiffness(roughness: Array, product: Array, step: Array, bends: Array, kept: float) -> float:
    """Return the stiffness that generalised cross-validation chooses, for all series together."""
    count = len(step) + 1
    # Eigenvalues of R^-1 Q'Q for equal steps, except for the corners. They give the spline's effective number of
    # parameters.
    angle = math.pi * np.arange(1, count - 1) / (count - 1)
    own = 3 * (2 - 2 * np.cos(angle)) ** 2 / (2 + np.cos(angle))
    best, least = 0.0, math.inf
    for cut in np.geomspace(_SOFTEST, min(kept, _SOFTEST / 2), _STIFFNESSES):
        stiffness = cut**-4.0
        off = _bent(roughness, product, step, bends, stiffness)[1]
        spent = 2 + (1 / (1 + stiffness * own)).sum()
        score = float((off * off).sum()) / (count - spent) ** 2
        if score < least:
            best, least = stiffness, score
    return best
