"""The result if no start leads to an orbit: the closest wingbeat, its deficits, and changes that lead to one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from wingbeat.orbits.infeasible.deficit import Deficit
from wingbeat.orbits.infeasible.diagnosis import (
    certified_changes,
    certified_without_terms,
    least_changes,
    nearest_beat,
    words_of,
)
from wingbeat.orbits.infeasible.lower_bound import from_raised_bound, may_end_at_lower_bound, words_of_raise
from wingbeat.orbits.infeasible.relaxation import Relaxation
from wingbeat.orbits.nlp.defect_correction import Corrected, certified, first_certified
from wingbeat.orbits.nlp.local_search import Candidate, search
from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.orbits.status import Status


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
) -> tuple[Corrected, Ending | None]:
    """Return the closest wingbeat and what fails; if it leads to an orbit after all, return that orbit.

    Parameters
    ----------
    programme : the problem's programme.
    found : where the local searches ended, none of them an orbit.
    threads : number of changes that are tried at a time.
    advise : whether to search for changes that lead to an orbit.
    progress : called with (starts done, starts in all); each change counts as one more start.
    """
    nearest = nearest_beat(programme, found)
    near = programme.physical(nearest.scaled)

    def report(done: int, total: int) -> None:
        if progress is not None:
            progress(len(found) + done, len(found) + total)

    closed = [programme.physical(c.scaled) for c in found if c.closed]
    raised = from_raised_bound(programme) if may_end_at_lower_bound(programme, closed) else None
    if raised is not None:
        return _below(programme, *raised)
    changes = least_changes(programme, near, nearest, threads, report) if advise and not nearest.closes else []
    # If a negligible change suffices, the local searches missed an orbit.
    negligible = programme.options.diagnosis.negligible_change
    leads = [near] * nearest.closes + [least.unknowns for least in changes if least.share <= negligible]
    led = [search(programme.uncorrected(), lead) for lead in leads]
    orbit = first_certified(programme, led)
    if orbit is not None:
        return orbit, None
    closing = [c for c in (*found, *led) if c.closed]
    if closing:
        return _uncertified(closing, len(found))
    if nearest.closes:
        return certified(programme.uncorrected(), nearest.scaled), _no_optimum("almost closed", len(found))
    flying = certified_changes(programme, changes)
    message = f"no orbit within the bounds from {_starts(len(found))}: {words_of(programme, nearest.deficits)}"
    if flying:
        message += f"; the smallest single changes that give an orbit: {', or '.join(r.text for r in flying)}"
    elif advise:
        message += "; no single change of a bound, a limit, the mass, the speed or the shoulder gave an orbit"
    without = certified_without_terms(programme, near, threads) if advise else ()
    message = "; ".join([message, *(term.text for term in without)])
    ending = Ending(Status.INFEASIBLE, message, nearest.deficits, (*flying, *without))
    return certified(programme.uncorrected(), nearest.scaled), ending


def unexplained(found: list[Candidate]) -> tuple[Corrected, Ending]:
    """Return the candidate closest to an orbit without a diagnosis; the status says whether it closes."""
    closing = [c for c in found if c.closed]
    if closing:
        return _uncertified(closing, len(found))
    nearest = min(found, key=lambda c: c.violation)
    message = f"no orbit within the bounds from {_starts(len(found))}; the balance that fails was not computed"
    return certified(nearest.programme.uncorrected(), nearest.scaled), Ending(Status.INFEASIBLE, message)


def _uncertified(closing: list[Candidate], searches: int) -> tuple[Corrected, Ending]:
    """Return the candidate that closes best; it is not a certified optimum."""
    nearest = min(closing, key=lambda c: c.violation)
    return certified(nearest.programme.uncorrected(), nearest.scaled), _no_optimum("closed", searches)


def _no_optimum(how: str, searches: int) -> Ending:
    found = f"{how} wingbeats were found from {_starts(searches)}, but none could be certified as an optimum"
    return Ending(Status.NOT_CONVERGED, f"{found}; try more starts or another seed")


def _starts(count: int) -> str:
    return f"{count} start" if count == 1 else f"{count} starts"


def _below(programme: Transcription, change: Relaxation, orbit: Corrected) -> tuple[Corrected, Ending | None]:
    """Search from the orbit at a raised bound of the frequency; if that fails, return this orbit and the change."""
    problem, beat = programme.problem, orbit.programme.physical(orbit.scaled)
    lower = first_certified(programme, [search(programme.uncorrected(), beat)])
    if lower is not None:
        return lower, None
    message = words_of_raise(problem, change)
    ending = Ending(Status.NOT_CONVERGED, message, relaxations=(change,))
    return certified(programme.uncorrected(), programme.scaled(beat)), ending
