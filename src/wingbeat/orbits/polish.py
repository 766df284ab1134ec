"""The last digits of an optimum: Newton's method on the optimality conditions, active bounds held.

A search ends where its quasi-Newton matrix has told it to, which costs many flights per digit in directions along
which the objective hardly changes. Here the curvature along the few free directions is measured instead, once.
"""

from __future__ import annotations

import numpy as np

from wingbeat.orbits.transcription import AT_BOUND, Transcription

# Step of the difference quotient of the curvature, and the Newton step whose successor counts as none, in the
# optimiser's scale.
_STEP = 1e-4
_STILL = 1e-5
_ITERATIONS = 6
# Newton's method that leaves this far from closure has lost its way.
_LOST = 1.0


class Polish:
    """Newton's method from an optimum to that of a slightly changed problem, with what is active at the first."""

    def __init__(self, problem: Transcription, scaled: np.ndarray) -> None:
        self.problem = problem
        reach = AT_BOUND * (problem.upper - problem.lower)
        self.free = (scaled - problem.lower > reach) & (problem.upper - scaled > reach)
        self.on_path = problem.pitch_margin(scaled) <= AT_BOUND
        _, jacobian = self._rows(scaled)
        # Fewer unknowns than conditions cannot meet them.
        self.fits = jacobian.shape[0] <= jacobian.shape[1]
        if self.fits:
            self.along = _null_space(jacobian)
            self.curvature = self._curvature(scaled, jacobian)
            self.fits = bool((np.linalg.eigvalsh(self.curvature) > 0).all())

    def _rows(self, scaled: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the values that must vanish and their derivative by the unknowns that are not at a bound."""
        problem = self.problem
        values = np.concatenate([problem.closure(scaled), problem.pitch_margin(scaled)[self.on_path]])
        by_path = problem.pitch_margin_jacobian(scaled)[self.on_path]
        return values, np.concatenate([problem.closure_jacobian(scaled), by_path])[:, self.free]

    def _curvature(self, scaled: np.ndarray, jacobian: np.ndarray) -> np.ndarray:
        """Return the Lagrangian's second derivative along the null space, by differences of its gradient."""
        gradient = self.problem.objective_gradient(scaled)[self.free]
        multipliers = np.linalg.lstsq(jacobian.T, gradient)[0]
        change = []
        for direction in self.along.T:
            moved = scaled.copy()
            moved[self.free] += _STEP * direction
            there = self.problem.objective_gradient(moved)[self.free] - gradient
            change.append(there - (self._rows(moved)[1] - jacobian).T @ multipliers)
        curvature = np.reshape(change, (-1, self.free.sum())) @ self.along / _STEP
        return 0.5 * (curvature + curvature.T)

    def follow(self, scaled: np.ndarray) -> np.ndarray | None:
        """Return the optimum next to a point, or None where Newton's method leads to none within the bounds."""
        problem = self.problem
        for _ in range(_ITERATIONS if self.fits else 0):
            values, jacobian = self._rows(scaled)
            if not np.isfinite(values).all() or np.abs(values).max() > _LOST:
                return None
            null = _null_space(jacobian)
            left, _, right = np.linalg.svd(null.T @ self.along)
            along = null @ left @ right
            downhill = along.T @ problem.objective_gradient(scaled)[self.free]
            step = np.linalg.lstsq(jacobian, -values)[0] - along @ np.linalg.solve(self.curvature, downhill)
            scaled = scaled.copy()
            scaled[self.free] += step
            if (scaled < problem.lower).any() or (scaled > problem.upper).any():
                return None
            if np.abs(step).max() <= _STILL:
                # A bound on the path that was not met before may be broken now, which these conditions do not see.
                return scaled if problem.pitch_margin(scaled).min() >= -AT_BOUND else None
        return None


def _null_space(jacobian: np.ndarray) -> np.ndarray:
    return np.linalg.svd(jacobian)[2][jacobian.shape[0] :].T
