"""How strips move through the air: axes of their sections, speeds, turning and acceleration."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from wingbeat_evidence.measured_motion.slopes import smoothed_slopes
from wingbeat_evidence.measured_motion.strip_case import StripCase, strip_widths

Array = NDArray[np.float64]

# Strips farther apart than this many of their widths belong to two wings.
_APART = 3.0
# A line shorter than this share of the widths has no direction.
_SHORT = 1e-6


@dataclass(frozen=True)
class StripMotion:
    """The motion of strips through still air.

    Attributes
    ----------
    chord, width : of the strips [m], shape (n, strips).
    ahead, normal : unit vectors, shape (n, strips, 3): `ahead` along the chord to the leading edge, `normal` across
        the chord to the upper side.
    outward : unit vector along the span, to the left, shape (n, strips, 3).
    velocity : of the quarter chord [m/s], shape (n, strips, 3).
    chord_speed, normal_speed : of the quarter chord along `ahead` and `normal` [m/s], shape (n, strips).
    turning : of the chord about the span, leading edge up [rad/s], shape (n, strips).
    turning_rate : rate of change of `turning` [rad/s2].
    middle_rate : rate of change of the normal speed of the mid-chord [m/s2].
    notes : notes for the reader.
    """

    chord: Array
    width: Array
    ahead: Array
    normal: Array
    outward: Array
    velocity: Array
    chord_speed: Array
    normal_speed: Array
    turning: Array
    turning_rate: Array
    middle_rate: Array
    notes: tuple[str, ...]

    def in_moving_air(self, case: StripCase, air: tuple[float, float]) -> StripMotion:
        """Return the motion of the strips through air whose velocity, forward and up, is constant [m/s]."""
        wind = np.array([air[0], 0.0, air[1]])
        # The wind is constant; its component along the wing's normal changes as the normal turns.
        change = smoothed_slopes(case.times, self.normal @ wind, case.frequency, case.period)[1]
        return replace(
            self,
            chord_speed=self.chord_speed - self.ahead @ wind,
            normal_speed=self.normal_speed - self.normal @ wind,
            middle_rate=self.middle_rate - change,
        )


class _Sections(NamedTuple):
    ahead: Array
    outward: Array
    normal: Array


def strip_motion(case: StripCase) -> StripMotion:
    """Return how the strips of a case move through still air.

    If the case gives no velocities of the quarter chord, they are computed as the rates of change of its
    positions. If these positions do not advance with the animal, as in a wind tunnel, the flight speed is added.
    If the case gives no velocities of the three-quarter chord, the chord's turning is the rate of change of its
    direction.

    Parameters
    ----------
    case : the measured motion.
    """
    chord, width = strip_widths(case.chord, case.area)
    sections = _sections(case, chord, width)
    velocity, notes = _velocity(case)
    normal_speed = _dot(velocity, sections.normal)
    if case.rear_velocity is not None:
        turning = (normal_speed - _dot(case.rear_velocity, sections.normal)) / (0.5 * chord)
    else:
        change = smoothed_slopes(case.times, case.chord, case.frequency, case.period)[1]
        turning = _dot(change, sections.normal) / chord
    middle = normal_speed - 0.25 * chord * turning
    both = np.stack([middle, chord * turning])
    rates = smoothed_slopes(case.times, np.moveaxis(both, 0, 1), case.frequency, case.period)[1]
    return StripMotion(
        chord=chord,
        width=width,
        ahead=sections.ahead,
        normal=sections.normal,
        outward=sections.outward,
        velocity=velocity,
        chord_speed=_dot(velocity, sections.ahead),
        normal_speed=normal_speed,
        turning=turning,
        turning_rate=rates[:, 1] / chord,
        middle_rate=rates[:, 0],
        notes=notes,
    )


def semi_span(case: StripCase) -> float:
    """Return how far the wings reach to one side [m]: to the outer end of the farthest strip.

    Parameters
    ----------
    case : the measured motion.
    """
    chord, width = strip_widths(case.chord, case.area)
    outward = _sections(case, chord, width).outward[..., 1]
    side = case.position[..., 1]
    half = 0.5 * width * np.abs(outward)
    if case.mirrored:
        return float((np.abs(side) + half).max())
    return float(0.5 * ((side + half).max() - (side - half).min()))


def moves_down(case: StripCase, motion: StripMotion) -> NDArray[np.bool_]:
    """Return at which times the wings are in the downstroke, shape (n,); for a level stroke, in the forward stroke.

    The downstroke is the half of the beat in which the farthest strip moves down along the line of its largest
    motion.

    Parameters
    ----------
    case : the measured motion.
    motion : of its strips through still air.
    """
    farthest = int(np.abs(case.position[..., 1]).max(axis=0).argmax())
    moving = motion.velocity[:, farthest] - case.mean(motion.velocity[:, farthest])
    line = np.linalg.svd(moving[case.inside], full_matrices=False)[2][0]
    down = line if 0.3 * line[0] - line[2] >= 0 else -line
    return moving @ down > 0


def _dot(first: Array, second: Array) -> Array:
    return (first * second).sum(-1)


def _velocity(case: StripCase) -> tuple[Array, tuple[str, ...]]:
    """Return the velocities of the quarter chords through still air [m/s], and notes for the reader."""
    if case.velocity is not None:
        mean = float(case.mean(case.velocity[..., 0] @ _shares(case)))
        if case.speed > 0 and abs(mean) < abs(mean - case.speed):
            note = (
                f"the given velocities are {mean:.2g} m/s forward on average, but the speed is {case.speed:g} m/s"
            )
            return case.velocity, (f"{note}: are they velocities through still air?",)
        return case.velocity, ()
    times = case.times[:, None]
    span = case.times - case.times.mean()
    forward = case.position[..., 0] @ _shares(case)
    advance = float(span @ (forward - forward.mean()) / (span @ span))
    moves = abs(advance - case.speed) < abs(advance)
    # Positions that advance do not repeat. Without the advance they repeat, so that the beat can be continued.
    drift = np.zeros(3) if not moves else np.array([case.speed, 0.0, 0.0])
    at_rest = case.position - times[..., None] * drift
    rates = smoothed_slopes(case.times, at_rest, case.frequency, case.period)[1]
    frame = "advance with the animal" if moves else "do not advance, so the speed is added, as in a wind tunnel"
    notes = ("velocities are computed from the positions" + (f", which {frame}" if case.speed > 0 else ""),)
    return rates + np.array([case.speed, 0.0, 0.0]), notes


def _shares(case: StripCase) -> Array:
    """Return the share of each strip in the wings' area."""
    areas = case.area.mean(axis=0)
    return areas / areas.sum()


