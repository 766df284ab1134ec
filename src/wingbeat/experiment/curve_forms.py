"""The curves that measurements are fitted to: a formula, its parameters, and where a fit should begin."""

from __future__ import annotations

import functools
import inspect
import math
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import FaultList
from wingbeat._jax.arrays import jax, unchecked
from wingbeat.aero.coefficient_model import at_angles
from wingbeat.aero.formula_terms import CamberedTerms, CentreTerms, FormulaTerms

Array = NDArray[np.float64]
Kind = type[FormulaTerms] | type[CentreTerms] | type[CamberedTerms]


@functools.partial(jax.jit, static_argnames=("kind", "curve"))
def _value_and_slopes(numbers: Any, alpha_deg: Any, kind: Any, curve: str) -> Any:
    # All numbers in one array: a record's fields, handed over one by one, take longer than the formula.
    terms = jax.tree.unflatten(kind, list(numbers))
    formula = getattr(type(terms), curve)
    slopes = jax.jacfwd(formula)(terms, alpha_deg)
    return [formula(terms, alpha_deg), *jax.tree.leaves(slopes)]


def value_and_slopes(terms: Any, alpha_deg: Array, curve: str = "at") -> tuple[Array, Any]:
    """Return a formula of `wingbeat.aero` at angles [deg], and its derivatives in a record like `terms`.

    >>> value, slopes = value_and_slopes(FormulaTerms(0.1, 2.0, 2.0, 0.0), np.array([45.0]))
    >>> round(float(value[0]), 12), round(float(slopes.amplitude[0]), 12)
    (2.1, 1.0)
    """
    numbers, kind = jax.tree.flatten(terms)
    function = functools.partial(_value_and_slopes, kind=kind, curve=curve)
    value, *slopes = at_angles(function, np.array(numbers, dtype=np.float64), alpha_deg)
    return value, jax.tree.unflatten(kind, slopes)


def any_terms(kind: Kind, terms: dict[str, float]) -> Any:
    """Return terms without the checks of their constructor, because a fit may pass through refused values."""
    # All of them floats: JAX compiles anew for another type of number, and does not differentiate in integers.
    return unchecked(kind, {name: float(value) for name, value in terms.items()})


