"""Weighted least squares of one curve, with measures of how far to trust it; and of drag beside its fitted lift."""

from __future__ import annotations

import dataclasses
import functools
import math
import warnings
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from wingbeat._base import Fault, FaultList, InvalidInputError
from wingbeat.experiment.curve_forms import BENDS, Array, CurveForm, DragForm, any_terms, value_and_slopes

# Above this condition number, the scaled Jacobian loses half of its digits.
ILL_CONDITIONED = 1e4
# Parts of drag that a wing may not have, such as a section without induced drag: 0 is a value like others.
_MAY_VANISH = ("drag_induced", "low_rise", "high_rise")


class FitRangeWarning(UserWarning):
    """A fitted curve was evaluated outside the angles it was fitted to."""


@dataclass(frozen=True)
class CurveFit:
    """A curve fitted to measurements; made by `fit_curve`.

    The covariance is ``s^2 (J^T W J)^-1`` with ``s^2 = chi^2/(n - p)``. It therefore grows if the data scatter more
    than the given standard errors, or if the form does not fit.

    Attributes
    ----------
    label : name of the quantity.
    form : the curve.
    parameters : fitted values by name.
    covariance : of the parameters, in that order, shape (p, p).
    condition : condition number of the scaled Jacobian; large if parameters cannot be separated.
    alpha_deg, values : the measurements, shape (n,) [deg].
    sigma : their standard errors, shape (n,); all 1 if none were given.
    weighted : whether errors were given.
    notes : notes for the reader.
    """

    label: str
    form: CurveForm
    parameters: dict[str, float]
    covariance: Array
    condition: float
    alpha_deg: Array
    values: Array
    sigma: Array
    weighted: bool
    notes: tuple[str, ...]

    @property
    def freedom(self) -> int:
        """Degrees of freedom: points minus parameters."""
        return len(self.values) - len(self.parameters)

    @property
    def residuals(self) -> Array:
        """Measured minus fitted values, shape (n,)."""
        return self.values - self.form.value(self.alpha_deg, self.parameters)

    @property
    def chi_squared(self) -> float:
        """Sum of squares of residuals over their standard errors."""
        return self._misfit(self.parameters)

    @property
    def r_squared(self) -> float:
        """``R^2 = 1 - sum r^2 / sum (y - mean y)^2``, unweighted, as in the paper; NaN for constant data."""
        total = float(((self.values - self.values.mean()) ** 2).sum())
        return 1.0 - float((self.residuals**2).sum()) / total if total > 0 else math.nan

    @property
    def aicc(self) -> float:
        """Akaike's criterion for small samples; of two forms fitted to the same data, the lower value is better.

        ``n ln(chi^2/n) + 2k + 2k(k+1)/(n-k-1)``, where k counts the parameters and the variance: Hurvich and Tsai
        1989, doi 10.1093/biomet/76.2.297. NaN unless n > k + 1; -inf for a perfect fit.
        """
        n, k = len(self.values), len(self.parameters) + 1
        if n - k - 1 <= 0:
            return math.nan
        misfit = self.chi_squared
        likelihood = n * math.log(misfit / n) if misfit > 0 else -math.inf
        return likelihood + 2 * k + 2 * k * (k + 1) / (n - k - 1)

    @property
    def standard_errors(self) -> dict[str, float]:
        """Standard error of each parameter."""
        return dict(zip(self.parameters, np.sqrt(np.diag(self.covariance)).tolist(), strict=True))

    def interval(self, confidence: float = 0.95) -> dict[str, tuple[float, float]]:
        """Return the confidence interval of each parameter by Student's t, to first order in the parameters.

        Parameters
        ----------
        confidence : between 0 and 1.

        Raises
        ------
        InvalidInputError : a confidence not between 0 and 1.
        """
        from scipy.stats import t

        _check_confidence(confidence)
        reach = float(t.ppf(0.5 + 0.5 * confidence, self.freedom))
        errors = self.standard_errors
        return {n: (v - reach * errors[n], v + reach * errors[n]) for n, v in self.parameters.items()}

    def covers(self, parameters: dict[str, float], confidence: float = 0.95) -> bool:
        """Return whether parameters lie in the joint confidence region of all of them.

        The region is ``chi^2(p) <= chi^2_min (1 + p/(n-p) F)`` (Beale 1960, J. R. Stat. Soc. B 22:41). It stays
        valid for strongly correlated parameters, where the ellipse of the covariance is wrong.

        Parameters
        ----------
        parameters : by name.
        confidence : between 0 and 1.

        Raises
        ------
        InvalidInputError : other names than those of the fit, a confidence not between 0 and 1.
        """
        from scipy.stats import f

        _check_confidence(confidence)
        if set(parameters) != set(self.parameters):
            fix = f"give {', '.join(self.parameters)}"
            raise InvalidInputError([Fault("parameters", ", ".join(parameters), "are not those of the fit", fix)])
        count = len(self.parameters)
        room = 1.0 + count / self.freedom * float(f.ppf(confidence, count, self.freedom))
        return self._misfit(parameters) <= self.chi_squared * room

    def predict(self, alpha_deg: ArrayLike) -> Array:
        """Return the curve at given angles, shape (n,).

        Angles outside those of the fit cause a `FitRangeWarning`.

        Parameters
        ----------
        alpha_deg : angles of attack [deg], shape (n,).
        """
        a = np.atleast_1d(np.asarray(alpha_deg, dtype=np.float64))
        low, high = float(self.alpha_deg.min()), float(self.alpha_deg.max())
        if a.min() < low - 1e-9 or a.max() > high + 1e-9:
            text = f"{self.label} was fitted from {low:g} to {high:g} degrees and is used outside that range"
            warnings.warn(text, FitRangeWarning, stacklevel=2)
        return self.form.value(a, self.parameters)

    def band(self, alpha_deg: ArrayLike, confidence: float = 0.95, *, of_mean: bool = False) -> Array:
        """Return the half width of the confidence band about the curve, shape (n,).

        Parameters
        ----------
        alpha_deg : angles of attack [deg], shape (n,).
        confidence : between 0 and 1.
        of_mean : True for the band of the curve itself, False for the band of a new measurement of the same
            precision.

        Raises
        ------
        InvalidInputError : a confidence not between 0 and 1.
        """
        from scipy.stats import t

        _check_confidence(confidence)
        a = np.atleast_1d(np.asarray(alpha_deg, dtype=np.float64))
        variance = self.curve_variance(a)
        if not of_mean:
            angles, place = np.unique(np.round(self.alpha_deg, 6), return_inverse=True)
            there = np.bincount(place, self.sigma**2) / np.bincount(place)
            variance = variance + np.interp(a, angles, there) * self.chi_squared / self.freedom
        return float(t.ppf(0.5 + 0.5 * confidence, self.freedom)) * np.sqrt(np.maximum(variance, 0.0))

    def curve_variance(self, alpha_deg: Array) -> Array:
        """Return the variance of the curve itself, to first order in the parameters, shape (n,).

        Parameters
        ----------
        alpha_deg : angles of attack [deg], shape (n,).
        """
        slopes = self.form.slopes(alpha_deg, self.parameters)
        return np.einsum("ij,jk,ik->i", slopes, self.covariance, slopes)

    def _misfit(self, parameters: dict[str, float]) -> float:
        scaled = (self.values - self.form.value(self.alpha_deg, parameters)) / self.sigma
        return float(scaled @ scaled)


