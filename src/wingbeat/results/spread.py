"""How errors of a measured wingbeat spread an orbit's numbers: the flight is solved for each random draw."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from wingbeat.animal.kinematics import Wingbeat, parameter
from wingbeat.orbits.solution import search_near
from wingbeat.records.numbers import POWERS, power_summary
from wingbeat.records.shares import LimitShare, limit_share
from wingbeat.results.orbit import Orbit


class Spread(NamedTuple):
    """Spread of an orbit's numbers over draws of its wingbeat; made by `orbit_spread`.

    Attributes
    ----------
    values : by the name of a number in the record, its values in the certified draws, shape (certified,) each.
    estimates : the same numbers for the orbit itself.
    asked : number of draws, certified or not.
    at_limit : whether a bound or limit of a number's own has set it, shape (certified,), for numbers of `values`;
        None if not known.

    >>> import dataclasses, wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> drawn = [dataclasses.replace(orbit.wingbeat, span_retraction=value) for value in (0.2, 0.3, 0.4)]
    >>> spread = wb.orbit_spread(orbit, drawn)
    >>> sorted(spread.values)[:2], spread.asked
    (['cost_of_transport', 'mean_actuator_power'], 3)
    """

    values: dict[str, np.ndarray]
    estimates: dict[str, float | None]
    asked: int
    at_limit: dict[str, np.ndarray] | None = None

    @property
    def certified(self) -> int:
        """Number of draws that were certified."""
        return len(next(iter(self.values.values())))

    def limited(self, name: str) -> LimitShare:
        """Return how many of the certified draws have a number at a bound or limit of its own.

        Parameters
        ----------
        name : of a number in the record.
        """
        values = self.values[name]
        held = (self.at_limit or {}).get(name)
        return limit_share(values, np.zeros(len(values), dtype=bool) if held is None else held)

    def standard_error(self, name: str) -> float | None:
        """Return the root mean square distance of the draws from the orbit; None if fewer than three are certified.

        The distance is from the orbit, not from the mean of the draws, so that a bias due to noise counts too.

        Parameters
        ----------
        name : of a number in the record.
        """
        values, estimate = self.values[name], self.estimates[name]
        if len(values) < 3 or estimate is None or not np.isfinite(values).all():
            return None
        return float(np.sqrt(np.mean((values - estimate) ** 2)))


def orbit_spread(
    orbit: Orbit, wingbeats: Sequence[Wingbeat], progress: Callable[[int, int], None] | None = None
) -> Spread:
    """Trim and certify each wingbeat, starting from the orbit, and return the spread of the orbit's numbers.

    Parameters
    ----------
    orbit : a certified orbit.
    wingbeats : each one replaces the problem's stock wingbeat; the problem's free parameters are then solved for.
    progress : called with (wingbeats done, wingbeats in all).

    Returns
    -------
    Spread : of powers, cost of transport, and the wingbeat's free parameters, named like ``wingbeat.pitch_mean``.

    >>> import dataclasses, wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> drawn = [dataclasses.replace(orbit.wingbeat, span_retraction=value) for value in (0.2, 0.3, 0.4)]
    >>> spread = wb.orbit_spread(orbit, drawn)
    >>> spread.certified, round(spread.standard_error("mean_positive_power"), 1)  # [W]
    (3, 3.4)
    """
    problem = orbit.problem
    found = []
    for i, wingbeat in enumerate(wingbeats, start=1):
        there = dataclasses.replace(problem, species=problem.species.with_record(wingbeat))
        solution = search_near(there, orbit.unknowns)
        if solution is not None:
            trim = {f"wingbeat.{name}": parameter(solution.wingbeat, name) for name in problem.free}
            power = power_summary(there.vehicle, there.air, there.speed, solution.beat())
            found.append((power | trim, solution.limited))
        if progress is not None:
            progress(i, len(wingbeats))
    record, trimmed = orbit.record(), dict(zip(problem.free, orbit.unknowns[4:], strict=True))
    estimates = {name: record[name] for name in POWERS} | {f"wingbeat.{n}": v for n, v in trimmed.items()}
    columns = {name: np.array([row[name] for row, _ in found], dtype=float) for name in estimates}
    own = {name: name.removeprefix("wingbeat.") for name in estimates}
    at_limit = {n: np.array([own[n] in limited for _, limited in found], dtype=bool) for n in estimates}
    return Spread(columns, estimates, len(wingbeats), at_limit)
