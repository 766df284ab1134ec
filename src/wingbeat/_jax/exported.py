"""Compiled functions whose traced programs are also stored on disk, so that a second process starts within seconds.

JAX's own cache stores what XLA compiled. To find an entry, JAX must first trace the function, which takes seconds.
Here the traced program itself (`jax.export`) is stored. Its name is a digest of everything that could change it.
The traced programs of the usual first questions come with the package.
"""

from __future__ import annotations

import functools
import hashlib
import inspect
import math
import os
import pickle
import platform
import threading
import zlib
from collections.abc import Callable, Iterable
from contextlib import suppress
from pathlib import Path
from typing import Any, NamedTuple

import jax
import jax.export
import numpy as np
from jax.core import Tracer

from wingbeat._base.errors import ForkError
from wingbeat._jax.config import in_own_settings, jnp, keep_program, kept_program, own_settings
from wingbeat._jax.private import backends_are_initialized, trace_state_clean, without_repeats
from wingbeat._version import __version__

# Threads that trace at the same time slow one another down. If they take turns, XLA compiles one program while the
# next is traced.
_TRACING = threading.Lock()
# XLA's older way to make loops of fused operations compiles in half the time of the newer one. Programs made the
# older way are as fast: the flight of the search takes 9 % longer for the model paper's pigeon, 10 % less for the
# model animal's bat. From JAX 0.12 on, XLA has the newer way only.
_SOON_ON_CPU: dict[str, str | bool] = (
    {"xla_cpu_use_fusion_emitters": False} if jax.__version_info__ < (0, 12) else {}
)
_NOTHING = np.zeros(0)
_PACKAGE = Path(__file__).parents[1]
# Traced programs that come with the package, made by benchmarks/shipped_programs.py, and all that they depend on.
SHIPPED = _PACKAGE / "data" / "programs"
_EQUATIONS = "_jax/*.py aero/*.py animal/*.py mechanics/*.py orbits/flight/*.py orbits/search_options.py"
EQUATIONS = tuple(path for part in _EQUATIONS.split() for path in _PACKAGE.glob(part))

# Whether this process had run JAX when it was last forked, and whether it is such a fork.
_has_run = False
_cannot_run = False


def _before_fork() -> None:
    global _has_run
    _has_run = backends_are_initialized()


def _after_fork() -> None:
    global _cannot_run
    _cannot_run = _has_run


if hasattr(os, "register_at_fork"):
    os.register_at_fork(before=_before_fork, after_in_child=_after_fork)


class _Ready(NamedTuple):
    """A compiled function of arrays, and the structure and shapes of its results."""

    program: Callable[..., Any]
    tree: Any
    shapes: tuple[Any, ...]


