"""What a wing whose pitch gives way refuses, records and says; one quick look at its accelerations."""

import dataclasses
import math

import numpy as np
import pytest

import wingbeat as wb
from wingbeat.animal.kinematics import with_parameters
from wingbeat.mechanics.state_rates import body_rates, rate_table
from wingbeat.records.inputs import wingbeat_from, wingbeat_record

STATE = np.array([0.1, 8.0, 0.3, 0.2, -0.25, 3.0])


@pytest.fixture(scope="module")
def robot():
    return wb.load_species("robofalcon2")


def giving(robot, **more):
    return dataclasses.replace(robot.wingbeat, pitch_hinge=wb.PitchHinge(1.4, 0.0166, -0.3, **more))


@pytest.mark.parametrize(("axis", "mass_axis"), [(0.25, 0.5), (0.05, 0.3)])
def test_the_five_coordinates_need_the_springs_torque(robot, axis, mass_axis):
    wing = dataclasses.replace(robot.vehicle.wing, pitch_axis=axis, mass_axis=mass_axis)
    vehicle = dataclasses.replace(robot.vehicle, wing=wing)
    model = wb.FlightModel(vehicle, wb.aero.BladeElement("su-fan", force_point="centre-of-pressure"))
    beat, phase = giving(robot, stop_stiffness=3.0, stop_angle=0.1), 0.23
    rates = np.asarray(body_rates(model, rate_table(model, beat, np.array(phase)), STATE))
    turn = 2.0 * math.pi * phase
    flap = beat.flap_mean + beat.flap_amplitude * math.cos(turn)
    rate = -2.0 * math.pi * beat.frequency * beat.flap_amplitude * math.sin(turn)
    bend = -((2.0 * math.pi * beat.frequency) ** 2) * beat.flap_amplitude * math.cos(turn)
    torque = wb.generalised_torques(
        model,
        beat,
        np.array([0.0, 0.0, STATE[0], flap, STATE[4]]),
        np.array([*STATE[1:4], rate, STATE[5]]),
        np.array([*rates[1:4], bend, rates[5]]),
        phase / beat.frequency,
    )
    np.testing.assert_allclose(np.asarray(torque)[:3], 0.0, atol=1e-11)
    assert float(torque[4]) == pytest.approx(float(beat.pitch_hinge.torque(STATE[4], STATE[5])), rel=1e-9)


def test_the_lag_of_the_wake_is_refused_in_words(robot):
    model = wb.FlightModel(robot.vehicle, wb.aero.BladeElement("su-fan", wake="jones-section"))
    with pytest.raises(wb.InvalidInputError, match=r"aero\.wake"):
        wb.certify(model, giving(robot), STATE[:4])


def test_the_five_coordinates_do_not_guess_a_twist(robot):
    model, still = wb.FlightModel(robot.vehicle, "su-fan"), np.zeros(5)
    with pytest.raises(wb.InvalidInputError, match="gives way"):
        wb.equations_of_motion(model, giving(robot, twist_share=1.0), still, still, 0.0)


def test_a_number_of_no_hinge_is_refused(robot):
    with pytest.raises(wb.InvalidInputError, match="there is none"):
        with_parameters(robot.wingbeat, {"hinge_stiffness": 1.0})


def test_a_replaced_pitch_law_is_left_out_whole(robot):
    beat = dataclasses.replace(giving(robot), pitch_harmonics=(0.1, 0.0))
    record = wingbeat_record(beat)
    assert [name for name in record if name.startswith("pitch_")] == []
    again = wingbeat_from(record)
    assert (again.pitch_mean, again.pitch_amplitude, again.pitch_harmonics) == (0.0, 0.0, ())
    assert again.pitch_hinge == beat.pitch_hinge


def test_bounds_of_a_hinge_that_are_given_are_no_guess(robot):
    own = dataclasses.replace(
        robot.with_values({"pitch_hinge.stiffness": 1.4}), bounds=robot.bounds | {"hinge_stiffness": (1.0, 2.0)}
    )
    free = own.with_free(["hinge_stiffness"])
    assert free.bounds["hinge_stiffness"] == (1.0, 2.0)
    assert "hinge_stiffness" not in free.guessed_bounds


def test_a_load_that_is_taken_off_again_is_none():
    for name in wb.species_names():
        bird = wb.load_species(name)
        loaded = bird.with_payload(0.0123)
        back = loaded.with_values({"body.mass": loaded.vehicle.body.mass - 0.0123})
        assert back.carried_mass == 0.0


def test_a_battery_without_a_motor_is_no_column_of_a_curve(robot):
    from wingbeat.records.curve_dataset import _numbers

    battery = wb.Battery(cells=3, capacity=0.85, internal_resistance=0.06)
    powered = robot.with_record(dataclasses.replace(robot.vehicle, battery=battery))
    names = [name for name, *_ in _numbers(wb.OrbitProblem(powered, speed=8.0), "speed")]
    assert "endurance" not in names
