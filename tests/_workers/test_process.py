"""One worker process: what it says, how it ends, and that it ends with its owner."""

import os
import queue
import signal
import subprocess
import sys
import time

import pytest

from tests.explorer.app.program import wait_gone
from wingbeat._leftovers import clear_leftovers
from wingbeat._workers.process import Message, WorkerProcess

PATIENCE = 60.0


class Heard(queue.SimpleQueue):
    """What a worker said."""

    def until_end(self):
        """Return what it says until it has ended."""
        return list(iter(lambda: self.get(timeout=PATIENCE), None))


@pytest.fixture
def start():
    workers = []

    def started(work="tests.helpers.worker_standin:do", **settings):
        heard = Heard()
        workers.append(WorkerProcess(work, heard.put, **settings))
        return workers[-1], heard

    yield started
    for worker in workers:
        worker.kill()
        worker.bury()


def test_it_says_what_becomes_of_each_request(start):
    worker, heard = start()
    worker.request(("steps", 2))
    worker.request(("fail", "so"))
    said = [heard.get(timeout=PATIENCE) for _ in range(7)]
    assert [message.kind for message in said] == [
        "ready",
        "started",
        "progress",
        "progress",
        "done",
        "started",
        "failed",
    ]
    assert [message.value for message in said[2:4]] == [[0, 2], [1, 2]]
    assert (type(said[-1].value), str(said[-1].value)) == (ValueError, "so")
    assert "in do\n" in said[-1].value.__notes__[0]


def test_a_stop_is_for_the_requests_before_it_alone(start):
    worker, heard = start()
    worker.request(("steps", 100_000))
    worker.request(("steps", 100_000))
    worker.stop()
    worker.request(("steps", 1))
    kinds = [heard.get(timeout=PATIENCE).kind for _ in range(8)]
    assert kinds == ["ready", "started", "stopped", "started", "stopped", "started", "progress", "done"]


def test_what_cannot_be_brought_back_is_told_in_words(start):
    worker, heard = start()
    worker.request(("fail oddly", 1))
    *_, failed = (heard.get(timeout=PATIENCE) for _ in range(3))
    assert (type(failed.value), str(failed.value)) == (RuntimeError, "OddError: 1 1")
    assert "in a worker process" in failed.value.__notes__[0]


def test_it_leaves_without_a_fault_after_the_request_with_which_it_outgrew_its_memory(start, capfd):
    """While its thread reads from the pipe: through ``sys.stdin`` it aborted, exit code 134."""
    worker, heard = start(memory=1)
    worker.request(("echo", 0))
    assert [message.kind for message in heard.until_end()] == ["ready", "started", "leaving", "done"]
    assert worker.bury() == "exit code 0"
    assert capfd.readouterr().err == ""


@pytest.mark.parametrize(
    ("what", "ending"),
    [
        (("die", 7), "exit code 7"),
        (("exit", 7), "exit code 7"),
        (("hoard", 1 << 40), "exit code 12: out of memory"),
    ],
)
def test_its_end_is_told_in_words(start, capfd, what, ending):
    worker, heard = start()
    worker.request(what)
    assert heard.until_end()[1:] == [Message("started")]
    assert worker.bury() == ending
    assert capfd.readouterr().err == ""


def test_one_that_is_silent_for_too_long_ends_itself_whatever_it_does(start):
    worker, heard = start(silence=0.5)
    worker.request(("steps", 50))  # of 0.02 s each
    assert [heard.get(timeout=PATIENCE) for _ in range(53)][-1].kind == "done"
    time.sleep(0.7)  # it has no work
    worker.request(("deaf", 1000.0))
    assert heard.until_end() == [Message("started")]
    assert worker.bury() == "exit code 1"


def test_a_request_of_any_size_is_taken_while_it_still_imports(start):
    worker, heard = start("wingbeat_explorer.app.jobs:do")
    worker.request("x" * 10_000_000)
    assert heard.empty()
    assert heard.get(timeout=PATIENCE).kind == "ready"


def test_what_it_prints_is_no_message(start, capfd):
    worker, heard = start("builtins:print")
    worker.request("words")
    assert [heard.get(timeout=PATIENCE).kind for _ in range(3)] == ["ready", "started", "done"]
    worker.kill()
    worker.bury()
    assert "words" in capfd.readouterr().err


def test_none_outlives_a_process_that_ends_at_once(start):
    worker, heard = start()
    assert heard.get(timeout=PATIENCE).kind == "ready"
    clear_leftovers()
    assert heard.until_end() == []
    assert worker.bury().startswith("SIGKILL")


@pytest.mark.parametrize("work", ["tests.helpers.worker_standin:do", "wingbeat_explorer.app.jobs:do"])
def test_one_whose_owner_was_killed_ends_whatever_it_does(work):
    """At work, and while it imports."""
    script = f"""if True:
        import queue, time
        from wingbeat._workers.process import WorkerProcess
        heard = queue.SimpleQueue()
        worker = WorkerProcess({work!r}, heard.put)
        worker.request(("deaf", 1000.0))
        if "standin" in {work!r}:
            assert [heard.get().kind, heard.get().kind] == ["ready", "started"]
        print(worker.pid, flush=True)
        time.sleep(1000.0)
    """
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(sys.path)}
    owner = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, text=True, env=environment)
    worker = int(owner.stdout.readline())
    owner.send_signal(signal.SIGKILL)
    owner.communicate()
    wait_gone([worker])
