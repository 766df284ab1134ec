"""The last digits of an optimum: Newton's method on the optimality conditions, active bounds held.

A search ends where its quasi-Newton matrix has told it to, which costs many flights per digit in directions along
which the objective hardly changes. Here the curvature along the few free directions is measured instead, once.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from wingbeat.orbits.nlp.transcription import AT_BOUND, Transcription

# Step of the difference quotient of the curvature, and the Newton step whose successor counts as none, in the
# optimiser's scale.
_STEP = 1e-4
STILL = 1e-5
_ITERATIONS = 10
# A step tells of the curvature along the null space if its part across is shorter than this share of it, and if
# the curvature is more than this share of what was thought.
_ASIDE = 0.05
_BENT = 0.1
# Conditions smaller than this share of the largest say nothing new.
_SAME_TWICE = 1e-13
# Newton's method that leaves this far from closure has lost its way.
_LOST = 5.0
# Conditions that hold so well, and a slope along them so small, are as good as the next step could make them.
_HELD = 3e-8
_FLAT = 3e-6


class Curvature(NamedTuple):
    """What Newton's method learned of one optimum, for optima near by where the same is active.

    Parameters
    ----------
    free : which unknowns lean on no bound.
    on_path : which margins are met.
    along : directions of the free unknowns that keep what is active, in columns.
    matrix : the Lagrangian's second derivative along them.
    """

    free: np.ndarray
    on_path: np.ndarray
    along: np.ndarray
    matrix: np.ndarray


class Polish:
    """Newton's method from an optimum to that of a slightly changed problem, with what is active at the first.

    The curvature is that of `like`, where that was found near by with the same active, or else it is measured.
    """

    def __init__(self, problem: Transcription, scaled: np.ndarray, like: Curvature | None = None) -> None:
        self.problem = problem
        reach = AT_BOUND * (problem.upper - problem.lower)
        self.free = (scaled - problem.lower > reach) & (problem.upper - scaled > reach)
        self.on_path = problem.margins(scaled) <= AT_BOUND
        _, jacobian = self._rows(scaled)
        # Fewer unknowns than conditions cannot meet them.
        self.fits = jacobian.shape[0] <= jacobian.shape[1] and bool(np.isfinite(jacobian).all())
        if not self.fits:
            return
        if like is not None and self._has_the_active_of(like):
            self.along, self.curvature = like.along, like.matrix
        else:
            conditions = Conditions(jacobian)
            self.along = conditions.null
            self.curvature = self._curvature(scaled, jacobian, conditions)
            self.fits = bool(np.isfinite(self.curvature).all() and (np.linalg.eigvalsh(self.curvature) > 0).all())

    @property
    def learned(self) -> Curvature | None:
        """What to lend to a problem near by, if Newton's method fits this one."""
        return Curvature(self.free, self.on_path, self.along, self.curvature) if self.fits else None

    def _has_the_active_of(self, other: Curvature) -> bool:
        return np.array_equal(self.free, other.free) and np.array_equal(self.on_path, other.on_path)

    def _rows(self, scaled: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        values, jacobian = self.problem.conditions(scaled, self.on_path)
        return values, jacobian[:, self.free]

    def _curvature(self, scaled: np.ndarray, jacobian: np.ndarray, conditions: Conditions) -> np.ndarray:
        """Return the Lagrangian's second derivative along the null space, by differences of its gradient."""
        gradient = self.problem.objective_gradient(scaled)[self.free]
        multipliers = conditions.multipliers(gradient)
        change = []
        for direction in self.along.T:
            moved = scaled.copy()
            moved[self.free] += _STEP * direction
            there = self.problem.objective_gradient(moved)[self.free] - gradient
            change.append(there - (self._rows(moved)[1] - jacobian).T @ multipliers)
        curvature = np.reshape(change, (-1, self.free.sum())) @ self.along / _STEP
        return 0.5 * (curvature + curvature.T)

    def approach(self, scaled: np.ndarray, near: float) -> np.ndarray | None:
        """Return a point from which the next step is shorter than `near`, or None as `follow` does.

        That step is not made: one from known answers to the optimum of a search's few steps would lead away.
        """
        return next((here for here, step in self._steps(scaled) if np.abs(step).max() <= near), None)

    def follow(self, scaled: np.ndarray, still: float = STILL) -> np.ndarray | None:
        """Return the optimum next to a point, or None where Newton's method leads to none within the bounds.

        It ends with a step shorter than `still`, or where nothing is left to be gained.
        """
        for here, step in self._steps(scaled):
            there = here + step
            if np.abs(step).max() <= still and not self._is_outside(there):
                # None where a bound on the path is broken that was not met before.
                return there if self.problem.margins(there).min() >= -AT_BOUND else None
        return None

    def _steps(self, scaled: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """Yield where Newton's method comes by and its next step, while it keeps to the bounds."""
        problem = self.problem
        before: tuple[np.ndarray, ...] | None = None
        for _ in range(_ITERATIONS if self.fits else 0):
            values, jacobian = self._rows(scaled)
            if not (np.isfinite(values).all() and np.isfinite(jacobian).all()) or np.abs(values).max() > _LOST:
                return
            gradient = problem.objective_gradient(scaled)[self.free]
            conditions = Conditions(jacobian)
            # Conditions of another rank leave other directions free, of which the curvature says nothing.
            if conditions.null.shape != self.along.shape:
                return
            step = np.zeros(scaled.size)
            if np.abs(values).max() <= _HELD and np.abs(conditions.null.T @ gradient).max(initial=0.0) <= _FLAT:
                yield scaled, step
                return
            if before is not None:
                along, sliding, gradient_before, jacobian_before = before
                turned = (jacobian - jacobian_before).T @ conditions.multipliers(gradient)
                self._learn(sliding, along.T @ (gradient - gradient_before - turned))
            left, _, right = np.linalg.svd(conditions.null.T @ self.along)
            along = conditions.null @ left @ right
            closing = conditions.shortest(-values)
            sliding = -np.linalg.solve(self.curvature, along.T @ gradient)
            step[self.free] = closing + along @ sliding
            slides = np.abs(closing).max() <= _ASIDE * np.abs(sliding).max(initial=0.0)
            before = (along, sliding, gradient, jacobian) if slides else None
            yield scaled, step
            scaled = scaled + step
            if self._is_outside(scaled):
                return

    def _is_outside(self, scaled: np.ndarray) -> bool:
        return bool((scaled < self.problem.lower).any() or (scaled > self.problem.upper).any())

    def _learn(self, sliding: np.ndarray, change: np.ndarray) -> None:
        """Take into the curvature how a step along the null space changed the Lagrangian's gradient (BFGS)."""
        told = self.curvature @ sliding
        if sliding @ change > _BENT * (sliding @ told):
            by_step = np.outer(change, change) / (sliding @ change)
            self.curvature = self.curvature - np.outer(told, told) / (sliding @ told) + by_step


class Conditions:
    """Linear conditions ``jacobian @ step = values``, taken apart once: what they leave free, and what they fix."""

    def __init__(self, jacobian: np.ndarray) -> None:
        rows = jacobian.shape[0]
        left, sizes, right = np.linalg.svd(jacobian)
        # Conditions that say the same twice have no size of their own.
        told = sizes > _SAME_TWICE * sizes[0]
        self.null = right[told.sum() :].T
        self._inverse = right[:rows][told].T @ (left[:, told] / sizes[told]).T

    def shortest(self, values: np.ndarray) -> np.ndarray:
        """Return the shortest step that meets the conditions."""
        return self._inverse @ values

    def multipliers(self, gradient: np.ndarray) -> np.ndarray:
        """Return the weights of the conditions that come nearest to a gradient."""
        return self._inverse.T @ gradient
