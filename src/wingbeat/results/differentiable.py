"""The optimum as a function of some numbers of its problem, with its implicit derivative for JAX."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
from jax.core import Tracer

from wingbeat._base import Fault, FaultList, InvalidInputError, suggest
from wingbeat._jax.arrays import jax, jnp
from wingbeat.orbits.options import DEFAULTS, SolverOptions, check_certified
from wingbeat.orbits.problem.parameters import SIDES, Parameter, bound_of, limit_of, parameters_of
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.problem.quantities import named_quantity
from wingbeat.orbits.problem.quantity import Quantity
from wingbeat.orbits.solution import correct_guess, search_near
from wingbeat.orbits.uncertainty import OptimumSlopes
from wingbeat.results.orbit import Orbit


class DifferentiableOptimum:
    """Quantities of the optimum next to a certified orbit, as a function that JAX differentiates.

    `differentiable_optimum` makes it. `jax.grad`, `jacfwd`, `jacrev` and `jit` apply to it.

    Attributes
    ----------
    parameters : names of the numbers that it takes, as in ``--set``.
    at : their values in the orbit's problem, shape (P,).

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0), starts=1)
    >>> frequency = wb.differentiable_optimum(orbit, "body.mass")
    >>> frequency.parameters, round(float(frequency(frequency.at)), 1)
    (('body.mass',), 9.5)
    """

    def __init__(
        self,
        problem: OrbitProblem,
        unknowns: np.ndarray,
        parameters: Sequence[Parameter],
        quantities: str | Sequence[str],
        options: SolverOptions,
    ) -> None:
        self.parameters = tuple(one.path for one in parameters)
        self.at = np.array([one.value for one in parameters])
        self._problem, self._unknowns, self._options = problem, unknowns, options
        self._names = (quantities,) if isinstance(quantities, str) else tuple(quantities)
        own = {*problem.unknowns().names, "objective"}
        self._asked: list[Quantity] = [named_quantity(name) for name in self._names if name not in own]
        self._parameters, self._known = list(parameters), dict[bytes, OptimumSlopes]()
        self._moves: np.ndarray | None = None
        shape = () if isinstance(quantities, str) else (len(self._names),)
        count = len(self.at)

        def found(values: np.ndarray) -> np.ndarray:
            optimum = self._optimum(values)
            read = {q.name: v for q, v in zip(self._asked, optimum.values(self._asked).tolist(), strict=True)}
            read |= dict(zip(problem.unknowns().names, optimum.unknowns.tolist(), strict=True))
            read["objective"] = optimum.objective
            return np.reshape([read[name] for name in self._names], shape)

        def slopes(values: np.ndarray) -> np.ndarray:
            optimum, columns = self._optimum(values), []
            for parameter, value in zip(self._parameters, values.tolist(), strict=True):
                one = optimum.by(parameter._replace(value=value), self._asked)
                read = {**one.quantities, **one.initial_state, **one.wingbeat, "objective": one.objective}
                columns.append([read[name] for name in self._names])
            return np.reshape(np.transpose(columns), (*shape, count))

        def outside(function: Any, values: Any, of: tuple[int, ...]) -> Any:
            """Evaluate outside JAX: at once if the values are known, else when the traced function runs."""
            dtype = jnp.result_type(float)

            def call(held: Any) -> np.ndarray:
                # In a thread of its own, for what JAX traces in this one includes all operations on arrays.
                with ThreadPoolExecutor(1) as pool:
                    return np.asarray(pool.submit(function, np.asarray(held, dtype=float)).result(), dtype)

            if not isinstance(values, Tracer):
                return jnp.asarray(call(values))
            result = jax.ShapeDtypeStruct(of, dtype)
            return jax.pure_callback(call, result, values, vmap_method="sequential")

        @jax.custom_jvp
        def optimum(values: Any) -> Any:
            return outside(found, values, shape)

        @optimum.defjvp
        def _(primals: Any, tangents: Any) -> Any:
            return optimum(*primals), outside(slopes, primals[0], (*shape, count)) @ tangents[0]

        self._function = optimum

    def __call__(self, values: Any) -> Any:
        """Return the quantities at other values of the parameters: a number, or of a list an array, shape (Q,).

        Parameters
        ----------
        values : of the parameters, SI and radians, shape (P,).

        Raises
        ------
        InvalidInputError : another shape, values that the problem refuses, or no certified orbit with derivatives
            next to the given one. Within `jax.jit` and other transformations, JAX raises the last two as its own
            ``JaxRuntimeError`` with the same text.
        """
        if jnp.shape(values) != self.at.shape:
            rule = f"must have the shape {self.at.shape}: {', '.join(self.parameters)}"
            raise InvalidInputError([Fault("values", f"shape {jnp.shape(values)}", rule)])
        return self._function(jnp.asarray(values, jnp.result_type(float)))

    def _optimum(self, values: np.ndarray) -> OptimumSlopes:
        """Return the optimum at other values, in the same family if small steps lead there."""
        key = values.tobytes()
        if key not in self._known:
            problem, guess = self._problem, self._unknowns
            for one, value in zip(self._parameters, values.tolist(), strict=True):
                problem = one.changed(problem, value)
            if self._known:  # to first order from the orbit itself
                if self._moves is None:
                    slopes = [next(iter(self._known.values())).by(one) for one in self._parameters]
                    self._moves = np.array([[*s.initial_state.values(), *s.wingbeat.values()] for s in slopes])
                guess = guess + (values - self.at) @ self._moves
            found = correct_guess(problem, guess, options=self._options)
            found = found or search_near(problem, guess, options=self._options)
            if found is None:
                shown = ", ".join(f"{n}={v:.6g}" for n, v in zip(self.parameters, values.tolist(), strict=True))
                rule, fix = "lead to no certified orbit next to the given one", "take smaller steps from `at`"
                raise InvalidInputError([Fault("values", shown, rule, fix)])
            while len(self._known) > 8:  # the first is the orbit itself
                del self._known[list(self._known)[1]]
            self._known[key] = OptimumSlopes(problem, found.unknowns, self._options)
        return self._known[key]


def differentiable_optimum(
    orbit: Orbit,
    parameters: str | Sequence[str],
    quantities: str | Sequence[str] = "objective",
    options: SolverOptions = DEFAULTS,
) -> DifferentiableOptimum:
    """Return quantities of the optimum next to an orbit as a function of some numbers, for `jax.grad` and others.

    `solve_orbit` itself cannot be traced: it searches, certifies and decides. At other values of the parameters
    this function solves again, next to the orbit, and its derivative is that of `sensitivities`: the implicit
    function theorem on the conditions of the optimum (Fiacco 1983, Introduction to Sensitivity and Stability
    Analysis in Nonlinear Programming). Where another bound or limit becomes active the derivative jumps.

    Parameters
    ----------
    orbit : a certified orbit.
    parameters : names of the numbers, as in ``--set``: ``wing.mass``, ``speed``, ``air.density``,
        ``bounds.flap_amplitude.upper``, ``limit.peak_power`` (``limit.peak_power.upper`` if it is limited on both
        sides); the function takes them in SI units and radians, shape (P,).
    quantities : ``objective``, an unknown such as ``flap_amplitude`` or ``body_pitch``, or a quantity; for one
        name the function returns a number, for a list an array, shape (Q,).
    options : of the solvers.

    Raises
    ------
    InvalidInputError : an orbit that is not certified, an unknown name, an optimum without derivatives. The
        function raises it where no certified orbit is next to the given one.

    >>> import jax, wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0), starts=1)
    >>> frequency = wb.differentiable_optimum(orbit, ["body.mass", "wing.semi_span"])
    >>> [round(float(slope), 1) for slope in jax.grad(frequency)(frequency.at)]
    [14.7, -47.4]
    """
    faults = FaultList()
    paths = [parameters] if isinstance(parameters, str) else list(parameters)
    if not paths:
        faults.add("parameters", paths, "is empty", "name at least one, such as 'wing.mass'")
    check_certified(faults, orbit.status, orbit.message, "derivatives")
    faults.raise_if_any()
    problem = orbit.problem
    known = {one.path: one for one in parameters_of(problem)}
    known |= {p.path: p for name in problem.bounds for side in SIDES for p in [bound_of(problem, name, side)]}
    known |= {p.path: p for i in range(len(problem.subject_to)) for p in [limit_of(problem, i)]}
    for path in paths:
        if path not in known:
            fix = suggest(path, known, otherwise="`wb.sensitivities(orbit).slopes` lists the parameters")
            faults.add("parameters", path, "is no number that this optimum depends on", fix)
    faults.raise_if_any()
    found = [known[path] for path in paths]
    optimum = DifferentiableOptimum(problem, orbit.unknowns, found, quantities, options)
    optimum._optimum(optimum.at)  # refuses an optimum without derivatives before JAX traces anything
    return optimum
