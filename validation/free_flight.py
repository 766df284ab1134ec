"""Flights of ours, flown on for ten beats by PteraSoftware's free flight: a table, a page, a figure.

Run as ``python validation/free_flight.py [--page]``, with the extra uvlm; it takes about twenty minutes. Writes
``data/free_flight.csv`` and from it page and figure; with ``--page`` nothing is computed.
"""

from __future__ import annotations

import argparse
import dataclasses
import math
import sys
from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.figure import Figure
from page_script import ROOT, filled

import wingbeat as wb
from wingbeat._base import WingbeatError, write_atomically
from wingbeat._base.style import MARKED, PAGE, drawing, legend_below, letter_panels, new_figure
from wingbeat.mechanics.flights import fly_beats
from wingbeat.mechanics.glide import held_still
from wingbeat.plots import save_figure
from wingbeat_evidence.markdown import markdown_table
from wingbeat_evidence.second_opinion import LatticeOptions
from wingbeat_evidence.second_opinion.comparison import ATTACHED, lattice_loads
from wingbeat_evidence.second_opinion.free_flight import WINGS, Flown, as_rigid_body, fly_on, own_less_lattice
from wingbeat_evidence.second_opinion.motion import Motion
from wingbeat_evidence.second_opinion.own_loads import own_loads

DOCS, TABLE = ROOT / "docs" / "evidence", ROOT / "data" / "free_flight.csv"
BEATS, OPTIONS, FINER = 10, LatticeOptions(2, 6, 16, 2), LatticeOptions(2, 6, 32, 2)
GLIDE = "pigeon, glide"
CASES = {"pigeon, 12 m/s": ("pigeon", 12.0), "robofalcon2, 8 m/s": ("robofalcon2", 8.0), GLIDE: ("pigeon", 12.0)}
OURS, BARE, WHOLE, SHORT = "ours", "bare", "whole", "one row"
REPLACED, STEPS = "our loads", "half step"
DRIFTS = ("speed", "height", "pitch_deg")


def flight(case: str) -> tuple[wb.FlightModel, wb.aero.BladeElement, Motion]:
    """Return model, air loads and motion of a case; a glide is cut into beats as long as the animal's."""
    name, speed = CASES[case]
    species = wb.load_species(name)
    model = wb.models.animal(species)
    problem = model.problem(species, speed=speed)
    if case != GLIDE:
        orbit = wb.solve_orbit(problem)
        flown = orbit.problem.model
        return flown, problem.aero, Motion.of(orbit.dataset, flown.vehicle, orbit.wingbeat, flown.air)
    flown, aero = problem.species, dataclasses.replace(problem.aero, wake="none")
    glides = wb.glide_polar(flown, aero, np.radians([4.0, 6.0, 8.0]), trim="tail").glides
    glide = min((one for one in glides if one.trimmed), key=lambda one: abs(one.speed - speed))
    held = dataclasses.replace(
        held_still(flown.wingbeat),
        flap_mean=glide.flap,
        pitch_mean=glide.wing_pitch,
        tail_tilt=glide.tail_tilt,
    )
    phase = np.linspace(0.0, 1.0, 65)
    u, w = glide.speed * math.cos(glide.glide_angle), -glide.sink
    at = {"x": u * phase / held.frequency, "z": w * phase / held.frequency}
    fields = at | {"body_pitch": phase * 0 + glide.body_pitch, "u": phase * 0 + u, "w": phase * 0 + w}
    fields |= {name: phase * 0 for name in ("pitch_rate", "u_rate", "w_rate", "pitch_acceleration")}
    dataset = xr.Dataset({name: ("phase", values) for name, values in fields.items()}, {"phase": phase})
    motion = Motion.of(dataset, flown.vehicle, held, flown.air)
    return wb.FlightModel(flown.vehicle, aero, flown.air, velocity=(u, w)), aero, motion


def drifts(flown: Flown, states: np.ndarray) -> list[dict[str, float]]:
    """Return speed, height and pitch after each beat less those of a flight that repeats."""
    way = flown.states[-1] - flown.states[0]
    rows = []
    for beat, state in enumerate(states):
        off = state - states[0] - beat * way * [1, 1, 0, 0, 0, 0]
        rows.append({"beat": beat, "speed": off[3], "height": off[1], "pitch_deg": math.degrees(off[2])})
    return rows


def ours(flown: Flown) -> np.ndarray:
    """Return the states of our own model, flown from the same state, at the end of each beat."""
    motion = flown.motion
    start = wb.State(*(float(field[0]) for field in motion.state(np.zeros(1))))
    states = fly_beats(flown.model, motion.wingbeat, start, BEATS, 1).states
    arm = np.array([[math.cos(p), -math.sin(p)] for p in states[:, 2]]) @ flown.place
    up = np.array([[math.sin(p), math.cos(p)] for p in states[:, 2]]) @ flown.place
    x, z, pitch, u, w, turning = states.T
    return np.column_stack([x + arm, z + up, pitch, u - turning * up, w + turning * arm, turning])


