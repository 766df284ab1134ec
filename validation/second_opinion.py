"""Our air loads beside a vortex lattice, for orbits of two models: two tables, one page, one figure.

Run as ``python validation/second_opinion.py [--page]``, with the extra uvlm; each comparison takes some minutes.
Writes ``data/second_opinion.csv`` and ``data/second_opinion_lattices.csv``, and from them the page; with ``--page``
nothing is computed.
"""

from __future__ import annotations

import argparse
import dataclasses
import math
import sys
from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd
from page_script import ROOT, filled

import wingbeat as wb
from wingbeat._base import WingbeatError, write_atomically
from wingbeat._jax.arrays import jnp
from wingbeat.plots import save_figure
from wingbeat_evidence.markdown import markdown_table
from wingbeat_evidence.second_opinion import LatticeOptions, compare_with_lattice
from wingbeat_evidence.second_opinion.comparison import ATTACHED, differences, lattice_loads
from wingbeat_evidence.second_opinion.figure import second_opinion_page
from wingbeat_evidence.second_opinion.lattice import no_lift_angle
from wingbeat_evidence.second_opinion.motion import Motion
from wingbeat_evidence.second_opinion.own_loads import own_loads

DOCS, TABLES = ROOT / "docs" / "evidence", ROOT / "data"
# Animal, speed [m/s], largest flap amplitude [deg] where it is not that of the species file.
CASES = (
    *(("pigeon", speed, None) for speed in (8, 12, 16)),
    *(("bat", speed, None) for speed in (5, 8)),
    *(("pigeon", speed, 45) for speed in (12, 16)),
)
SHOWN = ("pigeon", 12, None)
# Flights of the model animal, with and without the lag of the wake.
ANIMALS = (("pigeon", 10), ("pigeon", 14), ("common-starling", 10), ("cockatiel", 9), ("bat", 6))
WAKES = {"none": "", "jones-section": ", jones-section", "jones-finite": ", jones-finite"}
OWN, IDEAL = "own", "ideal wing"
FLOWN, HELD = "as flown", "held"
LATTICES = (
    LatticeOptions(2, 6, 24, 2),
    LatticeOptions(),
    LatticeOptions(beats=3),
    LatticeOptions(6, 18, 72, 2),
)
LATTICE = "vortex lattice"
TERMS = {
    ("none", "none"): "coefficients alone",
    ("thin-aerofoil", "none"): "rotation, added mass",
    ("none", "momentum"): "inflow",
    ("thin-aerofoil", "momentum"): "both",
}
MEANS = ("mean_lift", "mean_thrust", "aerodynamic_power")


def solved(animal: str, speed: float, amplitude: float | None) -> wb.Orbit:
    """Return the orbit of least frequency."""
    species = wb.load_species(animal)
    bounds = {} if amplitude is None else {"flap_amplitude": (0.0, float(np.radians(amplitude)))}
    return wb.solve_orbit(wb.OrbitProblem(species, speed=speed, bounds=bounds or None))


def compared() -> Iterator[dict[str, Any]]:
    """Yield a row for each flight and loads, and draw the flight that the page shows."""
    for case in CASES:
        opinion = compare_with_lattice(solved(*case))
        if case == SHOWN:
            save_figure(second_opinion_page(opinion), DOCS / "second_opinion.png")
        record = opinion.record()
        about = dict(zip(("animal", "speed", "flap_amplitude_deg"), case, strict=True))
        about |= {"model": "paper", "span": FLOWN, "beyond_15_deg": record["beyond_15_deg"]}
        yield about | {"loads": LATTICE} | {name: record[name]["theirs"] for name in MEANS}
        for row in record["terms"]:
            found = about | {"loads": TERMS[row["unsteady"], row["inflow"]]}
            if "refused" not in row:
                found |= {name: row[name]["ours"] for name in MEANS} | compared_lifts(row)
            yield found


