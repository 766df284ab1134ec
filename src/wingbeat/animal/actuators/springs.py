"""Springs at the flap hinges: beside the actuator (parallel), or between actuator and wing (in series)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from wingbeat._base import FaultList
from wingbeat._jax.config import jnp, register_record

if TYPE_CHECKING:
    from wingbeat._jax.shapes import Series

# Central differences of order 6 at samples of equal distance: weights of the samples 1, 2 and 3 steps ahead.
_AHEAD = (45 / 60, -9 / 60, 1 / 60)


@register_record
@dataclass(frozen=True)
class Springs:
    """Springs at the flap hinges, both sides together.

    Parameters
    ----------
    stiffness : of the springs beside the actuators, between body and arm [N m/rad].
    rest_angle : flap angle at which these springs exert no torque [rad].
    series_compliance : one over the stiffness of the springs between actuator and wing [rad/(N m)]; 0 is rigid.

    Raises
    ------
    InvalidInputError : a negative stiffness or compliance, a rest angle beyond half a turn, a number that is not
        finite.

    >>> Springs(stiffness=0.5).series_compliance
    0.0
    """

    stiffness: float = 0.0
    rest_angle: float = 0.0
    series_compliance: float = 0.0

    def __post_init__(self) -> None:
        faults = FaultList()
        faults.number("springs.stiffness", self.stiffness, at_least=0, unit="N m/rad", fix="count both sides")
        faults.angle("springs.rest_angle", self.rest_angle)
        fix = "give one over the stiffness of the series springs, or 0 for rigid ones"
        faults.number("springs.series_compliance", self.series_compliance, at_least=0, unit="rad/(N m)", fix=fix)
        faults.raise_if_any()


class Driven(NamedTuple):
    """Torque and motion that the actuators of both flap hinges must provide, as arrays of shape (K,).

    Attributes
    ----------
    torque : up positive [N m].
    rate : of the actuator's angle, converted to an angle of the flap hinge [rad/s].
    acceleration : [rad/s2].
    """

    torque: Series
    rate: Series
    acceleration: Series


def periodic_rate(values: Series, period: Any) -> Series:
    """Return the rate of a periodic series, by central differences of order 6.

    Parameters
    ----------
    values : at equal phases from 0 to 1, both ends included and equal, shape (K,).
    period : [s].
    """
    once = values[:-1]
    step = period / once.shape[0]
    pairs = (weight * (jnp.roll(once, -n) - jnp.roll(once, n)) for n, weight in enumerate(_AHEAD, 1))
    rate = sum(pairs) / step
    return jnp.concatenate((rate, rate[:1]))


def spring_torque(stiffness: Any, flap: Series, rest_angle: Any) -> Series:
    """Return the torque of springs beside the actuators, ``-k (flap - rest)`` [N m].

    Parameters
    ----------
    stiffness, rest_angle : k of both sides [N m/rad], and the flap angle at which the springs exert no torque
        [rad].
    flap : [rad], shape (K,).
    """
    return -stiffness * (flap - rest_angle)


def actuated(springs: Springs, flap: Series, rate: Series, torque: Series, period: Any) -> Driven:
    """Return the torque and motion that the actuators of the flap hinges must provide with these springs.

    Equations: the actuators give the torque that the springs beside them do not give. All of this torque passes
    through the springs in series, so that the actuators' angle is ahead of the flap angle by
    ``compliance * torque``.

    Parameters
    ----------
    springs : the springs.
    flap, rate, torque : angle, rate and torque of both flap hinges [rad, rad/s, N m], shape (K,).
    period : [s].
    """
    left = torque - spring_torque(springs.stiffness, flap, springs.rest_angle)
    own_rate = rate + springs.series_compliance * periodic_rate(left, period)
    return Driven(left, own_rate, periodic_rate(own_rate, period))
