"""Figure 4: phase portraits of a sample orbit."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base.style import PAGE, drawing, dress, letter_panels
from wingbeat_evidence.paper.figure_cycle import absence, assumptions, sample_orbits
from wingbeat_evidence.paper.figure_style import LOOKS, Drawn, say, sheet
from wingbeat_evidence.paper.treatments import DEFAULT, SAMPLE_SPEED, Orbits

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from wingbeat.results.orbit import Orbit

_ANIMAL, _MODEL = "pigeon", "su-fan"
_PORTRAITS = (
    ("x_m", "u_m_per_s", "displacement x [m]", "horizontal velocity u [m/s]"),
    ("z_mm", "w_m_per_s", "height z [mm]", "vertical velocity w [m/s]"),
    ("body_pitch_deg", "pitch_rate_deg_per_s", "body pitch ψ [deg]", "pitch rate q [deg/s]"),
)
# Phase at which each stroke begins, marker and its size: the paper's asterisk and black dot.
_STARTS = {"downstroke": (0.0, (8, 2, 0), 8.0), "upstroke": (0.5, "o", 4.5)}


def portrait_series(orbit: Orbit) -> dict[str, np.ndarray]:
    """Return the path and velocities of the body over one wingbeat in the units of the drawing, shapes (K,)."""
    data = orbit.dataset
    return {
        "phase": data["phase"].values,
        "time_s": data["time"].values,
        "x_m": data["x"].values,
        "u_m_per_s": data["u"].values,
        "z_mm": 1e3 * data["z"].values,
        "w_m_per_s": data["w"].values,
        "body_pitch_deg": np.degrees(data["body_pitch"].values),
        "pitch_rate_deg_per_s": np.degrees(data["pitch_rate"].values),
    }


def phase_figure(orbits: Orbits, sample: str = DEFAULT) -> Drawn:
    """Draw figure 4: a u against x, b w against z, c pitch rate against body pitch, of the pigeon at 10 m/s.

    Parameters
    ----------
    orbits : solved orbits by case; that of the pigeon at 10 m/s with Su-Fan is drawn if it is certified.
    sample : name of the treatment.

    Returns
    -------
    The figure, its caption, and its rows: phase, time, path and velocities.
    """
    orbit = sample_orbits(orbits, sample, _ANIMAL).get(_MODEL)
    series = {} if orbit is None else portrait_series(orbit)
    beat = "" if orbit is None else f", {orbit.wingbeat.frequency:.3g} Hz"
    caption = (
        "Forward velocity against displacement (a), upward velocity against height (b) and pitch rate against "
        f"body pitch (c) of our {_ANIMAL} at {SAMPLE_SPEED:g} m/s{beat}, {LOOKS[_MODEL].name} coefficients; "
        f"{assumptions(sample)}. "
        "Asterisk: beginning of the downstroke; black dot: beginning of the upstroke; solid: downstroke, dashed: "
        "upstroke; arrow: direction of time. The paper does not say which animal its sample orbit belongs to."
    )
    with drawing():
        figure = sheet(PAGE, 55.0, absence(orbits, sample, _ANIMAL, (_MODEL,)))
        panels = figure.subplots(1, 3)
        for axes, (place, speed, xlabel, ylabel) in zip(panels, _PORTRAITS, strict=True):
            dress(axes, xlabel, ylabel)
            axes.margins(0.1)
            if series:
                _draw_portrait(axes, series["phase"], series[place], series[speed])
            else:
                say(axes, "no certified orbit")
        letter_panels(panels)
    rows = [dict(zip(series, values, strict=True)) for values in zip(*series.values(), strict=True)]
    return Drawn(figure, rows, caption)


def _draw_portrait(axes: Axes, phase: np.ndarray, place: np.ndarray, speed: np.ndarray) -> None:
    for stroke, dashes in (("downstroke", "-"), ("upstroke", LOOKS["dickinson"].dashes)):
        part = phase <= 0.5 if stroke == "downstroke" else phase >= 0.5
        axes.plot(place[part], speed[part], color=LOOKS[_MODEL].color, linestyle=dashes, label=stroke)
    middle = len(phase) // 4
    arrow: dict[str, Any] = {"arrowprops": {"arrowstyle": "-|>", "color": LOOKS[_MODEL].color, "lw": 0.8}}
    axes.annotate("", (place[middle + 1], speed[middle + 1]), (place[middle - 1], speed[middle - 1]), **arrow)
    for stroke, (start, marker, size) in _STARTS.items():
        starts = phase[(phase - start) % 1.0 < 1e-9]
        at = [np.interp(starts, phase, values) for values in (place, speed)]
        look: dict[str, Any] = {"marker": marker, "markersize": size, "markeredgewidth": 0.9}
        axes.plot(*at, linestyle="", color="k", zorder=3, gid=stroke, **look)
