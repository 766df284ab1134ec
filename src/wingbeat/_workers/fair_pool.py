"""Jobs of several sessions on a few worker processes: a fair queue with limits, which survives a dead process."""

from __future__ import annotations

import itertools
import queue
import threading
import traceback
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from wingbeat._base.errors import first_line
from wingbeat._workers.main import Message
from wingbeat._workers.process import WorkerProcess

# If this many processes in a row end before they are ready, no more are started for the same job.
_FALSE_STARTS = 3
# A job that is no longer wanted may end by itself within this time [s]; then its process is ended.
_GRACE = 20.0


class Event(NamedTuple):
    """What happened to a job.

    Parameters
    ----------
    kind : ``waiting`` (value: place in the queue, 1 is next), ``started``, ``progress`` (value: [done, total]),
        and one of the endings ``done`` (value: the answer), ``stopped``,
        ``failed`` (value: what went wrong), ``lost`` (value: how its process ended), ``late`` (value: seconds).
    value : see `kind`.
    """

    kind: str
    value: Any = None

    @property
    def ends(self) -> bool:
        """Whether this event is the last one of its job."""
        return self.kind in ("done", "stopped", "failed", "lost", "late")


@dataclass(eq=False)
class Job:
    """A piece of work for a session; made by `FairPool.submit`."""

    session: str
    what: Any
    tell: Callable[[Event], None]
    number: int
    turn: int
    background: bool = False
    unwanted: bool = False
    place: int = 0
    tries: int = 0


@dataclass(eq=False)
class _Desk:
    """A slot for one worker process, and the thread that manages it."""

    wake: threading.Condition
    worker: WorkerProcess | None = None
    heard: queue.SimpleQueue[Message | None] = field(default_factory=queue.SimpleQueue)
    job: Job | None = None
    ready: bool = False
    late: bool = False
    served: str = ""
    thread: threading.Thread | None = None
    false_starts: int = 0


@dataclass
class _Turns:
    """The order of jobs: sessions take turns, and each session's jobs run in the order submitted."""

    now: int = 0
    last: dict[str, int] = field(default_factory=dict)

    def of(self, session: str) -> int:
        """Return the number by which a session's next job is ordered."""
        turn = self.last[session] = max(self.now, self.last.get(session, -1) + 1)
        return turn


