"""A beat as time series, and what is read off series: mean positive part, peaks, the best spring.

Quantities are functions of a beat. A series counts by its largest value in each quarter of the beat: a path seldom
has two peaks in one quarter, and an optimiser that knew only the largest peak of the whole beat would alternate
between peaks of equal height.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Collection
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._jax.arrays import jax, jnp
from wingbeat.animal.drive import Drive

if TYPE_CHECKING:
    from wingbeat._jax.arrays import (
        Columns,
        Indices,
        Number,
        Quarters,
        SampledSeries,
        Samples,
        SamplesOfPeaks,
        Scalar,
        Series,
        StripSeries,
    )


class Beat(NamedTuple):
    """One beat from phase 0 to 1, both ends included, at K equal phases.

    Names and units are those of `Orbit.dataset`. Torques and powers are those of both wings together.

    Attributes
    ----------
    phase : share of the beat, shape (K,).
    time : [s], shape (K,).
    body_pitch, pitch_rate, pitch_acceleration : of the body, nose-up positive [rad, rad/s, rad/s2], shape (K,).
    u, w, u_rate, w_rate : velocity forward and up, and its rates [m/s, m/s2], shape (K,).
    flap, flap_rate : of the arm, up positive [rad, rad/s], shape (K,).
    wing_pitch, wing_pitch_rate : at the root, leading edge up positive [rad, rad/s], shape (K,).
    flap_torque, pitch_torque : of the hinges [N m], shape (K,).
    hinge_power, actuator_power : of the hinges, and of all actuators [W], shape (K,).
    aerodynamic_power, inertial_power, body_power : parts of the hinge power [W], shape (K,).
    alpha : angle of attack of the strips of one wing [rad], shape (K, strips).
    strip_reynolds : Reynolds number of their chords, shape (K, strips).
    lift, drag : of these strips [N], shape (K, strips).
    force_x, force_z : air load on the whole vehicle, forward and up [N], shape (K,).
    frequency : [Hz].
    flap_amplitude : [rad].
    speed, climb : mean velocity, forward and up [m/s].
    mass : [kg].
    weight : [N].
    semi_span : [m].
    drive : muscles, motor and springs at the flap hinges; the flight does not depend on them.

    >>> import wingbeat as wb
    >>> highest = wb.Quantity("highest_flap", lambda beat: beat.flap, unit="rad")  # the function takes a Beat
    >>> str(wb.Constraint(highest, 1.2))
    'highest_flap<=1.2'
    """

    phase: Series
    time: Series
    body_pitch: Series
    u: Series
    w: Series
    pitch_rate: Series
    u_rate: Series
    w_rate: Series
    pitch_acceleration: Series
    flap: Series
    flap_rate: Series
    wing_pitch: Series
    wing_pitch_rate: Series
    flap_torque: Series
    pitch_torque: Series
    hinge_power: Series
    actuator_power: Series
    aerodynamic_power: Series
    inertial_power: Series
    body_power: Series
    alpha: StripSeries
    strip_reynolds: StripSeries
    lift: StripSeries
    drag: StripSeries
    force_x: Series
    force_z: Series
    frequency: Number
    flap_amplitude: Number
    speed: Number
    climb: Number
    mass: Number
    weight: Number
    semi_span: Number
    drive: Drive = Drive()

    def only(self, fields: Collection[str]) -> Beat:
        """Return the beat with only these fields and its drive; all other fields are None.

        Parameters
        ----------
        fields : names of the fields to keep.
        """
        others = [name for name in self._fields if name not in fields and name != "drive"]
        return self._replace(**dict.fromkeys(others))

    def mean(self, values: Samples) -> Scalar:
        """Return the mean of a series over the beat, by the trapezoidal rule.

        Parameters
        ----------
        values : the series, shape (K,).
        """
        return jnp.mean(0.5 * (values[:-1] + values[1:]))

    def mean_positive(self, values: Samples) -> Scalar:
        """Return the mean of the positive part of a series, taken as linear between its samples.

        Parameters
        ----------
        values : the series, shape (K,).
        """
        return mean_positive(values)


def mean_positive(values: Samples, xp: Any = jnp) -> Scalar:
    """Return the mean of the positive part of a piecewise linear curve through samples at equal phases.

    Unlike the mean of the samples' positive parts, it is differentiable when a sample passes through zero. `xp` is
    the array module of the samples. Theory: equation ``mean-positive``.
    """
    before, after = values[:-1], values[1:]
    crosses = before * after < 0.0
    part = xp.maximum(before, after) ** 2 / xp.where(crosses, xp.abs(before - after), 1.0)
    whole = xp.maximum(before, 0.0) + xp.maximum(after, 0.0)
    return 0.5 * xp.mean(xp.where(crosses, part, whole))


# Fields of a beat that are single numbers.
NUMBERS = ("frequency", "flap_amplitude", "speed", "climb", "mass", "weight", "semi_span")
# Those with a column for each strip. All others are series.
BY_STRIP = ("alpha", "strip_reynolds", "lift", "drag")

PARTS = 4


def highest(series: SampledSeries) -> Quarters:
    """Return the largest sample in each quarter of the beat, ends included, along the first axis."""
    return series[_quarters(series.shape[0])].max(axis=1)


def peaks(series: SampledSeries) -> Quarters:
    """Return the peak of a smooth curve through a closed path's samples, in each quarter of the beat.

    The highest sample would not do: as a function of the unknowns, it has a kink where two samples are equal, in
    which a search that lowers a peak, or that is at a bound of the path, would end. Theory: equation ``peaks``.
    """
    samples = _taken(series, _samples_around(series, jnp), jnp)
    return jnp.sum(jax.lax.stop_gradient(_weights(samples, jnp)) * samples, axis=0)


@functools.lru_cache(32)
def _quarters(count: int) -> np.ndarray:
    """Return the indices of the samples of each quarter, ends included, shape (quarters, samples)."""
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
    """Return the indices of four samples for each quarter, between whose middle two the curve peaks."""
    count, quarters = series.shape[0] - 1, _quarters(series.shape[0])
    begin, end = (quarters[:, i].reshape(-1, *[1] * (series.ndim - 1)) for i in (0, -1))
    top = begin + xp.argmax(series[quarters], axis=1)

    def beside(way: int) -> Any:
        return _at(series, (top + way) % count, xp)

    way = xp.where(beside(1) >= beside(-1), 1, -1)
    # Where the curve would rise beyond the quarter, its peak is the sample at the end.
    inside = (begin <= top + way) & (top + way <= end)
    return xp.stack([xp.where(inside, (top + way * k) % count, top) for k in (-1, 0, 1, 2)])


class WeightedSamples:
    """The samples of a closed path, shape (K, ...), from which its `peaks` are computed, and their weights."""

    def __init__(self, series: np.ndarray) -> None:
        self.around = _samples_around(series, np)
        self.weights = _weights(_taken(series, self.around, np), np)
        self.peaks = self.of(series)

    def of(self, series: np.ndarray) -> np.ndarray:
        """Return the weighted sums of the samples of a series; several series may lie along further last axes."""
        # Of a change of the path, this is the change of its peaks: a shift of phase has no first-order effect.
        around, weights = self.around, self.weights
        if more := tuple(range(weights.ndim, series.ndim + 1)):
            around, weights = (np.expand_dims(a, more) for a in (around, weights))
        return (weights * _taken(series, around, np)).sum(axis=0)


def peak_weights(path: np.ndarray) -> np.ndarray:
    """Return the weights, shape (K,), with which a closed path's samples sum to the highest of its `peaks`."""
    found, weights = WeightedSamples(path), np.zeros(len(path))
    highest = found.peaks.argmax()
    np.add.at(weights, found.around[:, highest], found.weights[:, highest])
    return weights


