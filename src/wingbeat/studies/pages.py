"""Read the pages of a store's files without SQLite, because SQLite refuses a whole file for one damaged page.

Formats: https://www.sqlite.org/fileformat2.html, sections 1.6 (cells and overflow pages), 2.1 (records) and 4
(the write-ahead log). Digests decide which rows are intact, so nothing here needs to know what is damaged.
"""

from __future__ import annotations

import mmap
import struct
from collections.abc import Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

from wingbeat.studies.digests import POINT_COLUMNS, row_digest
from wingbeat.studies.units import FAILED

# Bytes of a page; every store is made with it, so that salvage does not depend on the file's own head.
PAGE = 4096
_LOG_HEAD, _FRAME_HEAD = 32, 24
_LOG_MAGIC = (0x377F0682, 0x377F0683)  # the second sums in big-endian order
_FLOATS = tuple(POINT_COLUMNS.index(name) for name in ("certificate", "run_seconds", "run_finished"))
_STATUS, _NUMBER = POINT_COLUMNS.index("status"), POINT_COLUMNS.index("run_number")
# Bytes of the whole numbers and the float that a record holds, by their serial type.
_SIZES = {0: 0, 1: 1, 2: 2, 3: 3, 4: 4, 5: 6, 6: 8, 7: 8, 8: 0, 9: 0}


def whole_answers(path: Path) -> dict[str, tuple[Any, ...]]:
    """Return the intact rows of the table ``points``, by key; the store's files may be damaged in any way.

    If a point has two results, the one that did not fail is used, or else that of the later run.

    Parameters
    ----------
    path : of the store; its write-ahead log is read as well.
    """
    found: dict[str, tuple[Any, ...]] = {}
    for row in _rows(path):
        with suppress(ValueError, TypeError, UnicodeError):
            if len(row) == len(POINT_COLUMNS) and row_digest(row[:-1]) == row[-1]:
                found[row[0]] = max(found.get(row[0], row), row, key=_rank)
    return found


def _rank(row: tuple[Any, ...]) -> tuple[bool, int]:
    return row[_STATUS] not in FAILED, row[_NUMBER]


