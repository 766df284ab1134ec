"""Problems that ask for stability, and the easier problems that are solved before them."""

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
    """Return the easier problem that is solved first; a search for stability starts from its optima.

    If the objective is a quantity of the stroke map, the easier problem asks for the stable orbit of least
    frequency, or of least power if the frequency is fixed. Otherwise, the easier problem is the same problem
    without limits of the stroke map.
    """
    if minimises_map(problem):
        objective = Frequency() if "frequency" in problem.free else QUANTITIES["mean_positive_power"]
        stable = Constraint(MAP_QUANTITIES["spectral_radius"], STABLE_RADIUS)
        return dataclasses.replace(problem, minimise=objective, subject_to=(*problem.subject_to, stable))
    others = tuple(c for c in problem.subject_to if not isinstance(c.quantity, MapQuantity))
    return dataclasses.replace(problem, subject_to=others)
