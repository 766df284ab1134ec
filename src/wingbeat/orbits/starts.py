"""The solver's starts: one in each family of wingbeats, then seeded random ones within the bounds.

Most starts have a high frequency. A vehicle that beats fast moves little within a beat, so closure is nearly linear
and local searches do not diverge. A vehicle that beats too slowly to stay up is far from any orbit. From a closed
orbit of high frequency, the search lowers the frequency steadily towards its minimum. But where wings are large for
the body, families with little wing pitching exist at low frequencies only, and fast starts miss them.
"""

from __future__ import annotations

import dataclasses
import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat.animal.kinematics import Wingbeat, parameter
from wingbeat.orbits.options import DEFAULTS
from wingbeat.orbits.problem.outputs import value_count
from wingbeat.orbits.problem.quantities import QUANTITIES, Constraint, Frequency
from wingbeat.orbits.problem.quantity import MAP_QUANTITIES, STABLE_RADIUS, MapQuantity
from wingbeat.orbits.search_options import SearchOptions

if TYPE_CHECKING:
    from wingbeat.orbits.problem.problem import OrbitProblem


def start_count(problem: OrbitProblem, starts: int | None = None, options: SearchOptions = DEFAULTS.search) -> int:
    """Return the number of starts as given, or the default of the problem."""
    if starts is not None:
        return starts
    if asks_for_stability(problem):
        return start_count(easier(problem), None, options)
    peaks = value_count(problem.minimise, problem.aero.strips, problem.vehicle.drive, problem.map_states) > 1
    if peaks or problem.has_own_bounds:
        return options.starts_of_many_optima
    if problem.has_outputs and not problem.subject_to and problem.own_frequency:
        return options.starts_at_own_frequency
    return options.starts_of_outputs if problem.has_outputs else options.starts


def optima_lead_within(problem: OrbitProblem) -> bool:
    """Return whether optima without limits lead to the best within them: an output's within plausible ranges."""
    # Optima of the frequency often share its lower bound, so equal values say nothing there.
    return problem.within_plausible and not problem.minimise.parameter and not asks_for_stability(problem)


def starts_within(problem: OrbitProblem, starts: int, options: SearchOptions = DEFAULTS.search) -> int:
    """Return how many of the starts search within the limits from the beginning; all search without them."""
    return min(starts, options.starts_within_ranges) if optima_lead_within(problem) else starts


def usual_most_starts(problem: OrbitProblem, options: SearchOptions = DEFAULTS.search) -> int:
    """Return the default of the largest number of starts, tried while none leads to a certified orbit."""
    return options.most_stable_starts if asks_for_stability(problem) else options.most_starts


def starts_in_words(count: int) -> str:
    """Return how many starts there were."""
    return f"{count} start" if count == 1 else f"{count} starts"


class OwnStart(NamedTuple):
    """A start of the user's own: what it was, its unknowns by name (SI), and what was changed or added.

    `led_here` says whether the search from it ended in the family of the result; None if that is not known.
    """

    kind: str  # orbit, wingbeat, film or numbers
    values: dict[str, float]
    notes: tuple[str, ...] = ()
    led_here: bool | None = None

    def record(self) -> dict[str, Any]:
        """Return the start as plain values for JSON."""
        return {**self._asdict(), "values": dict(self.values), "notes": list(self.notes)}


def start_beside(
    problem: OrbitProblem, best: np.ndarray, index: int, seed: int, options: SearchOptions = DEFAULTS.search
) -> np.ndarray:
    """Return random unknowns near an optimum; they depend on the optimum, index and seed alone."""
    unknowns = problem.unknowns()
    random = np.random.default_rng([seed, index])
    moved = best + options.start_spread * unknowns.scale * random.uniform(-1.0, 1.0, best.size)
    return np.clip(moved, unknowns.lower, unknowns.upper)


