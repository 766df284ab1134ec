"""Fly random robots with a prescribed pitch, then with a random hinge: how many are certified, at what cost.

Run from the root of a clone::

    uv run python benchmarks/random_hinges.py --minutes 20

Masses are log-uniform from 0.02 to 2 kg, speeds 0.7 to 1.3 times those of a lift coefficient of 0.6. Robots are
those of `wingbeat.robot`, with the places of pitch axis and mass on the chord drawn too. First, each robot flies
with a prescribed pitch. The spring and damper that fit the torque of this pitch best, each times a number drawn
from 0.5 to 2, are its hinge. Half the wings pitch as a whole, half twist from a root at a free angle. Both flights
have one start, more follow until an orbit is certified; the least mean positive power is sought. Times are those
of the processor, after a flight of each kind that compiles the programs. A robot without an orbit is explained if
the solver finds none within the bounds: its message says what is short.

Of 100 robots with one start, 94 were certified and 5 explained; all 50 that twist were certified. An orbit took
2.98 times the time of a prescribed one (median; 3.6 for wings that pitch, 2.8 for wings that twist). The last one
had closed wingbeats that could not be certified; with four times its damping it flies.
"""

from __future__ import annotations

import argparse
import math
import time
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

import wingbeat as wb

SEED, COUNT = 2026, 100
MASSES, LIFT_COEFFICIENT, SPEEDS = (0.02, 2.0), 0.6, (0.7, 1.3)
AIR = wb.aero.BladeElement(wb.aero.SuFan(), 10, "centre-of-pressure")
OBJECTIVE = "mean_positive_power"


class Robot(NamedTuple):
    """A robot, the speed that it is asked to fly [m/s], and what its hinge is drawn with."""

    species: wb.Species
    speed: float
    twists: bool
    stiffer: float  # than the best fit
    damper: float

    @property
    def words(self) -> str:
        """Return what it is."""
        kind = "twists" if self.twists else "pitches"
        return f"{self.species.name}, {self.species.vehicle.mass:.3g} kg, {self.speed:.3g} m/s, {kind}"

    def prescribed(self) -> wb.OrbitProblem:
        """Return the problem of its flight with a prescribed pitch."""
        free, bounds = (*self.species.free, "pitch_phase"), {"pitch_phase": (-1.6, 1.6)}
        return wb.OrbitProblem(
            self.species, speed=self.speed, aero=AIR, minimise=OBJECTIVE, free=free, bounds=bounds
        )

    def given_way(self, hinge: wb.PitchHinge) -> wb.OrbitProblem:
        """Return the problem of its flight with a hinge."""
        numbers = {f"pitch_hinge.{name}": value for name, value in vars(hinge).items()}
        free, bounds = [name for name in self.species.free if not name.startswith("pitch_")], {}
        if self.twists:
            numbers["wingbeat.pitch_amplitude"] = 0.0
            free.append("pitch_mean")
        free.append("hinge_rest_angle")
        bounds["hinge_rest_angle"] = (-1.0, 1.0)
        species = self.species.with_values(numbers)
        return wb.OrbitProblem(
            species, speed=self.speed, aero=AIR, minimise=OBJECTIVE, free=tuple(free), bounds=bounds
        )


class Flight(NamedTuple):
    """How a flight ended, its seconds of the processor [s], and what the solver said."""

    status: wb.Status
    seconds: float
    message: str


def robots(count: int = COUNT, seed: int = SEED) -> Iterator[Robot]:
    """Yield random robots."""
    random = np.random.default_rng(seed)
    for index in range(count):
        mass = math.exp(random.uniform(*np.log(MASSES)))
        span = 1.137 * mass**0.396 * random.uniform(0.8, 1.3)
        area = span**2 / random.uniform(4.5, 8.0)
        places = {
            "wing.pitch_axis": random.uniform(0.05, 0.35),
            "wing.mass_axis": random.uniform(0.3, 0.5),
            "wing.mass_gyration": random.uniform(0.2, 0.3),
        }
        cruise = math.sqrt(2 * mass * 9.81 / (1.225 * area * LIFT_COEFFICIENT))
        species = wb.robot(mass=mass, wing_span=span, wing_area=area, name=f"robot {index}").with_values(places)
        drawn = random.uniform(*SPEEDS), *np.exp(random.uniform(-math.log(2.0), math.log(2.0), 2))
        yield Robot(species, cruise * drawn[0], index % 2 == 1, float(drawn[1]), float(drawn[2]))


