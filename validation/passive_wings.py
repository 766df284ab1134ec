"""Write docs/evidence/passive_wings.md and its figure: published wings with passive pitch, flown."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure
from page_script import filled, write_page

from wingbeat._base import WingbeatError
from wingbeat_evidence.markdown import markdown_table
from wingbeat_evidence.passive_wings import (
    MODELS,
    Flown,
    film_phase,
    fly,
    measured,
    passive_wings,
    projected_peak,
    reynolds,
    with_centre,
)


def _cell(flown: Flown) -> list[str]:
    lead = f"{np.degrees(flown.stroke.lead):.0f}"
    error = "-" if flown.phase_error is None else f"{flown.phase_error:+.0f}"
    return [f"{flown.amplitude:.0f}", f"{flown.ratio:.2f}", lead, error, "yes" if flown.within else "**no**"]


def _rows(flights: dict[tuple[str, str], Flown]) -> list[list[str]]:
    rows = []
    for case in passive_wings()["cases"]:
        truth = measured(case)
        aim = truth.harmonic if truth.peak is None else truth.peak
        lead = "-" if truth.lead is None else f"{truth.lead:.0f}"
        for model in MODELS:
            guess = "{:.0f}, {:.0f}".format(*case[f"guess_{model}"])
            found = _cell(flights[case["name"], model])
            other = projected_peak(case)
            flown = flights[case["name"], model]
            again = ["-", "-"] if other is None else [f"{other:.0f}", f"{flown.amplitude / other:.2f}"]
            rows.append([case["name"], f"{reynolds(case):.0f}", f"{aim:.0f}", lead, model, guess, *found, *again])
    return rows


def _changes(wing: dict[str, Any]) -> list[tuple[str, dict[str, Any]]]:
    low, high = wing["stiffness_range"]
    axis, centre = wing["pitch_axis"], wing["mass_axis"]
    ahead = max(axis - 0.05, 0.0)
    return [
        ("as published", {}),
        (f"stiffness {low:.1e} N m/rad", {"stiffness": low}),
        (f"stiffness {high:.1e} N m/rad", {"stiffness": high}),
        ("no damping", {"damping": 0.0}),
        ("damping of 0.1 of critical more", {"damping": wing["damping"] + 0.1 * _critical(wing)}),
        (f"pitch axis {ahead:.2f} c", {"pitch_axis": ahead, "mass_axis": centre + ahead - axis}),
        (f"pitch axis {axis + 0.05:.2f} c", {"pitch_axis": axis + 0.05, "mass_axis": centre + 0.05}),
        (f"mass axis {centre - 0.1:.2f} c", {"mass_axis": centre - 0.1}),
        (f"mass axis {min(centre + 0.1, 1.0):.2f} c", {"mass_axis": centre + 0.1}),
        ("wing mass x 0.7", {"mass": 0.7 * wing["mass"]}),
        ("wing mass x 1.3", {"mass": 1.3 * wing["mass"]}),
        ("no added mass, no rotation", {"unsteady": False}),
        ("Dickinson, x_cp 0.16 + 0.82 alpha/pi", {"aero": with_centre(0.16, 0.82)}),
        ("Dickinson, x_cp 0.25 + 0.50 alpha/pi", {"aero": with_centre(0.25, 0.5)}),
    ]


def _critical(wing: dict[str, Any]) -> float:
    """Return the critical damping of the hinge, twice the root of stiffness times pitch inertia [N m s/rad]."""
    behind = (wing["mass_axis"] - wing["pitch_axis"]) * wing["chord"]
    inertia = wing["mass"] * (behind**2 + (wing["mass_gyration"] * wing["chord"]) ** 2)
    return float(2 * np.sqrt(wing["stiffness"] * inertia))


def _sensitivities(cases: list[dict[str, Any]]) -> list[list[str]]:
    rows: list[list[str]] = []
    for place, case in enumerate(cases):
        for row, (name, change) in enumerate(_changes(passive_wings()[case["wing"]])):
            try:
                found = fly(case, "su-fan", **change)
                cells = [f"{found.ratio:.2f}", f"{found.phase_error:+.0f}"]
            except WingbeatError:
                cells = ["no stroke", "-"]
            print(case["name"], name, cells, flush=True)
            if place == 0:
                rows.append([name, *cells])
            else:
                both = rows[row][0] if rows[row][0] == name else f"{rows[row][0]}; fly: {name}"
                rows[row] = [both, *rows[row][1:], *cells]
    return rows


def _figure(flights: dict[tuple[str, str], Flown]) -> Figure:
    cases = passive_wings()["cases"]
    figure, axes = plt.subplots(2, 4, figsize=(12, 5.6), sharex=True, sharey=True, layout="constrained")
    for axis, case in zip(axes.flat, cases, strict=False):
        truth = measured(case)
        phase = flights[case["name"], "su-fan"].stroke.phase
        stroke = flights[case["name"], "su-fan"].stroke
        axis.plot(phase, np.degrees(stroke.flap_angle), color="0.7", label="flap, measured")
        if "pitch_deg" in case:
            axis.plot(film_phase(case) % 1, case["pitch_deg"], "k.", markersize=4, label="pitch, measured")
        elif truth.lead is not None and truth.harmonic is not None:
            turn = 2 * np.pi * phase + np.radians(truth.lead)
            axis.plot(phase, truth.harmonic * np.cos(turn), "k:", label="pitch, measured (first harmonic)")
        elif truth.peak is not None:
            for side in (-1, 1):
                axis.axhline(side * truth.peak, color="k", linestyle="--", label="pitch, measured (peak)")
        for model, line in zip(MODELS, ("-", "-."), strict=True):
            flown = flights[case["name"], model].stroke
            axis.plot(phase, np.degrees(flown.hinge_angle), line, label=f"pitch, {model}")
        axis.set_title(case["name"], fontsize=10)
        axis.grid(alpha=0.3)
    spare = axes.flat[len(cases)]
    spare.axis("off")
    named = {}
    for axis in axes.flat:
        named |= dict(zip(*reversed(axis.get_legend_handles_labels()), strict=True))
    spare.legend(named.values(), named.keys(), loc="center", fontsize=9)
    for axis in axes[1, :3]:
        axis.set_xlabel("phase of the stroke")
    for axis in axes[:, 0]:
        axis.set_ylabel("angle [deg]")
    return figure


def made(_: Path) -> tuple[str, Figure]:
    """Return the page and its figure."""
    data = passive_wings()
    flights = {(case["name"], model): fly(case, model) for case in data["cases"] for model in MODELS}
    head = ["wing", "Re", "measured [deg]", "its lead", "model", "guess: pitch, lead", "flown", "ratio", "lead"]
    table = markdown_table([*head, "lead, flown - measured", "within", "read as a film", "ratio"], _rows(flights))
    sources = markdown_table(
        ["wing", "source", "grades"],
        [[key, data[key]["source"], data[key]["grades"]] for key in ("robobee", "fly")],
    )
    cases = [case for case in data["cases"] if measured(case).lead is not None]
    names = ["change"]
    for case in (cases[0], cases[-1]):
        names += [f"{case['name']}: ratio", "lead, flown - measured"]
    change = markdown_table(names, _sensitivities([cases[0], cases[-1]]))
    kept = [flights[case["name"], "su-fan"] for case in data["cases"]]
    count = f"{sum(one.within for one in kept)} of {len(kept)}"
    other = sum(flights[case["name"], "dickinson"].within for case in data["cases"])
    page = filled("passive_wings", table=table, sources=sources, change=change, count=count, other=other)
    return page, _figure(flights)


if __name__ == "__main__":
    sys.exit(write_page(str(__doc__), "passive_wings", made))
