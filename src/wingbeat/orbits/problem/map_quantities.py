"""Quantities read off the stroke map of an orbit: its spectral radius and its response to gusts."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from wingbeat._base import NOMENCLATURE, plain
from wingbeat._jax.arrays import jax, jnp
from wingbeat.orbits.problem.quantity import Quantity

if TYPE_CHECKING:
    from wingbeat._jax.arrays import FiveExcesses, FourCoefficients, Moduli, Scalar, StrokeMatrix

# What counts as stable where nobody gives a limit: disturbances are halved in 140 beats at the latest.
STABLE_RADIUS = 0.995
# Disturbances of (body_pitch, u, w, pitch_rate) that count as equally large [rad, m/s, m/s, rad/s].
_EQUAL = (0.1, 1.0, 1.0, 2.0)
# The response to gusts is infinite at a spectral radius of 1. Up to the radius given here, it is exact.
_STEADY = 0.999
# The solver's limit of the spectral radius is lower than the user's by this share. Where two multipliers meet at a
# limit, they exceed it by the square root of the residual that the solver's tolerances allow.
_INSET = 1e-3
# Weights of the conditions of stability; the first is the product of four distances from 1, which are small.
_WEIGHTS = (100.0, 1.0, 1.0, 1.0, 1.0)
# Slope of the response above the radius `_STEADY`: steep, so that a search turns back.
_BEYOND = 1e3


@dataclass(frozen=True)
class MapQuantity(Quantity):
    """A quantity of the stroke map.

    Parameters
    ----------
    name, unit, parameter, in_hover, needs : as of a `Quantity`.
    scale : a difference that matters, so that the optimiser sees numbers near one.
    of : function of the derivative of (body_pitch, u, w, pitch_rate) after a beat by the same four before it, shape
        (4, 4), in JAX-compatible Python; returns a number, or several, of which the largest counts.
    excess : a smooth function, for a quantity that is proportional to the stroke map. It takes the stroke map
        divided by an upper limit, and returns numbers that are all at most 0 if the quantity keeps to the limit. In
        a search, it replaces an `of` that has kinks.

    Raises
    ------
    InvalidInputError : as of a `Quantity`.

    >>> trace = MapQuantity("trace", lambda stroke_map: stroke_map.trace())
    >>> trace.name
    'trace'
    """

    of: Callable[[Any], Any]
    excess: Callable[[Any], Any] | None = None


def _moduli(stroke_map: StrokeMatrix) -> Moduli:
    """Return the moduli of the four multipliers."""
    return jnp.sort(jnp.abs(jnp.linalg.eigvals(stroke_map)))


def _characteristic(stroke_map: StrokeMatrix) -> FourCoefficients:
    """Return the coefficients of z^3, z^2, z and 1 in the characteristic polynomial (Faddeev and LeVerrier)."""
    found, power = [], jnp.eye(4)
    for order in range(1, 5):
        product = stroke_map @ power
        found.append(-jnp.trace(product) / order)
        power = product + found[-1] * jnp.eye(4)
    return jnp.stack(found)


def _beyond_circle(over_limit: StrokeMatrix) -> FiveExcesses:
    """Return five numbers that are all at most 0 only if no multiplier has a modulus above 1.

    The map ``z = (1 + s) / (1 - s)`` takes the left half-plane of s to the unit disc of multipliers z. All roots s
    of ``b4 s^4 + ... + b0`` lie in the left half-plane if b0, b2, b3, b4 and Hurwitz's third determinant are
    positive (Lienard and Chipart). These five numbers are smooth where two multipliers meet; each multiplier by
    itself has an infinite derivative there. If the five are positive, b1 is positive too. It has no row of its own,
    because the conditions would then be dependent where two multipliers meet at 1.

    Theory: equation ``stability-conditions``.
    """
    a3, a2, a1, a0 = _characteristic(over_limit / (1.0 - _INSET))
    b0, b4 = 1.0 + a3 + a2 + a1 + a0, 1.0 - a3 + a2 - a1 + a0
    b1, b3 = 4.0 + 2.0 * a3 - 2.0 * a1 - 4.0 * a0, 4.0 - 2.0 * a3 + 2.0 * a1 - 4.0 * a0
    b2 = 6.0 - 2.0 * a2 + 6.0 * a0
    determinant = b1 * b2 * b3 - b4 * b1**2 - b0 * b3**2
    return -jnp.stack([b0, b2, b3, b4, determinant]) * jnp.asarray(_WEIGHTS)


def _gust_response(stroke_map: StrokeMatrix) -> Scalar:
    """Return the root mean square of the disturbance under gusts of 1 m/s that change at random every beat.

    The covariance P of the disturbances solves ``P = A P A' + G G'`` with ``G = (I - A)[:, (u, w)]``. A is the
    stroke map.

    Theory: equation ``gust-response``.
    """
    radius = _moduli(stroke_map)[-1]
    steady = stroke_map * jnp.minimum(1.0, _STEADY / jax.lax.stop_gradient(radius))
    gust = (jnp.eye(4) - stroke_map)[:, 1:3]
    covariance = jnp.linalg.solve(jnp.eye(16) - jnp.kron(steady, steady), (gust @ gust.T).ravel()).reshape(4, 4)
    response = jnp.sqrt(jnp.diagonal(covariance) @ jnp.asarray(_EQUAL) ** -2)
    return response + _BEYOND * jnp.maximum(radius - _STEADY, 0.0)


MAP_QUANTITIES = {
    name: MapQuantity(name, of, plain(NOMENCLATURE[name].unit), scale, excess=excess)
    for name, of, scale, excess in (
        ("spectral_radius", _moduli, 0.1, _beyond_circle),
        ("gust_response", _gust_response, 1.0, None),
    )
}
