"""Newton's method on the optimality conditions, with a fixed active set: the last digits of an optimum.

A local search estimates the curvature from its steps (a quasi-Newton matrix). Along directions in which the
objective hardly changes, the search needs many flights for each further digit. Here the curvature along the few
free directions is measured once.
"""

from __future__ import annotations

import dataclasses
import functools
import time
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from wingbeat.animal.kinematics import Wingbeat
from wingbeat.orbits.flight.certificate import Certificate
from wingbeat.orbits.flight.period import CLOSURE_SCALE
from wingbeat.orbits.nlp.programme import Step

if TYPE_CHECKING:
    from wingbeat.orbits.nlp.transcription import Candidate, Transcription


class ReducedHessian(NamedTuple):
    """The Lagrangian's curvature at one optimum, for optima nearby with the same active set."""

    free: np.ndarray  # which unknowns are at no bound
    active: np.ndarray
    basis: np.ndarray  # columns: directions of the free unknowns that change no active condition
    matrix: np.ndarray  # second derivative along them


class NewtonKKT:
    """Newton's method from one optimum to that of a slightly changed problem, with the active set of the first.

    The curvature `like` of a nearby optimum is used if its active set is the same, and else measured.
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
        if like and np.array_equal(self.free, like.free) and np.array_equal(self.active, like.active):
            self._basis, self._hessian = like.basis, like.matrix
        else:
            null_space = NullSpace(jacobian, self._options.rank_tolerance)
            self._basis = null_space.basis
            self._hessian = self._measured(programme, scaled, jacobian, null_space)
            self.fits = bool(np.isfinite(self._hessian).all() and (np.linalg.eigvalsh(self._hessian) > 0).all())

    @property
    def reduced_hessian(self) -> ReducedHessian | None:
        """The curvature, for use with similar problems; None if the method is not applicable."""
        return ReducedHessian(self.free, self.active, self._basis, self._hessian) if self.fits else None

    def _conditions(self, programme: Transcription, scaled: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        values, jacobian = programme.active_conditions(scaled, self.active)
        return values, jacobian[:, self.free]

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
        """Return a point from which the next step is shorter than `near`; None if none is within the bounds."""
        # That step is not taken: it would lead to the optimum of the coarse flight, which is farther from the
        # certified optimum than a point that certified optima predicted.
        steps = self._steps(programme, scaled)
        return next((here for here, step in steps if np.abs(step).max() <= near), None)

    def converge(
        self, programme: Transcription, scaled: np.ndarray, step_tolerance: float | None = None
    ) -> np.ndarray | None:
        """Return the optimum next to a point, or None if there is none. Theory: equation ``newton-step``."""
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
            null_space = NullSpace(jacobian, options.rank_tolerance)
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
    """Null space (columns of `basis`) and pseudo-inverse of conditions ``jacobian @ step = values``."""

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


# --- Defect correction: from the optimum of the coarse flight to one that the certifier closes. ---


@dataclass(frozen=True)
class Corrected:
    """A candidate, corrected so that it closes in the certifier's flight if possible, and its certificate.

    `origin` is where the search ended that led here, if `first_certified` returned it.
    """

    scaled: np.ndarray
    wingbeat: Wingbeat
    certificate: Certificate
    residual: np.ndarray
    programme: Transcription
    reduced_hessian: ReducedHessian | None = None
    origin: Candidate | None = None

    @functools.cached_property
    def optimality(self) -> float:
        """Largest residual of the optimality conditions."""
        return self.programme.optimality(self.scaled)

    def is_orbit(self, closure_tolerance: float | None = None) -> bool:
        """Whether the candidate closes, keeps its limits, and is an optimum. Theory: equation ``certificate``."""
        options = self.programme.options
        closed = options.certificate.closure_tolerance if closure_tolerance is None else closure_tolerance
        limits = self.programme.certified_inequalities(self.scaled, self.certificate)
        return bool(
            size(np.append(self.residual, self.certificate.inner_miss)) <= closed
            and limits.min() >= -options.certificate.limit_tolerance
            and self.optimality <= options.search.optimality_tolerance
        )


def correct(programme: Transcription, scaled: np.ndarray) -> Corrected:
    """Shift a candidate's closure by the certifier's residual until the certified wingbeat closes.

    We first replace value and derivative of the closure by those of a finer flight, then in each round the value by
    that of the certifier's flight. After each replacement, Newton's method finds the new optimum.
    """
    programme = programme.uncorrected()
    return follow_to_certificate(programme, NewtonKKT(programme, scaled), scaled)


def follow_to_certificate(programme: Transcription, newton: NewtonKKT, scaled: np.ndarray) -> Corrected:
    """Correct a candidate as `correct` does, with a given Newton's method; the programme must be uncorrected."""
    options = programme.options.certificate
    for _ in range(options.linearisations):
        programme = programme.linearised_at(scaled, options.fine_blocks)
        anchor, scaled = scaled, _optimum(programme, newton, scaled, options.linearised_step)
        if np.abs(scaled - anchor).max() <= options.linear_range:
            break
    rough = _fly(programme, scaled, rough=programme.outputs is None)[1]
    if np.isfinite(rough.end).all():
        programme = programme.matched_to(scaled, rough)
        scaled = _optimum(programme, newton, scaled)
    tries: list[Corrected] = []
    updates = 0
    for tried in range(options.corrections):
        here = certified(programme, scaled)
        if programme.steps is not None:
            moved = float(np.abs(scaled - tries[-1].scaled).max()) if tries else 0.0
            apart = size(here.residual / CLOSURE_SCALE)
            programme.steps.append(Step("certificate", tried, programme.objective(scaled), apart, moved))
        if here.is_orbit(options.aimed_closure):
            return dataclasses.replace(here, reduced_hessian=newton.reduced_hessian)
        tries.append(here)
        least, first = min(size(one.residual) for one in tries), size(tries[0].residual)
        hopeless = tried == options.trial_corrections and least > options.trial_reduction * first
        if hopeless or not np.isfinite(here.residual).all():
            break
        closes = size(here.residual) <= options.aimed_closure
        if closes and updates == options.bound_updates:
            break
        programme = programme.matched_to(scaled, here.certificate)
        if closes:
            # In a finer flight an active bound may become inactive, or another one active.
            scaled = programme.optimise(scaled, options.iterations, options.tolerance, stage="correction")[0]
            newton = NewtonKKT(programme, scaled)
            updates += 1
        scaled = _optimum(programme, newton, scaled)
    tries.sort(key=lambda one: size(one.residual))
    # Where two multipliers meet at their limit, corrections alternate between both sides of it.
    best = next((one for one in tries if one.is_orbit()), tries[0])
    return dataclasses.replace(best, reduced_hessian=newton.reduced_hessian)


