"""Write docs/evidence/slow_flight.md: which single change makes a slow pigeon beat as slowly as live ones.

    python validation/slow_flight.py

The base is a pigeon with the gliding wing, rotation, added mass, induced flow and body drag. Each row changes one
thing and solves for the least frequency at every speed; the last row is the model ``animal``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, NamedTuple

from page_script import write_trials

import wingbeat as wb

SPEEDS = 4.0, 6.0, 8.0, 10.0
STARTS = 6


class Trial(NamedTuple):
    """One change to the base: the species, its air loads, and what is free beyond the species' own."""

    name: str
    species: wb.Species
    aero: Any
    free: dict[str, tuple[float, float]]


def trials() -> Iterator[Trial]:
    """Yield the base, every single change, and the model animal."""
    pigeon = wb.load_species("pigeon").with_alternative("body-drag")
    unsteady = {"unsteady": "thin-aerofoil", "inflow": "momentum"}
    gliding, angle = wb.aero.BladeElement("feathered", **unsteady), math.radians
    yield Trial("base", pigeon, gliding, {})
    yield Trial("no rotation, no added mass", pigeon, wb.aero.BladeElement("feathered", inflow="momentum"), {})
    revolving = wb.aero.BladeElement("feathered-revolving", unsteady="thin-aerofoil")
    yield Trial("revolving wing (`feathered-revolving`), whose polar includes the inflow", pigeon, revolving, {})
    delayed = wb.aero.BladeElement("feathered-flapping", **unsteady)
    yield Trial("delayed stall (`feathered-flapping`)", pigeon, delayed, {})
    yield Trial("downstroke fraction free, 0.4 to 0.6", pigeon, gliding, {"downstroke_fraction": (0.4, 0.6)})
    tilting = {"tail_tilt": (-angle(30), angle(30))}
    yield Trial("tail spread by 60 degrees, its tilt free", pigeon.with_tail(), gliding, tilting)
    ahead = pigeon.with_alternative("shoulder")
    yield Trial("shoulders where they were measured", ahead, gliding, {})
    plane = {"stroke_plane_tilt": (-angle(45), angle(45))}
    yield Trial("these shoulders, and tilt of the stroke plane free", ahead, gliding, plane)
    wider = pigeon.with_values({"wing.chord": 0.13})
    yield Trial("16 % more chord, the top of its range", wider, gliding, {})
    folded = pigeon.with_values({"wingbeat.span_retraction": 0.5})
    yield Trial("half of the span retracted in place of 0.3", folded, gliding, {})
    spared = wb.aero.BladeElement("feathered", upstroke_factor=0.5, **unsteady)
    yield Trial("half the load where air meets the wing from above", pigeon, spared, {})
    yield Trial("twist free, 0 to 3 times the root's pitch", pigeon, gliding, {"twist_ratio": (0.0, 3.0)})
    animal = wb.models.animal(pigeon)
    yield Trial("**the model `animal`**", animal.species(pigeon), animal.aero, {})


def least_frequency(trial: Trial, speed: float) -> str:
    """Return the least frequency of a trial at a speed, or a dash."""
    free = (*trial.species.free, *trial.free)
    problem = wb.OrbitProblem(trial.species, speed, aero=trial.aero, free=free, bounds=trial.free)
    orbit = wb.solve_orbit(problem, starts=STARTS)
    return f"{orbit.wingbeat.frequency:.1f}" if orbit.status is wb.Status.CONVERGED else "-"


if __name__ == "__main__":
    write_trials("slow_flight", SPEEDS, trials(), least_frequency)
