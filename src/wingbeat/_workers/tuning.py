"""How a process of ours uses the machine: how many cores it may, one thread for XLA, rare garbage collection.

XLA hands parts of a program from the calling thread to its own threads, and back. The system puts these on
different cores, so each change finds cold caches, and on a busy machine it waits: see docs/evidence/performance.md.
"""

from __future__ import annotations

import gc
import os


def core_count() -> int:
    """Return how many cores this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def tune_process() -> None:
    """Have XLA compute in the thread that calls it, and make garbage collection rare; for processes of our own.

    A variable `PJRT_NPROC` or `NPROC` of the user's, who thereby chooses XLA's number of threads, stays as it is.
    """
    # Not in the user's Python: there it would slow the user's own JAX programs, which may need many cores. JAX
    # reads the variable when it first computes. With two threads an orbit takes a tenth more of the processor, and
    # where four such processes share two cores, three times as long.
    if "NPROC" not in os.environ:
        os.environ.setdefault("PJRT_NPROC", "1")
    # So many new containers. With Python's default of 700, it would look for garbage some thousand times while a
    # program is traced, and each time go through all that JAX holds; the solver's objects rarely form cycles.
    gc.set_threshold(50_000)
