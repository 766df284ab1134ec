"""NetCDF-4 files: datasets written whole or not at all, and read with every fault named."""

from __future__ import annotations

import json
import os
import stat
from os import PathLike
from typing import TYPE_CHECKING, Any

from wingbeat.errors import FileError
from wingbeat.files import writing

if TYPE_CHECKING:
    import xarray as xr

KIND = "wingbeat_kind"
_TEXT = ("status", "message", "species", "objective", "version")
_SIGNATURES = (b"\x89HDF\r\n\x1a\n",)


def orbit_attributes(record: dict[str, Any], inputs: dict[str, Any], digest: str) -> dict[str, Any]:
    """Return a record and its inputs as attributes: numbers and texts as they are, all else as JSON."""
    attributes = {name: _encode(name, value) for name, value in record.items()}
    return {KIND: "orbit", **attributes, "inputs": json.dumps(inputs), "inputs_hash": digest}


def parse_attributes(
    attributes: dict[str, Any], path: str | PathLike[str]
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return record and inputs from the attributes of a file.

    Raises
    ------
    FileError : the attributes are not those of an orbit.
    """
    if attributes.get(KIND) != "orbit":
        kind = attributes.get(KIND, "not from wingbeat")
        raise FileError(f"cannot read {os.fspath(path)!r} as an orbit: it is {kind}; give a file of `orbit -o`")
    try:
        names = [n for n in attributes if n not in (KIND, "Conventions", "inputs", "inputs_hash")]
        record = {name: _decode(name, attributes[name]) for name in names}
        return record, json.loads(attributes["inputs"])
    except (KeyError, ValueError, TypeError) as error:
        raise FileError(
            f"cannot read {os.fspath(path)!r} as an orbit: its attributes are damaged ({error}); solve it again"
        ) from None


def _encode(name: str, value: Any) -> Any:
    if name in _TEXT or (isinstance(value, int | float) and not isinstance(value, bool)):
        return value
    return json.dumps(value)


def _decode(name: str, value: Any) -> Any:
    if name in _TEXT:
        return str(value)
    if isinstance(value, str):
        return json.loads(value)
    return value.item()


def save_dataset(dataset: xr.Dataset, path: str | PathLike[str]) -> None:
    """Write a dataset as NetCDF-4, beside its place first and then renamed.

    Raises
    ------
    FileError : the file cannot be written.
    """
    with writing(path) as beside:
        dataset.to_netcdf(beside, engine="h5netcdf")


def load_dataset(path: str | PathLike[str]) -> xr.Dataset:
    """Read a NetCDF-4 file into memory.

    Raises
    ------
    FileError : missing, unreadable, truncated, or not NetCDF-4.
    """
    shown = repr(os.fspath(path))
    try:
        # A pipe or a terminal would wait for ever.
        mode = os.stat(path).st_mode
        if not stat.S_ISREG(mode) and not stat.S_ISDIR(mode):
            raise FileError(f"cannot read {shown}: it is not a plain file; give a file of `orbit -o`")
        with open(path, "rb") as file:
            start = file.read(8)
    except (OSError, ValueError) as error:
        reason = (getattr(error, "strerror", None) or str(error)).lower()
        raise FileError(f"cannot read {shown}: {reason}; check the path") from None
    if start not in _SIGNATURES:
        raise FileError(f"cannot read {shown}: it is not a NetCDF-4 file; give a file of `orbit -o`")
    import xarray as xr

    try:
        return xr.load_dataset(path, engine="h5netcdf")
    except Exception as error:
        # HDF5 reports damage through many kinds of exception, each with its own inner words.
        reason = str(error).split("\n")[0]
        raise FileError(f"cannot read {shown}: it is damaged or cut short ({reason}); solve it again") from None
