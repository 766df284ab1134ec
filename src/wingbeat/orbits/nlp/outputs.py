"""What a problem asks of the beat besides closing: its objective and constraints, read off flights."""

from __future__ import annotations

import numpy as np

from wingbeat.orbits.flight.beat import beat_reader, flown_beat
from wingbeat.orbits.flight.certify import Certificate
from wingbeat.orbits.flight.shooting import Flown
from wingbeat.orbits.problem.objectives import Quantity
from wingbeat.orbits.problem.path_functions import Readings
from wingbeat.orbits.problem.problem import OrbitProblem

# An unknown this near to a bound, as a share of its range, is at the bound; margins likewise, in their own scale.
AT_BOUND = 1e-6


class Asked:
    """The rows of objective and constraints of a problem, over their scales, and the constraints' limits."""

    def __init__(self, problem: OrbitProblem) -> None:
        self._problem = problem
        self._velocity = problem.speed, problem.climb
        objective = [problem.minimise] if isinstance(problem.minimise, Quantity) else []
        self._readings = Readings(objective, problem.subject_to, problem.aero.strips)
        self._reader = beat_reader(problem.model, problem.species.wingbeat, problem.free, self._velocity)
        self.objective_rows = self._readings.counts[0] if objective else 0
        self.has_peaks_to_lower = self.objective_rows > 1
        self.count = sum(self._readings.counts)
        self.limits = self._readings.limits

    @property
    def lost(self) -> tuple[np.ndarray, np.ndarray]:
        """Rows and derivatives where there is no flight to read them off: not-a-number."""
        return np.full(self.count, np.nan), np.zeros((self.count, 4 + len(self._problem.free)))

    def read(self, unknowns: np.ndarray, flown: Flown) -> tuple[np.ndarray, np.ndarray]:
        """Return the rows of a flight, and their derivatives by the unknowns."""
        beat, changes = self._reader(unknowns[4:], flown)
        return self._readings.of(beat), self._readings.changes_of(beat, changes)

    def read_certified(self, unknowns: np.ndarray, certificate: Certificate) -> np.ndarray:
        """Return the rows of what the certifier flew."""
        wingbeat = self._problem.wingbeat(unknowns)
        beat = flown_beat(
            self._problem.model, wingbeat, certificate.phase, certificate.states[:, 2:], self._velocity
        )
        return self._readings.of(beat, sampled=True)

    def rows_of(self, place: int) -> range:
        """Return which of the constraints' rows are those of one of them, by its place among them."""
        counts = self._readings.constraint_counts
        return range(sum(counts[:place]), sum(counts[: place + 1]))

    def active_rows(self, active: np.ndarray) -> list[int]:
        """Return which constraints have an active row, given which of the margins after body pitch are active."""
        return [i for i in range(len(self._problem.subject_to)) if active[self.rows_of(i)].any()]

    def active_constraints(self, margins: np.ndarray) -> list[str]:
        """Return the constraints that are at their limits, given the margins of their rows."""
        return [str(self._problem.subject_to[i]) for i in self.active_rows(margins <= AT_BOUND)]
