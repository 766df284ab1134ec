"""JAX as the package uses it: with float64, a compilation cache on disk, and records as pytrees."""

from __future__ import annotations

import dataclasses
import functools
import os
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any, ParamSpec, TypeVar

import jax
import jax.numpy as jnp
from jax._src import compilation_cache
from jax._src import config as state
from jax._src.core import trace_state_clean

from wingbeat._base.errors import Fault, InvalidInputError
from wingbeat._jax.program_cache import keep_program, kept_program, program_folder

__all__ = ["at_default", "in_own_settings", "jax", "jnp", "own_settings", "register_record", "unchecked"]

T = TypeVar("T")
P = ParamSpec("P")
# Settings of JAX under which the package computes. A host program may choose others for its own work, for the whole
# process or in a thread: float32 would spoil every result without a message, the rest would end in errors of JAX.
_OWN: tuple[tuple[Any, Any], ...] = (
    (state.enable_x64, True),
    (state.numpy_rank_promotion, "allow"),
    (state.numpy_dtype_promotion, "standard"),
    (state.disable_jit, False),
    (state.debug_nans, False),  # a search tries wingbeats whose flight runs off
    (state.debug_infs, False),
    (state.default_device, None),  # programs and their inputs are then on one device
)
_GUARDS = (state.transfer_guard_host_to_device, state.transfer_guard_device_to_host)


def _configure() -> None:
    # With this flag, XLA on CPU compiles a loop of small arrays into one function instead of some 20 calls per
    # iteration: a march takes a third of the time. JAX reads the flag when it first compiles. If JAX has already
    # compiled something, marches are slower.
    flags = os.environ.get("XLA_FLAGS", "")
    if "xla_backend_extra_options" not in flags:
        loops = "--xla_backend_extra_options=xla_cpu_small_while_loop_byte_threshold=100000000"
        os.environ["XLA_FLAGS"] = f"{flags} {loops}".strip()
    jax.config.update("jax_enable_x64", True)
    # Each thread computes its own results. Otherwise searches in threads would wait for one another's results.
    jax.config.update("jax_cpu_enable_async_dispatch", False)
    if getattr(jax.config, "jax_compilation_cache_dir", None) is None and (folder := program_folder()) is not None:
        _keep_compiled(folder)


class _Checked:
    """JAX's cache of compiled programs; `program_cache` checks its files, because JAX would run any file."""

    def __init__(self, folder: Path) -> None:
        self._path = folder

    def get(self, key: str) -> bytes | None:
        """Return the compiled program of this key; None if its file is missing, damaged, or another user's."""
        return kept_program(f"compiled-{key}")

    def put(self, key: str, value: bytes) -> None:
        """Store a compiled program under this key."""
        keep_program(f"compiled-{key}", value)


def _keep_compiled(folder: Path) -> None:
    """Make JAX store compiled programs in the folder, and read only files that have not changed since."""
    theirs = compilation_cache.get_file_cache

    def opened(path: str) -> Any:
        return (_Checked(folder), path) if path == str(folder) else theirs(path)

    compilation_cache.get_file_cache = opened
    jax.config.update("jax_compilation_cache_dir", str(folder))
    # XLA would read its own files there without a check, and they would be useless in a folder that has moved.
    jax.config.update("jax_persistent_cache_enable_xla_caches", "none")
    jax.config.update("jax_persistent_cache_min_compile_time_secs", 0.0)
    jax.config.update("jax_persistent_cache_min_entry_size_bytes", 0)


_configure()


@functools.cache
def _start() -> None:
    """Start JAX's platform, or say in words that it cannot be started."""
    try:
        jax.default_backend()
    except (AssertionError, RuntimeError) as error:
        reason, fix = str(error).split("\n")[0] or "this JAX does not know it", "set JAX_PLATFORMS=cpu"
        fault = Fault("jax_platforms", state.jax_platforms.value, f"cannot be started: {reason}", fix)
        raise InvalidInputError([fault]) from None


@contextmanager
def own_settings() -> Iterator[None]:
    """Compute under the package's settings of JAX in a block, in this thread; afterwards those of the host apply.

    It takes 2 us if the host has changed nothing, otherwise 40 us.

    Raises
    ------
    InvalidInputError : JAX cannot start on the platform that was chosen.
    """
    _start()
    if all(setting.value == own for setting, own in _OWN) and not any(guard.value for guard in _GUARDS):
        yield
        return
    with ExitStack() as stack:
        for setting, own in _OWN:
            stack.enter_context(setting(own))
        for guard in _GUARDS:
            stack.enter_context(guard("allow"))
        yield


def in_own_settings(function: Callable[P, T]) -> Callable[P, T]:
    """Return a function that computes under the package's settings of JAX, whatever those of the host are.

    Within a transformation of the host's, whose arguments are tracers, the host's settings stay.
    """

    @functools.wraps(function)
    def settled(*args: P.args, **named: P.kwargs) -> T:
        if not trace_state_clean():
            return function(*args, **named)
        with own_settings():
            return function(*args, **named)

    return settled


def unchecked(cls: type[T], fields: Mapping[str, Any]) -> T:
    """Return a record of these fields without its constructor's checks, which cannot evaluate JAX tracers."""
    record = object.__new__(cls)
    for name, value in fields.items():
        object.__setattr__(record, name, value)
    return record


def at_default(record: Any, name: str) -> bool:
    """Say whether an optional field has its default, the number that switches it off; an array is never off."""
    value = getattr(record, name)
    return isinstance(value, int | float) and value == getattr(type(record), name)


def register_record(
    cls: type[T] | None = None, *, static: tuple[str, ...] = (), optional: tuple[str, ...] = ()
) -> Any:
    """Make a frozen dataclass a pytree; the copies that JAX makes of a record skip the constructor's checks.

    The checks apply to user input. Inside compiled functions, JAX rebuilds the records from tracers, and a check
    cannot evaluate a tracer. Fields named in `static` (names, counts) are part of the compiled function; all others
    are data. A field named in `optional` is data only if it differs from its default, so a term that is off adds
    nothing to the program.
    """
    if cls is None:
        return functools.partial(register_record, static=static, optional=optional)
    names = [field.name for field in dataclasses.fields(cls) if field.name not in static]  # type: ignore[arg-type]

    def held(record: Any) -> tuple[list[str], tuple[Any, ...]]:
        off = tuple(name for name in optional if at_default(record, name))
        values = tuple(getattr(record, name) for name in static)
        return [name for name in names if name not in off], (off, *values) if optional else values

    def flatten(record: Any) -> tuple[list[Any], tuple[Any, ...]]:
        kept, aux = held(record)
        return [getattr(record, name) for name in kept], aux

    def flatten_with_keys(record: Any) -> tuple[list[Any], tuple[Any, ...]]:
        kept, aux = held(record)
        return [(jax.tree_util.GetAttrKey(name), getattr(record, name)) for name in kept], aux

    def unflatten(aux: tuple[Any, ...], leaves: Any) -> Any:
        off, values = (aux[0], aux[1:]) if optional else ((), aux)
        fields = {name: getattr(cls, name) for name in off}
        fields |= zip([name for name in names if name not in off], leaves, strict=True)
        return unchecked(cls, fields | dict(zip(static, values, strict=True)))

    jax.tree_util.register_pytree_with_keys(cls, flatten_with_keys, unflatten, flatten)
    return cls
