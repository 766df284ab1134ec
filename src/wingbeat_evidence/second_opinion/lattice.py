"""The wings as a lattice of panels at every step of some beats, and the sums of the forces on the panels."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from wingbeat._base import FaultList
from wingbeat._jax.arrays import unchecked
from wingbeat.aero.blade_element import BladeElement
from wingbeat.aero.coefficient_model import CoefficientModel
from wingbeat_evidence.second_opinion.motion import Motion
from wingbeat_evidence.second_opinion.own_loads import WingLoads

_LARGEST = 0.5  # angle at which lift is looked for [rad]
_CLOSE = 0.02  # of the semi-span: roots nearer to the plane of symmetry leave no room for panels across the body


@dataclass(frozen=True)
class LatticeOptions:
    """The resolution of the lattice, and the number of beats that it flies.

    For extrapolation, a lattice with half as many panels and steps is flown too, so numbers of panels and steps are
    even. The page `docs/evidence/second_opinion.md` has the convergence study behind the defaults.

    Parameters
    ----------
    chordwise : number of panels along the chord.
    spanwise : number of panels along the span of one wing.
    steps : number of time steps of a beat.
    beats : number of beats flown from rest. The loads of the last beat are used; the wake of all beats is kept.

    Raises
    ------
    InvalidInputError : a number that is odd or out of range.

    >>> LatticeOptions(beats=3).halved
    LatticeOptions(chordwise=2, spanwise=6, steps=24, beats=3)
    """

    chordwise: int = 4
    spanwise: int = 12
    steps: int = 48
    beats: int = 2

    def __post_init__(self) -> None:
        faults = FaultList()
        for name, least, most in (("chordwise", 2, 40), ("spanwise", 2, 80), ("steps", 16, 1000)):
            value = getattr(self, name)
            if faults.whole(name, value, least, most) and value % 2:
                faults.add(name, value, "must be even", "a second lattice, with half this number, is flown too")
        faults.whole("beats", self.beats, 2, 20, "the first beat starts from rest and is never compared")
        faults.raise_if_any()

    @property
    def halved(self) -> LatticeOptions:
        """The lattice with half as many panels and steps."""
        half = {name: getattr(self, name) // 2 for name in ("chordwise", "spanwise", "steps")}
        return unchecked(LatticeOptions, half | {"beats": self.beats})


def no_lift_angle(coefficients: CoefficientModel) -> float:
    """Return the angle of attack nearest 0 at which lift rises through zero [rad]; 0 if there is none.

    >>> from wingbeat.aero import Membrane
    >>> round(float(np.degrees(no_lift_angle(Membrane()))), 1)
    -9.2
    """
    alpha = np.linspace(-_LARGEST, _LARGEST, 1001)
    lift = coefficients.lift(alpha)
    below = np.flatnonzero((lift[:-1] < 0) & (lift[1:] >= 0))
    found = alpha[below] - lift[below] * np.diff(alpha)[below] / np.diff(lift)[below]
    return float(min(found, key=abs, default=0.0))


def _turned_up(points: np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Return points of the left wing, turned nose-up about its quarter-chord line by an angle of each station."""
    chord = points[:, :1] - points[:, -1:]
    quarter = 0.75 * points[:, :1] + 0.25 * points[:, -1:]
    normal = np.cross(chord, np.gradient(quarter, axis=2))
    normal *= np.linalg.norm(chord, axis=-1, keepdims=True) / np.linalg.norm(normal, axis=-1, keepdims=True)
    ahead = np.linspace(0.25, -0.75, points.shape[1])[:, None, None]
    return points + ahead * ((np.cos(angle) - 1.0)[:, None] * chord + np.sin(angle)[:, None] * normal)


