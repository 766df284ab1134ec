"""Write docs/evidence/neural_plate.md: thin plates by NeuralFoil against the paper's formulas."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from page_script import filled, write_page

from wingbeat._base.style import FIRST, PAGE, SECOND, THIRD, drawing, dress, legend_below, new_figure
from wingbeat.aero import SuFan
from wingbeat.aero.neural_sections import SectionPolar, section_polars
from wingbeat_evidence.markdown import markdown_table

ANGLES = (2, 5, 10, 20)
PLATES = (("plate0.04", 2e4), ("plate0.04", 5e4), ("plate0.105", 5e4))


def _cell(*numbers: float) -> str:
    return "/".join(f"{number:.2f}" for number in numbers)


def page(polars: list[SectionPolar]) -> str:
    """Return the text of the page."""
    paper, rows = SuFan(), []
    for angle in ANGLES:
        turn = np.radians(float(angle))
        cells = [f"{angle}", _cell(paper.lift(turn), paper.drag(turn), paper.moment(turn))]
        for one in polars:
            k = int(np.argmin(np.abs(one.alpha_deg - angle)))
            cells.append(_cell(one.lift[k], one.drag[k], one.moment[k], one.confidence[k]))
        rows.append(cells)
    head = ["deg", "paper", *(f"{name[5:]},{re / 1e3:g}k" for name, re in PLATES)]
    return filled("neural_plate", table=markdown_table(head, rows))


@drawing()
def figure(polars: list[SectionPolar]) -> Figure:
    """Return lift, drag and moment over the angle; rows that wingbeat leaves out are hollow."""
    paper, drawn = SuFan(), new_figure(PAGE, 70.0)
    fine = np.linspace(0, 30, 301)
    labels = ("lift coefficient $C_L$ [-]", "drag coefficient $C_D$ [-]", "moment $C_M$ about mid-chord [-]")
    panels = drawn.subplots(1, 3)
    for axes, label, curve, name in zip(
        panels, labels, (paper.lift, paper.drag, paper.moment), ("lift", "drag", "moment"), strict=True
    ):
        axes.plot(fine, curve(np.radians(fine)), color="k", label="Su et al., aspect ratio 6")
        for one, (plate, re), style in zip(polars, PLATES, (FIRST, SECOND, THIRD), strict=True):
            front = one.alpha_deg >= 0
            values = getattr(one, name)
            told = f"NeuralFoil, {float(plate[5:]):.1%} thick, Re {re:.0f}"
            axes.plot(one.alpha_deg[front], values[front], **style, linewidth=0.8, label=told)
            for used, face in ((one.kept, style["color"]), (~one.kept, "w")):
                where = front & used
                axes.plot(
                    one.alpha_deg[where], values[where], "o", ms=2.5, color=style["color"], markerfacecolor=face
                )
        dress(axes, r"angle of attack $\alpha$ [deg]", label)
    legend_below(drawn, list(panels), columns=2)
    return drawn


def _made(data: Path) -> tuple[str, Figure]:
    polars = [section_polars(name, [re])[1][0] for name, re in PLATES]
    return page(polars), figure(polars)


if __name__ == "__main__":
    sys.exit(write_page(__doc__ or "", "neural_plate", _made))
