"""Figures 6 to 8: angles of attack and forces, power and body pitch of the bat over one wingbeat at 10 m/s."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base.datasets import at_station
from wingbeat._base.style import COLUMN, PAGE, drawing, legend_above, letter_panels
from wingbeat.plots.published import PAPER_PEAK_POWER, PAPER_PITCH_RANGE_DEG, PAPER_SMALL_ALPHA_DEG
from wingbeat_evidence.paper.contradictions import NEAR_PEAK, Printed, near, told
from wingbeat_evidence.paper.figure_style import FONT_SMALL, LOOKS, Drawn, Table, dress_cycle, say, sheet
from wingbeat_evidence.paper.treatments import DEFAULT, MODELS, SAMPLE_SPEED, TREATMENTS, Case, Orbits, certified

if TYPE_CHECKING:
    from matplotlib.axes import Axes

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
    """Return in words which sample orbits are missing and why; an empty text if none is missing.

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
    """Return the description of a treatment."""
    return next(t.words for t in TREATMENTS if t.name == treatment)


def _about(shown: dict[str, Orbit], treatment: str) -> str:
    """Return the beginning of a caption: animal, speed, frequencies and assumptions."""
    beats = ", ".join(f"{LOOKS[model].name} {orbit.wingbeat.frequency:.3g} Hz" for model, orbit in shown.items())
    return f"Bat at {SAMPLE_SPEED:g} m/s{f' ({beats})' if beats else ''}; {assumptions(treatment)}."


def strip_series(orbit: Orbit, station: float) -> dict[str, np.ndarray]:
    """Return the angle of attack and the forces of the strip at a span fraction, over the wingbeat.

    Returns
    -------
    ``alpha_deg``, and the horizontal and the vertical force on this strip of both wings divided by the animal's
    weight. Each has shape (K,). Values are interpolated linearly between strip centres.
    """
    data, model = orbit.dataset, orbit.problem.model
    weight = model.vehicle.mass * model.air.gravity
    alpha = np.unwrap(data["alpha"].values, axis=1)
    forward, up = (2 * data["strip_force"].sel(axis=axis).values / weight for axis in "xz")
    series = (np.degrees(alpha), forward, up)
    return {name: at_station(values, station) for (name, _), values in zip(_FORCES, series, strict=True)}


def forces_figure(orbits: Orbits, sample: str = DEFAULT) -> Drawn:
    """Draw figure 6: effective angle of attack, horizontal and vertical force at 1/4 and 3/4 of the bat's span.

    Parameters
    ----------
    orbits : solved orbits by case; those of the bat at 10 m/s are drawn if they are certified.
    sample : name of the treatment.

    Returns
    -------
    The figure, its caption, and its rows: model, span fraction and phase with the three drawn quantities.
    """
    shown = sample_orbits(orbits, sample, "bat")
    strips = {orbit.dataset.sizes["station"] for orbit in shown.values()} or {"N"}
    caption = (
        f"{_about(shown, sample)} The downstroke is shaded. Forces are those on one of "
        f"{', '.join(map(str, strips))} equal strips, both wings together, divided by the animal's weight; "
        "forward and up are positive. Values are interpolated linearly between strip centres. Hatched: "
        f"{PAPER_SMALL_ALPHA_DEG[0]:g} to {PAPER_SMALL_ALPHA_DEG[1]:g} deg, which the paper calls small."
    )
    series = {(m, name): strip_series(o, s) for m, o in shown.items() for name, s in STATIONS.items()}
    caption = f"{caption} {told(6, _printed_of_forces(series))}"
    with drawing():
        figure = sheet(PAGE, 125.0, absence(orbits, sample, "bat"))
        panels = figure.subplots(3, 2, sharex=True, sharey="row")
        for row, (quantity, label) in zip(panels, _FORCES, strict=True):
            for axes, station in zip(row, STATIONS, strict=True):
                dress_cycle(axes, label if station == "1/4" else "")
                if quantity == "alpha_deg":
                    axes.axhspan(
                        *PAPER_SMALL_ALPHA_DEG, hatch="////", facecolor="none", edgecolor="0.75", gid="paper"
                    )
                for model, orbit in shown.items():
                    values = series[model, station][quantity]
                    axes.plot(orbit.dataset["phase"], values, label=LOOKS[model].name, **LOOKS[model].line)
                if not shown:
                    say(axes, "no certified orbit")
        for axes, station in zip(panels[0], STATIONS, strict=True):
            axes.set_title(f"{station} span", fontsize=8, loc="right", pad=4)
            axes.tick_params(labelbottom=False)
        if shown:
            legend_above(panels[0, 0])
        for axes in panels[:2].flat:
            axes.set_xlabel("")
        figure.align_ylabels(panels)
        letter_panels(panels)
    rows = []
    for (model, station), columns in series.items():
        about = {"model": model, "treatment": sample, "span_fraction": STATIONS[station]}
        rows += _over_phase(shown[model], about, columns)
    return Drawn(figure, rows, caption)


