"""The pool of workers, with cheap jobs: fair, limited, and none the worse for a process that dies."""

import os
import signal
import threading
import time

import pytest

from wingbeat._workers import pool as pools
from wingbeat._workers.pool import Event
from wingbeat_explorer.app.session import FairPool

PATIENCE = 60.0


class Heard:
    """What a job's owner heard of it."""

    def __init__(self, log=None, name=""):
        self.events: list[Event] = []
        self._ended, self._log, self._name = threading.Event(), log, name

    def __call__(self, event):
        self.events.append(event)
        if event.kind == "started" and self._log is not None:
            self._log.append(self._name)
        if event.ends:
            self._ended.set()

    def end(self) -> Event:
        assert self._ended.wait(PATIENCE), self.events
        return self.events[-1]

    def until(self, kind):
        limit = time.monotonic() + PATIENCE
        while not any(event.kind == kind for event in self.events):
            assert time.monotonic() < limit, self.events
            time.sleep(0.01)


@pytest.fixture
def make_pool():
    pools = []

    def make(processes=1, **options):
        pools.append(FairPool("tests.helpers.worker_standin:do", processes, **options))
        return pools[-1]

    yield make
    for each in pools:
        each.close()


def ask(pool, what, session="a", **about):
    heard = Heard(**about)
    return pool.submit(session, what, heard), heard


def test_an_answer_comes_back(make_pool):
    _, heard = ask(make_pool(), ("echo", 5))
    assert heard.end().value["echo"] == 5
    assert [event.kind for event in heard.events] == ["started", "done"]


def test_sessions_take_turns(make_pool):
    pool, order = make_pool(), []
    _, blocker = ask(pool, ("steps", 20), "z")
    blocker.until("started")
    jobs = [
        ask(pool, ("echo", 0), s, log=order, name=f"{s}{i}")
        for s, count in (("a", 3), ("b", 2))
        for i in range(count)
    ]
    places = [heard.events[-1].value for _, heard in jobs]
    for _, heard in jobs:
        heard.end()
    assert order == ["a0", "b0", "a1", "b1", "a2"]
    # Who came last is not told a place that is better than it is.
    assert places[-1] == 4


def test_of_eight_sessions_none_waits_longer_than_its_place_says(make_pool):
    pool = make_pool(2)
    busy = [ask(pool, ("steps", 40), name) for name in "yz"]
    for _, heard in busy:
        heard.until("started")
    jobs = [ask(pool, ("steps", 5), f"s{i}") for i in range(8)]
    for place, (_, heard) in enumerate(jobs, start=1):
        assert heard.end().kind == "done"
        told = [event.value for event in heard.events if event.kind == "waiting"]
        assert told == list(range(place, 0, -1))  # first come first served: step by step to the front


def test_background_jobs_wait_for_all_others(make_pool):
    pool, order = make_pool(), []
    _, blocker = ask(pool, ("steps", 20), "z")
    blocker.until("started")
    jobs = []
    for name, background in (("quiet", True), ("a", False), ("b", False)):
        heard = Heard(order, name)
        pool.submit(name, ("echo", 0), heard, background)
        jobs.append(heard)
    for heard in jobs:
        heard.end()
    assert order == ["a", "b", "quiet"]


@pytest.mark.slow
def test_background_jobs_leave_a_worker_free(make_pool):
    pool = make_pool(2)
    quiet = [Heard(), Heard()]
    for heard in quiet:
        pool.submit("a", ("steps", 60), heard, background=True)
    quiet[0].until("started")
    assert ask(pool, ("echo", 1))[1].end().kind == "done"  # while the first goes on, and the second waits
    assert [event.kind for event in quiet[1].events] == ["waiting"]
    assert not quiet[0].events[-1].ends
    assert [heard.end().kind for heard in quiet] == ["done", "done"]


def test_a_session_may_have_only_so_many_waiting(make_pool):
    pool = make_pool(most_waiting=2)
    _, blocker = ask(pool, ("steps", 50), "z")
    blocker.until("started")
    jobs = [ask(pool, ("echo", i))[0] for i in range(4)]
    assert [job is None for job in jobs] == [False, False, True, True]
    assert ask(pool, ("echo", 0), "b")[0] is not None


