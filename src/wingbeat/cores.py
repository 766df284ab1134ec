"""Worker processes that keep to a core each, where they take all cores there are.

XLA hands a program from the thread that asks to another, and back. Left alone, the system puts these on different
cores, each turn finds cold caches, and two processes on two cores take 1.4 to 1.9 times as long.
"""

from __future__ import annotations

import os


def cores_of(processes: int) -> list[int | None]:
    """Return the core that each of so many processes keeps to: None where some cores would be left to others.

    Two programs at once that take a few cores each must not end up on the same few.

    >>> cores_of(1_000_000)[0] is None
    True
    """
    # Neither Windows nor macOS lets a process keep to a core.
    usable = sorted(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else []
    return list(usable) if len(usable) == processes else [None] * processes


def keep_to(core: int | None) -> None:
    """Keep this process, and the threads that it will start, to a core; None leaves it as it is."""
    if core is not None:
        os.sched_setaffinity(0, {core})