class StoredFunction:
    """A function of pytrees of float64 arrays that is traced at most once on this machine for given shapes.

    Inside another JAX transformation, where its arguments are tracers, it acts as the plain function. Arguments
    named in `static` must be given by keyword, others may, and different values must have different `repr`s.
    """

    def __init__(self, function: Callable[..., Any], static: tuple[str, ...] = (), kept: bool = True) -> None:
        functools.update_wrapper(self, function)
        self._function, self._kept = function, kept
        self._inlined = jax.jit(function, static_argnames=static)
        self._static = frozenset(static)
        self._lock = threading.Lock()
        self._ready: dict[Any, _Ready] = {}

    @property
    def loaded(self) -> bool:
        """Whether a compiled program of this function is in memory."""
        return bool(self._ready)

    def __call__(self, *args: Any, **static: Any) -> Any:
        """Evaluate the function."""
        if not self._static.issuperset(static):
            args, static = self._in_order(args, static)
        leaves, tree = jax.tree_util.tree_flatten(args)
        if any(isinstance(leaf, Tracer) for leaf in leaves):
            return self._inlined(*args, **static)
        more = [np.asarray(leaf, dtype=float) for leaf in leaves]
        with own_settings():
            return self._run(self._program(tree, (), more, static), _NOTHING, more)

    def _in_order(self, args: tuple[Any, ...], named: dict[str, Any]) -> tuple[tuple[Any, ...], dict[str, Any]]:
        """Return the arguments with those in their places that are named and not static, and the static ones."""
        static = {name: value for name, value in named.items() if name in self._static}
        bound = inspect.signature(self._function).bind(*args, **named)
        names = [name for name in bound.signature.parameters if name not in self._static]
        last = max(names.index(name) for name in bound.arguments if name not in self._static)
        bound.apply_defaults()
        return tuple(bound.arguments[name] for name in names[: last + 1]), static

    def bind(self, *first: Any, **static: Any) -> Callable[..., Any]:
        """Return the function with its first arguments fixed; the others are of the same shapes in every call."""
        leaves, tree = jax.tree_util.tree_flatten(first)
        arrays = [np.asarray(leaf, dtype=float) for leaf in leaves]
        shapes = tuple(array.shape for array in arrays)
        if _cannot_run:
            _refuse_fork()
        with own_settings(), jax.ensure_compile_time_eval():
            held = jnp.asarray(_packed(arrays))
        ready: _Ready | None = None

        def call(*rest: Any) -> Any:
            nonlocal ready
            more = [np.asarray(a, dtype=float) for a in rest]
            with own_settings():
                if ready is None:
                    ready = self._program(tree, shapes, more, static)
                return self._run(ready, held, more)

        return call

    def _program(
        self, tree: Any, shapes: tuple[Any, ...], more: list[np.ndarray], static: dict[str, Any]
    ) -> _Ready:
        """Return the program for these arrays, followed by more arrays."""
        key = (tree, shapes, tuple(a.shape for a in more), *sorted(static.items()))
        if _cannot_run:
            _refuse_fork()
        if key not in self._ready:
            with self._lock:  # one thread loads, the others wait for it
                if key not in self._ready:
                    self._ready[key] = self._load(tree, shapes, key[2], static)
        return self._ready[key]

    def _run(self, ready: _Ready, held: Any, more: list[np.ndarray]) -> Any:
        if _cannot_run:
            _refuse_fork()
        program, out_tree, out_shapes = ready
        if trace_state_clean():
            found = np.asarray(program(held, _packed(more)))
        else:
            with jax.ensure_compile_time_eval():  # inside another trace, numbers stay numbers
                found = np.asarray(program(held, _packed(more)))
        return jax.tree_util.tree_unflatten(out_tree, _unpacked(found, out_shapes))

    def _load(self, tree: Any, shapes: tuple[Any, ...], rest: tuple[Any, ...], static: dict[str, Any]) -> _Ready:
        sizes = [sum(math.prod(shape) for shape in part) for part in (shapes, rest)]
        arguments = [jax.ShapeDtypeStruct((size,), jnp.float64) for size in sizes]
        name = self.name(tree, (shapes, rest), static, _here()) if self._kept else ""
        for find in (kept_program, self._shipped(tree, (shapes, rest), static)) if self._kept else ():
            with suppress(Exception):  # if JAX can no longer read it, it is traced again
                if (found := find(name)) is not None:
                    program, out_tree, out_shapes = pickle.loads(found)
                    exported = jax.export.deserialize(bytearray(program))
                    return _Ready(_compiled(exported.call, arguments), out_tree, out_shapes)
        outcome = []

        def flat(held: Any, more: Any) -> Any:
            arrays = [*_unpacked(held, shapes), *_unpacked(more, rest)]
            first = jax.tree_util.tree_unflatten(tree, arrays[: tree.num_leaves])
            found = self._function(*first, *arrays[tree.num_leaves :], **static)
            leaves, out_tree = jax.tree_util.tree_flatten(found)
            outcome.append((out_tree, tuple(leaf.shape for leaf in leaves)))
            # One array, because each returned array costs some microseconds.
            return jnp.concatenate([leaf.ravel() for leaf in leaves])

        if not self._kept:
            return _Ready(_compiled(flat, arguments), *outcome[0])
        with _TRACING:
            exported = without_repeats(jax.export.export(jax.jit(flat))(*arguments))
        keep_program(name, pickle.dumps((bytes(exported.serialize()), *outcome[0])))
        return _Ready(_compiled(exported.call, arguments), *outcome[0])

    def _shipped(self, tree: Any, shapes: Any, static: dict[str, Any]) -> Callable[[str], bytes | None]:
        """Return a function that reads the traced program from the package, and keeps it under a name."""

        def find(name: str) -> bytes | None:
            place = SHIPPED / self.name(tree, shapes, static, equations_digest())
            if not place.is_file():
                return None
            program = zlib.decompress(place.read_bytes())
            keep_program(name, program)
            return program

        return find

    def name(self, tree: Any, shapes: Any, static: dict[str, Any], made_by: Any) -> str:
        """Return the name of the traced program's file: a digest of everything that could change the program."""
        which = f"{self._function.__module__}.{self._function.__qualname__}"
        what = which, str(tree), shapes, sorted(static.items()), made_by, jax.default_backend()
        return f"traced-{hashlib.sha256(repr(what).encode()).hexdigest()}"


