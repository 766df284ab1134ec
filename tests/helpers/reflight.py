"""Flights flown again by SciPy, independent of the package's own integrator."""

import functools
import math
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

import wingbeat as wb
from tests.helpers.programs import compiled
from wingbeat._jax.arrays import jax, jnp
from wingbeat.mechanics.flight_loads import flight_loads
from wingbeat.mechanics.flights import state_rates

INTEGRALS = ("force_x", "force_z", "actuator_power", "air_power", "hinge_power")


class Reflight(NamedTuple):
    """One period flown by SciPy: state at the end, and time integrals over the period of what `INTEGRALS` names."""

    end: np.ndarray
    integrals: dict[str, float]


def dop853(rates, phases, start, rtol=1e-11):
    """Integrate with SciPy's DOP853 from one phase to another and return the end."""
    atol = 0.1 * rtol
    found = solve_ivp(lambda p, y: np.asarray(rates(p, y)), phases, start, "DOP853", rtol=rtol, atol=atol)
    assert found.success, found.message
    return found.y[:, -1]


@functools.partial(compiled, static_argnames=("kind", "shapes"))
def _rates_and_integrands(held, phase, state, kind, shapes):
    ends = np.cumsum([math.prod(shape) for shape in shapes])[:-1]
    leaves = [part.reshape(shape) for part, shape in zip(jnp.split(held, ends), shapes, strict=True)]
    model, wingbeat = jax.tree.unflatten(kind, leaves)
    now = flight_loads(model, wingbeat, wb.State(*state[:, None]), phase[None])
    power = jnp.stack([now.actuator_power, now.air_power, now.hinge_power])
    rates = state_rates(model, wingbeat, phase, state)
    return jnp.concatenate([rates, now.air_force[0, :2], power[:, 0]]) / wingbeat.frequency


def refly(model, wingbeat, start):
    """Fly one period with DOP853, the integrals as extra states."""
    first = np.concatenate([start, np.zeros(len(INTEGRALS))])
    # Taken apart once: thousands of calls would each do it with the sixty numbers of the records.
    leaves, kind = jax.tree.flatten((model, wingbeat))
    arrays = [np.asarray(leaf, dtype=float) for leaf in leaves]
    held = jnp.asarray(np.concatenate([array.ravel() for array in arrays]))
    parts = {"kind": kind, "shapes": tuple(array.shape for array in arrays)}
    end = dop853(lambda p, y: _rates_and_integrands(held, np.asarray(p), y[:6], **parts), (0.0, 1.0), first)
    return Reflight(end[:6], dict(zip(INTEGRALS, end[6:], strict=True)))


@compiled
def _many_rates(model, wingbeat, phase, states):
    return jax.vmap(lambda s: state_rates(model, wingbeat, phase, s))(states) / wingbeat.frequency


def refly_many(model, wingbeat, starts):
    """Fly one period from several states at once, shape (K, 6): all share the same steps.

    So small a tolerance because differences of such flights magnify their errors ten-thousandfold.
    """
    shape = np.shape(starts)

    def rates(phase, y):
        return np.asarray(_many_rates(model, wingbeat, np.asarray(phase), y.reshape(shape))).ravel()

    return dop853(rates, (0.0, 1.0), np.ravel(starts), rtol=1e-13).reshape(shape)
