"""Plausible ranges for an animal's beat, from published laws: power, force, body pitch, Strouhal and Reynolds."""

from __future__ import annotations

import math
from collections.abc import Mapping

from wingbeat.animal.species import scaling
from wingbeat.animal.species_schema import PLAUSIBLE, Number, Range

# What is judged of an orbit, in the order of a record: activation where there is muscle, the tail's tilt where a
# tail tilts.
JUDGED = (
    "positive_power_per_mass",
    "peak_activation",
    "frequency",
    "flap_amplitude",
    "tail_tilt",
    "peak_force_over_weight",
    "mean_body_pitch",
    "body_pitch_range",
    "strouhal",
    "reynolds",
)
# No number of an animal: the share of the muscle's fibres that a wingbeat uses.
ACTIVATION = Range(None, 1.0, "1", "by definition: above 1, the wingbeat needs more fibres than the muscle has")
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
# In cruise.
_MEAN_BODY_PITCH = Range(
    math.radians(-10.0),
    math.radians(40.0),
    "rad",
    "guess: no measured range was found; the body angle of pigeons falls with speed (A: Tobalske and Dial 1996, "
    "J Exp Biol 199:263, abstract), so that the body is nearly level in fast cruise and steeper in slow cruise; 10 "
    "degrees nose down are left for the rest",
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
        "mean_body_pitch": _MEAN_BODY_PITCH._replace(
            source=f"{_MEAN_BODY_PITCH.source}; cruise is 0.6 to 1.6 times {law}: slower flight is steeper",
            speeds=(slowest, fastest),
        ),
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
    return {key.name: Range(None, None, key.unit, _NO_LAW) for key in PLAUSIBLE if key.name != "peak_activation"}


def range_of_tilt(numbers: Mapping[str, Number]) -> Range:
    """Return the plausible range of the tail's tilt: its own, or what the range of the incidence allows.

    Parameters
    ----------
    numbers : of a species, by their paths.
    """
    own, incidence = numbers.get("wingbeat.tail_tilt"), numbers.get("vehicle.tail.incidence")
    if own is not None and own.range is not None:
        return range_of(own)
    if incidence is None or incidence.range is None:
        return Range(None, None, "rad", UNKNOWN)
    level = incidence.value
    assert not isinstance(level, tuple)
    low, high = (end - level for end in incidence.range)
    return Range(low, high, "rad", f"range of the tail's incidence; {incidence.source}")


def range_of(number: Number) -> Range:
    """Return the plausible range given with a number of a species file."""
    low, high = number.range or (None, None)
    return Range(low, high, number.unit, number.source if number.range else UNKNOWN)