def start_point(
    problem: OrbitProblem, index: int, seed: int, options: SearchOptions = DEFAULTS.search
) -> np.ndarray:
    """Return the unknowns of start number `index`; they depend on index and seed alone."""
    unknowns = problem.unknowns()
    given = structured_starts(problem, options)
    if index < len(given):
        return given[index]
    random = np.random.default_rng([seed, index])
    margin = options.random_margin * (unknowns.upper - unknowns.lower)
    point = random.uniform(unknowns.lower + margin, unknowns.upper - margin)
    # The pitch state is near the mean velocity and a moderate attitude.
    point[:4] = given[0][:4] + random.uniform(-np.array(options.random_below), options.random_above)
    if "frequency" in unknowns.names:
        column = unknowns.names.index("frequency")
        slower, faster = options.random_octaves
        point[column] = given[0][column] * 2.0 ** random.uniform(-slower, faster)
    return np.clip(point, unknowns.lower, unknowns.upper)


def structured_starts(problem: OrbitProblem, options: SearchOptions = DEFAULTS.search) -> list[np.ndarray]:
    """Return a start in each family of wingbeats, the species' stock wingbeat first."""
    unknowns, beat = problem.unknowns(), problem.species.wingbeat
    found: list[np.ndarray] = []
    for family in options.start_families:
        wingbeat = {name: parameter(beat, name) for name in problem.free}
        for name in ("frequency", "flap_amplitude"):
            if name in wingbeat:
                wingbeat[name] *= getattr(family, name)
        for name in ("pitch_mean", "pitch_amplitude"):
            if name in wingbeat and (own := getattr(family, name)) is not None:
                wingbeat[name] = own
        if "flap_mean" in wingbeat and family.flap_mean is not None:
            low, high = problem.bounds["flap_mean"]
            wingbeat["flap_mean"] = 0.5 * (low + high + family.flap_mean * (high - low))
        # Tilting the stroke plane turns the body the other way and leaves the wings where they were.
        pitch = family.nose_up + problem.vehicle.wing.stroke_plane_angle + beat.stroke_plane_tilt - 0.5 * math.pi
        start = [pitch, problem.speed, problem.climb, 0.0, *wingbeat.values()]
        start = np.clip(start, unknowns.lower, unknowns.upper)
        if not any(np.array_equal(start, other) for other in found):
            found.append(start)
    return found


def wingbeat_with_all_laws(problem: OrbitProblem, options: SearchOptions = DEFAULTS.search) -> Wingbeat:
    """Return a wingbeat near the first start in which no law with a free parameter is off, as in most optima.

    A law that is off is no part of the programs, so those for the start itself would serve no optimum.
    """
    unknowns, first = problem.unknowns(), start_point(problem, 0, 0, options)
    away = options.random_margin * (unknowns.upper - unknowns.lower)
    return problem.wingbeat(np.where(first + away < unknowns.upper, first + away, first - away))


def minimises_map(problem: OrbitProblem) -> bool:
    """Return whether the objective is a quantity of the stroke map."""
    return isinstance(problem.minimise, MapQuantity)


def asks_for_stability(problem: OrbitProblem) -> bool:
    """Return whether the objective or a limit is a quantity of the stroke map."""
    return minimises_map(problem) or any(isinstance(c.quantity, MapQuantity) for c in problem.subject_to)


def easier(problem: OrbitProblem) -> OrbitProblem:
    """Return the easier problem from whose optima a search for stability starts.

    It has no limits of the stroke map; or if such a quantity is minimised, it asks for the stable orbit of least
    frequency, or of least power if the frequency is fixed.
    """
    if minimises_map(problem):
        stable = Constraint(MAP_QUANTITIES["spectral_radius"], STABLE_RADIUS)
        return dataclasses.replace(plainly(problem), subject_to=(*problem.subject_to, stable))
    others = tuple(c for c in problem.subject_to if not isinstance(c.quantity, MapQuantity))
    return dataclasses.replace(problem, subject_to=others)


def plainly(problem: OrbitProblem) -> OrbitProblem:
    """Return the problem with a smooth objective: the frequency, or a power if that is fixed."""
    objective = Frequency() if "frequency" in problem.free else QUANTITIES["mean_positive_power"]
    return dataclasses.replace(problem, minimise=objective)


def is_at_lower_bound(problem: OrbitProblem, unknowns: np.ndarray, tolerance: float) -> bool:
    """Return whether the frequency is minimised and at its lower bound, so that no start can improve it."""
    if problem.minimise.parameter != "frequency":
        return False
    low, high = problem.bounds["frequency"]
    return problem.frequency(unknowns) - low <= tolerance * (high - low)
