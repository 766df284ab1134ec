"""Many flights through moving air at once, with or without feedback: `simulate_many`."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from wingbeat._base import FaultList
from wingbeat.aero.winds import Wind
from wingbeat.animal.kinematics import parameter
from wingbeat.mechanics.beat_by_beat import air_at, check_wind
from wingbeat.mechanics.flights import fly_through
from wingbeat.orbits.problem.problem import PITCH_STATE
from wingbeat.orbits.status import Status
from wingbeat.results.flight import simulate
from wingbeat.results.orbit import Orbit
from wingbeat.stability.feedback import Feedback
from wingbeat.stability.feedback_checks import check_late, noise_of
from wingbeat.stability.held_beats import Course, Hold, fly_held_beats
from wingbeat.stability.held_segments import SegmentHold, fly_held_segments
from wingbeat.stability.inputs import Compensation
from wingbeat.stability.many_options import DEFAULTS, ManyOptions
from wingbeat.stability.segment_feedback import SegmentFeedback, bump_parameters
from wingbeat.stability.smooth_commands import smoother

_STATE = ("z", *PITCH_STATE)


@dataclass(frozen=True)
class ManyFlights:
    """Many flights of one orbit; made by `simulate_many`.

    Attributes
    ----------
    states : (x, z, body_pitch, u, w, pitch_rate) at all tops of the stroke, shape (flights, beats + 1, 6)
        [m, m, rad, m/s, m/s, rad/s]; may be huge or not a number after a flight is lost.
    time : of these tops [s], shape (flights, beats + 1).
    changes : of the inputs in each beat, shape (flights, beats, inputs) [Hz, rad or shares]; or bumps of flap
        and pitch in each segment, shape (flights, beats * segments, 2) [rad].
    largest_pitch : largest deviation of the body pitch from the orbit's at the same phase [rad], shape (flights,).
    lowest : least height above the orbit's path at a top of the stroke [m], shape (flights,).
    survived : whether all numbers are finite, `largest_pitch` is at most `ManyOptions.tilt`, and `lowest` is not
        below ``-ManyOptions.loss``, shape (flights,).

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
    options: ManyOptions = DEFAULTS,
) -> ManyFlights:
    """Fly an orbit through many winds at once, the whole equations of motion in fixed steps.

    Parameters
    ----------
    orbit : a certified orbit; each flight starts on it at the top of the stroke.
    winds : velocity of the air of each flight, as in `simulate`.
    beats : number of wingbeats.
    feedback : of this orbit, from `feedback` or `feedback_in_beat`; None to fly the orbit's wingbeat throughout.
    late : beats of delay in addition to the delay for which the feedback was computed; 0 with `feedback_in_beat`.
    noise : standard deviations of what the feedback measures of the state, by name [m, rad, m/s, rad/s].
    seed : of the noise.
    options : steps, and when a flight is lost.

    Raises
    ------
    InvalidInputError : an orbit that is not certified, no winds, winds that are not finite, beats or lateness that
        are no whole numbers, feedback of another orbit, lateness of feedback within a beat, noise of an unknown
        state or that is negative.

    One flight was compared with the adaptive `simulate`: a pigeon with feedback, 30 beats through a gust of 3 m/s.
    With 64 steps of the classical Runge-Kutta method in a beat, the states at the tops of the stroke differ by less
    than 3e-3 in SI units. Without feedback, an unstable orbit enlarges this difference like any other disturbance.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=2)
    >>> gusts = [wb.winds.CosineGust(w=size, duration=0.3) for size in (0.0, 2.0, -2.0)]
    >>> wb.simulate_many(orbit, gusts, beats=12, feedback=wb.feedback(orbit)).survived.tolist()
    [True, True, True]
    """
    faults = FaultList()
    faults.whole("beats", beats, 1, 10_000)
    check_late(faults, late)
    if orbit.status is not Status.CONVERGED:
        faults.add("orbit", orbit.status.value, "is not certified", "fly a certified orbit")
    if not isinstance(winds, Sequence) or not winds:
        faults.add("winds", winds, "must be a list of at least one wind", "for example [wb.winds.CosineGust(w=2)]")
    else:
        for wind in winds:
            check_wind(faults, wind)
    if feedback is not None and not _is_of(_own(feedback), orbit):
        faults.add("feedback", _own(feedback).inputs["speed"], "is that of another orbit", "compute its own")
    if isinstance(feedback, SegmentFeedback) and late:
        faults.add("late", late, "is not known to feedback within a beat", "give 0, or feedback from beat to beat")
    faults.raise_if_any()
    deviations = noise_of(noise, _STATE, seed)
    lanes = min(options.lanes, len(winds)) if len(winds) < 8 else options.lanes
    if isinstance(feedback, SegmentFeedback):
        fly, slower, measurements = _within_beats(feedback, options.steps), 0.0, (beats, len(feedback.gains))
    else:
        fly, slower = _from_beat_to_beat(orbit, feedback, late, options.steps)
        measurements = (beats,)
    random, found = np.random.default_rng(seed), []
    for air in _tables(orbit, winds, beats, slower, lanes, options.air_samples):
        measured = deviations[:, None] * random.standard_normal((*measurements, len(_STATE), lanes))
        found.append(fly(air, 1.0 / (options.air_samples * orbit.wingbeat.frequency), measured))
    states, time, changes, pitch = (
        np.concatenate([np.moveaxis(part[i], -1, 0) for part in found])[: len(winds)] for i in range(4)
    )
    if changes.ndim > 3:
        changes = changes.reshape(len(changes), -1, changes.shape[-1])
    states = np.concatenate([np.broadcast_to(orbit.initial_state, (len(winds), 1, 6)), states], axis=1)
    time = np.concatenate([np.zeros((len(winds), 1)), time], axis=1)
    return _judged(orbit, states, time, changes, pitch, options)


