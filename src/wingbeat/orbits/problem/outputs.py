"""What the solver reads off a flight: quantities of the beat or of its stroke map, with exact derivatives.

A quantity that is a number has one value. A series has one value for each quarter of the beat: its largest there.
Several series, in columns, have one value for each column and quarter. A quantity of the stroke map has as many
values as its function returns. What a function reads and returns is found by tracing it.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._base import Fault, InvalidInputError, first_line
from wingbeat._jax.arrays import jax, jnp
from wingbeat._jax.exported import exported, jit_soon
from wingbeat.animal.drive import Drive
from wingbeat.orbits.flight.beat import BY_STRIP, NUMBERS, PARTS, Beat, WeightedSamples, highest
from wingbeat.orbits.problem.quantity import LASTING, MapQuantity, Quantity

if TYPE_CHECKING:
    from wingbeat._jax.arrays import StrokeMatrix
    from wingbeat.aero import BladeElement
    from wingbeat.orbits.problem.quantities import Constraint

ALL_FIELDS = tuple(name for name in Beat._fields if name != "drive")
# Samples of a beat that serves for its shapes only.
SAMPLES = 1 + 2 * PARTS


# Tracing a function takes 2.5 ms, and every problem of a curve or study needs the shapes.
@functools.lru_cache(256)
def given_by(function: Callable[[Any], Any], strips: int, drive: Any, states: int) -> Any:
    """Return the shapes that a function of a beat, with a drive of this tree, or of a map of `states` returns."""
    if states:
        return jax.eval_shape(function, jax.ShapeDtypeStruct((states, states), jnp.float64))
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


# How to add what a quantity needs to a vehicle.
_FIXES = {
    "muscle": "add a muscle with species.with_muscle(), or set the numbers muscle.* with --set",
    "motor": "add a motor: set the numbers motor.* with --set or in the species file",
    "battery": "add a battery: set the numbers battery.* with --set or in the species file",
}


def _in_floats(drive: Drive) -> Drive:
    return jax.tree.map(float, drive)  # a whole number would make another program


# One program for each function serves all objectives and limits that contain it.
@functools.partial(jit_soon, static_argnums=0)
def _value(function: Callable[[Any], Any], given: Any) -> Any:
    return jnp.asarray(function(given), dtype=float)


@exported(static=("functions", "fields"), kept=False)
def _changes(
    drive: Drive, *series: Any, functions: tuple[Callable[[Beat], Any], ...], fields: tuple[str, ...]
) -> tuple[Any, Any]:
    """Return the values of functions of fields of a beat, and their changes; `series` has fields, then changes."""

    def at(*held: Any) -> Any:
        given = dict.fromkeys(ALL_FIELDS) | dict(zip(fields, held, strict=True))
        return [_value(function, Beat(**given, drive=drive)) for function in functions]

    values, along = jax.linearize(at, *series[: len(fields)])
    return values, jax.vmap(along)(*series[len(fields) :])


@functools.partial(jit_soon, static_argnums=0)
def _map_changes(function: Callable[[Any], Any], stroke_map: StrokeMatrix, changes: Any) -> tuple[Any, Any]:
    """Return the value of a function of the stroke map, and its change for each change of the map."""
    value, along = jax.linearize(lambda at: _value(function, at), stroke_map)
    return value, jax.vmap(along)(changes)


@dataclass(frozen=True)
class _Lacking:
    """The negative of a quantity, or of a series' maximum. It turns a lower limit into an upper one."""

    of: Callable[[Any], Any]

    def __call__(self, given: Any) -> Any:
        return -jnp.max(self.of(given))


class Read(NamedTuple):
    """The parts of a flight that quantities read, or their changes along directions (first axis)."""

    beat: Any = None
    stroke_map: Any = None


class _OfBeat:
    """A function of the beat; a series counts by its peaks. `fields` are the fields that the function reads."""

    def __init__(self, function: Callable[[Any], Any], strips: int, drive: Drive) -> None:
        self.function = function
        self._drive = _in_floats(drive)
        self.fields = fields_read(function, strips, jax.tree.structure(drive))
        self.count = count_of(function, strips, drive)

    def value(self, read: Read) -> np.ndarray:
        beat = read.beat._replace(drive=self._drive).only(self.fields)
        value = np.asarray(_value(self.function, beat))
        return highest(value) if value.ndim else value

    def exactly(self, read: Read) -> np.ndarray:
        return self.value(read)


