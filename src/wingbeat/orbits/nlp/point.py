"""The programme's values at one point, and their correction by a finer flight."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np


class Point(NamedTuple):
    """Values and derivatives at one point, in the optimiser's scale.

    ``path`` holds the margins of body pitch above its lower bound and below its upper bound [rad], then the margins
    of the stroke (`StrokeLimits.margins`).
    """

    closure: np.ndarray
    closure_jacobian: np.ndarray
    path: np.ndarray
    path_jacobian: np.ndarray
    outputs: np.ndarray
    outputs_jacobian: np.ndarray


@dataclass(frozen=True)
class Correction:
    """Correction of a programme near one point, from a finer flight.

    The offset is subtracted from the value. The slope times the distance from the point (`anchor`) is added.
    """

    anchor: np.ndarray
    closure_offset: np.ndarray
    closure_slope: np.ndarray
    path_offset: np.ndarray
    outputs_offset: np.ndarray
    outputs_slope: np.ndarray

    @classmethod
    def none(cls, unknowns: int, path: int, outputs: int) -> Correction:
        """Return the correction that changes nothing, for these numbers of unknowns, path limits and outputs."""
        slopes = np.zeros((6, unknowns)), np.zeros((outputs, unknowns))
        return cls(np.zeros(unknowns), np.zeros(6), slopes[0], np.zeros(path), np.zeros(outputs), slopes[1])


def with_column(point: Point) -> Point:
    """Return the point with one more unknown, on which the flight does not depend."""
    wider = {
        name: np.pad(value, [(0, 0)] * (value.ndim - 1) + [(0, 1)])
        for name, value in point._asdict().items()
        if name.endswith("jacobian")
    }
    return point._replace(**wider)
