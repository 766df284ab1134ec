"""What to tell a user who asked for an orbit that there is not: what fails, and which changes would fly."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from wingbeat.errors import InvalidInputError
from wingbeat.orbits.infeasible.deficit import Balance, Shortage
from wingbeat.orbits.infeasible.relaxation import Change, Relaxation, possible_changes, relaxation
from wingbeat.orbits.infeasible.relaxed_problem import least_change
from wingbeat.orbits.nlp.defect_correction import correct
from wingbeat.orbits.nlp.local_search import Candidate, refine, search
from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.orbits.problem.objectives import QUANTITIES, Frequency
from wingbeat.orbits.problem.problem import OrbitProblem

# Beats from which the closest is sought, of those that the searches ended with, and by how much of their range
# unknowns must differ for two to count as two: searches that end alike lead to one answer.
_NEAREST = 6
_APART = 0.2
# A bound that a beat is as near to as this share of its range holds it back.
_LEANING = 0.02
# Changes that are told; of a short share of a law, the part of the largest that is worth telling.
_TOLD = 3
_MENTION = 0.2
# Times the least change that is told: at the least itself there is one orbit only, and it is hard to certify.
_SLACK = 1.02
# Steps of the last digit that a change is widened by until a certified orbit is found.
_WIDER = (0, 1, 3, 10)


@dataclass(frozen=True)
class Nearest:
    """The beat within the bounds that comes closest to an orbit, and what it is short of, the most first."""

    scaled: np.ndarray
    shortages: tuple[Shortage, ...]
    closes: bool


class Eased(NamedTuple):
    """A change, by what share of its scale it must be made, and the unknowns of a beat that closes then."""

    change: Change
    share: float
    unknowns: np.ndarray


def nearest_beat(programme: Transcription, found: Sequence[Candidate]) -> Nearest:
    """Return the beat that comes closest to an orbit, from where the searches ended."""
    balance = Balance(programme)
    apart, ends = _APART * (programme.upper - programme.lower), []
    for end in (c.scaled for c in sorted(found, key=lambda c: c.violation)):
        if len(ends) < _NEAREST and all((np.abs(end - other) > apart).any() for other in ends):
            ends.append(end)
    closest = balance.failing(ends)
    return Nearest(closest.scaled, balance.shortages(closest), closest.closes)


def words_of(problem: OrbitProblem, shortages: Sequence[Shortage]) -> str:
    """Return what is short, in a sentence's part."""
    told = [str(s) for s in shortages if abs(s.share) >= _MENTION * abs(shortages[0].share)]
    place = f"at {problem.speed:g} m/s" if problem.speed else "in hover"
    limits = ", ".join(str(c) for c in problem.subject_to)
    return f"{place}{f' with {limits}' if limits else ''} {' and '.join(told)}"


def least_changes(
    problem: OrbitProblem,
    near: np.ndarray,
    nearest: Nearest,
    threads: int,
    progress: Callable[[int, int], None] | None = None,
) -> list[Eased]:
    """Return the single changes with which beats close, as small as they can be, the smallest first.

    Parameters
    ----------
    problem : the problem, with which none was found.
    near : the unknowns of the beat that comes closest.
    nearest : what that is short of.
    threads : changes that are looked at at a time.
    progress : called with (changes looked at, changes in all).
    """
    problem = _plainly(problem)
    programme = Transcription(problem)
    leans = leaning(programme, programme.scaled(near))
    changes = list(possible_changes(problem, leans, {s.law: s.share for s in nearest.shortages}))
    met = []
    with ThreadPoolExecutor(threads) as pool:
        found = pool.map(lambda change: _least_change(problem, change, near), changes)
        for i, (change, answer) in enumerate(zip(changes, found, strict=True), start=1):
            if answer is not None:
                met.append(Eased(change, *answer))
            if progress is not None:
                progress(i, len(changes))
    return sorted(met, key=lambda m: m.share)


def certified_changes(problem: OrbitProblem, met: Iterable[Eased]) -> tuple[Relaxation, ...]:
    """Return the first few changes with which, rounded outward, a certified orbit is found."""
    flying: list[Relaxation] = []
    problem = _plainly(problem)
    for eased in met:
        certain = _certified_change(problem, eased)
        if certain is not None:
            flying.append(certain)
        if len(flying) == _TOLD:
            break
    return tuple(flying)


def _plainly(problem: OrbitProblem) -> OrbitProblem:
    """Return the problem with an objective that needs no unknown of its own."""
    if not Transcription(problem).has_level:
        return problem
    plain = Frequency() if "frequency" in problem.free else QUANTITIES["mean_positive_power"]
    return dataclasses.replace(problem, minimise=plain)


def leaning(programme: Transcription, scaled: np.ndarray) -> Iterator[tuple[str, str]]:
    """Yield (name, sign) of the bounds that a beat is at, and of the limits of the whole path that it is at."""
    names, reach = programme.unknowns.names, _LEANING * (programme.upper - programme.lower)
    for name, x, low, high, near in zip(names, scaled, programme.lower, programme.upper, reach, strict=False):
        if name in programme.problem.free:
            if x - low <= near:
                yield name, ">="
            if high - x <= near:
                yield name, "<="
    margins = zip(programme.path_limits, programme.margins(scaled), strict=False)
    yield from dict.fromkeys(limit for limit, margin in margins if margin <= _LEANING)


def _least_change(problem: OrbitProblem, change: Change, near: np.ndarray) -> tuple[float, np.ndarray] | None:
    """Return what `least_change` does; a change on whose way a problem is impossible is none."""
    try:
        return least_change(problem, change, near)
    except InvalidInputError:
        return None


def _certified_change(problem: OrbitProblem, eased: Eased) -> Relaxation | None:
    for more in _WIDER:
        change = relaxation(problem, eased.change, eased.change.moved(_SLACK * eased.share), more)
        try:
            programme = Transcription(change.apply(problem))
        except InvalidInputError:  # rounded to where no problem is: a shoulder at the centre of mass, for one
            continue
        for seek in (refine, search):
            met = seek(programme.anew(), eased.unknowns)
            if met.closed and met.optimal and correct(met.programme, met.scaled).is_orbit():
                return change
    return None
