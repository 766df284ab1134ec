"""AeroSandbox: states at nodes over one period, derivatives constrained by its cubic rule, solved by its Opti.

It joins nodes by quadrature rules over neighbouring nodes (trapezoidal to cubic) and has no collocation points
inside an interval, so accuracy is bought with nodes.
"""

from __future__ import annotations

from functools import partial
from types import SimpleNamespace

import aerosandbox as asb
import aerosandbox.numpy as anp
import casadi as cs
import numpy as np
from by_casadi import IPOPT
from cases import Answer, Solve
from collocation import STATE_SCALE
from physics import NUMPY, Flier, accelerations

import wingbeat as wb

OPS = SimpleNamespace(**{name: getattr(anp, name) for name in vars(NUMPY) if name != "total"}, total=lambda x: x)
OPTIONS = {f"ipopt.{name}": value for name, value in IPOPT.items()} | {"print_time": False}


def build(problem: wb.OrbitProblem, nodes: int, method: str) -> Solve:
    """Return what solves problems of this vehicle and model at any speed, stated once."""
    opti, flier, unknowns = asb.Opti(), Flier(problem, one_by_one=True), problem.unknowns()
    speed, climb = opti.parameter(problem.speed), opti.parameter(problem.climb)
    phase = np.linspace(0, 1, nodes)
    low, high = problem.bounds["body_pitch"]
    psi = opti.variable(init_guess=0, n_vars=nodes, scale=STATE_SCALE[0], lower_bound=low, upper_bound=high)
    u, w, rate = (opti.variable(init_guess=0, n_vars=nodes, scale=scale) for scale in STATE_SCALE[1:])
    free = [
        opti.variable(init_guess=0, scale=scale, lower_bound=lower, upper_bound=upper)
        for scale, lower, upper in zip(unknowns.scale[4:], unknowns.lower[4:], unknowns.upper[4:], strict=True)
    ]
    frequency = free[problem.free.index("frequency")]
    ax, az, spin = accelerations(OPS, flier, flier.beat(free), phase, psi, u, w, rate)
    states = (psi, u, w, rate)
    for state, slope, scale in zip(states, (rate, ax, az, spin), STATE_SCALE, strict=True):
        opti.constrain_derivative(slope / frequency / scale, state / scale, phase, method=method)
        opti.subject_to(state[-1] / scale == state[0] / scale)
    # A periodic integrand: the trapezoidal sum over one period is as good as any.
    opti.subject_to([anp.mean(u[:-1]) == speed, anp.mean(w[:-1]) == climb])
    start_low, start_high = opti.parameter(unknowns.lower[1:4]), opti.parameter(unknowns.upper[1:4])
    for i, state in enumerate((u, w, rate)):
        opti.subject_to([state[0] >= start_low[i], state[0] <= start_high[i]])
    opti.minimize(frequency / 10)
    solved: list[bool] = []

    def solve(problem: wb.OrbitProblem, guess: np.ndarray) -> Answer:
        limits = problem.unknowns()
        for symbol, value in zip((*states, *free), guess, strict=True):
            opti.set_initial(symbol, value)
        given = {speed: problem.speed, climb: problem.climb}
        given |= {start_low: limits.lower[1:4], start_high: limits.upper[1:4]}
        try:
            if solved:  # its own solve() would derive the whole problem anew; that of the Opti below it does not
                for symbol, value in given.items():
                    opti.set_value(symbol, value)
                found, success = cs.Opti.solve(opti), True
            else:
                solved.append(True)
                found, success = opti.solve(given, verbose=False, options=OPTIONS), True
        except RuntimeError:  # it raises where IPOPT gives up
            found, success = opti.debug, False
        first = [float(found.value(state)[0]) for state in states]
        answer = np.array(first + [float(found.value(each)) for each in free])
        return Answer(answer, success)

    return solve


VARIANTS = {
    "AeroSandbox 61 nodes": partial(build, nodes=61, method="cubic"),
    "AeroSandbox 201 nodes": partial(build, nodes=201, method="cubic"),
}
