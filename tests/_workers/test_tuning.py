"""Worker processes pinned to a core each."""

import os
import subprocess
import sys

import pytest

from wingbeat._workers.tuning import core_count, cores_of, pin_to, usable_cores

CORES = usable_cores()
several = pytest.mark.skipif(not 1 < len(CORES) < 33, reason="there is one core, or none to pin to, or very many")


def own_cores(_):
    return sorted(os.sched_getaffinity(0))


def test_processes_have_a_core_each_where_they_take_all(monkeypatch):
    monkeypatch.setattr(os, "sched_getaffinity", lambda process: {5, 3}, raising=False)
    assert cores_of(2) == [3, 5]
    assert cores_of(1) == [None]
    assert cores_of(3) == [None] * 3
    monkeypatch.delattr(os, "sched_getaffinity")
    assert cores_of(2) == [None, None]
    assert core_count() == (os.cpu_count() or 1)


@several
def test_no_core_and_one_that_is_not_there_change_nothing():
    for core in (None, 100_000):
        pin_to(core)
        assert own_cores(None) == CORES


COMPUTES = """
import pathlib, wingbeat._workers.tuning as tuning
tuning.tune_process()
import jax
jax.block_until_ready(jax.jit(lambda a: a @ a)(jax.numpy.ones((300, 300))))
names = [file.read_text().strip() for file in pathlib.Path("/proc/self/task").glob("*/comm")]
print(names.count("tf_XLAEigen"))
"""


@pytest.mark.skipif(not os.path.isdir("/proc/self/task"), reason="counts threads in /proc")
@pytest.mark.parametrize(("variables", "threads"), [({}, 1), ({"PJRT_NPROC": "3"}, 3), ({"NPROC": "3"}, 3)])
def test_xla_computes_in_one_thread_unless_the_user_chose_another_number(variables, threads):
    # JAX 0.10.2: threads named tf_XLAEigen are those to which XLA hands parts of a program. Neither
    # xla_cpu_multi_thread_eigen nor OMP_NUM_THREADS changes their number, these two variables do.
    mine = {name: value for name, value in os.environ.items() if name not in ("PJRT_NPROC", "NPROC")}
    done = subprocess.run([sys.executable, "-c", COMPUTES], env=mine | variables, capture_output=True, text=True)
    assert done.stdout.split() == [str(threads)], done.stderr
