"""Nested records as flat columns with dotted names, and the unit of each value."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

from wingbeat._base import InvalidInputError, cf, plain_unit
from wingbeat.orbits.problem.quantities import named_objective, named_quantity

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr


def flat(record: dict[str, Any], before: str = "") -> Iterator[tuple[str, Any]]:
    """Yield the values of nested tables by their dotted names; items of a list of numbers are numbered from 0.

    Other lists become JSON text.

    >>> dict(flat({"wing": {"mass": 0.02, "shoulder": [0.0, 0.1]}, "warnings": ["odd"]}))
    {'wing.mass': 0.02, 'wing.shoulder.0': 0.0, 'wing.shoulder.1': 0.1, 'warnings': '["odd"]'}
    """
    for path, value in leaves(record, before):
        yield path, json.dumps(value) if isinstance(value, list) else value


def leaves(record: dict[str, Any], before: str = "") -> Iterator[tuple[str, Any]]:
    """Yield the same as `flat`, except that a list remains a list unless it holds only numbers."""
    for key, value in record.items():
        path = f"{before}{key}"
        if isinstance(value, dict):
            yield from leaves(value, f"{path}.")
        elif isinstance(value, list) and value and numeric(value):
            yield from leaves({str(i): item for i, item in enumerate(value)}, f"{path}.")
        else:
            yield path, value


def numeric(value: list[Any]) -> bool:
    """Return whether a list holds numbers, missing numbers and lists of them alone."""
    return all(numeric(v) if isinstance(v, list) else isinstance(v, int | float | None) for v in value)


def table_of(records: Iterable[dict[str, Any]]) -> pd.DataFrame:
    """Return a table of pandas with a row for each record, whose columns have the dotted names of `flat`.

    A range that is None becomes two missing numbers, so that every row has the same columns.

    Parameters
    ----------
    records : nested tables of the same form.

    >>> table_of([{"price": {"frequency": 1.5}, "range": [0.0, 1.0]}]).columns.to_list()
    ['price.frequency', 'range.0', 'range.1']
    """
    import pandas as pd

    missing = [math.nan, math.nan]
    whole = [{**one, "plausible": one["plausible"] or missing} if "plausible" in one else one for one in records]
    return pd.DataFrame([dict(flat(record)) for record in whole])


def result_unit(dataset: xr.Dataset, results: dict[str, Any], path: str, value: Any) -> str:
    """Return the unit of a single value in a data set's attributes; an empty text if it is not known.

    Parameters
    ----------
    dataset, results : the data set, and the content of its attributes.
    path, value : dotted name and value of one of the results.
    """
    head, last = path.partition(".")[0], path.rpartition(".")[2]
    if isinstance(value, bool | str | dict | None) or (isinstance(value, list) and not (value and numeric(value))):
        return ""
    if last in dataset.variables and "units" in dataset[last].attrs:
        return dataset[last].attrs["units"]
    try:
        if path == "objective_value":
            return cf(named_objective(results["objective"]).unit)
        if head == "constraints":
            return cf(named_quantity(re.split("[<>=]", path.partition(".")[2])[0]).unit)
    except InvalidInputError:  # a function of the user's, whose unit no record holds
        return ""
    return cf(plain_unit(path))
