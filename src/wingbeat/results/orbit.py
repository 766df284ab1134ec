"""The class `Orbit`, one periodic orbit with its record, time series and file; how orbits are found and read."""

from __future__ import annotations

import copy
import functools
from collections.abc import Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from os import PathLike
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._base import Fault, FaultList, InvalidInputError, Report, Reported
from wingbeat.animal.kinematics import Wingbeat
from wingbeat.experiment.film_fit import FilmedBeat
from wingbeat.mechanics.flight_model import State
from wingbeat.orbits.batch import find_orbits, find_series
from wingbeat.orbits.changes import Relaxation
from wingbeat.orbits.flight.certificate import certify
from wingbeat.orbits.flight.time_series import flown_beat
from wingbeat.orbits.nlp.transcription import load_record_programs
from wingbeat.orbits.options import DEFAULTS, SolverOptions, Status, check_certified
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.solution import Solution
from wingbeat.orbits.solve import Progress, Settings, check_search, find_orbit
from wingbeat.orbits.starts import start_count, wingbeat_with_all_laws
from wingbeat.orbits.uncertainty import OptimumSlopes
from wingbeat.plots.draw_wingbeat import wingbeat_page
from wingbeat.records.flight_dataset import evaluate, flight_dataset
from wingbeat.records.forms import orbit_attributes, parse_attributes
from wingbeat.records.inputs import inputs_of, own_functions, problem_from, shape_attribute, wingbeat_from
from wingbeat.records.orbit_record import orbit_record
from wingbeat.records.result_files import Saveable, load_dataset
from wingbeat.records.tables import frame_of
from wingbeat.results.optimum import Multipliers, Trace
from wingbeat.results.own_start import own_start
from wingbeat.words.orbit_words import orbit_report

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr
    from matplotlib.figure import Figure

    from wingbeat.viewer.widget import FlightWidget


class Summary(NamedTuple):
    """The results of an orbit that need no evaluation of its loads."""

    status: Status
    message: str
    wingbeat: Wingbeat
    initial_state: State
    relaxations: tuple[Relaxation, ...] = ()


def _summary(record: dict[str, Any]) -> Summary:
    return Summary(
        Status(record["status"]),
        record["message"],
        wingbeat_from(record["wingbeat"]),
        State(**record["initial_state"]),
        tuple(Relaxation(**r) for r in record.get("relaxations", [])),
    )


