"""From load-cell records to coefficients: each run by itself, then the repeats of a point together."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from wingbeat.errors import FaultList
from wingbeat.experiment.record import CHANNELS, MIN_SAMPLES, LoadCellRun, refuse_radians
from wingbeat.experiment.statistics import added_variance, standard_error
from wingbeat.experiment.table import QUANTITIES, CoefficientTable

LAST_SECONDS = 20.0
# Repeats of one point: a positioning stage returns within a quarter degree, a stream within some per cent.
SAME_ALPHA_DEG = 0.5
SAME_REYNOLDS = 1.05
# x_cp is a ratio with C_N in the denominator. It is left out if C_N is less than CENTRE_SIGNAL times its own error,
# or less than CENTRE_FLOOR, because an error of the moment then has a large effect.
CENTRE_SIGNAL = 5.0
CENTRE_FLOOR = 0.02
# Student's t with 14 degrees of freedom passes 7 by chance once in 150 000 records.
_TREND_BLOCKS, _TREND_LIMIT = 16, 7.0
_BLOCKED = 0.05
# Number of samples that are reduced together; ten copies of them take some 20 MB.
_AT_A_TIME = 1 << 18


class RunMeans(NamedTuple):
    """Coefficients of one run.

    Attributes
    ----------
    alpha_deg : angle of attack [deg].
    reynolds : chord Reynolds number.
    mean, sd, se : mean, standard deviation and standard error of each of `QUANTITIES`, shape (4,); those of x_cp
        are NaN where the normal force is too small to divide by.
    normal, normal_se : C_N and its standard error.
    blockage : width of the plate across the stream divided by the channel's width; 0 if the latter is unknown.
    notes : notes for the reader.
    """

    alpha_deg: float
    reynolds: float
    mean: NDArray[np.float64]
    sd: NDArray[np.float64]
    se: NDArray[np.float64]
    normal: float
    normal_se: float
    blockage: float
    notes: tuple[str, ...]


def reduce_run(run: LoadCellRun, last: float = LAST_SECONDS) -> RunMeans:
    """Return the coefficients of one run from the last seconds of its record.

    ``L = F_N cos a - F_T sin a``, ``D = F_N sin a + F_T cos a``; ``C_L = L/(q c h)``, ``C_D = D/(q c h)``,
    ``C_M = M/(q c^2 h)`` with ``q = rho U^2 / 2``, and ``x_cp = 1/2 - M/(F_N c)`` from the means. From each channel
    we subtract a zero that drifts linearly from the still-fluid reading before the run to that after the run.
    Standard errors come from block means (`wingbeat.experiment.statistics`); the error of the ratio x_cp is to
    first order.

    Su, Fan, Onoue, Vejdani and Breuer 2023, doi 10.48550/arXiv.2302.09602.

    Parameters
    ----------
    last : length of the window at the end of the record [s]; everything before it counts as transient.
    run : the record.

    Raises
    ------
    InvalidInputError : `last` not positive or longer than the record, or a window of fewer than 32 samples.
    """
    return _reduced([run], last)[0]


def _reduced(runs: Sequence[LoadCellRun], last: float) -> list[RunMeans]:
    """Return the coefficients of each run; runs are reduced together, because each NumPy call is slow."""
    steady = [_steady(run, last) for run in runs]
    alike: dict[int, list[int]] = {}
    for place, (_, loads) in enumerate(steady):
        alike.setdefault(loads.shape[1], []).append(place)
    found: dict[int, RunMeans] = {}
    for size, places in alike.items():
        most = max(_AT_A_TIME // size, 1)
        for first in range(0, len(places), most):
            some = places[first : first + most]
            loads = np.stack([steady[place][1] for place in some], axis=1)
            means = _means([runs[place] for place in some], [steady[place][0] for place in some], loads)
            found.update(zip(some, means, strict=True))
    return [found[place] for place in range(len(runs))]


def _steady(run: LoadCellRun, last: float) -> tuple[float, NDArray[np.float64]]:
    """Return a run's angle [deg], and C_N, C_T and C_M in the window at its end, shape (3, n)."""
    keep = _window(run, last)
    share = (run.time[keep] - run.time[0]) / (run.time[-1] - run.time[0])
    tare = np.asarray(run.tare)
    raw = np.stack([getattr(run, name)[keep] for name in CHANNELS])
    normal, tangential, moment = raw - tare[:, :1] - (tare[:, 1:] - tare[:, :1]) * share
    alpha_deg = float(np.mean(np.asarray(run.alpha_deg)[keep]))
    force = 0.5 * run.density * run.speed**2 * run.chord * run.span
    return alpha_deg, np.stack([normal / force, tangential / force, moment / (force * run.chord)])


