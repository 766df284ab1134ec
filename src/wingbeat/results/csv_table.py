"""A result as a flat CSV table: header lines with units and single numbers, then one row per sample.

Header lines begin with ``#`` and can be skipped as comments: ``pandas.read_csv(file, comment="#")`` in Python,
``readtable(file, CommentStyle="#")`` in MATLAB, ``read.csv(file, comment.char = "#")`` in R.
"""

from __future__ import annotations

import io
import itertools
import json
import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

from wingbeat._base.datasets import KIND
from wingbeat.results.columns import leaves, result_unit

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

# The coordinate along which each kind of result has its rows.
_ROWS = {"orbit": "phase", "flight": "phase", "torque-driven flight": "time"}
_ROWS |= {"curve": "speed", "glide": "angle_of_attack"}


class _Column(NamedTuple):
    name: str
    unit: str
    meaning: str
    values: Any


def csv_text(dataset: xr.Dataset, results: dict[str, Any]) -> str:
    """Return the text of a CSV file.

    Parameters
    ----------
    dataset : of one of the kinds in `_ROWS`.
    results : the content of its attributes, from `results_of`.
    """
    kind = results["wingbeat_kind"]
    along = _ROWS[kind]
    columns = list(_columns(dataset, along))
    out = io.StringIO()
    out.write(f"# {kind}, written by the package wingbeat; SI units, angles in radians; ")
    out.write(f"one row per {along.replace('_', ' ')}\n")
    out.write("#\n# results: name = value [unit]; values are JSON\n")
    for path, value in _single_values(dataset, along, results):
        name = _one_line(path)
        out.write(f"# {name} = {json.dumps(value)}{_bracket(result_unit(dataset, results, path, value))}\n")
    out.write("#\n# columns: name [unit] meaning\n")
    for column in columns:
        out.write(f"# {column.name}{_bracket(column.unit)} {_one_line(column.meaning)}".rstrip() + "\n")
    out.write(",".join(column.name for column in columns) + "\n")
    for row in zip(*([_cell(v) for v in column.values.tolist()] for column in columns), strict=True):
        out.write(",".join(row) + "\n")
    return out.getvalue()


def frame_of(dataset: xr.Dataset) -> pd.DataFrame:
    """Return the rows and columns of the CSV file as a table of pandas.

    Parameters
    ----------
    dataset : of one of the kinds in `_ROWS`.
    """
    import pandas as pd

    columns = _columns(dataset, _ROWS[dataset.attrs[KIND]])
    return pd.DataFrame({column.name: column.values for column in columns})


def _columns(dataset: xr.Dataset, along: str) -> Iterator[_Column]:
    """Yield the columns of each variable that has the rows' dimension, the rows' own coordinate first."""
    for name in (along, *(name for name in dataset.variables if name != along)):
        variable = dataset[name]
        if along not in variable.dims:
            continue
        attributes, others = variable.attrs, [dim for dim in variable.dims if dim != along]
        meaning, unit = attributes.get("long_name", ""), attributes.get("units", "")
        moved = variable.transpose(along, *others).values
        for at in itertools.product(*(range(dataset.sizes[dim]) for dim in others)):
            ends = [_end(dataset, str(dim), i) for dim, i in zip(others, at, strict=True)]
            own = "_".join([str(name), *(short for short, _ in ends if short)])
            said = ", ".join(part for part in (meaning, *(long for _, long in ends)) if part)
            yield _Column(own, unit, said, moved[(slice(None), *at)])


def _end(dataset: xr.Dataset, dim: str, index: int) -> tuple[str, str]:
    """Return the endings of a column's name and meaning for one index along a dimension; indices start at 1."""
    if dim == "optimum":  # most readers want the best optimum of each speed, so its column has the plain name
        return (f"{dim}_{index + 1}", f"number {index + 1} of the optima at this speed") if index else ("", "")
    label = dataset[dim].values[index]
    if isinstance(label, str):
        return label.replace(" ", "_"), str(label)
    return f"{dim}_{index + 1}", f"{dim} {label:.6g}"


def _single_values(dataset: xr.Dataset, along: str, results: dict[str, Any]) -> Iterator[tuple[str, Any]]:
    """Yield all values outside the table: results by dotted name, then variables without the rows' dimension."""
    yield from leaves(results)
    for name, variable in dataset.variables.items():
        if along not in variable.dims and name != "optimum":
            yield str(name), variable.values.tolist()


def _bracket(unit: str) -> str:
    return f" [{unit}]" if unit else ""


def _cell(value: Any) -> str:
    """Return the text of a cell: a number with all its digits, or a text on one line.

    Texts are always in quotes, for without them readers would take what follows a ``#`` for a comment.
    """
    if isinstance(value, float):
        if math.isfinite(value):
            return repr(value)
        return "NaN" if math.isnan(value) else "Inf" if value > 0 else "-Inf"
    if isinstance(value, str):
        return '"' + _one_line(value).replace('"', '""') + '"'
    return str(value)


def _one_line(text: str) -> str:
    return "; ".join(text.splitlines())
