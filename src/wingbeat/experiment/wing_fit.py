"""The fit of a whole wing: lift, drag and centre of pressure, its model file, and models drawn from its errors."""

from __future__ import annotations

import contextlib
import dataclasses
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import Fault, FaultList, InvalidInputError, __version__, quoted, write_atomically
from wingbeat.aero import CamberedCoefficients, FormulaCoefficients
from wingbeat.aero.coefficient_model import check_aspect_ratio
from wingbeat.aero.model_file import KIND, Fitted, FittedCurve, FittedModel, FittedWing, read_model
from wingbeat.aero.polar_sheet import zero_lift
from wingbeat.experiment.coefficient_table import CoefficientTable
from wingbeat.experiment.curve_forms import FORMS, BoxForm, CurveForm, DragForm, LiftForm, WingForm
from wingbeat.experiment.judgement import failures, judge, model_failures
from wingbeat.experiment.regression import CurveFit, DragFit, fit_curve, fit_drag, stall_notes

# A spline through steps of one degree stays within 1e-4 of a smooth polar.
_STEP_DEG = 1.0
# A cambered wing acts like a plate from 45 degrees on, as `Feathered`, or from 20 degrees beyond the measurements,
# whichever angle is larger.
_PLATE_FROM_DEG, _JOIN_DEG = 45.0, 20.0
# Data to this angle leave nothing of a side to the form [deg].
_WHOLE_SIDE_DEG = 85.0


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
    notes : all that a reader should know: what the data do not determine, and the warnings.
    aspect_ratio : of the measured wing [-], infinite for a section, None if not stated.
    warnings : those of the notes that say that the curve may be wrong where it was measured, from the residuals
        (`wingbeat.experiment.judgement`), or beyond, because the data do not determine a mirrored form.
    failures : why the fit is useless, and cannot be saved; empty if it is not.
    """

    name: str
    form: str
    citation: str
    lift: CurveFit
    drag: CurveFit
    centre: CurveFit | None
    table: CoefficientTable
    notes: tuple[str, ...]
    aspect_ratio: float | None = None
    warnings: tuple[str, ...] = ()
    failures: tuple[str, ...] = ()

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
        return None if known is None else (float(np.nanmin(known)), float(np.nanmax(known)))

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
            fix = "fit a table with the column x_cp, by a form that uses it"
            raise InvalidInputError([Fault("x_cp", self.name, "this model has no centre of pressure", fix)])
        a = np.deg2rad(alpha_deg)
        normal = self.lift.predict(alpha_deg) * np.cos(a) + self.drag.predict(alpha_deg) * np.sin(a)
        return normal * (0.5 - self.centre.predict(alpha_deg))

    def model(self) -> Fitted:
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
        drag = _fitted(self.drag)
        if isinstance(self.drag, DragFit):
            low, high = self.alpha_range_deg
            joins = (min(-_PLATE_FROM_DEG, low - _JOIN_DEG), low), (high, max(_PLATE_FROM_DEG, high + _JOIN_DEG))
            wing = self.reynolds_range, FittedCurve(drag.terms, self.drag.joint_names, self.drag.joint)
            return FittedWing(self.name, self.citation, *joins, *wing, self.aspect_ratio, self.notes)
        centre = None if self.centre is None else _fitted(self.centre)
        ranges = self.alpha_range_deg, self.reynolds_range
        curves = _fitted(self.lift), drag, centre
        return FittedModel(self.name, self.citation, *ranges, *curves, self.aspect_ratio, self.notes)

    def coefficients(
        self, extension: str = "mirrored", blend_width_deg: float = 1.0
    ) -> FormulaCoefficients | CamberedCoefficients:
        """Return the coefficient model, for flights and orbits.

        Parameters
        ----------
        extension : how the formulas are extended to every angle, one of `EXTENSIONS`.
        blend_width_deg : half width of the blends where pieces meet [deg], in (0, 3].

        Raises
        ------
        InvalidInputError : as in `model`, and inputs that the coefficient model refuses.
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
        InvalidInputError : a fit that failed, another ending, a form of the user's own as .toml, or a table that
            does not cover 0 to 90 degrees or whose drag is negative.
        """
        ending = Path(path).suffix.lower()
        faults = FaultList()
        faults.choice("path", ending, (".toml", ".csv"))
        for failure in self.failures:
            faults.add(self.name, self.form, f"the fit failed: {failure}")
        faults.raise_if_any()
        text = model_text(self.model(), self.form, self.curves) if ending == ".toml" else self._as_table()
        write_atomically(path, text)

    def _as_table(self) -> str:
        low, high = self.alpha_range_deg
        if low > 0 or high < 90:
            rule = "does not cover 0 to 90 degrees, which a table model needs"
            fix = "measure farther, or fit a built-in form and save it as a model file (.toml)"
            raise InvalidInputError([Fault("alpha range", f"{low:g} to {high:g}", rule, fix)])
        alpha = np.arange(0.0, math.floor(high / _STEP_DEG) + 0.5) * _STEP_DEG
        columns = [alpha, *(curve.predict(alpha) for curve in self.curves.values())]
        if (least := float(columns[2].min())) < 0:
            raise InvalidInputError([Fault("C_D", least, "the fitted drag is negative", "choose another form")])
        head = ["# " + self.citation, "alpha_deg,c_l,c_d" + ",x_cp" * (self.centre is not None)]
        rows = [",".join(f"{value:.10g}" for value in row) for row in zip(*columns, strict=True)]
        return "\n".join([*head, *rows]) + "\n"


def fit_wing(
    table: CoefficientTable,
    form: str | WingForm = "su-fan",
    name: str = "fitted",
    citation: str = "",
    aspect_ratio: float | None = None,
) -> WingFit:
    """Fit lift, drag and, where it was measured, the centre of pressure.

    Rows are weighted by their standard errors if the table has them. The centre of pressure is fitted only to rows
    that have one, at angles that are not negative.

    Su-Fan's form is that of Su, Fan, Onoue, Vejdani and Breuer 2023, doi 10.48550/arXiv.2302.09602; Dickinson's
    form is that of Dickinson, Lehmann and Sane 1999, doi 10.1126/science.284.5422.1954.

    Parameters
    ----------
    form : "su-fan", "dickinson", "sine-cosine", "cambered" (`CamberedTerms`, for a wing whose two sides differ), or
        curves of your own.
    name, citation : name of the model, and source of the measurements.
    table : the measurements.
    aspect_ratio : span over mean chord of the measured wing [-], infinite for a section, None if not known.

    Raises
    ------
    InvalidInputError : an unknown form, an empty name, a bad aspect ratio, inputs that `fit_curve` refuses; for a
        cambered wing, angles beyond 60 degrees or fewer than three on one side of zero lift.
    """
    faults = FaultList()
    check_aspect_ratio(faults, "aspect_ratio", aspect_ratio)
    if isinstance(form, str):
        faults.choice("form", form, tuple(FORMS))
    if not name.strip():
        faults.add("name", name, "must not be empty", "name the model")
    faults.raise_if_any()
    chosen = FORMS[form] if isinstance(form, str) else form
    notes: list[str] = []
    measured, copies = table, 1
    one_side = isinstance(chosen.lift, LiftForm) and table.alpha_deg.min() >= 0
    if one_side and zero_lift(table.alpha_deg, table.mean["C_L"]) is not None:
        table, copies = table.with_mirror_image(), 2
        notes += ["one side was measured, and its lift at 0 degrees is 0: the other is taken as its mirror image"]
    lift = _fit(table, "C_L", chosen.lift)
    # A mirror image adds no information, so the variance stays that of the rows that were measured.
    lift = dataclasses.replace(lift, covariance=copies * lift.covariance)
    if isinstance(chosen.drag, DragForm):
        drag = fit_drag(chosen.drag, lift, table.mean["C_D"], _sigma(table, "C_D"), copies)
        notes += stall_notes(lift)
    else:
        drag = _fit(table, "C_D", chosen.drag)
    centre = None
    if chosen.centre is None and "x_cp" in table.mean:
        notes.append(f"x_cp: the form {chosen.name} has no centre of pressure, so this column is not used")
    if chosen.centre is not None and "x_cp" in table.mean:
        known = np.isfinite(table.mean["x_cp"])
        usable = known & (table.alpha_deg >= 0) if chosen.centre.only_positive else known
        if usable.sum() < len(chosen.centre.names) + 2:
            notes.append(
                f"x_cp: only {usable.sum()} usable rows, too few for a fit; the model has no centre of pressure"
            )
        else:
            centre = _fit(table, "x_cp", chosen.centre, usable)
            if usable.sum() < known.sum():
                notes.append(f"x_cp: {known.sum() - usable.sum()} rows at negative angles were left out")
    fitted = [curve for curve in (lift, drag, centre) if curve is not None]
    doubts = [note for curve in fitted for note in curve.notes]
    # Beyond the data a cambered wing becomes a plate, whatever its terms. A mirrored form goes on to 90 degrees as
    # it is, so its uncertain terms change the answer if the data end before.
    goes_on = not isinstance(chosen.lift, LiftForm) and np.abs(table.alpha_deg).max() < _WHOLE_SIDE_DEG
    warnings = list(doubts) if goes_on else []
    own = slice(len(measured.alpha_deg))
    for curve in (lift, drag):
        rows = {name: getattr(curve, name)[own] for name in ("alpha_deg", "values", "sigma")}
        warnings += judge(dataclasses.replace(curve, **rows), measured.reynolds)
    notes += [note for note in doubts if note not in warnings] + warnings
    failed = [text for curve in fitted for text in failures(curve)]
    curves = lift, drag, centre
    found = WingFit(name, chosen.name, citation, *curves, table, tuple(notes), aspect_ratio, tuple(warnings))
    if not failed and all(isinstance(curve.form, BoxForm) for curve in found.curves.values()):
        failed += model_failures(found.coefficients(), found.alpha_range_deg)
    return dataclasses.replace(found, failures=tuple(failed))


Rows = NDArray[np.bool_] | slice


def _fit(table: CoefficientTable, label: str, form: CurveForm, rows: Rows = slice(None)) -> CurveFit:
    return fit_curve(table.alpha_deg[rows], table.mean[label][rows], form, _sigma(table, label, rows), label)


def _sigma(table: CoefficientTable, label: str, rows: Rows = slice(None)) -> NDArray[np.float64] | None:
    """Return the standard errors of a coefficient, or None where there are none."""
    errors = table.se.get(label)
    # Errors that are all 0 belong to computed data without noise.
    return errors[rows] if errors is not None and bool((errors[rows] != 0).any()) else None


def _fitted(curve: CurveFit) -> FittedCurve:
    assert isinstance(curve.form, BoxForm)  # refused before
    terms = curve.form.kind(**curve.form.fixed | curve.parameters)
    return FittedCurve(terms, curve.form.names, curve.covariance)


_HEAD = """\
# Coefficients of a wing strip, fitted by `wingbeat fit`. Give this file in place of a model's name:
# wingbeat polar THIS.toml, wingbeat orbit pigeon --speed 12 --aero THIS.toml. Angles of attack a are in degrees."""
_CAMBERED = """\
# The formulas hold between the joins, where the wing was measured; beyond the joins the wing is a plate (su-fan).
# ramp(x) is max(x, 0) with its corner rounded. The onsets of drag are counted from zero_lift_deg. The slope and the
# rises are per radian."""


