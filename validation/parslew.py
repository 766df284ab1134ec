"""Write docs/parslew.md: what a predicted pigeon of other authors does, and what ours does.

    python validation/parslew.py

Parslew 2015 (doi 10.1098/rsif.2014.0953) and Parslew and Crowther 2010 predict the flight of a pigeon that spends
the least mechanical power. We could read only their abstracts, so this page tests the statements that stand there.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np

import wingbeat as wb
from wingbeat.files import writing

CRUISE = 6.0, 8.0, 10.0, 12.0, 14.0, 16.0, 18.0
CLIMBS = 0.5, 1.0, 2.0, 3.0, 4.0
CLIMB_SPEED = 8.0
RETRACTED = 0.6
STARTS = 12
PAGE = Path(__file__).parents[1] / "docs" / "parslew.md"


class Flown(NamedTuple):
    """A flight, or what stood in its way: numbers are None if no orbit was certified."""

    speed: float
    climb: float
    power: float | None = None
    frequency: float | None = None
    amplitude_deg: float | None = None
    from_vertical_deg: float | None = None
    retraction: float | None = None


def flown(speed: float, climb: float = 0.0, retraction: float | None = None) -> Flown:
    """Fly the pigeon of the model `animal` at least positive power; span retraction is free unless given."""
    pigeon = wb.load_species("pigeon")
    model = wb.models.animal(pigeon)
    species = model.species(pigeon)
    bounds = {"stroke_plane_tilt": (-math.radians(60), math.radians(60))}
    if retraction is None:
        bounds["span_retraction"] = (0.0, RETRACTED)
    else:
        wingbeat = dataclasses.replace(species.wingbeat, span_retraction=retraction)
        species = dataclasses.replace(species, wingbeat=wingbeat)
    problem = model.problem(
        species, speed, climb, minimise="mean_positive_power", free=(*species.free, *bounds), bounds=bounds
    )
    orbit = wb.solve_orbit(problem, starts=STARTS)
    if orbit.status is not wb.Status.CONVERGED:
        return Flown(speed, climb)
    beat, wing = orbit.wingbeat, problem.vehicle.wing
    pitch = float(np.mean(orbit.dataset()["body_pitch"].values[:-1]))
    attitude = pitch + 0.5 * math.pi - wing.stroke_plane_angle - beat.stroke_plane_tilt
    return Flown(
        speed,
        climb,
        orbit.record()["mean_positive_power"],
        beat.frequency,
        math.degrees(beat.flap_amplitude),
        math.degrees(attitude),
        beat.span_retraction,
    )


def cruise() -> Iterator[tuple[Flown, Flown]]:
    """Yield the flights at every speed with the span retraction free, and with the wings spread."""
    for speed in CRUISE:
        yield flown(speed), flown(speed, retraction=0.0)


def main() -> None:
    """Fly all and print."""
    print("cruise", flush=True)
    for free, spread in cruise():
        print(free, spread, flush=True)
    print("hover", flush=True)
    for retraction in (None, 0.0, 0.3, 0.5):
        print(retraction, flown(0.0, retraction=retraction), flush=True)
    print("climb", flush=True)
    for climb in CLIMBS:
        print(flown(CLIMB_SPEED, climb), flush=True)


if __name__ == "__main__":
    main()
