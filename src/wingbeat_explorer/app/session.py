"""One visitor's session, which uses no elements of the page, and the queue in which all sessions' jobs wait."""

from __future__ import annotations

import asyncio
import dataclasses
import traceback
from collections.abc import Callable
from contextlib import AbstractContextManager, suppress
from dataclasses import dataclass, field
from typing import Any, Protocol

from wingbeat._base import first_line
from wingbeat._workers.pool import Desk, Event, Job, Pool
from wingbeat_explorer.app.formatting import refusals
from wingbeat_explorer.app.links import to_plain
from wingbeat_explorer.app.scenario import Scenario

# After so many seconds without a change, a search from every start follows an answer that was continued. After a
# long continuation it waits longer: the search takes long, too, and the next move would wait for one of its starts.
_CALM = 0.35
_CALM_BY_CONTINUATION = 3.0
_LONGEST_CALM = 2.0  # for the first continuation is compiled, too
# If a continuation takes at most this time, its result is awaited while the slider moves on. Within plausible
# ranges those of pigeon and bat take 0.3 to 1.2 s.
_BRIEF = 1.5
# A continued orbit must be better by this share before the page says so.
_BETTER = 1e-4
BUSY = "Too many of your jobs are waiting already; wait for them, or cancel some."
_ENDINGS = {
    "lost": "The solver process ended ({}). It was started again; solve again.",
    "late": "No result within {:g} s, so the solver was stopped; choose fewer starts, or solve again.",
    "failed": "The solver failed ({}); this is a fault of wingbeat, please report it with the link of this page.",
}


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


class View(Protocol):
    """What a page shows of its session."""

    def context(self) -> AbstractContextManager[Any]:
        """Return the context in which the page may be changed."""
        ...

    def show_scenario(self, scenario: Scenario) -> None:
        """Show a scenario in the form."""

    def show_state(self, text: str, busy: bool, done: float | None = None) -> None:
        """Show what the session is doing; `done` is the finished share of the work."""

    def show_answer(self, answer: dict[str, Any]) -> None:
        """Show an answer."""

    def show_stale(self, stale: bool) -> None:
        """Show whether the answer on the page belongs to an earlier scenario."""

    def show_refusals(self, refusals: list[list[str]]) -> None:
        """Show the refusals, each as [where, message]; an empty list removes earlier ones."""

    def show_trouble(self, *lines: str) -> None:
        """Say that something went wrong."""


