"""Periodic smoothing splines, as Fourier series, with their errors.

The penalty is the square of (third derivative plus (2 pi)^2 times first derivative) of the spline. It is zero for a
mean and a plain sine (Ramsay and Silverman 2005, doi 10.1007/b98888): order k has the factor ``k^2 (k^2 - 1)^2``.
Restricted maximum likelihood chooses the weight of the penalty. The errors are those of the posterior whose mean is
the spline (Wahba 1983, doi 10.1111/j.2517-6161.1983.tb01239.x), so they include the spline's bias.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import HIGHEST_ORDER

# Range in which the weight of the penalty is searched, times the number of frames.
_WEIGHTS = (1e-12, 1e8)
Array = NDArray[np.float64]


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
        """Return the series at phases of the film, and its standard error.

        Parameters
        ----------
        phase : phases of the film, shape (n,).
        """
        columns = fourier_columns(phase)
        return columns @ self.coefficients, np.sqrt(np.einsum("ni,ij,nj->n", columns, self.covariance, columns))


def fit_law(phase: Array, values: Array) -> FilmedLaw:
    """Fit a periodic smoothing spline; restricted maximum likelihood chooses the weight of the penalty."""
    return _smoothed(fourier_columns(phase), values)


def fit_travel(phase: Array, values: Array) -> tuple[float, FilmedLaw]:
    """Fit uniform travel plus a periodic smoothing spline.

    Parameters
    ----------
    phase : in beats, counted on from beat to beat, shape (n,).
    values : shape (n,).

    Returns
    -------
    The travel in a beat, and the spline.
    """
    from_start = (phase - phase.mean())[:, None]
    found = _smoothed(np.hstack([from_start, fourier_columns(phase)]), values)
    travel, waves = found.coefficients[0], found.coefficients[1:].copy()
    waves[0] -= travel * phase.mean()
    law = found._replace(coefficients=waves, covariance=found.covariance[1:, 1:])
    return float(travel), law


def _smoothed(columns: Array, values: Array) -> FilmedLaw:
    """Fit values by columns; the penalty applies only to the last 14, which are of order 2 and up."""
    from scipy.optimize import minimize_scalar

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