def test_a_waiting_job_is_dropped_and_a_running_one_stops_at_its_next_step(make_pool):
    pool = make_pool()
    running, first = ask(pool, ("steps", 100_000))
    first.until("progress")
    waiting, second = ask(pool, ("echo", 1))
    before = pool.workers
    pool.cancel(waiting)
    pool.cancel(running)
    assert second.end().kind == first.end().kind == "stopped"
    assert "started" not in [event.kind for event in second.events]
    assert ask(pool, ("echo", 1))[1].end().value["pid"] in before


def test_a_job_that_is_deaf_to_being_stopped_is_ended_with_its_process(make_pool, monkeypatch):
    monkeypatch.setattr(pools, "_GRACE", 0.2)
    pool = make_pool()
    job, heard = ask(pool, ("deaf", 1000.0))
    heard.until("started")
    pool.cancel(job)
    assert heard.end().kind == "stopped"
    assert ask(pool, ("echo", 1))[1].end().kind == "done"


def test_a_killed_worker_is_told_of_and_replaced(make_pool):
    pool = make_pool()
    _, heard = ask(pool, ("deaf", 1000.0))
    heard.until("started")
    os.kill(pool.workers[0], signal.SIGKILL)
    assert heard.end() == Event("lost", "SIGKILL, exit code 137, as when memory runs out")
    assert ask(pool, ("echo", 1))[1].end().kind == "done"


def test_a_worker_killed_while_idle_costs_nobody_an_answer(make_pool):
    pool = make_pool()
    ask(pool, ("echo", 1))[1].end()
    os.kill(pool.workers[0], signal.SIGKILL)
    assert ask(pool, ("echo", 2))[1].end().value["echo"] == 2


def test_work_that_ends_its_process_is_lost_by_itself(make_pool):
    pool = make_pool()
    assert ask(pool, ("die", 7))[1].end() == Event("lost", "exit code 7")
    assert ask(pool, ("echo", 1))[1].end().kind == "done"


def test_a_worker_that_is_refused_memory_is_told_of_and_replaced(make_pool):
    pool = make_pool()
    assert ask(pool, ("hoard", 1 << 40))[1].end() == Event("lost", "exit code 12: out of memory")
    assert ask(pool, ("echo", 1))[1].end().kind == "done"


def test_a_worker_that_outgrew_its_memory_is_replaced_and_costs_nobody_an_answer(make_pool):
    pool = make_pool(memory=1)
    jobs = [ask(pool, ("echo", i))[1] for i in range(3)]
    answers = [heard.end().value for heard in jobs]
    assert [answer["echo"] for answer in answers] == [0, 1, 2]
    assert len({answer["pid"] for answer in answers}) == 3


def test_a_job_that_takes_too_long_is_ended(make_pool):
    pool = make_pool(seconds=0.3)
    assert ask(pool, ("deaf", 1000.0))[1].end() == Event("late", 0.3)
    assert ask(pool, ("echo", 1))[1].end().kind == "done"


def test_a_fault_in_the_work_is_told_in_a_line(make_pool):
    pool = make_pool()
    assert ask(pool, ("fail", "so\nand so"))[1].end() == Event("failed", "ValueError: so")
    assert ask(pool, ("echo", 1))[1].end().kind == "done"


def test_a_session_that_leaves_takes_its_jobs_along(make_pool):
    pool = make_pool()
    _, first = ask(pool, ("steps", 100_000))
    _, second = ask(pool, ("echo", 1))
    first.until("progress")
    pool.leave("a")
    assert first.end().kind == second.end().kind == "stopped"


def test_work_that_cannot_be_imported_is_told_for_every_job_and_not_tried_for_ever():
    pool = FairPool("no_such_module:do", 1)
    try:
        for _ in range(2):
            assert ask(pool, ("echo", 1))[1].end() == Event("lost", "exit code 1")
    finally:
        pool.close()


def test_closing_leaves_no_process(make_pool):
    pool = make_pool(2)
    ask(pool, ("deaf", 1000.0))[1].until("started")
    pids = pool.workers
    assert pids
    pool.close()
    for pid in pids:
        with pytest.raises(ProcessLookupError):
            os.kill(pid, 0)
