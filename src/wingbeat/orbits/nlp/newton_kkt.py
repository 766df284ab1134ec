"""Newton's method on the optimality conditions, with a fixed active set: the last digits of an optimum.

A local search estimates the curvature from its steps (a quasi-Newton matrix). Along directions in which the
objective hardly changes, the search needs many flights for each further digit. Here the curvature along the few
free directions is measured once.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from wingbeat.orbits.nlp.transcription import Transcription


class ReducedHessian(NamedTuple):
    """The Lagrangian's curvature at one optimum, for optima nearby with the same active set.

    Parameters
    ----------
    free : flags of the unknowns that are at no bound, shape (n,).
    active : which inequalities are active.
    basis : directions of the free unknowns that change no active condition, in columns.
    matrix : the Lagrangian's second derivative along them.
    """

    free: np.ndarray
    active: np.ndarray
    basis: np.ndarray
    matrix: np.ndarray


class NewtonKKT:
    """Newton's method from one optimum to that of a slightly changed problem, with the active set of the first.

    Parameters
    ----------
    programme : the first problem.
    scaled : its optimum.
    like : curvature at a nearby optimum. It is used if that optimum has the same active set; otherwise the
        curvature is computed from differences.

    Attributes
    ----------
    free, active : which unknowns are at no bound, and which inequalities are active.
    fits : whether there are enough unknowns for the conditions, and the measured curvature is positive definite.
    """

    def __init__(self, programme: Transcription, scaled: np.ndarray, like: ReducedHessian | None = None) -> None:
        self._options = programme.options.certificate.newton
        tolerance = programme.options.search.bound_tolerance
        reach = tolerance * (programme.upper - programme.lower)
        self.free = (scaled - programme.lower > reach) & (programme.upper - scaled > reach)
        self.active = programme.inequalities(scaled) <= tolerance
        _, jacobian = self._conditions(programme, scaled)
        # Fewer unknowns than conditions cannot satisfy them.
        self.fits = jacobian.shape[0] <= jacobian.shape[1] and bool(np.isfinite(jacobian).all())
        if not self.fits:
            return
        if like is not None and self._has_active_set_of(like):
            self._basis, self._hessian = like.basis, like.matrix
        else:
            null_space = self._null_space(jacobian)
            self._basis = null_space.basis
            self._hessian = self._measured(programme, scaled, jacobian, null_space)
            self.fits = bool(np.isfinite(self._hessian).all() and (np.linalg.eigvalsh(self._hessian) > 0).all())

    @property
    def reduced_hessian(self) -> ReducedHessian | None:
        """The curvature, for use with similar problems; None if the method is not applicable."""
        return ReducedHessian(self.free, self.active, self._basis, self._hessian) if self.fits else None

    def _has_active_set_of(self, other: ReducedHessian) -> bool:
        return np.array_equal(self.free, other.free) and np.array_equal(self.active, other.active)

    def _conditions(self, programme: Transcription, scaled: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        values, jacobian = programme.active_conditions(scaled, self.active)
        return values, jacobian[:, self.free]

    def _null_space(self, jacobian: np.ndarray) -> NullSpace:
        return NullSpace(jacobian, self._options.rank_tolerance)

    def _measured(
        self, programme: Transcription, scaled: np.ndarray, jacobian: np.ndarray, null_space: NullSpace
    ) -> np.ndarray:
        """Return the Lagrangian's second derivative along the null space, by differences of its gradient."""
        gradient, step = programme.objective_gradient(scaled)[self.free], self._options.difference_step
        multipliers = null_space.multipliers(gradient)
        change = []
        for direction in self._basis.T:
            moved = scaled.copy()
            moved[self.free] += step * direction
            there = programme.objective_gradient(moved)[self.free] - gradient
            change.append(there - (self._conditions(programme, moved)[1] - jacobian).T @ multipliers)
        curvature = np.reshape(change, (-1, self.free.sum())) @ self._basis / step
        return 0.5 * (curvature + curvature.T)

    def approach(self, programme: Transcription, scaled: np.ndarray, near: float) -> np.ndarray | None:
        """Return a point from which the next step is shorter than `near`; None if none is within the bounds.

        The next step is not taken. If certified optima predicted the first point, that step would lead to the
        optimum of the coarse flight, which is farther from the certified optimum than this point.
        """
        steps = self._steps(programme, scaled)
        return next((here for here, step in steps if np.abs(step).max() <= near), None)

    def converge(
        self, programme: Transcription, scaled: np.ndarray, step_tolerance: float | None = None
    ) -> np.ndarray | None:
        """Return the optimum next to a point, or None if the method finds none within the bounds.

        The method ends when a step is shorter than the tolerance (by default that of the options), or when
        residuals and gradient are as small as rounding permits.

        Theory: equation ``newton-step``.
        """
        still = self._options.step_tolerance if step_tolerance is None else step_tolerance
        for here, step in self._steps(programme, scaled):
            there = here + step
            if np.abs(step).max() <= still and not _is_outside(programme, there):
                # No optimum if it exceeds a limit that is not in the active set.
                exceeded = programme.inequalities(there).min() < -programme.options.search.bound_tolerance
                return None if exceeded else there
        return None

    def _steps(self, programme: Transcription, scaled: np.ndarray) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """Yield each iterate and its next step, while the iterates stay within the bounds."""
        options = self._options
        before: tuple[np.ndarray, ...] | None = None
        for _ in range(options.iterations if self.fits else 0):
            values, jacobian = self._conditions(programme, scaled)
            if not (np.isfinite(values).all() and np.isfinite(jacobian).all()):
                return
            if np.abs(values).max() > options.diverged:
                return
            gradient = programme.objective_gradient(scaled)[self.free]
            null_space = self._null_space(jacobian)
            # If the rank changes, the free directions change too, and their curvature is unknown.
            if null_space.basis.shape != self._basis.shape:
                return
            step = np.zeros(scaled.size)
            slope = np.abs(null_space.basis.T @ gradient).max(initial=0.0)
            if np.abs(values).max() <= options.residual_tolerance and slope <= options.gradient_tolerance:
                yield scaled, step
                return
            if before is not None:
                basis, tangential, gradient_before, jacobian_before = before
                turned = (jacobian - jacobian_before).T @ null_space.multipliers(gradient)
                self._update(tangential, basis.T @ (gradient - gradient_before - turned))
            left, _, right = np.linalg.svd(null_space.basis.T @ self._basis)
            basis = null_space.basis @ left @ right
            normal = null_space.least_norm_step(-values)
            tangential = -np.linalg.solve(self._hessian, basis.T @ gradient)
            step[self.free] = normal + basis @ tangential
            tells = np.abs(normal).max() <= options.normal_share * np.abs(tangential).max(initial=0.0)
            before = (basis, tangential, gradient, jacobian) if tells else None
            yield scaled, step
            scaled = scaled + step
            if _is_outside(programme, scaled):
                return

    def _update(self, tangential: np.ndarray, change: np.ndarray) -> None:
        """Update the curvature by the change of the Lagrangian's gradient along a tangential step (BFGS)."""
        expected = self._hessian @ tangential
        if tangential @ change > self._options.curvature_share * (tangential @ expected):
            by_step = np.outer(change, change) / (tangential @ change)
            self._hessian = self._hessian - np.outer(expected, expected) / (tangential @ expected) + by_step


def _is_outside(programme: Transcription, scaled: np.ndarray) -> bool:
    return bool((scaled < programme.lower).any() or (scaled > programme.upper).any())


class NullSpace:
    """Null space and pseudo-inverse of linear conditions ``jacobian @ step = values``, factored once.

    Parameters
    ----------
    jacobian : the conditions, shape (conditions, n).
    rank_tolerance : singular values below this share of the largest count as zero.

    Attributes
    ----------
    basis : orthonormal columns that span the steps with ``jacobian @ step = 0``.
    """

    def __init__(self, jacobian: np.ndarray, rank_tolerance: float) -> None:
        rows = jacobian.shape[0]
        left, sizes, right = np.linalg.svd(jacobian)
        independent = sizes > rank_tolerance * sizes[0]
        self.basis = right[independent.sum() :].T
        self._inverse = right[:rows][independent].T @ (left[:, independent] / sizes[independent]).T

    def least_norm_step(self, values: np.ndarray) -> np.ndarray:
        """Return the shortest step that satisfies the conditions."""
        return self._inverse @ values

    def multipliers(self, gradient: np.ndarray) -> np.ndarray:
        """Return the weights with which the conditions' gradients fit a gradient best."""
        return self._inverse.T @ gradient
