"""The SQLite file under a study's store: its tables, how it is opened, and its errors in words."""

from __future__ import annotations

import os
import sqlite3
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from wingbeat._base import FileError, WingbeatError, first_line
from wingbeat.studies.pages import whole_answers

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
    """Turn an error in the use of a store's content into a `FileError`: its digests match, but no study wrote it.

    Raises
    ------
    FileError : in place of any error that is neither wingbeat's nor SQLite's.
    """
    try:
        yield
    except (WingbeatError, sqlite3.Error):
        raise
    except Exception as error:  # whatever can be wrong with what somebody wrote into a file
        told, fix = first_line(error)[:200], "move it away, and run the study again"
        raise FileError(f"the store {str(path)!r} holds what no study writes ({told}); {fix}") from None


@contextmanager
def in_words(path: Path) -> Iterator[None]:
    """Turn errors of SQLite into a `FileError` in words.

    Raises
    ------
    FileError : in place of an error of SQLite.
    """
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
