"""Figure 5: wingbeat frequency against flight speed."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base.style import PAGE, drawing, dress, legend_below, letter_panels
from wingbeat.animal.species.making import load_species
from wingbeat.plots.published import (
    MEASURED_FREQUENCIES,
    PAPER_BAT_FREQUENCY,
    PAPER_BAT_RATIO,
    PAPER_BAT_SPEEDS,
    Measured,
)
from wingbeat_evidence.paper.contradictions import CLOSE, TWICE, Printed, told
from wingbeat_evidence.paper.figure_style import LOOKS, MEASURED, Drawn, sheet
from wingbeat_evidence.paper.treatments import ANIMALS, DEFAULT, DRAWN, MODELS, SPEEDS, Orbits, certified

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from wingbeat.results.orbit import Orbit

# The treatments drawn, and whether the marker is filled.
FILLS = {treatment.name: treatment.name == DEFAULT for treatment in DRAWN}
_LEAST_TOP = 25.0  # Hz
# Of laws and measurements over a range of speeds, one each: the page has one legend.
_DASHES = ((0, (1, 1)), (0, (3, 1, 1, 1)), (0, (6, 1.5)), (0, (2, 2)), (0, (3, 1, 1, 1, 1, 1)), (0, (9, 2, 1, 2)))
_NOTE = (
    "Wingbeat frequency against flight speed of (a) the pigeon and (b) the bat. "
    "Our points are certified orbits of minimum frequency. Filled points, thick lines: coefficients mirrored at "
    "negative angles of attack. Open points, thin lines: formulas as printed at negative angles, except Su-Fan's "
    "C_L, which stays mirrored. Neighbouring points may belong to different families of orbits. The flap amplitude "
    "is at its bound in {leaning} of {all} orbits. Crosses at the foot mark speeds without a certified orbit. "
    "Stars show what the paper prints for the bat (it prints no number for the pigeon). Green shows frequencies "
    "measured on animals, or laws of such measurements for this mass and span. In the legend, (A) marks values as "
    "in the source, and (D) values that we computed from the source. The table "
    "that comes with this figure gives the full sources. We could not obtain the "
    "frequencies of Tobalske and Dial (1996) that the paper draws; they did not vary with speed."
)


def frequency_figure(orbits: Orbits) -> Drawn:
    """Draw figure 5: frequency of a the pigeon and b the bat against speed, both models, two treatments.

    Parameters
    ----------
    orbits : solved orbits by case; those of the treatments mirrored and signed are drawn where certified.

    Returns
    -------
    The figure, its caption, and its rows: every requested orbit with its status, and every measurement with its
    source.
    """
    series = itertools.product(FILLS, ANIMALS, MODELS)
    drawn = [orbit for each in series for orbit in certified(orbits, *each).values()]
    # One scale for most runs, with room for every orbit.
    top = max([_LEAST_TOP, *(1.1 * orbit.wingbeat.frequency for orbit in drawn)])
    dashes = iter(_DASHES)
    with drawing():
        figure = sheet(PAGE, 118.0)
        panels = figure.subplots(1, 2)
        for axes, animal in zip(panels, ANIMALS, strict=True):
            dress(axes, "flight speed U [m/s]", "wingbeat frequency f [Hz]")
            axes.set(xlim=(3, 21), ylim=(0, top))
            axes.set_title(animal, fontsize=8, pad=3)
            _draw_measured(axes, animal, dashes)
            _draw_orbits(axes, orbits, animal)
        legend_below(figure, panels, columns=2)
        _mark_printed(panels[ANIMALS.index("bat")])
        letter_panels(panels)
    caption = f"{_NOTE.format(**_leaning(drawn))} {told(5, _printed(orbits))}"
    return Drawn(figure, [*_orbit_rows(orbits), *_measured_rows()], caption)


def _leaning(drawn: Sequence[Orbit]) -> dict[str, int]:
    """Return the number of drawn orbits at the largest flap amplitude allowed, and the number of all of them."""
    limits = [orbit.inputs["bounds"]["flap_amplitude"][1] for orbit in drawn]
    reached = [
        math.isclose(o.wingbeat.flap_amplitude, top, abs_tol=1e-4) for o, top in zip(drawn, limits, strict=True)
    ]
    return {"leaning": sum(reached), "all": len(drawn)}


def _draw_orbits(axes: Axes, orbits: Orbits, animal: str) -> None:
    for (treatment, filled), (i, model) in itertools.product(FILLS.items(), enumerate(MODELS)):
        look = LOOKS[model]
        found = certified(orbits, treatment, animal, model)
        style: dict[str, Any] = {"marker": look.marker, "markersize": 3.6, "markeredgewidth": 0.8, **look.line}
        style |= {"markerfacecolor": look.color if filled else "w", "linewidth": 1.1 if filled else 0.6}
        points = sorted((speed, orbit.wingbeat.frequency) for speed, orbit in found.items())
        axes.plot(*np.reshape(points, (-1, 2)).T, label=f"{look.name}, {treatment}", **style)
        absent = [c.speed for c in orbits if (c.treatment, c.animal, c.model) == (treatment, animal, model)]
        absent = sorted(set(absent) - set(found))
        # In rows along the foot of the panel, one for each series.
        height = 0.02 + 0.03 * (i + len(MODELS) * (not filled))
        cross: dict[str, Any] = {"marker": "x" if filled else "+", "linestyle": "", "markersize": 3.5}
        place = {"transform": axes.get_xaxis_transform(), "color": look.color, "gid": f"absent-{treatment}-{model}"}
        axes.plot(absent, [height] * len(absent), **cross, **place)


def _mark_printed(axes: Axes) -> None:
    """Mark what the paper prints for the bat: Su-Fan's frequency at two speeds, Dickinson's at the higher one."""
    slow, fast = PAPER_BAT_SPEEDS
    marks = {
        "su-fan": ([slow, fast], [PAPER_BAT_FREQUENCY] * 2),
        "dickinson": ([fast], [PAPER_BAT_RATIO * PAPER_BAT_FREQUENCY]),
    }
    for model, (speeds, frequencies) in marks.items():
        look: dict[str, Any] = {"marker": "*", "markersize": 8, "markeredgecolor": "k", "markeredgewidth": 0.5}
        look |= {"color": LOOKS[model].color, "linestyle": "-" if len(speeds) > 1 else "", "linewidth": 2.0}
        axes.plot(speeds, frequencies, zorder=4, gid=f"paper-{model}", **look)


def _printed(orbits: Orbits) -> list[Printed]:
    """Return the bat's frequencies that the paper prints, each with our result, for each treatment."""
    (slow, fast), found = PAPER_BAT_SPEEDS, []
    for treatment in FILLS:
        fit, fly = (certified(orbits, treatment, "bat", model) for model in MODELS)
        between = [orbit.wingbeat.frequency for speed, orbit in fit.items() if slow <= speed <= fast]
        if between:
            off = float(np.mean(np.abs(np.array(between) / PAPER_BAT_FREQUENCY - 1)))
            statement = f"about {PAPER_BAT_FREQUENCY:g} Hz for the bat from {slow:g} to {fast:g} m/s with Su-Fan"
            ours = f"{min(between):.3g} to {max(between):.3g} Hz ({treatment})"
            found.append(Printed(statement, ours, off <= CLOSE))
        if fast in fit and fast in fly:
            ratio = fly[fast].wingbeat.frequency / fit[fast].wingbeat.frequency
            statement = f"almost twice that near {fast:g} m/s with Dickinson"
            found.append(Printed(statement, f"{ratio:.2f} times ({treatment})", TWICE[0] <= ratio <= TWICE[1]))
    return found


