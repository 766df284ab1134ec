"""A pitch hinge that nothing drives: its numbers, its torque, and its motion at an instant."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from wingbeat._base import FaultList
from wingbeat._jax.arrays import at_default, jnp, register_record

if TYPE_CHECKING:
    from wingbeat._jax.arrays import Phases, Scalar

# Over this angle a stop goes from no torque to its stiffness [rad], so that a flight stays smooth.
_STOP_WIDTH = 0.05


@register_record(static=("twist_share",), optional=("stop_stiffness",))
@dataclass(frozen=True)
class PitchHinge:
    """A hinge that nothing drives: the wing's pitch gives way until spring, damper, inertia and air balance.

    Its torque is ``-k (theta - theta_0) - c theta'``, and that of its stops. A strip is pitched by its angle
    theta times ``(1 - t) g + t s/L``, where t is `twist_share` and g the strip's twist factor; unless t is 1, this
    stands in place of the pitch law.

    Parameters
    ----------
    stiffness : k, of the springs of both wings together [N m/rad].
    damping : c, of the dampers of both wings together [N m s/rad].
    rest_angle : theta_0, at which the springs exert no torque, leading edge up positive [rad].
    stop_angle : at which the stops begin, on both sides of 0 [rad].
    stop_stiffness : of the stops of both wings together [N m/rad]; 0 is a hinge without stops. The torque grows
        smoothly from none to this slope, over some 3 degrees.
    twist_share : a ratio: 0 for a wing that turns as a whole about its axis, 1 for one whose root follows the pitch
        law and that twists linearly from root to tip, by theta at the tip; between them, both give way together.

    Raises
    ------
    InvalidInputError : a negative stiffness or damping, a hinge with neither spring nor stops, an angle beyond half
        a turn, a share outside 0 to 1.

    Theory: equation ``hinge-torque``. Source: Whitney and Wood 2010 (doi 10.1017/S002211201000265X), of the passive
    hinge.

    >>> PitchHinge(stiffness=2.4, damping=0.02, rest_angle=-0.3).stop_stiffness
    0.0
    """

    stiffness: float
    damping: float = 0.0
    rest_angle: float = 0.0
    stop_angle: float = 0.25 * math.pi
    stop_stiffness: float = 0.0
    twist_share: float = 0.0

    def __post_init__(self) -> None:
        faults = FaultList()
        both = "count both wings"
        faults.number("pitch_hinge.stiffness", self.stiffness, at_least=0, unit="N m/rad", fix=both)
        faults.number("pitch_hinge.damping", self.damping, at_least=0, unit="N m s/rad", fix=both)
        faults.angle("pitch_hinge.rest_angle", self.rest_angle)
        faults.angle("pitch_hinge.stop_angle", self.stop_angle, at_least=0)
        faults.number("pitch_hinge.stop_stiffness", self.stop_stiffness, at_least=0, unit="N m/rad", fix=both)
        fix = "0 turns the whole wing, 1 twists it from root to tip"
        faults.number("pitch_hinge.twist_share", self.twist_share, at_least=0, at_most=1, fix=fix)
        faults.raise_if_any()
        if self.stiffness == self.stop_stiffness == 0:
            rule = "leaves the wing without spring and stops"
            faults.add("pitch_hinge.stiffness", self.stiffness, rule, "give it a stiffness, or stop_stiffness")
        faults.raise_if_any()

    @property
    def moves_root(self) -> bool:
        """Whether the wing's root pitches with the hinge, in place of the pitch law."""
        return self.twist_share < 1

    def torque(self, angle: Phases, rate: Phases) -> Phases:
        """Return the torque of both hinges on the wings [N m]. Theory: equation ``hinge-torque``.

        Parameters
        ----------
        angle, rate : of the hinge [rad, rad/s], any shape.
        """
        found = -self.stiffness * (angle - self.rest_angle) - self.damping * rate
        if not at_default(self, "stop_stiffness"):
            over, under = (
                _STOP_WIDTH * jnp.logaddexp(0.0, (side * angle - self.stop_angle) / _STOP_WIDTH)
                for side in (1.0, -1.0)
            )
            found = found - self.stop_stiffness * (over - under)
        return found


class HeldHinge(NamedTuple):
    """A hinge whose motion is known at one instant, in place of a `PitchHinge`; arrays of the phases' shape."""

    phase: Phases  # of the instant
    angle: Phases  # there [rad]
    rate: Phases  # [rad/s]
    acceleration: Phases  # [rad/s2]
    hinge: PitchHinge

    @property
    def moves_root(self) -> bool:
        """Whether the wing's root pitches with the hinge."""
        return self.hinge.moves_root

    def at(self, phase: Phases, frequency: Scalar) -> Phases:
        """Return the angle near the instant [rad], exact with its first two derivatives there."""
        later = (phase - self.phase) / frequency
        return self.angle + later * (self.rate + 0.5 * later * self.acceleration)


# The numbers of a hinge that can be free, by their names among a wingbeat's.
HINGE_NAMES = {f"hinge_{name}": name for name in ("stiffness", "damping", "rest_angle")}
