"""Figures 6 to 8: angles of attack and forces, power and body pitch of the bat over one wingbeat at 10 m/s."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat.paper.figure_style import (
    COLUMN,
    FONT_SMALL,
    LOOKS,
    PAGE,
    STYLE,
    Table,
    dress_cycle,
    legend_above,
    letter_panels,
    say,
    sheet,
)
from wingbeat.paper.measured_bands import PAPER_PEAK_POWER, PAPER_PITCH_RANGE_DEG
from wingbeat.paper.treatments import DEFAULT, MODELS, SAMPLE_SPEED, TREATMENTS, Case, Orbits, certified
from wingbeat.results.record import at_station

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from wingbeat.results.orbit import Orbit

STATIONS = {"1/4": 0.25, "3/4": 0.75}
_FORCES = (
    ("alpha_deg", "angle of attack α [deg]"),
    ("horizontal_force_over_weight", "horizontal force / weight [-]"),
    ("vertical_force_over_weight", "vertical force / weight [-]"),
)


def sample_orbits(orbits: Orbits, treatment: str, animal: str) -> dict[str, Orbit]:
    """Return the certified orbits at the paper's 10 m/s by coefficient model."""
    found = {model: certified(orbits, treatment, animal, model).get(SAMPLE_SPEED) for model in MODELS}
    return {model: orbit for model, orbit in found.items() if orbit is not None}


def absence(orbits: Orbits, treatment: str, animal: str, models: tuple[str, ...] = MODELS) -> str:
    """Return in words which of the sample orbits are missing and why; empty if none is.

    >>> absence({}, "mirrored", "bat", ("su-fan",))
    'No certified orbit of the bat at 10 m/s with Su-Fan (mirrored): not solved.'
    """
    there, missing = sample_orbits(orbits, treatment, animal), []
    for model in models:
        if model not in there:
            orbit = orbits.get(Case(treatment, animal, model, SAMPLE_SPEED))
            missing.append(f"{LOOKS[model].name} ({treatment}): {orbit.status.value if orbit else 'not solved'}")
    return (
        f"No certified orbit of the {animal} at {SAMPLE_SPEED:g} m/s with {', '.join(missing)}." if missing else ""
    )


def assumptions(treatment: str) -> str:
    """Return a treatment in words."""
    return next(t.words for t in TREATMENTS if t.name == treatment)


def _about(shown: dict[str, Orbit], treatment: str) -> str:
    """Return the beginning of a note: what flies, at which frequencies, under which assumptions."""
    beats = ", ".join(f"{LOOKS[model].name} {orbit.wingbeat.frequency:.3g} Hz" for model, orbit in shown.items())
    return f"Bat at {SAMPLE_SPEED:g} m/s{f' ({beats})' if beats else ''}; {assumptions(treatment)}."


def strip_series(orbit: Orbit, station: float) -> dict[str, np.ndarray]:
    """Return angle of attack and forces of one strip at a span fraction, over the beat.

    Returns
    -------
    ``alpha_deg`` and horizontal and vertical force on that strip of both wings over the animal's weight, shape
    (K,) each; between strip centres linear.
    """
    data, model = orbit.dataset, orbit.problem.model
    weight = model.vehicle.mass * model.air.gravity
    alpha = np.unwrap(data["alpha"].values, axis=1)
    forward, up = (2 * data["strip_force"].sel(axis=axis).values / weight for axis in "xz")
    series = (np.degrees(alpha), forward, up)
    return {name: at_station(values, station) for (name, _), values in zip(_FORCES, series, strict=True)}


def forces_figure(orbits: Orbits, sample: str = DEFAULT) -> tuple[Figure, Table]:
    """Draw figure 6: effective angle of attack, horizontal and vertical force at 1/4 and 3/4 of the bat's span.

    Parameters
    ----------
    orbits : solved orbits by case; those of the bat at 10 m/s are drawn if they are certified.
    sample : name of the treatment.

    Returns
    -------
    The figure, and its rows: model, span fraction and phase with the three drawn quantities.
    """
    from matplotlib import rc_context

    shown = sample_orbits(orbits, sample, "bat")
    strips = {orbit.dataset.sizes["station"] for orbit in shown.values()} or {"N"}
    note = (
        f"{_about(shown, sample)} Downstroke shaded. Forces are those of one of "
        f"{', '.join(map(str, strips))} equal strips, both wings together, over the animal's weight, forward and "
        "up positive; between strip centres linear."
    )
    series = {(m, name): strip_series(o, s) for m, o in shown.items() for name, s in STATIONS.items()}
    with rc_context(STYLE):  # type: ignore[arg-type]
        figure = sheet(PAGE, 125.0, note, absence(orbits, sample, "bat"))
        panels = figure.subplots(3, 2, sharex=True, sharey="row")
        for row, (quantity, label) in zip(panels, _FORCES, strict=True):
            for axes, station in zip(row, STATIONS, strict=True):
                dress_cycle(axes, label if station == "1/4" else "")
                for model, orbit in shown.items():
                    values = series[model, station][quantity]
                    axes.plot(orbit.dataset["phase"], values, label=LOOKS[model].name, **LOOKS[model].line)
                if not shown:
                    say(axes, "no certified orbit")
        for axes, station in zip(panels[0], STATIONS, strict=True):
            axes.set_title(f"{station} span", fontsize=8, loc="right", pad=4)
            axes.tick_params(labelbottom=False)
            if shown:
                legend_above(axes)
        for axes in panels[:2].flat:
            axes.set_xlabel("")
        figure.align_ylabels(panels)
        letter_panels(panels)
    rows = []
    for (model, station), columns in series.items():
        about = {"model": model, "treatment": sample, "span_fraction": STATIONS[station]}
        rows += _over_phase(shown[model], about, columns)
    return figure, rows


