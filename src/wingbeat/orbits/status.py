"""How the solver ended."""

from __future__ import annotations

import enum


class Status(enum.Enum):
    """How the solver ended; the value is the name in records."""

    CONVERGED = "converged"
    INFEASIBLE = "infeasible"
    NOT_CONVERGED = "not-converged"
