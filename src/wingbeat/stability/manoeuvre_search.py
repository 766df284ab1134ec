"""The beats of a manoeuvre: steady flights whose wing has the same top of the stroke, and the way between them.

States are (height above the path, body_pitch, u, w, pitch_rate) at the top of the stroke; a beat is a function of
the state at its start and of the changes of its inputs.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import splu

from wingbeat.animal.kinematics import Wingbeat, parameter
from wingbeat.mechanics.flight_model import State
from wingbeat.mechanics.flights import fly_through
from wingbeat.orbits.flight.period import flier
from wingbeat.orbits.options import Status
from wingbeat.results.orbit import solve_orbit
from wingbeat.stability.inputs import changed_wingbeat, parameters_and_slopes, smoother
from wingbeat.stability.linear_flight import linearise
from wingbeat.stability.options import ManoeuvreOptions

if TYPE_CHECKING:
    from wingbeat.results.orbit import Orbit

ORDER = 5
# Deviations of the pitch state weigh this much beside those of the inputs, so that the problem has one solution.
_WEIGHT = 1e-6


class FlownBeat(NamedTuple):
    """One beat.

    Attributes
    ----------
    end : (height, body_pitch, u, w, pitch_rate) after the beat, shape (5,).
    advance : distance flown forward [m].
    A : derivative of `end` by the state before the beat, shape (5, 5).
    B : derivative of `end` by the changes of the inputs, shape (5, inputs).
    advance_slope : derivative of `advance` by the state and the inputs, shape (5 + inputs,).
    frequency : of the beat [Hz].
    frequency_slope : derivative of the frequency by the inputs, shape (inputs,).
    """

    end: np.ndarray
    advance: float
    A: np.ndarray
    B: np.ndarray
    advance_slope: np.ndarray
    frequency: float
    frequency_slope: np.ndarray


class BeatMap:
    """Beats whose inputs differ from those of an orbit, and whose wing never jumps at the top of the stroke.

    All beats share position and velocity of the wing at the top of the stroke with the orbit: harmonics go with the
    inputs. A beat is flown in `blocks` times 32 steps.

    Attributes
    ----------
    orbit : a certified orbit.
    inputs : names of the parameters that change; by default those of `linearise`.
    climb : mean climb rate of the path from which heights are measured [m/s].
    """

    def __init__(self, orbit: Orbit, inputs: Sequence[str] | None, blocks: int) -> None:
        flight = linearise(orbit, inputs, height=True)
        self.orbit, self.inputs, self.climb = orbit, flight.inputs, float(orbit.inputs["climb"])
        self._harmonics = flight.compensation.names
        self._smooth = smoother(orbit.wingbeat, self.inputs, flight.compensation)
        self._blocks = blocks
        self._fly = flier(orbit.problem.model, orbit.wingbeat, (*self.inputs, *self._harmonics))

    @property
    def start(self) -> np.ndarray:
        """The state of the orbit at the top of the stroke, height 0, shape (5,)."""
        return np.concatenate([[0.0], np.array(self.orbit.initial_state, dtype=float)[2:]])

    def wingbeat(self, changes: np.ndarray) -> Wingbeat:
        """Return the wingbeat with inputs changed by so much [Hz, rad or shares]."""
        return changed_wingbeat(self.orbit.wingbeat, self._smooth, self.inputs, self._harmonics, changes)

    def __call__(self, state: np.ndarray, changes: np.ndarray) -> FlownBeat:
        """Fly a beat in fixed steps, with derivatives, from (height, body_pitch, u, w, pitch_rate)."""
        beat, changes = self.orbit.wingbeat, np.asarray(changes, float)
        found = parameters_and_slopes(beat, self._smooth, changes, inputs=self.inputs, harmonics=self._harmonics)
        values, slopes = (np.asarray(part) for part in found)
        frequency, by_frequency = float(self.orbit.wingbeat.frequency), np.zeros(len(self.inputs))
        if "frequency" in self.inputs:
            index = self.inputs.index("frequency")
            frequency, by_frequency = float(values[index]), slopes[index]
        flown = self._fly(values, np.asarray(state[1:], float), self._blocks)
        jacobian, order = np.asarray(flown.end_jacobian), ORDER - 1
        by_input = jacobian[:, order:] @ slopes
        end = np.concatenate([[state[0] + flown.end[1] - self.climb / frequency], np.asarray(flown.end)[2:]])
        A, B = np.zeros((ORDER, ORDER)), np.zeros((ORDER, len(self.inputs)))
        A[0, 0], A[0, 1:], A[1:, 1:] = 1.0, jacobian[1, :order], jacobian[2:, :order]
        B[0] = by_input[1] + self.climb / frequency**2 * by_frequency
        B[1:] = by_input[2:]
        advance_slope = np.concatenate([[0.0], jacobian[0, :order], by_input[0]])
        return FlownBeat(end, float(flown.end[0]), A, B, advance_slope, frequency, by_frequency)

    def exactly(self, state: np.ndarray, changes: np.ndarray) -> tuple[np.ndarray, float]:
        """Fly a beat with the adaptive integrator; return the state after it, shape (5,), and the advance [m]."""
        beat = self.wingbeat(changes)
        start = State(0.0, 0.0, *(float(part) for part in state[1:]))
        end = fly_through(self.orbit.problem.model, beat, start, np.array([0.0, 1.0]))[0][-1]
        height = float(state[0]) + end[1] - self.climb / beat.frequency
        return np.concatenate([[height], end[2:]]), float(end[0])


def scales_of(beat: BeatMap, options: ManoeuvreOptions) -> tuple[np.ndarray, np.ndarray]:
    """Return the scales of the state and the units of the inputs."""
    feedback = options.feedback
    scales = [feedback.scale(name) for name in ("z", "body_pitch", "u", "w", "pitch_rate")]
    return np.array(scales), np.array([feedback.unit(name) for name in beat.inputs])


class SteadyFlight(NamedTuple):
    """A periodic flight.

    Attributes
    ----------
    speed : mean forward speed [m/s].
    state : (height, body_pitch, u, w, pitch_rate) at the top of the stroke, height 0, shape (5,).
    changes : of the inputs from the first orbit, shape (inputs,).
    frequency : [Hz].
    defect : by how much the flight misses its start and its speed when the adaptive integrator flies it, in scales
        of the state [-].
    converged : whether the search for it ended at such a flight.
    """

    speed: float
    state: np.ndarray
    changes: np.ndarray
    frequency: float
    defect: float
    converged: bool


def steady_flight(
    beat: BeatMap,
    speed: float,
    wanted: np.ndarray,
    guess: SteadyFlight,
    options: ManoeuvreOptions,
    exact: bool = True,
) -> SteadyFlight:
    """Return the steady flight at a speed whose inputs are nearest to the wanted ones.

    The beat ends in the state in which it began, has the speed, and keeps the height above the path. Gauss and
    Newton's method with exact derivatives finds both; if `exact`, the adaptive integrator corrects them.

    Theory: equation ``steady-flight``.
    """
    scales, units = scales_of(beat, options)
    state, changes = guess.state.copy(), guess.changes.copy()
    miss_of_end, miss_of_advance = np.zeros(ORDER), 0.0
    converged, frequency = False, guess.frequency
    for _ in range(options.corrections if exact else 1):
        for _ in range(options.iterations):
            flown = beat(state, changes)
            frequency = flown.frequency
            residual = np.append(
                flown.end + miss_of_end - state, (flown.advance + miss_of_advance) * flown.frequency - speed
            )
            by_state = np.vstack([flown.A - np.eye(ORDER), flown.advance_slope[:ORDER] * flown.frequency])[:, 1:]
            by_input = np.vstack(
                [flown.B, flown.advance_slope[ORDER:] * flown.frequency + flown.advance * flown.frequency_slope]
            )
            jacobian = np.hstack([by_state * scales[1:], by_input * units])
            weight = np.concatenate([np.full(ORDER - 1, _WEIGHT), np.ones(len(units))])
            pull = np.concatenate([np.zeros(ORDER - 1), (changes - wanted) / units])
            step = _nearest(jacobian, residual, weight, pull)
            step *= min(1.0, options.largest_step / max(np.abs(step).max(), 1e-300))
            state[1:] += step[: ORDER - 1] * scales[1:]
            changes += step[ORDER - 1 :] * units
            if np.abs(step).max() <= options.step_tolerance:
                converged = True
                break
        else:
            converged = False
        if not exact or not np.isfinite(state).all():
            break
        coarse, (end, advance) = beat(state, changes), beat.exactly(state, changes)
        miss_of_end, miss_of_advance = end - coarse.end, advance - coarse.advance
    if not exact:
        return SteadyFlight(speed, state, changes, frequency, np.inf, converged)
    defect = defect_of(beat, speed, state, changes, frequency, options)
    return SteadyFlight(speed, state, changes, frequency, defect, converged)


def defect_of(
    beat: BeatMap,
    speed: float,
    state: np.ndarray,
    changes: np.ndarray,
    frequency: float,
    options: ManoeuvreOptions,
) -> float:
    """Return by how much a flight of the adaptive integrator misses its start and its speed, in scales."""
    scales = scales_of(beat, options)[0]
    end, advance = beat.exactly(state, changes)
    return float(max(np.abs((end - state) / scales).max(), abs(advance * frequency - speed) / scales[2]))


def _nearest(jacobian: np.ndarray, residual: np.ndarray, weight: np.ndarray, pull: np.ndarray) -> np.ndarray:
    """Return the step that closes the linearised residual with the least weighted squares of ``pull + step``."""
    rows, columns = jacobian.shape
    whole = np.zeros((rows + columns, rows + columns))
    whole[:columns, :columns] = np.diag(weight)
    whole[:columns, columns:], whole[columns:, :columns] = jacobian.T, jacobian
    return np.linalg.lstsq(whole, np.concatenate([-weight * pull, -residual]), rcond=None)[0][:columns]


class Road(NamedTuple):
    """Steady flights from one speed to another, and why there are no more, if so.

    Attributes
    ----------
    flights : the steady flights, from the first speed as far as they were found.
    free_frequency : of the best orbit at the last speed [Hz].
    failure : why the speed was not reached; None if it was.
    """

    flights: list[SteadyFlight]
    free_frequency: float
    failure: str | None


def steady_start(beat_map: BeatMap, options: ManoeuvreOptions) -> SteadyFlight:
    """Return the first orbit as a steady flight."""
    orbit, still = beat_map.orbit, np.zeros(len(beat_map.inputs))
    speed, frequency = float(orbit.inputs["speed"]), float(orbit.wingbeat.frequency)
    defect = defect_of(beat_map, speed, beat_map.start, still, frequency, options)
    return SteadyFlight(speed, beat_map.start, still, frequency, defect, True)


def road_back(passed: list[SteadyFlight], speed: float, beat_map: BeatMap) -> Road | None:
    """Return the way back over the steady flights passed, None if none of them had this speed."""
    for i in range(len(passed) - 2, -1, -1):
        if passed[i].speed == speed and math.isfinite(passed[i].defect):
            free = float(beat_map.orbit.wingbeat.frequency) if i == 0 else math.nan
            return Road(passed[i:][::-1], free, None)
    return None


def road_to(beat_map: BeatMap, here: SteadyFlight, speed: float, options: ManoeuvreOptions) -> Road:
    """Return steady flights from one to a speed, each near the inputs of the best orbits between both."""
    orbit = beat_map.orbit
    best = solve_orbit(orbit.problem.at_speed(speed), int(orbit.inputs["starts"]))
    if best.status is not Status.CONVERGED:
        return Road([here], math.nan, f"there is no certified orbit at {speed:g} m/s: {best.message}")
    first, last = ([float(parameter(one.wingbeat, name)) for name in beat_map.inputs] for one in (orbit, best))
    wanted = np.array(last) - np.array(first)
    count = max(math.ceil(abs(speed - here.speed) / options.speed_step), 1)
    flights = [here]
    for share in np.linspace(0.0, 1.0, count + 1)[1:]:
        between = speed if share == 1.0 else float(here.speed + share * (speed - here.speed))
        toward = here.changes + share * (wanted - here.changes)
        flights.append(steady_flight(beat_map, between, toward, flights[-1], options, exact=share == 1.0))
        if not flights[-1].converged:
            failure = f"no steady flight with this top of the stroke was found at {between:.3g} m/s"
            return Road(flights, float(best.wingbeat.frequency), failure)
    return Road(flights, float(best.wingbeat.frequency), None)


def schedule(flights: list[SteadyFlight], count: int) -> tuple[np.ndarray, np.ndarray]:
    """Return states at the tops of the stroke and changes in the beats; the speed starts and ends smoothly."""
    at = np.linspace(0.0, 1.0, len(flights))
    tops = np.linspace(0.0, 1.0, count + 1)
    ramp = tops**2 * (3.0 - 2.0 * tops)

    def along(shares: np.ndarray, name: str) -> np.ndarray:
        values = np.array([getattr(flight, name) for flight in flights])
        return np.stack([np.interp(shares, at, column) for column in values.T], axis=-1)

    return along(ramp, "state"), along(0.5 * (ramp[1:] + ramp[:-1]), "changes")


class Transition(NamedTuple):
    """A chain of beats in which each begins where the last one ends.

    Attributes
    ----------
    states : (height, body_pitch, u, w, pitch_rate) at the tops of the stroke, shape (K + 1, 5).
    changes : of the inputs in each beat, shape (K, inputs).
    advances : distance flown in each beat [m], shape (K,).
    A, B : derivatives of each beat, shapes (K, 5, 5) and (K, 5, inputs).
    defect : by how much the adaptive integrator's beats miss their ends at the most, in scales of the state [-].
    converged : whether the search ended.
    """

    states: np.ndarray
    changes: np.ndarray
    advances: np.ndarray
    A: np.ndarray
    B: np.ndarray
    defect: float
    converged: bool


def transition(beat: BeatMap, states: np.ndarray, changes: np.ndarray, options: ManoeuvreOptions) -> Transition:
    """Return the beats nearest to a schedule that lead from its first state to its last.

    The commands minimise the squares of their deviations from the schedule, of the change of these deviations from
    beat to beat, and of the deviations of the state from the schedule. That each beat ends where the next begins is
    a constraint, so the commands contain the feed-forward of the acceleration. Gauss-Newton steps alone go to and
    fro around the minimum, because they leave out the curvature of the constraint. So after some steps the step
    itself costs more and more: the constraint is met exactly, the minimum to some percent.

    Theory: equation ``transition``.
    """
    scales, units = scales_of(beat, options)
    count = len(changes)
    planned_states, planned = states.copy(), changes.copy()
    states, changes = states.copy(), changes.copy()
    misses = np.zeros((count, ORDER))
    weights = _Weights.of(count, len(units), options.smoothness)
    converged, defect = False, np.inf
    for round_ in range(options.corrections + 1):
        for iteration in range(options.iterations):
            flown = [beat(x, c) for x, c in zip(states[:-1], changes, strict=True)]
            gaps = np.array([one.end for one in flown]) + misses - states[1:]
            away = (states - planned_states) / scales, (changes - planned) / units
            # Once the coarse beats are closed, only what the adaptive integrator misses is left to close.
            careful = options.iterations if round_ else max(iteration - options.free_steps, 0)
            step_x, step_c = weights.step(flown, gaps, away, scales, units, options.caution**careful - 1.0)
            largest = max(np.abs(step_c).max(), np.abs(step_x).max())
            share = min(1.0, options.largest_step / max(largest, 1e-300))
            states += share * step_x * scales
            changes += share * step_c * units
            if not np.isfinite(states).all():
                return _ended(beat, states, changes, np.inf, False)
            if largest <= options.step_tolerance:
                converged = True
                break
        else:
            converged = False
        exact = [beat.exactly(x, c)[0] for x, c in zip(states[:-1], changes, strict=True)]
        defect = float(np.abs((np.array(exact) - states[1:]) / scales).max())
        if not converged or defect <= 0.1 * options.defect or round_ == options.corrections:
            break
        coarse = np.array([beat(x, c).end for x, c in zip(states[:-1], changes, strict=True)])
        misses = np.array(exact) - coarse
    return _ended(beat, states, changes, defect, converged)


def _ended(beat: BeatMap, states: np.ndarray, changes: np.ndarray, defect: float, converged: bool) -> Transition:
    flown = [beat(x, c) for x, c in zip(states[:-1], changes, strict=True)]
    A, B = np.array([one.A for one in flown]), np.array([one.B for one in flown])
    advances = np.array([one.advance for one in flown])
    return Transition(states, changes, advances, A, B, defect, converged)


class _Weights(NamedTuple):
    """The quadratic cost of the deviations of all inner states and all commands, in scales and units."""

    beats: int
    inputs: int
    hessian: np.ndarray

    @classmethod
    def of(cls, beats: int, inputs: int, smoothness: float) -> _Weights:
        """Return the cost of a chain of beats."""
        inner = ORDER * (beats - 1)
        change = np.eye(beats) - np.eye(beats, k=-1)
        costs = np.eye(beats) + smoothness * (change.T @ change)
        hessian = np.eye(inner + inputs * beats)
        hessian[inner:, inner:] = np.kron(costs, np.eye(inputs))
        return cls(beats, inputs, hessian)

    def step(
        self,
        flown: list[FlownBeat],
        gaps: np.ndarray,
        away: tuple[np.ndarray, np.ndarray],
        scales: np.ndarray,
        units: np.ndarray,
        caution: float,
    ) -> tuple[np.ndarray, np.ndarray]:
        """Return the step of all states (the ends stay) and commands that closes the linearised gaps.

        With `caution`, the step itself costs so many times what the deviation after it costs.
        """
        inner, size = ORDER * (self.beats - 1), len(self.hessian)
        rows = np.zeros((ORDER * self.beats, size))
        for k, one in enumerate(flown):
            here = slice(ORDER * k, ORDER * (k + 1))
            if k > 0:
                rows[here, ORDER * (k - 1) : ORDER * k] = one.A * scales / scales[:, None]
            if k < self.beats - 1:
                rows[here, ORDER * k : ORDER * (k + 1)] = -np.eye(ORDER)
            rows[here, inner + self.inputs * k : inner + self.inputs * (k + 1)] = one.B * units / scales[:, None]
        deviation = np.concatenate([away[0][1:-1].ravel(), away[1].ravel()])
        whole = np.block([[(1.0 + caution) * self.hessian, rows.T], [rows, np.zeros((len(rows), len(rows)))]])
        right = np.concatenate([-self.hessian @ deviation, -(gaps / scales).ravel()])
        try:
            found = splu(csc_matrix(whole)).solve(right)[:size]
        except RuntimeError:  # singular: the search ends, because NaN is no state
            found = np.full(size, np.nan)
        states = np.zeros((self.beats + 1, ORDER))
        states[1:-1] = found[:inner].reshape(-1, ORDER)
        return states, found[inner:].reshape(self.beats, self.inputs)
