"""The unmeasured numbers of an animal, its bounds, alternatives and plausible ranges, from mass, span and area.

What is the same for all animals, or for all of a kind, stands in `deriving.toml`.
"""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass
from pathlib import Path

from wingbeat._base import FaultList
from wingbeat.animal.species import scaling
from wingbeat.animal.species.numbers import (
    PLAUSIBLE,
    STATION_MASSES,
    WING,
    Alternative,
    Bound,
    Number,
    Numbers,
    Range,
    SpeciesText,
)
from wingbeat.animal.species.reading import read_species_text
from wingbeat.animal.species.scaling import Law

_FILE = Path(__file__).with_suffix(".toml")
_SPEED = 7.0  # m/s, of a bat's stock wingbeat: in the middle of the speeds that the law's spread covers
# Bounds of the frequency in a search. Two frequencies determine them: the stock one, and that of the cruising law
# of birds, which depends on size, weight and air. The lower bound is the first factor times the lower frequency;
# the upper bound is the second factor times the higher one. For a pigeon, the bounds are 1 to 30 Hz. In 63 flights
# of derived animals and robots (1 g to 10 kg, at 0.5 to 1.6 times the speed at which the lift coefficient is 0.6),
# the minimum frequency was 0.98 to 1.74 times the frequency of the cruising law.
_WIDE = 1 / 8, 4.0


@dataclass(frozen=True)
class Kind:
    """The laws of birds, bats or robots, and guesses where there is no law."""

    name: str
    wing_length: Law
    wing_mass: Law
    pitch_inertia: Law
    flap_inertia: Law | None
    aspect_ratios: tuple[tuple[float, float], str]
    muscle: tuple[float, str] | None  # share of the whole mass that is flight muscle, and its source


BIRD = Kind(
    "bird",
    scaling.BIRD_SEMI_SPAN,
    scaling.BIRD_WING_MASS,
    scaling.BIRD_PITCH_INERTIA,
    scaling.BIRD_FLAP_INERTIA,
    scaling.BIRD_ASPECT_RATIO,
    (
        0.25,
        "guess: 0.25 of a bird is flight muscle; 0.19 of a pigeon (Usherwood et al. 2005, doi 10.1242/jeb.01359)",
    ),
)
BAT = Kind(
    "bat",
    scaling.HALF_SPAN,
    scaling.BAT_WING_MASS,
    scaling.BAT_PITCH_INERTIA,
    scaling.BAT_FLAP_INERTIA,
    scaling.BAT_ASPECT_RATIO,
    (
        0.23,
        "at most 0.23 of a bat is flight muscle, 0.09 to 0.23 of 29 Australian species "
        "(B: Bullen and McKenzie 2004, Aust J Zool 52:605, abstract, doi 10.1071/ZO04036)",
    ),
)
ROBOT = Kind(
    "robot",
    scaling.HALF_SPAN,
    scaling.ROBOT_WING_MASS,
    scaling.ROBOT_PITCH_INERTIA,
    None,
    scaling.ROBOT_ASPECT_RATIO,
    None,
)


@functools.cache
def _stock() -> SpeciesText:
    """Return the content of `deriving.toml`, in which nothing may be wrong but what it lacks and laws give."""
    faults = FaultList()
    stock = read_species_text(_FILE.read_text(encoding="utf-8"), _FILE.name, "", faults)
    faults.faults = [fault for fault in faults.faults if fault.rule != "must be given"]
    faults.raise_if_any()
    return stock


def plausible_of(kind: Kind, mass: float, chord: float, viscosity: float) -> dict[str, Range]:
    """Return the plausible ranges for an animal of this mass [kg], mean chord [m] and air viscosity [m2/s].

    No law of robots was found, because motors differ too much: their ranges are open at both ends.

    >>> plausible_of(BIRD, 0.316, 0.112, 1.5e-5)["strouhal"].high
    0.4
    """
    if kind.muscle is None:
        unknown = "nothing is known: no law of robots was found"
        return {
            key.name: Range(None, None, key.unit, unknown) for key in PLAUSIBLE if key.name != "peak_activation"
        }
    share, share_source = kind.muscle
    cruise = scaling.CRUISE_BY_MASS.number(mass)
    slowest, fastest = cruise.range or (0.0, math.inf)
    whose = "; birds, no law of bats was found" if kind is BAT else ""
    law = f"{scaling.CRUISE_BY_MASS.formula} = {cruise.value:.3g} m/s, {scaling.CRUISE_BY_MASS.source}{whose}"
    found = dict(_stock().plausible)
    power = found["positive_power_per_mass"]
    assert power.high is not None
    found["positive_power_per_mass"] = power._replace(
        high=power.high * share, source=f"{power.source}; {share_source}"
    )
    for name, beyond in (("mean_body_pitch", "is steeper"), ("strouhal", "has a larger one")):
        source = f"{found[name].source}; cruise is 0.6 to 1.6 times {law}: slower flight {beyond}"
        found[name] = found[name]._replace(source=source, speeds=(slowest, fastest))
    highest = f"derived: the fastest cruise, 1.6 times {law}, at a chord of {chord:.3g} m"
    found["reynolds"] = Range(None, fastest * chord / viscosity, "1", highest)
    return found


