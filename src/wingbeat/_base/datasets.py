"""Functions that the readers of data sets share."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import xarray as xr


def flown(dataset: xr.Dataset) -> np.ndarray:
    """Return a mask of the samples before the vehicle tumbled; all samples if it did not."""
    return np.isfinite(dataset["hinge_power"].values) & np.isfinite(dataset["u"].values)


def downstrokes(phase: np.ndarray, flap_rate: np.ndarray) -> list[tuple[float, float]]:
    """Return the first and the last phase of each downstroke, from phase and flap rate of the samples [1, rad/s].

    >>> downstrokes(np.array([0.0, 0.25, 0.5, 0.75, 1.0]), np.array([0.0, -1.0, 0.0, 1.0, 0.0]))
    [(0.0, 0.5)]
    """
    down = (flap_rate[1:] + flap_rate[:-1]) < 0
    edges = np.flatnonzero(np.diff(np.concatenate([[False], down, [False]]).astype(int)))
    return [(float(phase[a]), float(phase[b])) for a, b in zip(edges[::2], edges[1::2], strict=True)]


def at_station(values: np.ndarray, station: float) -> np.ndarray:
    """Interpolate values at strip centres (last axis) linearly to one span fraction."""
    count = values.shape[-1]
    place = np.clip(station * count - 0.5, 0, count - 1)
    low = min(int(place), max(count - 2, 0))
    high = min(low + 1, count - 1)
    return values[..., low] + (place - low) * (values[..., high] - values[..., low])
