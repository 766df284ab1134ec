"""Problems that ask for stability, and the easier problems whose optima their searches start from."""

from __future__ import annotations

import dataclasses

from wingbeat.orbits.problem.limits import Constraint
from wingbeat.orbits.problem.map_quantities import MAP_QUANTITIES, STABLE_RADIUS, MapQuantity
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.problem.quantities import QUANTITIES, Frequency


def minimises_map(problem: OrbitProblem) -> bool:
    """Return whether the objective is a quantity of the stroke map."""
    return isinstance(problem.minimise, MapQuantity)


def asks_for_stability(problem: OrbitProblem) -> bool:
    """Return whether the objective or a limit is a quantity of the stroke map."""
    return minimises_map(problem) or any(isinstance(c.quantity, MapQuantity) for c in problem.subject_to)


def easier(problem: OrbitProblem) -> OrbitProblem:
    """Return the problem whose optima a search for stability starts from.

    It has no limits of the stroke map. If a quantity of the stroke map is minimised, it is the problem of the
    stable orbit of least frequency instead, or of least power if the frequency is fixed.
    """
    if minimises_map(problem):
        objective = Frequency() if "frequency" in problem.free else QUANTITIES["mean_positive_power"]
        stable = Constraint(MAP_QUANTITIES["spectral_radius"], STABLE_RADIUS)
        return dataclasses.replace(problem, minimise=objective, subject_to=(*problem.subject_to, stable))
    others = tuple(c for c in problem.subject_to if not isinstance(c.quantity, MapQuantity))
    return dataclasses.replace(problem, subject_to=others)
