"""What wings that others measured say about using the paper's plate as a wing.

Run as ``python validation/measured_wings.py [--data FOLDER] [-o FOLDER]``; writes measured_wings.md and .png.
"""

from __future__ import annotations

import sys
from pathlib import Path

from matplotlib.figure import Figure
from measured_data import all_polars
from measured_figure import draw_polars
from measured_summary import judge, of_model, summary
from measured_words import page
from page_script import write_page

from wingbeat.aero import Dickinson, SuFan


def main(argv: list[str] | None = None) -> int:
    """Write the page and the figure; return the exit code."""
    return write_page("Measured wings against the paper's plate.", "measured_wings", made, argv)


def made(data: Path) -> tuple[str, Figure]:
    """Return the page and the figure."""
    polars = all_polars(data)
    models = [of_model(SuFan(), "Su-Fan (the paper)"), of_model(Dickinson(), "Dickinson 1999")]
    rows = [summary(polar) for polar in [*models, *polars]]
    verdicts = [verdict for polar in polars for verdict in judge(polar)]
    return page(rows, verdicts), draw_polars(models, polars, rows)


if __name__ == "__main__":
    sys.exit(main())