def power_figure(orbits: Orbits, sample: str = DEFAULT) -> Drawn:
    """Draw figure 7: hinge power of both wings of the bat at 10 m/s, and the peaks that the paper prints.

    Parameters and returns are those of `forces_figure`.
    """
    shown = sample_orbits(orbits, sample, "bat")
    series = {model: {"hinge_power_W": orbit.dataset["hinge_power"].values} for model, orbit in shown.items()}
    peaks = [f"{LOOKS[m].name} {s['hinge_power_W'].max():.3g} W" for m, s in series.items()]
    caption = (
        f"{_about(shown, sample)} The power is that at the hinges of both wings. The downstroke is shaded. "
        f"Peaks: {', '.join(peaks) or 'none'}; dotted lines: the peaks that the paper prints for the same two "
        "models. "
    ) + told(7, _printed_of_power(series))
    with drawing():
        figure = sheet(COLUMN, 62.0, absence(orbits, sample, "bat"))
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
    return Drawn(figure, _rows(shown, sample, series), caption)


def pitch_figure(orbits: Orbits, sample: str = DEFAULT) -> Drawn:
    """Draw figure 8: body pitch of the bat over one wingbeat at 10 m/s, with the ranges that the paper prints.

    Parameters and returns are those of `forces_figure`.
    """
    shown = sample_orbits(orbits, sample, "bat")
    series = {m: {"body_pitch_deg": np.degrees(orbit.dataset["body_pitch"].values)} for m, orbit in shown.items()}
    ranges = [f"{LOOKS[m].name} {np.ptp(s['body_pitch_deg']):.3g} deg" for m, s in series.items()]
    printed = [f"{LOOKS[m].name} {value:g} deg" for m, value in PAPER_PITCH_RANGE_DEG.items()]
    caption = (
        f"{_about(shown, sample)} Nose up is positive. The downstroke is shaded. "
        f"Range over the wingbeat: {', '.join(ranges) or 'none'}; bars at the right: the ranges that the paper "
        f"prints, {', '.join(printed)}. "
    ) + told(8, _printed_of_pitch(series))
    with drawing():
        figure = sheet(COLUMN, 62.0, absence(orbits, sample, "bat"))
        axes = figure.subplots()
        _draw_cycle(axes, shown, series, "body_pitch_deg", "body pitch ψ [deg]")
        for i, (model, extent) in enumerate(PAPER_PITCH_RANGE_DEG.items()):
            drawn = series.get(model, {"body_pitch_deg": np.zeros(1)})["body_pitch_deg"]
            middle, at = 0.5 * (drawn.min() + drawn.max()), 1.03 + 0.17 * i
            bar: dict[str, Any] = {"color": LOOKS[model].color, "clip_on": False, "linewidth": 1.2, "marker": "_"}
            axes.plot([at, at], [middle - 0.5 * extent, middle + 0.5 * extent], gid="paper", **bar)
            place: dict[str, Any] = {
                "xytext": (3, 0),
                "textcoords": "offset points",
                "va": "center",
                "annotation_clip": False,
            }
            axes.annotate(
                f"paper:\n{extent:g}°", (at, middle), color=LOOKS[model].color, fontsize=FONT_SMALL, **place
            )
    return Drawn(figure, _rows(shown, sample, series), caption)


def _printed_of_forces(series: dict[tuple[str, str], dict[str, np.ndarray]]) -> list[Printed]:
    """Return the paper's printed statements about the bat's angles and forces, each with our result."""
    found = []
    if ("su-fan", "1/4") in series:
        low, high = PAPER_SMALL_ALPHA_DEG
        arm = series["su-fan", "1/4"]["alpha_deg"][:-1]
        share = float(np.mean((arm > low) & (arm <= high)))
        statement = "a small nose-up angle of the arm throughout the wingbeat with Su-Fan"
        found.append(Printed(statement, f"from {arm.min():.3g} to {arm.max():.3g} deg", share == 1.0))
    if {model for model, _ in series} == set(MODELS):
        for name, words in (
            ("horizontal_force_over_weight", "horizontal"),
            ("vertical_force_over_weight", "vertical"),
        ):
            swings = [[float(np.ptp(series[model, station][name])) for station in STATIONS] for model in MODELS]
            ratios = [fit / fly for fit, fly in zip(*swings, strict=True)]
            told_ratios = " and ".join(f"{ratio:.2f}" for ratio in ratios)
            ours = f"peak to peak, {told_ratios} times Dickinson's at 1/4 and 3/4 span"
            found.append(Printed(f"smaller {words} forces with Su-Fan", ours, max(ratios) < 1))
    return found


def _printed_of_power(series: dict[str, dict[str, np.ndarray]]) -> list[Printed]:
    """Return the bat's peak powers that the paper prints, each with our result."""
    found = []
    for model, columns in series.items():
        peak, printed = float(columns["hinge_power_W"].max()), PAPER_PEAK_POWER[model]
        agrees = near(peak, printed, NEAR_PEAK)
        found.append(Printed(f"a peak of {printed:g} W with {LOOKS[model].name}", f"{peak:.3g} W", agrees))
    return found


def _printed_of_pitch(series: dict[str, dict[str, np.ndarray]]) -> list[Printed]:
    """Return the bat's ranges of body pitch that the paper prints, each with our result."""
    found = []
    for model, columns in series.items():
        extent, printed = float(np.ptp(columns["body_pitch_deg"])), PAPER_PITCH_RANGE_DEG[model]
        within = extent <= printed if model == "su-fan" else near(extent, printed, NEAR_PEAK)
        words = "at most" if model == "su-fan" else "as much as"
        statement = f"{words} {printed:g} deg of body pitch with {LOOKS[model].name}"
        found.append(Printed(statement, f"{extent:.3g} deg", within))
    return found


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
