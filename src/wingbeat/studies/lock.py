"""One driver at a time: a lock that the operating system releases when its process ends, even by a crash."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from wingbeat.errors import FileError, system_reason


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
    except OSError:
        return True
    finally:
        os.close(descriptor)
    return False


def _beside(store: Path) -> Path:
    return store.with_name(store.name + ".lock")


@contextmanager
def only_one(store: Path) -> Iterator[None]:
    """Hold the lock of a store during a block.

    Raises
    ------
    FileError : another process holds it, or the folder cannot be written to.
    """
    path = _beside(store)
    while True:
        try:
            descriptor = os.open(path, os.O_RDWR | os.O_CREAT, 0o666)
        except OSError as error:
            reason = system_reason(error)
            fix = "copy the study to a folder that you can write to"
            raise FileError(f"cannot write in the folder of {str(store)!r}: {reason}; {fix}") from None
        try:
            _take(descriptor)
        except OSError:
            os.close(descriptor)
            fix = "wait for it, or look at it with `wingbeat study status`"
            raise FileError(f"another process is running the study of {str(store)!r}; {fix}") from None
        # A process that just ended may have deleted the file between our opening and our locking of it.
        with suppress(OSError):
            if os.path.samestat(os.fstat(descriptor), os.stat(path)):
                break
        os.close(descriptor)
    try:
        yield
    finally:
        with suppress(OSError):
            if os.name != "nt":  # Windows does not delete an open file
                path.unlink()
        os.close(descriptor)
