"""One local search: from a start to a periodic orbit of locally least objective."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import lsq_linear, minimize

from wingbeat.orbits.nlp.levenberg_marquardt import least_misses
from wingbeat.orbits.nlp.transcription import AT_BOUND, Transcription
from wingbeat.orbits.problem.problem import CLOSURE_SCALE, PATH_NAMES

# A closure of 1e-4 in the user's units, by its own few steps, is what a search must reach: the last digits come
# when it is corrected.
CLOSED = 1e-4
# Largest residual of the optimality conditions, in the optimiser's scale, that counts as none.
OPTIMAL = 1e-5
# An elastic solve that ends further off than this, in the optimiser's scale, is no lead worth optimising.
_HOPELESS = 1e-3
# Iterations from a neighbour's answer.
_BRIEFLY = 40
# Evaluations of the elastic solve that goes before a search which is expected to be hard.
_APPROACH = 40
# It ends where its squares shrink by less than this share; near closure they shrink by most of themselves.
_APPROACHED = 1e-4
# A search that has not come nearer than this to closure, in the optimiser's scale, after so many flights has gone
# astray: of 376 that met an orbit 2 had not, and an elastic solve may bring those back.
_ASTRAY = 0.3
_PATIENCE = 60


@dataclass(frozen=True)
class Candidate:
    """Where a local search ended, in the optimiser's scale, and the programme with the last flights made."""

    programme: Transcription
    scaled: np.ndarray
    objective: float
    closed: bool
    optimal: bool
    violation: float


def search(problem: Transcription, start: np.ndarray, *, elastic: bool = False) -> Candidate:
    """Search from unknowns `start` with SLSQP; one that stalls is brought nearer to closure and tried once more.

    With `elastic` it is brought nearer before the first try, too. A stall is mostly a spoilt BFGS matrix, or a
    start from which full Newton steps leave the region where the quadratic model means anything.
    """
    scaled = problem.scaled(start)
    closed = optimal = False
    for near in (elastic, True):
        if near:
            scaled = approach(problem, scaled)
            if violation(problem, scaled) > _HOPELESS:
                break
        scaled, optimal = optimise(problem, scaled, patience=_PATIENCE)
        closed = is_closed(problem, scaled)
        # SLSQP also stops where rounding lets it go no further; what counts is whether the conditions hold there.
        optimal = optimal or (closed and optimality(problem, scaled) <= OPTIMAL)
        if closed and optimal:
            break
    return _candidate(problem, scaled, closed, optimal)


def refine(problem: Transcription, start: np.ndarray, iterations: int = _BRIEFLY) -> Candidate:
    """Search once from unknowns that are taken to be near an orbit, and briefly: if they are, that is enough."""
    scaled, optimal = optimise(problem, problem.scaled(start), iterations, patience=_PATIENCE)
    return as_candidate(problem, scaled, optimal)


def as_candidate(problem: Transcription, scaled: np.ndarray, optimal: bool = False) -> Candidate:
    """Judge unknowns in the optimiser's scale; `optimal` is what the search that led to them says of itself."""
    closed = is_closed(problem, scaled)
    return _candidate(problem, scaled, closed, optimal or (closed and optimality(problem, scaled) <= OPTIMAL))


def _candidate(problem: Transcription, scaled: np.ndarray, closed: bool, optimal: bool) -> Candidate:
    objective = problem.objective(scaled) * problem.problem.minimise.scale
    return Candidate(problem, scaled, objective, closed, optimal, violation(problem, scaled))


def violation(problem: Transcription, scaled: np.ndarray) -> float:
    """Return the largest violation of closure and path bound, in the optimiser's scale."""
    pitch = np.maximum(-problem.margins(scaled), 0.0)
    return float(max(np.abs(problem.closure(scaled)).max(), pitch.max()))


def is_closed(problem: Transcription, scaled: np.ndarray) -> bool:
    """Say whether closure and path bound hold to `CLOSED` in the user's units."""
    miss = np.abs(problem.closure(scaled) * CLOSURE_SCALE).max()
    return bool(miss <= CLOSED and problem.margins(scaled).min() >= -CLOSED)


