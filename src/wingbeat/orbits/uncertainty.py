"""How an optimum changes with a number of its problem, by the implicit function theorem.

At an optimum, closure and the margins of active limits vanish, ``c(x, p) = 0``. The Lagrangian's gradient also
vanishes along the directions that these conditions leave free. The objective changes by
``dJ/dp - multipliers . dc/dp``; the change of the optimum does not enter (the envelope theorem). Derivatives by the
unknowns come from the flight and are exact. Derivatives by p are central differences of these exact numbers, so p
can be any number of the problem.
"""

from __future__ import annotations

import functools
import math
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from wingbeat._base import PRECISION, Fault, InvalidInputError, plain_unit
from wingbeat._workers.pool import in_processes
from wingbeat.animal.kinematics import unpack
from wingbeat.orbits.flight.period import CLOSURE, CLOSURE_SCALE, PATH_NAMES, PITCH_STATE
from wingbeat.orbits.nlp.newton_kkt import NewtonKKT, NullSpace
from wingbeat.orbits.nlp.transcription import Transcription, certified_beat
from wingbeat.orbits.options import DEFAULTS, SolverOptions, Status
from wingbeat.orbits.problem.parameters import SIDES, Parameter, bound_of, limit_of
from wingbeat.orbits.problem.problem import OrbitProblem, Unknowns
from wingbeat.orbits.problem.quantity import LASTING, MapQuantity, Quantity
from wingbeat.orbits.solution import correct_guess, search_near
from wingbeat.orbits.solve import Progress, Settings, find_orbit

# Multiples of a step and weights of the values there: central differences, or one-sided ones where a number can
# change one way only.
_CENTRAL = ((-1, -0.5), (1, 0.5))
_UPWARDS = ((0, -1.5), (1, 2.0), (2, -0.5))
_DOWNWARDS = tuple((-at, -weight) for at, weight in _UPWARDS)


class Sensitivity(NamedTuple):
    """Derivatives of the objective, of other quantities and of the unknowns by one parameter, per its unit."""

    parameter: Parameter
    objective: float
    quantities: dict[str, float]
    wingbeat: dict[str, float]
    initial_state: dict[str, float]


class Multiplier(NamedTuple):
    """The derivative of the least objective by the right-hand side of one condition of the optimum."""

    kind: str  # closure, bounds or limit
    name: str
    value: float
    unit: str


