"""Write docs/evidence/parslew.md: what another predictive model of a pigeon does, and what ours does.

    python validation/parslew.py [--page]

Parslew 2015 (doi 10.1098/rsif.2014.0953) and Parslew and Crowther 2010 (doi 10.1016/j.jbiomech.2010.07.018)
predict the flight of a pigeon that spends the least mechanical power. We could read only their abstracts, so this
page tests the statements that stand there. Flights are kept in ``data/parslew.csv``; with ``--page`` nothing is
flown.
"""

from __future__ import annotations

import argparse
import dataclasses
import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd
from page_script import filled

import wingbeat as wb
from wingbeat._base import write_atomically
from wingbeat._base.style import FIRST, GREY, PAGE, SECOND, drawing, dress, legend_below, letter_panels, new_figure
from wingbeat.plots import save_figure
from wingbeat_evidence.whole_flights import read_measured_flights

# What the words of the abstracts are taken to mean.
NEAR_VERTICAL = 20.0  # deg
FLEXED = 0.1  # least share of the span that a flexed wing retracts
EXTENDED = 0.05  # largest share of the span that an extended wing retracts
GRADUAL = 0.25  # largest change of the frequency from one speed to the next
FLEXING_COSTS = 0.1, 0.3  # "20 % more power", within ten percentage points
PANELS = {
    "power_per_mass": ("positive power [W/kg]", "positive_power_per_mass"),
    "frequency": ("wingbeat frequency [Hz]", "frequency"),
    "from_vertical_deg": ("stroke plane from vertical [deg]", ""),
    "retraction": ("span retracted on the upstroke [-]", ""),
}
ROOT = Path(__file__).parents[1]
TABLE, OUT, FIGURE = (
    ROOT / "data" / "parslew.csv",
    ROOT / "docs" / "evidence" / "parslew.md",
    ROOT / "docs" / "evidence" / "parslew.png",
)
CRUISE = 6.0, 8.0, 10.0, 12.0, 14.0, 16.0, 18.0  # m/s, as live pigeons
CLIMBS = 0.5, 1.0, 2.0, 3.0, 4.0  # m/s
CLIMB_SPEED = 8.0  # m/s forward
HIGHEST = 9.6  # Hz, the highest frequency measured on pigeons (Berg and Biewener 2008)
RETRACTED = 0.6  # largest share of the span that the wing may retract
HOVER = 0.0, 0.3, 0.5  # shares of the span retracted in hover
STARTS = 12


def flown(flight: str, speed: float, climb: float = 0.0, held: float | None = None, live: bool = True) -> dict:
    """Fly the pigeon of the model `animal` at least positive power.

    Parameters
    ----------
    flight : name of the group of flights.
    speed, climb : forward and up [m/s].
    held : share of the span that the wing retracts on the upstroke; free, up to `RETRACTED`, if None.
    live : whether the frequency is at most that of live pigeons.
    """
    pigeon = wb.load_species("pigeon")
    model = wb.models.animal(pigeon, "free")
    species = model.species(pigeon)
    bounds = {"stroke_plane_tilt": (-math.radians(60), math.radians(60))}
    free = dict.fromkeys((*species.free, *bounds, "span_retraction"))
    if held is None:
        bounds["span_retraction"] = (0.0, RETRACTED)
    else:
        del free["span_retraction"]
        wingbeat = dataclasses.replace(species.wingbeat, span_retraction=held)
        species = dataclasses.replace(species, wingbeat=wingbeat)
    problem = model.problem(
        species,
        speed,
        climb,
        minimise="mean_positive_power",
        subject_to=f"frequency<={HIGHEST}" if live else (),
        free=tuple(free),
        bounds=bounds,
    )
    orbit = wb.solve_orbit(problem, starts=STARTS)
    row = {"flight": flight, "speed": speed, "climb": climb, "held": held, "live": live}
    if orbit.status is not wb.Status.CONVERGED:
        return row
    beat, wing, vehicle = orbit.wingbeat, problem.vehicle.wing, problem.vehicle
    pitch = float(np.mean(orbit.dataset["body_pitch"].values[:-1]))
    from_vertical = pitch + 0.5 * math.pi - wing.stroke_plane_angle - beat.stroke_plane_tilt
    return row | {
        "power_per_mass": orbit.record()["mean_positive_power"] / vehicle.mass,
        "frequency": beat.frequency,
        "amplitude_deg": math.degrees(beat.flap_amplitude),
        "from_vertical_deg": math.degrees(from_vertical),
        "retraction": beat.span_retraction,
    }


