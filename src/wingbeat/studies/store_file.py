"""The file under a study's store: digests of its rows, its pages read without SQLite, its tables, errors in words.

SQLite refuses a whole file for one damaged page, so pages are read here to count and salvage intact results. The
formats: https://www.sqlite.org/fileformat2.html, sections 1.6 (cells and overflow pages), 2.1 (records) and 4 (the
write-ahead log). Digests decide which rows are intact, so nothing here needs to know what is damaged.
"""

from __future__ import annotations

import hashlib
import mmap
import os
import sqlite3
import struct
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any, NamedTuple

from wingbeat._base import FileError, WingbeatError, first_line
from wingbeat.studies.units import FAILED

# --- digests ---

# Columns of the table `points`, the digest of the others last.
POINT_COLUMNS = (
    *("key", "status", "base", "changes", "record", "certificate", "error", "run_seconds", "run_finished"),
    *("run_worker", "run_attempt", "run_number", "digest"),
)
_BYTES = 16


def _told(values: Iterable[Any]) -> bytes:
    """Return a row as bytes. Type and length precede each value, so that different rows give different bytes."""
    texts, heads = [], []
    for value in values:
        text = value if type(value) is str else repr(value)
        texts.append(text)
        heads.append(f"{type(value).__name__} {len(text)} ")
    return "".join((*heads, "\n", *texts)).encode()


def row_digest(values: Iterable[Any]) -> bytes:
    """Return the BLAKE2b digest of a row: of the value, type and length of each column.

    >>> row_digest(["3f2a", 1.0]) == row_digest(["3f2a", 1])
    False
    """
    return hashlib.blake2b(_told(values), digest_size=_BYTES).digest()


def table_digest(rows: Iterable[Sequence[Any]]) -> str:
    """Return the digest of rows in their order, as hexadecimal text."""
    digest = hashlib.blake2b(digest_size=_BYTES)
    for row in rows:
        digest.update(_told(row))
    return digest.hexdigest()


def about_digest(about: Mapping[str, str]) -> str:
    """Return the digest of a store's information about itself, except this digest."""
    return table_digest(sorted((name, value) for name, value in about.items() if name != "digest"))


class Fingerprint(NamedTuple):
    """The number of rows and the XOR of their digests.

    It shows whether a row is lost or changed; the order of the rows does not matter.

    >>> a, b = row_digest(["a"]), row_digest(["b"])
    >>> Fingerprint().add(a).add(b).remove(a) == Fingerprint().add(b)
    True
    """

    rows: int = 0
    mixed: int = 0

    def add(self, digest: bytes) -> Fingerprint:
        """Return the fingerprint with one more row."""
        return Fingerprint(self.rows + 1, self.mixed ^ int.from_bytes(digest, "big"))

    def remove(self, digest: bytes) -> Fingerprint:
        """Return the fingerprint without a row."""
        return Fingerprint(self.rows - 1, self.mixed ^ int.from_bytes(digest, "big"))

    def __str__(self) -> str:
        return f"{self.rows} {self.mixed:032x}"

    @classmethod
    def of_text(cls, text: str) -> Fingerprint:
        """Return the fingerprint that a text holds; an empty text means no rows."""
        count, _, mixed = text.partition(" ")
        return cls(int(count), int(mixed, 16)) if text else cls()


# --- pages, read without SQLite ---

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
    """

    def rank(row: tuple[Any, ...]) -> tuple[bool, int]:
        return row[_STATUS] not in FAILED, row[_NUMBER]

    found: dict[str, tuple[Any, ...]] = {}
    for row in _rows(path):
        with suppress(ValueError, TypeError, UnicodeError):
            if len(row) == len(POINT_COLUMNS) and row_digest(row[:-1]) == row[-1]:
                found[row[0]] = max(found.get(row[0], row), row, key=rank)
    return found


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


# --- the database ---

# A mark in the file's head, by which the program `file` and we recognise a store: "wbst".
APPLICATION = 0x77627374
# Raised whenever the tables change.
FORM = "2"
TABLES = """
CREATE TABLE about (name TEXT PRIMARY KEY, value TEXT NOT NULL);
CREATE TABLE bases (hash TEXT PRIMARY KEY, inputs TEXT NOT NULL);
CREATE TABLE plan_bases (base INTEGER PRIMARY KEY, hash TEXT NOT NULL, told TEXT NOT NULL);
CREATE TABLE plan (ordinal INTEGER PRIMARY KEY, unit INTEGER NOT NULL, key TEXT NOT NULL UNIQUE,
    base INTEGER NOT NULL, changes TEXT NOT NULL, told TEXT NOT NULL);
CREATE INDEX plan_unit ON plan (unit);
CREATE TABLE points (key TEXT PRIMARY KEY, status TEXT NOT NULL, base TEXT NOT NULL, changes TEXT NOT NULL,
    record TEXT, certificate REAL, error TEXT NOT NULL, run_seconds REAL NOT NULL, run_finished REAL NOT NULL,
    run_worker TEXT NOT NULL, run_attempt INTEGER NOT NULL, run_number INTEGER NOT NULL, digest BLOB NOT NULL);
