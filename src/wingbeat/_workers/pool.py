"""Worker processes that share jobs, and a map over items that uses them.

A thread looks after each process: it starts it, hands it one job after the other, and replaces it when it has died.
"""

from __future__ import annotations

import io
import itertools
import multiprocessing
import pickle
import queue
import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import Future
from contextlib import closing, contextmanager
from dataclasses import dataclass, field
from multiprocessing import spawn
from typing import Any, NamedTuple, TypeVar

from wingbeat._base.errors import WorkerError
from wingbeat._workers.process import Context, Message, WorkerProcess

T = TypeVar("T")
R = TypeVar("R")

# If this many processes in a row end before they are ready, no more are started for the same job.
_FALSE_STARTS = 3
# A job that is no longer wanted may end by itself within this time [s]; then its process is ended.
_GRACE = 20.0


class Event(NamedTuple):
    """What happened to a job.

    ``waiting`` (value: place in the queue, 1 is next), ``started``, ``progress`` (value: what the job reported),
    and one of the endings ``done`` (value: the answer), ``stopped``, ``failed`` (value: the exception), ``lost``
    (value: how its process ended), ``late`` (value: seconds).
    """

    kind: str
    value: Any = None

    @property
    def ends(self) -> bool:
        """Whether this event is the last one of its job."""
        return self.kind in ("done", "stopped", "failed", "lost", "late")


@dataclass(eq=False)
class Job:
    """A piece of work; made by `submit`."""

    what: Any
    tell: Callable[[Event], None]
    session: str = ""
    background: bool = False
    turn: int = 0
    number: int = 0
    place: int = 0
    tries: int = 0
    unwanted: bool = False


@dataclass(eq=False)
class Desk:
    """A slot for one worker process, and the thread that looks after it."""

    wake: threading.Condition
    worker: WorkerProcess | None = None
    heard: queue.SimpleQueue[Message | None] = field(default_factory=queue.SimpleQueue)
    job: Job | None = None
    used: int = 0
    ready: bool = False
    late: bool = False
    served: str = ""  # the session of its last job
    thread: threading.Thread | None = None
    false_starts: int = 0


class Pool:
    """A pool of worker processes, whose jobs run in the order submitted; events come from threads of its own."""

    def __init__(
        self,
        work: str,  # the function that does a job, as MODULE:FUNCTION; called with the job and a `process.Context`
        processes: int,
        *,
        at_once: bool = False,  # whether they start now and are replaced at once, or when there is a job for them
        again: bool = False,  # whether a job that had begun when its process died is given to another, once
        seconds: float | None = None,  # time limit of a job, after which its process is ended
        memory: int | None = None,  # resident memory [bytes] beyond which a worker is replaced after a job
    ) -> None:
        self._work, self._at_once, self._again = work, at_once, again
        self._seconds, self._memory = seconds, memory
        self._lock = threading.RLock()
        self._waiting: list[Job] = []
        self._numbers = itertools.count(1)
        self._open = True
        self._desks = [Desk(threading.Condition(self._lock)) for _ in range(processes)]
        for desk in self._desks:
            desk.thread = threading.Thread(target=self._look_after, args=(desk,), daemon=True)
            desk.thread.start()

    @property
    def workers(self) -> list[int]:
        """The process ids of the running workers."""
        with self._lock:
            return [desk.worker.pid for desk in self._desks if desk.worker is not None and desk.worker.alive]

    def add(self, job: Job) -> bool:
        """Queue a job; return whether the pool is still open."""
        with self._lock:
            if self._open:
                job.number = next(self._numbers)
                self._waiting.append(job)
                self._assign()
            return self._open

    def cancel(self, job: Job) -> None:
        """Cancel a job: remove it from the queue or stop it at its next step; if it goes on, end its process."""
        with self._lock:
            if job.unwanted:
                return
            job.unwanted = True
            if job in self._waiting:
                self._waiting.remove(job)
                job.tell(Event("stopped"))
                self._assign()
                return
            for desk in self._desks:
                if desk.job is job and desk.worker is not None:
                    desk.worker.stop()
                    self._later(_GRACE, desk, job, late=False)

    def close(self) -> None:
        """End every worker immediately."""
        with self._lock:
            self._open = False
            self._waiting.clear()
            for desk in self._desks:
                if desk.worker is not None:
                    desk.worker.kill()
                desk.wake.notify_all()
        for desk in self._desks:
            if desk.thread is not None:
                desk.thread.join(5.0)

    def _assign(self) -> None:
        """Assign waiting jobs to idle desks."""
        while self._waiting and (idle := [desk for desk in self._desks if desk.job is None]):
            desk = self._desk_for(self._waiting[0], idle)
            if desk is None:
                break
            desk.job = self._waiting.pop(0)
            desk.wake.notify_all()

    def _desk_for(self, job: Job, idle: list[Desk]) -> Desk | None:
        """Return the desk for the next job, the one used last; None if the job is to wait."""
        return max(idle, key=lambda desk: desk.used)

    def _request(self, job: Job, desk: Desk) -> Any:
        """Return what is sent to the worker."""
        return job.what

    def _later(self, seconds: float, desk: Desk, job: Job, late: bool) -> threading.Timer:
        """End the process of a job that still runs after `seconds`."""

        def end() -> None:
            with self._lock:
                if desk.job is job and desk.worker is not None:
                    desk.late = late
                    desk.worker.kill()

        timer = threading.Timer(seconds, end)
        timer.daemon = True
        timer.start()
        return timer

    def _look_after(self, desk: Desk) -> None:
        """Keep a process running in a slot, and follow its jobs, one after the other."""
        while self._open:
            if self._at_once and desk.worker is None:
                self._seat(desk)
            with self._lock:
                while self._open and desk.job is None:
                    desk.wake.wait()
                job = desk.job
            if job is not None and self._open:
                try:
                    ending = self._see_through(desk, job)
                except Exception as error:  # it cannot be pickled, or the system starts no process
                    ending = Event("failed", error)
                with self._lock:
                    desk.job, desk.used = None, next(self._numbers)
                    if ending is None:  # its process has died, and another is to try
                        self._waiting.insert(0, job)
                    else:
                        job.tell(ending)
                    self._assign()
        if desk.worker is not None:
            desk.worker.bury()

    def _seat(self, desk: Desk) -> None:
        """Start a process and wait until it is ready; if it cannot start, the next job tries again."""
        # The libraries keep the number of threads that they have on the command line. With another number they
        # would add in another order, and the tenth digit of an answer would differ from the command line's.
        worker = WorkerProcess(self._work, desk.heard.put, memory=self._memory)
        with self._lock:
            desk.worker, desk.ready = worker, False
            if not self._open:
                worker.kill()
        desk.ready = desk.heard.get() is not None
        desk.false_starts = 0 if desk.ready else desk.false_starts + 1
        if desk.ready:
            return
        if desk.false_starts < _FALSE_STARTS and self._open:
            worker.bury()
            self._seat(desk)
        else:
            desk.heard.put(None)  # the next job learns again that the process ended

    def _see_through(self, desk: Desk, job: Job) -> Event | None:
        """Return how a job ended; None if its process died and another is to try."""
        request = self._request(job, desk)
        if desk.worker is None:
            self._seat(desk)
        worker = desk.worker
        assert worker is not None
        desk.late, took, leaves, ending = False, False, False, None
        with self._lock:  # a cancellation either comes before the request, or sends its stop after the request
            if job.unwanted:
                return Event("stopped")
            worker.request(request)
        clock = None if self._seconds is None else self._later(self._seconds, desk, job, late=True)
        while ending is None and (message := desk.heard.get()) is not None:
            event = Event(*message)
            if event.kind == "leaving":
                leaves = True
            elif event.ends:
                ending = event
            else:
                took = True
                if not job.unwanted:
                    job.tell(event)
        if clock is not None:
            clock.cancel()
        if ending is None or leaves:
            how = worker.bury()
            desk.worker, desk.ready, desk.heard = None, False, queue.SimpleQueue()
            if ending is None:
                job.tries += 1
                if desk.late:
                    ending = Event("late", self._seconds)
                elif job.tries > 1 or (took and not self._again):
                    ending = Event("lost", how)
        return Event("stopped") if ending is not None and job.unwanted else ending


