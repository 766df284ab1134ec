"""Relaxed problems: one number, such as a bound, a limit, a mass or a speed, moves as little as possible."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from wingbeat._base import InvalidInputError
from wingbeat.orbits.infeasible.relaxation import Change, is_limit, with_change
from wingbeat.orbits.nlp.local_search import is_closed, optimise
from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.orbits.options.solver import SolverOptions
from wingbeat.orbits.problem.problem import PATH_NAMES, OrbitProblem
from wingbeat.orbits.starts import start_point

# Number of cached problems: those of the last few points and of their difference quotients.
_REMEMBERED = 8


class RelaxedProgramme:
    """A programme that minimises the change of one number; the change divided by its scale is one more unknown.

    Parameters
    ----------
    programme : the problem's programme, with the number either at its reach or unchanged.
    change : the number, and which way it moves.
    """

    def __init__(self, programme: Transcription, change: Change) -> None:
        self.change = change
        self._programme = programme
        self.lower = np.append(programme.lower, 0.0)
        self.upper = np.append(programme.upper, change.widest)

    def start(self, unknowns: np.ndarray, share: float) -> np.ndarray:
        """Return a start: a beat that closes, and the number moved back as far as this beat allows."""
        scaled = np.clip(np.append(unknowns / self._programme.unknowns.scale, share), self.lower, self.upper)
        slope = self.inequalities_jacobian(scaled)[:, -1]
        spare = (self.inequalities(scaled)[slope > 0] / slope[slope > 0]).min()
        return np.append(scaled[:-1], np.clip(scaled[-1] - spare, 0.0, self.upper[-1]))

    def physical(self, scaled: np.ndarray) -> np.ndarray:
        """Return the problem's own unknowns in SI."""
        return self._programme.physical(scaled[:-1])

    def _at(self, scaled: np.ndarray) -> Transcription:
        """Return the problem's own programme at this point."""
        return self._programme

    def closure(self, scaled: np.ndarray) -> np.ndarray:
        """Return the closure, shape (6,), scaled."""
        return self._at(scaled).closure(scaled[:-1])

    def closure_jacobian(self, scaled: np.ndarray) -> np.ndarray:
        """Return the derivative of the closure, shape (6, n)."""
        return _with_zeros(self._programme.closure_jacobian(scaled[:-1]))

    def inequalities(self, scaled: np.ndarray) -> np.ndarray:
        """Return the margin of everything that has a limit."""
        return self._at(scaled).inequalities(scaled[:-1])

    def inequalities_jacobian(self, scaled: np.ndarray) -> np.ndarray:
        """Return the derivative of the inequalities, shape (inequalities, n)."""
        return _with_zeros(self._programme.inequalities_jacobian(scaled[:-1]))

    def objective(self, scaled: np.ndarray) -> float:
        """Return how far the number is moved."""
        return float(scaled[-1])

    def objective_gradient(self, scaled: np.ndarray) -> np.ndarray:
        """Return the derivative of the objective, shape (n,)."""
        return np.eye(1, scaled.size, scaled.size - 1)[0]


def _with_zeros(jacobian: np.ndarray) -> np.ndarray:
    return np.pad(jacobian, [(0, 0), (0, 1)])


class _RelaxedBound(RelaxedProgramme):
    """The programme in which a bound of a free parameter moves; it has one more inequality."""

    def __init__(self, problem: OrbitProblem, change: Change, options: SolverOptions) -> None:
        programme = Transcription(with_change(problem, change.name, change.sign, change.reach), options)
        super().__init__(programme, change)
        self._column = programme.unknowns.names.index(change.name)
        self._scale = programme.unknowns.scale[self._column]

    def inequalities(self, scaled: np.ndarray) -> np.ndarray:
        """Return the inequalities, then the parameter's margin within its moved bound."""
        bound = self.change.moved(scaled[-1]) / self._scale
        inside = self.change.direction * (bound - scaled[self._column])
        return np.append(super().inequalities(scaled), inside)

    def inequalities_jacobian(self, scaled: np.ndarray) -> np.ndarray:
        """Return the derivative of the inequalities, shape (inequalities, n)."""
        row = np.zeros(scaled.size)
        row[self._column], row[-1] = -self.change.direction, self.change.scale / self._scale
        return np.vstack([super().inequalities_jacobian(scaled), row])


