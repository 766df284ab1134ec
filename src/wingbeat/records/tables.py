"""Records and data sets as tables for other programs: columns with dotted names, pandas, CSV and MATLAB.

Header lines of a CSV file begin with ``#`` and can be skipped as comments: ``pandas.read_csv(file, comment="#")``
in Python, ``readtable(file, CommentStyle="#")`` in MATLAB, ``read.csv(file, comment.char = "#")`` in R.

In a MATLAB file each series is a variable of its own shape; units, meanings and results are structs. SciPy writes
names that MATLAB cannot read, and leaves out a field whose name begins with an underscore: so a table with such a
name becomes a list of names and values.
"""

from __future__ import annotations

import io
import itertools
import json
import math
import re
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import KIND, SHAPE, InvalidInputError, cf, is_number, over_of, plain_unit
from wingbeat.orbits.problem.quantities import named_objective, named_quantity

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr


def flat(record: dict[str, Any], before: str = "") -> Iterator[tuple[str, Any]]:
    """Yield what `leaves` yields, its lists as JSON text."""
    for path, value in leaves(record, before):
        yield path, json.dumps(value) if isinstance(value, list) else value


def leaves(record: dict[str, Any], before: str = "") -> Iterator[tuple[str, Any]]:
    """Yield the values of nested tables by their dotted names; items of a list of numbers are numbered from 0.

    >>> dict(leaves({"wing": {"mass": 0.02, "shoulder": [0.0, 0.1]}, "warnings": ["odd"]}))
    {'wing.mass': 0.02, 'wing.shoulder.0': 0.0, 'wing.shoulder.1': 0.1, 'warnings': ['odd']}
    """
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
    """
    import pandas as pd

    missing = [math.nan, math.nan]
    whole = [{**one, "plausible": one["plausible"] or missing} if "plausible" in one else one for one in records]
    return pd.DataFrame([dict(flat(record)) for record in whole])


def result_unit(dataset: xr.Dataset, results: dict[str, Any], path: str, value: Any) -> str:
    """Return the unit of a single value in a data set's attributes; an empty text if it is not known."""
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


# The coordinate along which each kind of result has its rows; of a curve, the attribute `over` names it.
_ROWS = {"orbit": "phase", "flight": "phase", "torque-driven flight": "time", "glide": "angle_of_attack"}


def _rows(about: Mapping[str, Any]) -> str:
    return _ROWS.get(about[KIND]) or over_of(about)


def csv_text(dataset: xr.Dataset, results: dict[str, Any]) -> str:
    """Return the text of a CSV file."""
    kind = results["wingbeat_kind"]
    along = _rows(results)
    columns = list(_columns(dataset, along))
    out = io.StringIO()
    out.write(f"# {kind}, written by the package wingbeat; SI units, angles in radians; ")
    out.write(f"one row per {along.replace('_', ' ')}\n")
    out.write("#\n# results: name = value [unit]; values are JSON\n")
    single = [(str(name), v.values.tolist()) for name, v in dataset.variables.items() if along not in v.dims]
    for path, value in (*leaves(results), *(one for one in single if one[0] != "optimum")):
        name = _one_line(path)
        out.write(f"# {name} = {json.dumps(value)}{_bracket(result_unit(dataset, results, path, value))}\n")
    out.write("#\n# columns: name [unit] meaning\n")
    for name, unit, meaning, _ in columns:
        out.write(f"# {name}{_bracket(unit)} {_one_line(meaning)}".rstrip() + "\n")
    out.write(",".join(name for name, *_ in columns) + "\n")
    for row in zip(*([_cell(v) for v in values.tolist()] for *_, values in columns), strict=True):
        out.write(",".join(row) + "\n")
    return out.getvalue()


def frame_of(dataset: xr.Dataset) -> pd.DataFrame:
    """Return the rows and columns of the CSV file as a table of pandas."""
    import pandas as pd

    return pd.DataFrame({name: values for name, _, _, values in _columns(dataset, _rows(dataset.attrs))})


def _columns(dataset: xr.Dataset, along: str) -> Iterator[tuple[str, str, str, Any]]:
    """Yield name, unit, meaning and values of the columns of a table, its rows' own coordinate first."""
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
            yield own, unit, said, moved[(slice(None), *at)]