@dataclass(frozen=True)
class CurveForm:
    """One curve with free parameters, built in or a function of your own.

    Parameters
    ----------
    formula : the curve in words or symbols, for tables and figures.
    function : of angles [deg], shape (n,), and of each parameter by its name; returns shape (n,).
    start : names of the parameters with values to begin at.
    lowest, highest : bounds of some of the parameters.
    only_positive : True if the curve must not be evaluated at negative angles.

    Raises
    ------
    InvalidInputError : no parameters, a start that is not finite, or names that the function does not take.

    >>> line = CurveForm("m a + b", lambda a, m, b: m * a + b, {"m": 0.1, "b": 0.0})
    >>> line.value(np.array([10.0]), {"m": 0.1, "b": 1.0}).tolist()
    [2.0]
    """

    formula: str
    function: Callable[..., Any]
    start: dict[str, float]
    lowest: dict[str, float] = field(default_factory=dict)
    highest: dict[str, float] = field(default_factory=dict)
    only_positive: bool = False

    def __post_init__(self) -> None:
        faults = FaultList()
        if not self.start:
            faults.add("start", self.start, "has no parameters", "give {name: starting value}")
        for name, value in self.start.items():
            faults.number(f"start.{name}", value)
        try:
            inspect.signature(self.function).bind(np.zeros(1), **self.start)
        except (TypeError, ValueError) as error:
            rule = f"does not take the parameters named in start ({error})"
            faults.add("function", self.formula, rule, "give the function's arguments the names in start")
        faults.raise_if_any()

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the free parameters."""
        return tuple(self.start)

    def value(self, alpha_deg: Array, parameters: dict[str, float]) -> Array:
        """Return the curve at given angles, shape (n,).

        Parameters
        ----------
        alpha_deg : angles of attack [deg], shape (n,).
        parameters : the free parameters by name.
        """
        return np.asarray(self.function(alpha_deg, **parameters), dtype=np.float64)

    def slopes(self, alpha_deg: Array, parameters: dict[str, float]) -> Array:
        """Return the derivatives with respect to the parameters, shape (n, parameters), from central differences.

        Parameters
        ----------
        alpha_deg : angles of attack [deg], shape (n,).
        parameters : the free parameters by name.
        """
        columns = []
        for name, value in parameters.items():
            step = 6e-6 * max(abs(value), 1e-3)
            ends = [self.value(alpha_deg, parameters | {name: value + s}) for s in (step, -step)]
            with np.errstate(invalid="ignore"):  # infinite values: the caller refuses them
                columns.append((ends[0] - ends[1]) / (2 * step))
        return np.column_stack(columns)

    def value_and_slopes(self, alpha_deg: Array, parameters: dict[str, float]) -> tuple[Array, Array]:
        """Return `value` and `slopes`, shapes (n,) and (n, parameters).

        Parameters
        ----------
        alpha_deg : angles of attack [deg], shape (n,).
        parameters : the free parameters by name.
        """
        return self.value(alpha_deg, parameters), self.slopes(alpha_deg, parameters)

    def starts(self, alpha_deg: Array, values: Array, weight: Array) -> list[dict[str, float]]:
        """Return the parameters from which fits begin.

        Parameters
        ----------
        alpha_deg, values : the measurements, shape (n,) [deg].
        weight : one over the standard error of each measurement, shape (n,).
        """
        del alpha_deg, values, weight  # a form of the user's own knows its start
        return [self.start]

    def check(self, faults: FaultList, alpha_deg: Array, values: Array, label: str) -> None:
        """Note a fault if measurements lie where the form does not hold, or do not determine it.

        Parameters
        ----------
        faults : where it is noted.
        alpha_deg, values : the measurements, shape (n,) [deg].
        label : name of the quantity in messages.
        """
        del values, label
        if self.only_positive and len(alpha_deg) and alpha_deg.min() < 0:
            rule = f"is below 0, where the formula {self.formula} does not hold"
            fix = "choose the form cambered for both sides of a wing, or fit from 0 up (--alpha-min 0)"
            faults.add("alpha_deg", float(alpha_deg.min()), rule, fix)


@dataclass(frozen=True)
class BoxForm(CurveForm):
    """A formula of `wingbeat.aero`, possibly with fixed terms, with exact slopes and its own starts for a fit."""

    function: Callable[..., Any] = field(init=False)
    kind: Kind = FormulaTerms
    fixed: dict[str, float] = field(default_factory=dict)
    grids: dict[str, Array] = field(default_factory=dict)
    curve: str = "at"

    def __post_init__(self) -> None:
        def function(alpha_deg: Array, **parameters: float) -> Array:
            return value_and_slopes(any_terms(self.kind, self.fixed | parameters), alpha_deg, self.curve)[0]

        object.__setattr__(self, "function", function)
        super().__post_init__()

    def slopes(self, alpha_deg: Array, parameters: dict[str, float]) -> Array:
        """Return the derivatives with respect to the parameters, shape (n, parameters)."""
        return self.value_and_slopes(alpha_deg, parameters)[1]

    def value_and_slopes(self, alpha_deg: Array, parameters: dict[str, float]) -> tuple[Array, Array]:
        """Return `value` and `slopes`, shapes (n,) and (n, parameters), from one evaluation."""
        terms = any_terms(self.kind, self.fixed | parameters)
        value, slopes = value_and_slopes(terms, alpha_deg, self.curve)
        return value, np.column_stack([getattr(slopes, name) for name in self.names])

    def starts(self, alpha_deg: Array, values: Array, weight: Array) -> list[dict[str, float]]:
        """Return three starts: the best grid nodes of the non-linear terms, with linear terms by least squares."""
        found: list[tuple[float, dict[str, float]]] = []
        linear = [name for name in self.names if name not in self.grids and name != "phase_deg"]
        for node in product(*self.grids.values()):
            held = {name: float(at) for name, at in zip(self.grids, node, strict=True)}
            blank = dict.fromkeys(self.names, 0.0) | self.fixed | held
            _, slopes = value_and_slopes(any_terms(self.kind, blank), alpha_deg, self.curve)
            columns = {name: getattr(slopes, name) for name in linear}
            # A phase that is free makes the sine linear in two factors, those of a sine and of a cosine.
            if "phase_deg" in self.names:
                turned = any_terms(self.kind, blank | {"phase_deg": 90.0})
                columns["cosine"] = value_and_slopes(turned, alpha_deg)[1].amplitude
            basis = np.column_stack(list(columns.values()))
            factors = np.linalg.lstsq(basis * weight[:, None], values * weight)[0]
            left = (values - basis @ factors) * weight
            value = dict(zip(columns, factors.tolist(), strict=True)) | held
            if "cosine" in value:
                sine, cosine = value["amplitude"], value["cosine"]
                value["amplitude"] = math.hypot(sine, cosine)
                value["phase_deg"] = math.degrees(math.atan2(cosine, sine))
            found.append((float(left @ left), {name: value[name] for name in self.names}))
        found.sort(key=lambda pair: pair[0])
        return [start for _, start in found[:3]]
