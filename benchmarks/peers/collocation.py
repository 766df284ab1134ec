"""Direct collocation at Radau points over one period in phase, in CasADi's symbols; the mean velocity a parameter.

The horizontal and vertical positions do not enter the rates, so they are quadratures at the same points.
"""

from __future__ import annotations

from typing import Any

import casadi as cs
import numpy as np
from physics import Flier, accelerations, casadi_ops

import wingbeat as wb

# One unit of each state and of each closure that matters: IPOPT sees numbers near one.
STATE_SCALE = np.array([0.2, 1.0, 1.0, 5.0])


class Collocation:
    """The periodic orbits of a problem: symbols, what must vanish, and bounds and guesses in the same order.

    All points are taken at once, as rows: short graphs, so their derivatives are quick to build and to evaluate.
    """

    def __init__(self, problem: wb.OrbitProblem, intervals: int, degree: int = 3) -> None:
        self.flier, self.ops = Flier(problem, one_by_one=True), casadi_ops()
        # Physical states at the starts of the intervals and at their Radau points, the last of which is the end.
        tau = cs.collocation_points(degree, "radau")
        at_points, _, weights = cs.collocation_coeff(tau)
        self.count = count = intervals * degree
        start, path = cs.MX.sym("start", 4), cs.MX.sym("path", 4, count)
        free, self.velocity = cs.MX.sym("free", len(problem.free)), cs.MX.sym("velocity", 2)
        self.states = path * cs.repmat(STATE_SCALE, 1, count)
        self.values = free * problem.unknowns().scale[4:]
        self.phases = (np.arange(intervals)[:, None] + np.array(tau)).ravel() / intervals
        self.beat = self.flier.beat(self.values)
        psi, u, w, rate = (self.states[i, :] for i in range(4))
        self.bent = accelerations(self.ops, self.flier, self.beat, cs.DM(self.phases).T, psi, u, w, rate)
        slope = cs.vertcat(rate, *self.bent) / self.beat["frequency"]

        # Node k * degree is where interval k starts; its rows of the table reach that node and the points inside.
        table = np.zeros((count + 1, count))
        for k in range(intervals):
            table[k * degree : (k + 1) * degree + 1, k * degree : (k + 1) * degree] = at_points
        first = start * STATE_SCALE
        defects = (cs.horzcat(first, self.states) @ cs.sparsify(cs.DM(table)) - slope / intervals) / STATE_SCALE
        self.weights = cs.repmat(weights, intervals, 1) / intervals
        travelled = self.states[1:3, :] @ self.weights
        closure = cs.vertcat((self.states[:, -1] - first) / STATE_SCALE, travelled - self.velocity)
        self.vanishes = cs.vertcat(cs.vec(defects), closure)
        self.unknowns = cs.vertcat(start, cs.vec(path), free)

    def bounds(self, problem: wb.OrbitProblem) -> tuple[np.ndarray, np.ndarray]:
        """Return the bounds of the unknowns."""
        unknowns, wide = problem.unknowns(), [np.inf] * 3
        low, high = (limit / unknowns.scale for limit in (unknowns.lower, unknowns.upper))
        pitch_low, pitch_high = np.array(problem.bounds["body_pitch"]) / STATE_SCALE[0]
        path_low = np.tile([pitch_low, *np.negative(wide)], self.count)
        path_high = np.tile([pitch_high, *wide], self.count)
        return np.concatenate([low[:4], path_low, low[4:]]), np.concatenate([high[:4], path_high, high[4:]])

    def guess(self, problem: wb.OrbitProblem, unknowns: np.ndarray, path: np.ndarray | None = None) -> np.ndarray:
        """Return where to start from: steady at the state the unknowns begin with, or on a `path` (points, 4)."""
        steady = np.tile(unknowns[:4], (self.count, 1)) if path is None else path
        whole = np.concatenate([unknowns[None, :4], steady]) / STATE_SCALE
        return np.concatenate([whole.ravel(), unknowns[4:] / problem.unknowns().scale[4:]])

    def answer(self, problem: wb.OrbitProblem, x: Any) -> np.ndarray:
        """Return wingbeat's unknowns: the state at phase 0, then the free parameters."""
        found = np.array(x).ravel()[: self.unknowns.numel()]
        free = found[-len(problem.free) :] * problem.unknowns().scale[4:]
        return np.concatenate([found[:4] * STATE_SCALE, free])
