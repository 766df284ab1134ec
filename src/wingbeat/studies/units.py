"""What goes to a worker and what comes back: units of points, and how each point ended."""

from __future__ import annotations

from typing import Any, NamedTuple

CERTIFIED = "converged"
# The search ended; another try would end in the same way.
UNCERTIFIED = ("infeasible", "not-converged")
# The search did not end: an exception, a process that died, or a process that had to be stopped. `--retry-failed`
# tries them again.
FAILED = ("error", "crashed", "timeout")
STATUSES = (CERTIFIED, *UNCERTIFIED, *FAILED)


class Task(NamedTuple):
    """One point to solve: its key, and its values by path, which replace those of its unit's recipe."""

    key: str
    changes: dict[str, Any]


class Unit(NamedTuple):
    """Points that are solved together: one, or a chain in order, in which earlier results help later points."""

    recipe: str  # the base's inputs as JSON
    tasks: tuple[Task, ...]
    skip: tuple[str, ...] = ()  # keys of points of a chain that are left out, because they crash their process


class Waiting(NamedTuple):
    """A unit that waits to be solved, and which of its points are wanted."""

    unit: Unit
    wanted: tuple[str, ...]


class Outcome(NamedTuple):
    """How one point ended, with one of `STATUSES`."""

    key: str
    status: str
    record: str | None  # as JSON, without its computing time
    # Largest residual of the certifier's flight (m, rad, m/s, rad/s); None if nothing was flown or it diverged.
    certificate: float | None
    text: str  # the search's message if nothing is certified, or the error
    seconds: float  # computing time [s]


def failed(key: str, status: str, text: str, seconds: float = 0.0) -> Outcome:
    """Return the outcome of a point without a result."""
    return Outcome(key, status, None, None, text, seconds)
