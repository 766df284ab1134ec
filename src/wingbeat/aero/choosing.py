"""Coefficient models from what a user may give: a model, its name, the path of its file, or a function."""

from __future__ import annotations

import contextlib
import functools
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from wingbeat._base import Fault, FaultList, read_text, suggest
from wingbeat._base.sheets import seems_to_be
from wingbeat.aero.cambered import CamberedCoefficients
from wingbeat.aero.coefficient_model import CoefficientModel, check_curve
from wingbeat.aero.formula import FormulaCoefficients
from wingbeat.aero.function import FunctionCoefficients
from wingbeat.aero.library import LIBRARY
from wingbeat.aero.model_file import load_model
from wingbeat.aero.table import load_table


def coefficients_of(given: Any) -> CoefficientModel:
    """Return the coefficient model for any value that ``aero`` accepts.

    Parameters
    ----------
    given : a coefficient model; a name in `LIBRARY`; the path of a table (.csv) or of a fitted model (.toml); or a
        JAX function of the angle of attack [rad] that returns (C_L, C_D), see `FunctionCoefficients`.

    Raises
    ------
    FileError : the file is missing or cannot be read.
    InvalidInputError : an unknown name, a function that `FunctionCoefficients` refuses, a model with negative drag,
        C_D > 5 or C_L beyond 2 pi at some angle, a value of another type.

    >>> coefficients_of("dickinson").name, coefficients_of(LIBRARY["su-fan"]()).name
    ('dickinson', 'su-fan')
    """
    if isinstance(given, str | PathLike):
        return load_coefficients(Path(given) if isinstance(given, PathLike) else given)
    faults = FaultList()
    if isinstance(given, type) or any(given is maker for maker in LIBRARY.values()):
        name = getattr(given, "__name__", "?")
        faults.add("aero.coefficients", name, "is a class of coefficient models, not a model", f"call it: {name}()")
    elif hasattr(given, "kernel"):
        return _possible(given)
    elif callable(given):
        return FunctionCoefficients(given)
    else:
        fix = "give SuFan(), a name such as su-fan, the path of a model file, or a function alpha -> (C_L, C_D)"
        faults.add("aero.coefficients", given, "is not a coefficient model", fix)
    faults.raise_if_any()
    raise AssertionError("a fault was noted")


def load_coefficients(
    name_or_path: str | Path, extension: str = "mirrored", blend_width_deg: float = 1.0
) -> CoefficientModel:
    """Return a coefficient model by its name in `LIBRARY`, or from a file: a table (.csv) or a fit (.toml).

    Parameters
    ----------
    name_or_path : "su-fan", "dickinson", ... or the path of a table (.csv) or of a fitted model (.toml).
    extension : how the coefficients are extended to all angles, one of `EXTENSIONS`.
    blend_width_deg : half width of the blends where pieces meet [deg], in (0, 3].

    Raises
    ------
    FileError : the file is missing or cannot be read.
    InvalidInputError : an unknown name, or inputs that the model's constructor refuses.

    >>> load_coefficients("su-fan").name
    'su-fan'
    """
    name = str(name_or_path)
    if name.lower().endswith(".csv"):
        return load_table(name, extension, blend_width_deg)
    if name.lower().endswith(".toml"):
        return _possible(load_model(name, extension, blend_width_deg))
    if name not in LIBRARY:
        guess = suggest(name.lower(), LIBRARY, most=2, otherwise="")
        faults = FaultList()
        if name and Path(name).is_file():
            words = seems_to_be(read_text(name)) or "a file"
            rule = f"seems to be {words}"
            faults.add(
                "coefficients", name, rule, "the name of a table ends in .csv, that of a fitted model in .toml"
            )
            faults.raise_if_any()
        known = f"The models are {', '.join(LIBRARY)}; a table's path ends in .csv, a fitted model's in .toml"
        faults.add("coefficients", name, "is not a known coefficient model", f"{guess} {known}".lstrip())
        faults.raise_if_any()
    return LIBRARY[name](extension, blend_width_deg)


def load_hand(
    name_or_path: str, extension: str = "mirrored", blend_width_deg: float = 1.0
) -> CoefficientModel | str:
    """Return the coefficient model of a hand, from `load_coefficients`; if "none" is given, return "none".

    Parameters
    ----------
    name_or_path, extension, blend_width_deg : as for `load_coefficients`.

    Raises
    ------
    FileError, InvalidInputError : as `load_coefficients`.

    >>> load_hand("none"), load_hand("membrane").name
    ('none', 'membrane')
    """
    return name_or_path if name_or_path == "none" else load_coefficients(name_or_path, extension, blend_width_deg)


def _possible(model: CoefficientModel) -> CoefficientModel:
    """Return a model of formulas after a check of its curve at all angles; tables and functions check their own."""
    if isinstance(model, FormulaCoefficients | CamberedCoefficients):
        # Under JAX's transformations a model holds tracers, which have no hash.
        with contextlib.suppress(TypeError):
            faults = FaultList()
            faults.faults.extend(_curve_faults(model))
            faults.raise_if_any()
    return model


@functools.lru_cache(maxsize=256)
def _curve_faults(model: FormulaCoefficients | CamberedCoefficients) -> tuple[Fault, ...]:
    """Return what no wing has in the curve of a model of formulas; those of the library are known to be good."""
    if any(model == maker(model.extension, model.blend_width_deg) for maker in LIBRARY.values()):
        return ()
    faults, degrees = FaultList(), np.arange(-180.0, 180.25, 0.5)
    alpha = np.radians(degrees)
    check_curve(faults, "aero.coefficients", model.name, degrees, model.lift(alpha), model.drag(alpha))
    return tuple(faults.faults)
