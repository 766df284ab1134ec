"""A whole wing fitted: lift, drag and centre of pressure, and the model file that holds them."""

from __future__ import annotations

import json
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from wingbeat._version import __version__
from wingbeat.aero import FormulaCoefficients
from wingbeat.aero.formula import CentreTerms, FormulaTerms
from wingbeat.aero.model_file import KIND, FittedCurve, FittedModel
from wingbeat.errors import FaultList, InvalidInputError
from wingbeat.experiment.forms import FORMS, BoxForm, CurveForm, WingForm
from wingbeat.experiment.regression import CurveFit, fit_curve
from wingbeat.experiment.table import CoefficientTable
from wingbeat.files import write_atomically

# A spline through steps of one degree stays within 1e-4 of a smooth polar.
_STEP_DEG = 1.0


@dataclass(frozen=True)
class WingFit:
    """Curves fitted to the measurements of one wing; made by `fit_wing`.

    Attributes
    ----------
    name : of the model.
    form : name of the form.
    citation : source of the measurements.
    lift, drag : fits of C_L and C_D.
    centre : fit of the centre of pressure; None if it was not measured, or if the form has no curve for it.
    table : the measurements.
    notes : notes for the reader.
    """

    name: str
    form: str
    citation: str
    lift: CurveFit
    drag: CurveFit
    centre: CurveFit | None
    table: CoefficientTable
    notes: tuple[str, ...]

    @property
    def curves(self) -> dict[str, CurveFit]:
        """The fitted curves by coefficient."""
        curves = {"C_L": self.lift, "C_D": self.drag}
        return curves if self.centre is None else curves | {"x_cp": self.centre}

    @property
    def alpha_range_deg(self) -> tuple[float, float]:
        """Lowest and highest angle of the data [deg]."""
        return float(self.table.alpha_deg.min()), float(self.table.alpha_deg.max())

    @property
    def reynolds_range(self) -> tuple[float, float] | None:
        """Lowest and highest Reynolds number of the data, or None if it is not known."""
        known = self.table.reynolds
        return None if known is None else (float(known.min()), float(known.max()))

    def moment(self, alpha_deg: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return ``C_M = (C_L cos a + C_D sin a)(1/2 - x_cp)`` about mid-chord, shape (n,).

        Parameters
        ----------
        alpha_deg : angles of attack [deg], shape (n,).

        Raises
        ------
        InvalidInputError : no centre of pressure was fitted.
        """
        if self.centre is None:
            faults = FaultList()
            faults.add("x_cp", self.name, "was not fitted", "give a table with the column x_cp")
            raise InvalidInputError(faults.faults)
        a = np.deg2rad(alpha_deg)
        normal = self.lift.predict(alpha_deg) * np.cos(a) + self.drag.predict(alpha_deg) * np.sin(a)
        return normal * (0.5 - self.centre.predict(alpha_deg))

    def model(self) -> FittedModel:
        """Return the fit in the form of a model file's content.

        Raises
        ------
        InvalidInputError : a form of the user's own, which a model file cannot hold.
        """
        faults = FaultList()
        for label, curve in self.curves.items():
            if not isinstance(curve.form, BoxForm):
                fix = "save it as a table: give a path that ends in .csv"
                faults.add(label, curve.form.formula, "is a form of your own, which a model file cannot hold", fix)
        faults.raise_if_any()
        centre = None if self.centre is None else _fitted(self.centre, CentreTerms)
        ranges = self.alpha_range_deg, self.reynolds_range
        lift, drag = (_fitted(curve, FormulaTerms) for curve in (self.lift, self.drag))
        return FittedModel(self.name, self.citation, *ranges, lift, drag, centre)

    def coefficients(self, extension: str = "mirrored", blend_width_deg: float = 1.0) -> FormulaCoefficients:
        """Return the coefficient model, for flights and orbits.

        Parameters
        ----------
        extension : how the formulas reach every angle, one of `EXTENSIONS`.
        blend_width_deg : half width of the blends where pieces meet [deg], in (0, 3].

        Raises
        ------
        InvalidInputError : as in `model`, and what `FormulaCoefficients` refuses.
        """
        return self.model().coefficients(extension, blend_width_deg)

    def save(self, path: str | Path) -> None:
        """Write a model file (.toml), or the curves as a table (.csv) for any form; both load as coefficients.

        Parameters
        ----------
        path : of the file to write.

        Raises
        ------
        FileError : the file cannot be written.
        InvalidInputError : another ending, a form of the user's own as .toml, or a table that does not cover
            0 to 90 degrees or whose drag is negative.
        """
        ending = Path(path).suffix.lower()
        faults = FaultList()
        faults.choice("path", ending, (".toml", ".csv"))
        faults.raise_if_any()
        write_atomically(path, self._as_toml() if ending == ".toml" else self._as_table())

    def _as_toml(self) -> str:
        model = self.model()
        lines = [
            "# Coefficients of a wing strip, fitted by `wingbeat fit`. Name this file where a model is asked for:",
            "# wingbeat polar THIS.toml, wingbeat orbit pigeon --speed 12 --aero THIS.toml. Angles a in degrees.",
            f"kind = {_quoted(KIND)}",
            f"name = {_quoted(self.name)}",
            f"citation = {_quoted(self.citation)}",
            f"form = {_quoted(self.form)}",
            f"made_by = {_quoted(f'wingbeat {__version__}')}",
            f"alpha_range_deg = {_row(self.alpha_range_deg)}",
        ]
        if self.reynolds_range is not None:
            lines.append(f"reynolds_range = {_row(self.reynolds_range)}")
        parts = {"lift": model.lift, "drag": model.drag, "centre": model.centre}
        for (key, part), (label, curve) in zip(parts.items(), self.curves.items(), strict=False):
            if part is not None:
                lines += ["", *_as_section(key, label, curve, part)]
        return "\n".join(lines) + "\n"

    def _as_table(self) -> str:
        low, high = self.alpha_range_deg
        faults = FaultList()
        if low > 0 or high < 90:
            rule = "does not cover 0 to 90 degrees, which a table model needs"
            faults.add("alpha range", f"{low:g} to {high:g}", rule, "measure farther, or choose a built-in form")
        faults.raise_if_any()
        alpha = np.arange(0.0, math.floor(high / _STEP_DEG) + 0.5) * _STEP_DEG
        columns = [alpha, *(curve.predict(alpha) for curve in self.curves.values())]
        if (columns[2] < 0).any():
            faults.add("C_D", float(columns[2].min()), "the fitted drag is negative", "choose another form")
        faults.raise_if_any()
        head = ["# " + self.citation, "alpha_deg,c_l,c_d" + ",x_cp" * (self.centre is not None)]
        rows = [",".join(f"{value:.10g}" for value in row) for row in zip(*columns, strict=True)]
        return "\n".join([*head, *rows]) + "\n"


def fit_wing(
    table: CoefficientTable, form: str | WingForm = "su-fan", name: str = "fitted", citation: str = ""
) -> WingFit:
    """Fit lift, drag and, where it was measured, the centre of pressure.

    Rows are weighted by their standard errors if the table has them. The centre of pressure is fitted to rows that
    have one and whose angle is not negative.

    Su-Fan's form is that of Su, Fan, Onoue, Vejdani and Breuer 2023, doi 10.48550/arXiv.2302.09602; Dickinson's
    that of Dickinson, Lehmann and Sane 1999, doi 10.1126/science.284.5422.1954.

    Parameters
    ----------
    form : "su-fan", "dickinson", "sine-cosine", or curves of your own.
    name, citation : name of the model, and source of the measurements.
    table : the measurements.

    Raises
    ------
    InvalidInputError : an unknown form, an empty name, and what `fit_curve` refuses.
    """
    faults = FaultList()
    if isinstance(form, str):
        faults.choice("form", form, tuple(FORMS))
    if not name.strip():
        faults.add("name", name, "must not be empty", "name the model")
    faults.raise_if_any()
    chosen = FORMS[form] if isinstance(form, str) else form
    notes: list[str] = []
    lift, drag = (_fit(table, label, curve) for label, curve in (("C_L", chosen.lift), ("C_D", chosen.drag)))
    centre = None
    if chosen.centre is not None and "x_cp" in table.mean:
        known = np.isfinite(table.mean["x_cp"])
        usable = known & (table.alpha_deg >= 0) if chosen.centre.only_positive else known
        if usable.sum() < len(chosen.centre.names) + 2:
            notes.append(
                f"x_cp: {usable.sum()} usable rows are too few for its form; the model has no centre of pressure"
            )
        else:
            centre = _fit(table, "x_cp", chosen.centre, usable)
            if usable.sum() < known.sum():
                notes.append(f"x_cp: {known.sum() - usable.sum()} rows at negative angles were left out")
    for curve in (lift, drag, centre):
        notes += curve.notes if curve is not None else ()
    return WingFit(name, chosen.name, citation, lift, drag, centre, table, tuple(notes))


def _fit(
    table: CoefficientTable, label: str, form: CurveForm, rows: NDArray[np.bool_] | slice = slice(None)
) -> CurveFit:
    errors = table.se.get(label)
    # Errors of 0 throughout are those of data without noise, made and not measured.
    given = errors is not None and bool((errors[rows] != 0).any())
    sigma = errors[rows] if errors is not None and given else None
    return fit_curve(table.alpha_deg[rows], table.mean[label][rows], form, sigma, label)


def _fitted(curve: CurveFit, kind: type[FormulaTerms] | type[CentreTerms]) -> FittedCurve:
    assert isinstance(curve.form, BoxForm)  # refused before
    return FittedCurve(kind(**curve.form.terms(curve.parameters)), curve.form.names, curve.covariance)


def _as_section(key: str, label: str, curve: CurveFit, part: FittedCurve) -> list[str]:
    limits = curve.interval()
    lines = [f"[{key}] # {label} = {curve.form.formula}"]
    for name, value in vars(part.terms).items():
        if value is not None:
            low, high = limits.get(name, (value, value))
            about = f" # 95 % interval {low:.5g} to {high:.5g}" if name in limits else " # held fixed"
            lines.append(f"{name} = {float(value)!r}{about}")
    lines += ["", f"[{key}.fit]", f"free = [{', '.join(_quoted(name) for name in part.free)}]", "covariance = ["]
    lines += [f"  {_row(row)}," for row in part.covariance]
    lines += ["]", f"points = {len(curve.values)}"]
    lines += [
        f"{name} = {value!r}"
        for name, value in (("r_squared", curve.r_squared), ("aicc", curve.aicc))
        if math.isfinite(value)
    ]
    return lines


def _row(values: object) -> str:
    return "[" + ", ".join(repr(float(value)) for value in np.asarray(values)) + "]"


def _quoted(text: str) -> str:
    """Return a TOML string, written as JSON: their escapes agree once unprintable characters are removed."""
    return json.dumps("".join(sign for sign in text if sign.isprintable()), ensure_ascii=False)
