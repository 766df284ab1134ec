"""The claims about flight judged under many sets of assumptions at once."""

from __future__ import annotations

import functools
import multiprocessing
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass

import numpy as np

from wingbeat.orbits.solve import Progress
from wingbeat.paper.assumptions import Values, problem_under, sample_sets
from wingbeat.paper.claim import FlightClaim
from wingbeat.paper.claims import flight_claim_list
from wingbeat.paper.treatments import MODELS, Case
from wingbeat.results.orbit import solve_orbits

# The speeds that the claims need [m/s].
SPEEDS = {"pigeon": (10.0, 12.0, 16.0), "bat": (4.0, 5.0, 6.0, 8.0, 10.0, 12.0)}
# What every set would say alike (identities), or what one search an orbit cannot tell.
_LEFT_OUT = {
    "closed-loops",
    "open-loop",
    "printed-sign",
    "stable",
    "least-frequency",
    "force-balance",
    "differentiable",
}
_SET = "set"


@dataclass(frozen=True)
class Outcome:
    """What one set of assumptions says: numbers and verdicts by claim, not-a-number where untold."""

    numbers: tuple[float, ...]
    holds: tuple[float, ...]
    flown: int


@dataclass(frozen=True)
class Study:
    """All sets and what they say; arrays of shape (sets, claims), verdicts 0 or 1, not-a-number where untold."""

    sets: tuple[Values, ...]
    claims: tuple[FlightClaim, ...]
    numbers: np.ndarray
    holds: np.ndarray
    flown: np.ndarray

    @property
    def asked(self) -> int:
        """Orbits asked for in each set."""
        return len(MODELS) * sum(len(speeds) for speeds in SPEEDS.values())


def study_claims() -> tuple[FlightClaim, ...]:
    """Return the claims that hang on assumptions."""
    return tuple(claim for claim in flight_claim_list() if claim.id not in _LEFT_OUT)


def judge_set(values: Values, starts: int) -> Outcome:
    """Fly the orbits that the claims need under one set of assumptions, and judge the claims."""
    orbits = {}
    for animal, speeds in SPEEDS.items():
        for model in MODELS:
            problems = [problem_under(values, animal, model, speed) for speed in speeds]
            found = solve_orbits(problems, starts, most_starts=starts)
            orbits |= {Case(_SET, animal, model, s): orbit for s, orbit in zip(speeds, found, strict=True)}
    judged = [claim.judge(orbits, [_SET]).findings[0] for claim in study_claims()]
    return Outcome(
        tuple(np.nan if f.number is None else f.number for f in judged),
        tuple(np.nan if f.holds is None else float(f.holds) for f in judged),
        sum(orbit.status.value == "converged" for orbit in orbits.values()),
    )


def run_study(
    count: int, starts: int = 1, seed: int = 0, processes: int = 1, progress: Progress | None = None
) -> Study:
    """Sample sets of assumptions and judge the claims under each.

    Parameters
    ----------
    count : number of sets.
    starts : searches an orbit.
    seed : of the sample.
    processes : Python processes that share the sets.
    progress : called with (sets done, sets in all).
    """
    sets = sample_sets(count, seed)
    outcomes = []
    for outcome in _outcomes(sets, functools.partial(judge_set, starts=starts), processes):
        outcomes.append(outcome)
        if progress is not None:
            progress(len(outcomes), count)
    return Study(
        tuple(sets),
        study_claims(),
        np.array([o.numbers for o in outcomes]),
        np.array([o.holds for o in outcomes]),
        np.array([o.flown for o in outcomes]),
    )


def _outcomes(sets: Sequence[Values], judge: functools.partial[Outcome], processes: int) -> Iterator[Outcome]:
    if processes == 1:
        yield from map(judge, sets)
        return
    # A process that has run JAX must not be forked.
    with ProcessPoolExecutor(processes, multiprocessing.get_context("spawn")) as pool:
        try:
            yield from pool.map(judge, sets)
        finally:
            pool.shutdown(wait=False, cancel_futures=True)
