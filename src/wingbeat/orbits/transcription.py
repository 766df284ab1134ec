"""The orbit problem as a small nonlinear programme in scaled unknowns, by single shooting with few steps."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from wingbeat.kinematics import Wingbeat
from wingbeat.model import FlightModel
from wingbeat.orbits.certify import Certificate
from wingbeat.orbits.problem import CLOSURE_SCALE, OrbitProblem, Unknowns
from wingbeat.orbits.shooting import PeriodTangents, fly, fly_with_tangents

_LOST = 1e3


@dataclass
class Point:
    """Values, and once asked for derivatives, at one place of the search, in the optimiser's scale."""

    closure: np.ndarray
    path: np.ndarray
    closure_jacobian: np.ndarray | None = None
    path_jacobian: np.ndarray | None = None


class Transcription:
    """Closure, path bound and objective of a problem as functions of scaled unknowns, each flight flown once.

    `tilt_at` gives the closure the derivative of a finer flight, `shift_at` the value that the certifier finds.
    """

    def __init__(self, problem: OrbitProblem, model: FlightModel | None = None, blocks: int = 1) -> None:
        self.problem = problem
        self.model = model or problem.model
        self.blocks = blocks
        self.unknowns: Unknowns = problem.unknowns()
        self.lower = self.unknowns.lower / self.unknowns.scale
        self.upper = self.unknowns.upper / self.unknowns.scale
        self.pitch_bounds = np.array(problem.bounds["body_pitch"])
        self._shift = np.zeros(6)
        self._tilt = np.zeros((6, self.lower.size))
        self._anchor = np.zeros(self.lower.size)
        self._pitch_shift = np.zeros(2)
        self.flights = 0
        self.jacobians = 0
        self._key: bytes = b""
        self._point: Point | None = None

    def physical(self, scaled: np.ndarray) -> np.ndarray:
        """Return the unknowns in SI, within their bounds."""
        return np.clip(scaled * self.unknowns.scale, self.unknowns.lower, self.unknowns.upper)

    def scaled(self, unknowns: np.ndarray) -> np.ndarray:
        """Return unknowns in the optimiser's scale, within their bounds."""
        return np.clip(unknowns / self.unknowns.scale, self.lower, self.upper)

    def _at(self, scaled: np.ndarray) -> tuple[Point, np.ndarray, Wingbeat]:
        unknowns = self.physical(scaled)
        wingbeat = self.problem.wingbeat(unknowns)
        key = unknowns.tobytes()
        if key != self._key or self._point is None:
            flown = fly(self.model, wingbeat, unknowns[:4], self.blocks)
            self.flights += 1
            self._key, self._point = key, self._pack(flown.end, flown.path, unknowns, wingbeat)
        return self._point, unknowns, wingbeat

    def _pack(self, end: object, path: object, unknowns: np.ndarray, wingbeat: Wingbeat) -> Point:
        closure = self.problem.closure(np.asarray(end), unknowns, wingbeat.frequency) / CLOSURE_SCALE
        # A flight that tumbles off to infinity must still be a number for the line search to back away from.
        closure = np.nan_to_num(closure, nan=_LOST, posinf=_LOST, neginf=-_LOST)
        pitch = np.nan_to_num(np.asarray(path)[:, 0], nan=_LOST, posinf=_LOST, neginf=-_LOST)
        return Point(closure, pitch)

    def _differentiated(self, scaled: np.ndarray) -> Point:
        point, unknowns, wingbeat = self._at(scaled)
        if point.closure_jacobian is None:
            free = self.problem.free
            tangents = fly_with_tangents(self.model, wingbeat, free, unknowns[4:], unknowns[:4], self.blocks)
            self.jacobians += 1
            closure = self.problem.closure_jacobian(np.asarray(tangents.end_jacobian), wingbeat.frequency)
            scale = self.unknowns.scale
            point.closure_jacobian = np.nan_to_num(closure / CLOSURE_SCALE[:, None] * scale)
            point.path_jacobian = np.nan_to_num(np.asarray(tangents.path_jacobian)[:, 0] * scale)
        return point

    def closure(self, scaled: np.ndarray) -> np.ndarray:
        """Return the corrected closure, shape (6,), scaled."""
        return self._at(scaled)[0].closure - self._shift + self._tilt @ (scaled - self._anchor)

    def closure_jacobian(self, scaled: np.ndarray) -> np.ndarray:
        """Return its derivative, shape (6, n)."""
        jacobian = self._differentiated(scaled).closure_jacobian
        assert jacobian is not None
        return jacobian + self._tilt

    def pitch_margin(self, scaled: np.ndarray) -> np.ndarray:
        """Return how far body pitch stays above its lower and below its upper bound on the path [rad]."""
        return self.margins(self._at(scaled)[0].path) - self._pitch_shift

    def margins(self, pitch: np.ndarray) -> np.ndarray:
        """Return how far a path of body pitch stays inside its lower and upper bound [rad]."""
        return np.array([pitch.min() - self.pitch_bounds[0], self.pitch_bounds[1] - pitch.max()])

    def pitch_margin_jacobian(self, scaled: np.ndarray) -> np.ndarray:
        """Return its derivative, shape (2, n)."""
        point = self._differentiated(scaled)
        assert point.path_jacobian is not None
        return np.stack([point.path_jacobian[point.path.argmin()], -point.path_jacobian[point.path.argmax()]])

    def tilt_at(self, scaled: np.ndarray, fine: PeriodTangents) -> None:
        """Take the derivative of the closure from a finer flight at this point, leaving its value there."""
        value = self.closure(scaled)
        own = self._differentiated(scaled).closure_jacobian
        assert own is not None
        wingbeat = self.problem.wingbeat(self.physical(scaled))
        jacobian = self.problem.closure_jacobian(fine.end_jacobian, wingbeat.frequency)
        self._tilt = jacobian / CLOSURE_SCALE[:, None] * self.unknowns.scale - own
        self._anchor = scaled.copy()
        self._shift = self._at(scaled)[0].closure - value

    def shift_at(self, scaled: np.ndarray, certificate: Certificate) -> None:
        """Take the values of closure and path that the certifier finds at this point."""
        point, unknowns, wingbeat = self._at(scaled)
        miss = self.problem.closure(certificate.end, unknowns, wingbeat.frequency) / CLOSURE_SCALE
        self._shift = self._shift + self.closure(scaled) - miss
        self._pitch_shift = self.margins(point.path) - self.margins(certificate.states[:, 2])

    def objective(self, scaled: np.ndarray) -> float:
        """Return the objective over its scale."""
        minimise = self.problem.minimise
        return minimise.value(self.unknowns.names, self.physical(scaled)) / minimise.scale

    def objective_gradient(self, scaled: np.ndarray) -> np.ndarray:
        """Return its derivative, shape (n,)."""
        minimise = self.problem.minimise
        gradient = minimise.gradient(self.unknowns.names, self.physical(scaled))
        return gradient * self.unknowns.scale / minimise.scale
