"""rockit: the same direct collocation as an optimal-control problem, discretised by rockit and solved by IPOPT."""

from __future__ import annotations

import contextlib
import io
from functools import partial

import casadi as cs
import numpy as np
import rockit
from by_casadi import IPOPT
from cases import Answer, Solve
from collocation import STATE_SCALE
from physics import Flier, accelerations, casadi_ops

import wingbeat as wb


def build(problem: wb.OrbitProblem, intervals: int, degree: int = 3) -> Solve:
    """Return what solves problems of this vehicle and model at any speed, built once."""
    flier, ops = Flier(problem, one_by_one=True), casadi_ops()
    symbols = cs.SX.sym("phase"), cs.SX.sym("state", 4), cs.SX.sym("free", len(problem.free))
    bent = accelerations(ops, flier, flier.beat(symbols[2]), symbols[0], *cs.vertsplit(symbols[1]))
    bend = cs.Function("bend", symbols, [cs.vertcat(*bent)])

    # Time is the phase, so the unknown period is a plain variable; mean velocities are integrals over the phase.
    ocp = rockit.Ocp(t0=0, T=1)
    psi, u, w, rate = state = [ocp.state(scale=scale) for scale in STATE_SCALE]
    unknowns = problem.unknowns()
    free = [ocp.variable(scale=scale) for scale in unknowns.scale[4:]]
    speed, climb, bounds = ocp.parameter(), ocp.parameter(), ocp.parameter(4, 2)
    frequency = free[problem.free.index("frequency")]
    bent = bend(ocp.t, cs.vertcat(*state), cs.vertcat(*free))
    ocp.set_der(psi, rate / frequency)
    for i, each in enumerate((u, w, rate)):
        ocp.set_der(each, bent[i] / frequency)

    low, high = problem.bounds["body_pitch"]
    ocp.subject_to(low <= (psi <= high), grid="integrator_roots")
    for i, (each, scale) in enumerate(zip(state, STATE_SCALE, strict=True)):
        ocp.subject_to(ocp.at_tf(each) == ocp.at_t0(each), scale=scale)
        ocp.subject_to(bounds[i, 0] <= (ocp.at_t0(each) <= bounds[i, 1]), scale=scale)
    for i, each in enumerate(free, start=4):
        ocp.subject_to(unknowns.lower[i] <= (each <= unknowns.upper[i]))
    ocp.subject_to(ocp.integral(u) == speed)
    ocp.subject_to(ocp.integral(w) == climb)
    ocp.add_objective(frequency / 10)
    ocp.solver("ipopt", {"expand": True, "print_time": False, "ipopt": IPOPT})
    ocp.method(rockit.DirectCollocation(N=intervals, degree=degree, scheme="radau"))

    def solve(problem: wb.OrbitProblem, guess: np.ndarray) -> Answer:
        unknowns = problem.unknowns()
        ocp.set_value(speed, problem.speed)
        ocp.set_value(climb, problem.climb)
        ocp.set_value(bounds, np.column_stack([unknowns.lower, unknowns.upper])[:4])
        ocp.set_initial(cs.vertcat(*state, *free), guess)  # in one call: each one sets every guess anew
        with contextlib.redirect_stdout(io.StringIO()):
            try:
                found, success = ocp.solve(), True
            except RuntimeError:  # rockit raises where IPOPT gives up
                found, success = ocp.non_converged_solution, False
        answer = [found.sample(each, grid="control")[1][0] for each in state] + [found.value(each) for each in free]
        return Answer(np.array(answer, dtype=float), success)

    return solve


VARIANTS = {"rockit 20 x 3": partial(build, intervals=20)}
