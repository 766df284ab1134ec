"""Quantities of a beat that can be minimised, limits on them, and the limits of plausible problems.

>>> import wingbeat as wb
>>> cost = wb.objectives.PowerCost(returned=0.5)
>>> wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0, minimise=cost).minimise.name
'power_cost(0.5)'
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from wingbeat._base import NOMENCLATURE, Fault, FaultList, InvalidInputError, plain, plain_unit, suggest
from wingbeat._jax.arrays import jnp
from wingbeat.animal.kinematics import ANGLES, FREE_NAMES, parameter
from wingbeat.animal.species.numbers import JUDGED, Range, free_name
from wingbeat.animal.species.species import Species
from wingbeat.animal.vehicle import Air
from wingbeat.orbits.flight.beat import Beat, spread
from wingbeat.orbits.problem.quantity import MAP_QUANTITIES, OF_DRIVE, Quantity, SpringCost


@dataclass(frozen=True)
class _Series:
    """A series of the beat."""

    name: str

    def __call__(self, beat: Beat) -> Any:
        return getattr(beat, self.name)


@dataclass(frozen=True)
class _Size(_Series):
    """The absolute value of a series."""

    def __call__(self, beat: Beat) -> Any:
        return jnp.abs(getattr(beat, self.name))


@dataclass(frozen=True)
class _Cost:
    """The mean of a power if a share of its negative work is returned."""

    power: str
    returned: float

    def __call__(self, beat: Beat) -> Any:
        power = getattr(beat, self.power)
        positive = beat.mean_positive(power)
        return positive - self.returned * (positive - beat.mean(power))


def Frequency() -> Quantity:
    """Return the wingbeat frequency, which Su et al. 2023 (doi 10.48550/arXiv.2302.09602) minimise.

    >>> Frequency().name, Frequency().unit
    ('frequency', 'Hz')
    """
    return Quantity("frequency", _Series("frequency"), plain_unit("frequency"), 3.0, "frequency")


def PowerCost(returned: float = 0.0) -> Quantity:
    """Return the mean hinge power if only a share of the negative work is returned.

    Parameters
    ----------
    returned : share of the negative work that is returned. With 0, negative work costs nothing and is lost. With 1,
        it is fully returned, and the cost is the mean power. With a number between, it is partly returned. With -1,
        negative work costs as much as positive work.

    Raises
    ------
    InvalidInputError : not a number from -1 to 1.

    >>> PowerCost(0.3).name
    'power_cost(0.3)'
    """
    faults = FaultList()
    fix = "0 means that negative work is lost, 1 that it is returned"
    faults.number("returned", returned, at_least=-1, at_most=1, fix=fix)
    faults.raise_if_any()
    name = f"power_cost({_exactly(returned)})"
    return Quantity(name, _Cost("hinge_power", float(returned)), plain_unit("power_cost"))


def SpringPower(stiffness: float, rest_angle: float | None = None) -> Quantity:
    """Return the mean positive hinge power with springs at the flap hinges.

    A spring's torque is ``-k (flap - rest)``; the actuator's torque is the hinge torque minus the spring's torque.
    The actuator's negative work costs nothing and is lost. Without a spring, this is ``mean_positive_power``.

    Parameters
    ----------
    stiffness : k of both springs together [N m/rad].
    rest_angle : flap angle at which they exert no torque [rad]; default the middle of the stroke.

    Raises
    ------
    InvalidInputError : a stiffness that is negative, a rest angle beyond half a turn, a number that is not finite.

    >>> SpringPower(0.5).name, SpringPower(0.5, -0.1).name
    ('spring_power(0.5)', 'spring_power(0.5,-0.1)')
    """
    faults = FaultList()
    faults.number("stiffness", stiffness, at_least=0, unit=plain_unit("stiffness"), fix="the sum of both springs")
    if rest_angle is not None:
        faults.number("rest_angle", rest_angle, at_least=-math.pi, at_most=math.pi, unit=plain_unit("rest_angle"))
    faults.raise_if_any()
    numbers = [float(stiffness)] if rest_angle is None else [float(stiffness), float(rest_angle)]
    name = f"spring_power({','.join(map(_exactly, numbers))})"
    return Quantity(name, SpringCost(*numbers), plain_unit("spring_power"))


def _exactly(number: float) -> str:
    """Return the shortest text that reads back as the same number."""
    return repr(float(number)).removesuffix(".0")


def _cost_of_transport(beat: Beat) -> Any:
    return beat.mean_positive(beat.hinge_power) / (beat.weight * beat.speed)


def _power_per_mass(beat: Beat) -> Any:
    return beat.mean_positive(beat.hinge_power) / beat.mass


def _force_over_weight(beat: Beat) -> Any:
    squared = beat.force_x**2 + beat.force_z**2
    pushed = squared > 0.0  # the root has no derivative at 0
    return jnp.where(pushed, jnp.sqrt(jnp.where(pushed, squared, 1.0)), 0.0) / beat.weight


def _strouhal(beat: Beat) -> Any:
    return 2.0 * beat.frequency * beat.semi_span * jnp.sin(beat.flap_amplitude) / beat.speed


def _pitch_spread(beat: Beat) -> Any:
    return spread(beat.body_pitch)


def _mean_pitch(beat: Beat) -> Any:
    return beat.mean(beat.body_pitch)


def _roughness(beat: Beat) -> Any:
    return jnp.sqrt(beat.mean(beat.u_rate**2 + beat.w_rate**2))


def _known(
    name: str, of: Callable[[Beat], Any], scale: float = 1.0, in_hover: str | None = None, needs: str | None = None
) -> Quantity:
    """Return a quantity with the unit that the table of names gives it."""
    return Quantity(name, of, plain(NOMENCLATURE[name].unit), scale, in_hover=in_hover, needs=needs)


QUANTITIES: dict[str, Quantity] = {
    quantity.name: quantity
    for quantity in (
        Frequency(),
        _known("mean_power", _Cost("hinge_power", 1.0)),
        _known("mean_positive_power", _Cost("hinge_power", 0.0)),
        _known("peak_power", _Series("hinge_power"), 5.0),
        _known("mean_actuator_power", _Cost("actuator_power", 1.0)),
        _known("peak_actuator_power", _Series("actuator_power"), 5.0),
        _known("positive_power_per_mass", _power_per_mass, 10.0),
        _known("cost_of_transport", _cost_of_transport, 0.1, "use mean_positive_power"),
        _known("peak_force_over_weight", _force_over_weight, 0.5),
        _known("strouhal", _strouhal, 0.1, "limit frequency and flap_amplitude"),
        _known("peak_flap_torque", _Size("flap_torque"), 0.1),
        _known("peak_pitch_torque", _Size("pitch_torque"), 0.01),
        _known("mean_body_pitch", _mean_pitch, 0.1),
        _known("body_pitch_range", _pitch_spread, 0.1),
        _known("roughness", _roughness, 5.0),
        *(
            _known(name, of, scale, needs=needs)
            for needs, found in OF_DRIVE.items()
            for name, (of, scale) in found.items()
        ),
    )
}
# Short names on the command line.
_SHORT = {"power": "mean_power", "positive_power": "mean_positive_power"}

NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_POWER_COST = re.compile(rf"power_cost\(({NUMBER})\)")
_SPRING_POWER = re.compile(rf"spring_power\(({NUMBER})(?:,\s*({NUMBER}))?\)")


def named_quantity(name: str) -> Quantity:
    """Return the quantity of this name.

    Theory: equation ``quantities``.

    Parameters
    ----------
    name : such as ``mean_power``, or with a number as in ``power_cost(0.5)``.

    Raises
    ------
    InvalidInputError : no quantity has this name.
    """
    if found := _POWER_COST.fullmatch(str(name)):
        return PowerCost(float(found[1]))
    if found := _SPRING_POWER.fullmatch(str(name)):
        return SpringPower(*(float(number) for number in found.groups() if number is not None))
    every = QUANTITIES | MAP_QUANTITIES
    if name not in every:
        known = f"known quantities are {', '.join(every)}"
        others = f"{known}; power_cost and spring_power take a number, such as power_cost(0.5)"
        fix = suggest(str(name), every, most=1, otherwise=others)
        raise InvalidInputError([Fault("quantity", name, "is not known to wingbeat", fix)])
    return every[name]


def named_objective(name: str) -> Quantity:
    """Return the objective of this name; hyphens may replace underscores, as on the command line.

    Parameters
    ----------
    name : as in `named_quantity`, or a short one such as ``power``.

    Raises
    ------
    InvalidInputError : no quantity has this name.
    """
    word, bracket, numbers = str(name).partition("(")
    name = word.replace("-", "_") + bracket + numbers  # a hyphen in the brackets is a minus sign
    return named_quantity(_SHORT.get(name, name))


# --- Limits. ---
FASTEST = FASTEST_CLIMB = 100.0  # largest speed, climb and descent of a problem [m/s]


@dataclass(frozen=True)
class Constraint:
    """A limit on a quantity.

    Parameters
    ----------
    quantity : a `Quantity`, or the name of one.
    limit : in the unit of the quantity.
    at_most : True for an upper limit, False for a lower one. A limit on a series applies to its maximum:
        an upper limit therefore holds at every instant, a lower limit at one instant or more.

    Raises
    ------
    InvalidInputError : an unknown quantity, a limit that is not finite, an angle above pi.

    >>> import wingbeat as wb
    >>> limit = wb.Constraint("peak_power", 30.0)
    >>> str(limit)
    'peak_power<=30'
    >>> wb.OrbitProblem(wb.load_species("pigeon"), speed=10.0, subject_to=[limit]).subject_to == (limit,)
    True
    """

    quantity: Quantity
    limit: float
    at_most: bool = True

    def __post_init__(self) -> None:
        faults = FaultList()
        if isinstance(self.quantity, str):
            object.__setattr__(self, "quantity", named_quantity(self.quantity))
        if not isinstance(self.quantity, Quantity):
            faults.add("constraint.quantity", self.quantity, "is not a Quantity", "give a Quantity or its name")
        faults.number("constraint.limit", self.limit)
        faults.raise_if_any()
        if QUANTITIES.get(self.quantity.name) == self.quantity and self.quantity.unit == "rad":
            advice = f"write '{self} deg' or np.radians({self.limit:g})"
            faults.angle("constraint.limit", self.limit, advice=advice)
        faults.raise_if_any()

    def __str__(self) -> str:
        return f"{self.quantity.name}{'<=' if self.at_most else '>='}{self.limit:g}"


_EXPRESSION = re.compile(rf"\s*([\w.+-]+(?:\([^()]*\))?)\s*(<=|>=)\s*({NUMBER})\s*(deg)?\s*")


def parse_constraint(text: str) -> Constraint:
    """Return the constraint in a text such as ``peak_power<=30`` or ``body_pitch_range <= 10 deg``.

    >>> str(parse_constraint("peak_power <= 30"))
    'peak_power<=30'
    """
    found = _EXPRESSION.fullmatch(str(text))
    if found is None:
        fix = "for example peak_power<=30 or 'body_pitch_range <= 10 deg'"
        raise InvalidInputError([Fault("constraint", text, "must be a quantity, <= or >=, and a number", fix)])
    name, sign, number, degrees = found.groups()
    quantity = named_quantity(name)
    if degrees and quantity.unit != "rad":
        rule = f"gives {name} in degrees, but its unit is {quantity.unit}"
        raise InvalidInputError([Fault("constraint", text, rule, "leave out deg")])
    limit = math.radians(float(number)) if degrees else float(number)
    return Constraint(quantity, limit, sign == "<=")


class WingbeatLimit(NamedTuple):
    """A wingbeat parameter fixed at a value (``=``), or limited to it from above or below, SI and radians."""

    name: str
    sign: str
    value: float


_LIMIT = re.compile(rf"\s*([\w.]+)\s*(<=|>=|=)\s*({NUMBER})\s*(deg)?\s*")


def parse_wingbeat_limit(text: Any) -> WingbeatLimit | None:
    """Return the limit of a wingbeat parameter in a text, or None if the text has another meaning.

    >>> parse_wingbeat_limit("frequency = 6").value
    6.0
    """
    found = _LIMIT.fullmatch(text) if isinstance(text, str) else None
    name = "" if found is None else free_name(found[1])
    if found is None or name not in FREE_NAMES or (found[4] and name not in ANGLES):
        return None
    if name == "frequency" and found[2] != "=":  # a constraint like any other
        return None
    value = float(found[3])
    return WingbeatLimit(name, found[2], math.radians(value) if found[4] else value)


def read_limits(given: Sequence[Any], faults: FaultList) -> tuple[list[WingbeatLimit], list[Constraint]]:
    """Return the limits of wingbeat parameters and those of quantities; of two on the same side, the tighter one.

    >>> [str(one) for one in read_limits(["peak_power<=30", "peak_power<=40", "peak_power<=30.0"], FaultList())[1]]
    ['peak_power<=30']
    """
    parameters: dict[tuple[str, str], tuple[float, WingbeatLimit]] = {}
    quantities: dict[tuple[str, str], tuple[float, Constraint]] = {}
    for i, one in enumerate(given):
        limit = one if isinstance(one, WingbeatLimit) else parse_wingbeat_limit(one)
        if limit is not None:
            if limit.name not in ANGLES or faults.angle(limit.name, limit.value, advice=f"write '{one} deg'"):
                _add(parameters, (limit.name, limit.sign), limit.value, limit, faults)
            continue
        try:
            constraint = parse_constraint(one) if isinstance(one, str) else one
        except InvalidInputError as error:
            faults.faults.extend(error.faults)
            continue
        if isinstance(constraint, Constraint):
            sign = "<=" if constraint.at_most else ">="
            _add(quantities, (constraint.quantity.name, sign), constraint.limit, constraint, faults)
        else:
            faults.add(f"subject_to[{i}]", one, "is not a constraint", "for example 'peak_power<=30'")
    return [limit for _, limit in parameters.values()], [limit for _, limit in quantities.values()]


def _add(
    kept: dict[tuple[str, str], Any], key: tuple[str, str], value: float, limit: Any, faults: FaultList
) -> None:
    """Keep a limit unless there is a tighter one on the same side; note one that contradicts another."""
    name, sign = key
    values = {side: kept[name, side][0] for side in ("=", "<=", ">=") if (name, side) in kept}
    opposite = {"<=": ">=", ">=": "<="}.get(sign)
    if sign == "=" and values.get("=", value) != value:
        faults.add("subject_to", f"{name}={value:g}", f"is fixed at {values['=']:g} too", "keep one of the two")
    elif opposite in values and (values[opposite] > value if sign == "<=" else value > values[opposite]):
        rule = f"contradicts {name}{opposite}{values[opposite]:g}"
        faults.add("subject_to", f"{name}{sign}{value:g}", rule, "keep one of the two, or exchange the signs")
    if sign not in values or (value < values[sign] if sign == "<=" else value > values[sign]):
        kept[key] = value, limit


# --- Plausible problems: bounds narrowed to the species' ranges, and limits on quantities of the beat. ---
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
            rule = f"does not overlap with the plausible range ({_in_words(known)})"
            faults.add(f"bounds.{name}", bounds[name], rule, f"widen the bounds, or {_WAY_OUT}")
    for name in JUDGED:
        if name in FREE_NAMES and name not in free:
            value, known = parameter(species.wingbeat, name), species.plausible_range(name, 0.0)
            if _outside(value, known):
                rule = f"is fixed outside the plausible range ({_in_words(known)})"
                faults.add(f"wingbeat.{name}", value, rule, _WAY_OUT)
    return drawn


def plausible_limits(species: Species, speed: float, air: Air, faults: FaultList) -> tuple[Constraint, ...]:
    """Return the limits that keep quantities of the beat plausible at a speed [m/s]."""
    limits = []
    for name in judged_names(species, ()):
        known = species.plausible_range(name, speed)
        if name == "reynolds":  # which no wingbeat changes
            reynolds = air.reynolds(speed, species.vehicle.wing.mean_chord)
            if speed > 0 and _outside(reynolds, known):
                there = f"outside the plausible range ({_in_words(known)})"
                rule = f"gives a Reynolds number of {reynolds:.3g}, {there}"
                faults.add("speed", speed, rule, _WAY_OUT)
        elif name not in FREE_NAMES and not (name == "strouhal" and speed == 0):
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


def _in_words(known: Range) -> str:
    """Return a range in words, angles in degrees: ``19 to 52 deg``."""
    angle = known.unit == "rad"
    unit = "" if known.unit == "1" else " deg" if angle else f" {known.unit}"
    low, high = (None if end is None else math.degrees(end) if angle else end for end in known[:2])
    if low is None or high is None:
        return f"at least {low:.4g}{unit}" if high is None else f"at most {high:.4g}{unit}"
    return f"{low:.4g} to {high:.4g}{unit}"
