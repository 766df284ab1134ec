"""The numbers of a species: which there are, each with unit, source and range, and how readers see them."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from wingbeat._base import FIRST_ORDER, HARMONIC_NAMES, IN_RADIANS, Fault, find, plain, plain_unit
from wingbeat.animal.kinematics import HINGE_NAMES, PitchHinge
from wingbeat.animal.vehicle import STATIONS

DEFAULT = "not given: the default"
WING, STATION_MASSES = "vehicle.wing.mass", "vehicle.wing.station_masses"  # either may be given, or both
FREQUENCY = "wingbeat.frequency"


class Key(NamedTuple):
    """One number of a species: its path as in the orbit record, SI unit, meaning and shape."""

    path: str
    unit: str
    meaning: str
    required: bool = True
    # or "stations" (a number or a list), "vector" (three numbers), "list" (any count), "edge" (at least two),
    # "cover" and "colour" (texts)
    shape: str = "number"

    @property
    def name(self) -> str:
        """The last part of the path."""
        return self.path.rpartition(".")[2]

    @property
    def part(self) -> str:
        """The part of the vehicle, or the record, that it belongs to."""
        return self.path.split(".")[-2]

    @property
    def spellings(self) -> tuple[str, ...]:
        """The paths that a file may use; an angle may also have its name in degrees."""
        return (self.path, f"{self.path}_deg") if self.unit == "rad" else (self.path,)


def _keys(section: str, required: str = "", optional: str = "", shape: str = "number") -> tuple[Key, ...]:
    """Return the keys of a section by their names, with units and meanings from the nomenclature."""
    keys = []
    for names, needed in ((required, True), (optional, False)):
        for name in names.split():
            term = find(path := f"{section}.{name}")
            assert term is not None, path
            keys.append(Key(path, plain(term.unit), term.definition, needed, shape))
    return tuple(keys)


KEYS = (
    *_keys("vehicle", optional="mass"),
    *_keys("vehicle.body", optional="mass"),
    *_keys("vehicle.body", "pitch_inertia", "drag_area crossflow_area"),
    *_keys("vehicle.wing", "semi_span"),
    *_keys("vehicle.wing", "chord", shape="stations"),
    *_keys("vehicle.wing", optional="mass mass_exponent"),
    *_keys("vehicle.wing", optional="shoulder", shape="vector"),
    *_keys("vehicle.wing", optional="stroke_plane_angle pitch_axis mass_axis mass_gyration"),
    *_keys("vehicle.wing", optional=" ".join(STATIONS), shape="list"),
    *_keys("vehicle.pitch_hinge", "stiffness", "damping rest_angle stop_angle stop_stiffness twist_share"),
    *_keys("vehicle.tail", "area arm lift_slope", "drag_coefficient height incidence"),
    *_keys("vehicle.muscle", "mass elevator_share strain_per_angle max_strain_rate isometric_stress curvature"),
    *_keys("vehicle.muscle", optional="tendon_compliance activation_energy recovery_factor resting_rate"),
    *_keys("vehicle.muscle", optional="support_factor"),
    *_keys("vehicle.motor", "torque_constant resistance gear_ratio", "rotor_inertia no_load_current"),
    *_keys("vehicle.motor", optional="gear_efficiency crank"),
    *_keys("vehicle.springs", optional="stiffness rest_angle series_compliance"),
    *_keys("vehicle.battery", "cells capacity internal_resistance", "cutoff_voltage max_current"),
    *_keys("vehicle.battery", optional="cell_voltage", shape="list"),
    *_keys("wingbeat", "frequency flap_mean flap_amplitude pitch_mean pitch_amplitude"),
    *_keys("wingbeat", optional="span_retraction twist_ratio fold_amplitude wrist pitch_phase downstroke_fraction"),
    *_keys("wingbeat", optional="sweep_mean sweep_amplitude sweep_phase stroke_plane_tilt tail_tilt"),
    *_keys("wingbeat", optional="chord_retraction twist_mean"),
    *_keys("wingbeat", optional=" ".join(f"{law}_harmonics" for law in FIRST_ORDER), shape="list"),
    *_keys("air", optional="density viscosity gravity"),
)
# Parts that a vehicle may lack, all but body and wing; a vehicle without a part has none of the part's numbers.
PARTS = {
    part: tuple(key for key in KEYS if key.path.startswith(f"vehicle.{part}."))
    for part in dict.fromkeys(key.part for key in KEYS if key.path.count(".") == 2)
    if part not in ("body", "wing")
}
TAIL_PATHS = (*(key.path for key in PARTS["tail"]), "wingbeat.tail_tilt")
# Limits along the whole path, not only at its start.
PATH = _keys("path", "body_pitch flap")
# The wrist cannot be free: each strip is wholly arm or hand, so an orbit changes in steps with the wrist and has no
# derivative by which to search.
FREE = _keys(
    "free",
    " ".join(
        (
            *(key.name for key in KEYS if key.part == "wingbeat" and key.name != "wrist" and key.shape == "number"),
            *HARMONIC_NAMES,
            *HINGE_NAMES,
        )
    ),
)


def path_of(name: str) -> str:
    """Return the path of a free parameter's number: those of a hinge belong to the vehicle."""
    return f"vehicle.pitch_hinge.{HINGE_NAMES[name]}" if name in HINGE_NAMES else f"wingbeat.{name}"


