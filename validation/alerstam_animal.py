"""The birds flown by the model `animal`, one after the other; each bird's orbits are starts for the next larger."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np
from alerstam_flights import (
    ANIMAL,
    FREQUENCY,
    POWER,
    Bird,
    Point,
    point_of,
    problem_of,
    problems,
    speed_at_lift_one,
)
from numpy.typing import NDArray

import wingbeat as wb
from wingbeat._base import read_text, write_atomically
from wingbeat.animal.species.scaling import BIRD_FREQUENCY
from wingbeat.orbits.solution import Solution, search_near
from wingbeat.orbits.solve import Progress, Settings, find_orbit
from wingbeat.results.orbit import Orbit

# Of the speed at which a wing at lift coefficient 1 carries the bird; measured airspeeds play no part in them. The
# curves of three birds (swan, wood pigeon, sand martin) have both minima between. Where the least is at an end, the
# bird flies further speeds, up to MOST.
SPEEDS = (1.1, 1.2, 1.3, 1.4, 1.5)
BEYOND, MOST = 0.15, 4
# Problems by name: a speed of the curve by its factor, or this.
AIRSPEED = "airspeed"
# These also get a start from the bird's stock wingbeat, so that a family can enter that the bird before lacks.
STOCK = ("1.3", AIRSPEED)
# Neighbours farther apart in speed than this ratio do not help each other.
APART = 1.2
# Neighbours nearer than this in the optimiser's scale are of one family: one teaches the other nothing.
ALIKE = 0.5
MOST_STARTS = 8


@dataclass(frozen=True)
class Flown:
    """One bird: its points, and the unknowns of its orbits of least power, by the names of the problems.

    `law` is the frequency of Pennycuick's law [Hz], to which frequencies of the next bird are scaled.
    """

    species: str
    law: float
    points: list[Point]
    unknowns: dict[str, list[float]]
    speeds: dict[str, float]
    messages: list[str]


def fly_in_order(birds: Sequence[Bird], store: Path, progress: Progress | None = None) -> list[Point]:
    """Return the points of the birds, flown by rising mass; the folder `store` keeps each bird that was flown."""
    store.mkdir(parents=True, exist_ok=True)
    flown: dict[str, Flown] = {}
    before = None
    for bird in sorted(birds, key=lambda bird: (bird.mass, bird.name)):
        path = store / f"{bird.name.replace(' ', '_')}.json"
        if path.is_file():
            before = _read(path)
        else:
            before = fly_bird(bird, before)
            write_atomically(path, json.dumps(asdict(before), indent=1))
        flown[bird.name] = before
        if progress is not None:
            progress(len(flown), len(birds))
    return [point for bird in birds for point in flown[bird.name].points]


def fly_timed(timed: Sequence[Bird], store: Path) -> list[Point]:
    """Fly the birds of measured frequency at the speed of that measurement, each problem from two starts."""
    path = store / "timed.json"
    if not path.is_file():
        asked = problems([], list(timed), ANIMAL)
        orbits = wb.solve_orbits([problem for _, problem in asked], starts=2, most_starts=MOST_STARTS)
        found = [
            point_of(ANIMAL, what, problem, orbit) for (what, problem), orbit in zip(asked, orbits, strict=True)
        ]
        write_atomically(path, json.dumps([asdict(point) for point in found], indent=1))
    return [Point(**point) for point in json.loads(read_text(path))]


def _read(path: Path) -> Flown:
    saved = json.loads(read_text(path))
    return Flown(**{**saved, "points": [Point(**point) for point in saved["points"]]})


def fly_bird(bird: Bird, before: Flown | None) -> Flown:
    """Find the orbits of least metabolic power at all speeds, and that of least frequency at the airspeed."""
    species = bird.species
    at_one = speed_at_lift_one(bird)
    law = BIRD_FREQUENCY(bird.mass, bird.span, bird.area, species.air.density, species.air.gravity)
    speeds = {AIRSPEED: bird.airspeed}
    best: dict[str, Solution] = {}
    failed: dict[str, Solution] = {}
    due = [*(f"{factor:g}" for factor in SPEEDS), AIRSPEED]
    while due:
        speeds |= {name: float(name) * at_one for name in due if name != AIRSPEED}
        names = sorted(speeds, key=speeds.__getitem__)
        problems = [problem_of(ANIMAL, bird, speeds[name]) for name in names]
        for name, problem in zip(names, problems, strict=True):
            if name in due and (found := _first(problem, name, before, law)) is not None:
                best[name] = found
        ends = pass_on(problems, [best.get(name) for name in names])
        for name, problem, end in zip(names, problems, ends, strict=True):
            if end is not None:
                best[name] = end
            elif name not in failed:  # what no start has reached so far gets more starts
                found = _from_stock(problem)
                (best if _is_orbit(found) else failed)[name] = found
        factors = (name for name in speeds if name != AIRSPEED)
        due = further({float(name): best[name].objective if name in best else math.nan for name in factors})
    slow = problem_of(ANIMAL, bird, bird.airspeed, minimise="frequency")
    least = _from_stock(slow)
    # In the order of the other model: the curve, then the airspeed.
    found = best | failed
    asked = [(POWER, found[name]) for name in speeds if name != AIRSPEED]
    asked += [(POWER, found[AIRSPEED]), (FREQUENCY, least)]
    return Flown(
        bird.name,
        law,
        [point_of(ANIMAL, what, one.problem, Orbit.of(one, one.starts, 0)) for what, one in asked],
        {name: one.unknowns.tolist() for name, one in best.items()},
        speeds,
        [f"{what} at {one.problem.speed:.4g} m/s: {one.message}" for what, one in asked if not _is_orbit(one)],
    )


def further(curve: dict[float, float]) -> list[str]:
    """Return the factor of a further speed if power, or power over speed, is least at an end of the curve.

    Parameters
    ----------
    curve : least power by the factor of the speed; not-a-number without an orbit.
    """
    good = sorted(factor for factor, power in curve.items() if math.isfinite(power))
    if not good or len(curve) >= len(SPEEDS) + MOST:
        return []
    if min(good, key=curve.__getitem__) == good[0]:
        return [f"{min(curve) - BEYOND:g}"]
    farthest = min(good, key=lambda factor: curve[factor] / factor)
    return [f"{max(curve) + BEYOND:g}"] if farthest == good[-1] else []


def _is_orbit(found: Solution) -> bool:
    return found.status is wb.Status.CONVERGED


def _from_stock(problem: wb.OrbitProblem, most: int = MOST_STARTS) -> Solution:
    """Solve a problem from the stock wingbeat; further starts follow only until one leads to an orbit."""
    return find_orbit(problem, Settings(1, most_starts=most, advise=False), threads=1)


def _first(problem: wb.OrbitProblem, name: str, before: Flown | None, law: float) -> Solution | None:
    """Solve a problem from the orbit of the bird before, from the stock wingbeat, or from both."""
    found = []
    if before is not None and name in before.unknowns:
        found.append(search_near(problem, carried(problem, before, name, law)))
    if before is None or name in STOCK:
        found.append(_from_stock(problem, 1))
    good = [one for one in found if one is not None and _is_orbit(one)]
    return min(good, key=lambda one: one.objective, default=None)


def carried(problem: wb.OrbitProblem, before: Flown, name: str, law: float) -> NDArray[np.float64]:
    """Return unknowns of the bird before, scaled to this one: angles stay, times go with the frequency's law."""
    start = np.array(before.unknowns[name])
    names = problem.unknowns().names
    along, beat = problem.speed / before.speeds[name], law / before.law
    for unknown, ratio in (("u", along), ("w", along), ("pitch_rate", beat)):
        start[names.index(unknown)] *= ratio
    return start


