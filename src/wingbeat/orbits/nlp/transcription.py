"""The orbit problem as a small nonlinear programme, by single shooting with few steps, and a local search of it."""

from __future__ import annotations

import copy
import dataclasses
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from wingbeat.animal.kinematics import Wingbeat
from wingbeat.mechanics.flights import Steps
from wingbeat.orbits.flight.beat import Beat, highest_sample, peak_weights
from wingbeat.orbits.flight.certificate import SAMPLES, Certificate, certify, map_and_changes, monodromy
from wingbeat.orbits.flight.lagged import InnerStart
from wingbeat.orbits.flight.period import CLOSURE_SCALE, Flown, StrokeLimits, flier, inner_start
from wingbeat.orbits.flight.time_series import beat_reader, flown_beat
from wingbeat.orbits.nlp.levenberg_marquardt import least_squares, multiplier_residual
from wingbeat.orbits.nlp.programme import Programme
from wingbeat.orbits.options import DEFAULTS, SolverOptions
from wingbeat.orbits.problem.outputs import Outputs, Read

if TYPE_CHECKING:
    from wingbeat.orbits.problem.problem import OrbitProblem, Unknowns

# Larger sums of a flight's numbers overflow when squared, or soon will.
_OVERFLOW = 1e12
# Number of cached flights: the flight of the current point, and those where a difference or a line search started.
_REMEMBERED = 4
# Bounds of the epigraph variable, in the objective's scale.
_UNBOUNDED = 1e6
_PITCH_LIMITS = (("body_pitch", ">="), ("body_pitch", "<="))


class Point(NamedTuple):
    """Values and derivatives at one point, scaled, or corrections of them; `path` has pitch, then the stroke."""

    closure: np.ndarray
    closure_jacobian: np.ndarray
    path: np.ndarray
    path_jacobian: np.ndarray
    outputs: np.ndarray
    outputs_jacobian: np.ndarray


class _Flight(NamedTuple):
    """A flight, and its point; `read` says whether the point has the outputs, which take longer than the flight."""

    unknowns: np.ndarray
    flown: Flown
    point: Point
    read: bool


