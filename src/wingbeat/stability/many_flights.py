"""Many flights through moving air at once, with or without feedback: `simulate_many` and `survey_gusts`.

One compiled program, `fly_held`, flies them with linear feedback over the segments of a beat, or once a beat.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._base import FaultList, Report, Reported
from wingbeat._jax.arrays import jax, jnp
from wingbeat._jax.exported import exported
from wingbeat.aero.winds import CosineGust, Wind
from wingbeat.animal.kinematics import Wingbeat, unpack
from wingbeat.mechanics.flight_model import FlightModel
from wingbeat.mechanics.flights import air_at, check_wind, fly_beat_in_steps, fly_through
from wingbeat.orbits.options import check_certified
from wingbeat.plots.draw_stability import survey_page
from wingbeat.stability.beat_feedback import Feedback, feedback
from wingbeat.stability.imu import check_noise_of
from wingbeat.stability.inputs import Compensation, Smoother, parameters_of, smoother
from wingbeat.stability.options import FLIGHT_STATE, MANY, MOST_DELAY, ManyOptions, check_no_wake, noise_of
from wingbeat.stability.real_time import bump_parameters, by_beats
from wingbeat.stability.reports import survey_report
from wingbeat.stability.segment_feedback import SegmentFeedback

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

    from wingbeat._jax.arrays import (
        AirOfFlights,
        Flights,
        FlownCommands,
        FlownTimes,
        FlownTops,
        NoiseOfFlights,
        Scalar,
        StateVector,
    )
    from wingbeat.results.orbit import Orbit


class Hold(NamedTuple):
    """Linear feedback as arrays; feedback from beat to beat has one segment."""

    gains: np.ndarray  # of each segment, shape (segments, commands, 5 + delay * commands)
    lower: np.ndarray  # largest commands, shape (commands,)
    upper: np.ndarray
    shares: np.ndarray  # changes of the inputs per unit of each command, shape (inputs, commands)
    smoother: Smoother  # makes the parameters of a wingbeat from changes of the inputs
    phases: np.ndarray  # ends of the segments, shape (segments + 1,)
    path: np.ndarray  # (z, body_pitch, u, w, pitch_rate) at their starts, z from that at phase 0, (segments, 5)
    pitch: np.ndarray  # body pitch of the orbit at the ends of all steps [rad], shape (segments, steps + 1)


@exported(static=("inputs", "harmonics", "delay", "late"))
def fly_held(
    model: FlightModel,
    wingbeat: Wingbeat,
    hold: Hold,
    start: StateVector,
    climb: Scalar,
    air: AirOfFlights,
    spacing: Scalar,
    noise: NoiseOfFlights,
    *,
    inputs: tuple[str, ...],
    harmonics: tuple[str, ...],
    delay: int,
    late: int,
) -> tuple[FlownTops, FlownTimes, FlownCommands, Flights]:
    """Fly many flights from the start of an orbit that climbs by `climb` [m/s], each through its own air.

    Return states at the end of each beat, and its time; commands of each segment, as they act; and the largest
    deviation of the body pitch from the orbit's. Commands act later by so many segments: `delay`, of which the
    feedback knows, and `late`, of which it does not.
    """
    flights, count = air.shape[0], hold.lower.shape[0]

    def segment(carry: Any, asked: Any) -> tuple[Any, Any]:
        state, time, waiting, largest = carry
        gains, first, last, path, pitch, error = asked
        along = jnp.broadcast_to(path[:, None], (5, flights)).at[0].add(start[1] + climb * time)
        known = jnp.concatenate([state[1:6] - along + error, *waiting[late:]])
        command = jnp.clip(-gains @ known, hold.lower[:, None], hold.upper[:, None])
        command = jnp.where(jnp.isfinite(command), command, 0.0)  # the vehicle has tumbled
        queue = jnp.concatenate([waiting, command[None]])
        acting, waiting = queue[0], queue[1:]
        changed = wingbeat
        if inputs:
            changes = hold.shares @ acting
            numbers = parameters_of(wingbeat, hold.smoother, changes, inputs=inputs, harmonics=harmonics)
            changed = unpack((*inputs, *harmonics), wingbeat, numbers)
        ended, away = fly_beat_in_steps(model, changed, state, time, air, spacing, pitch, first, last)
        period = jnp.broadcast_to(1.0 / changed.frequency, (flights,))
        return (ended, time, waiting, jnp.maximum(largest, away)), (acting, period)

    def beat(carry: Any, errors: Any) -> tuple[Any, Any]:
        segments = hold.gains, hold.phases[:-1], hold.phases[1:], hold.path, hold.pitch, errors
        if errors.shape[0] == 1:  # no loop within the loop
            only = hold.gains[0], 0.0, 1.0, hold.path[0], hold.pitch[0], errors[0]
            (state, time, waiting, largest), (acting, period) = segment(carry, only)
            commands, periods = acting[None], period[None]
        else:
            (state, time, waiting, largest), (commands, periods) = jax.lax.scan(segment, carry, segments)
        time = time + periods[-1]
        return (state, time, waiting, largest), (state, time, commands)

    zeros = jnp.zeros(flights)
    begin = (
        jnp.broadcast_to(start[:, None], (start.size, flights)),
        zeros,
        jnp.zeros((delay + late, count, flights)),
        zeros,
    )
    (*_, largest), (states, times, commands) = jax.lax.scan(beat, begin, noise)
    return states, times, commands, largest


# Shortest and longest gust, and the time in which it may begin [beats].
_DURATION = (1.0, 8.0)
_BEGIN = 1.0
MOST_FLIGHTS = 100_000


@dataclass(frozen=True)
class ManyFlights:
    """Many flights of one orbit; made by `simulate_many`.

    Attributes
    ----------
    states : (x, z, body_pitch, u, w, pitch_rate) at all tops of the stroke, shape (flights, beats + 1, 6); may be
        huge or not a number after a flight is lost.
    time : of these tops [s], shape (flights, beats + 1).
    changes : of the inputs in each beat, shape (flights, beats, inputs) [Hz, rad or shares]; or of flap and pitch
        in each segment, shape (flights, beats * segments, 2) [rad].
    largest_pitch : largest deviation of the body pitch from the orbit's at the same phase [rad], shape (flights,).
    lowest : least height above the orbit's path at a top of the stroke [m], shape (flights,).
    survived : whether all is finite and within `ManyOptions.tilt` and `loss`, shape (flights,).

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> flights = wb.simulate_many(orbit, [wb.winds.CosineGust(w=size) for size in (0.0, 0.1)], beats=2)
    >>> flights.states.shape, flights.survived.tolist()
    ((2, 3, 6), [True, True])
    """

    states: np.ndarray
    time: np.ndarray
    changes: np.ndarray
    largest_pitch: np.ndarray
    lowest: np.ndarray
    survived: np.ndarray


def simulate_many(
    orbit: Orbit,
    winds: Sequence[Wind | tuple[float, float]],
    beats: int = 30,
    *,
    feedback: Feedback | SegmentFeedback | None = None,
    late: int = 0,
    noise: Mapping[str, float] | None = None,
    seed: int = 0,
    options: ManyOptions = MANY,
) -> ManyFlights:
    """Fly an orbit through many winds at once, the whole equations of motion in fixed steps.

    Parameters
    ----------
    orbit : a certified orbit; each flight starts on it at the top of the stroke.
    winds : velocity of the air of each flight, as in `simulate`.
    beats : number of wingbeats.
    feedback : of this orbit, from `feedback` or `feedback_in_beat`; None to fly the orbit's wingbeat throughout.
    late : beats of delay beyond that for which the feedback was computed; 0 with `feedback_in_beat`.
    noise : standard deviations of what the feedback measures of the state, by name [m, rad, m/s, rad/s].
    seed : of the noise.
    options : steps, and when a flight is lost.

    Raises
    ------
    InvalidInputError : an orbit that is not certified or has the lag of the wake, no winds or infinite ones, beats
        or lateness that are no whole numbers, feedback of another orbit, lateness within a beat, unknown noise.

    A pigeon with feedback, flown for 30 beats through a gust of 3 m/s in 64 steps of the classical Runge-Kutta
    method a beat, differs at the tops of the stroke by less than 3e-3 in SI units from the adaptive `simulate`.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=2)
    >>> gusts = [wb.winds.CosineGust(w=size, duration=0.3) for size in (0.0, 2.0, -2.0)]
    >>> wb.simulate_many(orbit, gusts, beats=12, feedback=wb.feedback(orbit)).survived.tolist()
    [True, True, True]
    """
    faults = FaultList()
    faults.whole("beats", beats, 1, 10_000)
    faults.whole("late", late, 0, MOST_DELAY)
    check_certified(faults, orbit.status, "fly a certified orbit")
    check_no_wake(faults, orbit.problem.aero.wake)
    if not isinstance(winds, Sequence) or not winds:
        faults.add("winds", winds, "must be a list of at least one wind", "for example [wb.winds.CosineGust(w=2)]")
    else:
        for wind in winds:
            check_wind(faults, wind)
    if feedback is not None:
        own = feedback.orbit if isinstance(feedback, SegmentFeedback) else feedback.flight.orbit
        if own is not orbit and (own.wingbeat != orbit.wingbeat or own.initial_state != orbit.initial_state):
            faults.add("feedback", own.inputs["speed"], "is that of another orbit", "compute its own")
    if isinstance(feedback, SegmentFeedback):
        check_noise_of(faults, feedback.imu, noise)
        if late:
            faults.add("late", late, "is not known to feedback within a beat", "give 0, or use `delay_time`")
    faults.raise_if_any()
    deviations = noise_of(noise, feedback.measured if isinstance(feedback, SegmentFeedback) else FLIGHT_STATE, seed)
    lanes = min(options.lanes, len(winds)) if len(winds) < 8 else options.lanes
    slower, segments, sensors = 0.0, 1, None
    if isinstance(feedback, SegmentFeedback):
        segments, sensors = len(feedback.gains), feedback.imu
    if isinstance(feedback, SegmentFeedback) and feedback.timing is not None:
        fly = by_beats(feedback.bound(options.steps), orbit.wingbeat.frequency)
    else:
        hold, names = _hold(orbit, feedback, options.steps)
        place = np.append(np.array(orbit.initial_state), orbit.hinge_start), np.array(float(orbit.inputs["climb"]))
        fly = fly_held.bind(orbit.problem.model, orbit.wingbeat, hold, *place, **names, late=late)
        slower = 0.0 if isinstance(feedback, SegmentFeedback) else min([0.0, *hold.lower.tolist()])
    random, found = np.random.default_rng(seed), []
    for air in _tables(orbit, winds, beats, slower, lanes, options.air_samples):
        measured = deviations[:, None] * random.standard_normal((beats, segments, len(deviations), lanes))
        if sensors is not None:
            measured = sensors.errors(random, beats, segments, lanes)
        found.append(fly(air, 1.0 / (options.air_samples * orbit.wingbeat.frequency), measured))
    states, time, changes, pitch = (
        np.concatenate([np.moveaxis(part[i], -1, 0) for part in found])[: len(winds)] for i in range(4)
    )
    changes = changes.reshape(len(winds), beats * segments, changes.shape[-1])
    states = states[..., :6]  # without those of a hinge
    states = np.concatenate([np.broadcast_to(orbit.initial_state, (len(winds), 1, 6)), states], axis=1)
    time = np.concatenate([np.zeros((len(winds), 1)), time], axis=1)
    height = states[:, :, 1] - float(orbit.initial_state.z) - float(orbit.inputs["climb"]) * time
    lowest = height.min(axis=1)
    survived = np.isfinite(states).all(axis=(1, 2)) & options.keeps(pitch, lowest)
    return ManyFlights(states, time, changes, pitch, lowest, survived)


def _hold(orbit: Orbit, feedback: Feedback | SegmentFeedback | None, steps: int) -> tuple[Hold, dict[str, Any]]:
    """Return a feedback as arrays, with its inputs, harmonics and delay; no feedback has no inputs."""
    start, ends, path = np.array(orbit.initial_state, dtype=float), np.array([0.0, 1.0]), np.zeros((1, 5))
    path[0, 1:] = start[2:]
    inputs: tuple[str, ...] = ()
    harmonics, delay = Compensation((), np.zeros((0, 0))), 0
    gains, limits, shares = np.zeros((1, 0, len(FLIGHT_STATE))), (np.zeros(0), np.zeros(0)), np.zeros((0, 0))
    if isinstance(feedback, SegmentFeedback):
        gains, ends, path = feedback.gains, feedback.phases, feedback.path[:-1]
        inputs, shares = bump_parameters(len(gains))
        limits = feedback.lower, feedback.upper
    elif feedback is not None:
        gains, limits, delay = feedback.gains[None], (feedback.lower, feedback.upper), feedback.delay
        inputs, harmonics, shares = feedback.inputs, feedback.flight.compensation, np.eye(len(feedback.inputs))
    count = math.ceil(steps * np.diff(ends).max() - 1e-6)  # no step is longer than those of a whole beat
    phases = np.concatenate([np.linspace(*pair, count + 1)[:-1] for pair in itertools.pairwise(ends)] + [ends[-1:]])
    hinge = () if orbit.hinge_start.size == 0 else (orbit.hinge_start,)
    flown, _ = fly_through(orbit.problem.model, orbit.wingbeat, orbit.initial_state, phases, wake=hinge)
    pitch = np.stack([flown[j * count : (j + 1) * count + 1, 2] for j in range(len(gains))])
    hold = Hold(gains, *limits, shares, smoother(orbit.wingbeat, inputs, harmonics), ends, path, pitch)
    return hold, {"inputs": inputs, "harmonics": harmonics.names, "delay": delay}


def _tables(
    orbit: Orbit, winds: Sequence[Wind | tuple[float, float]], beats: int, slower: float, lanes: int, samples: int
) -> Iterator[np.ndarray]:
    """Yield tables of the air's velocity of so many flights at a time, shape (lanes, places, 2)."""
    frequency = orbit.wingbeat.frequency
    slowest = frequency + slower  # of all inputs: more than is needed if none is it
    longest = frequency / max(slowest, 0.5 * frequency)
    times = np.arange(-1, int(beats * samples * longest) + 3) / (samples * frequency)
    for first in range(0, len(winds), lanes):
        tables = [air_at(wind, times) for wind in winds[first : first + lanes]]
        yield np.stack(tables + [tables[-1]] * (lanes - len(tables)))


