"""The process: how it ends on a signal, its standard streams, and the memory that it needs.

On a signal it ends at once, with one line of output. A KeyboardInterrupt would not do. Raised inside a callback
of JAX it is printed and forgotten, raised within an import it shows a traceback, and a compilation keeps it waiting
for many seconds.
"""

from __future__ import annotations

import io
import os
import signal
import sys
import time
from _thread import allocate_lock, get_ident
from contextlib import suppress

from wingbeat._leftovers import clear_leftovers

TYPE_CHECKING = False  # `typing` takes longer to import than all that must be ready for Ctrl-C
if TYPE_CHECKING:
    from types import FrameType
    from typing import Any

# --- exit codes ---

EXIT_GOOD = 0
EXIT_BAD_INPUT = 2
EXIT_NOT_CERTIFIED = 3
EXIT_SYSTEM = 1  # no memory, or no room for the output
EXIT_BROKEN_PIPE = 141  # 128 + SIGPIPE: the reader, say `head`, had seen enough
EXIT_INTERRUPTED = 130  # 128 + SIGINT, as shells report it
EXIT_TERMINATED = 143  # 128 + SIGTERM

# --- signals ---

_WORDS: dict[int, str] = {signal.SIGINT: "interrupted", signal.SIGTERM: "terminated"}
# Seconds that the main thread has to leave compiled code, and then to clear up, before another thread ends all.
_PATIENCE = 0.5
_CLEARING = 1.0

_ending = allocate_lock()
_ender: int | None = None


def end_on_signals() -> None:
    """Make Ctrl-C and SIGTERM end the process from now on, unless it was started to ignore them."""
    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, _end)
    if signal.getsignal(signal.SIGTERM) is signal.SIG_DFL:
        signal.signal(signal.SIGTERM, _end)
    if os.name == "posix":  # Windows wakes nobody but sockets
        from threading import Thread

        # A thread receives the signals, because the main thread receives none while in compiled code.
        hears, tells = os.pipe()
        os.set_blocking(tells, False)
        signal.set_wakeup_fd(tells, warn_on_full_buffer=False)
        Thread(target=_watch, args=(hears,), name="signals", daemon=True).start()


def _end(number: int, frame: FrameType | None = None) -> None:
    """Delete temporary files and end the process; the first thread that calls does it, the others wait."""
    global _ender
    if not _ending.acquire(blocking=False):
        if _ender == get_ident():  # a second signal in the midst of it
            os._exit(128 + number)
        time.sleep(60)
    _ender = get_ident()
    clear_leftovers()
    with suppress(OSError):
        os.write(2, f"error: {_WORDS[number]}\n".encode())
    os._exit(128 + number)


def _watch(hears: int) -> None:
    while told := os.read(hears, 1):
        number = told[0]
        if number not in _WORDS or signal.getsignal(number) is not _end:
            continue  # a study or the explorer, which end in their own order
        time.sleep(_PATIENCE)
        if _ending.locked():
            time.sleep(_CLEARING)
            os._exit(128 + number)
        _end(number)


# --- streams: a failed write to standard output is an error, one to standard error is ignored ---


class StdoutError(Exception):
    """Standard output cannot be written; `number` is the errno. Not an OSError: rich catches some of these."""

    def __init__(self, error: OSError) -> None:
        self.number = error.errno
        super().__init__((error.strerror or str(error)).lower())


class _Stdout(io.FileIO):
    def write(self, data: Any) -> int | None:
        try:
            return super().write(data)
        except OSError as error:
            raise StdoutError(error) from None


class _Stderr(io.FileIO):
    def write(self, data: Any) -> int | None:
        try:
            return super().write(data)
        except OSError:  # there is nowhere to say so
            return len(data)


def prepare_streams() -> None:
    """Set up the standard streams of the process, even if it was started with some of them closed."""
    if os.name != "posix":  # a console of Windows is no file
        for stream in (sys.stdout, sys.stderr):
            if isinstance(stream, io.TextIOWrapper):
                stream.reconfigure(errors="backslashreplace")
        return
    # Without this, the next file that is opened would become standard output. A stand-in opened the wrong way round
    # refuses reading or writing, as a closed stream does.
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_WRONLY if number == 0 else os.O_RDONLY)
    sys.stdout = _stream(sys.stdout, _Stdout(1, "w", closefd=False))
    sys.stderr = _stream(sys.stderr, _Stderr(2, "w", closefd=False), at_once=True)


def _stream(before: Any, raw: io.FileIO, at_once: bool = False) -> io.TextIOWrapper:
    """Return a stream like `before` that writes with `raw`; characters that its encoding lacks become escapes."""
    return io.TextIOWrapper(
        io.BufferedWriter(raw),
        encoding=getattr(before, "encoding", "utf-8"),
        errors="backslashreplace",
        line_buffering=at_once or raw.isatty() or getattr(before, "write_through", False),
    )


def drop_stdout() -> None:
    """Redirect standard output to the null device, so that the flush at exit does not fail again."""
    with suppress(OSError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)


# --- memory: checked before a command starts, because the compiler ends the process if it gets none ---

# Address space [bytes] of a solver: one orbit took 1.96 GB on two cores with an empty cache; with a full one,
# 1.84 GB on two cores and 1.65 GB on one. Most of it is set aside for threads. With 1.6 GB on two cores it aborts.
_SOLVER = 1_700_000_000
_SOLVER_PER_CORE = 200_000_000
# Address space of `wingbeat species`, which solves nothing.
_READER = 500_000_000


def memory_shortage(command: str) -> str | None:
    """Return the reason why a command cannot run within the address-space limit (``ulimit -v``), or None."""
    try:
        from resource import RLIM_INFINITY, RLIMIT_AS, getrlimit
    except ImportError:  # not on Windows
        return None
    from wingbeat._workers.tuning import core_count

    limit = getrlimit(RLIMIT_AS)[0]
    cores = core_count()
    need = _READER if command == "species" else _SOLVER + _SOLVER_PER_CORE * cores
    if limit == RLIM_INFINITY or limit >= need:
        return None
    return (
        f"memory is limited to {limit / 1e9:.2g} GB of address space, and {command} needs {need / 1e9:.2g} GB on "
        f"{cores} cores; raise the limit with `ulimit -v {-(-need // 1024)}`"
    )
