"""Result files: NetCDF-4 with a digest, written whole or not at all, and read back only if every check passes.

A few bytes can declare gigabytes, or other files: so what a file declares is checked first.
"""

from __future__ import annotations

import hashlib
import io
import json
import math
import os
import stat
from collections.abc import Callable, Iterable
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import KIND, FaultList, FileError, system_reason, write_atomically
from wingbeat.records.agreement import check_curve, check_flight, check_orbit
from wingbeat.records.characteristic import with_characteristic
from wingbeat.records.forms import FORMS, check_form, from_json, inputs_hash, parse_attributes, said_of
from wingbeat.records.tables import csv_text, mat_bytes, results_of

if TYPE_CHECKING:
    import h5py
    import xarray as xr

# The digest of a file, and the names of the attributes that it covers: other programs add attributes of their own.
DIGEST, DIGEST_OF = "wingbeat_digest", "wingbeat_digest_of"
# The attributes that wingbeat gives a variable.
_OF_VARIABLE = ("long_name", "standard_name", "symbol", "units")


def netcdf_bytes(dataset: xr.Dataset) -> bytes:
    """Return a dataset as the bytes of a NetCDF-4 file with a digest of its content."""
    import h5py

    covered = [str(name) for name in dataset.attrs]
    # A list of texts has no fixed length, so it becomes JSON, as everywhere in wingbeat's attributes.
    listed = {name: json.dumps(list(v)) for name, v in dataset.attrs.items() if isinstance(v, list | tuple)}
    dataset = dataset.assign_attrs(listed)
    signed = dataset.assign_attrs({DIGEST: digest(dataset, covered), DIGEST_OF: json.dumps(covered)})
    texts = {name: {"dtype": "S1"} for name, variable in signed.variables.items() if _is_text(variable.dtype)}
    # Texts get a fixed length (NC_CHAR, UTF-8): of those of variable length (NC_STRING), xarray's default, Octave's
    # netcdf package reads no unit and no coordinate, and ``nccopy -d`` packs no file that holds one.
    held = io.BytesIO(bytes(signed.drop_encoding().to_netcdf(engine="h5netcdf", encoding=texts)))
    # xarray adds attributes while it writes, `coordinates` and `_Encoding`; so the lengths are fixed afterwards.
    with h5py.File(held, "r+") as file:
        for place in (file, *file.values()):
            for name in list(place.attrs):
                known = h5py.check_string_dtype(place.attrs.get_id(name).dtype)
                if known is not None and known.length is None:  # a text, not a reference to an object
                    text = str(place.attrs[name]).encode("utf-8", "surrogateescape") or b"\0"
                    place.attrs.create(name, np.array(text, h5py.string_dtype("utf-8", len(text))))
                elif place is file and not name.startswith("_"):
                    place.attrs[name] = place.attrs[name]  # written again too, to stay in its place
    return held.getvalue()


def digest(dataset: xr.Dataset, covered: Iterable[str]) -> str:
    """Return the SHA-256 of a dataset's content, in hexadecimal.

    It covers the given attributes of the dataset, and of every variable its name, dimensions, shape, type, values
    and wingbeat's attributes. It does not depend on the order, on how a file stores them (chunks, compression,
    order of bytes, kind of text), or on what else is in the attributes.
    """
    found = hashlib.sha256()

    def add(*parts: Any) -> None:
        found.update(json.dumps(parts).encode() + b"\n")

    add("attributes", [(name, _plain(dataset.attrs[name])) for name in sorted(covered)])
    for name in sorted(map(str, dataset.variables)):
        variable = dataset.variables[name]
        about = [(own, _plain(variable.attrs[own])) for own in _OF_VARIABLE if own in variable.attrs]
        add(name, list(map(str, variable.dims)), variable.shape, about)
        if _is_text(variable.dtype):
            add([str(text).rstrip("\0") for text in variable.values.ravel().tolist()])
            continue
        values = np.ascontiguousarray(variable.values, variable.dtype.newbyteorder("<"))
        add(values.dtype.str)
        found.update((np.where(np.isnan(values), np.nan, values) if values.dtype.kind == "f" else values).tobytes())
    return found.hexdigest()


