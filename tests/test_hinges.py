"""Hinge torques from sums over the wing against the five-coordinate equations, and their derivatives."""

import numpy as np
import pytest

import wingbeat as wb
from wingbeat.hinges import hinge_loads, hinge_motion
from wingbeat.jax64 import jax
from wingbeat.model import body_rates, motion_table
from wingbeat.species.record import Species

PHASE = np.linspace(0.0, 1.0, 9)[:-1]
SHOULDER = {"wing.shoulder": [0.03, 0.02, 0.01], "wing.stroke_plane_angle": 1.2}


def of_flight(model, wingbeat, pitch_state, phase):
    motion, moved = motion_table(model, wingbeat, phase), hinge_motion(model.vehicle, wingbeat, phase, model.strips)
    body = body_rates(model, motion, pitch_state)[1:]
    return hinge_loads(model, motion, moved, pitch_state, body), moved, body


def animal(name: str, force_point: str) -> tuple[Species, wb.FlightModel]:
    species = wb.load_species(name).with_values(SHOULDER)
    aero = wb.aero.BladeElement(wb.aero.SuFan(), 7, force_point)
    return species, wb.flight_model(species.vehicle, aero, species.air)


@pytest.mark.parametrize("force_point", ["quarter-chord", "centre-of-pressure"])
@pytest.mark.parametrize("name", ["pigeon", "bat"])
def test_torques_are_those_of_the_five_coordinates(name, force_point):
    species, model = animal(name, force_point)
    beat = species.wingbeat
    state = np.random.default_rng(3).normal([[0.2], [9.0], [0.5], [1.0]], [[0.2], [2.0], [1.0], [3.0]], (4, 8))
    found, moved, body = jax.jit(of_flight)(model, beat, state, PHASE)
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
    found, _, _ = jax.jit(of_flight)(model, rigid, state, PHASE)
    np.testing.assert_allclose(
        found.actuator_power, found.hinge_power, atol=1e-12 * np.abs(found.hinge_power).max()
    )
    retracted, _, _ = jax.jit(of_flight)(model, species.wingbeat, state, PHASE)
    assert np.abs(retracted.actuator_power - retracted.hinge_power).max() > 0.1
