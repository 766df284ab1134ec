"""A nonlinear programme in scaled unknowns, its search by SLSQP, and the steps of that search."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from scipy.optimize import minimize

from wingbeat.orbits.flight.period import CLOSURE_SCALE
from wingbeat.orbits.nlp.levenberg_marquardt import Values
from wingbeat.orbits.search_options import SearchOptions


class Step(NamedTuple):
    """One iterate of a solver, in the optimiser's scale: where it was made, objective, violation, largest step."""

    stage: str
    iteration: int
    objective: float
    residual: float
    step: float


class _DivergedError(Exception):
    """A local search has diverged."""


class Programme:
    """A nonlinear programme in scaled unknowns: least objective, closure 0, no negative inequality."""

    lower: np.ndarray
    upper: np.ndarray
    closure: Values
    closure_jacobian: Values
    inequalities: Values
    inequalities_jacobian: Values
    objective: Callable[[np.ndarray], float]
    objective_gradient: Values
    # Where the iterates of this programme's searches are noted, if at all.
    steps: list[Step] | None = None

    def noting(self, stage: str) -> Callable[[np.ndarray], None] | None:
        """Return a function that notes each iterate it is called with, or None if nobody asked for the steps."""
        steps, before = self.steps, np.zeros(0)
        if steps is None:
            return None

        def note(scaled: np.ndarray) -> None:
            nonlocal before
            first = before.size == 0
            moved = 0.0 if first else float(np.abs(scaled - before).max())
            count = 0 if first else steps[-1].iteration + 1
            steps.append(Step(stage, count, self.objective(scaled), self.violation(scaled), moved))
            before = scaled.copy()

        return note

    def violation(self, scaled: np.ndarray) -> float:
        """Return the largest violation of closure and inequalities, in the optimiser's scale."""
        exceeded = np.maximum(-self.inequalities(scaled), 0.0)
        return float(max(np.abs(self.closure(scaled)).max(), exceeded.max()))

    def is_closed(self, scaled: np.ndarray, tolerance: float) -> bool:
        """Return whether closure and inequalities hold, to a tolerance in the user's units."""
        residual = np.abs(self.closure(scaled) * CLOSURE_SCALE).max()
        return bool(residual <= tolerance and self.inequalities(scaled).min() >= -tolerance)

    def optimise(
        self,
        scaled: np.ndarray,
        iterations: int,
        tolerance: float,
        patience: SearchOptions | None = None,
        stage: str = "search",
    ) -> tuple[np.ndarray, bool]:
        """Minimise the objective over closed orbits with SLSQP; return where it ended and whether it converged.

        With `patience`, a search that diverges by its options ends where its violation was least.
        """
        nearest, least, flights = scaled, np.inf, 0

        def closure(x: np.ndarray) -> np.ndarray:
            nonlocal nearest, least, flights
            away = self.violation(x)
            if away < least:
                nearest, least = x.copy(), away
            flights += 1
            if patience and flights >= patience.diverged_flights and least > patience.diverged_closure:
                raise _DivergedError
            return self.closure(x)

        equal = {"type": "eq", "fun": closure if patience else self.closure, "jac": self.closure_jacobian}
        within = {"type": "ineq", "fun": self.inequalities, "jac": self.inequalities_jacobian}
        try:
            start, bounds = np.clip(scaled, self.lower, self.upper), list(zip(self.lower, self.upper, strict=True))
            how = {"method": "SLSQP", "options": {"maxiter": iterations, "ftol": tolerance}}
            limits = {"bounds": bounds, "constraints": [equal, within]}
            if (note := self.noting(stage)) is not None:
                note(start)
                how["callback"] = note
            found = minimize(self.objective, start, jac=self.objective_gradient, **limits, **how)
        except _DivergedError:
            return np.clip(nearest, self.lower, self.upper), False
        return np.clip(found.x, self.lower, self.upper), bool(found.status == 0)
