"""Diagnosis of a problem without an orbit: the closest wingbeat, the balance that fails, and changes that help.

A single change, of a bound, a limit, a mass or a speed, is made as small as possible by a relaxed problem, in which
this number is one more unknown.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from itertools import islice
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from wingbeat._base import InvalidInputError
from wingbeat.orbits.changes import (
    FIRST,
    Change,
    Relaxation,
    holds_frequency,
    in_turn,
    is_limit,
    on_and_off,
    possible_changes,
    relaxation,
    terms_on,
    with_change,
    with_trace_of,
    without_term,
    words_without,
)
from wingbeat.orbits.deficit import Deficit, Nearest, bounds_near, nearest_beat, words_of
from wingbeat.orbits.flight.period import PATH_NAMES
from wingbeat.orbits.nlp.newton_kkt import Corrected, certified, correct, first_certified
from wingbeat.orbits.nlp.programme import Programme
from wingbeat.orbits.nlp.transcription import Candidate, Transcription, refine, restore_feasibility, search
from wingbeat.orbits.options import SolverOptions, Status
from wingbeat.orbits.problem.quantity import MapQuantity
from wingbeat.orbits.starts import is_at_lower_bound, plainly, start_point, starts_in_words

if TYPE_CHECKING:
    from wingbeat.orbits.problem.problem import OrbitProblem

_SMALLEST = "the smallest single changes that give an orbit"
# Number of cached problems: those of the last few points and of their difference quotients.
_REMEMBERED = 8


# --- Relaxed problems: one number moves as little as possible. ---


class _Relaxed(Programme):
    """A programme that minimises the change of one number; the change divided by its scale is one more unknown."""

    def __init__(self, programme: Transcription, change: Change) -> None:
        self.change, self._programme = change, programme
        self.lower, self.upper = np.append(programme.lower, 0.0), np.append(programme.upper, change.widest)

    def start(self, unknowns: np.ndarray, share: float) -> np.ndarray:
        """Return a start: a beat that closes, and the number moved back as far as this beat allows."""
        scaled = np.clip(np.append(unknowns / self._programme.unknowns.scale, share), self.lower, self.upper)
        slope = self.inequalities_jacobian(scaled)[:, -1]
        spare = (self.inequalities(scaled)[slope > 0] / slope[slope > 0]).min()
        return np.append(scaled[:-1], np.clip(scaled[-1] - spare, 0.0, self.upper[-1]))

    def physical(self, scaled: np.ndarray) -> np.ndarray:
        """Return the problem's own unknowns in SI."""
        return self._programme.physical(scaled[:-1])

    def _at(self, scaled: np.ndarray) -> Transcription:
        """Return the problem's own programme at this point."""
        return self._programme

    def closure(self, scaled: np.ndarray) -> np.ndarray:
        return self._at(scaled).closure(scaled[:-1])

    def closure_jacobian(self, scaled: np.ndarray) -> np.ndarray:
        return np.pad(self._programme.closure_jacobian(scaled[:-1]), [(0, 0), (0, 1)])

    def inequalities(self, scaled: np.ndarray) -> np.ndarray:
        return self._at(scaled).inequalities(scaled[:-1])

    def inequalities_jacobian(self, scaled: np.ndarray) -> np.ndarray:
        return np.pad(self._programme.inequalities_jacobian(scaled[:-1]), [(0, 0), (0, 1)])

    def objective(self, scaled: np.ndarray) -> float:
        return float(scaled[-1])

    def objective_gradient(self, scaled: np.ndarray) -> np.ndarray:
        return np.eye(1, scaled.size, scaled.size - 1)[0]


class _RelaxedBound(_Relaxed):
    """The programme in which a bound of a free parameter moves; the last inequality is the margin within it."""

    def __init__(self, problem: OrbitProblem, change: Change, options: SolverOptions) -> None:
        programme = Transcription(with_change(problem, change.name, change.sign, change.reach), options)
        super().__init__(programme, change)
        self._column = programme.unknowns.names.index(change.name)
        self._scale = programme.unknowns.scale[self._column]

    def inequalities(self, scaled: np.ndarray) -> np.ndarray:
        bound = self.change.moved(scaled[-1]) / self._scale
        inside = self.change.direction * (bound - scaled[self._column])
        return np.append(super().inequalities(scaled), inside)

    def inequalities_jacobian(self, scaled: np.ndarray) -> np.ndarray:
        row = np.zeros(scaled.size)
        row[self._column], row[-1] = -self.change.direction, self.change.scale / self._scale
        return np.vstack([super().inequalities_jacobian(scaled), row])