def _check_confidence(confidence: float) -> None:
    faults = FaultList()
    faults.number("confidence", confidence, above=0, below=1, fix="95 % is 0.95")
    faults.raise_if_any()


def fit_curve(
    alpha_deg: ArrayLike, values: ArrayLike, form: CurveForm, sigma: ArrayLike | None = None, label: str = "curve"
) -> CurveFit:
    """Fit a curve to measurements by weighted least squares.

    Parameters
    ----------
    alpha_deg, values : angles [deg] and the values measured there, shape (n,).
    form : the curve.
    sigma : standard error of each measurement, shape (n,); None gives all measurements equal weight.
    label : name of the quantity in messages.

    Raises
    ------
    InvalidInputError : columns of different length or not finite; fewer than p + 2 points or p different angles for
        p parameters; errors that are not positive; negative angles with a form that is invalid there; a form of the
        user's own whose values are not finite.

    >>> a = np.arange(0.0, 91.0, 10.0)
    >>> line = CurveForm("m a + b", lambda a, m, b: m * a + b, {"m": 0.0, "b": 0.0})
    >>> {name: round(value, 9) for name, value in fit_curve(a, 2 * a + 1, line).parameters.items()}
    {'m': 2.0, 'b': 1.0}
    """
    a, y = np.asarray(alpha_deg, dtype=np.float64), np.asarray(values, dtype=np.float64)
    errors = np.ones_like(y) if sigma is None else np.asarray(sigma, dtype=np.float64)
    _check_data(a, y, errors, form, label)
    best = _least_squares(a, y, errors, form, label)
    parameters = dict(zip(form.names, best.x.tolist(), strict=True))
    if "phase_deg" in parameters and "amplitude" in parameters:
        # The same sine with a positive amplitude and a phase within half a turn.
        if parameters["amplitude"] < 0:
            parameters["amplitude"] *= -1.0
            parameters["phase_deg"] += 180.0
        parameters["phase_deg"] = (parameters["phase_deg"] + 180.0) % 360.0 - 180.0
    slopes = form.slopes(a, parameters) / errors[:, None]
    sizes = np.linalg.norm(slopes, axis=0)
    sizes = np.where(sizes > 0, sizes, 1.0)
    # By singular values of the scaled slopes: the normal matrix would square the condition number.
    _, singular, right = np.linalg.svd(slopes / sizes, full_matrices=False)
    floor = max(float(singular[0]), 1e-300) * np.finfo(float).eps
    inverse = right.T / np.maximum(singular, floor)
    condition = float(singular[0] / max(float(singular[-1]), floor))
    left = (y - form.value(a, parameters)) / errors
    covariance = (inverse @ inverse.T) / np.outer(sizes, sizes) * float(left @ left) / (len(y) - len(parameters))
    found = CurveFit(label, form, parameters, covariance, condition, a, y, errors, sigma is not None, ())
    return dataclasses.replace(found, notes=distrust(found))


