"""Hinge torques from sums over the wing against the five-coordinate equations, and their derivatives."""

import dataclasses

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.programs import compiled
from wingbeat.animal.species.species import Species
from wingbeat.mechanics.flight_model import motion_table
from wingbeat.mechanics.hinge_torques import hinge_loads, hinge_motion
from wingbeat.mechanics.state_rates import body_rates

PHASE = np.linspace(0.0, 1.0, 9)[:-1]
SHOULDER = {"wing.shoulder": [0.03, 0.02, 0.01], "wing.stroke_plane_angle": 1.2}


# Each pair of terms is compiled anew; a pair that is planar and one that is full show every term at work.
TERMS = [("quarter-chord", "planar"), ("centre-of-pressure", "full")]


@compiled
def of_flight(model, wingbeat, pitch_state, phase):
    motion, moved = motion_table(model, wingbeat, phase), hinge_motion(model, wingbeat, phase)
    body = body_rates(model, motion, pitch_state)[1:]
    return hinge_loads(model, motion, moved, pitch_state, body), moved, body


@compiled
def of_moved_body(model, wingbeat, pitch_state, phase, body):
    """Return the hinge loads of a body that moves as given."""
    motion, moved = motion_table(model, wingbeat, phase), hinge_motion(model, wingbeat, phase)
    return hinge_loads(model, motion, moved, pitch_state, body)


def animal(name: str, force_point: str, airspeed: str = "planar") -> tuple[Species, wb.FlightModel]:
    species = wb.load_species(name).with_values(SHOULDER)
    aero = wb.aero.BladeElement(wb.aero.SuFan(), 7, force_point, airspeed)
    return species, wb.FlightModel(species.vehicle, aero, species.air)


@pytest.mark.parametrize(("force_point", "airspeed"), TERMS)
@pytest.mark.parametrize("name", ["pigeon", "bat"])
def test_torques_are_those_of_the_five_coordinates(name, force_point, airspeed):
    species, model = animal(name, force_point, airspeed)
    beat = species.wingbeat
    state = np.random.default_rng(3).normal([[0.2], [9.0], [0.5], [1.0]], [[0.2], [2.0], [1.0], [3.0]], (4, 8))
    found, moved, body = of_flight(model, beat, state, PHASE)
    none = np.zeros(8)
    flap = beat.flap_mean + beat.flap_amplitude * np.cos(2 * np.pi * PHASE)
    pitch = beat.pitch_mean - beat.pitch_amplitude * np.sin(2 * np.pi * PHASE)
    pushed = (2 * np.pi * beat.frequency) ** 2
    q = np.stack([none, none, state[0], flap, pitch], axis=-1)
    q_dot = np.stack([state[1], state[2], state[3], moved.flap_rate, moved.pitch_rate], axis=-1)
    harmonic = [-pushed * (flap - beat.flap_mean), -pushed * (pitch - beat.pitch_mean)]
    q_acceleration = np.stack([*body, *harmonic], axis=-1)
    wanted = wb.generalised_torques(model, beat, q, q_dot, q_acceleration, PHASE / beat.frequency)
    torques = np.stack([found.flap_torque, found.pitch_torque], axis=-1)
    np.testing.assert_allclose(torques, wanted[:, 3:], atol=1e-11 * np.abs(wanted).max())
    power = np.sum(torques * q_dot[:, 3:], axis=-1)
    np.testing.assert_allclose(found.hinge_power, power, rtol=1e-12)


def test_rigid_wings_have_no_actuators_but_the_hinges():
    species, model = animal("pigeon", "quarter-chord")
    rigid = wb.Wingbeat(6.0, 0.1, 0.7, 0.1, 0.3)
    state = np.tile([[0.2], [9.0], [0.5], [1.0]], 8)
    found, _, _ = of_flight(model, rigid, state, PHASE)
    np.testing.assert_allclose(
        found.actuator_power, found.hinge_power, atol=1e-12 * np.abs(found.hinge_power).max()
    )
    retracted, _, _ = of_flight(model, species.wingbeat, state, PHASE)
    assert np.abs(retracted.actuator_power - retracted.hinge_power).max() > 0.1


@pytest.mark.parametrize(("force_point", "airspeed"), TERMS)
@pytest.mark.parametrize("name", ["pigeon", "bat"])
def test_the_shares_of_hinge_power_add_to_it_and_are_those_of_the_five_coordinates(name, force_point, airspeed):
    species, model = animal(name, force_point, airspeed)
    beat = species.wingbeat
    state = np.random.default_rng(4).normal([[0.2], [9.0], [0.5], [1.0]], [[0.2], [2.0], [1.0], [3.0]], (4, 8))
    found, moved, _ = of_flight(model, beat, state, PHASE)
    largest = np.abs(found.hinge_power).max()
    shares = found.aerodynamic_power + found.inertial_power + found.body_power
    np.testing.assert_allclose(shares, found.hinge_power, rtol=0, atol=1e-12 * largest)

    none, rates = np.zeros(8), np.stack([moved.flap_rate, moved.pitch_rate], axis=-1)
    flap = beat.flap_mean + beat.flap_amplitude * np.cos(2 * np.pi * PHASE)
    pitch = beat.pitch_mean - beat.pitch_amplitude * np.sin(2 * np.pi * PHASE)
    time = PHASE / beat.frequency
    q = np.stack([none, none, state[0], flap, pitch], axis=-1)
    q_dot = np.stack([*state[1:], *rates.T], axis=-1)
    air = wb.air_forces(model, beat, q, q_dot, time).generalised[:, 3:]
    np.testing.assert_allclose(found.aerodynamic_power, -np.sum(air * rates, axis=1), atol=1e-11 * largest)

    # On a body that is held still and without weight the wings' own inertia is all that is left beside the air.
    held = wb.FlightModel(species.vehicle, wb.aero.BladeElement(wb.aero.SuFan(), 7), wb.Air(gravity=0.0))
    q_dot[:, :3] = 0.0
    pushed = -((2 * np.pi * beat.frequency) ** 2)
    q_acceleration = np.zeros((8, 5))
    q_acceleration[:, 3:] = pushed * np.stack([flap - beat.flap_mean, pitch - beat.pitch_mean], axis=-1)
    torque = wb.generalised_torques(held, beat, q, q_dot, q_acceleration, time)
    torque = torque + wb.air_forces(held, beat, q, q_dot, time).generalised
    own = np.sum(np.asarray(torque)[:, 3:] * rates, axis=1)
    np.testing.assert_allclose(found.inertial_power, own, atol=1e-11 * np.abs(own).max())


def test_rigid_wings_get_their_inertial_share_back_and_a_falling_body_asks_for_none():
    species, model = animal("bat", "quarter-chord")
    rigid = dataclasses.replace(species.wingbeat, span_retraction=0.0, fold_amplitude=0.0)
    phase = np.linspace(0.0, 1.0, 257)
    states = np.tile([[0.2], [9.0], [-1.0], [0.0]], phase.size)
    falling = np.tile([[0.0], [-model.air.gravity], [0.0]], phase.size)
    found = of_moved_body(model, rigid, states, phase, falling)
    largest = np.abs(found.inertial_power).max()
    assert abs(np.trapezoid(found.inertial_power, phase)) <= 1e-12 * largest
    assert np.abs(found.body_power).max() <= 1e-14 * largest
    held = of_moved_body(model, rigid, states, phase, np.zeros((3, phase.size)))
    assert np.abs(held.body_power).max() > 1e-3 * largest  # that of the wings' weight
    assert abs(np.trapezoid(held.body_power, phase)) <= 1e-12 * largest
