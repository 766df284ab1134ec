"""A map over worker processes: the results of Python's own map, whoever dies."""

import functools
import gc
import os
import signal
import subprocess
import sys
import textwrap
import time

import pytest

import wingbeat as wb
from tests.explorer.app.program import wait_gone
from wingbeat._workers.pool import in_processes, process_map


def slowly_told(_):
    time.sleep(0.5)
    return os.getpid()


def first_threshold(_):
    return gc.get_threshold()[0]


def half(number):
    if number < 0:
        raise ValueError(number)
    return number / 2


def die_once(number, mark):
    """Kill the process of a number below 0, the first time only if `mark` is a file that is not there yet."""
    if number < 0 and not (mark and os.path.exists(mark)):
        if mark:
            open(mark, "x").close()
        os.kill(os.getpid(), signal.SIGKILL)
    return number


def test_processes_look_for_garbage_seldom_and_this_one_as_it_was_told_to():
    own = gc.get_threshold()
    assert list(in_processes(first_threshold, [0, 1], 2)) == [50_000, 50_000]
    assert list(in_processes(first_threshold, [0], 1)) == [own[0]]


@pytest.mark.parametrize("processes", [1, 2])
def test_results_come_in_order_and_an_exception_at_its_turn(processes):
    done = []
    results = in_processes(half, [4, 3, -1, 2], processes, lambda *how: done.append(how))
    assert [next(results), next(results)] == [2.0, 1.5]
    with pytest.raises(ValueError, match="-1"):
        next(results)
    assert done == [(1, 4), (2, 4)]


def test_an_item_whose_process_dies_once_costs_nothing(tmp_path):
    work = functools.partial(die_once, mark=str(tmp_path / "mark"))
    assert list(in_processes(work, [1, -1, 2], 2)) == [1, -1, 2]


def test_an_item_whose_process_dies_twice_is_told():
    work = functools.partial(die_once, mark="")
    with pytest.raises(wb.WorkerError, match="ended with SIGKILL, exit code 137"):
        list(in_processes(work, [1, -1, 2], 2))


def test_none_is_left_when_it_is_given_up():
    with process_map(2, 2) as over:
        pids = list(over(slowly_told, range(4)))
        over(slowly_told, range(100))
    wait_gone(pids)


def run(tmp_path, text):
    path = tmp_path / "script.py"
    path.write_text(textwrap.dedent(text))
    return subprocess.run([sys.executable, str(path)], capture_output=True, text=True, check=False, timeout=300)


def test_a_script_without_a_guard_may_share_work_that_is_not_its_own(tmp_path):
    ended = run(
        tmp_path,
        """
        import math
        from wingbeat._workers.pool import in_processes
        print(list(in_processes(math.sqrt, [4.0, 9.0], 2)))
        """,
    )
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "[2.0, 3.0]\n", "")


WITH_OWN_WORK = """
from wingbeat._workers.pool import in_processes
class Doubled:
    def __init__(self, number):
        self.number = 2 * number
{guard}
    print([doubled.number for doubled in in_processes(Doubled, [1, 2], 2)])
"""


def test_a_script_with_a_guard_may_share_work_of_its_own(tmp_path):
    ended = run(tmp_path, WITH_OWN_WORK.format(guard='if __name__ == "__main__":'))
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "[2, 4]\n", "")


def test_a_script_without_a_guard_is_told_that_work_of_its_own_needs_one(tmp_path):
    ended = run(tmp_path, WITH_OWN_WORK.format(guard="if True:"))
    assert ended.returncode == 1
    assert ended.stdout == ""
    assert "if __name__ == '__main__':" in ended.stderr
