"""Worker processes pinned to a core each."""

import os
import time

import pytest

from wingbeat.orbits.many.batch import in_processes, spread
from wingbeat.workers.affinity import core_count, cores_of, pin_to, usable_cores

CORES = usable_cores()
several = pytest.mark.skipif(not 1 < len(CORES) < 33, reason="there is one core, or none to pin to, or very many")


def own_cores(_):
    return sorted(os.sched_getaffinity(0))


def slowly_told(_):
    time.sleep(0.5)
    return os.getpid(), own_cores(None)


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


@several
def test_processes_of_a_batch_are_pinned_to_a_core_each_and_this_one_to_none():
    with spread(len(CORES), len(CORES)) as over:
        found = {process: cores for process, cores in over(slowly_told, range(4 * len(CORES)))}
    assert sorted(found.values()) == [[core] for core in CORES[: len(found)]]
    assert len(found) > 1
    assert own_cores(None) == CORES


@several
def test_fewer_processes_than_cores_go_where_there_is_room():
    assert list(in_processes(own_cores, range(3), len(CORES) + 1)) == [CORES] * 3