def free_name(path: str) -> str:
    """Return the name of a free parameter, also for the path of a hinge's number; any other text as it is.

    >>> free_name("pitch_hinge.stiffness"), free_name("frequency")
    ('hinge_stiffness', 'frequency')
    """
    known = {path_of(name): name for name in HINGE_NAMES}
    return next((name for whole, name in known.items() if path in (whole, whole.removeprefix("vehicle."))), path)


def guessed_hinge_range(name: str, hinge: PitchHinge | None) -> tuple[float, float] | None:
    """Return bounds, a guess, of a hinge's number that has no range; None for another number, or one that is 0.

    >>> guessed_hinge_range("hinge_stiffness", PitchHinge(2.0))
    (0.2, 20.0)
    """
    if hinge is None or name not in HINGE_NAMES:
        return None
    if name == "hinge_rest_angle":
        return -0.25 * math.pi, 0.25 * math.pi
    value = getattr(hinge, HINGE_NAMES[name])
    return (0.1 * value, 10.0 * value) if value else None


# How the animal looks. No model reads it.
TRUNK = ("body_length", "body_width", "body_depth")
EXTREMITIES = ("head_length", "bill_length", "ear_length", "tail_length", "tail_width")  # 0 without one
SHAPE = (
    *_keys("shape", "leading_edge trailing_edge", shape="edge"),
    *_keys("shape", optional="camber thickness"),
    *_keys("shape", " ".join(TRUNK), " ".join(EXTREMITIES)),
)
COVERS = ("feathers", "membrane", "film")
COLOURS = ("back", "breast", "head", "wing", "wing_tip", "bill")
COLOUR = "#[0-9a-fA-F]{6}"  # the form of each, as a regular expression
NO_COLOUR = ("must be a colour", 'write it as "#rrggbb"')  # the fault of another form, and how to fix it
LOOKS = (*_keys("shape", "cover", shape="cover"), *_keys("shape.colours", " ".join(COLOURS), shape="colour"))
# What is judged of an orbit beside the certificate, in the order of a record: activation where there is muscle, the
# tail's tilt where a tail tilts. The ranges of the numbers of a wingbeat stand with them, under wingbeat.
JUDGED = (
    *("positive_power_per_mass", "peak_activation", "frequency", "flap_amplitude", "tail_tilt"),
    *("peak_force_over_weight", "mean_body_pitch", "body_pitch_range", "strouhal", "reynolds"),
)
_IN_WINGBEAT = ("frequency", "flap_amplitude", "tail_tilt")
PLAUSIBLE = _keys("plausible", optional=" ".join(name for name in JUDGED if name not in _IN_WINGBEAT))


class Shown(str):
    """Words that a fault shows in place of a value."""

    def __repr__(self) -> str:
        return str(self)


NOTHING = Shown("nothing")


def shown(value: Any) -> Any:
    """Return a value in a form that prints on one line; Python cannot print some values of a file (10**5000)."""
    flat = isinstance(value, list | tuple) and all(isinstance(item, int | float) for item in value)
    try:
        text = repr(value) if flat or not isinstance(value, dict | list | tuple) else ""
    except ValueError:
        return Shown("an enormous number")
    if isinstance(value, dict):
        return Shown("a table")
    if isinstance(value, list | tuple):
        return Shown(text) if flat else Shown("a list")
    return value if isinstance(value, str | int | float) else Shown(str(value))


def spoken(path: Any) -> str:
    """Return a path that the user typed: unchanged if it can be printed, else in quotes with escapes."""
    text = str(shown(path))
    return text if text.isprintable() and text.strip() and len(text) <= 80 else json.dumps(text)[:80]


Value = float | tuple[float, ...]
# The rule for an angle in radians, for one that the file gives in degrees.
_IN_DEGREES = {
    rule: f"must be an angle from {-most:.0f} to {most:.0f} degrees"
    for most, rule in ((math.degrees(most), rule) for most, rule in IN_RADIANS.items())
}


class Number(NamedTuple):
    """A number in SI units and radians, its unit, its source and its plausible range."""

    value: Value
    unit: str
    source: str = ""
    range: tuple[float, float] | None = None


