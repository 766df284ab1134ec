"""The state of a flight from an IMU: a discrete Kalman filter from the maps of the feedback."""

from __future__ import annotations

from dataclasses import dataclass, fields
from typing import NamedTuple

import numpy as np

from wingbeat._base import FaultList
from wingbeat.stability.riccati import multipliers_over, periodic_kalman

_BIASES = 3  # of the gyro and of the two accelerometers
_WALK = 1.0  # a bias wanders by its standard deviation in this time [s], so that the filter goes on learning it


@dataclass(frozen=True)
class Imu:
    """A gyro and two accelerometers in the body, and perhaps a height sensor; read at each sample.

    An accelerometer gives the mean over the sample. Biases are drawn for each flight; the filter estimates them.

    Parameters
    ----------
    gyro, accelerometer : standard deviation of a reading [rad/s, m/s2].
    gyro_bias, accelerometer_bias : standard deviation of the bias [rad/s, m/s2].
    height : standard deviation of a reading of the height [m]; None if there is no such sensor: height is not held.
    gust : standard deviation of the gusts that the filter expects, anew in each sample [m/s].

    Raises
    ------
    InvalidInputError : a number that is not positive, or a bias below 0.

    Theory: equation ``imu-reading``.

    >>> import wingbeat as wb
    >>> wb.Imu(gyro=0.002, accelerometer=0.05, height=0.1).gust
    1.0
    """

    gyro: float
    accelerometer: float
    gyro_bias: float = 0.0
    accelerometer_bias: float = 0.0
    height: float | None = None
    gust: float = 1.0

    def __post_init__(self) -> None:
        faults = FaultList()
        for field in fields(self):
            value = getattr(self, field.name)
            if field.name.endswith("bias"):
                faults.number(f"imu.{field.name}", value, at_least=0.0)
            elif field.name != "height" or value is not None:
                faults.number(f"imu.{field.name}", value, above=0.0, fix="give a standard deviation")
        faults.raise_if_any()

    @property
    def noise(self) -> np.ndarray:
        """Standard deviations of pitch rate, acceleration forward and up, and of the height if it is measured."""
        known = [self.gyro, self.accelerometer, self.accelerometer]
        return np.array(known if self.height is None else [*known, self.height])

    @property
    def bias(self) -> np.ndarray:
        """Standard deviations of the biases, in the order of `noise`."""
        known = [self.gyro_bias, self.accelerometer_bias, self.accelerometer_bias]
        return np.array(known if self.height is None else [*known, 0.0])

    def errors(self, random: np.random.Generator, beats: int, samples: int, flights: int) -> np.ndarray:
        """Return errors of all readings, with biases, shape (beats, samples, readings, flights).

        Parameters
        ----------
        random : draws them.
        beats, samples, flights : number of beats, of samples in each, and of flights.
        """
        shape = len(self.noise), flights
        fixed = self.bias[:, None] * random.standard_normal(shape)
        return fixed + self.noise[:, None] * random.standard_normal((beats, samples, *shape))


def check_noise_of(faults: FaultList, imu: Imu | None, noise: object) -> None:
    """Note noise of the state beside that of an IMU."""
    if imu is not None and noise:
        faults.add("noise", noise, "is not that of an IMU", "leave it out: the feedback has its own")


class Estimator(NamedTuple):
    """A Kalman filter of N samples; its state is that of the feedback, what accelerometers feel, and biases."""

    gains: np.ndarray  # shape (N, states, readings)
    output: np.ndarray  # readings by the state, shape (N, readings, states)
    by_state: np.ndarray  # to the next sample, shape (N, states, states)
    by_command: np.ndarray  # shape (N, states, laws)
    felt: np.ndarray  # by accelerometers on the orbit, in the sample before, shape (N, 2) [m/s2]

    @property
    def spectral_radius(self) -> float:
        """Largest modulus of a multiplier of the error of the estimate in a beat."""
        eye = np.eye(self.by_state.shape[1])
        steps = zip(self.by_state, self.gains, self.output, strict=True)
        return float(np.abs(multipliers_over([A @ (eye - L @ H) for A, L, H in steps])[0]))


def estimator_of(imu: Imu, A: np.ndarray, B: np.ndarray, felt: np.ndarray, period: float) -> Estimator:
    """Return the filter for the maps of `sample_maps`; a gust acts as a velocity against the air, and as no motion.

    Theory: equations ``imu-reading`` and ``gust-noise``.
    """
    N, order = A.shape[:2]
    whole, step = order + 2 + _BIASES, period / N
    by_state, by_command = np.zeros((N, whole, whole)), np.zeros((N, whole, B.shape[2]))
    by_state[:, :order, :order], by_command[:, :order] = A, B
    by_state[:, order : order + 2, :order] = felt[:, :, :order]
    by_command[:, order : order + 2] = felt[:, :, order:-1]
    by_state[:, order + 2 :, order + 2 :] = np.diag(imu.bias[:_BIASES] > 0.0)
    output = np.zeros((len(imu.noise), whole))
    output[0, 4] = output[1, order] = output[2, order + 1] = 1.0
    output[:_BIASES, order + 2 :] = np.eye(_BIASES)
    blown = np.zeros((N, whole, 2))
    velocity = np.eye(whole)[:, 2:4]  # u and w
    for j in range(N):
        blown[j] = velocity - by_state[j] @ velocity
        blown[j][0, 1] += step  # the air carries the body along
    if imu.height is None:  # then nothing tells the height
        by_state[:, 0], by_state[:, :, 0], by_command[:, 0], blown[:, 0] = 0.0, 0.0, 0.0, 0.0
    else:
        output[3, 0] = 1.0
    unknown = imu.gust**2 * blown @ np.moveaxis(blown, 1, 2)
    wander = np.zeros(whole)
    wander[order + 2 :] = imu.bias[:_BIASES] ** 2 * step / _WALK
    gains = periodic_kalman(by_state, output, unknown + np.diag(wander), np.diag(imu.noise**2))
    before = np.roll(felt[:, :, -1], 1, axis=0)
    return Estimator(gains, np.broadcast_to(output, (N, *output.shape)).copy(), by_state, by_command, before)
