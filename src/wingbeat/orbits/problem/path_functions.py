"""Quantities as functions of one beat or its stroke map: values with derivatives, in the optimiser's scale.

A quantity that is a number has one value. A series has one value for each quarter of the beat: its largest there.
Several series, in columns, have one value for each column and quarter. A quantity of the stroke map has as many
values as its function returns.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from wingbeat._jax.config import jax, jnp
from wingbeat._jax.exported import jit_soon
from wingbeat.actuators import Drive
from wingbeat.errors import Fault, InvalidInputError, first_line
from wingbeat.orbits.flight.beat import BY_STRIP, NUMBERS, Beat
from wingbeat.orbits.flight.path_maxima import PARTS, WeightedSamples, highest
from wingbeat.orbits.problem.limits import Constraint
from wingbeat.orbits.problem.map_quantities import MapQuantity
from wingbeat.orbits.problem.quantities import Quantity

# How to add what a quantity needs to a vehicle.
_FIXES = {
    "muscle": "add a muscle with species.with_muscle(), or set the numbers muscle.* with --set",
    "motor": "add a motor: set the numbers motor.* with --set or in the species file",
}
# Samples of a beat that serves for its shapes only.
_SAMPLES = 1 + 2 * PARTS


# One program for each function serves all objectives and limits that contain it.
@functools.partial(jit_soon, static_argnums=0)
def _value(function: Callable[[Any], Any], given: Any) -> Any:
    return jnp.asarray(function(given), dtype=float)


@functools.partial(jit_soon, static_argnums=0)
def _changes(function: Callable[[Any], Any], given: Any, changes: Any) -> tuple[Any, Any]:
    """Return the value of a function of a beat or a stroke map, and its change for each change of that."""
    value, along = jax.linearize(lambda at: _value(function, at), given)
    return value, jax.vmap(along)(changes)


@dataclass(frozen=True)
class _Lacking:
    """The negative of a quantity, or of a series' maximum. It turns a lower limit into an upper one."""

    of: Callable[[Any], Any]

    def __call__(self, given: Any) -> Any:
        return -jnp.max(self.of(given))


