"""Objective and constraints that are outputs of the wingbeat: their values for a flight, and the derivatives."""

from __future__ import annotations

import numpy as np

from wingbeat.orbits.flight.beat import beat_reader
from wingbeat.orbits.flight.certify import Certificate
from wingbeat.orbits.flight.shooting import Flown
from wingbeat.orbits.problem.certified_beat import certified_beat
from wingbeat.orbits.problem.path_functions import OutputFunctions
from wingbeat.orbits.problem.problem import OrbitProblem


class Outputs:
    """The values of objective and constraints that depend on the simulated wingbeat, divided by their scales.

    A quantity that is a series has several values: its peaks.

    Attributes
    ----------
    count : values of objective and constraints together.
    of_objective : number of the objective's values, which come first.
    minimises_peaks : whether the objective has several values.
    limits : upper limits of the constraints' values, shape (count - of_objective,).
    """

    def __init__(self, problem: OrbitProblem) -> None:
        self._problem = problem
        self._velocity = problem.speed, problem.climb
        objective = [] if problem.minimise.parameter else [problem.minimise]
        self._functions = OutputFunctions(objective, problem.subject_to, problem.aero.strips, problem.vehicle.drive)
        self._reader = beat_reader(problem.model, problem.species.wingbeat, problem.free, self._velocity)
        self.of_objective = self._functions.counts[0] if objective else 0
        self.minimises_peaks = self.of_objective > 1
        self.count = sum(self._functions.counts)
        self.limits = self._functions.limits

    @property
    def undefined(self) -> tuple[np.ndarray, np.ndarray]:
        """Values (not-a-number) and derivatives (zero) of a diverged flight."""
        return np.full(self.count, np.nan), np.zeros((self.count, 4 + len(self._problem.free)))

    def of(self, unknowns: np.ndarray, flown: Flown) -> tuple[np.ndarray, np.ndarray]:
        """Return the values for a flight, and their derivatives by the unknowns."""
        beat, changes = self._reader(unknowns[4:], flown)
        return self._functions.linearised(beat, changes)

    def of_certified(self, unknowns: np.ndarray, certificate: Certificate) -> np.ndarray:
        """Return the values for a certified flight."""
        beat = certified_beat(self._problem, self._problem.wingbeat(unknowns), certificate)
        return self._functions.values(beat)

    def values_of(self, index: int) -> range:
        """Return the indices of one constraint among the constraints' values."""
        counts = self._functions.constraint_counts
        return range(sum(counts[:index]), sum(counts[: index + 1]))

    def with_active(self, active: np.ndarray) -> list[int]:
        """Return indices of constraints with an active value; `active` flags those after the path limits."""
        return [i for i in range(len(self._problem.subject_to)) if active[self.values_of(i)].any()]

    def active_constraints(self, active: np.ndarray) -> list[str]:
        """Return the texts of the constraints that are at their limits; `active` as for `with_active`."""
        return [str(self._problem.subject_to[i]) for i in self.with_active(active)]
