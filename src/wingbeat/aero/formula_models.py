"""Coefficient models of formulas: one side of a plate, mirrored to every angle, and a cambered wing.

The formulas of a cambered wing hold between two joins; beyond them the coefficients are those of the plate of Su et
al. 2023. In a join they are the quintic polynomial that agrees with both in value, slope and curvature.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, NamedTuple

from wingbeat._base import FaultList
from wingbeat._jax.arrays import jnp, register_record
from wingbeat._jax.exported import exported
from wingbeat.aero.coefficient_model import CoefficientModel, Kernel, check_about, check_range
from wingbeat.aero.extension import Blend, ExtendedKernel, check_extension, extend, jet_of
from wingbeat.aero.formula_terms import CamberedCurves, CamberedTerms, CentreTerms, FormulaTerms, PowerLaw, Wave

if TYPE_CHECKING:
    from wingbeat._jax.arrays import Angles, Scalar


class FormulaPieces(NamedTuple):
    """The formulas in radians, as `wingbeat.aero.extension` takes them."""

    lift: Wave
    drag: Wave
    centre: PowerLaw


@register_record(
    static=("name", "citation", "doi", "grade", "reynolds_range", "alpha_range_deg", "extension", "aspect_ratio")
)
@dataclass(frozen=True)
class FormulaCoefficients(CoefficientModel):
    """Quasi-steady coefficients of a wing strip, from formulas fitted to one side of a wing.

    Parameters
    ----------
    name : name of the model.
    lift_terms, drag_terms : formulas of C_L and C_D.
    centre_terms : formula of the centre of pressure, or None.
    citation, doi : where the formulas come from; no DOI is None.
    grade : "A" if read in the source's own words, "B" if cited second-hand, "C" if in part a guess.
    reynolds_range : chord Reynolds numbers of the fit, or None.
    alpha_range_deg : lowest and highest angle of the fit [deg].
    extension : how the formulas are extended to all angles (`wingbeat.aero.extension`).
    blend_width_deg : half width of the blends where pieces meet [deg], in (0, 3].
    aspect_ratio : of the wing that was fitted [-], infinite for a section, None if not stated.

    Raises
    ------
    InvalidInputError : an unknown grade or extension, a bad width, range or aspect ratio, or a signed extension of
        a drag formula that has an exponential term.

    >>> plate = FormulaCoefficients("plate", FormulaTerms(0, 1.2, 2, 0), FormulaTerms(1.4, 1.0, 2, -90))
    >>> round(float(plate.lift(math.radians(45))), 3)
    1.2
    """

    name: str
    lift_terms: FormulaTerms
    drag_terms: FormulaTerms
    centre_terms: CentreTerms | None = None
    citation: str = ""
    doi: str | None = None
    grade: str = "A"
    reynolds_range: tuple[float, float] | None = None
    alpha_range_deg: tuple[float, float] = (0.0, 90.0)
    extension: str = "mirrored"
    blend_width_deg: float = 1.0
    aspect_ratio: float | None = None

    def __post_init__(self) -> None:
        faults = FaultList()
        check_about(faults, self, self.grade)
        check_range(faults, "alpha_range_deg", self.alpha_range_deg)
        check_extension(faults, self.extension, self.blend_width_deg)
        if self.extension in ("signed", "signed-drag") and self.drag_terms.decays:
            rule = "evaluates the drag formula at negative angles, where its exponential term diverges"
            faults.add("extension", self.extension, rule, "use mirrored")
        faults.raise_if_any()

    @property
    def has_centre_of_pressure(self) -> bool:
        """Whether the model has a centre of pressure."""
        return self.centre_terms is not None

    def kernel(self) -> ExtendedKernel:
        """Return the JAX pytree that evaluates this model; it is differentiable with respect to its parameters."""
        # Without a centre of pressure the pytree stays the same, and every value is NaN.
        centre = PowerLaw(math.nan, 0.0, 1.0, 0.0, 0.0)
        if self.centre_terms is not None:
            centre = self.centre_terms.in_radians()
        # The lift always carries its exponential, so that Su-Fan and Dickinson are one compiled function.
        lift = self.lift_terms.in_radians(with_decay=True)
        drag = self.drag_terms.in_radians(with_decay=self.drag_terms.decays)
        signed = ("drag",) if self.lift_terms.decays else ("lift", "drag")
        return extend(FormulaPieces(lift, drag, centre), self.blend_width_deg, self.extension, signed)


# The flat plate of Su et al. 2023 (`wingbeat.aero.SuFan`); beyond their stalls, cambered wings are this plate too.
PLATE = FormulaCoefficients(
    "su-fan",
    lift_terms=FormulaTerms(0.0, 1.19, 1.74, 20.0, decay_amplitude=-0.44, decay_rate=0.47),
    drag_terms=FormulaTerms(1.04, 1.0, 1.72, -70.0),
    centre_terms=CentreTerms(0.247, 0.016, 0.6, 0.026, 0.11),
    citation="Su, Fan, Onoue, Vejdani and Breuer 2023, arXiv 2302.09602",
    doi="10.48550/arXiv.2302.09602",
    reynolds_range=(2e4, 5e4),
    alpha_range_deg=(0.0, 110.0),
    aspect_ratio=6.0,
)


class Join(NamedTuple):
    """The blends of C_L and C_D between the curves of a wing and those of a plate, on either side."""

    centre: Scalar
    width: Scalar
    lift: Blend
    drag: Blend


class CamberedKernel(NamedTuple):
    """Coefficients at every angle in [-pi, pi], for use under JAX's jit, vmap and derivatives; a pytree."""

    curves: CamberedCurves
    plate: Kernel
    low: Join
    high: Join

    def lift_drag(self, alpha: Angles) -> tuple[Angles, Angles]:
        """Return C_L and C_D at `alpha` [rad], any shape. Theory: equation ``cambered-join``."""
        inside = (alpha > self.low.centre) & (alpha < self.high.centre)
        plate_lift, plate_drag = self.plate.lift_drag(alpha)
        lift = jnp.where(inside, self.curves.lift(alpha), plate_lift)
        drag = jnp.where(inside, self.curves.drag(alpha), plate_drag)
        for join in (self.low, self.high):
            distance = alpha - join.centre
            lift = join.lift.over(lift, distance, join.width)
            drag = join.drag.over(drag, distance, join.width)
        return lift, drag

    def centre_of_pressure(self, alpha: Angles) -> Angles:
        """Return not-a-number: no centre of pressure was fitted."""
        return jnp.full_like(alpha, math.nan)


