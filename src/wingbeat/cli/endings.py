"""How the process ends on a signal: at once, with one line of output.

A KeyboardInterrupt would not do. Raised inside a callback of JAX it is printed and forgotten, raised within an
import it shows a traceback, and a compilation keeps it waiting for many seconds.
"""

from __future__ import annotations

import os
import signal
import time
from _thread import allocate_lock, get_ident
from contextlib import suppress

from wingbeat._leftovers import clear_leftovers

TYPE_CHECKING = False  # `typing` takes longer to import than all that must be ready for Ctrl-C
if TYPE_CHECKING:
    from types import FrameType

EXIT_INTERRUPTED = 130  # 128 + SIGINT, as shells report it
EXIT_TERMINATED = 143  # 128 + SIGTERM

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
        _start_watch()


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


def _start_watch() -> None:
    """Start a thread that receives signals, because the main thread receives none while in compiled code."""
    from threading import Thread

    hears, tells = os.pipe()
    os.set_blocking(tells, False)
    signal.set_wakeup_fd(tells, warn_on_full_buffer=False)
    Thread(target=_watch, args=(hears,), name="signals", daemon=True).start()


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
