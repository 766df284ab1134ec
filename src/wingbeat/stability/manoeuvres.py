"""Manoeuvres from one speed to others, and the controller that flies them: `manoeuvre`."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import FaultList, Report, Reported, __version__
from wingbeat.aero.winds import Wind
from wingbeat.animal.kinematics import Wingbeat, parameter
from wingbeat.mechanics.flight_model import State
from wingbeat.orbits.options import Status, check_certified
from wingbeat.orbits.problem.problem import SPEED_LIMITS
from wingbeat.plots.draw_stability import manoeuvre_page
from wingbeat.records.tables import finite_or_none
from wingbeat.results.flight import Flight, simulate
from wingbeat.stability.inputs import top_of
from wingbeat.stability.manoeuvre_search import (
    BeatMap,
    Road,
    SteadyFlight,
    Transition,
    road_back,
    road_to,
    scales_of,
    schedule,
    steady_start,
    transition,
)
from wingbeat.stability.options import (
    ALLOWED,
    MANOEUVRE,
    ManoeuvreOptions,
    check_delay,
    check_no_hinge,
    check_no_wake,
)
from wingbeat.stability.reports import manoeuvre_report
from wingbeat.stability.riccati import gains_along

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from wingbeat.orbits.solve import Progress
    from wingbeat.results.orbit import Orbit

_MOST_BEATS = 300  # the matrix of more takes a gigabyte


@dataclass(frozen=True)
class Manoeuvre(Reported):
    """A flight from an orbit to steady flights at other speeds, beat by beat; made by `manoeuvre`.

    Attributes
    ----------
    beat_map : the map of a beat, with the first orbit and the names of the inputs.
    ends : the steady flights at the speeds asked for, each as far as it was found.
    free_frequencies : of the orbits of minimum objective at these speeds [Hz].
    legs : number of beats to each of the ends.
    delay : beats by which feedback acts later.
    states : (height, body_pitch, u, w, pitch_rate) at the tops of the stroke, shape (K + 1, 5).
    changes : of the inputs from the first orbit in each beat, shape (K, inputs) [Hz, rad or shares].
    advances : distance flown in each beat [m], shape (K,).
    gains : of the feedback at each top of the stroke, the last for all later ones, on the deviation of the state
        and on the corrections of the last `delay` beats, the oldest first, shape (K + 1, inputs, 5 + delay inputs).
    lower, upper : limits of the changes, shape (inputs,).
    defect : by how much a beat, flown by the adaptive integrator, misses the start of the next at the most, in
        scales of `FeedbackOptions` [-].
    status : converged if the manoeuvre is certified.
    message : what the status means, in terms of flight.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> faster = wb.manoeuvre(orbit, [12.5])
    >>> faster.status.value, len(faster.frequencies) == sum(faster.legs)
    ('converged', True)
    """

    beat_map: BeatMap
    ends: tuple[SteadyFlight, ...]
    free_frequencies: tuple[float, ...]
    legs: tuple[int, ...]
    delay: int
    states: np.ndarray
    changes: np.ndarray
    advances: np.ndarray
    gains: np.ndarray
    lower: np.ndarray
    upper: np.ndarray
    defect: float
    status: Status
    message: str

    @property
    def inputs(self) -> tuple[str, ...]:
        """Names of the parameters of the wingbeat that change."""
        return self.beat_map.inputs

    @property
    def frequencies(self) -> np.ndarray:
        """Frequency of each beat [Hz], shape (K,)."""
        return np.array([self.beat_map.wingbeat(change).frequency for change in self.changes])

    @property
    def times(self) -> np.ndarray:
        """Times of the tops of the stroke [s], shape (K + 1,)."""
        return np.concatenate([[0.0], np.cumsum(1.0 / self.frequencies)])

    @property
    def largest_jump(self) -> float:
        """Largest jump of the wing from one beat to the next, in position or speed [rad or rad/s]."""
        return _largest_jump(self.beat_map, self.changes)

    def controller(self, feedback: bool = True) -> ManoeuvreController:
        """Return a controller for `simulate`.

        Parameters
        ----------
        feedback : whether it reacts to the state; if not, it plays the commands.
        """
        return ManoeuvreController(self, feedback)

    def fly(
        self, wind: Wind | tuple[float, float] | None = None, *, feedback: bool = True, after: int = 10
    ) -> Flight:
        """Fly the manoeuvre with the adaptive integrator, and some beats of the last steady flight.

        Parameters
        ----------
        wind : as in `simulate`.
        feedback : whether the wingbeat reacts to the state.
        after : number of beats after the manoeuvre.
        """
        orbit, beats = self.beat_map.orbit, len(self.changes) + after
        start = orbit.problem.model, orbit.wingbeat, orbit.initial_state
        hold, species = self.controller(feedback), orbit.problem.species
        return simulate(*start, beats, wind=wind, controller=hold, species=species)

    def _report(self) -> Report:
        return manoeuvre_report(self.record())

    def plot(self, flights: Mapping[str, Flight] | None = None) -> Figure:
        """Return a figure of the plan and of flights of it.

        Parameters
        ----------
        flights : of `fly`, by names, at most three. Default: the flight with feedback in still air.
        """
        return manoeuvre_page(self, {"with feedback": self.fly()} if flights is None else flights)

    def record(self) -> dict[str, Any]:
        """Return the numbers as a JSON-able dictionary in SI units and radians; None for missing values."""
        orbit = self.beat_map.orbit
        ends = [
            {
                "speed": end.speed,
                "beats": beats,
                "frequency": end.frequency,
                "free_frequency": free,
                "defect": end.defect,
                "changes": dict(zip(self.inputs, end.changes.tolist(), strict=True)),
                "state": end.state.tolist(),
            }
            for end, beats, free in zip(self.ends, self.legs, self.free_frequencies, strict=False)
        ]
        return finite_or_none(
            {
                "status": self.status.value,
                "message": self.message,
                "species": orbit.inputs["species"]["name"],
                "speed": float(orbit.inputs["speed"]),
                "climb": self.beat_map.climb,
                "state": ["z", "body_pitch", "u", "w", "pitch_rate"],
                "inputs": list(self.inputs),
                "delay": self.delay,
                "ends": ends,
                "time": self.times.tolist(),
                "states": self.states.tolist(),
                "changes": self.changes.tolist(),
                "gains": self.gains.tolist(),
                "lower": self.lower.tolist(),
                "upper": self.upper.tolist(),
                "distance": float(self.advances.sum()),
                "defect": self.defect,
                "largest_jump": self.largest_jump,
                "version": __version__,
            }
        )


class ManoeuvreController:
    """A function of the beats flown and the state at the top of the stroke that returns the next wingbeat.

    It may fly one flight after another. After the last beat of the manoeuvre it holds the last steady flight.

    Theory: equation ``manoeuvre-law``.

    Attributes
    ----------
    manoeuvre : the manoeuvre that it flies.
    feedback : whether it reacts to the state; if not, it plays the commands.
    commands : changes of the inputs in each beat so far, each of shape (inputs,) [Hz, rad or shares].
    """

    def __init__(self, manoeuvre: Manoeuvre, feedback: bool) -> None:
        self.manoeuvre, self.feedback = manoeuvre, feedback
        self.commands: list[np.ndarray] = []
        self._ground = self._time = 0.0
        self._waiting: list[np.ndarray] = []  # corrections that do not act yet, the oldest first

    def __call__(self, beats: int, state: State) -> Wingbeat:
        """Return the wingbeat after so many beats, from the state at the top of the stroke [m, rad, m/s, rad/s]."""
        plan = self.manoeuvre
        if beats == 0:
            self.commands, self._ground, self._time = [], float(state.z), 0.0
            self._waiting = [np.zeros(len(plan.inputs))] * plan.delay
        at = min(beats, len(plan.changes))
        wanted = *plan.changes, plan.ends[-1].changes
        planned = wanted[at]
        if self.feedback:
            height = float(state.z) - self._ground - plan.beat_map.climb * self._time
            deviation = np.concatenate([[height], np.array(state, dtype=float)[2:]]) - plan.states[at]
            correction = -plan.gains[at] @ np.concatenate([deviation, *self._waiting])
            then = wanted[min(beats + plan.delay, len(plan.changes))]
            correction = np.clip(then + correction, plan.lower, plan.upper) - then
            if not np.isfinite(correction).all():  # the vehicle has tumbled
                correction = np.zeros_like(then)
            self._waiting.append(correction)
            planned = planned + self._waiting.pop(0)
        self.commands.append(planned)
        wingbeat = plan.beat_map.wingbeat(planned)
        self._time += 1.0 / wingbeat.frequency
        return wingbeat


def manoeuvre(
    orbit: Orbit,
    speeds: Sequence[float],
    *,
    beats: int | None = None,
    inputs: Sequence[str] | None = None,
    delay: int = 0,
    progress: Progress | None = None,
    options: ManoeuvreOptions = MANOEUVRE,
) -> Manoeuvre:
    """Find the beats that lead from an orbit to steady flights at other speeds, one after the other.

    The wing never jumps: all beats share position and speed of the wing at the top of the stroke with the orbit.
    Each steady flight has the inputs that are nearest to those of the best orbit at its speed. The commands follow
    the steady flights along speed, with the feed-forward that the acceleration needs. Feedback holds the animal on
    the way: its gains solve the Riccati equation backwards along the beats.

    Parameters
    ----------
    orbit : a certified orbit, the start.
    speeds : mean forward speeds to reach [m/s], for example ``[16.0, 6.0]``.
    beats : number of beats to each speed. Default: for the mean acceleration of `ManoeuvreOptions`; if they do not
        suffice, twice as many, and so on.
    inputs : names of the parameters that may change, as in `feedback`.
    delay : beats between a measurement and the beat that feedback changes, 0 to 4.
    progress : called with (beats found, beats in all).
    options : of the search.

    Returns
    -------
    The manoeuvre. Its status is converged if the adaptive integrator, beat by beat, flies from each top of the
    stroke to the next, the steady flights are periodic, and no command exceeds its limit.

    Raises
    ------
    InvalidInputError : an orbit that is not certified, has the lag of the wake or a hinge that gives way, speeds
        that are missing or out of range, beats that are no whole number from 2 to 300, a delay that is none from 0
        to 4, inputs that `linearise` refuses.

    The search is direct multiple shooting (Bock & Plitt 1984, doi 10.1016/S1474-6670(17)61205-9).

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=2)
    >>> faster = wb.manoeuvre(orbit, [13.0])
    >>> faster.status.value, bool(faster.largest_jump < 1e-9)
    ('converged', True)
    """
    faults = FaultList()
    check_manoeuvre(faults, speeds, beats, delay)
    check_certified(faults, orbit.status, "solve it again with more starts")
    check_no_wake(faults, orbit.problem.aero.wake)
    check_no_hinge(faults, orbit.wingbeat)
    faults.raise_if_any()
    beat_map = BeatMap(orbit, inputs, options.blocks)
    here = steady_start(beat_map, options)
    ends, free, legs, chains, passed = [], [], [], [], [here]
    failure: str | None = None
    for speed in map(float, speeds):
        road = road_back(passed, speed, beat_map) or road_to(beat_map, here, speed, options)
        passed += road.flights[1:]
        ends.append(road.flights[-1])
        free.append(road.free_frequency)
        failure = road.failure
        if failure:
            break
        chains.append(_leg(beat_map, road, beats, ends, options))
        count = len(chains[-1].changes)
        legs.append(count)
        if progress is not None:
            progress(sum(legs), sum(legs) + (len(speeds) - len(legs)) * count)
        if not chains[-1].converged:
            failure = f"no commands were found that lead to {speed:g} m/s in {count} beats: give more beats"
            break
        here = ends[-1]
    scales, units = scales_of(beat_map, options)
    states = np.concatenate([beat_map.start[None], *(chain.states[1:] for chain in chains)])
    changes = np.concatenate([np.zeros((0, len(units))), *(chain.changes for chain in chains)])
    advances = np.concatenate([np.zeros(0), *(chain.advances for chain in chains)])
    lower, upper = _limits(beat_map, ends, units, options)
    defect = max([part.defect for part in (*chains, *ends)], default=math.inf)
    if failure is None:
        failure = _excess(beat_map.inputs, changes, lower, upper)
    if failure is None and defect > options.defect:
        failure = f"a beat misses the next by {defect:.1g} of the scales of the state: give more beats"
    jump = _largest_jump(beat_map, np.concatenate([changes, *(end.changes[None] for end in ends)]))
    if failure is None and not jump <= options.jump:
        failure = f"the wing jumps by {jump:.1g} rad or rad/s between two beats: leave out an input"
    gains = np.zeros((len(states), len(units), len(scales) + delay * len(units)))
    if failure is None:
        held = beat_map(ends[-1].state, ends[-1].changes)
        A, B = (np.concatenate([getattr(chain, name) for chain in chains]) for name in "AB")
        gains = gains_along((*A, held.A), (*B, held.B), np.diag(scales**-2), np.diag(units**-2), delay)
    status = Status.CONVERGED if failure is None else Status.NOT_CONVERGED
    message = failure or f"certified: {len(changes)} beats, each ends where the next begins, to {defect:.0e}"
    way = tuple(ends), tuple(free), tuple(legs), delay, states, changes, advances
    return Manoeuvre(beat_map, *way, gains, lower, upper, defect, status, message)


def check_manoeuvre(faults: FaultList, speeds: Any, beats: int | None, delay: int) -> None:
    """Note speeds that are missing or out of range, a number of beats or a delay that no manoeuvre can have."""
    if not isinstance(speeds, list | tuple | np.ndarray) or len(speeds) == 0:
        faults.add("speeds", speeds, "must be a list of speeds", "for example [16.0, 6.0]")
    else:
        for i, speed in enumerate(speeds):
            faults.number(f"speeds[{i}]", speed, **SPEED_LIMITS)
    if beats is not None:
        faults.whole("beats", beats, 2, _MOST_BEATS, "beats to each speed")
    check_delay(faults, delay)


def _leg(
    beat_map: BeatMap, road: Road, beats: int | None, ends: list[SteadyFlight], options: ManoeuvreOptions
) -> Transition:
    """Return the beats along a road; if their number is not given, twice as many as long as they do not suffice."""
    units = scales_of(beat_map, options)[1]
    lower, upper = _limits(beat_map, ends, units, options)
    first, last = road.flights[0], road.flights[-1]
    seconds = abs(last.speed - first.speed) / options.acceleration
    count = min(max(math.ceil(seconds * 0.5 * (first.frequency + last.frequency)), 5), _MOST_BEATS)
    count = beats or count
    for _ in range(options.doublings):
        chain = transition(beat_map, *schedule(road.flights, count), options)
        enough = chain.converged and chain.defect <= options.defect
        if beats or count == _MOST_BEATS or (enough and not _excess(beat_map.inputs, chain.changes, lower, upper)):
            return chain
        count = min(2 * count, _MOST_BEATS)
    return transition(beat_map, *schedule(road.flights, count), options)


def _limits(
    beat_map: BeatMap, ends: list[SteadyFlight], units: np.ndarray, options: ManoeuvreOptions
) -> tuple[np.ndarray, np.ndarray]:
    """Return the limits of the changes: some units beyond the steady flights, and never beyond a wingbeat."""
    steady = np.array([np.zeros(len(units)), *(end.changes for end in ends)])
    room = options.reach * units
    lower, upper = steady.min(axis=0) - room, steady.max(axis=0) + room
    for i, name in enumerate(beat_map.inputs):
        value = float(parameter(beat_map.orbit.wingbeat, name))
        low, high = ALLOWED.get(name, (-math.inf, math.inf))
        lower[i], upper[i] = max(lower[i], low - value), min(upper[i], high - value)
    return lower, upper


def _largest_jump(beat_map: BeatMap, changes: np.ndarray) -> float:
    tops = [top_of(beat_map.wingbeat(change)) for change in changes]
    first = top_of(beat_map.orbit.wingbeat)
    return float(max((np.abs(top - first).max() for top in tops), default=0.0))


def _excess(inputs: tuple[str, ...], changes: np.ndarray, lower: np.ndarray, upper: np.ndarray) -> str | None:
    """Return which command exceeds its limits, if one does."""
    beyond = np.maximum(lower - changes, changes - upper)
    if beyond.size == 0 or beyond.max() <= 0:
        return None
    beat, i = np.unravel_index(int(beyond.argmax()), beyond.shape)
    return f"the command of {inputs[i]} exceeds its limit in beat {beat + 1}: give more beats"