def _check_data(a: Array, y: Array, errors: Array, form: CurveForm, label: str) -> None:
    if not a.shape == y.shape == errors.shape or a.ndim != 1:
        rule = "angles, values and errors must be lists of equal length"
        raise InvalidInputError([Fault(label, f"{a.shape}, {y.shape}, {errors.shape}", rule)])
    faults = FaultList()
    for name, column in (("alpha_deg", a), (label, y), (f"{label}_se", errors)):
        faults.first(name, column, ~np.isfinite(column), "must be finite", "drop the row")
    fix = "give every row its standard error, or leave the column out"
    faults.first(f"{label}_se", errors, errors <= 0, "must be > 0: it sets the weight of the row", fix)
    count, angles = len(form.names), len(np.unique(np.round(a, 6)))
    if len(y) < count + 2:
        rule = f"are too few for the {count} parameters of {form.formula}"
        faults.add(label, f"{len(y)} points", rule, f"measure at least {count + 2}, or choose a simpler form")
    elif angles < count:
        rule = f"are too few to tell {count} parameters apart"
        faults.add(label, f"{angles} angles", rule, f"measure at {count} angles or more")
    if len(y):
        form.check(faults, a, y, label)
    faults.raise_if_any()


def _least_squares(a: Array, y: Array, errors: Array, form: CurveForm, label: str) -> Any:
    """Return the best result of the fits from each of the form's starts."""
    from scipy.optimize import least_squares

    names = form.names
    bounds = [form.lowest.get(n, -math.inf) for n in names], [form.highest.get(n, math.inf) for n in names]

    # SciPy asks for slopes where it has just asked for the value; one evaluation gives both.
    @functools.lru_cache(maxsize=1)
    def misfit(x: bytes) -> tuple[Array, Array]:
        value, slopes = form.value_and_slopes(a, dict(zip(names, np.frombuffer(x).tolist(), strict=True)))
        return (value - y) / errors, slopes / errors[:, None]

    options: Any = {"jac": lambda x: misfit(x.tobytes())[1], "bounds": bounds, "x_scale": "jac", "max_nfev": 400}
    options |= {"ftol": 1e-12, "xtol": 1e-12, "gtol": 1e-12}
    best: Any = None
    for start in form.starts(a, y, 1.0 / errors):
        x = np.clip([start[name] for name in names], *bounds)
        if not all(np.isfinite(part).all() for part in misfit(x.tobytes())):
            rule = "gives no finite numbers at its starting values"
            raise InvalidInputError([Fault(label, form.formula, rule, "change these")])
        found = least_squares(lambda x: misfit(x.tobytes())[0], x, **options)
        if best is None or found.cost < best.cost:
            best = found
    return best


