"""Whether the averaged part of a record is steady, and the standard error of its mean and of repeats."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import FaultList
from wingbeat.experiment.coefficient_table import QUANTITIES
from wingbeat.experiment.load_cell_run import CHANNELS, LoadCellRun

Array = NDArray[np.float64]
Spans = list[tuple[float, float]]
MIN_BLOCKS = 8


def standard_error(series: Array) -> Array:
    """Return the standard error of the mean of each row of `series`, shape (..., n), by block means.

    The samples are averaged in blocks of B = 1, 2, 4, ... The standard error estimated from the block means grows
    with B until the means are independent. We use the smallest B with ``B^3 > 2 n (se_B / se_1)^4``, which balances
    bias and scatter of the estimate, and never fewer than 8 blocks.

    Flyvbjerg and Petersen 1989, J. Chem. Phys. 91:461, doi 10.1063/1.457480; the choice of the block is that of
    Lee et al. 2011, Phys. Rev. E 83:066706, doi 10.1103/PhysRevE.83.066706.
    """
    n = series.shape[-1]
    blocks, size = series, 1
    first = found = _error_of_independent(series)
    settled = np.zeros(series.shape[:-1], dtype=bool)
    while blocks.shape[-1] // 2 >= MIN_BLOCKS and not settled.all():
        blocks, size = 0.5 * (blocks[..., 0 : blocks.shape[-1] // 2 * 2 : 2] + blocks[..., 1::2]), 2 * size
        error = _error_of_independent(blocks)
        found = np.where(settled, found, error)
        with np.errstate(divide="ignore", invalid="ignore"):
            settled |= size**3 > 2 * n * np.nan_to_num(found / first) ** 4
    return found


def _error_of_independent(blocks: Array) -> Array:
    return blocks.std(axis=-1, ddof=1) / np.sqrt(blocks.shape[-1])


def added_variance(values: Array, errors: Array, groups: NDArray[np.intp]) -> float:
    """Return the variance between repeats that their own standard errors do not explain, one value for all groups.

    With ``w = 1/se^2``, their sum ``W`` in a group and ``Q = sum w (x - mean)^2``, the result is the moment
    estimator ``tau^2 = (Q - df) / sum(W - sum(w^2)/W)`` if ``Q > df + 2 sqrt(2 df)``, which is two standard
    deviations of chi^2 above its mean. Otherwise it is 0, because estimated errors make Q slightly too large:
    DerSimonian and Laird 1986, doi 10.1016/0197-2456(86)90046-2. The runs of a group are repeats of one point.
    """
    count = np.bincount(groups)
    freedom = int((count - 1)[count > 0].sum())
    if freedom == 0 or not (errors > 0).all():
        return 0.0
    weight = errors**-2
    total = np.bincount(groups, weight)
    mean = np.bincount(groups, weight * values) / total
    excess = float((weight * (values - mean[groups]) ** 2).sum()) - freedom
    if excess <= 2.0 * np.sqrt(2.0 * freedom):
        return 0.0
    return excess / float((total - np.bincount(groups, weight**2) / total).sum())


_BLOCKS = 16
# Student's t with 14 degrees of freedom passes 4.5 by chance in one of 2000 channels; a step at the best of 15
# places passes 7 in one of 10 000.
_TREND_LIMIT, _STEP_LIMIT = 4.5, 7.0
# Smaller changes across the window, as a share of the whole force, are not worth a word.
_SMALL_TREND, _SMALL_STEP = 0.03, 0.05
# A force below this share of the usual one is rest with an offset of the zero. A stream that starts may overshoot
# twofold, so a steady part has more.
_AT_REST = 0.45
_REST_BLOCKS = 128
# Samples so many times farther from the median than the middle one are spikes; 2 % of them are no longer rare.
_SPIKE, _RARE = 15.0, 0.02
# Samples at the very largest value: at least so many, this share of all, and so many times those at the next one.
_CLIPPED, _CLIPPED_SHARE, _CLIPPED_RATIO = 10, 0.01, 3
_REPEATED = 0.5
# The force in an interval of rest may change by this share of that in the stream, for its zero drifts.
_MOVING = 0.1


def rest_spans(time: Array, force: Array) -> Spans:
    """Return the intervals at the ends of a record in which the force, shape (2, n), is that of rest, if any."""
    size = max(time.size // _REST_BLOCKS, 1)
    count = time.size // size
    level = np.hypot(*force[:, : count * size].reshape(2, count, size).mean(axis=2))
    flowing = np.flatnonzero(level >= _AT_REST * np.quantile(level, 0.75))
    if flowing.size == 0 or flowing[0] > 0.75 * count:
        return []

    def change(block: int) -> int:
        """Return the first sample after the step near a block: where the sum of deviations is largest."""
        first = max(block - 2, 0) * size
        near = np.hypot(*force[:, first : (block + 3) * size])
        return first + int(np.abs(np.cumsum(near - near.mean())).argmax()) + 1

    spans = []
    if flowing[0] > 2:
        spans.append((float(time[0]), float(time[change(int(flowing[0])) - 1])))
    if flowing[-1] < count - 3:
        spans.append((float(time[change(int(flowing[-1]))]), float(time[-1])))
    return spans


def refuse_rest(faults: FaultList, run: LoadCellRun, force: Array, keep: NDArray[np.bool_]) -> None:
    """Note a window in which there is hardly any force [N], shape (2, n), while there was one before."""
    before = force[:, ~keep]
    size = max(before.shape[1] // _REST_BLOCKS, 1)
    if before.shape[1] < 2 * _BLOCKS:
        return
    blocks = before[:, : before.shape[1] // size * size].reshape(2, -1, size).mean(axis=2)
    usual, inside = float(np.quantile(np.hypot(*blocks), 0.75)), float(np.hypot(*force[:, keep].mean(axis=1)))
    scatter = float(np.hypot(*np.diff(blocks, axis=1).std(axis=1)))
    if inside < _AT_REST * usual and usual > 5 * scatter:
        window = run.time[keep]
        rule = f"from {window[0]:.4g} to {window[-1]:.4g} s is at rest: the force is {inside:.2g} N there, and "
        rule += f"{usual:.2g} N in the stream"
        fix = _state_rest(run, force, "cut the record at its end")
        faults.add(f"{run.name}, window", f"{window[-1] - window[0]:.4g} s", rule, fix)


def _state_rest(run: LoadCellRun, force: Array, otherwise: str) -> str:
    """Return the advice to state the rest at the ends of a record, or other advice if there is none."""
    spans = " ".join(f"{start:.4g}:{end:.4g}" for start, end in rest_spans(run.time, force))
    return f"state the rest, which also measures the zero: --rest {spans}" if spans else otherwise


def unsteady(runs: list[LoadCellRun], windows: list[Array], series: Array, zeroed: bool) -> list[list[str]]:
    """Return notes on coefficients that step or drift within the window, for each run.

    A step, a straight line and a parabola are fitted to the means of 16 blocks. A step is reported if it fits best,
    a drift otherwise, if the change is significant by Student's t and more than 5 per cent (step) or 3 per cent
    (line) of the force coefficient. The series are C_L, C_D and C_M in the window, shape (runs, 3, n); `zeroed`
    says that rest was stated, from which the zero is known.
    """
    size = series.shape[2] // _BLOCKS
    blocks = series[..., : size * _BLOCKS].reshape(*series.shape[:2], _BLOCKS, size).mean(axis=3)
    left = blocks - blocks.mean(axis=2, keepdims=True)
    scale = np.hypot(*series[:, :2].mean(axis=2).T)[:, None]
    total = (left**2).sum(axis=2)
    place = np.linspace(-1.0, 1.0, _BLOCKS)
    slope = blocks @ place / (place @ place)
    straight = np.maximum(total - slope**2 * (place @ place), 0.0)
    # A start that decays is closer to a parabola than to a step.
    bow = place**2 - np.mean(place**2)
    curved = np.maximum(straight - (blocks @ bow) ** 2 / (bow @ bow), 0.0)
    sure = np.abs(slope) > _TREND_LIMIT * np.sqrt(straight / (_BLOCKS - 2) / (place @ place))
    drifts = sure & (2 * np.abs(slope) > np.maximum(_SMALL_TREND * scale, 1e-9))
    # Sum of the first k blocks' deviations; the step after them is n/(k (n - k)) times it.
    first = np.arange(1, _BLOCKS)
    sums = np.cumsum(left, axis=2)[..., :-1]
    gained = sums**2 * _BLOCKS / (first * (_BLOCKS - first))
    best = gained.argmax(axis=2)
    stepped = np.maximum(total - np.take_along_axis(gained, best[..., None], 2)[..., 0], 0.0)
    count = best + 1
    step = -np.take_along_axis(sums, best[..., None], 2)[..., 0] * _BLOCKS / (count * (_BLOCKS - count))
    error = np.sqrt(stepped / (_BLOCKS - 2) * _BLOCKS / (count * (_BLOCKS - count)))
    least_step = np.maximum(_STEP_LIMIT * error, np.maximum(_SMALL_STEP * scale, 1e-9))
    steps = (np.abs(step) > least_step) & (stepped < curved)
    notes: list[list[str]] = [[] for _ in runs]
    for i, (run, time) in enumerate(zip(runs, windows, strict=True)):
        if steps[i].any():
            worst = int(np.argmax(np.where(steps[i], np.abs(step[i]), 0.0)))
            at = time[min((best[i, worst] + 1) * size, time.size - 1)]
            low, high = (part.mean() for part in np.split(blocks[i, worst], [best[i, worst] + 1]))
            force = np.stack([run.normal_force, run.tangential_force])
            fix = _state_rest(run, force, "average one side of the step only: cut the record there")
            notes[i].append(
                f"{run.name}: the record steps within the window, at about {at:.3g} s: {QUANTITIES[worst]} from "
                f"{low:.3g} to {high:.3g}; {fix}"
            )
        elif drifts[i].any():
            names = [name for name, drifting in zip(QUANTITIES, drifts[i], strict=False) if drifting]
            worst = int(np.argmax(np.where(drifts[i], np.abs(slope[i]), 0.0)))
            notes[i].append(
                f"{run.name}: still drifting within the window: {', '.join(names)}; {QUANTITIES[worst]} changes by "
                f"{2 * slope[i, worst]:.2g}; {_steadier(run, blocks[i, worst], zeroed)}"
            )
    return notes


def _steadier(run: LoadCellRun, blocks: Array, zeroed: bool) -> str:
    """Return advice on a drift: a shorter window if the drift decays, or else a measured zero."""
    half = _BLOCKS // 2
    early, late = (np.polyfit(np.arange(half), part, 1)[0] for part in (blocks[:half], blocks[half:]))
    if abs(late) < 0.5 * abs(early):
        return "the drift decays: give a smaller --last"
    if not (zeroed or np.isfinite(run.tare).all()):
        return "the zero may drift: give zero readings before and after the run, or rest at both ends (--rest)"
    return "stream or zero is not steady: a smaller --last does not help; check the zero readings"


def signal_notes(run: LoadCellRun, keep: NDArray[np.bool_], raw: Array) -> list[str]:
    """Return notes on gaps in the time, and on channels that are constant, clipped, repeated or have spikes.

    The channels are those in the window, shape (3, n).
    """
    notes, steps = [], np.diff(run.time[keep])
    usual = float(np.median(steps))
    if steps.max() > 5 * usual and steps.max() > 0.01 * steps.sum():
        gap = int(steps.argmax())
        notes.append(
            f"{run.name}: no samples for {steps[gap]:.3g} s at {run.time[keep][gap]:.4g} s; the others are "
            f"{usual:.3g} s apart"
        )
    count, same, dead = raw.shape[1], np.ones(raw.shape[1] - 1, dtype=bool), []
    for name, values in zip(CHANNELS, raw, strict=True):
        largest, smallest = float(values.max()), float(values.min())
        if largest == smallest:
            dead.append(f"{name} ({largest:g})")
            continue
        same &= values[1:] == values[:-1]
        for edge, inner in ((largest, values[values < largest].max()), (smallest, values[values > smallest].min())):
            at = int(np.count_nonzero(values == edge))
            next_to = int(np.count_nonzero(values == inner))
            if at >= max(_CLIPPED, _CLIPPED_SHARE * count) and at > _CLIPPED_RATIO * next_to:
                where = f"{run.name}: {name} is exactly {edge:g}"
                notes.append(f"{where} in {at} samples: is the load cell overloaded?")
        off = np.abs(values - np.median(values))
        far = np.flatnonzero(off > _SPIKE * float(np.median(off)))
        if 0 < far.size <= _RARE * count and np.median(off) > 0:
            worst = int(far[off[far].argmax()])
            notes.append(
                f"{run.name}: {name} has {far.size} spikes, the largest, {values[worst]:.3g}, at "
                f"{run.time[keep][worst]:.4g} s; drop these samples"
            )
    if dead:
        notes.append(f"{run.name}: {', '.join(dead)} never changes; is the channel connected?")
    elif same.mean() > _REPEATED:
        notes.append(f"{run.name}: {same.mean():.0%} of the samples repeat the one before; the sensor is slower")
    return notes


def stated_rest(faults: FaultList, run: LoadCellRun, spans: Spans, raw: Array, flow: Array) -> tuple[Array, Array]:
    """Return the channels' readings in intervals of rest [s] and their standard errors, shape (intervals, 3).

    An interval that is not at rest beside the mean force in the stream, `flow`, is noted.
    """
    zero, errors = np.zeros((2, len(spans), 3))
    for k, (start, end) in enumerate(spans):
        inside = (run.time >= start) & (run.time <= end)
        where = f"{run.name}, rest {start:g}:{end:g}"
        if inside.sum() < 2 * MIN_BLOCKS:
            record = f"{run.time[0]:g} to {run.time[-1]:g} s"
            rule = f"must hold at least {2 * MIN_BLOCKS} samples of the record, {record}"
            faults.add(where, f"{int(inside.sum())} samples", rule, "state longer rest, in seconds of the record")
            continue
        part = raw[:, inside]
        zero[k], errors[k] = part.mean(axis=1), standard_error(part)
        halves = [half.mean(axis=1) for half in np.array_split(part[:2], 2, axis=1)]
        change = float(np.hypot(*(halves[1] - halves[0])))
        noise = float(np.hypot(*np.diff(part[:2], axis=1).std(axis=1))) / np.sqrt(part.shape[1])
        if change > _MOVING * float(np.hypot(*(flow - zero[k, :2]))) and change > 5 * noise:
            rule = "is not at rest: the force changes within the interval"
            faults.add(where, f"{change:.2g} N", rule, "state only the time in which the fluid is still")
    return zero, errors


def zero_notes(runs: Sequence[LoadCellRun]) -> list[str]:
    """Say for how many runs the zero of the load cell is not known."""
    without = [run.name for run in runs if not np.isfinite(run.tare).all()]
    if not without:
        return []
    which = without[0] if len(runs) == 1 else f"{len(without)} of {len(runs)} runs, such as {without[0]}"
    return [
        f"{which}: zero readings are missing, so the zero is taken as 0, and what the load cell reads at rest adds "
        "to every coefficient; give tare_normal_force and so on, a record at rest (--tare), or state the rest in "
        "the record (--rest)"
    ]
