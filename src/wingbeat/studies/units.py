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
    """Points that are solved together: one point, or a chain in order, in which earlier results help later points.

    Parameters
    ----------
    recipe : the base's inputs as JSON.
    tasks : the points.
    skip : keys of points of a chain that are left out, because they crash their process.
    """

    recipe: str
    tasks: tuple[Task, ...]
    skip: tuple[str, ...] = ()


class Waiting(NamedTuple):
    """A unit that waits to be solved, and which of its points are wanted."""

    unit: Unit
    wanted: tuple[str, ...]


class Outcome(NamedTuple):
    """How one point ended.

    Parameters
    ----------
    key : of the point.
    status : one of `STATUSES`.
    record : the orbit record as JSON without its computing time; None if there is none.
    certificate : largest residual of the certifier's flight (m, rad, m/s, rad/s); None if nothing was flown or the
        flight diverged.
    text : the search's message if nothing is certified, or the error.
    seconds : computing time of the point [s].
    """

    key: str
    status: str
    record: str | None
    certificate: float | None
    text: str
    seconds: float


def failed(key: str, status: str, text: str, seconds: float = 0.0) -> Outcome:
    """Return the outcome of a point without a result."""
    return Outcome(key, status, None, None, text, seconds)
