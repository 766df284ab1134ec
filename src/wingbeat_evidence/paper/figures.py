"""Figures 1 to 8 of the paper redrawn from our model, as PNG and PDF files, with tables and captions."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Callable, Iterable
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

from wingbeat._base import FaultList, write_atomically
from wingbeat.plots import save_figure
from wingbeat_evidence.paper.figure_coefficients import coefficients_figure
from wingbeat_evidence.paper.figure_cycle import forces_figure, pitch_figure, power_figure
from wingbeat_evidence.paper.figure_frequency import frequency_figure
from wingbeat_evidence.paper.figure_orbit import phase_figure
from wingbeat_evidence.paper.figure_plate import plate_figure
from wingbeat_evidence.paper.figure_style import Drawn, Table
from wingbeat_evidence.paper.figure_vehicle import vehicle_figure
from wingbeat_evidence.paper.treatments import DEFAULT, TREATMENTS, Orbits

Drawing = Callable[[Orbits, str], Drawn]
FIGURES: dict[int, Drawing] = {
    1: lambda orbits, sample: plate_figure(),
    2: vehicle_figure,
    3: lambda orbits, sample: coefficients_figure(),
    4: phase_figure,
    5: lambda orbits, sample: frequency_figure(orbits),
    6: forces_figure,
    7: power_figure,
    8: pitch_figure,
}


def draw_figures(orbits: Orbits, numbers: Iterable[int], folder: str | Path, sample: str = DEFAULT) -> list[Path]:
    """Draw figures of the paper and write ``figureN.png``, ``.pdf``, ``.csv`` and ``.md`` for each.

    The page ``figureN.md`` shows the figure with its caption.

    Parameters
    ----------
    orbits : solved orbits by case; the figures say which are missing or not certified.
    numbers : which figures, from 1 to 8.
    folder : folder to write to; created if missing.
    sample : name of the treatment whose orbits at 10 m/s figures 2, 4 and 6 to 8 show.

    Returns
    -------
    The files written.

    Raises
    ------
    InvalidInputError : the figure or treatment does not exist.
    FileError : a file cannot be written.
    """
    numbers = list(numbers)
    faults = FaultList()
    for number in numbers:
        faults.choice("figure", str(number), tuple(map(str, FIGURES)))
    faults.choice("sample", sample, tuple(t.name for t in TREATMENTS))
    faults.raise_if_any()
    with suppress(OSError):  # the first file then says what is wrong with the folder
        Path(folder).mkdir(parents=True, exist_ok=True)
    written = []
    for number in numbers:
        drawn = FIGURES[number](orbits, sample)
        paths = [Path(folder) / f"figure{number}.{kind}" for kind in ("png", "pdf", "csv", "md")]
        for path in paths[:2]:
            save_figure(drawn.figure, path)
        write_atomically(paths[2], csv_text(drawn.table))
        title = f"Figure {number} of the paper, from our model"
        write_atomically(paths[3], f"# {title}\n\n![{title}]({paths[0].name})\n\n{drawn.caption}\n")
        written += paths
    return written


def csv_text(table: Table) -> str:
    """Return a table as CSV with one header line: the columns of all rows in order of first use.

    >>> print(csv_text([{"a": 1.0, "b": "x, y"}, {"a": float("nan"), "c": 1 / 3}]), end="")
    a,b,c
    1,"x, y",
    ,,0.333333333
    """
    columns = list(dict.fromkeys(name for row in table for name in row))
    text = io.StringIO()
    writer = csv.DictWriter(text, columns, restval="", lineterminator="\n")
    writer.writeheader()
    writer.writerows({name: _cell(value) for name, value in row.items()} for row in table)
    return text.getvalue()


def _cell(value: Any) -> Any:
    if isinstance(value, float | np.floating):
        return f"{value:.9g}" if math.isfinite(value) else ""
    return value
