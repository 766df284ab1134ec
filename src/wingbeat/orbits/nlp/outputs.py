"""Objective and constraints that are outputs of the flown beat or its stroke map: values and derivatives."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from wingbeat.orbits.flight.beat import beat_reader
from wingbeat.orbits.flight.certify import Certificate
from wingbeat.orbits.flight.floquet import monodromy
from wingbeat.orbits.flight.shooting import Flown
from wingbeat.orbits.flight.stroke_map import map_and_changes
from wingbeat.orbits.problem.certified_beat import certified_beat
from wingbeat.orbits.problem.path_functions import OutputFunctions, Read
from wingbeat.orbits.problem.problem import OrbitProblem


class Outputs:
    """The values of objective and constraints that depend on the simulated wingbeat, divided by their scales.

    A quantity that is a series has several values: its peaks.

    Parameters
    ----------
    problem : the orbit problem.
    fly : flies a period as the programme does; see `flier`.

    Attributes
    ----------
    count : number of values of objective and constraints together.
    of_objective : number of the objective's values, which come first.
    minimises_peaks : whether the objective has several values.
    limits : upper limits of the constraints' values, shape (count - of_objective,).
    """

    def __init__(self, problem: OrbitProblem, fly: Callable[..., Flown]) -> None:
        self._problem, self._fly = problem, fly
        self._velocity = problem.speed, problem.climb
        objective = [] if problem.minimise.parameter else [problem.minimise]
        self._functions = OutputFunctions(objective, problem.subject_to, problem.aero.strips, problem.vehicle.drive)
        self._reader = beat_reader(
            problem.model, problem.species.wingbeat, problem.free, self._velocity, self._functions.fields
        )
        self.of_objective = self._functions.counts[0] if objective else 0
        self.minimises_peaks = self.of_objective > 1
        self.count = sum(self._functions.counts)
        self.limits = self._functions.limits

    @property
    def undefined(self) -> tuple[np.ndarray, np.ndarray]:
        """Values (not-a-number) and derivatives (zero) of a diverged flight."""
        return np.full(self.count, np.nan), np.zeros((self.count, 4 + len(self._problem.free)))

    def of(self, unknowns: np.ndarray, flown: Flown, blocks: int) -> tuple[np.ndarray, np.ndarray]:
        """Return the values for a flight of `blocks` blocks, and their derivatives by the unknowns."""
        values, start, wants, nothing = unknowns[4:], unknowns[:4], self._functions, (None, None)
        beat = self._reader(values, flown) if wants.of_beat else nothing
        stroke_map = map_and_changes(self._fly, values, start, blocks, flown) if wants.of_map else nothing
        return wants.linearised(Read(beat[0], stroke_map[0]), Read(beat[1], stroke_map[1]))

    def of_certified(self, unknowns: np.ndarray, certificate: Certificate, *, exact: bool = False) -> np.ndarray:
        """Return the values for a certified flight; for `exact`, see `OutputFunctions.values`."""
        problem, wants = self._problem, self._functions
        wingbeat = problem.wingbeat(unknowns)
        beat = certified_beat(problem, wingbeat, certificate) if wants.of_beat else None
        stroke_map = monodromy(problem.model, wingbeat, certificate.steps) if wants.of_map else None
        return wants.values(Read(beat, stroke_map), exact=exact)

    def values_of(self, index: int) -> range:
        """Return the indices of one constraint among the constraints' values."""
        counts = self._functions.constraint_counts
        return range(sum(counts[:index]), sum(counts[: index + 1]))

    def with_active(self, active: np.ndarray) -> list[int]:
        """Return the indices of constraints with an active value; `active` flags the values of all constraints."""
        return [i for i in range(len(self._problem.subject_to)) if active[self.values_of(i)].any()]

    def active_constraints(self, active: np.ndarray) -> list[str]:
        """Return the texts of the constraints that are at their limits; `active` as for `with_active`."""
        return [str(self._problem.subject_to[i]) for i in self.with_active(active)]
