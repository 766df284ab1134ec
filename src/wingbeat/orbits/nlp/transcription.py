"""The orbit problem as a small nonlinear programme in scaled unknowns, by single shooting with few steps."""

from __future__ import annotations

import copy
from typing import Any

import numpy as np

from wingbeat.orbits.flight.certify import Certificate
from wingbeat.orbits.flight.path_maxima import peak_weights
from wingbeat.orbits.flight.shooting import Flown, flier
from wingbeat.orbits.nlp.outputs import Outputs
from wingbeat.orbits.nlp.point import Correction, Point, with_column
from wingbeat.orbits.nlp.stroke_limits import StrokeLimits
from wingbeat.orbits.options.solver import DEFAULTS, SolverOptions
from wingbeat.orbits.problem.problem import CLOSURE_SCALE, OrbitProblem
from wingbeat.orbits.problem.unknowns import Unknowns

# Larger sums of a flight's numbers overflow when squared, or soon will.
_OVERFLOW = 1e12
# Number of cached flights: the flight of the current point, and those where a difference or a line search started.
_REMEMBERED = 4
# Bounds of the epigraph variable, in the objective's scale.
_UNBOUNDED = 1e6
_PITCH_LIMITS = (("body_pitch", ">="), ("body_pitch", "<="))


class _Clock:
    """A sum of times [s]."""

    seconds = 0.0


