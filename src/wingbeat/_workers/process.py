"""One worker process as its owner sees it: started, given requests, listened to, ended."""

from __future__ import annotations

import json
import os
import pickle
import signal
import subprocess
import sys
import threading
from collections.abc import Callable, Mapping
from contextlib import ExitStack, suppress
from typing import Any

from wingbeat._leftovers import Leftover
from wingbeat._workers.main import NO_MEMORY, Message

# Not `-m`, which would load the module twice: under its own name and as `__main__`.
_PROGRAM = "from wingbeat._workers.main import main; main()"
# A process that is about to end has this many seconds to end by itself, so that its exit code is its own.
_LEAVING = 2.0
# Signals with which the system and the C++ libraries end a process that has no memory left, or for other reasons.
_WITHOUT_MEMORY = (signal.SIGABRT, *([signal.SIGKILL] if hasattr(signal, "SIGKILL") else []))


class WorkerProcess:
    """A new Python process that carries out requests in order; it ends when its owner ends, for any reason.

    Parameters
    ----------
    work : the function that carries out a request, as ``MODULE:FUNCTION``; called with the request and a
        `main.Context`.
    hear : called with each `Message`, in a thread of its own; finally with None when the process has ended.
    core : the core to which the process is pinned; None for any.
    silence : the process ends itself if it works on a request and sends no message for this many seconds; None for
        no limit.
    memory : resident memory [bytes] beyond which the process ends after a request, because compiled programs
        accumulate; None for any.
    environment : environment variables that differ from those of this process.
    """

    def __init__(
        self,
        work: str,
        hear: Callable[[Message | None], None],
        *,
        core: int | None = None,
        silence: float | None = None,
        memory: int | None = None,
        environment: Mapping[str, str] | None = None,
    ) -> None:
        settings = {"work": work, "core": core, "silence": silence, "memory": memory}
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