def highest_sample(path: np.ndarray) -> np.ndarray:
    """Return the weights, shape (K,), that select the highest sample."""
    weights = np.zeros(len(path))
    weights[path.argmax()] = 1.0
    return weights


def _weights(samples: Quarters, xp: Any) -> Quarters:
    """Return the weights (first axis) with which four samples sum to the curve's peak between the middle two."""
    before, here, there, after = samples
    # Coefficients of a Catmull-Rom cubic. The highest sample is at 0, its higher neighbour at 1.
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
    """Return a series minus its least value in each quarter of the beat; the largest is the series' range."""
    # With the least value of the whole beat, the range would have a kink where two minima are equal.
    return series[:, None] + peaks(-series)


# With a rest angle farther away, a spring is in effect a constant torque.
_FARTHEST_REST = math.pi


class Spring(NamedTuple):
    """Both flap springs: stiffness [N m/rad], rest angle [rad], None without, and the actuators' power left [W]."""

    stiffness: float
    rest_angle: float | None
    mean_positive_power: float


@jax.jit
def _left(spring: Columns, flap: Samples, flap_rate: Samples, power: Samples) -> Any:
    """Return the mean positive power left by a spring ``(k, k rest)``, and its derivative."""
    return jax.value_and_grad(lambda s: mean_positive(power + (s[0] * flap - s[1]) * flap_rate))(spring)


def best_spring(flap: Samples, flap_rate: Samples, hinge_power: Samples) -> Spring:
    """Return springs with which the actuators need the least mean positive power, for one closed beat.

    The samples are at equal phases from 0 to 1, ends included. The power is linear in stiffness and in stiffness
    times rest angle, so its mean positive part is convex in both, and SLSQP finds the global minimum.

    >>> phase = np.linspace(0.0, 1.0, 257)
    >>> flap, rate = np.cos(2 * np.pi * phase), -2 * np.pi * np.sin(2 * np.pi * phase)
    >>> best = best_spring(flap, rate, -3.0 * (flap - 0.2) * rate)
    >>> round(best.stiffness, 2), round(best.rest_angle, 2)
    (3.0, 0.2)
    """
    from scipy.optimize import minimize

    series = tuple(np.asarray(a, dtype=float) for a in (flap, flap_rate, hinge_power))
    without = float(mean_positive(series[2], np))
    # Scale: the stiffness of a spring that alone would take up a torque typical of this power.
    rate = np.abs(series[1]).max()
    size = np.abs(series[2]).max() / (rate * np.ptp(series[0])) if rate > 0.0 else 0.0
    if size == 0.0 or without == 0.0:
        return Spring(0.0, None, without)

    def left(scaled: np.ndarray) -> tuple[float, np.ndarray]:
        value, slope = _left(jnp.asarray(scaled * size), *series)
        return float(value) / without, np.asarray(slope) * size / without

    farthest = np.array([[_FARTHEST_REST, -1.0], [_FARTHEST_REST, 1.0]])
    found = minimize(
        left,
        np.zeros(2),
        jac=True,
        method="SLSQP",
        bounds=[(0.0, None), (None, None)],
        constraints={"type": "ineq", "fun": lambda s: farthest @ s, "jac": lambda s: farthest},
        options={"ftol": 1e-14, "maxiter": 300},
    )
    stiffness, preload = found.x * size
    if found.fun >= 1.0 or stiffness <= 0.0:
        return Spring(0.0, None, without)
    return Spring(float(stiffness), float(preload / stiffness), float(found.fun) * without)
