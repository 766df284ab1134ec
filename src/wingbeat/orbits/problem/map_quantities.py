"""Quantities read off the stroke map of an orbit: its spectral radius and its response to gusts."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from wingbeat._jax.config import jax, jnp
from wingbeat.nomenclature import NOMENCLATURE, plain
from wingbeat.orbits.problem.quantity import Quantity

if TYPE_CHECKING:
    from wingbeat._jax.shapes import Moduli, Scalar, StrokeMatrix

# Disturbances of (body_pitch, u, w, pitch_rate) that count as equally large [rad, m/s, m/s, rad/s].
_EQUAL = (0.1, 1.0, 1.0, 2.0)
# Gusts excite an orbit without end at a spectral radius of 1. Up to this radius, the response is exact.
_STEADY = 0.999
# How fast the value rises beyond it: steep, so that a search turns back.
_BEYOND = 1e3


@dataclass(frozen=True)
class MapQuantity(Quantity):
    """A quantity of the stroke map.

    Parameters
    ----------
    name, unit, scale : as of a `Quantity`.
    of : function of the derivative of (body_pitch, u, w, pitch_rate) after a beat by the same four before it, shape
        (4, 4), in JAX-compatible Python; returns a number, or several that count by the largest.

    >>> trace = MapQuantity("trace", lambda stroke_map: stroke_map.trace())
    >>> trace.name
    'trace'
    """

    of: Callable[[Any], Any]


def _moduli(stroke_map: StrokeMatrix) -> Moduli:
    """Return the moduli of the four multipliers.

    Each has a row of its own: a limit of the largest alone has a kink where two are equal.
    """
    return jnp.sort(jnp.abs(jnp.linalg.eigvals(stroke_map)))


def _gust_response(stroke_map: StrokeMatrix) -> Scalar:
    """Return the root mean square of the disturbance under gusts of 1 m/s that change at random every beat.

    The covariance P of the disturbances is that of ``P = A P A' + G G'``, ``G = (I - A)[:, (u, w)]``.
    """
    radius = jax.lax.stop_gradient(_moduli(stroke_map)[-1])
    steady = stroke_map * jnp.minimum(1.0, _STEADY / radius)
    gust = (jnp.eye(4) - stroke_map)[:, 1:3]
    covariance = jnp.linalg.solve(jnp.eye(16) - jnp.kron(steady, steady), (gust @ gust.T).ravel()).reshape(4, 4)
    response = jnp.sqrt(jnp.diagonal(covariance) @ jnp.asarray(_EQUAL) ** -2)
    return response + _BEYOND * jnp.maximum(_moduli(stroke_map)[-1] - _STEADY, 0.0)


MAP_QUANTITIES = {
    name: MapQuantity(name, of, plain(NOMENCLATURE[name].unit), scale)
    for name, of, scale in (("spectral_radius", _moduli, 0.1), ("gust_response", _gust_response, 1.0))
}
