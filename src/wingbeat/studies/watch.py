"""Whether the files of an open store are still the ones that were opened; others may delete or replace them."""

from __future__ import annotations

import sqlite3
from contextlib import closing
from pathlib import Path

from wingbeat._base import FileError
from wingbeat.studies.database import identity_of, in_words, unused_name
from wingbeat.studies.lock import Lock


class Watch:
    """A watch over the files of a store that this process writes to.

    Parameters
    ----------
    path : of the store.
    connection : to it; it is still of use if the store's name is gone.
    lock : the store's lock, if this process holds it.
    """

    def __init__(self, path: Path, connection: sqlite3.Connection, lock: Lock | None) -> None:
        self._path, self._connection, self._lock = path, connection, lock
        self._log = path.with_name(path.name + "-wal")
        self._store, self._logged = identity_of(path), identity_of(self._log)

    def check(self) -> None:
        """Keep all results if others have deleted or replaced the store or its log, or taken its lock.

        Raises
        ------
        FileError : they have; the message says where the results are.
        """
        name = repr(str(self._path))
        if identity_of(self._path) != self._store:
            what = "was deleted, moved or replaced while the study ran"
            raise FileError(f"the store {name} {what}; {self._rescue()}")
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

    def _rescue(self) -> str:
        """Copy the store from the open file, which has lost its name; return where the results are."""
        aside = unused_name(self._path, "rescued")
        try:
            with closing(sqlite3.connect(aside)) as copy:
                self._connection.backup(copy)
        except sqlite3.Error as error:
            return f"no copy can be written beside it ({error}); if you moved it, it holds all results so far"
        return f"all results so far are in {str(aside)!r}: rename it to {self._path.name!r} and run the study again"
