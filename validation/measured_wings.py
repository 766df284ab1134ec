"""What wings that others measured say about using the paper's plate as a wing.

Run as ``python validation/measured_wings.py [--data FOLDER] [-o FOLDER]``; writes measured_wings.md and .png.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from measured_data import all_polars
from measured_figure import draw_polars
from measured_summary import judge, of_model, summary
from measured_words import page

from wingbeat.aero import Dickinson, SuFan
from wingbeat.errors import WingbeatError
from wingbeat.files import write_atomically
from wingbeat.plots import save_figure

ROOT = Path(__file__).resolve().parents[1]


def main(argv: list[str] | None = None) -> int:
    """Write the table and the figure; return the exit code."""
    parser = argparse.ArgumentParser(description="Measured wings against the paper's plate.")
    parser.add_argument("--data", type=Path, default=ROOT / "../shared/data", help="folder of the CSV files")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "docs", help="folder to write to")
    chosen = parser.parse_args(argv)
    try:
        polars = all_polars(chosen.data)
        models = [of_model(SuFan(), "Su-Fan (the paper)"), of_model(Dickinson(), "Dickinson 1999")]
        rows = [summary(polar) for polar in [*models, *polars]]
        verdicts = [verdict for polar in polars for verdict in judge(polar)]
        save_figure(draw_polars(models, polars, rows), chosen.output / "measured_wings.png")
        write_atomically(chosen.output / "measured_wings.md", page(rows, verdicts))
    except WingbeatError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    print(f"wrote measured_wings.md and measured_wings.png to {chosen.output}", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
