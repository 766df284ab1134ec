"""Many flights through moving air at once, with or without feedback from beat to beat: `simulate_many`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from wingbeat.errors import FaultList
from wingbeat.mechanics.beat_by_beat import air_at, check_wind
from wingbeat.orbits.status import Status
from wingbeat.results.flight import simulate
from wingbeat.results.orbit import Orbit
from wingbeat.stability.feedback import Feedback
from wingbeat.stability.feedback_checks import MOST_DELAY, noise_of
from wingbeat.stability.held_beats import Course, Hold, fly_held_beats
from wingbeat.stability.inputs import Compensation
from wingbeat.stability.many_options import DEFAULTS, ManyOptions
from wingbeat.stability.smooth_commands import smoother
from wingbeat.winds import Wind

_STATE = ("z", "body_pitch", "u", "w", "pitch_rate")


@dataclass(frozen=True)
class ManyFlights:
    """Many flights of one orbit; made by `simulate_many`.

    Attributes
    ----------
    states : (x, z, body_pitch, u, w, pitch_rate) at all tops of the stroke, shape (flights, beats + 1, 6)
        [m, m, rad, m/s, m/s, rad/s]; may be huge or not a number after a flight is lost.
    time : of these tops [s], shape (flights, beats + 1).
    changes : of the inputs in each beat, shape (flights, beats, inputs) [Hz, rad or shares].
    largest_pitch : largest deviation of the body pitch from the orbit's at the same phase [rad], shape (flights,).
    lowest : least height above the orbit's path at a top of the stroke [m], shape (flights,).
    survived : whether all numbers are finite, `largest_pitch` is at most `ManyOptions.tilt`, and `lowest` is not
        below ``-ManyOptions.loss``, shape (flights,).
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
    feedback: Feedback | None = None,
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
    feedback : of this orbit; None to fly the orbit's wingbeat throughout.
    late : beats of delay in addition to the delay for which the feedback was computed.
    noise : standard deviations of what the feedback measures of the state, by name [m, rad, m/s, rad/s].
    seed : of the noise.
    options : steps, and when a flight is lost.

    Raises
    ------
    InvalidInputError : an orbit that is not certified, no winds, winds that are not finite, beats or lateness that
        are no whole numbers, feedback of another orbit, noise of an unknown state or that is negative.

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
    faults.whole("late", late, 0, MOST_DELAY)
    if orbit.status is not Status.CONVERGED:
        faults.add("orbit", orbit.status.value, "is not certified", "fly a certified orbit")
    if not isinstance(winds, Sequence) or not winds:
        faults.add("winds", winds, "must be a list of at least one wind", "for example [wb.winds.CosineGust(w=2)]")
    else:
        for wind in winds:
            check_wind(faults, wind)
    if feedback is not None and not _is_of(feedback, orbit):
        faults.add("feedback", feedback.flight.orbit.inputs["speed"], "is that of another orbit", "compute its own")
    faults.raise_if_any()
    deviations = noise_of(noise, _STATE, seed)
    hold, inputs, harmonics = _hold(orbit, feedback)
    lanes = min(options.lanes, len(winds)) if len(winds) < 8 else options.lanes
    fly = fly_held_beats.bind(
        orbit.problem.model,
        orbit.wingbeat,
        hold,
        _course(orbit, options.steps),
        inputs=inputs,
        harmonics=harmonics,
        delay=0 if feedback is None else feedback.delay,
        late=late,
    )
    random, found = np.random.default_rng(seed), []
    for air in _tables(orbit, winds, beats, hold, lanes, options.air_samples):
        measured = deviations[:, None] * random.standard_normal((beats, len(_STATE), lanes))
        found.append(fly(air, 1.0 / (options.air_samples * orbit.wingbeat.frequency), measured))
    states, time, changes, pitch = (
        np.concatenate([np.moveaxis(part[i], -1, 0) for part in found])[: len(winds)] for i in range(4)
    )
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
    with np.errstate(invalid="ignore"):
        survived = np.isfinite(states).all(axis=(1, 2)) & (pitch <= options.tilt) & (lowest >= -options.loss)
    return ManyFlights(states, time, changes, pitch, lowest, survived)


def _is_of(feedback: Feedback, orbit: Orbit) -> bool:
    own = feedback.flight.orbit
    return own is orbit or (own.wingbeat == orbit.wingbeat and own.initial_state == orbit.initial_state)


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
    orbit: Orbit, winds: Sequence[Wind | tuple[float, float]], beats: int, hold: Hold, lanes: int, samples: int
) -> Iterator[np.ndarray]:
    """Yield tables of the air's velocity of so many flights at a time, shape (lanes, places, 2)."""
    frequency = orbit.wingbeat.frequency
    slowest = frequency + min([0.0, *hold.lower.tolist()])  # of all inputs: more than is needed if none is it
    longest = frequency / max(slowest, 0.5 * frequency)
    times = np.arange(-1, int(beats * samples * longest) + 3) / (samples * frequency)
    for first in range(0, len(winds), lanes):
        tables = [air_at(wind, times) for wind in winds[first : first + lanes]]
        yield np.stack(tables + [tables[-1]] * (lanes - len(tables)))