class FairPool:
    """A pool of worker processes with a fair queue; events come from threads of its own.

    Background jobs wait for all others. They never take the last free worker, unless there is only one.

    Parameters
    ----------
    work : the function that does a job, as ``MODULE:FUNCTION``; called with the job and a `main.Context`.
    processes : how many workers.
    most_waiting : largest number of waiting jobs of one session.
    seconds : time limit of a job; after it, the job's process is ended.
    memory : resident memory [bytes] beyond which a worker is replaced after a job.
    """

    def __init__(
        self,
        work: str,
        processes: int,
        most_waiting: int = 6,
        seconds: float = 300.0,
        memory: int = 3 << 30,
    ) -> None:
        self._work, self._most_waiting, self._seconds, self._memory = work, most_waiting, seconds, memory
        self._lock = threading.RLock()
        self._waiting: list[Job] = []
        self._turns, self._quiet_turns = _Turns(), _Turns()
        self._numbers = itertools.count(1)
        self._open = True
        self._desks = [_Desk(threading.Condition(self._lock)) for _ in range(processes)]
        for desk in self._desks:
            desk.thread = threading.Thread(target=self._look_after, args=(desk,), daemon=True)
            desk.thread.start()

    @property
    def workers(self) -> list[int]:
        """The process ids of the running workers."""
        with self._lock:
            return [desk.worker.pid for desk in self._desks if desk.worker is not None and desk.worker.alive]

    def submit(
        self, session: str, what: Any, tell: Callable[[Event], None], background: bool = False
    ) -> Job | None:
        """Queue a job, or return None if the session already has the largest number of waiting jobs.

        Parameters
        ----------
        session : whose job it is.
        what : the argument for the worker's function; it must be picklable.
        tell : called with each `Event`, from another thread.
        background : whether the job waits for all that are not in the background.
        """
        with self._lock:
            if not self._open or sum(job.session == session for job in self._waiting) >= self._most_waiting:
                return None
            turn = self._turns_of(background).of(session)
            job = Job(session, what, tell, next(self._numbers), turn, background)
            self._waiting.append(job)
            self._assign()
            return job

    def cancel(self, job: Job) -> None:
        """Cancel a job: remove it from the queue or stop it at its next step; if it goes on, end its process."""
        with self._lock:
            if job.unwanted:
                return
            job.unwanted = True
            if job in self._waiting:
                self._waiting.remove(job)
                job.tell(Event("stopped"))
                self._tell_places()
                return
            for desk in self._desks:
                if desk.job is job and desk.worker is not None:
                    desk.worker.stop()
                    self._later(_GRACE, desk, job, late=False)

    def leave(self, session: str) -> None:
        """Cancel every job of a session that was closed."""
        with self._lock:
            working = [desk.job for desk in self._desks if desk.job is not None]
            for job in [*self._waiting, *working]:
                if job.session == session:
                    self.cancel(job)
            for turns in (self._turns, self._quiet_turns):
                turns.last.pop(session, None)

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

    def _turns_of(self, background: bool) -> _Turns:
        return self._quiet_turns if background else self._turns

    def _assign(self) -> None:
        """Assign waiting jobs to idle workers, if possible to the worker that served the same session last.

        A background job rather goes to another worker, so that the next job of its session finds that one free.
        """
        self._waiting.sort(key=lambda job: (job.background, job.turn, job.number))
        while self._waiting and (idle := [desk for desk in self._desks if desk.job is None]):
            if self._waiting[0].background and self._is_enough_background():
                break
            job = self._waiting.pop(0)
            desk = max(idle, key=lambda desk: ((desk.served == job.session) != job.background, desk.ready))
            desk.job, job.place = job, 0
            if not job.background:
                desk.served = job.session
            turns = self._turns_of(job.background)
            turns.now = max(turns.now, job.turn)
            desk.wake.notify_all()
        self._tell_places()

    def _is_enough_background(self) -> bool:
        working = sum(desk.job is not None and desk.job.background for desk in self._desks)
        return working >= max(len(self._desks) - 1, 1)

    def _tell_places(self) -> None:
        for place, job in enumerate(self._waiting, start=1):
            if job.place != place:
                job.place = place
                job.tell(Event("waiting", place))

    def _later(self, seconds: float, desk: _Desk, job: Job, late: bool) -> threading.Timer:
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

    def _look_after(self, desk: _Desk) -> None:
        """Keep a process running in a slot, and follow its jobs, one after the other."""
        while self._open:
            if desk.worker is None:
                self._seat(desk)
            with self._lock:
                while self._open and desk.job is None:
                    desk.wake.wait()
                job = desk.job
            if job is not None and self._open:
                ending = self._see_through(desk, job)
                with self._lock:
                    desk.job = None
                    if ending is None:  # its process had ended before it took the job
                        self._waiting.append(job)
                    else:
                        job.tell(ending)
                    self._assign()
        if desk.worker is not None:
            desk.worker.bury()

    def _seat(self, desk: _Desk) -> None:
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

    def _see_through(self, desk: _Desk, job: Job) -> Event | None:
        """Return how a job ended; None if its process had ended before it took the job."""
        worker = desk.worker
        assert worker is not None
        desk.late, took, leaves, ending = False, False, False, None
        with self._lock:  # a cancellation either comes before the request, or sends its stop after the request
            if job.unwanted:
                return Event("stopped")
            worker.request(job.what)
        clock = self._later(self._seconds, desk, job, late=True)
        while ending is None and (message := desk.heard.get()) is not None:
            event = Event(*message)
            if event.kind == "failed":
                traceback.print_exception(event.value)  # all of it for the log, one line for the visitor
                event = Event("failed", first_line(event.value)[:300])
            if event.kind == "leaving":
                leaves = True
            elif event.ends:
                ending = event
            else:
                took = True
                if not job.unwanted:
                    job.tell(event)
        clock.cancel()
        if ending is None or leaves:
            how = worker.bury()
            desk.worker, desk.ready, desk.heard = None, False, queue.SimpleQueue()
            ending = ending or self._loss(desk, job, took, how)
        return Event("stopped") if ending is not None and job.unwanted else ending

    def _loss(self, desk: _Desk, job: Job, took: bool, how: str) -> Event | None:
        """Return the last event of a job whose process ended."""
        if desk.late:
            return Event("late", self._seconds)
        job.tries += 1
        if took or job.tries > 1:
            return Event("lost", how)
        return None
