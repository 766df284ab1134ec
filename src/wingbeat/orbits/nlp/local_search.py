"""One local search: from a start to a periodic orbit that minimises the objective locally."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from scipy.optimize import lsq_linear, minimize

from wingbeat.orbits.nlp.levenberg_marquardt import least_squares
from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.orbits.problem.problem import CLOSURE_SCALE, PATH_NAMES


class Programme(Protocol):
    """The interface of a nonlinear programme in scaled unknowns, as SLSQP needs it."""

    lower: np.ndarray
    upper: np.ndarray

    def closure(self, scaled: np.ndarray) -> np.ndarray:
        """Return the equality constraints, which must vanish."""
        ...

    def closure_jacobian(self, scaled: np.ndarray) -> np.ndarray:
        """Return the derivative of the equality constraints with respect to the scaled unknowns."""
        ...

    def inequalities(self, scaled: np.ndarray) -> np.ndarray:
        """Return the inequality constraints, which must not be negative."""
        ...

    def inequalities_jacobian(self, scaled: np.ndarray) -> np.ndarray:
        """Return the derivative of the inequality constraints with respect to the scaled unknowns."""
        ...

    def objective(self, scaled: np.ndarray) -> float:
        """Return the value that is minimised."""
        ...

    def objective_gradient(self, scaled: np.ndarray) -> np.ndarray:
        """Return the derivative of the minimised value with respect to the scaled unknowns."""
        ...


@dataclass(frozen=True)
class Candidate:
    """The result of a local search.

    Parameters
    ----------
    programme : the nonlinear programme that was searched; it caches the last flights.
    scaled : the unknowns where the search ended, in the optimiser's scale.
    objective : the minimised quantity there, in its own unit.
    closed : whether closure and inequalities hold there.
    optimal : whether the optimality conditions hold there, or the optimiser converged.
    violation : largest violation of closure and inequalities there, in the optimiser's scale.
    """

    programme: Transcription
    scaled: np.ndarray
    objective: float
    closed: bool
    optimal: bool
    violation: float

    @property
    def is_optimum(self) -> bool:
        """Whether the candidate is closed and optimal, by the solver's coarse flight."""
        return self.closed and self.optimal


def search(programme: Transcription, start: np.ndarray, *, restore: bool = False) -> Candidate:
    """Search from unknowns with SLSQP; if it stalls, restore closure and search once more.

    With `restore`, closure is restored before the first search too. Most stalls come from a poor BFGS matrix, or
    from a start whose full Newton steps leave the region where the quadratic model is valid.
    """
    options = programme.options.search
    scaled = programme.scaled(start)
    closed = optimal = False
    for near in (restore, True):
        if near:
            scaled = restore_feasibility(programme, scaled)
            if violation(programme, scaled) > options.restored_closure:
                break
        scaled, optimal = optimise(programme, scaled, options.iterations, options.tolerance, Patience.of(programme))
        closed = is_closed(programme, scaled, options.closure_tolerance)
        # SLSQP also stops where rounding prevents progress; what counts is whether the conditions hold there.
        optimal = optimal or (closed and is_optimal(programme, scaled))
        if closed and optimal:
            break
    return _candidate(programme, scaled, closed, optimal)


def refine(programme: Transcription, start: np.ndarray, iterations: int | None = None) -> Candidate:
    """Run one short local search from unknowns that are assumed to be near an orbit."""
    options = programme.options.search
    scaled, optimal = optimise(
        programme,
        programme.scaled(start),
        options.local_iterations if iterations is None else iterations,
        options.tolerance,
        Patience.of(programme),
    )
    return as_candidate(programme, scaled, optimal)


def as_candidate(programme: Transcription, scaled: np.ndarray, optimal: bool = False) -> Candidate:
    """Return unknowns as a candidate; `optimal` says whether the search that led to them converged."""
    closed = is_closed(programme, scaled, programme.options.search.closure_tolerance)
    return _candidate(programme, scaled, closed, optimal or (closed and is_optimal(programme, scaled)))


def _candidate(programme: Transcription, scaled: np.ndarray, closed: bool, optimal: bool) -> Candidate:
    objective = programme.objective(scaled) * programme.problem.minimise.scale
    return Candidate(programme, scaled, objective, closed, optimal, violation(programme, scaled))


def violation(programme: Programme, scaled: np.ndarray) -> float:
    """Return the largest violation of closure and inequalities, in the optimiser's scale."""
    exceeded = np.maximum(-programme.inequalities(scaled), 0.0)
    return float(max(np.abs(programme.closure(scaled)).max(), exceeded.max()))