def _reach(measured: Measured) -> np.ndarray:
    """Return the speeds at which to draw a measurement [m/s]: the part of its range that the figure shows."""
    low, high = measured.speeds
    if low == high:
        return np.array([low])
    return np.linspace(max(low, SPEEDS[0]), min(high, SPEEDS[-1]), 33)


def measured_values(measured: Measured, speeds: np.ndarray) -> np.ndarray:
    """Return the measured frequency, or the law's frequency for our vehicle, at flight speeds [m/s], shape (K,)."""
    species = load_species(measured.animal)
    return np.array([measured.value(species.vehicle, species.air, float(speed)) for speed in speeds])


def _draw_measured(axes: Axes, animal: str, dashes: Iterator[Any]) -> None:
    for measured in (m for m in MEASURED_FREQUENCIES if m.animal == animal):
        speeds = _reach(measured)
        values, label = measured_values(measured, speeds), f"{measured.label} ({measured.grade})"
        if len(speeds) == 1:
            bar: dict[str, Any] = {"fmt": "D", "markersize": 4, "capsize": 2, "elinewidth": 0.8}
            axes.errorbar(speeds, values, measured.spread, color=MEASURED, label=label, **bar)
            continue
        if measured.spread:
            axes.fill_between(
                speeds, values - measured.spread, values + measured.spread, color=MEASURED, alpha=0.2, lw=0
            )
        axes.plot(speeds, values, color=MEASURED, linestyle=next(dashes), label=label)


def _orbit_rows(orbits: Orbits) -> list[dict[str, Any]]:
    rows = []
    for case in sorted(case for case in orbits if case.treatment in FILLS):
        orbit = orbits[case]
        good = case.speed in certified(orbits, case.treatment, case.animal, case.model)
        rows.append(
            {
                "kind": "orbit",
                "animal": case.animal,
                "treatment": case.treatment,
                "model": case.model,
                "speed_m_per_s": case.speed,
                "frequency_Hz": orbit.wingbeat.frequency if good else math.nan,
                "flap_amplitude_deg": math.degrees(orbit.wingbeat.flap_amplitude) if good else math.nan,
                "status": orbit.status.value,
            }
        )
    return rows


def _measured_rows() -> list[dict[str, Any]]:
    rows = []
    for measured in MEASURED_FREQUENCIES:
        speeds = _reach(measured)
        for speed, value in zip(speeds, measured_values(measured, speeds), strict=True):
            about = {"kind": "measured", "animal": measured.animal, "label": measured.label, "speed_m_per_s": speed}
            about |= {"frequency_Hz": value, "spread_Hz": measured.spread}
            rows.append(about | {"source": measured.source, "grade": measured.grade})
    return rows
