"""NetCDF-4 files: datasets are written whole or not at all; a file that cannot be read is refused with a reason."""

from __future__ import annotations

import hashlib
import json
import math
import os
import stat
from os import PathLike
from typing import TYPE_CHECKING, Any

from wingbeat.datasets import KIND
from wingbeat.errors import FileError, is_number, system_reason
from wingbeat.files import write_atomically
from wingbeat.nomenclature import NOMENCLATURE
from wingbeat.results.plausibility import is_judgement, statements

if TYPE_CHECKING:
    import xarray as xr

# What a record holds that is not a number.
_KINDS: dict[str, tuple[type, ...]] = {
    **dict.fromkeys(("status", "message", "species", "objective", "version"), (str,)),
    **dict.fromkeys(
        ("model", "vehicle", "aero", "air", "wingbeat", "initial_state", "closure", "constraints"), (dict,)
    ),
    **dict.fromkeys(("active_bounds", "failed_balance", "relaxations", "plausibility", "warnings"), (list,)),
    **dict.fromkeys(("floquet_multipliers", "alpha_quarter_span", "alpha_three_quarter_span"), (list,)),
    "inputs": (dict,),
}
_NUMBER = (int, float, type(None))
_GIVE = "give a file that `wingbeat orbit -o` wrote"
_SIGNATURES = (b"\x89HDF\r\n\x1a\n",)


def inputs_hash(inputs: dict[str, Any]) -> str:
    """Return the SHA-256 of the inputs; the order of the inputs does not matter."""
    return hashlib.sha256(json.dumps(inputs, sort_keys=True).encode()).hexdigest()


def orbit_attributes(record: dict[str, Any], inputs: dict[str, Any]) -> dict[str, Any]:
    """Return a record and its inputs as attributes: numbers and texts unchanged, everything else as JSON.

    The statements on closure and plausibility are added as two texts.
    """
    attributes = {name: _encode(name, value) for name, value in record.items()}
    said = statements(record)
    attributes |= {"statement_of_closure": said.closes, "statement_of_plausibility": said.plausible}
    return {KIND: "orbit", **attributes, "inputs": json.dumps(inputs), "inputs_hash": inputs_hash(inputs)}


def parse_attributes(
    attributes: dict[str, Any], path: str | PathLike[str]
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return record and inputs from the attributes of a file.

    Raises
    ------
    FileError : the attributes are not those of an orbit.
    """
    if attributes.get(KIND) != "orbit":
        kind = f"of kind {str(attributes[KIND])!r}" if KIND in attributes else "not from wingbeat"
        raise FileError(f"cannot read {os.fspath(path)!r} as an orbit: it is {kind}; {_GIVE}")
    try:
        # Other attributes come from other programs, such as `history`.
        own = {name: value for name, value in attributes.items() if name in _KINDS or name in NOMENCLATURE}
        record = {name: _decode(name, value) for name, value in own.items()}
        inputs = record.pop("inputs")
        if attributes["inputs_hash"] != inputs_hash(inputs):
            raise ValueError("the inputs do not match their hash")
        return record, inputs
    except (KeyError, ValueError, TypeError, AttributeError) as error:
        raise FileError(
            f"cannot read {os.fspath(path)!r} as an orbit: its attributes are damaged ({error}); "
            "solve the orbit again"
        ) from None


def _encode(name: str, value: Any) -> Any:
    if _KINDS.get(name) == (str,) or is_number(value):
        return value
    return json.dumps(value)


def _decode(name: str, value: Any) -> Any:
    kind = _KINDS.get(name, _NUMBER)
    if kind != (str,):
        value = json.loads(value) if isinstance(value, str) else value.item()
    if not isinstance(value, kind) or (isinstance(value, float) and not math.isfinite(value)):
        raise ValueError(f"{name} is {value!r}")
    if name == "plausibility" and not is_judgement(value):
        raise ValueError(f"{name} lacks a key")
    return value


def save_dataset(dataset: xr.Dataset, path: str | PathLike[str]) -> None:
    """Write a dataset as NetCDF-4, completely or not at all.

    Raises
    ------
    FileError : the file cannot be written.
    """
    # Made in memory: on a full disk HDF5 itself fills stderr with tracebacks and may crash the process.
    write_atomically(path, bytes(dataset.to_netcdf(engine="h5netcdf")))


def load_dataset(path: str | PathLike[str]) -> xr.Dataset:
    """Read a NetCDF-4 file into memory.

    Raises
    ------
    FileError : missing, unreadable, truncated, or not NetCDF-4.
    """
    shown = repr(os.fspath(path))
    if (suffix := os.path.splitext(os.fspath(path))[1].lower()) in (".csv", ".mat"):
        fix = f"{suffix} is for other programs; save the result as .nc too"
        raise FileError(f"cannot read {shown}: wingbeat reads results from .nc files; {fix}")
    try:
        # Reading from a pipe or a terminal could wait for ever.
        mode = os.stat(path).st_mode
        if not stat.S_ISREG(mode) and not stat.S_ISDIR(mode):
            raise FileError(f"cannot read {shown}: it is not a plain file; {_GIVE}")
        with open(path, "rb") as file:
            start = file.read(8)
    except (OSError, ValueError) as error:
        reason = system_reason(error)
        raise FileError(f"cannot read {shown}: {reason}; check the path") from None
    if start not in _SIGNATURES:
        raise FileError(f"cannot read {shown}: it is not a NetCDF-4 file; {_GIVE}")
    import h5py
    import xarray as xr

    try:
        with h5py.File(path, "r") as whole:
            # If the attributes are damaged, this raises before h5netcdf opens the file. A freed h5netcdf file would
            # complain once more on stderr.
            dict(whole.attrs)
        return xr.load_dataset(path, engine="h5netcdf")
    except Exception as error:
        # HDF5 reports damage through many kinds of exception, each with a text of its own.
        reason = str(error).split("\n")[0]
        raise FileError(f"cannot read {shown}: it is damaged or cut short ({reason}); solve it again") from None
