"""Programs stored on disk, in a folder that belongs to the user, each with a digest.

What is read here is executed. So a program is used only if the user wrote its file and the file is undamaged: a
changed bit in machine code gives wrong numbers or ends the process. Otherwise the program is made again.
"""

from __future__ import annotations

import functools
import hashlib
import hmac
import itertools
import logging
import os
import re
import secrets
import stat
import time
from contextlib import suppress
from pathlib import Path

from wingbeat._base.errors import FileError, system_reason
from wingbeat._base.files import write_atomically

# How long a program is kept without being used [s], and how large all programs together may be [bytes]. The 25
# programs of one orbit take 1.7 MB, those of all commands and tests with the changes of some months 98 MB in 2268
# files. A new version of wingbeat, JAX or Python makes all of them anew and never uses the old ones again. To look
# through 2268 files takes 10 to 20 ms, as long as it takes to compile the smallest program.
KEPT_SECONDS = 90 * 86400
KEPT_BYTES = 512 << 20
# A use is noted once a day, so that reading a program seldom writes. The folder is looked through when a process
# writes its first program, and after so many more.
_NOTED_SECONDS = 86400
_LOOKED = 100
# Names of programs, and of what `write_atomically` leaves of one if its process is killed.
_OWN_NAME = re.compile(r"(traced|compiled)-.*|(?P<rest>\.[0-9a-f]{12}\.part)")
_written = itertools.count()
_MAGIC = b"wingbeat program 1\n"
_DIGEST = 32  # bytes
_OTHERS_WRITE = stat.S_IWGRP | stat.S_IWOTH
_OPENING = os.O_RDONLY | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0)


def cache_folder() -> Path:
    """Return the user's cache folder for wingbeat (``WINGBEAT_CACHE`` overrides it).

    Raises
    ------
    RuntimeError : the user has no home folder.
    """
    if chosen := os.environ.get("WINGBEAT_CACHE"):
        return Path(chosen)
    return Path(os.environ.get("XDG_CACHE_HOME") or "~/.cache").expanduser() / "wingbeat"


def program_folder() -> Path | None:
    """Return the folder of programs, which no other user can write to; None if it cannot be made."""
    try:
        return _private(cache_folder() / f"programs-{_user()}")
    except RuntimeError as error:
        return _without(str(error))


def kept_program(name: str) -> bytes | None:
    """Return the program kept under a name; None if it is missing, damaged, or written by another user."""
    folder = program_folder()
    if folder is None:
        return None
    try:
        with open(os.open(folder / name, _OPENING), "rb") as file:
            found = os.fstat(file.fileno())
            if not stat.S_ISREG(found.st_mode) or not _is_own(found):
                return None
            content = file.read()
            if found.st_mtime < time.time() - _NOTED_SECONDS:
                with suppress(OSError):
                    os.utime(folder / name)
    except (OSError, ValueError):
        return None
    begin = len(_MAGIC) + _DIGEST
    program = content[begin:]
    whole = hmac.compare_digest(content[:begin], _MAGIC + _digest(name, program))
    return program if whole else None


def keep_program(name: str, program: bytes) -> None:
    """Keep a program under a name; if it cannot be written, it is compiled again next time."""
    folder = program_folder()
    if folder is not None:
        with suppress(FileError, OSError):
            write_atomically(folder / name, _MAGIC + _digest(name, program) + program)
            if next(_written) % _LOOKED == 0:
                _prune(folder)


def _prune(folder: Path) -> None:
    """Delete programs that were not used for long, and then those used longest ago until the rest is small enough.

    A process that looks for a deleted program makes it again; one that is reading it has it to its end.
    """
    found, now, total = [], time.time(), 0
    with os.scandir(folder) as entries:
        for entry in entries:
            with suppress(OSError):  # another process has deleted it
                held = entry.stat(follow_symlinks=False)
                if (name := _OWN_NAME.fullmatch(entry.name)) and stat.S_ISREG(held.st_mode) and _is_own(held):
                    found.append((held.st_mtime, held.st_size, entry.path, name["rest"]))
    for used, size, path, rest in sorted(found, reverse=True):
        total += size
        if now - used > (_NOTED_SECONDS if rest else KEPT_SECONDS) or total > KEPT_BYTES:
            with suppress(OSError):  # in use, on Windows
                os.unlink(path)


def _digest(name: str, program: bytes) -> bytes:
    """Return a digest of a program and its name, so that a renamed file does not match."""
    digest = hashlib.blake2b(name.encode() + b"\0", digest_size=_DIGEST)
    digest.update(program)
    return digest.digest()


def _user() -> int:
    return os.geteuid() if hasattr(os, "geteuid") else 0


def _is_own(found: os.stat_result) -> bool:
    return not hasattr(os, "geteuid") or found.st_uid == os.geteuid()


@functools.cache
def _private(folder: Path) -> Path | None:
    """Return the folder, created if missing; None if it cannot be made or belongs to another user."""
    try:
        folder.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        _make(folder)
        found = os.lstat(folder)
        if not stat.S_ISDIR(found.st_mode):
            return _without(f"{str(folder)!r} is not a folder")
        if not _is_own(found):
            return _without(f"{str(folder)!r} belongs to another user")
        if os.name == "posix" and found.st_mode & _OTHERS_WRITE:
            # Anyone may have put anything there.
            folder.rename(folder.with_name(f"{folder.name}-not-private-{secrets.token_hex(4)}"))
            _make(folder)
        elif os.name == "posix" and stat.S_IMODE(found.st_mode) & 0o077:
            folder.chmod(0o700)
    except (OSError, ValueError) as error:
        reason = system_reason(error)
        return _without(f"cannot make the folder {str(folder)!r}: {reason}")
    return folder


def _make(folder: Path) -> None:
    with suppress(FileExistsError):
        folder.mkdir(mode=0o700)


@functools.cache
def _without(reason: str) -> None:
    """Log one warning that says why programs are not kept; Python prints it if no logging is set up."""
    logging.getLogger("wingbeat").warning(
        "warning: compiled programs are not kept (%s), so every start takes longer; set WINGBEAT_CACHE to a folder "
        "of your own",
        reason,
    )