@exported
def _joined(curves: CamberedCurves, plate: Kernel, joins: tuple[Any, ...]) -> CamberedKernel:
    """Return the kernel; `joins` are the lower and the upper end of the two blends [rad]."""
    (first, second), (third, fourth) = joins
    from_plate = [lambda a: plate.lift_drag(a)[0], lambda a: plate.lift_drag(a)[1]]
    of_wing = [curves.lift, curves.drag]

    def join(left: list[Any], start: Scalar, right: list[Any], end: Scalar) -> Join:
        width = 0.5 * (end - start)
        blends = (Blend.between(jet_of(a, start), jet_of(b, end), width) for a, b in zip(left, right, strict=True))
        return Join(0.5 * (start + end), width, *blends)

    low, high = join(from_plate, first, of_wing, second), join(of_wing, third, from_plate, fourth)
    return CamberedKernel(curves, plate, low, high)


@register_record(static=("name", "citation", "doi", "grade", "reynolds_range", "blend_width_deg", "aspect_ratio"))
@dataclass(frozen=True)
class CamberedCoefficients(CoefficientModel):
    """Quasi-steady coefficients of a cambered wing at every angle; beyond stall, those of a plate.

    The formulas cover both sides of the wing, so no extension is needed: `extension` is "signed". There is no
    centre of pressure.

    Parameters
    ----------
    name : name of the model.
    terms : the terms of its formulas.
    low_join_deg, high_join_deg : ends of the two joins, each (lower, upper) [deg]. Only the wing's formulas apply
        between the upper end of the first join and the lower end of the second.
    citation, doi : where the terms come from; no DOI is None.
    grade : "A" if read in the source's own words or fitted to its data, "B" if cited second-hand, "C" if in part a
        guess.
    reynolds_range : chord Reynolds numbers of the measurements, or None.
    blend_width_deg : half width of the blends of the plate [deg], in (0, 3].
    aspect_ratio : of the wing that has these coefficients [-], infinite for a section, None for a revolving wing.

    Raises
    ------
    InvalidInputError : an unknown grade, a bad width, range or aspect ratio, joins that do not rise from -90 to 90
        degrees about the angle of zero lift.

    >>> terms = CamberedTerms(-4.0, 4.0, -0.3, 1.4, 0.15, 0.02, 0.05, 4.0, 0.5, 20.0, 2.0, 3.0)
    >>> wing = CamberedCoefficients("wing", terms, (-45.0, -20.0), (25.0, 45.0))
    >>> round(float(wing.lift(math.radians(10.0))), 2), round(float(wing.lift(math.radians(-10.0))), 2)
    (0.97, -0.27)
    """

    name: str
    terms: CamberedTerms
    low_join_deg: tuple[float, float]
    high_join_deg: tuple[float, float]
    citation: str = ""
    doi: str | None = None
    grade: str = "A"
    reynolds_range: tuple[float, float] | None = None
    blend_width_deg: float = 1.0
    aspect_ratio: float | None = None

    extension = "signed"

    def __post_init__(self) -> None:
        faults = FaultList()
        check_about(faults, self, self.grade)
        check_extension(faults, self.extension, self.blend_width_deg)
        check_range(faults, "low_join_deg", self.low_join_deg)
        check_range(faults, "high_join_deg", self.high_join_deg)
        faults.raise_if_any()
        rising = (-90.0, *self.low_join_deg, self.terms.zero_lift_deg, *self.high_join_deg, 90.0)
        if any(first >= then for first, then in itertools.pairwise(rising)):
            joins = f"{self.low_join_deg}, {self.high_join_deg}"
            rule = "must increase, lie between -90 and 90 degrees, and enclose the zero-lift angle"
            faults.add("low_join_deg, high_join_deg", joins, rule, "give each as (lower, upper)")
        faults.raise_if_any()

    @property
    def alpha_range_deg(self) -> tuple[float, float]:  # type: ignore[override]
        """Lowest and highest angle at which only the wing's formulas apply [deg]."""
        return self.low_join_deg[1], self.high_join_deg[0]

    def kernel(self) -> CamberedKernel:
        """Return the JAX pytree that evaluates this model; it is differentiable with respect to its parameters."""
        radians = math.pi / 180
        joins = tuple((start * radians, end * radians) for start, end in (self.low_join_deg, self.high_join_deg))
        plate = replace(PLATE, blend_width_deg=self.blend_width_deg)
        return _joined(self.terms.in_radians(), plate.kernel(), joins)
