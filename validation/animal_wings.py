"""Fit the coefficient model `feathered` to measured wings, and say how well it holds.

Run as ``python validation/animal_wings.py [--data FOLDER] [-o FOLDER]``; writes animal_wings.md and .png.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from animal_wings_data import check, half_wings, jackdaw_glides
from animal_wings_figure import LOOKS, draw_wings
from animal_wings_fit import ASPECT_RATIO, HalfWingFit, Interval, fit_half_wing, intervals, resampled
from animal_wings_glides import (
    ROSEN_RATIO,
    ROSEN_RATIO_SPEED,
    ROSEN_SINK,
    ROSEN_SINK_SPEED,
    JackdawGlides,
    LeftOut,
    jackdaw_glides_of,
    left_out,
    lift_gained,
    reynolds_exponents,
)
from matplotlib.figure import Figure
from measured_data import Array
from page_script import filled, write_page

import wingbeat as wb
from wingbeat.aero import coefficients_of
from wingbeat_evidence.markdown import markdown_table

# The goal of a fitted wing: ratio and sink of wings that the fit did not see within this share.
GOAL = 0.15


def page(
    fits: list[HalfWingFit],
    terms: dict[str, Interval],
    frames: int,
    out: list[LeftOut],
    own_drag: list[LeftOut],
    jackdaw: JackdawGlides,
    exponents: Array,
    gained: Array,
) -> str:
    """Return the page."""
    least = [fit.terms["drag_least"] for fit in fits]
    measured = [one.measured.ratio for one in out]
    (held, rms), (known, known_rms) = _errors(out), _errors(own_drag)
    ratio, sink = jackdaw_errors(jackdaw.feathered)
    error, of_lift = (float(values.std(ddof=1) / np.sqrt(len(values))) for values in (exponents, gained))
    return filled(
        "animal_wings",
        frames=frames,
        ratio=ASPECT_RATIO,
        lowest=min(least),
        highest=max(least),
        parameters=parameters(terms),
        gulls=gulls(fits, out),
        goal=GOAL,
        wings=len(out),
        ratios=held[0],
        sinks=held[1],
        of_ratio=rms[0],
        of_sink=rms[1],
        spread=float(np.std(measured, ddof=1) / np.mean(measured)),
        own_ratios=known[0],
        own_sinks=known[1],
        own_of_ratio=known_rms[0],
        own_of_sink=known_rms[1],
        wide=jackdaw.wide_area,
        folded=jackdaw.feathered.species.vehicle.body.drag_area,
        jackdaw=_jackdaw(jackdaw),
        jackdaw_ratio=ratio,
        jackdaw_sink=sink,
        holds="holds" if max(abs(ratio), abs(sink)) <= GOAL else "does not hold",
        printed=jackdaw.printed.ratio,
        mean=exponents.mean(),
        error=error,
        low=exponents.min(),
        high=exponents.max(),
        gained=gained.mean(),
        of_lift=of_lift,
        stalled=int((gained > 0.05).sum()),
        estimates=estimates(),
    )


def parameters(terms: dict[str, Interval]) -> str:
    """Return the table of the fitted terms of `feathered`."""
    rows = []
    for name, term in terms.items():
        spread = "one bird" if term.spread is None else f"{term.spread[0]:.3g} to {term.spread[1]:.3g}"
        rows.append([name, f"{term.value:.3g}", f"{term.low:.3g} to {term.high:.3g}", spread])
    return markdown_table(["term of `feathered`", "value", "95 % interval", "range of the nine wings"], rows)


def gulls(fits: list[HalfWingFit], out: list[LeftOut]) -> str:
    """Return the table of the wings: how well the form follows each, and its glide, measured and predicted."""
    rows = []
    for fit, one in zip(fits, out, strict=True):
        assert fit.wing.name == one.wing.name
        (ratio, sink), (measured, found) = one.errors, (one.measured, one.predicted)
        followed = [f"{fit.lift.r_squared:.4f}", f"{fit.profile.r_squared:.4f}"]
        glides = [
            f"{measured.ratio:.2f}, {found.ratio:.2f} ({ratio:+.0%})",
            f"{measured.sink:.3f}, {found.sink:.3f} ({sink:+.0%})",
        ]
        rows.append([one.wing.name, f"{fit.wing.aspect_ratio:.1f}", *followed, *glides])
    heads = ["wing", "aspect ratio", "R-squared of C_L", "of profile C_D"]
    return markdown_table([*heads, "ratio: measured, predicted", "sink: measured, predicted"], rows)


def _errors(out: list[LeftOut]) -> tuple[Array, Array]:
    """Return how many wings meet the goal, and the root-mean-square errors, of ratio and sink."""
    errors = np.array([one.errors for one in out])
    return (np.abs(errors) <= GOAL).sum(axis=0), np.sqrt((errors**2).mean(axis=0))


def _jackdaw(jackdaw: JackdawGlides) -> str:
    heads = ["", "best glide ratio", "at speed [m/s]", "least sink [m/s]", "at speed [m/s]"]
    first = (ROSEN_RATIO, ROSEN_RATIO_SPEED, ROSEN_SINK, ROSEN_SINK_SPEED)
    return "\n".join(
        [
            markdown_table(heads, [["measured, first study", *map(str, first)]]),
            jackdaw_row("`feathered`", jackdaw.feathered),
            jackdaw_row("`su-fan`", jackdaw.plate),
            jackdaw.measured_row,
            jackdaw_row("`feathered`, with the drag area of the second study", jackdaw.spread_tail),
        ]
    )


def jackdaw_errors(polar: wb.GlidePolar) -> tuple[float, float]:
    """Return the relative errors of best ratio and least sink against Rosen and Hedenstrom 2001."""
    assert polar.best_ratio is not None
    assert polar.least_sink is not None
    return polar.best_ratio.glide_ratio / ROSEN_RATIO - 1.0, polar.least_sink.sink / ROSEN_SINK - 1.0


def jackdaw_row(label: str, polar: wb.GlidePolar) -> str:
    """Return one row of the table of the jackdaw's glides."""
    assert polar.best_ratio is not None
    assert polar.least_sink is not None
    best, slow = polar.best_ratio, polar.least_sink
    return f"| {label} | {best.glide_ratio:.1f} | {best.speed:.1f} | {slow.sink:.2f} | {slow.speed:.1f} |"


def estimates() -> str:
    """Return the table of the terms of the other models that are not as in `feathered`, and what they rest on."""
    feathered, rows = wb.aero.WING_ESTIMATES["feathered"], []
    for model, terms in wb.aero.WING_ESTIMATES.items():
        for term, (value, low, high, basis) in terms.items():
            if model != "feathered" and basis != feathered[term].basis and basis != "guess: as feathered":
                rows.append([model, term, f"{value:g}", f"{low:g} to {high:g}", basis])
    return markdown_table(["model", "term", "value", "interval", "source"], rows)


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
