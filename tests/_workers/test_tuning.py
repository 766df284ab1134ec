"""Worker processes pinned to a core each."""

import os

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