class _RelaxedLimit(_Relaxed):
    """The programme in which a limit along the beat moves: that of body pitch, flap angle, or a constraint."""

    def __init__(self, problem: OrbitProblem, change: Change, options: SolverOptions) -> None:
        programme = Transcription(with_change(problem, change.name, change.sign, change.reach), options)
        super().__init__(programme, change)
        path = programme.path_limits
        rows, unit = [i for i, limit in enumerate(path) if limit == (change.name, change.sign)], 1.0
        if not rows:
            index = next(i for i, c in enumerate(problem.subject_to) if is_limit(c, change.name, change.sign))
            assert programme.outputs is not None
            rows = [len(path) + row for row in programme.outputs.values_of(index)]
            unit = problem.subject_to[index].quantity.scale
        self._moved, self._unit = rows, change.scale / unit

    def inequalities(self, scaled: np.ndarray) -> np.ndarray:
        inside = super().inequalities(scaled)  # with the limit at its reach
        inside[self._moved] += self._unit * (scaled[-1] - self.change.widest)
        return inside

    def inequalities_jacobian(self, scaled: np.ndarray) -> np.ndarray:
        jacobian = super().inequalities_jacobian(scaled)
        jacobian[self._moved, -1] += self._unit
        return jacobian


class _RelaxedNumber(_Relaxed):
    """The programme in which a number of vehicle, flight or wingbeat moves; derivatives by it are differences."""

    def __init__(self, problem: OrbitProblem, change: Change, options: SolverOptions) -> None:
        super().__init__(Transcription(problem, options), change)
        self._moved: dict[float, Transcription] = {}

    def start(self, unknowns: np.ndarray, share: float) -> np.ndarray:
        """Return a start: the beat and the number unchanged, because the beat closes with this number only."""
        return np.clip(np.append(unknowns / self._programme.unknowns.scale, share), self.lower, self.upper)

    def _at(self, scaled: np.ndarray) -> Transcription:
        share = float(scaled[-1])
        if share not in self._moved:
            if len(self._moved) == _REMEMBERED:
                del self._moved[next(iter(self._moved))]
            own, change = self._programme, self.change
            moved = with_change(own.problem, change.name, change.sign, change.moved(share))
            self._moved[share] = Transcription(moved, own.options)
        return self._moved[share]

    def closure_jacobian(self, scaled: np.ndarray) -> np.ndarray:
        return np.column_stack([self._at(scaled).closure_jacobian(scaled[:-1]), self._slope(self.closure, scaled)])

    def inequalities_jacobian(self, scaled: np.ndarray) -> np.ndarray:
        by_own = self._at(scaled).inequalities_jacobian(scaled[:-1])
        return np.column_stack([by_own, self._slope(self.inequalities, scaled)])

    def _slope(self, function: Callable[[np.ndarray], np.ndarray], scaled: np.ndarray) -> np.ndarray:
        """Return the derivative of a function by the number."""
        step = self._programme.options.diagnosis.difference_step
        step = step if scaled[-1] + step <= self.upper[-1] else -step
        return (function(np.append(scaled[:-1], scaled[-1] + step)) - function(scaled)) / step


class LeastChange(NamedTuple):
    """A change, its least amount (as a share of the change's scale), and the unknowns of a beat that closes."""

    change: Change
    share: float
    unknowns: np.ndarray


def least_change(
    problem: OrbitProblem, change: Change, near: np.ndarray, options: SolverOptions
) -> LeastChange | None:
    """Move a number far, until a beat closes, and then back as far as possible; None if none closes.

    `near` are the unknowns of a beat that nearly closes.
    """
    usual, search = options.diagnosis, options.search
    asked = [one.quantity for one in problem.subject_to if is_limit(one, change.name, change.sign)]
    relaxed = _RelaxedLimit if change.name in PATH_NAMES or asked else _RelaxedBound
    if change.sign == "=" or any(isinstance(quantity, MapQuantity) for quantity in asked):
        relaxed = _RelaxedNumber  # conditions of stability are not linear in their limit
    for share in change.tries or (change.widest,):
        share = min(share, change.widest)
        try:
            changed = with_change(problem, change.name, change.sign, change.moved(share))
        except InvalidInputError:
            # For example, a descent into the wings' own wake is refused, but a faster descent is possible.
            continue
        easy = Transcription(changed, options)
        for start in (start_point(easy.problem, 0, 0, search), near):
            if holds_frequency(problem) and not problem.subject_to:  # no matter at which power
                found = restore_feasibility(easy, easy.scaled(start))
            else:
                found, _ = easy.optimise(easy.scaled(start), usual.far_iterations, search.tolerance)
            if not easy.is_closed(found, search.closure_tolerance):
                continue
            programme = relaxed(problem, change, options)
            kept = programme.start(easy.physical(found), share)
            for _ in range(usual.back_times):
                scaled, _ = programme.optimise(kept, usual.back_iterations, search.tolerance)
                if not programme.is_closed(scaled, search.closure_tolerance) or scaled[-1] >= kept[-1]:
                    break
                kept = scaled
            return LeastChange(change, float(kept[-1]), programme.physical(kept))
    return None


