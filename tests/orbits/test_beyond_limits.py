"""Where no orbit is plausible, the message names the limits that the best orbit without them leaves."""

import dataclasses
import re

import numpy as np
import pytest

import wingbeat as wb
from wingbeat.orbits.changes import possible_changes
from wingbeat.orbits.diagnosis import least_change
from wingbeat.orbits.options import DEFAULTS
from wingbeat.orbits.solve import Settings, find_orbit


@pytest.fixture(scope="module")
def bat():
    """The bat of Su et al. at 10 m/s, which flies, but not as live bats do."""
    return wb.OrbitProblem(wb.load_species("bat"), speed=10.0, bounds="plausible")


@pytest.mark.slow
def test_the_message_says_which_limits_the_best_orbit_leaves_and_how_far_one_must_move(bat):
    """The values of another search, of a problem without limits, by NumPy from its series; the change, flown."""
    found = find_orbit(bat, Settings(2))
    assert found.status is wb.Status.INFEASIBLE
    assert "within the limits" in found.message
    free = find_orbit(dataclasses.replace(bat, subject_to=()), Settings(2))
    assert free.status is wb.Status.CONVERGED
    beat, mass = free.beat(), bat.vehicle.mass
    force = np.hypot(np.asarray(beat.force_x), np.asarray(beat.force_z))
    values = {
        "positive power per mass": np.maximum(np.asarray(beat.hinge_power), 0.0)[:-1].mean() / mass,
        "peak force over weight": force.max() / (mass * bat.air.gravity),
    }
    said = found.message.partition("without them has ")[2]
    told = {name: float(value) for name, value in re.findall(r"(\b[a-z ]+?) ([-\d.]+) \(at (?:most|least)", said)}
    for name, value in values.items():
        if name in told:
            assert told[name] == pytest.approx(value, rel=2e-2), name
    assert set(told) & set(values)
    for change in found.relaxations:
        moved = find_orbit(change.apply(bat), Settings(2))
        assert moved.status is wb.Status.CONVERGED, change.text


@pytest.mark.slow
def test_where_no_limit_is_to_blame_the_message_says_that_too():
    """A pigeon so heavy that no wingbeat within its bounds carries it."""
    heavy = wb.load_species("pigeon").with_values({"body.mass": 0.8})
    found = find_orbit(wb.OrbitProblem(heavy, speed=6.0, bounds="plausible"), Settings(2))
    assert found.status is wb.Status.INFEASIBLE
    said, _, without = found.message.partition("; without them, ")
    assert said == "no orbit within the limits"
    assert without.startswith("no orbit within the bounds from 2 starts: at 6 m/s, lift is short by")
    # The changes that the message goes on to name are those of the problem without limits.
    assert "changes that give an orbit" in without
    assert found.relaxations == ()
    assert found.deficits


@pytest.mark.slow
def test_a_limit_of_stability_is_one_of_the_limits_that_the_best_orbit_leaves(bat):
    stable = dataclasses.replace(bat, subject_to=(*bat.subject_to, "spectral_radius<=0.995"), bounds="plausible")
    found = find_orbit(stable, Settings(1, most_starts=1, advise=False))
    assert found.status is wb.Status.INFEASIBLE
    free = find_orbit(dataclasses.replace(bat, subject_to=()), Settings(1))
    radius = np.abs(free.multipliers).max()
    said = re.search(r"spectral radius ([.\d]+) \(at most 0.995\)", found.message)
    assert float(said[1]) == pytest.approx(radius, rel=5e-3)


@pytest.mark.slow
def test_a_limit_of_stability_is_moved_as_little_as_an_orbit_needs():
    """The least move is that to the radius of the orbit without the limit, which a search of its own finds."""
    problem = wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0)
    free = find_orbit(problem, Settings(2))
    radius = np.abs(free.multipliers).max()
    stable = dataclasses.replace(problem, subject_to=["spectral_radius<=0.2"])
    change = next(c for c in possible_changes(stable, (), {}) if c.name == "spectral_radius")
    least = least_change(stable, change, free.unknowns, DEFAULTS)
    assert 0.2 < change.moved(least.share) <= radius * 1.01