def is_closed(programme: Programme, scaled: np.ndarray, tolerance: float) -> bool:
    """Return whether closure and inequalities hold, to a tolerance in the user's units."""
    residual = np.abs(programme.closure(scaled) * CLOSURE_SCALE).max()
    return bool(residual <= tolerance and programme.inequalities(scaled).min() >= -tolerance)


def is_optimal(programme: Transcription, scaled: np.ndarray) -> bool:
    """Return whether the optimality conditions hold."""
    return optimality(programme, scaled) <= programme.options.search.optimality_tolerance


def restore_feasibility(programme: Transcription, scaled: np.ndarray) -> np.ndarray:
    """Reduce the violation of closure and inequalities in least squares within the bounds (an elastic solve)."""

    def residuals(x: np.ndarray) -> np.ndarray:
        return np.concatenate([programme.closure(x), np.minimum(programme.inequalities(x), 0.0)])

    def jacobian(x: np.ndarray) -> np.ndarray:
        exceeded = programme.inequalities(x)[:, None] < 0
        return np.concatenate([programme.closure_jacobian(x), exceeded * programme.inequalities_jacobian(x)])

    options = programme.options.search.restoration
    return least_squares(residuals, jacobian, scaled, programme.lower, programme.upper, options)


@dataclass(frozen=True)
class Patience:
    """A search counts as diverged if, after `flights` flights, its least violation still exceeds `closure`."""

    flights: int
    closure: float

    @classmethod
    def of(cls, programme: Transcription) -> Patience:
        """Return the rule for divergence with the two limits in the options of `programme`."""
        options = programme.options.search
        return cls(options.diverged_flights, options.diverged_closure)


class _DivergedError(Exception):
    """A local search has diverged."""


def optimise(
    programme: Programme,
    scaled: np.ndarray,
    iterations: int,
    tolerance: float,
    patience: Patience | None = None,
) -> tuple[np.ndarray, bool]:
    """Minimise the objective over closed orbits with SLSQP; return where SLSQP ended and whether it converged.

    Parameters
    ----------
    programme : the programme.
    scaled : where to start.
    iterations, tolerance : of SLSQP.
    patience : says when a local search has diverged. The search then ends where its violation was least. Without
        `patience`, no search counts as diverged.
    """
    nearest, least, flights = scaled, np.inf, 0

    def closure(x: np.ndarray) -> np.ndarray:
        nonlocal nearest, least, flights
        away = violation(programme, x)
        if away < least:
            nearest, least = x.copy(), away
        flights += 1
        if patience is not None and flights >= patience.flights and least > patience.closure:
            raise _DivergedError
        return programme.closure(x)

    try:
        found = minimize(
            programme.objective,
            np.clip(scaled, programme.lower, programme.upper),
            jac=programme.objective_gradient,
            bounds=list(zip(programme.lower, programme.upper, strict=True)),
            constraints=[
                {
                    "type": "eq",
                    "fun": closure if patience else programme.closure,
                    "jac": programme.closure_jacobian,
                },
                {"type": "ineq", "fun": programme.inequalities, "jac": programme.inequalities_jacobian},
            ],
            method="SLSQP",
            options={"maxiter": iterations, "ftol": tolerance},
        )
    except _DivergedError:
        return np.clip(nearest, programme.lower, programme.upper), False
    return np.clip(found.x, programme.lower, programme.upper), bool(found.status == 0)


def active_bounds(programme: Transcription, scaled: np.ndarray) -> tuple[str, ...]:
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
        names += programme.outputs.active_constraints(active[len(path) :])
    return tuple(names)


def optimality(programme: Transcription, scaled: np.ndarray) -> float:
    """Return the largest residual of the Karush-Kuhn-Tucker conditions, in the optimiser's scale.

    The multipliers are those that fit best in least squares. Multipliers of the closure are free; those of active
    bounds have the right sign.

    Theory: equation ``optimality-conditions``.
    """
    tolerance = programme.options.search.bound_tolerance
    closure = programme.closure_jacobian(scaled)
    unit, reach = np.eye(scaled.size), tolerance * (programme.upper - programme.lower)
    bounds = [unit[scaled - programme.lower <= reach], -unit[programme.upper - scaled <= reach]]
    active = programme.inequalities_jacobian(scaled)[programme.inequalities(scaled) <= tolerance]
    gradient, normals = programme.objective_gradient(scaled), np.concatenate([closure, *bounds, active]).T
    multipliers = np.linalg.lstsq(normals, gradient)[0]
    if (multipliers[len(closure) :] < 0).any():
        least = np.repeat([-np.inf, 0.0], [len(closure), multipliers.size - len(closure)])
        with np.errstate(invalid="ignore"):  # it multiplies zero by infinity
            multipliers = lsq_linear(normals, gradient, bounds=(least, np.inf)).x
    return float(np.abs(normals @ multipliers - gradient).max())
