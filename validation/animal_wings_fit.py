"""The fit of `wingbeat.aero.Feathered`: a shape from nine printed gull wings, a level of drag from a live jackdaw.

Each gull wing is brought to one aspect ratio and fitted by itself; the shape is the median of their terms. Least
drag and induced part are those of the live bird: the rigid, twisted prints have about three times its least drag.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from animal_wings_data import Glides, HalfWing, reduced
from measured_data import Array

from wingbeat.aero.formula_terms import CamberedCurves, CamberedTerms
from wingbeat.experiment import CurveFit, CurveForm, fit_curve

# The aspect ratio to which all wings are brought: near those of a gull, a jackdaw and a pigeon.
ASPECT_RATIO = 6.0
# Held fixed: the data of single wings do not determine how sharply lift and drag bend.
LIFT_ROUNDING, ONSET_ROUNDING_DEG = 0.15, 2.0
REPEATS, SEED, CONFIDENCE = 400, 0, 95.0
# The terms that come from the live bird.
LIVE = ("drag_least", "drag_induced")

Terms = dict[str, float]


def curves(terms: Terms) -> CamberedCurves:
    """Return the formulas of terms, which a search may have brought where no model may be."""
    whole = Terms(drag_induced=0.0, drag_least=0.0, low_onset_deg=0.0, low_rise=0.0, high_onset_deg=0.0)
    whole |= Terms(high_rise=0.0, lift_slope=1.0, lift_lowest=-1.0, lift_highest=1.0, zero_lift_deg=0.0)
    whole |= Terms(lift_rounding=LIFT_ROUNDING, onset_rounding_deg=ONSET_ROUNDING_DEG)
    record = object.__new__(CamberedTerms)
    for name, value in (whole | terms).items():
        object.__setattr__(record, name, value)
    return record.in_radians()


LIFT = CurveForm(
    "C_L of wingbeat.aero.CamberedTerms",
    lambda a, **terms: curves(terms).lift(np.radians(a)),
    {"zero_lift_deg": -3.0, "lift_slope": 4.0, "lift_lowest": -0.25, "lift_highest": 1.4},
    lowest={"lift_slope": 1.0, "lift_lowest": -1.0, "lift_highest": 0.8},
    highest={"lift_slope": 9.0, "lift_lowest": -0.02, "lift_highest": 2.0},
)
# C_D without its induced part, against the angle above zero lift.
PROFILE = CurveForm(
    "C_D - C_L^2 / (pi A) of wingbeat.aero.CamberedTerms",
    lambda a, **terms: curves(terms).drag(np.radians(a)),
    {"drag_least": 0.05, "low_onset_deg": 4.0, "low_rise": 0.5, "high_onset_deg": 20.0, "high_rise": 1.5},
    lowest={"drag_least": 0.0, "low_rise": 0.0, "high_rise": 0.0, "high_onset_deg": 8.0},
    highest={"low_rise": 2.0, "high_rise": 6.0, "low_onset_deg": 15.0, "high_onset_deg": 26.0},
)


@dataclass(frozen=True)
class HalfWingFit:
    """Lift and profile drag fitted to one half wing."""

    wing: HalfWing
    lift: CurveFit
    profile: CurveFit

    @property
    def terms(self) -> Terms:
        """The fitted terms of both curves."""
        return self.lift.parameters | self.profile.parameters


def fit_half_wing(wing: HalfWing, rows: Array | slice) -> HalfWingFit:
    """Return the fit of chosen rows of a half wing, brought to `ASPECT_RATIO`."""
    lift = wing.lift[rows]
    alpha, drag = reduced(wing.alpha_deg[rows], lift, wing.drag[rows], wing.aspect_ratio, ASPECT_RATIO)
    of_lift = fit_curve(alpha, lift, LIFT, label=f"C_L of {wing.name}")
    above = alpha - of_lift.parameters["zero_lift_deg"]
    profile = drag - lift**2 / (np.pi * ASPECT_RATIO)
    return HalfWingFit(wing, of_lift, fit_curve(above, profile, PROFILE, label=f"C_D of {wing.name}"))


def typical(fits: list[HalfWingFit]) -> Terms:
    """Return the medians of the terms of several wings."""
    return {name: float(np.median([fit.terms[name] for fit in fits])) for name in fits[0].terms}


def live_drag(glides: Glides, shape: Terms, frames: Array | slice = slice(None)) -> Terms:
    """Return least drag and induced part of the jackdaw's wings by least squares, given the shape of a wing.

    The separation drag of the shape is taken off at the lift of each frame: nobody measured the angle of attack.
    """
    lift = glides.lift[frames]
    _, induced = reduced(lift, lift, glides.induced[frames], glides.aspect_ratio[frames], ASPECT_RATIO)
    least = float(np.mean(glides.profile[frames] - separation_at(lift, shape)))
    return {"drag_least": least, "drag_induced": float(induced @ lift**2 / (lift**2 @ lift**2))}


def separation_at(lift: Array, shape: Terms) -> Array:
    """Return the separation drag of a shape at given lift, below its largest."""
    of_shape = curves(shape)
    alpha = np.radians(np.linspace(-15.0, 28.0, 431) + shape["zero_lift_deg"])
    rising = np.asarray(of_shape.lift(alpha))
    at = np.interp(lift, rising, alpha)
    return np.asarray(of_shape.separation_drag(at))


def feathered(fits: list[HalfWingFit], glides: Glides, frames: Array | slice = slice(None)) -> Terms:
    """Return all fitted terms: the typical shape of the gulls, the drag of the jackdaw."""
    shape = typical(fits)
    return shape | live_drag(glides, shape, frames)


@dataclass(frozen=True)
class Interval:
    """A fitted term, the 95 % interval of resampled fits, and the range over the gull wings (jackdaw: None)."""

    value: float
    low: float
    high: float
    spread: tuple[float, float] | None


def resampled(fits: list[HalfWingFit], glides: Glides) -> list[Terms]:
    """Return fits to wings and, for the live drag, to flights that were drawn with replacement."""
    random = np.random.default_rng(SEED)
    flights = [np.flatnonzero(glides.flight == flight) for flight in sorted(set(glides.flight))]
    drawn = []
    for _ in range(REPEATS):
        wings = [fits[i] for i in random.integers(len(fits), size=len(fits))]
        frames = np.concatenate([flights[i] for i in random.integers(len(flights), size=len(flights))])
        drawn.append(feathered(wings, glides, frames))
    return drawn


def intervals(fits: list[HalfWingFit], glides: Glides, drawn: list[Terms]) -> dict[str, Interval]:
    """Return every term with its interval over the resampled fits."""
    edge = 0.5 * (100.0 - CONFIDENCE)
    found = {}
    for name, value in feathered(fits, glides).items():
        low, high = np.percentile([terms[name] for terms in drawn], [edge, 100.0 - edge])
        each = None if name in LIVE else [fit.terms[name] for fit in fits]
        found[name] = Interval(value, float(low), float(high), None if each is None else (min(each), max(each)))
    return found
