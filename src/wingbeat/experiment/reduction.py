"""From load-cell records to coefficients: each run by itself, then the repeats of a point together."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import Fault, FaultList, InvalidInputError
from wingbeat.aero.polar_sheet import check_radians
from wingbeat.experiment.coefficient_table import QUANTITIES, CoefficientTable
from wingbeat.experiment.load_cell_run import (
    CHANNELS,
    MIN_SAMPLES,
    LoadCellRun,
    RunMeans,
    check_coefficients,
    coefficient_notes,
    constant_notes,
)
from wingbeat.experiment.steadiness import (
    Array,
    Spans,
    added_variance,
    refuse_rest,
    signal_notes,
    standard_error,
    stated_rest,
    unsteady,
    zero_notes,
)

Intervals = Sequence[tuple[float, float]]
LAST_SECONDS = 20.0
# Repeats of one point: a positioning stage returns within a quarter degree, a stream within some per cent.
SAME_ALPHA_DEG = 0.5
SAME_REYNOLDS = 1.05
# x_cp is a ratio with C_N in the denominator. It is left out if C_N is less than CENTRE_SIGNAL times its own error,
# or less than CENTRE_FLOOR, because an error of the moment then has a large effect.
CENTRE_SIGNAL = 5.0
CENTRE_FLOOR = 0.02
_BLOCKED = 0.05
# Number of samples that are reduced together; ten copies of them take some 20 MB.
_AT_A_TIME = 1 << 18


def reduce_run(run: LoadCellRun, last: float = LAST_SECONDS, rest: Intervals = ()) -> RunMeans:
    """Return the coefficients of one run from the last seconds of its record.

    ``L = F_N cos a - F_T sin a``, ``D = F_N sin a + F_T cos a``; ``C_L = L/(q c h)``, ``C_D = D/(q c h)``,
    ``C_M = M/(q c^2 h)`` with ``q = rho U^2 / 2``, and ``x_cp = 1/2 - M/(F_N c)`` from the means. From each channel
    we subtract a zero that drifts linearly from the still-fluid reading before the run to that after it, or from
    the mean in one stated interval of rest to that in the next. Standard errors come from block means
    (`wingbeat.experiment.steadiness`), in the window and in the rest; the error of the ratio x_cp is to first
    order.

    Su, Fan, Onoue, Vejdani and Breuer 2023, doi 10.48550/arXiv.2302.09602.

    Parameters
    ----------
    run : the record.
    last : length of the window [s], at the end of the record or of the part before the last rest; everything before
        it counts as transient.
    rest : start and end of each interval in which the fluid is at rest [s], in the record's time.

    Raises
    ------
    InvalidInputError : `last` not positive or longer than the record, a window of fewer than 32 samples or at
        rest, intervals of rest that are not in the record, move or come with zero readings, and coefficients that
        no plate has: C_L beyond -5 to 5, C_D above 5 or below 0 by more than its error, less than friction alone,
        less than a tenth of the force of an inclined plate, more tangential than normal force on a steep one.
    """
    means = _reduced([run], last, rest)[0]
    return means._replace(notes=(*([] if rest else zero_notes([run])), *means.notes))


def _reduced(runs: Sequence[LoadCellRun], last: float, rest: Intervals) -> list[RunMeans]:
    """Return the coefficients of each run; runs are reduced together, because each NumPy call is slow."""
    faults = FaultList()
    spans = sorted((float(start), float(end)) for start, end in rest)
    for start, end in spans:
        if not (math.isfinite(start) and math.isfinite(end) and start < end):
            faults.add("rest", f"{start:g}:{end:g}", "must be a start and a later end", "such as 0:5, in seconds")
    for (_, end), (start, _) in itertools.pairwise(spans):
        if start <= end:
            faults.add("rest", f"{start:g}", f"overlaps the interval that ends at {end:g} s", "join the two")
    faults.raise_if_any()
    steady = [_steady(faults, run, last, spans) for run in runs]
    faults.raise_if_any()
    alike: dict[int, list[int]] = {}
    for place, part in enumerate(steady):
        alike.setdefault(part.loads.shape[1], []).append(place)
    found: dict[int, RunMeans] = {}
    for size, places in alike.items():
        most = max(_AT_A_TIME // size, 1)
        for first in range(0, len(places), most):
            some = places[first : first + most]
            means = _means([runs[place] for place in some], [steady[place] for place in some], bool(spans))
            found.update(zip(some, means, strict=True))
    for place, run in enumerate(runs):
        check_coefficients(faults, run, found[place])
    faults.raise_if_any()
    return [found[place] for place in range(len(runs))]


class _Steady(NamedTuple):
    """The window of a run: its times [s], mean angle [deg], C_N, C_T, C_M, shape (3, n), and notes.

    `zero_se` holds the standard errors of the zero at the middle of the window, as coefficients, shape (3,).
    """

    time: Array
    alpha_deg: float
    loads: Array
    zero_se: Array
    notes: list[str]


def _steady(faults: FaultList, run: LoadCellRun, last: float, spans: Spans) -> _Steady:
    """Return the window of a run without the zero; note a window at rest, and rest that is none."""
    raw = np.stack([getattr(run, name) for name in CHANNELS])
    force = 0.5 * run.density * run.speed**2 * run.chord * run.span
    unit = np.array([force, force, force * run.chord])
    moving = np.ones(run.time.size, dtype=bool)
    for start, end in spans:
        moving &= (run.time < start) | (run.time > end)
    keep, zero_se = _window(run, last, spans, moving), np.zeros(3)
    tare = np.asarray(run.tare)
    if spans:
        if np.isfinite(tare).any():
            rule = "is stated, and the record has zero readings too"
            faults.add(f"{run.name}, rest", "", rule, "leave out one of the two")
        zeros, errors = stated_rest(faults, run, spans, raw, raw[:2, moving].mean(axis=1))
        middle = float(run.time[keep].mean())
        centres = np.array([0.5 * (start + end) for start, end in spans])
        shares = np.array([np.interp(middle, centres, one) for one in np.eye(len(spans))])
        zero_se = np.sqrt(shares**2 @ errors**2) / unit
        zero = np.stack([np.interp(run.time, centres, readings) for readings in zeros.T])
    else:
        share = (run.time - run.time[0]) / (run.time[-1] - run.time[0])
        before, after = np.nan_to_num(tare.T)[..., None]
        zero = before + (after - before) * share
        # One file of zero readings stands for both, and its error does not average out.
        weight = np.interp(float(run.time[keep].mean()), run.time[[0, -1]], [0.0, 1.0])
        errors = np.asarray(run.tare_se)
        zero_se = np.hypot((1 - weight) * errors[:, 0], weight * errors[:, 1]) / unit
        zero_se = np.where((tare[:, 0] == tare[:, 1]), errors[:, 0] / unit, zero_se)
    loads = raw - zero
    refuse_rest(faults, run, loads[:2], keep)
    notes = [*run.notes, *constant_notes(run), *signal_notes(run, keep, raw[:, keep])]
    alpha_deg = float(np.mean(np.asarray(run.alpha_deg)[keep]))
    return _Steady(run.time[keep], alpha_deg, loads[:, keep] / unit[:, None], zero_se, notes)


def _means(runs: list[LoadCellRun], steady: list[_Steady], zeroed: bool) -> list[RunMeans]:
    """Return the coefficients of runs whose windows have the same number of samples."""
    c_n, c_t, c_m = np.stack([part.loads for part in steady], axis=1)
    alpha_deg = [part.alpha_deg for part in steady]
    turns = [math.radians(angle) for angle in alpha_deg]
    cos, sin = (np.array([[function(turn)] for turn in turns]) for function in (math.cos, math.sin))
    mean_n, mean_m = c_n.mean(axis=1, keepdims=True), c_m.mean(axis=1, keepdims=True)
    # Change of the ratio with force and moment, to first order; not used where the ratio is undefined.
    some = np.where(mean_n == 0, 1.0, mean_n)
    lever_slope = mean_m / some
    lever = np.where(mean_n == 0, 0.0, -(c_m - lever_slope * c_n) / some)
    series = np.stack([c_n * cos - c_t * sin, c_n * sin + c_t * cos, c_m, lever, c_n], axis=1)
    mean, sd, se = series.mean(axis=2), series.std(axis=2, ddof=1), standard_error(series)
    # The error of the zero: of C_L and C_D from those of C_N and C_T; of the lever, through force and moment.
    of_n, of_t, of_m = np.stack([part.zero_se for part in steady], axis=1)[..., None]
    of_lever = np.hypot(of_m, lever_slope * of_n) / np.abs(some)
    of_l, of_d = np.hypot(of_n * cos, of_t * sin), np.hypot(of_n * sin, of_t * cos)
    se = np.hypot(se, np.stack([of_l, of_d, of_m, of_lever, of_n], axis=1)[..., 0])
    notes = unsteady(runs, [part.time for part in steady], series[:, :3], zeroed)
    means = []
    for i, run in enumerate(runs):
        found = np.stack([mean[i], sd[i], se[i]])[:, :4]
        normal, normal_se = float(mean_n[i, 0]), float(se[i, 4])
        # No centre of pressure where the normal force is too small to divide by.
        known = abs(normal) > max(CENTRE_FLOOR, CENTRE_SIGNAL * normal_se)
        found[:, 3] = (0.5 - float(mean_m[i, 0]) / normal, sd[i, 3], se[i, 3]) if known else math.nan
        across = run.chord * abs(float(sin[i, 0])) + run.thickness * abs(float(cos[i, 0]))
        blockage = 0.0 if run.channel_width is None else across / run.channel_width
        rows = found[0], found[1], found[2]
        one = RunMeans(alpha_deg[i], run.reynolds, *rows, normal, normal_se, blockage, ())
        said = (*notes[i], *steady[i].notes, *coefficient_notes(run, one))
        means.append(one._replace(notes=said))
    return means


def _window(run: LoadCellRun, last: float, spans: Spans, moving: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return which samples are in the window: the last seconds of the part before, between or after the rest."""
    if not moving.any():
        where, value = f"{run.name}, rest", f"{spans[0][0]:g}:{spans[-1][1]:g}"
        raise InvalidInputError([Fault(where, value, "covers the whole record", "state only the rest")])
    faults = FaultList()
    until = float(run.time[moving][-1])
    since = max((end for _, end in spans if end < until), default=float(run.time[0]))
    step = run.duration / len(run.time)
    fix = "give the length of the steady part at the end of the record"
    if faults.number("last", last, above=0, unit="s", fix=fix):
        if last > until - since + 2 * step:
            rest = " between the stated rest" if spans else ""
            rule = f"is longer than the record of {run.name}{rest}, {until - since + (0 if spans else step):.4g} s"
            faults.add("last", last, rule, "give a smaller --last, or record longer")
        elif last / step < MIN_SAMPLES - 0.5:
            rule = f"leaves fewer than {MIN_SAMPLES} samples of {run.name}"
            faults.add("last", last, rule, "give a larger --last, or sample faster")
    faults.raise_if_any()
    # Half a sample of tolerance; otherwise rounding decides whether the first sample is in the window.
    return moving & (run.time > until - last + 0.5 * step)


