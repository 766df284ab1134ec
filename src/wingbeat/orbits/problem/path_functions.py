"""Quantities as functions of one beat: values with derivatives, in the optimiser's scale.

A quantity that is a number has one value. A series has one value for each quarter of the beat: its largest there.
Several series, in columns, have one value for each column and quarter.
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
def _value(function: Callable[[Beat], Any], beat: Beat) -> Any:
    return jnp.asarray(function(beat), dtype=float)


@functools.partial(jit_soon, static_argnums=0)
def _changes(function: Callable[[Beat], Any], beat: Beat, changes: Beat) -> tuple[Any, Any]:
    """Return the value of a function of the beat, and its change for each change of the beat."""
    value, along = jax.linearize(lambda beat: _value(function, beat), beat)
    return value, jax.vmap(along)(changes)


@dataclass(frozen=True)
class _Lacking:
    """The negative of a quantity, or of a series' maximum. It turns a lower limit into an upper one."""

    of: Callable[[Beat], Any]

    def __call__(self, beat: Beat) -> Any:
        return -jnp.max(self.of(beat))


class OutputFunctions:
    """The values of several quantities, one after the other, each divided by its scale."""

    def __init__(
        self, quantities: Sequence[Quantity], constraints: Sequence[Constraint], strips: int, drive: Drive
    ) -> None:
        self._drive = jax.tree.map(float, drive)  # a whole number has no derivative
        kept = [c.quantity.of if c.at_most else _Lacking(c.quantity.of) for c in constraints]
        self._functions = tuple([q.of for q in quantities] + kept)
        everything = [*quantities, *(c.quantity for c in constraints)]
        self._names = [q.name for q in everything]
        self.counts = [value_count(function, strips, drive) for function in self._functions]
        self._scale = np.repeat([q.scale for q in everything], self.counts)
        limits = [(c.limit if c.at_most else -c.limit) / c.quantity.scale for c in constraints]
        self.constraint_counts = self.counts[len(quantities) :]
        self.limits = np.repeat(limits, self.constraint_counts)

    def values(self, beat: Beat) -> np.ndarray:
        """Return the values; for a series, its highest sample in each quarter of the beat.

        Raises
        ------
        InvalidInputError : a quantity is not finite although the beat is.
        """
        beat = beat._replace(drive=self._drive)
        found = [np.asarray(_value(function, beat)) for function in self._functions]
        return self._joined(beat, [highest(value) if value.ndim else value for value in found])

    def linearised(self, beat: Beat, changes: Beat) -> tuple[np.ndarray, np.ndarray]:
        """Return the values and their derivatives, shape (values, directions).

        The values of a series are the peaks of a smooth curve through it.

        Raises
        ------
        InvalidInputError : a quantity is not finite although the beat is.
        """
        beat, count = beat._replace(drive=self._drive), changes.phase.shape[0]
        changes = changes._replace(drive=jax.tree.map(lambda number: np.zeros(count), self._drive))
        values, derivatives = [], []
        for function in self._functions:
            value, along = (np.asarray(a) for a in _changes(function, beat, changes))
            along = np.moveaxis(along, 0, -1)
            if value.ndim:
                weighted = WeightedSamples(value)
                value, along = weighted.peaks, weighted.of(along)
            values.append(value)
            derivatives.append(along.reshape(-1, count))
        return self._joined(beat, values), np.concatenate(derivatives) / self._scale[:, None]

    def _joined(self, beat: Beat, values: list[np.ndarray]) -> np.ndarray:
        for name, value in zip(self._names, values, strict=True):
            if not np.isfinite(value).all() and all(np.isfinite(a).all() for a in jax.tree.leaves(beat)):
                fix = "the quantity's function must be finite for every flight"
                raise InvalidInputError([Fault(f"quantity {name}", float(value.flat[0]), "is not finite", fix)])
        return np.concatenate([value.ravel() for value in values]) / self._scale


def value_count(function: Callable[[Beat], Any], strips: int, drive: Drive) -> int:
    """Return how many values a quantity's function has: 1 if it gives a number."""
    shape = _given_by(function, strips, drive).shape
    return PARTS * math.prod(shape[1:]) if shape else 1


# Tracing a function takes 2.5 ms, and every problem of a curve or study needs the shapes.
@functools.lru_cache(256)
def _given_by(function: Callable[[Beat], Any], strips: int, drive: Drive) -> Any:
    """Return the shapes of the arrays that a quantity's function returns."""
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
        fix = "write the function in JAX-compatible Python; `Beat` documents the function's argument"
        try:
            found = _given_by(quantity.of, strips, drive)
        except Exception as error:  # whatever a user's function raises
            reason = f"fails: {first_line(error)}"
            faults.append(Fault(where, getattr(quantity.of, "__name__", quantity.of), reason, fix))
            continue
        shape = getattr(found, "shape", None)
        if shape is None or shape[:1] not in ((), (_SAMPLES,)) or len(shape) > 2:
            rule = "must give one number, or for each phase a number or a row of numbers"
            faults.append(Fault(where, shape if shape is not None else type(found).__name__, rule, fix))
    return faults
