"""Where searches start: a wingbeat of each family there is, then seeded random ones within the bounds.

Most start from brisk wingbeats. A vehicle that beats fast moves little within a beat, so closure is nearly linear
there and its searches do not stray; one that beats too slowly to stay up has no orbit near. From a closed orbit of
high frequency the way to least frequency is downhill. But where wings are large for the body, families of little
pitching exist at low frequencies alone, and brisk starts miss them.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from wingbeat.kinematics import parameter
from wingbeat.orbits.problem.problem import OrbitProblem

# Times the stock frequency. From 2 to 4 every pigeon and nearly every bat of +-30 % was found in one search; at 1 a
# third of the bats strayed, and took three times the flights.
_BRISK = 2.5


class Family(NamedTuple):
    """A family of wingbeats, as what its start changes in the species' stock wingbeat.

    Parameters
    ----------
    flap_mean : in shares of half its range from the middle of its bounds; that of the stock wingbeat if not given.
    pitch_mean, pitch_amplitude : likewise [rad].
    flap_amplitude, frequency : times those of the stock wingbeat.
    nose_up : body pitch [rad], with an upright stroke plane.
    """

    flap_mean: float | None = None
    pitch_mean: float | None = None
    pitch_amplitude: float | None = None
    flap_amplitude: float = 1.0
    frequency: float = _BRISK
    nose_up: float = 0.1


# Each is the best start into its family of up to 108 tried for 110 vehicles of +-40 %. Wings that hardly pitch and
# beat below the body are met in 68 % of the cases from a wide and slow beat, in 55 % from a brisk one. Wide beats
# above a body whose nose is down are 30 % slower than any other for some bats.
_QUIET, _PITCHING, _STEEP = math.radians(3.0), math.radians(15.0), math.radians(30.0)
_FAMILIES = (
    Family(),
    Family(-0.8, 0.0, _QUIET, flap_amplitude=1.3, frequency=1.0, nose_up=0.35),
    Family(0.8, 0.0, _QUIET),
    Family(-0.8, None, _PITCHING),
    Family(None, 0.0, _QUIET, frequency=1.0),
    Family(0.4, 0.3, _STEEP, flap_amplitude=1.3, frequency=1.5, nose_up=-0.6),
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
    unknowns = problem.unknowns()
    found: list[np.ndarray] = []
    for family in _FAMILIES:
        start = np.clip(_start_in(problem, family), unknowns.lower, unknowns.upper)
        if not any(np.array_equal(start, other) for other in found):
            found.append(start)
    return found


def _start_in(problem: OrbitProblem, family: Family) -> list[float]:
    beat = problem.species.wingbeat
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
    # Turning the stroke plane turns the body the other way and leaves the wings where they were.
    pitch = family.nose_up + problem.vehicle.wing.stroke_plane_angle + beat.stroke_plane_tilt - 0.5 * math.pi
    return [pitch, problem.speed, problem.climb, 0.0, *wingbeat.values()]
