"""Air loads: quasi-steady coefficients of a wing strip, and blade elements that turn them into forces."""

from __future__ import annotations

from wingbeat.aero.blade_element import AIRSPEEDS as AIRSPEEDS
from wingbeat.aero.blade_element import FORCE_POINTS as FORCE_POINTS
from wingbeat.aero.blade_element import BladeElement as BladeElement
from wingbeat.aero.choosing import coefficients_of as coefficients_of
from wingbeat.aero.choosing import load_coefficients as load_coefficients
from wingbeat.aero.coefficients import CoefficientModel as CoefficientModel
from wingbeat.aero.extension import EXTENSIONS as EXTENSIONS
from wingbeat.aero.formula import CentreTerms as CentreTerms
from wingbeat.aero.formula import FormulaCoefficients as FormulaCoefficients
from wingbeat.aero.formula import FormulaTerms as FormulaTerms
from wingbeat.aero.function import FunctionCoefficients as FunctionCoefficients
from wingbeat.aero.library import LIBRARY as LIBRARY
from wingbeat.aero.library import Byl as Byl
from wingbeat.aero.library import Dickinson as Dickinson
from wingbeat.aero.library import ParslewCrowther as ParslewCrowther
from wingbeat.aero.library import SuFan as SuFan
from wingbeat.aero.library import Wang2004 as Wang2004
from wingbeat.aero.library import WhitneyWood as WhitneyWood
from wingbeat.aero.library import ellington_normal_drag as ellington_normal_drag
from wingbeat.aero.library import thin_aerofoil_lift as thin_aerofoil_lift
from wingbeat.aero.library import thin_aerofoil_moment as thin_aerofoil_moment
from wingbeat.aero.model_file import load_model as load_model
from wingbeat.aero.table import TableCoefficients as TableCoefficients
from wingbeat.aero.table import load_table as load_table
