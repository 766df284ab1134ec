"""Results written for wingbeat itself (.nc) and for other programs (.csv, .mat), by the suffix of the file."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from os import PathLike
from typing import TYPE_CHECKING, Any

from wingbeat._base import FaultList, write_atomically
from wingbeat._base.datasets import SHAPE
from wingbeat.results.storage import save_dataset

if TYPE_CHECKING:
    import xarray as xr

# Attributes of a dataset that are plain text even if they read as JSON, such as a species called "12".
_TEXTS = (
    *("Conventions", "wingbeat_kind", "status", "message", "species", "objective", "trim", "version"),
    *("inputs", "inputs_hash", "statement_of_closure", "statement_of_plausibility"),
)


def results_of(dataset: xr.Dataset) -> dict[str, Any]:
    """Return the attributes of a result as plain dictionaries and lists.

    All inputs together stay one JSON text, from which the result can be computed again. The shape of the animal is
    left out: only our drawings use it.
    """
    found = {}
    for name, value in dataset.attrs.items():
        if name == SHAPE:
            continue
        value = value.item() if hasattr(value, "item") else value
        found[name] = _decoded(value) if isinstance(value, str) and name not in _TEXTS else value
    return found


def _decoded(text: str) -> Any:
    """Return what a JSON text holds; a text that is no JSON, such as ``prescribed``, is returned unchanged."""
    try:
        return json.loads(text)
    except ValueError:
        return text


def _as_csv(dataset: xr.Dataset) -> bytes:
    from wingbeat.results.csv_table import csv_text

    return csv_text(dataset, results_of(dataset)).encode()


def _as_mat(dataset: xr.Dataset) -> bytes:
    from wingbeat.results.mat_file import mat_bytes

    return mat_bytes(dataset, results_of(dataset))


_WRITERS: dict[str, Callable[[xr.Dataset], bytes]] = {".csv": _as_csv, ".mat": _as_mat}
SUFFIXES = (".nc", *_WRITERS)


def check_result_name(faults: FaultList, where: str, path: str | PathLike[str]) -> None:
    """Note a fault unless the suffix of a file name is that of a format for results."""
    if _suffix(path) not in SUFFIXES:
        fix = "end the name in .nc (NetCDF, which wingbeat can read again), .csv or .mat"
        faults.add(where, os.fspath(path), "does not end in a suffix for results", fix)


def save_result(dataset: xr.Dataset, path: str | PathLike[str]) -> None:
    """Write a result as NetCDF-4 (.nc), as a flat table (.csv) or for MATLAB (.mat), whole or not at all.

    wingbeat can read only the .nc file again. All three hold every number, with its unit.

    Raises
    ------
    InvalidInputError : another suffix.
    FileError : the file cannot be written.
    """
    faults = FaultList()
    check_result_name(faults, "path", path)
    faults.raise_if_any()
    write = _WRITERS.get(_suffix(path))
    if write is None:
        save_dataset(dataset, path)
    else:
        write_atomically(path, write(dataset))


def _suffix(path: str | PathLike[str]) -> str:
    return os.path.splitext(os.fspath(path))[1].lower()


class Saveable:
    """A result whose ``dataset`` can be written to a file."""

    def save(self: Any, path: str | PathLike[str]) -> None:
        """Write everything as NetCDF-4 (.nc), as a flat table (.csv) or for MATLAB (.mat); see `save_result`.

        Parameters
        ----------
        path : of the file to write; its suffix, .nc, .csv or .mat, determines the format.

        Raises
        ------
        InvalidInputError : another suffix.
        FileError : the file cannot be written.
        """
        save_result(self.dataset, path)
