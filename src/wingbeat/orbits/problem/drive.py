"""Quantities of the muscles or the motor that drive the flap hinges, with the vehicle's springs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from wingbeat._jax.arrays import jnp
from wingbeat.animal.actuators import (
    Driven,
    MotorState,
    activation,
    actuated,
    best_efficiency,
    metabolic_power,
    motor_state,
)
from wingbeat.animal.vehicle import Springs
from wingbeat.orbits.flight.beat import Beat

_NO_SPRINGS = Springs()


def driven(beat: Beat) -> Driven:
    """Return torque, rate and acceleration of the flap actuators, with the vehicle's springs taken into account."""
    springs = beat.drive.springs or _NO_SPRINGS
    return actuated(springs, beat.flap, beat.flap_rate, beat.flap_torque, 1.0 / beat.frequency)


@dataclass(frozen=True)
class DriveQuantity:
    """A function of a beat, computed from what its flap actuators must provide; `of` has both as arguments."""

    of: Callable[[Beat, Driven], Any]

    def __call__(self, beat: Beat) -> Any:
        """Return the value, or a series along the beat."""
        return self.of(beat, driven(beat))


def _pitching(beat: Beat) -> Any:
    """Return the mean positive power of the pitch hinges [W]."""
    return beat.mean_positive(beat.pitch_torque * beat.wing_pitch_rate)


def _metabolic_power(beat: Beat, need: Driven) -> Any:
    # The muscles that pitch the wing are small. We assume that they work at their most efficient speed.
    muscle = beat.drive.muscle
    assert muscle is not None
    flapping = sum(beat.mean_positive(part) for part in metabolic_power(muscle, need.torque, need.rate))
    return flapping + _pitching(beat) / best_efficiency(muscle.curvature)


def _peak_activation(beat: Beat, need: Driven) -> Any:
    assert beat.drive.muscle is not None
    return jnp.stack(activation(beat.drive.muscle, need.torque, need.rate), axis=1)


def _muscle_power_per_mass(beat: Beat, need: Driven) -> Any:
    assert beat.drive.muscle is not None
    return beat.mean_positive(need.torque * need.rate) / beat.drive.muscle.whole_mass


def _muscle_work_per_mass(beat: Beat, need: Driven) -> Any:
    return _muscle_power_per_mass(beat, need) / beat.frequency


def _muscle_efficiency(beat: Beat, need: Driven) -> Any:
    given = beat.mean_positive(need.torque * need.rate) + _pitching(beat)
    return given / _metabolic_power(beat, need)


def _motor_series(beat: Beat, need: Driven) -> MotorState:
    """Return the motor's speed, torque, current, voltage and power along the beat."""
    assert beat.drive.motor is not None
    return motor_state(beat.drive.motor, *need, beat.frequency)


def _electrical_power(beat: Beat, need: Driven) -> Any:
    # The motor only flaps the wings. The power of pitching is added, because pitching would otherwise be free.
    return beat.mean_positive(_motor_series(beat, need).power) + _pitching(beat)


@dataclass(frozen=True)
class _Size:
    """The absolute value of a series of the motor."""

    name: str

    def __call__(self, beat: Beat, need: Driven) -> Any:
        return jnp.abs(getattr(_motor_series(beat, need), self.name))


@dataclass(frozen=True)
class _RootMeanSquare:
    """The root mean square of a series of the motor."""

    name: str

    def __call__(self, beat: Beat, need: Driven) -> Any:
        return jnp.sqrt(beat.mean(getattr(_motor_series(beat, need), self.name) ** 2))


# Functions of a beat by the names of their quantities, each with a difference that matters.
OF_MUSCLE: dict[str, tuple[DriveQuantity, float]] = {
    "metabolic_power": (DriveQuantity(_metabolic_power), 5.0),
    "peak_activation": (DriveQuantity(_peak_activation), 0.1),
    "muscle_power_per_mass": (DriveQuantity(_muscle_power_per_mass), 20.0),
    "muscle_work_per_mass": (DriveQuantity(_muscle_work_per_mass), 5.0),
    "muscle_efficiency": (DriveQuantity(_muscle_efficiency), 0.1),
}
OF_MOTOR: dict[str, tuple[DriveQuantity, float]] = {
    "electrical_power": (DriveQuantity(_electrical_power), 2.0),
    "peak_motor_torque": (DriveQuantity(_Size("torque")), 0.01),
    "rms_motor_torque": (DriveQuantity(_RootMeanSquare("torque")), 0.01),
    "peak_motor_speed": (DriveQuantity(_Size("speed")), 100.0),
    "peak_motor_voltage": (DriveQuantity(_Size("voltage")), 1.0),
    "rms_motor_current": (DriveQuantity(_RootMeanSquare("current")), 0.5),
}


def drive_numbers(beat: Beat) -> dict[str, float]:
    """Return all numbers of the muscles and of the motor that the vehicle has; of a series, the largest value.

    Parameters
    ----------
    beat : with the vehicle's drive.
    """
    parts = ((beat.drive.muscle, OF_MUSCLE), (beat.drive.motor, OF_MOTOR))
    there = [found for part, found in parts if part is not None]
    if not there:
        return {}
    need = driven(beat)  # once: beside it, no number takes long
    return {name: float(jnp.max(found.of(beat, need))) for each in there for name, (found, _) in each.items()}
