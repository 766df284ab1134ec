"""Flight muscle: its relations against their known values, and what a torque costs against a slow reference."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import wingbeat as wb
from wingbeat._jax.arrays import jax, jnp
from wingbeat.animal.actuators import (
    activation,
    activation_power,
    best_efficiency,
    force_at,
    isometric_share,
    metabolic_power,
    metabolic_ratio,
    tendon_recoil,
)
from wingbeat.animal.drive import Muscle

MUSCLE = Muscle(0.06, 0.15, 0.15, 20.0, 250e3, 0.36)


def test_force_falls_with_speed_of_shortening_and_rises_when_the_muscle_lengthens():
    shortening = np.linspace(-1.0, 1.0, 401)
    force = np.asarray(force_at(shortening, 0.25))
    assert (np.diff(force) < 0.0).all()
    assert force[[0, 200, 400]] == pytest.approx([1.8, 1.0, 0.0])


@pytest.mark.parametrize("curvature", [0.15, 0.25, 0.361])
def test_power_is_largest_where_hill_says(curvature):
    shortening = np.linspace(0.0, 1.0, 100_001)
    power = shortening * np.asarray(force_at(shortening, curvature))
    assert shortening[power.argmax()] == pytest.approx(np.sqrt(curvature**2 + curvature) - curvature, abs=2e-5)


def test_the_metabolic_rate_is_that_of_minetti_and_alexander():
    """Values of the quotient of polynomials, by NumPy."""
    q = np.linspace(-1.0, 1.0, 81)
    reference = np.polyval([2.46, 0.506, 0.054], q) / np.polyval([-1.64, 12.8, -1.13, 1.0], q)
    np.testing.assert_allclose(metabolic_ratio(q), reference, rtol=1e-13)
    assert (reference > 0.0).all()
    assert [float(best_efficiency(k)) for k in (0.25, 0.361)] == pytest.approx([0.504, 0.553], abs=1e-3)


@settings(deadline=None, max_examples=50, derandomize=True)
@given(torque=st.floats(-2.0, 2.0).filter(lambda value: abs(value) > 1e-3), share=st.floats(-0.99, 0.94))
def test_cost_and_activation_are_those_of_the_pulling_muscle(torque, share):
    """The muscle pulls with the torque's sign; `share` is its speed of shortening over the largest."""
    rate = np.sign(torque) * share * MUSCLE.max_flap_rate
    isometric = abs(torque) / float(force_at(share, MUSCLE.curvature))
    cost = isometric * MUSCLE.max_flap_rate * float(metabolic_ratio(share))
    found = [max(float(part), 0.0) for part in metabolic_power(MUSCLE, torque, rate)]
    assert found == pytest.approx([cost, 0.0] if torque > 0.0 else [0.0, cost], rel=1e-12)
    up, down = (float(part) for part in activation(MUSCLE, torque, rate))
    strongest = MUSCLE.depressor_torque * (MUSCLE.elevator_share if torque > 0.0 else 1.0)
    assert max(up, down) == pytest.approx(isometric / strongest, rel=1e-12)
    assert min(up, down) <= 0.0


def test_beyond_the_largest_speed_the_need_goes_on_rising_smoothly():
    curvature, last = 0.36, 0.95
    slope = jax.grad(lambda q: isometric_share(q, curvature))
    assert float(slope(last + 1e-9)) == pytest.approx(float(slope(last - 1e-9)), rel=1e-5)
    beyond = np.asarray(isometric_share(np.linspace(0.9, 3.0, 50), curvature))
    assert (np.diff(beyond) > 0.0).all()


def test_the_muscle_of_the_laws_gives_the_power_that_was_measured():
    """533 W/kg at 0.34 of the largest speed: the cockatiel of Morris and Askew 2010, from which the laws follow."""
    muscle = wb.load_species("pigeon").with_muscle().vehicle.muscle
    share = np.linspace(0.0, 1.0, 10_001)
    power = np.asarray(force_at(share, muscle.curvature)) * muscle.depressor_torque * share * muscle.max_flap_rate
    assert power.max() / muscle.mass == pytest.approx(533.0, rel=1e-6)
    assert share[power.argmax()] == pytest.approx(0.34, abs=1e-4)


def test_a_tendon_gives_back_what_it_stores_and_takes_over_the_wings_motion():
    """Of a torque ``a cos``: rate of the tendon by hand, its work over a beat, and how far the muscle moves."""
    muscle = dataclasses.replace(MUSCLE, tendon_compliance=2.0)
    phase, period = np.linspace(0.0, 1.0, 257), 0.16
    torque = 0.3 * np.cos(2 * np.pi * phase) + 0.05
    recoil = np.asarray(tendon_recoil(muscle, torque, period))
    np.testing.assert_allclose(recoil, -2.0 * 0.3 * 2 * np.pi / period * np.sin(2 * np.pi * phase), atol=1e-9)
    work = np.trapezoid(np.maximum(torque, 0.0) * recoil, phase) * period
    assert abs(work) < 1e-5 * 0.5 * 2.0 * 0.35**2  # of what it stores
    # The wing's own motion at bottom dead centre: with a tendon of the right compliance the muscle stays as long.
    rate = 2.0 * 0.3 * 2 * np.pi / period * np.sin(2 * np.pi * phase)
    up, _ = activation(muscle, torque, rate, recoil)
    strongest = muscle.depressor_torque * muscle.elevator_share
    np.testing.assert_allclose(up, torque / strongest, rtol=1e-6, atol=1e-9)


def test_activation_takes_its_energy_once_a_beat_from_the_fibres_that_a_muscle_needs_at_most():
    muscle = dataclasses.replace(MUSCLE, activation_energy=7.0)
    up, down = np.array([-0.4, 0.1, 0.3]), np.array([0.8, -0.2, -0.6])
    wanted = 7.0 * 6.0 * (0.06 * 0.8 + 0.06 * 0.15 * 0.3)
    assert float(activation_power(muscle, up, down, 6.0)) == pytest.approx(wanted, rel=1e-14)


def test_without_a_tendon_the_numbers_are_those_without_the_term():
    torque, rate = jnp.linspace(-0.9, 0.9, 65), jnp.linspace(40.0, -55.0, 65)
    still = tendon_recoil(MUSCLE, torque, 0.1)
    for of in (activation, metabolic_power):
        for with_term, without in zip(of(MUSCLE, torque, rate, still), of(MUSCLE, torque, rate), strict=True):
            assert np.array_equal(with_term, without)


def test_every_fault_is_named():
    with pytest.raises(wb.InvalidInputError) as refused:
        Muscle(-0.06, 0.0, 0.15, float("nan"), 250e3, 0.36)
    assert [fault.where for fault in refused.value.faults] == [
        "muscle.mass",
        "muscle.elevator_share",
        "muscle.max_strain_rate",
    ]
