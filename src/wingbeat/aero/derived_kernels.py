"""Kernels made of the kernels of coefficient models: sections of a finite wing, arm and hand, and the upstroke.

Sections follow from Prandtl's lifting line by removing the wing's own induced flow: if a wing of aspect ratio A
has the angle of attack ``alpha``, its sections meet the air at ``alpha - eps`` with ``eps = C_L / (pi A)``, and
their lift is normal to that air. So the section at ``alpha - eps`` has ``c_l = C_L cos(eps) + C_D sin(eps)`` and
``c_d = C_D cos(eps) - C_L sin(eps)``. For arm and hand, the first axis of every array of angles counts the strips.
"""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from wingbeat._base import Fault, InvalidInputError
from wingbeat._jax.arrays import horner, jnp, register_record, sin
from wingbeat.aero.coefficient_model import CoefficientModel, Kernel

if TYPE_CHECKING:
    from wingbeat._jax.arrays import Angles, Scalar, Spline
    from wingbeat.aero.coefficient_model import Kernel

# Knots of the tables over the whole turn: a spline through them is within 1e-6 of the formulas of the library, and
# within 1e-4 in the blends.
_CELLS = 1440
_PASSES = 10
# A section's drag may be 0, but not negative beyond rounding.
_ROUNDING = 1e-6


class SectionalKernel(NamedTuple):
    """Coefficients of a section: cubic splines with equal steps of angle from -pi to pi; a JAX pytree."""

    lift_spline: Spline
    drag_spline: Spline
    centre_spline: Spline

    def lift_drag(self, alpha: Angles) -> tuple[Angles, Angles]:
        """Return c_l and c_d at `alpha` [rad], any shape."""
        return self._value(self.lift_spline, alpha), self._value(self.drag_spline, alpha)

    def centre_of_pressure(self, alpha: Angles) -> Angles:
        """Return x_cp at `alpha` [rad], any shape; NaN if there is none."""
        return self._value(self.centre_spline, alpha)

    def _value(self, spline: Spline, alpha: Angles) -> Angles:
        cells = (alpha + math.pi) * (_CELLS / (2 * math.pi))
        cell = jnp.clip(jnp.floor(cells), 0, _CELLS - 1)
        pieces = jnp.asarray(spline)[:, cell.astype(jnp.int32)]
        return horner(tuple(pieces), cells - cell)


# A problem asks twice for the kernel, at 0.03 s each, and an answer of the explorer sets up its problem five times.
@functools.lru_cache(maxsize=32)
def sectional_kernel(model: CoefficientModel) -> Kernel:
    """Return the kernel of a finite wing's sectional coefficients. Theory: equation ``section-coefficients``."""
    if model.aspect_ratio is None:
        rule = f"needs the aspect ratio of the wing that was measured, and {model.name} states none"
        fix = "use a model that has one, state aspect_ratio in the table or model, or leave the inflow out"
        raise InvalidInputError([Fault("aero.inflow", "momentum", rule, fix)])
    if math.isinf(model.aspect_ratio):
        return model.kernel()
    if (of_members := getattr(model, "kernel_of", None)) is not None:
        return of_members(sectional_kernel)
    knots = np.linspace(-math.pi, math.pi, _CELLS + 1)
    alpha = _wing_angles(model, model.aspect_ratio, knots)
    lift, drag = model.lift(alpha), model.drag(alpha)
    sine, cosine = np.sin(alpha - knots), np.cos(alpha - knots)
    centre = model.centre_of_pressure(alpha) if model.has_centre_of_pressure else np.full_like(alpha, np.nan)
    columns = (lift * cosine + drag * sine, drag * cosine - lift * sine, centre)
    least = int(np.argmin(columns[1]))
    if columns[1][least] < -_ROUNDING:
        here = f"C_D {drag[least]:.3g} and C_L {lift[least]:.3g} at {np.degrees(alpha[least]):.1f} degrees"
        rule = f"has {here}: less drag than the ideal induced drag of aspect ratio {model.aspect_ratio:g}"
        fix = "check aspect_ratio; it is inf if a section was measured"
        raise InvalidInputError([Fault("aero.coefficients", model.name, rule, fix)])
    return SectionalKernel(*(_spline(knots, column) for column in columns))


