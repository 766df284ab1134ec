"""The curves that measurements are fitted to: a formula, its parameters, and where a fit should begin.

The two sides of a cambered wing differ: lift is fitted first, then drag, which depends on the lift. The formulas
are those of `wingbeat.aero.CamberedTerms`. The widths of the bends in lift and drag are fixed, because the data of
a single wing do not determine them.
"""

from __future__ import annotations

import dataclasses
import functools
import inspect
import math
from collections.abc import Callable
from dataclasses import dataclass, field
from itertools import product
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from wingbeat._base import FaultList
from wingbeat._jax.arrays import jax, unchecked
from wingbeat.aero.coefficient_model import at_angles
from wingbeat.aero.formula_terms import CamberedTerms, CentreTerms, FormulaTerms
from wingbeat.aero.library import WING_ESTIMATES

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
    """Return a formula of `wingbeat.aero` at angles [deg], and its derivatives in a record like `terms`."""
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


# --- the forms of a wing: a curve for each of lift, drag and centre of pressure ---

# Angles beyond which lift falls off, as that of a plate does; the form has constant lift beyond its stalls.
FARTHEST_DEG = 60.0
# Least number of different angles on each side of zero lift: two for the line, one for its end.
LEAST_ANGLES = 3
# Values to try for each non-linear term, to find where a fit begins.
_NODES = 8
_SLOPES = (2.0, 3.5, 5.0, 6.5)
# Least distance between the two onsets, so that they cannot change places [deg].
_GAP_DEG = 0.1
BENDS = {name: WING_ESTIMATES["feathered"][name].value for name in ("lift_rounding", "onset_rounding_deg")}
_LIFT = {"zero_lift_deg": -3.0, "lift_slope": 4.0, "lift_lowest": -0.5, "lift_highest": 1.4}
_DRAG = {"drag_least": 0.03, "drag_induced": 0.05, "low_onset_deg": -5.0, "low_rise": 0.5}
_DRAG |= {"high_onset_deg": 15.0, "high_rise": 1.0}


@dataclass(frozen=True)
class LiftForm(BoxForm):
    """The lift of a cambered wing, up to its two stalls; the measurements must show both sides of zero lift."""

    def check(self, faults: FaultList, alpha_deg: Array, values: Array, label: str) -> None:
        """Note a fault if angles are too large, or if one side of the wing is not known."""
        low, high = float(alpha_deg.min()), float(alpha_deg.max())
        if max(-low, high) > FARTHEST_DEG:
            rule = f"reaches beyond {FARTHEST_DEG:g} degrees, where the form cambered does not hold"
            rows = f"leave out the rows beyond {FARTHEST_DEG:g} degrees, positive or negative"
            fix = f"{rows} (--alpha-min -{FARTHEST_DEG:g} --alpha-max {FARTHEST_DEG:g})"
            faults.add("alpha_deg", f"{low:g} to {high:g}", f"{rule}: there the model is a plate", fix)
        for side, words, where in ((-1, "negative", "below"), (1, "positive", "above")):
            count = len(np.unique(np.round(alpha_deg[side * values > 0], 6)))
            if count >= LEAST_ANGLES:
                continue
            rule = f"is {words} at {count or 'none'} of the angles between {low:g} and {high:g} degrees"
            few = ", too few to fit that side of the wing"
            rule += few if count else ", so the table shows one side of the wing only"
            fix = f"measure {LEAST_ANGLES} angles or more {where} zero lift, or choose a mirrored form (dickinson)"
            faults.add(label, f"{values.min():g} to {values.max():g}", rule, fix)

    def starts(self, alpha_deg: Array, values: Array, weight: Array) -> list[dict[str, float]]:
        """Return the three best nodes of a grid of zero-lift angles and slopes, and the extremes of the data."""
        ends = {"lift_lowest": float(values.min()), "lift_highest": float(values.max())}
        zeros = np.linspace(np.median(alpha_deg[values < 0]), np.median(alpha_deg[values > 0]), _NODES)
        nodes = product(zeros, _SLOPES)
        found = [{"zero_lift_deg": float(zero), "lift_slope": slope} | ends for zero, slope in nodes]
        left = [(self.value(alpha_deg, one) - values) * weight for one in found]
        best = np.argsort([float(one @ one) for one in left], kind="stable")
        return [found[i] for i in best[:3]]


