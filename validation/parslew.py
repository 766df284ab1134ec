"""Write docs/evidence/parslew.md: what another predictive model of a pigeon does, and what ours does.

    python validation/parslew.py [--page]

Parslew 2015 (doi 10.1098/rsif.2014.0953) and Parslew and Crowther 2010 (doi 10.1016/j.jbiomech.2010.07.018)
predict the flight of a pigeon that spends the least mechanical power. We could read only their abstracts, so this
page tests the statements that stand there. Flights are kept in ``data/parslew.csv``; with ``--page`` nothing is
flown.
"""

from __future__ import annotations

import argparse
import dataclasses
import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pandas as pd
from parslew_words import page

import wingbeat as wb
from wingbeat._base import write_atomically

ROOT = Path(__file__).parents[1]
TABLE, PAGE, FIGURE = (
    ROOT / "data" / "parslew.csv",
    ROOT / "docs" / "evidence" / "parslew.md",
    ROOT / "docs" / "evidence" / "parslew.png",
)
CRUISE = 6.0, 8.0, 10.0, 12.0, 14.0, 16.0, 18.0  # m/s, as live pigeons
CLIMBS = 0.5, 1.0, 2.0, 3.0, 4.0  # m/s
CLIMB_SPEED = 8.0  # m/s forward
HIGHEST = 9.6  # Hz, the highest frequency measured on pigeons (Berg and Biewener 2008)
RETRACTED = 0.6  # largest share of the span that the wing may retract
HOVER = 0.0, 0.3, 0.5  # shares of the span retracted in hover
STARTS = 12


def flown(flight: str, speed: float, climb: float = 0.0, held: float | None = None, live: bool = True) -> dict:
    """Fly the pigeon of the model `animal` at least positive power.

    Parameters
    ----------
    flight : name of the group of flights.
    speed, climb : forward and up [m/s].
    held : share of the span that the wing retracts on the upstroke; free, up to `RETRACTED`, if None.
    live : whether the frequency is at most that of live pigeons.
    """
    pigeon = wb.load_species("pigeon")
    model = wb.models.animal(pigeon)
    species = model.species(pigeon)
    bounds = {"stroke_plane_tilt": (-math.radians(60), math.radians(60))}
    if held is None:
        bounds["span_retraction"] = (0.0, RETRACTED)
    else:
        wingbeat = dataclasses.replace(species.wingbeat, span_retraction=held)
        species = dataclasses.replace(species, wingbeat=wingbeat)
    problem = model.problem(
        species,
        speed,
        climb,
        minimise="mean_positive_power",
        subject_to=f"frequency<={HIGHEST}" if live else (),
        free=(*species.free, *bounds),
        bounds=bounds,
    )
    orbit = wb.solve_orbit(problem, starts=STARTS)
    row = {"flight": flight, "speed": speed, "climb": climb, "held": held, "live": live}
    if orbit.status is not wb.Status.CONVERGED:
        return row
    beat, wing, vehicle = orbit.wingbeat, problem.vehicle.wing, problem.vehicle
    pitch = float(np.mean(orbit.dataset["body_pitch"].values[:-1]))
    from_vertical = pitch + 0.5 * math.pi - wing.stroke_plane_angle - beat.stroke_plane_tilt
    return row | {
        "power_per_mass": orbit.record()["mean_positive_power"] / vehicle.mass,
        "frequency": beat.frequency,
        "amplitude_deg": math.degrees(beat.flap_amplitude),
        "from_vertical_deg": math.degrees(from_vertical),
        "retraction": beat.span_retraction,
    }


def flights() -> Iterator[dict]:
    """Yield all flights."""
    for live in (True, False):
        for speed in CRUISE:
            yield flown("cruise", speed, live=live)
            yield flown("cruise, spread", speed, held=0.0, live=live)
        yield flown("hover", 0.0, live=live)
        for held in HOVER:
            yield flown("hover", 0.0, held=held, live=live)
        for climb in CLIMBS:
            yield flown("climb", CLIMB_SPEED, climb, live=live)


def main() -> None:
    """Fly all, keep the table, and write the page and its figure."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--page", action="store_true", help="write the page from the table, without flying")
    if not parser.parse_args().page:
        rows = []
        for row in flights():
            rows.append(row)
            print(row, flush=True)
        write_atomically(TABLE, pd.DataFrame(rows).to_csv(index=False, float_format="%.6g"))
    write_atomically(PAGE, page(pd.read_csv(TABLE), FIGURE, HIGHEST))


if __name__ == "__main__":
    main()
