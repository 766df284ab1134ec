"""How many cores a process may use, and how many threads XLA has in it."""

import os
import subprocess
import sys

import pytest

from wingbeat._workers.tuning import core_count


def test_cores_are_those_that_the_process_may_use(monkeypatch):
    monkeypatch.setattr(os, "sched_getaffinity", lambda process: {5, 3}, raising=False)
    assert core_count() == 2
    monkeypatch.delattr(os, "sched_getaffinity")
    assert core_count() == (os.cpu_count() or 1)


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
