"""How much arithmetic the programs of a search are, counted in their traced form, where time cannot blur it.

Run from the root of a clone; with --write it makes the present counts the baseline that a test holds us to::

    uv run python benchmarks/operations.py [--write]
"""

from __future__ import annotations

import argparse
import json
import math
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np

import wingbeat as wb
from wingbeat._jax.arrays import jax, jnp
from wingbeat.mechanics.flight_model import motion_table
from wingbeat.mechanics.state_rates import body_rates
from wingbeat.orbits.flight.period import STEPS, fly_part, march, tabulated
from wingbeat.orbits.starts import start_point

BASELINE = Path(__file__).with_name("operations.json")
# Traced under these names in `wingbeat._jax.arrays`; their polynomials count as operations as well.
POLYNOMIALS = ("sin", "atan2")
TRANSCENDENTAL = ("exp", "log", "pow", "sqrt", "sin", "cos", "tan", "atan2", "tanh", "erf")
MOVES = ("broadcast_in_dim", "reshape", "transpose", "slice", "squeeze", "concatenate", "convert_element_type")


def inner(eqn: Any) -> list[Any]:
    """Return the jaxprs that an equation carries."""
    found = []
    for value in eqn.params.values():
        for item in value if isinstance(value, tuple | list) else [value]:
            item = getattr(item, "jaxpr", item)
            if hasattr(item, "eqns"):
                found.append(item)
    return found


def count(jaxpr: Any, times: int = 1) -> Counter[str]:
    """Return elementwise operations, transcendental ones among them, and equations of a jaxpr and those inside."""
    total: Counter[str] = Counter()
    for eqn in jaxpr.eqns:
        name, size = eqn.primitive.name, sum(math.prod(v.aval.shape) for v in eqn.outvars)
        called = str(eqn.params.get("name", ""))
        if called in POLYNOMIALS:
            total["transcendentals"] += times * size
        parts = inner(eqn)
        for part in parts:
            total += count(part, times * eqn.params.get("length", 1) if name == "scan" else times)
        total["equations"] += 1
        if parts or name in MOVES:
            continue
        if name == "dot_general":
            (contract, _), _ = eqn.params["dimension_numbers"]
            size *= 2 * math.prod(eqn.invars[0].aval.shape[i] for i in contract)
        if name.startswith("reduce"):
            size = math.prod(eqn.invars[0].aval.shape)
        total["operations"] += times * size
        total["transcendentals"] += times * size * (name in TRANSCENDENTAL)
    return total


def traced(function: Any, *args: Any) -> dict[str, int]:
    return dict(sorted(count(jax.make_jaxpr(function)(*args).jaxpr).items()))


def measure() -> dict[str, dict[str, int]]:
    """Return the counts of a right-hand side of 10 strips, the wing's table at a phase, and flights."""
    problem = wb.OrbitProblem(wb.load_species("bat"), speed=10.0)
    model, beat, point = problem.model, problem.species.wingbeat, start_point(problem, 0, 0)
    table = motion_table(model, beat, jnp.asarray(0.3))

    def value(start: Any) -> Any:
        (rows, step), like = tabulated(model, beat, 0.0, 1.0)
        return march(model, rows, like, step, start)

    def flight(values: Any, start: Any) -> Any:
        static = {"free": problem.free, "components": 1, "stroke": True}
        return fly_part._function(model, beat, values, start, 0.0, 1.0, **static)

    return {
        "right-hand side": traced(lambda state: body_rates(model, table, state), point[:4]),
        "wing table at a phase": traced(lambda phase: motion_table(model, beat, phase), np.asarray(0.3)),
        f"flight of {STEPS} steps": traced(value, point[:4]),
        f"flight of {STEPS} steps with derivatives": traced(flight, point[4:], point[:4]),
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--write", action="store_true", help="make this the baseline")
    chosen = parser.parse_args()
    found = measure()
    before = json.loads(BASELINE.read_text()) if BASELINE.exists() else {}
    for name, counts in found.items():
        old = before.get(name, {})
        print(name, ", ".join(f"{key} {value} (baseline {old.get(key, '-')})" for key, value in counts.items()))
    if chosen.write:
        BASELINE.write_text(json.dumps(found, indent=2) + "\n")


if __name__ == "__main__":
    main()
