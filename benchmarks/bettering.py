"""Attempts to better an optimum of wingbeat's: random restarts of its own search, and CasADi with IPOPT.

What counts is the certified objective: what either finds is where wingbeat's correction starts, so that an error of
discretisation is no improvement.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path
from typing import Any

import numpy as np

import wingbeat as wb
from wingbeat.orbits.nlp.transcription import Candidate, Transcription, search
from wingbeat.orbits.options import DEFAULTS
from wingbeat.orbits.solution import Solution, certified_optimum, search_near
from wingbeat.orbits.starts import start_point

sys.path.append(str(Path(__file__).parent / "peers"))

# Seed of IPOPT's guesses.
GUESSES = 2
# A search's own value is that much off the certified one at most; so many of its optima are certified.
ROUGHLY, MOST = 0.02, 4
# In the optimiser's scale, of which a free parameter's range has five.
PERTURBED = 0.25


def by_restarts(best: Solution, restarts: int, seed: int) -> dict:
    """Return how many restarts ended in an optimum, how many in the best, and the least certified objective."""
    problem = best.problem
    programme = Transcription(problem)
    found = [search(programme.uncorrected(), start_point(problem, 1 + i, seed)) for i in range(restarts)]
    optima = sorted((c for c in found if c.closed and c.optimal), key=lambda c: c.objective)
    near = best.objective + ROUGHLY * abs(best.objective)
    rivals: list[Candidate] = []
    for candidate in optima:
        known = any(
            np.abs(candidate.scaled - other.scaled).max() <= DEFAULTS.search.same_optimum for other in rivals
        )
        if candidate.objective <= near and not known:
            rivals.append(candidate)
    certified = [found for candidate in rivals[:MOST] if (found := certified_optimum(candidate, 0.0))]
    return {
        "ended_in_an_optimum": len(optima),
        "as_good": sum(c.objective - optima[0].objective < 1e-3 * abs(best.objective) for c in optima),
        "least": min((c.objective for c in certified), default=None),
        "least_uncertified": optima[0].objective if optima else None,
        "not_certified": len(rivals[:MOST]) - len(certified),
    }


class Ipopt:
    """IPOPT on problems of wingbeat; those that differ in numbers only are stated once if in succession."""

    def __init__(self, guesses: int) -> None:
        self.guesses = guesses
        self._stated: tuple | None = None
        self._solve: Any = None

    def _state(self, problem: wb.OrbitProblem) -> None:
        from optima_by_casadi import build

        measures = problem.minimise.name, *(c.quantity.name for c in problem.subject_to)
        stated = problem.species.name, problem.species.wingbeat, problem.free, measures
        if self._stated != stated:
            self._stated, self._solve = stated, build(problem)

    def __call__(self, best: Solution) -> list[dict]:
        """Return what IPOPT finds from wingbeat's optimum, from near it, and from random guesses."""
        problem, flown = best.problem, best.certificate
        self._state(problem)

        def path(phases: np.ndarray) -> np.ndarray:
            return np.stack([np.interp(phases, flown.phase, states) for states in flown.states.T[2:]], axis=1)

        random = np.random.default_rng(GUESSES)
        near = best.unknowns + PERTURBED * problem.unknowns().scale * random.uniform(-1, 1, best.unknowns.size)
        starts: list[tuple] = [("its optimum", best.unknowns, path), ("near it", near, path)]
        starts += [(f"random {i}", start_point(problem, i, GUESSES), None) for i in range(1, 1 + self.guesses)]
        return [self._one(problem, *start) for start in starts]

    def _one(self, problem: wb.OrbitProblem, start: str, unknowns: np.ndarray, path: Any) -> dict:
        begun = time.perf_counter()
        found = self._solve(problem, unknowns, path)
        seconds = time.perf_counter() - begun
        flown = search_near(problem, found.unknowns) if found.success else None
        return {
            "from": start,
            "success": found.success,
            "own": found.objective,
            "certified": None if flown is None else flown.objective,
            "seconds": seconds,
        }
