"""How close a computed force comes to the measured one."""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass

import numpy as np
from numpy.typing import NDArray

from wingbeat_evidence.measured_motion.strip_case import StripCase

Array = NDArray[np.float64]

# Means and spreads below this share of the largest measured force count as zero.
_NOTHING = 1e-3
# Steps of a beat in which the lag is looked for, up to half a beat either way.
_STEPS = 360
# Share of the judged frames that a shifted force must still meet.
_OVERLAP = 0.6


@dataclass(frozen=True)
class Score:
    """How close a computed force comes to the measured one.

    A number is None if its force is not measured, or if it has no meaning.

    Attributes
    ----------
    mean_ratio : computed mean over the measured mean.
    peak_ratio : largest computed force over largest measured force, both in the direction of the largest measured
        force.
    rms : root mean square of the difference over the weight.
    correlation : Pearson's correlation coefficient.
    lag : delay of the computed force behind the measured one, as a share of a beat: the shift that makes them
        agree best.
    rms_about_mean : root mean square of the difference over the root mean square of the measured force, each force
        about its mean.
    """

    mean_ratio: float | None = None
    peak_ratio: float | None = None
    rms: float | None = None
    correlation: float | None = None
    lag: float | None = None
    rms_about_mean: float | None = None

    def to_dict(self) -> dict[str, float | None]:
        """Return the numbers by name."""
        return asdict(self)


def score(case: StripCase, axis: str, force: Array) -> Score:
    """Return how close a computed force comes to what a case measured.

    Parameters
    ----------
    case : the measured motion and its forces.
    axis : "fx" or "fz".
    force : computed [N], shape (n,).
    """
    if case.mean_force is not None:
        measured = case.mean_force[("fx", "fz").index(axis)]
        large = abs(measured) > _NOTHING * case.weight
        return Score(mean_ratio=_finite(float(case.mean(force)) / measured) if large else None)
    if axis not in case.forces:
        return Score()
    measured = case.forces[axis]
    here = case.inside
    peak = float(np.abs(measured[here]).max())
    if not peak > 0:
        return Score(rms=_finite(_rms(case, force) / case.weight))
    mean, computed = float(case.mean(np.where(here, measured, 0.0))), float(case.mean(force))
    about, computed_about = np.where(here, measured, 0.0) - mean, force - computed
    spread, computed_spread = _rms(case, about), _rms(case, computed_about)
    flat = spread <= _NOTHING * peak or computed_spread <= 1e-12 * peak
    side = math.copysign(1.0, float(measured[here][np.abs(measured[here]).argmax()]))
    product = float(case.mean(about * computed_about))
    return Score(
        mean_ratio=_finite(computed / mean) if abs(mean) > _NOTHING * peak else None,
        peak_ratio=_finite(float((side * force[here]).max()) / peak),
        rms=_finite(_rms(case, force - np.where(here, measured, 0.0)) / case.weight),
        correlation=None if flat else _finite(product / (spread * computed_spread)),
        lag=None if flat else _lag(case, measured, force),
        rms_about_mean=_finite(_rms(case, computed_about - about) / spread) if spread > _NOTHING * peak else None,
    )


def sine_score(case: StripCase, axis: str) -> dict[str, float | None]:
    """Return the scores of a mean and a sine at the beat's frequency, fitted to the measured force itself.

    Models of the air do not use the measured force; this fit does. A model that scores worse than the fit explains
    little.

    Parameters
    ----------
    case : the measured motion and its forces.
    axis : "fx" or "fz".
    """
    if axis not in case.forces:
        return {"rms": None, "rms_about_mean": None, "correlation": None, "amplitude": None}
    sine = best_sine(case, axis)
    found = score(case, axis, sine)
    amplitude = float(np.ptp(sine)) / 2
    scores = {"rms": found.rms, "rms_about_mean": found.rms_about_mean, "correlation": found.correlation}
    return {**scores, "amplitude": amplitude}


def best_sine(case: StripCase, axis: str) -> Array:
    """Return the mean and the sine at the beat's frequency that come closest to a measured force [N].

    Parameters
    ----------
    case : the measured motion and its forces.
    axis : "fx" or "fz".
    """
    angle = 2 * math.pi * case.frequency * (case.times - case.times[0])
    terms = np.stack([np.ones_like(angle), np.cos(angle), np.sin(angle)], axis=1)
    here = case.inside
    root = np.sqrt(case.weights()[here])[:, None]
    fitted = np.linalg.lstsq(root * terms[here], root[:, 0] * case.forces[axis][here], rcond=None)[0]
    return np.asarray(terms @ fitted, dtype=np.float64)


def floor(case: StripCase, axis: str) -> float | None:
    """Return the root mean square of the measurement's own standard error over the weight; None if unknown.

    Parameters
    ----------
    case : the measured motion and its forces.
    axis : "fx" or "fz".
    """
    if axis not in case.errors:
        return None
    return _finite(_rms(case, np.where(case.inside, case.errors[axis], 0.0)) / case.weight)


def _rms(case: StripCase, values: Array) -> float:
    return math.sqrt(float(case.mean(values * values)))


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _lag(case: StripCase, measured: Array, force: Array) -> float | None:
    """Return the delay of the computed force in beats: the shift by which the two forces agree best."""
    step, here = 1.0 / (case.frequency * _STEPS), case.inside
    first, last = case.times[here][0], case.times[here][-1]
    repeats = case.period if case.period is not None and here.all() else None
    count = round(repeats / step) if repeats else int((last - first) / step) + 1
    wanted = _at(case.times[here], measured[here], first + step * np.arange(count), repeats)
    # On one grid of even steps a shift is a count of steps.
    most = _STEPS // 2
    at = first + step * np.arange(-most, count + most)
    there = np.full(len(at), True) if repeats else (at >= case.times[0]) & (at <= case.times[-1])
    moved, found = _at(case.times, force, at, repeats), []
    for shift in range(2 * most + 1):
        met = there[shift : shift + count]
        if met.mean() < _OVERLAP:
            found.append(-math.inf)
            continue
        one, other = wanted[met], moved[shift : shift + count][met]
        one, other = one - one.mean(), other - other.mean()
        size = math.sqrt(float((one @ one) * (other @ other)))
        found.append(float(one @ other) / size if size > 0 else -math.inf)
    best = int(np.argmax(found))
    if not math.isfinite(found[best]):
        return None
    return (best - most + _vertex(found, best)) / _STEPS


def _vertex(values: list[float], best: int) -> float:
    """Return the steps from the largest value to the vertex of the parabola through it and its neighbours."""
    if not 0 < best < len(values) - 1:
        return 0.0
    before, here, after = values[best - 1 : best + 2]
    bend = before - 2 * here + after
    return 0.5 * (before - after) / bend if math.isfinite(bend) and bend < 0 else 0.0


def _at(times: Array, values: Array, at: Array, period: float | None) -> Array:
    return np.interp(at, times, values) if period is None else np.interp(at, times, values, period=period)
