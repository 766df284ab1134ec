"""Figure 2: the vehicles to scale, with strips, axes and angles, drawn from points that the model computes."""

from __future__ import annotations

import math
from typing import Any

from wingbeat._base.style import PAGE, drawing, letter_panels
from wingbeat.mechanics.wing_points import CORNERS
from wingbeat_evidence.paper.figure_cycle import sample_orbits
from wingbeat_evidence.paper.figure_style import Drawn, sheet
from wingbeat_evidence.paper.figure_vehicle_views import draw_front, draw_oblique, draw_section, draw_side, draw_top
from wingbeat_evidence.paper.treatments import ANIMALS, DEFAULT, MODELS, SAMPLE_SPEED, Orbits
from wingbeat_evidence.paper.vehicle_posture import Posture, flown, posture, section

MID_DOWNSTROKE = 0.25
PHASES = (MID_DOWNSTROKE, 0.0, 0.5, 0.75)


def vehicle_figure(orbits: Orbits, sample: str = DEFAULT) -> Drawn:
    """Draw figure 2: a to c the pigeon with its axes and angles, d to g both animals to one scale.

    Parameters
    ----------
    orbits : solved orbits by case; each animal is drawn at mid-downstroke of its certified orbit at 10 m/s with
        Su-Fan, or of the species' stock wingbeat if there is no such orbit.
    sample : name of the treatment.

    Returns
    -------
    The figure, its caption, and its rows: corners and quarter chords of the left wing's strips at the phases drawn.
    """
    found = {animal: sample_orbits(orbits, sample, animal).get(MODELS[0]) for animal in ANIMALS}
    flights = {animal: flown(animal, orbit) for animal, orbit in found.items()}
    postures = {animal: [posture(flight, phase) for phase in PHASES] for animal, flight in flights.items()}
    pigeon, strips = postures["pigeon"][0], flights["pigeon"].model.strips
    strip = min(int(0.75 * strips), strips - 1)
    stock = [animal for animal, orbit in found.items() if orbit is None]
    with drawing():
        figure = sheet(PAGE, 92.0)
        grid: Any = figure.add_gridspec(2, 4, height_ratios=(1, 1))
        cells = (grid[0, :2], grid[0, 2], grid[0, 3], *(grid[1, i] for i in range(4)))
        panels = [figure.add_subplot(cell) for cell in cells]
        draw_oblique(panels[0], pigeon, flights["pigeon"].model.vehicle.wing)
        draw_side(panels[1], pigeon)
        draw_section(panels[2], section(flights["pigeon"], MID_DOWNSTROKE, strip))
        for i, animal in enumerate(ANIMALS):
            draw_front(panels[3 + 2 * i], postures[animal], animal)
            draw_top(panels[4 + 2 * i], postures[animal][0], animal)
        letter_panels(panels)
    rows = [row for animal in ANIMALS for each in postures[animal] for row in _rows(animal, each)]
    return Drawn(figure, rows, _caption(flights, strips, strip, stock))


def _caption(flights: dict[str, Any], strips: int, strip: int, stock: list[str]) -> str:
    beats = ", ".join(f"{animal} {flight.wingbeat.frequency:.3g} Hz" for animal, flight in flights.items())
    guess = (
        f" There is no certified orbit of the {' and the '.join(stock)}: the stock wingbeat is drawn."
        if stock
        else ""
    )
    return (
        f"The pigeon (a to e) and the bat (f, g), drawn from points that the model computes, "
        f"at mid-downstroke of the orbits at {SAMPLE_SPEED:g} m/s "
        f"({beats}).{guess} Each wing has {strips} strips. Dashed line: quarter chord, which is the pitch axis; "
        f"dot: shoulder. c: cross-section of strip {strip + 1} of the pigeon, with its forces to one scale and θ "
        "measured from the normal of the stroke plane. d and f also show the quarter chord at both ends of the "
        "stroke (dotted) and at mid-upstroke (grey). In the model the body has no shape. The grey ellipsoid has "
        "the body's mass and pitch inertia, and the density of water."
    )


def _rows(animal: str, at: Posture) -> list[dict[str, Any]]:
    rows = []
    for i, fraction in enumerate(at.span_fraction):
        about = {"animal": animal, "phase": at.phase, "strip": i + 1, "span_fraction": float(fraction)}
        points = zip(("quarter chord", *CORNERS), [at.quarter_chord[i], *at.outlines[i]], strict=True)
        for name, (x, y, z) in points:
            angles = {"flap_deg": math.degrees(at.flap), "body_pitch_deg": math.degrees(at.body_pitch)}
            rows.append({**about, "point": name, "x_m": float(x), "y_m": float(y), "z_m": float(z), **angles})
    return rows
