"""The comparison as a figure: a dot for each case on a logarithmic time scale, cold starts beside."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from wingbeat._base.style import BLUE, GREEN, PAGE, PURPLE, VERMILION, drawing, letter_panels, new_figure
from wingbeat.plots import save_figure

KINDS = {
    "warm": (BLUE, "o", "warm, one case each"),
    "cold": (VERMILION, "D", "cold, nothing on disk"),
    "again": (GREEN, "s", "new process, caches kept"),
}


@drawing()
def draw(results: dict[str, dict], path: Path) -> None:
    """Write the figure: seconds with their medians on the left, closure when re-flown on the right."""
    names = list(results)[::-1]
    figure = new_figure(PAGE, 41.0 + 9.0 * len(names))
    left, right = figure.subplots(1, 2, sharey=True, width_ratios=(3, 2))
    for row, name in enumerate(names):
        solved = [entry for entry in results[name]["cases"] if entry["first"]["success"]]
        seconds = {kind: results[name][kind] for kind in ("cold", "again")}
        seconds["warm"] = [float(np.median(entry["seconds"])) for entry in solved]
        for kind, (colour, marker, label) in KINDS.items():
            shift = row + {"warm": 0.0, "cold": 0.25, "again": -0.25}[kind]
            style = {"color": colour, "marker": marker, "s": 14, "alpha": 0.7, "linewidths": 0}
            left.scatter(seconds[kind], [shift] * len(seconds[kind]), label=label if row == 0 else None, **style)
        if solved:
            left.plot([np.median(seconds["warm"])] * 2, [row - 0.2, row + 0.2], color="k", lw=1.5)
            misses = [max(entry["first"]["miss"], 1e-12) for entry in solved]
            right.scatter(misses, [row] * len(misses), color=PURPLE, s=14, alpha=0.7, linewidths=0)
    left.set(xscale="log", xlabel="time to an optimum [s]", yticks=range(len(names)), yticklabels=names)
    right.set(xscale="log", xlabel="largest closure miss, re-flown\n[m, rad, m/s, rad/s]")
    right.axvline(1e-6, color="k", lw=0.8, ls=":")
    for axes in (left, right):
        axes.grid(axis="x")
    letter_panels((left, right))
    figure.legend(loc="outside lower center", ncols=3)
    save_figure(figure, path)
