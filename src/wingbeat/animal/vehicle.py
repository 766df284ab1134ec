"""Records of body, wing, tail, vehicle and air, in SI units; each checks its numbers."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import dataclass
from typing import Any

from wingbeat._base import FaultList, is_number
from wingbeat._jax.arrays import at_default, register_record
from wingbeat.animal.drive import Battery, Drive, Motor, Muscle, Springs


@register_record(optional=("crossflow_area",))
@dataclass(frozen=True)
class Body:
    """The body without its wings.

    Parameters
    ----------
    mass : mass without wings [kg].
    pitch_inertia : moment of inertia about the pitch axis through its own centre of mass [kg m2].
    drag_area : drag coefficient times frontal area [m2]; 0, as in the paper, means no body drag.
    crossflow_area : coefficient of the force across the body axis times planform area, length times width of the
        body, at 90 degrees to the flow [m2]; 0, as in the paper, means that drag does not depend on attitude.

    Raises
    ------
    InvalidInputError : a mass or inertia that is not positive, a negative area, a number that is not finite.

    >>> import wingbeat as wb
    >>> body = wb.Body(mass=0.276, pitch_inertia=3.6e-4, drag_area=5e-4)
    >>> round(wb.Vehicle(body, wb.Wing(semi_span=0.279, chord=0.112, mass=0.020)).mass, 3)
    0.316
    """

    mass: float
    pitch_inertia: float
    drag_area: float = 0.0
    crossflow_area: float = 0.0

    def __post_init__(self) -> None:
        faults = FaultList()
        faults.number("body.mass", self.mass, above=0, unit="kg", fix="give the mass without the wings")
        faults.number("body.pitch_inertia", self.pitch_inertia, above=0, unit="kg m2")
        faults.number("body.drag_area", self.drag_area, at_least=0, unit="m2", fix="0 means no body drag")
        fix = "0 means that drag does not depend on attitude"
        faults.number("body.crossflow_area", self.crossflow_area, at_least=0, unit="m2", fix=fix)
        faults.raise_if_any()


# Places on a wing's chords; records leave them out at their defaults, which need no term.
CHORDWISE = ("pitch_axis", "mass_axis", "mass_gyration")
# The columns of a table of masses.
STATIONS = ("mass_stations", "station_masses", "station_axes", "station_gyrations")
# How far the stations' masses may miss the wing's, as a share: scales and rounded files.
_WEIGHED = 1e-3


@register_record(optional=CHORDWISE)
@dataclass(frozen=True)
class Wing:
    """One wing (the left one; the right one is its mirror image).

    Parameters
    ----------
    semi_span : length from shoulder to tip at mid-downstroke [m].
    chord : chord [m], one number or a tuple at equally spaced stations from root to tip.
    mass : mass of one wing [kg].
    mass_exponent : exponent p in the strip masses ``(1 - s/L)**p``; 0 is a uniform wing.
    shoulder : position of the shoulder in body axes (forward, left, up) [m].
    stroke_plane_angle : angle of the stroke plane from the body axis [rad]; pi/2 is a vertical plane.
    pitch_axis : where the axis about which the wing pitches crosses each chord, behind the leading edge, in chords.
        The stroke carries this axis.
    mass_axis : where the strips' centres of mass lie, behind the leading edge, in chords.
    mass_gyration : their radius of gyration about a line along the span through that centre, in chords; the default
        is that of a uniform strip.
    mass_stations : places of point masses along the span, as fractions of the wing's length, in any order; some may
        be equal, such as a piece of a spar and one of the skin. They replace the law of `mass_exponent`; None for
        that law.
    station_masses : the mass at each of them [kg]; they add up to `mass`.
    station_axes : where its centre lies, behind the leading edge, in chords; None for `mass_axis` everywhere.
    station_gyrations : its radius of gyration as in `mass_gyration`; None for that one everywhere.

    Raises
    ------
    InvalidInputError : a length or mass that is not positive, a negative exponent, fewer than two stations of the
        chord, a shoulder that is not three numbers, an axis off the chord, a number that is not finite, station
        masses that do not add up to the mass, columns of unequal length, or a number that they replace.

    >>> import wingbeat as wb
    >>> wing = wb.Wing(semi_span=0.3, chord=(0.12, 0.10, 0.04), mass=0.02, mass_exponent=2.0)
    >>> round(wing.mean_chord, 3)
    0.09
    """

    semi_span: float
    chord: float | tuple[float, ...]
    mass: float
    mass_exponent: float = 0.0
    shoulder: tuple[float, float, float] = (0.0, 0.0, 0.0)
    stroke_plane_angle: float = math.pi / 2
    pitch_axis: float = 0.25
    mass_axis: float = 0.5
    mass_gyration: float = 0.5 / math.sqrt(3.0)
    mass_stations: tuple[float, ...] | None = None
    station_masses: tuple[float, ...] | None = None
    station_axes: tuple[float, ...] | None = None
    station_gyrations: tuple[float, ...] | None = None

    def __post_init__(self) -> None:
        faults = FaultList()
        faults.number("wing.semi_span", self.semi_span, above=0, unit="m")
        fix = "give one chord, or the chords at two or more stations from root to tip"
        if isinstance(self.chord, list | tuple):
            object.__setattr__(self, "chord", tuple(self.chord))
            if len(self.chord) < 2:
                faults.add("wing.chord", self.chord, "has fewer than two stations", fix)
            for i, chord in enumerate(self.chord):
                faults.number(f"wing.chord[{i}]", chord, above=0, unit="m")
        else:
            faults.number("wing.chord", self.chord, above=0, unit="m", fix=fix)
        faults.number("wing.mass", self.mass, above=0, unit="kg", fix="give the mass of one wing")
        faults.number("wing.mass_exponent", self.mass_exponent, at_least=0, fix="0 is a uniform wing")
        if not isinstance(self.shoulder, list | tuple) or len(self.shoulder) != 3:
            faults.add("wing.shoulder", self.shoulder, "must be three numbers", "forward, left, up, in m")
        else:
            object.__setattr__(self, "shoulder", tuple(self.shoulder))
            for axis, value in zip("xyz", self.shoulder, strict=True):
                faults.number(f"wing.shoulder.{axis}", value, unit="m")
        faults.angle("wing.stroke_plane_angle", self.stroke_plane_angle)
        behind = "chords behind the leading edge"
        faults.number("wing.pitch_axis", self.pitch_axis, at_least=0, at_most=1, fix=behind)
        faults.number("wing.mass_axis", self.mass_axis, at_least=0, at_most=1, fix=behind)
        fix = "a uniform strip has 0.2887 chords"
        faults.number("wing.mass_gyration", self.mass_gyration, at_least=0, at_most=0.5, fix=fix)
        self._check_stations(faults)
        faults.raise_if_any()

    def _check_stations(self, faults: FaultList) -> None:
        given = [name for name in STATIONS if getattr(self, name) is not None]
        if not given:
            return
        least = {"station_masses": {"above": 0, "unit": "kg"}, "station_gyrations": {"at_least": 0, "at_most": 0.5}}
        for name in dict.fromkeys((*STATIONS[:2], *given)):
            column = getattr(self, name)
            if not isinstance(column, list | tuple):
                fix = "give mass_stations and station_masses, lists of equal length"
                faults.add(f"wing.{name}", column, "must be a list of numbers in a table of masses", fix)
                return
            object.__setattr__(self, name, tuple(column))
            for i, number in enumerate(column):
                faults.number(f"wing.{name}[{i}]", number, **least.get(name, {"at_least": 0, "at_most": 1}))
            if len(column) != (count := len(self.mass_stations or ())):
                rule = f"has {len(column)} numbers, wing.mass_stations has {count}"
                faults.add(f"wing.{name}", column, rule, "give one number for each station")
        for name, column in self.replaced.items():
            if not at_default(self, name):
                fix = f"leave it out, or set it to {getattr(Wing, name)!r}"
                faults.add(f"wing.{name}", getattr(self, name), f"has no effect beside wing.{column}", fix)
        if faults.faults or self.mass_stations is None or self.station_masses is None:
            return
        if len({*self.mass_stations}) < 3:
            fix = "cut the wing into more pieces"
            faults.add("wing.mass_stations", self.mass_stations, "are fewer than three different places", fix)
        if abs((total := math.fsum(self.station_masses)) - self.mass) > _WEIGHED * self.mass:
            fix = "correct one of them; in a file, leave wing.mass out"
            faults.add("wing.mass", self.mass, f"is not the sum of wing.station_masses, {total:.6g} kg", fix)

    @property
    def replaced(self) -> dict[str, str]:
        """Return the numbers that a table of masses replaces, with its columns that do."""
        pairs = zip(("mass_exponent", "mass_axis", "mass_gyration"), STATIONS[1:], strict=True)
        return {name: column for name, column in pairs if getattr(self, column) is not None}

    def weighing(self, mass: float) -> Wing:
        """Return this wing with another mass; those of its stations change in proportion.

        Parameters
        ----------
        mass : [kg].

        >>> wing = Wing(0.3, 0.1, 0.02, mass_stations=(0.1, 0.5, 0.9), station_masses=(0.01, 0.006, 0.004))
        >>> wing.weighing(0.04).station_masses
        (0.02, 0.012, 0.008)
        """
        masses = self.station_masses and tuple(one * mass / self.mass for one in self.station_masses)
        return dataclasses.replace(self, mass=mass, station_masses=masses)

    def told(self) -> dict[str, Any]:
        """Return its numbers by name, in SI units; what is at its default on the chord, or None, is left out."""
        off = {name for name in CHORDWISE if at_default(self, name)}
        return {name: value for name, value in vars(self).items() if name not in off and value is not None}

    @property
    def mean_chord(self) -> float:
        """Mean of the piecewise linear chord along the span [m]."""
        if not isinstance(self.chord, tuple):
            return self.chord
        return (sum(self.chord) - 0.5 * (self.chord[0] + self.chord[-1])) / (len(self.chord) - 1)


@register_record
@dataclass(frozen=True)
class Tail:
    """A tail: a flat surface that turns with the body; the body's mass includes the tail's.

    Parameters
    ----------
    area : [m2].
    arm : distance of its aerodynamic centre behind the body's centre of mass, along the body axis [m]; negative for
        a surface ahead of it.
    lift_slope : slope of its lift coefficient [1/rad].
    drag_coefficient : drag coefficient at zero lift.
    height : height of its aerodynamic centre above the body axis through the centre of mass [m].
    incidence : angle of its chord above the body axis, leading edge up positive [rad]; `Wingbeat.tail_tilt` is
        added to it.

    Raises
    ------
    InvalidInputError : an area or slope that is not positive, a negative drag coefficient, a number that is not
        finite.

    >>> import dataclasses, wingbeat as wb
    >>> pigeon = wb.load_species("pigeon").vehicle
    >>> tailed = dataclasses.replace(pigeon, tail=wb.Tail(area=0.008, arm=0.12, lift_slope=1.6))
    >>> pigeon.tail is None, tailed.tail.area
    (True, 0.008)
    """

    area: float
    arm: float
    lift_slope: float
    drag_coefficient: float = 0.0
    height: float = 0.0
    incidence: float = 0.0

    def __post_init__(self) -> None:
        faults = FaultList()
        faults.number("tail.area", self.area, above=0, unit="m2", fix="leave the tail out if there is none")
        faults.number("tail.arm", self.arm, unit="m")
        fix = "for a slender tail, give pi/2 times its aspect ratio"
        faults.number("tail.lift_slope", self.lift_slope, above=0, unit="1/rad", fix=fix)
        faults.number("tail.drag_coefficient", self.drag_coefficient, at_least=0)
        faults.number("tail.height", self.height, unit="m")
        faults.angle("tail.incidence", self.incidence)
        faults.raise_if_any()


@register_record
@dataclass(frozen=True)
class Vehicle:
    """An animal or a robot: its body, its two equal wings, perhaps a tail, and what drives the wings.

    Attributes
    ----------
    body : the body without its wings.
    wing : the left wing; the right one is its mirror image.
    tail : the tail; None, as in the paper, means no tail.
    muscle, motor : what drives the flap hinges, if it is known; neither changes the flight, only what it costs.
    springs : springs at the flap hinges; they reduce or increase the torque that muscle or motor must give.
    battery : what feeds the motor, if it is known; the body's mass includes its mass.

    >>> pigeon = Vehicle(Body(0.276, 3.6e-4), Wing(0.279, 0.112, 0.020, mass_exponent=2.0))
    >>> round(pigeon.mass, 3)
    0.316
    """

    body: Body
    wing: Wing
    tail: Tail | None = None
    muscle: Muscle | None = None
    motor: Motor | None = None
    springs: Springs | None = None
    battery: Battery | None = None

    @property
    def mass(self) -> Any:
        """Total mass: body and both wings [kg].

        Theory: equation ``whole-mass``.
        """
        return self.body.mass + 2 * self.wing.mass

    @property
    def drive(self) -> Drive:
        """What drives the flap hinges."""
        return Drive(self.muscle, self.motor, self.springs, self.battery)

    @property
    def passive(self) -> Vehicle:
        """The vehicle without muscle, motor, springs and battery: the parts that determine a flight."""
        return Vehicle(self.body, self.wing, self.tail)


@register_record
@dataclass(frozen=True)
class Air:
    """The air and the gravity that a vehicle flies in.

    Parameters
    ----------
    density : [kg/m3].
    viscosity : kinematic viscosity [m2/s].
    gravity : [m/s2].

    Raises
    ------
    InvalidInputError : a density or viscosity that is not positive, a negative gravity, a number that is not
        finite.

    >>> import wingbeat as wb
    >>> high = wb.Air(density=0.9)
    >>> round(high.reynolds(10.0, 0.1))
    66667
    """

    density: float = 1.225
    viscosity: float = 1.5e-5
    gravity: float = 9.81

    def __post_init__(self) -> None:
        faults = FaultList()
        faults.number("air.density", self.density, above=0, unit="kg/m3")
        faults.number("air.viscosity", self.viscosity, above=0, unit="m2/s")
        faults.number("air.gravity", self.gravity, at_least=0, unit="m/s2")
        faults.raise_if_any()

    @classmethod
    def at_altitude(cls, altitude: float = 0.0, temperature: float | None = None, gravity: float = 9.81) -> Air:
        """Return dry air with the pressure of the standard atmosphere at an altitude, and a temperature.

        The pressure p is that of the standard altitude also where the temperature T [K] is another. Density is
        p / (R T), viscosity Sutherland's formula divided by the density. Gravity does not change with altitude.

        Parameters
        ----------
        altitude : geometric height above sea level, -500 to 9000 [m].
        temperature : -60 to 60 [deg C]; None for that of the standard atmosphere, 15 at sea level.
        gravity : [m/s2].

        Raises
        ------
        InvalidInputError : an altitude, temperature or gravity out of range.

        Theory: equations ``air-density``, ``air-viscosity``. ICAO 1993, Manual of the ICAO Standard Atmosphere,
        Doc 7488, 3rd edition; below 32 km the same as U.S. Standard Atmosphere 1976, NASA-TM-X-74335.

        >>> import wingbeat as wb
        >>> air = wb.Air.at_altitude(2000.0)
        >>> f"{air.density:.4f} kg/m3, {air.viscosity:.4e} m2/s"
        '1.0066 kg/m3, 1.7147e-05 m2/s'
        """
        faults = FaultList()
        fix = "give metres above sea level; 1000 ft are 304.8 m"
        faults.number("altitude", altitude, at_least=-500, at_most=9000, unit="m", fix=fix)
        if temperature is not None:
            kelvin = is_number(temperature) and 200 < temperature < 340
            fix = (
                f"this seems to be in kelvin: give {temperature - 273.15:.4g}" if kelvin else "give degrees Celsius"
            )
            faults.number("temperature", temperature, at_least=-60, at_most=60, unit="deg C", fix=fix)
        faults.raise_if_any()
        from ambiance import CONST, Atmosphere

        standard = Atmosphere(float(altitude))
        kelvins = standard.temperature.item() if temperature is None else CONST.T_i + temperature
        density = standard.pressure.item() / (CONST.R * kelvins)
        dynamic = CONST.beta_s * kelvins**1.5 / (kelvins + CONST.S)
        return cls(density, dynamic / density, gravity)

    def reynolds(self, speed: Any, chord: Any) -> Any:
        """Return the Reynolds number of a chord [m] at a speed [m/s].

        Parameters
        ----------
        speed : [m/s], any shape.
        chord : [m], of a shape that broadcasts with `speed`.
        """
        return speed * chord / self.viscosity
