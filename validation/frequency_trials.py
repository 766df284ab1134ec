"""Write docs/evidence/frequency_trials.md: which change of a pigeon's model gives the frequency of live pigeons.

    python validation/frequency_trials.py

The base is the model ``animal`` that searches for the frequency. Each row changes one thing and solves again; the
table is written after each row.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterator
from typing import Any, NamedTuple

from page_script import write_trials

import wingbeat as wb

SPEEDS = 6.0, 10.0, 14.0


class Trial(NamedTuple):
    """One change: the species, what the model's air loads become, and what is minimised."""

    name: str
    species: wb.Species
    changes: dict[str, Any]


def trials() -> Iterator[Trial]:
    """Yield the base and every single change."""
    pigeon = wb.load_species("pigeon")
    model = _model(pigeon)
    base = model.species(pigeon)
    muscle = base.vehicle.muscle
    assert muscle is not None

    def with_muscle(**numbers: float) -> wb.Species:
        return base.with_values({f"muscle.{name}": value for name, value in numbers.items()})

    yield Trial("**the model `animal`**", base, {})
    yield Trial("depressors of 0.19 of the mass, as in pigeons, instead of 0.14", with_muscle(mass=0.059), {})
    yield Trial(
        "elevators with a third of the depressors' mass instead of a ninth", with_muscle(elevator_share=1 / 3), {}
    )
    stress, rate = muscle.isometric_stress, muscle.max_strain_rate
    yield Trial("isometric stress 400 kPa instead of 250", with_muscle(isometric_stress=400e3), {})
    weaker = with_muscle(isometric_stress=101e3, max_strain_rate=rate * stress / 101e3)
    yield Trial("isometric stress 101 kPa, and faster muscle of the same power", weaker, {})
    yield Trial("muscle half as fast", with_muscle(max_strain_rate=0.5 * rate), {})
    strain = muscle.strain_per_angle
    yield Trial("strain per angle 1.5 times as large", with_muscle(strain_per_angle=1.5 * strain), {})
    yield Trial(
        "wings of the dissected pigeon: heavier, with their mass closer to the root", _dissected(model, pigeon), {}
    )
    folded = base.with_values({"wingbeat.span_retraction": 0.5})
    held = {"free": tuple(name for name in base.free if name != "span_retraction")}
    yield Trial("half of the span retracted instead of 0.3", folded, held)
    tilting = {"stroke_plane_tilt": (-math.radians(60), math.radians(60)), "span_retraction": (0.0, 0.6)}
    freed = {"free": tuple(dict.fromkeys((*base.free, *tilting))), "bounds": tilting}
    yield Trial("tilt of the stroke plane and span retraction (up to 0.6) free", base, freed)
    light = with_muscle(elevator_share=1 / 3)
    yield Trial("the same, and elevators with a third of the depressors' mass", light, freed)
    spared = dataclasses.replace(model.aero, upstroke_factor=0.4)
    yield Trial("load times 0.4 where air meets the wing from above", base, {"aero": spared})
    yield Trial("least positive power", base, {"minimise": "mean_positive_power"})
    yield Trial("least activation", base, {"minimise": "peak_activation"})
    yield Trial("least frequency", base, {"minimise": "frequency"})


def _model(pigeon: wb.Species) -> Any:
    """Return the model `animal` that searches for the frequency, which by itself is that of live pigeons."""
    return wb.models.animal(pigeon, "free")


def _dissected(model: Any, pigeon: wb.Species) -> wb.Species:
    """Return the pigeon with the wing mass of AvInertia's, and its shoulders where they are."""
    other = pigeon.with_alternative("avinertia").vehicle.wing
    return model.species(pigeon).with_values({"wing.mass": other.mass, "wing.mass_exponent": other.mass_exponent})


def cell(model: Any, trial: Trial, speed: float) -> str:
    """Return what the best beat of a trial is, or a dash."""
    orbit = wb.solve_orbit(model.problem(trial.species, speed=speed, **trial.changes))
    if orbit.status is not wb.Status.CONVERGED:
        return "-"
    record = orbit.record()
    amplitude = math.degrees(orbit.wingbeat.flap_amplitude)
    power = record["mean_positive_power"] / trial.species.vehicle.mass
    return f"{orbit.wingbeat.frequency:.1f}, {amplitude:.0f}, {power:.0f}, {record['peak_activation']:.2g}"


if __name__ == "__main__":
    ANIMAL = _model(wb.load_species("pigeon"))
    write_trials("frequency_trials", SPEEDS, trials(), lambda trial, speed: cell(ANIMAL, trial, speed))
