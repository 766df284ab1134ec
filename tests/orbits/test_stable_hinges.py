"""Limits of stability for a wing whose pitch gives way: the map has the hinge's angle and rate, too."""

import dataclasses

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.differences import differences, miss
from wingbeat.mechanics.flights import fly_through
from wingbeat.orbits.flight.certificate import map_and_changes
from wingbeat.orbits.flight.period import flier
from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.orbits.solve import Settings, find_orbit

pytestmark = pytest.mark.slow

STABLE = "spectral_radius<=0.995"


@pytest.fixture(scope="module")
def problem():
    """At its own frequencies, up to 7.5 Hz, this robot has no stable orbit; up to 9 Hz it has one."""
    robot = wb.load_species("robofalcon2").with_values(
        {"pitch_hinge.stiffness": 1.49, "pitch_hinge.damping": 0.0163}
    )
    asked = {"minimise": "mean_positive_power", "subject_to": [STABLE], "bounds": {"frequency": (0.5, 9.0)}}
    return wb.OrbitProblem(robot, speed=8.0, **asked)


@pytest.fixture(scope="module")
def free(problem):
    return wb.solve_orbit(dataclasses.replace(problem, subject_to=()), starts=1)


@pytest.fixture(scope="module")
def stable(problem):
    return wb.solve_orbit(problem, starts=1)


def near(problem, orbit):
    """Return unknowns near the orbit's, off the optimum and its bounds."""
    unknowns = problem.unknowns_of(orbit.initial_state, orbit.wingbeat)
    return unknowns * np.random.default_rng(4).uniform(0.95, 0.99, unknowns.size)


@pytest.mark.parametrize("blocks", [1, 2])
def test_changes_of_the_map_follow_the_hinge_that_repeats(problem, free, blocks):
    fly, at = flier(problem.model, problem.species.wingbeat, problem.free), near(problem, free)

    def stroke_map(unknowns):
        for _ in range(2):  # the second flight starts with the hinge that repeats
            flown = fly(unknowns[4:], unknowns[:4], blocks)
        return flown.stroke_map

    found, changes = map_and_changes(fly, at[4:], at[:4], blocks, fly(at[4:], at[:4], blocks))
    assert found.shape == (6, 6)
    np.testing.assert_allclose(found, stroke_map(at), atol=1e-9)
    for own, step in zip(changes, np.diag(1e-5 * np.maximum(1.0, np.abs(at))), strict=True):
        expected = (stroke_map(at + step) - stroke_map(at - step)) / (2.0 * step.sum())
        assert np.abs(own - expected).max() < 3e-5 * np.abs(expected).max()


@pytest.mark.parametrize("limit", [STABLE, "gust_response<=3"])
def test_margins_of_the_programme_have_exact_derivatives(problem, free, stable, limit):
    programme = Transcription(dataclasses.replace(problem, subject_to=[limit]))
    # Beyond the circle the gust response is a penalty, whose slope is not exact.
    at = near(problem, free) if limit == STABLE else problem.unknowns_of(stable.initial_state, stable.wingbeat)
    found = differences(programme.inequalities, point := programme.scaled(at), 1e-4)
    assert miss(programme.inequalities_jacobian(point), found) < 1e-4


def test_the_robot_that_is_unstable_has_a_stable_orbit(problem, free, stable):
    assert not free.record()["stable"]
    record = stable.record()
    assert stable.status is wb.Status.CONVERGED, stable.message
    assert record["stable"]
    assert record["hinge_closure"] <= 1e-8
    assert 0.0 < record["mean_positive_power"] / free.record()["mean_positive_power"] - 1.0 < 0.06
    # The independent map: differences of adaptive flights of all eight states.
    start, phases = np.append(np.array(stable.initial_state), stable.hinge_start), np.linspace(0.0, 1.0, 5)

    def end(state):
        hinge = (state[6:],)
        return fly_through(problem.model, stable.wingbeat, wb.State(*state[:6]), phases, 1e-11, wake=hinge)[0][-1]

    columns = [(end(start + 1e-5 * e) - end(start - 1e-5 * e))[2:] / 2e-5 for e in np.eye(8)[2:]]
    flown = np.sort(np.abs(np.linalg.eigvals(np.transpose(columns))))[::-1]
    assert flown[0] <= 0.995
    own = np.abs([complex(*one) for one in record["floquet_multipliers"]])
    np.testing.assert_allclose(flown[:4], own, rtol=2e-4)
    assert record["constraints"][STABLE] == pytest.approx(flown[0], rel=1e-4)


def test_it_is_said_if_no_stable_orbit_is_found(problem):
    held = dataclasses.replace(problem, bounds={"frequency": (0.5, 7.5)})
    found = find_orbit(held, Settings(1, most_starts=1, advise=False), threads=1)
    assert found.status is wb.Status.INFEASIBLE
    assert f"at 8 m/s with {STABLE}, a nose-up pitching moment" in found.message


def test_derivatives_of_the_multipliers_know_the_hinge(free):
    found = wb.stability_sensitivities(free)
    own = np.sort(np.abs([complex(*one) for one in free.record()["floquet_multipliers"]]))
    np.testing.assert_allclose(np.sort(np.abs(found.multipliers)), own, rtol=1e-3)
    slopes = (one for one in found.sensitivities.slopes if one.parameter.path == "pitch_hinge.stiffness")
    assert found.by_parameter["pitch_hinge.stiffness"][0].real == pytest.approx(
        next(slopes).quantities["spectral_radius"], rel=1e-3
    )


def test_a_map_quantity_of_your_own_has_the_hinges_states(problem, free):
    sizes = []

    def of(stroke_map):
        sizes.append(stroke_map.shape)
        return stroke_map.trace()

    trace = wb.MapQuantity("trace", of)
    limited = dataclasses.replace(problem, subject_to=[wb.Constraint(trace, 3.0)])
    found = wb.solve_orbit(limited, starts=1, start=free)
    assert found.status is wb.Status.CONVERGED, found.message
    assert found.record()["constraints"]["trace<=3"] <= 3.0 + 1e-5
    assert set(sizes) == {(6, 6)}


def test_the_lag_of_the_wake_is_refused(problem):
    with pytest.raises(wb.InvalidInputError, match=r"aero.wake = 'jones-section': is not built"):
        dataclasses.replace(problem, aero=wb.aero.BladeElement(wb.aero.SuFan(), wake="jones-section"))
