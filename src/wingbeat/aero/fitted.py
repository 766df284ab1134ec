"""Coefficients that were fitted to measurements: their terms and the covariance of the terms."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import FaultList
from wingbeat.aero.cambered import CamberedCoefficients, CamberedTerms
from wingbeat.aero.extension import check_extension
from wingbeat.aero.formula import CentreTerms, FormulaCoefficients, FormulaTerms


class FittedCurve(NamedTuple):
    """Terms of one coefficient, or all terms of a cambered wing, with the uncertainty of the fit.

    The covariance, shape (k, k), is that of the k fitted terms that `free` names.
    """

    terms: FormulaTerms | CentreTerms | CamberedTerms
    free: tuple[str, ...]
    covariance: NDArray[np.float64]


class FittedModel(NamedTuple):
    """A fit of formulas to one side of a wing; `centre` is None if no centre of pressure was measured.

    `notes` are the warnings of the fit.
    """

    name: str
    citation: str
    alpha_range_deg: tuple[float, float]
    reynolds_range: tuple[float, float] | None
    lift: FittedCurve
    drag: FittedCurve
    centre: FittedCurve | None
    aspect_ratio: float | None = None
    notes: tuple[str, ...] = ()

    @property
    def curves(self) -> dict[str, FittedCurve]:
        """The fitted curves, by the names that their terms have in the coefficient model."""
        curves = {"lift_terms": self.lift, "drag_terms": self.drag}
        return curves if self.centre is None else curves | {"centre_terms": self.centre}

    def coefficients(
        self, extension: str = "mirrored", blend_width_deg: float = 1.0, **terms: Any
    ) -> FormulaCoefficients:
        """Return the coefficient model; formulas that are given (lift_terms, ...) replace those of the file.

        Raises
        ------
        InvalidInputError : inputs that `FormulaCoefficients` refuses.
        """
        own: dict[str, Any] = {name: curve.terms for name, curve in self.curves.items()}
        return FormulaCoefficients(
            self.name,
            **(own | terms),
            citation=self.citation,
            reynolds_range=self.reynolds_range,
            aspect_ratio=self.aspect_ratio,
            alpha_range_deg=self.alpha_range_deg,
            extension=extension,
            blend_width_deg=blend_width_deg,
        )


class FittedWing(NamedTuple):
    """A fit of a cambered wing; `wing` holds all its terms and the joint covariance of lift and drag.

    `notes` are the warnings of the fit.
    """

    name: str
    citation: str
    low_join_deg: tuple[float, float]
    high_join_deg: tuple[float, float]
    reynolds_range: tuple[float, float] | None
    wing: FittedCurve
    aspect_ratio: float | None = None
    notes: tuple[str, ...] = ()

    @property
    def curves(self) -> dict[str, FittedCurve]:
        """The fitted terms, by the name that they have in the coefficient model."""
        return {"terms": self.wing}

    def coefficients(
        self, extension: str = "mirrored", blend_width_deg: float = 1.0, **terms: Any
    ) -> CamberedCoefficients:
        """Return the coefficient model; terms that are given (terms=...) replace those of the file.

        The model covers all angles, so the extension has no effect.

        Raises
        ------
        InvalidInputError : an unknown extension; inputs that `CamberedCoefficients` refuses.
        """
        faults = FaultList()
        check_extension(faults, extension, blend_width_deg)
        faults.raise_if_any()
        own: dict[str, Any] = {"terms": self.wing.terms}
        return CamberedCoefficients(
            self.name,
            **(own | terms),
            low_join_deg=self.low_join_deg,
            high_join_deg=self.high_join_deg,
            citation=self.citation,
            reynolds_range=self.reynolds_range,
            blend_width_deg=blend_width_deg,
            aspect_ratio=self.aspect_ratio,
        )


Fitted = FittedModel | FittedWing
