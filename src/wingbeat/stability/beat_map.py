"""One beat as a function of the state at its start and of the changes of its inputs, with derivatives."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from wingbeat.animal.kinematics import Wingbeat
from wingbeat.mechanics.flight_model import State
from wingbeat.mechanics.flights import fly_through
from wingbeat.orbits.flight.shooting import flier
from wingbeat.results.orbit import Orbit
from wingbeat.stability.linear_flight import linearise
from wingbeat.stability.smooth_commands import changed_wingbeat, parameters_and_slopes, smoother

# (height above the path, body_pitch, u, w, pitch_rate) at the top of the stroke.
ORDER = 5


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
    inputs.

    Parameters
    ----------
    orbit : a certified orbit.
    inputs : names of the parameters that may change; None for the default of `linearise`.
    blocks : a beat is flown in this many times 32 steps.

    Attributes
    ----------
    orbit, inputs : as given.
    climb : mean climb rate of the path from which heights are measured [m/s].

    Raises
    ------
    InvalidInputError : what `linearise` refuses.
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
        """Return the wingbeat with changed inputs.

        Parameters
        ----------
        changes : of the inputs, shape (inputs,) [Hz, rad or shares].
        """
        return changed_wingbeat(self.orbit.wingbeat, self._smooth, self.inputs, self._harmonics, changes)

    def __call__(self, state: np.ndarray, changes: np.ndarray) -> FlownBeat:
        """Fly a beat in fixed steps, with derivatives.

        Parameters
        ----------
        state : (height, body_pitch, u, w, pitch_rate) at its start, shape (5,).
        changes : of the inputs, shape (inputs,) [Hz, rad or shares].
        """
        found = parameters_and_slopes(
            self.orbit.wingbeat,
            self._smooth,
            np.asarray(changes, float),
            inputs=self.inputs,
            harmonics=self._harmonics,
        )
        values, slopes = (np.asarray(part) for part in found)
        flown = self._fly(values, np.asarray(state[1:], float), self._blocks)
        jacobian, order = np.asarray(flown.end_jacobian), ORDER - 1
        by_input = jacobian[:, order:] @ slopes
        frequency, by_frequency = self._frequency(values, slopes)
        end = np.concatenate([[state[0] + flown.end[1] - self.climb / frequency], np.asarray(flown.end)[2:]])
        A, B = np.zeros((ORDER, ORDER)), np.zeros((ORDER, len(self.inputs)))
        A[0, 0], A[0, 1:], A[1:, 1:] = 1.0, jacobian[1, :order], jacobian[2:, :order]
        B[0] = by_input[1] + self.climb / frequency**2 * by_frequency
        B[1:] = by_input[2:]
        advance_slope = np.concatenate([[0.0], jacobian[0, :order], by_input[0]])
        return FlownBeat(end, float(flown.end[0]), A, B, advance_slope, frequency, by_frequency)

    def _frequency(self, values: np.ndarray, slopes: np.ndarray) -> tuple[float, np.ndarray]:
        if "frequency" not in self.inputs:
            return float(self.orbit.wingbeat.frequency), np.zeros(len(self.inputs))
        index = self.inputs.index("frequency")
        return float(values[index]), slopes[index]

    def exactly(self, state: np.ndarray, changes: np.ndarray) -> tuple[np.ndarray, float]:
        """Fly a beat with the adaptive integrator; return the state after it, shape (5,), and the advance [m].

        Parameters
        ----------
        state, changes : as when called.
        """
        beat = self.wingbeat(changes)
        start = State(0.0, 0.0, *(float(part) for part in state[1:]))
        end = fly_through(self.orbit.problem.model, beat, start, np.array([0.0, 1.0]))[0][-1]
        height = float(state[0]) + end[1] - self.climb / beat.frequency
        return np.concatenate([[height], end[2:]]), float(end[0])