def number_from(value: Any, unit: str, source: str, limits: list[float] | None) -> Number:
    """Return the number that JSON keeps as a list of these four."""
    whole = tuple(value) if isinstance(value, list) else value
    return Number(whole, unit, source, None if limits is None else (limits[0], limits[1]))


class Bound(NamedTuple):
    """The bounds of a free quantity in SI units and radians, the reason, and whether they are a guess."""

    bounds: tuple[float, float]
    reason: str = ""
    guessed: bool = False


class Range(NamedTuple):
    """The plausible range of a quantity, SI and radians; an unknown end is None.

    It applies between the lowest and the highest flight speed in `speeds` [m/s]; None means all speeds.
    """

    low: float | None = None
    high: float | None = None
    unit: str = "1"
    source: str = ""
    speeds: tuple[float, float] | None = None

    def at(self, speed: float) -> Range:
        """Return this range at a flight speed [m/s]; where it does not apply, open at both ends."""
        if self.speeds is None or self.speeds[0] <= speed <= self.speeds[1]:
            return self
        slowest, fastest = self.speeds
        where = f"nothing is known at {speed:g} m/s, only from {slowest:.3g} to {fastest:.3g} m/s"
        return Range(None, None, self.unit, f"{where}: {self.source}", self.speeds)


ALL_SPEEDS = (0.0, 100.0)  # m/s; no problem may be faster


class OwnFrequency(NamedTuple):
    """A frequency at which the animal beats [Hz], with its band, where it was found, and at which speeds [m/s].

    The basis is ``measured`` on the animal, ``law`` of other animals of its kind, a ``guess``, or
    ``given`` by the user.
    """

    value: float
    range: tuple[float, float]
    basis: str
    source: str = ""
    speeds: tuple[float, float] = ALL_SPEEDS


# How the source of a number begins, by its basis: grades A and B were measured, see docs/guide/animals.md.
_BASES = {"measured": ("A: ", "B: "), "law": ("derived",), "guess": ("guess", "first guess")}


def frequency_of(stock: Number, kind: str) -> OwnFrequency:
    """Return the frequency of the stock wingbeat of an animal of a kind; one that is given has no band.

    >>> frequency_of(Number(40.0, "Hz", "first guess", (25.0, 56.0)), "bird")[:3]
    (40.0, (25.0, 56.0), 'guess')
    """
    assert not isinstance(stock.value, tuple)
    found = (basis for basis, begins in _BASES.items() if stock.source.startswith(begins))
    basis = next(found, "given")
    if basis == "law" and kind == "robot":  # no law of robots was found: that of birds stands in for it
        basis = "guess"
    band = (stock.value, stock.value) if basis == "given" or stock.range is None else stock.range
    return OwnFrequency(stock.value, band, basis, stock.source)


def frequency_between(known: Sequence[OwnFrequency], speed: float) -> OwnFrequency:
    """Return the frequency at a flight speed [m/s]; between the speeds of two entries, on the straight line.

    Below the slowest and above the fastest speed, the nearest entry holds, and its source says so.

    >>> slow = OwnFrequency(8.0, (6.0, 10.0), "measured", "a film", (3.0, 5.0))
    >>> fast = OwnFrequency(6.0, (5.0, 7.0), "law", "a law", (7.0, 20.0))
    >>> frequency_between([fast, slow], 6.0)[:3]
    (7.0, (5.5, 8.5), 'law')
    """
    known = sorted(known, key=lambda one: one.speeds)
    inside = [one for one in known if one.speeds[0] <= speed <= one.speeds[1]]
    if inside:
        return inside[0]
    slower = [one for one in known if one.speeds[1] < speed]
    faster = [one for one in known if one.speeds[0] > speed]
    if not slower or not faster:
        near = (slower or faster[:1])[-1]
        at = f"at {near.speeds[slower != []]:g} m/s"
        return near._replace(source=f"as {at}: {near.source}")
    below, above = slower[-1], faster[0]
    share = (speed - below.speeds[1]) / (above.speeds[0] - below.speeds[1])
    value, low, high = (
        (1.0 - share) * start + share * end
        for start, end in zip((below.value, *below.range), (above.value, *above.range), strict=True)
    )
    basis = "law" if "law" in (below.basis, above.basis) else "measured"
    where = f"between those at {below.speeds[1]:g} and {above.speeds[0]:g} m/s"
    return OwnFrequency(value, (low, high), basis, f"{where}: {below.source}; {above.source}", (speed, speed))


# No number of an animal: the share of the muscle's fibres that a wingbeat uses.
ACTIVATION = Range(None, 1.0, "1", "by definition: above 1, the wingbeat needs more fibres than the muscle has")
UNKNOWN = "nothing is known: the species file gives no range"


def range_of_tilt(numbers: Mapping[str, Number]) -> Range:
    """Return the plausible range of the tail's tilt: its own, or what the range of the incidence allows."""
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


