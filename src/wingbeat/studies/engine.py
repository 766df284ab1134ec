"""Where the work is done: an engine takes batches of units and says how each ended. Local processes are one."""

from __future__ import annotations

import json
import os
import queue
import subprocess
import sys
import threading
import time
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple, Protocol

from wingbeat.errors import FileError
from wingbeat.studies.units import Outcome, Unit
from wingbeat.workers.affinity import cores_of

__all__ = ["Ended", "Engine", "LocalProcesses", "pack"]

# What a worker is told of threads: as many processes as there are cores, each with one.
_ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "VECLIB_MAXIMUM_THREADS")
# A worker that dies so soon after its start, before it said anything, is no fault of a point.
_STARTS = 3
# Seconds that a process whose pipe has closed gets to end by itself, so that its exit code is its own.
_LEAVING = 2.0


class Ended(NamedTuple):
    """How a batch ended.

    Parameters
    ----------
    batch : its number.
    outcomes : of its points, in their order; of a batch that was lost, those that were told before.
    worker : the name of who did it.
    lost : None, or how the worker ended: ``crashed`` or ``timeout``.
    text : what is known of that.
    told : whether a worker tells each point as it is done, so that the first one untold is the one to blame.
    """

    batch: int
    outcomes: list[Outcome]
    worker: str
    lost: str | None = None
    text: str = ""
    told: bool = True


class Engine(Protocol):
    """What the driver asks of an engine; the driver alone decides what is done, again, or given up."""

    @property
    def free(self) -> int:
        """How many more batches it takes now."""
        ...

    @property
    def workers(self) -> int:
        """How many batches it works on at a time."""
        ...

    def submit(self, batch: int, units: list[Unit]) -> None:
        """Take a batch; its number comes back with how it ended."""
        ...

    def wait(self, seconds: float) -> Ended | None:
        """Return a batch that ended, or None after so many seconds."""
        ...

    def close(self) -> None:
        """End every worker now, whatever it does."""
        ...


def pack(units: list[Unit]) -> dict[str, Any]:
    """Return units as a dictionary fit for JSON, each recipe once."""
    recipes = list(dict.fromkeys(unit.recipe for unit in units))
    places = {recipe: i for i, recipe in enumerate(recipes)}
    return {"recipes": recipes, "units": [[places[u.recipe], u.tasks, u.skip] for u in units]}


@dataclass
class _Worker:
    """A process, what it works on, and when it was last heard of."""

    process: subprocess.Popen[bytes]
    name: str
    listener: threading.Thread
    core: int | None
    batch: int | None = None
    outcomes: list[Outcome] = field(default_factory=list)
    heard: float = 0.0
    ready: bool = False