class Orbit(Saveable, Reported):
    """One periodic orbit, from `solve_orbit`, `solve_orbits`, `load_orbit` or a study.

    What can be done with it::

        orbit.status, orbit.message   how the solver ended, and what that means
        orbit.summary()               what the command line prints; a notebook shows it as a table
        orbit.plot()                  a figure of the wingbeat
        orbit.record()                all results as a dictionary of numbers, SI units and radians
        orbit.dataset                 time series of one beat, an xarray Dataset
        orbit.to_dataframe()          the same as a table of pandas, a row for each sample
        orbit.save("orbit.nc")        a file; `load_orbit` reads it. Tables: .csv, .mat
        orbit.view()                  the flight in motion, in a notebook
        orbit.problem                 the problem it solves, to change and solve again
        orbit.relaxations             single changes that lead to an orbit, if there is none
        orbit.multipliers             Lagrange multipliers of closure, bounds and limits
        orbit.trace                   the solver's steps, after solve_orbit(..., trace=True)

        wb.power_account(orbit.dataset)        the parts of its power, and which spring helps
        wb.sensitivities(orbit)                what its numbers depend on, and how uncertain they are
        wb.differentiable_optimum(orbit, ...)  the optimum as a function that jax.grad differentiates
        wb.export(orbit, "gait.csv")           the motion for robots, MATLAB, motion capture and MuJoCo

    It can be pickled, and copied to another process.

    Attributes
    ----------
    status : how the solver ended.
    message : what the status means, in terms of flight.
    wingbeat : the wingbeat found.
    initial_state : the body's state at phase 0.
    unknowns : pitch state at phase 0 and free parameters, in the form of a solver's initial guess.
    relaxations : if there is no orbit, the single changes that lead to one, the smallest first; then the terms of
        the air loads whose removal leads to an orbit.
    problem : the problem it solves.
    inputs : all inputs, enough to find the orbit again.
    dataset : time series of one beat, labelled, with the record as attributes.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> orbit.status.value, round(orbit.wingbeat.frequency, 1)
    ('converged', 9.5)
    """

    def __init__(
        self,
        summary: Summary,
        inputs: dict[str, Any],
        problem: OrbitProblem | None = None,
        solution: Solution | None = None,
        record: dict[str, Any] | None = None,
        series: xr.Dataset | None = None,
    ) -> None:
        # What is not given is computed on demand: the record from the solution, the series from it or a flight.
        self._summary = summary
        self._inputs = inputs
        self._problem = problem
        self._solution = solution
        self._given_record = record
        self._given_series = series

    @classmethod
    def of(cls, solution: Solution, starts: int, seed: int = 0) -> Orbit:
        """Return the orbit of a solution; record and time series are computed on demand.

        Parameters
        ----------
        solution : result of the solver.
        starts, seed : settings of the solver.
        """
        own = None if solution.start is None else solution.start.values
        inputs = inputs_of(solution.problem, starts, seed, solution.options, own)
        start = State(*solution.certificate.states[0].tolist())
        summary = Summary(solution.status, solution.message, solution.wingbeat, start, solution.relaxations)
        return cls(summary, inputs, solution.problem, solution)

    @classmethod
    def of_record(cls, record: dict[str, Any], problem: OrbitProblem, starts: int, seed: int = 0) -> Orbit:
        """Return the orbit of a record; its time series are computed on demand.

        Parameters
        ----------
        record : an orbit record.
        problem : the problem that it solves.
        starts, seed : settings of the solver.
        """
        return cls(_summary(record), inputs_of(problem, starts, seed), problem, record=record)

    def __getstate__(self) -> dict[str, Any]:
        """Return the state to pickle: the record, and the time series if they have been computed."""
        return vars(self) | {"_record": self._record}

    @functools.cached_property
    def _record(self) -> dict[str, Any]:
        if self._given_record is not None:
            return self._given_record
        assert self._solution is not None
        return orbit_record(self._solution)

    def __repr__(self) -> str:
        what, beat = self._inputs, f"{self.wingbeat.frequency:.3f} Hz"
        return f"<Orbit {what['species']['name']} at {what['speed']:g} m/s: {self.status.value}, {beat}>"

    @property
    def status(self) -> Status:
        """How the solver ended."""
        return self._summary.status

    @property
    def message(self) -> str:
        """What the status means, in terms of flight."""
        return self._summary.message

    @property
    def relaxations(self) -> tuple[Relaxation, ...]:
        """Single changes that lead to an orbit, the smallest first; empty if this is an orbit already.

        `Relaxation.apply` returns the changed problem.
        """
        return self._summary.relaxations

    @property
    def wingbeat(self) -> Wingbeat:
        """The wingbeat found."""
        return self._summary.wingbeat

    @property
    def initial_state(self) -> State:
        """The state at phase 0."""
        return self._summary.initial_state

    @property
    def hinge_start(self) -> np.ndarray:
        """Angle and rate of a pitch hinge that gives way at phase 0, shape (2,) [rad, rad/s]; empty without one."""
        return np.array(list(self._record.get("hinge_start", {}).values()), dtype=float)

    @property
    def unknowns(self) -> np.ndarray:
        """Pitch state at phase 0 and free parameters, in the form of a solver's initial guess."""
        return self.problem.unknowns_of(np.array(self.initial_state), self.wingbeat)

    @functools.cached_property
    def problem(self) -> OrbitProblem:
        """The problem that this orbit solves, set up again from the inputs unless they name a user's function."""
        if self._problem is not None and own_functions(self._inputs):
            return self._problem
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
        if self._given_series is not None:
            return self._given_series
        problem, wingbeat = self._problem or self.problem, self.wingbeat
        own, state = self._solution, np.array(self.initial_state)[2:]
        certificate = certify(problem.model, wingbeat, state) if own is None else own.certificate
        flight = problem.model, wingbeat, certificate.phase, certificate.states
        attributes = orbit_attributes(self._record, self._inputs) | shape_attribute(problem.species)
        loads = evaluate(*flight, certificate.wake, certificate.hinge)
        return flight_dataset(*flight, loads, attributes, hinge=certificate.hinge)

    @functools.cached_property
    def multipliers(self) -> Multipliers:
        """Lagrange, not Floquet, multipliers of closure, active bounds and limits, as `Multipliers` says.

        They are computed with the options that the orbit was solved with; of a loaded orbit, with the defaults.

        Raises
        ------
        InvalidInputError : an orbit that is not certified, or an optimum that is not isolated.
        """
        faults = FaultList()
        check_certified(faults, self.status, self.message, "multipliers")
        faults.raise_if_any()
        options = DEFAULTS if self._solution is None else self._solution.options
        slopes = OptimumSlopes(self.problem, self.unknowns, options)
        return Multipliers(slopes.multipliers(), unique=slopes.has_unique_multipliers)

    @property
    def trace(self) -> Trace:
        """The steps of the searches: objective, residual and step of each iteration.

        Raises
        ------
        InvalidInputError : an orbit that was solved without ``trace=True``.
        """
        if "trace" not in self._record:
            fix = "solve with wb.solve_orbit(problem, trace=True), or `wingbeat orbit --trace`"
            raise InvalidInputError([Fault("orbit.trace", None, "was not kept", fix)])
        return Trace(self._record["trace"], self._record["objective"])

    def _report(self) -> Report:
        return orbit_report(self._record)

    def plot(self) -> Figure:
        """Return a figure of the wingbeat: motion, body pitch, power, portraits, angle of attack and forces.

        >>> import wingbeat as wb
        >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0), starts=1)
        >>> len(orbit.plot().axes) >= 9
        True
        """
        return wingbeat_page(self.dataset)

    def to_dataframe(self) -> pd.DataFrame:
        """Return the time series of one beat, a row for each phase: SI units and radians.

        Columns have the names of `dataset`; those of one strip or hinge end in its number or name.

        >>> import wingbeat as wb
        >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0), starts=1)
        >>> {"time", "flap", "body_pitch", "hinge_power"} <= set(orbit.to_dataframe().columns)
        True
        """
        return frame_of(self.dataset)

    def view(self, beside: Orbit | None = None) -> FlightWidget:
        """Return the flight in motion, for a cell of a notebook; needs the extra ``notebook``.

        Parameters
        ----------
        beside : another orbit to compare with.

        Raises
        ------
        ImportError : without the extra.
        """
        from wingbeat.viewer.widget import FlightWidget

        shown = [self] if beside is None else [self, beside]
        labels = ["first", "second"] if beside else [self._inputs["species"]["name"]]
        return FlightWidget([(label, orbit.dataset) for label, orbit in zip(labels, shown, strict=True)])


