"""Write docs/evidence/frequency_trials.md: which change of a pigeon's model gives the frequency of live pigeons.

    python validation/frequency_trials.py

The base is the model ``animal``. Each row changes one thing and solves again; the table is written after each row.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import wingbeat as wb
from wingbeat.files import write_atomically

SPEEDS = 6.0, 10.0, 14.0
PAGE = Path(__file__).parents[1] / "docs" / "evidence" / "frequency_trials.md"
TEXT = """# What sets the frequency?

`python validation/frequency_trials.py` writes the table of this page. Live pigeons beat at 5.4 to 9.6 Hz at all
speeds, with 19 to 61 degrees of amplitude ([whole flights](flight_pigeon.md)). The model `animal`
([models](../guide/models.md)) does not predict this: in its beats of least metabolic power of the flight muscle,
the frequency is 14 to 17 Hz up to 10 m/s and 4 Hz around 13 m/s. Each row changes one thing in that model. A cell
holds frequency [Hz], flap amplitude [deg], positive power [W/kg of the bird] and activation, the largest share of
the flight muscle's fibres that the beat uses.

{table}

- **No single number of the muscle gives the frequency of live pigeons at all three speeds.** A change of the
  muscle's mass, share of elevators, strength, speed or leverage changes the frequency by at most 1.7 Hz at 6 and
  10 m/s, and by at most 1.5 Hz at 14 m/s.
- Weak and fast muscle, with the stress that was measured in a zebra finch's pectoralis, comes closest to live
  pigeons: 5.2 Hz at 14 m/s.
- Heavier wings with their mass closer to the root, a span that retracts more, and an upstroke with 0.4 of its load
  change the frequency by at most 1 Hz.
- If the model may also tilt its stroke plane and retract its span, it needs 10 to 35 % less power, and its
  frequency rises by 0.2 to 1.9 Hz.
- The beat of least positive power does not have the frequency of live pigeons either: at 10 m/s it is at the bound
  of 30 Hz. The beat of least activation does not have it at any of the three speeds.
- **Up to 10 m/s the elevators are too weak for any of these beats.** The elevators must stop the wings at the end
  of the downstroke and raise them. If the elevators have three times the mass, activation falls from 8.3 to 3.6 at
  6 m/s, and from 2.3 to 1.2 at 10 m/s.

Three effects are missing from the model. We do not know how large the first two are:

- Activating and relaxing a muscle costs energy and takes time, so each beat has a fixed cost
  ([muscles](../guide/muscles.md)). We found no value of this cost for birds. People who push against a fixed bar
  2.5 times a second spend 40 % of their energy on the fast rise of the force (van der Zee and Kuo 2021, J Exp Biol
  224:jeb233965, abstract).
- Stopping the wing at the end of the downstroke costs the model's elevators more than it costs a live bird's
  elevators. A live bird's wings fold there, and its tendons may store energy.
- The lift of a beating wing lags behind the wing's motion because of the wake. Orbits do not include this lag, so
  fast beats are too cheap (`wingbeat validate` can include it for measured motions). By thin-aerofoil theory for a
  wing that only plunges (Garrick 1936, NACA Report 567), at 12 m/s a share of 0.57 of the power becomes thrust at
  30 Hz, and 0.82 at 5 Hz. At 10 m/s the shares are 0.61 at 17 Hz and 0.72 at 8 Hz. Without the lag, all of the
  power would become thrust.

Each of these three effects may lower the frequency in slow flight. None of them explains the slow beats around 13
m/s. At these speeds the optimum is flat: at 12 m/s, beats of 6 to 18 Hz cost the same within 14 %.
"""


class Trial(NamedTuple):
    """One change: the species, what the model's air loads become, and what is minimised."""

    name: str
    species: wb.Species
    changes: dict[str, Any]


def trials() -> Iterator[Trial]:
    """Yield the base and every single change."""
    pigeon = wb.load_species("pigeon")
    model = wb.models.animal(pigeon)
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
    yield Trial("half of the span retracted instead of 0.3", folded, {})
    tilting = {"stroke_plane_tilt": (-math.radians(60), math.radians(60)), "span_retraction": (0.0, 0.6)}
    freed = {"free": (*base.free, *tilting), "bounds": tilting}
    yield Trial("tilt of the stroke plane and span retraction (up to 0.6) free", base, freed)
    light = with_muscle(elevator_share=1 / 3)
    yield Trial("the same, and elevators with a third of the depressors' mass", light, freed)
    spared = dataclasses.replace(model.aero, upstroke_factor=0.4)
    yield Trial("load times 0.4 where air meets the wing from above", base, {"aero": spared})
    yield Trial("least positive power", base, {"minimise": "mean_positive_power"})
    yield Trial("least activation", base, {"minimise": "peak_activation"})
    yield Trial("least frequency", base, {"minimise": "frequency"})


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


def main() -> None:
    """Solve every trial and write the page."""
    model = wb.models.animal(wb.load_species("pigeon"))
    heads = " | ".join(f"{speed:g} m/s" for speed in SPEEDS)
    lines = [f"| change | {heads} |", "|---|" + "---|" * len(SPEEDS)]
    for trial in trials():
        found = [cell(model, trial, speed) for speed in SPEEDS]
        lines.append(f"| {trial.name} | {' | '.join(found)} |")
        print(lines[-1], flush=True)
    write_atomically(PAGE, TEXT.format(table="\n".join(lines)))


if __name__ == "__main__":
    main()