@dataclass(frozen=True)
class DragForm(BoxForm):
    """The drag of a cambered wing; its induced part and its onsets depend on lift, which `beside` sets."""

    def beside(self, terms: dict[str, float], alpha_deg: Array) -> DragForm:
        """Return the form for fitted terms of lift, which with their angles also set the ranges of the onsets."""
        zero = terms["zero_lift_deg"]
        middle = math.degrees(0.5 * (terms["lift_lowest"] + terms["lift_highest"]) / terms["lift_slope"])
        low, high = float(alpha_deg.min()) - zero, float(alpha_deg.max()) - zero
        # Below the middle of the line of lift, flow separates from the lower side; above it, from the upper side.
        middle = float(np.clip(middle, low + 1.0, high - 1.0))
        gap = 0.5 * _GAP_DEG
        onsets = {"low_onset_deg": (low, middle - gap), "high_onset_deg": (middle + gap, high)}
        return dataclasses.replace(
            self,
            lowest=self.lowest | {name: ends[0] for name, ends in onsets.items()},
            highest=self.highest | {name: ends[1] for name, ends in onsets.items()},
            fixed=self.fixed | terms,
            grids={name: np.linspace(*ends, _NODES) for name, ends in onsets.items()},
        )


_LIFT_HELD = {"lift_rounding": BENDS["lift_rounding"]} | dict.fromkeys(_DRAG, 0.0) | {"onset_rounding_deg": 1.0}
CAMBERED_LIFT = LiftForm(
    "lowest + ramp(slope (a - zero_lift) - lowest) - ramp(slope (a - zero_lift) - highest)",
    _LIFT,
    lowest={"zero_lift_deg": -40.0, "lift_slope": 0.5, "lift_lowest": -3.0, "lift_highest": 0.02},
    highest={"zero_lift_deg": 40.0, "lift_slope": 12.0, "lift_lowest": -0.02, "lift_highest": 4.0},
    kind=CamberedTerms,
    fixed=_LIFT_HELD,
    curve="lift_at",
)
CAMBERED_DRAG = DragForm(
    "least + induced C_L^2 + low_rise ramp(low_onset - a) + high_rise ramp(a - high_onset)",
    _DRAG,
    lowest={"drag_least": 1e-4, "drag_induced": 0.0, "low_rise": 0.0, "high_rise": 0.0},
    highest={"drag_least": 1.0, "drag_induced": 1.0, "low_rise": 10.0, "high_rise": 10.0},
    kind=CamberedTerms,
    fixed=BENDS | _LIFT,
    curve="drag_at",
)
# A grid of a term in which formulas are not linear; the others follow from linear least squares at each node.
_RATES = np.concatenate([np.geomspace(0.3, 3.0, 12), [3.6, 4.5]])


def _wave_form(formula: str, free: list[str], fixed: dict[str, float], **grids: Array) -> BoxForm:
    decays = "decay_rate" in free
    return BoxForm(
        formula,
        dict.fromkeys(free, 1.0),
        lowest={"decay_rate": 0.0} if decays else {},
        highest={"decay_rate": 20.0} if decays else {},
        only_positive=decays,
        fixed=fixed,
        grids=grids,
    )


_SINE = ["constant", "amplitude", "rate", "phase_deg"]
_SINE_FORM = _wave_form("constant + amplitude sin(rate a + phase)", _SINE, {}, rate=_RATES)
_CENTRE = BoxForm(
    "constant + power_amplitude a^exponent + decay_amplitude a exp(-decay_rate a)",
    dict.fromkeys(["constant", "power_amplitude", "exponent", "decay_amplitude", "decay_rate"], 1.0),
    lowest={"exponent": 1e-3, "decay_rate": 0.0},
    highest={"exponent": 5.0, "decay_rate": 5.0},
    only_positive=True,
    kind=CentreTerms,
    grids={"exponent": np.linspace(0.2, 2.0, 10), "decay_rate": np.geomspace(0.02, 0.6, 10)},
)


class WingForm(NamedTuple):
    """The curves that are fitted to a wing.

    Attributes
    ----------
    name : of the form.
    lift, drag : curves of C_L and C_D.
    centre : curve of the centre of pressure, or None.
    """

    name: str
    lift: CurveForm
    drag: CurveForm
    centre: CurveForm | None = None


FORMS: dict[str, WingForm] = {
    "su-fan": WingForm(
        "su-fan",
        _wave_form(
            "amplitude sin(rate a + phase) + decay_amplitude exp(-decay_rate a)",
            ["decay_amplitude", "decay_rate", "amplitude", "rate", "phase_deg"],
            {"constant": 0.0},
            rate=_RATES,
            decay_rate=np.geomspace(0.02, 2.0, 10),
        ),
        _SINE_FORM,
        _CENTRE,
    ),
    "dickinson": WingForm("dickinson", _SINE_FORM, _SINE_FORM, _CENTRE),
    "sine-cosine": WingForm(
        "sine-cosine",
        _wave_form("amplitude sin 2a", ["amplitude"], {"constant": 0.0, "rate": 2.0, "phase_deg": 0.0}),
        _wave_form("constant - amplitude cos 2a", ["constant", "amplitude"], {"rate": 2.0, "phase_deg": -90.0}),
        _CENTRE,
    ),
    "cambered": WingForm("cambered", CAMBERED_LIFT, CAMBERED_DRAG),
}