class Session:
    """The requests of one page to the pool, under a unique name; they begin with a scenario."""

    def __init__(self, name: str, pool: FairPool, scenario: Scenario, view: View) -> None:
        self.name, self.scenario = name, scenario
        self.answer: dict[str, Any] | None = None
        self._answered = scenario
        self._pool, self._view = pool, view
        self._loop = asyncio.get_running_loop()
        self._job: Job | None = None
        self._brief_since: float | None = None
        self._continued: float | None = None
        self._again = False
        self._calm: asyncio.TimerHandle | None = None
        self._asked = 0
        self._gone = False

    @property
    def answered(self) -> Scenario:
        """The scenario of the answer."""
        return self._answered

    @property
    def rests(self) -> bool:
        """Whether no search runs, and none from every start is about to follow a continued answer."""
        return self._job is None and self._calm is None

    def change(self, **choices: Any) -> bool:
        """Change to another scenario; return whether each of its choices is valid by itself."""
        self.scenario = dataclasses.replace(self.scenario, **choices)
        return self.ask()

    def rearrange(self, **choices: Any) -> None:
        """Change a choice that does not affect the answer."""
        self.scenario = dataclasses.replace(self.scenario, **choices)
        self._tell_faults()
        self._tell_scenario()

    def _tell_scenario(self) -> None:
        self._view.show_scenario(self.scenario)
        self._view.show_stale(self.answer is not None and not self.scenario.asks_as(self._answered))

    def _tell_faults(self) -> bool:
        refused = refusals(self.scenario.faults().faults)
        self._view.show_refusals(refused)
        return bool(refused)

    def ask(self, whole: bool = False) -> bool:
        """Solve the scenario, by continuation from the previous answer if there is one, or by a `whole` search."""
        self._cancel_calm()
        self._continued = None
        self._tell_scenario()
        if self._tell_faults():
            self.stop("Not solved: a choice is invalid; see the mark beside it.")
            return False
        near = None if whole or self.answer is None else self.answer.get("near")
        if self._brief_since is not None and self._loop.time() - self._brief_since < _BRIEF and not whole:
            self._again = True  # the running search ends soon, and this one can continue from its result
            return True
        self._submit(near)
        return True

    def _submit(self, near: dict[str, Any] | None) -> None:
        self._again, self._calm = False, None
        if self._job is not None:
            self._pool.cancel(self._job)
        self._asked += 1
        asked, scenario = self._asked, self.scenario
        what = {"do": "orbit", "scenario": to_plain(scenario), "near": near}
        self._brief_since = self._loop.time() if near is not None else None
        self._job = self.start(what, lambda event: self._hear(asked, scenario, event))
        if self._job is None:
            self._brief_since = None
            self._view.show_trouble(BUSY)

    def start(self, what: dict[str, Any], hear: Callable[[Event], None], background: bool = False) -> Job | None:
        """Submit a job to the pool; `hear` gets its events on the page's own thread."""

        def tell(event: Event) -> None:
            with suppress(RuntimeError):  # the server has closed, and its loop with it
                self._loop.call_soon_threadsafe(self._inside, hear, event)

        return self._pool.submit(self.name, what, tell, background)

    def _inside(self, act: Callable[[Any], None], what: Any) -> None:
        """Call a function within the page's context, unless the page is closed."""
        if not self._gone:
            with self._view.context():
                act(what)

    def cancel(self, job: Job) -> None:
        """Drop a job."""
        self._pool.cancel(job)

    def stop(self, text: str = "Cancelled.") -> None:
        """Cancel the search that is running."""
        self._cancel_calm()
        self._asked += 1  # whatever comes of it is not shown
        self._again, self._brief_since = False, None
        if self._job is not None:
            self._pool.cancel(self._job)
            self._job = None
        self._view.show_state(text, busy=False)

    def leave(self) -> None:
        """Cancel all jobs of a page that was closed."""
        self._cancel_calm()
        self._gone = True
        self._pool.leave(self.name)

    def _hear(self, asked: int, scenario: Scenario, event: Event) -> None:
        if asked != self._asked:  # an answer to an outdated request
            return
        if event.kind == "waiting":
            self._view.show_state(f"Waiting: number {event.value} in the queue.", busy=True)
        elif event.kind == "started":
            self._view.show_state("Solving.", busy=True)
        elif event.kind == "progress":
            total = event.value[1]
            done = min(event.value[0], total)
            self._view.show_state(f"Solving: {done} of {total} starts.", busy=True, done=done / max(total, 1))
            if self._again:  # the continuation failed, and the search that follows it is of an earlier request
                self._brief_since = None
                self.ask()
        elif event.ends:
            self._end(scenario, event)

    def _end(self, scenario: Scenario, event: Event) -> None:
        self._job, self._brief_since = None, None
        if event.kind == "done" and "refused" not in event.value:
            self._take(scenario, event.value)
        elif event.kind == "done":
            self._view.show_refusals(event.value["refused"])
            self._view.show_state("Not solved: a choice is invalid; see the mark beside it.", busy=False)
        else:
            self.tell_ending(event)
        if self._again:
            self.ask()

    def tell_ending(self, event: Event) -> None:
        """Show how a job without an answer ended."""
        text = _ENDINGS[event.kind].format(event.value) if event.kind in _ENDINGS else "Cancelled."
        self._view.show_state(text, busy=False)
        if event.kind in _ENDINGS:
            self._view.show_trouble(text)

    def _take(self, scenario: Scenario, answer: dict[str, Any]) -> None:
        """Show an answer; if it was continued, search from every start as soon as the controls are left alone."""
        answer["scenario"] = to_plain(scenario)
        best = answer["record"].get("objective_value")
        if answer.get("continued"):
            self._continued = best
        elif self._continued is not None and best is not None and answer["near"] is not None:
            better = self._continued < best - _BETTER * abs(best)
            answer["continued_better"] = self._continued if better else None
        self._show(answer, scenario)
        if answer.get("continued") and not self._again:
            self._view.show_state("Continued from the previous result; now solving from every start.", busy=True)
            wait = min(max(_CALM, _CALM_BY_CONTINUATION * answer["seconds"]), _LONGEST_CALM)
            self._calm = self._loop.call_later(wait, self._inside, self._submit, None)
        elif not self._again:
            self._view.show_state(f"Solved in {answer['seconds']:.2g} s.", busy=False)

    def take_ready(self, answer: dict[str, Any]) -> None:
        """Show an answer to the present scenario that was solved before the page was opened."""
        self._tell_scenario()
        self._show(answer | {"scenario": to_plain(self.scenario)}, self.scenario)
        self._view.show_state("Solved beforehand.", busy=False)

    def take_file(self, answer: dict[str, Any], scenario: Scenario | None) -> None:
        """Show an answer from a file, and make its scenario the current one."""
        self.stop("From a file; nothing was solved.")
        if scenario is not None:
            self.scenario = scenario
            self._tell_faults()
            self._tell_scenario()
        answer["scenario"] = to_plain(self.scenario) if scenario is not None else None
        self._show(answer, self.scenario)

    def _show(self, answer: dict[str, Any], scenario: Scenario) -> None:
        self.answer, self._answered = answer, scenario
        self._continued = self._continued if answer.get("continued") else None
        self._view.show_answer(answer)
        self._view.show_stale(not self.scenario.asks_as(scenario))

    def _cancel_calm(self) -> None:
        if self._calm is not None:
            self._calm.cancel()
            self._calm = None


def known(answer: dict[str, Any]) -> dict[str, Any]:
    """Return the record and inputs from which the orbit of an answer can be made again."""
    return {"record": answer["record"], "inputs": answer["inputs"]}
