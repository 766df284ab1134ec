"""The beats of a transition between two steady flights: direct multiple shooting over the tops of the stroke."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import splu

from wingbeat.stability.beat_map import ORDER, BeatMap, FlownBeat
from wingbeat.stability.manoeuvre_options import ManoeuvreOptions
from wingbeat.stability.steady_flight import scales_of


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

    Parameters
    ----------
    beat : the map of a beat.
    states : the schedule at the tops of the stroke, shape (K + 1, 5); the first and the last are kept.
    changes : the schedule of the inputs, shape (K, inputs).
    options : of the search.
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
