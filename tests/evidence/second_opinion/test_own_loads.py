"""Our loads on a given motion are those of the flight where the motion is that of the flight."""

import dataclasses
import math

import numpy as np
import pytest

import wingbeat as wb
from tests.evidence.second_opinion.test_geometry import RICH
from tests.helpers.given_motion import PIGEON, given_motion
from wingbeat._jax.arrays import jnp
from wingbeat_evidence.second_opinion.motion import Motion
from wingbeat_evidence.second_opinion.own_loads import own_loads

PHASE = np.arange(8) / 8


def test_loads_on_the_motion_of_an_orbit_are_those_in_its_file(pigeon_orbit):
    orbit, model = pigeon_orbit.orbit, pigeon_orbit.model
    dataset = orbit.dataset.isel(phase=slice(0, None, 32))
    motion = Motion.of(orbit.dataset, model.vehicle, orbit.wingbeat, model.air)
    phase = dataset["phase"].values
    found = own_loads(motion, wb.aero.BladeElement(wb.aero.SuFan()), phase)
    np.testing.assert_allclose(found.thrust, dataset["force_x"].values, atol=1e-6)
    np.testing.assert_allclose(found.lift, dataset["force_z"].values, atol=1e-6)
    np.testing.assert_allclose(found.power, -dataset["air_power"].values, atol=1e-5)
    np.testing.assert_allclose(found.alpha, dataset["alpha"].values, atol=1e-7)
    np.testing.assert_allclose(motion.velocity, (10.0, 0.0), atol=1e-6)


def test_body_and_tail_are_no_load_of_the_wings():
    body = dataclasses.replace(PIGEON.body, drag_area=1e-2, crossflow_area=1e-2)
    tail = wb.Tail(area=0.01, arm=0.1, lift_slope=1.6, incidence=0.2)
    aero = wb.aero.BladeElement("su-fan")
    bare, heavy = (
        own_loads(given_motion(RICH, heave=0.02, pitch=0.1, vehicle=vehicle), aero, PHASE)
        for vehicle in (PIGEON, dataclasses.replace(PIGEON, body=body, tail=tail))
    )
    for name in ("thrust", "lift", "power"):
        np.testing.assert_allclose(getattr(bare, name), getattr(heavy, name), atol=1e-10)


class Section(wb.aero.FunctionCoefficients):
    aspect_ratio = math.inf


@pytest.mark.parametrize(
    ("wake", "numbers"),
    [("jones-section", ((0.165, 0.0455), (0.335, 0.3))), ("jones-finite", ((0.361, 0.381),))],
)
def test_a_heaving_wing_with_lag_lifts_by_jones_s_function_of_the_reduced_frequency(wake, numbers):
    """Lift is -2 pi rho U b C(k) h' a span, with C(k) = 1 - sum A_j i k / (b_j + i k)."""
    still = wb.Wingbeat(5.0, flap_amplitude=0.0, pitch_amplitude=0.0, flap_mean=0.0, pitch_mean=0.0)
    wing = wb.Wing(semi_span=0.3, chord=0.1, mass=0.01, stroke_plane_angle=np.pi / 2)  # aspect ratio 6
    heave, speed = 1e-5, 10.0
    motion = given_motion(still, speed, heave, vehicle=dataclasses.replace(PIGEON, wing=wing))
    section = Section(lambda alpha: (2 * np.pi * jnp.sin(alpha), 0.0 * alpha), "section")
    found = own_loads(motion, wb.aero.BladeElement(section, wake=wake), PHASE).lift
    omega, half = 10 * np.pi, 0.05
    k = omega * half / speed
    lag = 1 - sum(share * 1j * k / (rate + 1j * k) for share, rate in numbers)
    lift = -2 * np.pi * motion.air.density * speed * half * lag * 1j * omega * heave * 2 * wing.semi_span
    np.testing.assert_allclose(found, np.real(lift * np.exp(2j * np.pi * PHASE)), atol=1e-4 * abs(lift))


def test_added_mass_resists_the_acceleration_of_the_motion():
    """A wing without flap that heaves: lift is -(pi/4) rho c^2 h'' a span, whatever body would follow from it."""
    still = wb.Wingbeat(frequency=5.0, flap_amplitude=0.0, pitch_amplitude=0.0, flap_mean=0.0, pitch_mean=0.0)
    still = dataclasses.replace(still, span_retraction=0.0)
    wing = dataclasses.replace(PIGEON.wing, stroke_plane_angle=np.pi / 2)
    motion = given_motion(still, heave=1e-3, vehicle=dataclasses.replace(PIGEON, wing=wing))

    def no_force(alpha):
        return jnp.zeros_like(alpha), jnp.zeros_like(alpha)

    found = own_loads(motion, wb.aero.BladeElement(no_force, unsteady="thin-aerofoil"), PHASE)
    up = -1e-3 * (10 * np.pi) ** 2 * np.cos(2 * np.pi * PHASE)
    mass = np.pi / 4 * motion.air.density * wing.mean_chord**2 * 2 * wing.semi_span
    np.testing.assert_allclose(found.lift, -mass * up, rtol=1e-3, atol=1e-6)
