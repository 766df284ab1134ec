"""Tables of how numerical choices change the result: strips, steps, blend width, extension.

Run from the root of a clone; it rewrites docs/evidence/convergence.md::

    uv run python benchmarks/convergence.py
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

import wingbeat as wb
from wingbeat.orbits.flight.period import STEPS, flier
from wingbeat.orbits.solve import Settings, find_orbit
from wingbeat_evidence.markdown import markdown_table

PAGE = Path(__file__).resolve().parents[1] / "docs" / "evidence" / "convergence.md"
CASES = (("pigeon", 10.0), ("bat", 8.0))
TEXT = """# Convergence

`uv run python benchmarks/convergence.py` writes this page. Each orbit has minimum frequency, with default wings
and bounds, Su-Fan coefficients and the mirrored extension unless the row says otherwise, and is solved from the
first start only, so that a column follows one family of orbits; families of lower frequency may exist. Cells:
frequency [Hz], mean hinge power [W], peak power [W]. All orbits are certified; when the certifier flies them,
their closure is at most {closure:.0e}.

{orbits}

A certified orbit flown with fixed Runge-Kutta steps (RK4) ends this far from the certifier's adaptive flight, as
the largest difference in m, rad, m/s or rad/s:

{steps}
"""
LABELS = [f"{name}, {speed:g} m/s" for name, speed in CASES]


def solved(name: str, speed: float, aero: object) -> wb.Orbit:
    return wb.solve_orbit(wb.OrbitProblem(wb.load_species(name), speed=speed, aero=aero), starts=1)


def choices() -> dict[str, object]:
    """Return the air loads of each row of the table by its label."""
    blade, sufan = wb.aero.BladeElement, wb.aero.SuFan
    airs: dict[str, object] = {f"{n} strips": blade(sufan(), n) for n in (5, 10, 20, 40)}
    airs |= {f"blends of {one:g} deg": sufan(blend_width_deg=one) for one in (0.5, 1.0, 1.5, 2.0, 3.0)}
    airs |= {
        f"{maker().name}, {kind}": maker(extension=kind)
        for maker in (sufan, wb.aero.Dickinson)
        for kind in wb.aero.EXTENSIONS
    }
    return airs


def steps(name: str, speed: float) -> dict[str, str]:
    """Fly one certified orbit with fixed steps: the largest difference from the certifier's end."""
    solution = find_orbit(wb.OrbitProblem(wb.load_species(name), speed=speed), Settings(1))
    start, end = solution.certificate.states[0][2:], solution.certificate.end
    fly = flier(solution.problem.model, solution.wingbeat, solution.problem.free)
    values = np.array([getattr(solution.wingbeat, name) for name in solution.problem.free])
    ends = {blocks * STEPS: np.asarray(fly(values, start, blocks).end) for blocks in (1, 2, 4, 8, 16, 32, 64)}
    return {str(count): f"{np.abs(flown - end).max():.1e}" for count, flown in ends.items()}


def main() -> None:
    """Solve every choice and write the page."""
    rows, closures = [], []
    for label, aero in choices().items():
        cells = [label]
        for case in CASES:
            record = solved(*case, aero).record()
            closures += [abs(value) for value in record["closure"].values()]
            numbers = (
                f"{record['wingbeat']['frequency']:.4f}, {record['mean_power']:.3f}, {record['peak_power']:.2f}"
            )
            cells.append(numbers if record["status"] == "converged" else record["status"])
        rows.append(cells)
        print(" | ".join(cells), flush=True)
    flown = [steps(*case) for case in CASES]
    by_steps = [[count, *(one[count] for one in flown)] for count in flown[0]]
    page = TEXT.format(
        closure=max(closures),
        orbits=markdown_table(["choice", *LABELS], rows),
        steps=markdown_table(["RK4 steps per wingbeat", *LABELS], by_steps),
    )
    PAGE.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main()
