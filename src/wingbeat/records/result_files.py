"""Result files: written whole or not at all, and read back only if every check passes."""

from __future__ import annotations

import math
import os
import stat
from collections.abc import Callable
from os import PathLike
from typing import TYPE_CHECKING, Any

from wingbeat._base import KIND, FaultList, FileError, system_reason, write_atomically
from wingbeat.records.agreement import check_curve, check_flight, check_orbit
from wingbeat.records.characteristic import with_characteristic_speeds
from wingbeat.records.forms import FORMS, check_form, from_json, inputs_hash, parse_attributes, said_of
from wingbeat.records.netcdf import MOST_DECLARED, UnfitFileError, check_declared, netcdf_bytes, own_content
from wingbeat.records.tables import csv_text, mat_bytes, results_of

if TYPE_CHECKING:
    import h5py
    import xarray as xr

# The command that writes each kind of result, and the article of its name.
_WRITTEN_BY = {"orbit": ("an", "orbit -o"), "flight": ("a", "simulate -o"), "curve": ("a", "curve -o")}
_SIGNATURE = b"\x89HDF\r\n\x1a\n"
# What damaged or forged content raises while it is checked.
_WRONG = (LookupError, ValueError, TypeError, AttributeError, ArithmeticError, RecursionError)


def load_dataset(path: str | PathLike[str], *kinds: str, most: int = MOST_DECLARED) -> xr.Dataset:
    """Read the orbit, flight or curve that a file holds into memory, and check all of it.

    The checks go from the outside in: a plain file of NetCDF-4; its kind; what it declares to hold; its digest;
    types and dimensions of all attributes and variables; and whether its numbers agree with one another.

    What wingbeat wrote, without attributes that other programs added.
    """
    shown, kinds = repr(os.fspath(path)), kinds or tuple(FORMS)
    articles = [f"{_WRITTEN_BY[kind][0]} {kind}" for kind in kinds]
    what = f"{shown} as {_listed(articles)}" if len(kinds) == 1 else shown
    give = f"give a file that {_listed([f'`wingbeat {_WRITTEN_BY[kind][1]}`' for kind in kinds])} wrote"
    if (suffix := os.path.splitext(os.fspath(path))[1].lower()) in (".csv", ".mat"):
        fix = f"{suffix} is for other programs; save the result as .nc too"
        raise FileError(f"cannot read {shown}: wingbeat reads results from .nc files; {fix}")
    _check_plain(path, shown, give)
    import h5py
    import xarray as xr

    try:
        with h5py.File(path, "r") as whole:
            if (kind := _kind_of(whole)) not in kinds:
                its = "is not from wingbeat" if kind is None else f"holds another kind of result, {kind!r:.60}"
                raise FileError(f"cannot read {what}: it {its}; {give}")
            check_declared(whole, path, most)
        # Times stay numbers, whatever the units say.
        found = xr.load_dataset(path, engine="h5netcdf", decode_times=False, decode_timedelta=False)
    except FileError:
        raise
    except UnfitFileError as error:
        raise FileError(f"cannot read {shown}: {error}; {give}") from None
    except Exception as error:
        # HDF5 reports damage through many kinds of exception, each with a text of its own.
        reason = str(error).split("\n")[0][:200]
        raise FileError(f"cannot read {shown}: it is damaged or cut short ({reason}); solve it again") from None
    try:
        own = own_content(found)
    except ValueError as error:
        raise FileError(f"cannot read {what}: {error}") from None
    try:
        return _agreeing(own, str(kind))
    except _WRONG as error:
        reason = str(error).split("\n")[0][:200]
        raise FileError(f"cannot read {what}: it is damaged ({reason}); solve it again") from None


def _check_plain(path: str | PathLike[str], shown: str, give: str) -> None:
    try:
        # Reading from a pipe or a terminal could wait for ever.
        mode = os.stat(path).st_mode
        if not stat.S_ISREG(mode) and not stat.S_ISDIR(mode):
            raise FileError(f"cannot read {shown}: it is not a plain file; {give}")
        with open(path, "rb") as file:
            start = file.read(8)
    except (OSError, ValueError) as error:
        raise FileError(f"cannot read {shown}: {system_reason(error)}; check the path") from None
    if start != _SIGNATURE:
        raise FileError(f"cannot read {shown}: it is not a NetCDF-4 file; {give}")


def _kind_of(file: h5py.File) -> str | None:
    """Return the kind of result in a file, which is read before all else; None if there is none."""
    if KIND not in file.attrs or math.prod(file.attrs.get_id(KIND).shape or (1,)) != 1:
        return None
    kind = file.attrs[KIND]
    return kind.decode("utf-8", "replace") if isinstance(kind, bytes) else str(kind)


def _agreeing(dataset: xr.Dataset, kind: str) -> xr.Dataset:
    """Check the form of a dataset and that its numbers agree, and return it with what follows from them."""
    check_form(dataset)
    if kind == "flight":
        check_flight(dataset)
        return dataset
    if kind == "curve":
        inputs = from_json(dataset.attrs["inputs"])
        if dataset.attrs["inputs_hash"] != inputs_hash(inputs):
            raise ValueError("the inputs do not match their hash")
        check_curve(dataset, inputs)
        return with_characteristic_speeds(dataset, inputs["power_limit"])
    record, inputs = parse_attributes(dataset.attrs)
    check_orbit(record, inputs, dataset)
    return dataset.assign_attrs(said_of(record))


def _listed(names: list[str]) -> str:
    return " or ".join((", ".join(names[:-1]), names[-1])) if len(names) > 1 else names[0]


_WRITERS: dict[str, Callable[[xr.Dataset], bytes]] = {
    ".nc": netcdf_bytes,
    ".csv": lambda dataset: csv_text(dataset, results_of(dataset)).encode(),
    ".mat": lambda dataset: mat_bytes(dataset, results_of(dataset)),
}
SUFFIXES = (*_WRITERS,)


def check_result_name(faults: FaultList, where: str, path: str | PathLike[str]) -> None:
    """Note a fault unless the suffix of a file name is that of a format for results."""
    if _suffix(path) not in SUFFIXES:
        fix = "end the name in .nc (NetCDF, which wingbeat can read again), .csv or .mat"
        faults.add(where, os.fspath(path), "does not end in a suffix for results", fix)


def save_result(dataset: xr.Dataset, path: str | PathLike[str]) -> None:
    """Write a result as NetCDF-4 (.nc), as a flat table (.csv) or for MATLAB (.mat), whole or not at all.

    wingbeat can read only the .nc file again. All three hold every number, with its unit.
    """
    faults = FaultList()
    check_result_name(faults, "path", path)
    faults.raise_if_any()
    # Made in memory: on a full disk HDF5 itself fills stderr with tracebacks and may crash the process.
    write_atomically(path, _WRITERS[_suffix(path)](dataset))


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
