"""What a worker process runs: it reads requests from its pipe, does one after the other, and says how each ended.

When the pipe closes, the process ends at once, whatever it is doing, because nobody would receive its answer.
"""

from __future__ import annotations

import faulthandler
import importlib
import json
import os
import pickle
import queue
import signal
import sys
import threading
import traceback
from collections.abc import Callable
from typing import Any, NamedTuple

from wingbeat._workers.affinity import pin_to
from wingbeat._workers.gc import collect_seldom

# The exit code of a process that was refused memory: ENOMEM, as systems number their errors.
NO_MEMORY = 12
# How XLA, threads and the system say that there is no memory left, where Python does not raise a MemoryError.
_NO_MEMORY_WORDS = ("RESOURCE_EXHAUSTED", "can't start new thread", "Cannot allocate memory")


class Message(NamedTuple):
    """A message from a worker process.

    Parameters
    ----------
    kind : ``ready`` at first; for each request ``started``, any number of ``progress``, and an ending: ``done``
        (value: the answer), ``stopped`` or ``failed`` (value: the exception). ``leaving`` comes before the ending
        of the last request of a process that exceeds its memory limit.
    value : see `kind`.
    """

    kind: str
    value: Any = None


class StoppedError(Exception):
    """Raised because the request is no longer wanted."""


class Context:
    """The second argument of a work function: it reports progress, and says whether the request is still wanted.

    Parameters
    ----------
    report : sends a value to the process that made the request, in a ``progress`` message.
    stopped : returns whether the request is no longer wanted.
    """

    def __init__(self, report: Callable[[Any], None], stopped: Callable[[], bool]) -> None:
        self.report, self._stopped = report, stopped

    def check(self) -> None:
        """Raise `StoppedError` if the request is no longer wanted."""
        if self._stopped():
            raise StoppedError

    def progress(self, done: int, total: int) -> None:
        """Report the progress; raise `StoppedError` if the request is no longer wanted."""
        self.check()
        self.report([done, total])


class _Requests:
    """The requests to this process. A thread reads them as pickles of ``(what,)``; None stops all earlier ones."""

    def __init__(self) -> None:
        self._waiting: queue.SimpleQueue[tuple[Any]] = queue.SimpleQueue()
        self._read = self._taken = self._stopped = 0
        threading.Thread(target=self._listen, daemon=True).start()

    def take(self) -> Any:
        """Wait for the next request and return it."""
        (what,) = self._waiting.get()
        self._taken += 1
        return what

    def stopped(self) -> bool:
        """Return whether the request that was taken last is no longer wanted."""
        return self._taken <= self._stopped

    def _listen(self) -> None:
        code = 1  # if this thread fails, the process must end too, because nobody could end it
        try:
            # Not through sys.stdin: a process that ends while a thread reads from that aborts with exit code 134.
            with open(os.dup(0), "rb") as pipe:
                while True:
                    request = pickle.load(pipe)
                    if request is None:
                        self._stopped = self._read
                    else:
                        self._read += 1
                        self._waiting.put(request)
        except EOFError:
            code = 0
        finally:
            os._exit(code)


class _Speaker:
    """Writes messages to the original stdout; from now on, prints of the work go to stderr.

    Parameters
    ----------
    silence : the process ends if it has work and sends no message for this many seconds; None for no limit. A timer
        outside Python ends it, even if the process hangs and no Python thread runs.
    """

    def __init__(self, silence: float | None) -> None:
        self._silence = silence
        self._pipe = os.fdopen(os.dup(1), "wb")
        self._lock = threading.Lock()
        self._nowhere = open(os.devnull, "w")  # noqa: SIM115  # as long as the process
        os.dup2(2, 1)

    def say(self, kind: str, value: Any = None) -> None:
        """Send a message while the work goes on."""
        if self._silence is not None:
            faulthandler.dump_traceback_later(self._silence, exit=True, file=self._nowhere)
        self.send(pickle.dumps(Message(kind, value)))

    def rest(self, pickled: bytes) -> None:
        """Send the message that ends the work."""
        faulthandler.cancel_dump_traceback_later()
        self.send(pickled)

    def send(self, pickled: bytes) -> None:
        """Send a message."""
        try:
            with self._lock:
                self._pipe.write(pickled)
                self._pipe.flush()
        except OSError:  # nobody listens any more
            os._exit(0)


def main() -> None:
    """Work until the pipe closes; the program's argument holds the settings of `process.WorkerProcess`."""
    settings = json.loads(sys.argv[1])
    pin_to(settings["core"])  # before there are threads, which inherit it
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for whoever started this process
    collect_seldom()
    requests, speaker = _Requests(), _Speaker(settings["silence"])
    module, _, function = settings["work"].partition(":")
    work = getattr(importlib.import_module(module), function)
    context = Context(lambda value: speaker.say("progress", value), requests.stopped)
    speaker.send(pickle.dumps(Message("ready")))
    while True:
        what = requests.take()
        speaker.say("started")
        ending = _do(work, what, context)
        if leaves := settings["memory"] is not None and _memory() > settings["memory"]:
            speaker.say("leaving")
        speaker.rest(ending)
        if leaves:
            os._exit(0)


def _do(work: Callable[[Any, Context], Any], what: Any, context: Context) -> bytes:
    """Carry out a request, and return the pickled message that says how it ended."""
    try:
        return pickle.dumps(Message("done", work(what, context)))
    except StoppedError:
        return pickle.dumps(Message("stopped"))
    except Exception as error:
        if isinstance(error, MemoryError) or any(words in str(error) for words in _NO_MEMORY_WORDS):
            os._exit(NO_MEMORY)  # what is left of the process could not be relied on
        return _pickled_failure(error)


def _pickled_failure(error: Exception) -> bytes:
    """Return the pickled message of a failure: the exception and traceback, or text if it cannot be pickled."""
    error.add_note(f"in a worker process:\n{traceback.format_exc()}")
    try:
        pickled = pickle.dumps(Message("failed", error))
        pickle.loads(pickled)
    except Exception:
        told = RuntimeError(f"{type(error).__name__}: {error}")
        told.__notes__ = error.__notes__
        return pickle.dumps(Message("failed", told))
    return pickled


def _memory() -> int:
    """Return the resident memory [bytes]; 0 if the system does not say."""
    try:
        with open("/proc/self/statm", "rb") as numbers:
            return int(numbers.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, ValueError, IndexError):
        return 0
