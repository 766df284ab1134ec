"""Flight muscle: the force that it can exert at a given speed, and the metabolic power of that force.

A muscle's fibres shorten in proportion to the flap angle. The largest force of a muscle falls with its speed of
shortening. A force costs metabolic power even if it does no work. So a fast beat of small amplitude has a cost too.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from wingbeat._base import FaultList
from wingbeat._jax.config import jnp, register_record

if TYPE_CHECKING:
    from wingbeat._jax.shapes import Series

# Density of muscle [kg/m3]: Mendez and Keys 1960, Metabolism 9:184.
MUSCLE_DENSITY = 1060.0
# Largest eccentric force divided by isometric force, and the steepness of its rise: Alexander 1997, doi
# 10.1006/jtbi.1996.0262, as implemented by others.
_LARGEST, _STEEPNESS = 1.8, 7.56
# Above this share of the largest speed, the curve of the isometric force that a torque needs continues as its
# tangent.
_LAST_SHARE = 0.95


@register_record
@dataclass(frozen=True)
class Muscle:
    """The flight muscles of both sides: depressors that pull the wings down, and elevators that raise them.

    Both have the same kind of fibre. Fibres shorten in proportion to the flap angle, as on a pulley.

    Parameters
    ----------
    mass : of the depressors, both sides [kg].
    elevator_share : ratio of the elevators' mass to that of the depressors.
    strain_per_angle : fibre strain per flap angle [1/rad].
    max_strain_rate : largest speed of shortening, in lengths per second [1/s].
    isometric_stress : stress of fully active fibres that keep their length [Pa].
    curvature : k of Hill's relation [-]; the smaller k is, the faster the force falls with speed.

    Raises
    ------
    InvalidInputError : a number that is not positive or not finite.

    >>> muscle = Muscle(0.057, 0.16, 0.18, max_strain_rate=12.0, isometric_stress=130e3, curvature=0.25)
    >>> round(float(muscle.max_flap_rate), 1), round(float(muscle.depressor_torque), 2)
    (66.7, 1.26)
    """

    mass: float
    elevator_share: float
    strain_per_angle: float
    max_strain_rate: float
    isometric_stress: float
    curvature: float

    def __post_init__(self) -> None:
        faults = FaultList()
        together = "give the mass of the depressors of both sides together"
        faults.number("muscle.mass", self.mass, above=0, unit="kg", fix=together)
        faults.number("muscle.elevator_share", self.elevator_share, above=0, at_most=2)
        faults.number("muscle.strain_per_angle", self.strain_per_angle, above=0, unit="1/rad")
        faults.number(
            "muscle.max_strain_rate", self.max_strain_rate, above=0, unit="1/s", fix="give lengths per second"
        )
        faults.number("muscle.isometric_stress", self.isometric_stress, above=0, unit="Pa")
        faults.number("muscle.curvature", self.curvature, above=0, fix="fast muscle has 0.15 to 0.4")
        faults.raise_if_any()

    @property
    def max_flap_rate(self) -> Any:
        """Flap rate at which the muscles exert no torque [rad/s]."""
        return self.max_strain_rate / self.strain_per_angle

    @property
    def depressor_torque(self) -> Any:
        """Isometric torque of the fully active depressors [N m]: stress times volume times strain per angle."""
        return self.isometric_stress * self.mass / MUSCLE_DENSITY * self.strain_per_angle

    @property
    def whole_mass(self) -> Any:
        """Mass of depressors and elevators of both sides [kg]."""
        return self.mass * (1.0 + self.elevator_share)


def force_at(shortening: Series, curvature: Any) -> Series:
    """Return the force of fully active fibres divided by their isometric force.

    Equations: ``(1 - q) / (1 + q/k)`` if the muscle shortens (Hill 1938), ``1.8 - 0.8 (1 + q) / (1 - 7.56 q/k)`` if
    it lengthens (Alexander 1997, J Theor Biol 184:253, doi 10.1006/jtbi.1996.0262). The equations were taken from
    programs that cite these papers, not from the papers.

    Parameters
    ----------
    shortening : q, speed of shortening divided by its largest value, from -1 to 1; negative if the muscle
        lengthens.
    curvature : k.

    >>> [round(float(force_at(jnp.array(q), 0.25)), 3) for q in (-1.0, 0.0, 0.2, 1.0)]
    [1.8, 1.0, 0.444, 0.0]
    """
    shortens, lengthens = jnp.maximum(shortening, 0.0), jnp.minimum(shortening, 0.0)
    fast = (1.0 - shortens) / (1.0 + shortens / curvature)
    slow = _LARGEST - (_LARGEST - 1.0) * (1.0 + lengthens) / (1.0 - _STEEPNESS * lengthens / curvature)
    return jnp.where(shortening > 0.0, fast, slow)


def metabolic_rate(shortening: Series) -> Series:
    """Return the metabolic power of fully active fibres divided by (isometric force times largest speed).

    Equation: ``(0.054 + 0.506 q + 2.46 q^2) / (1 - 1.13 q + 12.8 q^2 - 1.64 q^3)``, q from -1 to 1.

    Source: Minetti and Alexander 1997, J Theor Biol 186:467, doi 10.1006/jtbi.1997.0407, as other papers quote it;
    we did not read the paper itself.

    Parameters
    ----------
    shortening : q, speed of shortening divided by its largest value.

    >>> round(float(metabolic_rate(jnp.array(0.0))), 3), round(float(metabolic_rate(jnp.array(0.2))), 3)
    (0.054, 0.199)
    """
    q = jnp.clip(shortening, -1.0, 1.0)
    return (0.054 + q * (0.506 + 2.46 * q)) / (1.0 + q * (-1.13 + q * (12.8 - 1.64 * q)))


def isometric_share(shortening: Series, curvature: Any) -> Series:
    """Return the isometric force of the fibres that must be active, divided by the force that they exert.

    Up to 0.95 of the largest speed, the result is ``1 / force_at``. At higher speeds it continues as a straight
    line, the tangent at 0.95, so that the solver can return from speeds that no muscle reaches.

    Parameters
    ----------
    shortening, curvature : as for `force_at`.
    """
    inside = jnp.clip(shortening, -1.0, _LAST_SHARE)
    slope = (1.0 + 1.0 / curvature) / (1.0 - _LAST_SHARE) ** 2  # of (1 + q/k) / (1 - q) there
    return 1.0 / force_at(inside, curvature) + slope * jnp.maximum(shortening - _LAST_SHARE, 0.0)


def metabolic_power(muscle: Muscle, torque: Series, flap_rate: Series) -> tuple[Series, Series]:
    """Return the metabolic powers of elevators and depressors [W]; only positive values count.

    Equation: ``T omega_max Phi(q)``, with T the isometric torque of the active fibres and omega_max the flap rate
    at which they exert no torque. The elevators exert upward torques, and the depressors downward ones. At each
    instant, the muscle that does not exert the torque rests, and its value is negative. The power of the rest of
    the body is not included.

    Parameters
    ----------
    muscle : the muscles.
    torque : flap torque that they must exert, both wings, up positive [N m], shape (K,).
    flap_rate : up positive [rad/s], shape (K,).
    """

    def cost(shortening: Series) -> Series:
        per_torque = isometric_share(shortening, muscle.curvature) * metabolic_rate(shortening)
        return muscle.max_flap_rate * per_torque

    shortening = flap_rate / muscle.max_flap_rate
    return torque * cost(shortening), -torque * cost(-shortening)


def activation(muscle: Muscle, torque: Series, flap_rate: Series) -> tuple[Series, Series]:
    """Return the share of active fibres that elevators need, and that of depressors; above 1, a muscle is too weak.

    At each instant one muscle rests; its share is negative.

    Parameters
    ----------
    muscle, torque, flap_rate : as for `metabolic_power`.
    """
    shortening, whole = flap_rate / muscle.max_flap_rate, muscle.depressor_torque
    up = torque * isometric_share(shortening, muscle.curvature) / (whole * muscle.elevator_share)
    down = -torque * isometric_share(-shortening, muscle.curvature) / whole
    return up, down


def best_efficiency(curvature: Any) -> Any:
    """Return a muscle's largest efficiency, mechanical power divided by metabolic power, at any speed.

    Parameters
    ----------
    curvature : k of Hill's relation.

    >>> round(float(best_efficiency(0.25)), 2)
    0.5
    """
    shortening = jnp.linspace(0.05, 0.6, 56)
    return jnp.max(force_at(shortening, curvature) * shortening / metabolic_rate(shortening))
