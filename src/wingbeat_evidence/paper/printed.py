"""The formulas as printed, at positive angles, without the extension and the blends that flight needs."""

from __future__ import annotations

import numpy as np

from wingbeat.aero import FormulaCoefficients


def printed_lift(model: FormulaCoefficients, alpha_deg: np.ndarray) -> np.ndarray:
    """Return C_L by the formula itself, without extension or blend, at angles from 0 to 110 [deg]."""
    return np.asarray(model.lift_terms.in_radians(with_decay=True)(np.radians(alpha_deg)))


def printed_drag(model: FormulaCoefficients, alpha_deg: np.ndarray) -> np.ndarray:
    """Return C_D by the formula itself at angles from 0 to 110 [deg]."""
    return np.asarray(model.drag_terms.in_radians(with_decay=True)(np.radians(alpha_deg)))


def printed_centre(model: FormulaCoefficients, alpha_deg: np.ndarray) -> np.ndarray:
    """Return the centre of pressure by the formula itself at angles above 0 [deg], in chords."""
    assert model.centre_terms is not None
    return np.asarray(model.centre_terms.in_radians()(np.radians(alpha_deg)))


def printed_moment(model: FormulaCoefficients, alpha_deg: np.ndarray) -> np.ndarray:
    """Return C_M about mid-chord, ``C_N (0.5 - x_cp)``, by the formulas themselves."""
    alpha = np.radians(alpha_deg)
    normal = printed_lift(model, alpha_deg) * np.cos(alpha) + printed_drag(model, alpha_deg) * np.sin(alpha)
    return normal * (0.5 - printed_centre(model, alpha_deg))


def fitted_slope(values: np.ndarray, alpha_deg: np.ndarray) -> float:
    """Return the slope of the least-squares line [1/rad]."""
    return float(np.polyfit(np.radians(alpha_deg), values, 1)[0])
