"""Hinge torques that drive the wings of a flight, as splines.

Flights with as many knots and times as each other share one compiled program.
"""

from wingbeat._jax.arrays import jnp

# Pieces of a beat, and how many of them lie between two of the times asked for.
KNOTS, BETWEEN = 2048, 128


def spline_torques(time, spline):
    """Return the hinge torques at a time from the pieces of cubic splines (4, pieces, 2) over knots."""
    knots, pieces = spline
    i = jnp.clip(jnp.searchsorted(knots, time, side="right") - 1, 0, pieces.shape[1] - 1)
    a, b, c, d = pieces[:, i]
    rest = time - knots[i]
    return ((a * rest + b) * rest + c) * rest + d
