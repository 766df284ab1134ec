"""Quantities of the muscles or the motor that drive the flap hinges, with the vehicle's springs."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from wingbeat._jax.config import jnp
from wingbeat.actuators import Springs
from wingbeat.actuators.motor import MotorState, motor_state
from wingbeat.actuators.muscle import activation, best_efficiency, metabolic_power
from wingbeat.actuators.springs import Driven, actuated
from wingbeat.orbits.flight.beat import Beat

_NO_SPRINGS = Springs()


def driven(beat: Beat) -> Driven:
    """Return torque, rate and acceleration of the flap actuators, with the vehicle's springs taken into account."""
    springs = beat.drive.springs or _NO_SPRINGS
    return actuated(springs, beat.flap, beat.flap_rate, beat.flap_torque, 1.0 / beat.frequency)


def _pitching(beat: Beat) -> Any:
    """Return the mean positive power of the pitch hinges [W]."""
    return beat.mean_positive(beat.pitch_torque * beat.wing_pitch_rate)


def _metabolic_power(beat: Beat) -> Any:
    # The muscles that pitch the wing are small. We assume that they work at their most efficient speed.
    muscle, need = beat.drive.muscle, driven(beat)
    assert muscle is not None
    flapping = sum(beat.mean_positive(part) for part in metabolic_power(muscle, need.torque, need.rate))
    return flapping + _pitching(beat) / best_efficiency(muscle.curvature)


def _peak_activation(beat: Beat) -> Any:
    muscle, need = beat.drive.muscle, driven(beat)
    assert muscle is not None
    return jnp.stack(activation(muscle, need.torque, need.rate), axis=1)


def _muscle_power_per_mass(beat: Beat) -> Any:
    muscle, need = beat.drive.muscle, driven(beat)
    assert muscle is not None
    return beat.mean_positive(need.torque * need.rate) / muscle.whole_mass


def _muscle_work_per_mass(beat: Beat) -> Any:
    return _muscle_power_per_mass(beat) / beat.frequency


def _muscle_efficiency(beat: Beat) -> Any:
    need = driven(beat)
    return (beat.mean_positive(need.torque * need.rate) + _pitching(beat)) / _metabolic_power(beat)


def motor_series(beat: Beat) -> MotorState:
    """Return the motor's speed, torque, current, voltage and power along the beat."""
    assert beat.drive.motor is not None
    return motor_state(beat.drive.motor, *driven(beat), beat.frequency)


def _electrical_power(beat: Beat) -> Any:
    # The motor only flaps the wings. The power of pitching is added, because pitching would otherwise be free.
    return beat.mean_positive(motor_series(beat).power) + _pitching(beat)


def _size_of(name: str) -> Callable[[Beat], Any]:
    return lambda beat: jnp.abs(getattr(motor_series(beat), name))


def _root_mean_square_of(name: str) -> Callable[[Beat], Any]:
    return lambda beat: jnp.sqrt(beat.mean(getattr(motor_series(beat), name) ** 2))


# Functions of a beat by the names of their quantities, each with a difference that matters.
OF_MUSCLE: dict[str, tuple[Callable[[Beat], Any], float]] = {
    "metabolic_power": (_metabolic_power, 5.0),
    "peak_activation": (_peak_activation, 0.1),
    "muscle_power_per_mass": (_muscle_power_per_mass, 20.0),
    "muscle_work_per_mass": (_muscle_work_per_mass, 5.0),
    "muscle_efficiency": (_muscle_efficiency, 0.1),
}
OF_MOTOR: dict[str, tuple[Callable[[Beat], Any], float]] = {
    "electrical_power": (_electrical_power, 2.0),
    "peak_motor_torque": (_size_of("torque"), 0.01),
    "rms_motor_torque": (_root_mean_square_of("torque"), 0.01),
    "peak_motor_speed": (_size_of("speed"), 100.0),
    "peak_motor_voltage": (_size_of("voltage"), 1.0),
    "rms_motor_current": (_root_mean_square_of("current"), 0.5),
}
