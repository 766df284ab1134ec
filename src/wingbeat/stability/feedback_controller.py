"""The controller that flies a feedback in `simulate`: it measures, waits out the delay and changes the wingbeat."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from wingbeat.animal.kinematics import Wingbeat
from wingbeat.mechanics.flight_model import State

if TYPE_CHECKING:
    from wingbeat.stability.feedback import Feedback


class FeedbackController:
    """A function of the beats flown and the state at the top of the stroke that returns the next wingbeat.

    It may fly one flight after another: at its first beat it forgets the flight before. The height is measured
    from the start, relative to the path that climbs as the orbit does; the distance x is not used.

    Theory: equation ``feedback-law``.

    Attributes
    ----------
    feedback : the feedback that it flies.
    late : beats of delay in addition to the delay for which the feedback was computed.
    noise : standard deviations of what is measured of the state, shape (5,) [m, rad, m/s, m/s, rad/s].
    seed : of the noise.
    commands : inputs of each beat so far, as they act, each of shape (inputs,) [Hz, rad or shares].

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=12.0), starts=1)
    >>> hold = wb.feedback(orbit).controller()
    >>> flown = wb.simulate(orbit.problem.model, orbit.wingbeat, orbit.initial_state, beats=3, controller=hold)
    >>> flown.completed, len(hold.commands)
    (True, 3)
    """

    def __init__(self, feedback: Feedback, late: int, noise: np.ndarray, seed: int) -> None:
        self.feedback, self.late, self.noise, self.seed = feedback, late, noise, seed
        self.commands: list[np.ndarray] = []
        self._begin(State())

    def _begin(self, state: State) -> None:
        self.commands = []
        waiting = self.feedback.delay + self.late
        self._waiting = [np.zeros(len(self.feedback.inputs)) for _ in range(waiting)]  # the oldest first
        self._random = np.random.default_rng(self.seed)
        self._ground, self._time = float(state.z), 0.0

    def __call__(self, beats: int, state: State) -> Wingbeat:
        """Return the wingbeat of the next beat.

        Parameters
        ----------
        beats : number of beats flown.
        state : at the top of the stroke [m, rad, m/s, rad/s].
        """
        if beats == 0:
            self._begin(state)
        feedback = self.feedback
        deviation = self._deviation(state) + self.noise * self._random.standard_normal(len(self.noise))
        known = np.concatenate([deviation, *self._waiting[self.late :]])
        command = np.clip(-feedback.gains @ known, feedback.lower, feedback.upper)
        if not np.isfinite(command).all():  # the vehicle has tumbled
            command = np.zeros_like(command)
        self._waiting.append(command)
        acting = self._waiting.pop(0)
        self.commands.append(acting)
        wingbeat = feedback.wingbeat(acting)
        self._time += 1.0 / wingbeat.frequency
        return wingbeat

    def _deviation(self, state: State) -> np.ndarray:
        orbit = self.feedback.flight.orbit
        height = float(state.z) - self._ground - float(orbit.inputs["climb"]) * self._time
        pitch_state = np.array(state, dtype=float)[2:] - np.array(orbit.initial_state, dtype=float)[2:]
        return np.concatenate([[height], pitch_state])
