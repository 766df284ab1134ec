"""How far the compiled right-hand side is from the same arithmetic written by hand in C.

Compiles rhs.c into a temporary folder, checks it against `wingbeat.mechanics.flight_model.body_rates`, and times
both on one core. Run from the root of a clone, with gcc at hand::

    taskset -c 0 uv run python benchmarks/kernel/yardstick.py
"""

from __future__ import annotations

import ctypes
import os
import subprocess
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

# One core for XLA too, before it starts.
os.environ["PJRT_NPROC"] = "1"
if hasattr(os, "sched_setaffinity"):
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})

import jax
import jax.numpy as jnp
import numpy as np

import wingbeat as wb
from wingbeat.bench import median_seconds
from wingbeat.mechanics.flight_model import FlightModel, motion_table
from wingbeat.mechanics.state_rates import body_rates
from wingbeat.mechanics.wing_shape import stroke_pitch

LANES = (64, 256, 1024, 4096)
STEPS, REPEATS = 8, 30
AT_MOST = 1e-12
FLAGS = ["-O3", "-march=native", "-std=gnu11", "-fPIC", "-shared"]
FLAGS += ["-fno-math-errno", "-fno-trapping-math", "-ffp-contract=fast"]
POINTER = ctypes.POINTER(ctypes.c_double)


def library(folder: Path) -> ctypes.CDLL:
    target = folder / "rhs.so"
    source = Path(__file__).with_name("rhs.c")
    subprocess.run(["gcc", *FLAGS, "-o", str(target), str(source), "-lm"], check=True)
    found = ctypes.CDLL(str(target))
    long = ctypes.c_long
    found.body_rates.argtypes = [POINTER] * 4 + [long] * 2
    found.march.argtypes = [POINTER, POINTER, long, ctypes.c_double, long, POINTER, long]
    found.body_rates.restype = found.march.restype = None
    return found


def pointer(array: np.ndarray) -> Any:
    assert array.dtype == np.float64
    assert array.flags.c_contiguous
    return array.ctypes.data_as(POINTER)


def numbers(model: FlightModel) -> np.ndarray:
    """Return the model in the order of the C struct."""
    kernel, body = model.kernel, model.vehicle.body
    drag, lift = kernel.pieces.drag, kernel.pieces.lift
    assert drag.decay_amplitude is None
    assert kernel.lift.patch is None
    assert kernel.drag.patch is None
    ends = (*kernel.lift.at_zero, *kernel.lift.at_right, *kernel.drag.at_zero, *kernel.drag.at_right)
    pitch = stroke_pitch(model.vehicle.wing.stroke_plane_angle)
    whole = (model.vehicle.mass, body.pitch_inertia, model.air.density, model.air.gravity, body.drag_area, pitch)
    return np.array([*whole, kernel.width, *lift, *drag[:4], *ends], dtype=float)


def rows(motion: Any) -> np.ndarray:
    """Return a motion table as C has it, (rows, lanes), or (times, rows, lanes) of one with times and lanes."""
    leaves = [np.asarray(a) for a in jax.tree.leaves(motion)]
    lanes = leaves[-1].ndim
    table = np.concatenate([a if a.ndim > lanes else a[None] for a in leaves])
    return np.ascontiguousarray(np.moveaxis(table, 0, -2))


def random_states(rng: np.random.Generator, lanes: int) -> np.ndarray:
    """Return pitch states of brisk flight, forward and, one in four, backward."""
    forward = rng.uniform(3.0, 18.0, lanes) * np.where(rng.uniform(size=lanes) < 0.25, -1.0, 1.0)
    pitch, climb, rate = (rng.uniform(-size, size, lanes) for size in (1.0, 6.0, 15.0))
    return np.stack([pitch, forward, climb, rate])


def median_ns(run: Callable[[], Any], count: int) -> float:
    """Return the median time of a call [ns], over `count` right-hand sides in it."""
    return 1e9 * median_seconds(run, REPEATS) / count


