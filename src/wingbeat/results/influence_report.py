"""What an orbit depends on, as the blocks of a report: ranked sensitivities and prices of bounds."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from wingbeat._base import Line, Report, Row, Table, written
from wingbeat.orbits.many.uncertainty import ErrorBar
from wingbeat.orbits.sensitivity import Sensitivity

if TYPE_CHECKING:
    from wingbeat.results.sensitivities import Sensitivities

_MOST = 15
_NAMED = 3


def influence_report(found: Sensitivities, bars: Sequence[ErrorBar] | None = None) -> Report:
    """Return what each quantity depends on most, the sensitivities, and the prices of the active bounds.

    Parameters
    ----------
    found : from `sensitivities`.
    bars : the error bar of each quantity, if the uncertainty of a fit belongs to it.
    """
    names = list(found.values)
    if bars is None:
        bars = [found.error_bar(name) for name in names]
    headings = [f"{name.replace('_', ' ')} [{found.units[name]}]" for name in names]
    rows = tuple(Row(_cells(slope, found)) for slope in found.ranked(names[0])[:_MOST])
    prices = [f"  {price_in_words(price, found)}" for price in found.prices] or ["  none is active"]
    return [
        Line("sensitivities: a first-order ranking, not an error bar", tone="title"),
        *(Line(f"  {ranked_in_words(bar)}") for bar in bars),
        Line("  for error bars run `wingbeat uncertainty`"),
        Line(""),
        Line("change at the low and high end of each range, extrapolated linearly: for ranking only", tone="title"),
        Table(rows, ("parameter", "plausible", *headings), "n" + "r" * (1 + len(names))),
        Line(""),
        Line("prices of the active bounds", tone="title"),
        *(Line(price) for price in prices),
    ]


def _cells(slope: Sensitivity, found: Sensitivities) -> tuple[str, ...]:
    parameter = slope.parameter
    plausible = "+-1 %" if parameter.plausible is None else "{:.3g} to {:.3g}".format(*parameter.plausible)
    swings = ["{:+.2g}, {:+.2g}".format(*found.swing(slope, name)) for name in found.values]
    return parameter.path, plausible, *swings


def ranked_in_words(bar: ErrorBar) -> str:
    """Return what a quantity depends on most, without an error bar."""
    parts = ", ".join(f"{name} ({share:.0%})" for name, share in list(bar.ranking.items())[:_NAMED])
    due = f"largest shares of the variance: {parts}" if parts else _nothing_moves(bar)
    return f"{bar.quantity.replace('_', ' ')} {written(bar.value, unit=bar.unit)}; {due}"


def _nothing_moves(bar: ErrorBar) -> str:
    """Say why no spread moves a quantity."""
    if bar.set_by_limit:
        return "set by the limit, so it is no prediction and has no error bar"
    return "no plausible range moves it" if bar.due_to else "no plausible ranges are known"


def in_words(bar: ErrorBar) -> str:
    """Return an error bar as a line: value, standard deviation, and its main causes."""
    if not bar.ranking:
        return ranked_in_words(bar)
    parts = ", ".join(f"{name} {deviation:.2g}" for name, deviation in list(bar.due_to.items())[:_NAMED])
    shown = written(bar.value, bar.deviation, bar.unit)
    return f"{bar.quantity.replace('_', ' ')} {shown}; largest contributions: {parts}"


def price_in_words(price: Sensitivity, found: Sensitivities) -> str:
    """Return the effect of one more unit of a bound: ``1 deg more of bounds.flap_amplitude.upper: -0.1 Hz``."""
    parameter = price.parameter
    per, unit = (math.radians(1.0), "deg") if parameter.unit == "rad" else (0.01 * parameter.size, parameter.unit)
    amount = 1.0 if unit == "deg" else per
    changes = [
        f"{price.quantities[name] * per:+.3g} {found.units[name]} of {name.replace('_', ' ')}"
        for name in found.values
    ]
    return f"{amount:.3g} {unit} more of {parameter.path}: {', '.join(changes)}"
