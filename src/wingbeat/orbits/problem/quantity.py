"""What a quantity is, and the quantities of the stroke map, of muscles, motors, springs and batteries."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import NOMENCLATURE, FaultList, plain
from wingbeat._jax.arrays import jax, jnp
from wingbeat.animal.actuators import (
    Discharge,
    Driven,
    MotorState,
    activation,
    activation_power,
    actuated,
    best_efficiency,
    discharge,
    metabolic_power,
    motor_state,
    spring_torque,
    tendon_recoil,
)
from wingbeat.animal.drive import Springs

if TYPE_CHECKING:
    from wingbeat._jax.arrays import CoefficientsOfMap, Excesses, Moduli, Scalar, StrokeMatrix
    from wingbeat.orbits.flight.beat import Beat


@dataclass(frozen=True)
class Quantity:
    """A number computed from one wingbeat, or a series along it that counts by its largest value.

    Parameters
    ----------
    name : its name in records and messages.
    of : function of a `Beat`, in JAX-compatible Python; returns a number, or an array (K,) or
        (K, m) of K phases.
    unit : of the value.
    scale : a difference that matters. The optimiser divides the value by it, so that its numbers are near one.
    parameter : name of the wingbeat parameter that equals the quantity, if any. As an objective, the quantity then
        needs no flight.
    in_hover : advice, in words, on what to use instead in hover, if the quantity is undefined at speed 0.
    needs : ``"muscle"``, ``"motor"`` or ``"battery"`` if the vehicle must have one.

    Raises
    ------
    InvalidInputError : an empty name, a function that cannot be called, a scale that is not positive.

    >>> lift = Quantity("mean_lift", lambda beat: beat.mean(beat.lift.sum(axis=1)), unit="N")
    >>> lift.name
    'mean_lift'
    """

    name: str
    of: Callable[[Beat], Any]
    unit: str = "1"
    scale: float = 1.0
    parameter: str | None = None
    in_hover: str | None = None
    needs: str | None = None

    def __post_init__(self) -> None:
        faults = FaultList()
        if not isinstance(self.name, str) or not self.name.strip():
            faults.add("quantity.name", self.name, "must be a name", "such as mean_lift")
        if not callable(self.of):
            faults.add("quantity.of", self.of, "is not a function", "give a function of a Beat")
        faults.number("quantity.scale", self.scale, above=0, fix="a difference that matters")
        faults.raise_if_any()


@dataclass(frozen=True)
class SpringCost:
    """The actuators' mean positive power with flap springs that by default exert no torque in mid-stroke."""

    stiffness: float
    rest_angle: float | None = None

    def __call__(self, beat: Beat) -> Any:
        """Return this power for a beat [W]."""
        rest = beat.mean(beat.flap) if self.rest_angle is None else self.rest_angle
        torque = spring_torque(self.stiffness, beat.flap, rest)
        return beat.mean_positive(beat.hinge_power - torque * beat.flap_rate)


# What counts as stable where nobody gives a limit: disturbances are halved in 140 beats at the latest.
STABLE_RADIUS = 0.995
# Disturbances of (body_pitch, u, w, pitch_rate) that count as equally large [rad, m/s, m/s, rad/s].
_EQUAL = (0.1, 1.0, 1.0, 2.0)
# The response to gusts is infinite at a spectral radius of 1. Up to the radius given here, it is exact.
_STEADY = 0.999
# The solver's limit of the spectral radius is lower than the user's by this share. Where two multipliers meet at a
# limit, they exceed it by the square root of the residual that the solver's tolerances allow.
_INSET = 1e-3
# Weight of the first condition of stability: a product of distances from 1, some of which are small.
_WEIGHT = 100.0
# Slope of the response above the radius `_STEADY`: steep, so that a search turns back.
_BEYOND = 1e3


@dataclass(frozen=True)
class MapQuantity(Quantity):
    """A quantity of the stroke map.

    Parameters
    ----------
    name, unit, parameter, in_hover, needs : as of a `Quantity`.
    scale : a difference that matters, so that the optimiser sees numbers near one.
    of : function of the derivative of (body_pitch, u, w, pitch_rate) after a beat by the same four before it, shape
        (4, 4), in JAX-compatible Python; returns a number, or several, of which the largest counts. A hinge that
        gives way adds (hinge_angle, hinge_rate): shape (6, 6).
    excess : a smooth function, for a quantity that is proportional to the stroke map. It takes the stroke map
        divided by an upper limit, and returns numbers that are all at most 0 if the quantity keeps to the limit. In
        a search, it replaces an `of` that has kinks.

    Raises
    ------
    InvalidInputError : as of a `Quantity`.

    >>> trace = MapQuantity("trace", lambda stroke_map: stroke_map.trace())
    >>> trace.name
    'trace'
    """

    of: Callable[[Any], Any]
    excess: Callable[[Any], Any] | None = None


