"""The motion of a saved orbit at any phase, in the world and in the frame of the mean flight."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._jax.arrays import jnp
from wingbeat.animal.kinematics import Wingbeat
from wingbeat.animal.vehicle import Air, Vehicle
from wingbeat.mechanics.flight_model import State
from wingbeat.mechanics.wing_points import surface_points

if TYPE_CHECKING:
    import xarray as xr

_PLACES = {"x": "u", "z": "w", "body_pitch": "pitch_rate"}
_HINGE = {"hinge_angle": "hinge_rate"}  # of a wing whose pitch gives way
_RATES = {"u": "u_rate", "w": "w_rate", "pitch_rate": "pitch_acceleration"}


@dataclass(frozen=True)
class Motion:
    """The periodic motion of a vehicle and its wings, given as one beat.

    Attributes
    ----------
    vehicle, wingbeat, air : the vehicle, its wingbeat, and the air.
    velocity : mean velocity, forward and up [m/s].
    """

    vehicle: Vehicle
    wingbeat: Wingbeat
    air: Air
    velocity: tuple[float, float]
    _splines: dict[str, Any]

    @classmethod
    def of(cls, dataset: xr.Dataset, vehicle: Vehicle, wingbeat: Wingbeat, air: Air) -> Motion:
        """Return the motion in the time series of an orbit.

        Parameters
        ----------
        dataset : `Orbit.dataset`.
        vehicle, wingbeat, air : those of the orbit.
        """
        from scipy.interpolate import CubicHermiteSpline

        time = dataset["phase"].values / wingbeat.frequency
        # The file has values and slopes; the cubics between the samples match both.
        splines = {
            name: CubicHermiteSpline(time, dataset[name].values, dataset[rate].values)
            for name, rate in (_PLACES | _RATES | _HINGE).items()
            if name in dataset
        }
        x, z = (float(np.diff(splines[name](time[[0, -1]]))[0]) / np.ptp(time) for name in ("x", "z"))
        return cls(vehicle, wingbeat, air, (x, z), splines)

    @property
    def period(self) -> float:
        """Duration of a beat [s]."""
        return 1.0 / self.wingbeat.frequency

    def state(self, phase: np.ndarray) -> State:
        """Return the body's state at phases of one beat, 0 to 1."""
        return State(*(self._splines[name](np.asarray(phase) * self.period) for name in State._fields))

    def acceleration(self, phase: np.ndarray) -> np.ndarray:
        """Return x'', z'' [m/s2] and body pitch acceleration [rad/s2] at phases of one beat, shape (K, 3)."""
        at = np.asarray(phase) * self.period
        return np.stack([self._splines[name](at, 1) for name in _RATES], axis=-1)

    def wing(self, phase: np.ndarray, span_fraction: np.ndarray, chord_fraction: np.ndarray) -> np.ndarray:
        """Return points of the left wing [m], shape (K, C, S, 3), in axes that fly at the mean velocity.

        Parameters
        ----------
        phase : phases of any beat, shape (K,).
        span_fraction, chord_fraction : where the points are, as in `surface_points`.
        """
        within = np.mod(phase, 1.0)
        hinge = [self._splines[name](within * self.period) for name in _HINGE if name in self._splines]
        points = surface_points(
            self.vehicle,
            self.wingbeat,
            self.state(within),
            *map(jnp.asarray, (within, span_fraction, chord_fraction, *hinge)),
        )
        drift = np.array([self.velocity[0], 0.0, self.velocity[1]]) * self.period
        return np.asarray(points) - within[:, None, None, None] * drift
