"""Figures of `docs/guide/air_loads.md`: what each term adds over a beat, and what a tail and an upstroke factor do.

Run from the root of a clone::

    uv run python validation/term_figures.py
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import numpy as np

import wingbeat as wb
from wingbeat._base.style import (
    FIRST,
    PAGE,
    PURPLE,
    SECOND,
    THIRD,
    drawing,
    dress,
    legend_below,
    letter_panels,
    new_figure,
    shade_downstrokes,
)
from wingbeat.aero.closed_forms import added_inertia, added_mass, damping_couple, rotation_force
from wingbeat.mechanics.wing_points import CORNERS
from wingbeat.plots import save_figure
from wingbeat_evidence.measured_motion.strip_case import StripCase
from wingbeat_evidence.measured_motion.strip_motion import strip_motion

DOCS = Path(__file__).parents[1] / "docs" / "guide"
SPEED = 8.0
STARTS = 4
_FOURTH: dict[str, Any] = {"color": PURPLE, "linestyle": (0, (5, 1, 1, 1))}


def case_of(orbit: wb.Orbit) -> StripCase:
    """Return the motion of an orbit's wings as a measured one; its force is the weight."""
    vehicle, air, data = orbit.problem.vehicle, orbit.problem.air, orbit.dataset
    corners = data["strip_corner"].values[:-1]
    edge = {name: corners[:, :, i] for i, name in enumerate(CORNERS)}
    front = 0.5 * (edge["leading inner"] + edge["leading outer"])
    chord = front - 0.5 * (edge["trailing inner"] + edge["trailing outer"])
    across = edge["leading outer"] - edge["leading inner"]
    frequency = orbit.wingbeat.frequency
    return StripCase(
        name="orbit",
        mass=vehicle.mass,
        density=air.density,
        gravity=air.gravity,
        frequency=frequency,
        speed=orbit.problem.speed,
        mirrored=True,
        periodic=True,
        times=data["phase"].values[:-1] / frequency,
        position=front - 0.25 * chord,
        chord=chord,
        area=np.linalg.norm(across, axis=-1) * np.linalg.norm(chord, axis=-1),
        mean_force=(0.0, vehicle.mass * air.gravity),
    )


def parts_of(case: StripCase) -> dict[str, np.ndarray]:
    """Return upward forces over the weight, and couples over weight times chord, of both wings."""
    motion, density = strip_motion(case), case.density
    wing = motion.chord, motion.width
    speed = np.hypot(motion.chord_speed, motion.normal_speed)
    along, across = rotation_force(density, *wing, motion.turning, motion.chord_speed, motion.normal_speed)
    couple = damping_couple(density, *wing, motion.turning, speed)
    pushed = -added_mass(density, *wing) * motion.middle_rate
    turned = -added_inertia(density, *wing) * motion.turning_rate
    up = along * motion.ahead[..., 2] + across * motion.normal[..., 2]
    length = float(motion.chord.mean())

    def total(of_strips: Any, over: float) -> np.ndarray:
        return 2.0 * np.asarray(of_strips).sum(axis=1) / over

    return {
        "rotation": total(up, case.weight),
        "added mass": total(pushed * motion.normal[..., 2], case.weight),
        "damping couple": total(couple, case.weight * length),
        "couple of added mass": total(turned, case.weight * length),
    }


@drawing()
def draw_parts(orbit: wb.Orbit) -> Any:
    """Return the figure of the unsteady parts over a beat of an orbit that was flown with them."""
    parts, phase = parts_of(case_of(orbit)), orbit.dataset["phase"].values[:-1]
    figure = new_figure(PAGE, 62.0)
    figure.suptitle(
        f"Pigeon at {SPEED:g} m/s, least frequency: parts of the unsteady terms", fontsize=8, x=0.01, ha="left"
    )
    panels = figure.subplots(1, 2)
    names = (("rotation", "added mass"), ("damping couple", "couple of added mass"))
    looks = dict(zip((name for group in names for name in group), (FIRST, SECOND, THIRD, _FOURTH), strict=True))
    labels = ("upward force / weight [-]", "couple / (weight × chord) [-]")
    for axes, group, label in zip(panels, names, labels, strict=True):
        shade_downstrokes(axes, 0.0, 1.0)
        for name in group:
            axes.plot(phase, parts[name], label=name, **looks[name])
        axes.set_xlim(0.0, 1.0)
        dress(axes, "phase [beats]", label)
    letter_panels(panels)
    legend_below(figure, panels)
    return figure


def least_frequency(problem_at: Callable[[float], wb.OrbitProblem], values: Iterable[float]) -> list[wb.Orbit]:
    """Return the certified orbits along a number of the problem."""
    orbits = [wb.solve_orbit(problem_at(float(value)), starts=STARTS) for value in values]
    assert all(orbit.status is wb.Status.CONVERGED for orbit in orbits)
    return orbits


@drawing()
def draw_along(title: str, label: str, values: Any, orbits: list[wb.Orbit]) -> Any:
    """Return the figure of frequency, power and largest Floquet multiplier of orbits along a number."""
    figure = new_figure(PAGE, 58.0)
    figure.suptitle(title, fontsize=8, x=0.01, ha="left")
    records = [orbit.record() for orbit in orbits]
    series = {
        "frequency [Hz]": ([record["wingbeat"]["frequency"] for record in records], FIRST),
        "mean power [W]": ([record["mean_power"] for record in records], SECOND),
        "largest Floquet multiplier [-]": (
            [max(np.hypot(*pair) for pair in record["floquet_multipliers"]) for record in records],
            THIRD,
        ),
    }
    panels = figure.subplots(1, 3)
    for axes, (name, (found, look)) in zip(panels, series.items(), strict=True):
        axes.plot(values, found, marker="o", markersize=3, **look)
        dress(axes, label, name)
    panels[2].axhline(1.0, color="k", linewidth=0.6)
    letter_panels(panels)
    return figure


def main() -> None:
    """Draw all figures."""
    pigeon = wb.load_species("pigeon")
    unsteady = wb.aero.BladeElement("su-fan", unsteady="thin-aerofoil")
    orbit = wb.solve_orbit(wb.OrbitProblem(pigeon, SPEED, aero=unsteady))
    save_figure(draw_parts(orbit), DOCS / "term_parts.png")

    factors = np.linspace(1.0, 0.0, 6)
    shed = least_frequency(
        lambda f: wb.OrbitProblem(pigeon, SPEED, aero=wb.aero.BladeElement("su-fan", upstroke_factor=f)), factors
    )
    title = f"Pigeon at {SPEED:g} m/s, least frequency: less load where air meets the wing from above"
    save_figure(draw_along(title, "upstroke factor [-]", factors, shed), DOCS / "term_upstroke.png")

    tailed = pigeon.with_tail()
    stock = tailed.vehicle.tail
    assert stock is not None
    areas = np.linspace(0.0, 1.5, 7)[1:]

    def with_area(share: float) -> wb.OrbitProblem:
        return wb.OrbitProblem(tailed.with_values({"tail.area": share * stock.area}), 12.0)

    plain = [wb.solve_orbit(wb.OrbitProblem(pigeon, 12.0), starts=STARTS)]
    orbits = plain + least_frequency(with_area, areas)
    title = "Pigeon at 12 m/s, least frequency: tails of other areas"
    values = [0.0, *(1e4 * areas * stock.area)]
    save_figure(draw_along(title, "area of the tail [cm²]", values, orbits), DOCS / "term_tail.png")


if __name__ == "__main__":
    main()
