"""How a process of ours uses the machine: the cores that it may use or is pinned to, and rare garbage collection.

XLA hands a program from the calling thread to another thread, and back. By default, the system puts these threads
on different cores, so each of these changes finds cold caches: see docs/evidence/performance.md.
"""

from __future__ import annotations

import gc
import os
from contextlib import suppress


def usable_cores() -> list[int]:
    """Return the cores that this process may use; an empty list if the system does not say (outside Linux)."""
    return sorted(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else []


def core_count() -> int:
    """Return how many cores this process may use."""
    return len(usable_cores()) or os.cpu_count() or 1


def cores_of(processes: int) -> list[int | None]:
    """Return the core to which to pin each process; all None unless there is one process for every core.

    With fewer processes, two programs that each use a few cores could be pinned to the same cores.
    """
    usable = usable_cores()
    return list(usable) if len(usable) == processes else [None] * processes


def pin_to(core: int | None) -> None:
    """Pin this thread, and threads that it will start, to a core; None or a missing core changes nothing."""
    if core is not None:
        with suppress(OSError):
            os.sched_setaffinity(0, {core})


def collect_seldom() -> None:
    """Make garbage collection rare in this process, because the solver's objects rarely form cycles."""
    # So many new containers. With Python's default of 700, it would look for garbage some thousand times while a
    # program is traced, and each time go through all that JAX holds.
    gc.set_threshold(50_000)
