"""Figure 3: lift, drag, moment and centre of pressure against angle of attack."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from wingbeat._base.style import GREY, PAGE, drawing, dress, legend_above, letter_panels
from wingbeat.aero import LIBRARY, FormulaCoefficients, thin_aerofoil_lift, thin_aerofoil_moment
from wingbeat_evidence.paper.figure_style import LOOKS, Drawn, Table, sheet

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# The range of the paper's measurements, in finer steps than measured.
ALPHA_DEG = np.linspace(0.0, 110.0, 441)
_THIN = {"lift": thin_aerofoil_lift, "moment": thin_aerofoil_moment}
_PANELS = (
    ("lift", "lift coefficient $C_L$ [-]", (-1.2, 2.0)),
    ("drag", "drag coefficient $C_D$ [-]", (0.0, 4.0)),
    ("moment", "moment coefficient $C_M$ [-]", (-0.15, 0.25)),
    ("centre", "centre of pressure $x_{cp}/c$ [-]", (0.0, 0.8)),
)
_NOTE = (
    "Lift (a), drag (b), moment (c) and centre of pressure (d) against angle of attack. "
    "Coloured lines are the published formulas at the angles to which they were fitted: 0 to 110 degrees for "
    "Su-Fan, and up to 90 degrees for Dickinson, who give no centre of pressure. Thin black lines are what our "
    "simulations use instead: they mirror the formulas beyond 90 degrees and blend them within 1 degree of 0 and "
    "90. Dotted grey lines are thin-aerofoil theory, 2πα and πα/2. In c the moment is about mid-chord; in d "
    "the distance is from the leading edge. The paper's measurements are not public, so no points are drawn."
)


def published(model: FormulaCoefficients, alpha_deg: np.ndarray) -> dict[str, np.ndarray]:
    """Return C_L and C_D by the formulas alone, and C_M about mid-chord and x_cp if the model has them.

    Parameters
    ----------
    model : a coefficient model made of formulas.
    alpha_deg : angles of attack, shape (K,) [deg]; coefficients at angles outside the fit are NaN.

    >>> found = published(LIBRARY["su-fan"](), np.array([40.0, 120.0]))
    >>> found["lift"].round(3).tolist()
    [1.19, nan]
    """
    low, high = model.alpha_range_deg
    alpha = np.radians(np.where((alpha_deg >= low) & (alpha_deg <= high), alpha_deg, np.nan))
    terms: dict[str, Any] = {"lift": model.lift_terms, "drag": model.drag_terms}
    found = {name: np.asarray(term.in_radians(with_decay=term.decays)(alpha)) for name, term in terms.items()}
    if model.centre_terms is not None:
        found["centre"] = np.asarray(model.centre_terms.in_radians()(alpha))
        normal = found["lift"] * np.cos(alpha) + found["drag"] * np.sin(alpha)
        found["moment"] = normal * (0.5 - found["centre"])
    return found


def simulated(model: FormulaCoefficients, alpha_deg: np.ndarray) -> dict[str, np.ndarray]:
    """Return the same coefficients as the simulations use them, at every angle [deg]."""
    alpha = np.radians(alpha_deg)
    found = {"lift": model.lift(alpha), "drag": model.drag(alpha)}
    if model.has_centre_of_pressure:
        found |= {"moment": model.moment(alpha), "centre": model.centre_of_pressure(alpha)}
    return found


def coefficients_figure() -> Drawn:
    """Draw figure 3: a lift, b drag, c moment about mid-chord, d centre of pressure, 0 to 110 degrees.

    Returns
    -------
    The figure, its caption, and its rows, one for each model and angle: by formula, as simulated, and by
    thin-aerofoil theory.

    Su et al. 2023, doi 10.48550/arXiv.2302.09602; Dickinson et al. 1999, doi 10.1126/science.284.5422.1954.
    """
    curves = {
        name: (published(LIBRARY[name](), ALPHA_DEG), simulated(LIBRARY[name](), ALPHA_DEG)) for name in LOOKS
    }
    with drawing():
        figure = sheet(PAGE, 105.0)
        panels = figure.subplots(2, 2)
        for axes, (quantity, label, limits) in zip(panels.flat, _PANELS, strict=True):
            _draw_panel(axes, quantity, curves)
            dress(axes, "angle of attack α [deg]", label)
            axes.set(xlim=(0, 110), ylim=limits, xticks=range(0, 111, 15))
        legend_above(panels[0, 0], columns=4)
        figure.align_ylabels(panels)
        letter_panels(panels)
    return Drawn(figure, _rows(curves), _NOTE)


def _draw_panel(axes: Axes, quantity: str, curves: dict[str, Any]) -> None:
    axes.axhline(0, color=GREY, linewidth=0.5)
    for i, (name, (formula, used)) in enumerate(curves.items()):
        if quantity not in formula:
            continue
        axes.plot(ALPHA_DEG, formula[quantity], label=LOOKS[name].name, linewidth=1.8, **LOOKS[name].line)
        apart = np.where(np.isclose(used[quantity], formula[quantity], atol=1e-4), np.nan, used[quantity])
        axes.plot(ALPHA_DEG, apart, color="k", linewidth=0.7, label=None if i else "as simulated")
    if quantity in _THIN:
        line: dict[str, Any] = {"color": GREY, "linestyle": ":", "label": "thin aerofoil"}
        axes.plot(ALPHA_DEG, _THIN[quantity](np.radians(ALPHA_DEG)), **line)


def _rows(curves: dict[str, Any]) -> Table:
    empty = np.full(len(ALPHA_DEG), np.nan)
    names = {"lift": "C_L", "drag": "C_D", "moment": "C_M_mid_chord", "centre": "x_cp_chords"}
    rows: list[dict[str, Any]] = []
    for model, (formula, used) in curves.items():
        columns = {"alpha_deg": ALPHA_DEG}
        for quantity, name in names.items():
            columns[f"{name}_formula"] = formula.get(quantity, empty)
            columns[f"{name}_simulated"] = used.get(quantity, empty)
        columns |= {f"{names[q]}_thin_aerofoil": line(np.radians(ALPHA_DEG)) for q, line in _THIN.items()}
        rows += [
            {"model": model, **dict(zip(columns, values, strict=True))}
            for values in zip(*columns.values(), strict=True)
        ]
    return rows
