"""The coefficients of a tail: slope, stall, broadside, symmetry, and what they cost."""

import math

import numpy as np
import pytest

from tests.helpers.tail_oracle import coefficients
from wingbeat._jax.arrays import jax, jnp
from wingbeat.aero.closed_forms import BROADSIDE, slender_slope, tail_force

SLOPE, DRAG, AREA, DENSITY, SPEED = 3.2, 0.03, 0.005, 1.2, 9.0
PRESSURE_AREA = 0.5 * DENSITY * SPEED**2 * AREA


def lift_and_drag(alpha):
    """Return the coefficients that the force along chord and normal amounts to."""
    normal = -np.sin(alpha), np.cos(alpha)
    forward, up = tail_force(DENSITY, AREA, SLOPE, DRAG, normal, (SPEED, 0.0))
    return up / PRESSURE_AREA, -forward / PRESSURE_AREA


def test_force_has_the_coefficients_at_every_angle():
    alpha = np.linspace(-math.pi, math.pi, 721)
    wanted = np.array([coefficients(SLOPE, DRAG, a) for a in alpha]).T
    np.testing.assert_allclose(lift_and_drag(alpha), wanted, rtol=0, atol=1e-14)


def test_lift_starts_with_its_slope_and_tilts_back_with_the_surface():
    alpha = 1e-4
    lift, drag = lift_and_drag(alpha)
    assert lift / alpha == pytest.approx(SLOPE, rel=1e-7)
    assert (drag - DRAG) / alpha**2 == pytest.approx(SLOPE, rel=1e-6)  # no suction at the leading edge
    assert slender_slope(2.0) == pytest.approx(math.pi)


def test_it_stalls_smoothly_and_is_a_plate_across_the_flow():
    alpha = np.linspace(0.0, 0.5 * math.pi, 901)
    lift, drag = lift_and_drag(alpha)
    assert math.degrees(alpha[lift.argmax()]) == pytest.approx(45.0, abs=0.1)
    assert lift.max() == pytest.approx(0.5 * SLOPE)
    assert lift[-1] == pytest.approx(0.0, abs=1e-12)
    assert drag[-1] == pytest.approx(DRAG + BROADSIDE)
    assert (drag > 0).all()


def test_it_is_the_same_from_below_and_from_behind():
    alpha = np.linspace(0.01, 1.5, 50)
    (lift, drag), (below, more), (behind, most) = map(lift_and_drag, (alpha, -alpha, math.pi - alpha))
    np.testing.assert_allclose([-below, more, -behind, most], [lift, drag, lift, drag], rtol=1e-9)


def test_it_has_a_force_and_slopes_at_rest():
    def force(velocity):
        return jnp.stack(tail_force(DENSITY, AREA, SLOPE, DRAG, (-0.6, 0.8), (velocity[0], velocity[1]), jnp))

    assert not np.asarray(force(jnp.zeros(2))).any()
    assert np.isfinite(jax.jacfwd(force)(jnp.zeros(2))).all()
