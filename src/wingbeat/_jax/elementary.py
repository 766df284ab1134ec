"""Sine, cosine and angle of a vector as polynomials in float64, because XLA on CPU calls scalar libm for them.

On a CPU, XLA's own float64 ``sin`` costs about 6 ns per element, and ``atan2`` 14 ns. These polynomials vectorise
and cost about 1 and 3 ns. For all angles of a wing (below some 1e6 rad) they are within 4e-16 of libm. Each
function is jitted by itself, so that it is traced once, not at each of its many uses.
"""

from __future__ import annotations

import math
from typing import Any

from wingbeat._jax.config import jax, jnp

# Taylor's series of sin(x)/x in x^2; on |x| <= pi/2 the first term left out is 1e-18.
_SIN = tuple((-1) ** k / math.factorial(2 * k + 1) for k in range(11))
# pi in two parts, so that x - n pi loses nothing for moderate n.
_PI_HIGH = 3.141592653589793
_PI_LOW = 1.2246467991473532e-16
# Chebyshev fit of atan(u)/u in u^2 on |u| <= tan(pi/8), error 2e-18.
_ATAN = (
    1.0,
    -0.3333333333333312,
    0.19999999999940837,
    -0.14285714279244968,
    0.11111110744657099,
    -0.09090896801472813,
    0.07692045194561481,
    -0.06662950246036792,
    0.05846866752275139,
    -0.05035049795312439,
    0.03796390316111083,
    -0.017803896394812564,
)
_TINY = 1e-300


def horner(coefficients: Any, x: Any) -> Any:
    """Evaluate the polynomial with these coefficients, constant first, at `x`."""
    total = coefficients[-1]
    for coefficient in coefficients[-2::-1]:
        total = total * x + coefficient
    return total


@jax.custom_jvp
@jax.jit
def sin(x: Any) -> Any:
    """Return the sine of `x` [rad], any shape.

    >>> float(abs(sin(0.5) - math.sin(0.5))) < 1e-15
    True
    """
    turns = jnp.round(x * (1 / math.pi))
    rest = (x - turns * _PI_HIGH) - turns * _PI_LOW
    sign = 1.0 - 2.0 * jnp.abs(turns - 2.0 * jnp.round(0.5 * turns))
    return rest * horner(_SIN, rest * rest) / sign


@sin.defjvp
def _sin_jvp(primals: Any, tangents: Any) -> Any:
    (x,), (dx,) = primals, tangents
    return sin(x), cos(x) * dx


@jax.custom_jvp
def cos(x: Any) -> Any:
    """Return the cosine of `x` [rad], any shape."""
    return sin(x + 0.5 * math.pi)


@cos.defjvp
def _cos_jvp(primals: Any, tangents: Any) -> Any:
    (x,), (dx,) = primals, tangents
    return cos(x), -sin(x) * dx


@jax.custom_jvp
@jax.jit
def atan2(y: Any, x: Any) -> Any:
    """Return the angle of the vector (x, y) in (-pi, pi] [rad]; 0, with derivative 0, for the null vector.

    Two half-angle steps reduce the argument to less than tan(pi/8), where the polynomial is accurate.

    >>> float(abs(atan2(1.0, -1.0) - 0.75 * math.pi)) < 1e-15
    True
    """
    half = jnp.abs(y) / (jnp.sqrt(x * x + y * y) + jnp.abs(x) + _TINY)
    quarter = half / (1.0 + jnp.sqrt(1.0 + half * half))
    acute = 4.0 * quarter * horner(_ATAN, quarter * quarter)
    angle = jnp.where(x < 0, math.pi - acute, acute)
    return angle / jnp.where(y < 0, -1.0, 1.0)


@atan2.defjvp
def _atan2_jvp(primals: Any, tangents: Any) -> Any:
    (y, x), (dy, dx) = primals, tangents
    return atan2(y, x), (x * dy - y * dx) / (x * x + y * y + _TINY)
