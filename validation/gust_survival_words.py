"""The page and the figure of `gust_survival.py`, from its table."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pandas as pd

from wingbeat.plots import save_figure
from wingbeat.style import (
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
COLUMNS = (
    "model",
    "orbit",
    "beat [Hz]",
    "control",
    "spectral radius",
    "gusts survived",
    "light turbulence",
    "moderate turbulence",
)
TEXT = """# Which gusts are survived?

`python validation/gust_survival.py` writes this page. It flies a pigeon at 12 m/s and a bat at 8 m/s, by the models
[`paper` and `animal`](../guide/models.md), through random gusts and through turbulence. They fly without
feedback, and with that of the page on [control](../guide/control.md).{missing}

- **Gusts.** {gusts} gusts for each line of the table, the same for all controls of an orbit. Their size is uniform
  up to 5 m/s, their direction uniform, their duration 1 to 8 beats. A flight lasts 30 beats.
  So an orbit that beats slowly meets longer gusts.
- **Turbulence.** {seeds} seeds of each level, 30 s each, with Dryden's spectra 30 m above the ground. The upward
  component has a root mean square of {light:.2f} m/s (light) and {moderate:.2f} m/s (moderate). It blows with
  full strength from the start.
- **Control.** *Feedback* changes the wingbeat for the next beat. If it is *one beat late*, it changes the beat
  after that, with gains that allow for the delay. *Feedback {segments} times a beat* raises flap and pitch by a
  bump in each quarter of the stroke (`feedback_in_beat`). All measure without noise.
- **Survived.** The body pitch stays within 60 degrees of the orbit's, and the vehicle does not sink 5 m below the
  orbit's path.

![Share of gusts survived against their size, for two animals by two models]({figure})

*Share of the gusts survived against their largest velocity, in bins of {bin:g} m/s:
{panels}.*

{table}

{findings}

All flights take fixed steps of a 64th of a beat or less, with `simulate_many`. `data/gust_survival.csv` has the
shares in bins of the size and of the direction of the gusts. A share near one half has a standard error of
{gust_error:.1f} percent in {gusts} gusts, and of {seed_error:.0f} percent in {seeds} seeds.
"""

FINDINGS = """- Without feedback, no orbit survives more than {open} of the gusts, or {open_light} of the light
  turbulence.
- One beat of delay takes the paper's bat from {bat} of the gusts to {bat_late}. The paper's pigeon hardly notices
  it in single gusts, but in light turbulence it falls from {pigeon_light} to {pigeon_late_light}.
- With feedback in each quarter of the stroke, the paper's bat survives {bat_within} of the gusts and
  {bat_within_light} of the light turbulence. In moderate turbulence, this feedback saves {worst} to {best},
  depending on the orbit.
"""


def page(table: pd.DataFrame, figure: Path) -> str:
    """Draw the figure, and return the page."""
    draw(table, figure)
    sizes = table[table["by"] == "size"]
    seeds = int(table.loc[table["by"] == "light turbulence", "flown"].iloc[0])
    gusts = int(sizes.groupby(["model", "animal", "control"])["flown"].sum().iloc[0])
    light, moderate = (table.loc[table["by"] == f"{one} turbulence", "from"].iloc[0] for one in LEVELS)
    return TEXT.format(
        gusts=gusts,
        seeds=seeds,
        light=light,
        moderate=moderate,
        segments=SEGMENTS,
        figure=figure.name,
        missing="".join(
            f" The {animal} by the model `{model}` is not flown yet."
            for model, animal, _ in FLIGHTS
            if (model, animal) not in _orbits(table)
        ),
        panels=", ".join(
            f"({letter}) {animal} by the model `{model}`"
            for letter, (model, animal) in zip("abcd", _orbits(table), strict=False)
        ),
        bin=float((sizes["to"] - sizes["from"]).iloc[0]),
        table="\n".join(_rows(table)),
        findings=findings(table).rstrip(),
        gust_error=100.0 * 0.5 / gusts**0.5,
        seed_error=100.0 * 0.5 / seeds**0.5,
    )


def share(table: pd.DataFrame, model: str, animal: str, control: str, by: str) -> float:
    """Return the share survived [percent] of an orbit with a control, over all bins of `by`."""
    chosen = (table["model"] == model) & (table["animal"] == animal)
    rows = table[chosen & (table["control"] == control) & (table["by"] == by)]
    return 100.0 * float(rows["survived"].sum() / rows["flown"].sum())


def _orbits(table: pd.DataFrame) -> list[tuple[str, str]]:
    return list(table[["model", "animal"]].drop_duplicates().itertuples(index=False, name=None))


def _rows(table: pd.DataFrame) -> Iterator[str]:
    yield f"| {' | '.join(COLUMNS)} |"
    yield "|---" * len(COLUMNS) + "|"
    for keys, rows in table.groupby(["model", "animal", "control"], sort=False):
        first = rows.iloc[0]
        kinds = ("size", *(f"{one} turbulence" for one in LEVELS))
        shares = " | ".join(f"{share(table, *keys, kind):.3g} %" for kind in kinds)
        yield (
            f"| {keys[0]} | {keys[1]}, {first['speed']:g} m/s | {first['frequency']:.2f} | {keys[2]} "
            f"| {first['spectral_radius']:.3f} | {shares} |"
        )


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


def findings(table: pd.DataFrame) -> str:
    """Return what the table says, in sentences."""
    light, moderate = (f"{one} turbulence" for one in LEVELS)
    orbits = _orbits(table)

    def shown(model: str, animal: str, control: str, by: str = "size") -> str:
        return f"{share(table, model, animal, control, by):.3g} %"

    most = {
        "open": max(share(table, *one, OPEN, "size") for one in orbits),
        "open_light": max(share(table, *one, OPEN, light) for one in orbits),
    }
    return FINDINGS.format(
        **{name: f"{value:.3g} %" for name, value in most.items()},
        bat=shown("paper", "bat", AT_ONCE),
        bat_late=shown("paper", "bat", LATE),
        pigeon_light=shown("paper", "pigeon", AT_ONCE, light),
        pigeon_late_light=shown("paper", "pigeon", LATE, light),
        bat_within=shown("paper", "bat", WITHIN),
        bat_within_light=shown("paper", "bat", WITHIN, light),
        worst=f"{min(share(table, *one, WITHIN, moderate) for one in orbits):.3g} %",
        best=f"{max(share(table, *one, WITHIN, moderate) for one in orbits):.3g} %",
    )
