"""JAX as the package uses it: with float64, under settings of its own, and with its programs kept on disk.

A program that is read from disk is executed. So it is used only if the user wrote its file and the file is
undamaged: a changed bit in machine code gives wrong numbers or ends the process. Otherwise it is made again.
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
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import ParamSpec, TypeVar

import jax
import jax.numpy as jnp  # noqa: F401  # who takes it from here has the settings

from wingbeat._base.errors import Fault, FileError, InvalidInputError, system_reason
from wingbeat._base.files import write_atomically
from wingbeat._jax.private import GUARDS, OWN, chosen_platforms, replace_file_cache, trace_state_clean

T = TypeVar("T")
P = ParamSpec("P")


def _configure() -> None:
    # With this flag, XLA on CPU compiles a loop of small arrays into one function instead of some 20 calls per
    # iteration: a march takes a third of the time. JAX reads the flag when it first compiles. If JAX has already
    # compiled something, marches are slower.
    flags = os.environ.get("XLA_FLAGS", "")
    if "xla_backend_extra_options" not in flags:
        loops = "--xla_backend_extra_options=xla_cpu_small_while_loop_byte_threshold=100000000"
        os.environ["XLA_FLAGS"] = f"{flags} {loops}".strip()
    jax.config.update("jax_enable_x64", True)
    # Each thread computes its own results. Otherwise searches in threads would wait for one another's results.
    jax.config.update("jax_cpu_enable_async_dispatch", False)
    if getattr(jax.config, "jax_compilation_cache_dir", None) is not None or (folder := program_folder()) is None:
        return
    replace_file_cache(str(folder), _Checked(folder))
    jax.config.update("jax_compilation_cache_dir", str(folder))
    # XLA would read its own files there without a check, and they would be useless in a folder that has moved.
    jax.config.update("jax_persistent_cache_enable_xla_caches", "none")
    jax.config.update("jax_persistent_cache_min_compile_time_secs", 0.0)
    jax.config.update("jax_persistent_cache_min_entry_size_bytes", 0)


class _Checked:
    """JAX's cache of compiled programs, whose files are checked here, because JAX would run any file."""

    def __init__(self, folder: Path) -> None:
        self._path = folder  # which JAX names in messages

    def get(self, key: str) -> bytes | None:
        """Return the compiled program of this key; None if its file is missing, damaged, or another user's."""
        return kept_program(f"compiled-{key}")

    def put(self, key: str, value: bytes) -> None:
        """Store a compiled program under this key."""
        keep_program(f"compiled-{key}", value)


@functools.cache
def _start() -> None:
    """Start JAX's platform, or say in words that it cannot be started."""
    try:
        jax.default_backend()
    except (AssertionError, RuntimeError) as error:
        reason, fix = str(error).split("\n")[0] or "this JAX does not know it", "set JAX_PLATFORMS=cpu"
        fault = Fault("jax_platforms", chosen_platforms(), f"cannot be started: {reason}", fix)
        raise InvalidInputError([fault]) from None


@contextmanager
def own_settings() -> Iterator[None]:
    """Compute under the package's settings of JAX in a block, in this thread; then those of the host apply."""
    _start()
    if all(setting.value == own for setting, own in OWN) and not any(guard.value for guard in GUARDS):
        yield  # the host has changed nothing: 2 us, otherwise 40 us
        return
    with ExitStack() as stack:
        for setting, own in OWN:
            stack.enter_context(setting(own))
        for guard in GUARDS:
            stack.enter_context(guard("allow"))
        yield


def in_own_settings(function: Callable[P, T]) -> Callable[P, T]:
    """Return a function that computes under the package's settings of JAX, whatever those of the host are."""

    @functools.wraps(function)
    def settled(*args: P.args, **named: P.kwargs) -> T:
        if not trace_state_clean():  # a transformation of the host's, whose arguments are tracers
            return function(*args, **named)
        with own_settings():
            return function(*args, **named)

    return settled


# --- programs on disk, in a folder that belongs to the user, each with a digest ---

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
    """Return the user's cache folder for wingbeat, or ``WINGBEAT_CACHE``; raise if there is no home folder."""
    if chosen := os.environ.get("WINGBEAT_CACHE"):
        return Path(chosen)
    return Path(os.environ.get("XDG_CACHE_HOME") or "~/.cache").expanduser() / "wingbeat"


def program_folder() -> Path | None:
    """Return the folder of programs, which no other user can write to; None if it cannot be made."""
    try:
        user = os.geteuid() if hasattr(os, "geteuid") else 0
        return _private(cache_folder() / f"programs-{user}")
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
    """Delete programs that were not used for long, then those used longest ago until the rest is small enough."""
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
        return _without(f"cannot make the folder {str(folder)!r}: {system_reason(error)}")
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


_configure()