def _moduli(stroke_map: StrokeMatrix) -> Moduli:
    """Return the moduli of all multipliers."""
    return jnp.sort(jnp.abs(jnp.linalg.eigvals(stroke_map)))


def _characteristic(stroke_map: StrokeMatrix) -> CoefficientsOfMap:
    """Return the coefficients of the characteristic polynomial without the first, by Faddeev and LeVerrier."""
    found, power = [], jnp.eye(len(stroke_map))
    for order in range(1, len(stroke_map) + 1):
        product = stroke_map @ power
        found.append(-jnp.trace(product) / order)
        power = product + found[-1] * jnp.eye(len(stroke_map))
    return jnp.stack(found)


def _beyond_circle(over_limit: StrokeMatrix) -> Excesses:
    """Return numbers at most 0 only if no multiplier exceeds 1. Theory: equation ``stability-conditions``.

    The map ``z = (1 + s) / (1 - s)`` takes the left half-plane of s to the unit disc of multipliers z. All n roots
    of ``c0 s^n + c1 s^(n-1) + ... + cn`` lie in the left half-plane if c0, c1, c2, c4, ..., cn and the Hurwitz
    determinants of odd order are positive (Lienard and Chipart). Unlike each multiplier, these are smooth where two
    multipliers meet. With a row for c(n-1), which is then positive too, they would be dependent where two meet
    at 1.
    """
    size, found = len(over_limit), [*_characteristic(over_limit / (1.0 - _INSET))]
    plus, minus = np.polynomial.Polynomial([1.0, 1.0]), np.polynomial.Polynomial([1.0, -1.0])
    shares = np.stack([(plus ** (size - k) * minus**k).coef for k in range(size + 1)], axis=1)
    c = [_combined(row, found) for row in shares[::-1]]
    third = c[3] * c[2] * c[1] - c[0] * c[3] ** 2 - c[4] * c[1] ** 2
    rows = [*c[:1:-2], c[1], c[0], third]
    if size > 4:
        rows[-1] = third + c[0] * c[1] * c[5]
        places = 1 + 2 * np.arange(5) - np.arange(5)[:, None]
        hurwitz = [[c[k] if 0 <= k <= size else 0.0 for k in row] for row in places]
        # Both determinants of highest order are products over pairs of multipliers; this gives them one scale.
        rows.append(jnp.linalg.det(jnp.asarray(hurwitz)) / 2**9)
    return -jnp.stack(rows) * jnp.asarray([_WEIGHT] + [1.0] * (len(rows) - 1))


def _combined(shares: Sequence[float], parts: Sequence[Scalar]) -> Scalar:
    """Return the first share plus the products of the others with the parts."""
    total: Any = float(shares[0])
    for share, part in zip(shares[1:], parts, strict=True):
        if share:
            product = part if abs(share) == 1.0 else abs(float(share)) * part
            total = total + product if share > 0.0 else total - product
    return total


def _gust_response(stroke_map: StrokeMatrix) -> Scalar:
    """Return the root mean square of the body's disturbance in gusts of 1 m/s. Theory: equation ``gust-response``.

    Gusts change at random every beat. The covariance P of the disturbances solves ``P = A P A' + G G'`` with
    ``G = (I - A)[:, (u, w)]`` for the stroke map A.
    """
    radius = _moduli(stroke_map)[-1]
    steady = stroke_map * jnp.minimum(1.0, _STEADY / jax.lax.stop_gradient(radius))
    size = len(stroke_map)
    gust = (jnp.eye(size) - stroke_map)[:, 1:3]
    later = jnp.eye(size**2) - jnp.kron(steady, steady)
    covariance = jnp.linalg.solve(later, (gust @ gust.T).ravel()).reshape(size, size)
    response = jnp.sqrt(jnp.diagonal(covariance)[: len(_EQUAL)] @ jnp.asarray(_EQUAL) ** -2)
    return response + _BEYOND * jnp.maximum(radius - _STEADY, 0.0)


