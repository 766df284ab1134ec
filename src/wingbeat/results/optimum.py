"""The steps that led to an optimum, and its Lagrange multipliers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from wingbeat._base import Line, Report, Reported, Row, Table, plain_unit
from wingbeat.records.tables import table_of

if TYPE_CHECKING:
    import pandas as pd

    from wingbeat.orbits.uncertainty import Multiplier


class Trace(Reported):
    """The steps of the searches that led to an orbit; `Orbit.trace` returns it.

    Each row has ``search``, ``stage``, ``iteration``, ``objective`` (in the objective's unit), ``residual`` and
    ``step``. Searches are numbered from 0 as they were made: from the starts, from the ends of searches of easier
    problems (these are left out themselves), and from further starts if none led to an orbit. The stages are
    ``restoration`` (a start is brought close to closure), ``search`` (SLSQP), ``correction`` (SLSQP where Newton's
    method fails) and ``certificate`` (flights of the certifier), whose search is the one that led to the orbit. The
    residual is the largest violation of closure and limits, at the certificate of closure alone; the step is the
    largest change of an unknown. Both are in the optimiser's scale, in which 1 is 0.1 m or rad, 1 m/s or 10 rad/s
    of a residual.

    Attributes
    ----------
    rows : the steps, in the order of the searches.
    objective : its name.

    >>> import wingbeat as wb
    >>> problem = wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0)
    >>> trace = wb.solve_orbit(problem, starts=1, trace=True).trace
    >>> trace.rows[-1]["stage"], trace.rows[-1]["residual"] < 1e-5
    ('certificate', True)
    """

    def __init__(self, rows: Sequence[Mapping[str, Any]], objective: str) -> None:
        self.rows = [dict(row) for row in rows]
        self.objective = objective

    def to_dataframe(self) -> pd.DataFrame:
        """Return a row for each step, with the names of `rows`.

        >>> import wingbeat as wb
        >>> problem = wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0)
        >>> list(wb.solve_orbit(problem, starts=1, trace=True).trace.to_dataframe())[2:]
        ['iteration', 'objective', 'residual', 'step']
        """
        return table_of(self.rows)

    def _report(self) -> Report:
        return trace_report(self.rows, self.objective)


def _numbers(row: Mapping[str, Any], names: Sequence[str]) -> list[str]:
    shown = {"objective": ".8g", "residual": ".1e", "step": ".1e"}
    return ["-" if row[name] is None else format(row[name], shown[name]) for name in names]


def trace_report(steps: Sequence[Mapping[str, Any]], objective: str) -> Report:
    """Return where each search ended, and the steps of the one that led to the orbit."""
    label = f"{objective.replace('_', ' ')} [{plain_unit(objective)}]"
    best = next((row["search"] for row in reversed(steps) if row["stage"] == "certificate"), None)
    ends = [[row for row in steps if row["search"] == i] for i in sorted({r["search"] for r in steps})]
    last = [[row for row in one if row["stage"] != "certificate"] for one in ends]
    searched = [
        Row((str(one[0]["search"]), str(len(one)), *_numbers(one[-1], ("objective", "residual"))))
        for one in last
        if one
    ]
    shown = [
        Row((row["stage"], str(row["iteration"]), *_numbers(row, ("objective", "residual", "step"))))
        for row in steps
        if row["search"] == best
    ]
    return [
        Line("where each search ended, in the optimiser's scale", tone="title"),
        Table(tuple(searched), ("search", "steps", label, "residual"), "nrrr"),
        Line(""),
        Line("no search was certified" if best is None else f"steps of search {best}", tone="title"),
        Table(tuple(shown), ("stage", "iteration", label, "residual", "largest step"), "nrrrr"),
    ]


class Multipliers(Reported):
    """Lagrange multipliers of an optimum; `Orbit.multipliers` returns it. Floquet multipliers are in the record.

    Each is the derivative of the least objective by the right-hand side of its condition, in the objective's unit
    per unit of the condition: of closure, by a prescribed miss, ``q(T) - q(0) - (U_x, U_z, 0, ...) T = miss``; of a
    bound or limit, by its value. So that of an upper bound or limit is negative or 0, that of a lower one positive
    or 0, and where none is listed it is 0. With ``L = J - sum(multiplier (condition - right-hand side))``, the
    gradient of L vanishes. Solvers that write ``L = f + sum(v c)``, such as SciPy's trust-constr, give the
    opposite sign.

    Attributes
    ----------
    closure : by the state that misses: x, z, body_pitch, u, w, pitch_rate.
    bounds : by name, such as ``flap_amplitude.upper``; ``body_pitch`` and ``flap`` are bounded along the whole
        path.
    limits : by the limited quantity, with ``.lower`` or ``.upper`` if it is limited on both sides.
    units : of each, by ``closure.x``, ``bounds.flap_amplitude.upper`` or ``limit.peak_power``.
    unique : whether no other multipliers belong to this optimum; if not, these are the smallest.

    >>> import wingbeat as wb
    >>> orbit = wb.solve_orbit(wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0), starts=1)
    >>> found = orbit.multipliers
    >>> found.bounds["flap_amplitude.upper"] < 0, found.units["bounds.flap_amplitude.upper"]
    (True, 'Hz per rad')
    """

    def __init__(self, found: Sequence[Multiplier], *, unique: bool = True) -> None:
        self.closure, self.bounds, self.limits = (
            {one.name: one.value for one in found if one.kind == kind} for kind in ("closure", "bounds", "limit")
        )
        self.units = {f"{one.kind}.{one.name}": one.unit for one in found}
        self.unique = unique

    def table(self) -> list[dict[str, Any]]:
        """Return condition, multiplier and unit of each, as plain dictionaries fit for JSON."""
        values = [*self.closure.values(), *self.bounds.values(), *self.limits.values()]
        pairs = zip(self.units.items(), values, strict=True)
        return [{"condition": name, "multiplier": value, "unit": unit} for (name, unit), value in pairs]

    def to_dataframe(self) -> pd.DataFrame:
        """Return a row for each condition, with the names of `table`."""
        return table_of(self.table())

    def _report(self) -> Report:
        rows = [Row((one["condition"], f"{one['multiplier']:.6g}", one["unit"])) for one in self.table()]
        fewer = [] if self.unique else [Line("others belong to this optimum too; these are the smallest")]
        return [
            Line("change of the least objective by each right-hand side", tone="title"),
            Table(tuple(rows), ("condition", "multiplier", "unit"), "nrn"),
            *fewer,
        ]