def load_orbit(path: str | PathLike[str]) -> Orbit:
    """Read an orbit that `Orbit.save` wrote.

    Parameters
    ----------
    path : of a NetCDF file (.nc).

    Raises
    ------
    FileError : the file is missing, unreadable, truncated, not an orbit of wingbeat, or changed after it was saved.

    >>> import tempfile, pathlib, wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     path = pathlib.Path(folder) / "orbit.nc"
    ...     orbit.save(path)
    ...     wb.load_orbit(path).wingbeat == orbit.wingbeat
    True
    """
    return orbit_from(load_dataset(path, "orbit"))


def orbit_from(dataset: xr.Dataset) -> Orbit:
    """Return the orbit in a dataset that `load_dataset` read and checked."""
    record, inputs = parse_attributes(dataset.attrs)
    return Orbit(_summary(record), inputs, record=record, series=dataset)


def solve_orbit(
    problem: OrbitProblem,
    starts: int | None = None,
    seed: int = 0,
    progress: Progress | None = None,
    options: SolverOptions = DEFAULTS,
    start: Orbit | Wingbeat | tuple[Wingbeat, State] | FilmedBeat | Mapping[str, float] | None = None,
    trace: bool = False,
) -> Orbit:
    """Find and certify the periodic orbit that minimises an objective at a prescribed mean velocity.

    A failure raises no exception: `Orbit.status` says how the solver ended, `Orbit.message` what fails and what to
    do. The orbit then holds the closest wingbeat, and `Orbit.relaxations` lists changes that lead to an orbit.

    Parameters
    ----------
    problem : the orbit problem.
    starts : number of starts; more may find better optima. The default is 24 if the wingbeat's bounds differ from
        the species', or if the largest value of a series is minimised; else 12 if the objective or a limit is a
        quantity of the flown wingbeat, unless there is no limit and the animal beats at its own frequency; else 6;
        1 with `start`.
    seed : of the random starts; the same seed gives the same orbit.
    progress : called with (starts done, starts in all).
    options : every tuning number of the solvers, with the measurement behind it.
    start : where the first search starts; the usual starts follow, if `starts` is more than 1 or if it leads to no
        orbit. It is an orbit; a wingbeat, with or without the state at phase 0; the fit of a film; or some unknowns
        by name, SI and radians. ``record()["start"]`` says what was changed, and whether it led to the result.
    trace : keep objective, residual and step of each iteration, for `Orbit.trace`.

    Raises
    ------
    InvalidInputError : starts or seed out of range; a start that is none of these, or is not finite; a call from
        a function that JAX differentiates with respect to numbers of the problem (see `differentiable_optimum`).

    The condition is ``q(T) = q(0) + (U_x, U_z, 0, ...) T`` of Su et al. 2023 (doi 10.48550/arXiv.2302.09602),
    certified by an independent adaptive flight at rtol 1e-10.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0), starts=1)
    >>> orbit.status.value, max(abs(miss) for miss in orbit.record()["closure"].values()) < 1e-6
    ('converged', True)
    """
    given, kind = ((start.wingbeat, start.initial_state), "orbit") if isinstance(start, Orbit) else (start, "")
    own = None if start is None else own_start(problem, given, kind, options)
    starts = 1 if starts is None and own is not None else start_count(problem, starts, options.search)
    check_search(starts, seed)
    with ThreadPoolExecutor(1) as pool:
        if not flown_beat.loaded:  # read or compiled while the search goes on
            pool.submit(load_record_programs, problem, wingbeat_with_all_laws(problem, options.search))
        settings = Settings(starts, seed, options=options, start=own, trace=trace)
        solution = find_orbit(problem, settings, progress)
    return Orbit.of(solution, starts, seed)


