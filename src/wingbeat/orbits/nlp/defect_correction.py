"""Defect correction: from the optimum of the solver's coarse flight to one that the certifier closes."""

from __future__ import annotations

import dataclasses
import functools
import time
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from wingbeat.animal.kinematics import Wingbeat
from wingbeat.orbits.flight.certificate import Certificate, certify
from wingbeat.orbits.nlp.newton_kkt import NewtonKKT, ReducedHessian

if TYPE_CHECKING:
    from wingbeat.orbits.nlp.transcription import Candidate, Transcription


@dataclass(frozen=True)
class Corrected:
    """A candidate, corrected so that it closes in the certifier's flight if possible, and its certificate."""

    scaled: np.ndarray
    wingbeat: Wingbeat
    certificate: Certificate
    residual: np.ndarray
    programme: Transcription
    reduced_hessian: ReducedHessian | None = None

    @functools.cached_property
    def optimality(self) -> float:
        """Largest residual of the optimality conditions."""
        return self.programme.optimality(self.scaled)

    def is_orbit(self, closure_tolerance: float | None = None) -> bool:
        """Whether the candidate closes, keeps to its limits along the path, and is an optimum.

        The default tolerance is that of a certificate.

        Theory: equation ``certificate``.
        """
        options = self.programme.options
        closed = options.certificate.closure_tolerance if closure_tolerance is None else closure_tolerance
        limits = self.programme.certified_inequalities(self.scaled, self.certificate)
        return bool(
            size(self.residual) <= closed
            and limits.min() >= -options.certificate.limit_tolerance
            and self.optimality <= options.search.optimality_tolerance
        )


def correct(programme: Transcription, scaled: np.ndarray) -> Corrected:
    """Shift a candidate's closure by the certifier's residual until the certified wingbeat closes.

    The optimum of the solver's coarse flight is inaccurate. We first replace value and derivative of the
    closure by those of a finer flight. In each round after that, we replace the value of the closure by that of the
    certifier's flight. After each replacement, Newton's method finds the new optimum.
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
            scaled = programme.optimise(scaled, options.iterations, options.tolerance)[0]
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
            return corrected
    return None


def _optimum(
    programme: Transcription, newton: NewtonKKT, scaled: np.ndarray, step_tolerance: float | None = None
) -> np.ndarray:
    """Return the optimum near a point, from Newton's method or else from SLSQP."""
    options = programme.options.certificate
    found = newton.converge(programme, scaled, step_tolerance)
    return programme.optimise(scaled, options.iterations, options.tolerance)[0] if found is None else found


def _fly(programme: Transcription, scaled: np.ndarray, *, rough: bool = False) -> tuple[Wingbeat, Certificate]:
    options = programme.options.certificate
    physical = programme.physical(scaled)
    begun = time.perf_counter()
    wingbeat = programme.problem.wingbeat(physical)
    certificate = certify(
        programme.model, wingbeat, physical[:4], options.rough_rtol if rough else options.rtol, rough=rough
    )
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
