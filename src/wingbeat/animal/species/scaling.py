"""Laws that give an animal's numbers: sizes, masses and wingbeat from mass, span and area; flight muscle; a tail.

This file has the formulas; `scaling.toml` says of each law where it comes from, how far animals scatter around it,
and the data to which it was fitted.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

from wingbeat.aero.closed_forms import slender_slope
from wingbeat.animal.drive import MUSCLE_DENSITY
from wingbeat.animal.species.numbers import FREQUENCY, OUTSIDE, Number, OwnFrequency, frequency_of

_TABLE = tomllib.loads(Path(__file__).with_suffix(".toml").read_text(encoding="utf-8"))


@dataclass(frozen=True)
class Data:
    """The data a law was fitted to: the range of each input by its symbol, in SI units, and where it was read."""

    ranges: dict[str, tuple[float, float]]
    where: str


@dataclass(frozen=True)
class Law:
    """A number of an animal as a function of others, in SI units, with its source and how far animals scatter.

    The `inputs` are symbol and unit of each value that it takes; `spread` is the lowest and highest ratio of
    measured values to what the law gives, and `scatter` says where that comes from; `beyond` says how the law
    continues outside its data, if not by its formula.

    >>> number = BIRD_WING_MASS.number(0.316)
    >>> f"{number.value:.4f} {number.unit}"
    '0.0199 kg'
    """

    unit: str
    formula: str
    inputs: tuple[str, ...]
    function: Callable[..., float]
    source: str
    spread: tuple[float, float]
    scatter: str
    data: Data
    beyond: str = ""

    def __call__(self, *values: float) -> float:
        """Return what the law gives."""
        return self.function(*values)

    def number(self, *values: float) -> Number:
        """Return what the law gives, marked as derived, with its spread as the plausible range."""
        value, (low, high) = self(*values), self.spread
        where = ", ".join(_told(*pair) for pair in zip(self.inputs, values, strict=True))
        formula = f"{self.formula} at {where}" if where else self.formula
        source = f"derived: {formula} ({self.source}); spread {low:g} to {high:g} times: {self.scatter}"
        return Number(value, self.unit, source + self.outside(*values), (low * value, high * value))

    def outside(self, *values: float) -> str:
        """Return which of these values are outside the law's data, as text to append to a source; empty if none."""
        found = []
        for pair, value in zip(self.inputs, values, strict=True):
            symbol, unit = pair.split()
            low, high = self.data.ranges.get(symbol, (-math.inf, math.inf))
            if not low <= value <= high:
                found.append(f"{_told(pair, value)}, data {low:.4g} to {high:.4g} {unit}")
        beyond = f"; there {self.beyond}" if self.beyond else ""
        return f"; {OUTSIDE}{' and '.join(found)} ({self.data.where}){beyond}" if found else ""


def _told(symbol_and_unit: str, value: float) -> str:
    symbol, unit = symbol_and_unit.split()
    return f"{symbol} = {value:.4g} {unit}"


def _words(text: str) -> str:
    """Return a text of the table on one line, with the papers that it names in braces."""
    papers = _TABLE["papers"]
    return " ".join(text.format(**papers).format(**papers).split())  # twice: a paper may name another


def _law(name: str, formula: str, function: Callable[..., float]) -> Law:
    told: dict[str, Any] = _TABLE["laws"][name]
    ranges = dict(_TABLE["data"][told["data"]])
    where, scaled = ranges.pop("where"), ranges.pop("scaled", None)
    if scaled:
        ranges["m"] = scaled / 27, scaled * 27
    data = Data({symbol: (low, high) for symbol, (low, high) in ranges.items()}, where)
    inputs, (low, high) = tuple(told.get("inputs", ())), told["spread"]
    source, scatter, beyond = (_words(told.get(part, "")) for part in ("source", "scatter", "beyond"))
    return Law(told["unit"], formula, inputs, function, source, (low, high), scatter, data, beyond)


# --- lengths ---

