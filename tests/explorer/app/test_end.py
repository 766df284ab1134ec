"""How the explorer and its solvers end: at once, told in words, nothing left behind."""

import math
import resource
import socket
import threading
from pathlib import Path

import pytest

from tests.explorer.app.program import PATIENCE, Program, wait_gone
from wingbeat_explorer.app.links import to_plain
from wingbeat_explorer.app.scenario import Scenario
from wingbeat_explorer.app.session import FairPool


def ended(pool, what):
    """Return how a job ended."""
    over, endings = threading.Event(), []

    def hear(event):
        if event.ends:
            endings.append(event)
            over.set()

    assert pool.submit("a", what, hear) is not None
    assert over.wait(2 * PATIENCE)
    return endings[0]


@pytest.mark.slow
def test_a_solver_without_memory_is_told_of_and_replaced():
    pool = FairPool("wingbeat_explorer.app.jobs:do", 1)
    question = {"do": "orbit", "scenario": to_plain(Scenario(starts=1))}
    try:
        assert ended(pool, {"do": "no such thing"}).kind == "failed"  # it runs now, and has solved nothing yet
        (worker,) = pool.workers
        pages = int(Path(f"/proc/{worker}/statm").read_text().split()[0])
        limit = pages * resource.getpagesize(), resource.RLIM_INFINITY
        resource.prlimit(worker, resource.RLIMIT_AS, limit)
        ending = ended(pool, question)
        assert ending.kind == "lost"
        assert "exit code" in ending.value
        assert "memory" in ending.value
        assert ended(pool, question).kind == "done"
    finally:
        pool.close()


@pytest.fixture
def start(tmp_path, explorers):
    programs = []

    def started():
        programs.append(Program(explorers, tmp_path))
        return programs[-1]

    yield started
    for program in programs:
        program.end()


LONG = "species=bat&speed=10&starts=100"


def solving(page):
    """Wait until something is being solved for a page."""
    while "Solving" not in page.recv(PATIENCE):
        pass


def interrupted_while_browsers_linger(program):
    """Return exit code and seconds of Ctrl-C amid a search and an upload, and the workers there were."""
    client, session = program.open_page(LONG)
    with program.connect(client) as page, socket.create_connection(("127.0.0.1", program.port)) as slow:
        solving(page)
        # a file of which the rest never comes, as from a browser that was suspended
        head = f"POST /wingbeat/upload/{session}?name=x HTTP/1.1\r\nHost: 127.0.0.1:{program.port}\r\n"
        slow.sendall(f"{head}Content-Length: 1000\r\nExpect: 100-continue\r\n\r\n".encode())
        assert b"100" in slow.recv(100)  # it is being read
        workers = program.workers()
        return *program.interrupt(), workers


@pytest.mark.slow
def test_ctrl_c_ends_the_explorer_within_two_seconds_though_browsers_linger(start):
    shortest = math.inf
    for _ in range(3):  # whatever else keeps the machine busy can only make it longer
        program = start()
        code, seconds, workers = interrupted_while_browsers_linger(program)
        assert code == 130
        assert program.log.read_text() == "error: interrupted\n"
        assert workers
        wait_gone(workers)
        shortest = min(shortest, seconds)
        if shortest < 2.0:
            break
    assert shortest < 2.0


@pytest.mark.slow
def test_a_killed_explorer_leaves_no_worker(start):
    program = start()
    client, _ = program.open_page(LONG)
    with program.connect(client) as page:
        solving(page)
        workers = program.workers()
        program.process.kill()
    assert workers
    wait_gone(workers)