def _rows(path: Path) -> Iterator[tuple[Any, ...]]:
    """Yield everything that can be read as a row, from every page of a database and of its write-ahead log."""
    logged = _logged(path)
    latest = dict(logged)
    with open(path, "rb") as file:
        size = file.seek(0, 2)
        if size == 0:
            return
        with mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as whole:
            for page in range(size // PAGE):
                held = whole[page * PAGE : (page + 1) * PAGE]
                yield from _cells(held, whole, {})
            for _, held in logged:
                # A row may continue on a page of the log or, if that page is newer than the row, on the page of the
                # database.
                yield from _cells(held, whole, latest)
                yield from _cells(held, whole, {})


def _cells(page: bytes, whole: mmap.mmap, latest: Mapping[int, bytes]) -> Iterator[tuple[Any, ...]]:
    """Yield the rows of a leaf page of a table; the page's type is not checked, because it may be damaged."""
    count = int.from_bytes(page[3:5], "big")
    if len(page) < PAGE or count > PAGE // 4:
        return
    for place in range(8, 8 + 2 * count, 2):
        with suppress(ValueError, IndexError, KeyError, struct.error, OverflowError):
            at = int.from_bytes(page[place : place + 2], "big")
            length, at = _varint(page, at)
            _, at = _varint(page, at)  # the row's number
            yield _record(_payload(page, at, length, whole, latest))


def _payload(page: bytes, at: int, length: int, whole: mmap.mmap, latest: Mapping[int, bytes]) -> bytes:
    """Return the bytes of a row, including those on its overflow pages."""
    most, least = PAGE - 35, (PAGE - 12) * 32 // 255 - 23
    if length <= most:
        return page[at : at + length]
    if length > len(whole) + sum(map(len, latest.values())):
        raise ValueError
    local = least + (length - least) % (PAGE - 4)
    local = local if local <= most else least
    parts, left = [page[at : at + local]], length - local
    number = int.from_bytes(page[at + local : at + local + 4], "big")
    while left > 0:
        held = latest.get(number) or whole[(number - 1) * PAGE : number * PAGE]
        if number < 1 or len(held) < PAGE:
            raise ValueError
        parts.append(held[4 : 4 + left])
        left -= PAGE - 4
        number = int.from_bytes(held[:4], "big")
    return b"".join(parts)


def _record(payload: bytes) -> tuple[Any, ...]:
    """Return the values of a row of the table ``points``, as SQLite would return them."""
    end, at = _varint(payload, 0)
    kinds = []
    while at < end:
        kind, at = _varint(payload, at)
        kinds.append(kind)
    if len(kinds) != len(POINT_COLUMNS):
        raise ValueError
    values: list[Any] = []
    at = end
    for kind in kinds:
        size = _SIZES[kind] if kind < 12 else (kind - 12) // 2
        values.append(_value(kind, payload[at : at + size]))
        at += size
    for place in _FLOATS:  # SQLite keeps a whole float as a whole number
        values[place] = None if values[place] is None else float(values[place])
    return tuple(values)


def _value(kind: int, data: bytes) -> Any:
    if kind == 0:
        return None
    if kind == 7:
        return struct.unpack(">d", data)[0]
    if kind < 12:
        return kind - 8 if kind > 7 else int.from_bytes(data, "big", signed=True)
    return data.decode() if kind % 2 else data


def _varint(data: bytes, at: int) -> tuple[int, int]:
    """Return a whole number of one to nine bytes, and the position after it."""
    value = 0
    for place in range(at, at + 8):
        value = value << 7 | data[place] & 0x7F
        if data[place] < 0x80:
            return value, place + 1
    return value << 8 | data[at + 8], at + 9


def _frames(path: Path) -> tuple[bytes, list[bytes]]:
    """Return the header of a database's write-ahead log, and its complete frames."""
    try:
        held = path.with_name(path.name + "-wal").read_bytes()
    except OSError:  # there is none
        return b"", []
    each = _FRAME_HEAD + PAGE
    places = range(_LOG_HEAD, len(held) - each + 1, each)
    return held[:_LOG_HEAD], [held[place : place + each] for place in places]


def _is_of(frame: bytes, head: bytes) -> bool:
    """Return whether a frame is of the current log.

    The two salts of an older frame both differ from those of the log; a flipped bit changes only one.
    """
    return frame[8:12] == head[16:20] or frame[12:16] == head[20:24]


def _logged(path: Path) -> list[tuple[int, bytes]]:
    """Return the number and content of each page in a database's log, in the order of writing."""
    head, frames = _frames(path)
    own = [frame for frame in frames if _is_of(frame, head)]
    return [(int.from_bytes(frame[:4], "big"), frame[_FRAME_HEAD:]) for frame in own]


def log_fault(path: Path) -> str | None:
    """Return where a database's log is damaged; SQLite ignores the rest of such a log without a message.

    An incomplete last frame, for example of a killed writer, is not a fault.
    """
    head, frames = _frames(path)
    if len(head) < _LOG_HEAD:
        return None
    magic = int.from_bytes(head[:4], "big")
    order = ">" if magic == _LOG_MAGIC[1] else "<"
    sums = _summed((0, 0), head[:24], order)
    if magic not in _LOG_MAGIC or struct.pack(">II", *sums) != head[24:32] or head[8:12] != PAGE.to_bytes(4, "big"):
        return "the header of its log"
    for number, frame in enumerate(frames):
        sums = _summed(_summed(sums, frame[:8], order), frame[_FRAME_HEAD:], order)
        if frame[8:16] != head[16:24] or struct.pack(">II", *sums) != frame[16:24]:
            if any(_is_of(later, head) for later in frames[number:]):
                return f"its log, from page {number + 1} on"
            return None
    return None


def _summed(sums: tuple[int, int], data: bytes, order: str) -> tuple[int, int]:
    one, two = sums
    words = struct.unpack(f"{order}{len(data) // 4}I", data)
    for first, second in zip(words[::2], words[1::2], strict=True):
        one = (one + first + two) & 0xFFFFFFFF
        two = (two + second + one) & 0xFFFFFFFF
    return one, two
