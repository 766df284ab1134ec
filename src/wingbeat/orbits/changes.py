"""Terms of a problem's air loads that are on, and the problem without one of them."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from wingbeat._base import InvalidInputError, cf, for_people, harmonic_place, plain_unit
from wingbeat.aero.blade_element import BladeElement
from wingbeat.animal.kinematics import ANGLES, parameter, with_parameters
from wingbeat.orbits.flight.period import LIFT, MOMENT, PATH_NAMES, THRUST
from wingbeat.orbits.options import DEFAULTS, ChangeOptions
from wingbeat.orbits.problem.parameters import Place, with_number
from wingbeat.orbits.problem.quantities import FASTEST, FASTEST_CLIMB, Constraint

if TYPE_CHECKING:
    from wingbeat.orbits.problem.problem import OrbitProblem

INFLOW, UNSTEADY, WAKE, UPSTROKE, HAND, TAIL = "inflow", "unsteady", "wake", "upstroke_factor", "hand", "tail"
TERMS = (INFLOW, UNSTEADY, WAKE, UPSTROKE, HAND, TAIL)
_SHARED = (UNSTEADY, WAKE)  # scaled by one share
_OFF = {INFLOW: "none", UNSTEADY: "none", WAKE: "none", UPSTROKE: 1.0, HAND: "none"}


def terms_on(problem: OrbitProblem) -> tuple[str, ...]:
    """Return the terms of `TERMS` that a problem has; a tail whose tilt is free does not count."""
    tail = problem.vehicle.tail is not None and "tail_tilt" not in problem.free
    on = [name for name, off in _OFF.items() if getattr(problem.aero, name) != off]
    return (*on, *[TAIL] * tail)


def on_and_off(problem: OrbitProblem, name: str) -> tuple[float, float, str]:
    """Return the number that describes a term (1 if it can only be on), that without the term, and the unit."""
    if name == UPSTROKE:
        return problem.aero.upstroke_factor, 1.0, "1"
    if name == TAIL and problem.vehicle.tail is not None:
        return problem.vehicle.tail.area, 0.0, "m2"
    return 1.0, 0.0, "1"


def without_term(problem: OrbitProblem, name: str) -> OrbitProblem:
    """Return the problem without one of its terms."""
    if name == TAIL:
        vehicle = dataclasses.replace(problem.vehicle, tail=None)
        return dataclasses.replace(problem, species=problem.species.with_record(vehicle))
    aero = dataclasses.replace(
        problem.aero,
        **{name: _OFF[name]},
        **({"hand_from": BladeElement.hand_from} if name == HAND else {}),
        **({"share": 1.0} if {INFLOW, UNSTEADY, WAKE} & set(terms_on(problem)) == {name} else {}),
    )
    return dataclasses.replace(problem, aero=aero)


def with_trace_of(problem: OrbitProblem, name: str, trace: float) -> OrbitProblem | None:
    """Return the problem with one of its terms scaled to the share `trace`; None if it has no share of its own.

    The compiled programs of the full problem also run this one.
    """
    aero = problem.aero
    if name == TAIL:
        tail = problem.vehicle.tail
        assert tail is not None
        return with_number(problem, ("species", "vehicle", "tail", "area"), trace * tail.area)
    if name == HAND or (name in _SHARED and {*_SHARED} <= {*terms_on(problem)}):
        return None
    if name == UPSTROKE:
        changed = {UPSTROKE: 1.0 - trace}
    elif name == INFLOW:
        changed = {"induced_factor": trace * aero.induced_factor}
    else:  # the share of unsteady terms and lag multiplies the induced factor, too
        changed = {"share": trace, "induced_factor": aero.share * aero.induced_factor / trace}
    return dataclasses.replace(problem, aero=dataclasses.replace(aero, **changed))


def words_without(problem: OrbitProblem, name: str, frequency: float) -> str:
    """Return a sentence: the problem has an orbit of this frequency [Hz] without one of its terms."""
    closes = f"this flight closes at {frequency:.3g} Hz"
    if name == INFLOW:
        ratio = problem.aero.coefficients.aspect_ratio
        why = f"the coefficients, measured on a wing of aspect ratio {ratio:g}, then include its induced flow"
        if math.isinf(ratio):
            why = (
                "the coefficients are stated to be those of a section, without induced flow; if they were measured "
                "on a finite wing, they already include it"
            )
        return f"without momentum inflow {closes}: {why}"
    if name == UNSTEADY:
        return f"without the unsteady terms {closes}: rotation, added mass and couples make the difference"
    if name == WAKE:
        return f"without the lag of the wake {closes}"
    if name == UPSTROKE:
        return f"with upstroke_factor 1 in place of {problem.aero.upstroke_factor:g}, {closes}"
    if name == HAND:
        return f"with the arm's coefficients from root to tip, without those of the hand, {closes}"
    return f"without the tail {closes}"


# Widest ranges of the wingbeat's parameters, beyond which it is hardly a wingbeat any more.
_QUARTER_TURN = 0.5 * math.pi
_ANY_ANGLE = (-_QUARTER_TURN, _QUARTER_TURN)
_ANY_FLAP = (-1.3 * _QUARTER_TURN, 1.3 * _QUARTER_TURN)
_AMPLITUDE = (0.0, _QUARTER_TURN)
_REACH = {
    "frequency": (0.1, 200.0),
    "flap_amplitude": _AMPLITUDE,
    "pitch_amplitude": _AMPLITUDE,
    "sweep_amplitude": _AMPLITUDE,
    "span_retraction": (0.0, 0.9),
    "chord_retraction": (0.0, 0.9),
    "twist_ratio": (0.0, 4.0),
    "downstroke_fraction": (0.1, 0.9),
    "body_pitch": _ANY_ANGLE,
    "flap": _ANY_FLAP,
}
# Range of a harmonic, which is an angle or a share of the span or the chord.
_HARMONIC = (-0.5, 0.5)
# How often a reach with an impossible wingbeat is halved.
_HALVED = 6
# Changes smaller than this share of their scale are rounded as if they were this large.
_LEAST = 1e-3
# Bounds of the frequency, which may move even if the closest wingbeat is not at them: if no start came near an
# orbit, the closest wingbeat does not show which frequency an orbit needs.
WIDER_FREQUENCIES = (("frequency", "<="), ("frequency", ">="))
# What an animal would change first at a given frequency; the twist need not be free.
FIRST = {"frequency": "frequency", "flap_amplitude": "flap amplitude", "twist_ratio": "twist"}


@dataclass(frozen=True)
class Change:
    """A number of a problem (SI and radians) that may move from `old` to `reach`; a change by `scale` is large.

    Its name is a wingbeat parameter, ``body_pitch`` or ``flap`` along the path, a constraint's quantity, ``mass``
    (only the body becomes lighter), ``speed``, ``climb``, ``shoulder`` (ahead of the body's centre of mass) or
    ``incidence`` of the tail. The sign is ``<=`` or ``>=`` for a bound or limit, ``=`` for a fixed number. `tries`
    are first changes, as shares.
    """

    name: str
    sign: str
    old: float
    reach: float
    scale: float
    tries: tuple[float, ...] = ()

    @property
    def widest(self) -> float:
        """The largest distance that the number may move, divided by its scale."""
        return abs(self.reach - self.old) / self.scale

    @property
    def direction(self) -> float:
        """The sign of a change."""
        return math.copysign(1.0, self.reach - self.old)

    def moved(self, share: float) -> float:
        """Return the number moved by a share of its scale, never past its reach."""
        moved = self.old + self.direction * share * self.scale
        return min(max(moved, min(self.old, self.reach)), max(self.old, self.reach))


@dataclass(frozen=True)
class Relaxation:
    """A single change with which a certified orbit was found.

    Parameters
    ----------
    name : the number that changes, as in `Change`, or the term that is removed, one of `terms.TERMS`.
    sign : as in `Change`; ``=`` if a term is removed.
    old, new : the number before and after the change [`unit`]; for a term that can only be on or off (inflow,
        unsteady, wake, hand) they are 1 and 0.
    unit : of `old` and `new`: SI, angles in radians.
    text : the change in words, angles in degrees.

    >>> import wingbeat as wb
    >>> slow = wb.OrbitProblem(wb.load_species("pigeon"), speed=4.0)
    >>> change = wb.Relaxation("speed", "=", 4.0, 5.0, "m/s", "speed 4 -> 5 m/s")  # as in orbit.relaxations
    >>> change.apply(slow).speed
    5.0
    """

    name: str
    sign: str
    old: float
    new: float
    unit: str
    text: str

    def apply(self, problem: OrbitProblem) -> OrbitProblem:
        """Return the problem with the change made.

        Parameters
        ----------
        problem : the problem without an orbit.
        """
        if self.name in TERMS:
            return without_term(problem, self.name)
        return with_change(problem, self.name, self.sign, self.new)


_PLACES: dict[str, Place] = {
    "mass": ("species", "vehicle", "body", "mass"),
    "shoulder": ("species", "vehicle", "wing", "shoulder", 0),
    "incidence": ("species", "vehicle", "tail", "incidence"),
    "speed": ("speed",),
    "climb": ("climb",),
}
_WORDS = {
    "flap_mean": "mean flap",
    "pitch_mean": "mean wing pitch",
    "pitch_amplitude": "wing pitch amplitude",
    "mass": "whole mass",
    "incidence": "tail incidence",
}


def relaxation(problem: OrbitProblem, change: Change, value: float, more: int = 0) -> Relaxation:
    """Return the change to a value (SI), rounded outward to the digits that its text prints.

    `more` are additional steps in the last printed digit.
    """
    name, sign = change.name, change.sign
    limits = [c.quantity.unit for c in problem.subject_to if is_limit(c, name, sign)]
    unit = limits[0] if limits else plain_unit(name)
    factor, shown = (1e3, "mm") if unit == "m" else for_people(cf(unit))
    new = rounded_outward(change, value, factor, more)
    side = "upper" if sign == "<=" else "lower"
    words = _WORDS.get(name, name.replace("_", " "))
    words = f"{side} limit of {name}" if limits else words if sign == "=" else f"{side} bound of {words}"
    text = f"{words} {change.old * factor:.6g} -> {new * factor:.9g}"
    text += f" {shown}" if shown else ""
    if name == "mass":
        text += f" ({100 * (new / change.old - 1):.2g} %, by a lighter body)"
    return Relaxation(name, sign, change.old, new, unit, text)


def with_change(problem: OrbitProblem, name: str, sign: str, value: float) -> OrbitProblem:
    """Return the problem with one number set, named as in `Change`."""
    limits = [i for i, c in enumerate(problem.subject_to) if is_limit(c, name, sign)]
    place: Place
    if name in _PLACES:
        place = _PLACES[name]
    elif limits:
        place = "subject_to", limits[0], "limit"
    elif sign == "=":
        place = "species", "wingbeat", name
    else:
        place = "bounds", name, int(sign == "<=")
    return with_number(problem, place, value - 2.0 * problem.vehicle.wing.mass if name == "mass" else value)


def is_limit(constraint: Constraint, name: str, sign: str) -> bool:
    """Return whether a constraint is the limit with this name and sign."""
    return constraint.quantity.name == name and constraint.at_most is (sign == "<=")


def possible_changes(
    problem: OrbitProblem,
    at_bounds: Iterable[tuple[str, str]],
    short: Mapping[str, float],
    options: ChangeOptions = DEFAULTS.changes,
) -> Iterator[Change]:
    """Yield the changes that may make a problem feasible.

    The closest wingbeat is at the bounds `at_bounds`, (name, sign), and `short` of each balance by a share of the
    weight, or of weight times chord.
    """

    def towards(name: str, sign: str, old: float, upper: bool, tries: tuple[float, ...]) -> Iterator[Change]:
        """Yield the change of a wingbeat parameter, up or down, if this relaxes the problem."""
        reach = _reach(problem, name, old, upper, options.wide_frequency)
        scale = options.large_angle if name in (*ANGLES, *PATH_NAMES) else max(abs(old), 0.1)
        if {"<=": reach > old, ">=": reach < old}.get(sign, reach != old):
            yield Change(name, sign, old, reach, scale, tries)

    def tries_for(law: str, *others: float) -> tuple[float, ...]:
        """Return first tries: lighter by the missing lift, or sinking for the thrust, is close to an orbit."""
        return (options.beyond * abs(short[law]), *others) if law in short else others

    limited = set()
    for constraint in problem.subject_to:
        name, sign, old = constraint.quantity.name, "<=" if constraint.at_most else ">=", float(constraint.limit)
        limited.add((name, sign))
        scale = abs(old) or constraint.quantity.scale
        factor = options.limit_factor if constraint.at_most else -options.limit_factor
        yield Change(name, sign, old, old + factor * scale, scale)
    for name, sign in dict.fromkeys((*at_bounds, *WIDER_FREQUENCIES)):
        if name in problem.bounds and (name, sign) not in limited:
            upper = sign == "<="
            tries = options.raised_frequency if (name, upper) == ("frequency", True) else ()
            yield from towards(name, sign, float(problem.bounds[name][upper]), upper, tries)
    twist = ["twist_ratio"] if holds_frequency(problem) else []
    for name in dict.fromkeys((*problem.species.bounds, *twist)):
        if name not in problem.free:
            tries = (0.1, 0.3, *options.raised_frequency) if name == "frequency" else (0.1, 0.3)
            for upper in (False, True):
                yield from towards(name, "=", float(parameter(problem.species.wingbeat, name)), upper, tries)
    wing = problem.vehicle.wing
    mass, wings, ahead = problem.vehicle.mass, 2.0 * wing.mass, wing.shoulder[0]
    yield Change("mass", "=", mass, wings + options.lightest * (mass - wings), mass, tries_for(LIFT, 0.3, 0.6))
    brisk = max(problem.speed, options.low_speed)
    fastest = min(problem.speed + options.faster * brisk, FASTEST)
    slowest = options.slowest * problem.speed if problem.needs_speed else 0.0
    steepest = max(problem.climb - brisk, -FASTEST_CLIMB)
    for name, old, reach, tries in (
        ("speed", problem.speed, fastest, (0.3, 1.0, 2.5)),
        ("speed", problem.speed, slowest, (0.3,)),
        ("climb", problem.climb, steepest, tries_for(THRUST, 0.2, 0.4)),
    ):
        if reach != old:
            yield Change(name, "=", old, reach, brisk, tries)
    tail = problem.vehicle.tail
    for way in (1.0, -1.0):
        tilted = 0.5 * way * _QUARTER_TURN  # of a tail, up or down
        if tail is not None and "tail_tilt" not in problem.free and way * (tilted - tail.incidence) > 0:
            yield Change("incidence", "=", tail.incidence, tilted, options.large_angle, (0.1, 0.3))
        reach = ahead + way * options.chords * wing.mean_chord
        yield Change("shoulder", "=", ahead, reach, wing.mean_chord, tries_for(MOMENT, 0.2, 0.6))


def holds_frequency(problem: OrbitProblem) -> bool:
    """Return whether the frequency of a problem is given."""
    return "frequency" not in problem.free


def in_turn(changes: Iterable[Change]) -> list[Change]:
    """Return changes in the order in which they are tried at a given frequency; a slower beat comes last."""

    def turn(change: Change) -> int:
        slower = change.name == "frequency" and change.direction < 0
        return len(FIRST) + 1 if slower else [*FIRST, change.name].index(change.name)

    return sorted(changes, key=turn)


def _reach(problem: OrbitProblem, name: str, old: float, upper: bool, wide: float) -> float:
    """Return the farthest value, up or down, of a wingbeat parameter for which a wingbeat is still possible."""
    reach = _HARMONIC if harmonic_place(name) else _REACH.get(name, _ANY_ANGLE)
    far = reach[upper]
    if name == "frequency":
        far = max(far, wide * old) if upper else min(far, old / wide)
    for _ in range(_HALVED):
        try:
            with_parameters(problem.species.wingbeat, {} if name in PATH_NAMES else {name: far})
        except InvalidInputError:
            far = 0.5 * (old + far)
        else:
            return far
    return old


def rounded_outward(change: Change, value: float, factor: float, more: int = 0) -> float:
    """Return a value (SI) rounded away from `old`, to two digits of the change in the unit of SI times `factor`."""
    moved = max(abs(value - change.old), _LEAST * change.scale) * factor
    digits = 1 - math.floor(math.log10(moved))
    way = change.direction
    steps = math.ceil(round(way * value * factor * 10.0**digits, 3)) + more
    printed = round(way * steps * 10.0**-digits, digits)
    return min(max(printed / factor, min(change.old, change.reach)), max(change.old, change.reach))
