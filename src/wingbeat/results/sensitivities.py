"""What an orbit depends on most, what its bounds cost, and its error bars to first order."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import (
    Fault,
    FaultList,
    InvalidInputError,
    Line,
    Report,
    Reported,
    Row,
    Table,
    cf,
    for_people,
    plain_unit,
    suggest,
    written,
)
from wingbeat.aero.model_file import Fitted
from wingbeat.orbits.options import DEFAULTS, SolverOptions, check_certified
from wingbeat.orbits.problem.parameters import CURVES, Parameter, parameters_of
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.problem.quantities import QUANTITIES as BY_NAME
from wingbeat.orbits.problem.quantities import named_objective
from wingbeat.orbits.problem.quantity import MapQuantity, Quantity
from wingbeat.orbits.uncertainty import (
    ErrorBar,
    OptimumSlopes,
    ParameterSpread,
    Sensitivity,
    first_order,
    uniform_spread,
)
from wingbeat.plots.draw_influences import tornado_page
from wingbeat.records.tables import table_of
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
        return tornado_page(self)

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
        rows = []
        for slope in [*self.ranked(next(iter(self.values))), *self.prices]:
            own, plausible = slope.parameter, slope.parameter.plausible
            row = {"parameter": own.path, "unit": own.unit, "value": own.value}
            row |= {"plausible": None if plausible is None else list(plausible), "objective": slope.objective}
            row |= {name: getattr(slope, name) for name in ("quantities", "wingbeat", "initial_state")}
            rows.append(row)
        return rows

    @property
    def guesses(self) -> tuple[str, ...]:
        """A line for each range that is drawn from by a guess, because the species file is silent."""
        return tuple(
            f"{own.path} is not in the species file: drawn from {own.plausible[0]:.3g} to {own.plausible[1]:.3g} "
            "chords, a guess, because it matters to a hinge as much as the stiffness; give it with its range"
            for own in (slope.parameter for slope in self.slopes)
            if own.guessed and own.plausible
        )

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
    quantities : what to differentiate besides objective and wingbeat: quantities, their names, or names of free
        parameters of the wingbeat.
    options : of the solvers.

    Raises
    ------
    InvalidInputError : an orbit that is not certified, an unknown quantity, one that does not know the lag of the
        wake of this orbit, an optimum without derivatives.

    >>> import wingbeat as wb
    >>> pigeon = wb.load_species("pigeon")
    >>> found = wb.sensitivities(wb.solve_orbit(wb.OrbitProblem(pigeon, speed=10.0), starts=1))
    >>> [price.parameter.path for price in found.prices]
    ['bounds.flap_amplitude.upper']
    """
    free = orbit.problem.free
    known, faults = [quantity_of(q, free) if isinstance(q, str) else q for q in quantities], FaultList()
    for unknowing in (q.name for q in known if isinstance(q, MapQuantity) and q.name != "spectral_radius"):
        if (wake := orbit.problem.aero.wake) != "none":
            rule = f"has states of the flight that {unknowing} does not know"
            faults.add("aero.wake", wake, rule, f"leave out {unknowing}, or solve the orbit without the wake")
    faults.raise_if_any()
    return differentiated(orbit, known, options)


@dataclass(frozen=True)
class _OfWingbeat:
    """A free parameter of the wingbeat, which is read off the unknowns: a beat does not hold it."""

    name: str

    def __call__(self, beat: Any) -> Any:
        raise LookupError(f"{self.name} is not a number of the beat")


def quantity_of(name: str, free: Sequence[str] = ()) -> Quantity:
    """Return the quantity of this name, or the free parameter of the wingbeat; hyphens may replace underscores."""
    parameter = name.replace("-", "_")
    if parameter in free and parameter not in BY_NAME:
        return Quantity(parameter, _OfWingbeat(parameter), plain_unit(parameter), parameter=parameter)
    try:
        return named_objective(name)
    except InvalidInputError as error:
        others = [one for one in free if one not in BY_NAME]
        near = suggest(parameter, others, most=1, otherwise=error.faults[0].fix)
        also = f"; free parameters here are {', '.join(others)}" if others and "known quantities" in near else ""
        raise InvalidInputError([dataclasses.replace(error.faults[0], fix=near + also)]) from None


