"""The orbit problem as a small nonlinear programme in scaled unknowns, by single shooting with few steps."""

from __future__ import annotations

import copy
from typing import NamedTuple

import numpy as np

from wingbeat.orbits.certify import Certificate
from wingbeat.orbits.problem import CLOSURE_SCALE, OrbitProblem, Unknowns
from wingbeat.orbits.shooting import Flown, flier

_LOST = 1e3
# Sums of a flight's numbers beyond this overflow when squared, or soon will.
_WILD = 1e12
# Flights remembered: that of the point at hand, and of the points that a difference or a line search started from.
_KEPT = 4
# An unknown this near to a bound, as a share of its range, is at the bound; body pitch likewise, in rad.
AT_BOUND = 1e-6


class Point(NamedTuple):
    """Values and derivatives at one place of the search, in the optimiser's scale."""

    closure: np.ndarray
    closure_jacobian: np.ndarray
    pitch: np.ndarray
    pitch_jacobian: np.ndarray


class Transcription:
    """Closure, path bound and objective of a problem as functions of scaled unknowns, each flight flown once.

    `tilt_at` gives the closure the derivative of a finer flight, `shift_at` the value that the certifier finds.
    """

    def __init__(self, problem: OrbitProblem) -> None:
        self.problem = problem
        self.model = problem.model
        self.unknowns: Unknowns = problem.unknowns()
        self.lower = self.unknowns.lower / self.unknowns.scale
        self.upper = self.unknowns.upper / self.unknowns.scale
        self._closure_scale = self.unknowns.scale / CLOSURE_SCALE[:, None]
        self.pitch_bounds = np.array(problem.bounds["body_pitch"])
        self.fly = flier(self.model, problem.species.wingbeat, problem.free)
        self._points: dict[bytes, Point] = {}
        self._uncorrect()

    def _uncorrect(self) -> None:
        self._shift = np.zeros(6)
        self._tilt = np.zeros((6, self.lower.size))
        self._anchor = np.zeros(self.lower.size)
        self._pitch_shift = np.zeros(2)
        self.certify_seconds = 0.0

    def anew(self) -> Transcription:
        """Return the same problem uncorrected, for another search at the same time; flights are remembered."""
        other = copy.copy(self)
        other._uncorrect()
        other._points = dict(self._points)
        return other

    def physical(self, scaled: np.ndarray) -> np.ndarray:
        """Return the unknowns in SI, within their bounds."""
        return np.minimum(np.maximum(scaled * self.unknowns.scale, self.unknowns.lower), self.unknowns.upper)

    def scaled(self, unknowns: np.ndarray) -> np.ndarray:
        """Return unknowns in the optimiser's scale, within their bounds."""
        return np.minimum(np.maximum(unknowns / self.unknowns.scale, self.lower), self.upper)

    def _at(self, scaled: np.ndarray) -> Point:
        key = scaled.tobytes()
        if key not in self._points:
            unknowns = self.physical(scaled)
            if len(self._points) == _KEPT:
                del self._points[next(iter(self._points))]
            self._points[key] = self._scaled(self.fly(unknowns[4:], unknowns[:4]), unknowns)
        return self._points[key]

    def _scaled(self, flown: Flown, unknowns: np.ndarray) -> Point:
        problem, scale = self.problem, self.unknowns.scale
        frequency = problem.frequency(unknowns)
        closure = problem.closure(flown.end, unknowns, frequency) / CLOSURE_SCALE
        jacobian = problem.closure_jacobian(flown.end_jacobian, frequency) * self._closure_scale
        point = Point(closure, jacobian, flown.pitch, flown.pitch_jacobian * scale)
        # A flight that tumbles off to infinity must still be a number for the line search to back away from.
        if abs(sum(float(a.sum()) for a in point)) < _WILD:
            return point
        return Point(*(np.clip(np.nan_to_num(a, nan=_LOST), -_LOST, _LOST) for a in point))

    def closure(self, scaled: np.ndarray) -> np.ndarray:
        """Return the corrected closure, shape (6,), scaled."""
        return self._at(scaled).closure - self._shift + self._tilt @ (scaled - self._anchor)

    def closure_jacobian(self, scaled: np.ndarray) -> np.ndarray:
        """Return its derivative, shape (6, n)."""
        return self._at(scaled).closure_jacobian + self._tilt

    def pitch_margin(self, scaled: np.ndarray) -> np.ndarray:
        """Return how far body pitch stays above its lower and below its upper bound on the path [rad]."""
        return self.margins(self._at(scaled).pitch) - self._pitch_shift

    def margins(self, pitch: np.ndarray) -> np.ndarray:
        """Return how far a path of body pitch stays inside its lower and upper bound [rad]."""
        return np.array([pitch.min() - self.pitch_bounds[0], self.pitch_bounds[1] - pitch.max()])

    def pitch_margin_jacobian(self, scaled: np.ndarray) -> np.ndarray:
        """Return its derivative, shape (2, n)."""
        point = self._at(scaled)
        return np.stack([point.pitch_jacobian[point.pitch.argmin()], -point.pitch_jacobian[point.pitch.argmax()]])

    def tilt_at(self, scaled: np.ndarray, blocks: int) -> None:
        """Take closure, its derivative and the path bound's value from a flight of more blocks at this point."""
        here, unknowns = self._at(scaled), self.physical(scaled)
        fine = self._scaled(self.fly(unknowns[4:], unknowns[:4], blocks), unknowns)
        self._tilt = fine.closure_jacobian - here.closure_jacobian
        self._anchor = scaled.copy()
        self._shift = here.closure - fine.closure
        self._pitch_shift = self.margins(here.pitch) - self.margins(fine.pitch)

    def shift_at(self, scaled: np.ndarray, certificate: Certificate) -> None:
        """Take the values of closure and path that the certifier finds at this point."""
        unknowns = self.physical(scaled)
        miss = self.problem.closure(certificate.end, unknowns, self.problem.frequency(unknowns)) / CLOSURE_SCALE
        self._shift = self._shift + self.closure(scaled) - miss
        self._pitch_shift = self.margins(self._at(scaled).pitch) - self.margins(certificate.pitch)

    def objective(self, scaled: np.ndarray) -> float:
        """Return the objective over its scale."""
        minimise = self.problem.minimise
        return minimise.value(self.unknowns.names, self.physical(scaled)) / minimise.scale

    def objective_gradient(self, scaled: np.ndarray) -> np.ndarray:
        """Return its derivative, shape (n,)."""
        minimise = self.problem.minimise
        gradient = minimise.gradient(self.unknowns.names, self.physical(scaled))
        return gradient * self.unknowns.scale / minimise.scale
