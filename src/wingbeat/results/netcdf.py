"""NetCDF-4 as wingbeat writes it: texts of fixed length, which every reader knows, and a digest of all content."""

from __future__ import annotations

import hashlib
import io
import json
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import xarray as xr

# The digest of a file, and the names of the attributes that it covers: other programs add attributes of their own.
DIGEST, DIGEST_OF = "wingbeat_digest", "wingbeat_digest_of"
# The attributes that wingbeat gives a variable.
_OF_VARIABLE = ("long_name", "standard_name", "symbol", "units")


def netcdf_bytes(dataset: xr.Dataset) -> bytes:
    """Return a dataset as the bytes of a NetCDF-4 file with a digest of its content.

    Texts have a fixed length (NC_CHAR, UTF-8). By default, xarray writes texts of variable length (NC_STRING), of
    which Octave's netcdf package reads no unit and no coordinate, and ``nccopy -d`` packs no file that holds one.

    Parameters
    ----------
    dataset : numbers and texts.
    """
    import h5py

    covered = [str(name) for name in dataset.attrs]
    # A list of texts has no fixed length, so it becomes JSON, as everywhere in wingbeat's attributes.
    listed = {name: json.dumps(list(v)) for name, v in dataset.attrs.items() if isinstance(v, list | tuple)}
    dataset = dataset.assign_attrs(listed)
    signed = dataset.assign_attrs({DIGEST: digest(dataset, covered), DIGEST_OF: json.dumps(covered)})
    texts = {name: {"dtype": "S1"} for name, variable in signed.variables.items() if _is_text(variable.dtype)}
    held = io.BytesIO(bytes(signed.drop_encoding().to_netcdf(engine="h5netcdf", encoding=texts)))
    # xarray adds attributes while it writes, `coordinates` and `_Encoding`; so the lengths are fixed afterwards.
    with h5py.File(held, "r+") as file:
        for place in (file, *file.values()):
            for name in list(place.attrs):
                if _is_long(place.attrs.get_id(name).dtype):
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

    Parameters
    ----------
    dataset : numbers and texts.
    covered : names of attributes.

    Raises
    ------
    KeyError : the dataset lacks one of the attributes.

    >>> import xarray as xr
    >>> one, other = (xr.Dataset({"u": ("phase", [1.0, u])}) for u in (2.0, 3.0))
    >>> digest(one, []) == digest(one.assign_attrs(history="copied"), []), digest(one, []) == digest(other, [])
    (True, False)
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
    """Return a dataset that was read from a file, without the digest and without what other programs added.

    Raises
    ------
    ValueError : there is no digest, or it does not fit the content; in words for a reader.
    """
    dataset = dataset.copy()
    for place in (dataset, *dataset.variables.values()):
        place.attrs = {name: _utf8(value) for name, value in place.attrs.items()}
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


def _utf8(value: Any) -> Any:
    """Return a text as it was written: netCDF's library declares UTF-8 as ASCII, which h5netcdf does not decode."""
    return value.encode("utf-8", "surrogateescape").decode("utf-8", "replace") if isinstance(value, str) else value


def _is_text(dtype: np.dtype) -> bool:
    return dtype.kind in "OUST"


def _is_long(dtype: np.dtype) -> bool:
    """Return whether the type is that of texts of variable length; references to objects have its kind too."""
    import h5py

    known = h5py.check_string_dtype(dtype)
    return known is not None and known.length is None


def _plain(value: Any) -> Any:
    """Return the value of an attribute for JSON; readers differ in whether one number is a list of one."""
    value = np.asarray(value)
    return value.item() if value.size == 1 else value.tolist()
