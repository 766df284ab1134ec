"""Whether the models predict the airspeeds better than wing loading alone does."""

from __future__ import annotations

import math

import numpy as np
from alerstam_summary import Row, column, compare, loading_of, of_model
from numpy.typing import NDArray

from wingbeat.models import MODELS

# A prediction counts as better if it leaves this share less scatter in logarithms than wing loading does.
CLEARLY = 0.1
SAMPLES = 2000
SPEEDS = (("min_power_speed", "minimum-power speed"), ("max_range_speed", "maximum-range speed"))

HEAD = """
## Better than wing loading alone?

*As predicted* is the scatter of the ratio of predicted to measured speed about the mean of this ratio. Nothing
else is fitted. For *fitted*, we fit a factor times a power of the predictor to the measured speed, and give the
scatter that is left. Each predictor thus has two fitted numbers. *Change* is the relative change of the logarithm
of the fitted scatter if the predictor replaces wing loading. Its 95 % interval is from {samples} bootstrap samples
of the species. A decrease of {clearly:.0%} or more counts as better.

| predictor of the measured speed | as predicted | fitted | change |
| --- | --- | --- | --- |
"""


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


def against_loading(found: list[Row]) -> str:
    """Return the table of scatters and the paragraph that answers the question by the last model."""
    flown = [model for model in MODELS if of_model(found, model)]
    own = of_model(found, flown[0])
    loading, measured, reynolds = loading_of(own), column(own, "airspeed"), column(own, "reynolds")
    law, alone = compare(4.3 * loading**0.31, measured, reynolds).scatter, left_by_fit(loading, measured)
    lines = [f"| wing loading (as predicted: the law 4.3 (m g/S)^0.31) | {law:.2f} | {math.exp(alone):.3f} | |"]
    as_is: dict[str, float] = {}
    gains: dict[str, tuple[float, float, float]] = {}
    left: dict[str, float] = {}
    for model in flown:
        for name, label in SPEEDS:
            values = column(of_model(found, model), name)
            scatter = compare(values, measured, reynolds).scatter
            gained, fitted = change(values, loading, measured), left_by_fit(values, measured)
            lines.append(
                f"| {label}, `{model}` | {scatter:.2f} | {math.exp(fitted):.3f} "
                f"| {gained[0]:+.1%} ({gained[1]:+.1%} to {gained[2]:+.1%}) |"
            )
            if model not in as_is or scatter < as_is[model]:
                as_is[model] = scatter
            if model not in gains or gained < gains[model]:
                gains[model], left[model] = gained, fitted
    answers = [_answer(model, as_is[model], left[model], gains[model], alone) for model in flown]
    text = HEAD.format(samples=SAMPLES, clearly=CLEARLY) + "\n".join(lines)
    return text + "\n\n" + "\n".join(answers) + "\n"


def _answer(model: str, as_is: float, left: float, gained: tuple[float, float, float], alone: float) -> str:
    if math.log(as_is) <= (1 - CLEARLY) * alone:
        verdict = "**yes**"
    else:
        verdict = "**only if fitted**" if gained[0] <= -CLEARLY and gained[2] < 0 else "**no**"
    return (
        f"- `{model}`: {verdict}. With nothing fitted, the better of the model's two speeds has a scatter of "
        f"{as_is:.2f}. With a fit, the scatter is {math.exp(left):.2f} for the better of the two speeds, and "
        f"{math.exp(alone):.2f} for wing loading."
    )