def flown_on(case: str) -> Iterator[dict[str, Any]]:
    """Yield a row for each beat of each way to fly a case on, and one with the loads on our path."""
    model, aero, motion = flight(case)
    flown = as_rigid_body(model, aero, motion, OPTIONS.steps)
    for row in drifts(flown, ours(flown)):
        yield {"case": case, "flown": OURS} | row
    whole = fly_on(flown, OPTIONS, BEATS)
    difference = own_less_lattice(flown, whole, OPTIONS)
    fine = lattice_loads(motion, LatticeOptions(beats=2), None, aero)
    alpha = own_loads(motion, aero, np.arange(OPTIONS.steps) / OPTIONS.steps).alpha
    assert alpha is not None
    weight = flown.mass * model.air.gravity
    yield {
        "case": case,
        "flown": "loads",
        "period": motion.period,
        "mass": flown.mass,
        "inertia": flown.inertia,
        **dict(zip(("own_thrust", "own_lift", "own_moment"), flown.loads[WINGS].mean(axis=0), strict=True)),
        **dict(zip(("less_thrust", "less_lift", "less_moment"), difference.mean(axis=0), strict=True)),
        "fine_thrust": float(np.mean(fine.thrust)),
        "fine_lift": float(np.mean(fine.lift)),
        "weight": weight,
        "beyond_15_deg": float(np.mean(np.abs(alpha) > ATTACHED)),
    }
    ways = {
        WHOLE: whole,
        BARE: fly_on(flown, OPTIONS, BEATS, complete=False),
        SHORT: fly_on(flown, OPTIONS, BEATS, wake_rows=1),
        REPLACED: fly_on(flown, OPTIONS, BEATS, instead=difference),
    }
    if case == GLIDE:
        ways[STEPS] = fly_on(as_rigid_body(model, aero, motion, FINER.steps), FINER, BEATS)
    for name, flight_on in ways.items():
        steps = FINER.steps if name == STEPS else OPTIONS.steps
        states = flight_on.state[OPTIONS.beats * steps :: steps]
        for row in drifts(flown, states):
            yield {"case": case, "flown": name, "rounds": flight_on.rounds.mean()} | row


def _last(of: pd.DataFrame) -> int:
    return int(of["beat"].max())


def page(table: pd.DataFrame) -> str:
    """Return the page.

    Parameters
    ----------
    table : rows of `flown_on`.
    """
    rows, causes = [], []
    for case in CASES:
        found = table[table["case"] == case]
        for name, of in found[found["flown"] != "loads"].groupby("flown", sort=False):
            whole = _last(of)
            first, last = (of[of["beat"] == beat].iloc[0] if whole else None for beat in (1, whole))
            cells = ["-"] * 2
            if first is not None and last is not None:
                cells = [", ".join(_number(row[drift]) for drift in DRIFTS) for row in (first, last)]
            rows.append([case, name, cells[0], f"{whole}: {cells[1]}" if whole else "0"])
        loads = found[found["flown"] == "loads"].iloc[0]
        lift, thrust = loads["own_lift"] - loads["less_lift"], loads["own_thrust"] - loads["less_thrust"]
        causes.append(
            [
                case,
                f"{loads['own_lift']:.3g}, {loads['own_thrust']:.2g}",
                f"{lift:.3g}, {thrust:.2g}",
                f"{loads['fine_lift']:.3g}, {loads['fine_thrust']:.2g}",
                f"{-loads['less_moment'] / loads['inertia']:.0f}",
                f"{loads['beyond_15_deg']:.0%}",
            ]
        )
    heads = ["flight", "flown", "after 1 beat", "after the last whole beat"]
    of_loads = [
        "flight",
        "ours",
        "this lattice",
        "finer",
        "its extra moment / inertia [rad/s2]",
        "strips beyond 15 deg",
    ]
    rounds = table[table["flown"] != OURS]["rounds"].dropna()
    return filled(
        "free_flight",
        drifts=markdown_table(heads, rows),
        causes=markdown_table(of_loads, causes),
        rounds=rounds.mean(),
        chordwise=OPTIONS.chordwise,
        spanwise=OPTIONS.spanwise,
        steps=OPTIONS.steps,
        beats=BEATS,
    )


def _number(value: float) -> str:
    return f"{float(f'{value:.2g}'):g}" if abs(value) >= 1e-5 else "0"


@drawing()
def figure(table: pd.DataFrame) -> Figure:
    """Draw drift of speed, height and pitch over the beats of each case."""
    drawn = new_figure(PAGE, 120.0)
    panels = drawn.subplots(len(DRIFTS), len(CASES), sharex=True)
    names = (OURS, WHOLE, BARE, SHORT, REPLACED, STEPS)
    for column, case in zip(panels.T, CASES, strict=True):
        column[0].set_title(case)
        for name, (color, mark) in zip(names, MARKED, strict=False):
            of = table[(table["case"] == case) & (table["flown"] == name)]
            for axes, drift in zip(column, DRIFTS, strict=True):
                if len(of):
                    axes.plot(of["beat"], of[drift], color=color, marker=mark, markersize=3, label=name)
        column[-1].set_xlabel("beats")
    for axes, label in zip(panels[:, 0], ("speed [m/s]", "height [m]", "pitch [deg]"), strict=True):
        axes.set_ylabel(f"drift of {label}")
    legend_below(drawn, panels, columns=3)
    letter_panels(panels)
    return drawn


def main() -> int:
    """Fly, and write table, page and figure; return the exit code."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--page", action="store_true", help="write the page from the table, without flying")
    try:
        if not parser.parse_args().page:
            rows = [row for case in CASES for row in flown_on(case)]
            write_atomically(TABLE, pd.DataFrame(rows).to_csv(index=False, float_format="%.5g"))
        table = pd.read_csv(TABLE)
        save_figure(figure(table), DOCS / "free_flight.png")
        write_atomically(DOCS / "free_flight.md", page(table))
    except WingbeatError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
