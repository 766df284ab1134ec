"""A result as a MATLAB file: each series is a variable of its own shape; units, meanings, results are structs.

SciPy writes names that MATLAB cannot read, and leaves out a field whose name begins with an underscore. So names
are checked here: a table with such a name becomes a list of names and values.
"""

from __future__ import annotations

import io
import re
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import is_number
from wingbeat.results.columns import numeric, result_unit

if TYPE_CHECKING:
    import xarray as xr

# A name that MATLAB accepts, of at most `namelengthmax` characters, and the words of its language (`iskeyword`).
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,62}")
_KEYWORDS = frozenset(
    (
        *("break", "case", "catch", "classdef", "continue", "else", "elseif", "end", "for", "function", "global"),
        *("if", "otherwise", "parfor", "persistent", "return", "spmd", "switch", "try", "while"),
    )
)


def mat_bytes(dataset: xr.Dataset, results: dict[str, Any]) -> bytes:
    """Return the content of a MATLAB file, version 5, which Octave and every MATLAB since version 5 can read.

    Parameters
    ----------
    dataset : of any result; the names of its variables are names of MATLAB.
    results : the content of its attributes, from `results_of`.
    """
    from scipy.io import savemat

    variables = {str(name): variable for name, variable in dataset.variables.items()}
    content: dict[str, Any] = {name: _array(variable.values) for name, variable in variables.items()}
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


def _array(values: np.ndarray) -> np.ndarray:
    """Return numbers as doubles, MATLAB's default type, and texts as a cell array."""
    return values.astype(float) if values.dtype.kind in "biuf" else values.astype(object)


def _is_name(name: str) -> bool:
    return _NAME.fullmatch(name) is not None and name not in _KEYWORDS


def _value(value: Any) -> Any:
    """Return one part of a record in MATLAB's types; a missing value becomes NaN."""
    if value is None:
        return np.nan
    if isinstance(value, dict):
        if all(map(_is_name, value)):
            return {key: _value(item) for key, item in value.items()}
        # MATLAB does not accept a limit such as "peak_power<=30" as the name of a field.
        return _value([{"name": key, "value": item} for key, item in value.items()])
    if isinstance(value, list):
        return _listed(value)
    return float(value) if is_number(value) else value


def _listed(items: list[Any]) -> np.ndarray:
    """Return a list as a matrix if it holds numbers in rows of one length, else as a cell array."""
    if numeric(items):
        with suppress(ValueError):  # rows of several lengths
            return np.array(items, dtype=float)
    cells = np.empty(len(items), dtype=object)
    for i, item in enumerate(items):
        cells[i] = _value(item)
    return cells