@dataclass(frozen=True)
class GustSurvey(Reported):
    """Which of many random gusts were survived; made by `survey_gusts`.

    Attributes
    ----------
    size : largest velocity of each gust [m/s], shape (flights,).
    direction : into which it blows, from forward to up [rad], shape (flights,).
    start, duration : time at which it begins, and from its begin to its end [s], shape (flights,).
    survived : by the name of the feedback, shape (flights,) each.
    largest_pitch : largest deviation of the body pitch [rad], likewise.
    beats : of each flight.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=2)
    >>> found = wb.survey_gusts(orbit, {"open": None, "held": wb.feedback(orbit)}, flights=20, size=3.0, seed=1)
    >>> found.share("held"), found.size.shape
    (1.0, (20,))
    """

    size: np.ndarray
    direction: np.ndarray
    start: np.ndarray
    duration: np.ndarray
    survived: dict[str, np.ndarray]
    largest_pitch: dict[str, np.ndarray]
    beats: int

    def share(self, name: str) -> float:
        """Return the share of gusts that were survived.

        Parameters
        ----------
        name : of the feedback.
        """
        return float(self.survived[name].mean())

    def by_size(self, name: str, bins: int = 10) -> tuple[np.ndarray, np.ndarray]:
        """Return the edges of equal bins of the gusts' size [m/s], and the share survived in each.

        Parameters
        ----------
        name : of the feedback.
        bins : number of bins.
        """
        return _shares(self.size, self.survived[name], np.linspace(0.0, float(self.size.max()), bins + 1))

    def by_direction(self, name: str, bins: int = 12) -> tuple[np.ndarray, np.ndarray]:
        """Return the edges of equal bins of the direction from 0 to 2 pi [rad], and the share survived in each.

        Parameters
        ----------
        name : of the feedback.
        bins : number of bins.
        """
        return _shares(self.direction, self.survived[name], np.linspace(0.0, 2 * math.pi, bins + 1))

    def _report(self) -> Report:
        return survey_report(self.record())

    def plot(self) -> Figure:
        """Return a figure of the share of gusts survived, by their size and by their direction."""
        return survey_page(self)

    def to_dataframe(self) -> pd.DataFrame:
        """Return a row for each gust: size [m/s], direction [rad], start and duration [s], then how it ended.

        For each feedback there are two more columns: ``survived.NAME`` and ``largest_pitch.NAME`` [rad].
        """
        import pandas as pd

        gust = {name: getattr(self, name) for name in ("size", "direction", "start", "duration")}
        for kind in ("survived", "largest_pitch"):
            gust |= {f"{kind}.{name}": values for name, values in getattr(self, kind).items()}
        return pd.DataFrame(gust)

    def record(self) -> dict[str, Any]:
        """Return the shares as a JSON-able dictionary in SI units and radians; an empty bin is None."""
        return {
            "flights": len(self.size),
            "beats": self.beats,
            "largest_gust": float(self.size.max()),
            "survived": {name: self.share(name) for name in self.survived},
            "by_size": {name: _record(*self.by_size(name)) for name in self.survived},
            "by_direction": {name: _record(*self.by_direction(name)) for name in self.survived},
        }