class _OfMap:
    """A function of the map of `states` over `over`; `smooth_for` is the upper limit whose smooth excess it is."""

    fields = ()

    def __init__(
        self, function: Callable[[Any], Any], states: int, over: float = 1.0, smooth_for: Constraint | None = None
    ) -> None:
        self.function, self._over, self._smooth_for = function, over, smooth_for
        self.count = count_of(function, 0, Drive(), states)

    def value(self, read: Read) -> np.ndarray:
        return np.asarray(_value(self.function, read.stroke_map / self._over))

    def exactly(self, read: Read) -> np.ndarray:
        """Return the value; in place of each number of a smooth excess, the excess of the quantity itself."""
        value, limit = self.value(read), self._smooth_for
        if limit is None:
            return value
        return np.full(value.shape, np.max(_value(limit.quantity.of, read.stroke_map)) - limit.limit)

    def linearised(self, read: Read, changes: Read) -> tuple[np.ndarray, np.ndarray]:
        given = read.stroke_map / self._over, changes.stroke_map / self._over
        value, along = (np.asarray(a) for a in _map_changes(self.function, *given))
        return value, np.moveaxis(along, 0, -1)


class Outputs:
    """The values of several quantities and limits that a flight decides, each divided by its scale.

    Those of the objective come first (`of_objective` of all `count`). `limits` are upper limits of the constraints'
    values; `of_beat` and `of_map` say whether any reads the beat (its `fields`), or the map of so many `states`.
    """

    def __init__(
        self,
        quantities: Sequence[Quantity],
        constraints: Sequence[Constraint],
        strips: int,
        drive: Drive,
        states: int = 4,
    ) -> None:
        def reader(quantity: Quantity, function: Callable[[Any], Any]) -> _OfBeat | _OfMap:
            of_map = isinstance(quantity, MapQuantity)
            return _OfMap(function, states) if of_map else _OfBeat(function, strips, drive)

        def kept(limit: Constraint) -> tuple[_OfBeat | _OfMap, float]:
            quantity = limit.quantity
            if not limit.at_most:
                return reader(quantity, _Lacking(quantity.of)), -limit.limit
            if isinstance(quantity, MapQuantity) and quantity.excess is not None:
                return _OfMap(quantity.excess, states, limit.limit, limit), 0.0
            return reader(quantity, quantity.of), limit.limit

        within = [kept(constraint) for constraint in constraints]
        self._functions = [*(reader(q, q.of) for q in quantities), *(function for function, _ in within)]
        everything = [*quantities, *(c.quantity for c in constraints)]
        self._names = [q.name for q in everything]
        self.of_map = any(isinstance(f, _OfMap) for f in self._functions)
        self.of_beat = any(isinstance(f, _OfBeat) for f in self._functions)
        self.fields = tuple(name for name in Beat._fields if any(name in f.fields for f in self._functions))
        self._drive = _in_floats(drive)
        # By number of samples, because a bound program takes arrays of one shape.
        self._changes: dict[int, Callable[..., Any]] = {}
        counts = [f.count for f in self._functions]
        self._scale = np.repeat([q.scale for q in everything], counts)
        limits = [limit / c.quantity.scale for (_, limit), c in zip(within, constraints, strict=True)]
        self._counts = counts[len(quantities) :]  # of the constraints
        self.limits = np.repeat(limits, self._counts)
        self.count, self.of_objective = sum(counts), sum(counts[: len(quantities)])

    def values(self, read: Read, *, exact: bool = False) -> np.ndarray:
        """Return the values; with `exact`, a smooth limit is judged by the quantity itself."""
        return self._joined(read, [f.exactly(read) if exact else f.value(read) for f in self._functions])

    def linearised(self, read: Read, changes: Read) -> tuple[np.ndarray, np.ndarray]:
        """Return values (for a series, the peaks of a smooth curve) and their derivatives, (values, directions)."""
        of_beat = iter(self._of_beat(read.beat, changes.beat) if self.of_beat else ())
        found = [f.linearised(read, changes) if isinstance(f, _OfMap) else next(of_beat) for f in self._functions]
        derivatives = [along.reshape(-1, along.shape[-1]) for _, along in found]
        return self._joined(read, [value for value, _ in found]), np.concatenate(derivatives) / self._scale[:, None]

    def _of_beat(self, beat: Beat, changes: Beat) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """Yield values and derivatives of each function of the beat; one program has all: a call takes 0.1 ms."""
        samples = len(beat.phase)
        if samples not in self._changes:
            functions = tuple(f.function for f in self._functions if isinstance(f, _OfBeat))
            self._changes[samples] = _changes.bind(self._drive, functions=functions, fields=self.fields)
        series = (getattr(part, name) for part in (beat, changes) for name in self.fields)
        for value, along in zip(*self._changes[samples](*series), strict=True):
            last = np.moveaxis(along, 0, -1)
            if not value.ndim:
                yield value, last
                continue
            weighted = WeightedSamples(value)
            yield weighted.peaks, weighted.of(last)

    def _joined(self, read: Read, values: list[np.ndarray]) -> np.ndarray:
        for name, value in zip(self._names, values, strict=True):
            if not np.isfinite(value).all() and all(np.isfinite(a).all() for a in jax.tree.leaves(read)):
                fix = "the quantity's function must be finite for every flight"
                raise InvalidInputError([Fault(f"quantity {name}", float(value.flat[0]), "is not finite", fix)])
        return np.concatenate([value.ravel() for value in values]) / self._scale

    def values_of(self, index: int) -> range:
        """Return the indices of one constraint among the constraints' values."""
        return range(sum(self._counts[:index]), sum(self._counts[: index + 1]))

    def with_active(self, active: np.ndarray) -> list[int]:
        """Return the indices of constraints with an active value; `active` flags the values of all constraints."""
        return [i for i in range(len(self._counts)) if active[self.values_of(i)].any()]