class Transcription:
    """Closure, inequalities and objective of a problem as functions of scaled unknowns; flights are cached.

    If the objective is the largest value of a series, the last unknown is the epigraph variable: an upper limit of
    the series' peaks. A programme is immutable; `linearised_at` and `matched_to` return a corrected one.

    Parameters
    ----------
    problem : the orbit problem.
    options : of the solvers.
    blocks : a flight has this many times `STEPS` steps.
    unknowns : bounds and scales that replace the problem's own, for a point just outside the bounds.

    Attributes
    ----------
    lower, upper : bounds of the scaled unknowns, shape (n,).
    outputs : objective and constraints that are outputs of the wingbeat; None if there are none.
    has_epigraph : whether the last unknown is the epigraph variable.
    path_limits : name and sign of each limit along the path, of body pitch and of the stroke.
    certify_seconds : time of the certifier for this programme and those corrected from it [s].
    """

    def __init__(
        self,
        problem: OrbitProblem,
        options: SolverOptions = DEFAULTS,
        blocks: int = 1,
        unknowns: Unknowns | None = None,
    ) -> None:
        self.problem = problem
        self.options = options
        self.model = problem.model
        self.unknowns: Unknowns = unknowns or problem.unknowns()
        self._blocks = blocks
        self._stroke = StrokeLimits(problem, options.search.plane_clearance)
        self.fly = flier(
            self.model,
            problem.species.wingbeat,
            problem.free,
            whole_path=problem.has_outputs,
            stroke=bool(self._stroke.names),
        )
        self.outputs = Outputs(problem, self.fly) if problem.has_outputs else None
        self.has_epigraph = self.outputs is not None and self.outputs.minimises_peaks
        scale = np.append(self.unknowns.scale, [1.0] * self.has_epigraph)
        self._scale = scale
        self.lower = np.append(self.unknowns.lower, [-_UNBOUNDED] * self.has_epigraph) / scale
        self.upper = np.append(self.unknowns.upper, [_UNBOUNDED] * self.has_epigraph) / scale
        self.pitch_bounds = np.array(problem.bounds["body_pitch"])
        # With the smooth peak, starts for least frequency diverge: they found 11 of a study's 14 orbits with it,
        # all 14 without it. Optima of outputs lie between two samples and need the smooth peak.
        self._peak = highest_sample if self.outputs is None else peak_weights
        self.path_limits = (*_PITCH_LIMITS, *self._stroke.names)
        self._points: dict[bytes, Point] = {}
        self._correction = self._no_correction
        self._clock = _Clock()

    @property
    def _no_correction(self) -> Correction:
        outputs = 0 if self.outputs is None else self.outputs.count
        return Correction.none(self.lower.size, len(self.path_limits), outputs)

    def uncorrected(self) -> Transcription:
        """Return a copy without the correction, for a parallel local search; the copy keeps the cached flights."""
        other = copy.copy(self)
        other._correction = self._no_correction
        other._points = dict(self._points)
        other._clock = _Clock()
        return other

    def _corrected(self, correction: Correction) -> Transcription:
        other = copy.copy(self)
        other._correction = correction
        return other

    @property
    def certify_seconds(self) -> float:
        """Time of the certifier for this programme and those corrected from it [s]."""
        return self._clock.seconds

    def count_certifying(self, seconds: float) -> None:
        """Add to the certifier's time."""
        self._clock.seconds += seconds

    def physical(self, scaled: np.ndarray) -> np.ndarray:
        """Return the unknowns in SI, within their bounds."""
        unknowns = scaled[: self.unknowns.lower.size] * self.unknowns.scale
        return np.minimum(np.maximum(unknowns, self.unknowns.lower), self.unknowns.upper)

    def scaled(self, unknowns: np.ndarray) -> np.ndarray:
        """Return unknowns in the optimiser's scale, within their bounds."""
        if not self.has_epigraph:
            return np.minimum(np.maximum(unknowns / self._scale, self.lower), self.upper)
        scaled = np.append(unknowns, 0.0) / self._scale
        scaled = np.minimum(np.maximum(scaled, self.lower), self.upper)
        scaled[-1] = self._outputs(scaled)[: self._minimised].max()
        return scaled

    @property
    def _minimised(self) -> int:
        """Number of outputs that belong to the objective."""
        return 0 if self.outputs is None else self.outputs.of_objective

    def point(self, scaled: np.ndarray) -> Point:
        """Return values and derivatives of the flight from one point."""
        key = scaled[: self.unknowns.lower.size].tobytes()
        if key not in self._points:
            unknowns = self.physical(scaled)
            if len(self._points) == _REMEMBERED:
                del self._points[next(iter(self._points))]
            self._points[key] = self._fly(unknowns, self._blocks)
        return self._points[key]

    def _fly(self, unknowns: np.ndarray, blocks: int) -> Point:
        # A diverging flight may overflow here; `_cut` limits its numbers.
        with np.errstate(over="ignore", invalid="ignore"):
            return self._cut(self.fly(unknowns[4:], unknowns[:4], blocks), unknowns, blocks)

    def _cut(self, flown: Flown, unknowns: np.ndarray, blocks: int) -> Point:
        problem, scale = self.problem, self.unknowns.scale
        frequency = problem.frequency(unknowns)
        closure = problem.closure(flown.end, unknowns, frequency) / CLOSURE_SCALE
        jacobian = problem.closure_jacobian(flown.end_jacobian, frequency) * scale / CLOSURE_SCALE[:, None]
        pitch, pitch_jacobian = flown.path[:, 0], flown.path_jacobian[:, 0] * scale
        tame = abs(closure.sum()) + abs(jacobian.sum()) + abs(pitch.sum()) + abs(pitch_jacobian.sum()) < _OVERFLOW
        outputs, outputs_jacobian = np.zeros(0), np.zeros((0, scale.size))
        if self.outputs is not None:
            outputs, outputs_jacobian = self.outputs.of(unknowns, flown, blocks) if tame else self.outputs.undefined
            tame = tame and abs(outputs.sum()) + abs(outputs_jacobian.sum()) < _OVERFLOW
            outputs_jacobian = outputs_jacobian * scale
        if not tame:
            # The line search needs finite numbers to back away from a diverging flight.
            flight, most = (closure, jacobian, pitch, pitch_jacobian, outputs, outputs_jacobian), self._largest
            cut = (np.clip(np.nan_to_num(a, nan=most), -most, most) for a in flight)
            closure, jacobian, pitch, pitch_jacobian, outputs, outputs_jacobian = cut
        lowest, highest = self._peak(-pitch), self._peak(pitch)
        stroke, stroke_jacobian = self._stroke.margins(flown)
        path = np.append(self._inside(lowest @ pitch, highest @ pitch), stroke)
        path_jacobian = np.zeros((len(path), scale.size))
        path_jacobian[:2] = lowest @ pitch_jacobian, -highest @ pitch_jacobian
        path_jacobian[2:, 4:] = stroke_jacobian * scale[4:]
        point = Point(closure, jacobian, path, path_jacobian, outputs, outputs_jacobian)
        return point if not self.has_epigraph else with_column(point)

    @property
    def _largest(self) -> float:
        return self.options.search.largest_residual

    def closure(self, scaled: np.ndarray) -> np.ndarray:
        """Return the corrected closure, shape (6,), scaled."""
        by = self._correction
        return self.point(scaled).closure - by.closure_offset + by.closure_slope @ (scaled - by.anchor)

    def closure_jacobian(self, scaled: np.ndarray) -> np.ndarray:
        """Return the derivative of the corrected closure, shape (6, n)."""
        return self.point(scaled).closure_jacobian + self._correction.closure_slope

    def _outputs(self, scaled: np.ndarray) -> np.ndarray:
        by = self._correction
        return self.point(scaled).outputs - by.outputs_offset + by.outputs_slope @ (scaled - by.anchor)

    def inequalities(self, scaled: np.ndarray) -> np.ndarray:
        """Return the margin of everything that has a limit; a margin is negative if its limit is exceeded.

        The margins have this order:

        1. The limits along the path, as named by `path_limits`: body pitch above its lower bound and below its
           upper bound [rad], then the stroke [wing lengths for strip corners, rad for the flap angle].
        2. The constraints, each divided by the scale of its quantity.
        3. If there is an epigraph variable, its excess over each peak of the objective, in the objective's scale.
        """
        path = self.point(scaled).path - self._correction.path_offset
        if self.outputs is None:
            return path
        outputs = self._outputs(scaled)
        constraints = self.outputs.limits - outputs[self._minimised :]
        below = scaled[-1] - outputs[: self._minimised] if self.has_epigraph else np.zeros(0)
        return np.concatenate([path, constraints, below])

    def pitch_margins(self, pitch: np.ndarray) -> np.ndarray:
        """Return the margins of a path of body pitch within its lower and upper bound [rad]."""
        return self._inside(self._peak(-pitch) @ pitch, self._peak(pitch) @ pitch)

    def _inside(self, lowest: Any, highest: Any) -> np.ndarray:
        return np.array([lowest - self.pitch_bounds[0], self.pitch_bounds[1] - highest])

    def inequalities_jacobian(self, scaled: np.ndarray) -> np.ndarray:
        """Return the derivative of the inequalities, shape (inequalities, n)."""
        point = self.point(scaled)
        if self.outputs is None:
            return point.path_jacobian
        outputs = point.outputs_jacobian + self._correction.outputs_slope
        below = np.zeros_like(outputs[: self._minimised if self.has_epigraph else 0])
        if self.has_epigraph:
            below[:, -1] = 1.0
            below -= outputs[: self._minimised]
        return np.concatenate([point.path_jacobian, -outputs[self._minimised :], below])

    def active_conditions(self, scaled: np.ndarray, active: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return closure and the active inequalities, all of which must vanish, and their derivative."""
        values = np.concatenate([self.closure(scaled), self.inequalities(scaled)[active]])
        by_inequalities = self.inequalities_jacobian(scaled)[active]
        return values, np.concatenate([self.closure_jacobian(scaled), by_inequalities])

    def linearised_at(self, scaled: np.ndarray, blocks: int) -> Transcription:
        """Return the programme, corrected to values and derivatives of a flight with more blocks at this point.

        Theory: equation ``defect-correction``.
        """
        here, unknowns = self.point(scaled), self.physical(scaled)
        fine = self._fly(unknowns, blocks)
        return self._corrected(
            Correction(
                anchor=scaled.copy(),
                closure_offset=here.closure - fine.closure,
                closure_slope=fine.closure_jacobian - here.closure_jacobian,
                path_offset=here.path - fine.path,
                outputs_offset=here.outputs - fine.outputs,
                outputs_slope=fine.outputs_jacobian - here.outputs_jacobian,
            )
        )

    def matched_to(self, scaled: np.ndarray, certificate: Certificate) -> Transcription:
        """Return the programme, corrected to the certifier's values of closure, path and outputs at this point.

        Theory: equation ``defect-correction``.
        """
        unknowns, by = self.physical(scaled), self._correction
        residual = self.problem.closure(certificate.end, unknowns, self.problem.frequency(unknowns)) / CLOSURE_SCALE
        path_offset = by.path_offset.copy()
        path_offset[:2] = self.point(scaled).path[:2] - self.pitch_margins(certificate.pitch)
        outputs_offset = by.outputs_offset
        if self.outputs is not None:
            outputs_offset = (
                outputs_offset + self._outputs(scaled) - self.outputs.of_certified(unknowns, certificate)
            )
        return self._corrected(
            Correction(
                anchor=by.anchor,
                closure_offset=by.closure_offset + self.closure(scaled) - residual,
                closure_slope=by.closure_slope,
                path_offset=path_offset,
                outputs_offset=outputs_offset,
                outputs_slope=by.outputs_slope,
            )
        )

    def certified_inequalities(self, scaled: np.ndarray, certificate: Certificate) -> np.ndarray:
        """Return the margins of body pitch, the stroke and the constraints in the certified flight."""
        path = np.append(self.pitch_margins(certificate.pitch), self.point(scaled).path[2:])
        if self.outputs is None:
            return path
        outputs = self.outputs.of_certified(self.physical(scaled), certificate, exact=True)
        return np.concatenate([path, self.outputs.limits - outputs[self._minimised :]])

    def objective(self, scaled: np.ndarray) -> float:
        """Return the objective over its scale."""
        if self.has_epigraph:
            return float(scaled[-1])
        if self._minimised:
            return float(self._outputs(scaled)[0])
        return float(self.physical(scaled)[self._parameter]) / self.problem.minimise.scale

    def objective_gradient(self, scaled: np.ndarray) -> np.ndarray:
        """Return the derivative of the objective over its scale, shape (n,)."""
        if self.has_epigraph:
            return np.eye(1, scaled.size, scaled.size - 1)[0]
        if self._minimised:
            return self.point(scaled).outputs_jacobian[0] + self._correction.outputs_slope[0]
        unit = np.eye(1, self.unknowns.scale.size, self._parameter)[0]
        return unit * self.unknowns.scale / self.problem.minimise.scale

    @property
    def _parameter(self) -> int:
        """Index of the objective among the unknowns, if it is one of them."""
        return self.unknowns.names.index(self.problem.minimise.parameter)


def highest_sample(values: np.ndarray) -> np.ndarray:
    """Return the weights that select the highest sample."""
    weights = np.zeros(len(values))
    weights[values.argmax()] = 1.0
    return weights