def _means(runs: list[LoadCellRun], alpha_deg: list[float], loads: NDArray[np.float64]) -> list[RunMeans]:
    """Return the coefficients of runs from their angles [deg] and their C_N, C_T, C_M, shape (3, runs, n)."""
    c_n, c_t, c_m = loads
    turns = [math.radians(angle) for angle in alpha_deg]
    cos, sin = (np.array([[function(turn)] for turn in turns]) for function in (math.cos, math.sin))
    mean_n, mean_m = c_n.mean(axis=1, keepdims=True), c_m.mean(axis=1, keepdims=True)
    # Change of the ratio with force and moment, to first order; not used where the ratio is undefined.
    some = np.where(mean_n == 0, 1.0, mean_n)
    lever = np.where(mean_n == 0, 0.0, -(c_m - mean_m / some * c_n) / some)
    series = np.stack([c_n * cos - c_t * sin, c_n * sin + c_t * cos, c_m, lever, c_n], axis=1)
    mean, sd, se = series.mean(axis=2), series.std(axis=2, ddof=1), standard_error(series)
    notes = _unsteady([run.name for run in runs], series[:, :3])
    means = []
    for i, run in enumerate(runs):
        found = np.stack([mean[i], sd[i], se[i]])[:, :4]
        normal, normal_se = float(mean_n[i, 0]), float(se[i, 4])
        found[:, 3] = _centre(normal, float(mean_m[i, 0]), normal_se, sd[i, 3], se[i, 3])
        blockage = _blockage(run, float(cos[i, 0]), float(sin[i, 0]))
        rows = found[0], found[1], found[2]
        means.append(RunMeans(alpha_deg[i], run.reynolds, *rows, normal, normal_se, blockage, notes[i]))
    return means


def _window(run: LoadCellRun, last: float) -> NDArray[np.bool_]:
    faults = FaultList()
    fix = "give the length of the steady part at the end of the record"
    if faults.number("last", last, above=0, unit="s", fix=fix):
        step = run.duration / len(run.time)
        if last > run.duration + step:
            rule = f"is longer than the record of {run.name}, {run.duration:.4g} s"
            faults.add("last", last, rule, "give a smaller --last, or record longer")
        elif last / step < MIN_SAMPLES - 0.5:
            rule = f"leaves fewer than {MIN_SAMPLES} samples of {run.name}"
            faults.add("last", last, rule, "give a larger --last, or sample faster")
    faults.raise_if_any()
    # Half a sample of tolerance; otherwise rounding decides whether the first sample is in the window.
    return run.time > run.time[-1] - last + 0.5 * run.duration / len(run.time)


def _centre(normal: float, moment: float, normal_se: float, sd: float, se: float) -> tuple[float, float, float]:
    """Return x_cp with its errors, NaN where the normal force is too small to divide by."""
    if abs(normal) <= max(CENTRE_FLOOR, CENTRE_SIGNAL * normal_se):
        return math.nan, math.nan, math.nan
    return 0.5 - moment / normal, sd, se


def _unsteady(names: list[str], series: NDArray[np.float64]) -> list[tuple[str, ...]]:
    """Return a note that names the coefficients whose drift in the window exceeds their block means' scatter."""
    size = series.shape[2] // _TREND_BLOCKS
    blocks = series[..., : size * _TREND_BLOCKS].reshape(*series.shape[:2], _TREND_BLOCKS, size).mean(axis=3)
    place = np.linspace(-1.0, 1.0, _TREND_BLOCKS)
    slope = blocks @ place / (place @ place)
    left = blocks - blocks.mean(axis=2, keepdims=True) - slope[..., None] * place
    error = np.sqrt((left**2).sum(axis=2) / (_TREND_BLOCKS - 2) / (place @ place))
    drifts = np.abs(slope) > np.maximum(_TREND_LIMIT * error, 1e-9)
    notes: list[tuple[str, ...]] = []
    for name, row in zip(names, drifts, strict=True):
        moved = [label for label, drifting in zip(QUANTITIES, row, strict=False) if drifting]
        text = f"{name}: still drifting within the window: {', '.join(moved)}; give a smaller --last"
        notes.append((text,) if moved else ())
    return notes


def _blockage(run: LoadCellRun, cos: float, sin: float) -> float:
    """Return the plate's width across the stream divided by the channel's width; 0 if that is not given."""
    if run.channel_width is None:
        return 0.0
    return (run.chord * abs(sin) + run.thickness * abs(cos)) / run.channel_width