def flights() -> Iterator[dict]:
    """Yield all flights."""
    for live in (True, False):
        for speed in CRUISE:
            yield flown("cruise", speed, live=live)
            yield flown("cruise, spread", speed, held=0.0, live=live)
        yield flown("hover", 0.0, live=live)
        for held in HOVER:
            yield flown("hover", 0.0, held=held, live=live)
        for climb in CLIMBS:
            yield flown("climb", CLIMB_SPEED, climb, live=live)


class Statement(NamedTuple):
    """A statement of the abstracts, what we take it to mean, and its test, which returns words and a verdict."""

    words: str
    reading: str
    test: Callable[[pd.DataFrame], tuple[str, bool | None]]


def _rows(table: pd.DataFrame, flight: str) -> pd.DataFrame:
    found = table[(table["flight"] == flight) & table["power_per_mass"].notna()]
    return found if flight == "hover" else found[found["held"].isna() | (flight == "cruise, spread")]


def _ends(values: pd.Series, form: str) -> str:
    low, high = f"{values.min():{form}}", f"{values.max():{form}}"
    return low if low == high else f"{low} to {high}"


def _vertical(table: pd.DataFrame) -> tuple[str, bool | None]:
    rows = _rows(table, "cruise")
    angles = rows["from_vertical_deg"]
    near = angles.abs() <= NEAR_VERTICAL
    at = ", ".join(f"{speed:g}" for speed in rows["speed"][near])
    words = f"{_ends(angles, '.0f')} degrees; near-vertical at {at or 'no speed'}{' m/s' if at else ''}"
    return words, bool(near.all()) if len(angles) else None


def _flexed(table: pd.DataFrame) -> tuple[str, bool | None]:
    free, spread = _rows(table, "cruise"), _rows(table, "cruise, spread")
    both = free.merge(spread, on="speed", suffixes=("", "_spread"))
    saved = 1 - both["power_per_mass"] / both["power_per_mass_spread"]
    words = f"retracts {_ends(free['retraction'], '.2f')} of the span"
    words += f"; this saves {_ends(100 * saved, '.0f')} % of the power"
    return words, bool((free["retraction"] >= FLEXED).all()) if len(free) else None


def _gradual(table: pd.DataFrame) -> tuple[str, bool | None]:
    rows = _rows(table, "cruise").sort_values("speed")
    jumps = (rows["frequency"].pct_change().abs()).dropna()
    return f"at most {100 * jumps.max():.0f} %", bool((jumps <= GRADUAL).all()) if len(jumps) else None


def _hover(table: pd.DataFrame) -> dict[float, float]:
    rows = _rows(table, "hover")
    return {held: power for held, power in zip(rows["held"].fillna(-1.0), rows["power_per_mass"], strict=True)}


def _extended(table: pd.DataFrame) -> tuple[str, bool | None]:
    rows = _rows(table, "hover")
    free = rows[rows["held"].isna()]["retraction"]
    if not len(free):
        return "no flight found", None
    return f"retracts {free.iloc[0]:.2f}", bool(free.iloc[0] <= EXTENDED)


def _costly(table: pd.DataFrame) -> tuple[str, bool | None]:
    powers = _hover(table)
    if 0.0 not in powers or len(powers) < 2:
        return "no flight found", None
    more = {held: power / powers[0.0] - 1 for held, power in powers.items() if held > 0.0}
    words = ", ".join(f"{100 * cost:+.0f} % with {held:g} of the span retracted" for held, cost in more.items())
    low, high = FLEXING_COSTS
    return words, any(low <= cost <= high for cost in more.values())


def _steep(table: pd.DataFrame) -> tuple[str, bool | None]:
    rows = _rows(table, "climb").sort_values("climb")
    if len(rows) < 2:
        return "too few flights found", None
    cost = rows["power_per_mass"] / rows["climb"]
    slow, fast = (f"{cost.iloc[end]:.0f} J/kg per metre at {rows['climb'].iloc[end]:g} m/s" for end in (0, -1))
    words = f"{slow} of climb, {fast}"
    return words, bool((cost.diff().dropna() < 0).all())


STATEMENTS = (
    Statement(
        "The cheapest way to cruise has a near-vertical stroke plane (2015).",
        f"at most {NEAR_VERTICAL:g} degrees from vertical at every speed",
        _vertical,
    ),
    Statement(
        "The cheapest way to cruise has a flexed-wing upstroke (2015).",
        f"the wing retracts at least {FLEXED:g} of its span at every speed",
        _flexed,
    ),
    Statement(
        "Kinematics vary gradually with speed (2010).",
        f"the frequency changes by at most {100 * GRADUAL:.0f} % over 2 m/s",
        _gradual,
    ),
    Statement(
        "The cheapest hover has an extended-wing upstroke (2015).",
        f"the wing retracts at most {EXTENDED:g} of its span",
        _extended,
    ),
    Statement(
        "In hover, flexing the wings costs 20 % more power (2015).",
        f"{100 * FLEXING_COSTS[0]:.0f} to {100 * FLEXING_COSTS[1]:.0f} % more power at one at least of the two "
        "retractions that we flew",
        _costly,
    ),
    Statement(
        "The cheapest way to reach an altitude is to climb as steeply as possible (2015).",
        "at 8 m/s forward, power divided by the rate of climb falls if the rate of climb rises",
        _steep,
    ),
)


