"""From power curves to the two characteristic speeds, beside what was measured and what the laws say."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from alerstam_flights import ANIMAL, FREQUENCY, POWER, Bird, Point, curves
from numpy.typing import NDArray

from wingbeat.aero import FeatheredFlapping, SuFan
from wingbeat.animal.species import scaling
from wingbeat.animal.vehicle import Air
from wingbeat.models import MODELS

AIR = Air()
# The Reynolds numbers at which the coefficients of each model were measured.
FITTED = {
    model: (FeatheredFlapping() if model == ANIMAL else SuFan()).reynolds_range or (math.nan, math.nan)
    for model in MODELS
}
_NEAR = 1e-4  # of a speed, for the rounding of a CSV file
# A prediction counts as better if it leaves this share less scatter in logarithms than wing loading does.
CLEARLY = 0.1
SAMPLES = 2000
SPEEDS = (("min_power_speed", "minimum-power speed"), ("max_range_speed", "maximum-range speed"))


@dataclass(frozen=True)
class Row:
    """One species by one model: measured, predicted, by published laws; SI units, not-a-number where there is none.

    `least_power` is the least of what the model minimises, `hinge_power` the positive hinge power at that speed.
    """

    model: str
    species: str
    mass: float
    wing_span: float
    wing_area: float
    airspeed: float
    airspeed_sd: float
    reynolds: float
    min_power_speed: float
    max_range_speed: float
    least_power: float
    hinge_power: float
    least_power_frequency: float
    least_frequency: float
    pennycuick_frequency: float
    mass_law_frequency: float
    wing_law_frequency: float


def best_speeds(curve: list[Point]) -> tuple[float, float, float, float]:
    """Return minimum-power speed, maximum-range speed [m/s], least power and its hinge power [W] of a curve.

    By a parabola through the least of power, or of power over speed, and its two neighbours; not-a-number where the
    least is the first or the last. The points have rising speeds.
    """
    speeds = np.array([point.speed for point in curve])
    power = np.array([point.power for point in curve])
    hinge = np.array([point.hinge_power for point in curve])
    slow, (least, beside) = _lowest(speeds, power, hinge)
    fast, _ = _lowest(speeds, power / speeds)
    return slow, fast, least, beside


def _lowest(
    speeds: NDArray[np.float64], values: NDArray[np.float64], beside: NDArray[np.float64] | None = None
) -> tuple[float, tuple[float, float]]:
    """Return the speed of the least value, that value, and there the value of the parabola through `beside`."""
    i = int(np.argmin(values)) if len(values) else 0
    if not 0 < i < len(values) - 1:
        return math.nan, (math.nan, math.nan)
    near = slice(i - 1, i + 2)
    bend, slope, level = np.polyfit(speeds[near] - speeds[i], values[near], 2)
    away = -0.5 * slope / bend
    other = np.polyval(np.polyfit(speeds[near] - speeds[i], (values if beside is None else beside)[near], 2), away)
    return float(speeds[i] + away), (float(level + 0.5 * slope * away), float(other))


def rows(radar: list[Bird], points: list[Point]) -> list[Row]:
    """Return a row for each model and each species whose airspeed was measured."""
    return [row for model in MODELS for row in _rows(radar, [point for point in points if point.model == model])]


def _rows(radar: list[Bird], points: list[Point]) -> list[Row]:
    own = curves(points)
    found = []
    for bird in radar if points else ():
        size = bird.mass, bird.span, bird.area
        at = {
            point.asked: point.frequency
            for point in points
            if point.species == bird.name and abs(point.speed - bird.airspeed) < _NEAR * bird.airspeed
        }
        wing = scaling.BIRD_SEMI_SPAN(bird.span)
        found.append(
            Row(
                points[0].model,
                bird.name,
                *size,
                bird.airspeed,
                bird.airspeed_sd,
                bird.airspeed * bird.area / bird.span / AIR.viscosity,
                *best_speeds(own.get(bird.name, [])),
                at.get(POWER, math.nan),
                at.get(FREQUENCY, math.nan),
                scaling.BIRD_FREQUENCY(*size, AIR.density, AIR.gravity),
                scaling.FREQUENCY_BY_MASS(bird.mass),
                scaling.FREQUENCY_BY_WING(wing),
            )
        )
    return found


def of_model(found: list[Row], model: str) -> list[Row]:
    """Return the rows of one model."""
    return [row for row in found if row.model == model]


def column(found: list[Row], name: str) -> NDArray[np.float64]:
    """Return one number of all species."""
    return np.array([getattr(row, name) for row in found])


def loading_of(found: list[Row]) -> NDArray[np.float64]:
    """Return the wing loading of all species [N/m2]."""
    return column(found, "mass") * AIR.gravity / column(found, "wing_area")


@dataclass(frozen=True)
class Comparison:
    """Of a prediction against a measurement, in logarithms: how far off, how scattered, how alike."""

    count: int
    median_ratio: float
    scatter: float
    correlation: float
    within_20_percent: float
    slope_in_reynolds: float
    slope_error: float


def compare(
    predicted: NDArray[np.float64], measured: NDArray[np.float64], reynolds: NDArray[np.float64]
) -> Comparison:
    """Compare where both are numbers; the scatter is a factor, one standard deviation of the ratio's logarithm."""
    both = np.isfinite(predicted) & np.isfinite(measured)
    one, other, at = np.log(predicted[both]), np.log(measured[both]), np.log(reynolds[both])
    off = one - other
    (slope, _), covariance = np.polyfit(at, off, 1, cov=True)
    alike = float(np.corrcoef(one, other)[0, 1]) if np.ptp(one) > 0 else math.nan
    near = float(np.mean(np.abs(off) < math.log(1.2)))
    return Comparison(
        int(both.sum()),
        float(np.exp(np.median(off))),
        float(np.exp(off.std(ddof=1))),
        alike,
        near,
        float(slope),
        float(1.96 * math.sqrt(covariance[0, 0])),
    )


def exponent(values: NDArray[np.float64], sizes: NDArray[np.float64]) -> tuple[float, float]:
    """Return the exponent of values over sizes by least squares in logarithms, and its 95 % half width."""
    good = np.isfinite(values)
    (slope, _), covariance = np.polyfit(np.log(sizes[good]), np.log(values[good]), 1, cov=True)
    return float(slope), float(1.96 * math.sqrt(covariance[0, 0]))


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
