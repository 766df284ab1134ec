"""What the programme evaluates at one point, and the correction that a finer flight gives it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np


class Point(NamedTuple):
    """Values and derivatives at one point of the search, in the optimiser's scale.

    ``path`` is how far body pitch stays above its lower and below its upper bound [rad], as flown, then how far the
    stroke stays inside its limits.
    """

    closure: np.ndarray
    closure_jacobian: np.ndarray
    path: np.ndarray
    path_jacobian: np.ndarray
    outputs: np.ndarray
    outputs_jacobian: np.ndarray


@dataclass(frozen=True)
class Correction:
    """What a finer flight says near one point: each quantity is less its offset, and its slope away from there."""

    anchor: np.ndarray
    closure_offset: np.ndarray
    closure_slope: np.ndarray
    path_offset: np.ndarray
    outputs_offset: np.ndarray
    outputs_slope: np.ndarray

    @classmethod
    def none(cls, unknowns: int, path: int, outputs: int) -> Correction:
        """Return the correction that changes nothing, for so many unknowns, path limits and outputs."""
        slopes = np.zeros((6, unknowns)), np.zeros((outputs, unknowns))
        return cls(np.zeros(unknowns), np.zeros(6), slopes[0], np.zeros(path), np.zeros(outputs), slopes[1])


def with_column(point: Point) -> Point:
    """Return the point with one more unknown, on which nothing that was flown depends."""
    wider = {
        name: np.pad(value, [(0, 0)] * (value.ndim - 1) + [(0, 1)])
        for name, value in point._asdict().items()
        if name.endswith("jacobian")
    }
    return point._replace(**wider)
