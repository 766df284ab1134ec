"""Rare garbage collection in wingbeat's own processes."""

from __future__ import annotations

import gc

# Number of new containers after which Python looks for garbage. With Python's default of 700, it would look some
# thousand times while a program is traced, and each time go through all that JAX holds.
_SELDOM = 50_000


def collect_seldom() -> None:
    """Make garbage collection rare in this process, because the solver's objects rarely form cycles."""
    gc.set_threshold(_SELDOM)
