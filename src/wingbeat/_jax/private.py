"""What wingbeat uses of JAX's private parts: if they change, this file alone must follow."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator
from typing import Any

import jax.export
from jax._src import compilation_cache
from jax._src import config as state
from jax._src.core import trace_state_clean as trace_state_clean
from jax._src.xla_bridge import backends_are_initialized as backends_are_initialized
from jax.interpreters.mlir import make_ir_context
from jaxlib.mlir import ir, passmanager
from jaxlib.mlir.dialects import stablehlo

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


# --- traced programs without repeated operations ---
# XLA removes repeats too, but only after some seventy passes over the program. In a flight with its derivatives,
# two thirds of the operations are repeats, most of them sines of one angle. Without repeats, a program compiles in
# 0.55 to 0.9 of the time.


def without_repeats(program: jax.export.Exported) -> jax.export.Exported:
    """Return the traced program with equal operations, and equal calls of its functions, merged into one."""
    with make_ir_context():
        module = ir.Module.parse(program.mlir_module())
        # Without the places in source files, programs are smaller and the same wherever the package is installed.
        passmanager.PassManager.parse("builtin.module(strip-debuginfo)").run(module.operation)
        merge = passmanager.PassManager.parse("builtin.module(cse)")
        merge.run(module.operation)
        while _merge_calls(module):  # merged calls make more operations equal, and so more calls
            merge.run(module.operation)
        version = stablehlo.get_current_version()
        return dataclasses.replace(
            program, mlir_module_serialized=stablehlo.serialize_portable_artifact(module, version)
        )


def _merge_calls(module: ir.Module) -> bool:
    """Merge calls of one function with the same arguments; return whether there were any."""
    # The compiler pass does not merge calls. It is safe: functions of a traced program have no side effects.
    found = False
    for block in _blocks(module.operation):
        first: dict[Any, Any] = {}
        for operation in [o.operation for o in block.operations if o.operation.name == "func.call"]:
            key = (str(operation.attributes["callee"]), *operation.operands)
            same = first.setdefault(key, operation)
            if same is not operation:
                for result, kept in zip(operation.results, same.results, strict=True):
                    result.replace_all_uses_with(kept)
                operation.erase()
                found = True
    return found


def _blocks(operation: ir.Operation) -> Iterator[ir.Block]:
    """Yield all blocks within an operation: those of functions, loops and branches."""
    for region in operation.regions:
        for block in region.blocks:
            yield block
            for inner in block.operations:
                yield from _blocks(inner.operation)