def _compiled(program: Callable[..., Any], arguments: list[jax.ShapeDtypeStruct]) -> Callable[..., Any]:
    """Compile a program, or read it from JAX's cache; a first call would keep two copies in memory."""
    lowered = jax.jit(program).lower(*arguments)
    if jax.default_backend() == "cpu":
        with suppress(jax.errors.JaxRuntimeError):  # from an XLA without this option
            return lowered.compile(_SOON_ON_CPU)
    return lowered.compile()


def jit_soon(function: Callable[..., Any], **options: Any) -> Callable[..., Any]:
    """Return what `jax.jit` returns with these options, but compiled in two thirds of the time on a CPU."""
    plain = jax.jit(function, **options)
    soon = jax.jit(function, **options, compiler_options=dict(_SOON_ON_CPU))

    @functools.wraps(function)
    @in_own_settings
    def call(*args: Any) -> Any:
        if jax.default_backend() == "cpu" and trace_state_clean():  # not in a transformation, which chooses how
            with suppress(jax.errors.JaxRuntimeError):  # from an XLA without this option
                return soon(*args)
        return plain(*args)

    return call


def _refuse_fork() -> None:
    raise ForkError(
        "this process was forked from one that had run JAX. It lacks JAX's threads and would wait for them "
        "forever; start processes with multiprocessing.get_context('spawn') or 'forkserver', or let "
        "wb.solve_orbits(problems, processes=N) start them"
    )


def _packed(arrays: list[np.ndarray]) -> np.ndarray:
    return np.concatenate([array.ravel() for array in arrays]) if arrays else np.zeros(0)


def _unpacked(held: Any, shapes: tuple[Any, ...]) -> list[Any]:
    found, end = [], 0
    for shape in shapes:
        begin, end = end, end + math.prod(shape)
        found.append(held[begin:end].reshape(shape))
    return found


@functools.cache
def _here() -> tuple[str, ...]:
    """Return what may change any traced program here; a function is traced again if an equation changes."""
    return __version__, _digest_of(_PACKAGE.rglob("*.py")), jax.__version__, platform.python_version()


@functools.cache
def equations_digest() -> str:
    """Return a digest of the sources on which shipped programs depend."""
    return _digest_of(EQUATIONS)


def _digest_of(paths: Iterable[Path]) -> str:
    digest = hashlib.sha256()
    for path in sorted(paths):
        digest.update(path.read_bytes().replace(b"\r\n", b"\n"))
    return digest.hexdigest()


def exported(
    function: Callable[..., Any] | None = None,
    *,
    static: tuple[str, ...] = (),
    kept: bool = True,
) -> Any:
    """Turn a function of float64 arrays (in pytrees) into a `StoredFunction`.

    A function that is not `kept` is traced in each process; those that take a user's function need this.

    >>> @exported
    ... def double(values):
    ...     return 2 * values
    >>> float(double(1.5))
    3.0
    """
    if function is None:
        return functools.partial(exported, static=static, kept=kept)
    return StoredFunction(function, static, kept)
