"""How the fitted wings glide, against wings and glides that the fit did not see."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from animal_wings_data import JACKDAW_FILE, HalfWing, reduced
from animal_wings_fit import ASPECT_RATIO, HalfWingFit, Terms, curves, typical
from measured_data import JACKDAW_AREA, Array, columns, rows

import wingbeat as wb

# Rosen and Hedenstrom 2001, J. Exp. Biol. 204:1153, abstract: a whole jackdaw, tail and body included.
ROSEN_RATIO, ROSEN_RATIO_SPEED = 12.6, 8.3
ROSEN_SINK, ROSEN_SINK_SPEED = 0.62, 7.4
# Angles above zero lift at which fitted wings are evaluated [deg], and the least C_L of a glide.
_ANGLES = np.linspace(-5.0, 28.0, 661)
_LEAST_LIFT = 0.2


@dataclass(frozen=True)
class Performance:
    """Best glide ratio, and sink of the slowest descent in units of sqrt(2 W / (rho S))."""

    ratio: float
    sink: float


@dataclass(frozen=True)
class LeftOut:
    """One half wing against the fit to all others, at its own aspect ratio."""

    wing: HalfWing
    measured: Performance
    predicted: Performance

    @property
    def errors(self) -> tuple[float, float]:
        """Relative errors of ratio and sink."""
        pairs = (self.predicted.ratio, self.measured.ratio), (self.predicted.sink, self.measured.sink)
        return tuple(found / wanted - 1.0 for found, wanted in pairs)  # type: ignore[return-value]


def performance(lift: Array, drag: Array) -> Performance:
    """Return the glides of a polar: with the path at the angle of C_D over C_L, the force carries the weight."""
    flying = lift > _LEAST_LIFT
    lift, drag = lift[flying], drag[flying]
    return Performance(float((lift / drag).max()), float((drag / (lift**2 + drag**2) ** 0.75).min()))


def measured(wing: HalfWing) -> Performance:
    """Return the glides of the means at each angle, at the faster tunnel speed."""
    alpha, place = np.unique(wing.alpha_deg[wing.fast], return_inverse=True)
    del alpha
    lift, drag = (np.bincount(place, c[wing.fast]) / np.bincount(place) for c in (wing.lift, wing.drag))
    return performance(lift, drag)


def polar_at(terms: Terms, aspect_ratio: float) -> tuple[Array, Array]:
    """Return C_L and C_D of fitted terms, brought to another aspect ratio."""
    of_wing = curves(terms)
    alpha = np.radians(_ANGLES + terms["zero_lift_deg"])
    lift, drag = np.asarray(of_wing.lift(alpha)), np.asarray(of_wing.drag(alpha))
    _, drag = reduced(lift, lift, drag, ASPECT_RATIO, aspect_ratio)
    return lift, drag


def left_out(fits: list[HalfWingFit], own: tuple[str, ...] = ()) -> list[LeftOut]:
    """Return each gull wing against the printed wings that remain, with an ideal induced part.

    Terms named in `own` are those of the wing itself.
    """
    found = []
    for fit in fits:
        others = typical([other for other in fits if other is not fit])
        terms = others | {"drag_induced": 1.0 / (math.pi * ASPECT_RATIO)} | {name: fit.terms[name] for name in own}
        predicted = performance(*polar_at(terms, fit.wing.aspect_ratio))
        found.append(LeftOut(fit.wing, measured(fit.wing), predicted))
    return found


@dataclass(frozen=True)
class JackdawGlides:
    """Glides of the whole jackdaw: with a folded tail, with the measured drag area, and as measured."""

    feathered: wb.GlidePolar
    plate: wb.GlidePolar
    spread_tail: wb.GlidePolar
    wide_area: float
    measured_row: str
    printed: Performance


def jackdaw_polar(aero: Any, drag_area: float | None = None) -> wb.GlidePolar:
    """Return the glides of this package's jackdaw, body and folded tail included or another drag area [m2]."""
    jackdaw = wb.load_species("jackdaw").with_alternative("body-drag")
    if drag_area is not None:
        jackdaw = jackdaw.with_values({"vehicle.body.drag_area": drag_area})
    return wb.glide_polar(jackdaw, aero=aero, angles_of_attack=np.radians(np.arange(1.0, 22.0)), trim="tail")


def jackdaw_glides_of(folder: Path, fits: list[HalfWingFit], aspect_ratio: float) -> JackdawGlides:
    """Return all glides of the jackdaw."""
    names = "airspeed_m_s", "CL", "lift_N", "drag_induced_N", "drag_wing_profile_N", "drag_body_N"
    speed, coefficient, lift, induced, profile, body = columns(rows(folder / JACKDAW_FILE), *names)
    area = float(np.mean(body * coefficient * JACKDAW_AREA / lift))
    classes = np.round(speed)
    ratios = {v: lift[classes == v].mean() / (induced + profile + body)[classes == v].mean() for v in set(classes)}
    sinks = {v: v * math.sin(math.atan(1.0 / ratio)) for v, ratio in ratios.items()}
    best, slow = max(ratios, key=ratios.__getitem__), min(sinks, key=sinks.__getitem__)
    row = f"| measured, second study | {ratios[best]:.1f} | {best:.0f} | {sinks[slow]:.2f} | {slow:.0f} |"
    of_prints = typical(fits) | {"drag_induced": 1.0 / (math.pi * ASPECT_RATIO)}
    printed = performance(*polar_at(of_prints, aspect_ratio))
    polars = jackdaw_polar("feathered"), jackdaw_polar("su-fan"), jackdaw_polar("feathered", area)
    return JackdawGlides(*polars, area, row, printed)


def reynolds_exponents(wings: list[HalfWing]) -> Array:
    """Return d ln C_D / d ln Re of each half wing between its two tunnel speeds, from -4 to 12 degrees."""
    found = []
    for wing in wings:
        each = []
        for angle in range(-4, 13):
            here = wing.alpha_deg == angle
            slow, fast = here & ~wing.fast, here & wing.fast
            if slow.any() and fast.any():
                drag, reynolds = (c[fast].mean() / c[slow].mean() for c in (wing.drag, wing.reynolds))
                each.append(math.log(drag) / math.log(reynolds))
        found.append(float(np.mean(each)))
    return np.array(found)


def lift_gained(wings: list[HalfWing]) -> Array:
    """Return how much more lift the faster speed gives each half wing at 14 to 20 degrees, on average."""
    found = []
    for wing in wings:
        near = (wing.alpha_deg >= 14) & (wing.alpha_deg <= 20)
        found.append(float(wing.lift[near & wing.fast].mean() - wing.lift[near & ~wing.fast].mean()))
    return np.array(found)
