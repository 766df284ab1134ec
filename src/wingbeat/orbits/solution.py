"""What the solver found and how it ended, and orbits found next to a known one by correction or a short search."""

from __future__ import annotations

import dataclasses
import functools
import re
import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from wingbeat.animal.kinematics import Wingbeat, parameter
from wingbeat.orbits.flight.beat import Beat
from wingbeat.orbits.flight.certificate import Certificate, monodromy, multipliers_of
from wingbeat.orbits.flight.period import CLOSURE, PATH_NAMES
from wingbeat.orbits.nlp.newton_kkt import (
    Corrected,
    NewtonKKT,
    ReducedHessian,
    first_certified,
    follow_to_certificate,
    size,
)
from wingbeat.orbits.nlp.programme import Step
from wingbeat.orbits.nlp.transcription import Candidate, Transcription, certified_beat, refine
from wingbeat.orbits.options import DEFAULTS, SolverOptions, Status
from wingbeat.orbits.problem.quantity import MapQuantity, Quantity
from wingbeat.orbits.starts import OwnStart, is_at_lower_bound

if TYPE_CHECKING:
    from wingbeat.orbits.changes import Relaxation
    from wingbeat.orbits.deficit import Deficit
    from wingbeat.orbits.diagnosis import Ending
    from wingbeat.orbits.problem.problem import OrbitProblem


class Optimum(NamedTuple):
    """The best uncorrected optimum of a family: the objective, the unknowns, and how many starts ended there."""

    objective: float
    unknowns: np.ndarray
    starts: int = 1


def families(optima: Iterable[Optimum], scale: np.ndarray, apart: float) -> tuple[Optimum, ...]:
    """Return the best optimum of each family, best first, with the number of starts that ended in it.

    Those closer to one another than `apart`, in the optimiser's scale, are of one family.
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


def at_orbit(optima: Sequence[Optimum], unknowns: np.ndarray, scale: np.ndarray, apart: float) -> list[Optimum]:
    """Return the optima that are of the family of a certified orbit: all that are near, or else the nearest."""
    away = [float(np.abs((optimum.unknowns - unknowns) / scale).max()) for optimum in optima]
    return [one for one, far in zip(optima, away, strict=True) if far <= max(apart, min(away, default=apart))]


def place_of(problem: OrbitProblem, unknowns: np.ndarray) -> np.ndarray:
    """Return unknowns in the optimiser's scale, without the mean velocity, to compare orbits at two speeds."""
    drift = np.zeros(unknowns.size)
    drift[1:3] = problem.speed, problem.climb
    return (unknowns - drift) / problem.unknowns().scale


