"""Write docs/evidence/slow_flight.md: which single change makes a slow pigeon beat as slowly as live ones.

    python validation/slow_flight.py

The base is a pigeon with the gliding wing, rotation, added mass, induced flow and body drag. Each row changes one
thing and solves for the least frequency at every speed; the last row is the model ``animal``.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import wingbeat as wb
from wingbeat.files import writing

SPEEDS = 4.0, 6.0, 8.0, 10.0
STARTS = 6
PAGE = Path(__file__).parents[1] / "docs" / "evidence" / "slow_flight.md"
TEXT = """# Slow flight

`python validation/slow_flight.py` writes the table of this page. It asks which single change lets a pigeon fly
slowly at the frequency of live pigeons. Live pigeons beat their wings at 8.0 Hz at 4.5 m/s (Usherwood et al. 2005,
doi 10.1242/jeb.01359), and at 6.1 to 9.6 Hz at 3 to 5 m/s (Berg and Biewener 2008, J Exp Biol 211:1120, abstract).

The base is the pigeon of the species file with body drag, the polar of a gliding wing (`feathered`), rotation,
added mass and induced flow. Most rows change one thing; a row that changes two names both. The table shows the
lowest frequency [Hz] that six starts found for level flight.

{table}

- **Delayed stall lowers the frequency** by 11 % at 4 m/s and by 12 to 20 % at higher speeds. The polar of a
  revolving wing lowers the frequency more than delayed stall does at 4 and 6 m/s, and less at 8 and 10 m/s. Dried
  pigeon wings that revolve reach a C_L of 1.64, and gliding wings reach 1.38 ([sources](animal_wings.md)). The
  part of the polar between attached flow and delayed stall is a guess.
- A free downstroke fraction lowers the frequency by 11 % at 4 m/s and by 5 to 8 % at higher speeds. Free twist
  lowers the frequency by 8 % at 4 m/s and by 11 to 14 % at higher speeds. We found no measurement of the downstroke
  fraction or of the twist of pigeons.
- Four changes alter the frequency at 4 m/s by at most 2 % each: a longer chord, a span that retracts more, an
  upstroke with half the load, and a tail. At 8 and 10 m/s, a longer chord lowers the frequency by 7 %.
- Rotation and added mass raise the frequency by 7 to 15 %.
- Shoulders at their measured place, ahead of the centre of mass, raise the frequency. A free tilt of the stroke
  plane makes up for this rise only at 10 m/s.

The model `animal` ([models](../guide/models.md)) has the delayed stall, a tail and a free downstroke fraction. At
4 m/s the lowest frequency found with this model is 9.6 Hz, a fifth above the 8.0 Hz of live pigeons at 4.5 m/s. At
6 m/s it is 8.5 Hz. The remaining difference may be due to a C_L above 1.64, to the clap of the wings at the top of
the stroke, or to twist. We found no measured values of these.
"""


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


def main() -> None:
    """Solve every trial and write the page."""
    heads = " | ".join(f"{speed:g} m/s" for speed in SPEEDS)
    lines = [f"| change | {heads} |", "|---|" + "---|" * len(SPEEDS)]
    for trial in trials():
        found = [least_frequency(trial, speed) for speed in SPEEDS]
        lines.append(f"| {trial.name} | {' | '.join(found)} |")
        print(lines[-1], flush=True)
    with writing(PAGE) as file:
        Path(file).write_text(TEXT.format(table="\n".join(lines)))


if __name__ == "__main__":
    main()