class IdealWing(wb.aero.FunctionCoefficients):
    """The polar of a finite wing in an ideal fluid, as if of a section: its induced flow is in it."""

    aspect_ratio = math.inf


def ideal_wing(aspect_ratio: float, no_lift: float) -> IdealWing:
    """Return Prandtl's polar ``C_L = 2 pi A/(A + 2) sin(alpha - alpha_0)`` of an elliptic wing, without drag."""
    slope = 2 * math.pi * aspect_ratio / (aspect_ratio + 2)
    return IdealWing(lambda alpha: (slope * jnp.sin(alpha - no_lift), 0.0 * alpha), IDEAL)


def lagged() -> Iterator[dict[str, Any]]:
    """Yield rows of the same columns for flights of the model animal: with each lag, and with the span held."""
    for animal, speed in ANIMALS:
        species = wb.load_species(animal)
        orbit = wb.solve_orbit(wb.models.animal(species).problem(species, speed=speed))
        model, aero = orbit.problem.model, orbit.problem.aero
        wing = model.vehicle.wing
        ideal = ideal_wing(2 * wing.semi_span / wing.mean_chord, no_lift_angle(aero.coefficients))
        loads = {OWN: aero, IDEAL: dataclasses.replace(aero, coefficients=ideal, inflow="none")}
        flown = Motion.of(orbit.dataset, model.vehicle, orbit.wingbeat, model.air)
        held = dataclasses.replace(flown, wingbeat=dataclasses.replace(orbit.wingbeat, span_retraction=0.0))
        for span, motion in ((FLOWN, flown), (HELD, held)):
            yield from _with_each_lag(
                {"animal": animal, "speed": speed, "model": "animal", "span": span}, motion, loads
            )


def _with_each_lag(
    about: dict[str, Any], motion: Motion, loads: dict[str, wb.aero.BladeElement]
) -> Iterator[dict[str, Any]]:
    options, weight = LatticeOptions(), motion.vehicle.mass * motion.air.gravity
    phase = np.arange(0, options.steps, 2) / options.steps
    theirs = lattice_loads(motion, options, None, loads[OWN])
    alpha = own_loads(motion, loads[OWN], phase).alpha
    assert alpha is not None
    about["beyond_15_deg"] = float(np.mean(np.abs(alpha) > ATTACHED))
    means = (float(np.mean(series)) for series in (theirs.lift, theirs.thrust, theirs.power))
    yield about | {"loads": LATTICE} | dict(zip(MEANS, means, strict=True))
    for name, aero in loads.items():
        for wake, label in WAKES.items():
            ours = own_loads(motion, dataclasses.replace(aero, wake=wake), phase)
            row = differences(ours, theirs, weight)
            yield (
                about | {"loads": name + label} | {mean: row[mean]["ours"] for mean in MEANS} | compared_lifts(row)
            )


def compared_lifts(row: dict[str, Any]) -> dict[str, float]:
    """Return the columns that compare two lifts."""
    difference = row["lift_rms_difference"]
    return {
        "lift_lag": row["lift_lag"],
        "rms_over_weight": difference,
        "rms_over_lattice": difference / row["lift_rms_of_theirs"],
    }


def converged(orbit: wb.Orbit) -> Iterator[dict[str, Any]]:
    """Yield what finer lattices and more beats make of an orbit."""
    model = orbit.problem.model
    motion = Motion.of(orbit.dataset, model.vehicle, orbit.wingbeat, model.air)
    for options in LATTICES:
        loads = lattice_loads(motion, options)
        first = 2 * np.fft.rfft(loads.lift)[1] / len(loads.lift)
        means = (float(np.mean(series)) for series in (loads.lift, loads.thrust, loads.power))
        harmonic = {
            "first_harmonic": float(abs(first)),
            "phase_of_first": float(-np.angle(first) / (2 * np.pi) % 1.0),
        }
        yield vars(options) | dict(zip(MEANS, means, strict=True)) | harmonic


