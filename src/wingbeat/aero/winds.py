"""Moving air as functions of time: a single gust, and turbulence with a published spectrum.

>>> import wingbeat as wb
>>> gust = wb.winds.CosineGust(w=2.0, duration=0.4)  # for wb.simulate and wb.simulate_many
>>> float(gust(0.2)[1])
2.0
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from wingbeat._base import FaultList

# A wind takes times [s], shape (K,). It returns two arrays of this shape: the air's velocity forward and up [m/s].
Wind = Callable[[np.ndarray], tuple[Any, Any]]

_FOOT, _KNOT = 0.3048, 1852.0 / 3600.0
# Mean wind at 20 feet [knots] of each level, and the altitudes [feet] for which the low-altitude model holds.
LEVELS = {"light": 15.0, "moderate": 30.0, "severe": 45.0}
_ALTITUDES = (10.0, 1000.0)
# Waves that are added; each carries the same share of the variance.
_WAVES = 256


@dataclass(frozen=True)
class CosineGust:
    """A gust that rises and falls once.

    At a time t after its start, its velocity is ``(1 - cos(2 pi t / duration)) / 2`` times the largest velocity.

    Parameters
    ----------
    u, w : largest velocity of the air, forward and up [m/s].
    start : time at which the gust begins [s].
    duration : time from its beginning to its end [s].

    Raises
    ------
    InvalidInputError : numbers that are not finite, a duration that is not positive.

    >>> u, w = CosineGust(w=2.0, start=1.0, duration=0.4)(np.array([0.9, 1.2, 1.5]))
    >>> w.tolist()
    [0.0, 2.0, 0.0]
    """

    u: float = 0.0
    w: float = 0.0
    start: float = 0.0
    duration: float = 0.5

    def __post_init__(self) -> None:
        faults = FaultList()
        for name in ("u", "w"):
            faults.number(f"gust.{name}", getattr(self, name), unit="m/s")
        faults.number("gust.start", self.start, unit="s")
        faults.number("gust.duration", self.duration, above=0, unit="s")
        faults.raise_if_any()

    def __call__(self, times: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the velocity of the air at these times [s], forward and up [m/s]."""
        through = np.clip((np.asarray(times) - self.start) / self.duration, 0.0, 1.0)
        rise = 0.5 * (1.0 - np.cos(2 * math.pi * through))
        return self.u * rise, self.w * rise


@dataclass(frozen=True)
class DrydenTurbulence:
    """Turbulence near the ground with Dryden's spectra, frozen while the animal flies through it.

    Each component is a sum of waves of equal variance. Their lengths follow the spectrum, their phases are random.

    Parameters
    ----------
    airspeed : of the flight, which turns lengths into times [m/s].
    level : strength, by the mean wind 20 feet above the ground: ``light`` (15 knots), ``moderate`` (30 knots) or
        ``severe`` (45 knots).
    altitude : above the ground [m].
    seed : of the random phases.

    Raises
    ------
    InvalidInputError : an airspeed that is not positive, an unknown level, an altitude outside the model's 3.05 to
        304.8 m, a seed that is not a whole number.

    The spectra over the wave number W [rad/m] are ``s_u^2 (2 L_u / pi) / (1 + (L_u W)^2)`` and
    ``s_w^2 (L_w / pi) (1 + 3 (L_w W)^2) / (1 + (L_w W)^2)^2``, with scales and intensities of the low-altitude
    model of MIL-F-8785C (1980), section 3.7.3.

    >>> air = DrydenTurbulence(airspeed=12.0, level="moderate", altitude=30.0, seed=1)
    >>> round(air.intensities[1], 2), round(air.scales[1], 1)
    (1.54, 30.0)
    """

    airspeed: float
    level: str = "light"
    altitude: float = 30.0
    seed: int = 0

    def __post_init__(self) -> None:
        faults = FaultList()
        faults.number("turbulence.airspeed", self.airspeed, above=0, unit="m/s")
        faults.choice("turbulence.level", self.level, tuple(LEVELS))
        low, high = (feet * _FOOT for feet in _ALTITUDES)
        faults.number("turbulence.altitude", self.altitude, at_least=low, at_most=high, unit="m")
        faults.whole("turbulence.seed", self.seed, 0, 2**31)
        faults.raise_if_any()

    @property
    def scales(self) -> tuple[float, float]:
        """Length scales of the forward and the upward component [m]."""
        feet = self.altitude / _FOOT
        return feet / (0.177 + 0.000823 * feet) ** 1.2 * _FOOT, self.altitude

    @property
    def intensities(self) -> tuple[float, float]:
        """Root mean squares of the forward and the upward component [m/s]."""
        upward = 0.1 * LEVELS[self.level] * _KNOT
        return upward / (0.177 + 0.000823 * self.altitude / _FOOT) ** 0.4, upward

    def __call__(self, times: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return the velocity of the air at these times [s], forward and up [m/s]."""
        series = [
            intensity * math.sqrt(2.0 / _WAVES) * _sum_of_waves(np.asarray(times, dtype=float), rates, phases)
            for intensity, rates, phases in zip(self.intensities, *self._waves, strict=True)
        ]
        return series[0], series[1]

    @functools.cached_property
    def _waves(self) -> tuple[np.ndarray, np.ndarray]:
        """Angular frequencies [rad/s] and phases [rad] of the waves of both components, shape (2, waves) each."""
        below = (np.arange(_WAVES) + 0.5) / _WAVES
        numbers = np.stack([np.tan(0.5 * math.pi * below), _upward_numbers(below)])
        rates = numbers * self.airspeed / np.array(self.scales)[:, None]
        return rates, 2 * math.pi * np.random.default_rng(self.seed).random((2, _WAVES))


def _sum_of_waves(times: np.ndarray, rates: np.ndarray, phases: np.ndarray) -> np.ndarray:
    """Return the sum of cosines ``cos(rate t + phase)`` at times of any shape."""
    # Equal steps of time are cut into rows of equal length. A product of two matrices of complex waves, one of the
    # rows' first times and one of the steps within a row, then takes a few of the cosines of all waves and times.
    if times.ndim == 1 and len(times) > _WAVES:
        even = np.linspace(times[0], times[-1], len(times))
        if np.abs(times - even).max() <= 8.0 * np.spacing(np.abs(times).max()):
            length = math.isqrt(len(times) - 1) + 1
            begins = np.exp(1j * (np.multiply.outer(times[::length], rates) + phases))
            within = np.exp(1j * np.multiply.outer(rates, times[:length] - times[0]))
            return np.real(begins @ within).ravel()[: len(times)]
    return np.cos(np.multiply.outer(times, rates) + phases).sum(-1)


def _upward_numbers(shares: np.ndarray) -> np.ndarray:
    """Return the wave numbers [1/L_w] below which the upward component has these shares of its variance."""
    low, high = np.full(shares.shape, -20.0), np.full(shares.shape, 20.0)
    for _ in range(60):  # bisection of the logarithm
        middle = 0.5 * (low + high)
        number = np.exp(middle)
        under = (2.0 * np.arctan(number) - number / (1.0 + number**2)) / math.pi < shares
        low, high = np.where(under, middle, low), np.where(under, high, middle)
    return np.exp(0.5 * (low + high))
