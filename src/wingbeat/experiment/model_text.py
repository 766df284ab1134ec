"""The text of a model file: TOML with every term, its interval and the covariance of all."""

from __future__ import annotations

import json
import math

import numpy as np

from wingbeat._version import __version__
from wingbeat.aero.model_file import KIND, Fitted, FittedCurve, FittedWing
from wingbeat.experiment.regression import CurveFit

_HEAD = """\
# Coefficients of a wing strip, fitted by `wingbeat fit`. Give this file in place of a model's name:
# wingbeat polar THIS.toml, wingbeat orbit pigeon --speed 12 --aero THIS.toml. Angles of attack a are in degrees."""
_CAMBERED = """\
# The formulas hold between the joins, where the wing was measured; beyond the joins the wing is a plate (su-fan).
# ramp(x) is max(x, 0) with its corner rounded. The onsets of drag are counted from zero_lift_deg. The slope and the
# rises are per radian."""


def model_text(model: Fitted, form: str, curves: dict[str, CurveFit]) -> str:
    """Return the content of the model file of a fit.

    Parameters
    ----------
    model : what the file holds.
    form : name of the form.
    curves : the fitted curves by coefficient.
    """
    lines = [
        _HEAD,
        *([_CAMBERED] if isinstance(model, FittedWing) else []),
        f"kind = {_quoted(KIND)}",
        f"name = {_quoted(model.name)}",
        f"citation = {_quoted(model.citation)}",
        f"form = {_quoted(form)}",
        f"made_by = {_quoted(f'wingbeat {__version__}')}",
    ]
    if isinstance(model, FittedWing):
        ranges = {"low_join_deg": model.low_join_deg, "high_join_deg": model.high_join_deg}
        sections = {"wing": (model.wing, curves)}
    else:
        ranges = {"alpha_range_deg": model.alpha_range_deg}
        parts = {"lift": model.lift, "drag": model.drag, "centre": model.centre}
        sections = {
            key: (part, {label: curve})
            for (key, part), (label, curve) in zip(parts.items(), curves.items(), strict=False)
            if part is not None
        }
    lines += [f"{key} = {_row(ends)}" for key, ends in ranges.items()]
    if model.reynolds_range is not None:
        lines.append(f"reynolds_range = {_row(model.reynolds_range)}")
    if model.aspect_ratio is not None:
        lines.append(f"aspect_ratio = {float(model.aspect_ratio)!r}")
    if model.notes:
        lines += ["notes = [", *(f"  {_quoted(note)}," for note in model.notes), "]"]
    for key, (part, own) in sections.items():
        lines += ["", *_section(key, part, own)]
    return "\n".join(lines) + "\n"


def _section(key: str, part: FittedCurve, curves: dict[str, CurveFit]) -> list[str]:
    limits = {name: ends for curve in curves.values() for name, ends in curve.interval().items()}
    formulas = [f"{label} = {curve.form.formula}" for label, curve in curves.items()]
    lines = [f"[{key}] # {formulas[0]}", *(f"# {formula}" for formula in formulas[1:])]
    for name, value in vars(part.terms).items():
        if value is not None:
            low, high = limits.get(name, (value, value))
            about = f" # 95 % interval {low:.5g} to {high:.5g}" if name in limits else " # held fixed"
            lines.append(f"{name} = {float(value)!r}{about}")
    lines += ["", f"[{key}.fit]", f"free = [{', '.join(_quoted(name) for name in part.free)}]", "covariance = ["]
    lines += [f"  {_row(row)}," for row in part.covariance]
    lines += ["]", f"points = {len(next(iter(curves.values())).values)}"]
    for name in ("r_squared", "aicc"):
        values = [getattr(curve, name) for curve in curves.values()]
        if all(math.isfinite(value) for value in values):
            lines.append(f"{name} = {_row(values) if len(values) > 1 else repr(float(values[0]))}")
    return lines


def _row(values: object) -> str:
    return "[" + ", ".join(repr(float(value)) for value in np.asarray(values)) + "]"


def _quoted(text: str) -> str:
    """Return a TOML string, written as JSON: their escapes agree once unprintable characters are removed."""
    return json.dumps("".join(sign for sign in text if sign.isprintable()), ensure_ascii=False)