MAP_QUANTITIES = {
    name: MapQuantity(name, of, plain(NOMENCLATURE[name].unit), scale, excess=excess)
    for name, of, scale, excess in (
        ("spectral_radius", _moduli, 0.1, _beyond_circle),
        ("gust_response", _gust_response, 1.0, None),
    )
}


def driven(beat: Beat) -> Driven:
    """Return torque, rate and acceleration of the flap actuators, with the vehicle's springs taken into account."""
    springs = beat.drive.springs or Springs()
    return actuated(springs, beat.flap, beat.flap_rate, beat.flap_torque, 1.0 / beat.frequency)


@dataclass(frozen=True)
class DriveQuantity:
    """A function of a beat, computed from what its flap actuators must provide; `of` has both as arguments."""

    of: Callable[[Beat, Driven], Any]

    def __call__(self, beat: Beat) -> Any:
        """Return the value, or a series along the beat."""
        return self.of(beat, driven(beat))


def _pitch_power(beat: Beat) -> Any:
    """Return the power of the pitch hinges that somebody pays for [W]."""
    return beat.pitch_torque * beat.wing_pitch_rate


def _pitching(beat: Beat) -> Any:
    """Return the mean positive power of the pitch hinges [W]."""
    return beat.mean_positive(_pitch_power(beat))


def _metabolic_power(beat: Beat, need: Driven) -> Any:
    # The muscles that pitch the wing are small. We assume that they work at their most efficient speed.
    muscle = beat.drive.muscle
    assert muscle is not None
    parts = metabolic_power(muscle, need.torque, need.rate, _recoil(beat, need))
    flapping = sum(beat.mean_positive(part) for part in parts)
    return flapping + _pitching(beat) / best_efficiency(muscle.curvature)


def _recoil(beat: Beat, need: Driven) -> Any:
    """Return the rate that the elevators' tendon adds to theirs [rad/s]."""
    assert beat.drive.muscle is not None
    return tendon_recoil(beat.drive.muscle, need.torque, 1.0 / beat.frequency)


def _peak_activation(beat: Beat, need: Driven) -> Any:
    assert beat.drive.muscle is not None
    return jnp.stack(activation(beat.drive.muscle, need.torque, need.rate, _recoil(beat, need)), axis=1)


def _activation_power(beat: Beat, need: Driven) -> Any:
    assert beat.drive.muscle is not None
    active = _peak_activation(beat, need)
    return activation_power(beat.drive.muscle, active[:, 0], active[:, 1], beat.frequency)


def _whole_muscle(beat: Beat, need: Driven) -> Any:
    """Return the metabolic power of the flight muscle with activation and recovery [W]."""
    assert beat.drive.muscle is not None
    return beat.drive.muscle.recovery_factor * (_metabolic_power(beat, need) + _activation_power(beat, need))


def _metabolic_rate(beat: Beat, need: Driven) -> Any:
    muscle = beat.drive.muscle
    assert muscle is not None
    return muscle.support_factor * (_whole_muscle(beat, need) + muscle.resting_rate)


def _mechanical(beat: Beat, need: Driven) -> Any:
    """Return the mean positive power of the muscles that flap the wings [W]."""
    own = need.torque * need.rate + jnp.maximum(need.torque, 0.0) * _recoil(beat, need)
    return beat.mean_positive(own)


def _muscle_power_per_mass(beat: Beat, need: Driven) -> Any:
    # Of the depressors alone, as measurements are of the pectoralis and of its mass.
    assert beat.drive.muscle is not None
    return beat.mean_positive(jnp.minimum(need.torque, 0.0) * need.rate) / beat.drive.muscle.mass


def _muscle_work_per_mass(beat: Beat, need: Driven) -> Any:
    return _muscle_power_per_mass(beat, need) / beat.frequency


def _muscle_efficiency(beat: Beat, need: Driven) -> Any:
    return (_mechanical(beat, need) + _pitching(beat)) / _metabolic_power(beat, need)


def _net_muscle_efficiency(beat: Beat, need: Driven) -> Any:
    return (_mechanical(beat, need) + _pitching(beat)) / _whole_muscle(beat, need)


def _flight_efficiency(beat: Beat, need: Driven) -> Any:
    return (_mechanical(beat, need) + _pitching(beat)) / _metabolic_rate(beat, need)


def _motor_series(beat: Beat, need: Driven) -> MotorState:
    """Return the motor's speed, torque, current, voltage and power along the beat."""
    assert beat.drive.motor is not None
    return motor_state(beat.drive.motor, *need, beat.frequency)


