"""Uncertainty of an optimum: spreads of parameters, propagated to first order and by samples."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from wingbeat._base import PRECISION
from wingbeat._workers.pool import in_processes
from wingbeat.orbits.options.solver import DEFAULTS, SolverOptions
from wingbeat.orbits.problem.parameters import Parameter
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.problem.quantities import Quantity
from wingbeat.orbits.sensitivity import Sensitivity
from wingbeat.orbits.solve import Progress, correct_guess, find_orbit, search_near
from wingbeat.orbits.status import Status

# A uniform spread's standard deviation, as a share of its width.
_UNIFORM = 1 / math.sqrt(12)


class ParameterSpread(NamedTuple):
    """Random deviations of some parameters from their values, independent of all other spreads.

    ``plausible`` is the lowest and the highest deviation of one parameter, with a uniform distribution between
    them. Without it the deviations are normal, of mean 0 and of `covariance`, shape (P, P).
    """

    name: str
    parameters: tuple[Parameter, ...]
    covariance: np.ndarray
    plausible: tuple[float, float] | None = None

    @property
    def mean(self) -> np.ndarray:
        """Mean deviation of each parameter; not 0 where the value is not in the middle of its range."""
        return np.full(len(self.parameters), 0.0 if self.plausible is None else float(np.mean(self.plausible)))

    def draw(self, generator: np.random.Generator, count: int) -> np.ndarray:
        """Return deviations, shape (count, P)."""
        if self.plausible is not None:
            return generator.uniform(*self.plausible, size=(count, 1))
        return generator.multivariate_normal(np.zeros(len(self.parameters)), self.covariance, size=count)


def uniform_spread(parameter: Parameter, share: float = 1.0) -> ParameterSpread:
    """Return the uniform spread over a parameter's plausible range, or over a share of it about the value."""
    assert parameter.plausible is not None
    low, high = (share * (end - parameter.value) for end in parameter.plausible)
    return ParameterSpread(parameter.path, (parameter,), np.array([[((high - low) * _UNIFORM) ** 2]]), (low, high))


class ErrorBar(NamedTuple):
    """A quantity with its standard deviation, to first order, and the part that is due to each spread.

    To first order, the quantity is a straight line through the optimum. Only samples show whether this line is
    accurate in the whole range. Without samples, rely only on `ranking`, which says which spreads matter most.

    Attributes
    ----------
    quantity : its name.
    unit : of the quantity.
    value : of the quantity at the optimum [`unit`].
    deviation : standard deviation; its square is the sum of the squares of `due_to` [`unit`].
    shift : mean minus `value`; not 0 where a parameter's value is not in the middle of its range [`unit`].
    due_to : standard deviation due to each spread, by its name, the largest first [`unit`].
    set_by_limit : whether a bound or limit of the quantity's own has set it, so that no error bar belongs to it.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> bar = wb.sensitivities(orbit).error_bar("frequency")
    >>> next(iter(bar.ranking)), round(bar.deviation, 1), bar.unit
    ('wing.semi_span', 1.5, 'Hz')
    """

    quantity: str
    unit: str
    value: float
    deviation: float
    shift: float
    due_to: dict[str, float]
    set_by_limit: bool = False

    @property
    def ranking(self) -> dict[str, float]:
        """Share of the variance to first order that is due to each spread, largest first; empty if nothing is."""
        whole = self.deviation**2
        varies = not self.set_by_limit and self.deviation > PRECISION * abs(self.value)
        return {name: part**2 / whole for name, part in self.due_to.items()} if varies else {}

    def ranked(self) -> dict[str, Any]:
        """Return the quantity and its ranking, without an error bar, as plain values for JSON."""
        plain = {name: getattr(self, name) for name in ("quantity", "unit", "value", "set_by_limit")}
        return plain | {"ranking": self.ranking}


def first_order(
    slopes: Sequence[Sensitivity],
    spreads: Sequence[ParameterSpread],
    quantity: str,
    unit: str,
    value: float,
    set_by_limit: bool = False,
) -> ErrorBar:
    """Propagate spreads to a quantity by its derivatives.

    Parameters
    ----------
    slopes : derivatives by every parameter of the spreads.
    spreads : of parameters.
    quantity : name of one of the differentiated quantities.
    unit, value, set_by_limit : of the quantity.
    """
    by_path = {s.parameter.path: s.quantities[quantity] for s in slopes}
    due_to, shift = {}, 0.0
    for spread in spreads:
        slope = np.array([by_path[p.path] for p in spread.parameters])
        due_to[spread.name] = math.sqrt(slope @ spread.covariance @ slope)
        shift += float(slope @ spread.mean)
    ranked = dict(sorted(due_to.items(), key=lambda item: -item[1]))
    return ErrorBar(quantity, unit, value, math.hypot(*ranked.values()), shift, ranked, set_by_limit)


