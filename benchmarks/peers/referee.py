"""The referee: every optimum is flown again by SciPy's DOP853 with wingbeat's equations, whoever found it."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
from cases import Case, first_start
from hinge_work import HingeWork, hinge_work
from physics import NUMPY, Flier, accelerations
from scipy.integrate import solve_ivp

import wingbeat as wb
from wingbeat._jax.arrays import jax
from wingbeat.mechanics.flights import state_rates
from wingbeat.orbits.flight.time_series import flown_beat

_rates = jax.jit(state_rates)
OURS = "u_rate", "w_rate", "pitch_acceleration", *HingeWork._fields
SCALARS = SimpleNamespace(**vars(NUMPY) | {"total": lambda strip: strip})


def refly(problem: wb.OrbitProblem, unknowns: np.ndarray) -> tuple[float, float]:
    """Return the largest closure miss (m, m, rad, m/s, m/s, rad/s) and how far body pitch is out of bounds."""
    if not np.isfinite(unknowns).all():
        return np.inf, np.inf
    beat, model = problem.wingbeat(unknowns), problem.model
    start = np.concatenate([[0.0, 0.0], unknowns[:4]])
    flown = solve_ivp(
        lambda phase, y: np.asarray(_rates(model, beat, phase, y)) / beat.frequency,
        (0.0, 1.0),
        start,
        method="DOP853",
        rtol=1e-10,
        atol=1e-12,
        t_eval=np.linspace(0.0, 1.0, 257),
    )
    if flown.status != 0:
        return np.inf, np.inf
    low, high = problem.bounds["body_pitch"]
    pitch = flown.y[2]
    miss = problem.closure(flown.y[:, -1], unknowns, beat.frequency)
    return float(np.abs(miss).max()), float(max(low - pitch.min(), pitch.max() - high, 0.0))


def model_gap(case: Case, points: int = 50) -> float:
    """Return the largest relative gap of accelerations, torques and powers to wingbeat's at random states."""
    problem = case.problem()
    ways = (NUMPY, Flier(problem, one_by_one=False)), (SCALARS, Flier(problem, one_by_one=True))
    random = np.random.default_rng(0)
    unknowns = problem.unknowns()
    worst = 0.0
    for _ in range(points):
        values = random.uniform(unknowns.lower, unknowns.upper)
        values[4] = first_start(problem)[4]
        phase, (psi, u, w, q) = random.uniform(), values[:4]
        beat = problem.wingbeat(values)
        flown = flown_beat(problem.model, beat, np.array([phase]), values[None, :4], (problem.speed, problem.climb))
        ours = np.array([getattr(flown, name)[0] for name in OURS])
        for ops, flier in ways:
            bent = accelerations(ops, flier, vars(beat), phase, psi, u, w, q)
            work = hinge_work(ops, flier, vars(beat), phase, (psi, u, w, q), bent)
            theirs = np.array([*bent, *work])
            worst = max(worst, float(np.abs((theirs - ours) / (1 + np.abs(ours))).max()))
    return worst
