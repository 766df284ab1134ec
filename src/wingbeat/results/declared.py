"""What a file declares, checked before it is read: a few bytes can declare gigabytes, or other files."""

from __future__ import annotations

import math
import os
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import h5py

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
    """Refuse, before reading, a file with too many or too large arrays, groups, or links to other files.

    Parameters
    ----------
    file : an open HDF5 file.
    path : of this file.
    most : most bytes that it may take once it is unpacked.

    Raises
    ------
    UnfitFileError : which rule it breaks.
    """
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
