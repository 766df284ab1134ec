"""What a search found, and how it ended."""

from __future__ import annotations

import dataclasses
import enum
import functools
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from wingbeat.kinematics import Wingbeat
from wingbeat.orbits.beat import Beat, flown_beat
from wingbeat.orbits.certify import Certificate
from wingbeat.orbits.changes import Relaxation
from wingbeat.orbits.polish import Curvature
from wingbeat.orbits.problem import OrbitProblem
from wingbeat.orbits.quantities import Quantity
from wingbeat.orbits.shortage import Shortage
from wingbeat.orbits.stability import floquet_multipliers

# Optima nearer to one another than this, in the optimiser's scale, are one; the other is the distance from which on
# two are two where one of them is not corrected.
SAME, ELSEWHERE = 1e-3, 0.05


class Status(enum.Enum):
    """How a search for an orbit ended; the value is the name in records."""

    CONVERGED = "converged"
    INFEASIBLE = "infeasible"
    NOT_CONVERGED = "not-converged"


class Optimum(NamedTuple):
    """Where one of the searches ended, uncorrected: the objective and the unknowns."""

    objective: float
    unknowns: np.ndarray


@dataclass(frozen=True)
class Solution:
    """What the search found: the wingbeat and start of the best orbit, and how far it can be trusted.

    `optima` are those that the searches met. Where there is no orbit, wingbeat and start are of the beat that comes
    closest; `shortages` says which law of balance it breaks and by how much, the most first, and `relaxations`
    which single changes fly, the smallest first. `learned` is what problems near by can make use of.
    """

    problem: OrbitProblem
    status: Status
    message: str
    wingbeat: Wingbeat
    certificate: Certificate
    closure: dict[str, float]
    active_bounds: tuple[str, ...]
    optimality: float
    starts: int
    distinct_optima: int
    seed: int
    seconds: float
    certify_seconds: float
    optima: tuple[Optimum, ...] = ()
    shortages: tuple[Shortage, ...] = ()
    relaxations: tuple[Relaxation, ...] = ()
    learned: Curvature | None = None

    @property
    def unknowns(self) -> np.ndarray:
        """Pitch state at the start and free parameters, as a search starts from them."""
        return self.problem.unknowns_of(self.certificate.states[0], self.wingbeat)

    @property
    def place(self) -> np.ndarray:
        """The unknowns in the optimiser's scale, velocities from the mean ones: orbits at two speeds compare."""
        drift = np.zeros(self.unknowns.size)
        drift[1:3] = self.problem.speed, self.problem.climb
        return (self.unknowns - drift) / self.problem.unknowns().scale

    def same_as(self, other: Solution) -> bool:
        """Whether this is the same optimum of the same problem."""
        return bool(np.abs(self.place - other.place).max() <= SAME)

    @functools.cached_property
    def objective(self) -> float:
        """What was made least."""
        minimise = self.problem.minimise
        if isinstance(minimise, Quantity):
            return self.value_of(minimise)
        return minimise.value(self.problem.unknowns().names, self.unknowns)

    def beat(self) -> Beat:
        """Return the certified beat as a time series, made anew: batches have no room for many."""
        problem, certificate = self.problem, self.certificate
        velocity = problem.speed, problem.climb
        return flown_beat(problem.model, self.wingbeat, certificate.phase, certificate.states[:, 2:], velocity)

    def value_of(self, quantity: Quantity) -> float:
        """Return a quantity of the certified beat in its unit, of a series its largest value."""
        return float(np.max(quantity.of(self.beat())))

    @functools.cached_property
    def multipliers(self) -> np.ndarray:
        """Floquet multipliers, found when first asked for."""
        return floquet_multipliers(self.problem.model, self.wingbeat, self.certificate.steps)


def better_of(own: Solution, other: Solution) -> Solution:
    """Return the better of two answers to one problem, with the searches, optima and times of both."""
    converged = [s for s in (own, other) if s.status is Status.CONVERGED]
    return dataclasses.replace(
        min(converged, key=lambda s: s.objective, default=own),
        starts=own.starts + other.starts,
        distinct_optima=own.distinct_optima + (0 if own.same_as(other) else other.distinct_optima),
        optima=own.optima + other.optima,
        seed=own.seed,
        seconds=own.seconds + other.seconds,
        certify_seconds=own.certify_seconds + other.certify_seconds,
    )
