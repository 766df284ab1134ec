"""The forms that a wing is fitted to: one curve for each of lift, drag and centre of pressure."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from wingbeat.aero.formula import CentreTerms, FormulaTerms
from wingbeat.experiment.cambered_form import CAMBERED_DRAG, CAMBERED_LIFT
from wingbeat.experiment.forms import Array, BoxForm, CurveForm, formula_of

# Grids of the terms in which a formula is not linear; the others follow from linear least squares at each node.
_RATES = np.concatenate([np.geomspace(0.3, 3.0, 12), [3.6, 4.5]])
_WAVE_DECAYS = np.geomspace(0.02, 2.0, 10)
_EXPONENTS = np.linspace(0.2, 2.0, 10)
_CENTRE_DECAYS = np.geomspace(0.02, 0.6, 10)


def _wave_form(formula: str, free: list[str], fixed: dict[str, float], **grids: Array) -> BoxForm:
    decays = "decay_rate" in free
    return BoxForm(
        formula,
        formula_of(FormulaTerms, fixed),
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
    formula_of(CentreTerms, {}),
    dict.fromkeys(["constant", "power_amplitude", "exponent", "decay_amplitude", "decay_rate"], 1.0),
    lowest={"exponent": 1e-3, "decay_rate": 0.0},
    highest={"exponent": 5.0, "decay_rate": 5.0},
    only_positive=True,
    kind=CentreTerms,
    grids={"exponent": _EXPONENTS, "decay_rate": _CENTRE_DECAYS},
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
            decay_rate=_WAVE_DECAYS,
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