def _end(dataset: xr.Dataset, dim: str, index: int) -> tuple[str, str]:
    """Return the endings of a column's name and meaning for one index along a dimension; indices start at 1."""
    if dim == "optimum":  # most readers want the best optimum of each row, so its column has the plain name
        return (f"{dim}_{index + 1}", f"number {index + 1} of the optima in this row") if index else ("", "")
    label = dataset[dim].values[index]
    if isinstance(label, str):
        return label.replace(" ", "_"), str(label)
    return f"{dim}_{index + 1}", f"{dim} {label:.6g}"


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


# A name that MATLAB accepts, of at most `namelengthmax` characters, and the words of its language (`iskeyword`).
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,62}")
_KEYWORDS = {
    *("break", "case", "catch", "classdef", "continue", "else", "elseif", "end", "for", "function", "global"),
    *("if", "otherwise", "parfor", "persistent", "return", "spmd", "switch", "try", "while"),
}


def mat_bytes(dataset: xr.Dataset, results: dict[str, Any]) -> bytes:
    """Return the content of a MATLAB file, version 5, which Octave and every MATLAB since version 5 can read."""
    from scipy.io import savemat

    variables = {str(name): variable for name, variable in dataset.variables.items()}
    content: dict[str, Any] = {}
    for name, variable in variables.items():  # numbers as doubles, MATLAB's default type, texts as cell arrays
        content[name] = variable.values.astype(float if variable.dtype.kind in "biuf" else object)
    for struct, attribute in (("units", "units"), ("meaning", "long_name")):
        content[struct] = {name: v.attrs[attribute] for name, v in variables.items() if attribute in v.attrs}
    content["dimensions"] = {name: _value(list(map(str, v.dims))) for name, v in variables.items()}
    content["results"] = _value(results)
    content["results_units"] = _value(_units(dataset, results, results, ""))
    held = io.BytesIO()
    savemat(held, content, long_field_names=True, do_compression=True, oned_as="column")
    return held.getvalue()


def _units(dataset: xr.Dataset, results: dict[str, Any], part: dict[str, Any], before: str) -> dict[str, Any]:
    """Return the units of all numbers in a part of the results, under the same names."""
    found: dict[str, Any] = {}
    for key, value in part.items():
        path = f"{before}{key}"
        unit = result_unit(dataset, results, path, value)
        if isinstance(value, dict):
            found[key] = _units(dataset, results, value, f"{path}.")
        elif unit:
            found[key] = unit
    return found


def _value(value: Any) -> Any:
    """Return one part of a record in MATLAB's types; a missing value becomes NaN."""
    if value is None:
        return np.nan
    if isinstance(value, dict):
        if all(_NAME.fullmatch(key) and key not in _KEYWORDS for key in value):
            return {key: _value(item) for key, item in value.items()}
        # MATLAB does not accept a limit such as "peak_power<=30" as the name of a field.
        return _value([{"name": key, "value": item} for key, item in value.items()])
    if isinstance(value, list):  # a matrix if it holds numbers in rows of one length, else a cell array
        if numeric(value):
            with suppress(ValueError):  # rows of several lengths
                return np.array(value, dtype=float)
        cells = np.empty(len(value), dtype=object)
        for i, item in enumerate(value):
            cells[i] = _value(item)
        return cells
    return float(value) if is_number(value) else value


# Attributes of a dataset that are plain text even if they read as JSON, such as a species called "12". All inputs
# together stay one JSON text, from which the result can be computed again.
_TEXTS = (
    *("Conventions", "wingbeat_kind", "status", "message", "species", "objective", "trim", "version"),
    *("inputs", "inputs_hash", "statement_of_closure", "statement_of_plausibility"),
)


def results_of(dataset: xr.Dataset) -> dict[str, Any]:
    """Return the attributes of a result as dictionaries and lists, without the shape, which is for drawings."""
    found = {}
    for name, value in dataset.attrs.items():
        if name == SHAPE:
            continue
        value = value.item() if hasattr(value, "item") else value
        if isinstance(value, str) and name not in _TEXTS:
            with suppress(ValueError):  # a text that is no JSON, such as ``prescribed``
                value = json.loads(value)
        found[name] = value
    return found


def finite_or_none(value: Any) -> Any:
    """Return a copy with every float that is not finite replaced by None."""
    if isinstance(value, dict):
        return {key: finite_or_none(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [finite_or_none(item) for item in value]
    if isinstance(value, float):
        return float(value) if math.isfinite(value) else None
    return value
