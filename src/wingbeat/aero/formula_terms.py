"""Formulas of coefficients: their terms as published, in degrees, and the curves that they define, in radians.

One side of a plate has a constant, a sine and an exponential for lift and drag, and powers for the centre of
pressure. A cambered wing, with ``u = slope (a - a_0)`` and ``ramp(x, w) = (x + sqrt(x^2 + w^2)) / 2``, has

``C_L = lowest + ramp(u - lowest, w) - ramp(u - highest, w)``

``C_D = least + induced C_L^2 + low_rise ramp(a_low - a, w_a) + high_rise ramp(a - a_high, w_a)``

Lift is a line between its lowest and its highest value. Drag has an induced part, and rises beyond two onsets,
where flow separates from the lower or from the upper side.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

from wingbeat._base import FaultList
from wingbeat._jax.arrays import jnp, register_record, sin

if TYPE_CHECKING:
    from wingbeat._jax.arrays import Angles, Scalar

_DEG = 180 / math.pi


class Wave(NamedTuple):
    """The formula of `FormulaTerms` with angles in radians. Theory: equation ``formula-terms``."""

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
    """The formula of `CentreTerms` with angles in radians. Theory: equation ``formula-terms``."""

    constant: Scalar
    power_amplitude: Scalar
    exponent: Scalar
    decay_amplitude: Scalar
    decay_rate: Scalar

    def __call__(self, alpha: Angles) -> Angles:
        """Return the centre of pressure at `alpha` > 0 [rad]."""
        decay = self.decay_amplitude * alpha * jnp.exp(-self.decay_rate * alpha)
        return self.constant + self.power_amplitude * alpha**self.exponent + decay


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
            fix = "give decay_amplitude and decay_rate, or neither"
            faults.number("terms.decay_amplitude", self.decay_amplitude, fix=fix)
            fix += "; the term is decay_amplitude exp(-decay_rate a), with the angle of attack a in degrees"
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
        """Return the same formula in radians.

        Parameters
        ----------
        with_decay : add an exponential term of amplitude 0 if it has none.
        """
        decay = (0.0, 0.0) if with_decay else (None, None)
        if self.decay_amplitude is not None and self.decay_rate is not None:
            decay = self.decay_amplitude, self.decay_rate * _DEG
        return Wave(self.constant, self.amplitude, self.rate, self.phase_deg / _DEG, *decay)


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
        decay = self.decay_amplitude * _DEG, self.decay_rate * _DEG
        return PowerLaw(self.constant, power_amplitude, self.exponent, *decay)


def _ramp(x: Angles, width: Scalar) -> Angles:
    """Return ``max(x, 0)`` with the corner rounded over about `width`. Theory: equation ``ramp``."""
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
        """Return C_L at `alpha` [rad]. Theory: equation ``cambered-lift``."""
        line = self.slope * (alpha - self.zero_lift)
        above, beyond = _ramp(line - self.lowest, self.rounding), _ramp(line - self.highest, self.rounding)
        return self.lowest + above - beyond

    def separation_drag(self, alpha: Angles) -> Angles:
        """Return the part of C_D at `alpha` [rad] that rises beyond the two onsets."""
        low = _ramp(self.low_onset - alpha, self.onset_rounding)
        high = _ramp(alpha - self.high_onset, self.onset_rounding)
        return self.low_rise * low + self.high_rise * high

    def drag(self, alpha: Angles) -> Angles:
        """Return C_D at `alpha` [rad]. Theory: equation ``cambered-drag``."""
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
        fix = "it is C_L beyond the stall at negative lift"
        faults.number("terms.lift_lowest", self.lift_lowest, below=0, fix=fix)
        for name in ("drag_induced", "low_rise", "high_rise"):
            faults.number(f"terms.{name}", getattr(self, name), at_least=0)
        low = faults.number("terms.low_onset_deg", self.low_onset_deg)
        high = faults.number("terms.high_onset_deg", self.high_onset_deg)
        if low and high and self.low_onset_deg >= self.high_onset_deg:
            faults.add("terms.low_onset_deg", self.low_onset_deg, "must be below high_onset_deg", "exchange them")
        faults.raise_if_any()

    def in_radians(self) -> CamberedCurves:
        """Return the formulas with their angles in radians."""
        radians = math.pi / 180
        zero = self.zero_lift_deg * radians
        lift = self.lift_slope, self.lift_lowest, self.lift_highest, self.lift_rounding
        low = zero + self.low_onset_deg * radians, self.low_rise
        high = zero + self.high_onset_deg * radians, self.high_rise
        rounding = self.onset_rounding_deg * radians
        return CamberedCurves(zero, *lift, self.drag_least, self.drag_induced, *low, *high, rounding)

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