def least_changes(
    programme: Transcription,
    near: np.ndarray,
    nearest: Nearest,
    threads: int,
    progress: Callable[[int, int], None] | None = None,
) -> tuple[list[LeastChange], tuple[Relaxation, ...], set[str]]:
    """Return single changes that let a beat close, each as small as possible, those that fly, and what was tried.

    `near` are the unknowns of the closest wingbeat; `threads` changes are tried at a time. The smallest come first.
    At a given frequency, the changes of `FIRST` do, and the search ends with `DiagnosisOptions.reported` of them.
    """
    problem, options = programme.problem, programme.options

    def least(change: Change) -> LeastChange | None:
        try:
            return least_change(problem, change, near, options)
        except InvalidInputError:  # the change makes the problem impossible
            return None

    at_bounds = bounds_near(programme, programme.scaled(near))
    shares = {deficit.law: deficit.share for deficit in nearest.deficits}
    changes = list(possible_changes(problem, at_bounds, shares, options.changes))
    held, most = holds_frequency(problem), options.diagnosis.reported
    changes = in_turn(changes) if held else changes
    found: list[LeastChange] = []
    flying: list[Relaxation] = []
    tried: set[str] = set()
    together = threads if held else len(changes)
    with ThreadPoolExecutor(threads) as pool:
        for first in range(0, len(changes), together):
            tried.update(change.name for change in changes[first : first + together])
            for i, answer in enumerate(pool.map(least, changes[first : first + together]), start=first + 1):
                if answer is not None and len(flying) < most:
                    found.append(answer)
                    flying += certified_changes(programme, [answer]) if held else ()
                if progress is not None:
                    progress(i, len(changes))
            if len(flying) == most:
                break
    return (found if held else sorted(found, key=lambda least: least.share)), tuple(flying), tried


def certified_changes(programme: Transcription, found: Iterable[LeastChange]) -> tuple[Relaxation, ...]:
    """Return the first few changes that, rounded outward, lead to a certified orbit."""
    problem, options, usual = programme.problem, programme.options, programme.options.diagnosis

    def flying() -> Iterator[Relaxation]:
        for least in found:
            value = least.change.moved(usual.slack * least.share)
            for more in usual.widened:
                change = relaxation(problem, least.change, value, more)
                try:
                    changed = Transcription(change.apply(problem), options)
                except InvalidInputError:  # impossible once rounded, such as a shoulder at the centre of mass
                    continue
                if _certified_from(changed, least.unknowns) is not None:
                    yield change
                    break

    return tuple(islice(flying(), usual.reported))


def certified_without_terms(programme: Transcription, near: np.ndarray, threads: int) -> tuple[Relaxation, ...]:
    """Return the terms of the air loads without which a certified orbit was found, one term left out at a time."""
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


# --- The least frequency may be at its lower bound, as in a descent that is nearly a glide. ---
# Where the wings hardly need to beat, orbits exist down to any frequency. Local searches often do not reach the
# bound, because the closure of a beat of half a second or more is far from linear. For a pigeon at 12 m/s and a
# sink of 7.2 m/s, none of 20 starts closed. With a lower bound of 2, 4 or 6 Hz, the first few starts found an orbit
# at that bound. So if all starts fail, the bound is raised.


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
            if at_bound and (orbit := first_certified(programme, [found])) is not None:
                return change, orbit
    return None


@dataclass(frozen=True)
class Ending:
    """How the solver ended; if no orbit exists, also the closest wingbeat's deficits, and changes that help."""

    status: Status
    message: str
    deficits: tuple[Deficit, ...] = ()
    relaxations: tuple[Relaxation, ...] = ()


