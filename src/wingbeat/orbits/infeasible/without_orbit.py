"""What is said where searches led to no orbit: the beat that comes closest, what it lacks, what would fly."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from wingbeat.orbits.infeasible.deficit import Deficit
from wingbeat.orbits.infeasible.diagnosis import certified_changes, least_changes, nearest_beat, words_of
from wingbeat.orbits.infeasible.lower_bound import from_raised_bound, may_end_at_lower_bound, words_of_raise
from wingbeat.orbits.infeasible.relaxation import Relaxation
from wingbeat.orbits.nlp.defect_correction import Corrected, certified, first_certified
from wingbeat.orbits.nlp.local_search import Candidate, search
from wingbeat.orbits.nlp.transcription import Transcription
from wingbeat.orbits.status import Status


@dataclass(frozen=True)
class Ending:
    """How a search ended, and without an orbit what is short at the closest beat and which changes fly."""

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
    """Return the beat that comes closest to an orbit and what fails; if it closes, the orbit that it leads to.

    Parameters
    ----------
    programme : the programme that was searched.
    found : where the searches ended, none of them an orbit.
    threads : changes that are looked at at a time.
    advise : whether to look for changes that fly.
    progress : called with (searches done, searches in all), each change one more.
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
    # A change of next to nothing is none: the searches missed what was there.
    nothing = programme.options.diagnosis.nothing
    leads = [near] * nearest.closes + [least.unknowns for least in changes if least.share <= nothing]
    led = [search(programme.uncorrected(), lead) for lead in leads]
    orbit = first_certified(programme, led)
    if orbit is not None:
        return orbit, None
    closing = [c for c in (*found, *led) if c.closed]
    if closing:
        return _uncertified(closing, len(found))
    if nearest.closes:
        return certified(programme.uncorrected(), nearest.scaled), _no_optimum("almost close", len(found))
    flying = certified_changes(programme, changes)
    message = f"no orbit within the bounds from {_starts(len(found))}: {words_of(programme, nearest.deficits)}"
    if flying:
        message += f"; the smallest single changes that fly: {', or '.join(r.text for r in flying)}"
    elif advise:
        message += "; no single change of a bound, a limit, the mass, the speed or the shoulder was found to fly"
    ending = Ending(Status.INFEASIBLE, message, nearest.deficits, flying)
    return certified(programme.uncorrected(), nearest.scaled), ending


def unexplained(found: list[Candidate]) -> tuple[Corrected, Ending]:
    """Return the beat that came closest to an orbit where searches ended, and only whether it closes."""
    closing = [c for c in found if c.closed]
    if closing:
        return _uncertified(closing, len(found))
    nearest = min(found, key=lambda c: c.violation)
    message = f"no orbit within the bounds from {_starts(len(found))}; the balance that fails was not computed"
    return certified(nearest.programme.uncorrected(), nearest.scaled), Ending(Status.INFEASIBLE, message)


def _uncertified(closing: list[Candidate], searches: int) -> tuple[Corrected, Ending]:
    """Return the beat that closes best, of those that do but are no optima."""
    nearest = min(closing, key=lambda c: c.violation)
    return certified(nearest.programme.uncorrected(), nearest.scaled), _no_optimum("close", searches)


def _no_optimum(how: str, searches: int) -> Ending:
    found = f"beats that {how} were found from {_starts(searches)}, but none could be certified as an optimum"
    return Ending(Status.NOT_CONVERGED, f"{found}; try more starts or another seed")


def _starts(count: int) -> str:
    return f"{count} start" if count == 1 else f"{count} starts"


def _below(programme: Transcription, change: Relaxation, orbit: Corrected) -> tuple[Corrected, Ending | None]:
    """Return the orbit that one at a raised bound of the frequency leads to, or that one and what to change."""
    problem, beat = programme.problem, orbit.programme.physical(orbit.scaled)
    lower = first_certified(programme, [search(programme.uncorrected(), beat)])
    if lower is not None:
        return lower, None
    message = words_of_raise(problem, change)
    ending = Ending(Status.NOT_CONVERGED, message, relaxations=(change,))
    return certified(programme.uncorrected(), programme.scaled(beat)), ending
