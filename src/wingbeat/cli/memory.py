"""Memory that a command needs; checked before it starts, because the compiler ends the process if it gets none."""

from __future__ import annotations

from wingbeat._workers.tuning import core_count

# Address space [bytes] of a solver: one orbit took 1.96 GB on two cores with an empty cache; with a full one,
# 1.84 GB on two cores and 1.65 GB on one. Most of it is set aside for threads. With 1.6 GB on two cores it aborts.
_SOLVER = 1_700_000_000
_SOLVER_PER_CORE = 200_000_000
# Address space of `wingbeat species`, which solves nothing.
_READER = 500_000_000
_READERS = ("species",)


def memory_shortage(command: str) -> str | None:
    """Return the reason why a command cannot run within the address-space limit (``ulimit -v``), or None."""
    try:
        from resource import RLIM_INFINITY, RLIMIT_AS, getrlimit
    except ImportError:  # not on Windows
        return None
    limit = getrlimit(RLIMIT_AS)[0]
    cores = core_count()
    need = _READER if command in _READERS else _SOLVER + _SOLVER_PER_CORE * cores
    if limit == RLIM_INFINITY or limit >= need:
        return None
    return (
        f"memory is limited to {limit / 1e9:.2g} GB of address space, and {command} needs {need / 1e9:.2g} GB on "
        f"{cores} cores; raise the limit with `ulimit -v {-(-need // 1024)}`"
    )
