"""One local search: from a start to a periodic orbit of locally least objective."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from scipy.optimize import lsq_linear, minimize

from wingbeat.orbits.nlp.levenberg_marquardt import least_squares
from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.orbits.problem.problem import CLOSURE_SCALE, PATH_NAMES


class Programme(Protocol):
    """A nonlinear programme in scaled unknowns, as SLSQP wants it."""

    lower: np.ndarray
    upper: np.ndarray

    def closure(self, scaled: np.ndarray) -> np.ndarray:
        """Return what must vanish."""
        ...

    def closure_jacobian(self, scaled: np.ndarray) -> np.ndarray:
        """Return its derivative."""
        ...

    def inequalities(self, scaled: np.ndarray) -> np.ndarray:
        """Return what must not be negative."""
        ...

    def inequalities_jacobian(self, scaled: np.ndarray) -> np.ndarray:
        """Return its derivative."""
        ...

    def objective(self, scaled: np.ndarray) -> float:
        """Return what is minimised."""
        ...

    def objective_gradient(self, scaled: np.ndarray) -> np.ndarray:
        """Return its derivative."""
        ...


@dataclass(frozen=True)
class Candidate:
    """Where a local search ended, in the optimiser's scale, and the programme with the last flights made."""

    programme: Transcription
    scaled: np.ndarray
    objective: float
    closed: bool
    optimal: bool
    violation: float

    @property
    def is_optimum(self) -> bool:
        """Whether it is closed and optimal, as far as the search's few steps tell."""
        return self.closed and self.optimal


def search(programme: Transcription, start: np.ndarray, *, restore: bool = False) -> Candidate:
    """Search from unknowns `start` with SLSQP; one that stalls is brought nearer to closure and tried once more.

    With `restore` it is brought nearer before the first try, too. A stall is mostly a spoilt BFGS matrix, or a
    start from which full Newton steps leave the region where the quadratic model means anything.
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
        # SLSQP also stops where rounding lets it go no further; what counts is whether the conditions hold there.
        optimal = optimal or (closed and is_optimal(programme, scaled))
        if closed and optimal:
            break
    return _candidate(programme, scaled, closed, optimal)


def refine(programme: Transcription, start: np.ndarray, iterations: int | None = None) -> Candidate:
    """Search once from unknowns that are taken to be near an orbit, and briefly: if they are, that is enough."""
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
    """Judge unknowns in the optimiser's scale; `optimal` is what the search that led to them says of itself."""
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
    """Say whether closure and inequalities hold, to a tolerance in the user's units."""
    residual = np.abs(programme.closure(scaled) * CLOSURE_SCALE).max()
    return bool(residual <= tolerance and programme.inequalities(scaled).min() >= -tolerance)


def is_optimal(programme: Transcription, scaled: np.ndarray) -> bool:
    """Say whether the optimality conditions hold."""
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
    """A search has diverged if it is farther than this from closure after so many flights."""

    flights: int
    closure: float

    @classmethod
    def of(cls, programme: Transcription) -> Patience:
        """Return that of the options of a programme."""
        options = programme.options.search
        return cls(options.diverged_flights, options.diverged_closure)


class _DivergedError(Exception):
    """A search that comes to no closure."""


def optimise(
    programme: Programme,
    scaled: np.ndarray,
    iterations: int,
    tolerance: float,
    patience: Patience | None = None,
) -> tuple[np.ndarray, bool]:
    """Minimise the objective on closed orbits with SLSQP; return where it ended and whether it converged.

    Parameters
    ----------
    programme : the programme.
    scaled : where to start.
    iterations, tolerance : of SLSQP.
    patience : a search that has diverged is given up where it was nearest to closure; none if not given.
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
    """Return the names of the unknowns at a bound, and of the limits of the whole path that are active."""
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

    The multipliers are the best in least squares: free for the closure, of the right sign for active bounds.
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
        with np.errstate(invalid="ignore"):  # where it multiplies nothing with infinity
            multipliers = lsq_linear(normals, gradient, bounds=(least, np.inf)).x
    return float(np.abs(normals @ multipliers - gradient).max())
