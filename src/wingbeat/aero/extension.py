"""Extend coefficients that are known for one side of a plate to every angle of attack.

Formulas and tables give the coefficients of a plate for 0 to 90 degrees; a flapping wing sees every angle.
Angles are in (-180, 180]; the extension is chosen by name:

mirrored
    the plate seen from behind and from below: C_L odd and C_D even in alpha, ``C_L(180-a) = -C_L(a)``,
    ``C_D(180-a) = C_D(a)``, x_cp even, ``x_cp(180-a) = 1 - x_cp(a)``. This is the physical extension, and the
    default.
signed-drag
    as mirrored, but C_D is the formula at the signed angle for -90 < a < 0.
signed
    as signed-drag, and C_L (and x_cp of a table) is also the formula at the signed angle for -90 < a < 0. An
    exception is a formula with an exponential term, which diverges at negative angles: it stays mirrored.
clipped-drag
    as mirrored, but C_D is the formula's value at 0 for every a < 0.

Two pieces meet in a join at 0, +-90 or 180 degrees. Nearer to a join than the blend width, the coefficient is the
quintic Hermite polynomial that agrees with both pieces in value, slope and curvature at join +- width. Its even and
its odd part in the distance are stored apart, so that a mirrored coefficient is exactly even or odd.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

import numpy as np

from wingbeat._base import FaultList
from wingbeat._jax.arrays import horner, jax, jnp
from wingbeat._jax.exported import exported

if TYPE_CHECKING:
    from wingbeat._jax.arrays import Angles, Scalar

Function = Callable[[Any], Any]


class Jet(NamedTuple):
    """Value, slope and curvature of a function at one point."""

    value: Scalar
    slope: Scalar
    curvature: Scalar

    def mirrored(self) -> Jet:
        """Return the jet of the curve with its argument's sign reversed."""
        return self._replace(slope=-self.slope)

    def negated(self) -> Jet:
        """Return the jet of the negative of the curve."""
        return Jet(*(-part for part in self))


# A curve by its jets: the angle in, the jet there out.
Jets = Callable[[Any], Jet]


def jet_of(function: Function, at: Scalar) -> Jet:
    """Return value, slope and curvature of a function, by automatic differentiation."""
    one = jnp.ones_like(at)
    (value, slope), (_, curvature) = jax.jvp(lambda x: jax.jvp(function, (x,), (one,)), (at,), (one,))
    return Jet(value, slope, curvature)


def even_blend(jet: Jet, width: Scalar) -> tuple[Scalar, ...]:
    """Return the even polynomial with `jet` at `width`, in distance squared. Theory: equation ``even-blend``."""
    f, s, k = jet.value, jet.slope * width, jet.curvature * width**2
    return f - (5 * s - k) / 8, (3 * s - k) / (4 * width**2), (k - s) / (8 * width**4)


def odd_blend(jet: Jet, width: Scalar) -> tuple[Scalar, ...]:
    """Return the odd polynomial with `jet` at `width`, over the distance. Theory: equation ``odd-blend``."""
    f, s, k = jet.value, jet.slope * width, jet.curvature * width**2
    first, third = (15 * f - 7 * s + k) / (8 * width), (5 * (s - f) - k) / (4 * width**3)
    return first, third, (k - 3 * (s - f)) / (8 * width**5)


class Blend(NamedTuple):
    """The even and the odd part of a quintic blend between any two pieces."""

    even: tuple[Scalar, ...]
    odd: tuple[Scalar, ...]

    @classmethod
    def between(cls, left: Jet, right: Jet, width: Scalar) -> Blend:
        """Return the blend with `left` at -width and `right` at +width. Theory: equation ``join-blend``."""
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


EXTENSIONS = ("mirrored", "signed-drag", "signed", "clipped-drag")
MAX_BLEND_WIDTH_DEG = 3.0
RIGHT_ANGLE = 0.5 * math.pi
# Distances at which the drag in a blend, a quintic, is checked.
_SAMPLES = 201


class Pieces(Protocol):
    """The coefficients to extend: functions of the angle [rad], given on [0, 90] degrees; a JAX pytree.

    Without a centre of pressure `centre` gives NaN, so that models with and without one are the same pytree.
    """

    def lift(self, alpha: Angles) -> Angles:
        """Return C_L."""
        ...

    def drag(self, alpha: Angles) -> Angles:
        """Return C_D."""
        ...

    def centre(self, alpha: Angles) -> Angles:
        """Return x_cp in chords from the leading edge."""
        ...


