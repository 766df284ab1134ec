"""How close a stroke comes to its limits: the plane of symmetry, and the range of the shoulder.

The distances depend on the wingbeat alone. A flight returns them as rows: each row is the least distance from a
limit. The strips' leading and trailing corners have a row for each quarter of the beat; the flap angles of arm and
hand have rows for the whole beat. The phase of the least distance does not matter to first order.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._jax.arrays import jax, jnp
from wingbeat.animal.kinematics import Wingbeat
from wingbeat.animal.vehicle import Vehicle
from wingbeat.mechanics.clearance import LEADING, TRAILING, flap_angles, lateral_corner, lateral_corners
from wingbeat.mechanics.wing_motion import strips_of
from wingbeat.mechanics.wing_shape import Strips
from wingbeat.orbits.flight.path_maxima import PARTS

if TYPE_CHECKING:
    from wingbeat._jax.arrays import Samples, StrokeIndices, StrokeRows, StrokeSeries


# Name of the corners' limit among the active bounds.
SYMMETRY = "plane_of_symmetry"
# Number of sampled phases, and of steps of Newton's method from the least sample to the minimum. The eighth and
# highest harmonic has eight samples in each period. One step leaves an error of 7e-5 in the derivative,
# two steps leave 1e-8.
_SAMPLES, _NEWTON = 64, 2
# Name and sign of each row's limit.
ROWS = (*[(SYMMETRY, ">=")] * 2 * PARTS, *[("flap", ">=")] * 2, *[("flap", "<=")] * 2)

# Phases between which the minimum of each row is sought: for corners a quarter of the beat, for angles the whole
# beat.
_BEGIN = np.array([*np.tile(np.arange(PARTS) / PARTS, 2), *[0.0] * 4])
_END = np.array([*np.tile((np.arange(PARTS) + 1) / PARTS, 2), *[1.0] * 4])


def _series(vehicle: Vehicle, wingbeat: Wingbeat, phase: Samples, strips: int) -> StrokeSeries:
    """Return the series whose minima are the rows: corner distances in wing lengths, and angles; (4 N + 4, K)."""
    corners = [edge / vehicle.wing.semi_span for edge in lateral_corners(vehicle, wingbeat, phase, count=strips)]
    angles = flap_angles(wingbeat, phase)
    return jnp.concatenate([*corners, angles, -angles])


def _places(sampled: StrokeSeries, strips: int) -> tuple[StrokeIndices, StrokeIndices]:
    """Return, for each row, the index of the series with the least value, and the index of that sample.

    The sample is found first, from the minimum over all corners at each phase. XLA on CPU vectorises a minimum, but
    not the search for its index.
    """
    part = (sampled.shape[1] - 1) // PARTS
    quarters = np.arange(PARTS)[:, None] * part + np.arange(part + 1)
    corners = sampled[: 4 * strips].reshape(2, 2 * strips, -1)
    nearest = jnp.min(corners, axis=1)[:, quarters]
    place = quarters[:, 0] + jnp.argmin(nearest, axis=-1)
    corner = jnp.argmin(jnp.take_along_axis(corners, place[:, None], axis=2), axis=1)
    series = jnp.append((2 * strips * np.arange(2)[:, None] + corner).ravel(), 4 * strips + np.arange(4))
    return series, jnp.append(place.ravel(), jnp.argmin(sampled[4 * strips :], axis=-1))


def least_distances(vehicle: Vehicle, wingbeat: Wingbeat, strips: int) -> StrokeRows:
    """Return the least distance of each row, shape (12,).

    Derivatives are computed at a fixed corner and phase. They are exact, because the derivative by phase is 0 at a
    minimum.
    """
    samples = jnp.arange(_SAMPLES + 1) / _SAMPLES
    series, place = _places(jax.lax.stop_gradient(_series(vehicle, wingbeat, samples, strips)), strips)
    phase = place / _SAMPLES
    trailing, corner = jnp.divmod(series[: 2 * PARTS], 2 * strips)
    outer, strip = jnp.divmod(corner, strips)
    of_corners = Strips(*(a[strip] for a in strips_of(vehicle.wing, strips)))

    def distance(at: Samples) -> Samples:
        share, side = jnp.where(trailing, TRAILING, LEADING), 2.0 * outer - 1.0
        return lateral_corner(vehicle, wingbeat, of_corners, share, side, at, strips) / vehicle.wing.semi_span

    def angle(at: Samples) -> Samples:
        angles = flap_angles(wingbeat, at)
        return jnp.stack([angles[0, 0], angles[1, 1], -angles[0, 2], -angles[1, 3]])

    corners = slice(2 * PARTS)
    angles = slice(2 * PARTS, None)
    return jnp.concatenate([_at_least(distance, phase, corners), _at_least(angle, phase, angles)])


def _at_least(value: Callable[[Any], Any], phase: StrokeRows, rows: slice) -> Samples:
    """Return the minima of some rows, by Newton's method from the phases of the least samples."""
    phase = phase[rows]
    for _ in range(_NEWTON):
        one = jnp.ones_like(phase)
        slope, bend = jax.jvp(lambda at: jax.jvp(value, (at,), (one,))[1], (phase,), (one,))  # noqa: B023
        step = jnp.where(bend > 0, -slope / jnp.where(bend > 0, bend, 1.0), 0.0)
        phase = jnp.clip(phase + jnp.clip(step, -1.0 / _SAMPLES, 1.0 / _SAMPLES), _BEGIN[rows], _END[rows])
    return value(jax.lax.stop_gradient(phase))
