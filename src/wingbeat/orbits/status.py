"""How the solver ended."""

from __future__ import annotations

import enum


class Status(enum.Enum):
    """How the solver ended; the value is the name in records.

    >>> import wingbeat as wb
    >>> [status.value for status in wb.Status]
    ['converged', 'infeasible', 'not-converged']
    >>> wb.Status("converged") is wb.Status.CONVERGED
    True
    """

    CONVERGED = "converged"
    INFEASIBLE = "infeasible"
    NOT_CONVERGED = "not-converged"
