"""What protects a store: one driver at a time, undamaged files before use, and the same files to the end.

A store's lock is a file beside the store; the operating system releases it when its process ends, even by a crash.
Every name of the store must lead to the same file: a store's path is its real path, beside which SQLite keeps its
log, and a store with hard links is not written to.
"""

from __future__ import annotations

import errno
import functools
import os
import sqlite3
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from pathlib import Path

from wingbeat._base import NUMERICAL_VERSION, FileError, system_reason
from wingbeat.studies.store_file import (
    APPLICATION,
    FORM,
    PAGE,
    TABLES,
    Fingerprint,
    about_digest,
    identity_of,
    in_words,
    is_open_here,
    log_fault,
    refusal,
    row_digest,
    table_digest,
    unused_name,
    whole_answers,
)

# --- one driver at a time ---

# How systems say that another process holds a lock; Windows says EACCES or EDEADLK. Any other error means that the
# file system has no locks.
_HELD = (errno.EWOULDBLOCK, errno.EAGAIN, errno.EACCES, errno.EDEADLK)


def _take(descriptor: int) -> None:
    """Lock a file for this process alone; raise `OSError` if another process holds the lock."""
    if os.name == "nt":
        import msvcrt

        msvcrt.locking(descriptor, msvcrt.LK_NBLCK, 1)  # type: ignore[attr-defined]
    else:
        import fcntl

        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)


def is_locked(store: Path) -> bool:
    """Return whether a process holds the lock of a store; the lock's file may remain from a killed process."""
    try:
        descriptor = os.open(_beside(store), os.O_RDONLY)
    except OSError:  # there is none
        return False
    try:
        _take(descriptor)
    except OSError as error:
        return error.errno in _HELD
    finally:
        os.close(descriptor)
    return False


def _beside(store: Path) -> Path:
    return store.with_name(store.name + ".lock")


class Lock:
    """The lock of a store's real path, held by this process; made by `only_one`."""

    def __init__(self, store: Path) -> None:
        self._store, self._path = store, _beside(store)
        self._descriptor = self._taken()

    def _taken(self) -> int:
        """Return the descriptor of the locked file."""
        while True:
            try:
                descriptor = os.open(self._path, os.O_RDWR | os.O_CREAT, 0o666)
            except OSError as error:
                reason = system_reason(error)
                fix = "copy the study to a folder that you can write to"
                raise FileError(f"cannot write in the folder of {str(self._store)!r}: {reason}; {fix}") from None
            try:
                _take(descriptor)
            except OSError as error:
                os.close(descriptor)
                if error.errno in _HELD:
                    fix = "wait for it, or look at it with `wingbeat study status`"
                    text = f"another process is running the study of {str(self._store)!r}; {fix}"
                else:
                    reason = system_reason(error)
                    text = f"cannot lock the store {str(self._store)!r}: {reason}; keep it on a local disk"
                raise FileError(text) from None
            # Somebody may have deleted the file between our opening and our locking of it.
            if self._is_of(descriptor):
                return descriptor
            os.close(descriptor)

    def _is_of(self, descriptor: int) -> bool:
        with suppress(OSError):
            return os.path.samestat(os.fstat(descriptor), os.stat(self._path))
        return False

    def renew(self) -> None:
        """Take the lock again if its file was deleted."""
        if not self._is_of(self._descriptor):
            fresh = self._taken()
            os.close(self._descriptor)
            self._descriptor = fresh

    def release(self) -> None:
        """Give the lock back and delete its file, but not a file that another process has put in its place."""
        with suppress(OSError):
            if os.name != "nt" and self._is_of(self._descriptor):  # Windows does not delete an open file
                self._path.unlink()
        os.close(self._descriptor)


@contextmanager
def only_one(store: Path) -> Iterator[Lock]:
    """Hold the lock of a store's real path during a block; a store with several names (hard links) is refused."""
    names = 1
    with suppress(OSError):
        names = os.stat(store).st_nlink
    if names > 1:
        # Each name has a log of its own, and SQLite would write two logs into one file.
        fix = "copy the store to a new file, and use the copy"
        raise FileError(f"the store {str(store)!r} has {names} names (hard links), which would damage it; {fix}")
    lock = Lock(store)
    try:
        yield lock
    finally:
        lock.release()


# --- undamaged files before use ---

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

    `mine` says that this process holds the store's lock, so that no other process is writing to the log.
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
        if digest_of(connection, table) != about.get(table, table_digest([])):
            raise _Damaged("the stored points of the study do not match their digest")


def digest_of(connection: sqlite3.Connection, table: str) -> str:
    """Return the digest of a table that a plan determines."""
    return table_digest(_rows(connection, table, PLAN_TABLES[table]))


def _rows(connection: sqlite3.Connection, table: str, order: str) -> Iterator[tuple]:
    # If the digest does not depend on the order of the rows, they are read in the order in which they are stored.
    tail = "NOT INDEXED" if table == "points" else f"ORDER BY {order}"
    return connection.execute(f"SELECT * FROM {table} {tail}")


# --- the same files to the end: others may delete or replace them ---


class Watch:
    """A watch over the files of a store that this process writes to."""

    def __init__(self, path: Path, connection: sqlite3.Connection, lock: Lock | None) -> None:
        self._path, self._connection, self._lock = path, connection, lock
        self._log = path.with_name(path.name + "-wal")
        self._store, self._logged = identity_of(path), identity_of(self._log)

    def check(self) -> None:
        """Keep all results if others have deleted or replaced the store or its log, or taken its lock."""
        name = repr(str(self._path))
        if identity_of(self._path) != self._store:
            aside = unused_name(self._path, "rescued")
            told = f"all results so far are in {str(aside)!r}: rename it to {self._path.name!r}"
            told += " and run the study again"
            try:
                with closing(sqlite3.connect(aside)) as copy:  # of the open file, which has lost its name
                    self._connection.backup(copy)
            except sqlite3.Error as error:
                told = f"no copy can be written beside it ({error}); if you moved it, it holds all results so far"
            raise FileError(f"the store {name} was deleted, moved or replaced while the study ran; {told}")
        if self._logged is not None and identity_of(self._log) != self._logged:
            with in_words(self._path):
                self._connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
            told = "all results so far are in the store; run the study again"
            raise FileError(f"the log of the store {name} was deleted while the study ran; {told}")
        self._logged = self._logged or identity_of(self._log)  # SQLite makes it with the first transaction
        if self._lock is not None:
            try:
                self._lock.renew()
            except FileError as error:
                raise FileError(f"the lock of the store {name} was deleted while the study ran: {error}") from None