BIRD_MASS = _law("bird_mass", "(b / 1.137)^(1/0.396)", lambda span: (span / 1.137) ** (1 / 0.396))
BIRD_SEMI_SPAN = _law("bird_semi_span", "0.464 b", lambda span: 0.464 * span)
HALF_SPAN = _law("half_span", "b/2", lambda span: 0.5 * span)
MEAN_CHORD = _law("mean_chord", "S/b", lambda span, area: area / span)
# Span over mean chord: the range of a whole table of birds, or a guess.
BIRD_ASPECT_RATIO = (3.6, 16.6), "all of 613 bird species in BirdWingData_tidy_ver2.1"
BAT_ASPECT_RATIO = (4.0, 12.0), "a guess around the 6 of the built-in bat and the 7 to 9 of 24 noctules"
ROBOT_ASPECT_RATIO = (2.5, 10.0), "a guess around the 3.4 to 7.0 of four robots"

# --- masses and moments of inertia ---

BIRD_WING_MASS = _law("bird_wing_mass", "0.0706 m^1.098", lambda mass: 0.0706 * mass**1.098)
BAT_WING_MASS = _law("bat_wing_mass", "0.07 m", lambda mass: 0.07 * mass)
ROBOT_WING_MASS = _law("robot_wing_mass", "0.042 m", lambda mass: 0.5 * (0.103 - 0.0943) / 0.103 * mass)
BIRD_FLAP_INERTIA = _law(
    "bird_flap_inertia", "0.118 (m_w l^2)^1.040", lambda wing_mass, length: 0.118 * (wing_mass * length**2) ** 1.040
)
BAT_FLAP_INERTIA = _law(
    "bat_flap_inertia",
    "twice the birds' 0.118 (m_w l^2)^1.040",
    lambda wing_mass, length: 2 * BIRD_FLAP_INERTIA(wing_mass, length),
)
ROBOT_MASS_EXPONENT = _law(
    "robot_mass_exponent", "1.1, a wing whose centre of mass is at 0.32 of its length", lambda: 1 / 0.32 - 2
)
BIRD_PITCH_INERTIA = _law(
    "bird_pitch_inertia", "2.6e-4 (m / 0.26)^(5/3)", lambda mass: 2.6e-4 * (mass / 0.26) ** (5 / 3)
)
BAT_PITCH_INERTIA = _law(
    "bat_pitch_inertia", "2.4e-5 (m / 0.068)^(5/3)", lambda mass: 2.4e-5 * (mass / 0.068) ** (5 / 3)
)
ROBOT_PITCH_INERTIA = _law(
    "robot_pitch_inertia", "3.0e-4 (m / 0.103)^(5/3)", lambda mass: 3.0e-4 * (mass / 0.103) ** (5 / 3)
)
BODY_DRAG_AREA = _law(
    "body_drag_area",
    "drag coefficient 0.2 (Klein Heerenbrink 2016, jackdaw, doi 10.1242/jeb.132480) times 0.00813 m^0.666",
    lambda mass: 0.2 * 0.00813 * mass**0.666,
)
CROSSFLOW_AREA = _law(
    "crossflow_area",
    "0.6 times 1.2 times 3, an ellipsoid's planform over its frontal area, times 0.00813 m^0.666",
    lambda mass: 0.6 * 1.2 * 3.0 * 0.00813 * mass**0.666,
)
BODY_HALF_WIDTH = _law(
    "body_half_width",
    "(0.00813 m^0.666 / pi)^(1/2), the radius of a circle of the body's frontal area",
    lambda mass: math.sqrt(0.00813 * mass**0.666 / math.pi),
)


def exponent_of_inertia(share: float) -> float:
    """Return the p of strip masses ``(1 - s/L)**p`` that gives a flap inertia; 0, a uniform wing, if none does.

    The share is the inertia about the shoulder, divided by wing mass times length squared: ``2/((p + 2) (p + 3))``.

    >>> exponent_of_inertia(1 / 3), round(exponent_of_inertia(0.1), 9)
    (0.0, 2.0)
    """
    return max(0.0, 0.5 * (math.sqrt(1 + 8 / share) - 5))