def differentiated(orbit: Orbit, known: Sequence[Quantity], options: SolverOptions) -> Sensitivities:
    """Return the derivatives of an orbit and of quantities, which may read the map of all states of the flight."""
    faults, problem = FaultList(), orbit.problem
    check_certified(faults, orbit.status, orbit.message, "sensitivities")
    faults.raise_if_any()
    optimum = OptimumSlopes(problem, orbit.unknowns, options)
    slopes = [optimum.by(one, known) for one in parameters_of(problem)]
    prices = [optimum.by(one, known) for one in optimum.active()]
    return Sensitivities(problem, orbit.unknowns, known, optimum.values(known).tolist(), slopes, prices)


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


_MOST = 15
_NAMED = 3


def influence_report(found: Sensitivities, bars: Sequence[ErrorBar] | None = None) -> Report:
    """Return what each quantity depends on most, the sensitivities, and the prices of the active bounds."""
    names = list(found.values)
    if bars is None:
        bars = [found.error_bar(name) for name in names]
    headings, rows = [f"{name.replace('_', ' ')} [{found.units[name]}]" for name in names], []
    for slope in found.ranked(names[0])[:_MOST]:
        ends = slope.parameter.plausible
        plausible = "+-1 %" if ends is None else "{:.3g} to {:.3g}".format(*ends)
        plausible += " (a guess)" if slope.parameter.guessed else ""
        swings = ["{:+.2g}, {:+.2g}".format(*found.swing(slope, name)) for name in names]
        rows.append(Row((slope.parameter.path, plausible, *swings)))
    prices = [f"  {price_in_words(price, found)}" for price in found.prices] or ["  none is active"]
    return [
        Line("sensitivities: a first-order ranking, not an error bar", tone="title"),
        *(Line(f"  {ranked_in_words(bar)}") for bar in bars),
        *(Line(f"  {guess}", tone="warning") for guess in found.guesses),
        Line("  for error bars run `wingbeat uncertainty`"),
        Line(""),
        Line("change at the low and high end of each range, extrapolated linearly: for ranking only", tone="title"),
        Table(tuple(rows), ("parameter", "plausible", *headings), "n" + "r" * (1 + len(names))),
        Line(""),
        Line("prices of the active bounds", tone="title"),
        *(Line(price) for price in prices),
    ]


def ranked_in_words(bar: ErrorBar) -> str:
    """Return what a quantity depends on most, without an error bar; angles are in degrees."""
    bar = _for_people(bar)
    parts = ", ".join(f"{name} ({share:.0%})" for name, share in list(bar.ranking.items())[:_NAMED])
    if parts:
        due = f"largest shares of the variance: {parts}"
    elif bar.set_by_limit:
        due = "set by the limit, so it is no prediction and has no error bar"
    else:
        due = "no plausible range moves it" if bar.due_to else "no plausible ranges are known"
    return f"{bar.quantity.replace('_', ' ')} {written(bar.value, unit=bar.unit)}; {due}"


def in_words(bar: ErrorBar) -> str:
    """Return an error bar as a line: value, standard deviation, and its main causes."""
    if not bar.ranking:
        return ranked_in_words(bar)
    bar = _for_people(bar)
    parts = ", ".join(f"{name} {deviation:.2g}" for name, deviation in list(bar.due_to.items())[:_NAMED])
    shown = written(bar.value, bar.deviation, bar.unit)
    return f"{bar.quantity.replace('_', ' ')} {shown}; largest contributions: {parts}"


def _for_people(bar: ErrorBar) -> ErrorBar:
    """Return an error bar in the unit that readers prefer."""
    factor, unit = for_people(cf(bar.unit))
    due_to = {name: factor * deviation for name, deviation in bar.due_to.items()}
    numbers = {name: factor * getattr(bar, name) for name in ("value", "deviation", "shift")}
    return bar._replace(unit=unit, due_to=due_to, **numbers)


def price_in_words(price: Sensitivity, found: Sensitivities) -> str:
    """Return the effect of one more unit of a bound: ``1 deg more of bounds.flap_amplitude.upper: -0.1 Hz``."""
    parameter = price.parameter
    per, unit = (math.radians(1.0), "deg") if parameter.unit == "rad" else (0.01 * parameter.size, parameter.unit)
    amount = 1.0 if unit == "deg" else per
    changes = [
        f"{price.quantities[name] * per:+.3g} {found.units[name]} of {name.replace('_', ' ')}"
        for name in found.values
    ]
    return f"{amount:.3g} {unit} more of {parameter.path}: {', '.join(changes)}"
