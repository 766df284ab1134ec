"""The page of the wings of animals: what was fitted to what, how well it holds, and what is a guess."""

from __future__ import annotations

import textwrap

import animal_wings_text as text
import numpy as np
from animal_wings_fit import ASPECT_RATIO, LIVE, HalfWingFit, Interval
from animal_wings_glides import (
    ROSEN_RATIO,
    ROSEN_RATIO_SPEED,
    ROSEN_SINK,
    ROSEN_SINK_SPEED,
    JackdawGlides,
    LeftOut,
)
from measured_data import Array

import wingbeat as wb

# The goal of a fitted wing: ratio and sink of wings that the fit did not see within this share.
GOAL = 0.15


def filled(sentences: str, **numbers: object) -> str:
    """Return a paragraph with its numbers, in lines of the width of the pages; a list item is indented."""
    one = " ".join(sentences.split()).format(**numbers)
    indent = "  " if one.startswith("- ") else ""
    return textwrap.fill(one, 115, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False)


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
    parts = [
        "# Wings of animals",
        filled(text.INTRODUCTION),
        "\n".join(filled(source, frames=frames) for source in text.SOURCES),
        text.COMMANDS,
        "![lift, drag, polar and the whole turn](animal_wings.png)",
        filled(text.FIGURE, ratio=ASPECT_RATIO),
        *_form(fits, terms),
        parameters(terms),
        "## How well the form follows each wing",
        wings(fits),
        "## Glides of wings that the fit did not see",
        *gulls(out, own_drag),
        *_jackdaw(jackdaw),
        "## Reynolds number",
        *_reynolds(exponents, gained),
        "## Sources of the models, and which numbers are guesses",
        "\n".join(filled(guess) for guess in text.GUESSES),
        estimates(),
    ]
    return "\n\n".join(parts) + "\n"


def _form(fits: list[HalfWingFit], terms: dict[str, Interval]) -> list[str]:
    least = [fit.terms["drag_least"] for fit in fits]
    live = terms["drag_least"].value
    return [
        text.FORM,
        filled(text.SIDES, highest=terms["lift_highest"].value, lowest=terms["lift_lowest"].value),
        filled(text.METHOD, ratio=ASPECT_RATIO, lowest=min(least), highest=max(least), live=live),
    ]


def parameters(terms: dict[str, Interval]) -> str:
    """Return the table of the fitted terms of `feathered`."""
    lines = [
        "| term of `feathered` | value | 95 % interval | range of the nine wings |",
        "|---|---|---|---|",
    ]
    for name, term in terms.items():
        spread = "one bird" if term.spread is None else f"{term.spread[0]:.3g} to {term.spread[1]:.3g}"
        lines.append(f"| {name} | {term.value:.3g} | {term.low:.3g} to {term.high:.3g} | {spread} |")
    live = " and ".join(f"`{name}`" for name in LIVE)
    return "\n".join([*lines, "", filled(text.INTERVALS, live=live)])


def wings(fits: list[HalfWingFit]) -> str:
    """Return the table of the fits to single wings."""
    lines = [
        "| wing | aspect ratio | R-squared of C_L | R-squared of profile C_D | not determined |",
        "|---|---|---|---|---|",
    ]
    for fit in fits:
        loose = "; ".join(note.partition(": ")[2].partition(";")[0] for note in fit.lift.notes + fit.profile.notes)
        values = f"{fit.lift.r_squared:.4f} | {fit.profile.r_squared:.4f} | {loose or '-'}"
        lines.append(f"| {fit.wing.name} | {fit.wing.aspect_ratio:.1f} | {values} |")
    return "\n".join(lines)


