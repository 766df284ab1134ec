"""Periodic series of a film: the rate at which its frames repeat, and periodic smoothing splines with their errors.

The splines are Fourier series. The penalty is the square of (third derivative plus (2 pi)^2 times first derivative)
of the spline. It is zero for a mean and a plain sine (Ramsay and Silverman 2005, doi 10.1007/b98888): order k has
the factor ``k^2 (k^2 - 1)^2``. Restricted maximum likelihood chooses the weight of the penalty. The errors are
those of the posterior whose mean is the spline (Wahba 1983, doi 10.1111/j.2517-6161.1983.tb01239.x), so they
include the spline's bias.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import HIGHEST_ORDER

Array = NDArray[np.float64]
# A clip of two beats determines its frequency; the count itself is uncertain by some per cent.
MIN_BEATS = 1.9
# Harmonics of the model; more of them would fit the noise of short clips.
_ORDERS = 3
# A column of an animal's flap has its first harmonic; in a span or a sweep the second may be larger. The slower of
# two rates counts if its share of the larger one's power is above this.
_SLOWER = 0.15
# ... and if a fit at the larger rate leaves a share of the variance that is above this one, and so many times the
# share that a fit at the slower one leaves. A series with 0.15 of its power at the slower rate leaves some 0.13.
_LEAST_WORSE, _WORSE = 0.01, 2.0
# Share of the variance that a beat explains in a film; noise of 3 degrees leaves 0.94 of a flap of 18 degrees.
_CLEAR = 0.8
# A change of the rate below this share of it is left alone: it moves the phase of a clip of four beats by at most
# 0.04 beats. Of 400 steady clips (2 to 6 beats, noise of 0.3 to 3 degrees), 98 % seem to change by less than 0.045.
_DRIFT = 0.08
# Standard errors by which two numbers differ for sure; 3.6 is the largest of 400 such clips.
SURE = 4.5
# At most so many points of the periodogram.
_POINTS = 1 << 17


class Clip(NamedTuple):
    """What the frames of a clip say about its beat, in the unit of its clock (beats per second, or per beat).

    Attributes
    ----------
    rate, rate_se : beats per unit of the clock, and its standard error.
    beats : number of beats in the clip.
    change, change_se : rate at the end minus rate at the start, if the rate changes evenly, and its standard error.
    explained : share of the variance that a beat explains whose rate changes evenly.
    """

    rate: float
    rate_se: float
    beats: float
    change: float
    change_se: float
    explained: float

    @property
    def clear(self) -> bool:
        """Whether the frames repeat so well that the rate can be trusted, where the clip has beats enough."""
        return self.explained >= _CLEAR

    @property
    def drifts(self) -> bool:
        """Whether the rate changes within the clip by more than its error, and by more than beats of animals do."""
        enough = self.clear and self.beats >= MIN_BEATS
        return enough and abs(self.change) > max(_DRIFT * self.rate, SURE * self.change_se)

    @property
    def ends(self) -> tuple[float, float]:
        """Rate at the start and at the end of the clip."""
        return self.rate - 0.5 * self.change, self.rate + 0.5 * self.change


def clip_rate(clock: Array, columns: Mapping[str, Array]) -> Clip | None:
    """Return the rate at which the columns of a clip repeat, None if they show no beat.

    The largest peak of the columns' periodogram (the flap's alone, if it was filmed) is the first guess. We refine
    it with the model ``sum over k <= 3 of a_k cos(2 pi k p) + b_k sin(2 pi k p)`` plus a mean, where
    ``p = f t + g t^2/2``: for given f and g, linear least squares gives the mean and the amplitudes (variable
    projection, Golub and Pereyra 1973, doi 10.1137/0710036), and Gauss-Newton steps give f and g. The standard
    errors are those of least squares, larger by the lag-one correlation of the residuals. The rate is that of the
    fit with g = 0. Columns are NaN in frames where they were not seen.
    """
    if "flap_deg" in columns:
        columns = {"flap_deg": columns["flap_deg"]}
    seen = []
    for values in columns.values():
        at, values = clock[np.isfinite(values)], values[np.isfinite(values)]
        if len(at) >= 2 * _ORDERS + 6 and np.std(values) > 1e-9 * max(np.abs(values).max(), 1e-30):
            seen.append((at, (values - values.mean()) / np.std(values)))
    if not seen:
        return None
    middle, span = 0.5 * (clock[0] + clock[-1]), float(clock[-1] - clock[0]) * len(clock) / (len(clock) - 1)
    seen = [(at - middle, values) for at, values in seen]
    guess = _peak(seen, span, len(clock))
    plain, (error, _), _ = _refined(seen, span, np.array([guess, 0.0]), steady=True)
    turning, (_, change_error), left = _refined(seen, span, plain, steady=False)
    rate, change = float(plain[0]), float(turning[1] * span)
    return Clip(rate, float(error), rate * span, change, float(change_error * span), 1.0 - left)


def scatter_at(clock: Array, values: Array, rate: float) -> float:
    """Return the standard deviation of a column from the best beat of a given rate, in the column's unit."""
    left, _, _ = _linearised([(clock - clock.mean(), values - values.mean())], np.array([rate, 0.0]), steady=True)
    return math.sqrt(float(left @ left) / max(len(left) - 2 * _ORDERS - 1, 1))


