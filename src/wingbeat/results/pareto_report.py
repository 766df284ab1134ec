"""What a Pareto front says to a reader, as the blocks of a report."""

from __future__ import annotations

from typing import Any

from wingbeat._base import Line, Report, Row, Table, for_people
from wingbeat._base.datasets import climb_text
from wingbeat._base.style import in_words
from wingbeat.results.limits import called, set_by_limit


def pareto_report(record: dict[str, Any]) -> Report:
    """Return a row for each limit: what is reached, and what it costs.

    Parameters
    ----------
    record : of `ParetoFront.record`.
    """
    minimised, limited = (in_words(record[kind]) for kind in ("objective", "quantity"))
    where = f"{record['species']} at {record['speed']:g} m/s{climb_text(record['climb'])}"
    factor, unit = for_people(record["quantity_unit"])
    of_objective, objective_unit = for_people(record["objective_unit"])
    headings = (f"limit [{unit or '-'}]", "reached", f"{minimised} [{objective_unit or '-'}]", "rise [%]")
    rows = tuple(Row(_cells(record, point, factor, of_objective)) for point in record["points"])
    return [
        Line(f"{where}: least {minimised} for each limit of the {limited}", wraps=False),
        Table(rows, (*headings, "f [Hz]", "P+ [W]", ""), "rrrrrrl"),
    ]


def _cells(record: dict[str, Any], point: dict[str, Any], factor: float, of_objective: float) -> tuple[str, ...]:
    """Return the cells of a point; factors turn the limited and the minimised quantity into units of the reader."""
    shown = "none" if point["limit"] is None else f"{factor * point['limit']:.4g}"
    if point["objective_value"] is None:
        return (shown, *[""] * 5, f"{point['status']}: {point['message']}")
    beat = {name: point[name] for name in ("frequency", "flap_amplitude")}
    limited = set_by_limit(
        {"active_bounds": point["active_bounds"], "objective": record["objective"], "wingbeat": beat}
    )
    # The limit of the front has a column of its own.
    names = [called(name) for name in limited if name != record["quantity"]]
    remarks = ["dominated" if point["dominated"] else ("stable" if point["stable"] else "unstable")]
    remarks += [f"set by limits: {', '.join(names)}"] if names else []
    return (
        shown,
        f"{factor * point['quantity_value']:.4g}",
        f"{of_objective * point['objective_value']:.4g}",
        "" if point["rise"] is None else f"{100 * point['rise']:.2f}",
        f"{point['frequency']:.4g}",
        f"{point['mean_positive_power']:.4g}",
        "; ".join(remarks),
    )