def _shares(values: np.ndarray, survived: np.ndarray, edges: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    count, _ = np.histogram(values, edges)
    alive, _ = np.histogram(values[survived], edges)
    return edges, np.where(count > 0, alive / np.maximum(count, 1), np.nan)


def _record(edges: np.ndarray, shares: np.ndarray) -> dict[str, list[float | None]]:
    finite = [share if math.isfinite(share) else None for share in shares.tolist()]
    return {"edges": edges.tolist(), "shares": finite}


def survey_gusts(
    orbit: Orbit,
    feedbacks: Mapping[str, Feedback | SegmentFeedback | None] | None = None,
    flights: int = 1000,
    *,
    size: float = 5.0,
    beats: int = 30,
    late: int = 0,
    noise: Mapping[str, float] | None = None,
    seed: int = 0,
    options: ManyOptions = MANY,
) -> GustSurvey:
    """Fly an orbit through random gusts, with each of several feedbacks through the same ones.

    Parameters
    ----------
    orbit : a certified orbit.
    feedbacks : of this orbit, by names, from `feedback` or `feedback_in_beat`; None flies without feedback.
        Default: without feedback, with that of `feedback`, and with that for one beat of delay.
    flights, beats : number of gusts, and of the wingbeats of a flight.
    size : of the largest gust [m/s].
    late, noise : of all feedbacks, as in `simulate_many` [m, rad, m/s, rad/s].
    seed, options : of the random numbers, and of `simulate_many`, which say when a flight is lost.

    Raises
    ------
    InvalidInputError : a number of flights that is not from 1 to 100000, a size that is not positive, and what
        `simulate_many` refuses.

    A gust is a `CosineGust`: size, direction and duration (1 to 8 beats) are uniform; it begins in the first beat.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=2)
    >>> found = wb.survey_gusts(orbit, {"open": None, "held": wb.feedback(orbit)}, flights=20, size=3.0, seed=1)
    >>> found.share("held") > found.share("open")
    True
    """
    faults = FaultList()
    faults.whole("flights", flights, 1, MOST_FLIGHTS)
    faults.number("size", size, above=0.0, unit="m/s")
    faults.whole("seed", seed, 0, 2**31)
    if feedbacks is not None and (not isinstance(feedbacks, Mapping) or not feedbacks):
        faults.add("feedbacks", feedbacks, "must be feedbacks by name", "for example {'held': wb.feedback(orbit)}")
    faults.raise_if_any()
    if feedbacks is None:
        feedbacks = {
            "no feedback": None,
            "feedback": feedback(orbit),
            "feedback, one beat late": feedback(orbit, delay=1),
        }
    random, period = np.random.default_rng(seed), 1.0 / orbit.wingbeat.frequency
    sizes, turns, starts, lengths = random.random((4, flights))
    sizes, turns, starts = size * sizes, 2 * math.pi * turns, _BEGIN * period * starts
    lengths = period * (_DURATION[0] + (_DURATION[1] - _DURATION[0]) * lengths)
    numbers = np.stack([sizes * np.cos(turns), sizes * np.sin(turns), starts, lengths], axis=-1)
    gusts = [CosineGust(*row) for row in numbers.tolist()]
    asked: dict[str, Any] = {"late": late, "noise": noise, "seed": seed, "options": options}
    flown = {name: simulate_many(orbit, gusts, beats, feedback=held, **asked) for name, held in feedbacks.items()}
    survived = {name: found.survived for name, found in flown.items()}
    largest = {name: found.largest_pitch for name, found in flown.items()}
    return GustSurvey(sizes, turns, starts, lengths, survived, largest, beats)