def _peak(seen: list[tuple[Array, Array]], span: float, frames: int) -> float:
    """Return the rate of the highest peak of the summed periodograms, or of half that rate if it has power too."""
    count = min(1 << max(math.ceil(math.log2(max(frames, 16))) + 1, 6), _POINTS)
    start = min(at[0] for at, _ in seen)
    grid = start + span * np.arange(count) / count
    padded = 8 * count
    power = np.zeros(padded // 2 + 1)
    for at, values in seen:
        slope = np.polynomial.polynomial.polyfit(at, values, 1)
        even = np.interp(grid, at, values - np.polynomial.polynomial.polyval(at, slope))
        # A column that is mostly noise has no peak and little weight.
        power += np.abs(np.fft.rfft(even, padded)) ** 2
    rates = np.arange(len(power)) / (span * padded / count)
    lowest, highest = 0.6 / span, 0.5 * frames / span
    allowed = (rates >= lowest) & (rates <= highest)
    best = int(np.argmax(np.where(allowed, power, -1.0)))
    near = np.abs(rates - 0.5 * rates[best]) < 0.3 / span
    if rates[best] * span >= 3.0 and near.any() and power[near].max() > _SLOWER * power[best]:
        slow = int(np.flatnonzero(near)[np.argmax(power[near])])
        # Straight lines across gaps have power at half the rate too. The frames themselves then fit both rates.
        fits = [_refined(seen, span, np.array([rates[k], 0.0]), steady=True)[2] for k in (best, slow)]
        best = slow if fits[0] > max(_WORSE * fits[1], _LEAST_WORSE) else best
    return float(rates[best])


def _linearised(seen: list[tuple[Array, Array]], turn: Array, steady: bool) -> tuple[Array, Array, float]:
    """Return residuals, their derivatives with respect to f (and g) projected off the columns, and correlation."""
    residuals, slopes, alike = [], [], []
    order = 2 * math.pi * np.arange(1, _ORDERS + 1)
    for at, values in seen:
        angle = 2 * math.pi * (turn[0] * at + 0.5 * turn[1] * at**2)[:, None] * np.arange(1, _ORDERS + 1)
        ones, cosines, sines = np.ones((len(at), 1)), np.cos(angle), np.sin(angle)
        columns = np.hstack([ones, cosines, sines])
        found, *_ = np.linalg.lstsq(columns, values, rcond=None)
        left, speed = values - columns @ found, np.hstack([0 * ones, -order * sines, order * cosines]) @ found
        slope = speed[:, None] * np.stack([at, 0.5 * at**2], axis=1)[:, : 1 if steady else 2]
        slope -= columns @ np.linalg.lstsq(columns, slope, rcond=None)[0]
        residuals.append(left)
        slopes.append(slope)
        alike.append(float(left[1:] @ left[:-1]) / max(float(left @ left), 1e-300))
    return np.concatenate(residuals), np.concatenate(slopes), float(np.clip(max(alike), 0.0, 0.9))


def _refined(seen: list[tuple[Array, Array]], span: float, turn: Array, steady: bool) -> tuple[Array, Array, float]:
    """Return f and g of least squares, their standard errors and the share of variance left, from a guess."""
    free = 1 if steady else 2
    left, slopes, alike = _linearised(seen, turn, steady)
    for _ in range(12):
        step, *_ = np.linalg.lstsq(slopes, left, rcond=None)
        # A step of a third of a beat over half the clip stays on the same peak.
        scale = np.array([0.3 / span, 2.0 / span**2])[:free]
        step = step / max(1.0, float(np.max(np.abs(step) / scale)))
        for _ in range(6):
            tried = turn + np.concatenate([step, np.zeros(2 - free)])
            new, new_slopes, new_alike = _linearised(seen, tried, steady)
            if new @ new <= left @ left:
                break
            step = 0.5 * step
        else:
            break
        gained = left @ left - new @ new
        turn, left, slopes, alike = tried, new, new_slopes, new_alike
        if gained <= 1e-9 * (left @ left):
            break
    spare = max(len(left) - len(seen) * (2 * _ORDERS + 1) - free, 1)
    variance = float(left @ left) / spare * (1 + alike) / (1 - alike)
    covariance = variance * np.linalg.pinv(slopes.T @ slopes)
    errors = np.sqrt(np.concatenate([np.diag(covariance), np.zeros(2 - free)]))
    return turn, errors, float(left @ left) / len(left)


# Range in which the weight of the penalty is searched, times the number of frames.
_WEIGHTS = (1e-12, 1e8)
# Noise alone exceeds this chi squared of four numbers in one film of a hundred.
_CHANCE = 13.28


def fourier_columns(phase: Any) -> Array:
    """Return the columns 1, cos, sin, .. of a Fourier series, shape (n, 17)."""
    turns = 2 * math.pi * np.asarray(phase)[:, None] * np.arange(1, HIGHEST_ORDER + 1)
    waves = np.stack([np.cos(turns), np.sin(turns)], axis=-1).reshape(len(turns), 2 * HIGHEST_ORDER)
    return np.hstack([np.ones((len(turns), 1)), waves])


class FilmedLaw(NamedTuple):
    """One column of a film as a Fourier series of the film's phase, in the unit of the column.

    Attributes
    ----------
    coefficients : mean, cosine and sine of order 1, of order 2 and so on up to 8, shape (17,).
    covariance : of the coefficients, shape (17, 17).
    residual_sd : standard deviation of a frame from the series.
    degrees : effective number of parameters of the spline; a mean and a plain sine count as 3.
    frames : number of frames.
    """

    coefficients: Array
    covariance: Array
    residual_sd: float
    degrees: float
    frames: int

    def curve(self, phase: Any) -> tuple[Array, Array]:
        """Return the series at phases of the film, and its standard error, shape (n,) each."""
        columns = fourier_columns(phase)
        return columns @ self.coefficients, np.sqrt(np.einsum("ni,ij,nj->n", columns, self.covariance, columns))

    @property
    def varies(self) -> bool:
        """Whether the first two orders exceed what noise alone shows in 99 films of a hundred."""
        waves, covariance = self.coefficients[1:5], self.covariance[1:5, 1:5]
        # Points without noise have no covariance.
        return bool(waves @ np.linalg.solve(covariance + 1e-18 * np.eye(4), waves) > _CHANCE)


def fit_law(phase: Array, values: Array, *before: Array) -> FilmedLaw:
    """Fit a periodic smoothing spline, and columns `before` it; the penalty is on orders 2 and up of the spline."""
    from scipy.optimize import minimize_scalar

    columns = np.hstack([*before, fourier_columns(phase)])
    count, plain = len(values), columns.shape[1] - 2 * (HIGHEST_ORDER - 1)
    orders = np.repeat(np.arange(2, HIGHEST_ORDER + 1), 2)
    penalty = np.concatenate([np.zeros(plain), orders**2 * (orders**2 - 1.0) ** 2])
    square, right = columns.T @ columns, columns.T @ values
    # Not 0 where all values are 0, so that the logarithm below is finite.
    rounding = count * (1e-9 * max(np.abs(values).max(), 1e-9)) ** 2

    def solved(log_weight: float) -> tuple[Array, Array, float]:
        stiff = square + np.diag(count * math.exp(log_weight) * penalty)
        found = np.asarray(np.linalg.solve(stiff, right), dtype=np.float64)
        rest = values - columns @ found
        return stiff, found, float(rest @ rest + found @ (stiff - square) @ found) + rounding

    def unlikely(log_weight: float) -> float:
        stiff, _, left = solved(log_weight)
        return float((count - plain) * math.log(left) + np.linalg.slogdet(stiff)[1] - orders.size * log_weight)

    # The likelihood may have two maxima, so a grid comes first.
    grid = np.linspace(math.log(_WEIGHTS[0]), math.log(_WEIGHTS[1]), 81)
    best = int(np.argmin([unlikely(at) for at in grid]))
    around = float(grid[max(best - 1, 0)]), float(grid[min(best + 1, grid.size - 1)])
    finest: Any = minimize_scalar(unlikely, bounds=around, method="bounded")
    stiff, found, left = solved(float(finest.x))
    variance, inverse = left / (count - plain), np.asarray(np.linalg.inv(stiff), dtype=np.float64)
    return FilmedLaw(found, variance * inverse, math.sqrt(variance), float(np.trace(inverse @ square)), count)


def from_phase(shift: float, coefficients: Array) -> Array:
    """Return the coefficients of the same series if its phase is counted from `shift`."""
    cosines, sines = coefficients[1::2], coefficients[2::2]
    turns = 2 * math.pi * shift * np.arange(1, len(cosines) + 1)
    c, s = np.cos(turns), np.sin(turns)
    waves = np.stack([cosines * c + sines * s, sines * c - cosines * s], axis=-1).ravel()
    return np.concatenate([coefficients[:1], waves])