def derive(
    kind: Kind, content: SpeciesText, mass: float, span: float, area: float, frequencies: tuple[float, float] | None
) -> None:
    """Add what `content` lacks, from the whole mass [kg], the span tip to tip [m] and the area of both wings [m2].

    The bounds of the wingbeat frequency are `frequencies` [Hz], or wide ones around the stock frequency.
    """
    numbers = content.numbers
    stock = _stock()
    found = stock.numbers | stock.alternatives[kind.name].numbers | _vehicle(kind, numbers, mass, span, area)
    air = [single(numbers.get(path, found[path])) for path in ("air.density", "air.gravity")]
    if kind is BAT:
        frequency, amplitude = bat_beat(mass, area)
    elif kind is BIRD:
        frequency = scaling.BIRD_FREQUENCY.number(mass, span, area, *air)
        amplitude = scaling.BIRD_FLAP_AMPLITUDE.number(span)
    else:
        frequency = scaling.ROBOT_FREQUENCY.number(mass, span, area, *air)
        amplitude = scaling.ROBOT_FLAP_AMPLITUDE.number()
    found |= {"wingbeat.frequency": frequency, "wingbeat.flap_amplitude": amplitude}
    for path, number in found.items():
        if STATION_MASSES not in numbers or path not in (WING, "vehicle.wing.mass_exponent"):
            numbers.setdefault(path, number)
    usual = [single(numbers["wingbeat.frequency"])]
    if numbers["wingbeat.frequency"] is frequency:
        usual.append(scaling.BIRD_FREQUENCY(mass, span, area, *air))
    bound = (
        Bound(frequencies, "given")
        if frequencies
        else Bound(
            (_WIDE[0] * min(usual), _WIDE[1] * max(usual)),
            "guess: an eighth to four times what the laws of the frequency give",
            True,
        )
    )
    content.free, content.path = {"frequency": bound} | stock.free, dict(stock.path)
    content.written = stock.written | {"frequency": ("free.frequency", list(bound.bounds))}
    content.plausible = plausible_of(kind, mass, area / span, single(numbers["air.viscosity"]))
    drag, rigid = Numbers(), Numbers()
    drag["vehicle.body.drag_area"] = scaling.BODY_DRAG_AREA.number(mass)
    reason = "the drag of the body, which Su et al. leave out; the law of birds"
    content.alternatives = {"body-drag": Alternative(reason, drag)}
    if kind is BIRD:
        rigid["wingbeat.span_retraction"] = Number(0.0, "1", "guess: the lower end of its range")
        reason = "a wing that keeps its span, to see how much depends on the guess"
        content.alternatives["rigid-span"] = Alternative(reason, rigid)


def _vehicle(kind: Kind, given: Numbers, mass: float, span: float, area: float) -> dict[str, Number]:
    whole = Number(mass, "kg", "given")
    if kind is BIRD:
        # A range only if no bird of this span has this mass: what somebody measured is exact.
        usual = scaling.BIRD_MASS.number(span)
        if usual.range and not usual.range[0] <= mass <= usual.range[1]:
            whole = Number(mass, "kg", f"given; range {usual.source}", usual.range)
    length = given.get("vehicle.wing.semi_span", kind.wing_length.number(span))
    wing_mass = given.get("vehicle.wing.mass", kind.wing_mass.number(mass))
    drag = scaling.BODY_DRAG_AREA.number(mass)
    cross = scaling.CROSSFLOW_AREA.number(mass)
    assert drag.range is not None, "every law has a spread"
    assert cross.range is not None, "every law has a spread"
    cross_source = f"Su et al., arXiv 2302.09602, have no force across the body; top of the range {cross.source}"
    drag_source = f"Su et al., arXiv 2302.09602, have no body drag; top of the range {drag.source}"
    chord = scaling.MEAN_CHORD.number(span, area)
    (low, high), whose = kind.aspect_ratios
    if not low <= span * span / area <= high:
        odd = f"; range: aspect ratio {low:g} to {high:g}, {whose}"
        chord = chord._replace(source=chord.source + odd, range=(span / high, span / low))
    if kind.flap_inertia is None:
        exponent = scaling.ROBOT_MASS_EXPONENT.number()
    else:
        exponent = scaling.mass_exponent(kind.flap_inertia, single(wing_mass), single(length))
    half_width = scaling.BODY_HALF_WIDTH.number(mass)
    beside = f"guess: level with the body's centre of mass; half the body's width to the side, {half_width.source}"
    return {
        "vehicle.mass": whole,
        "vehicle.body.pitch_inertia": kind.pitch_inertia.number(mass),
        "vehicle.body.drag_area": Number(0.0, drag.unit, drag_source, (0.0, drag.range[1])),
        "vehicle.body.crossflow_area": Number(0.0, cross.unit, cross_source, (0.0, cross.range[1])),
        "vehicle.wing.semi_span": length,
        "vehicle.wing.chord": chord,
        "vehicle.wing.mass": wing_mass,
        "vehicle.wing.mass_exponent": exponent,
        "vehicle.wing.shoulder": Number((0.0, single(half_width), 0.0), "m", beside, (-0.02 * span, 0.08 * span)),
    }


def bat_beat(mass: float, area: float) -> tuple[Number, Number]:
    """Return frequency [Hz] and flap amplitude [rad] of a bat of this mass [kg] and wing area [m2]."""
    return scaling.BAT_FREQUENCY.number(mass, _SPEED), scaling.BAT_FLAP_AMPLITUDE.number(_SPEED, area)


def single(number: Number) -> float:
    """Return the value of a number that is not a list."""
    assert not isinstance(number.value, tuple), "of the numbers here the chord alone may be a list"
    return number.value
