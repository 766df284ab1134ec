"""Text for the terminal: what an orbit depends on, with error bars, ranked sensitivities and prices of bounds."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from wingbeat.orbits.many.uncertainty import ErrorBar
from wingbeat.orbits.sensitivity import Sensitivity
from wingbeat.results.sensitivities import Sensitivities

if TYPE_CHECKING:
    from rich.console import Console

_MOST = 15
_NAMED = 3


def print_influence(found: Sensitivities, bars: list[ErrorBar], console: Console) -> None:
    """Print what each quantity depends on most, the sensitivities, and the prices of the active bounds."""
    from rich.table import Table
    from rich.text import Text

    console.print()
    console.print(Text("sensitivities: a first-order ranking, not an error bar", style="bold"))
    for bar in bars:
        console.print(Text(f"  {ranked_in_words(bar)}"))
    console.print(Text("  for error bars run `wingbeat uncertainty`"))
    names = list(found.values)
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    table.add_column("  parameter", no_wrap=True)
    table.add_column("plausible", no_wrap=True)
    for name in names:
        table.add_column(f"{name.replace('_', ' ')} [{found.units[name]}]")
    for slope in found.ranked(names[0])[:_MOST]:
        parameter = slope.parameter
        plausible = "+-1 %" if parameter.plausible is None else "{:.3g} to {:.3g}".format(*parameter.plausible)
        swings = ["{:+.2g}, {:+.2g}".format(*found.swing(slope, name)) for name in names]
        table.add_row(Text(f"  {parameter.path}"), plausible, *swings)
    console.print()
    heading = "change at the low and high end of each range, extrapolated linearly: for ranking only"
    console.print(Text(heading, style="bold"))
    console.print(table)
    console.print()
    console.print(Text("prices of the active bounds", style="bold"))
    for price in found.prices:
        console.print(Text(f"  {price_in_words(price, found)}"))
    if not found.prices:
        console.print(Text("  none is active"))


def ranked_in_words(bar: ErrorBar) -> str:
    """Return what a quantity depends on most, without an error bar."""
    unit = "" if bar.unit == "1" else f" {bar.unit}"
    parts = ", ".join(f"{name} ({share:.0%})" for name, share in list(bar.ranking.items())[:_NAMED])
    due = f"largest shares of the variance: {parts}" if parts else "no plausible ranges are known"
    return f"{bar.quantity.replace('_', ' ')} {bar.value:.4g}{unit}; {due}"


def in_words(bar: ErrorBar) -> str:
    """Return an error bar as a line: value, standard deviation, and its main causes."""
    parts = ", ".join(f"{name} {deviation:.2g}" for name, deviation in list(bar.due_to.items())[:_NAMED])
    unit = "" if bar.unit == "1" else f" {bar.unit}"
    due = f"; largest contributions: {parts}" if parts else ": no plausible ranges are known"
    return f"{bar.quantity.replace('_', ' ')} {bar.value:.4g} +- {bar.deviation:.2g}{unit}{due}"


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
