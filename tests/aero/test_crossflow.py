"""The force of the cross flow on a body: size, direction and derivatives; off, it adds nothing to a program."""

import dataclasses

import numpy as np
import pytest

import wingbeat as wb
from tests.helpers.oracle import crossflow
from wingbeat._jax.arrays import jax, jnp
from wingbeat.aero.closed_forms import body_drag, crossflow_force
from wingbeat.mechanics.flight_model import body_air

PIGEON = wb.load_species("pigeon").vehicle


def turned(area, tail=None):
    body = dataclasses.replace(PIGEON.body, crossflow_area=area)
    return dataclasses.replace(PIGEON, body=body, tail=tail)


@pytest.mark.parametrize("pitch", np.linspace(-3.0, 3.0, 7))
def test_force_is_that_of_the_angle_of_attack(pitch):
    velocity, normal = (9.0, -2.0), (-np.sin(pitch), np.cos(pitch))
    wanted = crossflow(0.008, 1.2, pitch, np.array(velocity))
    np.testing.assert_allclose(crossflow_force(0.008, 1.2, normal, velocity), wanted, rtol=1e-12, atol=1e-16)


def test_it_is_the_same_in_any_axes_and_adds_to_the_drag():
    vehicle, velocity = turned(0.008), (jnp.asarray(9.0), jnp.asarray(-2.0))
    force, moment = body_air(vehicle, 1.2, velocity, jnp.asarray(0.0))
    drag = body_drag(vehicle.body.drag_area, 1.2, velocity, jnp)
    assert moment is None
    np.testing.assert_allclose(np.subtract(force, drag), crossflow(0.008, 1.2, 0.0, np.array(velocity)), atol=1e-15)
    c, s = np.cos(0.4), np.sin(0.4)  # axes pitched nose-up by 0.4 from those of the body
    there = c * velocity[0] + s * velocity[1], c * velocity[1] - s * velocity[0]
    found, _ = body_air(vehicle, 1.2, there, jnp.asarray(0.0), axes=jnp.asarray(0.4))
    back = c * found[0] - s * found[1], s * found[0] + c * found[1]
    np.testing.assert_allclose(back, force, rtol=1e-12, atol=1e-16)


def test_it_has_slopes_at_rest_and_along_the_axis():
    def force(velocity):
        return jnp.stack(crossflow_force(0.008, 1.2, (0.0, 1.0), (velocity[0], velocity[1]), jnp))

    for velocity in ([0.0, 0.0], [9.0, 0.0]):
        assert not np.asarray(jax.jacfwd(force)(jnp.asarray(velocity))).any()


def test_an_area_of_zero_adds_nothing_to_the_program():
    def text(vehicle):
        at = jnp.zeros(3)
        return jax.jit(lambda v: body_air(v, 1.2, (at, at), at)).lower(vehicle).as_text()

    assert text(PIGEON) == text(turned(0.0))
    assert text(PIGEON) != text(turned(0.008))


@pytest.mark.parametrize("area", [-1e-3, float("nan")])
def test_impossible_areas_are_refused(area):
    with pytest.raises(wb.InvalidInputError, match="crossflow_area"):
        turned(area)
