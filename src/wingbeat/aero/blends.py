"""Polynomials that join two curves in value, slope and curvature, stored as an even and an odd part."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

from wingbeat._jax.arrays import horner, jax, jnp

if TYPE_CHECKING:
    from wingbeat._jax.shapes import Angles, Scalar


Function = Callable[[Any], Any]


class Jet(NamedTuple):
    """Value, slope and curvature of a function at one point."""

    value: Scalar
    slope: Scalar
    curvature: Scalar

    def mirrored(self) -> Jet:
        """Return the jet of the curve with its argument's sign reversed."""
        return Jet(self.value, -self.slope, self.curvature)

    def negated(self) -> Jet:
        """Return the jet of the negative of the curve."""
        return Jet(-self.value, -self.slope, -self.curvature)


# A curve by its jets: the angle in, the jet there out.
Jets = Callable[[Any], Jet]


def jet_of(function: Function, at: Scalar) -> Jet:
    """Return value, slope and curvature of a function, by automatic differentiation."""
    one = jnp.ones_like(at)

    def value_and_slope(x: Scalar) -> tuple[Scalar, Scalar]:
        return jax.jvp(function, (x,), (one,))

    (value, slope), (_, curvature) = jax.jvp(value_and_slope, (at,), (one,))
    return Jet(value, slope, curvature)


def even_blend(jet: Jet, width: Scalar) -> tuple[Scalar, ...]:
    """Return the coefficients of the even polynomial that has `jet` at `width`, by powers of distance squared.

    Theory: equation ``even-blend``.
    """
    f, s, k = jet.value, jet.slope * width, jet.curvature * width**2
    return f - (5 * s - k) / 8, (3 * s - k) / (4 * width**2), (k - s) / (8 * width**4)


def odd_blend(jet: Jet, width: Scalar) -> tuple[Scalar, ...]:
    """Return the same for the odd polynomial that has `jet` at `width`, after division by the distance.

    Theory: equation ``odd-blend``.
    """
    f, s, k = jet.value, jet.slope * width, jet.curvature * width**2
    return (
        (15 * f - 7 * s + k) / (8 * width),
        (5 * (s - f) - k) / (4 * width**3),
        (k - 3 * (s - f)) / (8 * width**5),
    )


class Blend(NamedTuple):
    """The even and the odd part of a quintic blend between any two pieces."""

    even: tuple[Scalar, ...]
    odd: tuple[Scalar, ...]

    @classmethod
    def between(cls, left: Jet, right: Jet, width: Scalar) -> Blend:
        """Return the blend that has `left` at distance -width and `right` at +width.

        Theory: equation ``join-blend``.
        """
        mirror = left.mirrored()
        even = Jet(*((r + m) / 2 for r, m in zip(right, mirror, strict=True)))
        odd = Jet(*((r - m) / 2 for r, m in zip(right, mirror, strict=True)))
        return cls(even_blend(even, width), odd_blend(odd, width))

    def at(self, distance: Angles) -> Angles:
        """Return the blend's value at a distance from the join."""
        squared = distance * distance
        return horner(self.even, squared) + distance * horner(self.odd, squared)

    def over(self, value: Angles, distance: Angles, width: Scalar) -> Angles:
        """Return `value`, or the blend's value if the distance is below the width."""
        return jnp.where(jnp.abs(distance) < width, self.at(distance), value)