def fitted(orbit: wb.Orbit, robot: Robot) -> tuple[wb.PitchHinge, float]:
    """Return a hinge near the best fit to the torque of a prescribed pitch, and what the fit explains."""
    names = ("wing_pitch", "wing_pitch_rate", "pitch_torque")
    angle, rate, torque = (orbit.dataset[name].values[:-1] for name in names)
    columns = np.column_stack([-angle, -rate, np.ones_like(angle)])
    (stiffness, damping, offset), *_ = np.linalg.lstsq(columns, torque, rcond=None)
    left = torque - columns @ [stiffness, damping, offset]
    given = 1.0 - float(left @ left / ((torque - torque.mean()) ** 2).sum())
    stiffness = max(float(stiffness), 1e-3 * float(np.abs(torque).max()))
    natural = stiffness / (2.0 * math.pi * orbit.wingbeat.frequency)
    # Of a twist, whose mean is half of that at the tip, half the stiffness.
    share = robot.stiffer * (0.5 if robot.twists else 1.0)
    rest = float(np.clip(offset / stiffness, -0.8, 0.8))
    damped = max(float(damping), 0.05 * natural) * robot.damper * (0.5 if robot.twists else 1.0)
    twist = {"rest_angle": 0.0, "twist_share": 1.0} if robot.twists else {"rest_angle": rest}
    return wb.PitchHinge(stiffness * share, damped, **twist), given


def flown(problem: wb.OrbitProblem, starts: int | None) -> tuple[wb.Orbit, Flight]:
    """Solve a flight and return how it ended."""
    begun = time.process_time()
    orbit = wb.solve_orbit(problem, starts=starts)
    return orbit, Flight(orbit.status, time.process_time() - begun, orbit.message)


def summary(flights: list[Flight]) -> str:
    """Return how many are certified and explained, and median and 90 % of the seconds of certified flights."""
    seconds = [flight.seconds for flight in flights if flight.status is wb.Status.CONVERGED]
    explained = sum(flight.status is wb.Status.INFEASIBLE for flight in flights)
    return (
        f"{len(seconds)} of {len(flights)} certified, {explained} explained; median {np.median(seconds):.2f} s, "
        f"nine in ten within {np.quantile(seconds, 0.9):.2f} s"
    )


def main() -> None:
    """Fly all and print what came of it."""
    parser = argparse.ArgumentParser(
        description="Fly random robots with a prescribed pitch, then with a random hinge."
    )
    parser.add_argument("--count", type=int, default=COUNT)
    parser.add_argument("--starts", type=int, default=1)
    parser.add_argument("--only", type=int, nargs="*", help="fly these, by their numbers")
    parser.add_argument("--minutes", type=float, default=math.inf, help="draw no more robots after this time")
    asked, begun = parser.parse_args(), time.perf_counter()
    drawn = list(robots(asked.count))
    both: list[tuple[Flight, Flight]] = []
    for index, robot in enumerate([*drawn[:2], *drawn]):
        if time.perf_counter() - begun > 60 * asked.minutes:
            break
        if asked.only and index - 2 not in asked.only:
            continue
        orbit, prescribed = flown(robot.prescribed(), asked.starts)
        if prescribed.status is not wb.Status.CONVERGED:
            print(f"{robot.words}: prescribed {prescribed.status.value}, no hinge is fitted", flush=True)
            continue
        hinge, given = fitted(orbit, robot)
        _, flight = flown(robot.given_way(hinge), asked.starts)
        print(
            f"{robot.words}: prescribed {prescribed.seconds:.2f} s, R2 {given:.2f}, "
            f"hinge {flight.status.value} {flight.seconds:.2f} s",
            flush=True,
        )
        if flight.status is not wb.Status.CONVERGED:
            print(f"  {hinge}\n  {flight.message}", flush=True)
        if index >= 2:  # the first two compile
            both.append((prescribed, flight))
    print(f"prescribed: {summary([one for one, _ in both])}")
    print(f"hinge: {summary([other for _, other in both])}")
    ratios = [b.seconds / a.seconds for a, b in both if b.status is wb.Status.CONVERGED]
    print(
        f"hinge over prescribed: median {np.median(ratios):.2f}, nine in ten within {np.quantile(ratios, 0.9):.2f}"
    )


if __name__ == "__main__":
    main()
