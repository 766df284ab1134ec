"""The claims about flight judged under many sets of assumptions at once."""

from __future__ import annotations

import functools
from dataclasses import dataclass

import numpy as np

from wingbeat.orbits.batch import in_processes
from wingbeat.orbits.solve import Progress
from wingbeat.paper.assumptions import Values, problem_under, sample_sets
from wingbeat.paper.claim import FlightClaim
from wingbeat.paper.claims import flight_claim_list
from wingbeat.paper.treatments import MODELS, chain
from wingbeat.results.orbit import solve_series

# The speeds that the claims need [m/s].
SPEEDS = {"pigeon": (10.0, 12.0, 16.0), "bat": (5.0, 8.0, 10.0, 12.0)}
# Identities, which every set says alike; what few searches cannot tell; what another claim's number says.
_LEFT_OUT = {
    "closed-loops",
    "open-loop",
    "printed-sign",
    "stable",
    "least-frequency",
    "force-balance",
    "differentiable",
    "few-degrees",
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
        row = chain(_SET, animal, speeds)
        problems = [problem_under(values, animal, case.model, case.speed) for case in row]
        orbits |= dict(zip(row, solve_series(problems, starts, most_starts=starts), strict=True))
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
    starts : searches of each orbit before answers are handed on along speed and from model to model.
    seed : of the sample.
    processes : Python processes that share the sets.
    progress : called with (sets done, sets in all).
    """
    sets = sample_sets(count, seed)
    outcomes = list(in_processes(functools.partial(judge_set, starts=starts), sets, processes, progress))
    return Study(
        tuple(sets),
        study_claims(),
        np.array([o.numbers for o in outcomes]),
        np.array([o.holds for o in outcomes]),
        np.array([o.flown for o in outcomes]),
    )
