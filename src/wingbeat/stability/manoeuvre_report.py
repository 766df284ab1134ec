"""What a manoeuvre says to a reader, as the blocks of a report."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, cast

from wingbeat._base import Line, Report, Reported, Row, Table
from wingbeat.plots.draw_stability import manoeuvre_page

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from wingbeat.results.flight import Flight
    from wingbeat.stability.manoeuvre import Manoeuvre

_HEADINGS = ("to [m/s]", "beats", "f [Hz]", "least f [Hz]")


class ReportedManoeuvre(Reported):
    """The notebook manners of a manoeuvre."""

    def _report(self) -> Report:
        return manoeuvre_report(cast("Manoeuvre", self).record())

    def plot(self, flights: Mapping[str, Flight] | None = None) -> Figure:
        """Return a figure of the plan and of flights of it.

        Parameters
        ----------
        flights : of `fly`, by names, at most three. Default: the flight with feedback in still air.
        """
        plan = cast("Manoeuvre", self)
        return manoeuvre_page(plan, {"with feedback": plan.fly()} if flights is None else flights)


def manoeuvre_report(record: dict[str, Any]) -> Report:
    """Return how the search ended, the steady flights, and time and distance.

    Parameters
    ----------
    record : of `Manoeuvre.record`.
    """
    rows = tuple(Row(_cells(end)) for end in record["ends"])
    return [
        Line(f"{record['species']} from {record['speed']:g} m/s: {record['message']}", wraps=False),
        Table(rows, _HEADINGS, "rrrr"),
        *([Line(f"{record['time'][-1]:.2f} s, {record['distance']:.1f} m")] if len(record["time"]) > 1 else []),
    ]


def _cells(end: dict[str, Any]) -> tuple[str, ...]:
    free = end["free_frequency"]
    return f"{end['speed']:g}", f"{end['beats']}", f"{end['frequency']:.4g}", "" if free is None else f"{free:.4g}"
