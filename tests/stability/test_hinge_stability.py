"""Stability, gusts and feedback of a wing whose pitch gives way."""

import functools
import json
import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import wingbeat as wb
from tests.helpers.coefficients import coefficients
from tests.helpers.hinge_oracle import HingedFlier, accelerations
from wingbeat._jax.arrays import jax
from wingbeat.animal.kinematics import with_parameters
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


def test_a_manoeuvre_says_that_it_does_not_know_the_hinge(orbit):
    with pytest.raises(
        wb.InvalidInputError, match=r"gives way, and manoeuvres do not know the hinge.*wb\.feedback"
    ):
        wb.manoeuvre(orbit, [8.0, 9.0])


# --- several times a beat ---


@pytest.mark.parametrize("law", ["pitch", "tail", "rest"])
def test_a_servo_needs_something_to_move(orbit, law):
    with pytest.raises(wb.InvalidInputError, match=f"servos = '{law}'"):
        wb.feedback_in_beat(orbit, servos={law: wb.Servo(speed=10.0)})


def test_bumps_of_the_flap_are_those_of_the_adaptive_integrator(orbit):
    """The oracle flies the bumps as mean and cosine of order 4, without the feedback's program."""
    held = wb.feedback_in_beat(orbit, 4)
    assert held.laws == ("flap",)
    assert held.spectral_radius < 1.0
    start = wb.State(*np.add(orbit.initial_state, [0, 0, 0.05, 0.2, 0.3, 0.5]).tolist())
    flown, beat = held.fly((0.0, 0.0), 2, start=start), orbit.wingbeat
    assert np.abs(flown.bumps).max() > 0.01
    state = np.append(np.array(start), orbit.hinge_start)
    for j, (height,) in enumerate(flown.bumps):
        changes = {"flap_mean": beat.flap_mean + height / 2, "flap_cos_4": -height / 2}
        moved, phases = with_parameters(beat, changes), np.linspace(j % 4 / 4, (j % 4 + 1) / 4, 5)
        state = fly_through(orbit.problem.model, moved, wb.State(*state[:6]), phases, wake=(state[6:],))[0][-1]
        np.testing.assert_allclose(flown.states[j + 1], state, atol=2e-3)


@pytest.fixture(scope="module")
def both(orbit):
    """Servos of flap and springs, twelve samples a beat, 1.3 of them late."""
    period, servo = 1 / orbit.wingbeat.frequency, wb.Servo(bandwidth=10.0)
    servos = {"flap": servo, "rest_angle": servo}
    return wb.feedback_in_beat(orbit, 12, delay_time=1.3 * period / 12, servos=servos)


def test_maps_are_those_of_differences_of_flights(orbit, both):
    assert both.measured == ("z", "body_pitch", "u", "w", "pitch_rate", "hinge_angle", "hinge_rate")
    assert both.state[7:9] == ("flap servo", "rest_angle servo")
    moved = np.array([0.0, 1e-4, 1e-3, -1e-3, 2e-3])
    start = wb.State(*(np.array(orbit.initial_state) + np.append(0.0, moved)).tolist())
    flown, calm = both.fly((0.0, 0.0), 1, start=start), both.fly((0.0, 0.0), 1)
    state = np.append(moved, np.zeros(len(both.state) - 5))
    scales = np.array([0.2, 0.1, 1.0, 1.0, 2.0, 0.1, 4.0])
    for j in range(12):
        command = -both.gains[j] @ state
        state = both.A[j] @ state + both.B[j] @ command
        away = flown.deviations[j + 1] - calm.deviations[j + 1]
        assert np.abs((away - state[:7]) / scales).max() < 5e-5
    assert np.abs(flown.bumps[:, 1] - calm.bumps[:, 1]).max() > 1e-5


