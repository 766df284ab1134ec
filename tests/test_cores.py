"""Worker processes that keep to a core each."""

import os

import pytest

from wingbeat.cores import cores_of, pin_to
from wingbeat.orbits.batch import in_processes

CORES = sorted(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else []
several = pytest.mark.skipif(
    len(CORES) < 2, reason="there is one core only, or the system lets no process keep to one"
)


def own_cores(_):
    return sorted(os.sched_getaffinity(0))


def test_processes_have_a_core_each_where_they_take_all(monkeypatch):
    monkeypatch.setattr(os, "sched_getaffinity", lambda process: {5, 3}, raising=False)
    assert cores_of(2) == [3, 5]
    assert cores_of(1) == [None]
    assert cores_of(3) == [None] * 3
    monkeypatch.delattr(os, "sched_getaffinity")
    assert cores_of(2) == [None, None]


@several
def test_nobody_is_kept_to_no_core():
    pin_to(None)
    assert own_cores(None) == CORES


@several
def test_processes_of_a_batch_pin_to_one_core_and_this_one_to_none():
    found = list(in_processes(own_cores, range(8), len(CORES)))
    assert {len(cores) for cores in found} == {1}
    assert {core for (core,) in found} <= set(CORES)
    assert own_cores(None) == CORES


@several
def test_fewer_processes_than_cores_go_where_there_is_room():
    assert list(in_processes(own_cores, [0], len(CORES) + 1)) == [CORES]