def solve_orbits(
    problems: Sequence[OrbitProblem],
    starts: int | None = None,
    seed: int = 0,
    processes: int = 1,
    progress: Progress | None = None,
    most_starts: int | None = None,
    advise: bool = False,
    in_order: bool = False,
    options: SolverOptions = DEFAULTS,
) -> list[Orbit]:
    """Find and certify an orbit for each problem, in their order; results of similar problems serve as starts.

    Among problems that differ in numbers only, the first few are solved as by `solve_orbit`. For each later
    problem, the first start is predicted from the solutions of these first problems. This start counts only if it
    leads to a certified orbit. If a problem has several optima, this orbit may differ from the one that
    `solve_orbit` finds. The results do not depend on `processes`.

    Records and time series are computed on demand, so you can hold thousands of orbits and look at a few.

    Parameters
    ----------
    problems : any mixture of vehicles, air loads, speeds, free parameters and objectives.
    starts, seed : as in `solve_orbit`, for each problem.
    processes : how many Python processes share the work. A script whose own functions or classes are in the
        problems must then keep its calls under ``if __name__ == "__main__":``.
    progress : called with (problems done, problems in all).
    most_starts : number of starts without an orbit after which the solver gives up; default as in `SearchOptions`.
    advise : for each problem without an orbit, find the single changes that lead to one, as `solve_orbit` does;
        this takes seconds for each.
    in_order : whether the problems are a series, such as speeds in order, with the same free parameters. Each
        problem then also starts from its neighbours' results, up and down the series, until nothing improves.
    options : of the solvers.

    Raises
    ------
    WorkerError : two processes die on the same problem, or processes cannot be started.
    InvalidInputError : something that is not a problem, starts, seed, most_starts or processes out of range, or
        problems in order with different free parameters.

    >>> import wingbeat as wb
    >>> pigeon = wb.load_species("pigeon")
    >>> orbits = wb.solve_orbits([wb.OrbitProblem(pigeon, speed=u) for u in (9.0, 10.0, 11.0)], starts=1)
    >>> [orbit.status.value for orbit in orbits]
    ['converged', 'converged', 'converged']
    """
    settings = Settings(starts, seed, most_starts, advise, options=options)
    found = (find_series if in_order else find_orbits)(problems, settings, processes, progress)
    asked = (start_count(problem, starts, options.search) for problem in problems)
    return [Orbit.of(solution, count, seed) for solution, count in zip(found, asked, strict=True)]
