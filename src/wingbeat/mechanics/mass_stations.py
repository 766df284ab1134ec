"""From masses that a builder weighed, at places along and across a wing, to its strips."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from wingbeat._jax.arrays import jnp

if TYPE_CHECKING:
    from wingbeat._jax.arrays import PerStrip, PerStripBroadcast, Stations
    from wingbeat.animal.vehicle import Wing


class Strips(NamedTuple):
    """Numbers of one wing's strips that are constant in time, shape (N,), or (N, 1, ...) to match axes of time."""

    span_fraction: PerStripBroadcast  # distance of the strip's centre from the shoulder over the semi-span
    chord: PerStripBroadcast  # [m]
    mass: PerStripBroadcast  # [kg]
    # Of a table of masses: how far centres of mass are behind the quarter chords [m], and the squared radius of
    # gyration about them [m2]; None if the wing's own numbers give them.
    behind: PerStripBroadcast | None = None
    gyration: PerStripBroadcast | None = None


def from_stations(wing: Wing, span_fraction: PerStrip, chord: PerStrip, there: Stations) -> Strips:
    """Return the strips of a wing with a table of masses.

    `there` is the chord at the stations. Kept are mass, first and second moment along the span, and about the axis
    of pitch the static moment, its moment along the span, and the inertia.

    Theory: equations ``station-lever``, ``station-mass`` and ``station-chord``.
    """
    count, place = span_fraction.size, jnp.asarray(wing.mass_stations, dtype=float)
    share = jnp.asarray(wing.station_masses, dtype=float)
    share = share / jnp.sum(share)
    # Each mass goes to the two nearest strips as a lever would; beyond the last centres, to the last strip.
    lever = jnp.clip(place * count - 0.5, 0.0, count - 1.0) - jnp.arange(count)[:, None]
    lever = jnp.maximum(1.0 - jnp.abs(lever), 0.0)
    near = lever @ share
    # Polynomials that are orthogonal over these masses bring both moments to the table's.
    middle = jnp.sum(near * span_fraction)
    away, out = span_fraction - middle, place - middle
    spread, skew = jnp.sum(near * away**2), jnp.sum(near * away**3)
    bend, bent = (x**2 - skew / spread * x - spread for x in (away, out))
    tilt = jnp.sum(share * out) / spread * away
    of_strip = near * (1.0 + tilt + jnp.sum(share * bent) / jnp.sum(near * bend**2) * bend)

    axis, radius = (
        (whole if column is None else jnp.asarray(column, dtype=float)) + jnp.zeros_like(share)
        for whole, column in (
            (wing.mass_axis, wing.station_axes),
            (wing.mass_gyration, wing.station_gyrations),
        )
    )
    axis = axis - wing.pitch_axis
    weight = lever * share / jnp.where(near > 0, near, 1.0)[:, None]
    mean = weight @ axis
    gyration = chord**2 * jnp.maximum(weight @ (axis**2 + radius**2) - mean**2, 0.0)
    behind, behind_there = chord * mean, axis * there
    # A straight line brings the static moments to the table's.
    behind = behind + jnp.sum(share * behind_there) - jnp.sum(of_strip * behind)
    middle = jnp.sum(of_strip * span_fraction)
    away, out = span_fraction - middle, place - middle
    missing = jnp.sum(share * behind_there * out) - jnp.sum(of_strip * behind * away)
    behind = behind + missing / jnp.sum(of_strip * away**2) * away
    inertia = jnp.sum(share * (behind_there**2 + (radius * there) ** 2))
    # A common part that is added, or factor below 1, brings the inertia to the table's.
    own = jnp.sum(of_strip * gyration)
    missing = inertia - jnp.sum(of_strip * behind**2) - own
    less = gyration * jnp.maximum(1.0 + missing / jnp.where(own > 0, own, 1.0), 0.0)
    gyration = jnp.where(missing > 0, gyration + missing, less)
    behind = behind + (wing.pitch_axis - 0.25) * chord
    return Strips(span_fraction, chord, wing.mass * of_strip, behind, gyration)