def check_extension(faults: FaultList, extension: Any, blend_width_deg: Any) -> None:
    """Note a fault for an unknown extension or a blend width that is not in (0, 3] degrees."""
    if extension == "viterna":
        rule = "completes the file of a table that ends at the stall, and this model needs no completion"
        faults.add("extension", extension, rule, f"use one of {', '.join(EXTENSIONS)}")
    else:
        faults.choice("extension", extension, EXTENSIONS)
    faults.number(
        "blend_width_deg",
        blend_width_deg,
        above=0,
        at_most=MAX_BLEND_WIDTH_DEG,
        unit="degrees",
        fix="1 is the default; without a blend the coefficients jump at 0 and 90 degrees",
    )


class SignedPatch(NamedTuple):
    """The formula at the signed angle, which replaces the mirrored coefficient for -90 < a < 0."""

    at_minus_right: Blend

    def over(self, value: Angles, piece: Function, alpha: Angles, width: Scalar) -> Angles:
        """Return the patched coefficient, which needs no blend at 0. Theory: equation ``signed-extensions``."""
        inside = (alpha > -RIGHT_ANGLE) & (alpha < width)
        value = jnp.where(inside, piece(jnp.where(inside, alpha, 0.0)), value)
        return self.at_minus_right.over(value, alpha + RIGHT_ANGLE, width)


class ClippedPatch(NamedTuple):
    """A constant, which replaces the mirrored coefficient for a < 0."""

    level: Scalar
    at_zero: Blend
    at_half_turn: Blend

    def over(self, value: Angles, piece: Function, alpha: Angles, width: Scalar) -> Angles:
        """Return the patched coefficient. Theory: equation ``signed-extensions``."""
        value = self.at_zero.over(jnp.where(alpha < 0, self.level, value), alpha, width)
        return self.at_half_turn.over(value, alpha - jnp.where(alpha < 0, -math.pi, math.pi), width)


class Ends(NamedTuple):
    """The blends of one mirrored coefficient at 0 and 90 degrees, and its patch for a < 0 (None without one)."""

    at_zero: tuple[Any, ...]
    at_right: tuple[Any, ...]
    patch: SignedPatch | ClippedPatch | None


def _fold(alpha: Angles) -> tuple[Angles, Angles]:
    """Return the angle minus whole half turns, and the number of these. Theory: equation ``folded-angle``."""
    turns = jnp.round(alpha * (1 / math.pi))
    return alpha - turns * math.pi, turns


class ExtendedKernel(NamedTuple):
    """Coefficients at every angle in [-pi, pi], for use under JAX's jit, vmap and derivatives.

    All its numbers are leaves of the pytree, so models of one form share one compiled function.
    """

    pieces: Pieces
    width: Scalar
    lift: Ends
    drag: Ends
    centre: Ends

    def lift_drag(self, alpha: Angles) -> tuple[Angles, Angles]:
        """Return C_L and C_D at `alpha` [rad], any shape. Theory: equation ``mirrored-extension``."""
        # One fold serves both: mirrored, C_L and C_D repeat every half turn.
        folded, _ = _fold(alpha)
        sign = jnp.where(folded < 0, -1.0, 1.0)
        acute = sign * folded
        short = acute - RIGHT_ANGLE
        near_zero, near_right = acute < self.width, -short < self.width
        squared, short_squared = folded * folded, short * short

        lift = jnp.where(near_right, short * horner(self.lift.at_right, short_squared), self.pieces.lift(acute))
        lift = jnp.where(near_zero, folded * horner(self.lift.at_zero, squared), sign * lift)
        drag = jnp.where(near_right, horner(self.drag.at_right, short_squared), self.pieces.drag(acute))
        drag = jnp.where(near_zero, horner(self.drag.at_zero, squared), drag)
        if self.lift.patch is not None:
            lift = self.lift.patch.over(lift, self.pieces.lift, alpha, self.width)
        if self.drag.patch is not None:
            drag = self.drag.patch.over(drag, self.pieces.drag, alpha, self.width)
        return lift, drag

    def centre_of_pressure(self, alpha: Angles) -> Angles:
        """Return x_cp at `alpha` [rad], NaN if there is none. Theory: equation ``mirrored-extension``."""
        folded, turns = _fold(alpha)
        acute = jnp.where(folded < 0, -1.0, 1.0) * folded
        short = acute - RIGHT_ANGLE
        near_zero = acute < self.width
        # a^0.6 has no derivative at 0, and where() would let that NaN through even where it selects the other
        # branch.
        centre = self.pieces.centre(jnp.where(near_zero, self.width, acute))
        at_right = 0.5 + short * horner(self.centre.at_right, short * short)
        centre = jnp.where(-short < self.width, at_right, centre)
        centre = jnp.where(near_zero, horner(self.centre.at_zero, folded * folded), centre)
        centre = jnp.where(turns != 0, 1.0 - centre, centre)
        if self.centre.patch is not None:
            centre = self.centre.patch.over(centre, self.pieces.centre, alpha, self.width)
        return centre


