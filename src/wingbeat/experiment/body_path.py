"""From a film to the motion of the body, with errors: uniform travel plus a periodic spline for each coordinate."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from wingbeat._base import HIGHEST_ORDER, FaultList, written
from wingbeat.experiment.film_fit import FilmedBeat
from wingbeat.experiment.periodic import MIN_BEATS, Array, fit_law, fourier_columns, from_phase

# A film must show this share of a beat in one piece: in a shorter piece, travel and periodic motion look alike.
_SHORTEST = 0.9
# A mean acceleration below this, 2 % of the weight, or below so many errors, is taken for none [m/s2].
_STEADY, _SURE_CHANGE = 0.2, 4.0
_WAYS = {"body_x_m": "forward", "body_z_m": "up"}


@dataclass(frozen=True)
class BodyPath:
    """Uniform travel of the body plus a periodic motion; made by `fit_body_path`.

    Parameters
    ----------
    frequency : wingbeats per second [Hz].
    velocity : of the travel, forward and up [m/s].
    series : x, z [m] and body pitch [rad] over the phase of the wingbeat, as mean, cosine and sine of order 1, of
        order 2 and so on up to 8, shape (3, 17); the place at phase 0 is the origin.
    acceleration : mean acceleration, forward and up, which is left out of the travel [m/s2].
    covariance : of velocity, acceleration and the 17 numbers of the series, for x, z and pitch, shape (3, 19, 19);
        None if not known.
    warnings : what may change every number computed from the path.
    """

    frequency: float
    velocity: tuple[float, float]
    series: Array
    acceleration: tuple[float, float] = (0.0, 0.0)
    covariance: Array | None = None
    warnings: tuple[str, ...] = ()

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
        return self._series(np.asarray(phase, dtype=float), 2) + np.array([*self.acceleration, 0.0])

    def draws(self, count: int, seed: int = 0) -> list[BodyPath]:
        """Return random paths, such as other films of the same flight might have given.

        Parameters
        ----------
        count : number of paths.
        seed : the same seed gives the same paths.
        """
        if self.covariance is None:
            return [self] * count
        # A stream beside that of the wings: both are drawn with one seed, and their errors are independent.
        random, found = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(0,))), []
        for _ in range(count):
            moved = np.stack([random.multivariate_normal(np.zeros(len(one)), one) for one in self.covariance])
            (u, w), (x, z) = (np.array([self.velocity, self.acceleration]) + moved[:2, :2].T).tolist()
            series = self.series + moved[:, 2:]
            found.append(dataclasses.replace(self, series=series, velocity=(u, w), acceleration=(x, z)))
        return found

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

    Each coordinate, x and z, is uniform travel plus a periodic smoothing spline like those of the wings' laws, and
    a mean acceleration if two beats or more show one above its error. Body pitch is such a spline alone. A velocity
    or pitch that was not filmed is constant, and given by the caller.

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
    frequency, warnings = film.frequency or math.nan, []
    size = 2 * HIGHEST_ORDER + 1
    series, covariance = np.zeros((3, size)), np.zeros((3, size + 2, size + 2))
    velocity, acceleration = [0.0, 0.0], [0.0, 0.0]
    for k, name in enumerate(("body_x_m", "body_z_m", "body_pitch_deg")):
        if name not in film.columns:
            if name == "body_pitch_deg":
                series[k, 0] = body_pitch or 0.0
            else:
                velocity[k] = given[name] or 0.0
            continue
        phase, values = film.seen(name)
        covered, before = float(np.ptp(phase)), []
        if name == "body_pitch_deg":
            values = np.radians(values)
        elif covered < _SHORTEST:
            rule = f"covers only {covered:.2g} beats: too little to separate travel from periodic motion"
            faults.add(f"{film.name}, column {name}", f"{len(phase)} frames", rule, "film a whole wingbeat")
            continue
        else:
            middle = phase - phase.mean()
            before, values = [middle[:, None]], values - values.mean()
            # From the path alone, a change of speed and the periodic motion of few beats look alike.
            if covered >= MIN_BEATS:
                bent, scale = fit_law(phase, values, middle[:, None], middle[:, None] ** 2), 2 * frequency**2
                change, error = scale * bent.coefficients[1], scale * math.sqrt(bent.covariance[1, 1])
                if abs(change) > max(_STEADY, _SURE_CHANGE * error):
                    before.append(middle[:, None] ** 2)
                    warnings.append(
                        f"{film.name}, column {name}: the flight is not steady: the body accelerates by "
                        f"{written(float(change), float(error), 'm/s2')} {_WAYS[name]}; the missing force contains "
                        "it, and velocities are the means of the clip"
                    )
        law = fit_law(phase, values, *before)
        # From the coefficients of the fit to velocity, acceleration and the series from the top of the stroke.
        linear = np.zeros((size + 2, len(law.coefficients)))
        for i in range(len(before)):
            linear[i, i] = (frequency, 2 * frequency**2)[i]
        linear[2:, len(before) :] = np.stack([from_phase(beat.shift, one) for one in np.eye(size)], axis=1)
        found = linear @ law.coefficients
        covariance[k] = linear @ law.covariance @ linear.T
        series[k] = found[2:]
        if before:
            velocity[k], acceleration[k] = (float(one) for one in found[:2])
    faults.raise_if_any()
    both = (velocity[0], velocity[1]), (acceleration[0], acceleration[1])
    return BodyPath(frequency, both[0], series, both[1], covariance, tuple(warnings))
