"""Problems whose least frequency is at the lower bound of frequency, as in a descent that is nearly a glide.

Where the wings hardly need to beat, orbits exist down to any frequency, and the optimum is at the bound. Local
searches often do not reach it, because the closure of a beat of half a second or more is far from linear. For a
pigeon at 12 m/s and a sink of 7.2 m/s, none of 20 starts closed. With a lower bound of 2, 4 or 6 Hz, the first few
starts found an orbit at that bound. So if all starts fail, the bound is raised.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from wingbeat.orbits.infeasible.relaxation import Change, Relaxation, relaxation
from wingbeat.orbits.nlp.defect_correction import Corrected, first_certified
from wingbeat.orbits.nlp.local_search import search
from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.starts import start_point


def is_at_lower_bound(problem: OrbitProblem, unknowns: np.ndarray, tolerance: float) -> bool:
    """Return whether the frequency is minimised and at its lower bound, so that no start can improve it."""
    if problem.minimise.parameter != "frequency":
        return False
    low, high = problem.bounds["frequency"]
    return problem.frequency(unknowns) - low <= tolerance * (high - low)


def may_end_at_lower_bound(programme: Transcription, closed: Iterable[np.ndarray]) -> bool:
    """Return whether the lowest frequency may be at its bound: in a descent, or if a beat at the bound closed."""
    problem, tolerance = programme.problem, programme.options.search.bound_tolerance
    if problem.minimise.parameter != "frequency":
        return False
    return problem.climb < 0 or any(is_at_lower_bound(problem, unknowns, tolerance) for unknowns in closed)


def from_raised_bound(unsolved: Transcription, seed: int = 0) -> tuple[Relaxation, Corrected] | None:
    """Return the least increase of the lower frequency bound with which an orbit is certified, and that orbit."""
    problem, options = unsolved.problem, unsolved.options
    raised, tolerance = options.diagnosis.raised_bounds, options.search.bound_tolerance
    low, high = (float(bound) for bound in problem.bounds["frequency"])
    for times in raised:
        change = relaxation(problem, Change("frequency", ">=", low, raised[-1] * low, low), times * low)
        if change.new >= high:
            return None
        programme = Transcription(change.apply(problem), options)
        for index in range(options.diagnosis.raised_starts):
            found = search(programme.uncorrected(), start_point(programme.problem, index, seed, options.search))
            at_bound = is_at_lower_bound(programme.problem, programme.physical(found.scaled), tolerance)
            orbit = first_certified(programme, [found]) if at_bound else None
            if orbit is not None:
                return change, orbit
    return None


def words_of_raise(problem: OrbitProblem, change: Relaxation) -> str:
    """Return the message for an orbit certified only at a raised bound: why starts failed, and what to do."""
    return (
        f"no orbit was certified below {change.new:g} Hz, but the lower bound of frequency is {change.old:g} Hz. "
        "The wings hardly need to beat here: the optimum is at the lower bound of frequency, and more starts will "
        "hardly help. Raise that bound "
        f"({change.text}), minimise a power, or find the glides of this species with `wingbeat glide`"
    )
