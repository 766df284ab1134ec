"""Problems made easier: one number, be it a bound, a limit, a mass or a speed, moves as little as it must."""

from __future__ import annotations

import numpy as np

from wingbeat.orbits.flight.shooting import Flown
from wingbeat.orbits.infeasible.relaxation import Change, is_limit, with_change
from wingbeat.orbits.nlp.local_search import is_closed, optimise
from wingbeat.orbits.nlp.transcription import Point, Transcription, with_column
from wingbeat.orbits.problem.problem import PATH_NAMES, OrbitProblem
from wingbeat.orbits.starts import start_point

# Step of the difference quotient by a number of the vehicle or the flight, as a share of the number's scale.
_STEP = 1e-6
# Problems with that number moved that are remembered: those of the last few places and of their quotients.
_KEPT = 8
# Iterations with the number moved far, and of moving it back.
_BRIEFLY = 40
_ITERATIONS = 60
# Times that it is moved back, each from where the last ended.
_TIMES = 3


class Eased(Transcription):
    """The problem with one number moved as little as can be: the last unknown is how far, over its scale."""

    def __init__(self, problem: OrbitProblem, change: Change) -> None:
        super().__init__(problem)
        self.change = change
        self.own = self.unknowns.lower.size
        self.lower = np.append(self.unknowns.lower / self.unknowns.scale, 0.0)
        self.upper = np.append(self.unknowns.upper / self.unknowns.scale, change.widest)
        self.has_level = False
        self._uncorrect()

    def start(self, unknowns: np.ndarray, share: float) -> np.ndarray:
        """Return a place to start from, in the optimiser's scale, within the bounds."""
        return np.clip(np.append(unknowns / self.unknowns.scale, share), self.lower, self.upper)

    def tightened(self, scaled: np.ndarray) -> np.ndarray:
        """Return the place with the number moved back as far as the same beat allows."""
        slope = self.margins_jacobian(scaled)[:, -1]
        spare = (self.margins(scaled)[slope > 0] / slope[slope > 0]).min()
        return np.append(scaled[:-1], np.clip(scaled[-1] - spare, 0.0, self.upper[-1]))

    def _scaled(self, flown: Flown, unknowns: np.ndarray) -> Point:
        return with_column(super()._scaled(flown, unknowns))

    def objective(self, scaled: np.ndarray) -> float:
        """Return how far the number is moved."""
        return float(scaled[-1])

    def objective_gradient(self, scaled: np.ndarray) -> np.ndarray:
        """Return its derivative."""
        return np.eye(1, scaled.size, scaled.size - 1)[0]


class _EasedBound(Eased):
    """With a bound of a free parameter moved: one margin more."""

    def __init__(self, problem: OrbitProblem, change: Change) -> None:
        super().__init__(with_change(problem, change.name, change.sign, change.reach), change)
        self._column = self.unknowns.names.index(change.name)
        self._scale = self.unknowns.scale[self._column]

    def margins(self, scaled: np.ndarray) -> np.ndarray:
        """Return the margins, and that of the parameter inside its bound moved."""
        bound = self.change.moved(scaled[-1]) / self._scale
        inside = self.change.direction * (bound - scaled[self._column])
        return np.append(super().margins(scaled), inside)

    def margins_jacobian(self, scaled: np.ndarray) -> np.ndarray:
        """Return their derivative."""
        row = np.zeros(scaled.size)
        row[self._column], row[-1] = -self.change.direction, self.change.scale / self._scale
        return np.vstack([super().margins_jacobian(scaled), row])


class _EasedLimit(Eased):
    """With a limit along the beat moved: of body pitch, of the flap angle, or a constraint."""

    def __init__(self, problem: OrbitProblem, change: Change) -> None:
        super().__init__(with_change(problem, change.name, change.sign, change.reach), change)
        rows = [i for i, limit in enumerate(self.path_limits) if limit == (change.name, change.sign)]
        unit = 1.0
        if not rows:
            constraints = list(problem.subject_to)
            place = next(i for i, c in enumerate(constraints) if is_limit(c, change.name, change.sign))
            assert self.asked is not None
            rows = [len(self.path_limits) + row for row in self.asked.rows_of(place)]
            unit = constraints[place].quantity.scale
        self._passed, self._unit = rows, change.scale / unit

    def margins(self, scaled: np.ndarray) -> np.ndarray:
        """Return the margins to the limit moved; without this they are those to where it may go at most."""
        margins = super().margins(scaled)
        margins[self._passed] += self._unit * (scaled[-1] - self.change.widest)
        return margins

    def margins_jacobian(self, scaled: np.ndarray) -> np.ndarray:
        """Return their derivative."""
        jacobian = super().margins_jacobian(scaled).copy()
        jacobian[self._passed, -1] += self._unit
        return jacobian


class _EasedNumber(Eased):
    """With a number of vehicle, flight or wingbeat moved; derivatives by it are difference quotients."""

    def tightened(self, scaled: np.ndarray) -> np.ndarray:
        """Return the place as it is: another number makes another beat."""
        return scaled

    def __init__(self, problem: OrbitProblem, change: Change) -> None:
        super().__init__(problem, change)
        self._moved: dict[float, Transcription] = {}

    def _with_number(self, share: float) -> Transcription:
        if share not in self._moved:
            if len(self._moved) == _KEPT:
                del self._moved[next(iter(self._moved))]
            value = self.change.moved(share)
            self._moved[share] = Transcription(with_change(self.problem, self.change.name, self.change.sign, value))
        return self._moved[share]

    def _at(self, scaled: np.ndarray) -> Point:
        share, unknowns = float(scaled[-1]), scaled[: self.own]
        step = _STEP if share + _STEP <= self.upper[-1] else -_STEP
        here, beside = (self._with_number(s)._at(unknowns) for s in (share, share + step))
        point = with_column(here)
        for name in ("closure", "inside", "rows"):
            jacobian = getattr(point, f"{name}_jacobian")
            jacobian[:, -1] = (getattr(beside, name) - getattr(here, name)) / step
        return point


def eased(problem: OrbitProblem, change: Change) -> Eased:
    """Return the programme in which one number of a problem is moved as little as can be."""
    if change.name in PATH_NAMES or any(is_limit(c, change.name, change.sign) for c in problem.subject_to):
        return _EasedLimit(problem, change)
    return _EasedNumber(problem, change) if change.sign == "=" else _EasedBound(problem, change)


def least_change(problem: OrbitProblem, change: Change, near: np.ndarray) -> tuple[float, np.ndarray] | None:
    """Return by how much of its scale a number must move for beats to close, and the unknowns of one that does.

    An orbit is looked for where the number has moved far; from there it is moved back until it can no further.

    Parameters
    ----------
    problem : the problem as it is.
    change : the number and its way.
    near : unknowns of a beat that nearly closes.
    """
    for share in change.tries or (change.widest,):
        share = min(share, change.widest)
        easy = Transcription(with_change(problem, change.name, change.sign, change.moved(share)))
        for start in (start_point(easy.problem, 0, 0), near):
            met, _ = optimise(easy, easy.scaled(start), iterations=_BRIEFLY)
            if not is_closed(easy, met):
                continue
            programme = eased(problem, change)
            kept = programme.tightened(programme.start(easy.physical(met), share))
            for _ in range(_TIMES):
                scaled, _ = optimise(programme, kept, iterations=_ITERATIONS)
                if not is_closed(programme, scaled) or scaled[-1] >= kept[-1]:
                    break
                kept = scaled
            return float(kept[-1]), programme.physical(kept)
    return None