class Transcription(Programme):
    """Closure, inequalities and objective of a problem as functions of scaled unknowns; flights are cached.

    If the objective is the largest value of a series, the last unknown is the epigraph variable: an upper limit of
    the series' peaks. A flight has `blocks` times `STEPS` steps. `unknowns` replaces the problem's own, for a point
    just outside the bounds; `path_limits` has name and sign of each limit along the path.
    """

    def __init__(
        self,
        problem: OrbitProblem,
        options: SolverOptions = DEFAULTS,
        blocks: int = 1,
        unknowns: Unknowns | None = None,
    ) -> None:
        self.problem, self.options, self.model, self._blocks = problem, options, problem.model, blocks
        self.unknowns: Unknowns = unknowns or problem.unknowns()
        limited = problem.shapes_stroke and not problem.wings_may_cross
        clearance, stock, free = options.search.plane_clearance, problem.species.wingbeat, problem.free
        low, high = problem.bounds["flap"]
        self._stroke = StrokeLimits(problem.vehicle, low, high, clearance, len(free), limited=limited)
        stroke = bool(self._stroke.names)
        self.fly = flier(self.model, stock, free, whole_path=problem.has_outputs, stroke=stroke, lag=options.wake)
        self._has_inner = inner_start(self.model, stock).size > 0
        self.outputs = None
        if problem.has_outputs:
            objective = [] if problem.minimise.parameter else [problem.minimise]
            shapes = problem.aero.strips, problem.vehicle.drive, problem.map_states
            self.outputs = Outputs(objective, problem.subject_to, *shapes)
            velocity = problem.speed, problem.climb
            self._reader = beat_reader(self.model, stock, free, velocity, self.outputs.fields)
        # Number of outputs that belong to the objective.
        self._minimised = 0 if self.outputs is None else self.outputs.of_objective
        self.has_epigraph = self._minimised > 1
        self._scale = scale = np.append(self.unknowns.scale, [1.0] * self.has_epigraph)
        self.lower = np.append(self.unknowns.lower, [-_UNBOUNDED] * self.has_epigraph) / scale
        self.upper = np.append(self.unknowns.upper, [_UNBOUNDED] * self.has_epigraph) / scale
        self.pitch_bounds = np.array(problem.bounds["body_pitch"])
        # With the smooth peak, starts for least frequency diverge: they found 11 of a study's 14 orbits with it,
        # all 14 without it. Optima of outputs lie between two samples and need the smooth peak.
        self._peak = highest_sample if self.outputs is None else peak_weights
        self.path_limits = (*_PITCH_LIMITS, *self._stroke.names)
        self._limits_outputs = self.has_epigraph or bool(problem.subject_to)
        self._flights: dict[bytes, _Flight] = {}
        self._anchor, self._correction = self._no_correction
        # Times of the certifier for this programme and those corrected from it [s].
        self.certifying: list[float] = []

    @property
    def _no_correction(self) -> tuple[np.ndarray, Point]:
        n, outputs, path = self.lower.size, 0 if self.outputs is None else self.outputs.count, len(self.path_limits)
        slopes = [np.zeros((count, n)) for count in (6, path, outputs)]
        return np.zeros(n), Point(np.zeros(6), slopes[0], np.zeros(path), slopes[1], np.zeros(outputs), slopes[2])

    def uncorrected(self) -> Transcription:
        """Return a copy without the correction, for a parallel local search; the copy keeps the cached flights."""
        other = self._corrected(*self._no_correction)
        other._flights, other.certifying = dict(self._flights), []
        other.fly = copy.copy(self.fly)  # with inner states it remembers its last flight
        other.steps = None if self.steps is None else []
        return other

    def _corrected(self, anchor: np.ndarray, by: Point) -> Transcription:
        other = copy.copy(self)
        other._anchor, other._correction = anchor, by
        return other

    @property
    def iteration_factor(self) -> int:
        """How many times the usual number of iterations a local search may take."""
        search = self.options.search
        return search.many_times if len(self.problem.free) >= search.many_free else 1

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

    def point(self, scaled: np.ndarray, read: bool = True) -> Point:
        """Return values and derivatives of the flight from one point; without `read`, outputs may be missing."""
        return self._flight(scaled, read).point

    def flown(self, scaled: np.ndarray) -> Flown:
        """Return the flight from one point, whose derivatives are by the unknowns in SI."""
        return self._flight(scaled, read=False).flown

    def _flight(self, scaled: np.ndarray, read: bool) -> _Flight:
        key = scaled[: self.unknowns.lower.size].tobytes()
        if key not in self._flights:
            if len(self._flights) == _REMEMBERED:
                del self._flights[next(iter(self._flights))]
            self._flights[key] = self._fly(self.physical(scaled), self._blocks, read)
        flight = self._flights[key]
        if read and not flight.read:
            with np.errstate(over="ignore", invalid="ignore"):
                point = self._cut(flight.flown, flight.unknowns, self._blocks, read)
            flight = self._flights[key] = flight._replace(point=point, read=True)
        return flight

    def inner_start(self, scaled: np.ndarray) -> InnerStart | None:
        """Return the inner states at the start of a flight from one point; None without any, or if it diverges."""
        return self.flown(scaled).inner if self._has_inner else None

    def is_closed(self, scaled: np.ndarray, tolerance: float) -> bool:
        """Return whether inner states repeat, and closure and inequalities hold, to a tolerance in SI units."""
        inner = self.inner_start(scaled)
        repeats = not self._has_inner or (inner is not None and inner.repeats)
        return repeats and super().is_closed(scaled, tolerance)

    def certificate(self, scaled: np.ndarray, wingbeat: Wingbeat, *, rough: bool = False) -> Certificate:
        """Return the certifier's flight of a wingbeat from one point."""
        options, start, near = self.options.certificate, self.physical(scaled)[:4], self.inner_start(scaled)
        rtol, lag = options.rough_rtol if rough else options.rtol, self.options.wake
        return certify(self.model, wingbeat, start, rtol, rough=rough, near=near, lag=lag)

    def _fly(self, unknowns: np.ndarray, blocks: int, read: bool = True) -> _Flight:
        # A diverging flight may overflow here; `_cut` limits its numbers.
        with np.errstate(over="ignore", invalid="ignore"):
            flown = self.fly(unknowns[4:], unknowns[:4], blocks)
            return _Flight(unknowns, flown, self._cut(flown, unknowns, blocks, read), read)

    def _cut(self, flown: Flown, unknowns: np.ndarray, blocks: int, read: bool) -> Point:
        problem, scale = self.problem, self.unknowns.scale
        frequency = problem.frequency(unknowns)
        closure = problem.closure(flown.end, unknowns, frequency) / CLOSURE_SCALE
        jacobian = problem.closure_jacobian(flown.end_jacobian, frequency) * scale / CLOSURE_SCALE[:, None]
        pitch, pitch_jacobian = flown.path[:, 0], flown.path_jacobian[:, 0] * scale
        tame = abs(closure.sum()) + abs(jacobian.sum()) + abs(pitch.sum()) + abs(pitch_jacobian.sum()) < _OVERFLOW
        outputs, outputs_jacobian = np.zeros(0), np.zeros((0, scale.size))
        if self.outputs is not None and read:
            count = self.outputs.count
            undefined = np.full(count, np.nan), np.zeros((count, scale.size))
            outputs, outputs_jacobian = self._read(self.outputs, unknowns, flown, blocks) if tame else undefined
            tame = tame and abs(outputs.sum()) + abs(outputs_jacobian.sum()) < _OVERFLOW
            outputs_jacobian = outputs_jacobian * scale
        if not tame:
            # The line search needs finite numbers to back away from a diverging flight.
            flight = closure, jacobian, pitch, pitch_jacobian, outputs, outputs_jacobian
            most = self.options.search.largest_residual
            cut = (np.clip(np.nan_to_num(a, nan=most), -most, most) for a in flight)
            closure, jacobian, pitch, pitch_jacobian, outputs, outputs_jacobian = cut
        lowest, highest = self._peak(-pitch), self._peak(pitch)
        stroke, stroke_jacobian = self._stroke.margins(flown)
        path = np.append([lowest @ pitch - self.pitch_bounds[0], self.pitch_bounds[1] - highest @ pitch], stroke)
        path_jacobian = np.zeros((len(path), scale.size))
        path_jacobian[:2] = lowest @ pitch_jacobian, -highest @ pitch_jacobian
        path_jacobian[2:, 4:] = stroke_jacobian * scale[4:]
        point = Point(closure, jacobian, path, path_jacobian, outputs, outputs_jacobian)
        if not self.has_epigraph:
            return point
        # The flight does not depend on the epigraph variable.
        jacobians = {name: np.pad(a, [(0, 0), (0, 1)]) for name, a in point._asdict().items() if "jacobian" in name}
        return point._replace(**jacobians)

    def _read(
        self, asked: Outputs, unknowns: np.ndarray, flown: Flown, blocks: int
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return the outputs of a flight of `blocks` blocks, and their derivatives by the unknowns."""
        values, start, nothing = unknowns[4:], unknowns[:4], (None, None)
        beat = self._reader(values, flown) if asked.of_beat else nothing
        stroke_map = map_and_changes(self.fly, values, start, blocks, flown) if asked.of_map else nothing
        return asked.linearised(Read(beat[0], stroke_map[0]), Read(beat[1], stroke_map[1]))

    def _certified(
        self, asked: Outputs, unknowns: np.ndarray, flown: Certificate, exact: bool = False
    ) -> np.ndarray:
        """Return the outputs of a certified flight; for `exact`, see `Outputs.values`."""
        wingbeat = self.problem.wingbeat(unknowns)
        beat = certified_beat(self.problem, wingbeat, flown) if asked.of_beat else None
        stroke_map = monodromy(self.model, wingbeat, flown.steps) if asked.of_map else None
        return asked.values(Read(beat, stroke_map), exact=exact)

    def closure(self, scaled: np.ndarray) -> np.ndarray:
        """Return the corrected closure, shape (6,), scaled."""
        by = self._correction
        return self.point(scaled, read=False).closure - by.closure + by.closure_jacobian @ (scaled - self._anchor)

    def closure_jacobian(self, scaled: np.ndarray) -> np.ndarray:
        """Return the derivative of the corrected closure, shape (6, n)."""
        return self.point(scaled, read=False).closure_jacobian + self._correction.closure_jacobian

    def _outputs(self, scaled: np.ndarray) -> np.ndarray:
        by = self._correction
        return self.point(scaled).outputs - by.outputs + by.outputs_jacobian @ (scaled - self._anchor)

    def inequalities(self, scaled: np.ndarray) -> np.ndarray:
        """Return the margins of `path_limits`, of constraints, and of peaks below the epigraph variable."""
        path = self.point(scaled, self._limits_outputs).path - self._correction.path
        if self.outputs is None or not self._limits_outputs:
            return path
        outputs = self._outputs(scaled)
        constraints = self.outputs.limits - outputs[self._minimised :]
        below = scaled[-1] - outputs[: self._minimised] if self.has_epigraph else np.zeros(0)
        return np.concatenate([path, constraints, below])

    def pitch_margins(self, pitch: np.ndarray) -> np.ndarray:
        """Return the margins of a path of body pitch within its lower and upper bound [rad]."""
        low, high = self.pitch_bounds
        return np.array([self._peak(-pitch) @ pitch - low, high - self._peak(pitch) @ pitch])

    def inequalities_jacobian(self, scaled: np.ndarray) -> np.ndarray:
        """Return the derivative of the inequalities, shape (inequalities, n)."""
        point = self.point(scaled, self._limits_outputs)
        if self.outputs is None or not self._limits_outputs:
            return point.path_jacobian
        outputs = point.outputs_jacobian + self._correction.outputs_jacobian
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
        """Return the programme, corrected to a flight with more blocks. Theory: equation ``defect-correction``."""
        here, fine = self.point(scaled), self._fly(self.physical(scaled), blocks).point
        offsets = {n: getattr(here, n) - getattr(fine, n) for n in ("closure", "path", "outputs")}
        slopes = {n: getattr(fine, n) - getattr(here, n) for n in ("closure_jacobian", "outputs_jacobian")}
        return self._corrected(scaled.copy(), self._correction._replace(**offsets, **slopes))

    def matched_to(self, scaled: np.ndarray, certificate: Certificate) -> Transcription:
        """Return the programme, corrected to the certifier's values. Theory: equation ``defect-correction``."""
        unknowns, by = self.physical(scaled), self._correction
        residual = self.problem.closure(certificate.end, unknowns, self.problem.frequency(unknowns)) / CLOSURE_SCALE
        path, outputs = by.path.copy(), by.outputs
        path[:2] = self.point(scaled).path[:2] - self.pitch_margins(certificate.pitch)
        if self.outputs is not None:
            outputs = outputs + self._outputs(scaled) - self._certified(self.outputs, unknowns, certificate)
        closure = by.closure + self.closure(scaled) - residual
        return self._corrected(self._anchor, by._replace(closure=closure, path=path, outputs=outputs))

    def certified_inequalities(self, scaled: np.ndarray, certificate: Certificate) -> np.ndarray:
        """Return the margins of body pitch, the stroke and the constraints in the certified flight."""
        path = np.append(self.pitch_margins(certificate.pitch), self.point(scaled).path[2:])
        if self.outputs is None:
            return path
        outputs = self._certified(self.outputs, self.physical(scaled), certificate, exact=True)
        return np.concatenate([path, self.outputs.limits - outputs[self._minimised :]])

    def optimality(self, scaled: np.ndarray) -> float:
        """Return the largest residual of optimality, scaled. Theory: equation ``optimality-conditions``."""
        tolerance, unit = self.options.search.bound_tolerance, np.eye(scaled.size)
        reach = tolerance * (self.upper - self.lower)
        bounds = [unit[scaled - self.lower <= reach], -unit[self.upper - scaled <= reach]]
        active = self.inequalities_jacobian(scaled)[self.inequalities(scaled) <= tolerance]
        within = np.concatenate([*bounds, active])
        return multiplier_residual(self.objective_gradient(scaled), self.closure_jacobian(scaled), within)

    def is_optimal(self, scaled: np.ndarray) -> bool:
        """Return whether the optimality conditions hold."""
        return self.optimality(scaled) <= self.options.search.optimality_tolerance

    def objective(self, scaled: np.ndarray) -> float:
        """Return the objective over its scale."""
        if self.has_epigraph:
            return float(scaled[-1])
        if self._minimised:
            return float(self._outputs(scaled)[0])
        place = self.unknowns.names.index(self.problem.minimise.parameter)
        return float(self.physical(scaled)[place]) / self.problem.minimise.scale

    def objective_gradient(self, scaled: np.ndarray) -> np.ndarray:
        """Return the derivative of the objective over its scale, shape (n,)."""
        if self.has_epigraph:
            return np.eye(1, scaled.size, scaled.size - 1)[0]
        if self._minimised:
            return self.point(scaled).outputs_jacobian[0] + self._correction.outputs_jacobian[0]
        place = self.unknowns.names.index(self.problem.minimise.parameter)
        unit = np.eye(1, self.unknowns.scale.size, place)[0]
        return unit * self.unknowns.scale / self.problem.minimise.scale


def load_programs(programme: Transcription, start: np.ndarray, wingbeat: Wingbeat) -> None:
    """Load or compile the programs of a local search and of the certificate in parallel, once per process.

    `start` is one of the search, `wingbeat` one like the optimum.
    """
    with ThreadPoolExecutor(2) as pool:
        # The program of the search compiles the longest, so it goes first.
        searching = pool.submit(programme.closure_jacobian, programme.scaled(start))
        once = dataclasses.replace(programme.options.wake, certifying_flights=1)
        pool.submit(certify, programme.model, wingbeat, start[:4], lag=once).result()
        searching.result()


def load_record_programs(problem: OrbitProblem, wingbeat: Wingbeat) -> None:
    """Load or compile the programs of a record's time series and multipliers, for a wingbeat like the optimum."""
    model, size = problem.model, 4 + inner_start(problem.model, wingbeat).size
    flown_beat(model, wingbeat, np.zeros(SAMPLES + 1), np.zeros((SAMPLES + 1, size)), (0.0, 0.0))
    monodromy(model, wingbeat, Steps(np.linspace(0.0, 1.0, 3), np.zeros((3, 2 + size))))


def certified_beat(problem: OrbitProblem, wingbeat: Wingbeat, flown: Certificate) -> Beat:
    """Return the time series of a flight of the certifier, with the vehicle's muscles, motor and springs."""
    velocity = problem.speed, problem.climb
    beat = flown_beat(problem.model, wingbeat, flown.phase, flown.path, velocity)
    return beat._replace(drive=problem.vehicle.drive)


@dataclass(frozen=True)
class Candidate:
    """Where a local search ended [optimiser's scale], the objective there in its unit, and what holds there."""

    programme: Transcription
    scaled: np.ndarray
    objective: float
    closed: bool
    optimal: bool
    violation: float

    @property
    def is_optimum(self) -> bool:
        """Whether the candidate is closed and optimal, by the solver's coarse flight."""
        return self.closed and self.optimal


def search(programme: Transcription, start: np.ndarray, *, restore: bool = False) -> Candidate:
    """Search with SLSQP, from where closure is restored with `restore`; if it stalls, do so once more."""
    # Most stalls come from a poor BFGS matrix, or from a start whose full Newton steps leave the region where the
    # quadratic model is valid.
    options = programme.options.search
    scaled = programme.scaled(start)
    closed = optimal = False
    for near in (restore, True):
        if near:
            scaled = restore_feasibility(programme, scaled)
            if programme.violation(scaled) > options.restored_closure:
                break
        most = options.iterations * programme.iteration_factor
        scaled, optimal = programme.optimise(scaled, most, options.tolerance, options)
        closed = programme.is_closed(scaled, options.closure_tolerance)
        # SLSQP also stops where rounding prevents progress; what counts is whether the conditions hold there.
        optimal = optimal or (closed and programme.is_optimal(scaled))
        if closed and optimal:
            break
    return _candidate(programme, scaled, closed, optimal)


def refine(programme: Transcription, start: np.ndarray, iterations: int | None = None) -> Candidate:
    """Run one short local search from unknowns that are assumed to be near an orbit."""
    options = programme.options.search
    most = options.local_iterations * programme.iteration_factor if iterations is None else iterations
    return as_candidate(programme, *programme.optimise(programme.scaled(start), most, options.tolerance, options))


def as_candidate(programme: Transcription, scaled: np.ndarray, optimal: bool = False) -> Candidate:
    """Return unknowns as a candidate; `optimal` says whether the search that led to them converged."""
    closed = programme.is_closed(scaled, programme.options.search.closure_tolerance)
    return _candidate(programme, scaled, closed, optimal or (closed and programme.is_optimal(scaled)))


def _candidate(programme: Transcription, scaled: np.ndarray, closed: bool, optimal: bool) -> Candidate:
    objective = programme.objective(scaled) * programme.problem.minimise.scale
    return Candidate(programme, scaled, objective, closed, optimal, programme.violation(scaled))


def restore_feasibility(programme: Transcription, scaled: np.ndarray) -> np.ndarray:
    """Reduce the violation of closure and inequalities in least squares within the bounds (an elastic solve)."""

    def residuals(x: np.ndarray) -> np.ndarray:
        return np.concatenate([programme.closure(x), np.minimum(programme.inequalities(x), 0.0)])

    def jacobian(x: np.ndarray) -> np.ndarray:
        exceeded = programme.inequalities(x)[:, None] < 0
        return np.concatenate([programme.closure_jacobian(x), exceeded * programme.inequalities_jacobian(x)])

    options = programme.options.search.restoration
    limits, note = (programme.lower, programme.upper), programme.noting("restoration")
    return least_squares(residuals, jacobian, scaled, *limits, options, note)