def own_content(dataset: xr.Dataset) -> xr.Dataset:
    """Return a dataset that was read from a file, without the digest and without what other programs added."""
    dataset = dataset.copy()
    for place in (dataset, *dataset.variables.values()):
        # netCDF's library declares UTF-8 as ASCII, which h5netcdf does not decode.
        place.attrs = {
            name: v.encode("utf-8", "surrogateescape").decode("utf-8", "replace") if isinstance(v, str) else v
            for name, v in place.attrs.items()
        }
    if DIGEST not in dataset.attrs or DIGEST_OF not in dataset.attrs:
        raise ValueError(
            "it has no digest, so another program or an older version of wingbeat wrote it; save the result again "
            "with this version"
        )
    covered: list[str] = []
    try:
        covered = json.loads(dataset.attrs[DIGEST_OF])
        good = digest(dataset, covered) == dataset.attrs[DIGEST]
    except (LookupError, ValueError, TypeError, AttributeError, RecursionError):
        good = False
    if not good:
        raise ValueError("it was changed after wingbeat wrote it: its digest does not fit; solve it again")
    dataset.attrs = {name: dataset.attrs[name] for name in covered}
    for variable in dataset.variables.values():
        variable.attrs = {name: value for name, value in variable.attrs.items() if name in _OF_VARIABLE}
    return dataset


def _is_text(dtype: np.dtype) -> bool:
    return dtype.kind in "OUST"


def _plain(value: Any) -> Any:
    """Return the value of an attribute for JSON; readers differ in whether one number is a list of one."""
    value = np.asarray(value)
    return value.item() if value.size == 1 else value.tolist()


# Most bytes that the arrays and attributes of a result may take once they are unpacked; an orbit takes 0.7 million,
# a flight of 1000 beats at 128 samples 370 million.
MOST_DECLARED = 1_000_000_000
# Most bytes that one byte of a file may declare, and bytes free of that rule. wingbeat writes uncompressed files; a
# copy by `nccopy -d9` declares 1.05 times its size if it is an orbit.
_MOST_PER_BYTE, _FREE = 100, 1_000_000
_MOST_OBJECTS = 400
# What netCDF and HDF5 write beside a result, for their own use.
_OF_NETCDF = ("CLASS", "NAME", "DIMENSION_LIST", "REFERENCE_LIST")


class UnfitFileError(ValueError):
    """A file declares what no result has; the message says what, in words for a reader."""


def check_declared(file: h5py.File, path: str | os.PathLike[str], most: int = MOST_DECLARED) -> None:
    """Refuse, before reading, a file with too many or too large arrays, groups, or links to other files."""
    import h5py

    size = os.path.getsize(path)
    limit = min(most, _FREE + _MOST_PER_BYTE * size)
    declared = _attributes(file, limit)
    for objects, name in enumerate(file, 1):
        if objects > _MOST_OBJECTS:
            raise UnfitFileError(f"it holds more than {_MOST_OBJECTS} arrays")
        if not isinstance(file.get(name, getlink=True), h5py.HardLink):
            raise UnfitFileError("it points to other places or files")
        item = file[name]
        if not isinstance(item, h5py.Dataset):
            raise UnfitFileError(f"it holds more than arrays and attributes, in {name!r:.60}")
        declared += _attributes(item, limit) + _array(item, size)
        if declared > limit:
            what = f"{most // 1_000_000} million bytes" if limit == most else "a hundred times its size"
            raise UnfitFileError(f"it would take more than {what} when unpacked")


def _array(item: h5py.Dataset, size: int) -> int:
    """Return the unpacked size of an array or of one of its chunks, whichever is larger [bytes]."""
    import h5py

    if item.external or item.is_virtual:
        raise UnfitFileError("it points to other places or files")
    count = math.prod(item.shape or (1,))
    each = item.dtype.itemsize
    if item.dtype.kind not in "biufS":
        if h5py.check_string_dtype(item.dtype) is None:
            raise UnfitFileError(f"it holds an array of neither numbers nor texts, {item.name!r:.60}")
        each = size  # many texts may share one place, which is unpacked for each
    _check_packing(item)
    return each * max(count, math.prod(item.chunks or (0,)))


