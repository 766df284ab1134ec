"""Fly thousands of random gusts, and turbulence, with and without feedback, and write a page on what survives.

    python validation/gust_survival.py [--page | --again]

A pigeon and a bat fly by the models `paper` and `animal`: through 1000 gusts, and through 30 s of light and of
moderate turbulence on 32 seeds. The results go to ``data/gust_survival.csv``, and the page is written from them.
Orbits that are in the table already are not flown, unless with ``--again``; with ``--page`` nothing is flown.
"""

from __future__ import annotations

import argparse
import dataclasses
import math
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd
from page_script import filled

import wingbeat as wb
from wingbeat._base import write_atomically
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
)
from wingbeat.plots import save_figure
from wingbeat_evidence.markdown import markdown_table

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Model, animal, speed [m/s].
FLIGHTS = (("paper", "pigeon", 12.0), ("paper", "bat", 8.0), ("animal", "pigeon", 12.0), ("animal", "bat", 8.0))
SEGMENTS = 4
OPEN, AT_ONCE, LATE = "no feedback", "feedback", "feedback one beat late"
WITHIN = f"feedback {SEGMENTS} times a beat"
CONTROLS = (OPEN, AT_ONCE, LATE, WITHIN)
LEVELS = ("light", "moderate")
_LINES: tuple[dict[str, Any], ...] = (SECOND, FIRST, THIRD, {"color": PURPLE, "linestyle": (0, (5, 1, 1, 1))})
_MARKS = ("s", "o", "^", "D")
ROOT = Path(__file__).parents[1]
TABLE, OUT = ROOT / "data" / "gust_survival.csv", ROOT / "docs" / "evidence" / "gust_survival.md"
GUSTS, SIZE, BEATS = 1000, 5.0, 30  # number of gusts, size of the largest [m/s], beats of each flight
SEEDS, LASTS = 32, 30.0  # number of flights through turbulence of each level, and how long each lasts [s]
SIZES, DIRECTIONS = 10, 12  # bins
# Light and moderate turbulence are flown at once.
TURBULENT = wb.ManyOptions(lanes=SEEDS * len(LEVELS))
SEED = 1

Held = wb.Feedback | wb.SegmentFeedback


def controls(orbit: wb.Orbit) -> dict[str, tuple[Held, float]]:
    """Return each control of an orbit by name, with the spectral radius of a beat."""
    prompt, late, within = wb.feedback(orbit), wb.feedback(orbit, delay=1), wb.feedback_in_beat(orbit, SEGMENTS)
    # Gains of zero are flown by the program that flies the others: one program less to compile.
    nothing = dataclasses.replace(prompt, gains=np.zeros_like(prompt.gains))
    return {
        OPEN: (nothing, prompt.flight.spectral_radius),
        AT_ONCE: (prompt, prompt.spectral_radius),
        LATE: (late, late.spectral_radius),
        WITHIN: (within, within.spectral_radius),
    }


def flown_rows(model: str, animal: str, speed: float) -> Iterator[dict[str, Any]]:
    """Yield the rows of one orbit: how many flights of each kind were flown, and how many survived."""
    species = wb.load_species(animal)
    orbit = wb.solve_orbit(wb.models.model_of(model, species).problem(species, speed))
    held = controls(orbit)
    gusts = wb.survey_gusts(
        orbit, {name: one for name, (one, _) in held.items()}, GUSTS, size=SIZE, beats=BEATS, seed=SEED
    )
    for name, (one, radius) in held.items():
        about = {
            "model": model,
            "animal": animal,
            "speed": speed,
            "frequency": orbit.wingbeat.frequency,
            "control": name,
            "spectral_radius": radius,
        }
        edges = np.linspace(0.0, SIZE, SIZES + 1)
        yield from _binned(about | {"by": "size"}, gusts.size, gusts.survived[name], edges)
        edges = np.linspace(0.0, 360.0, DIRECTIONS + 1)
        yield from _binned(about | {"by": "direction"}, np.degrees(gusts.direction), gusts.survived[name], edges)
        survived = _turbulent(orbit, one)
        for i, level in enumerate(LEVELS):
            upward = wb.winds.DrydenTurbulence(speed, level).intensities[1]
            one_level = survived[i * SEEDS : (i + 1) * SEEDS]
            row = {"by": f"{level} turbulence", "from": upward, "to": upward}
            yield about | row | {"flown": len(one_level), "survived": int(one_level.sum())}


def _turbulent(orbit: wb.Orbit, held: Held) -> np.ndarray:
    """Return which flights through turbulence were survived, a level after the other."""
    speed = float(orbit.inputs["speed"])
    winds = [wb.winds.DrydenTurbulence(speed, level, seed=seed) for level in LEVELS for seed in range(SEEDS)]
    beats = math.ceil(LASTS * orbit.wingbeat.frequency)
    return wb.simulate_many(orbit, winds, beats, feedback=held, options=TURBULENT).survived


def _binned(
    about: dict[str, Any], values: np.ndarray, survived: np.ndarray, edges: np.ndarray
) -> Iterator[dict[str, Any]]:
    flown, alive = np.histogram(values, edges)[0], np.histogram(values[survived], edges)[0]
    for low, high, count, kept in zip(edges[:-1], edges[1:], flown.tolist(), alive.tolist(), strict=True):
        yield about | {"from": low, "to": high, "flown": count, "survived": kept}


def totals(table: pd.DataFrame) -> str:
    """Return the shares of all gusts and of all turbulence that were survived, as text."""
    kinds = table[table["by"] != "direction"].groupby(["model", "animal", "control", "by"], sort=False)
    found = kinds[["flown", "survived"]].sum()
    found["share_percent"] = 100.0 * found["survived"] / found["flown"]
    return found.to_string()


