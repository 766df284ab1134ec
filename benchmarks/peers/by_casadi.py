"""CasADi and IPOPT: direct collocation at Radau points over one period in phase, speed and guess as parameters.

The horizontal and vertical positions do not enter the rates, so they are quadratures at the same points.
"""

from __future__ import annotations

from functools import partial

import casadi as cs
import numpy as np
from cases import Answer, Solve
from physics import Flier, accelerations, casadi_ops

import wingbeat as wb

# One unit of each state and of each closure that matters: IPOPT sees numbers near one.
STATE_SCALE = np.array([0.2, 1.0, 1.0, 5.0])
IPOPT = {"print_level": 0, "sb": "yes", "max_iter": 500, "tol": 1e-8, "linear_solver": "mumps"}


def build(problem: wb.OrbitProblem, intervals: int, degree: int = 3, **options) -> Solve:
    """Return what solves problems of this vehicle and model at any speed, built once."""
    flier, ops = Flier(problem, one_by_one=True), casadi_ops()
    # Physical states at the starts of the intervals and at their Radau points, the last of which is the end.
    tau = cs.collocation_points(degree, "radau")
    at_points, _, weights = cs.collocation_coeff(tau)
    count = intervals * degree
    start, path = cs.MX.sym("start", 4), cs.MX.sym("path", 4, count)
    free, velocity = cs.MX.sym("free", len(problem.free)), cs.MX.sym("velocity", 2)
    scale = problem.unknowns().scale
    states = path * cs.repmat(STATE_SCALE, 1, count)
    values = free * scale[4:]
    first = start * STATE_SCALE
    phases = (np.arange(intervals)[:, None] + np.array(tau)).ravel() / intervals
    # All points at once, as rows: short graphs, so their derivatives are quick to build and to evaluate.
    beat = flier.beat(values)
    psi, u, w, rate = (states[i, :] for i in range(4))
    ax, az, spin = accelerations(ops, flier, beat, cs.DM(phases).T, psi, u, w, rate)
    slope = cs.vertcat(rate, ax, az, spin) / beat["frequency"]

    # Node k * degree is where interval k starts; its rows of the table reach that node and the points inside.
    table = np.zeros((count + 1, count))
    for k in range(intervals):
        table[k * degree : (k + 1) * degree + 1, k * degree : (k + 1) * degree] = at_points
    defects = (cs.horzcat(first, states) @ cs.sparsify(cs.DM(table)) - slope / intervals) / STATE_SCALE
    travelled = states[1:3, :] @ cs.repmat(weights, intervals, 1) / intervals
    left = states[:, -1]
    closure = cs.vertcat((left - first) / STATE_SCALE, travelled - velocity)
    constraints = cs.vertcat(cs.vec(defects), closure)
    nlp = {
        "x": cs.vertcat(start, cs.vec(path), free),
        "p": velocity,
        "f": values[problem.free.index("frequency")] / 10,
        "g": constraints,
    }
    solver = cs.nlpsol("solver", "ipopt", nlp, {"print_time": False, "ipopt": IPOPT, **options})

    def solve(problem: wb.OrbitProblem, guess: np.ndarray) -> Answer:
        unknowns = problem.unknowns()
        low, high = (limit / unknowns.scale for limit in (unknowns.lower, unknowns.upper))
        (pitch_low, pitch_high), wide = np.array(problem.bounds["body_pitch"]) / STATE_SCALE[0], [np.inf] * 3
        path_low, path_high = np.tile([pitch_low, *np.negative(wide)], count), np.tile([pitch_high, *wide], count)
        steady = np.tile(guess[:4] / STATE_SCALE, count + 1)
        found = solver(
            x0=np.concatenate([steady, guess[4:] / unknowns.scale[4:]]),
            p=[problem.speed, problem.climb],
            lbx=np.concatenate([low[:4], path_low, low[4:]]),
            ubx=np.concatenate([high[:4], path_high, high[4:]]),
            lbg=0,
            ubg=0,
        )
        x = np.array(found["x"]).ravel()
        answer = np.concatenate([x[:4] * STATE_SCALE, x[-len(problem.free) :] * unknowns.scale[4:]])
        return Answer(answer, solver.stats()["success"])

    return solve


VARIANTS = {
    "CasADi 20 x 3": partial(build, intervals=20),
    "CasADi 100 x 3": partial(build, intervals=100),
    "CasADi 300 x 3": partial(build, intervals=300),
}
