"""The orbit problem as a small nonlinear programme in scaled unknowns, by single shooting with few steps."""

from __future__ import annotations

import copy
from typing import Any, NamedTuple

import numpy as np

from wingbeat.orbits.flight.certify import Certificate
from wingbeat.orbits.flight.path_maxima import peak_weights
from wingbeat.orbits.flight.shooting import Flown, flier
from wingbeat.orbits.nlp.outputs import AT_BOUND as AT_BOUND
from wingbeat.orbits.nlp.outputs import Asked
from wingbeat.orbits.nlp.stroke_limits import StrokeLimits
from wingbeat.orbits.problem.objectives import Frequency
from wingbeat.orbits.problem.problem import CLOSURE_SCALE, OrbitProblem, Unknowns

_LOST = 1e3
# Sums of a flight's numbers beyond this overflow when squared, or soon will.
_WILD = 1e12
# Flights remembered: that of the point at hand, and of the points that a difference or a line search started from.
_KEPT = 4
# Bounds of the level under which a series' peaks are brought, in the objective's scale.
_LEVELS = 1e6
_PITCH_LIMITS = (("body_pitch", ">="), ("body_pitch", "<="))


class Point(NamedTuple):
    """Values and derivatives at one place of the search, in the optimiser's scale.

    ``inside`` is how far body pitch stays above its lower and below its upper bound [rad], as flown, then how
    far the stroke stays inside its limits.
    """

    closure: np.ndarray
    closure_jacobian: np.ndarray
    inside: np.ndarray
    inside_jacobian: np.ndarray
    rows: np.ndarray
    rows_jacobian: np.ndarray


