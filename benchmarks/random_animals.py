"""Fly random birds and bats by both models: how many are certified, and how long an orbit takes.

Run from the root of a clone; it prints the numbers of docs/guide/models.md::

    uv run python benchmarks/random_animals.py --starts 1

Without the option, the times are those of the default number of starts. With one start, more follow until an orbit
is certified, as with the default number. An animal without an orbit is explained if the solver finds none within
the bounds (status infeasible); its message then says which balance fails.

Masses are log-uniform over the range of the laws. Span and area scatter log-normally around the laws; the ends of
a law's spread lie two standard deviations out, and what lies beyond is drawn anew. Speeds are 0.6 to 1.4 times that
of a lift coefficient of 0.6: a fast flight needs 0.3, a slow one 1.7. Both models take turns, and times are those
of the processor. Two animals are flown once before, untimed: that compiles the programs. `--minutes` ends the
drawing early; the summary says how many were flown.
"""

from __future__ import annotations

import argparse
import math
import time
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

import wingbeat as wb
from wingbeat.animal.species.scaling import BAT_ASPECT_RATIO, BIRD_ASPECT_RATIO, BIRD_MASS
from wingbeat.animal.vehicle import Air

SEED, COUNT = 2026, 200
# The laws of birds' wing mass and frequency hold from 0.01 kg to 10 kg, those of bats from 2 to 870 g [kg].
MASSES = {"bird": (0.01, 10.0), "bat": (0.002, 0.87)}
# Bats: area 0.176 m^(2/3) (24 noctules, see `wingbeat.animal.species.scaling`), times a guessed spread.
BAT_AREA, BAT_AREA_SPREAD = 0.176, (0.7, 1.4)
LIFT_COEFFICIENT, SPEEDS = 0.6, (0.6, 1.4)


class Animal(NamedTuple):
    """An animal and the speed [m/s] that it is asked to fly."""

    species: wb.Species
    speed: float

    def problem(self, model: str) -> wb.OrbitProblem:
        """Return the problem of its flight by a model."""
        return wb.models.model_of(model, self.species).problem(self.species, self.speed)


class Flight(NamedTuple):
    """How a flight ended, its seconds of the processor [s], and what the solver said."""

    status: wb.Status
    seconds: float
    message: str

    @property
    def certified(self) -> bool:
        """Whether an orbit was found and certified."""
        return self.status is wb.Status.CONVERGED


def animals(count: int = COUNT, seed: int = SEED) -> Iterator[Animal]:
    """Yield birds and bats in turn."""
    random = np.random.default_rng(seed)
    for index in range(count):
        kind = ("bird", "bat")[index % 2]
        mass = math.exp(random.uniform(*np.log(MASSES[kind])))
        if kind == "bird":
            span = 1.137 * (mass / _scattered(random, BIRD_MASS.spread)) ** 0.396
            area = span**2 / _scattered(random, BIRD_ASPECT_RATIO[0])
        else:
            area = BAT_AREA * mass ** (2 / 3) * _scattered(random, BAT_AREA_SPREAD)
            span = math.sqrt(area * _scattered(random, BAT_ASPECT_RATIO[0]))
        air = Air()
        cruise = math.sqrt(2 * mass * air.gravity / (air.density * area * LIFT_COEFFICIENT))
        make = wb.bird if kind == "bird" else wb.bat
        species = make(mass=mass, wing_span=span, wing_area=area, name=f"{kind} {index}")
        yield Animal(species, cruise * random.uniform(*SPEEDS))


def _scattered(random: np.random.Generator, spread: tuple[float, float]) -> float:
    low, high = np.log(spread)
    while True:
        drawn = random.normal((low + high) / 2, (high - low) / 4)
        if low <= drawn <= high:
            return math.exp(drawn)


def flown(animal: Animal, model: str, starts: int | None = None) -> Flight:
    """Solve a flight and return how it ended."""
    problem = animal.problem(model)
    begun = time.process_time()
    orbit = wb.solve_orbit(problem, starts=starts)
    return Flight(orbit.status, time.process_time() - begun, orbit.message)


def summary(flights: list[Flight]) -> str:
    """Return how many are certified and explained, and median and 90 % of the seconds of certified flights."""
    seconds = [flight.seconds for flight in flights if flight.certified]
    explained = sum(flight.status is wb.Status.INFEASIBLE for flight in flights)
    return (
        f"{len(seconds)} of {len(flights)} certified, {explained} explained; median {np.median(seconds):.2f} s, "
        f"nine in ten within {np.quantile(seconds, 0.9):.2f} s"
    )


def batch(drawn: list[Animal], model: str, starts: int | None = None) -> str:
    """Return seconds an orbit, and how many are certified, of all animals at once."""
    problems = [animal.problem(model) for animal in drawn]
    begun = time.perf_counter()
    orbits = wb.solve_orbits(problems, starts=starts)
    seconds = time.perf_counter() - begun
    certified = sum(orbit.status is wb.Status.CONVERGED for orbit in orbits)
    return f"{certified} of {len(orbits)} certified, {seconds / len(orbits):.2f} s an orbit"


def main() -> None:
    """Fly all and print what came of it."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--count", type=int, default=COUNT)
    parser.add_argument("--starts", type=int)
    parser.add_argument("--only", type=int, nargs="*", help="fly these by the model animal alone, by their numbers")
    parser.add_argument("--minutes", type=float, default=math.inf, help="draw no more animals after this time")
    parser.add_argument("--models", nargs="*", default=list(wb.models.MODELS), choices=wb.models.MODELS)
    asked = parser.parse_args()
    drawn = list(animals(asked.count))
    if asked.only:
        for index in asked.only:
            print(f"{_words(drawn[index])}: {flown(drawn[index], 'animal', asked.starts)}", flush=True)
        return
    begun = time.perf_counter()
    for animal in drawn[:2]:
        for model in asked.models:
            flown(animal, model, asked.starts)
    flights: dict[str, list[Flight]] = {model: [] for model in asked.models}
    for animal in drawn:
        if time.perf_counter() - begun > 60 * asked.minutes:
            break
        for model, those in flights.items():
            those.append(flown(animal, model, asked.starts))
        told = [f"{model} {those[-1].status.value} {those[-1].seconds:.2f} s" for model, those in flights.items()]
        print(f"{_words(animal)}: {', '.join(told)}", flush=True)
        for model, those in flights.items():
            if not those[-1].certified:
                print(f"  {model}: {those[-1].message}", flush=True)
    for model, those in flights.items():
        print(f"{model}: {summary(those)}")
    if math.isinf(asked.minutes):
        for model in flights:
            print(f"batch, {model}: {batch(drawn, model, asked.starts)}", flush=True)


def _words(animal: Animal) -> str:
    return f"{animal.species.name}, {animal.species.vehicle.mass:.3g} kg, {animal.speed:.1f} m/s"


if __name__ == "__main__":
    main()