def _ends(jet: Jets, width: Scalar, extension: str, name: str, signed: tuple[str, ...]) -> Ends:
    """Return the blends of the coefficient `name`. Theory: equation ``mirrored-blends``."""
    zero, right = jet(width), jet(RIGHT_ANGLE - width)
    backwards = right.mirrored()
    blend_zero, blend_right, behind = even_blend(zero, width), even_blend(backwards, width), right
    if name == "lift":
        blend_zero, blend_right = odd_blend(zero, width), odd_blend(backwards.negated(), width)
    if name == "centre":
        # About 90 degrees it is x_cp - 1/2 that is odd.
        about_half = backwards.negated()
        blend_right = odd_blend(about_half._replace(value=about_half.value + 0.5), width)
        behind = right.negated()._replace(value=1.0 - right.value)
    patch = None
    if name in signed and (extension == "signed" or (extension == "signed-drag" and name == "drag")):
        patch = SignedPatch(Blend.between(behind, jet(width - RIGHT_ANGLE), width))
    elif extension == "clipped-drag" and name == "drag":
        zero = 0.0 * width
        level = Jet(jet(zero).value, zero, zero)
        front = jet(width)
        joins = Blend.between(level, front, width), Blend.between(front.mirrored(), level, width)
        patch = ClippedPatch(level.value, *joins)
    return Ends(blend_zero, blend_right, patch)


def check_drag_of_joins(
    faults: FaultList, what: str, jet: Jets, blend_width_deg: float, extension: str, signed: tuple[str, ...]
) -> None:
    """Note a fault for each join in whose blend C_D is not positive; `what` names C_D in the faults."""
    # A blend keeps slope and curvature at its ends, so it can fall below both where drag is steep there.
    width = blend_width_deg * (math.pi / 180)
    ends = _ends(jet, width, extension, "drag", signed)
    blends = {90: Blend(ends.at_right, (0.0,))}
    if isinstance(ends.patch, SignedPatch):
        blends[-90] = ends.patch.at_minus_right
    else:
        blends[0] = Blend(ends.at_zero, (0.0,))
    if isinstance(ends.patch, ClippedPatch):
        blends |= {0: ends.patch.at_zero, 180: ends.patch.at_half_turn}
    distances = np.linspace(-width, width, _SAMPLES)
    for at, blend in blends.items():
        least = float(blend.at(distances).min())
        if least <= 0:
            where = f"{what} in the blend at {at} degrees (half width {blend_width_deg:g})"
            rule = "must be > 0: drag next to the blend is too steep for its width"
            faults.add(where, least, rule, "give a smaller blend_width_deg, or measure at more angles there")


@exported(static=("extension", "signed"))
def _extended(pieces: Pieces, width: Scalar, *, extension: str, signed: tuple[str, ...]) -> ExtendedKernel:
    """Return the kernel with its blends."""
    ends = [
        _ends(lambda at, name=name: jet_of(getattr(pieces, name), at), width, extension, name, signed)
        for name in ("lift", "drag", "centre")
    ]
    return ExtendedKernel(pieces, width, *ends)


def extend(pieces: Pieces, blend_width_deg: Scalar, extension: str, signed: tuple[str, ...]) -> ExtendedKernel:
    """Return the kernel of coefficients extended to every angle; those in `signed` are valid from -90 degrees."""
    return _extended(pieces, blend_width_deg * (math.pi / 180), extension=extension, signed=signed)
