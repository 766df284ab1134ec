"""Where searches start: a wingbeat of each family there is, then seeded random ones within the bounds.

All start from brisk wingbeats. A vehicle that beats fast moves little within a beat, so closure is nearly linear
there and its searches do not stray; one that beats too slowly to stay up has no orbit near. From a closed orbit of
high frequency the way to least frequency is downhill.
"""

from __future__ import annotations

import math

import numpy as np

from wingbeat.kinematics import parameter
from wingbeat.orbits.problem import OrbitProblem

# Times the stock frequency. From 2 to 4 every pigeon and nearly every bat of +-30 % was found in one search; at 1 a
# third of the bats strayed, and took three times the flights.
_BRISK = 2.5
# The families beside the stock wingbeat: flap mean in shares of half its range from the middle of its bounds, pitch
# in radians. _MEASURED_
_QUIET, _PITCHING = math.radians(3.0), math.radians(15.0)
_FAMILIES: tuple[dict[str, float], ...] = (
    {"flap_mean": -0.8, "pitch_mean": 0.0, "pitch_amplitude": _QUIET},
    {"flap_mean": 0.8, "pitch_mean": 0.0, "pitch_amplitude": _QUIET},
    {"flap_mean": -0.8, "pitch_amplitude": _PITCHING},
)
# Searches made if nothing is said. What is read off the beat has more optima than the frequency: 6 searches
# missed the bat's least frequency within a limit of its power at 10 m/s by half, 12 did not. Least peaks have the
# most: of 30 random starts 4 led to the bat's least peak pitch torque at 14 m/s, which 12 searches missed by half.
# Bounds of the user's own may cut off where most searches end: with a flap amplitude of 50 deg at most 12 missed
# the bat's least frequency at 10 m/s by 3 %, 24 did not.
_USUAL, _OF_THE_BEAT, _MANY = 6, 12, 24
# How far from the best optimum met those searches start that look for better ones near, in the optimiser's scale.
_BESIDE = 0.5


def usual_starts(problem: OrbitProblem) -> int:
    """Return how many searches are made for a problem if nothing is said."""
    if problem.lowers_peaks or problem.has_own_bounds:
        return _MANY
    return _OF_THE_BEAT if problem.reads_beat else _USUAL


def start_beside(problem: OrbitProblem, best: np.ndarray, index: int, seed: int) -> np.ndarray:
    """Return unknowns near those of an optimum; they depend on it, index and seed alone."""
    unknowns = problem.unknowns()
    random = np.random.default_rng([seed, index])
    moved = best + _BESIDE * unknowns.scale * random.uniform(-1.0, 1.0, best.size)
    return np.clip(moved, unknowns.lower, unknowns.upper)


def start_point(problem: OrbitProblem, index: int, seed: int) -> np.ndarray:
    """Return the unknowns that search number `index` starts from; it depends on index and seed alone."""
    unknowns = problem.unknowns()
    given = structured_starts(problem)
    if index < len(given):
        return given[index]
    random = np.random.default_rng([seed, index])
    point = random.uniform(
        unknowns.lower + 0.1 * (unknowns.upper - unknowns.lower),
        unknowns.upper - 0.1 * (unknowns.upper - unknowns.lower),
    )
    # Near the mean velocity and a moderate attitude; frequencies spread over two octaves.
    point[:4] = given[0][:4] + random.uniform([-0.2, -0.5, -1.0, -2.0], [0.3, 0.5, 1.0, 2.0])
    if "frequency" in unknowns.names:
        column = unknowns.names.index("frequency")
        point[column] = given[0][column] * 2.0 ** random.uniform(-1.2, 0.8)
    return np.clip(point, unknowns.lower, unknowns.upper)


def structured_starts(problem: OrbitProblem) -> list[np.ndarray]:
    """Return a start in each family of wingbeats, the species' stock wingbeat first.

    Optima beat with the wings below, above or about level with the body, and with little or much pitching.
    """
    unknowns, beat = problem.unknowns(), problem.species.wingbeat
    stock = {name: parameter(beat, name) for name in problem.free}
    if "frequency" in stock:
        stock["frequency"] *= _BRISK
    # Turning the stroke plane turns the body the other way and leaves the wings where they were.
    pitch = 0.1 + problem.vehicle.wing.stroke_plane_angle + beat.stroke_plane_tilt - 0.5 * math.pi
    state = [pitch, problem.speed, problem.climb, 0.0]
    found = []
    for family in ({}, *_FAMILIES):
        wingbeat = stock | {name: value for name, value in family.items() if name in stock}
        if "flap_mean" in wingbeat and "flap_mean" in family:
            low, high = problem.bounds["flap_mean"]
            wingbeat["flap_mean"] = 0.5 * (low + high + family["flap_mean"] * (high - low))
        start = np.clip([*state, *wingbeat.values()], unknowns.lower, unknowns.upper)
        if not any(np.array_equal(start, other) for other in found):
            found.append(start)
    return found
