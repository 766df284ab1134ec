"""A measured motion compared with the air loads of every coefficient model and every choice of terms."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base import Report, Reported
from wingbeat.aero import LIBRARY, BladeElement
from wingbeat_evidence.measured_motion.choice import (
    Regime,
    attached_share,
    model_distance,
    preference,
    reason,
    regime_of,
    wanted_model,
)
from wingbeat_evidence.measured_motion.ladder import THIN_AEROFOIL_WAKE, Rung, ladder
from wingbeat_evidence.measured_motion.reading import read_strip_case
from wingbeat_evidence.measured_motion.report import validation_report
from wingbeat_evidence.measured_motion.scores import Score, floor, score, sine_score
from wingbeat_evidence.measured_motion.strip_case import AXES, StripCase
from wingbeat_evidence.measured_motion.strip_loads import StripLoads, momentum_inflow, strip_loads
from wingbeat_evidence.measured_motion.strip_motion import StripMotion, strip_motion

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure


@dataclass(frozen=True)
class ValidationRow:
    """One coefficient model with a choice of terms, compared with a measured motion.

    Attributes
    ----------
    aero : the air loads.
    unsteady : "none", "thin-aerofoil" or "thin-aerofoil-wake".
    recommended : whether the rule of `measured_motion.choice` recommends this row; exactly one row
        is recommended.
    fx, fz : how close the computed forward and upward forces are to the measured ones.
    aerodynamic_power : mean power that the wings give to the air [W].
    loads : the loads through time.

    >>> import wingbeat_evidence as evidence
    >>> row = evidence.validate(evidence.shipped_cases()[0], aero=["dickinson"]).recommended
    >>> row.aero.coefficients.name, row.unsteady, round(row.fz.mean_ratio, 1)
    ('dickinson', 'none', 0.9)
    """

    aero: BladeElement
    unsteady: str
    recommended: bool
    fx: Score
    fz: Score
    aerodynamic_power: float
    loads: StripLoads

    def to_dict(self) -> dict[str, Any]:
        """Return the row as JSON types."""
        return {
            "aero": self.aero.coefficients.name,
            "extension": self.aero.coefficients.extension,
            "unsteady": self.unsteady,
            "inflow": self.aero.inflow,
            "recommended": self.recommended,
            "fz": self.fz.to_dict(),
            "fx": self.fx.to_dict(),
            "aerodynamic_power": self.aerodynamic_power if np.isfinite(self.aerodynamic_power) else None,
        }


@dataclass(frozen=True)
class Validation(Reported):
    """A measured motion, and the loads of every model and term on it.

    Attributes
    ----------
    case : the measured motion and its forces.
    motion : of its strips through still air.
    regime : Reynolds number, reduced frequency and kind of wing, which decide the recommendation.
    rows : one for each model and choice of terms.
    reason : why the recommended row is recommended.

    >>> import wingbeat_evidence as evidence
    >>> found = evidence.validate(evidence.shipped_cases()[0], aero=["dickinson"])
    >>> len(found.rows), found.recommended.unsteady
    (2, 'none')
    """

    case: StripCase
    motion: StripMotion
    regime: Regime
    rows: tuple[ValidationRow, ...]
    reason: str

    @property
    def recommended(self) -> ValidationRow:
        """The row that the rule prefers; the rule never sees the measured force."""
        return next(row for row in self.rows if row.recommended)

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes for the reader."""
        start = ()
        if self.case.period is None and any(row.unsteady == THIN_AEROFOIL_WAKE for row in self.rows):
            start = ("the motion does not repeat, so the wake at the first time is taken as that of steady flight",)
        return (*self.case.notes, *self.motion.notes, *start)

    def _report(self) -> Report:
        return validation_report(self)

    def plot(self) -> Figure:
        """Return a figure of the forces, of their residuals and of the angles of attack through time."""
        from wingbeat_evidence.measured_motion.figure import (
            validation_page,  # which draws validations, and so knows them
        )

        return validation_page(self)

    def to_dataframe(self) -> pd.DataFrame:
        """Return a table of the rows, with the names of `ValidationRow.to_dict`: ``aero``, ``fz.rms`` and so on.

        >>> from wingbeat_evidence.measured_motion import shipped_cases
        >>> table = validate(shipped_cases()[0], aero=["dickinson"]).to_dataframe()
        >>> table["recommended"].sum(), "fz.mean_ratio" in table
        (np.int64(1), True)
        """
        import pandas as pd

        return pd.json_normalize([row.to_dict() for row in self.rows])

    def to_dict(self) -> dict[str, Any]:
        """Return the comparison as JSON types; None where nothing was measured or a number has no meaning."""
        regime = self.regime
        return {
            "case": self.case.name,
            "results": [row.to_dict() for row in self.rows],
            "reason": self.reason,
            "wing": regime.wing,
            "wing_guessed": regime.guessed,
            "reynolds": regime.reynolds,
            "reduced_frequency": regime.reduced_frequency,
            "null_model": {axis: sine_score(self.case, axis) for axis in AXES},
            "floor": {axis: floor(self.case, axis) for axis in AXES},
            "notes": list(self.notes),
        }


