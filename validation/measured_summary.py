"""What a polar comes to: slope, zero lift, largest lift, least drag, best lift over drag, centre of its lift."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from measured_data import Array, Polar

from wingbeat._base import InvalidInputError
from wingbeat.aero import FormulaCoefficients
from wingbeat.experiment import FORMS, CoefficientTable, CurveFit, CurveForm, fit_curve, fit_wing

# A line is put through the lift between none and this share of the largest: below stall for every wing here.
LINEAR_SHARE = 0.6
# Where an animal that cruises is: around half to two thirds of the lift that its wings can give.
CRUISE = (0.5, 0.8)
LINE = CurveForm("slope x + offset", lambda x, slope, offset: slope * x + offset, {"slope": 1.0, "offset": 0.0})
PARABOLA = CurveForm(
    "least + rise (C_L - at)^2",
    lambda x, least, rise, at: least + rise * (x - at) ** 2,
    {"least": 0.05, "rise": 0.1, "at": 0.2},
)


@dataclass(frozen=True)
class Row:
    """One line of the table; None where the quantity was not measured."""

    polar: Polar
    slope: CurveFit | None
    zero_lift_deg: float | None
    lift_max: float
    lift_max_deg: float | None
    least_drag: float
    best_ratio: float
    cruise_ratio: float
    centre: CurveFit | None


def summary(polar: Polar) -> Row:
    """Return what the table says of one polar."""
    return _without_angle(polar) if polar.alpha_deg is None else _with_angle(polar, polar.alpha_deg)


def _with_angle(polar: Polar, alpha_deg: Array) -> Row:
    alpha, place = np.unique(alpha_deg, return_inverse=True)
    lift, drag = (np.bincount(place, column) / np.bincount(place) for column in (polar.lift, polar.drag))
    top = int(np.argmax(lift))
    below = (polar.lift >= 0) & (polar.lift <= LINEAR_SHARE * lift[top]) & (alpha_deg < alpha[top])
    slope = fit_curve(np.radians(alpha_deg[below]), polar.lift[below], LINE, label=polar.label)
    rising = slice(0, top + 1)
    crossing = np.flatnonzero((lift[rising][:-1] < 0) & (lift[rising][1:] >= 0))
    first = int(crossing[-1]) if len(crossing) else 0
    zero = float(np.interp(0.0, lift[first : first + 2], alpha[first : first + 2]))
    ratio = lift / drag
    cruising = (lift >= CRUISE[0]) & (lift <= CRUISE[1]) & (alpha < alpha[top])
    centre = None
    if polar.moment is not None:
        attached = (polar.lift >= 0) & (polar.lift <= 0.9 * lift[top]) & (alpha_deg < alpha[top])
        radians = np.radians(alpha_deg)
        normal = polar.lift * np.cos(radians) + polar.drag * np.sin(radians)
        centre = fit_curve(normal[attached], polar.moment[attached], LINE, label=polar.label)
    return Row(
        polar,
        slope,
        zero,
        float(lift[top]),
        float(alpha[top]),
        float(drag.min()),
        float(ratio.max()),
        float(np.median(ratio[cruising])),
        centre,
    )


def _without_angle(polar: Polar) -> Row:
    """Return the row of scattered forces: a parabola's, for the best of hundreds of ratios is the luckiest."""
    parabola = fit_curve(polar.lift, polar.drag, PARABOLA, label=polar.label)
    lift = np.linspace(max(float(polar.lift.min()), 0.05), float(polar.lift.max()), 500)
    drag = parabola.predict(lift)
    cruising = (lift >= CRUISE[0]) & (lift <= CRUISE[1])
    typical = float(np.median((lift / drag)[cruising]))
    best = float((lift / drag).max())
    return Row(polar, None, None, float(polar.lift.max()), None, float(drag.min()), best, typical, None)


def of_model(model: FormulaCoefficients, label: str) -> Polar:
    """Return a coefficient model as if it had been measured, every degree from 0 to 60.

    Its moment is about the leading edge, those of the gulls about the shoulder: only slopes compare.
    """
    alpha = np.arange(0.0, 61.0)
    radians = np.radians(alpha)
    reynolds = model.reynolds_range or (np.nan, np.nan)
    moment = model.moment(radians, about=0.0) if model.has_centre_of_pressure else None
    return Polar(label, "model", model.lift(radians), model.drag(radians), reynolds, alpha, moment)


@dataclass(frozen=True)
class Verdict:
    """How one form follows one coefficient of one wing; `identified` is whether the data determine it."""

    wing: str
    form: str
    curve: str
    r_squared: float
    aicc: float
    identified: bool


def judge(polar: Polar) -> list[Verdict]:
    """Return what each form of the package makes of a polar; nothing where no angle was measured."""
    found: list[Verdict] = []
    if polar.alpha_deg is None:
        return found
    for name, form in FORMS.items():
        # An exponential of the angle holds from 0 up only.
        keep = polar.alpha_deg >= 0 if form.lift.only_positive else np.ones(len(polar.lift), dtype=bool)
        mean = {"C_L": polar.lift[keep], "C_D": polar.drag[keep]}
        try:
            curves = fit_wing(CoefficientTable(polar.alpha_deg[keep], mean), name).curves
        except InvalidInputError:  # too few points for so many parameters
            found += [Verdict(polar.label, name, label, np.nan, np.nan, False) for label in mean]
            continue
        found += [
            Verdict(polar.label, name, label, curve.r_squared, curve.aicc, not curve.notes)
            for label, curve in curves.items()
        ]
    return found