def _judged(
    orbit: Orbit,
    states: np.ndarray,
    time: np.ndarray,
    changes: np.ndarray,
    pitch: np.ndarray,
    options: ManyOptions,
) -> ManyFlights:
    height = states[:, :, 1] - float(orbit.initial_state.z) - float(orbit.inputs["climb"]) * time
    lowest = height.min(axis=1)
    survived = np.isfinite(states).all(axis=(1, 2)) & options.keeps(pitch, lowest)
    return ManyFlights(states, time, changes, pitch, lowest, survived)


def _own(feedback: Feedback | SegmentFeedback) -> Orbit:
    return feedback.orbit if isinstance(feedback, SegmentFeedback) else feedback.flight.orbit


def _is_of(own: Orbit, orbit: Orbit) -> bool:
    return own is orbit or (own.wingbeat == orbit.wingbeat and own.initial_state == orbit.initial_state)


def _from_beat_to_beat(
    orbit: Orbit, feedback: Feedback | None, late: int, steps: int
) -> tuple[Callable[..., Any], float]:
    """Return the program that flies so, and the least change of an input."""
    hold, inputs, harmonics = _hold(orbit, feedback)
    fly = fly_held_beats.bind(
        orbit.problem.model,
        orbit.wingbeat,
        hold,
        _course(orbit, steps),
        inputs=inputs,
        harmonics=harmonics,
        delay=0 if feedback is None else feedback.delay,
        late=late,
    )
    return fly, min([0.0, *hold.lower.tolist()])


def _within_beats(feedback: SegmentFeedback, steps: int) -> Callable[..., Any]:
    """Return the program that flies with feedback within the beat, in steps no longer than those of a beat."""
    orbit, ends = feedback.orbit, feedback.phases
    names, shares = bump_parameters(len(feedback.gains))
    own = math.ceil(steps * np.diff(ends).max() - 1e-6)
    phases = np.concatenate([np.linspace(*pair, own + 1)[:-1] for pair in itertools.pairwise(ends)] + [ends[-1:]])
    flown, _ = fly_through(orbit.problem.model, orbit.wingbeat, orbit.initial_state, phases)
    pitch = np.stack([flown[j * own : (j + 1) * own + 1, 2] for j in range(len(feedback.gains))])
    hold = SegmentHold(
        feedback.gains,
        np.array(feedback.limit),
        np.array([float(parameter(orbit.wingbeat, name)) for name in names]),
        shares,
        ends,
        feedback.path,
        pitch,
    )
    course = np.array(orbit.initial_state, dtype=float), np.array(float(orbit.inputs["climb"]))
    return fly_held_segments.bind(orbit.problem.model, orbit.wingbeat, hold, *course, names=names)


def _hold(orbit: Orbit, feedback: Feedback | None) -> tuple[Hold, tuple[str, ...], tuple[str, ...]]:
    """Return what holds the flights, and the names of its inputs and harmonics; nothing without feedback."""
    if feedback is None:
        alone = Compensation((), np.zeros((0, 0)))
        nothing = np.zeros(0)
        return Hold(np.zeros((0, len(_STATE))), nothing, nothing, smoother(orbit.wingbeat, (), alone)), (), ()
    hold = Hold(feedback.gains, feedback.lower, feedback.upper, feedback.smoother)
    return hold, feedback.inputs, feedback.flight.compensation.names


def _course(orbit: Orbit, steps: int) -> Course:
    flown = simulate(orbit.problem.model, orbit.wingbeat, orbit.initial_state, 1, steps)
    start = np.array(orbit.initial_state, dtype=float)
    return Course(start, flown.states[:, 2], np.array(float(orbit.inputs["climb"])))


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
