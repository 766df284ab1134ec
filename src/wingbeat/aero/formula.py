"""Coefficients as published formulas: a constant, a sine and an exponential of the angle of attack."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from wingbeat._base import FaultList
from wingbeat._jax.arrays import jnp, register_record, sin
from wingbeat.aero.coefficient_model import CoefficientModel, check_aspect_ratio, check_range
from wingbeat.aero.extension import ExtendedKernel, check_extension, extend

if TYPE_CHECKING:
    from wingbeat._jax.arrays import Angles, Scalar


_DEG = 180 / math.pi
# How far a model is to be trusted, and what its name then says.
GRADES = {"A": "", "B": ", cited second-hand", "C": ", in part a guess"}


class Wave(NamedTuple):
    """``constant + amplitude sin(rate a + phase) + decay_amplitude exp(-decay_rate a)``, a in radians.

    Theory: equation ``formula-terms``.
    """

    constant: Scalar
    amplitude: Scalar
    rate: Scalar
    phase: Scalar
    decay_amplitude: Scalar | None
    decay_rate: Scalar | None

    def __call__(self, alpha: Angles) -> Angles:
        """Return the coefficient at `alpha` [rad]; without an exponential term it is valid at any angle."""
        value = self.constant + self.amplitude * sin(self.rate * alpha + self.phase)
        if self.decay_amplitude is None or self.decay_rate is None:
            return value
        return value + self.decay_amplitude * jnp.exp(-self.decay_rate * alpha)


class PowerLaw(NamedTuple):
    """``constant + power_amplitude a^exponent + decay_amplitude a exp(-decay_rate a)``, a in radians > 0.

    Theory: equation ``formula-terms``.
    """

    constant: Scalar
    power_amplitude: Scalar
    exponent: Scalar
    decay_amplitude: Scalar
    decay_rate: Scalar

    def __call__(self, alpha: Angles) -> Angles:
        """Return the centre of pressure at `alpha` > 0 [rad]."""
        decay = self.decay_amplitude * alpha * jnp.exp(-self.decay_rate * alpha)
        return self.constant + self.power_amplitude * alpha**self.exponent + decay


# Replaces the centre of pressure in a model without one: the pytree stays the same, and every value is NaN.
_NO_CENTRE = PowerLaw(math.nan, 0.0, 1.0, 0.0, 0.0)


class FormulaPieces(NamedTuple):
    """The formulas in radians, as `wingbeat.aero.extension` takes them."""

    lift: Wave
    drag: Wave
    centre: PowerLaw


@register_record
@dataclass(frozen=True)
class FormulaTerms:
    """The terms of one coefficient, as published, with the angle a in degrees.

    ``constant + amplitude sin(rate a + phase_deg) + decay_amplitude exp(-decay_rate a)``

    Parameters
    ----------
    constant, amplitude : [-].
    rate : degrees of the sine's argument per degree of angle [-].
    phase_deg : [deg].
    decay_amplitude, decay_rate : of the exponential term [-, 1/deg]; without this term both are None, or the
        amplitude is 0.

    Raises
    ------
    InvalidInputError : numbers that are not finite, a negative decay rate, or only one of the decay terms.
    """

    constant: float
    amplitude: float
    rate: float
    phase_deg: float
    decay_amplitude: float | None = None
    decay_rate: float | None = None

    def __post_init__(self) -> None:
        faults = FaultList()
        for name in ("constant", "amplitude", "rate", "phase_deg"):
            faults.number(f"terms.{name}", getattr(self, name))
        if self.decay_amplitude is not None or self.decay_rate is not None:
            faults.number(
                "terms.decay_amplitude", self.decay_amplitude, fix="give decay_amplitude and decay_rate, or neither"
            )
            term = "decay_amplitude exp(-decay_rate a), with the angle of attack a in degrees"
            fix = f"give decay_amplitude and decay_rate, or neither; the term is {term}"
            faults.number("terms.decay_rate", self.decay_rate, at_least=0, unit="1/deg", fix=fix)
        faults.raise_if_any()
        if self.decay_amplitude == 0:
            object.__setattr__(self, "decay_amplitude", None)
            object.__setattr__(self, "decay_rate", None)

    @property
    def decays(self) -> bool:
        """Whether there is an exponential term, which is invalid at negative angles."""
        return self.decay_amplitude is not None

    def at(self, alpha_deg: Any) -> Any:
        """Return the coefficient at angles [deg] by the formula alone: no blend, no extension.

        Parameters
        ----------
        alpha_deg : angle of attack [deg], any shape.

        >>> round(float(FormulaTerms(constant=0.1, amplitude=2.0, rate=2.0, phase_deg=0.0).at(45.0)), 12)
        2.1
        """
        return self.in_radians(with_decay=self.decays)(alpha_deg / _DEG)

    def in_radians(self, *, with_decay: bool) -> Wave:
        """Return the same formula with the angle in radians.

        Parameters
        ----------
        with_decay : whether to add an exponential term of amplitude 0 where there is none.
        """
        decay_amplitude, decay_rate = self.decay_amplitude, self.decay_rate
        if decay_amplitude is None or decay_rate is None:
            decay_amplitude = decay_rate = 0.0 if with_decay else None
        else:
            decay_rate = decay_rate * _DEG
        return Wave(self.constant, self.amplitude, self.rate, self.phase_deg / _DEG, decay_amplitude, decay_rate)


@register_record
@dataclass(frozen=True)
class CentreTerms:
    """The terms of the centre of pressure, in chords from the leading edge, with the angle a in degrees.

    ``constant + power_amplitude a^exponent + decay_amplitude a exp(-decay_rate a)``

    Parameters
    ----------
    constant : in chords.
    power_amplitude : in chords.
    exponent : exponent of the angle, > 0.
    decay_amplitude : [1/deg].
    decay_rate : [1/deg], 0 or more.

    Raises
    ------
    InvalidInputError : numbers that are not finite, an exponent that is not positive, a negative decay rate.
    """

    constant: float
    power_amplitude: float
    exponent: float
    decay_amplitude: float
    decay_rate: float

    def __post_init__(self) -> None:
        faults = FaultList()
        for name in ("constant", "power_amplitude", "decay_amplitude"):
            faults.number(f"centre.{name}", getattr(self, name))
        faults.number("centre.exponent", self.exponent, above=0)
        faults.number("centre.decay_rate", self.decay_rate, at_least=0, unit="1/deg")
        faults.raise_if_any()

    def at(self, alpha_deg: Any) -> Any:
        """Return the centre of pressure at angles >= 0 [deg] by the formula alone: no blend, no extension.

        Parameters
        ----------
        alpha_deg : angle of attack, 0 or more [deg], any shape.

        >>> round(float(CentreTerms(0.2, 0.1, 0.5, decay_amplitude=0.0, decay_rate=0.0).at(4.0)), 12)
        0.4
        """
        return self.in_radians()(alpha_deg / _DEG)

    def in_radians(self) -> PowerLaw:
        """Return the same formula with the angle in radians."""
        power_amplitude = self.power_amplitude * _DEG**self.exponent
        return PowerLaw(
            self.constant, power_amplitude, self.exponent, self.decay_amplitude * _DEG, self.decay_rate * _DEG
        )


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
        check_aspect_ratio(faults, "aspect_ratio", self.aspect_ratio)
        faults.choice("grade", self.grade, tuple(GRADES))
        if self.reynolds_range is not None:
            check_range(faults, "reynolds_range", self.reynolds_range)
        check_range(faults, "alpha_range_deg", self.alpha_range_deg)
        check_extension(faults, self.extension, self.blend_width_deg)
        if self.extension in ("signed", "signed-drag") and self.drag_terms.decays:
            rule = "evaluates the drag formula at negative angles, where its exponential term diverges"
            faults.add("extension", self.extension, rule, "use mirrored")
        faults.raise_if_any()

    def __str__(self) -> str:
        return f"{self.name} ({self.citation or 'no source given'}{GRADES[self.grade]})"

    @property
    def has_centre_of_pressure(self) -> bool:
        """Whether the model has a centre of pressure."""
        return self.centre_terms is not None

    def kernel(self) -> ExtendedKernel:
        """Return the JAX pytree that evaluates this model; it is differentiable with respect to its parameters."""
        centre = self.centre_terms.in_radians() if self.centre_terms is not None else _NO_CENTRE
        # The lift always carries its exponential, so that Su-Fan and Dickinson are one compiled function.
        lift = self.lift_terms.in_radians(with_decay=True)
        drag = self.drag_terms.in_radians(with_decay=self.drag_terms.decays)
        signed = ("drag",) if self.lift_terms.decays else ("lift", "drag")
        return extend(FormulaPieces(lift, drag, centre), self.blend_width_deg, self.extension, signed)
