"""The peaks of a series along a beat: its largest value in each quarter.

A path seldom has two peaks in one quarter. With the largest peak alone, an optimiser would alternate between peaks
of equal height.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._jax.config import jax, jnp

if TYPE_CHECKING:
    from wingbeat._jax.shapes import Columns, Quarters, SampledSeries


PARTS = 4


def highest(series: SampledSeries) -> Quarters:
    """Return the largest sample in each quarter of the beat, ends included, along the first axis."""
    part = (series.shape[0] - 1) // PARTS
    return jnp.stack([jnp.max(series[i * part : (i + 1) * part + 1], axis=0) for i in range(PARTS)])


def peaks(series: SampledSeries) -> Quarters:
    """Return the peak in each quarter of the beat of a smooth curve through a closed path's samples (first axis).

    The highest sample, as a function of the unknowns, has a kink where two samples are equal. A search that lowers
    a peak, or that is at a bound of the path, would end in this kink. The curve between two samples is a
    Catmull-Rom cubic.
    """
    part = (series.shape[0] - 1) // PARTS
    around = [_samples_around(series, i * part, (i + 1) * part) for i in range(PARTS)]
    samples = [jnp.stack([jnp.take_along_axis(series, k[None], axis=0)[0] for k in four]) for four in around]
    return jnp.stack([jnp.sum(jax.lax.stop_gradient(_weights(four, jnp)) * four, axis=0) for four in samples])


def _samples_around(series: SampledSeries, begin: int, end: int) -> list[Any]:
    """Return the indices of four samples for each quarter; the curve peaks between the middle two."""
    count = series.shape[0] - 1
    top = begin + jnp.argmax(series[begin : end + 1], axis=0)

    def beside(way: int) -> Any:
        return jnp.take_along_axis(series, ((top + way) % count)[None], axis=0)[0]

    way = jnp.where(beside(1) >= beside(-1), 1, -1)
    inside = (begin <= top + way) & (top + way <= end)
    # Where the curve would rise beyond the quarter, its peak is the sample at the end.
    return [jnp.where(inside, (top + way * k) % count, top) for k in (-1, 0, 1, 2)]


def peak_weights(path: np.ndarray) -> np.ndarray:
    """Return the weights of the samples of a closed path, shape (K,), that give the highest of its `peaks`.

    The same weights give the peak's derivative, because a shift of the peak's phase has no first-order effect.
    """
    count = len(path) - 1
    begin = np.arange(PARTS) * (count // PARTS)
    quarters = begin[:, None] + np.arange(count // PARTS + 1)
    top = begin + path[quarters].argmax(axis=1)
    way = np.where(path[(top + 1) % count] >= path[(top - 1) % count], 1, -1)
    inside = (begin <= top + way) & (top + way <= quarters[:, -1])
    around = np.array([np.where(inside, (top + way * k) % count, top) for k in (-1, 0, 1, 2)])
    four = _weights(path[around], np)
    highest = (four * path[around]).sum(axis=0).argmax()
    weights = np.zeros(len(path))
    np.add.at(weights, around[:, highest], four[:, highest])
    return weights


def _weights(samples: Quarters, xp: Any) -> Quarters:
    """Return the weights of four samples that give the peak of the curve between the middle two.

    The first of these two is the higher. Samples and weights are the first axis; `xp` is their array module.
    """
    before, here, there, after = samples
    # Coefficients of the cubic, linear to cubic, from the highest sample, at 0, to its higher neighbour, at 1.
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
