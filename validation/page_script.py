"""Pages of evidence: their templates filled with numbers, their tables, and a command line that writes one page."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure

from wingbeat._base import WingbeatError, write_atomically
from wingbeat.plots import save_figure
from wingbeat_evidence.markdown import markdown_table

ROOT = Path(__file__).resolve().parents[1]


def filled(name: str, **values: object) -> str:
    """Return the page `name`: its template in the folder pages, with values for the names in braces."""
    return (Path(__file__).with_name("pages") / f"{name}.md").read_text(encoding="utf-8").format(**values)


def write_trials(
    name: str, speeds: Sequence[float], trials: Iterable[Any], cell: Callable[[Any, float], str]
) -> None:
    """Write the page `name` with a row for each trial, which has a name, and a column for each speed [m/s]."""
    rows = []
    for trial in trials:
        rows.append([trial.name, *(cell(trial, speed) for speed in speeds)])
        print(" | ".join(rows[-1]), flush=True)
    table = markdown_table(["change", *(f"{speed:g} m/s" for speed in speeds)], rows)
    write_atomically(ROOT / "docs" / "evidence" / f"{name}.md", filled(name, table=table))


def write_page(
    description: str, name: str, made: Callable[[Path], tuple[str, Figure]], argv: list[str] | None = None
) -> int:
    """Write what `made` makes of the folder of the CSV files, as `name`.md and `name`.png; return the exit code."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--data", type=Path, default=ROOT / "../shared/data", help="folder of the CSV files")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "docs" / "evidence", help="folder to write to")
    chosen = parser.parse_args(argv)
    try:
        text, figure = made(chosen.data)
        save_figure(figure, chosen.output / f"{name}.png")
        write_atomically(chosen.output / f"{name}.md", text)
    except WingbeatError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    print(f"wrote {name}.md and {name}.png to {chosen.output}", file=sys.stderr)
    return 0