def page(table: pd.DataFrame, figure: Path) -> str:
    """Draw the figure, and return the page."""
    draw(table, figure)
    sizes = table[table["by"] == "size"]
    seeds = int(table.loc[table["by"] == "light turbulence", "flown"].iloc[0])
    gusts = int(sizes.groupby(["model", "animal", "control"])["flown"].sum().iloc[0])
    light, moderate = (f"{one} turbulence" for one in LEVELS)
    orbits = list(table[["model", "animal"]].drop_duplicates().itertuples(index=False, name=None))

    def shown(model: str, animal: str, control: str, by: str = "size") -> str:
        return f"{share(table, model, animal, control, by):.3g} %"

    within = [share(table, *one, WITHIN, moderate) for one in orbits]
    return filled(
        "gust_survival",
        gusts=gusts,
        seeds=seeds,
        light=table.loc[table["by"] == light, "from"].iloc[0],
        moderate=table.loc[table["by"] == moderate, "from"].iloc[0],
        segments=SEGMENTS,
        figure=figure.name,
        table=_table(table, orbits),
        open=f"{max(share(table, *one, OPEN, 'size') for one in orbits):.3g} %",
        open_light=f"{max(share(table, *one, OPEN, light) for one in orbits):.3g} %",
        bat=shown("paper", "bat", AT_ONCE),
        bat_late=shown("paper", "bat", LATE),
        pigeon_light=shown("paper", "pigeon", AT_ONCE, light),
        pigeon_late_light=shown("paper", "pigeon", LATE, light),
        bat_within=shown("paper", "bat", WITHIN),
        bat_within_light=shown("paper", "bat", WITHIN, light),
        worst=f"{min(within):.3g} %",
        best=f"{max(within):.3g} %",
        gust_error=100.0 * 0.5 / gusts**0.5,
        seed_error=100.0 * 0.5 / seeds**0.5,
    )


def share(table: pd.DataFrame, model: str, animal: str, control: str, by: str) -> float:
    """Return the share survived [percent] of an orbit with a control, over all bins of `by`."""
    chosen = (table["model"] == model) & (table["animal"] == animal)
    rows = table[chosen & (table["control"] == control) & (table["by"] == by)]
    return 100.0 * float(rows["survived"].sum() / rows["flown"].sum())


def _table(table: pd.DataFrame, orbits: list[tuple[str, str]]) -> str:
    """Return the spectral radius and the shares survived, a line for each control and a column for each orbit."""
    kinds = ("size", *(f"{one} turbulence" for one in LEVELS))
    heads, cells = ["control"], {control: [control] for control in CONTROLS}
    for model, animal in orbits:
        rows = table[(table["model"] == model) & (table["animal"] == animal)]
        beat = rows.iloc[0]
        heads.append(f"{animal}, `{model}`, {beat['speed']:g} m/s, {beat['frequency']:.2f} Hz")
        for control in CONTROLS:
            radius = rows.loc[rows["control"] == control, "spectral_radius"].iloc[0]
            shares = ", ".join(f"{share(table, model, animal, control, kind):.3g}" for kind in kinds)
            cells[control].append(f"{radius:.3f}; {shares}")
    return markdown_table(heads, cells.values())


@drawing()
def draw(table: pd.DataFrame, path: Path) -> None:
    """Draw the share survived against the size of the gusts, a panel for each orbit."""
    figure = new_figure(PAGE, 62.0)
    orbits = table[["model", "animal", "speed"]].drop_duplicates()
    panels = figure.subplots(1, len(orbits), sharey=True, squeeze=False)[0]
    for panel, (model, animal, speed) in zip(panels, orbits.itertuples(index=False), strict=True):
        rows = table[(table["model"] == model) & (table["animal"] == animal) & (table["by"] == "size")]
        _draw_shares(panel, rows)
        panel.set_title(f"{animal}, {speed:g} m/s, model {model}", fontsize="medium")
        first = panel is panels[0]
        dress(panel, "largest gust [m/s]", "survived [%]" if first else "")
    letter_panels(panels)
    legend_below(figure, panels)
    save_figure(figure, path)


def _draw_shares(panel: Axes, rows: pd.DataFrame) -> None:
    for control, line, mark in zip(CONTROLS, _LINES, _MARKS, strict=True):
        own = rows[rows["control"] == control]
        shares = 100.0 * own["survived"] / own["flown"]
        panel.plot(0.5 * (own["from"] + own["to"]), shares, label=control, marker=mark, markersize=2.5, **line)
    panel.set_xlim(0.0, float(rows["to"].max()))
    panel.set_ylim(-3.0, 103.0)


def main() -> None:
    """Fly, write table and page, and print the totals."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--page", action="store_true", help="write the page from the table, without flying")
    parser.add_argument("--again", action="store_true", help="fly orbits that are in the table, too")
    asked = parser.parse_args()
    rows = pd.read_csv(TABLE).to_dict("records") if TABLE.exists() and not asked.again else []
    done = {(row["model"], row["animal"], row["speed"]) for row in rows}
    for one in FLIGHTS if not asked.page else ():
        if one not in done:
            rows += flown_rows(*one)
            print(f"flown: {' '.join(map(str, one))}", flush=True)
            write_atomically(TABLE, pd.DataFrame(rows).to_csv(index=False, float_format="%.6g"))
    table = pd.read_csv(TABLE)
    write_atomically(OUT, page(table, OUT.with_suffix(".png")))
    print(totals(table))


if __name__ == "__main__":
    main()
