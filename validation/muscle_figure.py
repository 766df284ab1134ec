"""Figure and numbers of `docs/guide/muscles.md`: what a beat of a given frequency costs a pigeon's muscles.

Run from the root of a clone::

    uv run python validation/muscle_figure.py
"""

from __future__ import annotations

import math
from pathlib import Path

import wingbeat as wb
from wingbeat._base.style import FIRST, PAGE, SECOND, THIRD, drawing, dress, legend_below, letter_panels, new_figure
from wingbeat.plots import save_figure

DOCS = Path(__file__).parents[1] / "docs" / "guide"
SPEEDS = (10.0, 12.0, 16.0)
FREQUENCIES = tuple(float(f) for f in range(4, 19))
STARTS = 8
# The pectoralis of the law of all birds, and elevators without deltoids: less muscle than a pigeon's own.
MUSCLE = {"muscle.mass": 0.0442, "muscle.elevator_share": 0.11}


def beats(speed: float) -> list[dict[str, float]]:
    """Return the certified beats of least metabolic power at a speed, one for each frequency that has one."""
    pigeon = wb.load_species("pigeon").with_alternative("body-drag").with_muscle().with_values(MUSCLE)
    aero = wb.aero.BladeElement("feathered", inflow="momentum")
    found = []
    for frequency in FREQUENCIES:
        problem = wb.OrbitProblem(
            pigeon, speed=speed, aero=aero, minimise="metabolic_power", subject_to=f"frequency={frequency:g}"
        )
        orbit = wb.solve_orbit(problem, starts=STARTS)
        if orbit.status is wb.Status.CONVERGED:
            found.append({"frequency": frequency} | orbit.record())
    return found


def main() -> None:
    """Draw the figure and print its numbers."""
    with drawing():
        figure = new_figure(PAGE, 0.36 * PAGE)
        panels = figure.subplots(1, 3)
        for speed, look in zip(SPEEDS, (FIRST, SECOND, THIRD), strict=True):
            found = beats(speed)
            at = [one["frequency"] for one in found]
            series = [[one[name] for one in found] for name in ("metabolic_power", "peak_activation")]
            series.append([math.degrees(one["wingbeat"]["flap_amplitude"]) for one in found])
            for axes, values in zip(panels, series, strict=True):
                axes.plot(at, values, marker="o", markersize=3, **look, label=f"{speed:g} m/s")
            for f, power, activation, amplitude in zip(at, *series, strict=True):
                print(f"{speed:g} m/s, {f:g} Hz: {power:.2f} W, activation {activation:.2f}, {amplitude:.0f} deg")
        for axes, label in zip(
            panels,
            ("metabolic power of\nthe flight muscle [W]", "largest activation [-]", "flap amplitude [deg]"),
            strict=True,
        ):
            dress(axes, "wingbeat frequency [Hz]", label)
            axes.set_ylim(bottom=0.0)
        panels[1].axhline(1.0, color="0.5", linewidth=0.8)
        letter_panels(panels)
        legend_below(figure, panels)
        save_figure(figure, DOCS / "muscle_frequency.png")


if __name__ == "__main__":
    main()