def power_figure(orbits: Orbits, sample: str = DEFAULT) -> tuple[Figure, Table]:
    """Draw figure 7: hinge power of both wings of the bat at 10 m/s, and the peaks that the paper prints.

    Parameters and returns are those of `forces_figure`.
    """
    from matplotlib import rc_context

    shown = sample_orbits(orbits, sample, "bat")
    series = {model: {"hinge_power_W": orbit.dataset["hinge_power"].values} for model, orbit in shown.items()}
    peaks = [f"{LOOKS[m].name} {s['hinge_power_W'].max():.3g} W" for m, s in series.items()]
    note = (
        f"{_about(shown, sample)} Power at the hinges, both wings. Downstroke shaded. "
        f"Peaks: {', '.join(peaks) or 'none to tell'}; dotted: the peaks that the paper prints for the same two "
        "models."
    )
    with rc_context(STYLE):  # type: ignore[arg-type]
        figure = sheet(COLUMN, 62.0, note, absence(orbits, sample, "bat"))
        axes = figure.subplots()
        _draw_cycle(axes, shown, series, "hinge_power_W", "hinge power [W]")
        for model, peak in PAPER_PEAK_POWER.items():
            axes.axhline(peak, color=LOOKS[model].color, linewidth=0.6, linestyle=(0, (1, 2)), gid="paper")
            place: dict[str, Any] = {"xytext": (3, 0), "textcoords": "offset points", "va": "center"}
            axes.annotate(
                f"paper:\n{peak:g} W", (1.0, peak), color=LOOKS[model].color, fontsize=FONT_SMALL, **place
            )
        top = max([*PAPER_PEAK_POWER.values(), *(s["hinge_power_W"].max() for s in series.values())])
        axes.set_ylim(top=1.1 * top)
    return figure, _rows(shown, sample, series)


def pitch_figure(orbits: Orbits, sample: str = DEFAULT) -> tuple[Figure, Table]:
    """Draw figure 8: body pitch of the bat over one beat at 10 m/s, with the range of each curve.

    Parameters and returns are those of `forces_figure`.
    """
    from matplotlib import rc_context

    shown = sample_orbits(orbits, sample, "bat")
    series = {m: {"body_pitch_deg": np.degrees(orbit.dataset["body_pitch"].values)} for m, orbit in shown.items()}
    ranges = [f"{LOOKS[m].name} {np.ptp(s['body_pitch_deg']):.3g} deg" for m, s in series.items()]
    printed = [f"{LOOKS[m].name} {value:g} deg" for m, value in PAPER_PITCH_RANGE_DEG.items()]
    note = (
        f"{_about(shown, sample)} Nose up is positive; downstroke shaded. "
        f"Range over the beat: {', '.join(ranges) or 'none to tell'}; the paper says at most {', '.join(printed)}."
    )
    with rc_context(STYLE):  # type: ignore[arg-type]
        figure = sheet(COLUMN, 62.0, note, absence(orbits, sample, "bat"))
        _draw_cycle(figure.subplots(), shown, series, "body_pitch_deg", "body pitch ψ [deg]")
    return figure, _rows(shown, sample, series)


def _draw_cycle(axes: Axes, shown: dict[str, Orbit], series: dict, quantity: str, label: str) -> None:
    dress_cycle(axes, label)
    for model, orbit in shown.items():
        axes.plot(orbit.dataset["phase"], series[model][quantity], label=LOOKS[model].name, **LOOKS[model].line)
    if shown:
        legend_above(axes)
    else:
        say(axes, "no certified orbit")


def _rows(shown: dict[str, Orbit], sample: str, series: dict[str, dict[str, np.ndarray]]) -> Table:
    return [
        row
        for model, columns in series.items()
        for row in _over_phase(shown[model], {"model": model, "treatment": sample}, columns)
    ]


def _over_phase(orbit: Orbit, about: dict[str, Any], columns: dict[str, np.ndarray]) -> list[dict[str, Any]]:
    columns = {"phase": orbit.dataset["phase"].values, "time_s": orbit.dataset["time"].values, **columns}
    return [about | dict(zip(columns, values, strict=True)) for values in zip(*columns.values(), strict=True)]