def lattice_of(
    motion: Motion, options: LatticeOptions, phase: np.ndarray, aero: BladeElement | None = None
) -> np.ndarray:
    """Return the corners of the panels of both wings [m], shape (K, C + 1, 2 S + 1 or 2, 3).

    Corners run from leading to trailing edge and from the left tip to the right tip, in axes that fly at the mean
    velocity (x forward, y left, z up). Every corner is a point of the wing that our strips describe. A column of
    panels across the body joins the wings, so that no vortex ends at their roots. Our loads have nothing to compare
    with this column, so `sum_of_panels` leaves it out. If the roots come too close to the plane of symmetry for
    this column, their points are moved along y into the plane.

    Parameters
    ----------
    motion : of the wings.
    options : the numbers of panels.
    phase : phases of any beat, shape (K,).
    aero : our loads. Flat panels have no camber, so each is turned nose-up until it is without lift where our
        polar is. Not turned if not given.
    """
    along = np.linspace(0.0, 1.0, options.spanwise + 1)
    down = np.linspace(0.0, 1.0, options.chordwise + 1)
    left = motion.wing(phase, along, down)
    if aero is not None:
        angles = [-no_lift_angle(part.coefficients) for part in aero.parts]
        left = _turned_up(left, np.where(along > aero.hand_from, angles[-1], angles[0]))
    joined = left[:, :, 0, 1].min() < _CLOSE * motion.vehicle.wing.semi_span
    if joined:
        left[:, :, 0, 1] = 0.0
    right = left * np.array([1.0, -1.0, 1.0])
    return np.concatenate([left[:, :, ::-1], right[:, :, 1:] if joined else right], axis=2)


def panel_velocities(
    corners: np.ndarray, step: float, velocity: tuple[float, float]
) -> tuple[np.ndarray, np.ndarray]:
    """Return every panel's velocity through still air [m/s] and turning rate [rad/s], shape (K, C, S, 3) each.

    Parameters
    ----------
    corners : of the panels over one whole beat, in axes that fly at the mean velocity, shape (K, C + 1, S + 1, 3).
    step : between two samples [s].
    velocity : of these axes, forward and up [m/s].
    """
    frequencies = np.fft.rfftfreq(len(corners), step)
    spectrum = np.fft.rfft(corners, axis=0) * (2j * np.pi * frequencies[:, None, None, None])
    if len(corners) % 2 == 0:
        spectrum[-1] = 0.0  # a wave with a period of two samples has zero slope at the samples
    rates = np.fft.irfft(spectrum, len(corners), axis=0)
    chord, chord_rate = (_mean_of_neighbours(a[:, 1:] - a[:, :-1], 2) for a in (corners, rates))
    span = _mean_of_neighbours(corners[:, :, 1:] - corners[:, :, :-1], 1)
    axis = span / np.linalg.norm(span, axis=-1, keepdims=True)
    # Only the turning of the chord about the span, because the couple of a panel has no other component.
    turned = np.sum(np.cross(axis, chord) * chord_rate, axis=-1) / np.sum(chord * chord, axis=-1)
    centre = _mean_of_neighbours(_mean_of_neighbours(rates, 1), 2)
    return centre + np.array([velocity[0], 0.0, velocity[1]]), turned[..., None] * axis


def panel_centres(corners: np.ndarray) -> np.ndarray:
    """Return the centres of panels [m], shape (K, C, S, 3)."""
    return _mean_of_neighbours(_mean_of_neighbours(corners, 1), 2)


def sum_of_panels(
    spanwise: int,
    corners: np.ndarray,
    step: float,
    velocity: tuple[float, float],
    force: np.ndarray,
    moment: np.ndarray,
) -> WingLoads:
    """Add up the forces on the panels of the wings over one whole beat.

    Parameters
    ----------
    spanwise : panels along the span of one wing, S; the panels across the body are left out.
    corners, step, velocity : as in `panel_velocities`.
    force : on the panels [N], shape (K, C, S, 3).
    moment : of these forces about the origin of the corners [N m], shape (K, C, S, 3).
    """
    speed, turning = panel_velocities(corners, step, velocity)
    couple = moment - np.cross(panel_centres(corners), force)
    of_wings = np.r_[:spanwise, -spanwise:0]
    power = -np.sum((force * speed + couple * turning)[:, :, of_wings], axis=(1, 2, 3))
    force = force[:, :, of_wings]
    thrust, lift = (np.sum(force[..., axis], axis=(1, 2)) for axis in (0, 2))
    return WingLoads(thrust, lift, power)


def _mean_of_neighbours(values: np.ndarray, axis: int) -> np.ndarray:
    first, second = (np.take(values, range(i, values.shape[axis] - 1 + i), axis) for i in (0, 1))
    return 0.5 * (first + second)
