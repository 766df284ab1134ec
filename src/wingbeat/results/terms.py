"""Effects of terms of the air loads: best orbits as a term grows from none to all, and changes of family."""

from __future__ import annotations

import itertools
import time
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from wingbeat._base import FaultList, __version__
from wingbeat.orbits.branches import SHARE, Branches, certified, families, marks_of, trace
from wingbeat.orbits.options import DEFAULTS, SolverOptions
from wingbeat.orbits.problem.problem import OrbitProblem
from wingbeat.orbits.solve import Progress, check_search
from wingbeat.records.inputs import aero_record
from wingbeat.records.numbers import power_account
from wingbeat.records.tables import finite_or_none
from wingbeat.results.orbit import Orbit

SHARES = (0.0, 0.25, 0.5, 0.75, 1.0)
_MOST = 101
_NUMBERS = ("objective_value", "mean_power", "mean_positive_power", "mean_actuator_power", "body_pitch_range")


@dataclass(frozen=True)
class TermTrace:
    """Best orbits at each share of the terms of the air loads; made by `trace_terms`.

    Attributes
    ----------
    problem : the problem with the full terms, at share 1.
    orbits : the best orbit of each share, in order. If it is not certified, its message says why.
    branches : every optimum that was found, and how they are linked.
    seconds : computing time [s].

    >>> import wingbeat as wb
    >>> loads = wb.aero.BladeElement("su-fan", unsteady="thin-aerofoil")
    >>> problem = wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0, aero=loads)
    >>> trace = wb.trace_terms(problem, shares=[0.0, 1.0], starts=1)
    >>> [orbit.status.value for orbit in trace.orbits]
    ['converged', 'converged']
    """

    problem: OrbitProblem
    orbits: tuple[Orbit, ...]
    branches: Branches
    seconds: float

    def record(self) -> dict[str, Any]:
        """Return the trace as a JSON-able dictionary: SI units, radians, None for missing values.

        ``points`` has the best orbit of each share, with its ``family``. ``marks`` lists the shares between which
        the best orbit changes branch or active bounds, or is missing. ``same_family`` says whether continuation
        along the best orbits leads from none of the terms to all of them.
        """
        labels = families(self.branches)
        marks = [mark._asdict() for mark in marks_of(self.branches)]
        points = []
        for orbit, row in zip(self.orbits, labels, strict=True):
            about = orbit.record()
            found = orbit.status.value == "converged"
            point = {"share": orbit.problem.aero.share, "status": about["status"], "message": about["message"]}
            point |= {"family": row[0] if found else None, "optima": len(row) if found else 0}
            point |= {name: about[name] if found else None for name in _NUMBERS}
            point["wingbeat"] = about["wingbeat"] if found else None
            spent = power_account(orbit.dataset)["spent"] if found else {}
            point["spent"] = {name: part["mean"] for name, part in spent.items()} if found else None
            points.append(point)
        record = {
            **{"species": self.problem.species.name, "speed": self.problem.speed, "climb": self.problem.climb},
            "air": dict(vars(self.problem.air)),
            **({"carried_mass": added} if (added := self.problem.species.carried_mass) else {}),
            "objective": self.problem.minimise.name,
            "aero": aero_record(self.problem.aero),
            "points": points,
            "marks": marks,
            "same_family": all(mark["kind"] == "bounds" for mark in marks),
            "solve_seconds": self.seconds,
            "version": __version__,
        }
        return finite_or_none(record)


def trace_terms(
    problem: OrbitProblem,
    shares: Sequence[float] = SHARES,
    starts: int = 6,
    seed: int = 0,
    progress: Progress | None = None,
    options: SolverOptions = DEFAULTS,
) -> TermTrace:
    """Find the best orbits as the terms of a problem's air loads grow from none to all.

    Every optimum found at a share is continued to the neighbouring shares. The trace thus shows whether a term
    changes the wingbeat gradually, or makes another family of wingbeats the best.

    Parameters
    ----------
    problem : with ``unsteady``, ``wake`` or ``inflow`` in its air loads; they grow together. With ``inflow``, the
        sections' coefficients apply even at share 0, where there is no induced flow.
    shares : at least two, increasing, from 0 (none) to 1 (all).
    starts : number of starts at the first and the last share; each share in between gets a third as many.
    seed : of the random starts.
    progress : called with (tasks done, tasks known so far).
    options : of the solvers.

    Raises
    ------
    InvalidInputError : air loads without a term, shares that do not increase within 0 to 1, starts or seed out of
        range.

    >>> import wingbeat as wb
    >>> loads = wb.aero.BladeElement("su-fan", unsteady="thin-aerofoil")
    >>> pigeon = wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0, aero=loads)
    >>> wb.trace_terms(pigeon, shares=[0.0, 1.0], starts=1).record()["same_family"]
    True
    """
    check_search(starts, seed)
    faults = FaultList()
    if problem.aero.unsteady == problem.aero.wake == problem.aero.inflow == "none":
        fix = "give the air loads unsteady='thin-aerofoil', wake='jones-section' or inflow='momentum'"
        faults.add("problem.aero", "unsteady, wake and inflow none", "has no term to trace", fix)
    values = list(shares)
    good = all([faults.number(f"shares[{i}]", s, at_least=0, at_most=1) for i, s in enumerate(values)])
    if not 2 <= len(values) <= _MOST:
        faults.add("shares", len(values), f"must be 2 to {_MOST} shares", "for example 0:1:0.25")
    elif good and any(low >= high for low, high in itertools.pairwise(values)):
        faults.add("shares", values, "must increase", "give each share once, the smallest first")
    faults.raise_if_any()
    begun = time.perf_counter()
    problems = [SHARE.moved(problem, float(share)) for share in values]
    branches = trace(SHARE, problems, starts, seed, progress, options=options)
    orbits = tuple(Orbit.of(optima[0], starts, seed) for optima in branches.optima)
    return TermTrace(problem, orbits, branches, time.perf_counter() - begun)


def found_any(trace: TermTrace) -> bool:
    """Return whether some share has a certified orbit."""
    return any(certified(optima[0]) for optima in trace.branches.optima)
