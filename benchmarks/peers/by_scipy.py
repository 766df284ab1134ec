"""SciPy: single shooting, SLSQP over an adaptive flight of one period, forward differences.

The flight and its neighbours, one for each unknown, are flown side by side in one call of solve_ivp: they share
their steps, so their differences are smooth, and NumPy's overhead is paid once for all of them.
"""

from __future__ import annotations

from functools import partial
from types import SimpleNamespace

import numpy as np
from cases import Answer, Solve
from physics import NUMPY, Flier, accelerations
from scipy.integrate import solve_ivp
from scipy.optimize import least_squares, minimize

import wingbeat as wb

LANES = SimpleNamespace(**vars(NUMPY) | {"total": lambda strips: np.sum(strips, axis=-1, keepdims=True)})
CLOSURE_SCALE = np.array([0.1, 0.1, 0.1, 1.0, 1.0, 10.0])
PITCH_SCALE, SAMPLES = 0.1, 33
STEP = 1e-7  # of the differences, in scaled unknowns; shared steps leave them no noise but rounding
APPROACH = 10  # evaluations of least squares towards closure before each round of SLSQP
ROUNDS = 2
FAILED = 1e3  # stands for the miss of a flight that broke off


class Shooting:
    """Closure and path margins of one problem with their derivatives, in scaled unknowns."""

    def __init__(self, problem: wb.OrbitProblem, flier: Flier, rtol: float) -> None:
        self.problem, self.flier, self.rtol = problem, flier, rtol
        unknowns = problem.unknowns()
        self.scale, self.lower, self.upper = unknowns.scale, unknowns.lower, unknowns.upper
        self.known: tuple[bytes, np.ndarray, np.ndarray] | None = None

    def fly(self, lanes: np.ndarray) -> np.ndarray:
        """Fly one period from each row of unknowns; return states (6, lanes, samples)."""
        count, beat = len(lanes), self.flier.beat(lanes[:, 4:].T[..., None])

        def slope(phase: float, flat: np.ndarray) -> np.ndarray:
            _, _, psi, u, w, rate = flat.reshape(6, count, 1)
            bent = accelerations(LANES, self.flier, beat, phase, psi, u, w, rate)
            return (np.array([u, w, rate, *bent]) / beat["frequency"]).ravel()

        start, when = np.vstack([np.zeros((2, count)), lanes[:, :4].T]).ravel(), np.linspace(0, 1, SAMPLES)
        with np.errstate(all="ignore"):
            flown = solve_ivp(slope, (0, 1), start, "RK45", when, rtol=self.rtol, atol=self.rtol)
        if flown.status != 0 or not np.isfinite(flown.y).all():
            return np.full((6, count, SAMPLES), FAILED)
        return flown.y.reshape(6, count, SAMPLES)

    def evaluate(self, scaled: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return closure then path margins, and their Jacobian; the last ones asked for are kept."""
        key = scaled.tobytes()
        if self.known is None or self.known[0] != key:
            lanes = np.vstack([scaled, scaled + STEP * np.eye(scaled.size)]) * self.scale
            states = self.fly(lanes)
            low, high = self.problem.bounds["body_pitch"]
            rows = []
            for lane, values in enumerate(lanes):
                miss = self.problem.closure(states[:, lane, -1], values, values[4]) / CLOSURE_SCALE
                pitch = states[2, lane]
                rows.append(np.concatenate([miss, (pitch - low) / PITCH_SCALE, (high - pitch) / PITCH_SCALE]))
            self.known = key, rows[0], (np.array(rows[1:]) - rows[0]).T / STEP
        return self.known[1:]

    def approach(self, scaled: np.ndarray) -> np.ndarray:
        """Come nearer to closure in least squares within the bounds, where SLSQP's own steps would go astray."""
        inside = 1e-6 * (self.upper - self.lower)

        def misses(x: np.ndarray) -> np.ndarray:
            return np.concatenate([self.evaluate(x)[0][:6], np.minimum(self.evaluate(x)[0][6:], 0)])

        def jacobian(x: np.ndarray) -> np.ndarray:
            values, slopes = self.evaluate(x)
            return np.concatenate([slopes[:6], slopes[6:] * (values[6:, None] < 0)])

        first = np.clip(scaled, (self.lower + inside) / self.scale, (self.upper - inside) / self.scale)
        limits = self.lower / self.scale, self.upper / self.scale
        return least_squares(misses, first, jacobian, limits, max_nfev=APPROACH).x

    def optimise(self, scaled: np.ndarray, ftol: float) -> tuple[np.ndarray, bool]:
        """Minimise the frequency on closed orbits."""
        gradient = np.eye(scaled.size)[4] * self.scale[4] / 10
        found = minimize(
            lambda x: float(gradient @ x),
            scaled,
            jac=lambda x: gradient,
            bounds=list(zip(self.lower / self.scale, self.upper / self.scale, strict=True)),
            constraints=[
                {"type": "eq", "fun": lambda x: self.evaluate(x)[0][:6], "jac": lambda x: self.evaluate(x)[1][:6]},
                {
                    "type": "ineq",
                    "fun": lambda x: self.evaluate(x)[0][6:],
                    "jac": lambda x: self.evaluate(x)[1][6:],
                },
            ],
            method="SLSQP",
            options={"maxiter": 60, "ftol": ftol},
        )
        # Where no step improves any more (8), what counts is whether the orbit is closed.
        closed = np.abs(self.evaluate(found.x)[0][:6]).max() <= 10 * ftol
        return found.x, bool(found.status == 0 or (found.status == 8 and closed))


def build(problem: wb.OrbitProblem, rtol: float, ftol: float) -> Solve:
    """Return what solves problems of this vehicle and model."""
    flier = Flier(problem, one_by_one=False)

    def solve(problem: wb.OrbitProblem, guess: np.ndarray) -> Answer:
        shooting = Shooting(problem, flier, rtol)
        scaled = guess / shooting.scale
        for _ in range(ROUNDS):
            scaled, success = shooting.optimise(shooting.approach(scaled), ftol)
            if success:
                break
        return Answer(scaled * shooting.scale, success)

    return solve


BUILDS = False  # nothing to keep from one problem to the next
VARIANTS = {
    # The near-kinks of the coefficients cost high-order methods their order: DOP853 and LSODA are no faster here.
    # SLSQP's own tolerance stays above what the steps, chosen anew for each flight, leave as noise.
    "SciPy, rtol 1e-6": partial(build, rtol=1e-6, ftol=1e-4),
    "SciPy, rtol 1e-10": partial(build, rtol=1e-10, ftol=1e-8),
}
