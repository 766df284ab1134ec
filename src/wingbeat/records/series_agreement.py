"""Whether the series of a flight agree: with one another, with the wingbeat, and with Newton's laws."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import STATE_NAMES
from wingbeat._jax.arrays import own_settings
from wingbeat.animal.kinematics import Wingbeat, flap_angle, fold_angle, pitch_angle, span_ratio, sweep_angle

if TYPE_CHECKING:
    from wingbeat.animal.species.species import Species

# Record and series come of two compiled programs, which may differ in a number's last digits.
_RELATIVE, ABSOLUTE = 1e-6, 1e-9
# Pointwise identities of the series, relative to the largest value: rounding alone, at most 3e-16 in nine orbits.
_ROUNDING = 1e-9
# The integral of a rate agrees with its series to this share of the series' range. Measured: 1e-5 or better in nine
# orbits. A table of coefficients has kinks, which 256 samples resolve less well.
_INTEGRAL = 2e-3
# The laws of the wings, which give these series at every phase. Measured: to 1e-15 in 22 files.
_LAWS: dict[str, Callable[..., Any]] = {
    **{"flap": flap_angle, "wing_pitch": pitch_angle, "span_ratio": span_ratio},
    **{"fold": fold_angle, "sweep": sweep_angle},
}
# Faster flights (SI) are running off, and their powers may overflow.
_RUNS_OFF = 1e6
# Series and their rates: each series is the integral of its rate over time.
_RATES = {
    **{"x": "u", "z": "w", "body_pitch": "pitch_rate", "u": "u_rate", "w": "w_rate"},
    **{"pitch_rate": "pitch_acceleration", "flap": "flap_rate", "wing_pitch": "wing_pitch_rate"},
}
_PARTS_OF_HINGE = ("aerodynamic_power", "inertial_power", "body_power")
_PARTS_OF_AIR = ("profile_power", "induced_power", "parasite_power", "unsteady_power")


def check_series(series: dict[str, np.ndarray], weight: float) -> None:
    """Check the identities that hold at every sample of a flight."""
    phase, time = series["phase"], series["time"]
    demand(phase.ndim == 1 and phase.size > 0 and phase[0] == 0, "phase does not begin at 0")
    demand(bool((np.diff(phase) > 0).all() and (np.diff(time) > 0).all()), "phase or time does not increase")
    torque = series["flap_torque"] * series["flap_rate"] + series["pitch_torque"] * series["wing_pitch_rate"]
    sums = {
        "hinge_power": (torque, sum(series[name] for name in _PARTS_OF_HINGE)),
        "air_power": (-sum(series[name] for name in _PARTS_OF_AIR),),
        "potential_energy": (weight * series["centre_of_mass_z"],),
    }
    for name, others in sums.items():
        for other in others:
            parts = np.abs(other) + np.abs(series[name])
            wrong = np.abs(series[name] - other) > _ROUNDING * np.nanmax(parts, initial=0.0)
            demand(not wrong.any(), f"{name} is not the sum of its parts")


def check_finite(series: dict[str, np.ndarray]) -> None:
    """Check that all series of a flight are finite at all samples before it runs off."""
    calm = np.logical_and.reduce([np.abs(series[name]) < _RUNS_OFF for name in STATE_NAMES])
    for name, values in series.items():
        own = values[calm] if len(values) == len(calm) else values
        demand(own.dtype.kind != "f" or bool(np.isfinite(own).all()), f"{name} holds what is no number")


def check_wings(wingbeat: Wingbeat, series: dict[str, np.ndarray]) -> None:
    """Check that times and positions of the wings are those of the wingbeat."""
    same("time", series["time"], series["phase"] / wingbeat.frequency)
    for name, law in _LAWS.items():
        with own_settings():
            found = law(wingbeat, series["phase"])
        good = np.allclose(series[name], 0.0 if found is None else found, 0.0, ABSOLUTE)
        demand(good, f"{name} is not that of the wingbeat")


def check_newton(series: dict[str, np.ndarray], species: Species) -> None:
    """Check that each series is the integral of its rate, momentum that of force, and energy that of power."""
    mass, gravity = species.vehicle.mass, species.air.gravity
    pairs = {name: (series[name], series[rate]) for name, rate in _RATES.items()}
    pairs |= {
        "momentum_x": (series["momentum_x"], series["force_x"]),
        "momentum_z": (series["momentum_z"], series["force_z"] - mass * gravity),
        "centre_of_mass_x": (series["centre_of_mass_x"], series["momentum_x"] / mass),
        "centre_of_mass_z": (series["centre_of_mass_z"], series["momentum_z"] / mass),
        "energy": (
            series["kinetic_energy"] + series["potential_energy"],
            series["actuator_power"] + series["air_power"],
        ),
    }
    for name, (values, rate) in pairs.items():
        change = values - values[0]
        away = np.abs(change - _integral(rate, float(series["time"][-1]))).max()
        size = np.ptp(change) + 1e-2 * np.abs(rate).max() * series["time"][-1] + np.finfo(float).tiny
        demand(away <= _INTEGRAL * size, f"{name} is not the integral of its rate")


def _integral(rate: np.ndarray, period: float) -> np.ndarray:
    """Return the integral over time of a periodic series with both ends, exact for its resolved harmonics."""
    count = rate.size - 1
    found = np.fft.rfft(rate[:-1]) / np.maximum(np.arange(count // 2 + 1), 1) / 2j / np.pi
    mean, found[0] = float(rate[:-1].mean()), 0.0
    waves = np.fft.irfft(found, count)
    return period * (np.append(waves, waves[0]) - waves[0] + mean * np.linspace(0.0, 1.0, count + 1))


def same(name: str, own: Any, found: Any) -> None:
    """Demand that a number or a list of numbers is the one found; None stands for a number that is unknown."""
    if own is None or found is None:
        demand(own is found, f"{name} does not agree with the series")
        return
    good = np.shape(own) == np.shape(found) and np.allclose(own, found, _RELATIVE, ABSOLUTE)
    demand(bool(good), f"{name} does not agree with the series")


def demand(good: bool, otherwise: str) -> None:
    """Raise `ValueError` with the words of the contradiction unless all is good."""
    if not good:
        raise ValueError(otherwise)