class OptimumSlopes:
    """The active set, multipliers and curvature of an optimum; `InvalidInputError` if it is not isolated."""

    def __init__(self, problem: OrbitProblem, unknowns: np.ndarray, options: SolverOptions = DEFAULTS) -> None:
        self.problem = problem
        self._options = options
        fine = Transcription(problem, options, options.sensitivity.fine_blocks)
        guess = fine.scaled(unknowns)
        # The certificate decides which limits are active; all derivatives come from the solver's finer flights.
        certificate = fine.certificate(guess, problem.wingbeat(unknowns))
        newton = NewtonKKT(fine.uncorrected().matched_to(guess, certificate), guess)
        found = newton.converge(fine, guess, options.sensitivity.step_tolerance)
        if found is None:
            rule = "is not an isolated optimum, so its derivatives do not exist or depend on the direction"
            fix = "try a neighbouring speed, or free more parameters of the wingbeat"
            raise InvalidInputError([Fault("orbit", problem.species.name, rule, fix)])
        self._at, self._free, self._active = found, newton.free, newton.active
        self._at_lower = found - fine.lower < fine.upper - found
        own = fine.unknowns
        room = options.sensitivity.room * own.scale
        self._unknowns = Unknowns(own.names, own.lower - room, own.upper + room, own.scale)
        self._here = self._programme(problem)
        tolerance = options.certificate.newton.rank_tolerance
        self._null_space = NullSpace(self._conditions(self._here, found)[1], tolerance)
        gradient = self._here.objective_gradient(found)[self._free]
        self._multipliers = self._null_space.multipliers(gradient)
        null = self._null_space.basis
        bent = [self._along(self._lagrangian_gradient, self._of_free(direction)) for direction in null.T]
        self._curvature = np.reshape(bent, (-1, self._free.sum())) @ null

    @property
    def unknowns(self) -> np.ndarray:
        """The optimum's pitch state at phase 0 and free parameters."""
        return self._at[: self.scale.size] * self.scale

    @property
    def scale(self) -> np.ndarray:
        """Scales of the unknowns: differences that matter."""
        return self._unknowns.scale

    @property
    def objective(self) -> float:
        """The objective at the optimum, in its unit."""
        return self._here.objective(self._at) * self.problem.minimise.scale

    def active(self) -> list[Parameter]:
        """Return the active bounds and limits; the price of each is the derivative of the objective by it."""
        problem, names = self.problem, self._unknowns.names
        found = [
            bound_of(problem, name, SIDES[int(not at_lower)])
            for name, free, at_lower in zip(names, self._free, self._at_lower, strict=False)
            if not free and name in problem.bounds
        ]
        path = self._here.path_limits
        met = dict.fromkeys(limit for limit, on in zip(path, self._active, strict=False) if on)
        found += [bound_of(problem, name, SIDES[int(sign == "<=")]) for name, sign in met if name in PATH_NAMES]
        if self._here.outputs is not None:
            limits = self._here.outputs.with_active(self._active[len(path) :])
            found += [limit_of(problem, i) for i in limits]
        return list(dict.fromkeys(found))  # the body pitch may be at its bound at phase 0 and along the path

    @property
    def has_unique_multipliers(self) -> bool:
        """Whether the gradients of the conditions are independent."""
        return self._null_space.basis.shape[1] + self._multipliers.size == self._free.sum()

    def multipliers(self) -> list[Multiplier]:
        """Return the multipliers of closure, and of the active bounds and limits."""
        problem, here, least = self.problem, self._here, self.problem.minimise
        by_row = self._multipliers * least.scale
        found = [
            Multiplier("closure", name, float(value), f"{least.unit} per {plain_unit(name)}")
            for name, value in zip(CLOSURE, by_row[: len(CLOSURE)] / CLOSURE_SCALE, strict=True)
        ]
        jacobian = here.active_conditions(self._at, self._active)[1]
        slope = (here.objective_gradient(self._at) - jacobian.T @ self._multipliers) * least.scale
        numbers = zip(
            self._unknowns.names, self._free, self._at_lower, slope[: self.scale.size] / self.scale, strict=False
        )
        for name, free, at_lower, value in numbers:
            if not free and name in problem.bounds:  # the search's own bounds of u, w and pitch_rate are none
                side = SIDES[int(not at_lower)]
                found.append(
                    Multiplier("bounds", f"{name}.{side}", float(value), f"{least.unit} per {plain_unit(name)}")
                )
        # A limit along the path, or of a series, may be active at several places: their multipliers add up.
        rows = np.zeros(self._active.size)
        rows[self._active] = by_row[len(CLOSURE) :]
        path = here.path_limits
        for name, sign in dict.fromkeys(limit for limit, on in zip(path, self._active, strict=False) if on):
            value = sum(row for row, limit in zip(rows, path, strict=False) if limit == (name, sign))
            unit = plain_unit(name) if name in PATH_NAMES else "semi-span"
            signed = f"{name}.{SIDES[int(sign == '<=')]}"
            found.append(
                Multiplier("bounds", signed, float(-value if sign == "<=" else value), f"{least.unit} per {unit}")
            )
        if here.outputs is not None:
            rows = rows[len(path) :]
            for i in here.outputs.with_active(self._active[len(path) :]):
                limit = problem.subject_to[i]
                value = rows[here.outputs.values_of(i)].sum() / limit.quantity.scale
                unit = f"{least.unit} per {limit.quantity.unit}"
                name = limit_of(problem, i).path.removeprefix("limit.")
                found.append(Multiplier("limit", name, float(-value if limit.at_most else value), unit))
        # The body pitch is bounded at phase 0, as an unknown, and along the path: one bound, the sum its price.
        by_name: dict[tuple[str, str], Multiplier] = {}
        for one in found:
            before = by_name.get(one[:2])
            by_name[one[:2]] = one if before is None else one._replace(value=before.value + one.value)
        return list(by_name.values())

    def values(self, quantities: Sequence[Quantity]) -> np.ndarray:
        """Return quantities at the optimum; for a series, its largest value."""
        return self._read(self._here, self._at, quantities)

    def by(self, parameter: Parameter, quantities: Sequence[Quantity] = ()) -> Sensitivity:
        """Return the derivatives by one parameter. Theory: equations ``envelope`` and ``optimum-slope``."""
        size, scale = parameter.size, self._unknowns.scale
        moved = np.zeros(self._at.size)
        moves: Parameter | None = parameter
        if parameter.place[0] == "bounds" and parameter.place[1] in self._unknowns.names:
            name, side = parameter.place[1:]
            index = self._unknowns.names.index(str(name))
            if not self._free[index] and side == int(not self._at_lower[index]):
                moved[index] = size / scale[index]  # the other side's bound changes nothing
            if name in self.problem.free:
                moves = None
        residual = self._along(lambda programme, x: self._conditions(programme, x)[0], moved, moves)
        gained = self._along(lambda programme, x: np.array([programme.objective(x)]), moved, moves)[0]
        objective = (gained - self._multipliers @ residual) * self.problem.minimise.scale
        moved = moved + self._of_free(self._null_space.least_norm_step(-residual))
        turned = self._along(self._lagrangian_gradient, moved, moves)
        null = self._null_space.basis
        moved = moved + self._of_free(null @ np.linalg.solve(self._curvature, -null.T @ turned))
        changes = moved[: scale.size] * scale / size
        read = self._along(lambda programme, x: self._read(programme, x, quantities), moved, moves) / size
        return Sensitivity(
            parameter,
            float(objective / size),
            dict(zip((q.name for q in quantities), read.tolist(), strict=True)),
            dict(zip(self.problem.free, changes[4:].tolist(), strict=True)),
            dict(zip(PITCH_STATE, changes[:4].tolist(), strict=True)),
        )

    def _programme(self, problem: OrbitProblem) -> Transcription:
        return Transcription(problem, self._options, self._options.sensitivity.fine_blocks, self._unknowns)

    def _conditions(self, programme: Transcription, scaled: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        values, jacobian = programme.active_conditions(scaled, self._active)
        return values, jacobian[:, self._free]

    def _of_free(self, free: np.ndarray) -> np.ndarray:
        """Expand a direction of the free unknowns to all unknowns."""
        whole = np.zeros(self._at.size)
        whole[self._free] = free
        return whole

    def _lagrangian_gradient(self, programme: Transcription, scaled: np.ndarray) -> np.ndarray:
        gradient = programme.objective_gradient(scaled)[self._free]
        return gradient - self._conditions(programme, scaled)[1].T @ self._multipliers

    def _read(self, programme: Transcription, scaled: np.ndarray, quantities: Sequence[Quantity]) -> np.ndarray:
        """Return quantities of the beat by the certifier's flight, and those of the stroke map by the solver's."""
        problem, unknowns = programme.problem, scaled[: self._unknowns.scale.size] * self._unknowns.scale
        stroke_map, beat = None, None
        found = []
        for quantity in quantities:
            if quantity.parameter in self.problem.free:
                found.append(unknowns[4 + self.problem.free.index(quantity.parameter)])
            elif isinstance(quantity, MapQuantity):
                if stroke_map is None:
                    # Not the certifier's: its map is a difference of flights, and that error of 1e-6 is 1 % of a
                    # derivative.
                    stroke_map = programme.flown(scaled).stroke_map
                found.append(np.max(quantity.of(stroke_map)))
            else:
                if beat is None:
                    # `unpack` skips the constructor's checks: just outside a bound a wingbeat may be invalid, but
                    # it has derivatives.
                    wingbeat = unpack(problem.free, problem.species.wingbeat, unknowns[4:])
                    flown = programme.certificate(scaled, wingbeat)
                    beat = certified_beat(problem, wingbeat, flown)
                found.append(np.max(quantity.of(beat)))
        return np.array(found, dtype=float)

    def _along(
        self,
        function: Callable[[Transcription, np.ndarray], np.ndarray],
        direction: np.ndarray,
        parameter: Parameter | None = None,
    ) -> np.ndarray:
        """Return a function's derivative along a direction of the unknowns, and of a parameter by its size."""
        step = self._options.sensitivity.step / max(1.0, float(np.abs(direction).max()))
        nodes = self._nodes(parameter, step)
        values = [w * function(programme, self._at + at * step * direction) for at, w, programme in nodes]
        return np.sum(values, axis=0) / step

    def _nodes(self, parameter: Parameter | None, step: float) -> list[tuple[int, float, Transcription]]:
        """Return multiples of a step, their weights in a derivative, and the programmes at shifted parameters."""
        if parameter is None:
            return [(at, weight, self._here) for at, weight in _CENTRAL]
        for weights in (_CENTRAL, _UPWARDS, _DOWNWARDS):
            try:
                values = [parameter.value + at * step * parameter.size for at, _ in weights]
                problems = [parameter.changed(self.problem, value) for value in values]
            except InvalidInputError:
                continue
            return [(at, weight, self._programme(p)) for (at, weight), p in zip(weights, problems, strict=True)]
        raise InvalidInputError([Fault(parameter.path, parameter.value, "cannot be changed in either direction")])


# A uniform spread's standard deviation, as a share of its width.
_UNIFORM = 1 / math.sqrt(12)


class ParameterSpread(NamedTuple):
    """Random deviations of some parameters from their values, independent of all other spreads.

    They are uniform between the ends `plausible` of one parameter, or else normal of `covariance`, shape (P, P).
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
    """Propagate spreads to a quantity by its derivatives by every parameter of the spreads."""
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
    short : of each draw without an orbit, the balance that fails most, such as ``thrust``; otherwise empty.

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
    short: tuple[str, ...] = ()


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
    deviations: np.ndarray | None = None,
) -> Samples:
    """Solve a problem for draws of its parameters, also given ones, and compute quantities of certified orbits.

    The derivatives predict an optimum of the same family; its correction, a local search, and a last search from
    `starts` starts follow until one finds an orbit.
    """
    parameters = [p for spread in spreads for p in spread.parameters]
    if deviations is None:
        generator = np.random.default_rng(seed)
        deviations = np.concatenate([spread.draw(generator, count) for spread in spreads], axis=1)
    by_path = {s.parameter.path: [*s.initial_state.values(), *s.wingbeat.values()] for s in slopes}
    predicted = unknowns + deviations @ np.reshape([by_path[p.path] for p in parameters], (-1, len(unknowns)))
    drawn = []
    for row, guess in zip(deviations.tolist(), predicted, strict=True):
        moved = problem
        for parameter, deviation in zip(parameters, row, strict=True):
            moved = parameter.changed(moved, parameter.value + deviation)
        drawn.append((moved, guess))
    work = functools.partial(_read_off, quantities=tuple(quantities), seed=seed, options=options, starts=starts)
    each, at_limit, short = zip(*in_processes(work, drawn, processes, progress), strict=True)
    values, paths = np.array(each), tuple(p.path for p in parameters)
    certified = np.asarray(np.isfinite(values).all(axis=1))
    return Samples(paths, deviations, values, certified, np.array(at_limit), short)


def _read_off(
    drawn: tuple[OrbitProblem, np.ndarray],
    quantities: tuple[Quantity, ...],
    seed: int,
    options: SolverOptions,
    starts: int,
) -> tuple[list[float], list[bool], str]:
    """Return quantities of a draw's orbit, whether limits set them, and without one the balance that fails most."""
    problem, guess = drawn
    found = correct_guess(problem, guess, options=options) or search_near(problem, guess, options=options)
    if found is None and starts:
        found = find_orbit(problem, Settings(starts, seed, starts, advise=False, options=options), threads=1)
    if found is None or found.status is not Status.CONVERGED:
        short = "" if found is None or not found.deficits else found.deficits[0].law
        return [math.nan] * len(quantities), [False] * len(quantities), short
    values = [found.value_of(q) for q in quantities]
    # A battery that cannot feed the beat lasts 0 s, however far it is from feeding it.
    unfed = {q.name for q, value in zip(quantities, values, strict=True) if q.name in LASTING and value == 0}
    return values, [q.name in found.limited | unfed for q in quantities], ""
