"""Single flights through a gust, with and without feedback: `fly_gust`, and `fly_pushes` for the viewer."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._base import FaultList
from wingbeat.aero.winds import CosineGust, Wind
from wingbeat.animal.kinematics import Wingbeat
from wingbeat.mechanics.flights import air_at
from wingbeat.orbits.flight.period import PITCH_STATE
from wingbeat.orbits.options import check_certified
from wingbeat.results.flight import Flight, simulate
from wingbeat.stability.beat_feedback import Feedback, feedback
from wingbeat.stability.options import FEEDBACK, MANY, ManyOptions, check_no_wake
from wingbeat.stability.reports import beats_of
from wingbeat.stability.segment_feedback import SegmentFeedback
from wingbeat.viewer.scene import Push

if TYPE_CHECKING:
    from wingbeat.orbits.solve import Progress
    from wingbeat.results.orbit import Orbit

SAMPLES = 64  # in each beat
# The air's velocity of each gust, forward and up, over the size of the gust.
DIRECTIONS = {"upward": (0.0, 1.0), "downward": (0.0, -1.0), "head": (-1.0, 0.0), "tail": (1.0, 0.0)}
SIZES = (1.0, 3.0)  # [m/s]
_LASTS = 2  # beats that a gust lasts
_EVERY = 4  # of the samples of a flight, the page gets each fourth one: 16 in a beat


class SampledFlight(NamedTuple):
    """A flight with feedback within the beat, as figures take it."""

    time: np.ndarray  # of the samples [s]
    states: np.ndarray  # (x, z, body_pitch, u, w, pitch_rate) there
    wingbeats: tuple[Wingbeat, ...]  # of each beat
    air: np.ndarray  # its velocity at the samples, forward and up [m/s]
    completed: bool


@dataclass(frozen=True)
class GustFlight:
    """A flight through a wind, and the orbit on which it began.

    It is settled after so many beats if attitude and velocities at the top of the stroke then stay within half a
    scale of `FeedbackOptions`.
    """

    flight: Flight | SampledFlight
    pitch: np.ndarray  # deviation of the body pitch from the orbit's at the same phase [rad], shape (K,)
    height: np.ndarray  # above the orbit's path at the tops of the stroke [m], shape (beats + 1,)
    changes: np.ndarray  # of the inputs, as `ManyFlights.changes` of one flight
    survived: bool  # as in `ManyFlights`
    settled: int | None

    def record(self) -> dict[str, Any]:
        """Return the numbers as a JSON-able dictionary [m, rad]; None after the integrator gave up."""

        def finite(value: float) -> float | None:
            return float(value) if np.isfinite(value) else None

        return {
            "completed": self.flight.completed,
            "survived": self.survived,
            "largest_pitch": finite(np.abs(self.pitch).max()),
            "lowest": finite(self.height.min()),
            "highest": finite(self.height.max()),
            "settled_beats": self.settled,
        }


def fly_gust(
    orbit: Orbit,
    wind: Wind | tuple[float, float],
    beats: int = 30,
    *,
    feedback: Feedback | SegmentFeedback | None = None,
    late: int = 0,
    noise: Mapping[str, float] | None = None,
    seed: int = 0,
    options: ManyOptions = MANY,
) -> GustFlight:
    """Fly an orbit through a wind, without servos by the adaptive integrator; arguments as in `simulate_many`."""
    if isinstance(feedback, SegmentFeedback):
        return _within_beats(feedback, wind, beats, noise, seed, options)
    controller = None if feedback is None else feedback.controller(noise, seed, late=late)
    model, beat, start = orbit.problem.model, orbit.wingbeat, orbit.initial_state
    species, hinge = orbit.problem.species, orbit.record().get("hinge_start")
    given = {"wind": wind, "controller": controller, "species": species, "hinge": hinge}
    flown = simulate(model, beat, start, beats, SAMPLES, **given)
    path = simulate(model, beat, start, 1, SAMPLES, hinge=hinge).states[:-1, 2]
    pitch = flown.states[:, 2] - np.append(np.tile(path, beats), path[0])
    tops = flown.states[::SAMPLES]
    height = tops[:, 1] - float(start.z) - float(orbit.inputs["climb"]) * flown.time[::SAMPLES]
    kept = flown.completed and bool(options.keeps(np.abs(pitch).max(), height.min()))
    changes = np.zeros((beats, 0)) if controller is None else np.array(controller.commands)
    settled = _settled(tops[:, 2:] - np.array(start, dtype=float)[2:])
    return GustFlight(flown, pitch, height, changes, kept, settled)


def _settled(away: np.ndarray) -> int | None:
    """Return after how many beats deviations of the pitch state at the tops of the stroke stay small."""
    scales = np.array([FEEDBACK.scale(name) for name in PITCH_STATE])
    settled = max(np.flatnonzero(~(np.abs(away / scales).max(axis=1) < 0.5)).tolist(), default=-1) + 1
    return settled if settled < len(away) else None


def _within_beats(
    held: SegmentFeedback,
    wind: Wind | tuple[float, float],
    beats: int,
    noise: Mapping[str, float] | None,
    seed: int,
    options: ManyOptions,
) -> GustFlight:
    flown, beat = held.fly(wind, beats, noise, seed), held.orbit.wingbeat
    count = len(held.gains)
    time = (np.append(held.phases[:-1] + np.arange(beats)[:, None], beats)) / beat.frequency
    air = air_at(wind, time)
    pitch, height = flown.deviations[:, 1], flown.deviations[::count, 0]
    completed = bool(np.isfinite(flown.states).all())
    kept = completed and bool(options.keeps(np.abs(pitch).max(), height.min()))
    path = SampledFlight(time, flown.states, (beat,) * beats, air, completed)
    return GustFlight(path, pitch, height, flown.bumps, kept, _settled(flown.deviations[::count, 1:5]))


def fly_pushes(
    orbit: Orbit,
    delay: int | None = 0,
    beats: int = 16,
    options: ManyOptions = MANY,
    directions: Sequence[str] = tuple(DIRECTIONS),
    sizes: Sequence[float] = SIZES,
    progress: Progress | None = None,
) -> tuple[Push, ...]:
    """Fly an orbit through gusts, by default of 1 and 3 m/s from four sides, without and with feedback.

    Each gust rises and falls once in the first two beats (1-cosine). `write_page` puts the flights into a page.

    Parameters
    ----------
    orbit : a certified orbit.
    delay : of the feedback [beats], as in `feedback`; None for flights without feedback only.
    beats : number of beats of a flight.
    options : say when a flight is lost.
    directions : of the gusts, of ``"upward"``, ``"downward"``, ``"head"`` and ``"tail"``.
    sizes : largest velocities of the gusts [m/s].
    progress : called with (flights done, flights in all).

    Raises
    ------
    InvalidInputError : an orbit that is not certified or has the lag of the wake; beats that are no whole number
        from 3 to 100; an unknown direction; a size that is not positive; what `feedback` refuses, such as a mode
        that no input reaches.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=2)
    >>> pushes = wb.fly_pushes(orbit, delay=None)
    >>> len(pushes), pushes[0].label
    (8, 'upward gust of 1 m/s, without feedback')
    """
    faults = FaultList()
    faults.whole("beats", beats, _LASTS + 1, 100, "beats of a flight")
    for name in directions:
        faults.choice("directions", name, tuple(DIRECTIONS))
    for size in sizes:
        faults.number("sizes", size, above=0, unit="m/s")
    check_certified(faults, orbit.status, "solve it again with more starts")
    check_no_wake(faults, orbit.problem.aero.wake)
    faults.raise_if_any()
    held: list[Feedback | None] = [None] if delay is None else [None, feedback(orbit, delay=delay)]
    asked = list(itertools.product(directions, sizes, held))
    pushes = []
    for done, (name, size, one) in enumerate(asked):
        if progress is not None:
            progress(done, len(asked))
        pushes.append(_push(orbit, name, size, one, beats, options))
    return tuple(pushes)


def _push(
    orbit: Orbit, direction: str, size: float, held: Feedback | None, beats: int, options: ManyOptions
) -> Push:
    forward, up = (size * part for part in DIRECTIONS[direction])
    gust = CosineGust(u=forward, w=up, duration=_LASTS / orbit.wingbeat.frequency)
    flown = fly_gust(orbit, gust, beats, feedback=held, options=options)
    assert isinstance(flown.flight, Flight)
    path = float(orbit.initial_state.z) + float(orbit.inputs["climb"]) * flown.flight.time
    height = flown.flight.states[:, 1] - path
    kept = np.cumprod(options.keeps(np.abs(flown.pitch), height)).astype(bool)
    shown = slice(0, max(int(kept.sum()), 2 * _EVERY), _EVERY)
    if not flown.survived:
        outcome = f"lost after {max(int(kept.sum()) - 1, 0) / SAMPLES:.1f} beats: it tumbles"
    else:
        ending = "not settled at the end"
        if flown.settled is not None:
            ending = f"settled after {beats_of(flown.settled)}" if flown.settled else "hardly disturbed"
        outcome = f"{ending}, body pitch within {np.degrees(np.abs(flown.pitch).max()):.0f} deg of the orbit's"
    path_shown = flown.flight.dataset.isel(phase=shown)
    return Push(direction, size, held is not None, outcome, path_shown, flown.pitch[shown], height[shown])