CREATE INDEX points_status ON points (key, status, run_number);
"""

# Mean time of the points solved first, without the first points of each worker process, because it also compiles
# programs for them.
_RUN = "run_number, run_worker"
MEAN_SECONDS = f"""
WITH some AS (SELECT run_seconds, run_finished, {_RUN} FROM points WHERE run_seconds > 0 LIMIT 1000)
SELECT AVG(run_seconds) FROM some
    WHERE ({_RUN}, run_finished) NOT IN (SELECT {_RUN}, MIN(run_finished) FROM some GROUP BY {_RUN})
"""

# Databases that this process has open, by device and inode, with the number of connections.
_OPEN: Counter[tuple[int, int]] = Counter()


class DamagedStoreError(FileError):
    """The content of a store differs from what was written to it."""


def connect(path: Path, mode: str) -> sqlite3.Connection:
    """Open a database; wait only briefly for other programs, and leave the start of transactions to the caller."""
    connection = sqlite3.connect(f"{path.absolute().as_uri()}?{mode}", uri=True, timeout=10.0, isolation_level=None)
    try:
        connection.execute("SELECT name FROM sqlite_master LIMIT 1").fetchall()
    except BaseException:
        connection.close()
        raise
    return connection


def connect_reader(path: Path) -> sqlite3.Connection:
    """Open a database for reading, even in a read-only folder or while another process writes to it."""
    try:
        connection = connect(path, "mode=rw")
    except sqlite3.OperationalError:
        # Without a log beside it, nobody is writing to it.
        logged = path.with_name(path.name + "-wal").exists()
        connection = connect(path, "mode=ro" if logged else "mode=ro&immutable=1")
    connection.execute("PRAGMA query_only = 1")
    return connection


@contextmanager
def closing(connection: sqlite3.Connection, path: Path) -> Iterator[sqlite3.Connection]:
    """Close the connection to a database at the end of a block, whatever happens in it."""
    identity = identity_of(path) or (0, 0)
    _OPEN[identity] += 1
    try:
        yield connection
    finally:
        connection.close()
        _OPEN[identity] -= 1


def identity_of(path: Path) -> tuple[int, int] | None:
    """Return device and inode of a file, which its names share; None if there is no file."""
    try:
        found = os.stat(path)
    except OSError:
        return None
    return found.st_dev, found.st_ino


def unused_name(path: Path, word: str) -> Path:
    """Return an unused name beside a store, which ends in a word, so that files put aside earlier are kept."""
    number = 1
    while True:
        aside = path.with_name(f"{path.name}.{word}" + (f"-{number}" if number > 1 else ""))
        if not any(os.path.lexists(f"{aside}{end}") for end in ("", "-wal")):
            return aside
        number += 1


def is_open_here(path: Path) -> bool:
    """Return whether this process has a database open, so that it must not read the file itself.

    If a process closes any handle of a file, POSIX drops all locks of the process on this file, those of SQLite
    too. Another process then takes the log for one that nobody uses and deletes it, with the results in it
    (https://www.sqlite.org/howtocorrupt.html, section 2.2).
    """
    return _OPEN[identity_of(path) or (0, 0)] > 0


def refusal(path: Path, reason: str) -> DamagedStoreError:
    """Return the error for a damaged store, which says how many of its results can be salvaged."""
    count = 0
    with suppress(OSError):
        count = len(whole_answers(path))
    if not count:
        return DamagedStoreError(
            f"the store {str(path)!r} is damaged or not a store ({reason}), and no result can be read from it; "
            "nothing was deleted; restore a copy, or move it away and run the study again"
        )
    return DamagedStoreError(
        f"the store {str(path)!r} is damaged ({reason}); nothing was deleted; run `wingbeat study salvage`, which "
        f"keeps the {count} intact results in a new store, or restore a copy"
    )


@contextmanager
def in_use(path: Path) -> Iterator[None]:
    """Turn an error in using a store's content into a `FileError`: no study wrote it, though its digests match."""
    try:
        yield
    except (WingbeatError, sqlite3.Error):
        raise
    except Exception as error:  # whatever can be wrong with what somebody wrote into a file
        told, fix = first_line(error)[:200], "move it away, and run the study again"
        raise FileError(f"the store {str(path)!r} holds what no study writes ({told}); {fix}") from None


@contextmanager
def in_words(path: Path) -> Iterator[None]:
    """Turn errors of SQLite into a `FileError` in words."""
    try:
        yield
    except sqlite3.Error as error:
        told = str(error)
        code = getattr(error, "sqlite_errorname", "")
        if code == "SQLITE_IOERR_SHORT_READ":
            raise refusal(path, "it is cut short") from None
        if "full" in told or code.startswith(("SQLITE_FULL", "SQLITE_IOERR")):
            fix = "stored results remain; free some disk space and run the study again"
            raise FileError(f"cannot write the store {str(path)!r}: {told}; {fix}") from None
        if code in ("SQLITE_READONLY", "SQLITE_CANTOPEN") or "readonly" in told:
            fix = "check the path, or copy the study to a folder that you can write to"
            raise FileError(f"cannot open the store {str(path)!r}: {told}; {fix}") from None
        if "locked" in told or "busy" in told:
            raise FileError(f"the store {str(path)!r} is in use by another program; close that program") from None
        raise refusal(path, told) from None
    except UnicodeDecodeError:  # raised in place of an error of SQLite that quotes the damaged bytes
        raise refusal(path, "its schema is not text") from None