def validate(
    case: StripCase | str | Path,
    aero: Sequence[Any] | None = None,
    unsteady: str | None = None,
    inflow: str | None = None,
    induced_factor: float = 1.2,
    extension: str | None = None,
) -> Validation:
    """Evaluate the air loads of coefficient models and terms on a measured motion, and compare the forces.

    Each model has a row for each choice of terms. The unsteady terms are none, those of a thin aerofoil, or those
    of a thin aerofoil with the lag of the wake; each choice has a row with momentum inflow and a row without.
    Inflow and lag need a model with an aspect ratio. For other models, rows with inflow or lag are left out. If
    you ask for such a model with such a term, the call is refused.

    A rule recommends exactly one row (`wingbeat_evidence.measured_motion.choice`). It uses Reynolds number, reduced
    frequency, kind of wing and speed, and never sees the measured force. If no row has the loads that the rule
    wants, it recommends the nearest row: nearest in the model first, then in the unsteady terms, then in the
    inflow.

    The power that the wings give to the air is minus the power of loads and couples on the wing's motion through
    still air. In steady flight without body drag it equals the hinge power.

    Parameters
    ----------
    case : a measured motion, or the path of its case.toml.
    aero : coefficient models, their names or files; all of the library if not given.
    unsteady : "none", "thin-aerofoil" or "thin-aerofoil-wake" keeps only these rows.
    inflow : "none" or "momentum" keeps only these rows.
    induced_factor : induced power of the inflow over that of an ideal disc.
    extension : how models of the library and of files are extended to all angles; each model's own if not given.

    Raises
    ------
    FileError : a file is missing or cannot be read.
    InvalidInputError : inputs that `read_strip_case` and `BladeElement` refuse; a model without an aspect ratio
        that is given together with inflow or the lag of the wake.

    >>> from wingbeat_evidence.measured_motion import shipped_cases
    >>> found = validate(shipped_cases()[0], aero=["dickinson"])
    >>> found.recommended.aero.unsteady, 0.8 < found.recommended.fz.mean_ratio < 1.2
    ('none', True)
    """
    rungs = ladder(aero, unsteady, inflow, induced_factor, extension)
    measured = case if isinstance(case, StripCase) else read_strip_case(case)
    motion = strip_motion(measured)
    regime = regime_of(measured, motion)
    wanted = wanted_model(regime, list(LIBRARY))
    nearest = min(rungs, key=lambda rung: model_distance(regime, rung.aero.coefficients, wanted)).aero
    attached = attached_share(measured, motion, nearest.coefficients)
    best = min(rungs, key=lambda rung: preference(regime, rung, wanted, attached))
    moving = {"none": motion}
    if any(rung.aero.inflow != "none" for rung in rungs):
        moving["momentum"] = motion.in_moving_air(measured, momentum_inflow(measured, induced_factor))
    rows = tuple(_row(measured, motion, moving[rung.aero.inflow], rung, rung is best) for rung in rungs)
    return Validation(measured, motion, regime, rows, reason(regime, best, wanted, attached))


def _row(case: StripCase, motion: StripMotion, moving: StripMotion, rung: Rung, best: bool) -> ValidationRow:
    loads = strip_loads(case, motion, moving, rung.aero)
    fx, fz = score(case, "fx", loads.fx), score(case, "fz", loads.fz)
    return ValidationRow(rung.aero, rung.unsteady, best, fx, fz, float(case.mean(loads.power)), loads)
