"""What equations are written with: JAX, records as pytrees, elementary functions and derivatives."""

from __future__ import annotations

import dataclasses
import functools
import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, TypeVar

from jax.custom_derivatives import SymbolicZero

from wingbeat._jax.config import in_own_settings as in_own_settings
from wingbeat._jax.config import jax as jax
from wingbeat._jax.config import jnp as jnp
from wingbeat._jax.config import own_settings as own_settings

if TYPE_CHECKING:
    from wingbeat._jax.shapes import *  # noqa: F403  # for signatures

T = TypeVar("T")


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

    Fields named in `static` (names, counts) are part of the compiled function; all others are data. A field named
    in `optional` is data only if it differs from its default, so a term that is off adds nothing to the program.
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


# --- elementary functions ---
# On a CPU, XLA calls scalar libm for float64 ``sin``, at about 6 ns per element, and for ``atan2``, at 14 ns. These
# polynomials vectorise and cost about 1 and 3 ns. For all angles of a wing (below some 1e6 rad) they are within
# 4e-16 of libm. Each function is jitted by itself, so that it is traced once, not at each of its many uses.

# Taylor's series of sin(x)/x in x^2; on |x| <= pi/2 the first term left out is 1e-18.
_SIN = tuple((-1) ** k / math.factorial(2 * k + 1) for k in range(11))
# pi in two parts, so that x - n pi loses nothing for moderate n.
_PI_HIGH = 3.141592653589793
_PI_LOW = 1.2246467991473532e-16
# Chebyshev fit of atan(u)/u in u^2 on |u| <= tan(pi/8), error 2e-18.
_ATAN = (
    1.0,
    -0.3333333333333312,
    0.19999999999940837,
    -0.14285714279244968,
    0.11111110744657099,
    -0.09090896801472813,
    0.07692045194561481,
    -0.06662950246036792,
    0.05846866752275139,
    -0.05035049795312439,
    0.03796390316111083,
    -0.017803896394812564,
)
_TINY = 1e-300


def horner(coefficients: Any, x: Any) -> Any:
    """Evaluate the polynomial with these coefficients, constant first, at `x`."""
    total = coefficients[-1]
    for coefficient in coefficients[-2::-1]:
        total = total * x + coefficient
    return total


@jax.custom_jvp
@jax.jit
def sin(x: Any) -> Any:
    """Return the sine of `x` [rad], any shape.

    >>> float(abs(sin(0.5) - math.sin(0.5))) < 1e-15
    True
    """
    turns = jnp.round(x * (1 / math.pi))
    rest = (x - turns * _PI_HIGH) - turns * _PI_LOW
    sign = 1.0 - 2.0 * jnp.abs(turns - 2.0 * jnp.round(0.5 * turns))
    return rest * horner(_SIN, rest * rest) / sign


@sin.defjvp
def _sin_jvp(primals: Any, tangents: Any) -> Any:
    (x,), (dx,) = primals, tangents
    return sin(x), cos(x) * dx


@jax.custom_jvp
def cos(x: Any) -> Any:
    """Return the cosine of `x` [rad], any shape."""
    return sin(x + 0.5 * math.pi)


@cos.defjvp
def _cos_jvp(primals: Any, tangents: Any) -> Any:
    (x,), (dx,) = primals, tangents
    return cos(x), -sin(x) * dx


@jax.custom_jvp
@jax.jit
def atan2(y: Any, x: Any) -> Any:
    """Return the angle of the vector (x, y) in (-pi, pi] [rad]; 0, with derivative 0, for the null vector.

    >>> float(abs(atan2(1.0, -1.0) - 0.75 * math.pi)) < 1e-15
    True
    """
    # Two half-angle steps reduce the argument to less than tan(pi/8), where the polynomial is accurate.
    half = jnp.abs(y) / (jnp.sqrt(x * x + y * y) + jnp.abs(x) + _TINY)
    quarter = half / (1.0 + jnp.sqrt(1.0 + half * half))
    acute = 4.0 * quarter * horner(_ATAN, quarter * quarter)
    angle = jnp.where(x < 0, math.pi - acute, acute)
    return angle / jnp.where(y < 0, -1.0, 1.0)


@atan2.defjvp
def _atan2_jvp(primals: Any, tangents: Any) -> Any:
    (y, x), (dy, dx) = primals, tangents
    return atan2(y, x), (x * dy - y * dx) / (x * x + y * y + _TINY)


# --- derivatives of elementwise functions, computed once for all directions that are needed ---
# XLA on CPU repeats cheap operations at every use, but computes a division only once. A derivative in nine
# directions would therefore compute the function nine times. If the slope is divided by one, XLA computes it once,
# and each direction costs one product. A flight with its derivatives takes 1.6 ms this way, and 3.1 ms without the
# divisions.


def fusion_barrier(tree: T) -> T:
    """Return the arrays of `tree` divided by one, in a form that XLA cannot simplify."""
    return jax.tree_util.tree_map(lambda value: value / jnp.where(jnp.isnan(value), 2.0, 1.0), tree)


@jax.custom_jvp
def computed_once(tree: Any) -> Any:
    """Return the arrays of `tree` so that XLA computes them, and each directional derivative of them, only once."""
    # The barrier alone does not protect derivatives: all directions share the divisor, so XLA makes it a product.
    return fusion_barrier(tree)


@computed_once.defjvp
def _computed_once_jvp(primals: Any, tangents: Any) -> tuple[Any, Any]:
    return computed_once(*primals), fusion_barrier(tangents[0])


def elementwise_jvp(function: Callable[..., T]) -> Callable[..., T]:
    """Return an elementwise function of parameters and arrays with a derivative that computes each slope once.

    >>> line = elementwise_jvp(lambda slope, x: slope * x)
    >>> float(jax.jvp(lambda x: line(3.0, x), (2.0,), (1.0,))[1])
    3.0
    """

    @jax.custom_jvp
    @functools.wraps(function)
    def sloped(parameters: Any, *arrays: Any) -> T:
        return fusion_barrier(function(parameters, *arrays))

    def jvp(primals: Any, tangents: Any) -> tuple[T, T]:
        parameters, *arrays = primals
        value = sloped(*primals)
        change = jax.tree_util.tree_map(jnp.zeros_like, value)
        if not _all_zero(tangents[1:]):
            _, along = jax.linearize(lambda *a: function(parameters, *a), *arrays)  # traced once for all directions
            for i, tangent in enumerate(tangents[1:]):
                if not isinstance(tangent, SymbolicZero):
                    ones = [jnp.ones_like(a) if i == j else jnp.zeros_like(a) for j, a in enumerate(arrays)]
                    slope = fusion_barrier(along(*ones))
                    change = jax.tree_util.tree_map(lambda c, s, t=tangent: c + s * t, change, slope)
        if not _all_zero(tangents[0]):
            along = jax.tree_util.tree_map(_filled, tangents[0], is_leaf=_is_zero)
            more = fusion_barrier(jax.jvp(lambda p: function(p, *arrays), (parameters,), (along,))[1])
            change = jax.tree_util.tree_map(jnp.add, change, more)
        return value, change

    sloped.defjvp(jvp, symbolic_zeros=True)
    return sloped


def _is_zero(leaf: Any) -> bool:
    return isinstance(leaf, SymbolicZero)


def _all_zero(tangent: Any) -> bool:
    return all(_is_zero(leaf) for leaf in jax.tree_util.tree_leaves(tangent, is_leaf=_is_zero))


def _filled(leaf: Any) -> Any:
    return jnp.zeros(leaf.shape, leaf.dtype) if _is_zero(leaf) else leaf
