"""From the form of a study to its points; every fault is found before anything runs."""

from __future__ import annotations

import functools
import hashlib
import itertools
import json
import math
import warnings
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import NUMERICAL_VERSION, Fault, FaultList, InvalidInputError, WingbeatError
from wingbeat.aero.blade_element import OF_ELEMENTS
from wingbeat.animal.species.building import NO_SUCH_PATH, settable
from wingbeat.animal.species.file_schema import dotted
from wingbeat.animal.species.numbers import shown
from wingbeat.studies.form import StudyForm, number
from wingbeat.studies.recipe import AIR, MOTION, OF_COEFFICIENTS, Recipe, makers_of


def unit_points(method: str, count: int, directions: int, seed: int) -> NDArray[np.float64]:
    """Return points of the unit cube, shape (count, directions).

    Sobol's sequence (scrambled with the seed) begins with the same points for every count, so that points can be
    added later. A Latin hypercube has different points for each count.

    >>> bool((unit_points("sobol", 4, 2, 0) == unit_points("sobol", 8, 2, 0)[:4]).all())
    True
    """
    from scipy.stats import qmc

    random = np.random.default_rng(seed)
    if method == "latin-hypercube":
        return qmc.LatinHypercube(directions, rng=random).random(count)
    with warnings.catch_warnings():
        # If the count is not a power of two, the sequence is a little less even. It has no other effect.
        warnings.filterwarnings("ignore", message="The balance properties of Sobol")
        return qmc.Sobol(directions, scramble=True, rng=random).random(count)


MOST_POINTS = 10_000_000
# After this many faults of a plan, we do not look for more.
_ENOUGH = 100
# Top-level keys whose values are combined, in the order of the loops.
_TOP = (
    *("species", "model", "aero", *OF_COEFFICIENTS, *OF_ELEMENTS, "minimise"),
    *("subject_to", "speed", "climb", "payload", *AIR, "starts", "seed", "most_starts"),
)


class Base(NamedTuple):
    """One combination of the top-level keys: its recipe, the hash of its inputs, and what distinguishes it."""

    recipe: Recipe
    hash: str
    told: dict[str, Any]
    motion: dict[str, float]


class Point(NamedTuple):
    """A point: its key, its base, its chain, its changes to the base, and its varied values."""

    key: str
    base: int
    unit: int
    changes: dict[str, Any]
    values: list[Any]


def canonical(value: Any) -> str:
    """Return the canonical JSON text of a value: keys sorted, numbers as floats, no spaces."""
    return json.dumps(_floats(value), sort_keys=True, separators=(",", ":"), allow_nan=False)


def _digest(value: Any) -> str:
    return hashlib.sha256(canonical(value).encode()).hexdigest()


