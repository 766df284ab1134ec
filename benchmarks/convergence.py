"""Tables of how numerical choices change the result: strips, steps, blend width, extension.

Run from the root of a clone; it rewrites docs/evidence/convergence.md::

    uv run python benchmarks/convergence.py
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

import wingbeat as wb
from wingbeat.orbits.flight.shooting import STEPS, flier
from wingbeat.orbits.solve import find_orbit

PAGE = Path(__file__).resolve().parents[1] / "docs" / "evidence" / "convergence.md"
CASES = (("pigeon", 10.0), ("bat", 8.0))


def table(header: tuple[str, ...], rows: list[tuple[str, ...]]) -> str:
    lines = [header, tuple("---" for _ in header), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines) + "\n"


def solved(name: str, speed: float, aero: object) -> wb.Orbit:
    return wb.solve_orbit(wb.OrbitProblem(wb.load_species(name), speed=speed, aero=aero), starts=1)


def row(label: str, orbit: wb.Orbit) -> tuple[str, ...]:
    record = orbit.record()
    return (
        label,
        f"{record['wingbeat']['frequency']:.4f}",
        f"{record['mean_power']:.3f}",
        f"{record['peak_power']:.2f}",
        f"{max(abs(v) for v in record['closure'].values()):.0e}",
        record["status"],
    )


HEAD = ("frequency [Hz]", "mean hinge power [W]", "peak [W]", "closure", "status")


def strips(name: str, speed: float) -> str:
    blade = wb.aero.BladeElement
    rows = [row(str(n), solved(name, speed, blade(wb.aero.SuFan(), n))) for n in (5, 10, 20, 40)]
    return table(("strips", *HEAD), rows)


def widths(name: str, speed: float) -> str:
    rows = [
        row(f"{width:g}", solved(name, speed, wb.aero.SuFan(blend_width_deg=width)))
        for width in (0.5, 1.0, 1.5, 2.0, 3.0)
    ]
    return table(("blend width [deg]", *HEAD), rows)


def extensions(name: str, speed: float) -> str:
    rows = [
        row(f"{maker().name}, {kind}", solved(name, speed, maker(extension=kind)))
        for maker in (wb.aero.SuFan, wb.aero.Dickinson)
        for kind in wb.aero.EXTENSIONS
    ]
    return table(("coefficients, extension", *HEAD), rows)


def steps(name: str, speed: float) -> str:
    """Fly one certified orbit with fixed steps: the largest difference from the certifier's end."""
    solution = find_orbit(wb.OrbitProblem(wb.load_species(name), speed=speed), starts=1)
    start, end = solution.certificate.states[0][2:], solution.certificate.end
    problem, rows = solution.problem, []
    fly = flier(problem.model, solution.wingbeat, problem.free)
    values = np.array([getattr(solution.wingbeat, name) for name in problem.free])
    for blocks in (1, 2, 4, 8, 16, 32, 64):
        flown = fly(values, start, blocks)
        rows.append((str(blocks * STEPS), f"{np.abs(np.asarray(flown.end) - end).max():.1e}"))
    return table(("RK4 steps per wingbeat", "largest difference (m, rad, m/s, rad/s)"), rows)


def main() -> None:
    parts = [
        "# Convergence\n",
        "`uv run python benchmarks/convergence.py` writes this page. Unless a table says otherwise, each "
        "orbit has minimum\nfrequency, with the default wings and bounds, Su-Fan coefficients and the "
        "mirrored extension. Each orbit is solved\nfrom the first start only, so that a column follows one "
        "family of orbits. Families of lower frequency may exist.\n",
        "The certifier is the adaptive integrator that flies each orbit again to certify it. For the first "
        "two tables, we\nflew a certified orbit with fixed steps (RK4: the classical Runge-Kutta method). "
        "These two tables give the largest\ndifference between the final state of this flight and the final "
        "state of the certifier's flight. All later tables\nhave a column *closure*: the largest residual of "
        "the periodicity when the certifier flies the orbit.\n",
    ]
    for title, make in (
        ("Fixed steps against the certifier", steps),
        ("Width of the blends at 0, 90 and 180 degrees", widths),
        ("Number of strips", strips),
        ("Extension to negative angles", extensions),
    ):
        parts.append(f"## {title}\n")
        for name, speed in CASES:
            print(title, name, flush=True)
            parts.append(f"{name.capitalize()} at {speed:g} m/s:\n\n{make(name, speed)}")
            PAGE.write_text("\n".join(parts), encoding="utf-8")


if __name__ == "__main__":
    main()
