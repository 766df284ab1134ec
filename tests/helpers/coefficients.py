"""Coefficients of a kernel with their exact derivatives, at any number of angles by one compiled function."""

import numpy as np

from wingbeat._jax.config import jax, jnp

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
