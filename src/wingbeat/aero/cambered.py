"""Coefficients of a cambered wing whose two sides differ: attached flow between two stalls, a plate beyond.

Here ``u = slope (a - a_0)``, and ``ramp(x, w) = (x + sqrt(x^2 + w^2)) / 2`` is 0 far below 0 and x far above 0:

``C_L = lowest + ramp(u - lowest, w) - ramp(u - highest, w)``

``C_D = least + induced C_L^2 + low_rise ramp(a_low - a, w_a) + high_rise ramp(a - a_high, w_a)``

Lift is a line between its lowest and its highest value. Drag is that of a wing with an induced part, and rises
beyond two onsets, where flow separates from the lower or from the upper side. These formulas hold between the two
joins; beyond them the coefficients are those of the plate of Su et al. 2023 (`SuFan`). In a join they are the
quintic polynomial that agrees with both in value, slope and curvature.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from wingbeat._base import FaultList
from wingbeat._jax.arrays import jnp, register_record
from wingbeat._jax.exported import exported
from wingbeat.aero.coefficient_model import CoefficientModel, Kernel, check_aspect_ratio, check_range
from wingbeat.aero.extension import Blend, check_extension, jet_of
from wingbeat.aero.formula import GRADES
from wingbeat.aero.published import SuFan

if TYPE_CHECKING:
    from wingbeat._jax.arrays import Angles, Scalar


def _ramp(x: Angles, width: Scalar) -> Angles:
    """Return ``max(x, 0)`` with the corner rounded over about `width`.

    Theory: equation ``ramp``.
    """
    return 0.5 * (x + jnp.sqrt(x * x + width * width))


class CamberedCurves(NamedTuple):
    """The formulas in radians, valid between the joins; a JAX pytree. The onsets are angles of attack."""

    zero_lift: Scalar
    slope: Scalar
    lowest: Scalar
    highest: Scalar
    rounding: Scalar
    least: Scalar
    induced: Scalar
    low_onset: Scalar
    low_rise: Scalar
    high_onset: Scalar
    high_rise: Scalar
    onset_rounding: Scalar

    def lift(self, alpha: Angles) -> Angles:
        """Return C_L at `alpha` [rad].

        Theory: equation ``cambered-lift``.
        """
        line = self.slope * (alpha - self.zero_lift)
        above, beyond = _ramp(line - self.lowest, self.rounding), _ramp(line - self.highest, self.rounding)
        return self.lowest + above - beyond

    def separation_drag(self, alpha: Angles) -> Angles:
        """Return the part of C_D at `alpha` [rad] that rises beyond the two onsets."""
        low = _ramp(self.low_onset - alpha, self.onset_rounding)
        high = _ramp(alpha - self.high_onset, self.onset_rounding)
        return self.low_rise * low + self.high_rise * high

    def drag(self, alpha: Angles) -> Angles:
        """Return C_D at `alpha` [rad].

        Theory: equation ``cambered-drag``.
        """
        lift = self.lift(alpha)
        return self.least + self.induced * lift * lift + self.separation_drag(alpha)


@register_record
@dataclass(frozen=True)
class CamberedTerms:
    """The terms of a cambered wing, with angles in degrees.

    Parameters
    ----------
    zero_lift_deg : angle of attack at which the line of lift is zero [deg].
    lift_slope : slope of lift in attached flow [1/rad].
    lift_lowest, lift_highest : constant C_L beyond the stall at negative and at positive lift [-].
    lift_rounding : width of the rounding where the line of lift meets each stall, in C_L [-].
    drag_least : C_D without lift or separated flow [-].
    drag_induced : C_D over C_L squared; an ideal wing of aspect ratio A has 1 / (pi A) [-].
    low_onset_deg, high_onset_deg : angles above zero lift where separated flow begins to add drag [deg].
    low_rise, high_rise : C_D that separated flow adds for each radian beyond its onset [1/rad].
    onset_rounding_deg : width of the rounding where separated flow begins to add drag [deg].

    Raises
    ------
    InvalidInputError : numbers that are not finite, a negative rise or induced part, a least drag, rounding or
        slope that is not positive, limits of lift of the wrong sign, onsets in the wrong order.
    """

    zero_lift_deg: float
    lift_slope: float
    lift_lowest: float
    lift_highest: float
    lift_rounding: float
    drag_least: float
    drag_induced: float
    low_onset_deg: float
    low_rise: float
    high_onset_deg: float
    high_rise: float
    onset_rounding_deg: float

    def __post_init__(self) -> None:
        faults = FaultList()
        faults.number("terms.zero_lift_deg", self.zero_lift_deg, above=-45, below=45, unit="deg")
        for name in ("lift_slope", "lift_rounding", "lift_highest", "onset_rounding_deg", "drag_least"):
            faults.number(f"terms.{name}", getattr(self, name), above=0)
        faults.number(
            "terms.lift_lowest", self.lift_lowest, below=0, fix="it is C_L beyond the stall at negative lift"
        )
        for name in ("drag_induced", "low_rise", "high_rise"):
            faults.number(f"terms.{name}", getattr(self, name), at_least=0)
        onsets = [
            faults.number(f"terms.{name}", getattr(self, name)) for name in ("low_onset_deg", "high_onset_deg")
        ]
        if all(onsets) and self.low_onset_deg >= self.high_onset_deg:
            faults.add("terms.low_onset_deg", self.low_onset_deg, "must be below high_onset_deg", "exchange them")
        faults.raise_if_any()

    def in_radians(self) -> CamberedCurves:
        """Return the formulas with their angles in radians."""
        radians = math.pi / 180
        zero = self.zero_lift_deg * radians
        return CamberedCurves(
            zero_lift=zero,
            slope=self.lift_slope,
            lowest=self.lift_lowest,
            highest=self.lift_highest,
            rounding=self.lift_rounding,
            least=self.drag_least,
            induced=self.drag_induced,
            low_onset=zero + self.low_onset_deg * radians,
            low_rise=self.low_rise,
            high_onset=zero + self.high_onset_deg * radians,
            high_rise=self.high_rise,
            onset_rounding=self.onset_rounding_deg * radians,
        )

    def lift_at(self, alpha_deg: Any) -> Any:
        """Return C_L at angles [deg] by the formula alone: no join, no plate.

        Parameters
        ----------
        alpha_deg : angle of attack [deg], any shape.

        >>> terms = CamberedTerms(-4.0, 4.0, -0.3, 1.4, 0.15, 0.02, 0.05, 4.0, 0.5, 20.0, 2.0, 3.0)
        >>> round(float(terms.lift_at(10.0)), 2), round(float(terms.drag_at(10.0)), 3)
        (0.97, 0.081)
        """
        return self.in_radians().lift(alpha_deg * (math.pi / 180))

    def drag_at(self, alpha_deg: Any) -> Any:
        """Return C_D at angles [deg] by the formula alone: no join, no plate.

        Parameters
        ----------
        alpha_deg : angle of attack [deg], any shape.
        """
        return self.in_radians().drag(alpha_deg * (math.pi / 180))


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
        """Return C_L and C_D at `alpha` [rad], any shape.

        Theory: equation ``cambered-join``.
        """
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
        blends = [
            Blend.between(jet_of(one, start), jet_of(other, end), width)
            for one, other in zip(left, right, strict=True)
        ]
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
        check_aspect_ratio(faults, "aspect_ratio", self.aspect_ratio)
        faults.choice("grade", self.grade, tuple(GRADES))
        if self.reynolds_range is not None:
            check_range(faults, "reynolds_range", self.reynolds_range)
        check_extension(faults, self.extension, self.blend_width_deg)
        for name in ("low_join_deg", "high_join_deg"):
            check_range(faults, name, getattr(self, name))
        faults.raise_if_any()
        rising = (-90.0, *self.low_join_deg, self.terms.zero_lift_deg, *self.high_join_deg, 90.0)
        if any(first >= then for first, then in itertools.pairwise(rising)):
            joins = f"{self.low_join_deg}, {self.high_join_deg}"
            rule = "must increase, lie between -90 and 90 degrees, and enclose the zero-lift angle"
            faults.add("low_join_deg, high_join_deg", joins, rule, "give each as (lower, upper)")
        faults.raise_if_any()

    def __str__(self) -> str:
        return f"{self.name} ({self.citation or 'no source given'}{GRADES[self.grade]})"

    @property
    def alpha_range_deg(self) -> tuple[float, float]:  # type: ignore[override]
        """Lowest and highest angle at which only the wing's formulas apply [deg]."""
        return self.low_join_deg[1], self.high_join_deg[0]

    @property
    def has_centre_of_pressure(self) -> bool:
        """Whether the model has a centre of pressure: it has none."""
        return False

    def kernel(self) -> CamberedKernel:
        """Return the JAX pytree that evaluates this model; it is differentiable with respect to its parameters."""
        radians = math.pi / 180
        joins = tuple((start * radians, end * radians) for start, end in (self.low_join_deg, self.high_join_deg))
        return _joined(self.terms.in_radians(), SuFan(blend_width_deg=self.blend_width_deg).kernel(), joins)
