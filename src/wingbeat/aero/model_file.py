"""Model files: TOML files with coefficients that were fitted to measurements, and their covariance."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import fields
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import Fault, FaultList, InvalidInputError, read_text, toml_tables
from wingbeat.aero.coefficient_model import check_aspect_ratio
from wingbeat.aero.extension import check_extension
from wingbeat.aero.formula_models import CamberedCoefficients, FormulaCoefficients
from wingbeat.aero.formula_terms import CamberedTerms, CentreTerms, FormulaTerms


class FittedCurve(NamedTuple):
    """Terms of one coefficient, or all terms of a cambered wing, with the uncertainty of the fit."""

    terms: FormulaTerms | CentreTerms | CamberedTerms
    free: tuple[str, ...]  # names of the k fitted terms
    covariance: NDArray[np.float64]  # theirs, shape (k, k)


class FittedModel(NamedTuple):
    """A fit of formulas to one side of a wing; `centre` is None if no centre of pressure was measured."""

    name: str
    citation: str
    alpha_range_deg: tuple[float, float]
    reynolds_range: tuple[float, float] | None
    lift: FittedCurve
    drag: FittedCurve
    centre: FittedCurve | None
    aspect_ratio: float | None = None
    notes: tuple[str, ...] = ()  # warnings of the fit

    @property
    def curves(self) -> dict[str, FittedCurve]:
        """The fitted curves, by the names that their terms have in the coefficient model."""
        curves = {"lift_terms": self.lift, "drag_terms": self.drag}
        return curves if self.centre is None else curves | {"centre_terms": self.centre}

    def coefficients(
        self, extension: str = "mirrored", blend_width_deg: float = 1.0, **terms: Any
    ) -> FormulaCoefficients:
        """Return the coefficient model; formulas that are given (lift_terms, ...) replace those of the file."""
        own: dict[str, Any] = {name: curve.terms for name, curve in self.curves.items()}
        return FormulaCoefficients(
            self.name,
            **(own | terms),
            citation=self.citation,
            reynolds_range=self.reynolds_range,
            aspect_ratio=self.aspect_ratio,
            alpha_range_deg=self.alpha_range_deg,
            extension=extension,
            blend_width_deg=blend_width_deg,
        )


class FittedWing(NamedTuple):
    """A fit of a cambered wing; `wing` holds all its terms and the joint covariance of lift and drag."""

    name: str
    citation: str
    low_join_deg: tuple[float, float]
    high_join_deg: tuple[float, float]
    reynolds_range: tuple[float, float] | None
    wing: FittedCurve
    aspect_ratio: float | None = None
    notes: tuple[str, ...] = ()

    @property
    def curves(self) -> dict[str, FittedCurve]:
        """The fitted terms, by the name that they have in the coefficient model."""
        return {"terms": self.wing}

    def coefficients(
        self, extension: str = "mirrored", blend_width_deg: float = 1.0, **terms: Any
    ) -> CamberedCoefficients:
        """Return the coefficient model; terms that are given (terms=...) replace those of the file."""
        # The model covers all angles, so the extension has no effect.
        faults = FaultList()
        check_extension(faults, extension, blend_width_deg)
        faults.raise_if_any()
        return CamberedCoefficients(
            self.name,
            terms.get("terms", self.wing.terms),
            self.low_join_deg,
            self.high_join_deg,
            citation=self.citation,
            reynolds_range=self.reynolds_range,
            blend_width_deg=blend_width_deg,
            aspect_ratio=self.aspect_ratio,
        )


Fitted = FittedModel | FittedWing


KIND = "wing coefficients"
MAX_BYTES = 1 << 16
_WAVE = ("constant", "amplitude", "rate", "phase_deg")
_DECAY = ("decay_amplitude", "decay_rate")
# The tables of terms that a file may have: the type and the names of their terms.
_TABLES: dict[str, tuple[type[FormulaTerms] | type[CentreTerms] | type[CamberedTerms], tuple[str, ...]]] = {
    "lift": (FormulaTerms, (*_WAVE, *_DECAY)),
    "drag": (FormulaTerms, (*_WAVE, *_DECAY)),
    "centre": (CentreTerms, ("constant", "power_amplitude", "exponent", "decay_amplitude", "decay_rate")),
    "wing": (CamberedTerms, tuple(field.name for field in fields(CamberedTerms))),
}
_HEAD = ("kind", "name", "citation", "form", "made_by", "reynolds_range", "aspect_ratio", "notes")
_ONE_SIDE = (*_HEAD, "alpha_range_deg", "lift", "drag", "centre")
_TWO_SIDES = (*_HEAD, "low_join_deg", "high_join_deg", "wing")
_FIT = ("free", "covariance", "r_squared", "aicc", "points")


def read_model(path: str | Path) -> Fitted:
    """Read a model file, of a cambered wing if it has the table ``[wing]``, with the covariance of its terms."""
    path = Path(path)
    file, faults = path.name, FaultList()
    raw = toml_tables(read_text(path, limit=MAX_BYTES), str(path))
    if raw.get("kind") != KIND:
        fix = "is it a species file? `wingbeat fit -o NAME.toml` writes model files"
        raise InvalidInputError([Fault(f"{file}: kind", raw.get("kind"), f"must be {KIND!r}", fix)])
    cambered = "wing" in raw
    _known(faults, file, raw, _TWO_SIDES if cambered else _ONE_SIDE)
    texts = {key: _text(faults, file, raw, key) for key in ("name", "citation", "form", "made_by")}
    reynolds = _pair(faults, file, raw, "reynolds_range", 0.0, 1e12) if "reynolds_range" in raw else None
    aspect_ratio = raw.get("aspect_ratio")
    check_aspect_ratio(faults, f"{file}: aspect_ratio", aspect_ratio)
    if not texts["name"] and "name" in raw:
        faults.add(f"{file}: name", raw["name"], "must not be empty")
    notes = raw.get("notes", [])
    if not isinstance(notes, list) or not all(isinstance(note, str) for note in notes):
        faults.add(f"{file}: notes", notes, "must be a list of texts", "write each in quotes")
        notes = []
    named = texts["name"], texts["citation"] or file
    if cambered:
        low, high = (_pair(faults, file, raw, key, -90.0, 90.0) for key in ("low_join_deg", "high_join_deg"))
        wing = _curve(faults, file, raw, "wing")
        faults.raise_if_any()
        return FittedWing(*named, low, high, reynolds, wing, aspect_ratio, tuple(notes))
    alpha = _pair(faults, file, raw, "alpha_range_deg", -180.0, 180.0)
    lift, drag = (_curve(faults, file, raw, key) for key in ("lift", "drag"))
    centre = _curve(faults, file, raw, "centre") if "centre" in raw else None
    faults.raise_if_any()
    return FittedModel(*named, alpha, reynolds, lift, drag, centre, aspect_ratio, tuple(notes))


def load_model(
    path: str | Path, extension: str = "mirrored", blend_width_deg: float = 1.0
) -> FormulaCoefficients | CamberedCoefficients:
    """Read the coefficient model of a model file.

    Parameters
    ----------
    path : the TOML file; angles in degrees.
    extension, blend_width_deg : as in `FormulaCoefficients`; a cambered wing covers all angles, so an extension
        has no effect on it.

    Raises
    ------
    FileError, InvalidInputError : as in `read_model`; inputs that the model's constructor refuses, such as a signed
        extension of a drag formula with an exponential term.
    """
    faults = FaultList()
    check_extension(faults, extension, blend_width_deg)
    try:
        model = read_model(path)
    except InvalidInputError as error:
        raise InvalidInputError([*faults.faults, *error.faults]) from None
    faults.raise_if_any()
    return model.coefficients(extension, blend_width_deg)


def _known(faults: FaultList, where: str, table: dict[str, Any], keys: Iterable[str]) -> None:
    for key in table:
        if key not in keys:
            faults.add(f"{where}: {key!r}", "", "is not a known key", f"the keys are {', '.join(keys)}")


def _text(faults: FaultList, file: str, raw: dict[str, Any], key: str) -> str:
    value = raw.get(key, "")
    if not isinstance(value, str):
        faults.add(f"{file}: {key}", value, "must be a text", "put it in quotes")
        return ""
    if key == "name" and key not in raw:
        faults.add(f"{file}: {key}", "", "must be given", "name the model")
    return value


def _pair(faults: FaultList, file: str, raw: dict[str, Any], key: str, low: float, high: float) -> Any:
    """Return two numbers, or None with its faults noted."""
    pair = raw.get(key)
    if not isinstance(pair, list) or len(pair) != 2:
        faults.add(f"{file}: {key}", pair, "must be a list of two numbers", "write [lowest, highest]")
        return None
    if not all([faults.number(f"{file}: {key}[{i}]", v, at_least=low, at_most=high) for i, v in enumerate(pair)]):
        return None
    if pair[0] > pair[1]:
        faults.add(f"{file}: {key}", pair, "has the highest value first", "write [lowest, highest]")
    return float(pair[0]), float(pair[1])


def _curve(faults: FaultList, file: str, raw: dict[str, Any], key: str) -> Any:
    """Return one `FittedCurve`, or None with its faults noted."""
    table, where = raw.get(key), f"{file}: {key}"
    if not isinstance(table, dict):
        faults.add(where, table, "must be a table", f"write [{key}] with its terms below")
        return None
    earlier = len(faults.faults)
    kind, known = _TABLES[key]
    names = _WAVE if kind is FormulaTerms and not any(name in table for name in _DECAY) else known
    _known(faults, where, table, (*known, "fit"))
    for name in names:
        faults.number(f"{where}.{name}", table.get(name), fix=f"the terms are {', '.join(names)}")
    free, covariance = _covariance(faults, f"{where}.fit", table.get("fit", {}), names)
    if len(faults.faults) > earlier:
        return None
    terms = {name: float(table[name]) for name in names}
    try:
        formula = kind(**terms)
    except InvalidInputError as error:  # what the formula itself demands, in the words of the file
        for fault in error.faults:
            own = f"{where}.{fault.where.rpartition('.')[2]}"
            faults.faults.append(Fault(own, fault.value, fault.rule, fault.fix))
        return None
    return FittedCurve(formula, free, covariance)


def _covariance(
    faults: FaultList, where: str, fit: Any, names: tuple[str, ...]
) -> tuple[tuple[str, ...], NDArray[np.float64]]:
    """Return the names of the fitted terms and their covariance; note a fault unless it is a valid covariance."""
    nothing = (), np.zeros((0, 0))
    if not isinstance(fit, dict):
        faults.add(where, fit, "must be a table", "write free = [...] and covariance = [[...], ...] in it")
        return nothing
    _known(faults, where, fit, _FIT)
    free, rows = fit.get("free", []), fit.get("covariance", [])
    if not isinstance(free, list) or not all(name in names for name in free) or len(set(free)) != len(free):
        fix = f"they are {', '.join(names)}"
        faults.add(f"{where}.free", free, "must name terms of the formula, each once", fix)
        return nothing
    size = len(free)
    if not isinstance(rows, list) or [len(row) if isinstance(row, list) else -1 for row in rows] != [size] * size:
        faults.add(f"{where}.covariance", "", f"must be {size} rows of {size} numbers, one for each term in free")
        return nothing
    cells = [(i, k, cell) for i, row in enumerate(rows) for k, cell in enumerate(row)]
    if not all([faults.number(f"{where}.covariance[{i}][{k}]", cell) for i, k, cell in cells]):
        return nothing
    matrix = np.array(rows, dtype=np.float64).reshape(size, size)
    spread = np.sqrt(np.maximum(np.diag(matrix), 0.0))
    scale = np.outer(spread, spread)
    # Check the correlations, because the variances of a phase in degrees and of a rate differ by powers of ten.
    correlation = np.divide(matrix, scale, out=np.zeros_like(matrix), where=scale > 0)
    invalid = not np.allclose(correlation, correlation.T, rtol=0, atol=1e-9) or (np.diag(matrix) < 0).any()
    if size and (invalid or np.linalg.eigvalsh(correlation).min() < -1e-6):
        rule = "must be symmetric and positive semidefinite"
        faults.add(f"{where}.covariance", "", rule, "copy the matrix of the fit")
    return tuple(free), matrix
