"""How fast this machine solves: the measurements behind ``wingbeat bench``."""

from __future__ import annotations

import contextlib
import os
import platform
import statistics
import time
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from wingbeat._base import __version__
from wingbeat._jax.arrays import jax, jnp
from wingbeat.aero import Dickinson, SuFan
from wingbeat.animal.species.making import load_species
from wingbeat.mechanics.flight_model import motion_table
from wingbeat.mechanics.state_rates import body_rates
from wingbeat.orbits.batch import find_orbits
from wingbeat.orbits.flight.period import flier
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.solution import Solution
from wingbeat.orbits.solve import Progress, Settings, find_orbit
from wingbeat.orbits.starts import start_point

ANIMALS = ("pigeon", "bat")
LANES = 1024
_TURNS = 64
_REPEATS = 30
_SPEEDS = np.linspace(8.0, 14.0, 20)


def median_seconds(run: Callable[[], Any], repeats: int) -> float:
    """Return the median time of `repeats` calls [s]; one earlier call compiles and is not timed."""
    run()
    times = []
    for _ in range(repeats):
        begun = time.perf_counter()
        run()
        times.append(time.perf_counter() - begun)
    return statistics.median(times)


def right_hand_side(lanes: int = LANES) -> float:
    """Return the time to evaluate the equations of motion once when many flights are integrated together [s]."""
    problem = OrbitProblem(load_species("pigeon"), speed=10.0)
    random = np.random.default_rng(0)
    motion = motion_table(problem.model, problem.species.wingbeat, random.uniform(0.0, 1.0, lanes))
    states = jnp.asarray(random.uniform([-0.5, 8.0, -1.0, -5.0], [0.5, 12.0, 1.0, 5.0], (lanes, 4)).T)

    @jax.jit
    def march(motion: Any, state: Any) -> Any:
        def step(_: Any, now: Any) -> Any:
            return now + 1e-6 * body_rates(problem.model, motion, now)

        return jax.lax.fori_loop(0, _TURNS, step, state)

    return median_seconds(lambda: march(motion, states).block_until_ready(), _REPEATS) / (lanes * _TURNS)


def jacobian() -> float:
    """Return the time of one flight with its derivatives, as the search computes it [s]."""
    problem = OrbitProblem(load_species("pigeon"), speed=10.0)
    point = start_point(problem, 0, 0)
    fly = flier(problem.model, problem.species.wingbeat, problem.free)
    return median_seconds(lambda: fly(point[4:], point[:4]), _REPEATS)


def orbits(animal: str) -> list[Solution]:
    """Return the orbits of an animal at 20 shuffled speeds, one start each, solved after one that compiles."""
    species = load_species(animal)
    speeds = np.random.default_rng(0).permutation(_SPEEDS)
    problems = [OrbitProblem(species, speed=float(speed)) for speed in (10.0, *speeds)]
    return [find_orbit(problem, Settings(1), threads=1) for problem in problems][1:]


def mixed_problems(count: int, seed: int = 0) -> Iterator[OrbitProblem]:
    """Yield random problems: speeds from 4 to 16 m/s, masses and the wing's length within 10 % of the animal's."""
    random = np.random.default_rng(seed)
    species = {name: load_species(name) for name in ANIMALS}
    for i in range(count):
        animal = species[ANIMALS[i % 2]]
        body, wing = animal.vehicle.body, animal.vehicle.wing
        factor = random.uniform(0.9, 1.1, 3)
        changed = {
            "body.mass": body.mass * factor[0],
            "wing.mass": wing.mass * factor[1],
            "wing.semi_span": wing.semi_span * factor[2],
        }
        aero = SuFan() if random.uniform() < 0.5 else Dickinson()
        yield OrbitProblem(animal.with_values(changed), speed=float(random.uniform(4.0, 16.0)), aero=aero)


def machine() -> dict[str, Any]:
    """Return the versions of the software, and the device."""
    device = jax.devices()[0]
    versions = {"wingbeat": __version__, "python": platform.python_version()}
    return {
        "versions": versions | {"jax": jax.__version__, "numpy": np.__version__},
        "device": f"{device.platform}: {platform.processor() or platform.machine()}, {os.cpu_count()} cores",
    }


@contextlib.contextmanager
def _one_core() -> Iterator[None]:
    """Restrict this process to one core. JAX then uses one thread, unless it has already computed something."""
    if not hasattr(os, "sched_setaffinity"):
        yield
        return
    cores = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {max(cores)})
    try:
        yield
    finally:
        os.sched_setaffinity(0, cores)


def measure(batch: int = 1024, progress: Progress | None = None) -> dict[str, Any]:
    """Measure this machine, on one core if the system allows it.

    Parameters
    ----------
    batch : number of mixed problems in the batch.
    progress : called with (parts done, parts in all).

    Returns
    -------
    Times, versions and device. ``rhs_ns``: one evaluation of the equations of motion, when many run together.
    ``jacobian_ms``: a flight with derivatives. ``pigeon_ms`` and ``bat_ms``: an orbit with its certificate, without
    compilation (medians over 20 speeds). ``certify_ms``: the part of these times that the certificate takes.
    ``solve_ms``: the rest, for search and correction. ``batch_ms``: an orbit in a batch. ``batch_certified``: the
    number of certified orbits in the batch.
    """
    with _one_core():
        done = 0

        def told() -> None:
            nonlocal done
            done += 1
            if progress is not None:
                progress(done, 4 + batch)

        result: dict[str, Any] = {"rhs_ns": 1e9 * right_hand_side()}
        told()
        result["jacobian_ms"] = 1e3 * jacobian()
        told()
        solve, certify = {}, {}
        for animal in ANIMALS:
            found = orbits(animal)
            result[f"{animal}_ms"] = 1e3 * statistics.median(s.seconds for s in found)
            solve[animal] = 1e3 * statistics.median(s.seconds - s.certify_seconds for s in found)
            certify[animal] = 1e3 * statistics.median(s.certify_seconds for s in found)
            told()
        result |= {"solve_ms": solve, "certify_ms": certify}
        problems = list(mixed_problems(batch))
        begun, certified = time.perf_counter(), 0
        for solution in find_orbits(problems, Settings(1, advise=False)):
            certified += solution.status.value == "converged"
            told()
        result["batch_ms"] = 1e3 * (time.perf_counter() - begun) / batch
        return result | {"batch": batch, "batch_certified": certified} | machine()
