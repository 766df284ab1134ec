"""Fit the coefficient model `feathered` to measured wings, and say how well it holds.

Run as ``python validation/animal_wings.py [--data FOLDER] [-o FOLDER]``; writes animal_wings.md and .png.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from animal_wings_data import check, half_wings, jackdaw_glides
from animal_wings_figure import LOOKS, draw_wings
from animal_wings_fit import fit_half_wing, intervals, resampled
from animal_wings_glides import (
    jackdaw_glides_of,
    left_out,
    lift_gained,
    reynolds_exponents,
)
from animal_wings_words import page

from wingbeat.aero import coefficients_of
from wingbeat.errors import WingbeatError
from wingbeat.files import write_atomically
from wingbeat.plots import save_figure

ROOT = Path(__file__).resolve().parents[1]


def main(argv: list[str] | None = None) -> int:
    """Write the page and the figure; return the exit code."""
    parser = argparse.ArgumentParser(description="Coefficient models of the wings of animals.")
    parser.add_argument("--data", type=Path, default=ROOT / "../shared/data", help="folder of the CSV files")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "docs", help="folder to write to")
    chosen = parser.parse_args(argv)
    try:
        check(chosen.data)
        wings, glides = half_wings(chosen.data), jackdaw_glides(chosen.data)
        fits = [fit_half_wing(wing, wing.fast) for wing in wings]
        drawn = resampled(fits, glides)
        terms = intervals(fits, glides, drawn)
        jackdaw = jackdaw_glides_of(chosen.data, fits, float(glides.aspect_ratio.mean()))
        of_reynolds = reynolds_exponents(wings), lift_gained(wings)
        unseen = left_out(fits), left_out(fits, own=("drag_least",))
        text = page(fits, terms, len(glides.lift), *unseen, jackdaw, *of_reynolds)
        models = {name: coefficients_of(name) for name in LOOKS}
        save_figure(draw_wings(models, fits, glides, drawn), chosen.output / "animal_wings.png")
        write_atomically(chosen.output / "animal_wings.md", text)
    except WingbeatError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    print(f"wrote animal_wings.md and animal_wings.png to {chosen.output}", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
