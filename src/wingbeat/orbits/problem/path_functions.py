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
from typing import Any, NamedTuple

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


class Read(NamedTuple):
    """What quantities read of a flight, or its changes along directions (first axis); None if no quantity reads it.

    Attributes
    ----------
    beat : its time series.
    stroke_map : derivative of (body_pitch, u, w, pitch_rate) after the beat by those before it, shape (4, 4).
    """

    beat: Any = None
    stroke_map: Any = None


class _OfBeat(NamedTuple):
    """A function of the beat; a series counts by its peaks."""

    function: Callable[[Any], Any]

    def value(self, read: Read) -> np.ndarray:
        value = np.asarray(_value(self.function, read.beat))
        return highest(value) if value.ndim else value

    def exactly(self, read: Read) -> np.ndarray:
        return self.value(read)

    def linearised(self, read: Read, changes: Read) -> tuple[np.ndarray, np.ndarray]:
        value, along = (np.asarray(a) for a in _changes(self.function, read.beat, changes.beat))
        along = np.moveaxis(along, 0, -1)
        if not value.ndim:
            return value, along
        weighted = WeightedSamples(value)
        return weighted.peaks, weighted.of(along)


class _OfMap(NamedTuple):
    """A function of the stroke map over a number; the upper limit that it stands for, if it is a smooth excess."""

    function: Callable[[Any], Any]
    over: float = 1.0
    smooth_for: Constraint | None = None

    def value(self, read: Read) -> np.ndarray:
        return np.asarray(_value(self.function, read.stroke_map / self.over))

    def exactly(self, read: Read) -> np.ndarray:
        """Return the value, or the excess of the quantity itself, as often as it has smooth numbers."""
        value, limit = self.value(read), self.smooth_for
        if limit is None:
            return value
        return np.full(value.shape, np.max(_value(limit.quantity.of, read.stroke_map)) - limit.limit)

    def linearised(self, read: Read, changes: Read) -> tuple[np.ndarray, np.ndarray]:
        given = read.stroke_map / self.over, changes.stroke_map / self.over
        value, along = (np.asarray(a) for a in _changes(self.function, *given))
        return value, np.moveaxis(along, 0, -1)


def _kept(constraint: Constraint) -> tuple[_OfBeat | _OfMap, float]:
    """Return a function and its upper limit, within which it keeps a constraint."""
    quantity, limit, at_most = constraint.quantity, constraint.limit, constraint.at_most
    kind = _OfMap if isinstance(quantity, MapQuantity) else _OfBeat
    if isinstance(quantity, MapQuantity) and quantity.excess is not None and at_most:
        return _OfMap(quantity.excess, limit, constraint), 0.0
    return kind(quantity.of if at_most else _Lacking(quantity.of)), limit if at_most else -limit


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
        minimised = [_OfMap(q.of) if isinstance(q, MapQuantity) else _OfBeat(q.of) for q in quantities]
        kept = [_kept(constraint) for constraint in constraints]
        self._functions = (*minimised, *(function for function, _ in kept))
        everything = [*quantities, *(c.quantity for c in constraints)]
        self._names = [q.name for q in everything]
        reads_map = [isinstance(f, _OfMap) for f in self._functions]
        self.of_map, self.of_beat = any(reads_map), not all(reads_map)
        given = zip(self._functions, reads_map, strict=True)
        self.counts = [_count(f.function, strips, drive, of_map) for f, of_map in given]
        self._scale = np.repeat([q.scale for q in everything], self.counts)
        limits = [limit / c.quantity.scale for (_, limit), c in zip(kept, constraints, strict=True)]
        self.constraint_counts = self.counts[len(quantities) :]
        self.limits = np.repeat(limits, self.constraint_counts)

    def values(self, read: Read, *, exact: bool = False) -> np.ndarray:
        """Return the values; for a series, its highest sample in each quarter of the beat.

        With `exact`, a limit for which the search uses smooth numbers is judged by the quantity itself.

        Raises
        ------
        InvalidInputError : a quantity is not finite although the flight is.
        """
        read = self._driven(read)
        return self._joined(read, [f.exactly(read) if exact else f.value(read) for f in self._functions])

    def linearised(self, read: Read, changes: Read) -> tuple[np.ndarray, np.ndarray]:
        """Return the values and their derivatives, shape (values, directions).

        The values of a series are the peaks of a smooth curve through it.

        Raises
        ------
        InvalidInputError : a quantity is not finite although the flight is.
        """
        read = self._driven(read)
        if changes.beat is not None:
            still = jax.tree.map(lambda _: np.zeros(changes.beat.phase.shape[0]), self._drive)
            changes = changes._replace(beat=changes.beat._replace(drive=still))
        found = [f.linearised(read, changes) for f in self._functions]
        derivatives = [along.reshape(-1, along.shape[-1]) for _, along in found]
        return self._joined(read, [value for value, _ in found]), np.concatenate(derivatives) / self._scale[:, None]

    def _driven(self, read: Read) -> Read:
        return read if read.beat is None else read._replace(beat=read.beat._replace(drive=self._drive))

    def _joined(self, read: Read, values: list[np.ndarray]) -> np.ndarray:
        for name, value in zip(self._names, values, strict=True):
            if not np.isfinite(value).all() and all(np.isfinite(a).all() for a in jax.tree.leaves(read)):
                fix = "the quantity's function must be finite for every flight"
                raise InvalidInputError([Fault(f"quantity {name}", float(value.flat[0]), "is not finite", fix)])
        return np.concatenate([value.ravel() for value in values]) / self._scale


def value_count(quantity: Quantity, strips: int, drive: Drive) -> int:
    """Return how many values a quantity has: 1 if its function gives a number."""
    return _count(quantity.of, strips, drive, isinstance(quantity, MapQuantity))


def _count(function: Callable[[Any], Any], strips: int, drive: Drive, of_map: bool) -> int:
    shape = _given_by(function, strips, drive, of_map).shape
    return math.prod(shape) if of_map or not shape else PARTS * math.prod(shape[1:])


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