def reduce_runs(runs: Sequence[LoadCellRun], last: float = LAST_SECONDS) -> CoefficientTable:
    """Return the coefficients of a campaign: one row for each angle and Reynolds number; repeated runs are pooled.

    Runs within half a degree and 5 per cent in Reynolds number are repeats of one point. A row's mean is the mean
    of its R runs, with the standard error ``sqrt(sum se^2 / R^2 + tau^2 / R)``. Here tau^2 is the variance between
    repeats that the errors se do not explain. For each coefficient, tau^2 is estimated from all points of a
    Reynolds number together; it is 0 unless significant. The standard deviation is that of the samples within runs.
    The row's x_cp is computed from the pooled force and moment.

    Parameters
    ----------
    runs : the records.
    last : length of the window at the end of each record [s].

    Raises
    ------
    InvalidInputError : no runs, a sweep of angles in radians, and inputs that `reduce_run` refuses.
    """
    if not runs:
        faults = FaultList()
        faults.add("runs", "none", "there is nothing to reduce", "name at least one run")
        faults.raise_if_any()
    means = _reduced(runs, last)
    alpha = np.array([one.alpha_deg for one in means])
    refuse_radians("alpha_deg of the runs", alpha)
    stream = _clusters(np.log([one.reynolds for one in means]), math.log(SAME_REYNOLDS))
    point = np.zeros(len(means), dtype=np.intp)
    for k in range(stream.max() + 1):
        here = stream == k
        point[here] = _clusters(alpha[here], SAME_ALPHA_DEG) + (point.max() + 1 if k else 0)
    return _pooled(means, stream, point)


def _clusters(values: NDArray[np.float64], gap: float) -> NDArray[np.intp]:
    """Return the cluster number of each value; a new cluster begins at a large step between sorted values."""
    order = np.argsort(values, kind="stable")
    number = np.concatenate([[0], np.cumsum(np.diff(values[order]) > gap)])
    clusters = np.empty(len(values), dtype=np.intp)
    clusters[order] = number
    return clusters


def _pooled(means: list[RunMeans], stream: NDArray[np.intp], point: NDArray[np.intp]) -> CoefficientTable:
    count = np.bincount(point)

    def average(values: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.bincount(point, values) / count

    def variance(values: NDArray[np.float64], errors: NDArray[np.float64]) -> Variance:
        between = np.zeros(len(count))
        for k in range(stream.max() + 1):
            here = stream == k
            groups, repeat = np.unique(point[here], return_inverse=True)
            between[groups] = added_variance(values[here], errors[here], repeat)
        return Variance(np.bincount(point, errors**2) / count**2, between / count)

    value, sd, se = (np.array([getattr(one, name) for one in means]) for name in ("mean", "sd", "se"))
    mean = {name: average(value[:, i]) for i, name in enumerate(QUANTITIES)}
    spread = {name: np.sqrt(average(sd[:, i] ** 2)) for i, name in enumerate(QUANTITIES)}
    parts = {name: variance(value[:, i], se[:, i]) for i, name in enumerate(QUANTITIES[:3])}
    normal = average(np.array([one.normal for one in means]))
    of_normal = variance(np.array([one.normal for one in means]), np.array([one.normal_se for one in means]))
    error = {name: np.sqrt(part.within + part.between) for name, part in parts.items()}
    with np.errstate(divide="ignore", invalid="ignore"):
        lever = mean["C_M"] / normal
        # The variance between repeats enters through force and moment; it changes the ratio most where the force is
        # small.
        between = (parts["C_M"].between + lever**2 * of_normal.between) / normal**2
        # Runs without a centre make the error NaN, so the cell stays empty.
        error["x_cp"] = np.sqrt(np.bincount(point, se[:, 3] ** 2) / count**2 + between)
    floor = np.maximum(CENTRE_FLOOR, CENTRE_SIGNAL * np.sqrt(of_normal.within + of_normal.between))
    known = (np.abs(normal) > floor) & np.isfinite(error["x_cp"])
    for column, values in ((mean, 0.5 - lever), (spread, spread["x_cp"]), (error, error["x_cp"])):
        column["x_cp"] = np.where(known, values, np.nan)
    return CoefficientTable(
        alpha_deg=average(np.array([one.alpha_deg for one in means])),
        reynolds=average(np.array([one.reynolds for one in means])),
        mean=mean,
        sd=spread,
        se=error,
        runs=count,
        notes=_notes(means),
    )


class Variance(NamedTuple):
    """Variance of each point's mean: the part from its samples, and the added part from scatter between repeats."""

    within: NDArray[np.float64]
    between: NDArray[np.float64]


def _notes(means: list[RunMeans]) -> tuple[str, ...]:
    notes = [note for one in means for note in one.notes]
    blockage = max((one.blockage for one in means), default=0.0)
    if blockage > _BLOCKED:
        notes.append(f"the plate blocks up to {blockage:.1%} of the channel's width; no correction was made")
    return tuple(notes)