def mass_exponent(law: Law, wing_mass: float, length: float) -> Number:
    """Return the mass exponent for which a wing of this mass [kg] and length [m] has the flap inertia of a law."""
    inertia, whole = law(wing_mass, length), wing_mass * length**2
    low, high = law.spread
    source = (
        f"derived: gives the wing the flap inertia {inertia:.3g} kg m2, {law.formula} at m_w = {wing_mass:.4g} kg, "
        f"l = {length:.4g} m ({law.source}); "
        f"spread {low:g} to {high:g} times the inertia: {law.scatter}{law.outside(wing_mass, length)}"
    )
    limits = exponent_of_inertia(high * inertia / whole), exponent_of_inertia(low * inertia / whole)
    return Number(exponent_of_inertia(inertia / whole), "1", source, limits)


# --- the wingbeat, and the cruise ---


def _pennycuick(mass: float, span: float, area: float, density: float, gravity: float) -> float:
    return mass ** (3 / 8) * gravity**0.5 * span ** (-23 / 24) * area ** (-1 / 3) * density ** (-3 / 8)


def _bullen(mass: float, speed: float) -> float:
    """Return a bat's frequency. Outside the law's masses, a power of mass: the law fails from 10 kg up."""
    lightest, heaviest = BAT_FREQUENCY.data.ranges["m"]
    inside = min(max(mass, lightest), heaviest)
    fitted = 5.54 - 3.068 * math.log10(inside) - 2.857 * math.log10(speed)
    return fitted * (mass / inside) ** -0.26


FREQUENCY_BY_MASS = _law("frequency_by_mass", "3.228 m^-0.440", lambda mass: 3.228 * mass**-0.440)
FREQUENCY_BY_WING = _law("frequency_by_wing", "1.807 l^-1.055", lambda length: 1.807 * length**-1.055)
BIRD_FREQUENCY = _law("bird_frequency", "m^3/8 g^1/2 b^-23/24 S^-1/3 rho^-3/8", _pennycuick)
ROBOT_FREQUENCY = _law("robot_frequency", BIRD_FREQUENCY.formula, _pennycuick)
BAT_FREQUENCY = _law("bat_frequency", "5.54 - 3.068 log10 m - 2.857 log10 V", _bullen)
# The law of bats is nearly straight between these speeds [m/s]. At one speed it is right to 1 Hz for 21 of its 23
# species; outside the law's masses, the band keeps its share of the frequency.
_SPEEDS, _BAND = (2.0, 4.0, 6.0, 8.0, 10.0), 1.0


def bat_frequencies(mass: float) -> tuple[OwnFrequency, ...]:
    """Return the frequency by speed of a bat of this mass [kg], by the law of bats.

    >>> [(round(one.value, 2), round(one.range[1] - one.value, 2)) for one in bat_frequencies(0.068)][:2]
    [(8.26, 1.0), (7.4, 1.0)]
    """
    lightest, heaviest = BAT_FREQUENCY.data.ranges["m"]
    inside, found = min(max(mass, lightest), heaviest), []
    for speed in _SPEEDS:
        value = BAT_FREQUENCY(mass, speed)
        band = _BAND * value / BAT_FREQUENCY(inside, speed)
        source = (
            f"derived: {BAT_FREQUENCY.formula} at m = {mass:.4g} kg, V = {speed:g} m/s ({BAT_FREQUENCY.source}); "
            f"{band:.2g} Hz more or less, as for 21 of the 23 species{BAT_FREQUENCY.outside(mass, speed)}"
        )
        found.append(OwnFrequency(value, (value - band, value + band), "law", source, (speed, speed)))
    return tuple(found)


def frequencies_by_law(kind: str, numbers: Mapping[str, Number]) -> tuple[OwnFrequency, ...]:
    """Return the frequencies by speed of a bat whose own was neither measured nor given; else nothing."""
    if kind != "bat" or frequency_of(numbers[FREQUENCY], kind).basis not in ("law", "guess"):
        return ()
    return bat_frequencies(cast(float, numbers["vehicle.mass"].value))


