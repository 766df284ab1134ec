"""Air loads: quasi-steady coefficients of a wing strip, and blade elements that turn them into forces.

>>> import wingbeat as wb
>>> wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0, aero=wb.aero.Dickinson()).aero.coefficients.name
'dickinson'
"""

from wingbeat.aero import winds as winds
from wingbeat.aero.blade_element import AIRSPEEDS, FORCE_POINTS, BladeElement, coefficients_of, load_coefficients
from wingbeat.aero.closed_forms import INFLOWS, UNSTEADY
from wingbeat.aero.coefficient_model import CoefficientModel
from wingbeat.aero.extension import EXTENSIONS
from wingbeat.aero.family import FamilyCoefficients
from wingbeat.aero.formula_models import CamberedCoefficients, FormulaCoefficients
from wingbeat.aero.formula_terms import CamberedTerms, CentreTerms, FormulaTerms
from wingbeat.aero.function import FunctionCoefficients
from wingbeat.aero.library import (
    LIBRARY,
    WING_ESTIMATES,
    Byl,
    Dickinson,
    Estimate,
    Feathered,
    FeatheredFlapping,
    FeatheredRevolving,
    Membrane,
    ParslewCrowther,
    SuFan,
    Wang2004,
    WhitneyWood,
    ellington_normal_drag,
    thin_aerofoil_lift,
    thin_aerofoil_moment,
)
from wingbeat.aero.model_file import load_model
from wingbeat.aero.polar_models import load_table
from wingbeat.aero.table import TableCoefficients
from wingbeat.aero.wake import WAKES

__all__ = [
    "AIRSPEEDS",
    "EXTENSIONS",
    "FORCE_POINTS",
    "INFLOWS",
    "LIBRARY",
    "UNSTEADY",
    "WAKES",
    "WING_ESTIMATES",
    "BladeElement",
    "Byl",
    "CamberedCoefficients",
    "CamberedTerms",
    "CentreTerms",
    "CoefficientModel",
    "Dickinson",
    "Estimate",
    "FamilyCoefficients",
    "Feathered",
    "FeatheredFlapping",
    "FeatheredRevolving",
    "FormulaCoefficients",
    "FormulaTerms",
    "FunctionCoefficients",
    "Membrane",
    "ParslewCrowther",
    "SuFan",
    "TableCoefficients",
    "Wang2004",
    "WhitneyWood",
    "coefficients_of",
    "ellington_normal_drag",
    "load_coefficients",
    "load_model",
    "load_table",
    "thin_aerofoil_lift",
    "thin_aerofoil_moment",
    "winds",
]


def __dir__() -> list[str]:
    return sorted(__all__)
