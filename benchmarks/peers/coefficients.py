"""C_L and C_D at every angle, mirrored and blended, for any array library: model.md 4 written a second time.

The published terms are wingbeat's; the extension and the blends are written anew here. Within a degree of 0 and 90
degrees an odd or an even polynomial takes over that has value, slope and curvature of the formula where it joins.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from wingbeat.aero import FormulaCoefficients, FormulaTerms

ODD, EVEN = (1, 3, 5), (0, 2, 4)


class Formula:
    """``constant + amplitude sin(rate a + phase) + decay_amplitude exp(-decay_rate a)``, a in radians."""

    def __init__(self, terms: FormulaTerms) -> None:
        self.constant, self.amplitude, self.rate = terms.constant, terms.amplitude, terms.rate
        self.phase = math.radians(terms.phase_deg)
        self.decay = terms.decay_amplitude or 0.0
        self.decay_rate = math.degrees(terms.decay_rate or 0.0)

    def __call__(self, ops: Any, a: Any) -> Any:
        value = self.constant + self.amplitude * ops.sin(self.rate * a + self.phase)
        return value + self.decay * ops.exp(-self.decay_rate * a) if self.decay else value

    def jet(self, a: float) -> list[float]:
        """Return value, slope and curvature."""
        wave, decay = self.rate * a + self.phase, self.decay * math.exp(-self.decay_rate * a)
        return [
            self.constant + self.amplitude * math.sin(wave) + decay,
            self.amplitude * self.rate * math.cos(wave) - self.decay_rate * decay,
            -self.amplitude * self.rate**2 * math.sin(wave) + self.decay_rate**2 * decay,
        ]


def blend(powers: tuple[int, int, int], at: float, jet: list[float]) -> list[float]:
    """Return the factors of the powers that have a jet at a distance `at` from the centre of the blend."""
    rows = [
        [at**n for n in powers],
        [n * at ** max(n - 1, 0) for n in powers],
        [n * (n - 1) * at ** max(n - 2, 0) for n in powers],
    ]
    return [float(factor) for factor in np.linalg.solve(rows, jet)]


class Coefficients:
    """C_L and C_D of one model at any angle in [-pi, pi]."""

    def __init__(self, model: FormulaCoefficients) -> None:
        assert model.extension == "mirrored"
        self.width = math.radians(model.blend_width_deg)
        self.lift, self.drag = Formula(model.lift_terms), Formula(model.drag_terms)
        w, right = self.width, math.pi / 2
        self.lift_blends = blend(ODD, w, self.lift.jet(w)), blend(ODD, -w, self.lift.jet(right - w))
        self.drag_blends = blend(EVEN, w, self.drag.jet(w)), blend(EVEN, -w, self.drag.jet(right - w))

    def __call__(self, ops: Any, alpha: Any) -> tuple[Any, Any]:
        """Return (C_L, C_D): the plate seen from behind and from below is the same plate."""
        folded = alpha - math.pi * ops.floor(alpha / math.pi + 0.5)
        sign = ops.where(folded < 0, -1.0, 1.0)
        acute = sign * folded
        short = acute - math.pi / 2
        near_zero, near_right = acute < self.width, short > -self.width
        s, t = acute * acute, short * short

        (a, b, c), (d, e, f) = self.lift_blends
        lift = ops.where(near_right, short * (d + t * (e + t * f)), self.lift(ops, acute))
        lift = sign * ops.where(near_zero, acute * (a + s * (b + s * c)), lift)
        (a, b, c), (d, e, f) = self.drag_blends
        drag = ops.where(near_right, d + t * (e + t * f), self.drag(ops, acute))
        drag = ops.where(near_zero, a + s * (b + s * c), drag)
        return lift, drag