def pass_on(problems: Sequence[wb.OrbitProblem], first: Sequence[Solution | None]) -> list[Solution | None]:
    """Return the best orbits, or None, after each has started its neighbours' searches, until none gets better.

    Only orbits that differ are handed on. The best family of orbits thus spreads as far as it exists.

    Parameters
    ----------
    problems : by rising speed.
    first : the orbit known for each problem, if any.
    """
    best, tried = list(first), set[tuple[bytes, int]]()
    upward = [(i, i + 1) for i in range(len(best) - 1)]
    downward = [(i + 1, i) for i in reversed(range(len(best) - 1))]
    better = True
    while better:
        better = False
        for giver, taker in upward + downward:
            given, own = best[giver], best[taker]
            near = max(problems[i].speed for i in (giver, taker)) <= APART * problems[min(giver, taker)].speed
            if given is None or not near or (own is not None and not _differ(given, own)):
                continue
            if (key := (given.unknowns.tobytes(), taker)) in tried:
                continue
            tried.add(key)
            below = math.inf if own is None else own.objective * (1 - 1e-4)
            if (found := search_near(problems[taker], given.unknowns, below)) is not None:
                best[taker], better = found, True
    return best


def _differ(one: Solution, other: Solution) -> bool:
    return bool(np.abs(one.place - other.place).max() > ALIKE)
