"""One worker process as its owner sees it: started, given a job, listened to, ended."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

from wingbeat.app.worker import NO_MEMORY

__all__ = ["WorkerProcess"]

# Seconds in which a process that has closed its pipe may end by itself, so that its own exit code is told.
_LAST_BREATH = 2.0

# How the system and the C++ libraries end a process that has no memory left, among other reasons.
_WITHOUT_MEMORY = (signal.SIGABRT, signal.SIGKILL)


class WorkerProcess:
    """A fresh Python that runs `wingbeat.app.worker`.

    Parameters
    ----------
    work : what it does with a job, ``MODULE:FUNCTION``.
    """

    def __init__(self, work: str) -> None:
        # The libraries keep the threads they have on the command line: with others they add up in another order,
        # and the tenth digit of an answer would not be the command line's.
        environment = dict(os.environ)
        # The package that serves is the one that works, wherever it was imported from.
        home = str(Path(__file__).resolve().parents[2])
        environment["PYTHONPATH"] = os.pathsep.join([home, *filter(None, [environment.get("PYTHONPATH")])])
        self._process = subprocess.Popen(
            [sys.executable, "-P", "-m", "wingbeat.app.worker", work],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=environment,
            start_new_session=True,  # Ctrl-C is for the server, which then ends its workers
        )
        self._lock = threading.Lock()

    @property
    def pid(self) -> int:
        """The number of the process."""
        return self._process.pid

    @property
    def alive(self) -> bool:
        """Whether the process runs."""
        return self._process.poll() is None

    def send(self, what: dict[str, Any]) -> None:
        """Hand over a line; a process that has died says so by the end of what it tells."""
        assert self._process.stdin is not None
        with self._lock, suppress(OSError, ValueError):
            self._process.stdin.write(json.dumps(what).encode() + b"\n")
            self._process.stdin.flush()

    def lines(self) -> Iterator[dict[str, Any]]:
        """Yield what the process tells, until it ends."""
        assert self._process.stdout is not None
        while (line := self._process.stdout.readline()).endswith(b"\n"):
            yield json.loads(line)

    def kill(self) -> None:
        """End the process now, whatever it does; safe to call twice."""
        with suppress(OSError):
            self._process.kill()

    def bury(self) -> str:
        """Close the pipes of a process that is ending, or end it, and return how it ended."""
        try:
            code = self._process.wait(_LAST_BREATH)
        except subprocess.TimeoutExpired:
            self.kill()
            code = self._process.wait()
        for pipe in (self._process.stdin, self._process.stdout):
            with self._lock, suppress(OSError):
                assert pipe is not None
                pipe.close()
        return _ending(code)


def _ending(code: int) -> str:
    """Return in words how a process ended, with the exit code that a shell would tell."""
    if code == NO_MEMORY:
        return f"exit code {code}: out of memory"
    if code >= 0:
        return f"exit code {code}"
    name = f"signal {-code}"
    with suppress(ValueError):
        name = signal.Signals(-code).name
    return f"{name}, exit code {128 - code}" + (", as when memory runs out" if -code in _WITHOUT_MEMORY else "")
