"""Write docs/evidence/frequency_trials.md: no change of a pigeon's model gives its frequency.

    python validation/frequency_trials.py

The base is the model ``animal`` with the frequency free. Each row changes one thing and solves again.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterator
from typing import Any, Literal, NamedTuple

from page_script import write_trials

import wingbeat as wb

SPEEDS = 6.0, 10.0, 14.0


class Trial(NamedTuple):
    """One change: the species, the problem's changes, and the frequency: searched for unless it says otherwise."""

    name: str
    species: wb.Species
    changes: dict[str, Any]
    frequency: Literal["own", "free"] = "free"


def trials() -> Iterator[Trial]:
    """Yield the base and every single change."""
    pigeon = wb.load_species("pigeon")
    model = wb.models.animal(pigeon, "free")
    base = model.species(pigeon)
    muscle = base.vehicle.drive.muscle
    assert muscle is not None

    def with_muscle(**numbers: float) -> wb.Species:
        return base.with_values({f"muscle.{name}": value for name, value in numbers.items()})

    yield Trial("**the model `animal`, with the frequency searched for**", base, {})
    stress, rate = muscle.isometric_stress, muscle.max_strain_rate
    yield Trial("isometric stress 400 kPa instead of 250", with_muscle(isometric_stress=400e3), {})
    weaker = with_muscle(isometric_stress=101e3, max_strain_rate=rate * stress / 101e3)
    yield Trial("isometric stress 101 kPa, and faster muscle of the same power", weaker, {})
    yield Trial("muscle half as fast", with_muscle(max_strain_rate=0.5 * rate), {})
    strain = muscle.strain_per_angle
    yield Trial("strain per angle 1.5 times as large", with_muscle(strain_per_angle=1.5 * strain), {})
    yield Trial("tendon of the elevators, 0.15 N m/rad", with_muscle(tendon_compliance=1 / 0.15), {})
    yield Trial(
        "wings of the dissected pigeon: heavier, with their mass closer to the root", _dissected(model, pigeon), {}
    )
    spared = dataclasses.replace(model.aero, upstroke_factor=0.4)
    yield Trial("load times 0.4 where air meets the wing from above", base, {"aero": spared})
    late = dataclasses.replace(model.aero, wake="jones-finite")
    yield Trial("lag of the wake", base, {"aero": late})
    yield Trial("least positive power", base, {"minimise": "mean_positive_power"})
    yield Trial("least metabolic rate, with activation and recovery", base, {"minimise": "metabolic_rate"})
    yield Trial("least activation", base, {"minimise": "peak_activation"})
    yield Trial("activation at most 1", base, {"subject_to": ["peak_activation <= 1"]})
    yield Trial("**its own frequency, given**", base, {}, "own")


def _dissected(model: Any, pigeon: wb.Species) -> wb.Species:
    """Return the pigeon with the wing mass of AvInertia's, and its shoulders where they are."""
    other = pigeon.with_alternative("avinertia").vehicle.wing
    return model.species(pigeon).with_values({"wing.mass": other.mass, "wing.mass_exponent": other.mass_exponent})


def cell(trial: Trial, speed: float) -> str:
    """Return what the best beat of a trial is, or a dash; a star says that a bound chose the frequency."""
    model = wb.models.animal(trial.species, trial.frequency)
    orbit = wb.solve_orbit(model.problem(trial.species, speed=speed, **trial.changes))
    if orbit.status is not wb.Status.CONVERGED:
        return "-"
    record = orbit.record()
    amplitude = math.degrees(orbit.wingbeat.flap_amplitude)
    power = record["mean_positive_power"] / trial.species.vehicle.mass
    star = "*" if "frequency" in record["active_bounds"] else ""
    return f"{orbit.wingbeat.frequency:.1f}{star}, {amplitude:.0f}, {power:.0f}, {record['peak_activation']:.2g}"


if __name__ == "__main__":
    write_trials("frequency_trials", SPEEDS, trials(), cell)