def _sections(case: StripCase, chord: Array, width: Array) -> _Sections:
    """Return the axes of the sections: along the chord, along the span, and across both, to the upper side.

    The span is the line of quarter chords minus the component of this line along the chord. If a wing has a single
    strip, the span points to the side. On both wings the span runs to the left, so that the normal points to the
    upper side.
    """
    ahead = case.chord / chord[..., None]
    outward = np.zeros_like(ahead)
    for first, end in wing_ranges(case, ahead, width):
        line = case.position[:, first:end]
        along = np.gradient(line, axis=1) if end - first > 1 else np.zeros_like(line)
        along = along - _dot(along, ahead[:, first:end])[..., None] * ahead[:, first:end]
        leftward = along[..., 1].sum() >= 0
        outward[:, first:end] = along if leftward else -along
    size = np.sqrt(_dot(outward, outward))
    left = np.array([0.0, 1.0, 0.0])
    aside = left - ahead[..., 1:2] * ahead
    lost = size < _SHORT * width
    outward = np.where(lost[..., None], aside, outward)
    size = np.sqrt(_dot(outward, outward))
    # A chord that points straight to the side has no span by this rule, and no load.
    outward = outward / np.where(size > 0, size, 1.0)[..., None]
    return _Sections(ahead, outward, np.cross(ahead, outward))


def wing_ranges(case: StripCase, ahead: Array, width: Array) -> list[tuple[int, int]]:
    """Return for each wing its first strip and the strip after its last.

    Strips of a wing lie side by side, run one way, and are on one side of the body.
    """
    steps = np.diff(case.position, axis=1)
    middle = 0.5 * (ahead[:, :-1] + ahead[:, 1:])
    steps = steps - _dot(steps, middle)[..., None] * middle
    apart = np.median(np.sqrt(_dot(steps, steps)) / (0.5 * (width[:, :-1] + width[:, 1:])), axis=0)
    back = np.append(False, np.median(_dot(steps[:, 1:], steps[:, :-1]), axis=0) < 0)
    left = np.median(case.position[..., 1], axis=0) > 0
    other_side = (left[1:] != left[:-1]) & (not case.mirrored)
    starts = [0]
    for i in range(len(apart)):
        # The first step within a wing has no earlier step whose direction it could reverse.
        if apart[i] > _APART or other_side[i] or (back[i] and i != starts[-1]):
            starts.append(i + 1)
    return list(zip(starts, [*starts[1:], case.area.shape[1]], strict=True))