def approach(problem: Transcription, scaled: np.ndarray) -> np.ndarray:
    """Reduce closure and path violation in least squares within the bounds (an elastic solve)."""

    def misses(x: np.ndarray) -> np.ndarray:
        return np.concatenate([problem.closure(x), np.minimum(problem.margins(x), 0.0)])

    def jacobian(x: np.ndarray) -> np.ndarray:
        broken = problem.margins(x)[:, None] < 0
        return np.concatenate([problem.closure_jacobian(x), broken * problem.margins_jacobian(x)])

    return least_misses(misses, jacobian, scaled, problem.lower, problem.upper, _APPROACH, _APPROACHED)


class _AstrayError(Exception):
    """A search that comes to no closure."""


def optimise(
    problem: Transcription,
    scaled: np.ndarray,
    iterations: int = 60,
    tolerance: float = 1e-6,
    patience: int | None = None,
) -> tuple[np.ndarray, bool]:
    """Minimise the objective on closed orbits with SLSQP; return where it ended and whether it converged.

    Parameters
    ----------
    problem : the programme.
    scaled : where to start.
    iterations, tolerance : of SLSQP.
    patience : flights after which one that has gone astray is given up where it was nearest; none if not given.
    """
    nearest, least, flights = scaled, np.inf, 0

    def closure(x: np.ndarray) -> np.ndarray:
        nonlocal nearest, least, flights
        away = violation(problem, x)
        if away < least:
            nearest, least = x.copy(), away
        flights += 1
        if patience is not None and flights >= patience and least > _ASTRAY:
            raise _AstrayError
        return problem.closure(x)

    try:
        found = minimize(
            problem.objective,
            np.clip(scaled, problem.lower, problem.upper),
            jac=problem.objective_gradient,
            bounds=list(zip(problem.lower, problem.upper, strict=True)),
            constraints=[
                {"type": "eq", "fun": closure if patience else problem.closure, "jac": problem.closure_jacobian},
                {"type": "ineq", "fun": problem.margins, "jac": problem.margins_jacobian},
            ],
            method="SLSQP",
            options={"maxiter": iterations, "ftol": tolerance},
        )
    except _AstrayError:
        return np.clip(nearest, problem.lower, problem.upper), False
    return np.clip(found.x, problem.lower, problem.upper), bool(found.status == 0)


def active_bounds(problem: Transcription, scaled: np.ndarray) -> tuple[str, ...]:
    """Return the names of the unknowns at a bound, and of the limits of the whole path, that are met."""
    names = [
        name
        for name, x, lower, upper in zip(problem.unknowns.names, scaled, problem.lower, problem.upper, strict=False)
        if name not in PATH_NAMES and min(x - lower, upper - x) <= AT_BOUND * (upper - lower)
    ]
    margins = problem.margins(scaled)
    path = problem.path_limits
    names += dict.fromkeys(name for (name, _), margin in zip(path, margins, strict=False) if margin <= AT_BOUND)
    if problem.asked is not None:
        names += problem.asked.active_constraints(margins[len(path) :])
    return tuple(names)


def optimality(problem: Transcription, scaled: np.ndarray) -> float:
    """Return the largest residual of the Karush-Kuhn-Tucker conditions, in the optimiser's scale.

    The multipliers are the best in least squares: free for the closure, of the right sign for active bounds.
    """
    closure = problem.closure_jacobian(scaled)
    unit, reach = np.eye(scaled.size), AT_BOUND * (problem.upper - problem.lower)
    bounds = [unit[scaled - problem.lower <= reach], -unit[problem.upper - scaled <= reach]]
    passed = problem.margins_jacobian(scaled)[problem.margins(scaled) <= AT_BOUND]
    gradient, normals = problem.objective_gradient(scaled), np.concatenate([closure, *bounds, passed]).T
    multipliers = np.linalg.lstsq(normals, gradient)[0]
    if (multipliers[len(closure) :] < 0).any():
        least = np.repeat([-np.inf, 0.0], [len(closure), multipliers.size - len(closure)])
        with np.errstate(invalid="ignore"):  # where it multiplies nothing with infinity
            multipliers = lsq_linear(normals, gradient, bounds=(least, np.inf)).x
    return float(np.abs(normals @ multipliers - gradient).max())
