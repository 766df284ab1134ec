"""The memory of a process of tests: compiled programs pile up, and each worker's come to 10 GB without this."""

import ctypes
import gc
import sys
from pathlib import Path

from wingbeat._jax.arrays import jax
from wingbeat._jax.exported import StoredFunction

# Above this a process lets go of its programs [bytes]. They come back from disk, an orbit's in a second.
MOST = 6e9
_PAGES = Path("/proc/self/statm")


def resident():
    """Return the memory that this process holds [bytes]; 0 where the system does not say."""
    return int(_PAGES.read_text().split()[1]) * 4096 if _PAGES.exists() else 0


def forget_programs():
    """Let go of all compiled programs, and give the memory back to the system."""
    modules = [module for name, module in list(sys.modules.items()) if name.partition(".")[0] == "wingbeat"]
    for stored in (value for module in modules for value in vars(module).values()):
        if isinstance(stored, StoredFunction):
            stored._ready.clear()
    jax.clear_caches()
    gc.collect()
    ctypes.CDLL("libc.so.6").malloc_trim(0)
