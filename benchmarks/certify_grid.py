"""Solve and certify the grid of the core claim, or random vehicles, and judge each orbit by SciPy too.

Run from the root of a clone::

    uv run python benchmarks/certify_grid.py grid            # 72 problems
    uv run python benchmarks/certify_grid.py vehicles        # 200 random vehicles, +-30 %

Prints one line a problem and a summary; nothing is gated here.
"""

from __future__ import annotations

import argparse
import itertools
import time

import numpy as np
from scipy.integrate import solve_ivp

import wingbeat as wb
from wingbeat._jax.arrays import jax, jnp
from wingbeat.mechanics.flights import state_rates

rates = jax.jit(state_rates)


def grid():
    for name, aero in itertools.product(("pigeon", "bat"), (wb.aero.SuFan(), wb.aero.Dickinson())):
        for speed in range(3, 21):
            yield wb.OrbitProblem(wb.load_species(name), speed=float(speed), aero=aero)


def vehicles(count: int = 200, seed: int = 2026):
    """Every mass, length and inertia times a factor from 0.7 to 1.3, either animal and model, any speed."""
    random = np.random.default_rng(seed)
    for _ in range(count):
        species = wb.load_species(str(random.choice(["pigeon", "bat"])))
        aero = (wb.aero.SuFan, wb.aero.Dickinson)[random.integers(2)]()
        body, wing = species.vehicle.body, species.vehicle.wing
        factor = random.uniform(0.7, 1.3, 5)
        species = species.with_values(
            {
                "body.mass": body.mass * factor[0],
                "body.pitch_inertia": body.pitch_inertia * factor[1],
                "wing.mass": wing.mass * factor[2],
                "wing.semi_span": wing.semi_span * factor[3],
                "wing.chord": wing.chord * factor[4],
            }
        )
        yield wb.OrbitProblem(species, speed=float(random.uniform(3.0, 20.0)), aero=aero)


def second_opinion(orbit: wb.Orbit) -> float:
    """Return the largest closure miss of a flight by SciPy's DOP853 at rtol 1e-12."""
    problem, beat = orbit.problem, orbit.wingbeat
    start = np.array(orbit.initial_state)
    # As arrays at once, not their some fifty numbers anew in each of thousands of calls.
    model, wingbeat = jax.tree.map(jnp.asarray, (problem.model, beat))
    flown = solve_ivp(
        lambda t, y: np.asarray(rates(model, wingbeat, t * beat.frequency, y)),
        (0.0, 1.0 / beat.frequency),
        start,
        method="DOP853",
        rtol=1e-12,
        atol=1e-14,
    )
    travelled = np.array([problem.speed, problem.climb, 0, 0, 0, 0]) / beat.frequency
    return float(np.abs(flown.y[:, -1] - start - travelled).max())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("what", choices=["grid", "vehicles"])
    parser.add_argument("--starts", type=int, default=6)
    chosen = parser.parse_args()
    begun, statuses, worst, seconds = time.perf_counter(), [], 0.0, []
    for problem in grid() if chosen.what == "grid" else vehicles():
        orbit = wb.solve_orbit(problem, starts=chosen.starts)
        record = orbit.record()
        statuses.append(record["status"])
        seconds.append(record["solve_seconds"])
        own = max(abs(v) if v is not None else np.inf for v in record["closure"].values())
        other = second_opinion(orbit) if orbit.status is wb.Status.CONVERGED else np.inf
        if orbit.status is wb.Status.CONVERGED:
            worst = max(worst, own, other)
        what = f"{record['species']:7s} {record['aero']['coefficients']:10s} {record['speed']:6.2f} m/s"
        found = f"{record['status']:13s} {record['wingbeat']['frequency']:7.3f} Hz"
        miss = f"closure {own:.1e} (scipy {other:.1e}) kkt {record['optimality'] or np.nan:.0e}"
        effort = f"{record['starts']:2d} starts {record['distinct_optima']} optima {record['solve_seconds']:6.2f} s"
        print(f"{what} {found}  {miss}  {effort}  {', '.join(record['active_bounds'])}", flush=True)
    counts = {status: statuses.count(status) for status in sorted(set(statuses))}
    print(f"{counts}; worst closure of the converged {worst:.1e}")
    print(f"median {np.median(seconds):.2f} s an orbit, {time.perf_counter() - begun:.0f} s in all")


if __name__ == "__main__":
    main()