def _electrical_power(beat: Beat, need: Driven) -> Any:
    # The motor only flaps the wings. The power of pitching is added, because pitching would otherwise be free.
    return beat.mean_positive(_motor_series(beat, need).power) + _pitching(beat)


def discharged(beat: Beat, need: Driven) -> Discharge:
    """Return what the battery does if this beat is flown until the battery no longer allows it."""
    assert beat.drive.battery is not None
    motor = _motor_series(beat, need)
    power = jnp.maximum(motor.power, 0.0) + jnp.maximum(_pitch_power(beat), 0.0)  # as in the electrical power
    return discharge(beat.drive.battery, power, motor.voltage)


@dataclass(frozen=True)
class _OfDischarge:
    """A number of the battery's discharge."""

    name: str

    def __call__(self, beat: Beat, need: Driven) -> Any:
        return getattr(discharged(beat, need), self.name)


def _flight_range(beat: Beat, need: Driven) -> Any:
    return discharged(beat, need).endurance * beat.speed


@dataclass(frozen=True)
class _OfMotor:
    """The absolute value of a series of the motor, or its root mean square."""

    name: str
    mean: bool = False

    def __call__(self, beat: Beat, need: Driven) -> Any:
        series = getattr(_motor_series(beat, need), self.name)
        return jnp.sqrt(beat.mean(series**2)) if self.mean else jnp.abs(series)


# Functions of a beat by the names of their quantities, each with a difference that matters.
OF_MUSCLE: dict[str, tuple[DriveQuantity, float]] = {
    "metabolic_power": (DriveQuantity(_metabolic_power), 5.0),
    "peak_activation": (DriveQuantity(_peak_activation), 0.1),
    "muscle_power_per_mass": (DriveQuantity(_muscle_power_per_mass), 20.0),
    "muscle_work_per_mass": (DriveQuantity(_muscle_work_per_mass), 5.0),
    "muscle_efficiency": (DriveQuantity(_muscle_efficiency), 0.1),
    "activation_power": (DriveQuantity(_activation_power), 1.0),
    "metabolic_rate": (DriveQuantity(_metabolic_rate), 10.0),
    "net_muscle_efficiency": (DriveQuantity(_net_muscle_efficiency), 0.1),
    "flight_efficiency": (DriveQuantity(_flight_efficiency), 0.1),
}
OF_MOTOR: dict[str, tuple[DriveQuantity, float]] = {
    "electrical_power": (DriveQuantity(_electrical_power), 2.0),
    "peak_motor_torque": (DriveQuantity(_OfMotor("torque")), 0.01),
    "rms_motor_torque": (DriveQuantity(_OfMotor("torque", mean=True)), 0.01),
    "peak_motor_speed": (DriveQuantity(_OfMotor("speed")), 100.0),
    "peak_motor_voltage": (DriveQuantity(_OfMotor("voltage")), 1.0),
    "peak_motor_current": (DriveQuantity(_OfMotor("current")), 0.5),
    "rms_motor_current": (DriveQuantity(_OfMotor("current", mean=True)), 0.5),
}
OF_BATTERY: dict[str, tuple[DriveQuantity, float]] = {
    "peak_battery_current": (DriveQuantity(_OfDischarge("peak_current")), 0.5),
    "least_battery_voltage": (DriveQuantity(_OfDischarge("least_voltage")), 1.0),
    "charge_left": (DriveQuantity(_OfDischarge("charge_left")), 0.1),
    "endurance": (DriveQuantity(_OfDischarge("endurance")), 100.0),
    "flight_range": (DriveQuantity(_flight_range), 1000.0),
}
LASTING = ("endurance", "flight_range")  # to minimise them would be a slip
OF_DRIVE = {"muscle": OF_MUSCLE, "motor": OF_MOTOR, "battery": OF_BATTERY}  # by the part that they need


def drive_numbers(beat: Beat) -> dict[str, float]:
    """Return all numbers of the vehicle's muscles, motor and battery; of a series, the largest value."""
    parts = beat.drive if beat.drive.motor is not None else beat.drive._replace(battery=None)
    there = [found for part, found in OF_DRIVE.items() if getattr(parts, part) is not None]
    if not there:
        return {}
    need = driven(beat)  # once: beside it, no number takes long
    return {name: float(jnp.max(found.of(beat, need))) for each in there for name, (found, _) in each.items()}
