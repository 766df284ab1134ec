"""CasADi and IPOPT: direct collocation, speed and guess as parameters."""

from __future__ import annotations

from functools import partial

import casadi as cs
import numpy as np
from cases import Answer, Solve
from collocation import Collocation

import wingbeat as wb

IPOPT = {"print_level": 0, "sb": "yes", "max_iter": 500, "tol": 1e-8, "linear_solver": "mumps"}


def build(problem: wb.OrbitProblem, intervals: int, degree: int = 3, **options) -> Solve:
    """Return what solves problems of this vehicle and model at any speed, built once."""
    orbits = Collocation(problem, intervals, degree)
    nlp = {"x": orbits.unknowns, "p": orbits.velocity, "f": orbits.beat["frequency"] / 10, "g": orbits.vanishes}
    solver = cs.nlpsol("solver", "ipopt", nlp, {"print_time": False, "ipopt": IPOPT, **options})

    def solve(problem: wb.OrbitProblem, guess: np.ndarray) -> Answer:
        low, high = orbits.bounds(problem)
        found = solver(
            x0=orbits.guess(problem, guess),
            p=[problem.speed, problem.climb],
            lbx=low,
            ubx=high,
            lbg=0,
            ubg=0,
        )
        return Answer(orbits.answer(problem, found["x"]), solver.stats()["success"])

    return solve


VARIANTS = {
    "CasADi 20 x 3": partial(build, intervals=20),
    "CasADi 100 x 3": partial(build, intervals=100),
    "CasADi 300 x 3": partial(build, intervals=300),
}
