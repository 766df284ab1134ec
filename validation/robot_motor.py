"""The motor of the Purdue Hummingbird in hover, by its makers' equations and by wingbeat.

    python validation/robot_motor.py

prints the numbers of docs/muscles.md. The makers published the robot's simulation: Fei et al. 2019,
arXiv 1902.09628, code purdue-biorobotics/flappy (Actuator.cpp, Wing.cpp, mav_config_list.json, pid_controller.py).
`makers_hover` marches these equations for one wing whose pitch is at its stop in each half of the stroke. It shares
no code with wingbeat. `flown` is a hover by the model `animal` at the robot's frequency.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

import wingbeat as wb
from wingbeat.actuators.motor import motor_state
from wingbeat.actuators.springs import actuated

# What the makers state: frequency [Hz], amplitude of the voltage in hover and the largest [V], whole mass [kg].
FREQUENCY, HOVER_VOLTAGE, LARGEST_VOLTAGE, MASS = 34.0, 9.3, 18.0, 0.012
# Largest lift [kg], a press report (mikeshouts.com), low trust.
LARGEST_LIFT = 0.027
# One wing: length and mean chord [m], moments of its area, inertia about the stroke axis [kg m2], stop of its
# pitch [rad].
LENGTH, CHORD, R22, R33, INERTIA, STOP = 0.07, 0.0212121, 0.2842036, 0.2058333, 2.21e-7, math.radians(45)
AIR_DENSITY = 1.18009
# One motor: torque constant [N m/A], gear ratio and efficiency.
TORQUE_CONSTANT, GEAR, EFFICIENCY = 1.75e-3, 10, 0.9
# Its friction [N m], damping [N m s] and inertia [kg m2], and the spring of one wing [N m/rad].
FRICTION, DAMPING, ROTOR, SPRING = 2e-5, 9.74e-9, 7.03e-10, 0.0133
# Resistance [ohm]: of the data sheet, and the mean of the two fitted motors of the version with trim.
NOMINAL, FITTED = 12.4, 0.5 * (14.780 + 13.763)


class Hover(NamedTuple):
    """One beat of both wings by the makers' equations, series of shape (K,), both ends included.

    Attributes
    ----------
    flap, rate, torque : angle [rad], rate [rad/s] and torque [N m] at both flap hinges, without springs.
    voltage, current : at each motor [V], of both motors [A].
    lift : mean [N].
    """

    flap: np.ndarray
    rate: np.ndarray
    torque: np.ndarray
    voltage: np.ndarray
    current: np.ndarray
    lift: float

    @property
    def numbers(self) -> dict[str, float]:
        """Amplitude of the flap [deg], peaks and means of torque, speed, current, power, and lift over weight."""
        return {
            "flap amplitude [deg]": math.degrees(np.ptp(self.flap)) / 2,
            "lift over weight": self.lift / (9.81 * MASS),
            "peak voltage [V]": np.abs(self.voltage).max(),
            "peak motor speed [rad/s]": GEAR * np.abs(self.rate).max(),
            "rms torque of both motors [mN m]": 1e3 * TORQUE_CONSTANT * rms(self.current),
            "electrical power [W]": np.maximum(self.voltage * self.current, 0.0)[:-1].mean(),
        }


def rms(series: np.ndarray) -> float:
    """Return the root mean square over one beat."""
    return float(np.sqrt(np.mean(np.asarray(series)[:-1] ** 2)))


def makers_hover(
    voltage: float = HOVER_VOLTAGE, resistance: float = NOMINAL, samples: int = 512, beats: int = 30
) -> Hover:
    """March the makers' equations of one wing until the beat repeats; return the last beat.

    Equations: ``J phi'' = eta N (kt i - d N phi' - friction sign phi') - k phi - Q`` with
    ``i = (V - kt N phi')/R``, ``J`` the inertia of wing and geared rotor, the moment of the air
    ``Q = F cos(stop) r33/r22 R`` and ``F = 0.5 rho c C_N r22 R^3 phi'^2``; ``C_N`` as in Wing.cpp.
    """
    turning, angle = 2 * math.pi * FREQUENCY, math.pi / 2 - STOP
    normal = (
        1.8 * math.sin(2 * angle) * math.cos(angle)
        + 1.95 * math.sin(angle)
        - 1.5 * math.cos(2 * angle) * math.sin(angle)
    )
    force = 0.5 * AIR_DENSITY * CHORD * normal * LENGTH**3 * R22
    drag = force * math.cos(STOP) * LENGTH * R33 / R22

    def current(t: float, rate: float) -> float:
        return (voltage * math.cos(turning * t) - TORQUE_CONSTANT * GEAR * rate) / resistance

    def rates(t: float, state: np.ndarray) -> np.ndarray:
        flap, rate = state
        motor = TORQUE_CONSTANT * current(t, rate) - DAMPING * GEAR * rate - FRICTION * np.sign(rate)
        moment = EFFICIENCY * GEAR * motor - SPRING * flap - drag * rate * abs(rate)
        return np.array([rate, moment / (INERTIA + EFFICIENCY * GEAR**2 * ROTOR)])

    step, state, found = 1 / (FREQUENCY * samples), np.zeros(2), []
    for index in range(beats * samples + 1):
        t = index * step
        slope = rates(t, state)
        if index >= (beats - 1) * samples:
            found.append((*state, slope[1], voltage * math.cos(turning * t), 2 * current(t, state[1])))
        second = rates(t + step / 2, state + step / 2 * slope)
        third = rates(t + step / 2, state + step / 2 * second)
        state = state + step / 6 * (slope + 2 * second + 2 * third + rates(t + step, state + step * third))
    flap, rate, acceleration, volts, amperes = np.array(found).T
    torque = 2 * (INERTIA * acceleration + drag * rate * np.abs(rate))
    lift = 2 * force * math.sin(STOP) * np.mean(rate[:-1] ** 2)
    return Hover(flap, rate, torque, volts, amperes, float(lift))


def wingbeats_motor(hover: Hover, resistance: float = NOMINAL) -> dict[str, float]:
    """Return what wingbeat's motor and springs need for the makers' beat, by the names of `Hover.numbers`."""
    species = wb.load_species("purdue-hummingbird").with_values({"motor.resistance": resistance / 2})
    _, motor, springs = species.vehicle.drive
    need = actuated(springs, hover.flap, hover.rate, hover.torque, 1 / FREQUENCY)
    state = motor_state(motor, need.torque, need.rate, need.acceleration, FREQUENCY)
    return {
        "peak voltage [V]": float(np.abs(state.voltage).max()),
        "peak motor speed [rad/s]": float(np.abs(state.speed).max()),
        "rms torque of both motors [mN m]": 1e3 * TORQUE_CONSTANT * rms(np.asarray(state.current)),
        "electrical power [W]": float(np.maximum(np.asarray(state.power), 0.0)[:-1].mean()),
    }


def flown(starts: int = 6) -> wb.Orbit:
    """Return a hover by the model `animal` at the robot's frequency and with its pitch between its stops."""
    species = wb.load_species("purdue-hummingbird")
    species = species.with_values({"wingbeat.frequency": FREQUENCY, "wingbeat.pitch_amplitude": STOP})
    model = wb.models.animal(species)
    fixed = {"frequency", "pitch_amplitude"}
    free = [name for name in model.species(species).free if name not in fixed]
    return wb.solve_orbit(model.problem(species, speed=0.0, free=free), starts=starts)


def flown_numbers(orbit: wb.Orbit) -> dict[str, float]:
    """Return the numbers of a flight, by the names of `Hover.numbers`."""
    record = orbit.record()
    return {
        "flap amplitude [deg]": math.degrees(record["wingbeat"]["flap_amplitude"]),
        "lift over weight": 1.0,
        "peak voltage [V]": record["peak_motor_voltage"],
        "peak motor speed [rad/s]": record["peak_motor_speed"],
        "rms torque of both motors [mN m]": 1e3 * TORQUE_CONSTANT * record["rms_motor_current"],
        "electrical power [W]": record["electrical_power"],
    }


def main() -> None:
    """Print all columns."""
    nominal, fitted = makers_hover(), makers_hover(resistance=FITTED)
    columns = {"makers": nominal.numbers, "makers, fitted": fitted.numbers, "motor": wingbeats_motor(nominal)}
    orbit = flown()
    print(orbit.status.value, orbit.message)
    columns["flight"] = flown_numbers(orbit)
    for name in nominal.numbers:
        print(name, {column: f"{numbers[name]:.4g}" for column, numbers in columns.items() if name in numbers})
    for resistance in (NOMINAL, FITTED):
        largest = makers_hover(LARGEST_VOLTAGE, resistance)
        print(f"{LARGEST_VOLTAGE} V, {resistance:.1f} ohm: lift {1e3 * largest.lift / 9.81:.1f} g")


if __name__ == "__main__":
    main()
