"""Records of what drives the flap hinges: muscle, motor, springs and battery; each checks its numbers."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import Any, NamedTuple

from wingbeat._base import WHOLE, FaultList
from wingbeat._jax.arrays import register_record

# Density of muscle [kg/m3]: Mendez and Keys 1960, Metabolism 9:184.
MUSCLE_DENSITY = 1060.0


@register_record
@dataclass(frozen=True)
class Muscle:
    """The flight muscles of both sides: depressors that pull the wings down, and elevators that raise them.

    Both have the same kind of fibre. Fibres shorten in proportion to the flap angle, as on a pulley.

    Parameters
    ----------
    mass : of the depressors, both sides [kg].
    elevator_share : ratio of the elevators' mass to that of the depressors.
    strain_per_angle : fibre strain per flap angle [1/rad].
    max_strain_rate : largest speed of shortening, in lengths per second [1/s].
    isometric_stress : stress of fully active fibres that keep their length [Pa].
    curvature : k of Hill's relation [-]; the smaller k is, the faster the force falls with speed.
    tendon_compliance : one over the stiffness of the elevators' tendon, both sides [rad/(N m)]; 0 is rigid.
    activation_energy : of one contraction, to release and pump back calcium, per mass of active fibres [J/kg].
    recovery_factor : initial metabolism and recovery together, divided by the initial one [-].
    resting_rate : metabolic rate of the whole animal at rest [W]; like the next, not of its muscle alone.
    support_factor : metabolic rate with posture, breathing and circulation, divided by that without [-].

    Raises
    ------
    InvalidInputError : a mass, share, strain, stress or curvature that is not positive, a share above 2, a negative
        compliance, energy or rate, a factor below 1, a number that is not finite.

    >>> muscle = Muscle(0.057, 0.16, 0.18, max_strain_rate=12.0, isometric_stress=130e3, curvature=0.25)
    >>> round(float(muscle.max_flap_rate), 1), round(float(muscle.depressor_torque), 2)
    (66.7, 1.26)
    """

    mass: float
    elevator_share: float
    strain_per_angle: float
    max_strain_rate: float
    isometric_stress: float
    curvature: float
    tendon_compliance: float = 0.0
    activation_energy: float = 0.0
    recovery_factor: float = 1.0
    resting_rate: float = 0.0
    support_factor: float = 1.0

    def __post_init__(self) -> None:
        faults = FaultList()
        together, lengths = "give the mass of the depressors of both sides together", "give lengths per second"
        faults.number("muscle.mass", self.mass, above=0, unit="kg", fix=together)
        faults.number("muscle.elevator_share", self.elevator_share, above=0, at_most=2)
        faults.number("muscle.strain_per_angle", self.strain_per_angle, above=0, unit="1/rad")
        faults.number("muscle.max_strain_rate", self.max_strain_rate, above=0, unit="1/s", fix=lengths)
        faults.number("muscle.isometric_stress", self.isometric_stress, above=0, unit="Pa")
        faults.number("muscle.curvature", self.curvature, above=0, fix="fast muscle has 0.15 to 0.4")
        for name in ("tendon_compliance", "activation_energy", "resting_rate"):
            faults.number(f"muscle.{name}", getattr(self, name), at_least=0, fix="0 leaves it out")
        for name in ("recovery_factor", "support_factor"):
            faults.number(f"muscle.{name}", getattr(self, name), at_least=1, fix="1 leaves it out")
        faults.raise_if_any()

    @property
    def max_flap_rate(self) -> Any:
        """Flap rate at which the muscles exert no torque [rad/s]."""
        return self.max_strain_rate / self.strain_per_angle

    @property
    def depressor_torque(self) -> Any:
        """Isometric torque of the fully active depressors [N m]: stress times volume times strain per angle."""
        return self.isometric_stress * self.mass / MUSCLE_DENSITY * self.strain_per_angle


@register_record
@dataclass(frozen=True)
class Motor:
    """A motor that flaps both wings but does not pitch them: with brushes, or brushless with its controller.

    For two motors, one for each wing, give the same torque constant, half of the resistance, twice the rotor
    inertia and twice the no-load current. Torques and currents are then sums of both motors.

    Parameters
    ----------
    torque_constant : torque per current [N m/A]; in SI units, this number is also the voltage per speed.
    resistance : of the winding [ohm].
    gear_ratio : ratio of the motor's speed to the flap rate or, with a crank, to the speed of the crank.
    rotor_inertia : of the rotor, and of all that turns with it [kg m2].
    no_load_current : current that friction takes at any speed [A].
    gear_efficiency : share of the power that the gear transmits, in either direction.
    crank : the number 1 if the motor turns a crank at constant speed, and a linkage makes the wings flap; 0 if the
        motor turns with the wings and reverses twice a beat.

    Raises
    ------
    InvalidInputError : a constant that is not positive, a negative inertia or current, an efficiency outside 0 to
        1, a crank other than 0 or 1, a number that is not finite.

    >>> Motor(torque_constant=2.1e-3, resistance=0.45, gear_ratio=10.0).crank
    0.0
    """

    torque_constant: float
    resistance: float
    gear_ratio: float
    rotor_inertia: float = 0.0
    no_load_current: float = 0.0
    gear_efficiency: float = 1.0
    crank: float = 0.0

    def __post_init__(self) -> None:
        faults = FaultList()
        fix = "give 60 / (2 pi) divided by the speed constant in rpm/V"
        faults.number("motor.torque_constant", self.torque_constant, above=0, unit="N m/A", fix=fix)
        faults.number("motor.resistance", self.resistance, above=0, unit="ohm")
        faults.number("motor.gear_ratio", self.gear_ratio, above=0)
        faults.number("motor.rotor_inertia", self.rotor_inertia, at_least=0, unit="kg m2")
        faults.number("motor.no_load_current", self.no_load_current, at_least=0, unit="A")
        faults.number("motor.gear_efficiency", self.gear_efficiency, above=0, at_most=1)
        if self.crank not in (0, 1):
            fix = "give 1 for a crank, 0 for a motor that reverses"
            faults.add("motor.crank", self.crank, "must be 0 or 1", fix)
        faults.raise_if_any()


@register_record
@dataclass(frozen=True)
class Springs:
    """Springs at the flap hinges, both sides together.

    Parameters
    ----------
    stiffness : of the springs beside the actuators, between body and arm [N m/rad].
    rest_angle : flap angle at which these springs exert no torque [rad].
    series_compliance : one over the stiffness of the springs between actuator and wing [rad/(N m)]; 0 is rigid.

    Raises
    ------
    InvalidInputError : a negative stiffness or compliance, a rest angle beyond half a turn, a number that is not
        finite.

    >>> Springs(stiffness=0.5).series_compliance
    0.0
    """

    stiffness: float = 0.0
    rest_angle: float = 0.0
    series_compliance: float = 0.0

    def __post_init__(self) -> None:
        faults = FaultList()
        faults.number("springs.stiffness", self.stiffness, at_least=0, unit="N m/rad", fix="count both sides")
        faults.angle("springs.rest_angle", self.rest_angle)
        fix = "give one over the stiffness of the series springs, or 0 for rigid ones"
        faults.number("springs.series_compliance", self.series_compliance, at_least=0, unit="rad/(N m)", fix=fix)
        faults.raise_if_any()


@register_record
@dataclass(frozen=True)
class Battery:
    """A battery of equal cells in series that feeds the motor through a controller without losses.

    Parameters
    ----------
    cells : number of cells in series [-].
    capacity : charge from full to empty [A h]; 850 mAh are 0.85.
    internal_resistance : of all cells together, with plugs and wires [ohm].
    cutoff_voltage : mean voltage under load, of each cell, at which the flight ends [V]; the default is a guess.
    max_current : largest current that it may give [A]; 0 if it is not known.
    cell_voltage : of one cell without load, at equal steps of charge from empty to full [V]; if it is not given,
        the lithium polymer cell of Chen and Rincon-Mora 2006, doi 10.1109/TEC.2006.874229.

    Raises
    ------
    InvalidInputError : cells that are not a whole number, a capacity, resistance or voltage that is not positive, a
        capacity above 30 A h, a negative current, a single voltage or voltages that do not rise with charge, a
        number that is not finite.

    >>> Battery(cells=3, capacity=0.85, internal_resistance=0.06).cutoff_voltage
    3.3
    """

    cells: float
    capacity: float
    internal_resistance: float
    cutoff_voltage: float = 3.3
    max_current: float = 0.0
    cell_voltage: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        faults = FaultList()
        if faults.number("battery.cells", self.cells, above=0, at_most=100) and self.cells != round(self.cells):
            faults.add("battery.cells", self.cells, WHOLE, "give the cells in series: 3 of a 3S")
        fix = "give A h: 850 mAh are 0.85"
        faults.number("battery.capacity", self.capacity, above=0, at_most=30, unit="A h", fix=fix)
        faults.number("battery.internal_resistance", self.internal_resistance, above=0, unit="ohm")
        faults.number("battery.cutoff_voltage", self.cutoff_voltage, above=0, unit="V", fix="give that of one cell")
        faults.number("battery.max_current", self.max_current, at_least=0, unit="A", fix="0 leaves it out")
        object.__setattr__(self, "cell_voltage", tuple(self.cell_voltage))
        good = [
            faults.number(f"battery.cell_voltage[{i}]", one, above=0, unit="V")
            for i, one in enumerate(self.cell_voltage)
        ]
        rises = all(good) and all(low < high for low, high in itertools.pairwise(self.cell_voltage))
        if len(good) == 1 or (all(good) and not rises):
            fix = "give voltages at equal steps of charge, from empty to full"
            faults.add("battery.cell_voltage", self.cell_voltage, "must be two or more that rise with charge", fix)
        faults.raise_if_any()


class Drive(NamedTuple):
    """What drives the flap hinges of a vehicle; a part that the vehicle lacks is None."""

    muscle: Muscle | None = None
    motor: Motor | None = None
    springs: Springs | None = None
    battery: Battery | None = None
