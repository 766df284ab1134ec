"""Any objective and limits of wingbeat by CasADi and IPOPT, stated without kinks, as a competent user would.

A largest value is a level that no point passes; the positive part of a power is a series of its own that is at
least the power and at least nothing; the range of body pitch is the distance of two levels.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import casadi as cs
import numpy as np
from by_casadi import IPOPT as FOR_FREQUENCY
from collocation import Collocation
from hinge_work import hinge_work

import wingbeat as wb

INTERVALS = 40
# A guess that has not led to an optimum by then costs more than it is worth.
IPOPT = {**FOR_FREQUENCY, "max_iter": 250}


# The guess of a body's path: of the phases, shape (points, 4).
Path = Callable[[np.ndarray], np.ndarray]


class Found(NamedTuple):
    """Wingbeat's unknowns where IPOPT ended, its own value of the objective, and whether it calls it an optimum."""

    unknowns: np.ndarray
    objective: float
    success: bool


class Nlp:
    """Collects extra unknowns, each with what it starts from, and what must be at most nothing."""

    def __init__(self, problem: wb.OrbitProblem, orbits: Collocation) -> None:
        self.orbits = orbits
        state = tuple(orbits.states[i, :] for i in range(4))
        self.bent = orbits.bent
        self.work = hinge_work(orbits.ops, orbits.flier, orbits.beat, cs.DM(orbits.phases).T, state, self.bent)
        self.weight = problem.vehicle.mass * problem.air.gravity
        self.extra: list[Any] = []
        self.lowest: list[float] = []
        self.begin: list[Any] = []
        self.at_most: list[Any] = []

    def _more(self, begin: Any, scale: float, lowest: float = -np.inf) -> Any:
        symbol = cs.MX.sym(f"extra{len(self.extra)}", 1, begin.numel())
        self.extra.append(symbol.T)
        self.lowest += [lowest] * begin.numel()
        self.begin.append(begin.T / scale)
        return symbol * scale

    def level(self, series: Any, scale: float) -> Any:
        """Return what a series may not pass."""
        level = self._more(cs.mmax(series), scale)
        self.at_most.append((series - level).T / scale)
        return level

    def mean_positive(self, power: Any) -> Any:
        """Return the mean of the positive part."""
        part = self._more(cs.fmax(power, 0), 10.0, 0.0)
        self.at_most.append((power - part).T / 10.0)
        return part @ self.orbits.weights

    def root(self, mean: Any, scale: float) -> Any:
        """Return the root of a mean; taken of the mean itself it would fill the Hessian."""
        root = self._more(cs.sqrt(mean), scale, 0.0)
        self.at_most.append((mean - root * root) / scale**2)
        return root

    def size(self, torque: Any, scale: float) -> Any:
        """Return the largest size of a series."""
        return self.level(cs.horzcat(torque, -torque), scale)

    def measure(self, name: str) -> Any:
        """Return a quantity of wingbeat's by its name."""
        weights, pitch = self.orbits.weights, self.orbits.states[0, :]
        measures: dict[str, Callable[[], Any]] = {
            "frequency": lambda: self.orbits.beat["frequency"],
            "mean_power": lambda: self.work.hinge_power @ weights,
            "mean_positive_power": lambda: self.mean_positive(self.work.hinge_power),
            "peak_power": lambda: self.level(self.work.hinge_power, 10.0),
            "mean_actuator_power": lambda: self.work.actuator_power @ weights,
            "peak_actuator_power": lambda: self.level(self.work.actuator_power, 10.0),
            "cost_of_transport": lambda: (
                self.mean_positive(self.work.hinge_power) / (self.weight * self.orbits.velocity[0])
            ),
            "peak_flap_torque": lambda: self.size(self.work.flap_torque, 0.1),
            "peak_pitch_torque": lambda: self.size(self.work.pitch_torque, 0.01),
            "body_pitch_range": lambda: self.level(pitch, 0.2) + self.level(-pitch, 0.2),
            "roughness": lambda: self.root((self.bent[0] ** 2 + self.bent[1] ** 2) @ weights, 5.0),
        }
        return measures[name]()


def build(
    problem: wb.OrbitProblem, intervals: int = INTERVALS
) -> Callable[[wb.OrbitProblem, np.ndarray, Path | None], Found]:
    """Return what solves problems with these measures at any speed and limits, from unknowns and perhaps a path."""
    orbits = Collocation(problem, intervals)
    nlp = Nlp(problem, orbits)
    scale = problem.minimise.scale
    objective = nlp.measure(problem.minimise.name)
    limits = cs.MX.sym("limits", len(problem.subject_to))
    for i, constraint in enumerate(problem.subject_to):
        assert constraint.at_most  # a mean of positive parts is one from above only
        nlp.at_most.append((nlp.measure(constraint.quantity.name) - limits[i]) / constraint.quantity.scale)
    parameters = cs.vertcat(orbits.velocity, limits)
    stated = {
        "x": cs.vertcat(orbits.unknowns, *nlp.extra),
        "p": parameters,
        "f": objective / scale,
        "g": cs.vertcat(orbits.vanishes, *nlp.at_most),
    }
    solver = cs.nlpsol("solver", "ipopt", stated, {"print_time": False, "ipopt": IPOPT})
    begin = cs.Function("begin", [orbits.unknowns, parameters], [cs.vertcat(*nlp.begin, 0)[:-1]])
    rows = stated["g"].numel()
    lowest = np.zeros(rows)
    lowest[orbits.vanishes.numel() :] = -np.inf

    def solve(problem: wb.OrbitProblem, unknowns: np.ndarray, path: Path | None = None) -> Found:
        low, high = orbits.bounds(problem)
        given = [problem.speed, problem.climb, *(c.limit for c in problem.subject_to)]
        first = orbits.guess(problem, unknowns, None if path is None else path(orbits.phases))
        more = np.array(begin(first, given)).ravel()
        found = solver(
            x0=np.concatenate([first, more]),
            p=given,
            lbx=np.concatenate([low, nlp.lowest]),
            ubx=np.concatenate([high, np.full(more.size, np.inf)]),
            lbg=lowest,
            ubg=np.zeros(rows),
        )
        return Found(orbits.answer(problem, found["x"]), float(found["f"]) * scale, solver.stats()["success"])

    return solve
