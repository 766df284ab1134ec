"""Coefficients that differ between arm and hand, and smaller loads of a wing on the upstroke.

Both kernels are made of the kernels of coefficient models. The first axis of every array of angles counts the
strips.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from wingbeat._jax.arrays import horner, jnp, register_record, sin

if TYPE_CHECKING:
    from wingbeat._jax.shapes import Angles, Scalar
    from wingbeat.aero.coefficient_model import Kernel

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
    """The kernel of a wing whose inner and outer strips have different coefficients; a JAX pytree.

    Parameters
    ----------
    arm, hand : kernels of the two parts.
    arm_strips : number of strips that belong to the arm.
    """

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
        """Return C_L and C_D at `alpha` [rad], shape (N, ...).

        Theory: equation ``upstroke-factor``.
        """
        lift, drag = self.kernel.lift_drag(alpha)
        below = jnp.clip(0.5 + 0.5 * sin(alpha) / math.sin(math.radians(_CHANGE_DEG)), 0.0, 1.0)
        smooth = below * below * below * horner((10.0, -15.0, 6.0), below)
        left = self.factor + (1.0 - self.factor) * smooth
        return left * lift, left * drag

    def centre_of_pressure(self, alpha: Angles) -> Angles:
        """Return x_cp at `alpha` [rad], shape (N, ...); NaN if there is none."""
        return self.kernel.centre_of_pressure(alpha)
