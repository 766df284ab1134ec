"""What an orbit depends on most, and what its bounds cost."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import Fault, FaultList, InvalidInputError, Report, Reported, drawn
from wingbeat.aero.model_file import Fitted
from wingbeat.orbits.many.uncertainty import (
    ErrorBar,
    ParameterSpread,
    first_order,
    uniform_spread,
)
from wingbeat.orbits.options.solver import DEFAULTS, SolverOptions
from wingbeat.orbits.problem.parameters import CURVES, Parameter, parameters_of
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.problem.quantities import Quantity, named_quantity
from wingbeat.orbits.sensitivity import OptimumSlopes, Sensitivity
from wingbeat.orbits.status import Status
from wingbeat.results.columns import table_of
from wingbeat.results.influence_report import influence_report
from wingbeat.results.orbit import Orbit

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

QUANTITIES = ("frequency", "mean_positive_power")


class Sensitivities(Reported):
    """Derivatives of an optimum with respect to every number it depends on; made by `sensitivities`.

    Attributes
    ----------
    problem : the problem that was solved.
    unknowns : pitch state at phase 0 and free parameters of the optimum.
    values : the quantities at the optimum, by name.
    units : their units.
    slopes : derivatives with respect to the parameters.
    prices : derivatives with respect to the active bounds and limits.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> found = wb.sensitivities(orbit)
    >>> found.ranked("frequency")[0].parameter.path
    'wing.semi_span'
    """

    def __init__(
        self,
        problem: OrbitProblem,
        unknowns: np.ndarray,
        quantities: Sequence[Quantity],
        values: Sequence[float],
        slopes: Sequence[Sensitivity],
        prices: Sequence[Sensitivity],
    ) -> None:
        self.problem = problem
        self.unknowns = unknowns
        self.values = dict(zip((q.name for q in quantities), values, strict=True))
        self.units = {q.name: q.unit for q in quantities}
        self.slopes = list(slopes)
        self.prices = list(prices)

    def __repr__(self) -> str:
        what, count = self.problem.species.name, len(self.slopes)
        return (
            f"<Sensitivities {what} at {self.problem.speed:g} m/s: {count} parameters, {len(self.prices)} bounds>"
        )

    def _report(self) -> Report:
        return influence_report(self)

    def plot(self) -> Figure:
        """Return a figure that ranks the parameters by the effect of their plausible ranges."""
        return drawn("tornado_page", self)

    def to_dataframe(self) -> pd.DataFrame:
        """Return a row for each ranked parameter, then for each active bound, with the names of `table`.

        Values are in SI units and radians. The ends of a plausible range are ``plausible.0`` and ``plausible.1``.

        >>> import wingbeat as wb
        >>> pigeon = wb.load_species("pigeon")
        >>> found = wb.sensitivities(wb.solve_orbit(wb.OrbitProblem(pigeon, speed=10.0), starts=1))
        >>> found.to_dataframe()["parameter"].iloc[-1]
        'bounds.flap_amplitude.upper'
        """
        return table_of(self.table())

    def ranked(self, quantity: str = QUANTITIES[0]) -> list[Sensitivity]:
        """Return the sensitivities to the parameters; those that can change a quantity most come first.

        They are ranked by the change over the plausible range, or, without a range, by the change for one percent.

        Parameters
        ----------
        quantity : name of one that was differentiated.

        Raises
        ------
        InvalidInputError : a quantity that was not differentiated.
        """
        self._check(quantity)
        return sorted(self.slopes, key=lambda s: -max(abs(end) for end in self.swing(s, quantity)))

    def swing(self, slope: Sensitivity, quantity: str) -> tuple[float, float]:
        """Return the change of a quantity to the low and to the high end of a parameter's plausible range.

        Without a range, the ends are one percent below and above the value.

        Parameters
        ----------
        slope : the sensitivity to that parameter.
        quantity : name of one that was differentiated.
        """
        parameter = slope.parameter
        ends = parameter.plausible or (
            parameter.value - 0.01 * parameter.size,
            parameter.value + 0.01 * parameter.size,
        )
        low, high = (slope.quantities[quantity] * (end - parameter.value) for end in ends)
        return low, high

    def table(self) -> list[dict[str, Any]]:
        """Return the ranked sensitivities, then the prices, as plain dictionaries fit for JSON."""
        return [_plain(slope) for slope in [*self.ranked(next(iter(self.values))), *self.prices]]

    @property
    def limited(self) -> frozenset[str]:
        """Names of the quantities and parameters that an active bound or limit of their own has set."""
        names = (price.parameter.path.partition(".")[2] for price in self.prices)
        return frozenset(name.removesuffix(".lower").removesuffix(".upper") for name in names)

    def spreads(self, fit: Fitted | None = None, share: float = 1.0) -> list[ParameterSpread]:
        """Return the uncertainty of the inputs: uniform over their plausible ranges, and a fit's covariance.

        Parameters
        ----------
        fit : the fit from which the coefficients come, read with `read_model`; without it, they count as exact.
        share : every range is narrowed to this share, around the value; the covariance is narrowed alike.

        Raises
        ------
        InvalidInputError : a fit of other coefficients, a share that is not in (0, 1].
        """
        faults = FaultList()
        faults.number("share", share, above=0, at_most=1)
        faults.raise_if_any()
        parameters = [slope.parameter for slope in self.slopes]
        found = [uniform_spread(p, share) for p in parameters if p.plausible is not None]
        return found if fit is None else found + _of_fit(self.problem, parameters, fit, share)

    def error_bar(self, quantity: str, fit: Fitted | None = None, share: float = 1.0) -> ErrorBar:
        """Return a quantity with its standard deviation to first order, and the contributions to it.

        Parameters
        ----------
        quantity : name of one that was differentiated.
        fit, share : as in `spreads`.

        Raises
        ------
        InvalidInputError : a quantity that was not differentiated; inputs that `spreads` refuses.
        """
        self._check(quantity)
        spreads = self.spreads(fit, share)
        numbers = self.units[quantity], self.values[quantity], quantity in self.limited
        return first_order(self.slopes, spreads, quantity, *numbers)

    def _check(self, quantity: str) -> None:
        faults = FaultList()
        faults.choice("quantity", quantity, tuple(self.values))
        faults.raise_if_any()


def sensitivities(
    orbit: Orbit, quantities: Sequence[str | Quantity] = QUANTITIES, options: SolverOptions = DEFAULTS
) -> Sensitivities:
    """Differentiate an orbit with respect to every number it depends on; find the prices of its active bounds.

    The envelope theorem gives the derivative of the objective, ``dJ/dp - multipliers . dc/dp``. The derivatives of
    the wingbeat and of other quantities follow from the conditions of the optimum (implicit function theorem;
    Fiacco 1983, Introduction to Sensitivity and Stability Analysis in Nonlinear Programming).

    Parameters
    ----------
    orbit : a certified orbit, from `solve_orbit` or `load_orbit`.
    quantities : what to differentiate besides objective and wingbeat, quantities or their names.
    options : of the solvers.

    Raises
    ------
    InvalidInputError : an orbit that is not certified, an unknown quantity, an optimum without derivatives.

    >>> import wingbeat as wb
    >>> pigeon = wb.load_species("pigeon")
    >>> found = wb.sensitivities(wb.solve_orbit(wb.OrbitProblem(pigeon, speed=10.0), starts=1))
    >>> [price.parameter.path for price in found.prices]
    ['bounds.flap_amplitude.upper']
    """
    if orbit.status is not Status.CONVERGED:
        rule, fix = "is not certified, so it has no sensitivities", orbit.message
        raise InvalidInputError([Fault("orbit", orbit.status.value, rule, fix)])
    known = [named_quantity(q) if isinstance(q, str) else q for q in quantities]
    problem = orbit.problem
    optimum = OptimumSlopes(problem, orbit.unknowns, options)
    slopes = [optimum.by(one, known) for one in parameters_of(problem)]
    prices = [optimum.by(one, known) for one in optimum.active()]
    return Sensitivities(problem, orbit.unknowns, known, optimum.values(known).tolist(), slopes, prices)


def _plain(slope: Sensitivity) -> dict[str, Any]:
    parameter = slope.parameter
    return {
        "parameter": parameter.path,
        "unit": parameter.unit,
        "value": parameter.value,
        "plausible": None if parameter.plausible is None else list(parameter.plausible),
        "objective": slope.objective,
        "quantities": slope.quantities,
        "wingbeat": slope.wingbeat,
        "initial_state": slope.initial_state,
    }


def _of_fit(
    problem: OrbitProblem, parameters: Sequence[Parameter], fit: Fitted, share: float
) -> list[ParameterSpread]:
    """Return one spread for each curve of a fit, because the errors of a curve's terms are correlated."""
    by_path = {p.path: p for p in parameters}
    coefficients, found = problem.aero.coefficients, []
    names = {field: name for name, field in CURVES.items()}
    for field, curve in fit.curves.items():
        name = names[field]
        paths = [f"aero.{name}.{term}" for term in curve.free]
        if not any(path in by_path for path in paths):
            continue
        if getattr(coefficients, field, None) != curve.terms:
            rule, fix = f"has other {name} terms than the orbit's coefficients", "give the fit that the orbit used"
            raise InvalidInputError([Fault("fit", fit.name, rule, fix)])
        members = tuple(by_path[path] for path in paths)
        found.append(ParameterSpread(f"aero.{name}", members, share**2 * np.asarray(curve.covariance)))
    return found
