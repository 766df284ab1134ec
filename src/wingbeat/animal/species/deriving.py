"""The unmeasured numbers of an animal, its bounds, alternatives and plausible ranges, from mass, span and area."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from typing import Any

from wingbeat._base import plain_unit
from wingbeat.animal.species import scaling
from wingbeat.animal.species.building import default_of
from wingbeat.animal.species.numbers import PLAUSIBLE, Alternative, Bound, Law, Number, Numbers, Range, SpeciesText
from wingbeat.animal.vehicle import Air

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


_SPEED = 7.0  # m/s, of a bat's stock wingbeat: in the middle of the speeds that the law's spread covers
# Bounds of the frequency in a search. Two frequencies determine them: the stock one, and that of the cruising law
# of birds, which depends on size, weight and air. The lower bound is the first factor times the lower frequency;
# the upper bound is the second factor times the higher one. For a pigeon, the bounds are 1 to 30 Hz. In 63 flights
# of derived animals and robots (1 g to 10 kg, at 0.5 to 1.6 times the speed at which the lift coefficient is 0.6),
# the minimum frequency was 0.98 to 1.74 times the frequency of the cruising law.
_WIDE = 1 / 8, 4.0
_SU_FAN = "Su et al., arXiv 2302.09602"


@dataclass(frozen=True)
class Kind:
    """The laws of birds, bats or robots, and guesses where there is no law."""

    name: str
    wing_length: Law
    wing_mass: Law
    pitch_inertia: Law
    flap_inertia: Law | None
    aspect_ratios: tuple[tuple[float, float], str]
    recovery: dict[str, float]
    recovery_source: str
    muscle: tuple[float, str] | None  # share of the whole mass that is flight muscle, and its source


BIRD = Kind(
    "bird",
    scaling.BIRD_SEMI_SPAN,
    scaling.BIRD_WING_MASS,
    scaling.BIRD_PITCH_INERTIA,
    scaling.BIRD_FLAP_INERTIA,
    scaling.BIRD_ASPECT_RATIO,
    {"span_retraction": 0.3, "twist_ratio": 1.0, "fold_amplitude": 0.0},
    f"guess: as the pigeon of {_SU_FAN}, who give no retraction",
    _BIRD_MUSCLE,
)
BAT = Kind(
    "bat",
    scaling.HALF_SPAN,
    scaling.BAT_WING_MASS,
    scaling.BAT_PITCH_INERTIA,
    scaling.BAT_FLAP_INERTIA,
    scaling.BAT_ASPECT_RATIO,
    {"span_retraction": 0.0, "twist_ratio": 1.6, "fold_amplitude": math.radians(10)},
    f"guess: as the bat of {_SU_FAN}",
    _BAT_MUSCLE,
)
ROBOT = Kind(
    "robot",
    scaling.HALF_SPAN,
    scaling.ROBOT_WING_MASS,
    scaling.ROBOT_PITCH_INERTIA,
    None,
    scaling.ROBOT_ASPECT_RATIO,
    {"span_retraction": 0.0, "twist_ratio": 1.0, "fold_amplitude": 0.0},
    "guess: rigid wings",
    None,
)


def plausible_of(kind: Kind, mass: float, chord: float, viscosity: float) -> dict[str, Range]:
    """Return the plausible ranges for an animal of this mass [kg], mean chord [m] and air viscosity [m2/s].

    No law of robots was found, because motors differ too much: their ranges are open at both ends.

    >>> plausible_of(BIRD, 0.316, 0.112, 1.5e-5)["strouhal"].high
    0.4
    """
    if kind.muscle is None:
        return {
            key.name: Range(None, None, key.unit, _NO_LAW) for key in PLAUSIBLE if key.name != "peak_activation"
        }
    share, share_source = kind.muscle
    cruise = scaling.CRUISE_BY_MASS.number(mass)
    slowest, fastest = cruise.range or (0.0, math.inf)
    whose = "; birds, no law of bats was found" if kind is BAT else ""
    law = f"{scaling.CRUISE_BY_MASS.formula} = {cruise.value:.3g} m/s, {scaling.CRUISE_BY_MASS.source}{whose}"
    steeper = f"{_MEAN_BODY_PITCH.source}; cruise is 0.6 to 1.6 times {law}: slower flight is steeper"
    larger = f"{_STROUHAL_SOURCE}; cruise is 0.6 to 1.6 times {law}: slower flight has a larger one"
    highest = f"derived: the fastest cruise, 1.6 times {law}, at a chord of {chord:.3g} m"
    return {
        "positive_power_per_mass": Range(None, _MUSCLE * share, "W/kg", f"{_MUSCLE_SOURCE}; {share_source}"),
        "peak_force_over_weight": _FORCE,
        "mean_body_pitch": _MEAN_BODY_PITCH._replace(source=steeper, speeds=(slowest, fastest)),
        "body_pitch_range": _BODY_PITCH,
        "strouhal": Range(*_STROUHAL, "1", larger, (slowest, fastest)),
        "reynolds": Range(None, fastest * chord / viscosity, "1", highest),
    }


def derive(
    kind: Kind, content: SpeciesText, mass: float, span: float, area: float, frequencies: tuple[float, float] | None
) -> None:
    """Add what `content` lacks, from the whole mass [kg], the span tip to tip [m] and the area of both wings [m2].

    The bounds of the wingbeat frequency are `frequencies` [Hz], or wide ones around the stock frequency.
    """
    found = _vehicle(kind, content.numbers, mass, span, area)
    limits = {"density": (0.8, 1.35), "viscosity": (1.2e-5, 2.0e-5), "gravity": (9.78, 9.84)}
    for name, value in dataclasses.asdict(Air()).items():
        found[f"air.{name}"] = Number(value, plain_unit(name), "guess: standard air at sea level", limits[name])
    air = [single(content.numbers.get(path, found[path])) for path in ("air.density", "air.gravity")]
    found |= _wingbeat(kind, mass, span, area, *air)
    for path, number in found.items():
        content.numbers.setdefault(path, number)
    stock = content.numbers["wingbeat.frequency"]
    usual = [single(stock)]
    if "wingbeat.frequency" in found and stock is found["wingbeat.frequency"]:
        usual.append(scaling.BIRD_FREQUENCY(mass, span, area, *air))
    content.free, content.path = _bounds(usual, frequencies)
    content.written = {name: (f"free.{name}", list(bound.bounds)) for name, bound in content.free.items()}
    content.plausible = plausible_of(kind, mass, area / span, single(content.numbers["air.viscosity"]))
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
        low, high = _range(usual)
        if not low <= mass <= high:
            whole = Number(mass, "kg", f"given; range {usual.source}", (low, high))
    length = given.get("vehicle.wing.semi_span", kind.wing_length.number(span))
    wing_mass = given.get("vehicle.wing.mass", kind.wing_mass.number(mass))
    drag = scaling.BODY_DRAG_AREA.number(mass)
    drag_source = f"{_SU_FAN}, have no body drag; top of the range {drag.source}"
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
    vertical = "guess: near vertical is the best in cruise (Parslew 2015, J R Soc Interface 12:20140953, on birds)"
    return {
        "vehicle.mass": whole,
        "vehicle.body.pitch_inertia": kind.pitch_inertia.number(mass),
        "vehicle.body.drag_area": Number(0.0, plain_unit("drag_area"), drag_source, (0.0, _range(drag)[1])),
        "vehicle.wing.semi_span": length,
        "vehicle.wing.chord": chord,
        "vehicle.wing.mass": wing_mass,
        "vehicle.wing.mass_exponent": exponent,
        "vehicle.wing.shoulder": Number((0.0, single(half_width), 0.0), "m", beside, (-0.02 * span, 0.08 * span)),
        "vehicle.wing.stroke_plane_angle": _guess("vehicle.wing.stroke_plane_angle", None, 45, 110, vertical),
    }


def _wingbeat(kind: Kind, mass: float, span: float, area: float, density: Any, gravity: Any) -> dict[str, Number]:
    if kind is BAT:
        frequency, amplitude = bat_beat(mass, area)
    elif kind is BIRD:
        frequency = scaling.BIRD_FREQUENCY.number(mass, span, area, density, gravity)
        amplitude = scaling.BIRD_FLAP_AMPLITUDE.number(span)
    else:
        frequency = scaling.ROBOT_FREQUENCY.number(mass, span, area, density, gravity)
        amplitude = scaling.ROBOT_FLAP_AMPLITUDE.number()
    ranges = {"span_retraction": (0.0, 0.5), "twist_ratio": (1.0, 2.0), "fold_amplitude": (0.0, math.radians(30))}
    found = {
        f"wingbeat.{name}": Number(value, plain_unit(name), kind.recovery_source, ranges[name])
        for name, value in kind.recovery.items()
    }
    return found | {
        "wingbeat.frequency": frequency,
        "wingbeat.flap_mean": _guess("wingbeat.flap_mean", 0, -30, 30),
        "wingbeat.flap_amplitude": amplitude,
        "wingbeat.pitch_mean": _guess("wingbeat.pitch_mean", 8, -30, 40),
        "wingbeat.pitch_amplitude": _guess("wingbeat.pitch_amplitude", 15, 0, 60),
        "wingbeat.wrist": Number(0.5, "1", "guess: half the span; without a fold it has no effect", (0.3, 0.7)),
    }


def bat_beat(mass: float, area: float) -> tuple[Number, Number]:
    """Return frequency [Hz] and flap amplitude [rad] of a bat of this mass [kg] and wing area [m2]."""
    return scaling.BAT_FREQUENCY.number(mass, _SPEED), scaling.BAT_FLAP_AMPLITUDE.number(_SPEED, area)


def _guess(path: str, degrees: float | None, low: float, high: float, source: str = "first guess") -> Number:
    value = default_of(path) if degrees is None else math.radians(degrees)
    return Number(value, "rad", source, (math.radians(low), math.radians(high)))


def _bounds(usual: list[float], given: tuple[float, float] | None) -> tuple[dict[str, Bound], dict[str, Bound]]:
    """Return the bounds of the free parameters and those along the path; `usual` holds typical frequencies [Hz]."""
    wide = _WIDE[0] * min(usual), _WIDE[1] * max(usual)
    guess = "guess: an eighth to four times what the laws of the frequency give"
    frequency = Bound(wide, guess, True) if given is None else Bound(given, "given")

    def angles(low: float, high: float, reason: str) -> Bound:
        return Bound((math.radians(low), math.radians(high)), reason, True)

    reach = "the shoulder's reach, a guess"
    free = {
        "frequency": frequency,
        "flap_mean": angles(-30, 30, reach),
        "flap_amplitude": angles(5, 70, "guess: wide around what animals show"),
        "pitch_mean": angles(-30, 40, reach),
        "pitch_amplitude": angles(0, 60, reach),
    }
    path = {
        "body_pitch": angles(-60, 60, "steeper is a manoeuvre, not forward flight"),
        "flap": angles(-90, 90, f"{reach}: upright above and below; no measurement found"),
    }
    return free, path


def single(number: Number) -> float:
    """Return the value of a number that is not a list."""
    assert not isinstance(number.value, tuple), "of the numbers here the chord alone may be a list"
    return number.value


def _range(number: Number) -> tuple[float, float]:
    assert number.range is not None, "every law has a spread"
    return number.range
