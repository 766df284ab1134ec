"""Error bars from orbits with random parameters: of an orbit's numbers, and of the difference of two conditions."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from wingbeat._base import PRECISION, FaultList
from wingbeat.aero.model_file import Fitted
from wingbeat.orbits.options import DEFAULTS, SolverOptions
from wingbeat.orbits.problem.parameters import parameters_of
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.solve import Progress
from wingbeat.orbits.uncertainty import (
    ErrorBar,
    ParameterSpread,
    Samples,
    Sensitivity,
    first_order,
    sample_orbits,
)
from wingbeat.records.shares import LimitShare, StableShare, Unsolved, limit_share, stable_share, unsolved
from wingbeat.results.sensitivities import QUANTITIES, Sensitivities, quantity_of

# Share of the draws' variance that the first-order estimate must predict. At a tenth and at three tenths of every
# range it predicts 97 to 99.9 %, and its standard deviation agrees with that of the draws. Over the bat's whole
# ranges it predicts 6 %, and the two deviations disagree (docs/guide/sensitivities.md).
_BORNE_OUT = 0.9
# Fewer draws than this do not tell the fourth moment: of 30 from a normal distribution, nine in ten give a kurtosis
# of 1.8 to 3.8, where 3 is right.
_FEW = 30


class Comparison(NamedTuple):
    """A quantity's first-order uncertainty, compared with its uncertainty from random samples.

    Attributes
    ----------
    first_order : the first-order estimate.
    mean, deviation : mean and standard deviation of the samples.
    standard_error : standard error of `deviation`.
    explained : share of the samples' variance that the first-order estimate of each draw explains.
    certified, drawn : number of certified draws, and number of all draws.
    stable : of the quantity ``spectral_radius``, how many of the orbits are stable; otherwise None.
    limited : how many of the orbits have the quantity at a bound or limit of its own.
    unsolved : how many draws have no certified orbit, and why.
    guessed : names of the numbers drawn from a range that is our guess, because the species file is silent.
    """

    first_order: ErrorBar
    mean: float
    deviation: float
    standard_error: float
    explained: float
    certified: int
    drawn: int
    stable: StableShare | None = None
    limited: LimitShare = LimitShare((), 0, 0, None)
    unsolved: Unsolved | None = None
    guessed: tuple[str, ...] = ()

    @property
    def first_order_holds(self) -> bool:
        """Whether the samples confirm the first-order estimate; if not, use it only to rank the inputs."""
        return self.explained >= _BORNE_OUT


def uncertainty_by_samples(
    found: Sensitivities,
    quantities: Sequence[str] = QUANTITIES,
    samples: int = 2000,
    seed: int = 0,
    fit: Fitted | None = None,
    share: float = 1.0,
    processes: int = 1,
    progress: Progress | None = None,
    options: SolverOptions = DEFAULTS,
) -> dict[str, Comparison]:
    """Solve the orbit for randomly drawn parameters, and compare the uncertainty with its first-order estimate.

    Parameters
    ----------
    found : the sensitivities of the orbit.
    quantities : names of quantities that were differentiated; with ``spectral_radius`` among them, stable
        orbits are counted.
    samples : number of random samples.
    seed : of the samples.
    fit, share : as in `Sensitivities.spreads`.
    processes, progress, options : as in `solve_orbits`.

    Raises
    ------
    InvalidInputError : samples not a whole number from 10 to 100000; nothing that is uncertain; inputs that
        `Sensitivities.error_bar` refuses.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> found = wb.sensitivities(orbit)
    >>> checked = wb.uncertainty_by_samples(found, ["frequency"], samples=10, share=0.1)["frequency"]
    >>> checked.drawn, checked.first_order_holds
    (10, True)
    """
    faults = FaultList()
    check_draws(faults, found.problem, samples, share, fit)
    faults.raise_if_any()
    bars = [found.error_bar(name, fit, share) for name in quantities]
    spreads = found.spreads(fit, share)
    read = [quantity_of(name, found.problem.free) for name in quantities]
    drawn = sample_orbits(
        found.problem, found.unknowns, found.slopes, spreads, read, samples, seed, processes, progress, options
    )
    slopes = {s.parameter.path: s for s in found.slopes}
    return {bar.quantity: _compared(bar, drawn, i, slopes) for i, bar in enumerate(bars)}


def check_draws(faults: FaultList, problem: OrbitProblem, samples: int, share: float, fit: Fitted | None) -> None:
    """Note a number of samples or a share out of range, and a problem of which nothing is uncertain."""
    faults.whole("samples", samples, 10, 100_000)
    faults.number("share", share, above=0, at_most=1)
    if fit is None and not any(parameter.plausible for parameter in parameters_of(problem)):
        rule = "has no plausible ranges, so there is nothing to draw"
        faults.add("species", problem.species.name, rule, "give ranges in the species file, or a fit as aero")


def _compared(bar: ErrorBar, drawn: Samples, column: int, slopes: Mapping[str, Sensitivity]) -> Comparison:
    values = drawn.quantities[:, column]
    held = np.zeros(len(values), bool) if drawn.at_limit is None else drawn.at_limit[:, column]
    predicted = drawn.deviations @ [slopes[path].quantities[bar.quantity] for path in drawn.paths]
    size, count = float(np.abs(values[drawn.certified]).max(initial=0.0)), len(values)
    found = _judged(bar, drawn.certified, values, predicted, held, size)
    stable = stable_share(values[drawn.certified], count) if bar.quantity == "spectral_radius" else None
    numbers = [slopes[path].parameter for path in drawn.paths]
    centre = [number.value for number in numbers]
    lost = unsolved(drawn.certified, drawn.short, centre + drawn.deviations, drawn.paths)
    guessed = tuple(number.path for number in numbers if number.guessed)
    return found._replace(stable=stable, unsolved=lost, guessed=guessed)


def _judged(
    bar: ErrorBar, certified: np.ndarray, values: np.ndarray, predicted: np.ndarray, held: np.ndarray, size: float
) -> Comparison:
    """Compare an error bar with the values of certified draws, known to `PRECISION` of a size."""
    values, predicted, held, count = values[certified], predicted[certified], held[certified], len(values)
    deviation, error, explained = 0.0, 0.0, 1.0
    # All draws agree to their last digits if a bound or limit holds the quantity.
    if len(values) and np.ptp(values) > PRECISION * size:
        centred = values - values.mean()
        deviation = float(values.std(ddof=1))
        # The error of a deviation from n draws, by their fourth moment. Few draws do not tell it (three may give no
        # error at all), so they count as drawn from a normal distribution if that has the larger error.
        kurtosis = float(np.mean(centred**4)) / deviation**4
        if len(values) < _FEW:
            kurtosis = max(kurtosis, 3.0)
        error = deviation * np.sqrt(max(kurtosis - 1.0, 0.0) / (4 * len(values)))
        explained = 1.0 - float(np.var(values - bar.value - predicted) / np.var(values))
    mean = float(values.mean()) if len(values) else math.nan
    return Comparison(
        bar, mean, deviation, float(error), explained, len(values), count, limited=limit_share(values, held)
    )


class Difference(NamedTuple):
    """A quantity in two conditions, and its difference with the error bar of paired draws.

    Attributes
    ----------
    here, there : the quantity in each condition.
    difference : that here minus that there, over the draws with a certified orbit in both.
    exact : numbers that the conditions set differently within one plausible range; they are not drawn.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> found = wb.sensitivities(orbit)
    >>> wb.difference_by_samples(found, found, ["frequency"], samples=10, share=0.1)["frequency"].difference.mean
    0.0
    """

    here: Comparison
    there: Comparison
    difference: Comparison
    exact: tuple[str, ...]


def difference_by_samples(
    here: Sensitivities,
    there: Sensitivities,
    quantities: Sequence[str] = QUANTITIES,
    samples: int = 2000,
    seed: int = 0,
    fit: Fitted | None = None,
    share: float = 1.0,
    processes: int = 1,
    progress: Progress | None = None,
    options: SolverOptions = DEFAULTS,
) -> dict[str, Difference]:
    """Solve two conditions for the same random draws, and return each quantity's difference with its error bar.

    A number that is uncertain in both conditions is drawn once, at the same place of its range in each. What both
    share then leaves the difference, which may be certain where two error bars overlap.

    Parameters
    ----------
    here, there : the sensitivities of the orbits in both conditions.
    quantities : names of quantities that were differentiated in both.
    samples, seed, fit, share : as in `uncertainty_by_samples`.
    processes, progress, options : as in `solve_orbits`.

    Raises
    ------
    InvalidInputError : as in `uncertainty_by_samples`.

    >>> import wingbeat as wb
    >>> pigeon = wb.load_species("pigeon")
    >>> animals = [pigeon.with_payload(0.03), pigeon]
    >>> orbits = [wb.solve_orbit(wb.OrbitProblem(one, speed=12.0), starts=1) for one in animals]
    >>> loaded, alone = (wb.sensitivities(orbit) for orbit in orbits)
    >>> found = wb.difference_by_samples(loaded, alone, ["frequency"], samples=10, share=0.1)["frequency"]
    >>> found.difference.deviation < 0.2 * found.here.deviation
    True
    """
    faults = FaultList()
    for found in (here, there):
        check_draws(faults, found.problem, samples, share, fit)
    faults.faults[:] = dict.fromkeys(faults.faults)
    faults.raise_if_any()
    names = [name for name in quantities if here.error_bar(name, fit, share) and there.error_bar(name, fit, share)]
    spreads = [{one.name: one for one in found.spreads(fit, share)} for found in (here, there)]
    exact = tuple(name for name in spreads[0] if name in spreads[1] and _is_set(*(own[name] for own in spreads)))
    ours, theirs = ({name: one for name, one in own.items() if name not in exact} for own in spreads)
    generator = np.random.default_rng(seed)
    drawn = {name: spread.draw(generator, samples) for name, spread in ours.items()}
    matched = {
        name: _moved(drawn[name], ours[name], spread) if name in ours else spread.draw(generator, samples)
        for name, spread in theirs.items()
    }
    found = []
    for i, (one, own, deviations) in enumerate(((here, ours, drawn), (there, theirs, matched))):

        def told(done: int, _: int, before: int = i * samples) -> None:
            if progress is not None:
                progress(before + done, 2 * samples)

        read = [quantity_of(name, one.problem.free) for name in names]
        solved = sample_orbits(
            *(one.problem, one.unknowns, one.slopes, list(own.values()), read, samples, seed, processes, told),
            options=options,
            deviations=np.concatenate([*deviations.values(), np.zeros((samples, 0))], axis=1),
        )
        found.append((one, own, solved, {slope.parameter.path: slope for slope in one.slopes}))
    return {name: _differ(name, i, found[0], found[1], exact) for i, name in enumerate(names)}


def _is_set(here: ParameterSpread, there: ParameterSpread) -> bool:
    """Whether a condition has set a number: its value differs, and its plausible range has not moved along."""
    one, other = here.parameters[0], there.parameters[0]
    if here.plausible is None or one.plausible is None or other.plausible is None:
        return False
    same = np.allclose(one.plausible, other.plausible, rtol=PRECISION, atol=0.0)
    return same and not math.isclose(one.value, other.value, rel_tol=PRECISION)


def _moved(drawn: np.ndarray, here: ParameterSpread, there: ParameterSpread) -> np.ndarray:
    """Return the deviations there that lie at the same places of the range as those drawn here."""
    if here.plausible is None or there.plausible is None:
        return drawn
    (low, high), (least, most) = here.plausible, there.plausible
    return least + (drawn - low) * ((most - least) / (high - low) if high > low else 0.0)


_Solved = tuple[Sensitivities, Mapping[str, ParameterSpread], Samples, Mapping[str, Sensitivity]]


def _differ(name: str, column: int, here: _Solved, there: _Solved, exact: tuple[str, ...]) -> Difference:
    """Return a quantity of two conditions, and its difference to first order and from the pairs of draws."""
    each, parts, shifts, series = [], [], [], []
    for found, spreads, drawn, slopes in (here, there):
        numbers = found.units[name], found.values[name], name in found.limited
        bar = first_order(found.slopes, list(spreads.values()), name, *numbers)
        each.append(_compared(bar, drawn, column, slopes))
        by_path = {path: slope.quantities[name] for path, slope in slopes.items()}
        along = {key: np.array([by_path[p.path] for p in spread.parameters]) for key, spread in spreads.items()}
        parts.append({key: _along_axes(spreads[key], slope) for key, slope in along.items()})
        shifts.append(sum(float(slope @ spreads[key].mean) for key, slope in along.items()))
        values = drawn.quantities[:, column]
        held = np.zeros(len(values), bool) if drawn.at_limit is None else drawn.at_limit[:, column]
        series.append((values, drawn.deviations @ [by_path[path] for path in drawn.paths], held))
    (own, other), limited = (one.first_order for one in each), any(one.first_order.set_by_limit for one in each)
    due_to = {
        key: float(np.linalg.norm(parts[0].get(key, 0.0) - parts[1].get(key, 0.0)))  # type: ignore[operator]
        for key in dict.fromkeys([*parts[0], *parts[1]])
    }
    if math.hypot(*due_to.values()) <= PRECISION * abs(own.value):  # rounding
        due_to = dict.fromkeys(due_to, 0.0)
    due_to = dict(sorted(due_to.items(), key=lambda item: -item[1]))
    numbers = own.value - other.value, math.hypot(*due_to.values()), shifts[0] - shifts[1]
    both = here[2].certified & there[2].certified
    size = max(float(np.abs(values[both]).max(initial=0.0)) for values, _, _ in series)
    values, predicted = (series[0][i] - series[1][i] for i in (0, 1))
    bar = ErrorBar(name, own.unit, *numbers, due_to, limited)
    apart = _judged(bar, both, values, predicted, series[0][2] | series[1][2], size)
    return Difference(each[0], each[1], apart, exact)


def _along_axes(spread: ParameterSpread, slope: np.ndarray) -> np.ndarray:
    """Return the change by one standard deviation along each axis of a covariance, which both conditions share."""
    sizes, axes = np.linalg.eigh(spread.covariance)
    return np.sqrt(np.maximum(sizes, 0.0)) * (axes.T @ slope)
