"""A motor's balance of power, and the springs beside and before it, each to rounding."""

import numpy as np
import pytest

import wingbeat as wb
from wingbeat.animal.actuators import actuated, motor_state, periodic_rate, spring_torque
from wingbeat.animal.drive import Motor, Springs

FREQUENCY = 5.0
PHASE = np.linspace(0.0, 1.0, 257)
TURN = 2.0 * np.pi * PHASE
# A beat of two harmonics, and a torque that drives and is driven.
FLAP = 0.7 * np.cos(TURN) + 0.05 * np.sin(2 * TURN)
RATE = 2.0 * np.pi * FREQUENCY * (-0.7 * np.sin(TURN) + 0.1 * np.cos(2 * TURN))
TORQUE = -0.4 + 0.9 * np.sin(TURN + 0.4) + 0.2 * np.cos(3 * TURN)
MOTOR = Motor(2.1e-3, 0.4, 20.0, rotor_inertia=3e-7, no_load_current=0.15, gear_efficiency=0.8)


def mean(values):
    return float(np.mean(0.5 * (values[:-1] + values[1:])))


def state(motor, torque=TORQUE, rate=RATE):
    acceleration = np.asarray(periodic_rate(rate, 1.0 / FREQUENCY))
    return [np.asarray(part) for part in motor_state(motor, torque, rate, acceleration, FREQUENCY)], acceleration


@pytest.mark.parametrize("crank", [0, 1])
def test_electrical_power_is_heat_friction_and_shaft(crank):
    motor = Motor(**{**vars(MOTOR), "crank": crank})
    (speed, torque, current, voltage, power), _ = state(motor)
    heat = motor.resistance * current**2
    friction = motor.torque_constant * motor.no_load_current * np.abs(speed)
    np.testing.assert_allclose(voltage, motor.resistance * current + motor.torque_constant * speed, rtol=1e-12)
    np.testing.assert_allclose(power, heat + friction + torque * speed, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("crank", [0, 1])
def test_the_gear_takes_its_share_whichever_way_the_power_goes(crank):
    (speed, torque, *_), acceleration = state(Motor(**{**vars(MOTOR), "crank": crank}))
    load = TORQUE * RATE
    kinetic = 0.0 if crank else MOTOR.rotor_inertia * speed * MOTOR.gear_ratio * acceleration
    loss = torque * speed - kinetic - load
    drives, tolerance = load > 0.0, {"rtol": 1e-11, "atol": 1e-12}
    assert loss.min() >= -1e-12
    np.testing.assert_allclose(loss[drives], (1 / MOTOR.gear_efficiency - 1) * load[drives], **tolerance)
    np.testing.assert_allclose(loss[~drives], (1 - MOTOR.gear_efficiency) * -load[~drives], **tolerance)
    assert 20 < drives.sum() < 200


def test_a_lossless_motor_gives_the_power_of_the_hinges():
    ideal = Motor(2.1e-3, 1e-15, 20.0)
    for crank in (0, 1):
        (*_, power), _ = state(Motor(**{**vars(ideal), "crank": crank}))
        np.testing.assert_allclose(power, TORQUE * RATE, rtol=1e-11, atol=1e-11)


def test_a_crank_turns_at_constant_speed():
    (speed, *_), _ = state(Motor(**{**vars(MOTOR), "crank": 1}))
    np.testing.assert_allclose(speed, MOTOR.gear_ratio * 2.0 * np.pi * FREQUENCY, rtol=1e-14)


def test_springs_and_actuator_share_the_torque_and_springs_do_no_net_work():
    springs = Springs(stiffness=0.8, rest_angle=0.2, series_compliance=0.3)
    need = actuated(springs, FLAP, RATE, TORQUE, 1.0 / FREQUENCY)
    np.testing.assert_allclose(need.torque + spring_torque(0.8, FLAP, 0.2), TORQUE, rtol=1e-12, atol=1e-13)
    # The actuators' work is that of the hinges, although their powers differ.
    power = np.asarray(need.torque * need.rate)
    assert mean(power) == pytest.approx(mean(TORQUE * RATE), abs=1e-12)
    assert np.abs(power - TORQUE * RATE).max() > 1.0


@pytest.mark.parametrize("crank", [0, 1])
def test_the_power_of_the_battery_is_accounted_for_to_rounding(crank):
    """Battery = hinges + heat + friction + gear + change of the rotor's energy, at every moment and over a beat."""
    motor = Motor(**{**vars(MOTOR), "crank": crank})
    (speed, _, current, _, power), acceleration = state(motor)
    hinges = TORQUE * RATE
    heat = motor.resistance * current**2
    friction = motor.torque_constant * motor.no_load_current * np.abs(speed)
    share = motor.gear_efficiency
    gear = np.where(hinges > 0.0, (1 / share - 1) * hinges, (share - 1) * hinges)
    # A crank turns at constant speed, and its rotor's energy does not change.
    rotor = 0.0 if crank else motor.rotor_inertia * speed * motor.gear_ratio * acceleration
    tolerance = 1e-12 * np.abs(power).max()
    assert np.abs(power - (hinges + heat + friction + gear + rotor)).max() <= tolerance
    assert mean(rotor + 0.0 * speed) == pytest.approx(0.0, abs=tolerance)
    assert mean(power) == pytest.approx(mean(hinges + heat + friction + gear), abs=tolerance)


@pytest.mark.parametrize("springs", [Springs(0.8, 0.2), Springs(0.0, 0.0, 0.3), Springs(0.8, 0.2, 0.3)])
def test_each_spring_does_no_net_work(springs):
    need = actuated(springs, FLAP, RATE, TORQUE, 1.0 / FREQUENCY)
    # The rate of the sampled flap angle itself, so that sums over samples are exact.
    rate = np.asarray(periodic_rate(FLAP, 1.0 / FREQUENCY))
    beside = np.asarray(spring_torque(springs.stiffness, FLAP, springs.rest_angle)) * rate
    between = np.asarray(need.torque) * (np.asarray(need.rate) - RATE)
    tolerance = 1e-12 * np.abs(TORQUE * RATE).max()
    assert mean(beside) == pytest.approx(0.0, abs=tolerance)
    assert mean(between) == pytest.approx(0.0, abs=tolerance)
    assert max(np.abs(beside).max(), np.abs(between).max()) > 1.0


def test_no_springs_change_nothing():
    need = actuated(Springs(), FLAP, RATE, TORQUE, 1.0 / FREQUENCY)
    np.testing.assert_array_equal(need.torque, TORQUE)
    np.testing.assert_array_equal(need.rate, RATE)


def test_rates_of_a_periodic_series_are_exact_to_order_six():
    exact = 2.0 * np.pi * FREQUENCY * 3.0 * np.cos(3.0 * TURN)
    error = [
        np.abs(np.asarray(periodic_rate(np.sin(3.0 * TURN[::step]), 1.0 / FREQUENCY)) - exact[::step]).max()
        for step in (2, 1)
    ]
    assert error[0] / error[1] == pytest.approx(64.0, rel=0.05)


def test_every_fault_is_named():
    with pytest.raises(wb.InvalidInputError) as refused:
        Motor(0.0, 0.4, 20.0, gear_efficiency=1.2, crank=0.5)
    assert [fault.where for fault in refused.value.faults] == [
        "motor.torque_constant",
        "motor.gear_efficiency",
        "motor.crank",
    ]
    with pytest.raises(wb.InvalidInputError, match=r"springs\.series_compliance"):
        Springs(series_compliance=-1.0)