def test_a_servo_of_the_springs_is_that_of_the_lagrangian(orbit):
    """SciPy flies the equations of the mass points; the servo's angle is added to the rest angle of the springs."""
    servo, beat, model = wb.Servo(bandwidth=10.0), orbit.wingbeat, orbit.problem.model
    held = wb.feedback_in_beat(orbit, 12, servos={"rest_angle": servo})
    start = wb.State(*np.add(orbit.initial_state, [0, 0, 0.05, 0.2, 0.3, 0.5]).tolist())
    flown = held.fly((0.0, 0.0), 1, start=start)
    assert np.abs(flown.angles[:3]).max() > 0.01
    vehicle = {part: vars(one) for part, one in vars(model.vehicle).items() if one is not None}
    three = jax.jit(functools.partial(coefficients, model.kernel))
    hinge, pace, sample = vars(beat.pitch_hinge), 2 * math.pi * 10.0, 1 / beat.frequency / 12
    state, angle = np.append(np.array(start), orbit.hinge_start), 0.0  # x z psi u w q theta theta'
    for j in range(3):
        aim, first = flown.bumps[j, 0], angle

        def rates(time, at, j=j, aim=aim, first=first):
            turned = aim + (first - aim) * math.exp(-pace * (time - j * sample))
            springs = hinge | {"rest_angle": hinge["rest_angle"] + turned}
            flier = HingedFlier(
                vehicle, vars(beat), springs, vars(model.air), lambda a: np.array(three(a)), model.strips
            )
            found = accelerations(flier, at[[0, 1, 2, 6]], at[[3, 4, 5, 7]], time * beat.frequency)
            return np.array([*at[3:6], *found[:3], at[7], found[3]])

        state = solve_ivp(rates, (j * sample, (j + 1) * sample), state, rtol=1e-7, atol=1e-9).y[:, -1]
        angle = aim + (first - aim) * math.exp(-pace * sample)
        np.testing.assert_allclose(flown.states[j + 1], state, atol=2e-3)
        assert flown.angles[j, 0] == pytest.approx(angle, abs=1e-7)


def test_the_robot_survives_gusts_with_delay_and_a_servo_and_an_imu(orbit):
    servo = wb.Servo(speed=math.radians(600))
    imu = wb.Imu(gyro=0.01, accelerometer=0.3, gyro_bias=0.02, accelerometer_bias=0.2, height=0.1)
    asked = {"sample_rate": 100.0, "delay_time": 0.01, "servos": servo}
    held = {"state": wb.feedback_in_beat(orbit, **asked), "imu": wb.feedback_in_beat(orbit, **asked, imu=imu)}
    assert "count as measured" in held["state"].summary()
    assert "count as measured" not in held["imu"].summary()
    found = wb.survey_gusts(orbit, {"free": None, **held}, flights=40, size=3.0, seed=1)
    assert min(found.share("state"), found.share("imu")) > 0.95 > found.share("free")


def test_the_block_of_equations_gives_the_commands_of_flights(both, tmp_path):
    both.save(tmp_path / "controller.json")
    block = json.loads((tmp_path / "controller.json").read_text())
    flown = both.fly(wb.winds.CosineGust(w=1.0, duration=0.2), 2)
    memory = np.zeros(len(block["memory"]))
    for j in range(24):
        gains = np.hstack([block["gains_of_state"][j % 12], block["gains_of_memory"][j % 12]])
        command = np.clip(-gains @ np.append(flown.deviations[j], memory), block["lower"], block["upper"])
        np.testing.assert_allclose(command, flown.bumps[j], atol=1e-6)
        memory = np.array(block["memory"]) @ memory + np.array(block["input"]) @ command
    with pytest.raises(wb.InvalidInputError, match="MuJoCo"):
        both.driver()


def test_a_gust_flight_starts_with_the_orbits_hinge(orbit):
    from wingbeat.stability.gust_flights import fly_gust

    calm = fly_gust(orbit, (0.0, 0.0), beats=2)
    assert np.abs(calm.pitch).max() < 1e-5
    np.testing.assert_allclose(calm.flight.hinge[0], orbit.hinge_start)
