"""Text for the terminal: what moves the spectral radius of an orbit."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from wingbeat.orbits.problem.parameters import Parameter
from wingbeat.stability.causes import StabilitySensitivities

if TYPE_CHECKING:
    from rich.console import Console

_MOST = 10
_RADIUS = "spectral_radius"


def print_causes(found: StabilitySensitivities, console: Console) -> None:
    """Print the numbers that move the spectral radius most over their plausible ranges."""
    from rich.table import Table
    from rich.text import Text

    console.print(Text(f"what moves the spectral radius {found.spectral_radius:.3f} most", style="bold"))
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for label in ("  parameter", "value", "derivative", "plausible", "change at both ends"):
        table.add_column(label, no_wrap=True)
    slopes = found.sensitivities
    for slope in slopes.ranked(_RADIUS)[:_MOST]:
        parameter = slope.parameter
        factor, unit = _shown(parameter)
        ends = parameter.plausible
        plausible = "+-1 %" if ends is None else f"{factor * ends[0]:.3g} to {factor * ends[1]:.3g}{unit}"
        low, high = slopes.swing(slope, _RADIUS)
        per = f" per{unit}" if unit else ""
        table.add_row(
            Text(f"  {parameter.path}"),
            f"{factor * parameter.value:.4g}{unit}",
            f"{slope.quantities[_RADIUS] / factor:+.3g}{per}",
            plausible,
            f"{low + 0.0:+.2g}, {high + 0.0:+.2g}",
        )
    console.print(table)
    console.print(Text("  the changes are extrapolated linearly: for ranking only"))
    console.print(Text("  for the share of stable orbits run `wingbeat uncertainty`"))
    console.print()


def _shown(parameter: Parameter) -> tuple[float, str]:
    """Return the factor and the unit in which a parameter is printed: angles in degrees."""
    if parameter.unit == "rad":
        return math.degrees(1.0), " deg"
    return 1.0, "" if parameter.unit == "1" else f" {parameter.unit}"