# --- a map over items ---


def in_processes(
    work: Callable[[T], R], items: Sequence[T], processes: int, progress: Callable[[int, int], None] | None = None
) -> Iterator[R]:
    """Yield the result of `work` for each item, in the order of the items, as soon as it is ready.

    `work` can be pickled; its JAX programs run in the process it is called in. With one process, that is this one.
    `progress` is called with (items done, items in all).

    Raises
    ------
    WorkerError : two processes die on the same item, or none can be started.
    """
    with process_map(processes, len(items)) as over:
        for done, result in enumerate(over(work, items), start=1):
            if progress is not None:
                progress(done, len(items))
            yield result


@contextmanager
def process_map(processes: int, most: int) -> Iterator[Callable[[Callable[[T], R], Iterable[T]], Iterator[R]]]:
    """Yield a `map` that uses `processes` processes, at most one per item; with 1, it is Python's own `map`."""
    if processes == 1:
        yield map
        return
    with closing(_Callers(min(processes, max(most, 1)))) as pool:
        yield pool.map


class _Callers(Pool):
    """Processes that call functions; they start when there is work for them."""

    def __init__(self, processes: int) -> None:
        # What a new process needs to import the main module of this one. During this import, it starts none.
        self._main = spawn.get_preparation_data("worker")
        del self._main["authkey"]  # cannot be pickled
        super().__init__(f"{__name__}:call", processes, again=True)

    def map(self, work: Callable[[T], R], items: Iterable[T]) -> Iterator[R]:
        """Begin with all items; return an iterator over the results in order."""
        answers = deque(self._answer((work, item)) for item in items)
        return (answers.popleft().result() for _ in range(len(answers)))

    def _answer(self, what: Any) -> Future[Any]:
        answer: Future[Any] = Future()

        def tell(event: Event) -> None:
            if event.kind == "done":
                answer.set_result(event.value)
            elif event.kind == "failed":
                answer.set_exception(event.value)
            elif event.ends:
                text = f"two worker processes died on the same work; the last one ended with {event.value}"
                answer.set_exception(WorkerError(text))

        if not self.add(Job(what, tell)):
            raise WorkerError("the worker processes are closed")
        return answer

    def _request(self, job: Job, desk: Desk) -> Any:
        return self._main, pickle.dumps(job.what)


def call(request: tuple[dict[str, Any], bytes], context: Context) -> Any:
    """Call a function with an item in a worker process; the request holds both, pickled."""
    work, item = _Unpickler(*request).load()
    return work(item)


class _Unpickler(pickle.Unpickler):
    """Imports the main module of the requesting process, but only if something in it is needed.

    A script that sends none of its own functions or classes to workers therefore needs no ``if __name__ ==
    "__main__":``.
    """

    def __init__(self, main: dict[str, Any], pickled: bytes) -> None:
        super().__init__(io.BytesIO(pickled))
        self._main = main

    def find_class(self, module: str, name: str) -> Any:
        """Return a class or function."""
        if module == "__main__":
            here: Any = multiprocessing.current_process()
            here._inheriting = True  # as multiprocessing marks it, so that `get_preparation_data` refuses
            try:
                spawn.prepare(self._main)
            finally:
                del here._inheriting
        return super().find_class(module, name)
