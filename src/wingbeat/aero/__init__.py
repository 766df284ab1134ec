"""Air loads: quasi-steady coefficients of a wing strip, and blade elements that turn them into forces."""

from __future__ import annotations

import difflib
from pathlib import Path

from wingbeat.aero.blade_element import BladeElement as BladeElement
from wingbeat.aero.coefficients import CoefficientModel as CoefficientModel
from wingbeat.aero.extension import EXTENSIONS as EXTENSIONS
from wingbeat.aero.formula import CentreTerms as CentreTerms
from wingbeat.aero.formula import FormulaCoefficients as FormulaCoefficients
from wingbeat.aero.formula import FormulaTerms as FormulaTerms
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
from wingbeat.errors import FaultList


def load_coefficients(
    name_or_path: str | Path, extension: str = "mirrored", blend_width_deg: float = 1.0
) -> CoefficientModel:
    """Return a coefficient model by its name in `LIBRARY`, or from a file: a table .csv, a fit .toml.

    Parameters
    ----------
    name_or_path : "su-fan", "dickinson", ... or the path of a table (.csv) or of a fitted model (.toml).
    extension : how the coefficients reach every angle, one of `EXTENSIONS`.
    blend_width_deg : half width of the blends where pieces meet [deg], in (0, 3].

    Raises
    ------
    FileError : the file is missing or cannot be read.
    InvalidInputError : an unknown name, or what the model's constructor refuses.

    >>> load_coefficients("su-fan").name
    'su-fan'
    """
    name = str(name_or_path)
    if name.lower().endswith(".csv"):
        return load_table(name, extension, blend_width_deg)
    if name.lower().endswith(".toml"):
        return load_model(name, extension, blend_width_deg)
    if name not in LIBRARY:
        close = difflib.get_close_matches(name.lower(), LIBRARY, n=2, cutoff=0.5)
        guess = f"did you mean {' or '.join(close)}? " if close else ""
        faults = FaultList()
        fix = f"{guess}The models are {', '.join(LIBRARY)}; a table's path ends in .csv, a fitted model's in .toml"
        faults.add("coefficients", name, "is not a known coefficient model", fix)
        faults.raise_if_any()
    return LIBRARY[name](extension, blend_width_deg)