BIRD_FLAP_AMPLITUDE = _law(
    "bird_flap_amplitude", "half of 67 b^-0.24 degrees", lambda span: math.radians(33.5 * span**-0.24)
)
BAT_FLAP_AMPLITUDE = _law(
    "bat_flap_amplitude",
    "half of 56.92 + 5.18 V + 16.06 log10 S degrees",
    lambda speed, area: math.radians(0.5 * (56.92 + 5.18 * speed + 16.06 * math.log10(area))),
)
ROBOT_FLAP_AMPLITUDE = _law(
    "robot_flap_amplitude", "half of 81 degrees", lambda: math.radians(0.5 * (80 + 105 + 50 + 90) / 4)
)
CRUISE_BY_MASS = _law("cruise_by_mass", "15.9 m^0.13", lambda mass: 15.9 * mass**0.13)

# --- flight muscle ---

# The largest power of isotonic contractions [W/kg], and the share of the largest speed at which it was reached. We
# found no published speed of shortening of a bird's flight muscle. It is derived from this power, of a cockatiel's
# pectoralis, and the isometric stress. The stress is a guess, but its product with the speed is measured.
_POWER, _SHARE = 533.0, 0.34
# Mass of the deltoids, which raise the wing too, divided by that of the pectoralis; read in no other birds.
_DELTOIDS = 0.2
DEPRESSOR_MASS = _law("depressor_mass", "0.1392 m^0.996", lambda mass: 0.1392 * mass**0.996)
ELEVATOR_SHARE = _law(
    "elevator_share",
    "0.112 m^0.016 + 0.2",
    lambda mass: 0.0156 * mass**1.012 / DEPRESSOR_MASS(mass) + _DELTOIDS,
)
BAT_DEPRESSOR_MASS = _law("bat_depressor_mass", "0.12 m", lambda mass: 0.12 * mass)
BAT_ELEVATOR_SHARE = _law("bat_elevator_share", "1/3", lambda: 1 / 3)
STRAIN_PER_ANGLE = _law("strain_per_angle", "0.15", lambda: 0.15)
ISOMETRIC_STRESS = _law("isometric_stress", "250 kPa", lambda: 250e3)
MAX_STRAIN_RATE = _law(
    "max_strain_rate",
    "rho P / (q^2 sigma)",
    lambda density, power, share, stress: density * power / (share**2 * stress),
)
# The tendon is in series with the supracoracoideus, whose share of the elevators' torque is 0.44 in a pigeon.
TENDON_COMPLIANCE = _law(
    "tendon_compliance",
    "0.44^2 / 0.15 (m / 0.316)^(-4/3)",
    lambda mass: 0.44**2 / 0.15 * (mass / 0.316) ** (-4 / 3),
)
ACTIVATION_ENERGY = _law("activation_energy", "5 J/kg", lambda: 5.0)
RECOVERY_FACTOR = _law("recovery_factor", "2", lambda: 2.0)
BIRD_RESTING_RATE = _law("bird_resting_rate", "3.52 m^0.669", lambda mass: 3.52 * mass**0.669)
BAT_RESTING_RATE = _law("bat_resting_rate", "3.14 m^0.744", lambda mass: 3.14 * mass**0.744)
SUPPORT_FACTOR = _law("support_factor", "1.1", lambda: 1.1)


def _rigid(mass: float, bat: bool) -> str:
    """Return why the elevators' tendon is taken as rigid."""
    if bat:
        return "guess: the muscles that raise a bat's wing have no long tendon"
    known = TENDON_COMPLIANCE.number(mass)
    pigeon = TENDON_COMPLIANCE(0.316)
    return f"rigid: {pigeon:.2g} rad/(N m) changes a pigeon's power by 0.01 %; {known.source}"


