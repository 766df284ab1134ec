"""Angles of a tracker that jumps by a whole turn, such as from 179 to -179 degrees."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import FaultList

_TURN = 360.0
Array = NDArray[np.float64]


def unwrapped(faults: FaultList, where: str, phase: Array, angle: Array) -> tuple[Array, int]:
    """Return an angle without jumps over the beat [deg], and the number of frames moved by whole turns.

    In the order of phase within the beat, each frame is moved by whole turns until it lies within half a turn of
    the frame before. Then all frames are moved together, so that their mean lies within half a turn of 0. A frame
    that is not moved keeps every digit.

    Parameters
    ----------
    faults : receives a fault if the angle does not come back to its first value after a beat.
    where : of the column, for that fault.
    phase : beats, shape (n,).
    angle : as tracked [deg], shape (n,).

    >>> unwrapped(FaultList(), "pitch", np.arange(4) / 4, np.array([170.0, -175.0, 172.0, 165.0]))
    (array([170., 185., 172., 165.]), 1)
    """
    order = np.argsort(phase % 1.0, kind="stable")
    smooth = np.empty_like(angle)
    smooth[order] = np.unwrap(angle[order], period=_TURN)
    smooth -= _TURN * np.round(smooth.mean() / _TURN)
    first, last = smooth[order[0]], smooth[order[-1]]
    if abs(first - last) > 0.5 * _TURN:
        rule = f"turns from {first:.4g} to {last:.4g} degrees in one beat and does not come back"
        faults.add(where, f"{len(angle)} frames", rule, "film more frames, or drop those where the tracker slipped")
    return smooth, int(np.count_nonzero(np.abs(smooth - angle) > 1.0))
