"""What a quantity's function reads of a beat, and what it returns; both are found by tracing the function."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

from wingbeat._jax.arrays import jax, jnp
from wingbeat.orbits.flight.beat import BY_STRIP, NUMBERS, Beat
from wingbeat.orbits.flight.path_maxima import PARTS

ALL_FIELDS = tuple(name for name in Beat._fields if name != "drive")
# Samples of a beat that serves for its shapes only.
SAMPLES = 1 + 2 * PARTS


# Tracing a function takes 2.5 ms, and every problem of a curve or study needs the shapes.
@functools.lru_cache(256)
def given_by(function: Callable[[Any], Any], strips: int, drive: Any, of_map: bool) -> Any:
    """Return the shapes of the arrays that a quantity's function of a beat, or of a stroke map, returns.

    Parameters
    ----------
    function, of_map : the function, and whether it reads the stroke map.
    strips : number of strips of the wing.
    drive : structure of the vehicle's drive, as a tree.
    """
    if of_map:
        return jax.eval_shape(function, jax.ShapeDtypeStruct((4, 4), jnp.float64))
    return jax.eval_shape(function, _any_beat(strips, drive))


@functools.lru_cache(256)
def fields_read(function: Callable[[Beat], Any], strips: int, drive: Any) -> tuple[str, ...]:
    """Return the names of the fields of a beat that a function needs; for the parameters see `given_by`."""
    beat = _any_beat(strips, drive)
    places = jax.tree.leaves(beat._replace(**{name: name for name in Beat._fields if name != "drive"}))
    traced = jax.make_jaxpr(function)(beat).jaxpr
    read = {id(var) for step in traced.eqns for var in step.invars} | {id(var) for var in traced.outvars}
    names = {name for name, var in zip(places, traced.invars, strict=True) if id(var) in read}
    fields = tuple(name for name in Beat._fields if name == "phase" or name in names)
    try:
        jax.eval_shape(function, beat.only(fields))
    except Exception:  # a user's function may look at a field that does not matter for its value
        return ALL_FIELDS
    return fields


def _any_beat(strips: int, drive: Any) -> Beat:
    by_strip = jax.ShapeDtypeStruct((SAMPLES, strips), jnp.float64)
    number, series = (jax.ShapeDtypeStruct(shape, jnp.float64) for shape in ((), (SAMPLES,)))
    shapes: dict[str, Any] = dict.fromkeys(BY_STRIP, by_strip)
    shapes |= dict.fromkeys(NUMBERS, number)
    shapes["drive"] = drive.unflatten([number] * drive.num_leaves)
    return Beat(*(shapes.get(name, series) for name in Beat._fields))