def _told(test: Callable[[pd.DataFrame], tuple[str, bool | None]], table: pd.DataFrame) -> str:
    words, holds = test(table)
    verdict = "cannot be tested" if holds is None else "**yes**" if holds else "**no**"
    return f"{verdict}: {words}"


def _sum(table: pd.DataFrame) -> str:
    verdicts = [one.test(table)[1] for one in STATEMENTS]
    told = [verdict for verdict in verdicts if verdict is not None]
    return f"{len(told)} statements can be tested and {sum(told)} hold"


def _powers(limited: pd.DataFrame, free: pd.DataFrame) -> Iterator[str]:
    def power(table: pd.DataFrame, row: pd.Series) -> str:
        same = (table["flight"] == row["flight"]) & (table["climb"] == row["climb"])
        held = table["held"].isna() if pd.isna(row["held"]) else table["held"] == row["held"]
        value = table[same & held]["power_per_mass"].iloc[0]
        return "none found" if pd.isna(value) else f"{value:.0f}"

    for _, row in limited[limited["flight"].isin(["hover", "climb"])].iterrows():
        held = "retraction free" if pd.isna(row["held"]) else f"{row['held']:g} of the span retracted"
        name = f"hover, {held}" if row["flight"] == "hover" else f"climb of {row['climb']:g} m/s at 8 m/s forward"
        yield f"| {name} | {power(limited, row)} | {power(free, row)} |"


@drawing()
def draw(limited: pd.DataFrame, free: pd.DataFrame, path: Path) -> None:
    """Draw the flights in cruise against speed, with what was measured on pigeons."""
    figure = new_figure(PAGE, 0.75 * PAGE)
    panels = figure.subplots(2, 2, sharex=True).ravel()
    measured = read_measured_flights("pigeon").measurements
    for axes, (column, (label, name)) in zip(panels, PANELS.items(), strict=True):
        for table, look, words in ((limited, FIRST, "frequency limited"), (free, SECOND, "frequency free")):
            rows = _rows(table, "cruise").sort_values("speed")
            axes.plot(rows["speed"], rows[column], marker="o", markersize=3, **look, label=words)
        for one in measured:
            if one.quantity == name and one.basis == "measured" and one.speeds is not None:
                (first, last), (low, high) = one.speeds, one.values
                wide = max(0.5 * (0.3 - (last - first)), 0.0)
                face = {"color": GREY, "alpha": 0.35, "linewidth": 0, "label": "measured on pigeons"}
                axes.fill_between([first - wide, last + wide], low, high, **face)
        dress(axes, "speed [m/s]", label)
        axes.tick_params(labelbottom=True)
        axes.set_ylim(0 if name else None)
    letter_panels(panels)
    legend_below(figure, panels)
    save_figure(figure, path)


def page(table: pd.DataFrame, figure: Path, highest: float) -> str:
    """Draw the figure, and return the page."""
    limited, free = (table[table["live"] == live] for live in (True, False))
    draw(limited, free, figure)
    statements = "\n".join(
        f"| {one.words} | {one.reading} | {_told(one.test, limited)} | {_told(one.test, free)} |"
        for one in STATEMENTS
    )
    spread = _rows(free, "hover")
    return filled(
        "parslew",
        limited=_sum(limited),
        free=_sum(free),
        most=table["retraction"].max(),
        hover=spread[spread["held"].isna()]["from_vertical_deg"].iloc[0],
        highest=highest,
        certified=int(table["power_per_mass"].notna().sum()),
        count=len(table),
        figure=figure.name,
        statements=statements,
        powers="\n".join(_powers(limited, free)),
    )


def main() -> None:
    """Fly all, keep the table, and write the page and its figure."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--page", action="store_true", help="write the page from the table, without flying")
    if not parser.parse_args().page:
        rows = []
        for row in flights():
            rows.append(row)
            print(row, flush=True)
        write_atomically(TABLE, pd.DataFrame(rows).to_csv(index=False, float_format="%.6g"))
    write_atomically(OUT, page(pd.read_csv(TABLE), FIGURE, HIGHEST))


if __name__ == "__main__":
    main()
