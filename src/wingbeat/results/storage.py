"""Result files: written whole or not at all, and read back only if every check passes."""

from __future__ import annotations

import hashlib
import json
import math
import os
import stat
from collections.abc import Callable
from os import PathLike
from typing import TYPE_CHECKING, Any

from wingbeat._base import NOMENCLATURE, FileError, is_number, system_reason, write_atomically
from wingbeat._base.datasets import KIND, STATE_NAMES
from wingbeat.results.declared import MOST_DECLARED, UnfitFileError, check_declared
from wingbeat.results.forms import FORMS, check_form, from_json
from wingbeat.results.netcdf import netcdf_bytes, own_content
from wingbeat.results.plausibility import is_judgement, statements

if TYPE_CHECKING:
    import h5py
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


def _is_state(value: dict[str, Any]) -> bool:
    return {*value} == {*STATE_NAMES} and all(map(_is_known, value.values()))


def _is_known(value: Any) -> bool:
    return value is None or is_number(value)


def _is_range(value: list[Any]) -> bool:
    return len(value) == 2 and all(map(_is_known, value))


def _are_texts(value: list[Any]) -> bool:
    return all(isinstance(item, str) for item in value)


def _are_deficits(value: list[Any]) -> bool:
    return all({*one} == {"law", "share", "amount", "unit"} for one in value) and all(
        isinstance(one["law"], str) and is_number(one["share"]) and is_number(one["amount"]) for one in value
    )


# What the items of dictionaries and lists must be.
_ITEMS: dict[str, Callable[[Any], bool]] = {
    **dict.fromkeys(("initial_state", "closure"), _is_state),
    **dict.fromkeys(("active_bounds", "warnings"), _are_texts),
    **dict.fromkeys(("alpha_quarter_span", "alpha_three_quarter_span"), _is_range),
    "constraints": lambda value: all(map(_is_known, value.values())),
    "floquet_multipliers": lambda value: all(isinstance(pair, list) and _is_range(pair) for pair in value),
    "failed_balance": _are_deficits,
    "plausibility": is_judgement,
}
# The command that writes each kind of result, and the article of its name.
_WRITTEN_BY = {"orbit": ("an", "orbit -o"), "flight": ("a", "simulate -o"), "curve": ("a", "curve -o")}
_SIGNATURE = b"\x89HDF\r\n\x1a\n"
# What damaged or forged content raises while it is checked.
_WRONG = (LookupError, ValueError, TypeError, AttributeError, ArithmeticError, RecursionError)


def inputs_hash(inputs: dict[str, Any]) -> str:
    """Return the SHA-256 of the inputs; the order of the inputs does not matter."""
    return hashlib.sha256(json.dumps(inputs, sort_keys=True).encode()).hexdigest()


def orbit_attributes(record: dict[str, Any], inputs: dict[str, Any]) -> dict[str, Any]:
    """Return a record and its inputs as attributes: numbers and texts unchanged, everything else as JSON.

    The statements on closure and plausibility are added as two texts.
    """
    attributes = {name: _encode(name, value) for name, value in record.items()}
    return {
        KIND: "orbit",
        **attributes,
        **_statements(record),
        "inputs": json.dumps(inputs),
        "inputs_hash": inputs_hash(inputs),
    }


def _statements(record: dict[str, Any]) -> dict[str, str]:
    said = statements(record)
    return {"statement_of_closure": said.closes, "statement_of_plausibility": said.plausible}


def parse_attributes(attributes: dict[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
    """Return record and inputs from the attributes of an orbit.

    Raises
    ------
    ValueError, LookupError, TypeError, AttributeError, RecursionError : they are not those of an orbit.
    """
    own = {name: value for name, value in attributes.items() if name in _KINDS or name in NOMENCLATURE}
    record = {name: _decode(name, value) for name, value in own.items()}
    inputs = record.pop("inputs")
    if attributes["inputs_hash"] != inputs_hash(inputs):
        raise ValueError("the inputs do not match their hash")
    return record, inputs


def _encode(name: str, value: Any) -> Any:
    if _KINDS.get(name) == (str,) or is_number(value):
        return value
    return json.dumps(value)


def _decode(name: str, value: Any) -> Any:
    kind = _KINDS.get(name, _NUMBER)
    if kind != (str,):
        value = from_json(value) if isinstance(value, str) else value.item()
    if not isinstance(value, kind) or (isinstance(value, float) and not math.isfinite(value)):
        raise ValueError(f"{name} is {value!r:.60}")
    if not _ITEMS.get(name, lambda _: True)(value):
        raise ValueError(f"{name} holds something else than it should")
    return value


def save_dataset(dataset: xr.Dataset, path: str | PathLike[str]) -> None:
    """Write a dataset as NetCDF-4 with a digest of its content, completely or not at all.

    Raises
    ------
    FileError : the file cannot be written.
    """
    # Made in memory: on a full disk HDF5 itself fills stderr with tracebacks and may crash the process.
    write_atomically(path, netcdf_bytes(dataset))


def load_dataset(path: str | PathLike[str], *kinds: str, most: int = MOST_DECLARED) -> xr.Dataset:
    """Read the orbit, flight or curve that a file holds into memory, and check all of it.

    The checks go from the outside in: a plain file of NetCDF-4; its kind; what it declares to hold; its digest;
    types and dimensions of all attributes and variables; and whether its numbers agree with one another.

    Parameters
    ----------
    path : of the file.
    kinds : those that are wanted, of ``"orbit"``, ``"flight"`` and ``"curve"``; all of them if none is given.
    most : most bytes that the file may take once it is unpacked.

    Returns
    -------
    What wingbeat wrote, without attributes that other programs added.

    Raises
    ------
    FileError : missing, unreadable, cut short, not NetCDF-4, of another kind, too large, changed, or contradictory.
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
    from wingbeat.results.agreement import check_flight, check_orbit
    from wingbeat.results.curve_agreement import check_curve
    from wingbeat.results.curve_dataset import with_characteristic_speeds

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
    return dataset.assign_attrs(_statements(record))


def _listed(names: list[str]) -> str:
    return " or ".join((", ".join(names[:-1]), names[-1])) if len(names) > 1 else names[0]
