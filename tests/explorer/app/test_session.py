"""What a page is told of its search."""

import asyncio
import contextlib
from concurrent.futures import ThreadPoolExecutor

from wingbeat._workers.pool import Event
from wingbeat_explorer.app.scenario import Scenario
from wingbeat_explorer.app.session import Session


class Shown:
    """A page that notes what it was told."""

    def __init__(self):
        self.states = []

    def context(self):
        return contextlib.nullcontext()

    def show_state(self, text, busy, done=None):
        self.states.append((text, done))

    def show_scenario(self, scenario):
        pass

    show_stale = show_refusals = show_answer = show_scenario


class Pool:
    """A pool that solves nothing, and tells what it is asked to."""

    def submit(self, session, what, tell, background=False):
        self.tell = tell
        return object()


def test_no_more_searches_are_done_than_were_asked_for():
    async def visit():
        page, pool = Shown(), Pool()
        Session("a", pool, Scenario(), page).ask(whole=True)
        for done in (11, 12, 13):
            pool.tell(Event("progress", [done, 12]))
        await asyncio.sleep(0)
        return page.states

    # In a thread of its own: where a browser was driven before, this one has a running loop.
    with ThreadPoolExecutor(1) as thread:
        states = thread.submit(asyncio.run, visit()).result()
    assert states == [
        ("Solving: 11 of 12 starts.", 11 / 12),
        ("Solving: 12 of 12 starts.", 1.0),
        ("Solving: 12 of 12 starts.", 1.0),
    ]


def test_it_rests_only_once_the_search_that_follows_a_continued_answer_has_ended(monkeypatch):
    monkeypatch.setattr("wingbeat_explorer.app.session._CALM", 0.0)
    answer = {"record": {"objective_value": 1.0}, "near": {}, "seconds": 0.0}

    async def visit():
        pool = Pool()
        session = Session("a", pool, Scenario(), Shown())
        rests = [session.rests]
        session.ask(whole=True)
        for found in ({**answer, "continued": True}, answer):
            rests.append(session.rests)
            pool.tell(Event("done", dict(found)))
            await asyncio.sleep(0.01)
        return [*rests, session.rests]

    with ThreadPoolExecutor(1) as thread:
        assert thread.submit(asyncio.run, visit()).result() == [True, False, False, True]


def test_the_search_that_follows_waits_longer_after_a_long_continuation():
    async def visit(seconds):
        pool, waits = Pool(), []
        session = Session("a", pool, Scenario(), Shown())
        loop = asyncio.get_running_loop()
        call_later = loop.call_later
        loop.call_later = lambda delay, *rest: waits.append(delay) or call_later(delay, *rest)
        session.ask(whole=True)
        found = {"record": {"objective_value": 1.0}, "near": {}, "seconds": seconds, "continued": True}
        pool.tell(Event("done", found))
        await asyncio.sleep(0)
        session.stop()
        return waits

    with ThreadPoolExecutor(1) as thread:
        assert thread.submit(asyncio.run, visit(0.02)).result() == [0.35]
        assert thread.submit(asyncio.run, visit(0.5)).result() == [1.5]
        assert thread.submit(asyncio.run, visit(40.0)).result() == [2.0]  # it was compiled


def test_a_move_does_not_wait_for_the_search_that_follows_a_failed_continuation():
    async def visit():
        page, pool = Shown(), Pool()
        session = Session("a", pool, Scenario(), page)
        session.answer = {"near": {}}
        asked = []
        submit = pool.submit
        pool.submit = lambda name, what, *rest: asked.append(what["scenario"]["speed"]) or submit(name, what, *rest)
        pool.cancel = lambda job: None
        session.change(speed=11.0)
        session.change(speed=12.0)  # the continuation of the first is awaited
        before = list(asked)
        pool.tell(Event("progress", [1, 12]))
        await asyncio.sleep(0)
        return before, asked

    with ThreadPoolExecutor(1) as thread:
        before, asked = thread.submit(asyncio.run, visit()).result()
    assert before == [11.0]
    assert asked == [11.0, 12.0]