def without_orbit(
    programme: Transcription,
    found: list[Candidate],
    threads: int,
    advise: bool,
    progress: Callable[[int, int], None] | None = None,
    nearest: Nearest | None = None,
) -> tuple[Corrected, Ending | None]:
    """Return the closest wingbeat and what fails; if it leads to an orbit after all, return that orbit.

    The searches ended in `found`. With `advise`, changes are sought, each for `progress` one more start.
    """
    problem, options = programme.problem, programme.options
    nearest = nearest or nearest_beat(programme, found)
    near = programme.physical(nearest.scaled)

    def report(done: int, total: int) -> None:
        if progress is not None:
            progress(len(found) + done, len(found) + total)

    closed = (programme.physical(c.scaled) for c in found if c.closed)
    sinks = problem.climb < 0 and problem.minimise.parameter == "frequency"
    if sinks or any(is_at_lower_bound(problem, end, options.search.bound_tolerance) for end in closed):
        raised = from_raised_bound(programme)
        if raised is not None:
            return _below(programme, *raised)
    plain = Transcription(plainly(problem), options) if programme.has_epigraph else programme
    changes: list[LeastChange] = []
    flying, tried = (), set()
    if advise and not nearest.closes:
        changes, flying, tried = least_changes(plain, near, nearest, threads, report)
    # If a negligible change suffices, the local searches missed an orbit.
    negligible = options.diagnosis.negligible_change
    leads = [near] * nearest.closes + [least.unknowns for least in changes if least.share <= negligible]
    led = [search(programme.uncorrected(), lead) for lead in leads]
    orbit = first_certified(programme, led)
    if orbit is not None:
        return orbit, None
    if closing := [c for c in (*found, *led) if c.closed]:
        return _uncertified(closing, len(found))
    if nearest.closes:
        return certified(programme.uncorrected(), nearest.scaled), _no_optimum("almost closed", len(found))
    held = holds_frequency(problem)
    flying = flying if held else certified_changes(plain, changes)
    which = "single changes that give an orbit, each the least" if held else _SMALLEST
    short = words_of(programme, nearest)
    message = f"no orbit within the bounds from {starts_in_words(len(found))}: {short}"
    if flying:
        message += f"; {which}: {', or '.join(r.text for r in flying)}"
    elif advise:
        message += "; no single change of a bound, a limit, the mass, the speed or the shoulder gave an orbit"
    others = [words for name, words in FIRST.items() if held and name in tried - {r.name for r in flying}]
    message += f"; no {' or '.join(others)} alone gives one" if others else ""
    # Problems without a term need compiled programs of their own.
    known = not advise or (held and len(flying) == options.diagnosis.reported)
    without = () if known else certified_without_terms(plain, near, threads)
    message = "; ".join([message, *(term.text for term in without)])
    ending = Ending(Status.INFEASIBLE, message, nearest.deficits, (*flying, *without))
    return certified(programme.uncorrected(), nearest.scaled), ending


def unexplained(found: list[Candidate]) -> tuple[Corrected, Ending]:
    """Return the candidate closest to an orbit without a diagnosis; the status says whether it closes."""
    if closing := [c for c in found if c.closed]:
        return _uncertified(closing, len(found))
    nearest = min(found, key=lambda c: c.violation)
    searched = f"no orbit within the bounds from {starts_in_words(len(found))}"
    message = f"{searched}; the balance that fails was not computed"
    return certified(nearest.programme.uncorrected(), nearest.scaled), Ending(Status.INFEASIBLE, message)


def _uncertified(closing: list[Candidate], searches: int) -> tuple[Corrected, Ending]:
    """Return the candidate that closes best; it is not a certified optimum."""
    nearest = min(closing, key=lambda c: c.violation)
    return certified(nearest.programme.uncorrected(), nearest.scaled), _no_optimum("closed", searches)


def _no_optimum(how: str, searches: int) -> Ending:
    found = f"{how} wingbeats were found from {starts_in_words(searches)}, but none could be certified"
    return Ending(Status.NOT_CONVERGED, f"{found} as an optimum; try more starts or another seed")


def _below(programme: Transcription, change: Relaxation, orbit: Corrected) -> tuple[Corrected, Ending | None]:
    """Search from the orbit at a raised bound of the frequency; if that fails, return this orbit and the change."""
    beat = orbit.programme.physical(orbit.scaled)
    lower = first_certified(programme, [search(programme.uncorrected(), beat)])
    if lower is not None:
        return lower, None
    message = (
        f"no orbit was certified below {change.new:g} Hz, but the lower bound of frequency is {change.old:g} Hz. "
        "The wings hardly need to beat here: the optimum is at the lower bound of frequency, and more starts will "
        f"hardly help. Raise that bound ({change.text}), minimise a power, or find the glides of this species with "
        "`wingbeat glide`"
    )
    ending = Ending(Status.NOT_CONVERGED, message, relaxations=(change,))
    return certified(programme.uncorrected(), programme.scaled(beat)), ending
