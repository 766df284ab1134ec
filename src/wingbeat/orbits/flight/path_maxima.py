"""The peaks of a series along a beat: its largest value in each quarter.

A path seldom has two peaks in one quarter, and a search that saw the largest only would go to and fro between peaks
of equal height.
"""

from __future__ import annotations

from typing import Any

from wingbeat._jax.config import jax, jnp

PARTS = 4


def highest(series: Any) -> Any:
    """Return the largest sample in each quarter, ends included, along the first axis."""
    part = (series.shape[0] - 1) // PARTS
    return jnp.stack([jnp.max(series[i * part : (i + 1) * part + 1], axis=0) for i in range(PARTS)])


def peaks(series: Any) -> Any:
    """Return the peak in each quarter of a smooth curve through the samples along the first axis.

    The highest sample itself has a kink wherever two samples are level, and optima that lower a peak come to lie in
    it. The curve is the cubic of Catmull and Rom between each sample and the next. Where the peak lies does not
    matter to first order.
    """
    part = (series.shape[0] - 1) // PARTS
    first, last = (3.0 * (a - b) + c for a, b, c in (series[:3], series[:-4:-1]))
    longer = jnp.concatenate([first[None], series, last[None]])
    return jnp.stack([_peak(longer, 1 + i * part, 1 + (i + 1) * part) for i in range(PARTS)])


def _peak(series: Any, begin: int, end: int) -> Any:
    top = begin + jnp.argmax(series[begin : end + 1], axis=0)

    def sample(index: Any) -> Any:
        return jnp.take_along_axis(series, index[None], axis=0)[0]

    way = jnp.where(sample(top + 1) >= sample(top - 1), 1, -1)
    inside = (begin <= top + way) & (top + way <= end)
    # Where the curve would rise out of the quarter, its peak there is the sample at the end.
    around = [sample(jnp.where(inside, top + way * k, top)) for k in (-1, 0, 1, 2)]
    at = jax.lax.stop_gradient(_place(*around))
    before, here, there, after = around
    return (
        before * (-0.5 * at + at**2 - 0.5 * at**3)
        + here * (1.0 - 2.5 * at**2 + 1.5 * at**3)
        + there * (0.5 * at + 2.0 * at**2 - 1.5 * at**3)
        + after * (-0.5 * at**2 + 0.5 * at**3)
    )


def _place(before: Any, here: Any, there: Any, after: Any) -> Any:
    """Return where between the middle two of four samples, the first of them the higher, the curve is highest."""
    slope, slope_there = 0.5 * (there - before), 0.5 * (after - here)
    bend = 3.0 * (there - here) - 2.0 * slope - slope_there
    twist = 2.0 * (here - there) + slope + slope_there
    root = jnp.sqrt(jnp.maximum(bend**2 - 3.0 * slope * twist, 0.0))
    rises = root > bend
    return jnp.where(rises, jnp.minimum(slope / jnp.where(rises, root - bend, 1.0), 1.0), 0.0)


def spread(series: Any) -> Any:
    """Return how far a series is, at each phase, above its least value in each quarter: shape (phases, quarters).

    The largest of all is the series' range. Above the least value only, it would have a kink where two are level.
    """
    return series[:, None] + peaks(-series)