def muscle_numbers(mass: float, bat: bool = False) -> dict[str, Number]:
    """Return the numbers of the flight muscle that the laws give a bird or a bat of this mass [kg], by their paths.

    >>> {path.rpartition(".")[2]: float(f"{number.value:.3g}") for path, number in muscle_numbers(0.316).items()}
    {'mass': 0.0442, 'elevator_share': 0.31, 'strain_per_angle': 0.15, 'max_strain_rate': 19.5, \
'isometric_stress': 250000.0, 'curvature': 0.361, 'tendon_compliance': 0.0, 'activation_energy': 5.0, \
'recovery_factor': 2.0, 'resting_rate': 1.63, 'support_factor': 1.1}
    """
    # Hill's relation has its largest power at q = sqrt(k^2 + k) - k.
    at = f"q^2 / (1 - 2 q) at q = {_SHARE:g}, the share of the largest speed at which power is largest"
    curvature = f"derived: {at}, {_words('{morris}')}"
    numbers = {
        "mass": (BAT_DEPRESSOR_MASS if bat else DEPRESSOR_MASS).number(mass),
        "elevator_share": BAT_ELEVATOR_SHARE.number() if bat else ELEVATOR_SHARE.number(mass),
        "strain_per_angle": STRAIN_PER_ANGLE.number(),
        "max_strain_rate": MAX_STRAIN_RATE.number(MUSCLE_DENSITY, _POWER, _SHARE, ISOMETRIC_STRESS()),
        "isometric_stress": ISOMETRIC_STRESS.number(),
        "curvature": Number(_SHARE**2 / (1.0 - 2.0 * _SHARE), "1", curvature, (0.15, 0.5)),
        "tendon_compliance": Number(0.0, "rad/(N m)", _rigid(mass, bat)),
        "activation_energy": ACTIVATION_ENERGY.number(),
        "recovery_factor": RECOVERY_FACTOR.number(),
        "resting_rate": (BAT_RESTING_RATE if bat else BIRD_RESTING_RATE).number(mass),
        "support_factor": SUPPORT_FACTOR.number(),
    }
    for name in ("strain_per_angle", "max_strain_rate", "isometric_stress", "curvature") if bat else ():
        numbers[name] = numbers[name]._replace(source=f"guess, the number of birds: {numbers[name].source}")
    return {f"vehicle.muscle.{name}": number for name, number in numbers.items()}


# --- the tail of a bird: a triangle that opens backwards from its root; no law of bats or of robots was found ---

# Half of its breadth over its length. The angle between the outer feathers is the widest for which the theory of
# slender wings held.
_HALF = math.tan(0.5 * math.radians(60))
TAIL_LENGTH = _law("tail_length", "0.1364 m^0.2209", lambda mass: 0.1364 * mass**0.2209)
TAIL_AREA = _law(
    "tail_area", "l^2 tan(60 deg / 2), tail length l = 0.1364 m^0.2209", lambda mass: _HALF * TAIL_LENGTH(mass) ** 2
)
TAIL_ARM = _law(
    "tail_arm",
    "0.088 (m / 0.26)^(1/3) + 2/3 of the tail length 0.1364 m^0.2209",
    lambda mass: 0.088 * (mass / 0.26) ** (1 / 3) + 2 / 3 * TAIL_LENGTH(mass),
)
TAIL_SLOPE = _law("tail_slope", "pi/2 times the aspect ratio, 4 tan(60 deg / 2)", lambda: slender_slope(4 * _HALF))
TAIL_DRAG = _law("tail_drag", "0.02", lambda: 0.02)


def tail_numbers(mass: float) -> dict[str, Number]:
    """Return the numbers of the tail that the laws give a bird of this mass [kg], by their paths.

    >>> {path.rpartition(".")[2]: float(f"{number.value:.3g}") for path, number in tail_numbers(0.316).items()}
    {'area': 0.00646, 'arm': 0.164, 'lift_slope': 3.63, 'drag_coefficient': 0.02, 'incidence': 0.0}
    """
    level = "guess: along the body axis; tail_tilt turns it; no measured range of a tail's tilt was found"
    return {
        "vehicle.tail.area": TAIL_AREA.number(mass),
        "vehicle.tail.arm": TAIL_ARM.number(mass),
        "vehicle.tail.lift_slope": TAIL_SLOPE.number(),
        "vehicle.tail.drag_coefficient": TAIL_DRAG.number(),
        "vehicle.tail.incidence": Number(0.0, "rad", level, (math.radians(-30), math.radians(30))),
    }