def _floats(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _floats(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_floats(item) for item in value]
    return number(value)


@dataclass(frozen=True)
class Plan:
    """All points of a study, generated on demand.

    Parameters
    ----------
    form : the study's form, without faults.
    bases : the combinations of the top-level keys.
    """

    form: StudyForm
    bases: tuple[Base, ...]

    @property
    def paths(self) -> tuple[str, ...]:
        """The varied parameters; a chain's parameter is the last."""
        chain = self.form.chain
        return (*(path for path in self.form.vary if path != chain), *([] if chain is None else [chain]))

    @property
    def objectives(self) -> tuple[str, ...]:
        """The names of what the points minimise, which a model may have chosen."""
        return tuple(dict.fromkeys(base.recipe.objective["name"] for base in self.bases))

    @functools.cached_property
    def _kinds(self) -> dict[str, list[str]]:
        """Paths, grouped by how their values are combined: by grid, row by row, or by sample."""
        kinds: dict[str, list[str]] = {"grid": [], "list": [], "range": []}
        for path in self.paths:
            given = self.form.vary[path].how
            kinds["range" if "range" in given else "list" if given == "list" else "grid"].append(path)
        return kinds

    @property
    def chain_length(self) -> int:
        """Number of points in one unit of work; 1 without a chain."""
        return len(self.form.vary[self.form.chain].values) if self.form.chain else 1

    def __len__(self) -> int:
        kinds, form = self._kinds, self.form
        rows = len(form.vary[kinds["list"][0]].values) if kinds["list"] else 1
        grid = math.prod(len(form.vary[path].values) for path in kinds["grid"])
        return len(self.bases) * (form.sample.n if form.sample else 1) * rows * grid

    @functools.cached_property
    def digest(self) -> str:
        """Digest of the plan: equal if two plans have the same points."""
        vary = [[path, self.form.vary[path].model_dump(by_alias=True, exclude_none=True)] for path in self.paths]
        sample = self.form.sample.model_dump() if self.form.sample else None
        bases = [[base.hash, base.motion] for base in self.bases]
        return _digest([NUMERICAL_VERSION, bases, vary, sample, self.form.seed[0], self.form.chain])

    def points(self) -> Iterator[Point]:
        """Yield the points one by one, those of a chain in its order."""
        kinds, form = self._kinds, self.form
        samples = np.zeros((1, 0))
        if form.sample is not None:
            seed = form.seed[0] if form.sample.seed is None else form.sample.seed
            samples = unit_points(form.sample.method, form.sample.n, len(kinds["range"]), seed)
        order = [*kinds["range"], *kinds["list"], *kinds["grid"]]
        places = [order.index(path) for path in self.paths]
        unit = 0
        for index, base in enumerate(self.bases):
            stock = {path: base.recipe.value(path) for path in self.paths}
            rows = list(zip(*(form.vary[path].values for path in kinds["list"]), strict=True)) or [()]
            grids = [_scaled(form, path, stock[path], form.vary[path].values) for path in kinds["grid"]]
            ends = [_scaled(form, path, stock[path], form.vary[path].values) for path in kinds["range"]]
            for sample in samples:
                drawn = [_between(low, high, float(u)) for (low, high), u in zip(ends, sample, strict=True)]
                before: list[Any] = []
                for row, grid in itertools.product(rows, itertools.product(*grids)):
                    found = [*drawn, *row, *grid]
                    values = [found[place] for place in places]
                    before = [] if len(before) == self.chain_length else before
                    point = _point(base, index, unit, dict(zip(self.paths, values, strict=True)), stock, before)
                    yield point
                    if form.chain is not None:
                        before = [*before, values[-1]]
                    unit += len(before) in (0, self.chain_length)


def _point(
    base: Base, index: int, unit: int, values: dict[str, Any], stock: dict[str, Any], before: list[Any]
) -> Point:
    # A value equal to the base's is no change: the point is the same as in a study that does not vary it.
    changes = base.motion | {p: v for p, v in values.items() if p in MOTION or _floats(v) != _floats(stock[p])}
    told = [NUMERICAL_VERSION, base.hash, changes, *([before] if before else [])]
    return Point(_digest(told), index, unit, changes, list(values.values()))


def _between(low: Any, high: Any, share: float) -> Any:
    """Return the value at a share of the way from one number, or list of numbers, to another."""
    if isinstance(low, list):
        return [_between(*ends, share) for ends in zip(low, high, strict=True)]
    return low + (high - low) * share


def _scaled(form: StudyForm, path: str, stock: Any, values: list[Any]) -> list[Any]:
    """Return values; relative ones are multiplied by the base's own value."""
    if not form.vary[path].how.startswith("relative"):
        return values
    return [[factor * v for v in stock] if isinstance(stock, list) else factor * stock for factor in values]


def make_plan(form: StudyForm | None, faults: FaultList, folder: Path) -> Plan:
    """Return the plan of a form.

    `faults` are those in the structure of the form; all faults are raised at once.
    """
    if form is None or any(fault.where.startswith(("vary", "sample", "chain")) for fault in faults.faults):
        faults.raise_if_any()
    assert form is not None
    lists = {name: values for name in _TOP if (values := getattr(form, name)) is not None}
    combinations = math.prod(map(len, lists.values()))
    if combinations > 10_000:
        rule = "give more than 10000 combinations"
        faults.add("lists outside [vary]", combinations, rule, "vary numbers under [vary] instead")
        faults.raise_if_any()
    bases: dict[str, Base] = {}
    makers = makers_of(form, folder)
    for values in itertools.product(*lists.values()):
        base = _base(form, dict(zip(lists, values, strict=True)), makers, faults)
        if base is not None and len(faults.faults) < _ENOUGH:
            _check_values(form, base.recipe, faults)
            bases.setdefault(canonical([base.hash, base.motion]), base)
    faults.faults[:] = dict.fromkeys(faults.faults)
    faults.raise_if_any()
    plan = Plan(form, tuple(bases.values()))
    if len(plan) > MOST_POINTS:
        rule = f"points are more than {MOST_POINTS}"
        faults.add("vary", len(plan), rule, "vary less, or split the study")
        faults.raise_if_any()
    return plan


def _base(
    form: StudyForm,
    chosen: Mapping[str, Any],
    makers: Mapping[str, tuple[tuple[str, ...], Callable[..., Any]]],
    faults: FaultList,
) -> Base | None:
    """Return one combination of the top-level keys, or note why it is impossible."""
    before = len(faults.faults)
    made: dict[str, Any] = {}
    for name, (keys, make) in makers.items():
        if any(key != name and key in makers and key not in made for key in keys):
            continue  # its fault is that of another key
        try:
            made[name] = make(*(chosen.get(key) for key in keys))
        except InvalidInputError as error:
            faults.faults += [_hashable(fault) for fault in error.faults]
        except WingbeatError as error:
            faults.add(name, shown(chosen[name]), str(error))
    search: dict[str, Any] = {name: chosen.get(name) for name in ("starts", "seed", "most_starts")}
    search |= {"advise": form.advise, "explain": form.explain}
    motion = {name: float(chosen[name]) for name in MOTION if name in chosen and name not in form.vary}
    for name, value in motion.items():
        faults.number(name, value, **MOTION[name])
    if len(faults.faults) > before:
        return None
    free, limits = tuple(form.free or ()), tuple(chosen["subject_to"])
    parts = made["species"], made["aero"], made["minimise"], free, made["bounds"], limits, search
    recipe = Recipe(*parts, **made["own"])
    try:
        _ = recipe.example
        inputs = recipe.inputs()
    except InvalidInputError as error:
        faults.faults += [_hashable(fault) for fault in error.faults]
        return None
    told = {name: chosen[name] for name in _TOP if name in chosen and len(getattr(form, name)) > 1}
    # Results depend neither on the kind of the species nor on how it looks.
    species = {key: value for key, value in inputs["species"].items() if key not in ("kind", "shape")}
    return Base(recipe, _digest(inputs | {"species": species}), told, motion)


def _hashable(fault: Fault) -> Fault:
    """Return a fault in a hashable form, so that each fault is reported once."""
    if isinstance(fault.value, str | int | float):
        return fault
    return Fault(fault.where, "None" if fault.value is None else _text(fault.value), fault.rule, fault.fix)


def _check_values(form: StudyForm, recipe: Recipe, faults: FaultList) -> None:
    """Note each value that is impossible at its path, whatever the other values are."""
    names: dict[str, str] = {}
    for path, vary in form.vary.items():
        given, place, name = vary.how, dotted(("vary", path)), recipe.name_of(path)
        where = f"{place}.{given}"
        if (other := names.setdefault(name, path)) != path:
            faults.add(place, given, f"is varied as {other} too", "keep one of the two")
            continue
        free = name.removeprefix("wingbeat.")
        if name.startswith("wingbeat.") and free in recipe.example.free:
            fix = f"vary bounds.{free}.lower or .upper, or choose other parameters in `free`"
            faults.add(place, given, "is free: the solver would overwrite it", fix)
            continue
        stock, values = recipe.value(path), vary.values
        no_number = isinstance(stock, str) or stock is None or not np.any(stock)
        follows = recipe.follows_speed(path)
        known = path in MOTION or follows or stock is not None or settable(path, None, FaultList()) is not None
        if given.startswith("relative") and no_number and known:
            rule, fix = "needs a value other than zero to be relative to", "use grid or range"
            if follows:
                rule = "has no value to be relative to: the animal's own changes with speed"
            if isinstance(stock, str):
                rule, fix = "would multiply a word", "use grid"
            faults.add(where, shown(values), rule, fix)
            continue
        for i, value in enumerate(values if stock is None else _scaled(form, path, stock, values)):
            own = FaultList()
            try:
                recipe.check(path, value, own)
            except InvalidInputError as error:
                own.faults += error.faults
            except (TypeError, ValueError, OverflowError) as error:
                own.add(path, shown(value), f"is impossible there ({error})")
            told = _text(values[i])
            named = [Fault(f"{where}[{i}]", told, fault.rule, fault.fix) for fault in own.faults]
            if unknown := any(fault.rule == NO_SUCH_PATH for fault in named):
                named = [Fault(place, told, named[0].rule, named[0].fix)]
            faults.faults += named
            if len(faults.faults) >= _ENOUGH:
                return
            if unknown:  # whatever the value
                break


def _text(value: Any) -> Any:
    """Return a value, or its text if it is no number."""
    return value if isinstance(value := shown(value), str | int | float) else repr(value)
