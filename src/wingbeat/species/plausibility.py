"""Plausible ranges for an animal's beat, from published laws: power, force, body pitch, Strouhal and Reynolds."""

from __future__ import annotations

import math

from wingbeat.species import scaling
from wingbeat.species_schema import PLAUSIBLE, Number, Range

# What is judged of every orbit, in the order of a record.
JUDGED = (
    "positive_power_per_mass",
    "frequency",
    "flap_amplitude",
    "peak_force_over_weight",
    "body_pitch_range",
    "strouhal",
    "reynolds",
)
UNKNOWN = "nothing is known: the species file gives no range"
_NO_LAW = "nothing is known: no law of robots was found"

# Power of flight muscle in short maximal bursts [W/kg]; sustained flight cannot exceed it.
_MUSCLE = 460.0
_MUSCLE_SOURCE = (
    "flight muscles give 360 to 460 W/kg in short maximal bursts, animals of 0.0002 to 5 kg "
    "(A: Askew, Marsh and Ellington 2001, J Exp Biol 204:3601, abstract, doi 10.1242/jeb.204.21.3601)"
)
# Share of the whole mass that is flight muscle.
_BIRD_MUSCLE = (
    0.25,
    "guess: 0.25 of a bird is flight muscle; 0.19 of a pigeon (Usherwood et al. 2005, doi 10.1242/jeb.01359)",
)
_BAT_MUSCLE = (
    0.23,
    "at most 0.23 of a bat is flight muscle, 0.09 to 0.23 of 29 Australian species "
    "(A: Bullen and McKenzie 2004, Aust J Zool 52:605, abstract, doi 10.1071/ZO04036)",
)
_FORCE = Range(
    None,
    4.0,
    "1",
    "guess: no measurement found; a downstroke of half the beat that carries the whole weight alone has a peak of "
    "pi weights if it is a half sine (D), and 4 leaves room for a shorter downstroke",
)
_BODY_PITCH = Range(
    None,
    math.radians(20.0),
    "rad",
    "guess: no measurement found; a body that turns by 20 degrees turns a sixth of its lift into thrust and drag "
    "by turns",
)
# Strouhal numbers of cruising animals.
_STROUHAL = 0.2, 0.4
_STROUHAL_SOURCE = (
    "A: 42 species of birds, bats and insects in cruise (Taylor, Nudds and Thomas 2003, Nature 425:707, "
    "doi 10.1038/nature02000, abstract)"
)


def _plausible(
    muscle: tuple[float, str], mass: float, chord: float, viscosity: float, whose: str
) -> dict[str, Range]:
    share, share_source = muscle
    cruise = scaling.CRUISE_BY_MASS.number(mass)
    slowest, fastest = cruise.range or (0.0, math.inf)
    law = f"{scaling.CRUISE_BY_MASS.formula} = {cruise.value:.3g} m/s, {scaling.CRUISE_BY_MASS.source}{whose}"
    return {
        "positive_power_per_mass": Range(None, _MUSCLE * share, "W/kg", f"{_MUSCLE_SOURCE}; {share_source}"),
        "peak_force_over_weight": _FORCE,
        "body_pitch_range": _BODY_PITCH,
        "strouhal": Range(
            *_STROUHAL,
            "1",
            f"{_STROUHAL_SOURCE}; cruise is 0.6 to 1.6 times {law}: slower flight has a larger one",
            (slowest, fastest),
        ),
        "reynolds": Range(
            None,
            fastest * chord / viscosity,
            "1",
            f"derived: the fastest cruise, 1.6 times {law}, at a chord of {chord:.3g} m",
        ),
    }


def plausible_of_birds(mass: float, chord: float, viscosity: float) -> dict[str, Range]:
    """Return the plausible ranges for a bird of this mass [kg], mean chord [m] and viscosity of the air [m2/s].

    >>> plausible_of_birds(0.316, 0.112, 1.5e-5)["strouhal"].high
    0.4
    """
    return _plausible(_BIRD_MUSCLE, mass, chord, viscosity, "")


def plausible_of_bats(mass: float, chord: float, viscosity: float) -> dict[str, Range]:
    """Return the plausible ranges for a bat of this mass [kg], mean chord [m] and air viscosity [m2/s]."""
    return _plausible(_BAT_MUSCLE, mass, chord, viscosity, "; birds, no law of bats was found")


def plausible_of_robots(mass: float, chord: float, viscosity: float) -> dict[str, Range]:
    """Return ranges that are open at both ends: no law of robots was found, because motors differ too much."""
    return {key.name: Range(None, None, key.unit, _NO_LAW) for key in PLAUSIBLE}


def range_of(number: Number) -> Range:
    """Return the plausible range given with a number of a species file."""
    low, high = number.range or (None, None)
    return Range(low, high, number.unit, number.source if number.range else UNKNOWN)