class Case:
    """A species with the numbers for C and the functions for JAX."""

    def __init__(self, found: ctypes.CDLL, name: str) -> None:
        species = wb.load_species(name)
        self.found, self.wingbeat, self.rng = found, species.wingbeat, np.random.default_rng(20230219)
        self.model = wb.FlightModel(species.vehicle, wb.aero.BladeElement(wb.aero.SuFan()), species.air)
        self.numbers = numbers(self.model)
        self.jax_rates = jax.jit(body_rates)
        self.jax_march = jax.jit(rk4)

    def motion(self, shape: tuple[int, ...]) -> Any:
        return jax.jit(motion_table)(self.model, self.wingbeat, jnp.asarray(self.rng.uniform(size=shape)))

    def c_rates(self, table: np.ndarray, state: np.ndarray, repeats: int = 1) -> np.ndarray:
        rates = np.empty_like(state)
        arrays = (self.numbers, table, state, rates)
        self.found.body_rates(*map(pointer, arrays), state.shape[1], repeats)
        return rates

    def c_march(self, tables: np.ndarray, state: np.ndarray, step: float) -> np.ndarray:
        state, shared = state.copy(), tables.ndim == 2
        steps = (len(tables) - 1) // 2
        arrays = pointer(self.numbers), pointer(tables)
        self.found.march(*arrays, shared, step, steps, pointer(state), state.shape[1])
        return state

    def worst(self, lanes: int) -> float:
        """Return the largest difference of the two, relative to the largest rate of its kind."""
        motion, state = self.motion((lanes,)), random_states(self.rng, lanes)
        expected = np.asarray(self.jax_rates(self.model, motion, jnp.asarray(state)))
        off = np.abs(self.c_rates(rows(motion), state) - expected)
        return float(np.max(off / np.max(np.abs(expected), axis=1, keepdims=True)))

    def worst_march(self, lanes: int) -> float:
        """Return the largest difference after a march, per lane tables and shared ones."""
        motion, state = self.motion((2 * STEPS + 1, lanes)), random_states(self.rng, lanes)
        expected = np.asarray(self.jax_march(self.model, by_step(motion), 1e-3, jnp.asarray(state)))
        own = rows(motion)
        difference = self.c_march(own, state, 1e-3) - expected
        one = np.ascontiguousarray(own[:, :, 0])
        spread = np.ascontiguousarray(np.broadcast_to(one[..., None], own.shape))
        shared = self.c_march(one, state, 1e-3) - self.c_march(spread, state, 1e-3)
        scale = np.max(np.abs(expected), axis=1, keepdims=True)
        return float(max(np.max(np.abs(d) / scale) for d in (difference, shared)))

    def times(self, lanes: int) -> tuple[float, ...]:
        """Return ns per right-hand side of C, JAX, C's march with tables per lane and shared, and JAX's march."""
        motion, state = self.motion((lanes,)), random_states(self.rng, lanes)
        table, again, held = rows(motion), max(1, 16384 // lanes), jnp.asarray(state)
        tables = self.motion((2 * STEPS + 1, lanes))
        own, stages = rows(tables), by_step(tables)
        one = np.ascontiguousarray(own[:, :, 0])
        in_march = 4 * STEPS * lanes
        return (
            median_ns(lambda: self.c_rates(table, state, again), lanes * again),
            median_ns(lambda: self.jax_rates(self.model, motion, held).block_until_ready(), lanes),
            median_ns(lambda: self.c_march(own, state, 1e-3), in_march),
            median_ns(lambda: self.c_march(one, state, 1e-3), in_march),
            median_ns(lambda: self.jax_march(self.model, stages, 1e-3, held).block_until_ready(), in_march),
        )


def by_step(tables: Any) -> Any:
    """Return the tables at beginning, middle and end of each step, each (steps, ..., lanes)."""
    times = jax.tree.map(lambda a: jnp.moveaxis(a, -2, 0), tables)
    return tuple(jax.tree.map(lambda a, i=i: a[i : i + 2 * STEPS : 2], times) for i in range(3))


def rk4(model: FlightModel, stages: Any, step: Any, state: Any) -> Any:
    """March classical Runge-Kutta over tables by step, in lanes."""

    def advance(state: Any, tables: Any) -> tuple[Any, None]:
        begin, middle, end = tables
        first = body_rates(model, begin, state)
        second = body_rates(model, middle, state + 0.5 * step * first)
        third = body_rates(model, middle, state + 0.5 * step * second)
        fourth = body_rates(model, end, state + step * third)
        return state + step / 6 * (first + 2 * (second + third) + fourth), None

    return jax.lax.scan(advance, state, stages)[0]


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        found = library(Path(folder))
        cases = {name: Case(found, name) for name in ("pigeon", "bat")}
        for name, case in cases.items():
            one, many = case.worst(1024), case.worst_march(64)
            print(f"{name}: C agrees with JAX to {one:.1e} in the rates, {many:.1e} after {STEPS} steps")
            if max(one, many) > AT_MOST:
                raise SystemExit(f"C and JAX differ by more than {AT_MOST}")
        print(f"ns per right-hand side and lane, one core, float64, median of {REPEATS}")
        print("| lanes | C | JAX | JAX/C | C RK4 | C RK4, shared tables | JAX RK4 | JAX/C |")
        print("| --- " * 8 + "|")
        for lanes in LANES:
            c, by_jax, own, shared, jax_own = cases["pigeon"].times(lanes)
            line = f"{c:.1f} | {by_jax:.0f} | {by_jax / c:.1f} | {own:.1f} | {shared:.1f} | {jax_own:.0f}"
            print(f"| {lanes} | {line} | {jax_own / own:.1f} |", flush=True)


if __name__ == "__main__":
    main()
