"""The command line of a study of measured wings: it reads CSV files, and writes one page with one figure."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from pathlib import Path

from matplotlib.figure import Figure

from wingbeat.errors import WingbeatError
from wingbeat.files import write_atomically
from wingbeat.plots import save_figure

ROOT = Path(__file__).resolve().parents[1]


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
