"""The peaks of a series along a beat: its largest value in each quarter.

A path seldom has two peaks in one quarter. If an optimiser knew only the largest peak of the whole
beat, it would alternate between peaks of equal height.
"""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._jax.arrays import jax, jnp

if TYPE_CHECKING:
    from wingbeat._jax.arrays import Columns, Indices, Quarters, SampledSeries, SamplesOfPeaks


PARTS = 4


def highest(series: SampledSeries) -> Quarters:
    """Return the largest sample in each quarter of the beat, ends included, along the first axis."""
    return series[_quarters(series)].max(axis=1)


def peaks(series: SampledSeries) -> Quarters:
    """Return the peak of a smooth curve through a closed path's samples (first axis), in each quarter of the beat.

    The curve between two samples is a Catmull-Rom cubic. The highest sample would not do: as a function of the
    unknowns, it has a kink where two samples are equal. A search that lowers a peak, or that is at a bound of the
    path, would end in this kink.

    Theory: equation ``peaks``.
    """
    samples = _taken(series, _samples_around(series, jnp), jnp)
    return jnp.sum(jax.lax.stop_gradient(_weights(samples, jnp)) * samples, axis=0)


def _quarters(series: SampledSeries) -> np.ndarray:
    """Return the indices of the samples of each quarter, ends included, shape (quarters, samples)."""
    return _quarters_of(series.shape[0])


@functools.lru_cache(32)
def _quarters_of(count: int) -> np.ndarray:
    part = (count - 1) // PARTS
    return part * np.arange(PARTS)[:, None] + np.arange(part + 1)


def _at(series: SampledSeries, index: Indices, xp: Any) -> Any:
    """Return the samples at indices along the first axis; all other axes are those of the series."""
    # Every flight of a search needs the peaks of one path, and `take_along_axis` takes ten times as long.
    return series[index] if xp is np and series.ndim == 1 else xp.take_along_axis(series, index, axis=0)


def _taken(series: SampledSeries, around: SamplesOfPeaks, xp: Any) -> Any:
    """Return the samples at indices of shape (4, quarters, ...)."""
    if xp is np and series.ndim == 1:
        return _at(series, around, xp)
    return xp.stack([_at(series, index, xp) for index in around])


def _samples_around(series: SampledSeries, xp: Any) -> Any:
    """Return the indices of four samples for each quarter; the curve peaks between the middle two.

    Shape (4, quarters, ...); `xp` is the array module of the series.
    """
    count, quarters = series.shape[0] - 1, _quarters(series)
    begin, end = (quarters[:, i].reshape(-1, *[1] * (series.ndim - 1)) for i in (0, -1))
    top = begin + xp.argmax(series[quarters], axis=1)

    def beside(way: int) -> Any:
        return _at(series, (top + way) % count, xp)

    way = xp.where(beside(1) >= beside(-1), 1, -1)
    # Where the curve would rise beyond the quarter, its peak is the sample at the end.
    inside = (begin <= top + way) & (top + way <= end)
    return xp.stack([xp.where(inside, (top + way * k) % count, top) for k in (-1, 0, 1, 2)])


class WeightedSamples:
    """The samples of a closed path from which its `peaks` are computed, and their weights.

    Parameters
    ----------
    series : the path, shape (K, ...).
    """

    def __init__(self, series: np.ndarray) -> None:
        self._around = _samples_around(series, np)
        self._weights = _weights(_taken(series, self._around, np), np)
        self.peaks = self.of(series)

    def of(self, series: np.ndarray) -> np.ndarray:
        """Return the weighted sums of the samples of a series; several series may lie along further last axes.

        If the series is a change of the path, the result is the change of the path's peaks, because a shift of a
        peak's phase has no first-order effect.
        """
        around, weights = self._around, self._weights
        if more := tuple(range(weights.ndim, series.ndim + 1)):
            around, weights = (np.expand_dims(a, more) for a in (around, weights))
        return (weights * _taken(series, around, np)).sum(axis=0)

    def of_highest(self, count: int) -> np.ndarray:
        """Return the weights, shape (K,), with which the samples of a single path sum to its highest peak."""
        weights, highest = np.zeros(count), self.peaks.argmax()
        np.add.at(weights, self._around[:, highest], self._weights[:, highest])
        return weights


def peak_weights(path: np.ndarray) -> np.ndarray:
    """Return the weights, shape (K,), with which a closed path's samples sum to the highest of its `peaks`."""
    return WeightedSamples(path).of_highest(len(path))


def _weights(samples: Quarters, xp: Any) -> Quarters:
    """Return the weights with which four samples sum to the peak of the curve between the middle two.

    The first of these two is the higher. Samples and weights are the first axis; `xp` is their array module.
    """
    before, here, there, after = samples
    # Coefficients of the cubic, from linear to cubic. The highest sample is at 0, its higher neighbour at 1.
    slope, slope_there = 0.5 * (there - before), 0.5 * (after - here)
    bend = 3.0 * (there - here) - 2.0 * slope - slope_there
    twist = 2.0 * (here - there) + slope + slope_there
    root = xp.sqrt(xp.maximum(bend**2 - 3.0 * slope * twist, 0.0))
    rises = root > bend
    at = xp.where(rises, xp.minimum(slope / xp.where(rises, root - bend, 1.0), 1.0), 0.0)
    return xp.stack(
        [
            -0.5 * at + at**2 - 0.5 * at**3,
            1.0 - 2.5 * at**2 + 1.5 * at**3,
            0.5 * at + 2.0 * at**2 - 1.5 * at**3,
            -0.5 * at**2 + 0.5 * at**3,
        ]
    )


def spread(series: SampledSeries) -> Columns:
    """Return a series minus its least value in each quarter of the beat, shape (phases, quarters).

    The largest of these numbers is the series' range. If we subtracted only the least value of the whole beat, the
    range would have a kink where two minima are equal.
    """
    return series[:, None] + peaks(-series)
