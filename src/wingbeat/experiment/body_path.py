"""The motion of a filmed body: uniform travel plus a periodic smoothing spline."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from wingbeat._base import HIGHEST_ORDER, FaultList
from wingbeat.experiment.film_fit import FilmedBeat
from wingbeat.experiment.periodic_spline import Array, fit_law, fit_travel, fourier_columns, from_phase

# A film must show this share of a beat in one piece: in a shorter piece, travel and periodic motion look alike.
_SHORTEST = 0.9


@dataclass(frozen=True)
class BodyPath:
    """Uniform travel of the body plus a periodic motion; made by `fit_body_path`.

    Parameters
    ----------
    frequency : wingbeats per second [Hz].
    velocity : of the travel, forward and up [m/s].
    series : x, z [m] and body pitch [rad] over the phase of the wingbeat, as mean, cosine and sine of order 1, of
        order 2 and so on up to 8, shape (3, 17); the place at phase 0 is the origin.
    """

    frequency: float
    velocity: tuple[float, float]
    series: Array

    def states(self, phase: Any) -> Array:
        """Return (x, z, body_pitch, u, w, pitch_rate), shape (K, 6) [m, m, rad, m/s, m/s, rad/s].

        Parameters
        ----------
        phase : of the wingbeat, shape (K,).
        """
        phase = np.asarray(phase, dtype=float)
        place, rate = (self._series(phase, order) for order in (0, 1))
        place[:, :2] -= self._series(np.zeros(1), 0)[:, :2]
        travel = np.array([*self.velocity, 0.0])
        return np.hstack([place + travel * phase[:, None] / self.frequency, rate + travel])

    def accelerations(self, phase: Any) -> Array:
        """Return (x'', z'', psi''), shape (K, 3) [m/s2, m/s2, rad/s2].

        Parameters
        ----------
        phase : of the wingbeat, shape (K,).
        """
        return self._series(np.asarray(phase, dtype=float), 2)

    def _series(self, phase: Array, derivative: int) -> Array:
        """Return the series or one of their time derivatives, shape (K, 3)."""
        turning = 2 * math.pi * self.frequency * np.arange(1, HIGHEST_ORDER + 1)
        waves = self.series[:, 1::2] + 1j * self.series[:, 2::2]
        # Cosine and sine are the real part of (a + i b) exp(-i w t).
        waves = waves * (-1j * turning) ** derivative
        pairs = np.stack([waves.real, waves.imag], axis=-1).reshape(3, -1)
        mean = self.series[:, :1] * (derivative == 0)
        return fourier_columns(phase) @ np.hstack([mean, pairs]).T


def fit_body_path(
    beat: FilmedBeat, u: float | None = None, w: float | None = None, body_pitch: float | None = None
) -> BodyPath:
    """Fit the motion of a filmed body.

    Each coordinate, x and z, is uniform travel plus a periodic smoothing spline like those of the wings' laws. Body
    pitch is such a spline alone. A velocity or pitch that was not filmed is constant, and given by the caller.

    Parameters
    ----------
    beat : the fitted wingbeat of a film with any of ``body_x_m``, ``body_z_m`` and ``body_pitch_deg``.
    u, w : velocity forward and up, if x or z was not filmed [m/s]; w is 0 if not given.
    body_pitch : constant pitch, if it was not filmed [rad]; 0 if not given.

    Raises
    ------
    InvalidInputError : a film of less than nine tenths of a beat, a quantity that is both given and filmed, or no
        velocity.
    """
    film, faults = beat.film, FaultList()
    given = {"body_x_m": u, "body_z_m": w, "body_pitch_deg": body_pitch}
    for name, number in given.items():
        if name in film.columns and number is not None:
            faults.add(f"{film.name}, column {name}", number, "is filmed and given too", "give one of the two")
    if "body_x_m" not in film.columns and u is None:
        faults.add(f"{film.name}, body_x_m", "", "is missing", "add the column, or give the mean velocity u [m/s]")
    laws: list[Array] = []
    velocity = []
    frequency = film.frequency or math.nan
    for name in ("body_x_m", "body_z_m"):
        travel, series = (given[name] or 0.0) / frequency, np.zeros(2 * HIGHEST_ORDER + 1)
        if name in film.columns:
            phase, values = film.seen(name)
            covered = float(np.ptp(phase))
            if covered < _SHORTEST:
                rule = f"covers only {covered:.2g} beats: too little to separate travel from periodic motion"
                faults.add(f"{film.name}, column {name}", f"{len(phase)} frames", rule, "film a whole wingbeat")
            travel, law = fit_travel(phase, values - values.mean())
            series = law.coefficients
        velocity.append(travel * frequency)
        laws.append(series)
    faults.raise_if_any()
    pitch = np.array([body_pitch or 0.0, *[0.0] * 2 * HIGHEST_ORDER])
    if "body_pitch_deg" in film.columns:
        pitch = np.radians(fit_law(*film.seen("body_pitch_deg")).coefficients)
    moved = np.stack([from_phase(beat.shift, one) for one in (*laws, pitch)])
    return BodyPath(frequency, (velocity[0], velocity[1]), moved)
