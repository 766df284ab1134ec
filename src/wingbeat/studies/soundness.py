"""Check that a study's store is undamaged, whenever a store is opened and before its content is used."""

from __future__ import annotations

import functools
import os
import sqlite3
from collections.abc import Iterator
from contextlib import closing, suppress
from pathlib import Path

from wingbeat._base import FileError, system_reason
from wingbeat._version import NUMERICAL_VERSION
from wingbeat.studies.database import APPLICATION, FORM, TABLES, is_open_here, refusal
from wingbeat.studies.digests import Fingerprint, about_digest, row_digest, table_digest
from wingbeat.studies.lock import is_locked
from wingbeat.studies.pages import PAGE, log_fault, whole_answers

# Tables that a plan determines, each with the column that orders its rows for the table's digest.
PLAN_TABLES = {"bases": "hash", "plan_bases": "base", "plan": "ordinal"}
_MAGIC = b"SQLite format 3\0"
# Bytes of the head of a file that are the same in every store: the size of a page, both versions of the format,
# bytes reserved in a page, and the text encoding, UTF-8.
_HEAD = {16: PAGE.to_bytes(2, "big"), 20: b"\0", 56: b"\0\0\0\1"}

# Files that this process found undamaged; they are not checked again, because a command opens its store several
# times.
_SOUND: dict[Path, tuple[tuple[int, int, int], ...]] = {}


class _Damaged(Exception):
    """The content of a store differs from what was written to it."""


def check_files(path: Path, mine: bool) -> None:
    """Refuse a store with damaged files before SQLite opens them, because SQLite would truncate a damaged log.

    Parameters
    ----------
    path : of the store.
    mine : whether this process holds the store's lock, so that no other process is writing to the log.

    Raises
    ------
    FileError : the store is damaged, or cannot be read.
    """
    fault = log_fault(path)
    if fault is not None and not mine:  # perhaps a driver was just writing: look again if no driver is running
        fault = None if is_locked(path) else log_fault(path)
    if fault is None and is_open_here(path):  # it was checked when it was opened
        return
    try:
        with open(path, "rb") as file:
            head = file.read(100)
    except OSError as error:
        reason = system_reason(error)
        raise FileError(f"cannot open the store {str(path)!r}: {reason}; check its permissions") from None
    if fault is None and head.startswith(_MAGIC):
        alike = all(head[at : at + len(held)] == held for at, held in _HEAD.items())
        # Both format versions are 1 without a log and 2 with a log; other values keep SQLite from writing or
        # reading the file.
        alike = alike and {*head[18:20]} <= {1, 2}
        # Databases of other programs may differ; we recognise a store by its mark, or by a result in it.
        if not alike and (head[68:72] == APPLICATION.to_bytes(4, "big") or whole_answers(path)):
            fault = "its header"
    if fault is not None:
        raise refusal(path, fault)


def check_contents(connection: sqlite3.Connection, path: Path) -> None:
    """Refuse a file that is not a store, a store of another numerical version, and a damaged store.

    Every row of every table is read, which takes about 30 us per point. If this process has already found the same
    files undamaged, it reads nothing.

    Raises
    ------
    FileError : the file is one of these; the message says which, and what to do.
    sqlite3.Error : SQLite itself cannot read the file.
    """
    stamp = _stamp(path)
    if _SOUND.get(path) == stamp:
        return
    connection.execute("BEGIN")  # one consistent state, whatever a driver writes meanwhile
    try:
        _check_kind(connection, path)
        _check_structure(connection)
        _check_tables(connection, read_about(connection))
    except _Damaged as fault:
        raise refusal(path, str(fault)) from None
    finally:
        if connection.in_transaction:
            connection.execute("ROLLBACK")
    _SOUND[path] = stamp


def _stamp(path: Path) -> tuple[tuple[int, int, int], ...]:
    """Return a stamp for each non-empty file of a store; the stamp differs if the file was changed."""
    found = []
    for file in (path, path.with_name(path.name + "-wal")):
        with suppress(FileNotFoundError):
            held = os.stat(file)
            found.append((held.st_ino, held.st_size, held.st_mtime_ns))
    return tuple(stamp for stamp in found if stamp[1])


