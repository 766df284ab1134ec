"""From power curves to the two characteristic speeds, beside what was measured and what the laws say."""

from __future__ import annotations

import csv
import io
import math
from dataclasses import dataclass

import numpy as np
from alerstam_flights import FREQUENCY, POWER, Bird, Point, curves
from numpy.typing import NDArray

from wingbeat.aero import SuFan
from wingbeat.species import scaling
from wingbeat.vehicle import Air

AIR = Air()
FITTED = SuFan().reynolds_range or (math.nan, math.nan)
_NEAR = 1e-4  # of a speed, for the rounding of a CSV file


@dataclass(frozen=True)
class Row:
    """One species: measured, predicted, and by published laws; SI units, not-a-number where there is none."""

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
    least_power_frequency: float
    least_frequency: float
    pennycuick_frequency: float
    mass_law_frequency: float
    wing_law_frequency: float


def best_speeds(curve: list[Point]) -> tuple[float, float, float]:
    """Return minimum-power speed, maximum-range speed [m/s] and least power [W] of a curve of rising speeds.

    By a parabola through the least of power, or of power over speed, and its two neighbours; not-a-number where the
    least is the first or the last.
    """
    speeds = np.array([point.speed for point in curve])
    power = np.array([point.power for point in curve])
    (slow, least), (fast, _) = _lowest(speeds, power), _lowest(speeds, power / speeds)
    return slow, fast, least


def _lowest(speeds: NDArray[np.float64], values: NDArray[np.float64]) -> tuple[float, float]:
    i = int(np.argmin(values)) if len(values) else 0
    if not 0 < i < len(values) - 1:
        return math.nan, math.nan
    near = slice(i - 1, i + 2)
    bend, slope, level = np.polyfit(speeds[near] - speeds[i], values[near], 2)
    away = -0.5 * slope / bend
    return float(speeds[i] + away), float(level + 0.5 * slope * away)


def rows(radar: list[Bird], points: list[Point]) -> list[Row]:
    """Return a row for each species whose airspeed was measured."""
    own = curves(points)
    found = []
    for bird in radar:
        size = bird.mass, bird.span, bird.area
        at = {
            point.asked: point.frequency
            for point in points
            if point.species == bird.name and abs(point.speed - bird.airspeed) < _NEAR * bird.airspeed
        }
        wing = scaling.BIRD_SEMI_SPAN(bird.span)
        found.append(
            Row(
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


def column(found: list[Row], name: str) -> NDArray[np.float64]:
    """Return one number of all species."""
    return np.array([getattr(row, name) for row in found])


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


def to_csv(found: list[Row]) -> str:
    """Return the rows as a CSV file's text."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(Row.__dataclass_fields__)
    for row in found:
        writer.writerow([f"{value:.4g}" if isinstance(value, float) else value for value in vars(row).values()])
    return text.getvalue()
