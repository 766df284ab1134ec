"""What wingbeat uses of JAX's private parts: if they change, this file alone must follow."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from jax._src import compilation_cache
from jax._src import config as state
from jax._src.core import trace_state_clean as trace_state_clean
from jax._src.xla_bridge import backends_are_initialized as backends_are_initialized
from jax.interpreters.mlir import make_ir_context as make_ir_context
from jaxlib.mlir import ir as ir
from jaxlib.mlir import passmanager as passmanager
from jaxlib.mlir.dialects import stablehlo as stablehlo

# Settings of JAX under which the package computes. A host program may choose others for its own work, for the whole
# process or in a thread: float32 would spoil every result without a message, the rest would end in errors of JAX.
OWN: tuple[tuple[Any, Any], ...] = (
    (state.enable_x64, True),
    (state.numpy_rank_promotion, "allow"),
    (state.numpy_dtype_promotion, "standard"),
    (state.disable_jit, False),
    (state.debug_nans, False),  # a search tries wingbeats whose flight runs off
    (state.debug_infs, False),
    (state.default_device, None),  # programs and their inputs are then on one device
)
GUARDS = (state.transfer_guard_host_to_device, state.transfer_guard_device_to_host)


def chosen_platforms() -> str | None:
    """Return the platforms that the user or the environment chose."""
    return state.jax_platforms.value


def replace_file_cache(folder: str, cache: Any) -> None:
    """Let JAX keep compiled programs of a folder in `cache`, which has its methods ``get`` and ``put``."""
    theirs: Callable[[str], Any] = compilation_cache.get_file_cache
    compilation_cache.get_file_cache = lambda path: (cache, path) if path == folder else theirs(path)
