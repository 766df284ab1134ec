"""Orbits, curves, flights and polars can be pickled, copied and sent to another process, and stay what they are."""

import copy
import functools
import multiprocessing
import operator
import pickle
from concurrent.futures import ProcessPoolExecutor

import numpy as np
import pytest

import wingbeat as wb
from wingbeat.orbits.problem.parameters import parameters_of
from wingbeat.orbits.problem.quantities import QUANTITIES
from wingbeat.orbits.problem.quantity import MAP_QUANTITIES

PIGEON = wb.load_species("pigeon")
PROBLEM = wb.OrbitProblem(PIGEON, speed=10.0)


@pytest.fixture(scope="module")
def spawned():
    """Return a function: what another process, started afresh for these tests, makes of a thing."""
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
        yield lambda work, thing: pool.submit(work, thing).result(timeout=120)


@pytest.fixture
def few_derivatives(monkeypatch):
    """Sensitivities by the first four parameters only, each of which takes as long as a search."""
    monkeypatch.setattr("wingbeat.results.sensitivities.parameters_of", lambda problem: parameters_of(problem)[:4])


def assert_same_series(one, other):
    """Every number is the same to the last bit, and every unit and attribute."""
    assert one.attrs == other.attrs
    assert list(one.variables) == list(other.variables)
    for name in one.variables:
        assert one[name].attrs == other[name].attrs
        np.testing.assert_array_equal(one[name].values, other[name].values)


@pytest.fixture(scope="module")
def orbit():
    return wb.solve_orbit(PROBLEM, starts=1)


@pytest.mark.parametrize("copied", [lambda o: pickle.loads(pickle.dumps(o)), copy.deepcopy, copy.copy])
def test_a_copied_orbit_is_the_same_to_the_last_bit(orbit, copied):
    again = copied(orbit)
    assert again.record() == orbit.record()
    assert_same_series(again.dataset, orbit.dataset)
    assert (again.inputs, again.status, again.wingbeat) == (orbit.inputs, orbit.status, orbit.wingbeat)
    assert again.problem == orbit.problem


@pytest.mark.usefixtures("few_derivatives")
def test_a_pickled_orbit_is_differentiated_and_saved_as_the_first(orbit, tmp_path):
    again = pickle.loads(pickle.dumps(orbit))
    assert wb.sensitivities(again).table() == wb.sensitivities(orbit).table() != []
    again.save(tmp_path / "again.nc")
    loaded = pickle.loads(pickle.dumps(wb.load_orbit(tmp_path / "again.nc")))
    assert loaded.record() == orbit.record()
    assert_same_series(loaded.dataset, orbit.dataset)


@pytest.mark.slow
def test_an_orbit_crosses_processes_both_ways(spawned):
    """There its series are made of what was flown here; back they come as they were made."""
    fresh = wb.solve_orbit(PROBLEM, starts=1)
    record = spawned(operator.methodcaller("record"), fresh)
    assert record == fresh.record()
    assert_same_series(spawned(operator.attrgetter("dataset"), fresh), fresh.dataset)
    there = spawned(functools.partial(wb.solve_orbit, starts=1), PROBLEM)
    assert there.status is wb.Status.CONVERGED
    assert pickle.loads(pickle.dumps(there)).record() == there.record()


def test_an_orbit_of_a_record_can_be_pickled(orbit):
    told = wb.Orbit.of_record(orbit.record(), PROBLEM, 1)
    again = pickle.loads(pickle.dumps(told))
    assert again.record() == orbit.record()
    assert_same_series(again.dataset, told.dataset)


def test_curves_flights_and_polars_can_be_pickled(spawned):
    curve = wb.solve_curve(PROBLEM, [10.0, 11.0], starts=1)
    again = spawned(copy.deepcopy, curve)
    assert again.record() == curve.record()
    assert_same_series(again.dataset, curve.dataset)
    flight = wb.simulate(PROBLEM.model, PIGEON.wingbeat, wb.State(u=10.0), beats=1)
    assert_same_series(pickle.loads(pickle.dumps(flight)).dataset, flight.dataset)
    polar = wb.glide_polar(PIGEON, angles_of_attack=np.radians([4.0, 6.0, 8.0]))
    again = pickle.loads(pickle.dumps(polar))
    assert again.record() == polar.record()
    assert_same_series(again.dataset, polar.dataset)


@pytest.mark.parametrize("name", [*QUANTITIES, *MAP_QUANTITIES])
def test_every_quantity_can_be_sent_to_another_process(name):
    limit = wb.Constraint(name, 1.0)
    assert pickle.loads(pickle.dumps(limit)) == limit


def lift_of_the_beat(beat):
    return beat.mean(beat.lift.sum(axis=1))


@pytest.mark.slow
@pytest.mark.usefixtures("few_derivatives")
def test_an_orbit_with_a_function_of_ones_own_keeps_its_problem():
    """No file holds the function, but the orbit in memory does, and so does its pickle."""
    limit = wb.Constraint(wb.Quantity("mean_lift", lift_of_the_beat, "N"), 0.1, at_most=False)
    orbit = wb.solve_orbit(wb.OrbitProblem(PIGEON, speed=10.0, subject_to=[limit]), starts=1)
    again = pickle.loads(pickle.dumps(orbit))
    assert again.problem.subject_to == (limit,)
    assert again.record() == orbit.record()
    assert wb.sensitivities(again).table() == wb.sensitivities(orbit).table() != []
