"""A measured motion against every coefficient model and every step of the ladder of further terms."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from wingbeat.aero import INFLOWS, LIBRARY, UNSTEADY, BladeElement, CoefficientModel, coefficients_of
from wingbeat.aero.choosing import load_coefficients
from wingbeat.errors import FaultList, InvalidInputError
from wingbeat.measured_motion.choice import Regime, preference, reason, regime_of, wanted_model
from wingbeat.measured_motion.reading import read_strip_case
from wingbeat.measured_motion.scores import Score, floor, score, sine_score
from wingbeat.measured_motion.strip_case import AXES, StripCase
from wingbeat.measured_motion.strip_loads import StripLoads, momentum_inflow, strip_loads
from wingbeat.measured_motion.strip_motion import StripMotion, strip_motion


@dataclass(frozen=True)
class ValidationRow:
    """One coefficient model with a choice of terms, held against a measured motion.

    Attributes
    ----------
    aero : the air loads.
    recommended : whether the rule prefers them to all other rows.
    fx, fz : how close the forward and the upward force come.
    aerodynamic_power : mean power that the wings give to the air [W].
    loads : the loads through time.
    """

    aero: BladeElement
    recommended: bool
    fx: Score
    fz: Score
    aerodynamic_power: float
    loads: StripLoads

    def to_dict(self) -> dict[str, Any]:
        """Return the row as JSON's types."""
        return {
            "aero": self.aero.coefficients.name,
            "extension": self.aero.coefficients.extension,
            "unsteady": self.aero.unsteady,
            "inflow": self.aero.inflow,
            "recommended": self.recommended,
            "fz": self.fz.to_dict(),
            "fx": self.fx.to_dict(),
            "aerodynamic_power": self.aerodynamic_power if np.isfinite(self.aerodynamic_power) else None,
        }


@dataclass(frozen=True)
class Validation:
    """A measured motion, and the loads of every model and term on it.

    Attributes
    ----------
    case : the measured motion and its forces.
    motion : the same through still air.
    regime : Reynolds number, reduced frequency and kind of wing, by which the rule chooses.
    rows : one for each model and choice of terms.
    reason : why the recommended row is.
    """

    case: StripCase
    motion: StripMotion
    regime: Regime
    rows: tuple[ValidationRow, ...]
    reason: str

    @property
    def recommended(self) -> ValidationRow:
        """The row that the rule prefers; it never sees the measured force."""
        return next(row for row in self.rows if row.recommended)

    @property
    def notes(self) -> tuple[str, ...]:
        """Notes for the reader."""
        return (*self.case.notes, *self.motion.notes)

    def to_dict(self) -> dict[str, Any]:
        """Return the whole as JSON's types; None where nothing was measured or a number has no meaning."""
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

    The rows are every model with every step of the ladder: no terms, the thin-aerofoil terms, momentum inflow,
    both. Momentum inflow needs a model with an aspect ratio; rows of others are left out unless they are asked for.
    Exactly one row is recommended, by a rule of Reynolds number, reduced frequency, kind of wing and speed that
    never sees the measured force (`wingbeat.measured_motion.choice`). If the rows hold no such loads, the nearest
    are recommended: first by the model, then by the unsteady terms, then by the inflow.

    The power that the wings give to the air is minus the work of the loads along the velocities of the wing through
    still air, and of the couples along its turning. In steady flight without drag of the body it is the power of
    the hinges.

    Parameters
    ----------
    case : a measured motion, or the path of its case.toml.
    aero : coefficient models, their names or files; all of the library if not given.
    unsteady : "none" or "thin-aerofoil" keeps these rows alone.
    inflow : "none" or "momentum" keeps these rows alone.
    induced_factor : induced power of the inflow over that of an ideal disc.
    extension : how the library's models and those of files reach every angle; that of each model if not given.

    Raises
    ------
    FileError : a file is missing or cannot be read.
    InvalidInputError : what `read_strip_case` and `BladeElement` refuse; inflow for a model without an aspect ratio
        that was asked for.

    >>> from wingbeat.measured_motion import shipped_cases
    >>> found = validate(shipped_cases()[0], aero=["dickinson"])
    >>> found.recommended.aero.unsteady, 0.8 < found.recommended.fz.mean_ratio < 1.2
    ('thin-aerofoil', True)
    """
    loads = _air_loads(aero, unsteady, inflow, induced_factor, extension)
    measured = case if isinstance(case, StripCase) else read_strip_case(case)
    motion = strip_motion(measured)
    regime = regime_of(measured, motion)
    wanted = wanted_model(regime, list(LIBRARY))
    best = min(loads, key=lambda one: preference(regime, one, wanted))
    moving = {"none": motion}
    if any(one.inflow != "none" for one in loads):
        moving["momentum"] = motion.in_moving_air(measured, momentum_inflow(measured, induced_factor))
    rows = tuple(
        _row(measured, one, one is best, strip_loads(measured, motion, moving[one.inflow], one)) for one in loads
    )
    return Validation(measured, motion, regime, rows, reason(regime, best, wanted))


def _row(case: StripCase, aero: BladeElement, recommended: bool, loads: StripLoads) -> ValidationRow:
    fx, fz = score(case, "fx", loads.fx), score(case, "fz", loads.fz)
    return ValidationRow(aero, recommended, fx, fz, float(case.mean(loads.power)), loads)


def _air_loads(
    aero: Sequence[Any] | None,
    unsteady: str | None,
    inflow: str | None,
    induced_factor: float,
    extension: str | None,
) -> list[BladeElement]:
    """Return the rows that were asked for, all faults of what was asked together."""
    faults = FaultList()
    if unsteady is not None:
        faults.choice("unsteady", unsteady, UNSTEADY)
    if inflow is not None:
        faults.choice("inflow", inflow, INFLOWS)
    faults.number("induced_factor", induced_factor, at_least=0, fix="1 is an ideal disc")
    models = []
    for given in LIBRARY if aero is None else aero:
        try:
            models.append(_model(given, extension))
        except InvalidInputError as error:
            faults.faults.extend(error.faults)
    if not models and not faults.faults:
        faults.add("aero", [], "names no coefficient model", f"the models are {', '.join(LIBRARY)}")
    faults.raise_if_any()
    rows = []
    for model in models:
        for term in UNSTEADY if unsteady is None else (unsteady,):
            for flow in INFLOWS if inflow is None else (inflow,):
                # Nobody asked for this row by its name and its inflow.
                if flow != "none" and model.aspect_ratio is None and (aero is None or inflow is None):
                    continue
                try:
                    rows.append(BladeElement(model, unsteady=term, inflow=flow, induced_factor=induced_factor))
                except InvalidInputError as error:
                    faults.faults.extend(fault for fault in error.faults if fault not in faults.faults)
    faults.raise_if_any()
    return rows


def _model(given: Any, extension: str | None) -> CoefficientModel:
    if extension is not None and isinstance(given, str | Path):
        return load_coefficients(given, extension)
    return coefficients_of(given)
