"""Rare garbage collection in wingbeat's own processes."""

from __future__ import annotations

import gc

# Containers made before a look; Python's own 700 come together some thousand times while a program is traced, and
# each look goes through what JAX holds.
_SELDOM = 50_000


def collect_seldom() -> None:
    """Make garbage collection rare in this process, because the solver's objects rarely form cycles."""
    gc.set_threshold(_SELDOM)