def _check_packing(item: h5py.Dataset) -> None:
    """Refuse packing other than by one pass of deflate, or a chunk that unpacks to more than it declares."""
    import zlib

    import h5py

    plist = item.id.get_create_plist()
    packing = [plist.get_filter(i)[0] for i in range(plist.get_nfilters())]
    if packing.count(h5py.h5z.FILTER_DEFLATE) > 1 or not {*packing} <= {
        h5py.h5z.FILTER_DEFLATE,
        h5py.h5z.FILTER_SHUFFLE,
        h5py.h5z.FILTER_FLETCHER32,
    }:
        raise UnfitFileError(f"it is packed in a way that wingbeat does not read, in {item.name!r:.60}")
    if h5py.h5z.FILTER_DEFLATE not in packing:
        return
    most = math.prod(item.chunks or (1,)) * item.dtype.itemsize + 64
    for i in range(item.id.get_num_chunks()):
        chunk = item.id.get_chunk_info(i)
        if chunk.filter_mask:
            continue  # stored as it is
        _, packed = item.id.read_direct_chunk(chunk.chunk_offset)
        unpacking = zlib.decompressobj()
        unpacking.decompress(packed, most)
        if unpacking.unconsumed_tail:
            raise UnfitFileError(f"it would unpack to more than it declares, in {item.name!r:.60}")


def _attributes(item: Any, limit: int) -> int:
    """Return the size of all attributes of one object [bytes]."""
    import h5py

    if len(item.attrs) > _MOST_OBJECTS:
        raise UnfitFileError(f"it holds more than {_MOST_OBJECTS} attributes at one place")
    size = 0
    for name in item.attrs:
        if name in _OF_NETCDF:
            continue
        about = item.attrs.get_id(name)
        size += math.prod(about.shape or (1,)) * about.dtype.itemsize
        if size <= limit and h5py.check_string_dtype(about.dtype) is not None and about.dtype.kind == "O":
            if math.prod(about.shape or (1,)) > 1:
                raise UnfitFileError(f"it holds an attribute of many texts, {name!r:.60}")
            size += len(str(item.attrs[name]))
        if size > limit:
            raise UnfitFileError("it holds too much text")
    return size


# The command that writes each kind of result, and the article of its name.
_WRITTEN_BY = {"orbit": ("an", "orbit -o"), "flight": ("a", "simulate -o"), "curve": ("a", "curve -o")}
_SIGNATURE = b"\x89HDF\r\n\x1a\n"
# What damaged or forged content raises while it is checked.
_WRONG = (LookupError, ValueError, TypeError, AttributeError, ArithmeticError, RecursionError)


def load_dataset(path: str | PathLike[str], *kinds: str, most: int = MOST_DECLARED) -> xr.Dataset:
    """Read the orbit, flight or curve that a file holds into memory, and check all of it.

    The checks go from the outside in: a plain file of NetCDF-4; its kind; what it declares to hold; its digest;
    types and dimensions of all attributes and variables; and whether its numbers agree with one another. Attributes
    that other programs added are left out.
    """
    shown, kinds = repr(os.fspath(path)), kinds or tuple(FORMS)
    articles = [f"{_WRITTEN_BY[kind][0]} {kind}" for kind in kinds]
    what = f"{shown} as {_listed(articles)}" if len(kinds) == 1 else shown
    give = f"give a file that {_listed([f'`wingbeat {_WRITTEN_BY[kind][1]}`' for kind in kinds])} wrote"
    if (suffix := os.path.splitext(path)[1].lower()) in (".csv", ".mat"):
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
        return with_characteristic(dataset, inputs)
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
    if os.path.splitext(path)[1].lower() not in SUFFIXES:
        fix = "end the name in .nc (NetCDF, which wingbeat can read again), .csv or .mat"
        faults.add(where, os.fspath(path), "does not end in a suffix for results", fix)


def save_result(dataset: xr.Dataset, path: str | PathLike[str]) -> None:
    """Write a result as NetCDF-4 (.nc), as a flat table (.csv) or for MATLAB (.mat), whole or not at all."""
    faults = FaultList()
    check_result_name(faults, "path", path)
    faults.raise_if_any()
    # Made in memory: on a full disk HDF5 itself fills stderr with tracebacks and may crash the process.
    write_atomically(path, _WRITERS[os.path.splitext(path)[1].lower()](dataset))


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
