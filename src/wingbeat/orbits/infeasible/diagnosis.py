"""Diagnosis of a problem without an orbit: which balance fails, and which change or omitted term gives an orbit."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from itertools import islice
from typing import NamedTuple

import numpy as np

from wingbeat._base import InvalidInputError
from wingbeat.orbits.infeasible.deficit import Balance, Deficit
from wingbeat.orbits.infeasible.relaxation import Change, Relaxation, possible_changes, relaxation
from wingbeat.orbits.infeasible.relaxed_problem import least_change
from wingbeat.orbits.infeasible.terms import on_and_off, terms_on, with_trace_of, without_term, words_without
from wingbeat.orbits.nlp.defect_correction import Corrected, correct
from wingbeat.orbits.nlp.local_search import Candidate, refine, search
from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.orbits.options.solver import SolverOptions
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.problem.quantities import QUANTITIES, Frequency
from wingbeat.orbits.starts import start_point


@dataclass(frozen=True)
class Nearest:
    """The closest wingbeat, in the optimiser's scale, and its deficits, the largest first."""

    scaled: np.ndarray
    deficits: tuple[Deficit, ...]
    closes: bool


class LeastChange(NamedTuple):
    """A change, its least amount (as a share of the change's scale), and the unknowns of a beat that closes."""

    change: Change
    share: float
    unknowns: np.ndarray


def nearest_beat(programme: Transcription, found: Sequence[Candidate]) -> Nearest:
    """Return the closest wingbeat; the search for it starts where the local searches ended."""
    balance, options = Balance(programme), programme.options.diagnosis
    apart, ends = options.ends_apart * (programme.upper - programme.lower), []
    for end in (c.scaled for c in sorted(found, key=lambda c: c.violation)):
        if len(ends) < options.nearest_ends and all((np.abs(end - other) > apart).any() for other in ends):
            ends.append(end)
    beat = balance.failing(ends)
    return Nearest(beat.scaled, balance.deficits(beat), beat.closes)


def words_of(programme: Transcription, deficits: Sequence[Deficit]) -> str:
    """Return the deficits as part of a sentence."""
    problem, least = programme.problem, programme.options.diagnosis.mentioned * abs(deficits[0].share)
    words = [str(d) for d in deficits if abs(d.share) >= least]
    place = f"at {problem.speed:g} m/s" if problem.speed else "in hover"
    limits = ", ".join(str(c) for c in problem.subject_to)
    return f"{place}{f' with {limits}' if limits else ''}, {' and '.join(words)}"


def least_changes(
    programme: Transcription,
    near: np.ndarray,
    nearest: Nearest,
    threads: int,
    progress: Callable[[int, int], None] | None = None,
) -> list[LeastChange]:
    """Return the single changes that let a beat close, each as small as possible, the smallest first.

    Parameters
    ----------
    programme : the programme of the problem without an orbit.
    near : the unknowns of the closest wingbeat.
    nearest : that wingbeat with its deficits.
    threads : number of changes that are tried at a time.
    progress : called with (changes tried, changes in all).
    """
    options = programme.options
    programme = _plainly(programme)
    problem = programme.problem
    at_bounds = bounds_near(programme, programme.scaled(near))
    shares = {deficit.law: deficit.share for deficit in nearest.deficits}
    changes = list(possible_changes(problem, at_bounds, shares, options.changes))
    found = []
    with ThreadPoolExecutor(threads) as pool:
        answers = pool.map(lambda change: _least_change(problem, change, near, options), changes)
        for i, (change, answer) in enumerate(zip(changes, answers, strict=True), start=1):
            if answer is not None:
                found.append(LeastChange(change, *answer))
            if progress is not None:
                progress(i, len(changes))
    return sorted(found, key=lambda least: least.share)


def certified_changes(programme: Transcription, found: Iterable[LeastChange]) -> tuple[Relaxation, ...]:
    """Return the first few changes that, rounded outward, lead to a certified orbit."""
    flying: list[Relaxation] = []
    programme = _plainly(programme)
    for least in found:
        certain = _certified_change(programme, least)
        if certain is not None:
            flying.append(certain)
        if len(flying) == programme.options.diagnosis.reported:
            break
    return tuple(flying)


