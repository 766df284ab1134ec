"""Sums over the strips of a wing, which are the first axis."""

from __future__ import annotations

import functools
import operator
from collections.abc import Sequence
from typing import TYPE_CHECKING

from wingbeat._jax.arrays import jnp

if TYPE_CHECKING:
    from wingbeat._jax.arrays import PerStrip, PerStripBroadcast, Phases, Sums


_FEW_STRIPS = 32


def sum_over_strips(a: PerStrip) -> Phases:
    """Return the sum over the strips.

    At most 32 strips are added one by one, because XLA, JAX's compiler, can vectorise this on a CPU.
    """
    if a.shape[0] > _FEW_STRIPS:
        return jnp.sum(a, axis=0)
    return functools.reduce(operator.add, [a[i] for i in range(a.shape[0])])


def mass_moments(mass: PerStripBroadcast | float, rows: Sequence[PerStrip]) -> Sums:
    """Return the sums over the strips of each row times the strips' mass, shape (rows, ...).

    A single sum for all rows compiles in a third of the time that one sum per row needs.
    """
    return sum_over_strips(jnp.stack([mass * row for row in rows], axis=1))
