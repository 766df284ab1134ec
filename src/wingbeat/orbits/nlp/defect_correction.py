"""Defect correction: from the search's optimum of a slightly wrong flight to one that the certifier closes."""

from __future__ import annotations

import dataclasses
import functools
import time
from dataclasses import dataclass

import numpy as np

from wingbeat.kinematics import Wingbeat
from wingbeat.orbits.flight.certify import Certificate, certify
from wingbeat.orbits.nlp.local_search import OPTIMAL, Candidate, optimality, optimise
from wingbeat.orbits.nlp.newton_kkt import STILL, Curvature, Polish
from wingbeat.orbits.nlp.transcription import Transcription

CERTIFIED = 1e-6
_AIM = 3e-7
_EXCESS = 1e-6
# Blocks of steps of the flight that gives the corrected closure its derivative; how far from there, in the
# optimiser's scale, that derivative will do; and how near to the optimum that is not yet the last is near enough.
_FINE = 6
SETTLED = 2e-2
_SETTLING = 4
_NEARLY = 1e-3
_CORRECTIONS = 12
# After so many corrections the miss must have shrunk to this share, or it will not shrink to nothing.
_TRIED, _SHRUNK = 4, 0.1
# How often what binds is asked anew where a beat closes but is no optimum.
_TURNS = 2


@dataclass(frozen=True)
class Corrected:
    """A candidate brought to the certifier's closure, and what the certifier says of it."""

    scaled: np.ndarray
    wingbeat: Wingbeat
    certificate: Certificate
    miss: np.ndarray
    programme: Transcription
    learned: Curvature | None = None

    @functools.cached_property
    def optimality(self) -> float:
        """Largest residual of the optimality conditions."""
        return optimality(self.programme, self.scaled)

    def is_orbit(self, closed: float = CERTIFIED) -> bool:
        """Whether it closes, keeps to its limits along the path, and is an optimum."""
        return bool(
            size(self.miss) <= closed
            and self.programme.certified_margins(self.scaled, self.certificate).min() >= -_EXCESS
            and self.optimality <= OPTIMAL
        )


def correct(problem: Transcription, scaled: np.ndarray) -> Corrected:
    """Fly a candidate by the certifier and take its miss off the closure until the certifier's own miss is gone.

    The search's few steps find the optimum of a slightly wrong flight. Its closure is given the derivative and the
    value of a finer flight, then round by round the value that the certifier finds, and the optimum is followed.
    """
    problem = problem.anew()
    return follow_to_certificate(problem, Polish(problem, scaled), scaled)


def follow_to_certificate(problem: Transcription, polish: Polish, scaled: np.ndarray) -> Corrected:
    """Correct a candidate in a programme not corrected yet, as `correct` does, with a given polish."""
    for _ in range(_SETTLING):
        problem.tilt_at(scaled, _FINE)
        tilted, scaled = scaled, _settle(polish, scaled, _NEARLY)
        if np.abs(scaled - tilted).max() <= SETTLED:
            break
    rough = _fly(problem, scaled, rough=problem.asked is None)[1]
    if np.isfinite(rough.end).all():
        problem.shift_at(scaled, rough)
        scaled = _settle(polish, scaled)
    best: Corrected | None = None
    turns, first = 0, np.inf
    for tried in range(_CORRECTIONS):
        here = certified(problem, scaled)
        if here.is_orbit(_AIM):
            return dataclasses.replace(here, learned=polish.learned)
        if best is None or size(here.miss) < size(best.miss):
            best = here
        if tried == 0:
            first = size(here.miss)
        hopeless = tried == _TRIED and size(best.miss) > _SHRUNK * first
        if hopeless or not np.isfinite(here.miss).all():
            break
        closes = size(here.miss) <= _AIM
        if closes and turns == _TURNS:
            break
        problem.shift_at(scaled, here.certificate)
        if closes:
            # A bound that the search's few steps lean on may let go in a finer flight, or another begin to bind.
            scaled = optimise(problem, scaled, iterations=40, tolerance=1e-14)[0]
            polish = Polish(problem, scaled)
            turns += 1
        scaled = _settle(polish, scaled)
    assert best is not None
    return dataclasses.replace(best, learned=polish.learned)


def first_certified(problem: Transcription, found: list[Candidate]) -> Corrected | None:
    """Return the best candidate that the certifier closes, if any."""
    for candidate in sorted((c for c in found if c.closed and c.optimal), key=lambda c: c.objective):
        corrected = correct(candidate.programme, candidate.scaled)
        problem.certify_seconds += corrected.programme.certify_seconds
        if corrected.is_orbit():
            return corrected
    return None


def _settle(polish: Polish, scaled: np.ndarray, still: float = STILL) -> np.ndarray:
    polished = polish.follow(scaled, still)
    return optimise(polish.problem, scaled, iterations=40, tolerance=1e-14)[0] if polished is None else polished


def _fly(problem: Transcription, scaled: np.ndarray, *, rough: bool = False) -> tuple[Wingbeat, Certificate]:
    physical = problem.physical(scaled)
    begun = time.perf_counter()
    wingbeat = problem.problem.wingbeat(physical)
    certificate = certify(problem.model, wingbeat, physical[:4], rough=rough)
    problem.certify_seconds += time.perf_counter() - begun
    return wingbeat, certificate


def certified(problem: Transcription, scaled: np.ndarray) -> Corrected:
    """Fly unknowns by the certifier as they are."""
    wingbeat, certificate = _fly(problem, scaled)
    miss = problem.problem.closure(certificate.end, problem.physical(scaled), wingbeat.frequency)
    return Corrected(scaled, wingbeat, certificate, miss, problem)


def size(miss: np.ndarray) -> float:
    """Return the largest part of a miss, infinite where it is not a number."""
    return float(np.abs(np.nan_to_num(miss, nan=np.inf)).max())
