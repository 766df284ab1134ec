"""What moves the spectral radius of an orbit, as the blocks of a report."""

from __future__ import annotations

import math
from typing import Any

from wingbeat._base import Line, Report, Row, Table

_MOST = 10
_HEADINGS = ("parameter", "value", "derivative", "plausible", "change at both ends")


def causes_report(record: dict[str, Any]) -> Report:
    """Return the numbers that move the spectral radius most over their plausible ranges.

    Parameters
    ----------
    record : of `StabilitySensitivities.record`.
    """
    rows = tuple(Row(_cells(parameter)) for parameter in record["parameters"][:_MOST])
    return [
        Line(f"what moves the spectral radius {record['spectral_radius']:.3f} most", tone="title"),
        Table(rows, _HEADINGS, "nrrrr"),
        Line("the changes are extrapolated linearly: for ranking only"),
        Line("for the share of stable orbits run `wingbeat uncertainty`"),
    ]


def _cells(parameter: dict[str, Any]) -> tuple[str, ...]:
    factor, unit = _shown(parameter["unit"])
    ends = parameter["plausible"]
    low, high = parameter["change_to_ends"]
    per = f" per{unit}" if unit else ""
    return (
        parameter["parameter"],
        f"{factor * parameter['value']:.4g}{unit}",
        f"{parameter['spectral_radius'] / factor:+.3g}{per}",
        "+-1 %" if ends is None else f"{factor * ends[0]:.3g} to {factor * ends[1]:.3g}{unit}",
        f"{low + 0.0:+.2g}, {high + 0.0:+.2g}",
    )


def _shown(unit: str) -> tuple[float, str]:
    """Return the factor and the unit in which a parameter is shown: angles in degrees."""
    if unit == "rad":
        return math.degrees(1.0), " deg"
    return 1.0, "" if unit == "1" else f" {unit}"
