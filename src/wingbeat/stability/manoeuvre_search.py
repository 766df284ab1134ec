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
from wingbeat.stability.options import FLIGHT_STATE, ManoeuvreOptions

if TYPE_CHECKING:
    from wingbeat.results.orbit import Orbit

ORDER = 5
# Deviations of the pitch state weigh this much beside those of the inputs, so that the problem has one solution.
_WEIGHT = 1e-6


class FlownBeat(NamedTuple):
    """One beat."""

    end: np.ndarray  # state after the beat, shape (5,)
    advance: float  # distance flown forward [m]
    A: np.ndarray  # derivative of `end` by the state before the beat, shape (5, 5)
    B: np.ndarray  # derivative of `end` by the changes of the inputs, shape (5, inputs)
    advance_slope: np.ndarray  # derivative of `advance` by the state and the inputs, shape (5 + inputs,)
    frequency: float  # [Hz]
    frequency_slope: np.ndarray  # derivative of the frequency by the inputs, shape (inputs,)


class BeatMap:
    """Beats whose inputs differ from those of an orbit, and whose wing never jumps at the top of the stroke.

    All beats share position and velocity of the wing at the top of the stroke with the orbit: harmonics go with the
    inputs. A beat is flown in `blocks` times 32 steps. Heights are those above a path that climbs by `climb` [m/s].
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
        frequency, by_frequency = float(beat.frequency), np.zeros(len(self.inputs))
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
    scales = np.array([feedback.scale(name) for name in FLIGHT_STATE])
    return scales, np.array([feedback.unit(name) for name in beat.inputs])


class SteadyFlight(NamedTuple):
    """A periodic flight.

    The defect is by how much it misses its start and its speed when the adaptive integrator flies it, in scales of
    the state [-].
    """

    speed: float  # mean, forward [m/s]
    state: np.ndarray  # at the top of the stroke, height 0, shape (5,)
    changes: np.ndarray  # of the inputs from the first orbit, shape (inputs,)
    frequency: float  # [Hz]
    defect: float
    converged: bool  # whether the search for it ended at such a flight


def steady_flight(
    beat: BeatMap, speed: float, wanted: np.ndarray, guess: SteadyFlight, options: ManoeuvreOptions, exact: bool
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
            miss_of_speed = (flown.advance + miss_of_advance) * frequency - speed
            residual = np.append(flown.end + miss_of_end - state, miss_of_speed)
            by_state = np.vstack([flown.A - np.eye(ORDER), flown.advance_slope[:ORDER] * frequency])[:, 1:]
            speed_slope = flown.advance_slope[ORDER:] * frequency + flown.advance * flown.frequency_slope
            by_input = np.vstack([flown.B, speed_slope])
            jacobian = np.hstack([by_state * scales[1:], by_input * units])
            weight = np.concatenate([np.full(ORDER - 1, _WEIGHT), np.ones(len(units))])
            pull = np.concatenate([np.zeros(ORDER - 1), (changes - wanted) / units])
            # The step that closes the linearised residual with the least weighted squares of `pull + step`.
            rows, columns = jacobian.shape
            whole = np.block([[np.diag(weight), jacobian.T], [jacobian, np.zeros((rows, rows))]])
            right = np.concatenate([-weight * pull, -residual])
            step = np.linalg.lstsq(whole, right, rcond=None)[0][:columns]
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
    flight = SteadyFlight(speed, state, changes, frequency, np.inf, converged)
    return _with_defect(beat, flight, options) if exact else flight


def _with_defect(beat: BeatMap, flight: SteadyFlight, options: ManoeuvreOptions) -> SteadyFlight:
    scales = scales_of(beat, options)[0]
    end, advance = beat.exactly(flight.state, flight.changes)
    miss_of_speed = abs(advance * flight.frequency - flight.speed) / scales[2]
    return flight._replace(defect=float(max(np.abs((end - flight.state) / scales).max(), miss_of_speed)))


class Road(NamedTuple):
    """Steady flights from one speed to another, and why there are no more, if so."""

    flights: list[SteadyFlight]  # from the first speed as far as they were found
    free_frequency: float  # of the best orbit at the last speed [Hz]
    failure: str | None  # why the speed was not reached; None if it was


def steady_start(beat_map: BeatMap, options: ManoeuvreOptions) -> SteadyFlight:
    """Return the first orbit as a steady flight."""
    orbit, still = beat_map.orbit, np.zeros(len(beat_map.inputs))
    speed, frequency = float(orbit.inputs["speed"]), float(orbit.wingbeat.frequency)
    return _with_defect(beat_map, SteadyFlight(speed, beat_map.start, still, frequency, np.inf, True), options)


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
    flights, free, failure = [here], float(best.wingbeat.frequency), None
    for share in np.linspace(0.0, 1.0, count + 1)[1:]:
        between = speed if share == 1.0 else float(here.speed + share * (speed - here.speed))
        toward = here.changes + share * (wanted - here.changes)
        flights.append(steady_flight(beat_map, between, toward, flights[-1], options, exact=share == 1.0))
        if not flights[-1].converged:
            failure = f"no steady flight with this top of the stroke was found at {between:.3g} m/s"
            break
    return Road(flights, free, failure)


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
    """A chain of beats in which each begins where the last one ends."""

    states: np.ndarray  # at the tops of the stroke, shape (K + 1, 5)
    changes: np.ndarray  # of the inputs in each beat, shape (K, inputs)
    advances: np.ndarray  # distance flown in each beat [m], shape (K,)
    A: np.ndarray  # derivatives of each beat by the state, shape (K, 5, 5)
    B: np.ndarray  # and by the inputs, shape (K, 5, inputs)
    defect: float  # by how much the adaptive integrator's beats miss their ends at the most, in scales [-]
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
    count, inner = len(changes), ORDER * (len(changes) - 1)
    planned_states, planned = states, changes
    states, changes = states.copy(), changes.copy()
    misses = np.zeros((count, ORDER))
    change = np.eye(count) - np.eye(count, k=-1)
    costs = np.eye(count) + options.smoothness * (change.T @ change)
    hessian = np.eye(inner + count * len(units))  # of all inner states, then of all commands
    hessian[inner:, inner:] = np.kron(costs, np.eye(len(units)))
    converged, defect = False, np.inf
    for round_ in range(options.corrections + 1):
        for iteration in range(options.iterations):
            flown = list(map(beat, states[:-1], changes))
            gaps = np.array([one.end for one in flown]) + misses - states[1:]
            away = (states - planned_states) / scales, (changes - planned) / units
            # Once the coarse beats are closed, only what the adaptive integrator misses is left to close.
            careful = options.iterations if round_ else max(iteration - options.free_steps, 0)
            step_x, step_c = _step(hessian, flown, gaps, away, scales, units, options.caution**careful - 1.0)
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
        exact = np.array([end for end, _ in map(beat.exactly, states[:-1], changes)])
        defect = float(np.abs((exact - states[1:]) / scales).max())
        if not converged or defect <= 0.1 * options.defect or round_ == options.corrections:
            break
        misses = exact - np.array([one.end for one in map(beat, states[:-1], changes)])
    return _ended(beat, states, changes, defect, converged)


def _ended(beat: BeatMap, states: np.ndarray, changes: np.ndarray, defect: float, converged: bool) -> Transition:
    flown = list(map(beat, states[:-1], changes))
    advances, A, B = (np.array([getattr(one, name) for one in flown]) for name in ("advance", "A", "B"))
    return Transition(states, changes, advances, A, B, defect, converged)


def _step(
    hessian: np.ndarray,
    flown: list[FlownBeat],
    gaps: np.ndarray,
    away: tuple[np.ndarray, np.ndarray],
    scales: np.ndarray,
    units: np.ndarray,
    caution: float,
) -> tuple[np.ndarray, np.ndarray]:
    """Return the step of all states (the ends stay) and commands that closes the gaps, in scales and units.

    With `caution`, the step itself costs so many times what the deviation after it costs.
    """
    beats, inputs, size = len(flown), len(units), len(hessian)
    inner = ORDER * (beats - 1)
    rows = np.zeros((ORDER * beats, size))
    for k, one in enumerate(flown):
        here = slice(ORDER * k, ORDER * (k + 1))
        if k > 0:
            rows[here, ORDER * (k - 1) : ORDER * k] = one.A * scales / scales[:, None]
        if k < beats - 1:
            rows[here, ORDER * k : ORDER * (k + 1)] = -np.eye(ORDER)
        rows[here, inner + inputs * k : inner + inputs * (k + 1)] = one.B * units / scales[:, None]
    deviation = np.concatenate([away[0][1:-1].ravel(), away[1].ravel()])
    whole = np.block([[(1.0 + caution) * hessian, rows.T], [rows, np.zeros((len(rows), len(rows)))]])
    right = np.concatenate([-hessian @ deviation, -(gaps / scales).ravel()])
    try:
        found = splu(csc_matrix(whole)).solve(right)[:size]
    except RuntimeError:  # singular: the search ends, because NaN is no state
        found = np.full(size, np.nan)
    states = np.zeros((beats + 1, ORDER))
    states[1:-1] = found[:inner].reshape(-1, ORDER)
    return states, found[inner:].reshape(beats, inputs)
