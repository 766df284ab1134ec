"""A fair queue: the jobs of several sessions on a few worker processes, with limits."""

from __future__ import annotations

import traceback
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from wingbeat._base import first_line
from wingbeat._workers.pool import Desk, Event, Job, Pool


@dataclass
class _Turns:
    """The order of jobs: sessions take turns, and each session's jobs run in the order submitted."""

    now: int = 0
    last: dict[str, int] = field(default_factory=dict)

    def of(self, session: str) -> int:
        """Return the number by which a session's next job is ordered."""
        self.last[session] = max(self.now, self.last.get(session, -1) + 1)
        return self.last[session]


class FairPool(Pool):
    """A pool of worker processes with a fair queue of the jobs of several sessions.

    Background jobs wait for all others. They never take the last free worker, unless there is only one.
    Of one session, at most `most_waiting` jobs wait.
    """

    def __init__(
        self, work: str, processes: int, most_waiting: int = 6, seconds: float = 300.0, memory: int = 3 << 30
    ) -> None:
        self._most_waiting = most_waiting
        self._turns = {background: _Turns() for background in (False, True)}
        super().__init__(work, processes, at_once=True, seconds=seconds, memory=memory)

    def submit(
        self, session: str, what: Any, tell: Callable[[Event], None], background: bool = False
    ) -> Job | None:
        """Queue a job, or return None if the session already has the largest number of waiting jobs.

        `what` must be picklable; `tell` is called with each `Event`, from another thread.
        """

        def told(event: Event) -> None:
            if event.kind == "failed":
                traceback.print_exception(event.value)  # all of it for the log, one line for the visitor
                event = Event("failed", first_line(event.value)[:300])
            tell(event)

        with self._lock:
            if sum(job.session == session for job in self._waiting) >= self._most_waiting:
                return None
            job = Job(what, told, session, background, self._turns[background].of(session))
            return job if self.add(job) else None

    def leave(self, session: str) -> None:
        """Cancel every job of a session that was closed."""
        with self._lock:
            working = [desk.job for desk in self._desks if desk.job is not None]
            for job in [*self._waiting, *working]:
                if job.session == session:
                    self.cancel(job)
            for turns in self._turns.values():
                turns.last.pop(session, None)

    def _assign(self) -> None:
        """Assign waiting jobs to idle desks, and tell the others their new places."""
        self._waiting.sort(key=lambda job: (job.background, job.turn, job.number))
        super()._assign()
        for place, job in enumerate(self._waiting, start=1):
            if job.place != place:
                job.place = place
                job.tell(Event("waiting", place))

    def _desk_for(self, job: Job, idle: list[Desk]) -> Desk | None:
        """Return the desk for the next job, if possible the one that served the same session last.

        A background job rather goes to another, so that the next job of its session finds that one free.
        """
        quiet = sum(desk.job is not None and desk.job.background for desk in self._desks)
        if job.background and quiet >= max(len(self._desks) - 1, 1):
            return None
        desk = max(idle, key=lambda desk: ((desk.served == job.session) != job.background, desk.ready))
        job.place = 0
        if not job.background:
            desk.served = job.session
        turns = self._turns[job.background]
        turns.now = max(turns.now, job.turn)
        return desk
