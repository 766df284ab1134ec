"""An electric motor that flaps the wings through a gear: torque, speed, current, voltage and electrical power."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from wingbeat._base import FaultList
from wingbeat._jax.config import jnp, register_record

if TYPE_CHECKING:
    from wingbeat._jax.shapes import Series


@register_record
@dataclass(frozen=True)
class Motor:
    """A motor that flaps both wings but does not pitch them: with brushes, or brushless with its controller.

    For two motors, one for each wing, give the same torque constant, half of the resistance, twice the rotor
    inertia and twice the no-load current. Torques and currents are then sums of both motors.

    Parameters
    ----------
    torque_constant : torque per current [N m/A]; in SI units, this number is also the voltage per speed.
    resistance : of the winding [ohm].
    gear_ratio : ratio of the motor's speed to the flap rate or, with a crank, to the speed of the crank.
    rotor_inertia : of the rotor, and of all that turns with it [kg m2].
    no_load_current : current that friction takes at any speed [A].
    gear_efficiency : share of the power that the gear transmits, in either direction.
    crank : the number 1 if the motor turns a crank at constant speed, and a linkage makes the wings flap; 0 if the
        motor turns with the wings and reverses twice a beat.

    Raises
    ------
    InvalidInputError : a constant that is not positive, a negative inertia or current, an efficiency outside 0 to
        1, a crank other than 0 or 1, a number that is not finite.

    >>> Motor(torque_constant=2.1e-3, resistance=0.45, gear_ratio=10.0).crank
    0.0
    """

    torque_constant: float
    resistance: float
    gear_ratio: float
    rotor_inertia: float = 0.0
    no_load_current: float = 0.0
    gear_efficiency: float = 1.0
    crank: float = 0.0

    def __post_init__(self) -> None:
        faults = FaultList()
        fix = "give 60 / (2 pi) divided by the speed constant in rpm/V"
        faults.number("motor.torque_constant", self.torque_constant, above=0, unit="N m/A", fix=fix)
        faults.number("motor.resistance", self.resistance, above=0, unit="ohm")
        faults.number("motor.gear_ratio", self.gear_ratio, above=0)
        faults.number("motor.rotor_inertia", self.rotor_inertia, at_least=0, unit="kg m2")
        faults.number("motor.no_load_current", self.no_load_current, at_least=0, unit="A")
        faults.number("motor.gear_efficiency", self.gear_efficiency, above=0, at_most=1)
        if self.crank not in (0, 1):
            faults.add(
                "motor.crank", self.crank, "must be 0 or 1", "give 1 for a crank, 0 for a motor that reverses"
            )
        faults.raise_if_any()


class MotorState(NamedTuple):
    """Speed, torque and electrical quantities of a motor at the K samples of one beat, as arrays of shape (K,).

    Attributes
    ----------
    speed : of the motor [rad/s].
    torque : of the motor on gear and rotor; friction is not included [N m].
    current : [A].
    voltage : at its terminals [V].
    power : electrical power, negative where the motor returns power [W].
    """

    speed: Series
    torque: Series
    current: Series
    voltage: Series
    power: Series


def motor_state(motor: Motor, torque: Series, rate: Series, acceleration: Series, frequency: Any) -> MotorState:
    """Return the state of a motor that exerts a given torque on the flap hinges at a given flap rate.

    Equations: ``omega = N rate``, ``torque = load / N + J omega'``, ``i = torque/kt + sign(omega) i0``, ``v = R i +
    kt omega``, ``P = v i``. The loss of the gear is added to the load while the motor drives the wings, and
    subtracted from the load while the wings drive the motor. With a crank, the speed is ``N 2 pi f``, the load is
    the flap hinges' power divided by the crank's speed, and the rotor's inertia has no effect.

    Parameters
    ----------
    motor : the motor.
    torque, rate, acceleration : at both flap hinges together [N m, rad/s, rad/s2], shape (K,).
    frequency : of the beat [Hz].
    """
    turning = 2.0 * jnp.pi * frequency
    crank = motor.crank
    load = (1.0 - crank) * torque + crank * torque * rate / turning
    driven = (1.0 - crank) * rate + crank * turning
    speed = motor.gear_ratio * driven
    drives = load * driven > 0.0
    passed = jnp.where(drives, load / motor.gear_efficiency, load * motor.gear_efficiency)
    own = (1.0 - crank) * motor.rotor_inertia * motor.gear_ratio * acceleration
    shaft = passed / motor.gear_ratio + own
    current = shaft / motor.torque_constant + jnp.sign(speed) * motor.no_load_current
    voltage = motor.resistance * current + motor.torque_constant * speed
    return MotorState(speed, shaft, current, voltage, voltage * current)
