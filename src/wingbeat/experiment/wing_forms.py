"""The forms that a wing is fitted to: a curve for each of lift, drag and centre of pressure.

The two sides of a cambered wing differ: lift is fitted first, then drag, which depends on the lift. The formulas
are those of `wingbeat.aero.CamberedTerms`. The widths of the bends in lift and drag are fixed, because the data of
a single wing do not determine them.
"""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from itertools import product
from typing import NamedTuple

import numpy as np

from wingbeat._base import FaultList
from wingbeat.aero.formula_models import CamberedTerms, CentreTerms
from wingbeat.aero.library import WING_ESTIMATES
from wingbeat.experiment.curve_forms import Array, BoxForm, CurveForm, any_terms, value_and_slopes
from wingbeat.experiment.regression import CurveFit, distrust, fit_curve

# Angles beyond which lift falls off, as that of a plate does; the form has constant lift beyond its stalls.
FARTHEST_DEG = 60.0
# Least number of different angles on each side of zero lift: two for the line, one for its end.
LEAST_ANGLES = 3
# Values to try for each non-linear term, to find where a fit begins.
_NODES = 8
_SLOPES = (2.0, 3.5, 5.0, 6.5)
# Least distance between the two onsets, so that they cannot change places [deg].
_GAP_DEG = 0.1
_BENDS = {name: WING_ESTIMATES["feathered"][name].value for name in ("lift_rounding", "onset_rounding_deg")}
_LIFT = {"zero_lift_deg": -3.0, "lift_slope": 4.0, "lift_lowest": -0.5, "lift_highest": 1.4}
_DRAG = {"drag_least": 0.03, "drag_induced": 0.05, "low_onset_deg": -5.0, "low_rise": 0.5}
_DRAG |= {"high_onset_deg": 15.0, "high_rise": 1.0}


@dataclass(frozen=True)
class LiftForm(BoxForm):
    """The lift of a cambered wing, up to its two stalls; the measurements must show both sides of zero lift."""

    def check(self, faults: FaultList, alpha_deg: Array, values: Array, label: str) -> None:
        """Note a fault if angles are too large, or if one side of the wing is not known."""
        if not len(alpha_deg):
            return
        low, high = float(alpha_deg.min()), float(alpha_deg.max())
        if max(-low, high) > FARTHEST_DEG:
            rule = f"reaches beyond {FARTHEST_DEG:g} degrees, where the form cambered does not hold"
            rows = f"leave out the rows beyond {FARTHEST_DEG:g} degrees, positive or negative"
            fix = f"{rows} (--alpha-min -{FARTHEST_DEG:g} --alpha-max {FARTHEST_DEG:g})"
            faults.add("alpha_deg", f"{low:g} to {high:g}", f"{rule}: there the model is a plate", fix)
        for side, words, where in ((-1, "negative", "below"), (1, "positive", "above")):
            count = len(np.unique(np.round(alpha_deg[side * values > 0], 6)))
            if count >= LEAST_ANGLES:
                continue
            rule = f"is {words} at {count or 'none'} of the angles between {low:g} and {high:g} degrees"
            few = ", too few to fit that side of the wing"
            rule += few if count else ", so the table shows one side of the wing only"
            fix = f"measure {LEAST_ANGLES} angles or more {where} zero lift, or choose a mirrored form (dickinson)"
            faults.add(label, f"{values.min():g} to {values.max():g}", rule, fix)

    def starts(self, alpha_deg: Array, values: Array, weight: Array) -> list[dict[str, float]]:
        """Return the three best nodes of a grid of zero-lift angles and slopes, and the extremes of the data."""
        ends = {"lift_lowest": float(values.min()), "lift_highest": float(values.max())}
        zeros = np.linspace(np.median(alpha_deg[values < 0]), np.median(alpha_deg[values > 0]), _NODES)
        found = [
            {"zero_lift_deg": float(zero), "lift_slope": slope} | ends for zero, slope in product(zeros, _SLOPES)
        ]
        left = [(self.value(alpha_deg, one) - values) * weight for one in found]
        best = np.argsort([float(one @ one) for one in left], kind="stable")
        return [found[i] for i in best[:3]]