class _RelaxedLimit(RelaxedProgramme):
    """The programme in which a limit along the beat moves: that of body pitch, flap angle, or a constraint."""

    def __init__(self, problem: OrbitProblem, change: Change, options: SolverOptions) -> None:
        programme = Transcription(with_change(problem, change.name, change.sign, change.reach), options)
        super().__init__(programme, change)
        path = programme.path_limits
        rows, unit = [i for i, limit in enumerate(path) if limit == (change.name, change.sign)], 1.0
        if not rows:
            constraints = list(problem.subject_to)
            index = next(i for i, c in enumerate(constraints) if is_limit(c, change.name, change.sign))
            assert programme.outputs is not None
            rows = [len(path) + row for row in programme.outputs.values_of(index)]
            unit = constraints[index].quantity.scale
        self._moved, self._unit = rows, change.scale / unit

    def inequalities(self, scaled: np.ndarray) -> np.ndarray:
        """Return the inequalities with the limit moved; the wrapped programme has the limit at its reach."""
        inside = super().inequalities(scaled)
        inside[self._moved] += self._unit * (scaled[-1] - self.change.widest)
        return inside

    def inequalities_jacobian(self, scaled: np.ndarray) -> np.ndarray:
        """Return the derivative of the inequalities, shape (inequalities, n)."""
        jacobian = super().inequalities_jacobian(scaled)
        jacobian[self._moved, -1] += self._unit
        return jacobian


class _RelaxedNumber(RelaxedProgramme):
    """The programme in which a number of vehicle, flight or wingbeat moves; derivatives by it are differences."""

    def __init__(self, problem: OrbitProblem, change: Change, options: SolverOptions) -> None:
        super().__init__(Transcription(problem, options), change)
        self._options = options
        self._moved: dict[float, Transcription] = {}

    def start(self, unknowns: np.ndarray, share: float) -> np.ndarray:
        """Return a start: the beat and the number unchanged, because the beat closes with this number only."""
        return np.clip(np.append(unknowns / self._programme.unknowns.scale, share), self.lower, self.upper)

    def _at(self, scaled: np.ndarray) -> Transcription:
        share = float(scaled[-1])
        if share not in self._moved:
            if len(self._moved) == _REMEMBERED:
                del self._moved[next(iter(self._moved))]
            problem, change = self._programme.problem, self.change
            moved = with_change(problem, change.name, change.sign, change.moved(share))
            self._moved[share] = Transcription(moved, self._options)
        return self._moved[share]

    def closure_jacobian(self, scaled: np.ndarray) -> np.ndarray:
        """Return the derivative of the closure."""
        return np.column_stack([self._at(scaled).closure_jacobian(scaled[:-1]), self._slope(self.closure, scaled)])

    def inequalities_jacobian(self, scaled: np.ndarray) -> np.ndarray:
        """Return the derivative of the inequalities."""
        by_own = self._at(scaled).inequalities_jacobian(scaled[:-1])
        return np.column_stack([by_own, self._slope(self.inequalities, scaled)])

    def _slope(self, function: Callable[[np.ndarray], np.ndarray], scaled: np.ndarray) -> np.ndarray:
        """Return the derivative of a function by the number."""
        step = self._options.diagnosis.difference_step
        step = step if scaled[-1] + step <= self.upper[-1] else -step
        return (function(np.append(scaled[:-1], scaled[-1] + step)) - function(scaled)) / step


def relaxed(problem: OrbitProblem, change: Change, options: SolverOptions) -> RelaxedProgramme:
    """Return the programme that moves one number of a problem as little as possible."""
    if change.name in PATH_NAMES or any(is_limit(c, change.name, change.sign) for c in problem.subject_to):
        return _RelaxedLimit(problem, change, options)
    return (_RelaxedNumber if change.sign == "=" else _RelaxedBound)(problem, change, options)


def least_change(
    problem: OrbitProblem, change: Change, near: np.ndarray, options: SolverOptions
) -> tuple[float, np.ndarray] | None:
    """Return the least change with which a beat closes, and this beat; None if there is no such change.

    The change is divided by its scale. The search moves the number far, until a beat closes, and then back as far
    as possible.

    Parameters
    ----------
    problem : the problem as it is.
    change : the number, and which way it moves.
    near : unknowns of a beat that nearly closes.
    options : of the solvers.
    """
    usual, search = options.diagnosis, options.search
    for share in change.tries or (change.widest,):
        share = min(share, change.widest)
        try:
            changed = with_change(problem, change.name, change.sign, change.moved(share))
        except InvalidInputError:
            # For example, a descent into the wings' own wake is refused, but a faster descent is possible.
            continue
        easy = Transcription(changed, options)
        for start in (start_point(easy.problem, 0, 0, search), near):
            found, _ = optimise(easy, easy.scaled(start), usual.far_iterations, search.tolerance)
            if not is_closed(easy, found, search.closure_tolerance):
                continue
            programme = relaxed(problem, change, options)
            kept = programme.start(easy.physical(found), share)
            for _ in range(usual.back_times):
                scaled, _ = optimise(programme, kept, usual.back_iterations, search.tolerance)
                if not is_closed(programme, scaled, search.closure_tolerance) or scaled[-1] >= kept[-1]:
                    break
                kept = scaled
            return float(kept[-1]), programme.physical(kept)
    return None
