"""The limits of the stroke: each wing stays on its own side of the body, and within the range of its shoulder.

Both depend on the wingbeat alone, so they cost no flight. Each row is the least distance from a limit: of the
strips' leading and trailing corners in each quarter of the beat, of the flap angles of arm and hand in the whole
beat. Where in the beat the distance is least does not matter to first order.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat.clearance import flap_angles, has_room, lateral_corners
from wingbeat.jax64 import jax, jnp
from wingbeat.kinematics import Wingbeat, unpack
from wingbeat.orbits.peaks import PARTS
from wingbeat.stored import stored
from wingbeat.vehicle import Vehicle

if TYPE_CHECKING:
    from wingbeat.orbits.problem import OrbitProblem

# The limit of the corners, as a name among the active bounds.
SYMMETRY = "plane_of_symmetry"
# Phases at which the least distance is looked for, and steps of Newton's method that find it between them.
# Harmonics go up to the eighth, each period of which has eight samples. One step leaves an error of 7e-5 in the
# derivative, two 1e-8.
SAMPLES, _NEWTON = 64, 2
# Corners keep this share of the wing's length off the plane of symmetry, 3 micrometres of 0.3 m: ten times what the
# search's tolerances leave open.
_ALLOWANCE = 1e-5
# Name and sign of each row's limit.
ROWS = (*[(SYMMETRY, ">=")] * 2 * PARTS, *[("flap", ">=")] * 2, *[("flap", "<=")] * 2)

_UPRIGHT = 0.5 * math.pi
# First and last sample of each quarter; a row of corners is looked for in its quarter, one of angles in the beat.
_PART = SAMPLES // PARTS
_QUARTERS = np.arange(PARTS)[:, None] * _PART + np.arange(_PART + 1)
_BEGIN = np.array([*_QUARTERS[:, 0], *_QUARTERS[:, 0], 0, 0, 0, 0]) / SAMPLES
_END = np.array([*_QUARTERS[:, -1], *_QUARTERS[:, -1], *[SAMPLES] * 4]) / SAMPLES


def _series(vehicle: Vehicle, wingbeat: Wingbeat, phase: Any, strips: int) -> Any:
    """Return what the rows are the least of: corners over the wing's length, then angles, shape (4 N + 4, K)."""
    corners = [edge / vehicle.wing.semi_span for edge in lateral_corners(vehicle, wingbeat, phase, strips)]
    angles = flap_angles(wingbeat, phase)
    return jnp.concatenate([*corners, angles, -angles])


def _places(sampled: Any, strips: int) -> tuple[Any, Any]:
    """Return which series is the least of each row, and at which sample.

    First the sample, by the least of all corners at each: XLA on CPU makes vector code of a least value, but not of
    the search for its place.
    """
    corners = sampled[: 4 * strips].reshape(2, 2 * strips, -1)
    nearest = jnp.min(corners, axis=1)[:, _QUARTERS]
    place = _QUARTERS[:, 0] + jnp.argmin(nearest, axis=-1)
    corner = jnp.argmin(jnp.take_along_axis(corners, place[:, None], axis=2), axis=1)
    series = jnp.append((2 * strips * np.arange(2)[:, None] + corner).ravel(), 4 * strips + np.arange(4))
    return series, jnp.append(place.ravel(), jnp.argmin(sampled[4 * strips :], axis=-1))


def _least(vehicle: Vehicle, wingbeat: Wingbeat, strips: int) -> Any:
    """Return each row. Series and phase are held when it is differentiated: at its least the rate by phase is 0."""
    samples = jnp.arange(SAMPLES + 1) / SAMPLES
    series, place = _places(jax.lax.stop_gradient(_series(vehicle, wingbeat, samples, strips)), strips)

    def value(at: Any) -> Any:
        return jnp.take_along_axis(_series(vehicle, wingbeat, at, strips), series[None], axis=0)[0]

    phase = place / SAMPLES
    for _ in range(_NEWTON):
        one = jnp.ones_like(phase)
        slope, bend = jax.jvp(lambda at: jax.jvp(value, (at,), (one,))[1], (phase,), (one,))  # noqa: B023
        step = jnp.where(bend > 0, -slope / jnp.where(bend > 0, bend, 1.0), 0.0)
        phase = jnp.clip(phase + jnp.clip(step, -1.0 / SAMPLES, 1.0 / SAMPLES), _BEGIN, _END)
    return value(jax.lax.stop_gradient(phase))


@stored(static=("free", "strips"), hot=True)
def least_distances(
    vehicle: Vehicle, wingbeat: Wingbeat, values: Any, *, free: tuple[str, ...], strips: int
) -> tuple[Any, Any]:
    """Return the rows and their derivative by the free parameters, now at `values`: (12,) and (12, free)."""
    rows, along = jax.linearize(lambda at: _least(vehicle, unpack(free, wingbeat, at), strips), values)
    return rows, jax.vmap(along, out_axes=1)(jnp.eye(len(free)))


class StrokeLimits:
    """How far the stroke of a problem stays inside its limits, as rows of the search.

    Where nothing that is free shapes the stroke, or wings may cross, there are none.

    Attributes
    ----------
    names : name and sign of the limit of each row.
    """

    def __init__(self, problem: OrbitProblem) -> None:
        limited = problem.shapes_stroke and not problem.wings_may_cross
        beside = has_room(problem.vehicle)
        self._kept = slice(0 if beside else 2 * PARTS, None if limited else 0)
        self.names = ROWS[self._kept]
        self._free = len(problem.free)
        if not limited:
            return
        beat, strips = problem.species.wingbeat, problem.aero.strips
        self._rows = least_distances.bind(problem.vehicle, beat, free=problem.free, strips=strips)
        low, high = problem.bounds["flap"] if beside else np.clip(problem.bounds["flap"], -_UPRIGHT, _UPRIGHT)
        self._limits = np.array([*[_ALLOWANCE] * 2 * PARTS, low, low, -high, -high])

    def margins(self, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return how far inside its limit each row is, and the derivative by the free parameters.

        Corners are in wing lengths, flap angles in radians.
        """
        if not self.names:
            return np.zeros(0), np.zeros((0, self._free))
        rows, jacobian = self._rows(np.ascontiguousarray(values))
        return (rows - self._limits)[self._kept], jacobian[self._kept]
