"""One driver at a time: a lock that the operating system releases when its process ends, even by a crash.

A store's lock is a file beside the store. So every name of the store must lead to the same file: `real_path`
follows symbolic links, and a store with hard links is not written to.
"""

from __future__ import annotations

import errno
import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from wingbeat._base import FileError, system_reason

# How systems say that another process holds a lock; Windows says EACCES or EDEADLK. Any other error means that the
# file system has no locks.
_HELD = (errno.EWOULDBLOCK, errno.EAGAIN, errno.EACCES, errno.EDEADLK)


def real_path(store: str | os.PathLike[str]) -> Path:
    """Return the path of the file that a store's name leads to; SQLite keeps its log beside this file."""
    return Path(os.path.realpath(store))


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
    """The lock of a store, held by this process; made by `only_one`.

    Parameters
    ----------
    store : real path of the store.

    Raises
    ------
    FileError : another process holds it, the folder cannot be written to, or its file system has no locks.
    """

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
        """Take the lock again if its file was deleted.

        Raises
        ------
        FileError : as of `Lock`: meanwhile another process has taken it.
        """
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
    """Hold the lock of a store during a block.

    Parameters
    ----------
    store : real path of the store.

    Raises
    ------
    FileError : as of `Lock`, or the store has several names (hard links).
    """
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
