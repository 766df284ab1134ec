"""A power curve on a terminal and as a figure: what `curve`, `show` and `plot` share."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from wingbeat.cli.streams import plain_console
from wingbeat.datasets import climb_text
from wingbeat.paper.measured_powers import published_for
from wingbeat.results.record import vehicle_from
from wingbeat.vehicle import Air

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from wingbeat.results.curve import Curve

_LABELS = {
    "minimum_power": "minimum power",
    "maximum_range": "greatest range",
    "fastest_sustained": "fastest within the power limit",
    "slowest_sustained": "slowest within the power limit",
}


def drawn(curve: Curve) -> Figure:
    """Return the page of a curve, with published measurements of the animal, if there are any."""
    from wingbeat.plots import curve_page

    record, speed = curve.record(), curve.dataset["speed"].values
    vehicle = vehicle_from(record["vehicle"])
    beside = published_for(record["species"], vehicle, Air(**record["air"]), float(speed[0]), float(speed[-1]))
    return curve_page(curve.dataset, beside)


def print_curve(curve: Curve) -> None:
    """Print one line per speed, with changes of the best orbit between them, characteristic speeds and warnings."""
    from rich.table import Table
    from rich.text import Text

    console = plain_console()
    record = curve.record()
    points = record["points"]
    climb = climb_text(record["climb"])
    certified = len(points) - len(record["gaps"])
    console.print(
        f"{record['species']}{climb}, minimum {record['objective'].replace('_', ' ')}: "
        f"{certified} of {len(points)} speeds certified"
    )
    table = Table(box=None, pad_edge=False, padding=(0, 2, 0, 0))
    for heading in ("U [m/s]", "f [Hz]", "P+ [W]", "CoT [-]", "flap [deg]", "optima"):
        table.add_column(Text(heading), justify="right")
    table.add_column(Text("at the bound of"))
    for point in points:
        table.add_row(*map(Text, _row(point)))
    console.print(table)
    console.print()
    console.print(Text("changes from one speed to the next", style="bold"))
    for mark in record["marks"]:
        where = f"{mark['lower_speed']:g} to {mark['upper_speed']:g} m/s"
        console.print(
            Text(f"  {mark['kind']}, {where}: {mark['what']}", style="" if mark["kind"] == "bounds" else "yellow")
        )
    if not record["marks"]:
        console.print("  one branch, always at the same bounds")
    console.print(Text(f"characteristic speeds, from the curve of {_power(record)}", style="bold"))
    for name, found in record["characteristic_speeds"].items():
        console.print(f"  {_LABELS[name]}: {_told(name, found)}")
    if record["warnings"]:
        console.print(Text("warnings", style="bold"))
    for warning in record["warnings"]:
        console.print(Text(f"- {warning}", style="yellow"))


def _power(record: dict[str, Any]) -> str:
    if record["power"] == "minimised quantity":
        return record["objective"].replace("_", " ")
    return record["power"]


def _row(point: dict[str, Any]) -> list[str]:
    if not point["optima"]:
        return [f"{point['speed']:g}", "", "", "", "", "0", f"{point['status']}: {point['message']}"]
    best = point["optima"][0]
    cost = best["cost_of_transport"]
    return [
        f"{point['speed']:g}",
        f"{best['frequency']:.4g}",
        f"{best['mean_positive_power']:.4g}",
        "-" if cost is None else f"{cost:.3g}",
        f"{math.degrees(best['flap_amplitude']):.3g}",
        f"{point['distinct_optima']}",
        best["active_bounds"] or "nothing",
    ]


def _told(name: str, found: dict[str, Any] | None) -> str:
    if found is None:
        return "none"
    text = f"{found['speed']:.3g} m/s, {found['power']:.4g} W"
    if "within_2_percent" in found:
        low, high = found["within_2_percent"]
        least = "power over speed" if name == "maximum_range" else "the power"
        text += f"; {least} is within 2 % of its minimum from {low:.3g} to {high:.3g} m/s"
    if found["at_edge"]:
        text += "; at the end of the range or beside a gap: the true speed may lie beyond"
    if found["jump_beside"]:
        text += "; the curve changes branch there"
    return text
