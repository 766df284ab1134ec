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
from typing import Any

import numpy as np
import pandas as pd
from gust_survival_words import AT_ONCE, FLIGHTS, LATE, LEVELS, OPEN, SEGMENTS, WITHIN, page

import wingbeat as wb
from wingbeat._base import write_atomically

ROOT = Path(__file__).parents[1]
TABLE, PAGE = ROOT / "data" / "gust_survival.csv", ROOT / "docs" / "evidence" / "gust_survival.md"
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
    write_atomically(PAGE, page(table, PAGE.with_suffix(".png")))
    print(totals(table))


if __name__ == "__main__":
    main()
