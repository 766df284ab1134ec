"""Our air loads beside a vortex lattice, for pigeon and bat: two tables, one page, one figure.

Run as ``python validation/second_opinion.py [--page]``, with the extra uvlm; each comparison takes some minutes.
Writes ``data/second_opinion.csv`` and ``data/second_opinion_lattices.csv``, and from them the page; with ``--page``
nothing is computed.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd
from page_script import ROOT, filled

import wingbeat as wb
from wingbeat._base import WingbeatError, write_atomically
from wingbeat.plots import save_figure
from wingbeat_evidence.markdown import markdown_table
from wingbeat_evidence.second_opinion import LatticeOptions, compare_with_lattice
from wingbeat_evidence.second_opinion.comparison import lattice_loads
from wingbeat_evidence.second_opinion.figure import second_opinion_page
from wingbeat_evidence.second_opinion.motion import Motion

DOCS, TABLES = ROOT / "docs" / "evidence", ROOT / "data"
# Animal, speed [m/s], largest flap amplitude [deg] where it is not that of the species file.
CASES = (
    *(("pigeon", speed, None) for speed in (8, 12, 16)),
    *(("bat", speed, None) for speed in (5, 8)),
    *(("pigeon", speed, 45) for speed in (12, 16)),
)
SHOWN = ("pigeon", 12, None)
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
        about["beyond_15_deg"] = record["beyond_15_deg"]
        yield about | {"loads": LATTICE} | {name: record[name]["theirs"] for name in MEANS}
        for row in record["terms"]:
            found = about | {"loads": TERMS[row["unsteady"], row["inflow"]]}
            if "refused" not in row:
                found |= {name: row[name]["ours"] for name in MEANS}
                found["lift_lag"] = row["lift_lag"]
                found["rms_over_weight"] = row["lift_rms_difference"]
                found["rms_over_lattice"] = row["lift_rms_difference"] / row["lift_rms_of_theirs"]
            yield found


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


def page(flights: pd.DataFrame, lattices: pd.DataFrame) -> str:
    """Return the page.

    Parameters
    ----------
    flights : rows of `compared`.
    lattices : rows of `converged`.
    """
    cells: dict[tuple[Any, ...], list[str]] = {}
    for row in flights.itertuples():
        means = ", ".join(
            f"{value:.3g}" if abs(value) > 5e-4 else "0" for value in (getattr(row, m) for m in MEANS)
        )
        name = f"{row.animal} {row.speed} m/s"
        name += "" if pd.isna(row.flap_amplitude_deg) else f", flap at most {row.flap_amplitude_deg:.0f} deg"
        own = cells.setdefault((name,), [name, f"{row.beyond_15_deg:.0%}"])
        own.append(means if row.loads == LATTICE else f"{means}; {row.rms_over_lattice:.2f}; {row.lift_lag:+.3f}")
    theirs, alone = (flights[flights["loads"] == name] for name in (LATTICE, TERMS["none", "none"]))
    power = theirs["aerodynamic_power"].to_numpy() / alone["aerodynamic_power"].to_numpy()
    default, finest = lattices.iloc[1], lattices.iloc[-1]
    names = dict(zip(MEANS, ("lift", "thrust", "power"), strict=True))
    rows = [
        [
            f"{row.chordwise} x {row.spanwise}, {row.steps}, {row.beats}",
            f"{row.mean_lift:.3f}, {row.mean_thrust:.3f}, {row.aerodynamic_power:.2f}",
            f"{row.first_harmonic:.3f}, {row.phase_of_first:.3f}",
        ]
        for row in lattices.itertuples()
    ]
    heads = [
        "panels (chord x span), steps per beat, beats",
        "lift, thrust, power",
        "first harmonic [N], its phase",
    ]
    return filled(
        "second_opinion",
        table=markdown_table(["flight", "beyond 15 deg", LATTICE, *TERMS.values()], cells.values()),
        least=flights["beyond_15_deg"].min(),
        most=flights["beyond_15_deg"].max(),
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
            for table, found in zip(tables, (compared(), converged(solved(*SHOWN))), strict=True):
                write_atomically(table, pd.DataFrame(found).to_csv(index=False, float_format="%.4g"))
        write_atomically(DOCS / "second_opinion.md", page(*map(pd.read_csv, tables)))
    except WingbeatError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
