"""Stability, gusts and feedback of a wing whose pitch gives way."""

import numpy as np
import pytest

import wingbeat as wb
from wingbeat.mechanics.flights import fly_through

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def orbit():
    numbers = {"pitch_hinge.stiffness": 1.4, "pitch_hinge.damping": 0.0166}
    robot = wb.load_species("robofalcon2").with_values(numbers)
    found = wb.solve_orbit(wb.OrbitProblem(robot, speed=8.0, minimise="mean_positive_power"), starts=4)
    assert found.status is wb.Status.CONVERGED
    return found


@pytest.fixture(scope="module")
def flight(orbit):
    return wb.linearise(orbit)


def test_the_map_is_the_derivative_of_the_certifiers_flight(orbit, flight):
    assert flight.state == ("body_pitch", "u", "w", "pitch_rate", "hinge_angle", "hinge_rate")
    start = np.append(np.array(orbit.initial_state), orbit.hinge_start)

    model, beat, phases = orbit.problem.model, orbit.wingbeat, np.linspace(0.0, 1.0, 5)

    def end(state):
        return fly_through(model, beat, state[:6], phases, 1e-11, wake=(state[6:],))[0][-1]

    columns = [(end(start + 1e-5 * e) - end(start - 1e-5 * e))[2:] / 2e-5 for e in np.eye(8)[2:]]
    np.testing.assert_allclose(flight.A, np.transpose(columns), atol=3e-5 * np.abs(flight.A).max())


def test_two_modes_more_are_the_hinges_and_die_out(orbit, flight):
    certified = np.abs([complex(*pair) for pair in orbit.record()["floquet_multipliers"]])
    sizes = sorted((abs(mode.multiplier) for mode in flight.modes), reverse=True)
    assert sizes[0] == pytest.approx(certified[0], rel=1e-4)
    last = flight.modes[-1]
    assert abs(last.multiplier) < 0.1
    assert last.shares["hinge_rate"] + last.shares["hinge_angle"] > 0.5


def test_feedback_that_does_not_know_the_hinge_holds_the_robot_in_gusts(orbit):
    held = wb.feedback(orbit)
    assert held.flight.state == ("z", "body_pitch", "u", "w", "pitch_rate")
    found = wb.survey_gusts(orbit, {"open": None, "held": held}, flights=40, size=3.0, beats=30, seed=1)
    assert found.share("held") > 0.9 > found.share("open")


def test_what_does_not_know_the_hinge_says_so(orbit):
    for asked in (lambda: wb.feedback_in_beat(orbit), lambda: wb.manoeuvre(orbit, [8.0, 9.0])):
        with pytest.raises(wb.InvalidInputError, match="gives way"):
            asked()


def test_a_gust_flight_starts_with_the_orbits_hinge(orbit):
    from wingbeat.stability.gust_flights import fly_gust

    calm = fly_gust(orbit, (0.0, 0.0), beats=2)
    assert np.abs(calm.pitch).max() < 1e-5
    np.testing.assert_allclose(calm.flight.hinge[0], orbit.hinge_start)
