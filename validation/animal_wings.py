"""Fit the coefficient model `feathered` to measured wings, and say how well it holds.

Run as ``python validation/animal_wings.py [--data FOLDER] [-o FOLDER]``; writes animal_wings.md and .png.
"""

from __future__ import annotations

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
from matplotlib.figure import Figure
from page_script import write_page

from wingbeat.aero import coefficients_of


def main(argv: list[str] | None = None) -> int:
    """Write the page and the figure; return the exit code."""
    return write_page("Coefficient models of the wings of animals.", "animal_wings", made, argv)


def made(data: Path) -> tuple[str, Figure]:
    """Return the page and the figure."""
    check(data)
    wings, glides = half_wings(data), jackdaw_glides(data)
    fits = [fit_half_wing(wing, wing.fast) for wing in wings]
    drawn = resampled(fits, glides)
    terms = intervals(fits, glides, drawn)
    jackdaw = jackdaw_glides_of(data, fits, float(glides.aspect_ratio.mean()))
    of_reynolds = reynolds_exponents(wings), lift_gained(wings)
    unseen = left_out(fits), left_out(fits, own=("drag_least",))
    text = page(fits, terms, len(glides.lift), *unseen, jackdaw, *of_reynolds)
    models = {name: coefficients_of(name) for name in LOOKS}
    return text, draw_wings(models, fits, glides, drawn)


if __name__ == "__main__":
    sys.exit(main())
