"""Draw the figures of the paper about wingbeat.

    python paper/figures.py [FOLDER]

The figure of curves solves its orbits, which takes a minute or two. The figure of evidence counts again what is in
``data``: the sample of assumptions and the predicted flights. Without FOLDER the pictures are written beside this
file.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd

import wingbeat as wb
from wingbeat._base.style import (
    BLUE,
    FIRST,
    FONT,
    GREEN,
    GREY,
    PAGE,
    PURPLE,
    SECOND,
    SHADE,
    VERMILION,
    drawing,
    dress,
    legend_above,
    letter_panels,
    new_figure,
)
from wingbeat.plots import save_figure
from wingbeat_evidence.whole_flights import Prediction, measured_animals, read_measured_flights
from wingbeat_evidence.whole_flights.comparison import AGREES, Score, compared

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

HERE = Path(__file__).parent
DATA = HERE.parent / "data"
SPEEDS = tuple(float(speed) for speed in range(6, 21))  # m/s, those of the paper's figure 5
MODELS = (("plate of Su et al.", wb.aero.SuFan, FIRST), ("Dickinson et al.", wb.aero.Dickinson, SECOND))
SERIES = (
    ("frequency", "wingbeat frequency [Hz]"),
    ("mean_positive_power", "mean positive power [W]"),
    ("spectral_radius", "largest multiplier (modulus)"),
)

# Claims that the figure names; the text of the paper speaks of most of them.
NAMED = {
    "hand-thrusts": "bat: the hand gives the thrust",
    "lower-power": "the plate's coefficients need less power",
    "pigeon-closer-at-speed-usherwood": "pigeon: the plate is closer to live birds",
    "smaller-horizontal-force": "bat: smaller horizontal forces",
    "four-times": "bat: four times the power",
    "bat-agrees": "bat: 6 Hz from 5 to 10 m/s",
    "twice-the-frequency": "bat: twice the frequency",
    "pigeon-agrees-usherwood": "pigeon: frequency agrees very well",
}
GROUPS = (
    ("frequency", "wingbeat frequency", BLUE, "o"),
    ("flap_amplitude_deg", "flap amplitude", VERMILION, "s"),
    ("positive_power_per_mass", "power per mass", GREEN, "^"),
    ("muscle_power_per_mass", "power per muscle mass", GREEN, "v"),
    ("metabolic_rate", "metabolic rate", PURPLE, "X"),
    ("net_muscle_efficiency", "net efficiency of the muscle", PURPLE, "D"),
    ("flight_efficiency", "efficiency of the flight", PURPLE, "P"),
)


def values_of(orbit: wb.Orbit) -> dict[str, float]:
    """Return the numbers of a certified orbit that the figure draws, by their names in `SERIES`, and its speed."""
    record = orbit.record()
    return {
        "speed": record["speed"],
        "frequency": orbit.wingbeat.frequency,
        "mean_positive_power": record["mean_positive_power"],
        "spectral_radius": float(np.max(np.hypot(*np.transpose(record["floquet_multipliers"])))),
    }


def curves_figure(speeds: Sequence[float] = SPEEDS, starts: int = 4) -> Figure:
    """Draw frequency, power and stability of the pigeon's orbits of lowest frequency against speed.

    Parameters
    ----------
    speeds : [m/s].
    starts : starts of each search.
    """
    pigeon = wb.load_species("pigeon")
    with drawing():
        figure = new_figure(PAGE, 58.0)
        panels = figure.subplots(1, 3)
        for name, coefficients, line in MODELS:
            problems = [wb.OrbitProblem(pigeon, speed=speed, aero=coefficients()) for speed in speeds]
            orbits = wb.solve_orbits(problems, starts=starts, in_order=True)
            found = [values_of(orbit) for orbit in orbits if orbit.status.value == "converged"]
            for axes, (quantity, _) in zip(panels, SERIES, strict=True):
                points = [(values["speed"], values[quantity]) for values in found]
                axes.plot(*np.reshape(points, (-1, 2)).T, label=name, marker=".", markersize=4, **line)
        for axes, (_, label) in zip(panels, SERIES, strict=True):
            dress(axes, "mean speed [m/s]", label)
        for axes in panels[:2]:
            axes.set_ylim(bottom=0)
        panels[2].axhline(1.0, color=GREY, linewidth=0.7)
        legend_above(panels[0], columns=2)
        letter_panels(panels)
    return figure


def shares() -> dict[str, float]:
    """Return, for each claim, the share of the testable sets of assumptions in which it holds, lowest first [%]."""
    sets = pd.read_csv(DATA / "assumptions.csv")
    columns = [name for name in sets if name.endswith(":holds")]
    found = {name.removesuffix(":holds"): 100 * float(np.nanmean(sets[name].to_numpy(float))) for name in columns}
    return dict(sorted(found.items(), key=lambda item: item[1]))


def ratios(quantity: str) -> Iterator[tuple[str, Score, tuple[float, float]]]:
    """Yield the animals and comparisons of a quantity; not those with an upper limit, which has no middle."""
    for animal in measured_animals():
        flights = read_measured_flights(animal)
        file = DATA / "whole_flights" / f"{animal}.json"
        for score in compared(Prediction.of_plain(flights, json.loads(file.read_text(encoding="utf-8")))):
            one = score.measurement
            if one.quantity == quantity and one.values[0] > 0 and score.ratio is not None:
                yield animal, score, score.ratio


def draw_shares(axes: Axes) -> None:
    """Draw the shares of all claims in their order, and name some."""
    found = shares()
    axes.plot(list(found.values()), range(len(found)), "o", color=BLUE, markersize=3)
    for claim, words in NAMED.items():
        share, place = found[claim], list(found).index(claim)
        left = share > 50
        shift: dict[str, Any] = {"xytext": (-5 if left else 5, 0), "ha": "right" if left else "left"}
        axes.annotate(words, (share, place), textcoords="offset points", va="center", fontsize=FONT - 1, **shift)
    dress(axes, "sets in which the claim holds [%]", f"the {len(found)} claims, in order")
    axes.set(xlim=(-3, 103), yticks=[])
    axes.grid(axis="x")


def draw_ratios(axes: Axes) -> None:
    """Draw the range of predicted over measured values of each comparison; shade the factor of agreement."""
    rows: list[str] = []
    for quantity, label, color, mark in GROUPS:
        first, factor = len(rows), AGREES[quantity]
        for animal, score, ratio in ratios(quantity):
            law = score.measurement.basis != "measured"
            look: dict[str, Any] = {"color": color, "markersize": 3.2, "markerfacecolor": "w" if law else color}
            axes.plot(ratio, [len(rows)] * 2, marker=mark, label=None if len(rows) > first else label, **look)
            rows.append(wb.load_species(animal).common_name or animal)
        axes.fill_betweenx([first - 0.5, len(rows) - 0.5], 1 / factor, factor, color=SHADE, linewidth=0, zorder=0)
    dress(axes, "predicted / middle of the measured range", "")
    axes.set_xscale("log")
    ticks = (0.1, 0.25, 0.5, 1, 2, 4, 8)
    axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.set_xticks([], minor=True)
    axes.set_yticks(range(len(rows)), rows, fontsize=FONT - 1.5)
    axes.set_ylim(len(rows) - 0.5, -0.5)
    axes.axvline(1.0, color=GREY, linewidth=0.7)
    handles, labels = axes.get_legend_handles_labels()
    legend_above(axes, handles=handles, labels=labels, columns=2)


def evidence_figure() -> Figure:
    """Draw how often each claim of Su et al. holds, and how predicted flights compare with measured ones."""
    with drawing():
        figure = new_figure(PAGE, 108.0)
        claims, flights = figure.subplots(1, 2)
        draw_shares(claims)
        draw_ratios(flights)
        letter_panels((claims, flights))
    return figure


def main(folder: Path) -> None:
    """Write both figures into a folder."""
    save_figure(evidence_figure(), folder / "evidence.png")
    save_figure(curves_figure(), folder / "curves.png")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else HERE)
