"""The limits of the stroke: each wing stays on its own side of the body, and within the range of its shoulder."""

from __future__ import annotations

import math

import numpy as np

from wingbeat.mechanics.clearance import has_room
from wingbeat.orbits.flight.path_maxima import PARTS
from wingbeat.orbits.flight.shooting import Flown
from wingbeat.orbits.flight.stroke_distances import ROWS
from wingbeat.orbits.problem.problem import OrbitProblem

_UPRIGHT = 0.5 * math.pi


class StrokeLimits:
    """Margins of a problem's stroke within its limits, as rows of the inequalities.

    There are no rows if no free parameter affects the stroke, or if the wings may cross.

    Parameters
    ----------
    problem : the orbit problem.
    clearance : smallest distance of strip corners from the plane of symmetry, in wing lengths.

    Attributes
    ----------
    names : name and sign of the limit of each row.
    """

    def __init__(self, problem: OrbitProblem, clearance: float) -> None:
        limited = problem.shapes_stroke and not problem.wings_may_cross
        beside = has_room(problem.vehicle)
        self._kept = slice(0 if beside else 2 * PARTS, None if limited else 0)
        self.names = ROWS[self._kept]
        self._free = len(problem.free)
        if not limited:
            return
        low, high = problem.bounds["flap"] if beside else np.clip(problem.bounds["flap"], -_UPRIGHT, _UPRIGHT)
        self._limits = np.array([*[clearance] * 2 * PARTS, low, low, -high, -high])

    def margins(self, flown: Flown) -> tuple[np.ndarray, np.ndarray]:
        """Return the margin of each row for a flight, and the derivative by the free parameters.

        Corners are in wing lengths, flap angles in radians.
        """
        if not self.names:
            return np.zeros(0), np.zeros((0, self._free))
        return (flown.stroke - self._limits)[self._kept], flown.stroke_jacobian[self._kept]