class Transcription:
    """Closure, margins and objective of a problem as functions of scaled unknowns, each flight flown once.

    A series' largest value is made least by one more unknown: a level, the last, that none of its peaks may pass.
    `tilt_at` gives the closure the derivative of a finer flight, `shift_at` the value that the certifier finds;
    likewise what is read off the beat.

    Parameters
    ----------
    problem : the orbit problem.
    blocks : how many times `STEPS` steps a flight has.
    unknowns : replace the problem's own bounds and scales, for a point just outside of them.
    """

    def __init__(self, problem: OrbitProblem, blocks: int = 1, unknowns: Unknowns | None = None) -> None:
        self.problem = problem
        self.model = problem.model
        self.unknowns: Unknowns = unknowns or problem.unknowns()
        self._blocks = blocks
        self.asked = Asked(problem) if problem.reads_beat else None
        self.has_level = self.asked is not None and self.asked.has_peaks_to_lower
        scale = np.append(self.unknowns.scale, [1.0] * self.has_level)
        self._all_scale = scale
        self.lower = np.append(self.unknowns.lower, [-_LEVELS] * self.has_level) / scale
        self.upper = np.append(self.unknowns.upper, [_LEVELS] * self.has_level) / scale
        self.pitch_bounds = np.array(problem.bounds["body_pitch"])
        # Searches for least frequency go astray on the smooth peak (11 orbits of a study's 14, all 14 without it);
        # optima of what is read off the beat settle between two samples and need it.
        self._peak = highest_sample if self.asked is None else peak_weights
        self._stroke = StrokeLimits(problem)
        self.path_limits = (*_PITCH_LIMITS, *self._stroke.names)
        self.fly = flier(
            self.model,
            problem.species.wingbeat,
            problem.free,
            whole_path=problem.reads_beat,
            stroke=bool(self._stroke.names),
        )
        self._points: dict[bytes, Point] = {}
        self._uncorrect()

    def _uncorrect(self) -> None:
        count = 0 if self.asked is None else self.asked.count
        self._shift = np.zeros(6)
        self._tilt = np.zeros((6, self.lower.size))
        self._anchor = np.zeros(self.lower.size)
        self._inside_shift = np.zeros(len(self.path_limits))
        self._rows_shift = np.zeros(count)
        self._rows_tilt = np.zeros((count, self.lower.size))
        self.certify_seconds = 0.0

    def anew(self) -> Transcription:
        """Return the same problem uncorrected, for another search at the same time; flights are remembered."""
        other = copy.copy(self)
        other._uncorrect()
        other._points = dict(self._points)
        return other

    def physical(self, scaled: np.ndarray) -> np.ndarray:
        """Return the unknowns in SI, within their bounds."""
        unknowns = scaled[: self.unknowns.lower.size] * self.unknowns.scale
        return np.minimum(np.maximum(unknowns, self.unknowns.lower), self.unknowns.upper)

    def scaled(self, unknowns: np.ndarray) -> np.ndarray:
        """Return unknowns in the optimiser's scale, within their bounds."""
        if not self.has_level:
            return np.minimum(np.maximum(unknowns / self._all_scale, self.lower), self.upper)
        scaled = np.append(unknowns, 0.0) / self._all_scale
        scaled = np.minimum(np.maximum(scaled, self.lower), self.upper)
        scaled[-1] = self._rows(scaled)[: self._lowered].max()
        return scaled

    @property
    def _lowered(self) -> int:
        """How many of the rows are the objective's."""
        return 0 if self.asked is None else self.asked.objective_rows

    def _at(self, scaled: np.ndarray) -> Point:
        key = scaled[: self.unknowns.lower.size].tobytes()
        if key not in self._points:
            unknowns = self.physical(scaled)
            if len(self._points) == _KEPT:
                del self._points[next(iter(self._points))]
            self._points[key] = self._scaled(self.fly(unknowns[4:], unknowns[:4], self._blocks), unknowns)
        return self._points[key]

    def _scaled(self, flown: Flown, unknowns: np.ndarray) -> Point:
        # A flight that runs off may overflow here; what is wild is tamed below.
        with np.errstate(over="ignore", invalid="ignore"):
            return self._tamed(flown, unknowns)

    def _tamed(self, flown: Flown, unknowns: np.ndarray) -> Point:
        problem, scale = self.problem, self.unknowns.scale
        frequency = problem.frequency(unknowns)
        closure = problem.closure(flown.end, unknowns, frequency) / CLOSURE_SCALE
        jacobian = problem.closure_jacobian(flown.end_jacobian, frequency) * scale / CLOSURE_SCALE[:, None]
        pitch, pitch_jacobian = flown.path[:, 0], flown.path_jacobian[:, 0] * scale
        tame = abs(closure.sum()) + abs(jacobian.sum()) + abs(pitch.sum()) + abs(pitch_jacobian.sum()) < _WILD
        rows, rows_jacobian = np.zeros(0), np.zeros((0, scale.size))
        if self.asked is not None:
            rows, rows_jacobian = self.asked.read(unknowns, flown) if tame else self.asked.lost
            tame = tame and abs(rows.sum()) + abs(rows_jacobian.sum()) < _WILD
            rows_jacobian = rows_jacobian * scale
        if not tame:
            # A flight that tumbles off to infinity must still be a number for the line search to back away from.
            flight = (closure, jacobian, pitch, pitch_jacobian, rows, rows_jacobian)
            tamed = (np.clip(np.nan_to_num(a, nan=_LOST), -_LOST, _LOST) for a in flight)
            closure, jacobian, pitch, pitch_jacobian, rows, rows_jacobian = tamed
        lowest, highest = self._peak(-pitch), self._peak(pitch)
        stroke, stroke_jacobian = self._stroke.margins(flown)
        inside = np.append(self._inside(lowest @ pitch, highest @ pitch), stroke)
        inside_jacobian = np.zeros((len(inside), scale.size))
        inside_jacobian[:2] = lowest @ pitch_jacobian, -highest @ pitch_jacobian
        inside_jacobian[2:, 4:] = stroke_jacobian * scale[4:]
        point = Point(closure, jacobian, inside, inside_jacobian, rows, rows_jacobian)
        return point if not self.has_level else with_column(point)

    def closure(self, scaled: np.ndarray) -> np.ndarray:
        """Return the corrected closure, shape (6,), scaled."""
        return self._at(scaled).closure - self._shift + self._tilt @ (scaled - self._anchor)

    def closure_jacobian(self, scaled: np.ndarray) -> np.ndarray:
        """Return its derivative, shape (6, n)."""
        return self._at(scaled).closure_jacobian + self._tilt

    def _rows(self, scaled: np.ndarray) -> np.ndarray:
        return self._at(scaled).rows - self._rows_shift + self._rows_tilt @ (scaled - self._anchor)

    def margins(self, scaled: np.ndarray) -> np.ndarray:
        """Return how far all that must not be passed is from it; negative where it is passed.

        First body pitch on the path above its lower and below its upper bound [rad], then the limits of the stroke,
        both as named by `path_limits`, then the constraints' rows in their scale, then the level above each peak
        that is to be lowered.
        """
        inside = self._at(scaled).inside - self._inside_shift
        if self.asked is None:
            return inside
        rows = self._rows(scaled)
        return np.concatenate([inside, self.asked.limits - rows[self._lowered :], self._peaks_below(scaled, rows)])

    def _peaks_below(self, scaled: np.ndarray, rows: np.ndarray) -> np.ndarray:
        return scaled[-1] - rows[: self._lowered] if self.has_level else np.zeros(0)

    def pitch_margins(self, pitch: np.ndarray) -> np.ndarray:
        """Return how far a path of body pitch stays inside its lower and upper bound [rad]."""
        return self._inside(self._peak(-pitch) @ pitch, self._peak(pitch) @ pitch)

    def _inside(self, lowest: Any, highest: Any) -> np.ndarray:
        return np.array([lowest - self.pitch_bounds[0], self.pitch_bounds[1] - highest])

    def margins_jacobian(self, scaled: np.ndarray) -> np.ndarray:
        """Return their derivative, shape (margins, n)."""
        point = self._at(scaled)
        if self.asked is None:
            return point.inside_jacobian
        rows = point.rows_jacobian + self._rows_tilt
        level = np.zeros_like(rows[: self._lowered if self.has_level else 0])
        if self.has_level:
            level[:, -1] = 1.0
            level -= rows[: self._lowered]
        return np.concatenate([point.inside_jacobian, -rows[self._lowered :], level])

    def conditions(self, scaled: np.ndarray, active: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return what must vanish, closure and those margins that are active, and the derivative."""
        values = np.concatenate([self.closure(scaled), self.margins(scaled)[active]])
        by_margins = self.margins_jacobian(scaled)[active]
        return values, np.concatenate([self.closure_jacobian(scaled), by_margins])

    def tilt_at(self, scaled: np.ndarray, blocks: int) -> None:
        """Take closure, rows, their derivatives and the path bound's value from a flight of more blocks here."""
        here, unknowns = self._at(scaled), self.physical(scaled)
        fine = self._scaled(self.fly(unknowns[4:], unknowns[:4], blocks), unknowns)
        self._tilt = fine.closure_jacobian - here.closure_jacobian
        self._anchor = scaled.copy()
        self._shift = here.closure - fine.closure
        self._inside_shift = here.inside - fine.inside
        self._rows_tilt = fine.rows_jacobian - here.rows_jacobian
        self._rows_shift = here.rows - fine.rows

    def shift_at(self, scaled: np.ndarray, certificate: Certificate) -> None:
        """Take the values of closure, path and rows that the certifier finds at this point."""
        unknowns = self.physical(scaled)
        miss = self.problem.closure(certificate.end, unknowns, self.problem.frequency(unknowns)) / CLOSURE_SCALE
        self._shift = self._shift + self.closure(scaled) - miss
        self._inside_shift[:2] = self._at(scaled).inside[:2] - self.pitch_margins(certificate.pitch)
        if self.asked is not None:
            self._rows_shift = (
                self._rows_shift + self._rows(scaled) - self.asked.read_certified(unknowns, certificate)
            )

    def certified_margins(self, scaled: np.ndarray, certificate: Certificate) -> np.ndarray:
        """Return the margins of body pitch and constraints that the certifier finds."""
        inside = np.append(self.pitch_margins(certificate.pitch), self._at(scaled).inside[2:])
        if self.asked is None:
            return inside
        rows = self.asked.read_certified(self.physical(scaled), certificate)
        return np.concatenate([inside, self.asked.limits - rows[self._lowered :]])

    def objective(self, scaled: np.ndarray) -> float:
        """Return the objective over its scale."""
        if self.has_level:
            return float(scaled[-1])
        if self._lowered:
            return float(self._rows(scaled)[0])
        minimise = self.problem.minimise
        assert isinstance(minimise, Frequency)
        return minimise.value(self.unknowns.names, self.physical(scaled)) / minimise.scale

    def objective_gradient(self, scaled: np.ndarray) -> np.ndarray:
        """Return its derivative, shape (n,)."""
        if self.has_level:
            return np.eye(1, scaled.size, scaled.size - 1)[0]
        if self._lowered:
            return self._at(scaled).rows_jacobian[0] + self._rows_tilt[0]
        minimise = self.problem.minimise
        assert isinstance(minimise, Frequency)
        gradient = minimise.gradient(self.unknowns.names, self.physical(scaled))
        return gradient * self.unknowns.scale / minimise.scale


def highest_sample(values: np.ndarray) -> np.ndarray:
    """Return the weights that give the highest of samples."""
    weights = np.zeros(len(values))
    weights[values.argmax()] = 1.0
    return weights


def with_column(point: Point) -> Point:
    """Return the point with one more unknown, which nothing that was flown hangs on."""
    wider = {
        name: np.pad(value, [(0, 0)] * (value.ndim - 1) + [(0, 1)])
        for name, value in point._asdict().items()
        if name.endswith("jacobian")
    }
    return point._replace(**wider)