@dataclass(frozen=True)
class Solution:
    """What the solver found: wingbeat and initial state of the best orbit, and how far the orbit can be trusted.

    Without an orbit, they are those of the closest wingbeat; `deficits` of the balances that fail have the largest
    first, `relaxations` with which an orbit exists the smallest. `free_objective` is without limits of stability.
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
    # Only if they were asked for: the user's own start, and the steps of each search with its number.
    start: OwnStart | None = None
    steps: tuple[tuple[int, Step], ...] | None = None

    @property
    def starts_at_best(self) -> int:
        """How many starts ended in the family of this optimum."""
        if self.status is not Status.CONVERGED:
            return 0
        place = self.unknowns, self.problem.unknowns().scale, self.options.search.same_optimum
        return max(sum(o.starts for o in at_orbit(self.optima, *place)), 1)

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
        """The unknowns as `place_of` returns them."""
        return place_of(self.problem, self.unknowns)

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
        """Return the certified beat as time series."""
        # Computed anew in each call, because the beats of thousands of solutions would not fit in memory.
        return certified_beat(self.problem, self.wingbeat, self.certificate)

    def value_of(self, quantity: Quantity, beat: Beat | None = None) -> float:
        """Return a quantity of the certified flight, whose `beat` may be given; for a series, its largest value."""
        if quantity.parameter in self.problem.free:
            return float(parameter(self.wingbeat, quantity.parameter))
        if isinstance(quantity, MapQuantity):
            return float(np.max(quantity.of(self.monodromy)))
        return float(np.max(quantity.of(self.beat() if beat is None else beat)))

    @functools.cached_property
    def monodromy(self) -> np.ndarray:
        """Derivative of the pitch state, and of a wake that lags, after a beat by that before it; kept."""
        return monodromy(self.problem.model, self.wingbeat, self.certificate.steps)

    @functools.cached_property
    def multipliers(self) -> np.ndarray:
        """Floquet multipliers, the largest modulus first."""
        return multipliers_of(self.monodromy)


def better_of(own: Solution, other: Solution) -> Solution:
    """Return the better of two solutions of one problem, with the starts, optima and times of both."""
    converged = [s for s in (own, other) if s.status is Status.CONVERGED]
    known = [o for s in (own, other) for o in (s.optima or s.as_optimum())]
    best = min(converged, key=lambda s: s.objective, default=own)
    place = own.problem.unknowns().scale, own.options.search.same_optimum
    optima = families(known, *place)
    return dataclasses.replace(
        best,
        starts=own.starts + other.starts,
        distinct_optima=len(optima) - max(len(at_orbit(optima, best.unknowns, *place)) - 1, 0),
        optima=optima,
        seed=own.seed,
        seconds=own.seconds + other.seconds,
        certify_seconds=own.certify_seconds + other.certify_seconds,
    )


# --- From the solver to a solution. ---


def optima_of(candidates: Iterable[Candidate]) -> tuple[Optimum, ...]:
    """Return the optima among the candidates, in SI, the best first."""
    return tuple(Optimum(c.objective, c.programme.physical(c.scaled)) for c in optimal(candidates))


def optimal(candidates: Iterable[Candidate]) -> list[Candidate]:
    """Return the candidates that are optima, the best first."""
    return sorted((c for c in candidates if c.is_optimum), key=lambda c: c.objective)


def solution_of(
    best: Corrected,
    programme: Transcription,
    begun: float,
    found: Iterable[Candidate] = (),
    searches: int = 1,
    seed: int = 0,
    ending: Ending | None = None,
) -> Solution:
    """Return what the solver found since `begun` [s]; without an `ending`, the orbit is certified."""
    seconds, certifying = time.perf_counter() - begun, sum(programme.certifying)
    search = programme.options.search
    place = programme.problem.unknowns().scale, search.same_optimum
    optima = families(optima_of(found), *place)
    distinct = len(optima)
    if ending is None:
        here = at_orbit(optima, best.programme.physical(best.scaled), *place)
        distinct = max(distinct + 1 - len(here), 1)
        status, message = Status.CONVERGED, f"certified: re-flown, it closes to {size(best.residual):.0e}"
        problem = best.programme.problem
        if is_at_lower_bound(problem, best.programme.physical(best.scaled), search.bound_tolerance):
            low = problem.bounds["frequency"][0]
            message += f"; the frequency is at its lower bound of {low:g} Hz, so more starts cannot improve it"
    else:
        status, message = ending.status, ending.message
    return Solution(
        problem=best.programme.problem,
        status=status,
        message=message,
        wingbeat=best.wingbeat,
        certificate=best.certificate,
        closure=dict(zip(CLOSURE, (float(v) for v in best.residual), strict=True)),
        active_bounds=_active_bounds(best.programme, best.scaled),
        optimality=best.optimality,
        starts=searches,
        distinct_optima=distinct,
        seed=seed,
        seconds=seconds,
        certify_seconds=certifying,
        optima=optima,
        deficits=() if ending is None else ending.deficits,
        relaxations=() if ending is None else ending.relaxations,
        reduced_hessian=best.reduced_hessian,
        options=best.programme.options,
    )


def _active_bounds(programme: Transcription, scaled: np.ndarray) -> tuple[str, ...]:
    """Return the names of the unknowns at a bound, of the active path limits and of the active constraints."""
    tolerance = programme.options.search.bound_tolerance
    unknowns = zip(programme.unknowns.names, scaled, programme.lower, programme.upper, strict=False)
    names = [
        name
        for name, x, lower, upper in unknowns
        if name not in PATH_NAMES and min(x - lower, upper - x) <= tolerance * (upper - lower)
    ]
    active = programme.inequalities(scaled) <= tolerance
    path = programme.path_limits
    names += dict.fromkeys(name for (name, _), on in zip(path, active, strict=False) if on)
    if programme.outputs is not None:
        names += [str(programme.problem.subject_to[i]) for i in programme.outputs.with_active(active[len(path) :])]
    return tuple(names)


def correct_guess(
    problem: OrbitProblem, guess: np.ndarray, like: ReducedHessian | None = None, options: SolverOptions = DEFAULTS
) -> Solution | None:
    """Return the certified orbit next to a guess of the unknowns, by correction without a local search, or None.

    `like` is the curvature at the optimum of a similar problem.
    """
    begun = time.perf_counter()
    programme = Transcription(problem, options)
    scaled = programme.scaled(guess)
    if programme.violation(scaled) > options.continuation.near_closure:
        return None
    newton = NewtonKKT(programme, scaled, like)
    nearer = newton.approach(programme, scaled, options.certificate.linear_range)
    corrected = None if nearer is None else follow_to_certificate(programme, newton, nearer)
    if corrected is None or not corrected.is_orbit():
        return None
    return solution_of(corrected, programme, begun)


def search_near(
    problem: OrbitProblem, start: np.ndarray, below: float = np.inf, options: SolverOptions = DEFAULTS
) -> Solution | None:
    """Return the orbit that one local search from near it leads to, or None unless its objective is `below`."""
    begun = time.perf_counter()
    candidate = refine(Transcription(problem, options), start)
    if not (candidate.is_optimum and candidate.objective < below):
        return None
    found = certified_optimum(candidate, time.perf_counter() - begun)
    # The certifier moves the orbit and may raise its objective: whoever repeats this until nothing improves would
    # never end.
    return found if found is not None and found.objective < below else None


def certified_optimum(candidate: Candidate, seconds: float) -> Solution | None:
    """Certify where a local search ended, or return None; `seconds` is the time that the search took."""
    begun = time.perf_counter() - seconds
    programme = candidate.programme.uncorrected()
    best = first_certified(programme, [candidate])
    return None if best is None else solution_of(best, programme, begun)