def _rows(flights: pd.DataFrame) -> list[list[str]]:
    """Return a row for each flight, with a cell for each of its loads."""
    rows: dict[str, list[str]] = {}
    for row in flights.itertuples():
        means = ", ".join(
            f"{value:.3g}" if abs(value) > 5e-4 else "0" for value in (getattr(row, m) for m in MEANS)
        )
        name = f"{row.animal} {row.speed} m/s"
        own = rows.setdefault(name, [name])
        own.append(means if row.loads == LATTICE else f"{means}; {row.rms_over_lattice:.2f}; {row.lift_lag:+.3f}")
    return list(rows.values())


def _differences(flights: pd.DataFrame) -> str:
    """Return the table of the differences in lift of all flights with the span held, and their mean delays."""
    rows = []
    for loads in (OWN, IDEAL):
        cells = [loads]
        for label in WAKES.values():
            of = flights[(flights["span"] == HELD) & (flights["loads"] == loads + label)]
            each = ", ".join(f"{value:.2f}" for value in of["rms_over_lattice"])
            cells.append(f"{each}; {of['lift_lag'].mean():+.3f}")
        rows.append(cells)
    return markdown_table(["span held", *(label.removeprefix(", ") or "no lag" for label in WAKES.values())], rows)


def page(flights: pd.DataFrame, lattices: pd.DataFrame) -> str:
    """Return the page.

    Parameters
    ----------
    flights : rows of `compared`.
    lattices : rows of `converged`.
    """
    of_paper, of_animal = (flights[flights["model"] == model] for model in ("paper", "animal"))
    shown = of_animal[(of_animal["span"] == FLOWN) & ~of_animal["loads"].str.startswith(IDEAL)]
    theirs, alone = (of_paper[of_paper["loads"] == name] for name in (LATTICE, TERMS["none", "none"]))
    power = theirs["aerodynamic_power"].to_numpy() / alone["aerodynamic_power"].to_numpy()
    default, finest = lattices.iloc[1], lattices.iloc[-1]
    names = dict(zip(MEANS, ("lift", "thrust", "power"), strict=True))
    rows = [
        [
            f"{row.chordwise} x {row.spanwise}, {row.steps}, {row.beats}",
            f"{row.mean_lift:.3f}, {row.mean_thrust:.3f}, {row.aerodynamic_power:.2f}",
            f"{row.first_harmonic:.3f}, {row.phase_of_first:.3f}",
        ]
        for row in lattices[lattices["beats"] == default["beats"]].itertuples()
    ]
    heads = [
        "panels (chord x span), steps per beat, beats",
        "lift, thrust, power",
        "first harmonic [N], its phase",
    ]
    return filled(
        "second_opinion",
        least=of_paper["beyond_15_deg"].min(),
        most=of_paper["beyond_15_deg"].max(),
        animals=markdown_table(
            ["flight", LATTICE, OWN, *(wake for wake, label in WAKES.items() if label)], _rows(shown)
        ),
        beyond=shown["beyond_15_deg"].max(),
        differences=_differences(of_animal),
        low=power.min(),
        high=power.max(),
        convergence=markdown_table(heads, rows),
        errors=", ".join(f"{abs(default[key] / finest[key] - 1):.1%} in {name}" for key, name in names.items()),
    )


def main() -> int:
    """Compare, and write tables, page and figure; return the exit code."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--page", action="store_true", help="write the page from the tables, without computing")
    tables = TABLES / "second_opinion.csv", TABLES / "second_opinion_lattices.csv"
    try:
        if not parser.parse_args().page:
            for table, found in zip(tables, ((*compared(), *lagged()), converged(solved(*SHOWN))), strict=True):
                write_atomically(table, pd.DataFrame(found).to_csv(index=False, float_format="%.4g"))
        write_atomically(DOCS / "second_opinion.md", page(*map(pd.read_csv, tables)))
    except WingbeatError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
