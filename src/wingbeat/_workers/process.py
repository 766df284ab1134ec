"""A worker process: what it runs, and how its owner starts it, sends it requests, listens to it and ends it.

It reads requests from its pipe, does one after the other, and says how each ended. When the pipe closes, the
process ends at once, whatever it is doing, because nobody would receive its answer.
"""

from __future__ import annotations

import faulthandler
import json
import os
import pickle
import pkgutil
import queue
import signal
import subprocess
import sys
import threading
import traceback
from collections.abc import Callable, Mapping
from contextlib import ExitStack, suppress
from typing import Any, NamedTuple

from wingbeat._leftovers import Leftover
from wingbeat._workers.tuning import tune_process

# The exit code of a process that was refused memory: ENOMEM, as systems number their errors.
NO_MEMORY = 12
# How XLA, threads and the system say that there is no memory left, where Python does not raise a MemoryError.
_NO_MEMORY_WORDS = ("RESOURCE_EXHAUSTED", "can't start new thread", "Cannot allocate memory")


class Message(NamedTuple):
    """A message from a worker process.

    ``ready`` at first; for each request ``started``, any number of ``progress``, and an ending: ``done`` (value:
    the answer), ``stopped`` or ``failed`` (value: the exception). ``leaving`` comes before the ending of the last
    request of a process that exceeds its memory limit.
    """

    kind: str
    value: Any = None


class StoppedError(Exception):
    """Raised because the request is no longer wanted."""


class Context:
    """The second argument of a work function: it reports progress, and says whether the request is still wanted.

    `report` sends a value to the process that made the request, in a ``progress`` message.
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

    The process ends if it has work and sends no message for `silence` seconds. A timer outside Python ends it, even
    if the process hangs and no Python thread runs.
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

    def send(self, pickled: bytes) -> None:
        """Send a message."""
        try:
            with self._lock:
                self._pipe.write(pickled)
                self._pipe.flush()
        except OSError:  # nobody listens any more
            os._exit(0)


def main() -> None:
    """Work until the pipe closes; the program's argument holds the settings of `WorkerProcess`."""
    settings = json.loads(sys.argv[1])
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is for whoever started this process
    tune_process()
    requests, speaker = _Requests(), _Speaker(settings["silence"])
    work = pkgutil.resolve_name(settings["work"])
    context = Context(lambda value: speaker.say("progress", value), requests.stopped)
    speaker.send(pickle.dumps(Message("ready")))
    while True:
        what = requests.take()
        speaker.say("started")
        ending = _do(work, what, context)
        if leaves := settings["memory"] is not None and _memory() > settings["memory"]:
            speaker.say("leaving")
        faulthandler.cancel_dump_traceback_later()
        speaker.send(ending)
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
        error.add_note(f"in a worker process:\n{traceback.format_exc()}")
        try:
            pickled = pickle.dumps(Message("failed", error))
            pickle.loads(pickled)
            return pickled
        except Exception:  # the exception cannot be pickled: send its text
            told = RuntimeError(f"{type(error).__name__}: {error}")
            told.__notes__ = error.__notes__
            return pickle.dumps(Message("failed", told))


def _memory() -> int:
    """Return the resident memory [bytes]; 0 if the system does not say."""
    try:
        with open("/proc/self/statm", "rb") as numbers:
            return int(numbers.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")
    except (OSError, ValueError, IndexError):
        return 0


# --- as its owner sees it ---

# Not `-m`, which would load the module twice: under its own name and as `__main__`.
_PROGRAM = "from wingbeat._workers.process import main; main()"
# A process that is about to end has this many seconds to end by itself, so that its exit code is its own.
_LEAVING = 2.0
# Signals with which the system and the C++ libraries end a process that has no memory left, or for other reasons.
_WITHOUT_MEMORY = (signal.SIGABRT, *([signal.SIGKILL] if hasattr(signal, "SIGKILL") else []))


class WorkerProcess:
    """A new Python process that carries out requests in order; it ends when its owner ends, for any reason."""

    def __init__(
        self,
        work: str,  # the function that carries out a request, as MODULE:FUNCTION; called with it and a `Context`
        hear: Callable[[Message | None], None],  # called in a thread of its own, with None when the process ended
        *,
        silence: float | None = None,  # it ends if it works on a request and sends no message for so long [s]
        memory: int | None = None,  # resident memory [bytes] beyond which it ends after a request: programs pile up
        environment: Mapping[str, str] | None = None,  # variables that differ from those of this process
    ) -> None:
        settings = {"work": work, "silence": silence, "memory": memory}
        # What this process imports is what the worker imports, wherever it comes from.
        paths = os.pathsep.join(map(str, sys.path))
        self._process = subprocess.Popen(
            [sys.executable, "-P", "-c", _PROGRAM, json.dumps(settings)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env={**os.environ, "PYTHONPATH": paths, **(environment or {})},
            start_new_session=True,  # Ctrl-C is for this process, which then ends its workers
        )
        self._lock = threading.Lock()
        self._open = ExitStack()
        self._open.enter_context(Leftover(self.kill))
        self._listener = threading.Thread(target=self._listen, args=(hear,), daemon=True)
        self._listener.start()

    @property
    def pid(self) -> int:
        """The number of the process."""
        return self._process.pid

    @property
    def alive(self) -> bool:
        """Whether the process runs."""
        return self._process.poll() is None

    def request(self, what: Any) -> None:
        """Send a picklable request; if the process has died, `hear` is called with None."""
        self._send((what,))

    def stop(self) -> None:
        """Tell the process that its requests are no longer wanted; work that checks for this ends."""
        self._send(None)

    def kill(self) -> None:
        """End the process immediately; a second call does nothing."""
        with suppress(OSError):
            self._process.kill()

    def bury(self) -> str:
        """Wait briefly for the process to end, or end it; return in words how it ended."""
        try:
            code = self._process.wait(_LEAVING)
        except subprocess.TimeoutExpired:
            self.kill()
            code = self._process.wait()
        self._open.close()
        assert self._process.stdin is not None
        with self._lock, suppress(OSError):
            self._process.stdin.close()
        self._listener.join(1.0)
        return _ending(code)

    def _send(self, request: tuple[Any] | None) -> None:
        pickled = pickle.dumps(request)
        assert self._process.stdin is not None
        with self._lock, suppress(OSError, ValueError):  # it has died, or was buried
            self._process.stdin.write(pickled)
            self._process.stdin.flush()

    def _listen(self, hear: Callable[[Message | None], None]) -> None:
        assert self._process.stdout is not None
        try:
            with self._process.stdout as pipe:
                while True:
                    hear(pickle.load(pipe))
        except (EOFError, OSError, pickle.UnpicklingError):  # the end, also amid a message
            pass
        finally:
            hear(None)


def _ending(code: int) -> str:
    """Return in words how a process ended, with the exit code that a shell would show."""
    if code == NO_MEMORY:
        return f"exit code {code}: out of memory"
    if code >= 0:
        return f"exit code {code}"
    name = f"signal {-code}"
    with suppress(ValueError):
        name = signal.Signals(-code).name
    return f"{name}, exit code {128 - code}" + (", as when memory runs out" if -code in _WITHOUT_MEMORY else "")