def certified_without_terms(programme: Transcription, near: np.ndarray, threads: int) -> tuple[Relaxation, ...]:
    """Return the terms of the air loads without which a certified orbit was found, one term left out at a time.

    Parameters
    ----------
    programme : the programme of the problem without an orbit.
    near : the unknowns of the closest wingbeat.
    threads : number of terms that are tried at a time.
    """
    programme = _plainly(programme)
    with ThreadPoolExecutor(threads) as pool:
        tried = pool.map(lambda name: _without_term(programme, name, near), terms_on(programme.problem))
        return tuple(one for one in tried if one is not None)


def _without_term(programme: Transcription, name: str, near: np.ndarray) -> Relaxation | None:
    problem, options = programme.problem, programme.options
    starts = [near, *(start_point(problem, i, 0, options.search) for i in range(options.diagnosis.term_starts))]
    trace = with_trace_of(problem, name, options.diagnosis.term_trace)
    if trace is not None:
        # The stock wingbeat is not changed before the search; other starts are first brought close to closure, as
        # in `search_from_starts`.
        almost = Transcription(trace, options)
        ends = (search(almost.uncorrected(), start, restore=i != 1) for i, start in enumerate(starts))
        starts = [almost.physical(end.scaled) for end in islice((end for end in ends if end.closed), 1)]
    changed = Transcription(without_term(problem, name), options)
    for start in starts:
        if (orbit := _certified_from(changed, start)) is not None:
            text = words_without(problem, name, orbit.wingbeat.frequency)
            return Relaxation(name, "=", *on_and_off(problem, name), text)
    return None


def _certified_from(programme: Transcription, start: np.ndarray) -> Corrected | None:
    """Search from unknowns near an orbit, first briefly and then at length; return the certified orbit, or None."""
    for attempt in (refine, search):
        found = attempt(programme.uncorrected(), start)
        if found.is_optimum and (orbit := correct(found.programme, found.scaled)).is_orbit():
            return orbit
    return None


def _plainly(programme: Transcription) -> Transcription:
    """Return the programme with an objective that needs no epigraph variable."""
    problem = programme.problem
    if programme.has_epigraph:
        plain = Frequency() if "frequency" in problem.free else QUANTITIES["mean_positive_power"]
        problem = dataclasses.replace(problem, minimise=plain)
    return Transcription(problem, programme.options)


def bounds_near(programme: Transcription, scaled: np.ndarray) -> Iterator[tuple[str, str]]:
    """Yield (name, sign) of each bound, and of each limit along the path, that a beat is near."""
    share = programme.options.diagnosis.near_bound
    names, reach = programme.unknowns.names, share * (programme.upper - programme.lower)
    for name, x, low, high, near in zip(names, scaled, programme.lower, programme.upper, reach, strict=False):
        if name in programme.problem.free:
            if x - low <= near:
                yield name, ">="
            if high - x <= near:
                yield name, "<="
    path = zip(programme.path_limits, programme.inequalities(scaled), strict=False)
    yield from dict.fromkeys(limit for limit, inside in path if inside <= share)


def _least_change(
    problem: OrbitProblem, change: Change, near: np.ndarray, options: SolverOptions
) -> tuple[float, np.ndarray] | None:
    """Return the result of `least_change`, or None if the change makes the problem impossible."""
    try:
        return least_change(problem, change, near, options)
    except InvalidInputError:
        return None


def _certified_change(programme: Transcription, least: LeastChange) -> Relaxation | None:
    problem, options = programme.problem, programme.options
    for more in options.diagnosis.widened:
        value = least.change.moved(options.diagnosis.slack * least.share)
        change = relaxation(problem, least.change, value, more)
        try:
            changed = Transcription(change.apply(problem), options)
        except InvalidInputError:  # impossible once rounded, such as a shoulder at the centre of mass
            continue
        if _certified_from(changed, least.unknowns) is not None:
            return change
    return None
