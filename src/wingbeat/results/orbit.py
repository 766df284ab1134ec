"""The orbit a user holds: record, time series, file; and the verbs that make one."""

from __future__ import annotations

import copy
import functools
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from os import PathLike
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat.kinematics import Wingbeat
from wingbeat.loads import flight_loads
from wingbeat.model import State
from wingbeat.orbits.problem import OrbitProblem
from wingbeat.orbits.solve import Progress, Status, find_orbit
from wingbeat.results.dataset import evaluate, flight_dataset
from wingbeat.results.provenance import inputs_of, problem_from
from wingbeat.results.record import orbit_record
from wingbeat.results.storage import load_dataset, orbit_attributes, parse_attributes, save_dataset

if TYPE_CHECKING:
    import xarray as xr


class Orbit:
    """One periodic orbit and everything about it; made by `solve_orbit` or `load_orbit`."""

    def __init__(self, record: dict[str, Any], inputs: dict[str, Any], series: Callable[[], xr.Dataset]) -> None:
        self._record = record
        self._inputs = inputs
        self._series = series

    def __repr__(self) -> str:
        r = self._record
        beat = f"{r['wingbeat']['frequency']:.3f} Hz"
        return f"<Orbit {r['species']} at {r['speed']:g} m/s: {r['status']}, {beat}>"

    @property
    def status(self) -> Status:
        """How the search ended."""
        return Status(self._record["status"])

    @property
    def message(self) -> str:
        """What that means, in flight terms."""
        return self._record["message"]

    @property
    def wingbeat(self) -> Wingbeat:
        """The wingbeat found."""
        return Wingbeat(**self._record["wingbeat"])

    @property
    def initial_state(self) -> State:
        """The state at phase 0."""
        return State(**self._record["initial_state"])

    @property
    def problem(self) -> OrbitProblem:
        """The problem this orbit answers, set up again from its inputs."""
        return problem_from(self._inputs)

    @property
    def inputs(self) -> dict[str, Any]:
        """All inputs, enough to find the orbit again."""
        return copy.deepcopy(self._inputs)

    def record(self) -> dict[str, Any]:
        """Return the orbit record: a JSON-able dictionary in SI units and radians."""
        return copy.deepcopy(self._record)

    @functools.cached_property
    def dataset(self) -> xr.Dataset:
        """The time series of one beat, labelled, with the record as attributes."""
        return self._series()

    def save(self, path: str | PathLike[str]) -> None:
        """Write dataset and record to a NetCDF-4 file, whole or not at all.

        Raises
        ------
        FileError : the file cannot be written.
        """
        save_dataset(self.dataset, path)


def solve_orbit(problem: OrbitProblem, starts: int = 6, seed: int = 0, progress: Progress | None = None) -> Orbit:
    """Find the periodic orbit of least objective at the prescribed mean velocity and certify it.

    A failed search raises nothing: `Orbit.status` says how it ended and `Orbit.message` what to do.

    Parameters
    ----------
    problem : the orbit problem.
    starts : number of searches from different starts; more find better optima.
    seed : of the random starts; the same seed gives the same orbit.
    progress : called with (searches done, searches in all).

    Raises
    ------
    InvalidInputError : starts or seed out of range.

    The condition is ``q(T) = q(0) + (U_x, U_z, 0, ...) T`` of Su et al. 2023
    (doi 10.48550/arXiv.2302.09602), certified by an independent adaptive flight at rtol 1e-10.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0), starts=1)
    >>> orbit.status.value, max(abs(miss) for miss in orbit.record()["closure"].values()) < 1e-6
    ('converged', True)
    """
    model = problem.model
    with ThreadPoolExecutor(1) as pool:
        if not flight_loads.loaded:  # read or compiled while the search goes on
            pool.submit(evaluate, model, problem.species.wingbeat, np.zeros(1), np.zeros((1, 6)))
        solution = find_orbit(problem, starts, seed, progress)
    certificate = solution.certificate
    found = evaluate(model, solution.wingbeat, certificate.phase, certificate.states)
    record = orbit_record(solution, found)
    inputs = inputs_of(problem, starts, seed)

    def series() -> xr.Dataset:
        attributes = orbit_attributes(record, inputs)
        return flight_dataset(model, solution.wingbeat, certificate.phase, certificate.states, found, attributes)

    return Orbit(record, inputs, series)


def load_orbit(path: str | PathLike[str]) -> Orbit:
    """Read an orbit that `Orbit.save` wrote.

    Raises
    ------
    FileError : the file is missing, unreadable, truncated, or not an orbit of wingbeat.
    """
    dataset = load_dataset(path)
    record, inputs = parse_attributes(dataset.attrs, path)
    return Orbit(record, inputs, lambda: dataset)
