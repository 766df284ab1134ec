"""How the air loads on a measured motion compare with the measurement, as the blocks of a report."""

from __future__ import annotations

from typing import TYPE_CHECKING

from wingbeat._base import Block, Line, Notes, Report, Row, Table

if TYPE_CHECKING:
    from wingbeat_evidence.measured_motion.comparison import Validation, ValidationRow

_NUMBERS = {
    "mean": "mean_ratio",
    "peak": "peak_ratio",
    "rms": "rms",
    "about\nmean": "rms_about_mean",
    "corr.": "correlation",
    "lag": "lag",
}
_AXES = (("fz", "upward force"), ("fx", "forward force"))
_LEGEND = (
    "mean, peak: computed force / measured force",
    "rms: rms of the difference / weight",
    "about mean: rms of the difference / rms of the measurement, after each force's mean is subtracted",
    "lag: fraction of a beat, positive if the computed force is late",
    "wake: thin-aerofoil with the lag of the wake",
)


def validation_report(found: Validation) -> Report:
    """Return a table of the rows for each measured force, the recommended row, and what the numbers mean.

    Parameters
    ----------
    found : from `validate`.
    """
    tables = [_table(found, axis, label) for axis, label in _AXES]
    blocks: list[Block] = [Line(found.case.name, tone="title"), *(table for table in tables if table)]
    blocks.append(Line(f"* marks the recommended row. {found.reason}"))
    said = found.to_dict()
    for axis, label in _AXES:
        sine, noise = said["null_model"][axis], said["floor"][axis]
        if sine["rms"] is not None:
            fitted = f"{label}: the best sine (at the beat's frequency, fitted to the measured force)"
            blocks.append(Line(f"{fitted} differs from that force by an rms of {sine['rms']:.3f} of the weight"))
        if noise is not None:
            error = f"the standard error of the measurement has an rms of {noise:.3f} of the weight"
            blocks.append(Line(f"{label}: {error}"))
    return [*blocks, Notes(found.notes), *map(Line, _LEGEND), Line("")]


def _table(found: Validation, axis: str, label: str) -> Table | None:
    """Return the scores of every row along an axis; None if nothing was measured along it."""
    scores = [getattr(row, axis) for row in found.rows]
    known = {h: key for h, key in _NUMBERS.items() if any(getattr(one, key) is not None for one in scores)}
    if not known:
        return None
    rows = []
    for row, one in zip(found.rows, scores, strict=True):
        numbers = [getattr(one, key) for key in known.values()]
        rows.append(Row(_cells(row, numbers), "good" if row.recommended else ""))
    return Table(tuple(rows), (label, "terms", *known, "power\n[W]"), "ll" + "r" * (len(known) + 1))


def _cells(row: ValidationRow, numbers: list[float | None]) -> tuple[str, ...]:
    aero = row.aero
    name = ("* " if row.recommended else "  ") + aero.coefficients.name
    terms = [term for term in (row.unsteady.removeprefix("thin-aerofoil-"), aero.inflow) if term != "none"]
    shown = ["-" if value is None else f"{value:z.2f}" for value in numbers]
    both = "both" if terms[:1] == ["thin-aerofoil"] else " + ".join(terms)
    return name, ("-", *terms, both)[len(terms) + (len(terms) > 1)], *shown, f"{row.aerodynamic_power:.3g}"