class Numbers(dict[str, Number]):
    """Numbers by path, with the original text of each, so that a fault can quote it."""

    def __init__(self) -> None:
        super().__init__()
        self.written: dict[str, tuple[str, Any]] = {}

    def put(self, key: Key, number: Number, path: str, value: Any) -> None:
        """Add a number that was written as `value` under `path`."""
        self[key.path] = number
        self.written[key.path] = (path, value)

    def quote(self, fault: Fault) -> Fault:
        """Return a fault that a constructor found, with the path, value and unit that the file uses."""
        where = fault.where if fault.where.startswith(("wingbeat.", "air.", "shape.")) else f"vehicle.{fault.where}"
        for canonical, (path, value) in self.written.items():
            rest = where[len(canonical) :]
            if where.startswith(canonical) and rest[:1] in ("", "[", "."):
                told = fault.value if rest else shown(value)
                if not path.endswith("_deg"):
                    return Fault(path + rest, told, fault.rule, fault.fix)
                if fault.rule in _IN_DEGREES:
                    return Fault(path + rest, told, _IN_DEGREES[fault.rule])
                return Fault(path + rest, told, fault.rule.replace(" rad", " deg"), fault.fix)
        return Fault(where, fault.value, fault.rule, fault.fix)


class Alternative(NamedTuple):
    """Measured or assumed numbers that may replace the defaults, and why they are worth a trial."""

    reason: str
    numbers: Numbers


class ShapeText(NamedTuple):
    """How the animal looks: numbers by path, and texts by path (what covers the wing, and the colours)."""

    numbers: Numbers
    texts: dict[str, str]


@dataclass
class SpeciesText:
    """The content of a species file, before any check of its physics."""

    name: str
    common_name: str = ""
    scientific_name: str = ""
    kind: str = ""
    numbers: Numbers = field(default_factory=Numbers)
    free: dict[str, Bound] = field(default_factory=dict)
    path: dict[str, Bound] = field(default_factory=dict)
    plausible: dict[str, Range] = field(default_factory=dict)
    frequencies: list[OwnFrequency] = field(default_factory=list)
    shape: ShapeText | None = None
    alternatives: dict[str, Alternative] = field(default_factory=dict)
    written: dict[str, tuple[str, Any]] = field(default_factory=dict)  # each bound's path and pair


def to_si(value: Any, path: str) -> Value:
    """Return a number or list of the right shape in SI units; `path` shows whether it is in degrees."""
    if isinstance(value, list):
        return tuple(float(to_si(item, path)) for item in value)  # type: ignore[arg-type]
    return math.radians(value) if path.endswith("_deg") else float(value)


def display(path: str, number: Number) -> tuple[str, Number]:
    """Return path and number for readers: angles are in degrees, with ``_deg`` in the path."""
    if number.unit != "rad":
        return path, number

    def degrees(angle: float) -> float:
        return float(f"{math.degrees(angle):.12g}")  # 60 comes back as 60, not 59.99999999999999

    limits = number.range and (degrees(number.range[0]), degrees(number.range[1]))
    angles = number.value
    shown = tuple(degrees(angle) for angle in angles) if isinstance(angles, tuple) else degrees(angles)
    return f"{path}_deg", Number(shown, "deg", number.source, limits)


def in_order(numbers: Mapping[str, Number]) -> dict[str, Number]:
    """Return the numbers in the order of a species file."""
    return {key.path: numbers[key.path] for key in KEYS if key.path in numbers}


def jsonable(value: Any) -> Any:
    """Return a value as JSON holds it: records as dictionaries, tuples as lists."""
    if hasattr(value, "_asdict"):
        value = value._asdict()
    if isinstance(value, dict):
        return {key: jsonable(item) for key, item in value.items()}
    return [jsonable(item) for item in value] if isinstance(value, tuple | list) else value


def words(path: str, number: Number) -> str:
    """Return value and unit as text for a reader, angles in degrees."""
    _, shown = display(path, number)
    unit = "" if shown.unit == "1" else f" {shown.unit}"
    if isinstance(shown.value, tuple):
        return f"[{', '.join(f'{value:g}' for value in shown.value)}]{unit}"
    return f"{shown.value:g}{unit}"


def bound_cells(path: str, limits: tuple[float, float]) -> tuple[str, str, str]:
    """Return name, bounds and unit of a parameter or of a limit along the path, with angles in degrees.

    >>> bound_cells("wingbeat.frequency", (1.0, 30.0))
    ('wingbeat.frequency', '1 to 30', 'Hz')
    """
    name, shown = display(path, Number(0.0, plain_unit(path), range=limits))
    low, high = shown.range or limits
    return name, f"{low:g} to {high:g}", "" if shown.unit == "1" else shown.unit


# In the source of a number that a law gave outside its data, this text precedes the value of the input and the
# range of the data.
OUTSIDE = "outside its data: "