def reduce_runs(runs: Sequence[LoadCellRun], last: float = LAST_SECONDS, rest: Intervals = ()) -> CoefficientTable:
    """Return the coefficients of a campaign: one row for each angle and Reynolds number; repeated runs are pooled.

    Runs within half a degree and 5 per cent in Reynolds number are repeats of one point. A row's mean is the mean
    of its R runs, with the standard error ``sqrt(sum se^2 / R^2 + tau^2 / R)``. Here tau^2 is the variance between
    repeats that the errors se do not explain. For each coefficient, tau^2 is estimated from all points of a
    Reynolds number together; it is 0 unless significant. The standard deviation is that of the samples within runs.
    The row's x_cp is computed from the pooled force and moment.

    Parameters
    ----------
    runs : the records.
    last : length of the window of each record [s].
    rest : start and end of each interval of rest [s], see `reduce_run`.

    Raises
    ------
    InvalidInputError : no runs, a sweep of angles in radians, and inputs that `reduce_run` refuses.
    """
    if not runs:
        raise InvalidInputError([Fault("runs", "none", "there is nothing to reduce", "name at least one run")])
    means = _reduced(runs, last, rest)
    alpha, faults = np.array([one.alpha_deg for one in means]), FaultList()
    check_radians(faults, "alpha_deg of the runs", alpha)
    faults.raise_if_any()
    stream = _clusters(np.log([one.reynolds for one in means]), math.log(SAME_REYNOLDS))
    point = np.zeros(len(means), dtype=np.intp)
    for k in range(stream.max() + 1):
        here = stream == k
        point[here] = _clusters(alpha[here], SAME_ALPHA_DEG) + (point.max() + 1 if k else 0)
    notes = [*([] if rest else zero_notes(runs)), *(note for one in means for note in one.notes)]
    blockage = max((one.blockage for one in means), default=0.0)
    if blockage > _BLOCKED:
        notes.append(f"the plate blocks up to {blockage:.1%} of the channel's width; no correction was made")
    return _pooled(means, stream, point, tuple(notes))


