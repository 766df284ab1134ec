"""Our air loads beside a vortex lattice, for pigeon and bat: one table, one figure.

Run as ``python validation/second_opinion.py [--records FOLDER] [-o FOLDER]``, with the extra uvlm; writes
second_opinion.md and .png. Records in the folder are used again; missing ones are computed, in some minutes each.
"""

from __future__ import annotations

import argparse
import json
import sys
from pathlib import Path

import numpy as np
from second_opinion_words import page

import wingbeat as wb
from wingbeat._base.errors import WingbeatError
from wingbeat._base.files import write_atomically
from wingbeat.plots import save_figure
from wingbeat_evidence.second_opinion import LatticeOptions, compare_with_lattice
from wingbeat_evidence.second_opinion.comparison import lattice_loads
from wingbeat_evidence.second_opinion.figure import second_opinion_page
from wingbeat_evidence.second_opinion.motion import Motion

ROOT = Path(__file__).resolve().parents[1]
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


def solved(animal: str, speed: float, amplitude: float | None) -> wb.Orbit:
    """Return the orbit of least frequency."""
    species = wb.load_species(animal)
    bounds = {} if amplitude is None else {"flap_amplitude": (0.0, float(np.radians(amplitude)))}
    return wb.solve_orbit(wb.OrbitProblem(species, speed=speed, bounds=bounds or None))


def converged(orbit: wb.Orbit) -> list[dict[str, object]]:
    """Return what finer lattices and more beats make of an orbit."""
    model = orbit.problem.model
    motion = Motion.of(orbit.dataset, model.vehicle, orbit.wingbeat, model.air)
    rows = []
    for options in LATTICES:
        loads = lattice_loads(motion, options)
        first = 2 * np.fft.rfft(loads.lift)[1] / len(loads.lift)
        rows.append(
            {
                "lattice": vars(options),
                "mean_lift": float(np.mean(loads.lift)),
                "mean_thrust": float(np.mean(loads.thrust)),
                "aerodynamic_power": float(np.mean(loads.power)),
                "first_harmonic": float(abs(first)),
                "phase_of_first": float(-np.angle(first) / (2 * np.pi) % 1.0),
            }
        )
    return rows


def main(argv: list[str] | None = None) -> int:
    """Write the page and the figure; return the exit code."""
    parser = argparse.ArgumentParser(description="Our air loads beside a vortex lattice.")
    parser.add_argument("--records", type=Path, default=Path("second_opinion"), help="folder of the comparisons")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "docs" / "evidence", help="folder to write to")
    chosen = parser.parse_args(argv)
    chosen.records.mkdir(parents=True, exist_ok=True)
    records = {}
    try:
        for case in CASES:
            name = "_".join(str(part) for part in case if part is not None)
            file, figure = chosen.records / f"{name}.json", chosen.output / "second_opinion.png"
            if not file.exists() or (case == SHOWN and not figure.exists()):
                opinion = compare_with_lattice(solved(*case))
                write_atomically(file, json.dumps(opinion.record(), indent=1))
                if case == SHOWN:
                    save_figure(second_opinion_page(opinion), figure)
            records[case] = json.loads(file.read_text(encoding="utf-8"))
        file = chosen.records / "convergence.json"
        if not file.exists():
            write_atomically(file, json.dumps(converged(solved(*SHOWN)), indent=1))
        rows = json.loads(file.read_text(encoding="utf-8"))
        write_atomically(chosen.output / "second_opinion.md", page(records, rows))
    except WingbeatError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    print(f"wrote second_opinion.md to {chosen.output}", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