class Samples(NamedTuple):
    """Orbits of n random draws of P parameters, with Q quantities.

    Attributes
    ----------
    paths : names of the parameters, as `Parameter.path`.
    deviations : of the parameters from their values, in this order and in their units, shape (n, P).
    quantities : values in the order requested and in the quantities' units, shape (n, Q); not-a-number for draws
        without an orbit.
    certified : whether a draw has a certified orbit, shape (n,).
    at_limit : whether a bound or limit of a quantity's own has set it, shape (n, Q); None if not known.

    >>> import numpy as np, wingbeat as wb
    >>> deviations, frequencies = np.array([[-0.02], [0.0], [0.02]]), np.array([[9.3], [9.5], [np.nan]])
    >>> drawn = wb.Samples(("body.mass",), deviations, frequencies, certified=np.array([True, True, False]))
    >>> float(drawn.quantities[drawn.certified].mean().round(1))
    9.4
    """

    paths: tuple[str, ...]
    deviations: np.ndarray
    quantities: np.ndarray
    certified: np.ndarray
    at_limit: np.ndarray | None = None


def sample_orbits(
    problem: OrbitProblem,
    unknowns: np.ndarray,
    slopes: Sequence[Sensitivity],
    spreads: Sequence[ParameterSpread],
    quantities: Sequence[Quantity],
    count: int,
    seed: int = 0,
    processes: int = 1,
    progress: Progress | None = None,
    options: SolverOptions = DEFAULTS,
    starts: int = 1,
) -> Samples:
    """Solve a problem for random draws of its parameters.

    For each draw, the derivatives predict an optimum, and a correction of the prediction gives the orbit. So the
    orbit belongs to the same family. If the correction fails, a local search from the prediction follows. If that
    fails too, a last search from `starts` starts follows.

    Parameters
    ----------
    problem, unknowns : the orbit problem and its optimum.
    slopes : its sensitivities by the spreads' parameters.
    spreads : distributions of the parameters.
    quantities : computed for each certified orbit; not-a-number without one.
    count : number of draws.
    seed : of the draws, and of the starts.
    processes, progress, options : as in `solve_orbits`.
    starts : number of starts of the last search, which takes most of the time if many draws have no orbit; 0 omits
        this search.
    """
    generator = np.random.default_rng(seed)
    parameters = [p for spread in spreads for p in spread.parameters]
    deviations = np.concatenate([spread.draw(generator, count) for spread in spreads], axis=1)
    by_path = {s.parameter.path: [*s.initial_state.values(), *s.wingbeat.values()] for s in slopes}
    predicted = unknowns + deviations @ np.array([by_path[p.path] for p in parameters])
    drawn = [(_moved(problem, parameters, row), guess) for row, guess in zip(deviations, predicted, strict=True)]
    work = functools.partial(_read_off, quantities=tuple(quantities), seed=seed, options=options, starts=starts)
    found = in_processes(work, drawn, processes, progress)
    values, at_limit = (np.array(each) for each in zip(*found, strict=True))
    certified = np.asarray(np.isfinite(values).all(axis=1))
    return Samples(tuple(p.path for p in parameters), deviations, values, certified, at_limit)


def _moved(problem: OrbitProblem, parameters: Sequence[Parameter], deviations: np.ndarray) -> OrbitProblem:
    for parameter, deviation in zip(parameters, deviations.tolist(), strict=True):
        problem = parameter.changed(problem, parameter.value + deviation)
    return problem


def _read_off(
    drawn: tuple[OrbitProblem, np.ndarray],
    quantities: tuple[Quantity, ...],
    seed: int,
    options: SolverOptions,
    starts: int,
) -> tuple[list[float], list[bool]]:
    """Return quantities of the orbit of one draw, not-a-number if there is none, and whether limits set them."""
    problem, guess = drawn
    found = correct_guess(problem, guess, options=options) or search_near(problem, guess, options=options)
    if found is None and starts:
        found = find_orbit(problem, starts, seed, threads=1, most_starts=starts, options=options)
    if found is None or found.status is not Status.CONVERGED:
        return [math.nan] * len(quantities), [False] * len(quantities)
    limited = found.limited
    return [found.value_of(q) for q in quantities], [q.name in limited for q in quantities]