def gulls(out: list[LeftOut], own_drag: list[LeftOut]) -> list[str]:
    """Return the table of the wings that were left out, whether the goal holds, and what their own drag changes."""
    lines = [
        "| wing left out | best ratio, measured | predicted | error | sink, measured | predicted | error |",
        "|---|---|---|---|---|---|---|",
    ]
    for one in out:
        ratio, sink = one.errors
        lines.append(
            f"| {one.wing.name} | {one.measured.ratio:.2f} | {one.predicted.ratio:.2f} | {ratio:+.0%} "
            f"| {one.measured.sink:.3f} | {one.predicted.sink:.3f} | {sink:+.0%} |"
        )
    held, rms = _errors(out)
    spread = np.std([one.measured.ratio for one in out], ddof=1) / np.mean([one.measured.ratio for one in out])
    counts = {"ratios": held[0], "sinks": held[1], "wings": len(out)}
    verdict = filled(
        text.LEFT_OUT_VERDICT, goal=GOAL, **counts, of_ratio=rms[0], of_sink=rms[1], spread=float(spread)
    )
    known, known_rms = _errors(own_drag)
    reason = filled(
        text.OWN_DRAG, ratios=known[0], sinks=known[1], wings=len(out), of_ratio=known_rms[0], of_sink=known_rms[1]
    )
    return [filled(text.LEFT_OUT), "\n".join(lines), verdict, reason]


def _errors(out: list[LeftOut]) -> tuple[Array, Array]:
    """Return how many wings meet the goal, and the root-mean-square errors, of ratio and sink."""
    errors = np.array([one.errors for one in out])
    return (np.abs(errors) <= GOAL).sum(axis=0), np.sqrt((errors**2).mean(axis=0))


def _jackdaw(jackdaw: JackdawGlides) -> list[str]:
    lines = [
        "| | best glide ratio | at speed [m/s] | least sink [m/s] | at speed [m/s] |",
        "|---|---|---|---|---|",
        f"| measured, first study | {ROSEN_RATIO} | {ROSEN_RATIO_SPEED} | {ROSEN_SINK} | {ROSEN_SINK_SPEED} |",
        jackdaw_row("`feathered`", jackdaw.feathered),
        jackdaw_row("`su-fan`", jackdaw.plate),
        jackdaw.measured_row,
        jackdaw_row("`feathered`, with the drag area of the second study", jackdaw.spread_tail),
    ]
    ratio, sink = jackdaw_errors(jackdaw.feathered)
    holds = "holds" if max(abs(ratio), abs(sink)) <= GOAL else "does not hold"
    verdict = filled(
        text.JACKDAW_VERDICT, ratio=ratio, sink=sink, goal=GOAL, holds=holds, printed=jackdaw.printed.ratio
    )
    areas = {"wide": jackdaw.wide_area, "folded": jackdaw.feathered.species.vehicle.body.drag_area}
    return [filled(text.JACKDAW, **areas), "\n".join(lines), verdict]


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


def _reynolds(exponents: Array, gained: Array) -> list[str]:
    error, of_lift = (float(values.std(ddof=1) / np.sqrt(len(values))) for values in (exponents, gained))
    ends = {"low": exponents.min(), "high": exponents.max()}
    return [
        filled(text.REYNOLDS, mean=exponents.mean(), error=error, **ends),
        filled(text.STALL, mean=gained.mean(), error=of_lift, stalled=int((gained > 0.05).sum())),
    ]


def estimates() -> str:
    """Return the table of all numbers of the models that differ from `feathered`, and what they rest on."""
    lines = ["| model | term | value | interval | source |", "|---|---|---|---|---|"]
    feathered = wb.aero.WING_ESTIMATES["feathered"]
    for model, terms in wb.aero.WING_ESTIMATES.items():
        for term, (value, low, high, basis) in terms.items():
            if model == "feathered" or basis != feathered[term].basis:
                lines.append(f"| {model} | {term} | {value:g} | {low:g} to {high:g} | {basis} |")
    others = [
        f"| {model} | all others | | | as feathered |" for model in ("feathered-revolving", "feathered-flapping")
    ]
    return "\n".join([*lines, *others])
