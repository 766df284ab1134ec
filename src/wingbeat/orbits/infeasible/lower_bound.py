"""Least frequency that ends at its own lower bound, as in a descent that is nearly a glide.

Where the wings hardly need to beat, orbits exist down to any frequency, and the bound is the answer. Searches often
do not get there: a beat of half a second or more is too long for its closure to be nearly linear. For a pigeon at
12 m/s and a sink of 7.2 m/s none of 20 searches closed, while with a lower bound of 2, 4 or 6 Hz the first few
found an orbit at that bound. So where searches fail, the bound is raised.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from wingbeat.orbits.infeasible.relaxation import Change, Relaxation, relaxation
from wingbeat.orbits.nlp.defect_correction import Corrected, first_certified
from wingbeat.orbits.nlp.local_search import search
from wingbeat.orbits.nlp.outputs import AT_BOUND
from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.orbits.problem.objectives import Frequency
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.starts import start_point

# Times the lower bound, the raised bounds at which an orbit is looked for, and the searches for each.
_RAISED = (2.0, 4.0, 8.0)
_SEARCHES = 4


def is_at_lower_bound(problem: OrbitProblem, unknowns: np.ndarray) -> bool:
    """Say whether the frequency is minimised and is at its lower bound: no search can better that."""
    if not isinstance(problem.minimise, Frequency):
        return False
    low, high = problem.bounds["frequency"]
    return problem.frequency(unknowns) - low <= AT_BOUND * (high - low)


def may_end_at_lower_bound(problem: OrbitProblem, closed: Iterable[np.ndarray]) -> bool:
    """Say whether least frequency may end at its bound: in a descent, or where a beat at the bound closed."""
    if not isinstance(problem.minimise, Frequency):
        return False
    return problem.climb < 0 or any(is_at_lower_bound(problem, unknowns) for unknowns in closed)


def from_raised_bound(problem: OrbitProblem, seed: int = 0) -> tuple[Relaxation, Corrected] | None:
    """Return the least raise of the lower bound of frequency at which an orbit is certified, and that orbit."""
    low, high = (float(bound) for bound in problem.bounds["frequency"])
    for times in _RAISED:
        change = relaxation(problem, Change("frequency", ">=", low, _RAISED[-1] * low, low), times * low)
        if change.new >= high:
            return None
        programme = Transcription(change.apply(problem))
        for index in range(_SEARCHES):
            met = search(programme.anew(), start_point(programme.problem, index, seed))
            at_bound = is_at_lower_bound(programme.problem, programme.physical(met.scaled))
            orbit = first_certified(programme, [met]) if at_bound else None
            if orbit is not None:
                return change, orbit
    return None


def words_of_raise(problem: OrbitProblem, change: Relaxation) -> str:
    """Return why searches failed where an orbit was certified at a raised bound only, and what to do."""
    return (
        f"the least frequency is between its lower bound, {change.old:g} Hz, and {change.new:g} Hz, where an orbit "
        "was certified; of lower ones none could be. The wings hardly need to beat here, the problem ends at the "
        "lower bound of frequency, and more starts will hardly help. "
        f"Raise that bound ({change.text}), minimise a power, or see `wingbeat glide {problem.species.name}`"
    )