class OutputFunctions:
    """The values of several quantities, one after the other, each divided by its scale.

    Attributes
    ----------
    counts, constraint_counts : how many values each quantity has, and each constraint.
    limits : upper limits of the constraints' values.
    of_beat, of_map : whether any quantity is one of the beat, and of the stroke map.
    """

    def __init__(
        self, quantities: Sequence[Quantity], constraints: Sequence[Constraint], strips: int, drive: Drive
    ) -> None:
        self._drive = jax.tree.map(float, drive)  # a whole number has no derivative
        kept = [c.quantity.of if c.at_most else _Lacking(c.quantity.of) for c in constraints]
        self._functions = tuple([q.of for q in quantities] + kept)
        everything = [*quantities, *(c.quantity for c in constraints)]
        self._names = [q.name for q in everything]
        self._reads_map = [isinstance(q, MapQuantity) for q in everything]
        self.of_map, self.of_beat = any(self._reads_map), not all(self._reads_map)
        given = zip(self._functions, self._reads_map, strict=True)
        self.counts = [_count(_given_by(function, strips, drive, of_map), of_map) for function, of_map in given]
        self._scale = np.repeat([q.scale for q in everything], self.counts)
        limits = [(c.limit if c.at_most else -c.limit) / c.quantity.scale for c in constraints]
        self.constraint_counts = self.counts[len(quantities) :]
        self.limits = np.repeat(limits, self.constraint_counts)

    def values(self, beat: Beat | None, stroke_map: np.ndarray | None) -> np.ndarray:
        """Return the values; for a series, its highest sample in each quarter of the beat.

        Raises
        ------
        InvalidInputError : a quantity is not finite although beat and stroke map are.
        """
        found = []
        for function, of_map in zip(self._functions, self._reads_map, strict=True):
            value = np.asarray(_value(function, stroke_map if of_map else self._driven(beat)))
            found.append(highest(value) if value.ndim and not of_map else value)
        return self._joined((beat, stroke_map), found)

    def linearised(
        self, beat: tuple[Beat, Beat] | None, stroke_map: tuple[np.ndarray, np.ndarray] | None
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return the values and their derivatives, shape (values, directions).

        The values of a series are the peaks of a smooth curve through it.

        Parameters
        ----------
        beat, stroke_map : each with its changes along the directions (first axis); None if no quantity reads it.

        Raises
        ------
        InvalidInputError : a quantity is not finite although beat and stroke map are.
        """
        if beat is not None:
            count = beat[1].phase.shape[0]
            drive = jax.tree.map(lambda number: np.zeros(count), self._drive)
            beat = self._driven(beat[0]), beat[1]._replace(drive=drive)
        values, derivatives = [], []
        for function, of_map in zip(self._functions, self._reads_map, strict=True):
            at = stroke_map if of_map else beat
            assert at is not None
            value, along = (np.asarray(a) for a in _changes(function, *at))
            along = np.moveaxis(along, 0, -1)
            if value.ndim and not of_map:
                weighted = WeightedSamples(value)
                value, along = weighted.peaks, weighted.of(along)
            values.append(value)
            derivatives.append(along.reshape(-1, along.shape[-1]))
        return self._joined((beat, stroke_map), values), np.concatenate(derivatives) / self._scale[:, None]

    def _driven(self, beat: Beat | None) -> Beat:
        assert beat is not None
        return beat._replace(drive=self._drive)

    def _joined(self, given: Any, values: list[np.ndarray]) -> np.ndarray:
        for name, value in zip(self._names, values, strict=True):
            if not np.isfinite(value).all() and all(np.isfinite(a).all() for a in jax.tree.leaves(given)):
                fix = "the quantity's function must be finite for every flight"
                raise InvalidInputError([Fault(f"quantity {name}", float(value.flat[0]), "is not finite", fix)])
        return np.concatenate([value.ravel() for value in values]) / self._scale


def value_count(quantity: Quantity, strips: int, drive: Drive) -> int:
    """Return how many values a quantity has: 1 if its function gives a number."""
    of_map = isinstance(quantity, MapQuantity)
    return _count(_given_by(quantity.of, strips, drive, of_map), of_map)


def _count(given: Any, of_map: bool) -> int:
    if of_map or not given.shape:
        return math.prod(given.shape)
    return PARTS * math.prod(given.shape[1:])


# Tracing a function takes 2.5 ms, and every problem of a curve or study needs the shapes.
@functools.lru_cache(256)
def _given_by(function: Callable[[Any], Any], strips: int, drive: Drive, of_map: bool) -> Any:
    """Return the shapes of the arrays that a quantity's function of a beat, or of a stroke map, returns."""
    if of_map:
        return jax.eval_shape(function, jax.ShapeDtypeStruct((4, 4), jnp.float64))
    return jax.eval_shape(function, _any_beat(strips, drive))


def _any_beat(strips: int, drive: Drive) -> Beat:
    by_strip = jax.ShapeDtypeStruct((_SAMPLES, strips), jnp.float64)
    number, series = (jax.ShapeDtypeStruct(shape, jnp.float64) for shape in ((), (_SAMPLES,)))
    shapes: dict[str, Any] = dict.fromkeys(BY_STRIP, by_strip)
    shapes |= dict.fromkeys(NUMBERS, number)
    shapes["drive"] = jax.tree.map(lambda _: number, drive)
    return Beat(*(shapes.get(name, series) for name in Beat._fields))


def check_quantities(quantities: Sequence[Quantity], strips: int, drive: Drive) -> list[Fault]:
    """Return the faults of quantities whose functions fail or return neither a number nor a series."""
    faults = []
    for quantity in quantities:
        if quantity.needs is not None and getattr(drive, quantity.needs) is None:
            rule = f"needs a {quantity.needs}, and the vehicle has none"
            faults.append(Fault("quantity", quantity.name, rule, _FIXES[quantity.needs]))
            continue
        where = f"quantity {quantity.name}"
        of_map = isinstance(quantity, MapQuantity)
        where_said = "MapQuantity" if of_map else "Beat"
        fix = f"write the function in JAX-compatible Python; `{where_said}` documents the function's argument"
        try:
            found = _given_by(quantity.of, strips, drive, of_map)
        except Exception as error:  # whatever a user's function raises
            reason = f"fails: {first_line(error)}"
            faults.append(Fault(where, getattr(quantity.of, "__name__", quantity.of), reason, fix))
            continue
        shape = getattr(found, "shape", None)
        if of_map and (shape is None or len(shape) > 1):
            faults.append(Fault(where, shape, "must give one number, or a row of numbers", fix))
        elif not of_map and (shape is None or shape[:1] not in ((), (_SAMPLES,)) or len(shape) > 2):
            rule = "must give one number, or for each phase a number or a row of numbers"
            faults.append(Fault(where, shape if shape is not None else type(found).__name__, rule, fix))
    return faults
