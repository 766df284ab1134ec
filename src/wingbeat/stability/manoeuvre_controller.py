"""The controller that flies a manoeuvre in `simulate`: the commands of each beat, and feedback around them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from wingbeat.animal.kinematics import Wingbeat
from wingbeat.mechanics.flight_model import State

if TYPE_CHECKING:
    from wingbeat.stability.manoeuvre import Manoeuvre


class ManoeuvreController:
    """A function of the beats flown and the state at the top of the stroke that returns the next wingbeat.

    It may fly one flight after another. After the last beat of the manoeuvre it holds the last steady flight.

    Theory: equation ``manoeuvre-law``.

    Attributes
    ----------
    manoeuvre : the manoeuvre that it flies.
    feedback : whether it reacts to the state; if not, it plays the commands.
    commands : changes of the inputs in each beat so far, each of shape (inputs,) [Hz, rad or shares].
    """

    def __init__(self, manoeuvre: Manoeuvre, feedback: bool) -> None:
        self.manoeuvre, self.feedback = manoeuvre, feedback
        self.commands: list[np.ndarray] = []
        self._ground = self._time = 0.0
        self._waiting: list[np.ndarray] = []  # corrections that do not act yet, the oldest first

    def __call__(self, beats: int, state: State) -> Wingbeat:
        """Return the wingbeat of the next beat.

        Parameters
        ----------
        beats : number of beats flown.
        state : at the top of the stroke [m, rad, m/s, rad/s].
        """
        plan = self.manoeuvre
        if beats == 0:
            self.commands, self._ground, self._time = [], float(state.z), 0.0
            self._waiting = [np.zeros(len(plan.inputs))] * plan.delay
        at = min(beats, len(plan.changes))
        planned = self._planned(beats)
        if self.feedback:
            height = float(state.z) - self._ground - plan.beat_map.climb * self._time
            deviation = np.concatenate([[height], np.array(state, dtype=float)[2:]]) - plan.states[at]
            correction = -plan.gains[at] @ np.concatenate([deviation, *self._waiting])
            then = self._planned(beats + plan.delay)
            correction = np.clip(then + correction, plan.lower, plan.upper) - then
            if not np.isfinite(correction).all():  # the vehicle has tumbled
                correction = np.zeros_like(then)
            self._waiting.append(correction)
            planned = planned + self._waiting.pop(0)
        command = planned
        self.commands.append(command)
        wingbeat = plan.beat_map.wingbeat(command)
        self._time += 1.0 / wingbeat.frequency
        return wingbeat

    def _planned(self, beats: int) -> np.ndarray:
        """Return the planned changes of a beat."""
        plan = self.manoeuvre
        return plan.changes[beats] if beats < len(plan.changes) else plan.ends[-1].changes
