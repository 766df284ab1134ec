"""The measured motion of a wing as strips through time, with the forces that were measured at the same time."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import FaultList
from wingbeat_evidence.measured_motion.strip_checks import check_arrays, check_measured, check_scalars, check_window

Array = NDArray[np.float64]

WINGS = ("feathered", "membrane", "rigid")
AXES = ("fx", "fz")
# Tolerance of whole beats, as a share of the beat and of the widest step.
_SLACK = 0.02


def _no_arrays() -> Mapping[str, Array]:
    return {}


@dataclass(frozen=True)
class StripCase:
    """A flight whose wings were measured strip by strip, and the forces on the animal or robot.

    Axes are those of still air: x forward, y left, z up.

    Parameters
    ----------
    name : of the case.
    mass : of the animal or robot [kg].
    density : of the air [kg/m3].
    gravity : [m/s2].
    frequency : wingbeats per second [Hz].
    speed : forward speed through the air [m/s].
    mirrored : whether the strips are those of one side (one wing, or fore and hind wing), and the other side is its
        mirror image.
    periodic : whether the motion repeats after the last time; the times then cover whole beats.
    times : of the measurement, rising [s], shape (n,).
    position : of the quarter chord of each strip [m], shape (n, strips, 3).
    chord : from the trailing to the leading edge [m], shape (n, strips, 3).
    area : of each strip [m2], shape (n, strips).
    velocity : of the wing's material at the quarter chord through still air [m/s], shape (n, strips, 3); if None,
        it is computed from the positions.
    rear_velocity : the same at the three-quarter chord [m/s]; if None, the chord's rate of turning is computed
        from `chord`.
    forces : any of "fx" (forward) and "fz" (up), of the whole animal [N], shape (n,); NaN where not measured.
    errors : the standard errors of `forces` [N], shape (n,).
    mean_force : mean forward and upward force [N], in place of `forces`.
    start, end : first and last time at which forces are compared [s]; None for those of `times`.
    wing : "feathered", "membrane" or "rigid"; None if unknown.
    title : what was measured and by whom, in words for figures; empty for the name.

    Attributes
    ----------
    notes : notes for the reader.

    Raises
    ------
    InvalidInputError : numbers that are missing, not finite or out of range, arrays of the wrong shape, times that
        do not rise or leave gaps, chords of zero length, both or neither of `forces` and `mean_force`.

    >>> import wingbeat_evidence as evidence
    >>> case = evidence.read_strip_case(evidence.shipped_cases()[-1])
    >>> case.name, case.position.shape[1:], round(case.weight, 3)
    ('flapper-yeo2011', (20, 3), 0.071)
    """

    name: str
    mass: float
    density: float
    gravity: float
    frequency: float
    speed: float
    mirrored: bool
    periodic: bool
    times: Array
    position: Array
    chord: Array
    area: Array
    velocity: Array | None = None
    rear_velocity: Array | None = None
    forces: Mapping[str, Array] = field(default_factory=_no_arrays)
    errors: Mapping[str, Array] = field(default_factory=_no_arrays)
    mean_force: tuple[float, float] | None = None
    start: float | None = None
    end: float | None = None
    wing: str | None = None
    title: str = ""
    notes: tuple[str, ...] = field(default=(), init=False)

    def __post_init__(self) -> None:
        for name in MOTION:
            if getattr(self, name) is not None:
                object.__setattr__(self, name, as_array(getattr(self, name)))
        faults = FaultList()
        check_scalars(faults, {name: getattr(self, name) for name in SCALARS}, lambda name: name)
        if self.wing is not None:
            faults.choice("wing", self.wing, WINGS)
        faults.raise_if_any()
        check_arrays(faults, self.arrays(), self.frequency, _place)
        faults.raise_if_any()
        check_window(faults, self.times, self.start, self.end, lambda name: name)
        faults.raise_if_any()
        check_measured(faults, self)
        faults.raise_if_any()
        object.__setattr__(self, "notes", tuple(self._notes()))

    def arrays(self) -> dict[str, Array | None]:
        """Return the arrays of the motion by name."""
        return {name: getattr(self, name) for name in MOTION}

    @property
    def weight(self) -> float:
        """Weight of the animal or robot [N]."""
        return self.mass * self.gravity

    @property
    def inside(self) -> NDArray[np.bool_]:
        """Which of the times are compared, shape (n,)."""
        first = self.times[0] if self.start is None else self.start
        last = self.times[-1] if self.end is None else self.end
        slack = 1e-9 * (self.times[-1] - self.times[0])
        return (self.times >= first - slack) & (self.times <= last + slack)

    @property
    def period(self) -> float | None:
        """Time after which the motion repeats [s]; None if it does not, or the times do not cover whole beats."""
        covered = self.times[-1] - self.times[0]
        whole = max(round(covered * self.frequency), 1) / self.frequency
        gap = whole - covered
        widest = float(np.diff(self.times).max()) * (1 + _SLACK) + _SLACK / self.frequency
        return whole if self.periodic and -_SLACK / self.frequency <= gap <= widest else None

    def weights(self) -> Array:
        """Return the weights of the times in a mean over the compared time, shape (n,), by the trapezoidal rule."""
        steps = np.diff(self.times)
        here = self.inside
        if self.period is not None and here.all():
            wrap = max(self.period - (self.times[-1] - self.times[0]), 0.0)
            steps = np.append(steps, wrap)
            shares = 0.5 * (steps + np.roll(steps, 1))
        else:
            between = np.where(here[:-1] & here[1:], steps, 0.0)
            shares = 0.5 * (np.append(between, 0.0) + np.append(0.0, between))
        return shares / shares.sum()

    def mean(self, values: Array) -> Array:
        """Return the mean of values over the compared time, along the first axis.

        Parameters
        ----------
        values : shape (n, ...).
        """
        weights, here = self.weights(), self.inside
        return np.tensordot(weights[here], values[here], axes=1)

    def _notes(self) -> list[str]:
        notes = []
        covered = float(np.ptp(self.times[self.inside])) * self.frequency
        if self.periodic and self.period is None:
            beats = float(np.ptp(self.times)) * self.frequency
            rule = "not a whole number: the motion counts as not periodic"
            notes.append(f"the times cover {beats:.2f} beats, {rule}")
        whole = self.period is not None and bool(self.inside.all())
        if not whole and self.mean_force is not None and abs(covered - round(covered)) > 0.1:
            notes.append(f"{covered:.2f} beats are compared, so the computed mean is not that of whole beats")
        if self.density > 10:
            notes.append("the fluid is not air, but the Reynolds number is computed with the viscosity of air")
        return notes


SCALARS = ("mass", "density", "gravity", "frequency", "speed", "mirrored", "periodic", "name")
MOTION = ("times", "position", "chord", "area", "velocity", "rear_velocity")


def _place(name: str, index: tuple[int, ...]) -> str:
    """Return the place of an array's element as Python would write it."""
    return f"{name}[{', '.join(map(str, index))}]" if index else name


def strip_widths(chord: Array, area: Array) -> tuple[Array, Array]:
    """Return the length of the chords and the widths of strips of these areas [m].

    Parameters
    ----------
    chord : vectors [m], shape (..., 3).
    area : [m2], shape (...).

    >>> [float(value) for value in strip_widths(np.array([0.0, 0.3, 0.4]), np.array(0.1))]
    [0.5, 0.2]
    """
    length = np.sqrt((chord * chord).sum(-1))
    return length, area / length


def as_array(values: Any) -> Array:
    """Return numbers as a float64 array, or a single NaN if the values are not numbers."""
    try:
        return np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        return np.array(math.nan)
