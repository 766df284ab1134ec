"""How predicted flights compare with measured ones, as the blocks of a report."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING

from wingbeat._base import Line, Report, Row, Table, in_words
from wingbeat_evidence.whole_flights.comparison import compared, ends_of, name_of, words_of

if TYPE_CHECKING:
    from wingbeat_evidence.whole_flights.prediction import Prediction

_HEADINGS = ("quantity", "basis", "measured", "predicted", "agrees")
_ACROSS = 16  # letters of a column's heading


def prediction_report(found: Prediction) -> Report:
    """Return the quantities at each speed, and each measurement beside its prediction.

    Parameters
    ----------
    found : from `predict_flights`.
    """
    names = list(next((one.values for one in found.flown if one.values), {}))
    flown = []
    for one in found.flown:
        cells = [f"{one.values[name]:.3g}" for name in names] if one.values else [one.status]
        flown.append(Row((f"{one.speed:g}", *cells, *[""] * (len(names) - len(cells)))))
    heads = ["\n".join(textwrap.wrap(name_of(name), _ACROSS)) for name in names] or ["status"]
    rows = []
    for score in compared(found):
        told = score.measurement
        ends = ends_of(told.values), ends_of(score.predicted)
        rows.append(Row((name_of(told.quantity), told.basis, *ends, words_of(score))))
    about = f"{found.flights.species}: model {found.model}, minimum {in_words(found.objective)}"
    return [
        Line(about, tone="title"),
        Table(tuple(flown), ("speed\n[m/s]", *heads), "r" * (1 + len(heads))),
        Table(tuple(rows), _HEADINGS, "lllll"),
    ]
