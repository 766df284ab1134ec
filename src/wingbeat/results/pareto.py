"""What a limit costs: the optima under a series of limits, and the class `ParetoFront` that holds them."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import FaultList, Report, Reported, __version__
from wingbeat.orbits.batch import find_series
from wingbeat.orbits.options import DEFAULTS, SolverOptions, Status
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.problem.quantities import Constraint
from wingbeat.orbits.problem.quantity import Quantity
from wingbeat.orbits.solve import Progress, Settings
from wingbeat.orbits.starts import start_count
from wingbeat.plots.draw_influences import pareto_page
from wingbeat.records.tables import finite_or_none, table_of
from wingbeat.results.orbit import Orbit
from wingbeat.words.curve_words import pareto_report

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

MOST_LIMITS = 200
_OF_ORBIT = ("frequency", "flap_amplitude")
_OF_RECORD = ("mean_positive_power", "stable", "active_bounds")


@dataclass(frozen=True)
class ParetoFront(Reported):
    """The best certified orbits under a series of limits of one quantity; made by `pareto_front`.

    Attributes
    ----------
    quantity : the limited quantity.
    at_most : True if the limits are upper limits.
    limits : from the loosest to the tightest, in the unit of the quantity; the first is None, no limit.
    orbits : the orbit of least objective within each limit.
    values : the quantity in each orbit; NaN without a certified orbit, shape (K,).

    >>> import wingbeat as wb
    >>> problem = wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0)
    >>> front = wb.pareto_front(problem, "spectral_radius", [1.2], starts=1)
    >>> [orbit.status.value for orbit in front.orbits], bool(front.values[1] < front.values[0])
    (['converged', 'converged'], True)
    """

    quantity: Quantity
    at_most: bool
    limits: tuple[float | None, ...]
    orbits: tuple[Orbit, ...]
    values: np.ndarray

    @property
    def objectives(self) -> np.ndarray:
        """The minimised quantity in each orbit; NaN without a certified orbit, shape (K,)."""
        numbers = [
            orbit.record()["objective_value"] if orbit.status is Status.CONVERGED else None for orbit in self.orbits
        ]
        return np.array(numbers, dtype=float)

    @property
    def dominated(self) -> np.ndarray:
        """Whether another orbit is better in one of the two quantities and no worse in the other, shape (K,).

        An orbit without a certificate is neither dominated nor does it dominate.
        """
        sign = 1.0 if self.at_most else -1.0
        costs = np.stack([self.objectives, sign * self.values], axis=-1)
        slack = DEFAULTS.continuation.improvement * np.abs(costs)
        others, own = costs[None], costs[:, None]
        no_worse = np.all(others <= own + slack[:, None], axis=-1)
        better = np.any(others < own - slack[:, None], axis=-1)
        return np.any(no_worse & better, axis=-1)

    def _report(self) -> Report:
        return pareto_report(self.record())

    def plot(self) -> Figure:
        """Return a figure of the front, and of how the wingbeat changes along it."""
        return pareto_page(self.record())

    def to_dataframe(self) -> pd.DataFrame:
        """Return a row for each limit, the first without a limit, with the names of `record`: SI units, radians."""
        return table_of(self.record()["points"])

    def record(self) -> dict[str, Any]:
        """Return all points as a JSON-able dictionary: SI units, radians, None for missing values."""
        first = self.orbits[0].record()
        free = self.objectives[0]
        points = [
            {
                "limit": limit,
                "status": orbit.status.value,
                "message": orbit.message,
                "objective_value": float(objective),
                "quantity_value": float(value),
                "rise": float(objective / free - 1.0) if free else math.nan,
                "dominated": bool(dominated),
                **{name: float(getattr(orbit.wingbeat, name)) for name in _OF_ORBIT},
                **{name: orbit.record()[name] for name in _OF_RECORD},
            }
            for limit, orbit, objective, value, dominated in zip(
                self.limits, self.orbits, self.objectives, self.values, self.dominated, strict=True
            )
        ]
        return finite_or_none(
            {
                **{name: first[name] for name in ("species", "speed", "climb", "objective")},
                **{name: first[name] for name in ("air", "carried_mass") if name in first},
                "objective_unit": self.orbits[0].problem.minimise.unit,
                "quantity": self.quantity.name,
                "quantity_unit": self.quantity.unit,
                "at_most": self.at_most,
                "points": points,
                "version": __version__,
            }
        )


def pareto_front(
    problem: OrbitProblem,
    quantity: Quantity | str,
    limits: Sequence[float],
    *,
    at_most: bool = True,
    starts: int | None = None,
    seed: int = 0,
    processes: int = 1,
    progress: Progress | None = None,
    options: SolverOptions = DEFAULTS,
) -> ParetoFront:
    """Find the best orbits under a series of limits of one quantity: what more of the one costs in the other.

    Each orbit minimises the objective of the problem within one of the limits. One more orbit has no limit. The
    orbits of neighbouring limits serve as starts for each other, so the best family spreads over all limits.

    Parameters
    ----------
    problem : the problem; its own limits hold for all points.
    quantity : that is limited, such as `spectral_radius`: a quantity or its name.
    limits : values in the unit of the quantity, each once, in any order.
    at_most : True for upper limits, False for lower ones.
    starts, seed : as in `solve_orbit`, for each limit.
    processes : how many Python processes share the starts. The results do not depend on it.
    progress : called with (problems solved, problems in all).
    options : of the solvers.

    Returns
    -------
    The front, from no limit to the tightest limit. A limit that no orbit keeps has a point whose status says so.

    Raises
    ------
    InvalidInputError : limits that are not finite, repeated, or not 1 to 200; a quantity that is unknown, that the
        vehicle lacks, or that the problem minimises or limits already; what `solve_orbits` refuses.

    The method is that of the ε-constraint (Haimes et al. 1971, IEEE Trans. Syst. Man Cybern. 1, 296).

    >>> import wingbeat as wb
    >>> problem = wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0)
    >>> front = wb.pareto_front(problem, "spectral_radius", [1.2, 1.0], starts=1)
    >>> front.limits, front.dominated.any()
    ((None, 1.2, 1.0), np.False_)
    """
    faults, values = FaultList(), list(limits)
    good = all([faults.number(f"limits[{i}]", limit) for i, limit in enumerate(values)])
    if not 1 <= len(values) <= MOST_LIMITS:
        faults.add("limits", len(values), f"must be 1 to {MOST_LIMITS} limits", "for example 0.95:1.3:0.05")
    elif good and len(set(values)) < len(values):
        faults.add("limits", values, "has a limit twice", "give each limit once")
    faults.raise_if_any()
    kept = Constraint(quantity, values[0], at_most).quantity  # type: ignore[arg-type]
    if kept.name == problem.minimise.name:
        faults.add("quantity", kept.name, "is minimised", "limit another quantity than the minimised one")
    if any(c.quantity.name == kept.name and c.at_most == at_most for c in problem.subject_to):
        fix = "leave it out of the problem's own limits"
        faults.add("quantity", kept.name, "is limited by the problem already", fix)
    faults.raise_if_any()
    values = sorted((float(limit) for limit in values), reverse=at_most)
    tighter = [(*problem.subject_to, Constraint(kept, limit, at_most)) for limit in values]
    series = [problem, *(dataclasses.replace(problem, subject_to=limits) for limits in tighter)]
    found = find_series(
        series, Settings(starts, seed, advise=False, options=options), processes=processes, progress=progress
    )
    counts = [start_count(one, starts, options.search) for one in series]
    orbits = tuple(Orbit.of(solution, count, seed) for solution, count in zip(found, counts, strict=True))
    reached = [s.value_of(kept) if s.status is Status.CONVERGED else math.nan for s in found]
    return ParetoFront(kept, at_most, (None, *values), orbits, np.array(reached, dtype=float))
