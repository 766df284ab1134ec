"""The rows of a comparison: every coefficient model with every choice of terms."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

from wingbeat._base import Fault, FaultList, InvalidInputError
from wingbeat.aero import (
    INFLOWS,
    LIBRARY,
    UNSTEADY,
    BladeElement,
    CoefficientModel,
    FamilyCoefficients,
    coefficients_of,
)
from wingbeat.aero.blade_element import load_coefficients

THIN_AEROFOIL_WAKE = "thin-aerofoil-wake"
UNSTEADY_STEPS = (*UNSTEADY, THIN_AEROFOIL_WAKE)


class Rung(NamedTuple):
    """One coefficient model with a choice of terms."""

    aero: BladeElement

    @property
    def unsteady(self) -> str:
        """Name of the unsteady terms, one of `UNSTEADY_STEPS`."""
        return self.aero.unsteady if self.aero.wake == "none" else THIN_AEROFOIL_WAKE


def ladder(
    aero: Sequence[Any] | None,
    unsteady: str | None,
    inflow: str | None,
    induced_factor: float,
    extension: str | None,
) -> list[Rung]:
    """Return the rows of a comparison.

    Parameters
    ----------
    aero : coefficient models, their names or files; all of the library if not given.
    unsteady : one of `UNSTEADY_STEPS`; all if not given.
    inflow : one of `INFLOWS`; all if not given.
    induced_factor : induced power of the inflow over that of an ideal disc.
    extension : how models of the library and of files are extended to all angles; each model's own if not given.

    Raises
    ------
    InvalidInputError : all faults of these arguments together.
    FileError : the file of a model is missing or cannot be read.
    """
    faults = FaultList()
    if unsteady is not None:
        faults.choice("unsteady", unsteady, UNSTEADY_STEPS)
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
    rungs = []
    for model in models:
        for step in UNSTEADY_STEPS if unsteady is None else (unsteady,):
            for flow in INFLOWS if inflow is None else (inflow,):
                unasked = (flow != "none" and (aero is None or inflow is None)) or (
                    step == THIN_AEROFOIL_WAKE and (aero is None or unsteady is None)
                )
                # Nobody asked for this row by its name and its term.
                if model.aspect_ratio is None and unasked:
                    continue
                try:
                    rungs.append(_rung(model, step, flow, induced_factor))
                except InvalidInputError as error:
                    faults.faults.extend(fault for fault in error.faults if fault not in faults.faults)
    faults.raise_if_any()
    return rungs


def _rung(model: CoefficientModel, step: str, flow: str, induced_factor: float) -> Rung:
    if step != THIN_AEROFOIL_WAKE:
        return Rung(BladeElement(model, unsteady=step, inflow=flow, induced_factor=induced_factor))
    terms: dict[str, Any] = {"unsteady": "thin-aerofoil", "wake": "jones-section", "inflow": flow}
    return Rung(BladeElement(model, induced_factor=induced_factor, **terms))


def _model(given: Any, extension: str | None) -> CoefficientModel:
    if extension is not None and isinstance(given, str | Path):
        model = load_coefficients(given, extension)
    else:
        model = coefficients_of(given)
    if isinstance(model, FamilyCoefficients):
        rule = "depends on the Reynolds number, and a measured motion states no viscosity"
        raise InvalidInputError([Fault("aero", model.name, rule, "give the polar of one Reynolds number")])
    return model
