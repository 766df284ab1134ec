"""A power curve on a terminal and as a figure: what `curve`, `show` and `plot` share."""

from __future__ import annotations

from typing import TYPE_CHECKING

from wingbeat.animal.vehicle import Air
from wingbeat.cli.printing import print_report
from wingbeat.cli.streams import plain_console
from wingbeat.plots.published import published_for
from wingbeat.records.inputs import vehicle_from
from wingbeat.words.curve_words import curve_report

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from wingbeat.results.curve import Curve


def drawn(curve: Curve) -> Figure:
    """Return the page of a curve, with published measurements of the animal, if there are any."""
    from wingbeat.plots import curve_page

    record, speed = curve.record(), curve.dataset["speed"].values
    vehicle = vehicle_from(record["vehicle"])
    beside = published_for(record["species"], vehicle, Air(**record["air"]), float(speed[0]), float(speed[-1]))
    return curve_page(curve.dataset, beside)


def print_curve(curve: Curve) -> None:
    """Print one line per speed, with changes of the best orbit between them, characteristic speeds and warnings."""
    print_report(curve_report(curve.record()), plain_console())
