"""Compiled functions whose tracing, too, is kept on disk, so that a second process starts in a second or two.

JAX's own cache keeps what XLA compiled, but finds it by the traced program, and tracing costs Python seconds.
Here the traced program itself (`jax.export`) is kept, named by everything that could change it.
"""

from __future__ import annotations

import functools
import hashlib
import pickle
import platform
import threading
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

import jax
import jax.export
import numpy as np
from jax.core import Tracer

from wingbeat._version import __version__
from wingbeat.errors import FileError
from wingbeat.files import write_atomically
from wingbeat.jax64 import cache_folder, jnp


class StoredFunction:
    """A function jitted for arrays of float64, traced at most once on this machine for given shapes.

    Called with tracers, inside another JAX transformation, it is the plain function. Arguments named in `static`
    must be given by keyword and have a telling `repr`.
    """

    def __init__(self, function: Callable[..., Any], static: tuple[str, ...] = ()) -> None:
        functools.update_wrapper(self, function)
        self._function = function
        self._static = static
        self._inlined = jax.jit(function, static_argnames=static)
        self._lock = threading.Lock()
        self._ready: dict[Any, tuple[Callable[..., Any], Any]] = {}

    @property
    def loaded(self) -> bool:
        """Whether any program of it is in memory."""
        return bool(self._ready)

    def __call__(self, *args: Any, **static: Any) -> Any:
        """Evaluate the function."""
        leaves, tree = jax.tree_util.tree_flatten(args)
        if any(isinstance(leaf, Tracer) for leaf in leaves):
            return self._inlined(*args, **static)
        leaves = [leaf if _is_float64(leaf) else np.asarray(leaf, dtype=float) for leaf in leaves]
        call, out_tree = self._program(leaves, tree, static)
        return jax.tree_util.tree_unflatten(out_tree, call(*leaves))

    def bind(self, *first: Any, **static: Any) -> Callable[..., Any]:
        """Return the function of the arguments that follow these, which are taken apart and moved but once.

        The arguments that follow must be arrays of float64, or floats, and of the same shapes in every call.
        """
        leaves, tree = jax.tree_util.tree_flatten(first)
        held = jax.device_put([leaf if _is_float64(leaf) else np.asarray(leaf, dtype=float) for leaf in leaves])
        found: list[Any] = []

        def call(*rest: Any) -> Any:
            if not found:
                whole = jax.tree_util.tree_structure((*jax.tree_util.tree_unflatten(tree, leaves), *rest))
                found.extend(self._program([*held, *(np.asarray(a, dtype=float) for a in rest)], whole, static))
            program, out_tree = found
            return jax.tree_util.tree_unflatten(out_tree, program(*held, *rest))

        return call

    def _program(self, leaves: list[Any], tree: Any, static: dict[str, Any]) -> tuple[Callable[..., Any], Any]:
        """Return the compiled function of the leaves and the structure of what it returns."""
        key = (tree, tuple(np.shape(leaf) for leaf in leaves), *static.values())
        if key not in self._ready:
            with self._lock:  # one thread loads, the others wait for it
                if key not in self._ready:
                    self._ready[key] = self._load(leaves, tree, static)
        return self._ready[key]

    def _load(self, leaves: list[Any], tree: Any, static: dict[str, Any]) -> tuple[Callable[..., Any], Any]:
        shapes = [jax.ShapeDtypeStruct(np.shape(leaf), jnp.float64) for leaf in leaves]
        path = self._path(shapes, tree, static)
        try:
            program, out_tree = pickle.loads(path.read_bytes())
            call = jax.jit(jax.export.deserialize(bytearray(program)).call)
            call(*leaves)  # compiled, or read from JAX's cache, while the lock is held
            return call, out_tree
        except Exception:  # absent, cut short, or of a JAX that reads it no more: traced anew
            pass
        outcome = []

        def flat(*values: Any) -> list[Any]:
            result = self._function(*jax.tree_util.tree_unflatten(tree, values), **static)
            flat_result, out_tree = jax.tree_util.tree_flatten(result)
            outcome.append(out_tree)
            return flat_result

        exported = jax.export.export(jax.jit(flat))(*shapes)
        with suppress(FileError, OSError):  # a cache that cannot be written costs time, not the answer
            path.parent.mkdir(parents=True, exist_ok=True)
            write_atomically(path, pickle.dumps((bytes(exported.serialize()), outcome[0])))
        return jax.jit(exported.call), outcome[0]

    def _path(self, shapes: list[Any], tree: Any, static: dict[str, Any]) -> Path:
        """Return where the traced program is kept: its name is a digest of all that could change it."""
        what = (
            f"{self._function.__module__}.{self._function.__qualname__}",
            str(tree),
            [shape.shape for shape in shapes],
            sorted(static.items()),
            (__version__, _source_digest(), jax.__version__, platform.python_version()),
            jax.default_backend(),
        )
        return cache_folder() / "traced" / hashlib.sha256(repr(what).encode()).hexdigest()


def _is_float64(leaf: Any) -> bool:
    return type(leaf) is float or getattr(leaf, "dtype", None) == np.float64


@functools.cache
def _source_digest() -> str:
    """Return a digest of the package's own sources, so that an edited equation is traced anew."""
    digest = hashlib.sha256()
    for path in sorted(Path(__file__).parent.rglob("*.py")):
        digest.update(path.read_bytes())
    return digest.hexdigest()


def stored(function: Callable[..., Any] | None = None, *, static: tuple[str, ...] = ()) -> Any:
    """Turn a function of float64 arrays (in pytrees) into a `StoredFunction`.

    >>> @stored
    ... def double(values):
    ...     return 2 * values
    >>> float(double(1.5))
    3.0
    """
    if function is None:
        return functools.partial(stored, static=static)
    return StoredFunction(function, static)