def _wing_angles(model: CoefficientModel, aspect_ratio: float, section: np.ndarray) -> np.ndarray:
    """Return a wing's angles at which its sections have these [rad]. Theory: equation ``section-angle``."""

    def turned(alpha: np.ndarray) -> np.ndarray:
        return model.lift(alpha) / (math.pi * aspect_ratio)

    fine = np.linspace(-math.pi, math.pi, 4 * _CELLS + 1)
    there = fine - turned(fine)
    if not (np.diff(there) > 0).all():
        rule = f"has no sectional coefficients: its lift rises too fast for an aspect ratio of {aspect_ratio:g}"
        raise InvalidInputError([Fault("aero.coefficients", model.name, rule, "check aspect_ratio")])
    alpha = np.interp(section, there, fine, period=2 * math.pi)
    # np.interp may return an angle that is off by a whole turn. Each pass divides the remaining error by 3 or more.
    alpha = section + np.remainder(alpha - section + math.pi, 2 * math.pi) - math.pi
    for _ in range(_PASSES):
        alpha = section + turned(alpha)
    return alpha


def _spline(knots: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Return the pieces of a periodic spline, constant first, whose variable runs from 0 to 1 in each cell."""
    from scipy.interpolate import CubicSpline

    if np.isnan(values).any():
        return np.full((4, _CELLS), np.nan)
    whole = np.append(values[:-1], values[0])
    return CubicSpline(knots, whole, bc_type="periodic").c[::-1] * (knots[1] - knots[0]) ** np.arange(4)[:, None]


# Half width of the change between air from below and air from above [deg].
_CHANGE_DEG = 5.0


def count_arm_strips(strips: int, hand_from: float) -> int:
    """Return how many of a wing's strips have their centre at or inside the span fraction where the hand begins.

    >>> count_arm_strips(10, 0.5), count_arm_strips(10, 0.25)
    (5, 3)
    """
    return sum((i + 0.5) / strips <= hand_from for i in range(strips))


@register_record(static=("arm_strips",))
@dataclass(frozen=True)
class ArmHandKernel:
    """The kernel of a wing whose inner and outer strips have different coefficients; a JAX pytree."""

    arm: Kernel
    hand: Kernel
    arm_strips: int

    def lift_drag(self, alpha: Angles) -> tuple[Angles, Angles]:
        """Return C_L and C_D at `alpha` [rad], shape (N, ...)."""
        inner, outer = self.arm.lift_drag(alpha[: self.arm_strips]), self.hand.lift_drag(alpha[self.arm_strips :])
        return jnp.concatenate([inner[0], outer[0]]), jnp.concatenate([inner[1], outer[1]])

    def centre_of_pressure(self, alpha: Angles) -> Angles:
        """Return x_cp at `alpha` [rad], shape (N, ...); NaN if there is none."""
        inner = self.arm.centre_of_pressure(alpha[: self.arm_strips])
        return jnp.concatenate([inner, self.hand.centre_of_pressure(alpha[self.arm_strips :])])


class UpstrokeKernel(NamedTuple):
    """The kernel of a wing that lets air through, or folds away, where air meets it from above; a JAX pytree.

    Lift and drag are those of `kernel` times `factor` where ``sin(alpha) < 0``. Within 5 degrees of an angle of
    attack of 0 or 180 degrees the multiplier changes from 1 to `factor`, with continuous second derivative.
    """

    kernel: Kernel
    factor: Scalar

    def lift_drag(self, alpha: Angles) -> tuple[Angles, Angles]:
        """Return C_L and C_D at `alpha` [rad], shape (N, ...). Theory: equation ``upstroke-factor``."""
        lift, drag = self.kernel.lift_drag(alpha)
        below = jnp.clip(0.5 + 0.5 * sin(alpha) / math.sin(math.radians(_CHANGE_DEG)), 0.0, 1.0)
        smooth = below * below * below * horner((10.0, -15.0, 6.0), below)
        left = self.factor + (1.0 - self.factor) * smooth
        return left * lift, left * drag

    def centre_of_pressure(self, alpha: Angles) -> Angles:
        """Return x_cp at `alpha` [rad], shape (N, ...); NaN if there is none."""
        return self.kernel.centre_of_pressure(alpha)
