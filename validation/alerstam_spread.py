"""How far the spread of each derived number, and each guess, moves the answers for a few birds."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from alerstam_flights import POWER, SPEEDS, Bird, fly, fly_series, rough
from alerstam_summary import best_speeds

import wingbeat as wb
from wingbeat._workers.pool import in_processes

# Birds of three sizes, within, at and beyond the Reynolds numbers of the fit.
BIRDS = ("Apus apus", "Columba palumbus", "Larus argentatus")


@dataclass(frozen=True)
class Moved:
    """Minimum-power and maximum-range speed [m/s] and least power [W] of one bird with one number changed."""

    species: str
    what: str
    min_power_speed: float
    max_range_speed: float
    least_power: float


def variants(bird: Bird) -> dict[str, wb.Species]:
    """Return the bird, and the bird with each number at either end of its spread."""
    plain = bird.species
    found = {"as derived": plain}
    for name, path in (
        ("wing_mass", "vehicle.wing.mass"),
        ("mass_exponent", "vehicle.wing.mass_exponent"),
        ("pitch_inertia", "vehicle.body.pitch_inertia"),
        ("semi_span", "vehicle.wing.semi_span"),
        ("chord", "vehicle.wing.chord"),
        ("span_retraction", "wingbeat.span_retraction"),
    ):
        number = plain.numbers[path]
        for end, value in zip(("low", "high"), number.range or (), strict=True):
            changed: dict[str, Any] = {name: min(value, 0.5 * bird.span) if name == "semi_span" else value}
            found[f"{name} {end}"] = wb.bird(
                mass=bird.mass, wing_span=bird.span, wing_area=bird.area, name=bird.name, **changed
            )
    return found | {"body-drag": plain.with_alternative("body-drag")}


def spreads(radar: list[Bird], processes: int) -> list[Moved]:
    """Fly every variant of the few birds over the study's speeds, in one batch."""
    asked, named = [], []
    for bird in (bird for bird in radar if bird.name in BIRDS):
        for what, species in variants(bird).items():
            named.append((bird.name, what))
            at_one = math.sqrt(2 * bird.mass * species.air.gravity / (species.air.density * bird.area))
            for factor in SPEEDS:
                asked.append(
                    (POWER, wb.OrbitProblem(species, speed=factor * at_one, minimise="mean_positive_power"))
                )
    points = fly(asked, processes)
    count = len(SPEEDS)
    flown = [points[i * count : (i + 1) * count] for i in range(len(named))]
    poor = [i for i, curve in enumerate(flown) if rough(curve) or math.isnan(best_speeds(curve)[0])]
    again = [[problem for _, problem in asked[i * count : (i + 1) * count]] for i in poor]
    for i, curve in zip(poor, in_processes(fly_series, again, processes), strict=True):
        flown[i] = [
            p if p.power < q.power or math.isnan(q.power) else q for p, q in zip(curve, flown[i], strict=True)
        ]
    return [
        Moved(name, what, *best_speeds([point for point in curve if math.isfinite(point.power)])[:3])
        for (name, what), curve in zip(named, flown, strict=True)
    ]