def stall_notes(lift: CurveFit) -> tuple[str, ...]:
    """Return notes on the sides whose stall the measurements of lift do not reach."""
    terms, notes = lift.parameters, []
    for angle, end, side in ((lift.alpha_deg.min(), "lift_lowest", -1), (lift.alpha_deg.max(), "lift_highest", 1)):
        line = terms["lift_slope"] * math.radians(float(angle) - terms["zero_lift_deg"])
        if side * (line - terms[end]) < 2 * _BENDS["lift_rounding"]:
            notes.append(
                f"{lift.label}: at {angle:g} degrees, where the measurements end, lift has not levelled off; "
                f"{end} depends on the assumed form, so measure farther on that side"
            )
    return tuple(notes)


@dataclass(frozen=True)
class DragForm(BoxForm):
    """The drag of a cambered wing; its induced part and its onsets depend on lift, which `beside` sets."""

    def beside(self, lift: CurveFit) -> DragForm:
        """Return the form for a fitted lift, whose terms also set the ranges of the two onsets."""
        terms = lift.parameters
        zero = terms["zero_lift_deg"]
        middle = math.degrees(0.5 * (terms["lift_lowest"] + terms["lift_highest"]) / terms["lift_slope"])
        low, high = float(lift.alpha_deg.min()) - zero, float(lift.alpha_deg.max()) - zero
        # Below the middle of the line of lift, flow separates from the lower side; above it, from the upper side.
        middle = float(np.clip(middle, low + 1.0, high - 1.0))
        gap = 0.5 * _GAP_DEG
        onsets = {"low_onset_deg": (low, middle - gap), "high_onset_deg": (middle + gap, high)}
        return dataclasses.replace(
            self,
            lowest=self.lowest | {name: ends[0] for name, ends in onsets.items()},
            highest=self.highest | {name: ends[1] for name, ends in onsets.items()},
            fixed=self.fixed | terms,
            grids={name: np.linspace(*ends, _NODES) for name, ends in onsets.items()},
        )


@dataclass(frozen=True)
class DragFit(CurveFit):
    """A fit of drag that depends on fitted lift; `covariance` includes the uncertainty of the lift.

    `joint` is the covariance of the parameters in `joint_names`: those of lift, then those of drag.
    """

    joint_names: tuple[str, ...]
    joint: Array

    def curve_variance(self, alpha_deg: Array) -> Array:
        """Return the variance of the curve itself, to first order in the parameters of lift and drag."""
        slopes = _slopes(self, alpha_deg, self.joint_names)
        return np.einsum("ij,jk,ik->i", slopes, self.joint, slopes)


def _slopes(fit: CurveFit, alpha_deg: Array, names: tuple[str, ...]) -> Array:
    """Return the derivatives of a fitted drag with respect to terms of lift and drag, shape (n, names)."""
    assert isinstance(fit.form, DragForm)
    terms = any_terms(fit.form.kind, fit.form.fixed | fit.parameters)
    slopes = value_and_slopes(terms, alpha_deg, fit.form.curve)[1]
    return np.column_stack([getattr(slopes, name) for name in names])


def fit_drag(form: DragForm, lift: CurveFit, values: Array, sigma: Array | None, copies: int = 1) -> DragFit:
    """Fit the drag of a cambered wing at its fitted lift, with a covariance that includes the uncertainty of lift.

    If the terms of lift change by ``d``, those of drag follow by ``G d``, ``G = -(J^T W J)^-1 J^T W L``, where J
    and L are the derivatives of drag with respect to its own terms and to those of lift. So if the errors of lift
    and drag are independent, the covariance of all terms is ``[[V_l, V_l G^T], [G V_l, V_d + G V_l G^T]]``: Murphy
    and Topel 1985, J. Bus. Econ. Stat. 3:370. Each measurement is `copies` times among the values: 2 if half of
    them are a mirror image.
    """
    drag = fit_curve(lift.alpha_deg, values, form.beside(lift), sigma, "C_D")
    own, other = tuple(drag.parameters), tuple(lift.parameters)
    weighted = _slopes(drag, drag.alpha_deg, (*own, *other)) / drag.sigma[:, None]
    sizes = np.maximum(np.linalg.norm(weighted, axis=0), 1e-300)
    scaled = weighted / sizes
    follow = -np.linalg.lstsq(scaled[:, : len(own)], scaled[:, len(own) :])[0]
    follow *= sizes[len(own) :] / sizes[: len(own), None]
    cross = follow @ lift.covariance
    marginal = copies * drag.covariance + cross @ follow.T
    joint = np.block([[lift.covariance, cross.T], [cross, marginal]])
    found = DragFit(**vars(drag) | {"covariance": marginal}, joint_names=(*other, *own), joint=joint)
    return dataclasses.replace(found, notes=distrust(found))