def read_about(connection: sqlite3.Connection) -> dict[str, str]:
    """Return the information that a store holds about itself."""
    return dict(connection.execute("SELECT name, value FROM about"))


def _check_kind(connection: sqlite3.Connection, path: Path) -> None:
    """Refuse databases of other programs, and stores of another version of wingbeat."""
    if connection.execute("PRAGMA application_id").fetchone()[0] != APPLICATION:
        if whole_answers(path):
            raise _Damaged("its header")
        raise FileError(
            f"{str(path)!r} is a database, but not a store of a study; move it away or rename the study"
        )
    about = read_about(connection)
    theirs = f"{about.get('numerical_version')} (wingbeat {about.get('made_by')})"
    if about.get("form") == "1" and "digest" not in about:
        raise FileError(
            f"the store {str(path)!r} is of numerical version {theirs} and has no digests, so damage would not "
            "show; move it away and run the study again, or continue with the wingbeat that made it"
        )
    if about_digest(about) != about.get("digest"):
        raise _Damaged("its own description does not match its digest")
    if about["form"] != FORM or about["numerical_version"] != str(NUMERICAL_VERSION):
        raise FileError(
            f"the store {str(path)!r} is of numerical version {theirs}, but this wingbeat is of version "
            f"{NUMERICAL_VERSION}; old and new results cannot be mixed: move the store away, or continue with the "
            "wingbeat that made it"
        )


def _check_structure(connection: sqlite3.Connection) -> None:
    """Find damage to tables, pages and indices, which the digests of rows do not show."""
    if _schema(connection) != _own_schema():
        raise _Damaged("its tables are not those of a store")
    (told,) = connection.execute("PRAGMA integrity_check(1)").fetchone()
    if told != "ok":
        raise _Damaged(" ".join(str(told).replace("*** in database main ***", "").split()))


def _schema(connection: sqlite3.Connection) -> list[tuple[str, ...]]:
    return sorted(connection.execute("SELECT type, name, tbl_name, COALESCE(sql, '') FROM sqlite_master"))


@functools.cache
def _own_schema() -> list[tuple[str, ...]]:
    with closing(sqlite3.connect(":memory:")) as connection:
        connection.executescript(TABLES)
        return _schema(connection)


def _check_tables(connection: sqlite3.Connection, about: dict[str, str]) -> None:
    """Compare every row with its digest, and every table with the digest of all its rows."""
    found, damaged = Fingerprint(), []
    for row in _rows(connection, "points", "key"):
        if row_digest(row[:-1]) != row[-1]:
            damaged.append(str(row[0])[:8])
        else:
            found = found.add(row[-1])
    expected = Fingerprint.of_text(about.get("points", ""))
    if damaged:
        keys = ", ".join(damaged[:3]) + (", ..." if len(damaged) > 3 else "")
        raise _Damaged(f"{len(damaged)} of {expected.rows} results do not match their digests, key {keys}")
    if found != expected:
        raise _Damaged(f"the {found.rows} results in it are not the {expected.rows} that were written")
    for table in PLAN_TABLES:
        if digest_of(connection, table) != about.get(table, digest_of_nothing()):
            raise _Damaged("the stored points of the study do not match their digest")


def digest_of(connection: sqlite3.Connection, table: str) -> str:
    """Return the digest of a table that a plan determines."""
    return table_digest(_rows(connection, table, PLAN_TABLES[table]))


@functools.cache
def digest_of_nothing() -> str:
    """Return the digest of a table without rows."""
    return table_digest([])


def _rows(connection: sqlite3.Connection, table: str, order: str) -> Iterator[tuple]:
    # If the digest does not depend on the order of the rows, they are read in the order in which they are stored.
    tail = "NOT INDEXED" if table == "points" else f"ORDER BY {order}"
    return connection.execute(f"SELECT * FROM {table} {tail}")