class LocalProcesses:
    """Processes on this machine, each a fresh Python with one thread, fed through its own pipes.

    They are started when first needed, and leave when their pipe closes, however that comes.

    Parameters
    ----------
    processes : how many.
    timeout : seconds without a word from a worker that has work, after which it is ended.

    Attributes
    ----------
    false_starts : processes that died in a row before they said anything.
    """

    # What the processes run; tests put something cheaper in its place.
    work = "wingbeat.studies.work:solve_unit"

    def __init__(self, processes: int, timeout: float = 600.0) -> None:
        self.workers = processes
        self._cores = cores_of(processes)
        self._timeout = timeout
        self._crew: list[_Worker] = []
        self._heard: queue.SimpleQueue[tuple[int, bytes]] = queue.SimpleQueue()
        self._ended: list[Ended] = []
        self.false_starts = 0

    @property
    def free(self) -> int:
        """How many more batches it takes now."""
        return self.workers - sum(worker.batch is not None for worker in self._crew)

    def submit(self, batch: int, units: list[Unit]) -> None:
        """Take a batch."""
        idle = next((worker for worker in self._crew if worker.batch is None), None) or self._start()
        idle.batch, idle.outcomes, idle.heard = batch, [], time.monotonic()
        assert idle.process.stdin is not None
        with suppress(OSError):  # it has died: its pipe's end says so
            idle.process.stdin.write(json.dumps(pack(units)).encode() + b"\n")
            idle.process.stdin.flush()

    def wait(self, seconds: float) -> Ended | None:
        """Return a batch that ended, or None after so many seconds."""
        until = time.monotonic() + seconds
        while not self._ended:
            self._end_silent()
            try:
                who, line = self._heard.get(timeout=max(min(until - time.monotonic(), 0.2), 0.001))
            except queue.Empty:
                if time.monotonic() >= until:
                    return None
                continue
            self._hear(who, line)
        return self._ended.pop(0)

    def close(self) -> None:
        """End every worker now, whatever it does."""
        for worker in self._crew:
            worker.process.kill()
        for worker in self._crew:
            _leave(worker)
        self._crew.clear()

    def _start(self) -> _Worker:
        environment = dict(os.environ)
        for name in _ONE_THREAD:
            environment[name] = "1"
        # The package that drives is the one that works, wherever it was imported from.
        home = str(Path(__file__).resolve().parents[2])
        environment["PYTHONPATH"] = os.pathsep.join([home, *filter(None, [environment.get("PYTHONPATH")])])
        taken = [worker.core for worker in self._crew]
        core = next((core for core in self._cores if core not in taken), None)
        words = [self.work, str(self._timeout), *([] if core is None else [str(core)])]
        process = subprocess.Popen(
            [sys.executable, "-P", "-m", "wingbeat.studies.worker", *words],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=environment,
            start_new_session=True,  # Ctrl-C is for the driver, which then says what becomes of its workers
        )
        listener = threading.Thread(target=self._listen, args=(process,), daemon=True)
        worker = _Worker(process, f"process {process.pid}", listener, core)
        self._crew.append(worker)
        listener.start()
        return worker

    def _listen(self, process: subprocess.Popen[bytes]) -> None:
        """Pass on what a worker says, line by line, and its end as no line."""
        assert process.stdout is not None
        with process.stdout as lines:
            for line in lines:
                if line.endswith(b"\n"):
                    self._heard.put((process.pid, line))
        self._heard.put((process.pid, b""))

    def _hear(self, who: int, line: bytes) -> None:
        worker = next((worker for worker in self._crew if worker.process.pid == who), None)
        if worker is None:  # its last words, after it was given up
            return
        worker.heard = time.monotonic()
        if not line:
            self._bury(worker, "crashed")
            return
        told = json.loads(line)
        if isinstance(told, list):
            worker.outcomes.append(Outcome(*told))
        elif told == "done" and worker.batch is not None:
            self._ended.append(Ended(worker.batch, worker.outcomes, worker.name))
            worker.batch = None
        elif told == "ready":
            worker.ready, self.false_starts = True, 0

    def _end_silent(self) -> None:
        """End workers that have work and said nothing for too long."""
        now = time.monotonic()
        for worker in list(self._crew):
            if worker.batch is not None and now - worker.heard > self._timeout:
                self._bury(worker, "timeout")

    def _bury(self, worker: _Worker, how: str) -> None:
        """Take leave of a worker, and say what became of its batch."""
        self._crew.remove(worker)
        if how == "crashed":
            with suppress(subprocess.TimeoutExpired):
                worker.process.wait(_LEAVING)
        worker.process.kill()
        code = _leave(worker)
        if not worker.ready and how == "crashed":
            self.false_starts += 1
            if self.false_starts >= _STARTS:
                raise FileError("no worker process can be started; see its message above")
        text = f"no result within {self._timeout:g} s" if how == "timeout" else _last_words(code)
        if worker.batch is not None:
            self._ended.append(Ended(worker.batch, worker.outcomes, worker.name, how, text))


def _leave(worker: _Worker) -> int:
    """Close the pipes of a process that was ended, and return its exit code."""
    code = worker.process.wait()
    assert worker.process.stdin is not None
    with suppress(OSError):
        worker.process.stdin.close()
    worker.listener.join(1.0)
    return code


def _last_words(code: int) -> str:
    """Return how a process ended."""
    if code >= 0:
        return f"its process ended with exit code {code}"
    import signal

    try:
        return f"its process was ended by {signal.Signals(-code).name}"
    except ValueError:
        return f"its process was ended by signal {-code}"