_LIFT_HELD = {"lift_rounding": _BENDS["lift_rounding"]} | dict.fromkeys(_DRAG, 0.0) | {"onset_rounding_deg": 1.0}
CAMBERED_LIFT = LiftForm(
    "lowest + ramp(slope (a - zero_lift) - lowest) - ramp(slope (a - zero_lift) - highest)",
    _LIFT,
    lowest={"zero_lift_deg": -40.0, "lift_slope": 0.5, "lift_lowest": -3.0, "lift_highest": 0.02},
    highest={"zero_lift_deg": 40.0, "lift_slope": 12.0, "lift_lowest": -0.02, "lift_highest": 4.0},
    kind=CamberedTerms,
    fixed=_LIFT_HELD,
    curve="lift_at",
)
CAMBERED_DRAG = DragForm(
    "least + induced C_L^2 + low_rise ramp(low_onset - a) + high_rise ramp(a - high_onset)",
    _DRAG,
    lowest={"drag_least": 1e-4, "drag_induced": 0.0, "low_rise": 0.0, "high_rise": 0.0},
    highest={"drag_least": 1.0, "drag_induced": 1.0, "low_rise": 10.0, "high_rise": 10.0},
    kind=CamberedTerms,
    fixed=_BENDS | _LIFT,
    curve="drag_at",
)
# A grid of a term in which formulas are not linear; the others follow from linear least squares at each node.
_RATES = np.concatenate([np.geomspace(0.3, 3.0, 12), [3.6, 4.5]])


def _wave_form(formula: str, free: list[str], fixed: dict[str, float], **grids: Array) -> BoxForm:
    decays = "decay_rate" in free
    return BoxForm(
        formula,
        dict.fromkeys(free, 1.0),
        lowest={"decay_rate": 0.0} if decays else {},
        highest={"decay_rate": 20.0} if decays else {},
        only_positive=decays,
        fixed=fixed,
        grids=grids,
    )


_SINE = ["constant", "amplitude", "rate", "phase_deg"]
_SINE_FORM = _wave_form("constant + amplitude sin(rate a + phase)", _SINE, {}, rate=_RATES)
_CENTRE = BoxForm(
    "constant + power_amplitude a^exponent + decay_amplitude a exp(-decay_rate a)",
    dict.fromkeys(["constant", "power_amplitude", "exponent", "decay_amplitude", "decay_rate"], 1.0),
    lowest={"exponent": 1e-3, "decay_rate": 0.0},
    highest={"exponent": 5.0, "decay_rate": 5.0},
    only_positive=True,
    kind=CentreTerms,
    grids={"exponent": np.linspace(0.2, 2.0, 10), "decay_rate": np.geomspace(0.02, 0.6, 10)},
)


class WingForm(NamedTuple):
    """The curves that are fitted to a wing.

    Attributes
    ----------
    name : of the form.
    lift, drag : curves of C_L and C_D.
    centre : curve of the centre of pressure, or None.
    """

    name: str
    lift: CurveForm
    drag: CurveForm
    centre: CurveForm | None = None


FORMS: dict[str, WingForm] = {
    "su-fan": WingForm(
        "su-fan",
        _wave_form(
            "amplitude sin(rate a + phase) + decay_amplitude exp(-decay_rate a)",
            ["decay_amplitude", "decay_rate", "amplitude", "rate", "phase_deg"],
            {"constant": 0.0},
            rate=_RATES,
            decay_rate=np.geomspace(0.02, 2.0, 10),
        ),
        _SINE_FORM,
        _CENTRE,
    ),
    "dickinson": WingForm("dickinson", _SINE_FORM, _SINE_FORM, _CENTRE),
    "sine-cosine": WingForm(
        "sine-cosine",
        _wave_form("amplitude sin 2a", ["amplitude"], {"constant": 0.0, "rate": 2.0, "phase_deg": 0.0}),
        _wave_form("constant - amplitude cos 2a", ["constant", "amplitude"], {"rate": 2.0, "phase_deg": -90.0}),
        _CENTRE,
    ),
    "cambered": WingForm("cambered", CAMBERED_LIFT, CAMBERED_DRAG),
}
