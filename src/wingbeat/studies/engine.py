"""Where the work is done: an engine takes batches of units and reports how each ended. Here: local processes."""

from __future__ import annotations

import queue
import time
from dataclasses import dataclass, field
from typing import NamedTuple, Protocol

from wingbeat._base import WorkerError
from wingbeat._workers.process import Message, WorkerProcess
from wingbeat.studies.units import Outcome, Unit

# There are as many processes as cores, so each has one thread.
_ONE_THREAD = {f"{name}_NUM_THREADS": "1" for name in ("OMP", "OPENBLAS", "MKL")} | {"VECLIB_MAXIMUM_THREADS": "1"}
# After this many workers in a row that die before they are ready, no more are started: no point is to blame.
_STARTS = 3
# If the driver cannot end a worker, the worker ends itself after a silence of this many timeouts plus these
# seconds.
_BACKSTOP, _BACKSTOP_SECONDS = 2.0, 60.0


class Ended(NamedTuple):
    """How a batch ended: outcomes of its points, in order; of a lost batch, those that were reported before."""

    batch: int
    outcomes: list[Outcome]
    worker: str
    lost: str | None = None  # how the worker ended: `crashed` or `timeout`
    text: str = ""  # what is known about the loss
    # Whether a worker reports each point as soon as it is solved; then the first unreported one is to blame.
    told: bool = True


class Engine(Protocol):
    """The interface of an engine. The driver alone decides which points are solved, retried or given up."""

    @property
    def free(self) -> int:
        """Number of further batches that the engine accepts now."""
        ...

    @property
    def workers(self) -> int:
        """Number of batches that the engine works on at the same time."""
        ...

    def submit(self, batch: int, units: list[Unit]) -> None:
        """Take a batch; `wait` later returns its number and how it ended."""

    def wait(self, seconds: float) -> Ended | None:
        """Return a batch that ended, or None if none ended within `seconds`."""

    def close(self) -> None:
        """End every worker now, whatever it does."""


@dataclass(eq=False)
class _Worker:
    """A process, the batch that it works on, and the time of its last message."""

    process: WorkerProcess = field(init=False)
    batch: int | None = None
    outcomes: list[Outcome] = field(default_factory=list)
    heard: float = 0.0
    ready: bool = False


class LocalProcesses:
    """Processes on this machine, each a new Python with one thread, which gets its work through pipes of its own.

    They are started when first needed, and end when their pipe closes for any reason. A worker that has work and
    sends nothing for `timeout` [s] is ended.
    """

    # What the processes run; tests put something cheaper in its place.
    work = "wingbeat.studies.work:solve_units"

    def __init__(self, processes: int, timeout: float = 600.0) -> None:
        self.workers = processes
        self._timeout = timeout
        self._crew: list[_Worker] = []
        self._heard: queue.SimpleQueue[tuple[_Worker, Message | None]] = queue.SimpleQueue()
        self._ended: list[Ended] = []
        self.false_starts = 0  # consecutive processes that died before they sent a message

    @property
    def free(self) -> int:
        """Number of further batches that the engine accepts now."""
        return self.workers - sum(worker.batch is not None for worker in self._crew)

    def submit(self, batch: int, units: list[Unit]) -> None:
        """Take a batch."""
        idle = next((worker for worker in self._crew if worker.batch is None), None) or self._start()
        idle.batch, idle.outcomes, idle.heard = batch, [], time.monotonic()
        idle.process.request(units)

    def wait(self, seconds: float) -> Ended | None:
        """Return a batch that ended, or None if none ended within `seconds`."""
        until = time.monotonic() + seconds
        while not self._ended:
            self._end_silent()
            try:
                worker, message = self._heard.get(timeout=max(min(until - time.monotonic(), 0.2), 0.001))
            except queue.Empty:
                if time.monotonic() >= until:
                    return None
                continue
            if worker in self._crew:  # otherwise, this worker has been given up
                self._hear(worker, message)
        return self._ended.pop(0)

    def close(self) -> None:
        """End every worker now, whatever it does."""
        for worker in self._crew:
            worker.process.kill()
        for worker in self._crew:
            worker.process.bury()
        self._crew.clear()

    def _start(self) -> _Worker:
        worker = _Worker()
        worker.process = WorkerProcess(
            self.work,
            lambda message: self._heard.put((worker, message)),
            silence=_BACKSTOP * self._timeout + _BACKSTOP_SECONDS,
            environment=_ONE_THREAD,
        )
        self._crew.append(worker)
        return worker

    def _hear(self, worker: _Worker, message: Message | None) -> None:
        worker.heard = time.monotonic()
        if message is None:
            self._bury(worker, "crashed")
        elif message.kind == "ready":
            worker.ready, self.false_starts = True, 0
        elif message.kind == "progress":
            worker.outcomes.append(message.value)
        elif message.kind == "done":
            self._end(worker)
        elif message.kind == "failed":
            self._end(worker, "crashed", f"its process raised {type(message.value).__name__}: {message.value}")

    def _end_silent(self) -> None:
        """End workers that have work but have sent nothing for too long."""
        now = time.monotonic()
        for worker in list(self._crew):
            if worker.batch is not None and now - worker.heard > self._timeout:
                worker.process.kill()
                self._bury(worker, "timeout")

    def _bury(self, worker: _Worker, how: str) -> None:
        """Remove a worker that has ended, and report how its batch ended."""
        self._crew.remove(worker)
        ending = worker.process.bury()
        if not worker.ready and how == "crashed":
            self.false_starts += 1
            if self.false_starts >= _STARTS:
                raise WorkerError("no worker process can be started; see the error message above")
        text = f"no result within {self._timeout:g} s" if how == "timeout" else f"its process ended with {ending}"
        self._end(worker, how, text)

    def _end(self, worker: _Worker, lost: str | None = None, text: str = "") -> None:
        """Report how the batch of a worker ended, if it has one."""
        if worker.batch is not None:
            name = f"process {worker.process.pid}"
            self._ended.append(Ended(worker.batch, worker.outcomes, name, lost, text))
            worker.batch = None
