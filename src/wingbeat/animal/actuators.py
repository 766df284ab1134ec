"""Actuators of the flap hinges: what a muscle or motor can exert at which cost, springs beside it, and a battery.

A muscle's fibres shorten in proportion to the flap angle. The largest force of a muscle falls with its speed of
shortening. A force costs metabolic power even if it does no work. So a fast beat of small amplitude has a cost too.
Springs sit beside the actuator (parallel), or between actuator and wing (in series).
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from wingbeat._jax.arrays import jnp

if TYPE_CHECKING:
    from wingbeat._jax.arrays import Series
    from wingbeat.animal.drive import Battery, Motor, Muscle, Springs

# Largest eccentric force divided by isometric force, and the steepness of its rise: Alexander 1997, doi
# 10.1006/jtbi.1996.0262, as implemented by others.
_LARGEST, _STEEPNESS = 1.8, 7.56
# Above this share of the largest speed, the curve of the isometric force that a torque needs continues as its
# tangent.
_LAST_SHARE = 0.95


def force_at(shortening: Series, curvature: Any) -> Series:
    """Return the force of fully active fibres divided by their isometric force.

    Equations: ``(1 - q) / (1 + q/k)`` if the muscle shortens (Hill 1938), ``1.8 - 0.8 (1 + q) / (1 - 7.56 q/k)`` if
    it lengthens (Alexander 1997, J Theor Biol 184:253, doi 10.1006/jtbi.1996.0262), with q the speed of shortening
    divided by its largest value, from -1 to 1, and k the curvature. The equations were taken from programs that
    cite these papers, not from the papers.

    >>> [round(float(force_at(jnp.array(q), 0.25)), 3) for q in (-1.0, 0.0, 0.2, 1.0)]
    [1.8, 1.0, 0.444, 0.0]
    """
    shortens, lengthens = jnp.maximum(shortening, 0.0), jnp.minimum(shortening, 0.0)
    fast = (1.0 - shortens) / (1.0 + shortens / curvature)
    slow = _LARGEST - (_LARGEST - 1.0) * (1.0 + lengthens) / (1.0 - _STEEPNESS * lengthens / curvature)
    return jnp.where(shortening > 0.0, fast, slow)


def metabolic_ratio(shortening: Series) -> Series:
    """Return the metabolic power of fully active fibres divided by (isometric force times largest speed).

    Equation: ``(0.054 + 0.506 q + 2.46 q^2) / (1 - 1.13 q + 12.8 q^2 - 1.64 q^3)``, q as for `force_at`.

    Source: Minetti and Alexander 1997, J Theor Biol 186:467, doi 10.1006/jtbi.1997.0407, as other papers quote it;
    we did not read the paper itself.

    >>> round(float(metabolic_ratio(jnp.array(0.0))), 3), round(float(metabolic_ratio(jnp.array(0.2))), 3)
    (0.054, 0.199)
    """
    q = jnp.clip(shortening, -1.0, 1.0)
    return (0.054 + q * (0.506 + 2.46 * q)) / (1.0 + q * (-1.13 + q * (12.8 - 1.64 * q)))


def isometric_share(shortening: Series, curvature: Any) -> Series:
    """Return the isometric force of the fibres that must be active, divided by the force that they exert.

    Up to 0.95 of the largest speed, the result is ``1 / force_at``. At higher speeds it continues as a straight
    line, the tangent at 0.95, so that the solver can return from speeds that no muscle reaches.
    """
    inside = jnp.clip(shortening, -1.0, _LAST_SHARE)
    slope = (1.0 + 1.0 / curvature) / (1.0 - _LAST_SHARE) ** 2  # of (1 + q/k) / (1 - q) there
    return 1.0 / force_at(inside, curvature) + slope * jnp.maximum(shortening - _LAST_SHARE, 0.0)


def metabolic_power(
    muscle: Muscle, torque: Series, flap_rate: Series, recoil: Series | float = 0.0
) -> tuple[Series, Series]:
    """Return the metabolic powers of elevators and depressors [W], shape (K,); only positive values count.

    Equation: ``T omega_max Phi(q)``, with T the isometric torque of the active fibres and omega_max the flap rate
    at which they exert no torque. The elevators exert upward torques, and the depressors downward ones: `torque` is
    that of both wings, up positive [N m], as is `flap_rate` [rad/s]. At each instant, the muscle that does not
    exert the torque rests, and its value is negative. The power of the rest of the body is not included. The
    `recoil` of the elevators' tendon is added to their rate; see `tendon_recoil`.
    """

    def cost(shortening: Series) -> Series:
        per_torque = isometric_share(shortening, muscle.curvature) * metabolic_ratio(shortening)
        return muscle.max_flap_rate * per_torque

    shortening = flap_rate / muscle.max_flap_rate
    return torque * cost((flap_rate + recoil) / muscle.max_flap_rate), -torque * cost(-shortening)


def activation(
    muscle: Muscle, torque: Series, flap_rate: Series, recoil: Series | float = 0.0
) -> tuple[Series, Series]:
    """Return the shares of active fibres that elevators and depressors need; above 1, a muscle is too weak.

    At each instant one muscle rests; its share is negative. Torque, rate and recoil are as for `metabolic_power`.
    """
    shortening, whole = flap_rate / muscle.max_flap_rate, muscle.depressor_torque
    elevating = (flap_rate + recoil) / muscle.max_flap_rate
    up = torque * isometric_share(elevating, muscle.curvature) / (whole * muscle.elevator_share)
    down = -torque * isometric_share(-shortening, muscle.curvature) / whole
    return up, down


def tendon_recoil(muscle: Muscle, torque: Series, period: Any) -> Series:
    """Return the rate that the tendon of the elevators adds to the flap rate at the muscle [rad/s], shape (K,).

    Equation: ``C torque'``. The tendon lies in series with the elevators, so that their angle is ahead of the
    wing's by C times the torque. It lengthens while they brake the downstroke, and shortens during the upstroke:
    they then shorten less than the wing moves. It holds where the elevators exert the torque.
    """
    return muscle.tendon_compliance * periodic_rate(torque, period)


def activation_power(muscle: Muscle, up: Series, down: Series, frequency: Any) -> Any:
    """Return the power that the activation of elevators and depressors takes [W].

    Equation: ``e f m (s max(up) + max(down))``: once a beat, each muscle activates as many fibres as it needs at
    most, and e is the energy for that per mass. The shares `up` and `down` are those of `activation`.

    Source of e: Barclay, Woledge and Curtin 2007, J Muscle Res Cell Motil 28:259, doi 10.1007/s10974-007-9116-7,
    abstract: pumping takes 30 to 40 % of the energy of isometric contraction.

    >>> from wingbeat.animal.drive import Muscle
    >>> muscle = Muscle(0.06, 0.2, 0.15, 20.0, 250e3, 0.36, activation_energy=5.0)
    >>> round(float(activation_power(muscle, jnp.array([-1.0, 0.5]), jnp.array([0.4, -1.0]), 6.0)), 3)
    0.9
    """
    active = muscle.elevator_share * jnp.maximum(jnp.max(up), 0.0) + jnp.maximum(jnp.max(down), 0.0)
    return muscle.activation_energy * frequency * muscle.mass * active


def best_efficiency(curvature: Any) -> Any:
    """Return a muscle's largest efficiency, mechanical power divided by metabolic power, at any speed.

    >>> round(float(best_efficiency(0.25)), 2)
    0.5
    """
    shortening = jnp.linspace(0.05, 0.6, 56)
    return jnp.max(force_at(shortening, curvature) * shortening / metabolic_ratio(shortening))


class MotorState(NamedTuple):
    """What a motor does, shape (K,) each."""

    speed: Series  # [rad/s]
    torque: Series  # on gear and rotor, without friction [N m]
    current: Series  # [A]
    voltage: Series  # [V]
    power: Series  # electrical [W], negative where the motor returns power


def motor_state(motor: Motor, torque: Series, rate: Series, acceleration: Series, frequency: Any) -> MotorState:
    """Return the state of a motor that exerts a given torque on the flap hinges at a given flap rate.

    Equations: ``omega = N rate``, ``torque = load / N + J omega'``, ``i = torque/kt + sign(omega) i0``, ``v = R i +
    kt omega``, ``P = v i``. The loss of the gear is added to the load while the motor drives the wings, and
    subtracted from the load while the wings drive the motor. With a crank, the speed is ``N 2 pi f``, the load is
    the flap hinges' power divided by the crank's speed, and the rotor's inertia has no effect. Torque, rate and
    acceleration are those of both flap hinges together [N m, rad/s, rad/s2]; the frequency is the beat's [Hz].
    """
    turning = 2.0 * jnp.pi * frequency
    crank = motor.crank
    load = (1.0 - crank) * torque + crank * torque * rate / turning
    driven = (1.0 - crank) * rate + crank * turning
    speed = motor.gear_ratio * driven
    drives = load * driven > 0.0
    passed = jnp.where(drives, load / motor.gear_efficiency, load * motor.gear_efficiency)
    own = (1.0 - crank) * motor.rotor_inertia * motor.gear_ratio * acceleration
    shaft = passed / motor.gear_ratio + own
    current = shaft / motor.torque_constant + jnp.sign(speed) * motor.no_load_current
    voltage = motor.resistance * current + motor.torque_constant * speed
    return MotorState(speed, shaft, current, voltage, voltage * current)


def cell_voltage(charge: Any) -> Any:
    """Return the voltage of a lithium polymer cell without load by its charge, a share [V].

    Theory: equation ``cell-voltage``. Chen and Rincon-Mora 2006, IEEE Trans. Energy Convers. 21:504, doi
    10.1109/TEC.2006.874229; its numbers as three programs of others repeat them, the paper was not read.
    """
    return -1.031 * jnp.exp(-35.0 * charge) + 3.685 + 0.2156 * charge - 0.1178 * charge**2 + 0.3201 * charge**3


_CHARGES = np.linspace(0.0, 1.0, 401)  # of the table of this cell
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(24)  # of the integral over charge
_TURNS = 16  # of the voltage at which the mean voltage under load is that of the cut-off
_LEAST_VOLTAGE = 1e-6  # of a motor at rest [V]; keeps derivatives finite


class Discharge(NamedTuple):
    """What a battery does that feeds the same beat again and again, from full until this beat ends."""

    endurance: Any  # how long it lasts [s]
    charge_left: Any  # at its end, a share
    peak_current: Any  # at its end, the largest of the beat [A]
    least_voltage: Any  # at its end, the least of the beat at the battery's terminals [V]
    cutoff: Any  # voltage without load at which the mean under load is that of the cut-off [V]
    needed: Any  # voltage without load at which the motor just gets what it needs at the worst instant [V]
    full: Any  # voltage without load of the full battery [V]


def battery_current(opened: Any, resistance: Any, power: Any) -> Any:
    """Return the current of a battery of a voltage without load [V] that gives a power [W].

    Theory: equation ``battery-current``. More than ``opened^2 / (4 resistance)`` no battery gives; there the
    current is that of half the voltage.
    """
    spare = opened**2 - 4.0 * resistance * power
    gives = spare > 0.0  # the root has no derivative at 0
    root = jnp.sqrt(jnp.where(gives, spare, 1.0))
    return jnp.where(gives, 2.0 * power / (opened + root), opened / (2.0 * resistance))


def discharge(battery: Battery, power: Series, voltage: Series) -> Discharge:
    """Return how long a full battery feeds a beat that needs this power [W] and motor voltage [V], shape (K,).

    Theory: equation ``battery-discharge``. The controller lowers the battery's voltage to the motor's without
    loss, and gives no power back. The flight ends when the mean voltage under load falls to the cut-off, when the
    motor no longer gets its voltage at some instant, or when the battery is empty.
    """
    cell = jnp.stack(battery.cell_voltage) if battery.cell_voltage else cell_voltage(_CHARGES)
    opened = battery.cells * cell
    charges = jnp.linspace(0.0, 1.0, opened.shape[0])
    resistance, empty, full = battery.internal_resistance, opened[0], opened[-1]

    def mean_current(at: Any) -> Any:
        current = battery_current(at, resistance, power)
        return jnp.mean(0.5 * (current[..., :-1] + current[..., 1:]), axis=-1)

    cutoff = full
    for _ in range(_TURNS):
        cutoff = battery.cells * battery.cutoff_voltage + resistance * mean_current(cutoff)
    # Where the motor's voltage is low, the battery's power is what is short: it is largest at half the voltage.
    own = jnp.maximum(jnp.abs(voltage), jnp.sqrt(resistance * power + _LEAST_VOLTAGE**2))
    needed = jnp.max(own + resistance * power / own)
    end = jnp.clip(jnp.maximum(cutoff, needed), empty, full)
    left = jnp.interp(end, opened, charges)
    on_the_way = jnp.interp(left + (1.0 - left) * 0.5 * (_NODES + 1.0), charges, opened)
    slowness = jnp.sum(_WEIGHTS / jnp.maximum(mean_current(on_the_way[:, None]), 1e-9)) * 0.5  # [1/A]
    peak = jnp.max(battery_current(end, resistance, power))
    return Discharge(
        endurance=3600.0 * battery.capacity * (1.0 - left) * slowness,
        charge_left=left,
        peak_current=peak,
        least_voltage=end - resistance * peak,
        cutoff=cutoff,
        needed=needed,
        full=full,
    )


# Central differences of order 6 at samples of equal distance: weights of the samples 1, 2 and 3 steps ahead.
_AHEAD = (45 / 60, -9 / 60, 1 / 60)


class Driven(NamedTuple):
    """What the actuators must provide: sums of both hinges, up positive, in angles of the hinge, shape (K,)."""

    torque: Series  # [N m]
    rate: Series  # [rad/s]
    acceleration: Series  # [rad/s2]


def periodic_rate(values: Series, period: Any) -> Series:
    """Return the rate of a periodic series, by central differences of order 6.

    The values are at equal phases from 0 to 1, both ends included and equal, shape (K,).
    """
    once = values[:-1]
    step = period / once.shape[0]
    pairs = (weight * (jnp.roll(once, -n) - jnp.roll(once, n)) for n, weight in enumerate(_AHEAD, 1))
    rate = sum(pairs) / step
    return jnp.concatenate((rate, rate[:1]))


def spring_torque(stiffness: Any, flap: Series, rest_angle: Any) -> Series:
    """Return the torque of springs beside the actuators, ``-k (flap - rest)`` [N m]."""
    return -stiffness * (flap - rest_angle)


def actuated(springs: Springs, flap: Series, rate: Series, torque: Series, period: Any) -> Driven:
    """Return the torque and motion that the actuators of the flap hinges must provide with these springs.

    Equations: the actuators give the torque that the springs beside them do not give. All of this torque passes
    through the springs in series, so that the actuators' angle is ahead of the flap angle by
    ``compliance * torque``. Angle, rate and torque are those of both flap hinges [rad, rad/s, N m], shape (K,).
    """
    left = torque - spring_torque(springs.stiffness, flap, springs.rest_angle)
    own_rate = rate + springs.series_compliance * periodic_rate(left, period)
    return Driven(left, own_rate, periodic_rate(own_rate, period))
