"""Honest warnings: where an orbit leans on a guess, or leaves what the model was fitted to."""

from __future__ import annotations

import math

import numpy as np

from wingbeat.loads import Loads
from wingbeat.orbits.solution import Solution
from wingbeat.vehicle import Air, Vehicle

# Hover's induced velocity is felt up to about three times that speed: there the wake bends alpha by some 10 %.
_SLOW = 3.0
_MENTION = 0.01


def orbit_warnings(solution: Solution, found: Loads) -> list[str]:
    """Return everything a reader should know before trusting an orbit."""
    problem = solution.problem
    air = problem.air
    notes = list(problem.species.warnings)
    notes += induced_flow(problem.vehicle, air, math.hypot(problem.speed, problem.climb))
    notes += fitted_range(solution, found)
    for name in solution.active_bounds:
        if name in problem.species.guessed_bounds:
            notes.append(f"the optimum leans on the bound of {name}, which is a guess: see the species file")
        if name in ("u", "w", "pitch_rate"):
            notes.append(f"the start's {name} met the limit of the search; distrust this orbit")
    if solution.distinct_optima > 1:
        notes.append(
            f"{solution.distinct_optima} distinct optima were met in {solution.starts} searches; "
            "this is the best of them, not proven the best of all"
        )
    return notes


def induced_flow(vehicle: Vehicle, air: Air, speed: float) -> list[str]:
    """Warn where the missing induced flow matters, by the momentum theory of a hovering actuator disc."""
    disc = math.pi * vehicle.wing.semi_span**2
    induced = math.sqrt(vehicle.mass * air.gravity / (2.0 * air.density * disc))
    if speed >= _SLOW * induced:
        return []
    return [
        f"no induced flow is modelled: at {speed:.1f} m/s, below {_SLOW * induced:.1f} m/s (three times the "
        "induced velocity of hover), power is understated"
    ]


def fitted_range(solution: Solution, found: Loads) -> list[str]:
    """Warn of the share of the beat, over all strips, outside the coefficients' Reynolds and alpha range."""
    problem = solution.problem
    coefficients = problem.aero.coefficients
    notes = []
    if coefficients.reynolds_range is not None:
        reynolds = found.strip_reynolds
        low, high = coefficients.reynolds_range
        share = _outside(reynolds, low, high)
        if share > _MENTION:
            notes.append(
                f"Reynolds number outside the fitted {low:g} to {high:g} for {share:.0%} of the beat "
                f"(it runs from {reynolds.min():.0f} to {reynolds.max():.0f})"
            )
    low, high = np.radians(coefficients.alpha_range_deg)
    share = _outside(found.alpha, low, high)
    if share > _MENTION:
        notes.append(
            f"angle of attack outside the fitted {math.degrees(low):g} to {math.degrees(high):g} degrees for "
            f"{share:.0%} of the beat: there the extension '{coefficients.extension}' decides"
        )
    return notes


def _outside(values: np.ndarray, low: float, high: float) -> float:
    return float(np.mean((values < low) | (values > high)))