def first_certified(programme: Transcription, found: list[Candidate]) -> Corrected | None:
    """Return the best candidate that can be certified, if any."""
    for candidate in sorted((c for c in found if c.is_optimum), key=lambda c: c.objective):
        corrected = correct(candidate.programme, candidate.scaled)
        programme.certifying.extend(corrected.programme.certifying)
        if corrected.is_orbit():
            return dataclasses.replace(corrected, origin=candidate)
    return None


def _optimum(
    programme: Transcription, newton: NewtonKKT, scaled: np.ndarray, step_tolerance: float | None = None
) -> np.ndarray:
    """Return the optimum near a point, from Newton's method or else from SLSQP."""
    options = programme.options.certificate
    found = newton.converge(programme, scaled, step_tolerance)
    if found is not None:
        return found
    return programme.optimise(scaled, options.iterations, options.tolerance, stage="correction")[0]


def _fly(programme: Transcription, scaled: np.ndarray, *, rough: bool = False) -> tuple[Wingbeat, Certificate]:
    begun = time.perf_counter()
    wingbeat = programme.problem.wingbeat(programme.physical(scaled))
    certificate = programme.certificate(scaled, wingbeat, rough=rough)
    programme.certifying.append(time.perf_counter() - begun)
    return wingbeat, certificate


def certified(programme: Transcription, scaled: np.ndarray) -> Corrected:
    """Return unknowns with their certificate, without correction."""
    wingbeat, certificate = _fly(programme, scaled)
    residual = programme.problem.closure(certificate.end, programme.physical(scaled), wingbeat.frequency)
    return Corrected(scaled, wingbeat, certificate, residual, programme)


def size(residual: np.ndarray) -> float:
    """Return the largest part of a residual, infinite if a part is not a number."""
    return float(np.abs(np.nan_to_num(residual, nan=np.inf)).max())
