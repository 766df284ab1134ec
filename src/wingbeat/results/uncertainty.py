"""Error bars of an orbit from random samples, beside their first-order estimate."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from wingbeat._base import PRECISION, FaultList
from wingbeat.aero.model_file import Fitted
from wingbeat.orbits.many.uncertainty import ErrorBar, Samples, sample_orbits
from wingbeat.orbits.options.solver import DEFAULTS, SolverOptions
from wingbeat.orbits.problem.parameters import parameters_of
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.problem.quantities import named_quantity
from wingbeat.orbits.sensitivity import Sensitivity
from wingbeat.orbits.solve import Progress
from wingbeat.results.limit_share import LimitShare, limit_share
from wingbeat.results.sensitivities import QUANTITIES, Sensitivities
from wingbeat.results.stable_share import StableShare, stable_share

# Share of the draws' variance that the first-order estimate must predict. At a tenth and at three tenths of every
# range it predicts 97 to 99.9 %, and its standard deviation agrees with that of the draws. Over the bat's whole
# ranges it predicts 6 %, and the two deviations disagree (docs/guide/sensitivities.md).
_BORNE_OUT = 0.9


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
    read = [named_quantity(name) for name in quantities]
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


def _compared(bar: ErrorBar, drawn: Samples, column: int, slopes: dict[str, Sensitivity]) -> Comparison:
    values = drawn.quantities[drawn.certified, column]
    predicted = drawn.deviations[drawn.certified] @ [slopes[path].quantities[bar.quantity] for path in drawn.paths]
    deviation, error, explained = 0.0, 0.0, 1.0
    # All draws agree to their last digits if a bound or limit holds the quantity.
    if np.ptp(values) > PRECISION * np.abs(values).max():
        centred = values - values.mean()
        deviation = float(values.std(ddof=1))
        # The error of a deviation from n draws, by their fourth moment.
        kurtosis = float(np.mean(centred**4)) / deviation**4
        error = deviation * np.sqrt(max(kurtosis - 1.0, 0.0) / (4 * len(values)))
        explained = 1.0 - float(np.var(values - bar.value - predicted) / np.var(values))
    count = len(drawn.certified)
    stable = stable_share(values, count) if bar.quantity == "spectral_radius" else None
    held = np.zeros(count, bool) if drawn.at_limit is None else drawn.at_limit[:, column]
    limited = limit_share(values, held[drawn.certified])
    numbers = float(values.mean()), deviation, float(error), explained
    return Comparison(bar, *numbers, len(values), count, stable, limited)