def _clusters(values: Array, gap: float) -> NDArray[np.intp]:
    """Return the cluster number of each value; a new cluster begins at a large step between sorted values."""
    order = np.argsort(values, kind="stable")
    number = np.concatenate([[0], np.cumsum(np.diff(values[order]) > gap)])
    return number[np.argsort(order)]


def _pooled(
    means: list[RunMeans], stream: NDArray[np.intp], point: NDArray[np.intp], notes: tuple[str, ...]
) -> CoefficientTable:
    count = np.bincount(point)

    def average(values: Array) -> Array:
        return np.bincount(point, values) / count

    value, sd, se, c_n, c_n_se, alpha, reynolds = (
        np.array([getattr(one, name) for one in means])
        for name in ("mean", "sd", "se", "normal", "normal_se", "alpha_deg", "reynolds")
    )
    mean = {name: average(value[:, i]) for i, name in enumerate(QUANTITIES)}
    spread = {name: np.sqrt(average(sd[:, i] ** 2)) for i, name in enumerate(QUANTITIES)}
    # The variance of each point's mean: the part from its samples, and that from scatter between repeats.
    within, between = {}, {}
    runs = {name: (value[:, i], se[:, i]) for i, name in enumerate(QUANTITIES[:3])} | {"C_N": (c_n, c_n_se)}
    for name, (values, errors) in runs.items():
        within[name], between[name] = np.bincount(point, errors**2) / count**2, np.zeros(len(count))
        for k in range(stream.max() + 1):
            here = stream == k
            groups, repeat = np.unique(point[here], return_inverse=True)
            between[name][groups] = added_variance(values[here], errors[here], repeat)
        between[name] /= count
    error = {name: np.sqrt(within[name] + between[name]) for name in QUANTITIES[:3]}
    normal = average(c_n)
    with np.errstate(divide="ignore", invalid="ignore"):
        lever = mean["C_M"] / normal
        # The variance between repeats enters through force and moment; it changes the ratio most where the force is
        # small.
        of_lever = (between["C_M"] + lever**2 * between["C_N"]) / normal**2
        # Runs without a centre make the error NaN, so the cell stays empty.
        error["x_cp"] = np.sqrt(np.bincount(point, se[:, 3] ** 2) / count**2 + of_lever)
    floor = np.maximum(CENTRE_FLOOR, CENTRE_SIGNAL * np.sqrt(within["C_N"] + between["C_N"]))
    known = (np.abs(normal) > floor) & np.isfinite(error["x_cp"])
    for column, values in ((mean, 0.5 - lever), (spread, spread["x_cp"]), (error, error["x_cp"])):
        column["x_cp"] = np.where(known, values, np.nan)
    return CoefficientTable(average(alpha), mean, spread, error, average(reynolds), count, notes)
