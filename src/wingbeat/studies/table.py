"""A study as a table: one row per point, columns by the record's dotted names, and files of it."""

from __future__ import annotations

import csv
import io
import json
import os
from collections.abc import Iterable
from datetime import UTC, datetime
from os import PathLike
from typing import TYPE_CHECKING, Any

from wingbeat._base import (
    NUMERICAL_VERSION,
    FaultList,
    WingbeatError,
    cf,
    install_extra,
    is_number,
    label_of,
    plain_unit,
    write_atomically,
)
from wingbeat.records.result_files import netcdf_bytes
from wingbeat.records.tables import flat

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

    from wingbeat.studies.store import Store

SUFFIXES = (".nc", ".csv", ".parquet")
KIND = "study"


def frame_of(store: Store) -> pd.DataFrame:
    """Return a row for each point of a store's plan, in its order; without a result, ``status`` is ``waiting``.

    The columns are the top-level keys with several values, the varied paths, the record's dotted names,
    ``certificate``, ``error``, and those that begin with ``run_``, about the run. A point without a record has only
    its inputs.
    """
    import pandas as pd

    asked = _asked(store.bases())
    rows, columns = [], ({}, {}, {})
    for row in store.rows():
        status = {"key": row.key, "status": row.status or "waiting"}
        record = {} if row.record is None else dict(flat(json.loads(row.record)))
        record.pop("status", None)
        run = {
            "certificate": row.certificate,
            "error": row.error or "",
            "run_seconds": row.seconds,
            "run_finished": None if row.finished is None else datetime.fromtimestamp(row.finished, UTC).isoformat(),
            "run_worker": row.worker or "",
            "run_attempt": row.attempt,
        }
        parts = status | asked[row.base] | dict(flat(row.told)), record, run
        for names, part in zip(columns, parts, strict=True):
            names.update(dict.fromkeys(part))
        # The record's own names take precedence: they say what was solved, in SI units.
        rows.append(parts[0] | parts[1] | parts[2])
    order = dict.fromkeys(name for names in columns for name in names)
    frame = pd.DataFrame.from_records(rows, columns=list(order))
    for name in frame.columns:
        # A null in a record is an unknown number: not-a-number in a column of numbers.
        if frame[name].dtype == object and all(v is None or is_number(v) for v in frame[name]):
            frame[name] = frame[name].astype(float)
    return frame


def varied_numbers(frame: pd.DataFrame, paths: Iterable[str]) -> list[str]:
    """Return the columns of varied parameters that hold numbers; for lists of numbers, the items that differ."""
    names, found = [str(name) for name in frame.columns], []
    for path in paths:
        items = [name for name in names if name.startswith(f"{path}.") and name.rpartition(".")[2].isdigit()]
        found += [path] if path in names else [name for name in items if len(set(frame[name])) > 1]
    return [name for name in found if frame[name].dtype.kind in "fiu"]


def _asked(bases: list[tuple[dict[str, Any], dict[str, Any]]]) -> list[dict[str, Any]]:
    """Return, for each base, the values that distinguish it, by column."""
    names = {"species": lambda of: of["species"]["name"], "aero": lambda of: of["aero"]["coefficients"]}
    columns = {"species": "species", "aero": "aero.coefficients"}
    # Several files may hold animals or models of the same name; the names or paths that were given then distinguish
    # them.
    alike = [
        name
        for name, called in names.items()
        if len({called(inputs) for _, inputs in bases}) < len({told.get(name) for told, _ in bases})
    ]
    return [
        {columns[name]: called(inputs) for name, called in names.items()}
        | {f"{name}_given": told[name] for name in alike}
        | {name: json.dumps(v) if isinstance(v, list) else v for name, v in told.items() if name not in names}
        for told, inputs in bases
    ]


def to_dataset(frame: pd.DataFrame, about: dict[str, Any]) -> xr.Dataset:
    """Return a table as a labelled dataset along ``point``.

    A column without numbers becomes a column of texts; a missing value in it becomes an empty text.
    """
    import numpy as np
    import xarray as xr

    columns = {}
    for name in frame.columns:
        values = frame[name]
        if _is_text(values):
            texts = ["" if value is None or value != value else str(value) for value in values]
            values = np.array(texts, dtype=str)
        columns[name] = ("point", np.asarray(values), _attributes(frame, str(name)))
    return xr.Dataset(columns).assign_attrs(wingbeat_kind=KIND, numerical_version=NUMERICAL_VERSION, **about)


def _is_text(values: Any) -> bool:
    return values.dtype.kind not in "fiub"


def _attributes(frame: pd.DataFrame, name: str) -> dict[str, str]:
    """Return label and unit of a column; texts have no unit, and neither have numbers whose units differ by row."""
    label = label_of(name)
    if _is_text(frame[name]):
        return {"long_name": label}
    units = {plain_unit(name)}
    if name == "objective_value" and "objective" in frame:
        units = {plain_unit(objective) for objective in frame["objective"] if isinstance(objective, str)}
    return {"units": cf(units.pop()), "long_name": label} if len(units) == 1 else {"long_name": label}


def check_table_name(faults: FaultList, where: str, path: str | PathLike[str]) -> None:
    """Note a fault unless the name has the suffix of a table that can be written."""
    if os.path.splitext(path)[1].lower() not in SUFFIXES:
        faults.add(where, os.fspath(path), "is not a table format", f"end it in {', '.join(SUFFIXES)}")


def save_table(frame: pd.DataFrame, about: dict[str, Any], path: str | PathLike[str]) -> None:
    """Write a table with its units as NetCDF-4, CSV or Parquet, by the suffix, completely or not at all."""
    faults = FaultList()
    check_table_name(faults, "path", path)
    faults.raise_if_any()
    suffix = os.path.splitext(path)[1].lower()
    if suffix == ".nc":
        write_atomically(path, netcdf_bytes(to_dataset(frame, about)))
    elif suffix == ".csv":
        text = frame.to_csv(index=False)
        if "#" in text:  # the character that begins a comment: texts are quoted
            text = frame.to_csv(index=False, quoting=csv.QUOTE_NONNUMERIC)
        write_atomically(path, _head(frame) + text)
    else:
        write_atomically(path, _parquet(frame))


def _head(frame: pd.DataFrame) -> str:
    """Return the header lines of a CSV file, with unit and meaning of each column, as `results.csv_table` does."""
    lines = ["# study, written by the package wingbeat; SI units, angles in radians; one row per point", "#"]
    lines.append("# columns: name [unit] meaning")
    for name in frame.columns:
        about = _attributes(frame, str(name))
        unit = f" [{about['units']}]" if "units" in about else ""
        lines.append(f"# {name}{unit} {about['long_name']}")
    # A name from the user's file may hold a line break.
    return "".join(" ".join(line.split()) + "\n" for line in lines)


def _parquet(frame: pd.DataFrame) -> bytes:
    """Return a table as a Parquet file whose fields hold ``units`` and ``long_name`` as metadata."""
    try:
        import pyarrow as pa  # pyright: ignore[reportMissingImports]
        import pyarrow.parquet as pq  # pyright: ignore[reportMissingImports]
    except ImportError:
        raise WingbeatError(
            f"To write Parquet, install pyarrow: {install_extra('parquet')}. Or choose a name ending in .nc or .csv"
        ) from None
    table = pa.Table.from_pandas(frame, preserve_index=False)
    fields = [field.with_metadata(_attributes(frame, field.name)) for field in table.schema]
    held = io.BytesIO()
    pq.write_table(table.cast(pa.schema(fields, table.schema.metadata)), held)
    return held.getvalue()
