"""Coefficients of a kernel with their exact derivatives, at any number of angles by one compiled function."""

import math

import numpy as np

from tests.helpers.programs import compiled
from wingbeat._jax.arrays import jax, jnp

# Angles that are evaluated together: one length, so that each form of kernel is traced once.
TOGETHER = 2048


def coefficients(kernel, alpha):
    """Return C_L, C_D and x_cp at one angle [rad]."""
    return jnp.stack([*kernel.lift_drag(alpha), kernel.centre_of_pressure(alpha)])


def _three(kernel, alpha):
    slopes = jax.jacfwd(coefficients, argnums=1)
    return coefficients(kernel, alpha), slopes(kernel, alpha), jax.jacfwd(slopes, argnums=1)(kernel, alpha)


# The kernel is an argument, so that the models of one form share what is compiled.
_MANY = jax.jit(jax.vmap(_three, (None, 0)))


def value_slope_curvature(model, alpha):
    """Return the coefficients of a model, their slopes and curvatures at angles (n,): three arrays (n, 2 or 3)."""
    angles, kernel = np.ravel(np.asarray(alpha, dtype=float)), model.kernel()
    rows = np.zeros(-(-angles.size // TOGETHER) * TOGETHER)
    rows[: angles.size] = angles
    parts = [_MANY(kernel, part) for part in rows.reshape(-1, TOGETHER)]
    columns = 3 if model.has_centre_of_pressure else 2
    return [np.concatenate(order)[: angles.size, :columns] for order in zip(*parts, strict=True)]


def check_derivative_in_numbers(model, outputs, rtol, atol):
    """Check how outputs of a kernel change with each number of its model: exactly, and by central differences."""
    leaves, form = jax.tree.flatten(model)
    numbers = np.array(leaves)

    @compiled
    def value_and_slope(numbers, direction):
        def at(numbers):
            return outputs(form.unflatten(list(numbers)).kernel())

        return jax.jvp(at, (numbers,), (direction,))

    for number, one in zip(numbers, np.eye(numbers.size), strict=True):
        step = 1e-5 * max(abs(number), 0.1)
        ends = [value_and_slope(numbers + s * one, one)[0] for s in (step, -step)]
        slope = value_and_slope(numbers, one)[1]
        np.testing.assert_allclose(slope, (ends[0] - ends[1]) / (2 * step), rtol=rtol, atol=atol)


def by_the_lifting_line(kernel, aspect_ratio, section):
    """Return angle, C_L, C_D of a wing whose sections have the angles `section`, by bisection on the downwash."""
    c_l, c_d = (np.asarray(part) for part in kernel.lift_drag(section))
    low, high = np.full_like(section, -0.5), np.full_like(section, 0.5)
    for _ in range(60):
        eps = 0.5 * (low + high)
        above = eps > (c_l * np.cos(eps) - c_d * np.sin(eps)) / (math.pi * aspect_ratio)
        low, high = np.where(above, low, eps), np.where(above, eps, high)
    return section + eps, c_l * np.cos(eps) - c_d * np.sin(eps), c_d * np.cos(eps) + c_l * np.sin(eps)