def value_count(quantity: Quantity, strips: int, drive: Drive, states: int) -> int:
    """Return how many values a quantity of the beat, or of the map of `states`, has: 1 if it is a number."""
    return count_of(quantity.of, strips, drive, states if isinstance(quantity, MapQuantity) else 0)


def count_of(function: Callable[[Any], Any], strips: int, drive: Drive, states: int = 0) -> int:
    """Return how many values a function of a beat, or of a map of `states`, has."""
    shape = given_by(function, strips, jax.tree.structure(drive), states).shape
    return math.prod(shape) if states or not shape else PARTS * math.prod(shape[1:])


def check_quantities(
    quantities: Sequence[Quantity],
    aero: BladeElement,
    drive: Drive,
    states: int,
    minimised: Quantity | None = None,
) -> list[Fault]:
    """Return the faults of quantities whose functions fail, have the wrong shape, or cannot be minimised."""
    faults = []
    if isinstance(minimised, MapQuantity) and minimised.excess is not None:
        rule = "can be limited but not minimised: its optima are at kinks"
        faults.append(Fault("minimise", minimised.name, rule, "minimise gust_response, or limit it"))
    if minimised is not None and minimised.name in LASTING:
        fix = f"minimise electrical_power and limit it, such as '{minimised.name}>=600'"
        faults.append(Fault("minimise", minimised.name, "is best where it is largest", fix))
    for quantity in quantities:
        parts = {None: (), "battery": ("motor", "battery")}.get(quantity.needs, (quantity.needs,))
        lacking = [part for part in parts if getattr(drive, part) is None]
        faults += [
            Fault("quantity", quantity.name, f"needs a {part}, and the vehicle has none", _FIXES[part])
            for part in lacking
        ]
        if lacking:
            continue
        where = f"quantity {quantity.name}"
        of_map = isinstance(quantity, MapQuantity)
        if of_map and aero.wake != "none":
            rule = f"has states of the flight that {quantity.name} does not know"
            faults.append(Fault("aero.wake", aero.wake, rule, "leave the wake out, or limits of stability"))
            continue
        said = "MapQuantity" if of_map else "Beat"
        fix = f"write the function in JAX-compatible Python; `{said}` documents the function's argument"
        try:
            found = given_by(quantity.of, aero.strips, jax.tree.structure(drive), states if of_map else 0)
        except Exception as error:  # whatever a user's function raises
            reason = f"fails: {first_line(error)}"
            faults.append(Fault(where, getattr(quantity.of, "__name__", quantity.of), reason, fix))
            continue
        shape = getattr(found, "shape", None)
        if of_map and (shape is None or len(shape) > 1):
            faults.append(Fault(where, shape, "must give one number, or a row of numbers", fix))
        elif not of_map and (shape is None or shape[:1] not in ((), (SAMPLES,)) or len(shape) > 2):
            rule = "must give one number, or for each phase a number or a row of numbers"
            faults.append(Fault(where, shape if shape is not None else type(found).__name__, rule, fix))
    return faults
