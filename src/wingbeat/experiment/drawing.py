"""Coefficient models drawn at random from the uncertainty of a fit."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import FaultList, InvalidInputError
from wingbeat.aero import CamberedCoefficients, FormulaCoefficients
from wingbeat.aero.model_file import FittedCurve, read_model
from wingbeat.experiment.wing_fit import WingFit

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
    curves = model.curves
    if not any(curve.free for curve in curves.values()):
        faults.add(model.name, "no covariance", "has nothing to draw from", "fit it with `wingbeat fit`")
    faults.raise_if_any()
    random = np.random.default_rng(seed)
    drawn = {name: _terms(name, curve, count, random) for name, curve in curves.items()}
    return [
        model.coefficients(extension, blend_width_deg, **{name: terms[i] for name, terms in drawn.items()})
        for i in range(count)
    ]


def _terms(label: str, curve: FittedCurve, count: int, random: np.random.Generator) -> list[Any]:
    """Return `count` random draws of the formula of one coefficient."""
    if not curve.free:
        return [curve.terms] * count
    mean = np.array([getattr(curve.terms, name) for name in curve.free])
    factor = _root(curve.covariance)
    found: list[Any] = []
    for _ in range(_TRIES):
        for values in mean + random.normal(size=(count, len(mean))) @ factor.T:
            try:
                found.append(
                    dataclasses.replace(curve.terms, **dict(zip(curve.free, values.tolist(), strict=True)))
                )
            except InvalidInputError:
                continue
        if len(found) >= count:
            return found[:count]
    faults = FaultList()
    rule = "few random draws from it give a valid formula: the data do not determine this form"
    faults.add(f"{label}, covariance", "too wide", rule, "choose a form with fewer parameters")
    raise InvalidInputError(faults.faults)


def _root(covariance: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a matrix L with ``L L^T`` equal to the covariance; negative eigenvalues from rounding count as 0."""
    spread = np.sqrt(np.diag(covariance))
    scale = np.where(spread > 0, spread, 1.0)
    values, vectors = np.linalg.eigh(covariance / np.outer(scale, scale))
    return scale[:, None] * vectors * np.sqrt(np.maximum(values, 0.0))
