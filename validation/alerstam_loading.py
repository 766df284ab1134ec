"""Whether the models predict the airspeeds better than wing loading alone does."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

# A prediction counts as better if it leaves this share less scatter in logarithms than wing loading does.
CLEARLY = 0.1
SAMPLES = 2000
SPEEDS = (("min_power_speed", "minimum-power speed"), ("max_range_speed", "maximum-range speed"))


def left_by_fit(values: NDArray[np.float64], measured: NDArray[np.float64]) -> float:
    """Return the scatter, one standard deviation of the logarithm, that a fit ``measured = c values^k`` leaves."""
    good = np.isfinite(values)
    one, other = np.log(values[good]), np.log(measured[good])
    off = other - np.polyval(np.polyfit(one, other, 1), one)
    return math.sqrt(off @ off / (off.size - 2))


def change(
    values: NDArray[np.float64], alone: NDArray[np.float64], measured: NDArray[np.float64]
) -> tuple[float, float, float]:
    """Return by which share that scatter changes from a fit by `alone` to a fit by `values`, and its 95 % interval.

    The interval is that of bootstrap samples of the species, which it takes for independent.
    """
    good = np.flatnonzero(np.isfinite(values))
    random = np.random.default_rng(0)

    def share(some: NDArray[np.int64]) -> float:
        return left_by_fit(values[some], measured[some]) / left_by_fit(alone[some], measured[some]) - 1.0

    changes = [share(random.choice(good, good.size)) for _ in range(SAMPLES)]
    low, high = np.quantile(changes, [0.025, 0.975])
    return share(good), float(low), float(high)
