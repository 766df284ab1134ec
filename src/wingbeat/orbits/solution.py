"""What the solver found, and how it ended."""

from __future__ import annotations

import dataclasses
import functools
import re
from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from wingbeat.animal.kinematics import Wingbeat
from wingbeat.orbits.flight.beat import Beat
from wingbeat.orbits.flight.certify import Certificate
from wingbeat.orbits.flight.floquet import monodromy, multipliers_of
from wingbeat.orbits.infeasible.deficit import Deficit
from wingbeat.orbits.infeasible.relaxation import Relaxation
from wingbeat.orbits.nlp.newton_kkt import ReducedHessian
from wingbeat.orbits.options.solver import DEFAULTS, SolverOptions
from wingbeat.orbits.problem.certified_beat import certified_beat
from wingbeat.orbits.problem.map_quantities import MapQuantity
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.problem.quantity import Quantity
from wingbeat.orbits.status import Status


class Optimum(NamedTuple):
    """The best uncorrected optimum of a family: the objective, the unknowns, and how many starts ended there."""

    objective: float
    unknowns: np.ndarray
    starts: int = 1


def families(optima: Iterable[Optimum], scale: np.ndarray, apart: float) -> tuple[Optimum, ...]:
    """Return the best optimum of each family, best first, with the number of starts that ended in it.

    Parameters
    ----------
    optima : those in which starts ended.
    scale : of the unknowns.
    apart : optima closer to one another than this, in the optimiser's scale, belong to one family.
    """
    found: list[Optimum] = []
    for optimum in sorted(optima, key=lambda o: o.objective):
        for i, other in enumerate(found):
            if np.abs((optimum.unknowns - other.unknowns) / scale).max() <= apart:
                found[i] = other._replace(starts=other.starts + optimum.starts)
                break
        else:
            found.append(optimum)
    return tuple(found)


@dataclass(frozen=True)
class Solution:
    """What the solver found: wingbeat and initial state of the best orbit, and how far the orbit can be trusted.

    `optima` holds the best uncorrected optimum of each family. `reduced_hessian` helps to solve similar problems.
    `options` are the options of the solvers. `free_objective` is the objective without limits of stability, if the
    problem has such limits.

    If there is no orbit, wingbeat and initial state are those of the closest wingbeat. `deficits` are then the
    deficits of the balances that fail, the largest first. `relaxations` are the single changes with which an orbit
    exists, the smallest first.
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
    deficits: tuple[Deficit, ...] = ()
    relaxations: tuple[Relaxation, ...] = ()
    reduced_hessian: ReducedHessian | None = None
    options: SolverOptions = DEFAULTS
    free_objective: float | None = None

    @property
    def starts_at_best(self) -> int:
        """How many starts ended in the family of this optimum."""
        if self.status is not Status.CONVERGED:
            return 0
        scale, apart = self.problem.unknowns().scale, self.options.search.same_optimum
        near = [o.starts for o in self.optima if np.abs((o.unknowns - self.unknowns) / scale).max() <= apart]
        return max(sum(near), 1)

    @property
    def limited(self) -> frozenset[str]:
        """Names of the parameters and quantities that a bound or a limit of their own has set."""
        return frozenset(re.split("[<>]=", name)[0] for name in self.active_bounds)

    @property
    def unknowns(self) -> np.ndarray:
        """Pitch state at phase 0 and free parameters, from which a local search can start."""
        return self.problem.unknowns_of(self.certificate.states[0], self.wingbeat)

    @property
    def place(self) -> np.ndarray:
        """The unknowns in the optimiser's scale, with mean velocity subtracted, to compare orbits at two speeds."""
        drift = np.zeros(self.unknowns.size)
        drift[1:3] = self.problem.speed, self.problem.climb
        return (self.unknowns - drift) / self.problem.unknowns().scale

    def same_as(self, other: Solution) -> bool:
        """Whether this optimum and another of the same problem are of one family."""
        return bool(np.abs(self.place - other.place).max() <= self.options.search.same_optimum)

    @functools.cached_property
    def objective(self) -> float:
        """The value that was minimised."""
        minimise = self.problem.minimise
        if minimise.parameter:
            return float(self.unknowns[self.problem.unknowns().names.index(minimise.parameter)])
        return self.value_of(minimise)

    @property
    def price_of_stability(self) -> float | None:
        """The excess of the objective over `free_objective`, as a share of `free_objective`; None if not known."""
        if self.free_objective is None or self.status is not Status.CONVERGED:
            return None
        return (self.objective - self.free_objective) / abs(self.free_objective)

    def as_optimum(self) -> tuple[Optimum, ...]:
        """Return the orbit as an optimum in which one start ended; return nothing if the orbit is not certified."""
        return (Optimum(self.objective, self.unknowns),) if self.status is Status.CONVERGED else ()

    def beat(self) -> Beat:
        """Return the certified beat as time series.

        Each call computes it again, because the beats of thousands of solutions would not fit in memory.
        """
        return certified_beat(self.problem, self.wingbeat, self.certificate)

    def value_of(self, quantity: Quantity, beat: Beat | None = None) -> float:
        """Return a quantity of the certified flight in its unit; for a series, its largest value.

        Whoever asks for several hands over the `beat`, which is else computed again for each.
        """
        if isinstance(quantity, MapQuantity):
            return float(np.max(quantity.of(self.monodromy)))
        return float(np.max(quantity.of(self.beat() if beat is None else beat)))

    @functools.cached_property
    def monodromy(self) -> np.ndarray:
        """Derivative of (body_pitch, u, w, pitch_rate) after a beat by those before it, computed on first use."""
        return monodromy(self.problem.model, self.wingbeat, self.certificate.steps)

    @functools.cached_property
    def multipliers(self) -> np.ndarray:
        """Floquet multipliers, the largest modulus first."""
        return multipliers_of(self.monodromy)


def better_of(own: Solution, other: Solution) -> Solution:
    """Return the better of two solutions of one problem, with the starts, optima and times of both."""
    converged = [s for s in (own, other) if s.status is Status.CONVERGED]
    known = [o for s in (own, other) for o in (s.optima or s.as_optimum())]
    optima = families(known, own.problem.unknowns().scale, own.options.search.same_optimum)
    return dataclasses.replace(
        min(converged, key=lambda s: s.objective, default=own),
        starts=own.starts + other.starts,
        distinct_optima=len(optima),
        optima=optima,
        seed=own.seed,
        seconds=own.seconds + other.seconds,
        certify_seconds=own.certify_seconds + other.certify_seconds,
    )