def distrust(fit: CurveFit) -> tuple[str, ...]:
    """Return notes that name the parameters that the data do not determine."""
    notes = []
    determined = {n: v for n, v in fit.parameters.items() if n not in _MAY_VANISH or v > 1e-9}
    for name, value in determined.items():
        ends = fit.form.lowest.get(name, -math.inf), fit.form.highest.get(name, math.inf)
        if any(math.isclose(value, end, abs_tol=1e-9) for end in ends):
            notes.append(f"{fit.label}: {name} reached its limit in the fit, {value:g}; choose another form")
    # The largest meaningful half width of an interval is in general the parameter's own size. Two may be 0: the
    # angle of zero lift, which shifts the line, and a constant, known well if it is small beside the curve.
    limits, least = fit.interval(), {"zero_lift_deg": 5.0, "constant": float(np.ptp(fit.values))}
    room = {n: 45.0 if n == "phase_deg" else max(abs(v), least.get(n, 1e-12)) for n, v in determined.items()}
    loose = [name for name, value in determined.items() if limits[name][1] - value > room[name]]
    if loose:
        text = f"{fit.label}: too uncertain to be meaningful: {', '.join(loose)}"
        notes.append(f"{text}; the data do not determine this form; use the curve only where it was measured")
    if fit.condition > ILL_CONDITIONED:
        notes.append(
            f"{fit.label}: ill-conditioned (condition number {fit.condition:.1e}): the data do not separate the "
            "parameters; measure over more angles, or choose a form with fewer parameters"
        )
    return tuple(notes)


# --- a cambered wing ---


def stall_notes(lift: CurveFit) -> tuple[str, ...]:
    """Return notes on the sides whose stall the measurements of lift do not reach."""
    terms, notes = lift.parameters, []
    for angle, end, side in ((lift.alpha_deg.min(), "lift_lowest", -1), (lift.alpha_deg.max(), "lift_highest", 1)):
        line = terms["lift_slope"] * math.radians(float(angle) - terms["zero_lift_deg"])
        if side * (line - terms[end]) < 2 * BENDS["lift_rounding"]:
            notes.append(
                f"{lift.label}: at {angle:g} degrees, where the measurements end, lift has not levelled off; "
                f"{end} depends on the assumed form, so measure farther on that side"
            )
    return tuple(notes)


@dataclass(frozen=True)
class DragFit(CurveFit):
    """A fit of drag that depends on fitted lift; `covariance` includes the uncertainty of the lift.

    `joint` is the covariance of the parameters in `joint_names`: those of lift, then those of drag.
    """

    joint_names: tuple[str, ...]
    joint: Array

    def curve_variance(self, alpha_deg: Array) -> Array:
        """Return the variance of the curve itself, to first order in the parameters of lift and drag."""
        slopes = _slopes(self, alpha_deg, self.joint_names)
        return np.einsum("ij,jk,ik->i", slopes, self.joint, slopes)


def _slopes(fit: CurveFit, alpha_deg: Array, names: tuple[str, ...]) -> Array:
    """Return the derivatives of a fitted drag with respect to terms of lift and drag, shape (n, names)."""
    assert isinstance(fit.form, DragForm)
    terms = any_terms(fit.form.kind, fit.form.fixed | fit.parameters)
    slopes = value_and_slopes(terms, alpha_deg, fit.form.curve)[1]
    return np.column_stack([getattr(slopes, name) for name in names])


def fit_drag(form: DragForm, lift: CurveFit, values: Array, sigma: Array | None, copies: int = 1) -> DragFit:
    """Fit the drag of a cambered wing at its fitted lift, with a covariance that includes the uncertainty of lift.

    If the terms of lift change by ``d``, those of drag follow by ``G d``, ``G = -(J^T W J)^-1 J^T W L``, where J
    and L are the derivatives of drag with respect to its own terms and to those of lift. So if the errors of lift
    and drag are independent, the covariance of all terms is ``[[V_l, V_l G^T], [G V_l, V_d + G V_l G^T]]``: Murphy
    and Topel 1985, J. Bus. Econ. Stat. 3:370. Each measurement is `copies` times among the values: 2 if half of
    them are a mirror image.
    """
    drag = fit_curve(lift.alpha_deg, values, form.beside(lift.parameters, lift.alpha_deg), sigma, "C_D")
    own, other = tuple(drag.parameters), tuple(lift.parameters)
    weighted = _slopes(drag, drag.alpha_deg, (*own, *other)) / drag.sigma[:, None]
    sizes = np.maximum(np.linalg.norm(weighted, axis=0), 1e-300)
    scaled = weighted / sizes
    follow = -np.linalg.lstsq(scaled[:, : len(own)], scaled[:, len(own) :])[0]
    follow *= sizes[len(own) :] / sizes[: len(own), None]
    cross = follow @ lift.covariance
    marginal = copies * drag.covariance + cross @ follow.T
    joint = np.block([[lift.covariance, cross.T], [cross, marginal]])
    found = DragFit(**vars(drag) | {"covariance": marginal}, joint_names=(*other, *own), joint=joint)
    return dataclasses.replace(found, notes=distrust(found))