def model_text(model: Fitted, form: str, curves: dict[str, CurveFit]) -> str:
    """Return the content of the model file of a fit with its curves by coefficient."""
    texts = {"kind": KIND, "name": model.name, "citation": model.citation, "form": form}
    texts["made_by"] = f"wingbeat {__version__}"
    if isinstance(model, FittedWing):
        ranges = {"low_join_deg": model.low_join_deg, "high_join_deg": model.high_join_deg}
        sections = [("wing", model.wing, curves)]
    else:
        ranges = {"alpha_range_deg": model.alpha_range_deg}
        pairs = zip(model.curves.items(), curves.items(), strict=True)
        sections = [(key.removesuffix("_terms"), part, dict([curve])) for (key, part), curve in pairs]
    lines = [_HEAD, *([_CAMBERED] if isinstance(model, FittedWing) else [])]
    lines += [f"{key} = {quoted(text)}" for key, text in texts.items()]
    lines += [f"{key} = {_row(ends)}" for key, ends in ranges.items()]
    if model.reynolds_range is not None:
        lines.append(f"reynolds_range = {_row(model.reynolds_range)}")
    if model.aspect_ratio is not None:
        lines.append(f"aspect_ratio = {float(model.aspect_ratio)!r}")
    if model.notes:
        lines += ["notes = [", *(f"  {quoted(note)}," for note in model.notes), "]"]
    for key, part, own in sections:
        limits = {name: ends for curve in own.values() for name, ends in curve.interval().items()}
        formulas = "\n# ".join(f"{label} = {curve.form.formula}" for label, curve in own.items())
        lines += ["", f"[{key}] # {formulas}"]
        for name, value in vars(part.terms).items():
            if value is not None:
                low, high = limits.get(name, (value, value))
                about = f" # 95 % interval {low:.5g} to {high:.5g}" if name in limits else " # held fixed"
                lines.append(f"{name} = {float(value)!r}{about}")
        free = ", ".join(quoted(name) for name in part.free)
        lines += ["", f"[{key}.fit]", f"free = [{free}]", "covariance = ["]
        lines += [f"  {_row(row)}," for row in part.covariance]
        lines += ["]", f"points = {len(next(iter(own.values())).values)}"]
        for name in ("r_squared", "aicc"):
            values = [getattr(curve, name) for curve in own.values()]
            if all(math.isfinite(value) for value in values):
                lines.append(f"{name} = {_row(values) if len(values) > 1 else repr(float(values[0]))}")
    return "\n".join(lines) + "\n"


