"""Steady flights at a given speed whose wing has the same top of the stroke as a given orbit."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from wingbeat.stability.beat_map import ORDER, BeatMap
from wingbeat.stability.manoeuvre_options import ManoeuvreOptions

# Deviations of the pitch state weigh this much beside those of the inputs, so that the problem has one solution.
_WEIGHT = 1e-6


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

    The conditions are those of an orbit: the beat ends in the state in which it began, has the speed, and keeps the
    height above the path. Gauss and Newton's method with exact derivatives finds inputs and state.

    Theory: equation ``steady-flight``.

    Parameters
    ----------
    beat : the map of a beat.
    speed : mean forward speed [m/s].
    wanted : changes of the inputs that are wanted, shape (inputs,).
    guess : a flight at a similar speed.
    options : of the search.
    exact : whether the adaptive integrator corrects the flight.
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
    """Return by how much a flight misses its start and its speed when the adaptive integrator flies it, in scales.

    Parameters
    ----------
    beat : the map of a beat.
    speed : mean forward speed [m/s].
    state : at the top of the stroke, shape (5,).
    changes : of the inputs, shape (inputs,).
    frequency : [Hz].
    options : with the scales.
    """
    scales = scales_of(beat, options)[0]
    end, advance = beat.exactly(state, changes)
    return float(max(np.abs((end - state) / scales).max(), abs(advance * frequency - speed) / scales[2]))


def scales_of(beat: BeatMap, options: ManoeuvreOptions) -> tuple[np.ndarray, np.ndarray]:
    """Return the scales of the state, shape (5,), and the units of the inputs, shape (inputs,).

    Parameters
    ----------
    beat : the map of a beat.
    options : with scales and units.
    """
    feedback = options.feedback
    scales = [feedback.scale(name) for name in ("z", "body_pitch", "u", "w", "pitch_rate")]
    return np.array(scales), np.array([feedback.unit(name) for name in beat.inputs])


def _nearest(jacobian: np.ndarray, residual: np.ndarray, weight: np.ndarray, pull: np.ndarray) -> np.ndarray:
    """Return the step that closes the linearised residual with the least weighted squares of ``pull + step``."""
    rows, columns = jacobian.shape
    whole = np.zeros((rows + columns, rows + columns))
    whole[:columns, :columns] = np.diag(weight)
    whole[:columns, columns:], whole[columns:, :columns] = jacobian.T, jacobian
    return np.linalg.lstsq(whole, np.concatenate([-weight * pull, -residual]), rcond=None)[0][:columns]
