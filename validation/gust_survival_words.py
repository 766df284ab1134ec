"""The page and the figure of `gust_survival.py`, from its table."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import pandas as pd
from page_script import filled

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
