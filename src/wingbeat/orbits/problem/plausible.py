"""Plausible problems: bounds narrowed to the species' ranges, and limits on quantities of the beat."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from wingbeat._base import FaultList
from wingbeat.animal.kinematics import FREE_NAMES, parameter
from wingbeat.animal.species.numbers import JUDGED, Range
from wingbeat.animal.species.species import Species
from wingbeat.animal.vehicle import Air
from wingbeat.orbits.problem.quantities import QUANTITIES, Constraint

_WAY_OUT = "leave out 'plausible', or correct the range in the species file"
# A fixed number or the Reynolds number may exceed the end of a range by rounding.
_ROUNDING = 1e-9
# A limit is set inside the end of the plausible range, by this share of the end. For three orbits at such a limit
# (bat at 5 m/s, pigeon at 10 m/s) the record exceeded the limit by a share of at most 7e-5.
_INSET = 2e-4


def judged_names(species: Species, free: Sequence[str]) -> list[str]:
    """Return what is judged of an orbit: activation where there is muscle, the tail's tilt where a tail tilts."""
    tilts = species.vehicle.tail is not None and ("tail_tilt" in free or species.wingbeat.tail_tilt != 0)
    absent = {"peak_activation": species.vehicle.muscle is None, "tail_tilt": not tilts}
    return [name for name in JUDGED if not absent.get(name)]


def drawn_in(
    species: Species, free: Sequence[str], bounds: Mapping[str, tuple[float, float]], faults: FaultList
) -> dict[str, tuple[float, float]]:
    """Return the bounds of free parameters (SI and radians) narrowed to their plausible ranges."""
    drawn = {}
    for name in free:
        known = species.plausible_range(name, 0.0)
        if known.low is None or known.high is None or name not in bounds:
            continue
        pair = max(bounds[name][0], known.low), min(bounds[name][1], known.high)
        if pair[0] < pair[1]:
            drawn[name] = pair
        else:
            rule = f"does not overlap with the plausible range ({_words(known)})"
            faults.add(f"bounds.{name}", bounds[name], rule, f"widen the bounds, or {_WAY_OUT}")
    for name in JUDGED:
        if name in FREE_NAMES and name not in free:
            value, known = parameter(species.wingbeat, name), species.plausible_range(name, 0.0)
            if _outside(value, known):
                rule = f"is fixed outside the plausible range ({_words(known)})"
                faults.add(f"wingbeat.{name}", value, rule, _WAY_OUT)
    return drawn


def plausible_limits(species: Species, speed: float, air: Air, faults: FaultList) -> tuple[Constraint, ...]:
    """Return the limits that keep quantities of the beat plausible at a speed [m/s]."""
    limits = []
    for name in judged_names(species, ()):
        known = species.plausible_range(name, speed)
        if name in FREE_NAMES or (name == "strouhal" and speed == 0):
            continue
        if name == "reynolds":  # which no wingbeat changes
            reynolds = air.reynolds(speed, species.vehicle.wing.mean_chord)
            if speed > 0 and _outside(reynolds, known):
                rule = f"gives a Reynolds number of {reynolds:.3g}, outside the plausible range ({_words(known)})"
                faults.add("speed", speed, rule, _WAY_OUT)
            continue
        for end, at_most in ((known.low, False), (known.high, True)):
            if end is not None:
                # The record samples a certified beat at other phases than the solver.
                inset = _INSET * (abs(end) or QUANTITIES[name].scale)
                limits.append(Constraint(QUANTITIES[name], end - inset if at_most else end + inset, at_most))
    return tuple(limits)


def _outside(value: float, known: Range) -> bool:
    low = -math.inf if known.low is None else known.low - _ROUNDING * abs(known.low)
    high = math.inf if known.high is None else known.high + _ROUNDING * abs(known.high)
    return not low <= value <= high


def _words(known: Range) -> str:
    """Return a range in words, angles in degrees: ``19 to 52 deg``."""
    angle = known.unit == "rad"
    unit = "" if known.unit == "1" else " deg" if angle else f" {known.unit}"
    low, high = (None if end is None else math.degrees(end) if angle else end for end in known[:2])
    if low is None or high is None:
        return f"at least {low:.4g}{unit}" if high is None else f"at most {high:.4g}{unit}"
    return f"{low:.4g} to {high:.4g}{unit}"