def _row(values: object) -> str:
    return "[" + ", ".join(repr(float(value)) for value in np.asarray(values)) + "]"


MAX_COUNT = 100_000
_TRIES = 100


def draw(
    source: str | Path | WingFit,
    count: int,
    seed: int = 0,
    *,
    extension: str = "mirrored",
    blend_width_deg: float = 1.0,
) -> list[FormulaCoefficients] | list[CamberedCoefficients]:
    """Return coefficient models whose terms are random draws from the normal distribution of a fit's parameters.

    The parameters of one curve (lift, drag or centre of pressure) are drawn together, with their covariance.
    Different curves are drawn independently, except that all terms of a cambered wing are drawn together. A sample
    that is not a valid formula (a decay that grows) is drawn again. The same seed gives the same models.

    Parameters
    ----------
    source : the path of a model file, or a fit.
    count : how many models.
    seed : of the random numbers.
    extension, blend_width_deg : as in `FormulaCoefficients`.

    Raises
    ------
    FileError : the file is missing or cannot be read.
    InvalidInputError : a count or seed that is not a whole number, inputs that `read_model` refuses, a file without
        covariance, or a covariance so wide that few samples give a valid formula.
    """
    faults = FaultList()
    for name, value, lowest, highest in (("count", count, 1, MAX_COUNT), ("seed", seed, 0, 2**63)):
        faults.whole(name, value, lowest, highest)
    faults.raise_if_any()
    model = source.model() if isinstance(source, WingFit) else read_model(source)
    if not any(curve.free for curve in model.curves.values()):
        faults.add(model.name, "no covariance", "has nothing to draw from", "fit it with `wingbeat fit`")
    faults.raise_if_any()
    random = np.random.default_rng(seed)
    drawn = {name: _terms(name, curve, count, random) for name, curve in model.curves.items()}
    return [
        model.coefficients(extension, blend_width_deg, **{name: terms[i] for name, terms in drawn.items()})
        for i in range(count)
    ]


def _terms(label: str, curve: FittedCurve, count: int, random: np.random.Generator) -> list[Any]:
    """Return `count` random draws of the formula of one coefficient."""
    if not curve.free:
        return [curve.terms] * count
    mean = np.array([getattr(curve.terms, name) for name in curve.free])
    # A matrix L with L L^T equal to the covariance; negative eigenvalues from rounding count as 0.
    spread = np.sqrt(np.diag(curve.covariance))
    scale = np.where(spread > 0, spread, 1.0)
    values, vectors = np.linalg.eigh(curve.covariance / np.outer(scale, scale))
    factor = scale[:, None] * vectors * np.sqrt(np.maximum(values, 0.0))
    found: list[Any] = []
    for _ in range(_TRIES):
        for values in mean + random.normal(size=(count, len(mean))) @ factor.T:
            drawn = dict(zip(curve.free, values.tolist(), strict=True))
            with contextlib.suppress(InvalidInputError):
                found.append(dataclasses.replace(curve.terms, **drawn))
        if len(found) >= count:
            return found[:count]
    rule = "few random draws from it give a valid formula: the data do not determine this form"
    fix = "choose a form with fewer parameters"
    raise InvalidInputError([Fault(f"{label}, covariance", "too wide", rule, fix)])
